// SPDX-License-Identifier: MIT
// The scene file: what is written is read back bit by bit, and reads well.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/diag.h"
#include "base/file.h"
#include "model/file_path.h"
#include "model/json_layout.h"
#include "random_scene.h"
#include "random_value.h"
#include "scene_file.h"

#include <stdio.h>
#include <string.h>

static void check_round_trip(bool binary) {
    const SceneWriteOptions options = {.binary = binary};
    for (uint64_t number = 0; number < 150; number++) {
        Arena *arena = arena_create();
        Rng rng = {number};
        Scene *scene = random_scene(&rng, arena);
        scene_write(scene, scene_json_path, &options);
        Scene *again = scene_read(scene_json_path, arena);
        const char *difference = scene_difference(scene, again);
        if (difference)
            fail_msg("scene %llu: %s differs", (unsigned long long)number, difference);
        arena_destroy(arena);
    }
}

// Bases other than Bézier's become it: a biquadratic span begins at the middle of the four points
// about its corner; knots that are repeated at both ends leave Bézier points as they are.
static void test_bases(void **state) {
    (void)state;
    Arena *arena = arena_create();
    static const char text[] =
        "{\"format\": \"qipov-scene\", \"version\": 1, \"objects\": ["
        "{\"type\": \"bezier_patch\", \"basis\": \"doo_sabin\", \"points\": "
        "[[[0,0,0],[0,2,0],[0,4,1]], [[2,0,0],[2,2,2],[2,4,0]], [[4,0,0],[4,2,0],[4,4,0]]]},"
        "{\"type\": \"bezier_patch\", \"basis\": \"bspline\", \"knots_u\": [0,0,3,3],"
        "\"knots_v\": [1,1,2,2], \"weights\": [[1,1,1],[1,3,1],[1,1,2]], \"points\": "
        "[[[0,0,0],[0,2,0],[0,4,1]], [[2,0,0],[2,2,2],[2,4,0]], [[4,0,0],[4,2,0],[4,4,0]]]}"
        "]}";
    scene_file_put(scene_json_path, text, strlen(text));
    Scene *scene = scene_read(scene_json_path, arena);
    const PatchShape *mesh = &scene->objects[0].shape.patch, *same = &scene->objects[1].shape.patch;
    assert_true(mesh->degree_u == 2 && !mesh->weights);
    Vec3 corner = mesh->points[0], middle = mesh->points[4];
    assert_true(corner.x == 1 && corner.y == 1 && corner.z == 0.5);
    assert_true(middle.x == 2 && middle.y == 2 && middle.z == 2);
    assert_true(same->weights[4] == 3 && same->weights[8] == 2);
    assert_true(same->points[4].z == 2 && same->points[2].z == 1 && same->points[8].x == 4);
    scene_collect_requires(scene, arena);
    bool rational = false;
    for (uint32_t i = 0; i < scene->requires_count; i++)
        rational |= strcmp(scene->requires[i], "rational_patch") == 0;
    assert_true(rational);
    arena_destroy(arena);
}

static void test_round_trip_text(void **state) {
    (void)state;
    check_round_trip(false);
    assert_false(file_exists(scene_bin_path));
}

static void test_round_trip_binary(void **state) {
    (void)state;
    check_round_trip(true);
    assert_true(file_exists(scene_bin_path));
}

// The comparison itself must see every member: change one byte at a time of a finish.
static void test_comparison_sees(void **state) {
    (void)state;
    Arena *arena = arena_create();
    Rng a = {11}, b = {11};
    Scene *one = random_scene(&a, arena), *two = random_scene(&b, arena);
    assert_null(scene_difference(one, two));
    // All members of a finish but the two bools and their padding are floats.
    unsigned char *bytes = (unsigned char *)&two->textures[0].layers[0].finish;
    for (size_t i = 0; i < offsetof(Finish, reflection_fresnel); i++) {
        bytes[i] ^= 1;
        assert_non_null(scene_difference(one, two));
        bytes[i] ^= 1;
    }
    arena_destroy(arena);
}

static void test_numbers(void **state) {
    (void)state;
    Rng rng = {1};
    char text[JSON_NUMBER_SIZE];
    for (int i = 0; i < 200000; i++) {
        double value = random_double(&rng), back;
        float single = random_float(&rng), single_back;
        json_double(text, value);
        back = strtod(text, NULL);
        assert_memory_equal(&value, &back, sizeof value);
        json_float(text, single);
        single_back = (float)strtod(text, NULL);
        assert_memory_equal(&single, &single_back, sizeof single);
    }
    json_double(text, 0.1);
    assert_string_equal(text, "0.1");
    json_float(text, 0.1f);
    assert_string_equal(text, "0.1");
    json_double(text, -0.0);
    assert_string_equal(text, "-0.0");
}

// Maps that share their entries: 40 records of 2 entries each are 2^40 evaluations of a point, and
// a small file. They are refused.
static void test_shared_maps(void **state) {
    (void)state;
    Arena *arena = arena_create();
    Scene *scene = scene_of_patches(arena, 1);
    enum { DEPTH = 40 };
    scene->normals = ARENA_ARRAY(arena, Normal, DEPTH);
    scene->normal_count = DEPTH;
    for (uint32_t i = 0; i < DEPTH; i++) {
        Normal *normal = &scene->normals[i];
        *normal = normal_default();
        normal->pattern.type = i == 0 ? PATTERN_BUMPS : PATTERN_BOZO;
        normal->entry_count = i == 0 ? 0 : 2;
        normal->entries = ARENA_ARRAY(arena, IndexEntry, 2);
        for (uint32_t k = 0; k < normal->entry_count; k++)
            normal->entries[k] = (IndexEntry){(float)k, i - 1};
    }
    SceneJob job = {.arena = arena, .scene = scene};
    char *message = NULL;
    assert_false(diag_catch(scene_job_validate, &job, &message));
    assert_non_null(strstr(message, "evaluations at each point"));
    free(message);
    scene->normal_count = 12;
    scene_job_validate(&job);
    arena_destroy(arena);
}

// Files are named from where the scene file stands.
static void test_paths(void **state) {
    (void)state;
    Arena *arena = arena_create();
    assert_string_equal(path_from_file(arena, "a/b.png", "a/c/x.json"), "../b.png");
    assert_string_equal(path_from_file(arena, "b.png", "x.json"), "b.png");
    assert_string_equal(path_from_file(arena, "./d/../e/b.png", "e/x.json"), "b.png");
    assert_string_equal(path_from_file(arena, "/a/b.png", "c/x.json"), "/a/b.png");
    assert_string_equal(path_beside_file(arena, "../b.png", "a/c/x.json"), "a/c/../b.png");
    assert_string_equal(path_beside_file(arena, "b.png", "x.json"), "b.png");
    assert_string_equal(path_beside_file(arena, "/b.png", "a/x.json"), "/b.png");
    arena_destroy(arena);
}

static void test_layout(void **state) {
    (void)state;
    Arena *arena = arena_create();
    scene_write(scene_of_patches(arena, 1), scene_json_path, &(SceneWriteOptions){false});
    char *text = scene_file_get(arena, scene_json_path);
    assert_non_null(strstr(text, "\n  \"requires\": [\"bicubic_patch\", \"perspective\"],\n"));
    assert_non_null(
        strstr(text, "\n  \"pigments\": [{\"type\": \"plain\", \"color\": [1, 0.5, 0.1]}],\n"));
    assert_non_null(
        strstr(text, "\n        [[0, 0.25, 0], [0, 1.25, 0], [0, 2.25, 0], [0, 3.25, 0]],\n"));
    assert_null(strstr(text, "settings")); // all of them have their defaults
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n"))
        assert_true(strlen(line) <= 100);
    arena_destroy(arena);
}

// A pigment shows what was set and no more; a warp the fields of its type.
static void test_pattern_layout(void **state) {
    (void)state;
    Arena *arena = arena_create();
    Scene *scene = scene_of_patches(arena, 1);
    Pigment *pigment = &scene->pigments[0];
    MapEntry entry = {.color = {1, 1, 1, 0, 0}, .pigment = NO_INDEX};
    Warp warps[2] = {warp_default(WARP_CUBIC), warp_default(WARP_BLACK_HOLE)};
    warps[1].black_hole.radius = 3;
    pigment->pattern.type = PATTERN_SPIRAL1;
    pigment->pattern.arms = 5;
    pigment->pattern.has_turbulence = true;
    pigment->pattern.turbulence.amount = vec3(1, 2, 3);
    pigment->pattern.turbulence.octaves = 4;
    pigment->pattern.warps = warps;
    pigment->pattern.warp_count = 2;
    pigment->color = (Color){0, 0, 0, 0, 0};
    pigment->entries = &entry;
    pigment->entry_count = 1;
    scene_collect_requires(scene, arena);
    scene_write(scene, scene_json_path, &(SceneWriteOptions){false});
    char *text = scene_file_get(arena, scene_json_path), *to = text;
    for (const char *from = text; *from; from++) // how the lines are broken is test_layout's
        if (*from != ' ' && *from != '\n')
            *to++ = *from;
    *to = '\0';
    assert_non_null(strstr(text, "\"pattern_warp\",\"perspective\",\"spiral1\",\"turbulence\","
                                 "\"warp_black_hole\",\"warp_cubic\"]"));
    assert_non_null(strstr(
        text,
        "\"pigments\":[{\"type\":\"spiral1\",\"arms\":5,\"map\":[{\"value\":0,\"color\":[1,1,1]}"
        "],\"warps\":[{\"type\":\"cubic\"},{\"type\":\"black_hole\",\"center\":[0,0,0],"
        "\"radius\":3}],\"turbulence\":{\"amount\":[1,2,3],\"octaves\":4}}]"));
    arena_destroy(arena);
}

// bounded_by came behind boxed, and dents behind dispersion.
static void test_requires_are_sorted(void **state) {
    (void)state;
    for (uint64_t number = 0; number < 150; number++) {
        Arena *arena = arena_create();
        Rng rng = {number};
        const Scene *scene = random_scene(&rng, arena);
        for (uint32_t i = 1; i < scene->requires_count; i++)
            assert_true(strcmp(scene->requires[i - 1], scene -> requires[i]) < 0);
        arena_destroy(arena);
    }
}

// Above 10,000 patches the points leave the text, and equal neighbours are one entry.
static void test_many_patches(void **state) {
    (void)state;
    Arena *arena = arena_create();
    Scene *scene = scene_of_patches(arena, 10001);
    scene->objects[7000].shape.patch.uv[2].u = 0.5;
    scene_write(scene, scene_json_path, &(SceneWriteOptions){false});
    assert_null(scene_difference(scene, scene_read(scene_json_path, arena)));
    char *text = scene_file_get(arena, scene_json_path);
    assert_non_null(strstr(text, "\"count\": 10001"));
    assert_non_null(strstr(text, "\"uri\": \"x.qi.bin\""));
    assert_true(strlen(text) < 2000);
    arena_destroy(arena);
}

static void test_deep_unions(void **state) {
    (void)state;
    for (uint32_t depth = 990; depth <= 1010; depth += 20) {
        Arena *arena = arena_create();
        Scene *scene = scene_of_patches(arena, depth);
        for (uint32_t i = 0; i + 1 < depth; i++) {
            scene->objects[i] = object_default(OBJECT_UNION);
            scene->objects[i].shape.children.items = ARENA_NEW(arena, uint32_t);
            scene->objects[i].shape.children.items[0] = i + 1;
            scene->objects[i].shape.children.count = 1;
        }
        scene->root_count = 1;
        scene_collect_requires(scene, arena);
        SceneJob job = {.arena = arena, .scene = scene, .path = scene_json_path};
        job.options = &(SceneWriteOptions){false};
        char *message = NULL;
        bool good = diag_catch(scene_job_write, &job, &message);
        if (depth < 1000) {
            assert_true(good);
            assert_null(scene_difference(scene, scene_read(scene_json_path, arena)));
        } else {
            assert_false(good);
            assert_non_null(strstr(message, "more than 1000 unions inside one another"));
        }
        free(message);
        arena_destroy(arena);
    }
}

static void test_unwritable(void **state) {
    (void)state;
    Arena *arena = arena_create();
    SceneJob job = {
        .arena = arena, .scene = scene_of_patches(arena, 1), .path = "/nowhere/x.qi.json"};
    job.options = &(SceneWriteOptions){true};
    char *message = NULL;
    assert_false(diag_catch(scene_job_write, &job, &message));
    assert_non_null(strstr(message, "cannot write '/nowhere/x.qi.json': No such file"));
    free(message);
    arena_destroy(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bases),
        cmocka_unit_test(test_round_trip_text),
        cmocka_unit_test(test_round_trip_binary),
        cmocka_unit_test(test_comparison_sees),
        cmocka_unit_test(test_shared_maps),
        cmocka_unit_test(test_paths),
        cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_layout),
        cmocka_unit_test(test_pattern_layout),
        cmocka_unit_test(test_requires_are_sorted),
        cmocka_unit_test(test_many_patches),
        cmocka_unit_test(test_deep_unions),
        cmocka_unit_test(test_unwritable),
    };
    return cmocka_run_group_tests_name("scene_json", tests, scene_file_set_up,
                                       scene_file_tear_down);
}
