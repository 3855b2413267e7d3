// SPDX-License-Identifier: MIT
// Pigments, finishes and textures of the language as they arrive in the scene: what an edit keeps,
// layers, maps, transforms, defaults. Truth is the facts about POV-Ray and mathematics.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/diag.h"
#include "convert_help.h"

#include <stdio.h>
#include <string.h>

// The top pigment of sphere { 0, 1 <text> } (after <before>).
static Pigment pigment(const char *before, const char *text) {
    char all[2048];
    snprintf(all, sizeof all, "%s sphere { 0, 1 %s }", before, text);
    Scene *s = scene_of(all);
    return *pigment_of(s, root(s, 0), 0);
}

static Finish finish(const char *text) {
    char all[1024];
    snprintf(all, sizeof all, "sphere { 0, 1 finish { %s } }", text);
    Scene *s = scene_of(all);
    return texture_of(s, root(s, 0))->layers[0].finish;
}

static void checker_lists(void **state) {
    (void)state;
    Pigment p = pigment("", "pigment { checker }");
    assert_int_equal(p.pattern.type, PATTERN_CHECKER);
    assert_near(p.pattern.frequency, 0);
    assert_int_equal(p.entry_count, 2);
    assert_color(p.entries[0].color, 0, 0, 1, 0, 0);
    assert_color(p.entries[1].color, 0, 1, 0, 0, 0);
    p = pigment("", "pigment { checker color rgb <1,0,0> }");
    assert_color(p.entries[0].color, 1, 0, 0, 0, 0);
    assert_color(p.entries[1].color, 0, 1, 0, 0, 0);
    p = pigment("#declare Red = rgb x;", "pigment { checker Red, rgbt <1,1,1,0.5> scale 2 }");
    assert_color(p.entries[0].color, 1, 0, 0, 0, 0);
    assert_color(p.entries[1].color, 1, 1, 1, 0, 0.5);
    assert_near(p.pattern.warps[0].transform.m[2][2], 2);
    p = pigment("", "pigment { checker 1, <0,0.5,1> }"); // width 5: filter and transmit too
    assert_color(p.entries[0].color, 1, 1, 1, 1, 1);
    assert_color(p.entries[1].color, 0, 0.5, 1, 0, 0);
    Scene *s = scene_of("sphere { 0, 1 pigment { checker pigment { rgb x } pigment { gradient y } "
                        "frequency 3 } }");
    const Pigment *list = pigment_of(s, root(s, 0), 0);
    assert_color(s->pigments[list->entries[0].pigment].color, 1, 0, 0, 0, 0);
    assert_int_equal(s->pigments[list->entries[1].pigment].pattern.type, PATTERN_GRADIENT);
    assert_near(list->pattern.frequency, 3);
    assert_dies("sphere { 0, 1 pigment { checker color_map { [0 rgb 1] } } }",
                "'color_map' cannot be used with 'checker'");
    assert_dies("sphere { 0, 1 pigment { checker rgb <1,1,1> <0,0,0> } }", "error"); // T4
}

static void color_maps(void **state) {
    (void)state;
    const char *before = "#declare Red = rgb x; #declare M = color_map { [0 rgb 0][1 Red] };";
    Pigment p = pigment("", "pigment { gradient y }");
    assert_int_equal(p.entry_count, 2);
    assert_color(p.entries[1].color, 1, 1, 1, 0, 0);
    p = pigment(before, "pigment { gradient <0,2,0> color_map { M } }");
    assert_color(p.entries[1].color, 1, 0, 0, 0, 0);
    assert_vec(p.pattern.gradient, 0, 1, 0);
    p = pigment(before, "pigment { gradient x colour_map { [0.0, 0.25 color Red color rgbt 0.5]"
                        "[0.25 1 color red 1 green 0.5, color Red] [1, Red*0.5] [1 1-Red] } }");
    assert_int_equal(p.entry_count, 6);
    assert_color(p.entries[1].color, 0.5, 0.5, 0.5, 0, 0.5);
    assert_near(p.entries[1].value, 0.25);
    assert_color(p.entries[2].color, 1, 0.5, 0, 0, 0);
    assert_color(p.entries[4].color, 0.5, 0, 0, 0, 0);
    assert_color(p.entries[5].color, 0, 1, 1, 1, 1); // T6
    assert_dies("sphere { 0, 1 pigment { gradient x color_map { [0 <1,0,0>] [1 rgb 1] } } }",
                "2:51: error: Expected a colour"); // T41
    assert_dies("sphere { 0, 1 pigment { gradient x color_map { [0 rgb 1, ] } } }", "']'");
    assert_dies("sphere { 0, 1 pigment { <1,0,0> } }", "error");
}

static void waves_and_numbers(void **state) {
    (void)state;
    Pigment p = pigment("", "pigment { gradient x frequency 2 phase 0.5 poly_wave 3 }");
    assert_near(p.pattern.frequency, 2);
    assert_near(p.pattern.phase, 0.5);
    assert_int_equal(p.pattern.wave, WAVE_POLY);
    assert_near(p.pattern.exponent, 3);
    static const char *const names[] = {"ramp", "triangle", "sine", "scallop", "cubic", "poly"};
    for (int i = 0; i < 6; i++) {
        char text[64];
        snprintf(text, sizeof text, "pigment { gradient x %s_wave }", names[i]);
        assert_int_equal(pigment("", text).pattern.wave, i);
    }
    p = pigment("", "pigment { gradient x quick_color rgb <1,2,3> }");
    assert_true(p.has_quick_color);
    assert_color(p.quick_color, 1, 2, 3, 0, 0);
    assert_false(pigment("", "pigment { gradient x quick_color rgb -1 }").has_quick_color);
}

// A pattern keyword changes the kind; maps, waves and transforms of the base stay.
static void edits_keep_the_rest(void **state) {
    (void)state;
    const char *before = "#declare T = texture { pigment { wood color_map { [0 rgb x][1 rgb y] } "
                         "scale 4 } finish { ambient 1 } }";
    Pigment p = pigment(before, "texture { T pigment { gradient y } }");
    assert_int_equal(p.pattern.type, PATTERN_GRADIENT);
    assert_color(p.entries[0].color, 1, 0, 0, 0, 0);
    assert_near(p.pattern.warps[0].transform.m[0][0], 4);
    assert_int_equal(p.pattern.wave, WAVE_TRIANGLE);
    p = pigment("", "texture { scale 4 pigment { gradient y } }");
    assert_near(p.pattern.warps[0].transform.m[0][0], 4);
    p = pigment("", "pigment { checker rgb x rgb y } pigment { gradient z }");
    assert_near(p.pattern.frequency, 0);
    assert_color(p.entries[0].color, 1, 0, 0, 0, 0);
    Scene *s = scene_of("#declare T = texture { pigment { rgb x } finish { ambient 0.75 } }\n"
                        "#declare P = pigment { rgb y }\n"
                        "sphere { 0, 1 texture { T P finish { diffuse 0.25 } } }");
    assert_color(pigment_of(s, root(s, 0), 0)->color, 0, 1, 0, 0, 0);
    assert_near(texture_of(s, root(s, 0))->layers[0].finish.ambient.r, 0.75);
    assert_near(texture_of(s, root(s, 0))->layers[0].finish.diffuse, 0.25);
}

static void transforms_reach_what_is_there(void **state) {
    (void)state;
    Pigment p = pigment("", "pigment { gradient x translate y } translate x scale 2");
    assert_int_equal(p.pattern.warp_count, 1); // neighbours are one
    assert_vec(transform_point(&p.pattern.warps[0].transform, vec3(0, 0, 0)), 2, 2, 0);
    p = pigment("", "translate x pigment { gradient x }"); // T35
    assert_int_equal(p.pattern.warp_count, 0);
    Scene *s = scene_of("union { sphere { 0, 1 pigment { gradient x } translate x } "
                        "sphere { 0, 1 translate y } pigment { gradient y } translate z }");
    const Pigment *a = pigment_of(s, child(s, root(s, 0), 0), 0);
    const Pigment *b = pigment_of(s, child(s, root(s, 0), 1), 0);
    assert_vec(transform_point(&a->pattern.warps[0].transform, vec3(0, 0, 0)), 1, 0, 1);
    assert_vec(transform_point(&b->pattern.warps[0].transform, vec3(0, 0, 0)), 0, 0, 1);
}

static void layers(void **state) {
    (void)state;
    Scene *s = scene_of("#declare X = sphere { 0, 1 texture { pigment { rgb y } } }" // T32
                        "object { X texture { pigment { rgbt <1,0,0,.5> } } } object { X }");
    assert_int_equal(texture_of(s, root(s, 0))->layer_count, 2);
    assert_color(pigment_of(s, root(s, 0), 0)->color, 1, 0, 0, 0, 0.5); // the top one first
    assert_color(pigment_of(s, root(s, 0), 1)->color, 0, 1, 0, 0, 0);
    assert_int_equal(texture_of(s, root(s, 1))->layer_count, 1);
    s = scene_of(
        "#declare T = texture { pigment { rgb x } } texture { pigment { rgbt <0,1,0,.25> } }"
        "\nsphere { 0, 1 texture { T } pigment { rgb z } }"); // T36
    assert_int_equal(texture_of(s, root(s, 0))->layer_count, 2);
    assert_color(pigment_of(s, root(s, 0), 0)->color, 0, 0, 1, 0, 0); // edits the top layer
    assert_color(pigment_of(s, root(s, 0), 1)->color, 1, 0, 0, 0, 0);
    assert_dies("sphere { 0, 1 texture { gradient x texture_map { [0 pigment { rgb 1 }] } } "
                "texture { pigment { rgb 1 } } }",
                "2:76: error: a patterned texture");
    // Up to 3.1 filter becomes transmit above the bottom layer.
    Converted old = convert_raw("#version 3.1; sphere { 0, 1 texture { pigment { rgbf .5 } } "
                                "texture { pigment { gradient x color_map { [0 rgbf .25][1 rgb 0] "
                                "} } } }");
    const Object *o = root(old.scene, 0);
    assert_color(pigment_of(old.scene, o, 0)->entries[0].color, .25, .25, .25, 0, .25);
    assert_color(pigment_of(old.scene, o, 1)->color, .5, .5, .5, .5, 0);
}

static void defaults(void **state) {
    (void)state;
    Scene *s =
        scene_of("#declare S = sphere { 0, 1 }\n"
                 "#declare F = sphere { 0, 1 finish { ambient 1 } }\n" // took the old default
                 "#default { pigment { rgb <1,0,0> } }\n"
                 "object { S } object { F } sphere { 0, 1 pigment { gradient x } }\n"
                 "#default { texture { pigment { rgb y } finish { phong 1 } } }\n"
                 "sphere { 0, 1 texture { } }"); // T34
    assert_color(pigment_of(s, root(s, 0), 0)->color, 1, 0, 0, 0, 0);
    assert_color(pigment_of(s, root(s, 1), 0)->color, 0, 0, 0, 0, 0);
    assert_int_equal(pigment_of(s, root(s, 2), 0)->pattern.type, PATTERN_GRADIENT);
    assert_color(pigment_of(s, root(s, 3), 0)->color, 0, 1, 0, 0, 0);
    assert_near(texture_of(s, root(s, 3))->layers[0].finish.phong, 1);
    assert_dies("#default { texture { checker texture { } } }", "must be plain");
    // The default of a statement is that of its end.
    s = scene_of("union { sphere { 0, 1 } #default { pigment { rgb z } } sphere { x, 1 } }");
    assert_color(pigment_of(s, child(s, root(s, 0), 0), 0)->color, 0, 0, 1, 0, 0);
}

static void finishes(void **state) {
    (void)state;
    Finish f = finish("ambient rgb <1,2,3> diffuse 0.5, 0.25 metallic crand 0.125 emission 2");
    assert_near(f.ambient.g, 2);
    assert_near(f.diffuse_back, 0.25);
    assert_near(f.metallic, 1);
    assert_near(f.emission.b, 2);
    f = finish("phong albedo 0.5 phong_size 3 diffuse albedo 0.5 brilliance 2");
    assert_near(f.phong, 0.5 * (3 + 1) / 2);
    assert_near(f.diffuse, 0.5 * (2 + 1) / 2);
    f = finish("specular albedo 0.5 roughness 0.5");
    assert_near(f.specular, (float)(0.5 * 4 / (4 * (2 - 0.5)))); // n = 2
    f = finish("reflection 0.5");
    assert_near(f.reflection_min.r, 0.5);
    assert_near(f.reflection_max.r, 0.5);
    f = finish("reflection { 0.25, 0.75 falloff 3 exponent 2 metallic } conserve_energy");
    assert_near(f.reflection_min.r, 0.25);
    assert_near(f.reflection_max.r, 0.75);
    assert_near(f.reflection_falloff, 3);
    assert_near(f.reflection_exponent, 2);
    assert_near(f.reflection_metallic, 1);
    assert_true(f.conserve_energy);
    f = finish("reflection { rgb 1 fresnel on }");
    assert_near(f.reflection_min.r, 0);
    assert_near(f.reflection_max.r, 1);
    assert_true(f.reflection_fresnel);
    f = finish("irid { 0.5 thickness 0.25 turbulence 1 } reflection_exponent 3");
    assert_near(f.irid, 0.5);
    assert_near(f.irid_thickness, 0.25);
    assert_warns("sphere { 0, 1 finish { subsurface { translucency 1 } } }", "subsurface is not");
}

static void materials(void **state) {
    (void)state;
    Scene *s = scene_of(
        "#declare M = material { texture { pigment { rgb x } } interior { ior 1.5 } }\n"
        "sphere { 0, 1 material { M } } sphere { 0, 1 material { M texture { pigment { rgbt 1 } } "
        "interior_texture { pigment { rgb y } } } }");
    assert_color(pigment_of(s, root(s, 0), 0)->color, 1, 0, 0, 0, 0);
    assert_near(s->interiors[root(s, 0)->interior].ior, 1.5);
    assert_int_equal(texture_of(s, root(s, 1))->layer_count, 2);
    const Texture *inner = &s->textures[root(s, 1)->interior_texture];
    assert_color(s->pigments[inner->layers[0].pigment].color, 0, 1, 0, 0, 0);
    assert_int_not_equal(root(s, 0)->interior, root(s, 1)->interior);
    assert_dies("sphere { 0, 1 interior_texture { pigment { rgb 1 } } }", "needs a texture");
}

static void middle_colors(void **state) {
    (void)state;
    Pigment p = pigment("", "pigment { tiling 1 color_map { [0 rgb 0][1 rgb <1,0.5,0>] } }");
    assert_int_equal(p.pattern.type, PATTERN_PLAIN);
    assert_color(p.color, 0.5, 0.25, 0, 0, 0);
    p = pigment("", "pigment { tiling 2 color_map { [0.25 rgb 0][0.75 rgbt 1] } }");
    assert_color(p.color, 0.5, 0.5, 0.5, 0, 0.5);
    p = pigment("",
                "pigment { tiling 4 pigment_map { [0 rgb x][0.5 checker rgb y rgb z][1 rgb 0] }}");
    assert_color(p.color, 0, 0.5, 0.5, 0, 0);
    p = pigment("", "texture { tiling 3 texture_map { [0 pigment { rgb x }][1 pigment { rgb y }] "
                    "} }");
    assert_color(p.color, 0, 1, 0, 0, 0);
    assert_warns("sphere { 0, 1 pigment { tiling 3 } }", "the pattern 'tiling' is not modelled");
    // It was read and ignored without a word.
    assert_warns(
        "sphere { 0, 1 pigment { image_map { png \"scenes/uv/uv.png\" premultiplied on } } }",
        "premultiplied is not modelled");
    assert_warns("sphere { 0, 1 texture { tiling 1 texture_map { [0 pigment { rgb 1 }] } } }",
                 "a texture with 'tiling'");
    assert_warns("sphere { 0, 1 pigment { rgb 1 } normal { tiling 3 } }", "a normal with 'tiling'");
    assert_silent("sphere { 0, 1 pigment { rgb 1 } normal { bumps 0.5 } }");
}

// What belongs to single patterns; each keyword brings its defaults along.
// What normals have besides their pattern, and where no_bump_scale comes from.
static void normal_members(void **state) {
    (void)state;
    const Scene *s = scene_of(
        "sphere { 0, 1 pigment { rgb 1 } normal { granite 0.3 accuracy 0.01 slope_map { [0 <1,2>] "
        "[0.5 <3,4>] } } } sphere { 3, 1 texture { pigment { rgb 1 } normal { average normal_map { "
        "[2 facets size 0.5 metric 3 coords 0.25] [bumps bump_size 0.7 no_bump_scale] } } "
        "no_bump_scale } } sphere { 6, 1 pigment { rgb 1 } normal { uv_mapping checker 0.4 } }");
    const Normal *granite = &s->normals[0], *facets = &s->normals[1], *average = &s->normals[3];
    assert_int_equal(s->normal_count, 5);
    assert_near(granite->amount, 0.3f);
    assert_near(granite->accuracy, 0.01f);
    assert_int_equal(granite->slope_count, 2);
    assert_near(granite->slopes[1].value, 0.5);
    assert_near(granite->slopes[1].height, 3);
    assert_near(granite->slopes[1].slope, 4);
    assert_false(granite->no_bump_scale || granite->uv_mapping);
    assert_near(facets->pattern.facets.size, 0.5);
    assert_near(facets->pattern.facets.metric, 3);
    assert_near(facets->pattern.facets.coords, 0.25);
    assert_int_equal(s->normals[2].pattern.type, PATTERN_BUMPS);
    assert_near(s->normals[2].amount, 0.7f);
    assert_int_equal(average->pattern.type, PATTERN_AVERAGE);
    assert_near(average->entries[0].value, 2);
    assert_near(average->entries[1].value, 1);
    assert_int_equal(average->entries[1].index, 2);
    assert_true(average->no_bump_scale && facets->no_bump_scale);
    assert_true(s->normals[4].uv_mapping && s->normals[4].entry_count == 0);
    assert_int_equal(s->textures[1].layers[0].normal, 3);

    // One normal, used with and without the flag, is two.
    s = scene_of(
        "#declare N = normal { bumps } #declare T = texture { pigment { rgb 1 } normal { N "
        "} } sphere { 0, 1 texture { checker texture { T } texture { T } no_bump_scale } "
        "} sphere { 3, 1 texture { T } }");
    assert_int_equal(s->normal_count, 2);
    assert_int_equal(s->texture_count, 3);
    assert_true(s->normals[0].no_bump_scale && !s->normals[1].no_bump_scale);
}

static void patterned_textures(void **state) {
    (void)state;
    const Scene *s = scene_of(
        "sphere { 0, 1 texture { tiles { texture { pigment { rgb x } } tile2 texture { pigment { "
        "rgb y } } } scale 2 } } sphere { 3, 1 texture { uv_mapping gradient x texture_map { [0.25 "
        "pigment { rgb x }] [1 pigment { rgb z }] } } }");
    const Texture *tiles = &s->textures[2], *map = &s->textures[4], *uv = &s->textures[5];
    assert_int_equal(s->texture_count, 6);
    assert_int_equal(tiles->pattern.type, PATTERN_CHECKER);
    assert_near(s->pigments[s->textures[tiles->entries[1].index].layers[0].pigment].color.r, 1);
    assert_int_equal(tiles->pattern.warp_count, 1);
    assert_int_equal(map->pattern.type, PATTERN_GRADIENT);
    assert_near(map->entries[0].value, 0.25);
    assert_true(uv->uv_mapping && uv->entry_count == 1 && uv->entries[0].index == 4);
}

static void pattern_members(void **state) {
    (void)state;
    Pattern p = pigment("", "pigment { brick brick_size <1,2,3> mortar 0.25 }").pattern;
    assert_vec(p.brick_size, 1, 2, 3);
    assert_near(p.mortar, 0.25);
    p = pigment("#declare B = pigment { brick mortar 0.25 }", "pigment { B brick }").pattern;
    assert_near(p.mortar, 0.25); // the same keyword again leaves it, as in POV-Ray
    p = pigment("#declare B = pigment { brick mortar 0.25 } #declare C = pigment { B onion }",
                "pigment { C brick }")
            .pattern;
    assert_near(p.mortar, 0.5);
    p = pigment("#declare B = pigment { brick mortar 0.25 }", "pigment { B scale 2 }").pattern;
    assert_near(p.mortar, 0.25);
    p = pigment("", "pigment { quilted control0 0.5 control1 2 }").pattern;
    assert_near(p.quilted[0], 0.5);
    assert_near(p.quilted[1], 2);
    assert_near(p.frequency, 0);
    p = pigment("", "pigment { crackle form <1,2,3> metric 3 offset 0.5 solid }").pattern;
    assert_vec(p.crackle.form, 1, 2, 3);
    assert_near(p.crackle.metric, 3);
    assert_near(p.crackle.offset, 0.5);
    assert_true(p.crackle.solid);
    p = pigment("", "pigment { spiral2 7 }").pattern;
    assert_int_equal(p.arms, 7);
    assert_int_equal(p.wave, WAVE_TRIANGLE);
    p = pigment("", "pigment { bozo noise_generator 1 noise_generator 2 }").pattern;
    assert_int_equal(p.noise_generator, 3);
    p = pigment("", "pigment { agate agate_turb 0.75 }").pattern;
    assert_near(p.agate_turb, 0.75);
    assert_true(p.has_turbulence);
    assert_int_equal(p.turbulence.octaves, 6);
    Scene *s = scene_of("sphere { 0, 1 pigment { average pigment_map { [2 rgb x][bozo] } } }");
    const Pigment *average = pigment_of(s, root(s, 0), 0);
    assert_int_equal(average->pattern.type, PATTERN_AVERAGE);
    assert_near(average->entries[0].value, 2);
    assert_near(average->entries[1].value, 1);
    assert_dies("sphere { 0, 1 pigment { bozo noise_generator 4 } }", "0, 1, 2 or 3");
}

// The pattern's own turbulence is one value; the warps are kept the last one first.
static void warps(void **state) {
    (void)state;
    Pattern p = pigment("#declare M = pigment { marble turbulence 0.5 octaves 20 omega 0.25 }",
                        "pigment { M lambda 3 scale 2 turbulence <1,2,3> }")
                    .pattern;
    assert_int_equal(p.warp_count, 1);
    assert_true(p.has_turbulence);
    assert_vec(p.turbulence.amount, 1, 2, 3);
    assert_int_equal(p.turbulence.octaves, 10);
    assert_near(p.turbulence.omega, 0.25);
    assert_near(p.turbulence.lambda, 3);
    assert_false(pigment("", "pigment { bozo octaves 3 }").pattern.has_turbulence);
    p = pigment("", "pigment { bozo scale 2 rotate 30*y warp { repeat 2*y offset x flip <0,3,1> } "
                    "warp { turbulence z octaves 2 } translate x warp { cubic } }")
            .pattern;
    assert_int_equal(p.warp_count, 5);
    static const WarpType order[] = {WARP_CUBIC, WARP_TRANSFORM, WARP_TURBULENCE, WARP_REPEAT,
                                     WARP_TRANSFORM};
    for (int i = 0; i < 5; i++)
        assert_int_equal(p.warps[i].type, order[i]);
    assert_vec(p.warps[2].turbulence.amount, 0, 0, 1);
    assert_int_equal(p.warps[2].turbulence.octaves, 2);
    assert_int_equal(p.warps[3].repeat.axis, 1);
    assert_near(p.warps[3].repeat.width, 2);
    assert_vec(p.warps[3].repeat.offset, 1, 0, 0);
    assert_vec(p.warps[3].repeat.flip, 1, -1, -1);
    p = pigment("", "pigment { bozo warp { black_hole <0,1,0>, 0.5 strength 2 falloff 3 inverse "
                    "repeat <4,0,1> turbulence <1,1,0.25> } warp { black_hole 0, 1 type 2 } "
                    "warp { planar 2*y, 3 } warp { toroidal orientation x dist_exp 2 "
                    "major_radius 0.5 } }")
            .pattern;
    assert_int_equal(p.warp_count, 3); // the hole of type 2 does nothing
    assert_vec(p.warps[0].mapping.orientation, 1, 0, 0);
    assert_near(p.warps[0].mapping.dist_exp, 2);
    assert_near(p.warps[0].mapping.major_radius, 0.5);
    assert_vec(p.warps[1].mapping.orientation, 0, 1, 0);
    assert_near(p.warps[1].mapping.distance, 3);
    const BlackHoleWarp *hole = &p.warps[2].black_hole;
    assert_vec(hole->center, 0.5, 1, 0.5);     // inside its block
    assert_vec(hole->repeat_size, 4, 0, 1.25); // with room for the shaking
    assert_near(hole->falloff, 3);
    assert_true(hole->inverse && hole->repeat);
    assert_dies("sphere { 0, 1 pigment { bozo warp { repeat <1,1,0> } } }", "one axis only");
    assert_dies("sphere { 0, 1 pigment { bozo warp { repeat 0 } } }", "axis");
    assert_dies("sphere { 0, 1 pigment { bozo warp { scale 2 } } }", "kind of warp");
}

static void missing_patterns(void **state) {
    (void)state;
    assert_dies("sphere { 0, 1 normal { scale 2 } }", "a normal needs a pattern");
    assert_dies("sphere { 0, 1 texture { gradient x } }", "needs a texture_map");
    assert_silent("sphere { 0, 1 pigment { scale 2 } texture { } }");
    assert_dies("sphere { 0, 1 pigment { scale 2 gradient x } }", "2:33: error");
}

static void equal_textures_are_one(void **state) {
    (void)state;
    Scene *s = scene_of("#declare T = texture { pigment { checker rgb x rgb y } }\n"
                        "#declare I = 0; #while (I < 20)\n"
                        "sphere { 0, 1 texture { T } scale 2 } #declare I = I + 1; #end\n"
                        "sphere { 0, 1 pigment { checker rgb x rgb y scale 2 } }\n"
                        "sphere { 0, 1 texture { T } }");
    assert_int_equal(s->texture_count, 2);
    assert_int_equal(s->pigment_count, 2);
}

// Every pattern with arguments in every kind of block where it may stand.
static void all_patterns_are_read(void **state) {
    (void)state;
    static const char *const patterns[] = {
        "agate agate_turb 1",
        "aoi",
        "average",
        "boxed",
        "bozo",
        "brick",
        "bumps",
        "cells",
        "checker",
        "crackle form <1,0,0> metric 3 offset 0 solid",
        "cubic",
        "cylindrical",
        "density_file df3 \"a.df3\" interpolate 1",
        "dents",
        "function { x*y }",
        "function { pattern { bozo turbulence 1 } }",
        "gradient x",
        "granite",
        "hexagon",
        "image_pattern { png \"a.png\" use_alpha interpolate 2 }",
        "image_pattern { function 10, 10 { x } }",
        "julia <0.3, 0.2>, 20 exponent 3 interior 1, 2 exterior 2, 3",
        "leopard",
        "magnet 1 mandel 20",
        "magnet 2 julia <1,2> 20",
        "mandel 20",
        "marble turbulence 1 octaves 3 omega 0.5 lambda 2",
        "object { sphere { 0, 1 } }",
        "onion",
        "pavement number_of_sides 4 number_of_tiles 3 pattern 2 form 1 interior 2 exterior 1",
        "pigment_pattern { checker rgb 0 rgb 1 }",
        "planar",
        "quilted control0 1 control1 0",
        "radial frequency 4",
        "ripples",
        "slope y",
        "slope { y, 0.5, 1 altitude y, 0, 1 }",
        "slope { point_at y }",
        "spherical",
        "spiral1 3",
        "spiral2 3",
        "spotted",
        "square",
        "tiling 3",
        "triangular",
        "waves",
        "wood noise_generator 2",
        "wrinkles",
        "uv_mapping checker",
        "gradient x warp { black_hole <0,0,0>, 1 falloff 2 strength 3 inverse type 0 repeat 2 "
        "turbulence 1 }",
        "gradient x warp { repeat x flip y offset z } warp { cylindrical orientation y dist_exp 1 }"
        " warp { toroidal major_radius 2 } warp { planar y, 1 } warp { planar } warp { cubic } "
        "warp { spherical } warp { turbulence 1 octaves 2 lambda 2 omega 1 }",
    };
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        char text[2048];
        bool map = strncmp(patterns[i], "average", 7) == 0;
        snprintf(text, sizeof text,
                 "#declare P = pigment { %s %s }; #declare D = density { %s %s };\n"
                 "#declare N = normal { %s 0.5 %s scale 2 bump_size 1 accuracy 0.01 }\n"
                 "sphere { 0, 1 pigment { P } normal { N } }",
                 patterns[i], map ? "pigment_map { [1 rgb 1][2 P_0] }" : "", patterns[i],
                 map ? "density_map { [1 rgb 1] }" : "", map ? patterns[i] : "bozo",
                 map ? "normal_map { [bumps 1] }" : "slope_map { [0 <0,1>][1 <1,0>] }");
        char declared[2200];
        snprintf(declared, sizeof declared, "#declare P_0 = pigment { rgb 1 }\n%s", text);
        scene_of(declared);
    }
    scene_of("sphere { 0, 1 normal { checker 0.5 normal { bumps } normal { dents 2 } } }"
             "sphere { 0, 1 normal { bump_map { png \"a.png\" map_type 1 } bump_size 3 } }"
             "sphere { 0, 1 normal { facets coords 1 size 0.5 } }"
             "sphere { 0, 1 normal { gradient x, 0.5 sine_wave } }"
             "sphere { 0, 1 texture { tiles { texture { pigment { rgb 1 } } tile2 texture { } } } }"
             "sphere { 0, 1 texture { material_map { png \"a.png\" texture { } texture { } } } }"
             "sphere { 0, 1 texture { checker texture { } texture { pigment { rgb 1 } } } }"
             "sphere { 0, 1 pigment { object { box { 0, 1 } color rgb x color rgb y } } }"
             "sphere { 0, 1 pigment { image_map { png \"a.png\" gamma 2 once filter all 0.5 "
             "transmit all 0.5 repeat <1,2> offset <1,2> } } }");
}

static void write_bytes(const char *path, const void *bytes, size_t count) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, count, file), count);
    assert_int_equal(fclose(file), 0);
}

#define IMAGE(text) "sphere { 0, 1 pigment { image_map { " text " } } }"

// Single colours are made clear in palettes only. Before, `filter 1, 0.5` of a picture without one
// was accepted, and ended the render instead; a TGA's palette was none.
static void palettes(void **state) {
    (void)state;
    // 1 x 1 pixel: two colours and the place 1, blue as itself, and two colours by GIF's codes.
    static const unsigned char mapped[] = {0, 1, 1, 0, 0, 2, 0,  24, 0, 0, 0, 0, 1,
                                           0, 1, 0, 8, 0, 0, 10, 20, 9, 9, 9, 1};
    static const unsigned char plain[] = {0, 0, 2, 0, 0, 0,  0, 0,   0, 0, 0,
                                          0, 1, 0, 1, 0, 24, 0, 255, 0, 0};
    static const unsigned char gif[] = {'G', 'I', 'F', '8', '7', 'a', 1, 0,    1, 0, 0x80, 0,
                                        0,   0,   0,   0,   9,   9,   9, ',',  0, 0, 0,    0,
                                        1,   0,   1,   0,   0,   2,   2, 0x4c, 1, 0, ';'};
    write_bytes("build/test/mapped.tga", mapped, sizeof mapped);
    write_bytes("build/test/plain.tga", plain, sizeof plain);
    write_bytes("build/test/two.gif", gif, sizeof gif);
    assert_dies(IMAGE("tga \"build/test/plain.tga\" filter 0, 0.5"),
                "Keyword 'filter' cannot be used with non color-mapped image");
    assert_dies(IMAGE("tga \"build/test/plain.tga\" transmit nothing"),
                "Keyword 'transmit' cannot be used with non color-mapped image");
    assert_dies(IMAGE("function 2, 2 { x } filter 0, 0.5"), "non color-mapped image");
    scene_of(IMAGE("tga \"build/test/plain.tga\" filter all 0.5"));
    assert_dies(IMAGE("tga \"build/test/mapped.tga\" filter 2, 0.5"),
                "FILTER color register value out of range: the palette has 2 colors");
    assert_warns(IMAGE("tga \"build/test/mapped.tga\" filter 1, 0.5"), "color 1 of this picture");
    assert_dies(IMAGE("gif \"build/test/two.gif\" transmit 1.99, 0.5"),
                "TRANSMIT color register value out of range");
    assert_silent(IMAGE("gif \"build/test/two.gif\" transmit 1.98, 0.5 filter -1 0.5"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(checker_lists),
        cmocka_unit_test(color_maps),
        cmocka_unit_test(waves_and_numbers),
        cmocka_unit_test(edits_keep_the_rest),
        cmocka_unit_test(transforms_reach_what_is_there),
        cmocka_unit_test(layers),
        cmocka_unit_test(defaults),
        cmocka_unit_test(finishes),
        cmocka_unit_test(materials),
        cmocka_unit_test(middle_colors),
        cmocka_unit_test(normal_members),
        cmocka_unit_test(patterned_textures),
        cmocka_unit_test(pattern_members),
        cmocka_unit_test(warps),
        cmocka_unit_test(missing_patterns),
        cmocka_unit_test(equal_textures_are_one),
        cmocka_unit_test(all_patterns_are_read),
        cmocka_unit_test(palettes),
    };
    return cmocka_run_group_tests_name("convert_texture", tests, NULL, NULL);
}
