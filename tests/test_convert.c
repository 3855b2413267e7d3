// SPDX-License-Identifier: MIT
// The statements of the language as the scene they make: objects, what they inherit, patches,
// bounding boxes; whole scenes and the standard includes. Truth is the facts about POV-Ray, its
// binary where it can be asked, and mathematics.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/diag.h"
#include "convert_help.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// ---- shapes and transforms -------------------------------------------------------------------

static void sphere_keeps_its_numbers(void **state) {
    (void)state;
    Scene *s = scene_of("sphere { <1,2,3>, 2 translate x scale 3 rotate 90*y }"
                        "sphere { x, 1 scale <1,2,1> translate y }"
                        "sphere { x, 1 matrix <1,0,0, 0,1,0, 0,0,1, 5,0,0> }");
    assert_false(root(s, 0)->has_transform);
    assert_vec(root(s, 0)->shape.sphere.center, 9, 6, -6); // z goes to x, x to -z
    assert_near(root(s, 0)->shape.sphere.radius, 6);
    assert_true(root(s, 1)->has_transform);
    assert_vec(root(s, 1)->shape.sphere.center, 1, 0, 0);
    assert_vec(transform_point(&root(s, 1)->transform, vec3(1, 1, 0)), 1, 3, 0);
    assert_true(root(s, 2)->has_transform);
}

static void plane_moves_with_its_points(void **state) {
    (void)state;
    const char *moves[] = {"translate <1,2,3>", "rotate <30,40,50>", "scale <1,2,3>",
                           "matrix <1,2,0, 0,1,0, 0,3,1, 1,2,3>",
                           "scale <1,-2,3> rotate 20*z translate y"};
    for (size_t i = 0; i < sizeof moves / sizeof *moves; i++) {
        char text[512]; // a triangle in the plane goes the same way, since its points are moved
        snprintf(text, sizeof text,
                 "plane { <1,2,2>, 3 %s } triangle { <1,2,2>, <3,1,2>, <3,3,0> %s }", moves[i],
                 moves[i]);
        Scene *s = scene_of(text);
        const PlaneShape *plane = &root(s, 0)->shape.plane;
        assert_near(vec_length(plane->normal), 1);
        for (int k = 0; k < 3; k++)
            assert_near(vec_dot(plane->normal, root(s, 1)->shape.triangle.p[k]), plane->distance);
    }
}

static void other_shapes(void **state) {
    (void)state;
    Scene *s = scene_of("box { <1,5,-1>, <0,2,3> scale <-2,1,1> translate x }"
                        "box { 0, 1 rotate 10 }"
                        "cone { 0, 1, y, 0.5 open } cone { 0, 1, y, 1 } cylinder { 0, y, 2 open }"
                        "torus { 2, 0.5 rotate 90*x } disc { y, <0,2,0>, 3 } disc { 0, z, 3, 1 }");
    assert_vec(root(s, 0)->shape.box.low, -1, 2, -1);
    assert_vec(root(s, 0)->shape.box.high, 1, 5, 3);
    assert_false(root(s, 0)->has_transform);
    assert_true(root(s, 1)->has_transform);
    assert_int_equal(root(s, 2)->type, OBJECT_CONE);
    assert_near(root(s, 2)->shape.cone.apex_radius, 0.5);
    assert_true(root(s, 2)->shape.cone.open);
    assert_int_equal(root(s, 3)->type, OBJECT_CYLINDER);
    assert_near(root(s, 4)->shape.cone.base_radius, 2);
    assert_true(root(s, 4)->shape.cone.open);
    assert_vec(transform_point(&root(s, 5)->transform, vec3(0, 1, 0)), 0, 0, 1);
    assert_vec(root(s, 6)->shape.disc.normal, 0, 1, 0);
    assert_near(root(s, 6)->shape.disc.hole, 0);
    assert_near(root(s, 7)->shape.disc.hole, 1);
}

static void odd_numbers(void **state) {
    (void)state;
    Scene *s = scene_of("sphere { 0, -2 } cylinder { 0, y, -1 } disc { 0, y, -3 }");
    assert_near(root(s, 0)->shape.sphere.radius, 2);
    assert_true(root(s, 0)->inverse);
    assert_near(root(s, 1)->shape.cone.base_radius, 1);
    assert_near(root(s, 2)->shape.disc.radius, 3);
    assert_warns("torus { 1, -1 }", "a radius of the torus is negative: it is ignored");
    assert_warns("disc { 0, 0, 1 }", "the normal of the disc has no length: it is ignored");
    assert_warns("superellipsoid { <1, -1> }", "is not above 0: it is ignored");
    assert_int_equal(scene_of("torus { 1, -1 } disc { 0, 0, 1 } sphere { 0, 1 }")->object_count, 1);
    assert_dies("sphere { 0, 1e400 }", "2:1: error: a number of this sphere is not finite");
    assert_dies("box { <0, 1e400 - 1e400, 0>, 1 }", "not finite");
    assert_dies("cylinder { x, x, 1 }", "are the same point");
    assert_dies("plane { 0, 1 }", "must have a length");
}

static void transform_blocks(void **state) {
    (void)state;
    Scene *s = scene_of("#declare T = transform { translate x inverse scale 2 }"
                        "triangle { 0, x, y transform T } triangle { 0, x, y transform { T } }"
                        "triangle { 0, x, y transform { T inverse } }"
                        "triangle { 0, x, y transform { translate x scale 2 } }");
    // Forth: p -> 2 (p + x); the inverse that T stands for: p -> p / 2 - x.
    assert_vec(root(s, 0)->shape.triangle.p[1], -0.5, 0, 0);
    assert_vec(root(s, 1)->shape.triangle.p[1], -0.5, 0, 0);
    assert_vec(root(s, 2)->shape.triangle.p[1], 4, 0, 0);
    assert_vec(root(s, 3)->shape.triangle.p[1], 4, 0, 0);
    assert_warns("sphere { 0, 1 scale <1,2> }", "scale by 0 in z"); // T14
    assert_warns("sphere { 0, 1 matrix <1,0,0, 1,0,0, 0,0,1, 0,0,0> }", "column 2");
    assert_dies("sphere { 0, 1 matrix <1,1,0, 1,1,0, 0,0,1, 0,0,0> }", "no inverse");
}

static void names_stand_for_objects(void **state) {
    (void)state;
    const char *declared = "#declare A = sphere { 0, 1 }\n";
    char text[256];
    snprintf(text, sizeof text, "%sA box { A translate x } object { A }", declared);
    Scene *s = scene_of(text);
    assert_int_equal(s->root_count, 3); // T29
    assert_int_equal(root(s, 1)->type, OBJECT_SPHERE);
    assert_vec(root(s, 1)->shape.sphere.center, 1, 0, 0);
    assert_vec(root(s, 2)->shape.sphere.center, 0, 0, 0); // the declared one was not moved
    snprintf(text, sizeof text, "%sunion { A A }", declared);
    assert_dies(text, "scene.pov:3:11: error");
}

static void trees_are_copied_when_changed(void **state) {
    (void)state;
    Scene *s = scene_of("#declare U = union { sphere { 0, 1 } bicubic_patch { type 1 " PATCH_POINTS
                        " } light_source { y, 1 } }\n"
                        "object { U translate x } object { U } object { U translate y }");
    for (uint32_t i = 0; i < 3; i++) {
        double x = i == 0, y = i == 2;
        assert_vec(child(s, root(s, i), 0)->shape.sphere.center, x, y, 0);
        assert_vec(child(s, root(s, i), 1)->shape.patch.points[15], 3 + x, 3 + y, 1);
        assert_vec(s->lights[i].location, x, 1 + y, 0);
    }
    // A tree that grows by itself is deep; one without an end is refused. One of unions may be as
    // deep as it likes: before, it was refused too.
    scene_of("#declare A = sphere { 0, 1 } #declare I = 0; #while (I < 900)"
             "#declare A = union { object { A } sphere { I, 1 } } #declare I = I + 1; #end "
             "object { A translate x }");
    s = scene_of("#declare A = sphere { 0, 1 } #declare I = 0; #while (I < 1200)"
                 "#declare A = union { object { A } sphere { I*x, 1 } translate x }"
                 "#declare I = I + 1; #end A");
    uint32_t spheres = 0;
    for (uint32_t i = 0; i < s->object_count; i++)
        if (s->objects[i].type == OBJECT_SPHERE)
            assert_vec(s->objects[i].shape.sphere.center, 1200, 0, 0), spheres++;
    assert_int_equal(spheres, 1201);
    assert_dies("#declare A = sphere { 0, 1 } #declare I = 0; #while (I < 1500)"
                "#declare A = merge { object { A } sphere { I, 1 } } #declare I = I + 1; #end A",
                "1000 objects inside one another");
}

static void inverse_objects(void **state) {
    (void)state;
    Scene *s = scene_of("plane { y, 2 inverse } sphere { 0, 1 inverse } sphere { 0, 1 inverse "
                        "inverse }");
    assert_vec(root(s, 0)->shape.plane.normal, 0, -1, 0);
    assert_near(root(s, 0)->shape.plane.distance, -2);
    assert_true(root(s, 1)->inverse);
    assert_false(root(s, 2)->inverse);
    s = scene_of("union { sphere { 0, 1 } plane { y, 2 } inverse }");
    assert_int_equal(root(s, 0)->type, OBJECT_INTERSECTION);
    assert_true(child(s, root(s, 0), 0)->inverse);
    assert_vec(child(s, root(s, 0), 1)->shape.plane.normal, 0, -1, 0);
    s = scene_of("merge { sphere { 0, 1 } sphere { x, 1 } inverse inverse }");
    assert_int_equal(root(s, 0)->type, OBJECT_MERGE);
    assert_false(child(s, root(s, 0), 0)->inverse);
    assert_warns("triangle { 0, x, y inverse }", "inverse has no effect");
}

// ---- patches ---------------------------------------------------------------------------------

static void patch_fields(void **state) {
    (void)state;
    Scene *s = scene_of("#declare F = 0.01; #declare P = <7,0,0>; "
                        "bicubic_patch { v_steps 4.9 u_steps 2 type 0 flatness F, " PATCH_POINTS "}"
                        "bicubic_patch { type 1 accuracy 5 v_steps -3 " PATCH_POINTS "}"
                        "bicubic_patch { 1 3 4 " PATCH_POINTS "}"
                        "bicubic_patch { 2 0.5 3 4 " PATCH_POINTS "}");
    const PatchShape *patch = &root(s, 0)->shape.patch;
    assert_int_equal(patch->type, 0);
    assert_int_equal(patch->u_steps, 2);
    assert_int_equal(patch->v_steps, 4);
    assert_near(patch->flatness, 0.01);
    assert_vec(patch->points[3], 3, 0, 0);
    assert_vec(patch->points[12], 0, 3, 0);
    assert_int_equal(patch->degree_u, 3);
    patch = &root(s, 1)->shape.patch;
    assert_int_equal(patch->u_steps, 0);
    assert_int_equal(patch->v_steps, 0);
    assert_near(patch->flatness, 0);
    assert_near(patch->uv[2].u, 1);
    assert_near(patch->uv[1].v, 0);
    patch = &root(s, 2)->shape.patch;
    assert_near(patch->flatness, 0.1);
    assert_int_equal(patch->u_steps, 3);
    assert_int_equal(patch->v_steps, 4);
    patch = &root(s, 3)->shape.patch;
    assert_int_equal(patch->type, 1);
    assert_near(patch->flatness, 0.5);
}

static void patch_points_of_all_kinds(void **state) {
    (void)state;
    Scene *s = scene_of("#declare A = <0,0,0>; #declare B = array[2] { x, 2*x }\n" // T31
                        "#macro M(N) <N,1,0> #end\n"
                        "bicubic_patch { type 1 flatness 0.1 v_steps 3 u_steps 3\n"
                        "uv_vectors <0,0><2,0><2,2>,<0,2>\n"
                        "A B[0], B[1] A+3*x M(0) M(1), M(2) <3,1 0> <0,2,0,><1,2,0><2,2,0><3,2,0>"
                        "<0,3,0>,<1,3,0>,<2,3,0>,<3,3,0> scale <1,-1,2> translate z }");
    const PatchShape *patch = &root(s, 0)->shape.patch;
    assert_vec(patch->points[2], 2, 0, 1);
    assert_vec(patch->points[6], 2, -1, 1);
    assert_near(patch->uv[1].u, 2);
}

static void patch_errors(void **state) {
    (void)state;
    const char *head = "bicubic_patch { type 1 ";
    assert_dies("bicubic_patch { type 1 u_steps 3, v_steps 3 " PATCH_POINTS "}",
                "2:35: error: no comma"); // T30
    assert_dies("bicubic_patch { flatness 1 " PATCH_POINTS "}", "needs 'type'");
    assert_dies("bicubic_patch { type -1 " PATCH_POINTS "}", "needs 'type'");
    assert_dies("bicubic_patch { type 1 uv_vectors <0,0><1,0><1,1><0,1> u_steps 3 " PATCH_POINTS
                "}",
                "must be the last keyword");
    assert_dies("bicubic_patch { type 1 <0,0,0> }", "point 2 of 16");
    assert_dies("bicubic_patch { type 1 " PATCH_POINTS " x }", "after the 16 points");
    assert_warns("bicubic_patch { type 3 " PATCH_POINTS "}", "type 3 is treated as type 1");
    char text[1024];
    snprintf(text, sizeof text, "%s<0,0,0>,<1e400-1e400,0,0>,<1,1,1> }", head);
    assert_dies(text, "point 2 of the patch (group 1, position 2) is not finite");
}

static void patch_bounds(void **state) {
    (void)state;
    const char *patch = "bicubic_patch { type 1 " PATCH_POINTS;
    char text[1024];
    // POV-Ray keeps the smaller of the two boxes, and cuts the patch at it.
    static const double highs[] = {2, 1};
    for (int clip = 0; clip < 2; clip++)
        for (int i = 0; i < 2; i++) {
            snprintf(text, sizeof text, "%s %s { box { -1, %g } } }", patch,
                     clip ? "clipped_by" : "bounded_by", highs[i]);
            assert_silent(text);
            Scene *s = scene_of(text);
            assert_int_equal(root(s, 0)->bounds.count, 1);
            assert_int_equal(root(s, 0)->clips.count, 0);
            const Object *box = &s->objects[root(s, 0)->bounds.items[0]];
            assert_vec(box->shape.box.high, i ? 1 : 3, i ? 1 : 3, 1);
        }
    // Moved with what is around it, it forgets its bounds.
    snprintf(text, sizeof text, "union { %s clipped_by { box { -1, 1 } } } translate x }", patch);
    Scene *s = scene_of(text);
    const Object *part = child(s, root(s, 0), 0);
    assert_vec(s->objects[part->bounds.items[0]].shape.box.high, 4, 3, 1);
    assert_silent("sphere { 0, 1 bounded_by { box { -1, 1 } } }");
    assert_silent("sphere { 0, 1 clipped_by { plane { y, 0 } } bounded_by { clipped_by } }");
    // Bounds of a tree stay, and keep a union whole; what a split union has at the top does not.
    s = scene_of("union { sphere { 0, 1 } sphere { x, 1 } bounded_by { sphere { 0, 0.5 } } }"
                 "union { sphere { 0, 1 } sphere { x, 1 } split_union off }"
                 "union { sphere { 0, 1 } sphere { x, 1 } }");
    assert_true(root(s, 0)->whole && root(s, 1)->whole && !root(s, 2)->whole);
    assert_int_equal(root(s, 0)->bounds.count, 2); // its box and the sphere
    assert_int_equal(root(s, 1)->bounds.count, 0);
    assert_warns("sphere { 0, 1 clipped_by { plane { y, 0 } julia_fractal { <1,0,0,0> } } }",
                 "'julia_fractal' is not modelled");
    snprintf(text, sizeof text, "sphere { 0, 1 bounded_by { %s } } }", patch);
    assert_dies(text, "without an inside");
}

// ---- inheritance -----------------------------------------------------------------------------

static void unions_pass_on(void **state) {
    (void)state;
    Scene *s = scene_of("union { sphere { 0, 1 finish { ambient 1 } } sphere { 9, 1 } "
                        "pigment { rgb <1,0,0> } no_shadow no_image hollow }"); // T33
    const Object *a = child(s, root(s, 0), 0), *b = child(s, root(s, 0), 1);
    assert_near(pigment_of(s, a, 0)->color.r, 0);
    assert_near(s->textures[a->texture].layers[0].finish.ambient.g, 1);
    assert_near(pigment_of(s, b, 0)->color.r, 1);
    assert_true(a->no_shadow && b->no_image && a->hollow && !b->no_reflection);
    s = scene_of("union { union { sphere { 0, 1 hollow off } sphere { x, 1 } double_illuminate off"
                 " } sphere { y, 1 } hollow double_illuminate }");
    const Object *inner = child(s, root(s, 0), 0);
    assert_false(child(s, inner, 0)->hollow);
    assert_true(child(s, inner, 1)->hollow);
    assert_true(child(s, inner, 1)->double_illuminate); // the outer one speaks last
}

static void unions_share_an_interior(void **state) {
    (void)state;
    Scene *s =
        scene_of("union { sphere { 0, 1 } sphere { x, 1 } sphere { y, 1 interior { ior 1.2 } }"
                 " interior { ior 1.5 caustics 1 fade_distance 2 fade_power 1 } }"
                 "union { sphere { 0, 1 } union { sphere { x, 1 } sphere { y, 1 } } }"
                 "sphere { 0, 1 }");
    const Object *u = root(s, 0);
    uint32_t shared = child(s, u, 0)->interior;
    assert_int_equal(child(s, u, 1)->interior, shared);
    assert_int_not_equal(child(s, u, 2)->interior, shared);
    assert_near(s->interiors[shared].ior, 1.5);
    assert_near(s->interiors[shared].caustics, 45);
    assert_near(s->interiors[child(s, u, 2)->interior].ior, (float)1.2);
    // Also air is shared: a ray that enters one child leaves at the next.
    u = root(s, 1);
    shared = child(s, u, 0)->interior;
    assert_int_not_equal(shared, NO_INDEX);
    assert_int_equal(child(s, child(s, u, 1), 1)->interior, shared);
    assert_int_equal(root(s, 2)->interior, NO_INDEX);
    // Two copies of one object are two bodies.
    s = scene_of("#declare S = sphere { 0, 1 interior { ior 1.5 } } object { S } object { S }");
    assert_int_not_equal(root(s, 0)->interior, root(s, 1)->interior);
    // ior in its old place.
    s = scene_of("sphere { 0, 1 finish { ior 1.4 refraction 1 } }");
    assert_near(s->interiors[root(s, 0)->interior].ior, (float)1.4);
}

static void uv_flag(void **state) {
    (void)state;
    Scene *s = scene_of("union { sphere { 0, 1 } uv_mapping pigment { rgb 1 } }"
                        "sphere { 0, 1 uv_mapping pigment { checker } scale 3 }"
                        "sphere { 0, 1 pigment { uv_mapping checker scale 0.5 } scale 3 }"
                        "sphere { 0, 1 texture { uv_mapping pigment { checker } } }");
    assert_true(child(s, root(s, 0), 0)->uv_mapping);
    assert_int_equal(pigment_of(s, root(s, 1), 0)->pattern.warp_count, 0);
    const Pigment *p = pigment_of(s, root(s, 2), 0);
    assert_true(p->uv_mapping && !root(s, 2)->uv_mapping);
    assert_near(p->pattern.warps[0].transform.m[0][0], 0.5); // the object's scale has no part
    assert_int_equal(p->pattern.warp_count, 1);
    assert_true(s->textures[root(s, 3)->texture].uv_mapping);
    assert_dies("sphere { 0, 1 pigment { rgb 1 } uv_mapping }", "before the texture");
}

static void lights_leave_their_unions(void **state) {
    (void)state;
    Scene *s = scene_of(
        "union { light_source { y, rgb 2 parallel point_at x } sphere { 0, 1 } translate z }"
        "light_source { <1,2,3> } light_source { 0, 1 shadowless fade_distance 2 fade_power 3 }"
        "light_source { x, 1 looks_like { sphere { 0, 2 } } translate y }");
    assert_int_equal(s->light_count, 4);
    assert_int_equal(s->lights[0].type, LIGHT_PARALLEL);
    assert_vec(s->lights[0].location, 0, 1, 1);
    assert_vec(s->lights[0].point_at, 1, 0, 1);
    assert_near(s->lights[0].color.g, 2);
    assert_near(s->lights[1].color.g, 0); // T40: no colour is black
    assert_true(s->lights[2].shadowless);
    assert_near(s->lights[2].fade_power, 3);
    assert_int_equal(s->root_count, 2);
    assert_vec(root(s, 1)->shape.sphere.center, 1, 1, 0);
    assert_true(root(s, 1)->no_shadow);
    assert_dies("light_source { <1,2,3> rgb 1 radius 5 spotlight }", "'radius' needs spotlight");
    assert_dies("light_source { 0, 1 point_at y }", "'point_at' needs spotlight");
    s = scene_of("difference { light_source { 0, 1 } sphere { 0, 1 } translate x }");
    assert_vec(s->lights[0].location, 1, 0, 0);
    s = scene_of("light_source { 0, 1 projected_through { sphere { x, 1 } } translate 3*x } "
                 "sphere { 0, 1 }");
    assert_true(s->lights[0].has_projection && s->projection_count == 1 && s->root_count == 1);
    const Object *slit = &s->objects[s->projections[s->lights[0].projection]];
    assert_true(slit->shape.sphere.center.x == 4);
    assert_dies("light_source { 0, 1 area_light x, y, 0, 3 }", "1 to 2048 points");
}

// ---- constructive solid geometry

static void trees_and_clips(void **state) {
    (void)state;
    Scene *s = scene_of("difference { box { -1, 1 } sphere { 0, 1 } intersection { sphere { 0, 1 } "
                        "torus { 1, 0.2 } } bicubic_patch { type 1 " PATCH_POINTS "} }");
    const Object *tree = root(s, 0);
    assert_int_equal(tree->type, OBJECT_INTERSECTION);
    assert_int_equal(tree->shape.children.count, 4);
    assert_false(child(s, tree, 0)->inverse);
    assert_true(child(s, tree, 1)->inverse);
    assert_int_equal(child(s, tree, 2)->type, OBJECT_MERGE);
    assert_true(child(s, child(s, tree, 2), 1)->inverse);
    assert_false(child(s, tree, 3)->inverse); // a patch has no inside

    // Clips move with the object from where they were given; they carry neither texture nor body.
    s = scene_of("sphere { 0, 1 translate x clipped_by { plane { y, 1 } union { sphere { 0, 1 } "
                 "box { 0, 1 } } } translate 2*y pigment { rgb 1 } }");
    const Object *sphere = root(s, 0);
    assert_int_equal(sphere->clips.count, 2);
    const Object *plane = &s->objects[sphere->clips.items[0]];
    assert_near(plane->shape.plane.distance, 3);
    assert_true(plane->texture == NO_INDEX && plane->interior == NO_INDEX);
    assert_vec(child(s, &s->objects[sphere->clips.items[1]], 0)->shape.sphere.center, 0, 2, 0);

    // Without a modelled cutter it stays whole; without what bounds it nothing may be left.
    Converted result = convert_text("difference { sphere { 0, 1 } julia_fractal { <1,0,0,0> } }");
    assert_int_equal(result.scene->object_count, 2);
    assert_int_equal(result.warnings, 1);
    result = convert_text("difference { julia_fractal { <1,0,0,0> } sphere { 0, 1 } }");
    assert_int_equal(result.scene->object_count, 0);
    assert_silent("difference { sphere { 0, 1 pigment { rgb 1 } } box { 0, 1 } cutaway_textures }");
    const char many[] = "difference { union { #for (I, 1, %d) sphere { I*x, 1 pigment { rgb I } } "
                        "#end } box { 0, 1 } cutaway_textures }";
    char text[256];
    snprintf(text, sizeof text, many, HIT_MAX_TEXTURES);
    assert_silent(text);
    snprintf(text, sizeof text, many, HIT_MAX_TEXTURES + 1);
    assert_warns(text, "cutaway_textures among so many textures");
}

// ---- what is not modelled --------------------------------------------------------------------

static void gaps_are_said_when_used(void **state) {
    (void)state;
    assert_silent("#declare J = julia_fractal { <1,0,0,0> } sphere { 0, 1 }");
    assert_silent("#declare T = texture { pigment { wood turbulence 1 } normal { bumps } }"
                  "sphere { 0, 1 }");
    assert_warns("sphere { 0, 1 } julia_fractal { <1,0,0,0> }",
                 "2:17: error: 'julia_fractal' is not modelled");
    Converted result =
        convert_text("#declare I = 0; #while (I < 5) sphere { I, 1 pigment { tiling 3 } "
                     "normal { tiling 3 } } #declare I = I + 1; #end");
    assert_int_equal(result.warnings, 2); // once a place
    result = convert_text("#declare P = pigment { wood turbulence 1 scale 2 };\n");
    assert_int_equal(result.warnings, 1); // no object
    result = convert_text("global_settings { radiosity { count 3 } } media { emission 1 } "
                          "fog { distance 0 rgb 1 } sphere { 0, 1 }");
    assert_int_equal(result.warnings, 2);
    result = convert_text("#declare J = julia_fractal { <1,0,0,0> } "
                          "intersection { sphere { 0, 1 } object { J } } "
                          "union { sphere { 0, 1 } object { J } }");
    assert_int_equal(result.scene->object_count, 2);
    assert_int_equal(result.warnings, 1); // once a place
}

static void empty_scenes(void **state) {
    (void)state;
    Converted result = convert_text("");
    assert_non_null(result.scene);
    assert_int_equal(result.warnings, 1);
    assert_near(result.scene->camera.right.x, 1.33);
    assert_dies("sphere { 0, 1 ", "scene.pov:2:15: error");
    assert_dies("sphere { 0, 1 pigment { rgb 1 }", "error");
    assert_dies("pigment { rgb 1 }", "2:1: error: expected an object");
    assert_dies("sphere { 0, 1 wobble }", "2:15: error");
}

// ---- bounding boxes --------------------------------------------------------------------------

// min_extent and max_extent of the converter against those of povray, for one object a line.
static void extents_are_those_of_povray(void **state) {
    (void)state;
    static const char *const objects[] = {
        "sphere { 0.1, 1 }",
        "sphere { 0.1, 1 scale <1,2,3> rotate 30*z }",
        "sphere { <1,2,3>, 1 rotate 30*y }",
        "sphere { 0, 1 matrix <1,0,0, 0.5,1,0, 0,0,1, 0,0,0> }",
        "box { <0.1,0.2,0.3>, <1,2,3> }",
        "box { <0.1,0.2,0.3>, <1,2,3> rotate 30 translate 0.7 }",
        "cylinder { <0.1,0.2,0.3>, <1,2,3>, 0.5 }",
        "cylinder { 0, z, 0.5 scale <1,2,3> }",
        "cylinder { 0, -z, 0.5 }",
        "cone { <0.1,0.2,0.3>, 0.5, <1,2,3>, 0.25 }",
        "cone { <0.1,0.2,0.3>, 0.25, <1,2,3>, 0.5 rotate 40*x }",
        "cone { 0, 0.5, y, 0.5 }",
        "torus { 1, 0.3 rotate 30 }",
        "disc { <0.1,0.2,0.3>, y, 1 }",
        "disc { <0.1,0.2,0.3>, <1,2,3>, 1, 0.5 scale 2 }",
        "triangle { <0.1,0.2,0.3>, <1,2,3>, <3,1,0.3> rotate 10 }",
        "plane { y, 1 }",
        "union { box { 0, 1 } sphere { 2, 0.5 } rotate 45*z }",
        "merge { box { 0, 1 } sphere { 2, 0.5 } }",
        "intersection { box { 0, 1 } sphere { 0.9, 0.5 } }",
        "difference { box { 0, 1 } sphere { 0.9, 0.5 } }",
        "difference { box { 0, 1 } sphere { 0.9, 0.5 } box { 0.2, 3 inverse } }",
        "difference { box { 0, 1 inverse } sphere { 0.9, 0.5 } }",
        "intersection { box { -1, 1 } plane { y, 0.3 } plane { -x, 0.2 } plane { x + y, 0.1 } }",
        "intersection { box { -1, 1 } box { 0, 1 inverse } } ",
        "intersection { box { -1, 1 } box { 2, 3 } }",
        "intersection { union { box { -1, 1 } inverse } box { -4, 2 } inverse translate x }",
        "sphere { 0, 1 clipped_by { box { 0, 2 } box { -1, 1 inverse } } }",
        "plane { y, 1 clipped_by { box { 0, 2 inverse } } scale 2 }",
        "object { bicubic_patch { type 1 " PATCH_POINTS " clipped_by { box { 0, 2 } } } rotate y }",
        "union { bicubic_patch { type 1 " PATCH_POINTS " clipped_by { box { 0, 2 } } } scale 2 }",
        "sphere { 0, 1 clipped_by { box { 0, 2 } } }",
        "sphere { 0, 1 bounded_by { box { 0, 1 } } }",
        "sphere { 0, 1 bounded_by { box { -3, 3 } } }",
        "union { sphere { 0, 1 } sphere { 1, 1 } bounded_by { box { -0.5, 0.5 } } translate x }",
        "bicubic_patch { type 1 " PATCH_POINTS " rotate 30*y scale 0.1 }",
        "light_source { y, 1 }",
        "union { light_source { y, 1 } sphere { 2, 0.5 } }",
        // The egg's middle, and the curve between two points of a sor, are wider than the points.
        "ovus { 1.1, 0.7 rotate 20*x }",
        "ovus { 0.7, 0.9 }",
        "sor { 5, <0.3, -0.2>, <1, 0.3>, <0.5, 1>, <0.7, 2>, <0.3, 3> rotate <10, 20, 30> }",
        // Boxes that grow with each turn, and shapes that are measured anew.
        "quadric { <1, 2, 0.5>, 0, <0, 0.3, 0>, -1 }",
        "quadric { <-1, -2, -0.5>, 0, 0, 1 rotate <10, 20, 30> rotate <-40, 0, 5> translate x }",
        "quadric { <1, 0, 1>, 0, 0, -1 scale <1.1, 0.7, -2> }",
        "mesh { triangle { 0, <1.1, 0.3, 0>, <0.2, 1, 0.7> } rotate <10, 20, 30> rotate -40*x }",
        "sphere_sweep { b_spline 4, 0, 0.3, x, 0.4, x + y, 0.2, <0, 1, 1>, 0.5 rotate 20*x "
        "rotate 30*z }",
        "polygon { 4, <0, 0, 1>, <1, 0, 1.5>, <1, 1, 1.5>, <0, 0, 1> rotate <10, 20, 30> }",
        // Around components are balls, also of a cylinder; clips and bounds of its own come too
        // late.
        "blob { threshold 0.5 cylinder { x, <2, 1, 1>, 0.6, 1 } sphere { y, 1.1, 0.8 } }",
        "blob { threshold 0.5 sphere { x, 1.2, 1 } sphere { 0, 1.1, -1 } clipped_by { box { 0, 1 } "
        "} rotate 30*y }",
        "object { blob { threshold 0.5 sphere { x, 1.2, 1 } } clipped_by { box { 0, 1 } } }",
        "height_field { function 20, 20 { x*y } clipped_by { sphere { 0, 0.5 } } rotate 20*y }",
    };
    enum { COUNT = sizeof objects / sizeof *objects };
    char text[16384] = "", line[1024];
    for (size_t i = 0; i < COUNT; i++) {
        snprintf(line, sizeof line,
                 "#declare O = %s #write(Out, vstr(3, min_extent(O), \" \", 0, 9), \" \", "
                 "vstr(3, max_extent(O), \" \", 0, 9), \"\\n\")\n",
                 objects[i]);
        strcat(text, line);
    }
    strcat(text, "#fclose Out sphere { 0, 1 }\n");
    const char *expected = povray_output(text);
    if (!expected) {
        printf("skipped: povray is not here\n");
        skip();
    }
    for (size_t i = 0; i < COUNT; i++) {
        double want[6];
        int used = 0;
        if (sscanf(expected, "%lf %lf %lf %lf %lf %lf%n", &want[0], &want[1], &want[2], &want[3],
                   &want[4], &want[5], &used) != 6)
            fail_msg("povray says too little: %s", expected);
        expected += used;
        snprintf(line, sizeof line,
                 "#declare O = %s triangle { min_extent(O), max_extent(O), <9,8,7> }", objects[i]);
        Scene *s = scene_of(line);
        const Vec3 *p = root(s, 0)->shape.triangle.p;
        for (int k = 0; k < 6; k++) {
            double got = vec_get(p[k / 3], k % 3), size = 1 + fabs(want[k]);
            if (fabs(got - want[k]) > 2e-7 * size) // two steps of single precision
                fail_msg("%s: component %d is %.9g, povray has %.9g", objects[i], k, got, want[k]);
        }
    }
}

// ---- whole scenes ----------------------------------------------------------------------------

static void converts(const char *path) {
    if (access(path, R_OK) != 0) {
        printf("skipped: %s is not here\n", path);
        return;
    }
    Converted result = convert_file(path, NULL);
    if (!result.scene)
        fail_msg("%s", result.message);
    uint32_t patches = 0;
    for (uint32_t i = 0; i < result.scene->object_count; i++)
        patches += result.scene->objects[i].type == OBJECT_PATCH;
    assert_true(patches > 0);
}

static void distribution_scenes(void **state) {
    (void)state;
    converts("/usr/share/doc/povray/examples/objects/bezier.pov");
    converts("/usr/share/doc/povray/examples/objects/primitiv.pov");
    converts("/usr/share/doc/povray/examples/advanced/teapot/teapot.pov");
}

static void corpus_converts(const char *name) {
    char path[256]; // beside the project, or beside the folder of its worktrees
    snprintf(path, sizeof path, "../shared/corpus/%s", name);
    if (access(path, R_OK) != 0)
        snprintf(path, sizeof path, "../../shared/corpus/%s", name);
    converts(path);
}

static void corpus_scenes(void **state) {
    (void)state;
    corpus_converts("cephalopov/bicubicpatch_basic.pov");
    corpus_converts("dealii/cont243bic.pov");
    corpus_converts("postit/postit.pov");
    corpus_converts("eaglemode/Splitter.pov");
    corpus_converts("eaglemode/SplitterPressed.pov");
    corpus_converts("fmunoz/fruit_only.pov");
    corpus_converts("fmunoz/FMunoz_demo.pov");
    corpus_converts("easychair/easychair.pov");
    corpus_converts("gamesprites/GSprites_Terrain_demo.pov");
    corpus_converts("gamesprites/GSprites_Floors_demo.pov");
}

// Those that stand by themselves in POV-Ray; the others use names of colors.inc or shapes.inc.
static void standard_includes(void **state) {
    (void)state;
    static const char folder[] = "/usr/share/povray-3.7/include";
    static const char *const needy[] = {"shapes2.inc", "shapesq.inc",  "skies.inc",   "stage1.inc",
                                        "stdcam.inc",  "stoneold.inc", "stones.inc",  "stones1.inc",
                                        "stones2.inc", "textures.inc", "ttffonts.cat"};
    DIR *dir = opendir(folder);
    if (!dir) {
        printf("skipped: %s is not here\n", folder);
        skip();
    }
    for (struct dirent *entry; (entry = readdir(dir));) {
        const char *dot = strrchr(entry->d_name, '.');
        if (!dot || strcmp(dot, ".inc") != 0)
            continue;
        const char *first = "";
        for (size_t i = 0; i < sizeof needy / sizeof *needy; i++)
            if (strcmp(needy[i], entry->d_name) == 0)
                first = "#include \"colors.inc\"\n#include \"shapes.inc\"\n";
        char text[512];
        snprintf(text, sizeof text, "%s#include \"%s\"\n", first, entry->d_name);
        Converted result = convert_text(text);
        if (!result.scene)
            fail_msg("%s", result.message);
    }
    closedir(dir);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_keeps_its_numbers),
        cmocka_unit_test(plane_moves_with_its_points),
        cmocka_unit_test(other_shapes),
        cmocka_unit_test(odd_numbers),
        cmocka_unit_test(transform_blocks),
        cmocka_unit_test(names_stand_for_objects),
        cmocka_unit_test(trees_are_copied_when_changed),
        cmocka_unit_test(inverse_objects),
        cmocka_unit_test(patch_fields),
        cmocka_unit_test(patch_points_of_all_kinds),
        cmocka_unit_test(patch_errors),
        cmocka_unit_test(patch_bounds),
        cmocka_unit_test(trees_and_clips),
        cmocka_unit_test(unions_pass_on),
        cmocka_unit_test(unions_share_an_interior),
        cmocka_unit_test(uv_flag),
        cmocka_unit_test(lights_leave_their_unions),
        cmocka_unit_test(gaps_are_said_when_used),
        cmocka_unit_test(empty_scenes),
        cmocka_unit_test(extents_are_those_of_povray),
        cmocka_unit_test(distribution_scenes),
        cmocka_unit_test(corpus_scenes),
        cmocka_unit_test(standard_includes),
    };
    return cmocka_run_group_tests_name("convert", tests, NULL, NULL);
}
