// SPDX-License-Identifier: MIT
// Cameras, settings, sky, versions, and objects that are read but not modelled. Truth is the facts
// about POV-Ray and plain geometry.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/diag.h"
#include "convert_help.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static Camera camera(const char *items) {
    char text[1024];
    snprintf(text, sizeof text, "camera { %s } sphere { 0, 1 }", items);
    return scene_of(text)->camera;
}

// As scene_of, of the text as it is.
static const Scene *scene_of_raw(const char *text) {
    Converted result = convert_raw(text);
    if (!result.scene)
        fail_msg("%s", result.message);
    return result.scene;
}

static Camera old_camera(const char *items) {
    char text[1024];
    snprintf(text, sizeof text, "#version 3.1; camera { %s } sphere { 0, 1 }", items);
    return scene_of_raw(text)->camera;
}

static void camera_defaults(void **state) {
    (void)state;
    Camera c = camera("");
    assert_vec(c.right, 1.33, 0, 0);
    assert_vec(c.up, 0, 1, 0);
    assert_vec(c.direction, 0, 0, 1);
    assert_int_equal(c.type, CAMERA_PERSPECTIVE);
}

static void camera_looks_at(void **state) {
    (void)state;
    // The order of writing has no part in it.
    const char *orders[] = {"location <3,0,4> look_at 0 right 2*x angle 90",
                            "angle 90 look_at 0 right 2*x location <3,0,4>"};
    for (int i = 0; i < 2; i++) {
        Camera c = camera(orders[i]);
        assert_vec(c.direction, -0.6, 0, -0.8); // |right| / (2 tan 45) = 1
        assert_vec(c.right, -1.6, 0, 1.2);
        assert_vec(c.up, 0, 1, 0);
    }
    Camera c = camera("location -2*z look_at 0 right -x*1.5"); // right-handed
    assert_vec(c.right, -1.5, 0, 0);
    c = camera("location <0,-5,0> direction y up z right -x sky z look_at 0");
    assert_vec(c.direction, 0, 1, 0);
    assert_vec(c.up, 0, 0, 1);
    // up x direction . right = (z x y) . -x = 1 > 0: the side of sky x direction = z x y = -x.
    assert_vec(c.right, -1, 0, 0);
    c = camera("location <0,-5,0> direction y up z right x sky z look_at 0");
    assert_vec(c.right, 1, 0, 0);                       // -(-x)
    c = camera("location <0,5,0> right 2*x look_at 0"); // along the sky
    assert_vec(c.right, 2, 0, 0);
    assert_warns("camera { location y look_at 0 } sphere { 0, 1 }", "sky vector");
    assert_dies("camera { location y look_at y }", "same point");
    assert_dies("camera { angle 180 }", "less than 180");
    assert_dies("camera { angle -1 }", "negative");
}

static void camera_transforms_come_last(void **state) {
    (void)state;
    Camera c = camera("rotate 90*y location -5*z look_at 0 translate x"); // T39
    assert_vec(c.location, -4, 0, 0);
    assert_vec(c.direction, 1, 0, 0);
    assert_vec(c.right, 0, 0, -1.33);
    Scene *s = scene_of("#declare C = camera { location -5*z look_at 0 }\n"
                        "camera { C translate y rotate 90*x } sphere { 0, 1 }");
    assert_vec(s->camera.location, 0, 5, 1);
    assert_dies("#declare C = camera { } camera { C location x }", "camera after its name");
    assert_dies("camera { location <0,0,-5> orthographic look_at 0 }", "must be the first item");
}

static void orthographic_cameras(void **state) {
    (void)state;
    Camera c = camera("orthographic location -5*z look_at 0");
    assert_int_equal(c.type, CAMERA_ORTHOGRAPHIC);
    assert_near(c.right.x, 1.33 * 5);
    assert_near(c.up.y, 5);
    c = camera("orthographic location -5*z look_at 0 right 4*x up 3*y");
    assert_near(c.right.x, 4);
    assert_near(c.up.y, 3);
    c = camera("orthographic location -5*z look_at 0 right 4*x up 3*y angle 90");
    assert_near(c.direction.z, 2); // 4 / (2 tan 45), so right and up grow by 5 / 2
    assert_near(c.right.x, 10);
    assert_near(c.up.y, 7.5);
    c = camera("orthographic location -5*z"); // look_at z, though not given
    assert_near(c.up.y, 6);
}

static void old_cameras_act_at_once(void **state) {
    (void)state;
    Camera c = old_camera("location -5*z look_at 0 right 2*x");
    assert_vec(c.right, 2, 0, 0);
    c = old_camera("right 2*x location <5,0,0> look_at 0 right 3*x");
    assert_vec(c.right, 3, 0, 0); // not turned any more
    c = old_camera("location -5*z look_at 0 orthographic");
    assert_near(c.up.y, 5);
    c = old_camera("orthographic location -5*z look_at 0"); // |look_at - location| was 1
    assert_near(c.up.y, 1);
    c = old_camera("location x translate y location 2*z rotate 90*y");
    assert_vec(c.location, 2, 0, 0);
    c = old_camera("angle 90 right 4*x");
    assert_near(c.direction.z, 1.33 / 2);
}

static void several_cameras(void **state) {
    (void)state;
    Scene *s = scene_of("camera { location x up 2*y } camera { location y } sphere { 0, 1 }");
    assert_vec(s->camera.location, 0, 1, 0);
    assert_vec(s->camera.up, 0, 1, 0); // from the default, not from the first
    assert_warns("camera { } camera { } sphere { 0, 1 }", "a camera before");
    s = scene_of("#default { camera { right 2*x } } camera { location y } sphere { 0, 1 }");
    assert_vec(s->camera.right, 2, 0, 0);
    const Camera *c = &scene_of("camera { spherical angle 200 } sphere { 0, 1 }")->camera;
    assert_int_equal(c->type, CAMERA_SPHERICAL);
    assert_true(c->spherical_deg[0] == 200 && c->spherical_deg[1] == 100 && c->angle_deg == 90);
    c = &scene_of("camera { cylinder 3 angle 200, } sphere { 0, 1 }")->camera;
    assert_int_equal(c->type, CAMERA_CYLINDER_3);
    assert_true(c->angle_deg == 200 && !c->has_blur);
    c = &scene_of("camera { aperture 1 blur_samples 4, 10 focal_point 3*y location 7*y scale 2 "
                  "confidence 0.8 variance 0 } sphere { 0, 1 }")
             ->camera;
    assert_true(c->has_blur && c->blur.samples == 10 && c->blur.min_samples == 4);
    assert_true(c->blur.focal_distance == 4 && c->blur.variance == 0 && c->blur.confidence == 0.8);
    c = &scene_of("camera { aperture 1 blur_samples 4 direction 3*z look_at 9*y } sphere { 0, 1 }")
             ->camera;
    assert_true(c->blur.focal_distance == 3 && c->blur.min_samples == 0);
    assert_warns("camera { mesh_camera { 1 0 mesh { triangle { 0, x, y } } } } sphere { 0, 1 }",
                 "mesh_camera is not modelled");
    assert_silent("#declare C = camera { mesh_camera { 1 0 mesh { triangle { 0, x, y } } } } "
                  "sphere { 0, 1 }");
    assert_warns("camera { aperture 1 blur_samples 9 bokeh { pigment { rgb 1 } } } sphere { 0, 1 }",
                 "bokeh is not modelled");
    assert_silent("camera { bokeh { pigment { rgb 1 } } } sphere { 0, 1 }");
    assert_warns("camera { aperture 1 confidence 1 } sphere { 0, 1 }", "between 0 and 1");
    assert_dies("camera { blur_samples 0 }", "must be positive");
    assert_dies("camera { blur_samples 9, 3 }", "must not be larger");
    assert_dies("camera { blur_samples 1e9 }", "at most 100000");
    assert_dies("camera { cylinder 5 }", "type 1, 2, 3 or 4");
}

static Settings settings(const char *raw) {
    char text[512];
    snprintf(text, sizeof text, "%s sphere { 0, 1 }", raw);
    return scene_of_raw(text)->settings;
}

static void versions_and_gamma(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int version;
        GammaMode mode;
        float gamma;
    } cases[] = {
        {"", 362, GAMMA_NONE, 1},
        {"#version 3.7;", 370, GAMMA_POWER, 1},
        {"#version 3.6;", 360, GAMMA_NONE, 1},
        {"#version 3.6; #version 3.7;", 370, GAMMA_POWER, 1},
        {"#version 3.7; #version 3.6;", 360, GAMMA_NONE, 1},
        {"#version 3.6; global_settings { assumed_gamma 2.2 }", 360, GAMMA_POWER, 2.2F},
        {"global_settings { assumed_gamma 1 }", 362, GAMMA_POWER, 1},
        {"#version 3.7; global_settings { assumed_gamma srgb }", 370, GAMMA_SRGB, 1},
        {"#version 3.7; global_settings { assumed_gamma 1.5 } global_settings { assumed_gamma 3 }",
         370, GAMMA_POWER, 1.5F},
        {"#include \"colors.inc\"", 370, GAMMA_POWER, 1}, // T38
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Settings s = settings(cases[i].text);
        assert_int_equal(s.version, cases[i].version);
        assert_int_equal(s.gamma_mode, cases[i].mode);
        if (s.gamma_mode == GAMMA_POWER)
            assert_near(s.assumed_gamma, cases[i].gamma);
    }
}

static void global_settings(void **state) {
    (void)state;
    Settings s = settings("#version 3.7; global_settings { assumed_gamma 1 ambient_light rgb "
                          "<1,2,3> max_trace_level 20 adc_bailout 0.25 number_of_waves 7 "
                          "noise_generator 3 irid_wavelength rgb 0.5 charset utf8 mm_per_unit 1 "
                          "max_intersections 3 subsurface { samples 3, 4 } } "
                          "background { rgbt <1,0.5,0,0.25> }");
    assert_near(s.ambient_light.b, 3);
    assert_int_equal(s.max_trace_level, 20);
    assert_near(s.adc_bailout, 0.25);
    assert_int_equal(s.number_of_waves, 7);
    assert_int_equal(s.noise_generator, 3);
    assert_near(s.irid_wavelength.g, 0.5);
    assert_color(s.background, 1, 0.5, 0, 0, 0.25);
    assert_int_equal(settings("#version 3.1;").noise_generator, 1);
    assert_int_equal(settings("#version 3.7;").noise_generator, 2);
    assert_color(settings("").background, 0, 0, 0, 0, 1);
    assert_warns("global_settings { max_trace_level 1000 } sphere { 0, 1 }", "256 is used");
    assert_dies("global_settings { wobble 3 }", "global_settings");
    scene_of("global_settings { radiosity { count 100, 1000 nearest_count 5, 3 error_bound 1 "
             "pretrace_start 0.1 pretrace_end 0.04 recursion_limit 1 normal on media off "
             "always_sample off gray_threshold 0 brightness 1 low_error_factor .5 minimum_reuse "
             ".015 maximum_reuse .1 adc_bailout .01 max_sample 1 save_file \"a\" } photons { count "
             "1000 autostop 0 jitter .4 gather 20, 100 media 10 radius 1, 2 expand_thresholds .2, "
             "40 max_trace_level 3 adc_bailout .1 load_file \"b\" } } sphere { 0, 1 }");
}

static void sky_spheres(void **state) {
    (void)state;
    Scene *s = scene_of("#declare S = sky_sphere { pigment { rgb x } }\n"
                        "sky_sphere { S pigment { gradient y } rotate 90*z emission 2 } "
                        "sphere { 0, 1 }");
    assert_true(s->has_sky_sphere);
    assert_int_equal(s->sky_sphere.pigment_count, 2);
    assert_int_equal(s->pigments[s->sky_sphere.pigments[1]].pattern.type, PATTERN_GRADIENT);
    assert_near(s->sky_sphere.emission.r, 2);
    assert_vec(transform_point(&s->sky_sphere.transform, vec3(1, 0, 0)), 0, 1, 0);
    assert_dies("sky_sphere { }", "'pigment' in 'sky_sphere'");
    assert_warns("sky_sphere { pigment { rgb 1 } } sky_sphere { pigment { rgb 1 } } "
                 "sphere { 0, 1 }",
                 "a sky_sphere before");
}

static void air(void **state) {
    (void)state;
    Scene *s = scene_of(
        "#declare F = fog { distance 10 rgb 1 fog_type 2 fog_alt 1 fog_offset 2 up y "
        "turbulence 0.5 turb_depth 1 octaves 3 omega 1 lambda 2 rotate x }\n"
        "fog { F distance 3 } "
        "rainbow { direction x angle 42 width 5 distance 1e6 jitter 0.1 up y arc_angle 100 "
        "falloff_angle 50 color_map { [0 rgb 0][1 rgb 1] } }"
        "media { intervals 3 samples 1, 2 method 3 confidence 0.9 variance 0.1 ratio 0.5 "
        "absorption 1 emission 1 scattering { 5, rgb 1 eccentricity 0.5 extinction 1 } "
        "density { bozo color_map { [0 rgb 0][1 rgb 1] } } jitter 1 aa_level 3 "
        "aa_threshold 0.1 scale 2 } sphere { 0, 1 }");
    assert_int_equal(s->fog_count, 1);
    assert_int_equal(s->fogs[0].type, FOG_GROUND);
    assert_true(s->fogs[0].distance == 3 && s->fogs[0].offset == 2 && s->fogs[0].alt == 1);
    assert_vec(s->fogs[0].up, 0, cos(M_PI / 180), sin(M_PI / 180));
    assert_int_equal(s->fogs[0].turbulence.octaves, 3);
    assert_int_equal(s->rainbow_count, 1);
    assert_vec(s->rainbows[0].right, 0, 0, -1);
    assert_true(s->rainbows[0].arc_deg == 100 && s->rainbows[0].falloff_deg == 50);
    s = scene_of("fog { 1 rgb x } fog { distance 0 } fog { 2 rgb z } rainbow { direction x } "
                 "sphere { 0, 1 }");
    assert_int_equal(s->fog_count, 2);
    assert_near(s->fogs[0].color.b, 1); // the last one first
    assert_int_equal(s->rainbow_count, 0);
    assert_dies("rainbow { angle 10, width 2 }", "found instead");
    assert_dies("rainbow { angle 10 }", "direction of a rainbow");
    assert_dies("rainbow { direction y }", "must not point along");
    assert_dies("rainbow { direction x up 0 }", "up vector");
    assert_dies("rainbow { direction x arc_angle 400 }", "0 to 360 degrees, not 400");
    assert_dies("rainbow { direction x arc_angle 10 falloff_angle 20 }", "smaller than");
    assert_warns("fog { distance 1 translate x } sphere { 0, 1 }", "cannot be translated");
    assert_warns("sphere { 0, 1 interior { media { emission 1 } } }", "media is not modelled");
    assert_silent("#declare I = interior { media { emission 1 } } sphere { 0, 1 }");
}

static void lights_of_other_kinds(void **state) {
    (void)state;
    Scene *s = scene_of(
        "light_source { 0, 1 spotlight point_at y radius 10 falloff 20 tightness 3 } "
        "light_source { 0, 1 cylinder radius 1 falloff 2 point_at x } "
        "light_source { 0, 1 area_light x, y, 3, 3 adaptive 1 jitter circular orient "
        "area_illumination on media_interaction off media_attenuation on photons { reflection on "
        "refraction off } } "
        "light_source { 0, 1 projected_through { disc { 0, z, 1 } } } "
        "light_group { light_source { y, 1 } sphere { 0, 1 } global_lights on translate x }");
    assert_int_equal(s->light_count, 5);
    assert_int_equal(s->lights[0].type, LIGHT_SPOT);
    assert_near(s->lights[0].falloff, 20);
    assert_near(s->lights[0].tightness, 3);
    assert_int_equal(s->lights[1].type, LIGHT_CYLINDER);
    assert_near(s->lights[1].radius, 1);
    assert_true(s->lights[2].has_area && s->lights[2].area.jitter && s->lights[2].area.orient);
    assert_true(s->lights[2].area.illumination);
    assert_int_equal(s->lights[2].area.adaptive, 1);
    assert_vec(s->lights[4].location, 1, 1, 0);
    s = scene_of("light_group { light_source { y, 1 } sphere { 0, 1 } light_group { box { 0, 1 } "
                 "light_source { x, 1 } global_lights } } light_source { z, 1 } disc { 0, z, 1 }");
    assert_int_equal(s->light_count, 3);
    assert_int_equal(s->lights[0].group, 1);
    assert_int_equal(s->lights[1].group, 2);
    assert_int_equal(s->lights[2].group, 0);
    for (uint32_t i = 0; i < s->object_count; i++) {
        const Object *o = &s->objects[i];
        if (o->type == OBJECT_SPHERE || o->type == OBJECT_BOX) {
            assert_int_equal(o->light_group, o->type == OBJECT_SPHERE ? 1 : 2);
            assert_true(o->no_global_lights);
        } else if (o->type == OBJECT_DISC) {
            assert_true(o->light_group == 0 && !o->no_global_lights);
        }
    }
    s = scene_of("light_source { x, 1 media_attenuation } sphere { 0, 1 } "
                 "light_source { x, 1 media_attenuation media_interaction off }");
    assert_true(s->lights[0].media_attenuation && !s->lights[1].media_attenuation);
    assert_dies(
        "light_source { 0, 1 looks_like { sphere { 0, 1 } } looks_like { sphere { 0, 1 } } }",
        "only one 'looks_like'");
}

// Every object statement with modifiers behind: the modelled ones are there, the others warned of.
static void other_objects_are_read(void **state) {
    (void)state;
    static const char *const objects[] = {
        "blob { threshold 0.5 sphere { 0, 1, strength 2 pigment { rgb 1 } } cylinder { 0, x, 1, 1 "
        "scale 2 texture { } } component 1, 2, <0,1,0> sturm }",
        "height_field { png \"plasma3.png\" smooth water_level 0.1 }",
        "height_field { function 10, 10 { x*y } }",
        "isosurface { function { x*x + y*y - 1 } contained_by { box { -1, 1 } } threshold 0.1 "
        "accuracy 0.01 max_gradient 3 max_trace 2 all_intersections evaluate 1, 2, 0.5 open }",
        "isosurface { function { x } contained_by { sphere { 0, 1 } } }",
        "julia_fractal { <1,2,3,4> quaternion sqr max_iteration 8 precision 20 slice <1,0,0,0>, 1 "
        "}",
        "julia_fractal { <1,2,3,4> hypercomplex pwr(2, 3) }",
        "lathe { cubic_spline 4 <0,0>,<1,1>,<1,2> <0,3> sturm }",
        "mesh { triangle { 0, x, y } smooth_triangle { 0, x, y, z, x, y uv_vectors <0,0>,<1,0>,"
        "<1,1> texture { T } } triangle { 0, x, y texture_list { T T T } } inside_vector y }",
        "mesh2 { vertex_vectors { 3, 0, x, y } normal_vectors { 1, y } uv_vectors { 1, <0,0> } "
        "texture_list { 2, texture { T } texture { } } face_indices { 1, <0,1,2>, 0, 1, 0 } "
        "uv_indices { 1, <0,0,0> } normal_indices { 1, <0,0,0> } inside_vector z }",
        "ovus { 2, 1 }",
        "parametric { function { u } function { v } function { u*v } <0,0>, <1,1> contained_by { "
        "box { -1, 1 } } max_gradient 2 accuracy 0.1 precompute 10 x, y, z }",
        "poly { 2, <1,0,0,0,1,0,0,0,1,-1> sturm }",
        "cubic { <1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20> }",
        "quartic { <1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,"
        "30,31,32,33,34,35> }",
        "polynomial { 2, xyz(2,0,0):1, xyz(0,0,0):-1 }",
        "polygon { 4, 0, x, x+y, 0 }",
        "prism { linear_sweep linear_spline 0, 1, 4, <0,0>,<1,0>,<1,1>,<0,0> open }",
        "quadric { <1,1,1>, 0, 0, -1 }",
        "smooth_triangle { 0, x, y, z, x, y }",
        "sor { 4, <0,0>,<1,1>,<1,2>,<0,3> open }",
        "sphere_sweep { b_spline 4, 0, 1, x, 1, y, 1, z, 1 tolerance 0.1 }",
        "superellipsoid { <0.5, 0.5> }",
        "text { ttf \"timrom.ttf\" \"Hello\" 0.1, 0 }",
        "text { internal 1 \"Hello\", 0.1, <0,0,0> }",
        "intersection { ovus { 2, 1 } box { 0, 1 } cutaway_textures }",
        "difference { ovus { 2, 1 } union { box { 0, 1 } sphere { x, 1 } } }",
    };
    for (size_t i = 0; i < sizeof objects / sizeof *objects; i++) {
        char text[2048];
        snprintf(text, sizeof text,
                 "#declare T = texture { } #declare O = %s object { O pigment { rgb 1 } interior "
                 "{ ior 2 } rotate x hollow }",
                 objects[i]);
        bool modelled = strncmp(objects[i], "julia", 5) != 0;
        Converted result = convert_text(text);
        if (!result.scene)
            fail_msg("%s: %s", objects[i], result.message);
        assert_int_equal(result.scene->object_count > 0, modelled);
        assert_int_equal(strstr(first_warning(text), "is not modelled") == NULL, modelled);
    }
    scene_of("sphere { 0, 1 photons { target 1 reflection on refraction off pass_through collect "
             "off } radiosity { importance 0.5 } no_radiosity dtag \"x\" }"
             "union { sphere { 0, 1 } sphere { 0, 1 } split_union off } torus { 1, 0.2 sturm }");
    assert_dies("sphere { 0, 1 sturm }", "'sturm' cannot be used");
    assert_dies("sphere { 0, 1 no_shadow off }", "error");
    assert_warns("union { sphere { 0, 1 } }", "at least two");
    assert_warns("sphere { 0, 1 rgb 1 }", "a colour belongs into a pigment");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(camera_defaults),
        cmocka_unit_test(camera_looks_at),
        cmocka_unit_test(camera_transforms_come_last),
        cmocka_unit_test(orthographic_cameras),
        cmocka_unit_test(old_cameras_act_at_once),
        cmocka_unit_test(several_cameras),
        cmocka_unit_test(versions_and_gamma),
        cmocka_unit_test(global_settings),
        cmocka_unit_test(sky_spheres),
        cmocka_unit_test(air),
        cmocka_unit_test(lights_of_other_kinds),
        cmocka_unit_test(other_objects_are_read),
    };
    return cmocka_run_group_tests_name("convert_world", tests, NULL, NULL);
}
