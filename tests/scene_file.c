// SPDX-License-Identifier: MIT
#include "scene_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/diag.h"
#include "base/file.h"

#include <stdio.h>
#include <unistd.h>

static char folder[] = "/tmp/qipov-scene-XXXXXX";
char scene_json_path[64], scene_bin_path[64];

int scene_file_set_up(void **state) {
    (void)state;
    if (!mkdtemp(folder))
        return 1;
    snprintf(scene_json_path, sizeof scene_json_path, "%s/x.qi.json", folder);
    snprintf(scene_bin_path, sizeof scene_bin_path, "%s/x.qi.bin", folder);
    diag_program("test");
    return 0;
}

int scene_file_tear_down(void **state) {
    (void)state;
    unlink(scene_json_path);
    unlink(scene_bin_path);
    return rmdir(folder);
}

void scene_file_put(const char *path, const char *text, size_t size) {
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(text, 1, size, out), size);
    assert_int_equal(fclose(out), 0);
}

char *scene_file_get(Arena *arena, const char *path) {
    char *text = file_read(arena, path, NULL, NULL);
    assert_non_null(text);
    return text;
}

void scene_job_read(void *arg) {
    SceneJob *job = arg;
    job->scene = scene_read(scene_json_path, job->arena);
}

void scene_job_write(void *arg) {
    const SceneJob *job = arg;
    scene_write(job->scene, job->path, job->options);
}

void scene_job_validate(void *arg) {
    const SceneJob *job = arg;
    scene_validate(job->scene, "memory");
}

Scene *scene_of_patches(Arena *arena, uint32_t patches) {
    Scene *scene = ARENA_NEW(arena, Scene);
    scene->settings = settings_default();
    scene->camera = camera_default();
    scene->pigments = ARENA_NEW(arena, Pigment);
    scene->pigments[0] = (Pigment){.pattern = pattern_default(), .color = {1, 0.5f, 0.1f, 0, 0}};
    scene->pigment_count = 1;
    scene->textures = ARENA_NEW(arena, Texture);
    scene->textures[0].layers = ARENA_NEW(arena, Layer);
    scene->textures[0].pattern = pattern_default();
    scene->textures[0].layers[0].finish = finish_default();
    scene->textures[0].layers[0].normal = NO_INDEX;
    scene->textures[0].layer_count = scene->texture_count = 1;
    scene->objects = ARENA_ARRAY(arena, Object, patches);
    scene->roots = ARENA_ARRAY(arena, uint32_t, patches);
    scene->object_count = scene->root_count = patches;
    Vec3 *points = ARENA_ARRAY(arena, Vec3, (size_t)patches * 16);
    for (uint32_t i = 0; i < patches; i++) {
        scene->roots[i] = i;
        scene->objects[i] = object_default(OBJECT_PATCH);
        scene->objects[i].texture = 0;
        scene->objects[i].shape.patch.points = &points[(size_t)i * 16];
        for (int j = 0; j < 16; j++)
            points[i * 16 + (uint32_t)j] = vec3((double)(j >> 2), j % 4 + 0.25, i);
    }
    scene_collect_requires(scene, arena);
    return scene;
}
