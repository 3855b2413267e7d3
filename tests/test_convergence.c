// SPDX-License-Identifier: MIT
// Our one picture (--method qi) against six of POV-Ray's, whose patches are cut 2..7 times: the
// finer POV-Ray cuts, the nearer its picture comes to ours. The table in README is this program's
// output. Three figures a step, in steps of 8 bits (1 = 1/255):
//   whole    RMS over the whole picture,
//   inside   RMS over pixels on patches and away from silhouettes: the camera rays of the pixel and
//            of its eight neighbours meet patches, their normals are within 20 degrees of the
//            pixel's own, none is seen at less than 12 degrees to the surface,
//   smooth   the same without the edges of what is painted or mirrored on the patch: our own
//            picture changes by less than a tenth of the full range over the nine pixels. (With
//            one sample a pixel an edge of a check that moves by a hundredth of a pixel flips one
//            pixel in a hundred along it from black to white, which says nothing of the surface.)
// Limits: all fall at every step; the last `smooth` is below 1, one step of 8 bits.
#include "pictures.h"

#include "base/file.h"
#include "converter/convert.h"
#include "render/camera.h"
#include "render/world.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 320, HEIGHT = 240, FIRST_STEP = 2, LAST_STEP = 7, KINDS = 3 };

typedef struct {
    const char *name, *folder, *scene;
} Row;

static const Row ROWS[] = {
    {"bezier.pov", EXAMPLES "objects", "bezier.pov"},
    {"teapot.pov", EXAMPLES "advanced/teapot", "teapot.pov"},
    {"teapot-matte.pov", "scenes/teapot-matte", "teapot-matte.pov"},
};

typedef struct {
    Vec3 normal;
    double cosine;
    bool patch;
} Seen;

// Casts the camera ray of every pixel.
static void look(const Scene *scene, Seen *seen) {
    PatchSetOptions options = patchset_options_default();
    World *world = world_create(scene, &options);
    const CameraView view = camera_view(&scene->camera, NULL, WIDTH, HEIGHT);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            Seen *s = &seen[y * WIDTH + x];
            Ray ray;
            camera_ray(&view, x, y, &ray);
            WorldHit hit;
            *s = (Seen){0};
            if (!world_intersect(world, &ray, 1e-4, INFINITY, RAY_CAMERA, NULL, &hit))
                continue;
            s->patch = scene->objects[hit.object].type == OBJECT_PATCH;
            s->normal = hit.normal;
            s->cosine = vec_dot(hit.normal, ray.dir);
        }
    }
    world_destroy(world);
}

static bool is_inside(const Seen *seen, int x, int y) {
    const double SMOOTH = cos(20.0 * 3.14159265358979 / 180.0);
    const double STEEP = sin(12.0 * 3.14159265358979 / 180.0);
    const Seen *middle = &seen[y * WIDTH + x];
    if (x < 1 || y < 1 || x >= WIDTH - 1 || y >= HEIGHT - 1)
        return false;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            const Seen *s = &seen[(y + dy) * WIDTH + x + dx];
            if (!s->patch || fabs(s->cosine) < STEEP ||
                fabs(vec_dot(s->normal, middle->normal)) < SMOOTH)
                return false;
        }
    return true;
}

static bool is_smooth(const Image *picture, int x, int y) {
    for (int c = 0; c < 3; c++) {
        float low = 1, high = 0;
        for (int dy = -1; dy <= 1; dy++)
            for (int dx = -1; dx <= 1; dx++) {
                float value = picture->pixels[((y + dy) * WIDTH + x + dx) * picture->channels + c];
                low = value < low ? value : low;
                high = value > high ? value : high;
            }
        if (high - low > 0.1f)
            return false;
    }
    return true;
}

// RMS in steps of 8 bits over the pixels that mask selects (all when NULL).
static double rms(const Image *a, const Image *b, const bool *mask) {
    double sum = 0;
    size_t count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        if (mask && !mask[i])
            continue;
        for (int c = 0; c < 3; c++) {
            double d = 255.0 * ((double)a->pixels[i * a->channels + c] -
                                (double)b->pixels[i * b->channels + c]);
            sum += d * d;
        }
        count += 3;
    }
    assert_true(count > 0);
    return sqrt(sum / (double)count);
}

static void converges(void **state) {
    const Row *row = *state;
    const char *scratch = scratch_folder();
    assert_int_equal(
        run_command(NULL, "rm -rf '%s/c' && cp -r '%s' '%s/c' && cp scenes/teapot/*.inc '%s/c'",
                    scratch, row->folder, scratch, scratch),
        0);
    char scene_path[4400];
    snprintf(scene_path, sizeof scene_path, "%s/c/%s", scratch, row->scene);

    Arena *arena = arena_create();
    const Image *ours = NULL;
    bool *masks[KINDS] = {NULL, ARENA_ARRAY(arena, bool, WIDTH *HEIGHT),
                          ARENA_ARRAY(arena, bool, WIDTH *HEIGHT)};
    size_t counts[KINDS] = {WIDTH * HEIGHT, 0, 0};
    double error[KINDS][LAST_STEP + 1];
    for (int steps = FIRST_STEP; steps <= LAST_STEP; steps++) {
        assert_int_equal(run_command(NULL,
                                     "cd '%s/c' && sed -E -i 's/(u_steps|v_steps)[[:space:]]+"
                                     "[0-9A-Za-z_]+/\\1 %d/g; s/flatness[[:space:]]+"
                                     "[0-9.A-Za-z_]+/flatness 0/g' $(ls *.pov *.inc)",
                                     scratch, steps),
                         0);
        if (!ours) {
            ours = image_read(arena, render_with_qirender("ours", scene_path, "+W320 +H240 -A"));
            RenderOptions options = options_default();
            options.input = scene_path;
            options.width = WIDTH;
            options.height = HEIGHT;
            const char *library = arena_printf(arena, "%s/c", scratch);
            options.library_paths = &library;
            options.library_path_count = 1;
            Seen *seen = ARENA_ARRAY(arena, Seen, WIDTH * HEIGHT);
            look(convert_scene(&options, arena), seen);
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                counts[1] += masks[1][i] = is_inside(seen, i % WIDTH, i / WIDTH);
                counts[2] += masks[2][i] = masks[1][i] && is_smooth(ours, i % WIDTH, i / WIDTH);
            }
        }
        const Image *theirs =
            image_read(arena, render_with_povray("theirs", scene_path, "+W320 +H240 -A"));
        for (int k = 0; k < KINDS; k++)
            error[k][steps] = rms(ours, theirs, masks[k]);
    }
    static const char *const NAMES[KINDS] = {"whole", "inside", "smooth"};
    for (int k = 0; k < KINDS; k++) {
        print_message("| %s | %s, %zu pixels |", row->name, NAMES[k], counts[k]);
        for (int s = FIRST_STEP; s <= LAST_STEP; s++)
            print_message(" %.3f |", error[k][s]);
        print_message("\n");
    }
    for (int k = 0; k < KINDS; k++)
        for (int s = FIRST_STEP + 1; s <= LAST_STEP; s++)
            assert_true(error[k][s] < error[k][s - 1]);
    assert_true(error[KINDS - 1][LAST_STEP] < 1.0);
    arena_destroy(arena);
}

int main(void) {
    enum { COUNT = sizeof ROWS / sizeof *ROWS };
    struct CMUnitTest tests[COUNT];
    for (int i = 0; i < COUNT; i++)
        tests[i] =
            (struct CMUnitTest){ROWS[i].name, converges, NULL, NULL, (void *)(uintptr_t)&ROWS[i]};
    print_message("RMS in steps of 8 bits; u_steps = v_steps =   2, 3, 4, 5, 6, 7; flatness 0\n");
    return cmocka_run_group_tests_name("convergence", tests, NULL, NULL);
}
