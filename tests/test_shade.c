// SPDX-License-Identifier: MIT
// Finishes, reflections and transparency against POV-Ray: each row of a table is one sphere,
// written for both; a row of spheres is rendered by both and every value of 16 bits compared.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "shade_fixture.h"

// Rows name only what differs from the default; later initialisers win on purpose.
#pragma GCC diagnostic ignored "-Woverride-init"

#define AIR                                                                                        \
    { .ior = 1.0f }

typedef struct {
    const char *pigment;
    Color color;
    const char *finish;
    Finish value;
    const char *interior;
    Interior inner;
} Row;

#define CELL 2.4 // width of a sphere's part of the picture, in units
#define CELL_PIXELS 12

static void add_row(Fixture *f, const Row *row, int index) {
    fixture_text(f, "sphere { <%.17g, 0, 0>, 1 pigment { %s } finish { %s } interior { %s } }\n",
                 CELL * index, row->pigment, row->finish, row->interior ? row->interior : "");
    Layer layer = {fixture_plain(f, row->color), row->value, NO_INDEX};
    Object sphere = fixture_sphere(vec3(CELL * index, 0, 0), 1.0);
    sphere.texture = fixture_texture(f, &layer, 1);
    Interior inner = row->inner;
    inner.refraction = 1.0f; // the default, of which the rows say nothing
    if (row->interior != NULL)
        sphere.interior = fixture_interior(f, inner);
    fixture_object(f, sphere);
}

static Fixture *table_scene(const Row *rows, int count, int version) {
    Fixture *f = fixture_create(version);
    fixture_orthographic(f, count * CELL_PIXELS, CELL_PIXELS, CELL * count, CELL,
                         vec3(CELL * (count - 1) / 2.0, 0.0, 0.0));
    fixture_add_lights(f);
    fixture_add_room(f);
    for (int i = 0; i < count; i++)
        add_row(f, &rows[i], i);
    return f;
}

static void check_table(const Row *rows, int count, int version) {
    fixture_compare_later(table_scene(rows, count, version), 9, false);
    fixture_compare_now();
}

#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

// ---- finishes ---------------------------------------------------------------------------------

#define CLAY                                                                                       \
    "rgb <0.7, 0.5, 0.3>", { 0.7f, 0.5f, 0.3f, 0.0f, 0.0f }

static const Row finishes[] = {
    {CLAY, "ambient 0.1", FINISH(), NULL, AIR},
    {CLAY, "ambient rgb <0.3, 0.2, 0.5> diffuse 0",
     FINISH(.ambient = {0.3f, 0.2f, 0.5f}, .diffuse = 0.0f), NULL, AIR},
    {CLAY, "emission rgb <0.1, 0.4, 0.2>", FINISH(.emission = {0.1f, 0.4f, 0.2f}), NULL, AIR},
    {CLAY, "diffuse 0.4, 0.3", FINISH(.diffuse = 0.4f, .diffuse_back = 0.3f), NULL, AIR},
    {CLAY, "brilliance 3.5", FINISH(.brilliance = 3.5f), NULL, AIR},
    {CLAY, "phong 0.7", FINISH(.phong = 0.7f), NULL, AIR},
    {CLAY, "phong 0.7 phong_size 4.5", FINISH(.phong = 0.7f, .phong_size = 4.5f), NULL, AIR},
    {CLAY, "phong 0.9 phong_size 80 metallic",
     FINISH(.phong = 0.9f, .phong_size = 80.0f, .metallic = 1.0f), NULL, AIR},
    {CLAY, "specular 0.6", FINISH(.specular = 0.6f), NULL, AIR},
    {CLAY, "specular 0.6 roughness 0.37", FINISH(.specular = 0.6f, .roughness = 0.37f), NULL, AIR},
    {CLAY, "specular 0.6 roughness 0.2 metallic 0.6",
     FINISH(.specular = 0.6f, .roughness = 0.2f, .metallic = 0.6f), NULL, AIR},
    {CLAY, "irid { 0.5 thickness 0.3 }", FINISH(.irid = 0.5f, .irid_thickness = 0.3f), NULL, AIR},
    {CLAY, "irid { 0.5 thickness 0.3 turbulence 0.7 }",
     FINISH(.irid = 0.5f, .irid_thickness = 0.3f, .irid_turbulence = 0.7f), NULL, AIR},
    {CLAY, "diffuse 0 specular 0.4 irid { 0.7 thickness 1.3 }",
     FINISH(.diffuse = 0.0f, .specular = 0.4f, .irid = 0.7f, .irid_thickness = 1.3f), NULL, AIR},
};

static void finish_terms(void **state) {
    (void)state;
    check_table(finishes, COUNT(finishes), 370);
}

// ---- reflection -------------------------------------------------------------------------------

static const Row reflections[] = {
    {CLAY, "reflection 0.4", FINISH(.reflection_min = GREY3(0.4f), .reflection_max = GREY3(0.4f)),
     NULL, AIR},
    {CLAY, "reflection rgb <0.2, 0.5, 0.8>",
     FINISH(.reflection_min = {0.2f, 0.5f, 0.8f}, .reflection_max = {0.2f, 0.5f, 0.8f}), NULL, AIR},
    {CLAY, "reflection { 0.3 }",
     FINISH(.reflection_min = GREY3(0.3f), .reflection_max = GREY3(0.3f)), NULL, AIR},
    {CLAY, "reflection { rgb <0.1, 0.1, 0.3>, rgb <0.9, 0.6, 0.7> }",
     FINISH(.reflection_min = {0.1f, 0.1f, 0.3f}, .reflection_max = {0.9f, 0.6f, 0.7f}), NULL, AIR},
    {CLAY, "reflection { 0.05, 0.8 falloff 3.3 }",
     FINISH(.reflection_min = GREY3(0.05f), .reflection_max = GREY3(0.8f),
            .reflection_falloff = 3.3f),
     NULL, AIR},
    {CLAY, "reflection { 0.9 metallic }",
     FINISH(.reflection_min = GREY3(0.9f), .reflection_max = GREY3(0.9f),
            .reflection_metallic = 1.0f),
     NULL, AIR},
    {CLAY, "reflection { 0.2, 0.9 metallic 0.7 }",
     FINISH(.reflection_min = GREY3(0.2f), .reflection_max = GREY3(0.9f),
            .reflection_metallic = 0.7f),
     NULL, AIR},
    {CLAY, "reflection { 0.7 exponent 1.8 }",
     FINISH(.reflection_min = GREY3(0.7f), .reflection_max = GREY3(0.7f),
            .reflection_exponent = 1.8f),
     NULL, AIR},
    {CLAY,
     "reflection { 0.9 fresnel }",
     FINISH(.reflection_max = GREY3(0.9f), .reflection_fresnel = true),
     "ior 1.5",
     {.ior = 1.5f}},
    {CLAY,
     "reflection { 0.1, 0.9 fresnel }",
     FINISH(.reflection_min = GREY3(0.1f), .reflection_max = GREY3(0.9f),
            .reflection_fresnel = true),
     "ior 2.3",
     {.ior = 2.3f}},
    {CLAY, "reflection { 0.9 fresnel }",
     FINISH(.reflection_max = GREY3(0.9f), .reflection_fresnel = true), NULL, AIR},
    {CLAY, "reflection 0.5 irid { 0.4 thickness 0.5 }",
     FINISH(.reflection_min = GREY3(0.5f), .reflection_max = GREY3(0.5f), .irid = 0.4f,
            .irid_thickness = 0.5f),
     NULL, AIR},
    {"rgbt <0.7, 0.5, 0.3, 0.6>",
     {0.7f, 0.5f, 0.3f, 0.0f, 0.6f},
     "reflection { 0.3, 0.8 } conserve_energy",
     FINISH(.reflection_min = GREY3(0.3f), .reflection_max = GREY3(0.8f), .conserve_energy = true),
     NULL,
     AIR},
};

static void reflection_forms(void **state) {
    (void)state;
    check_table(reflections, COUNT(reflections), 370);
}

// ---- transparency -----------------------------------------------------------------------------

static const Row transparents[] = {
    {"rgbt <0.7, 0.5, 0.3, 0.5>", {0.7f, 0.5f, 0.3f, 0.0f, 0.5f}, "", FINISH(), NULL, AIR},
    {"rgbf <0.7, 0.5, 0.3, 0.8>", {0.7f, 0.5f, 0.3f, 0.8f, 0.0f}, "", FINISH(), NULL, AIR},
    {"rgbft <0.7, 0.5, 0.3, 0.4, 0.3>", {0.7f, 0.5f, 0.3f, 0.4f, 0.3f}, "", FINISH(), NULL, AIR},
    {"rgbf <0.9, 0.95, 0.8, 0.9>",
     {0.9f, 0.95f, 0.8f, 0.9f, 0.0f},
     "phong 0.5",
     FINISH(.phong = 0.5f),
     "ior 1.5",
     {.ior = 1.5f}},
    {"rgbt <1, 1, 1, 0.9>",
     {1.0f, 1.0f, 1.0f, 0.0f, 0.9f},
     "reflection { 0.1, 0.9 fresnel }",
     FINISH(.reflection_min = GREY3(0.1f), .reflection_max = GREY3(0.9f),
            .reflection_fresnel = true),
     "ior 1.33",
     {.ior = 1.33f}},
    {"rgbt <1, 1, 1, 0.8>",
     {1.0f, 1.0f, 1.0f, 0.0f, 0.8f},
     "",
     FINISH(),
     "ior 0.6",
     {.ior = 0.6f}}, // totally reflecting from outside near the rim
    {"rgbt <1, 1, 1, 0.8>",
     {1.0f, 1.0f, 1.0f, 0.0f, 0.8f},
     "reflection 0.3",
     FINISH(.reflection_min = GREY3(0.3f), .reflection_max = GREY3(0.3f)),
     "ior 0.5",
     {.ior = 0.5f}},
    {"rgbt 0.9",
     {0.9f, 0.9f, 0.9f, 0.0f, 0.9f},
     "",
     FINISH(),
     "fade_distance 0.7 fade_power 2 fade_color rgb <0.1, 0.5, 0.2>",
     {.ior = 1.0f, .fade_distance = 0.7f, .fade_power = 2.0f, .fade_color = {0.1f, 0.5f, 0.2f}}},
    {"rgbt 0.9",
     {0.9f, 0.9f, 0.9f, 0.0f, 0.9f},
     "",
     FINISH(),
     "ior 1.2 fade_distance 1.7 fade_power 1001 fade_color rgb <0.1, 0.5, 0.2>",
     {.ior = 1.2f, .fade_distance = 1.7f, .fade_power = 1001.0f, .fade_color = {0.1f, 0.5f, 0.2f}}},
    {"rgbt 0.9",
     {0.9f, 0.9f, 0.9f, 0.0f, 0.9f},
     "",
     FINISH(),
     "fade_distance 0.7",
     {.ior = 1.0f, .fade_distance = 0.7f}},
    {"rgbt <0.5, 0.7, 0.9, 0.6>",
     {0.5f, 0.7f, 0.9f, 0.0f, 0.6f},
     "",
     FINISH(),
     "ior 1.1 caustics 0.2",
     {.ior = 1.1f, .caustics = 9.0f}},
    {"rgbf <1.3, -0.2, 0.4, 0.6>",
     {1.3f, -0.2f, 0.4f, 0.6f, 0.0f},
     "conserve_energy",
     FINISH(.conserve_energy = true),
     NULL,
     AIR},
};

static void transparency(void **state) {
    (void)state;
    check_table(transparents, COUNT(transparents), 370);
}

static void transparency_before_37(void **state) {
    (void)state;
    check_table(transparents, COUNT(transparents), 360);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finish_terms),
        cmocka_unit_test(reflection_forms),
        cmocka_unit_test(transparency),
        cmocka_unit_test(transparency_before_37),
    };
    return cmocka_run_group_tests_name("shade", tests, NULL, NULL);
}
