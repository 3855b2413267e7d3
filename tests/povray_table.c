// SPDX-License-Identifier: MIT
#include "tests/povray_table.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "render/camera.h"
#include "render/trace.h"
#include "tests/convert_help.h"
#include "tests/povray_pictures.h"

#include <math.h>
#include <stdio.h>

enum { PIXELS = TABLE_WIDTH * TABLE_HEIGHT };

static long value_of(float v) { return lround(fmin(fmax(v, 0.0), 1.0) * 65535.0); }

// How many pixels differ by more than a rounding in the last places.
static int count_differences(const uint16_t *want, const char *text) {
    const Scene *scene = scene_of(text);
    PatchSetOptions facets = {.method = METHOD_FACETS, .tolerance = 1e-9};
    World *world = world_create(scene, &facets);
    TraceOptions options = {.quality = 9};
    Shading *shading = shading_create(scene, world, &options);
    Tracer *tracer = tracer_create(shading);
    const CameraView view = camera_view(&scene->camera, NULL, TABLE_WIDTH, TABLE_HEIGHT);
    int count = 0;
    for (int i = 0; i < PIXELS; i++) {
        Ray ray;
        camera_ray(&view, i % TABLE_WIDTH, i / TABLE_WIDTH, &ray);
        Color c = tracer_trace(tracer, &ray);
        const long got[3] = {value_of(c.r), value_of(c.g), value_of(c.b)};
        bool differs = false;
        for (int k = 0; k < 3; k++)
            differs = differs || labs(got[k] - want[i * 3 + k]) > 2;
        count += differs;
    }
    tracer_destroy(tracer);
    shading_destroy(shading);
    world_destroy(world);
    return count;
}

static void write_job(const PovrayPictures *pictures, size_t number, const char *text) {
    char path[128];
    snprintf(path, sizeof path, "%s/job%zu.pov", pictures->directory, number);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "#version 3.7; global_settings { assumed_gamma 1 }\n%s", text);
    fclose(file);
}

static char *scene_text(const char *stage, const char *scene) {
    static char text[16384];
    int length = snprintf(text, sizeof text, "%s%s\n", stage, scene);
    assert_true(length > 0 && (size_t)length < sizeof text);
    return text;
}

static void compare(void **state) {
    const PovrayTable *table = *state;
    PovrayPictures *pictures = povray_create(TABLE_WIDTH, TABLE_HEIGHT);
    for (size_t i = 0; i < table->count; i++)
        write_job(pictures, i, scene_text(table->stage, table->scenes[i]));
    if (!povray_render(pictures, table->count)) {
        povray_destroy(pictures);
        print_message("povray is not installed: nothing to compare with\n");
        skip();
    }
    bool good = true;
    for (size_t i = 0; i < table->count; i++) {
        const uint16_t *pixels = povray_read(pictures, i);
        if (!pixels)
            fail_msg("povray refused %s/job%zu.pov", pictures->directory, i);
        int differ = count_differences(pixels, scene_text(table->stage, table->scenes[i]));
        print_message("scene %zu: %d of %d pixels differ\n", i, differ, PIXELS);
        good = good && differ <= table->share * PIXELS;
    }
    povray_destroy(pictures);
    assert_true(good);
}

int povray_table_run(const PovrayTable *table) {
    const struct CMUnitTest tests[] = {
        {"pictures", compare, NULL, NULL, (void *)(uintptr_t)table},
    };
    return cmocka_run_group_tests_name(table->name, tests, NULL, NULL);
}
