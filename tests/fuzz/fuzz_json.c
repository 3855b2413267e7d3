// SPDX-License-Identifier: MIT
// libFuzzer's entry to the scene file: whatever the JSON, it is read or refused.
#include "base/diag.h"
#include "model/scene.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct {
    const char *path;
    Arena *arena;
} Job;

static void read_scene(void *arg) {
    Job *job = arg;
    scene_read(job->path, job->arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static char path[64];
    snprintf(path, sizeof path, "/tmp/qipov-fuzz-%d.qi.json", (int)getpid());
    FILE *out = fopen(path, "wb");
    if (!out || fwrite(data, 1, size, out) != size)
        abort();
    fclose(out);
    diag_quiet(true);
    Job job = {path, arena_create()};
    char *message = NULL;
    if (!diag_catch(read_scene, &job, &message))
        free(message);
    arena_destroy(job.arena);
    return 0;
}
