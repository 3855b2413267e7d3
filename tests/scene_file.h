// SPDX-License-Identifier: MIT
// Scene files made in a test: where they are written, a small scene, and reading, writing and
// checking as diag_catch takes them.
#ifndef TESTS_SCENE_FILE_H
#define TESTS_SCENE_FILE_H

#include "model/scene.h"

// x.qi.json, and x.qi.bin beside it, in a folder of the program's own.
extern char scene_json_path[64], scene_bin_path[64];
int scene_file_set_up(void **state); // of a group of tests; names the program
int scene_file_tear_down(void **state);

void scene_file_put(const char *path, const char *text, size_t size);
char *scene_file_get(Arena *arena, const char *path);

// A scene of patches that scripts and readers like: short lines, one row of the net a line.
Scene *scene_of_patches(Arena *arena, uint32_t patches);

typedef struct {
    Arena *arena; // of what is read
    Scene *scene;
    const SceneWriteOptions *options;
    const char *path; // where it is written
} SceneJob;

// For diag_catch: arg is a SceneJob.
void scene_job_read(void *arg); // scene_json_path, into its scene
void scene_job_write(void *arg);
void scene_job_validate(void *arg);

#endif
