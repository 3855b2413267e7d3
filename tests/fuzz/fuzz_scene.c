// SPDX-License-Identifier: MIT
// libFuzzer's entry to the scene language: whatever the bytes, reading them ends soon with a scene
// or a message. `make fuzz` builds and runs it.
#include "base/diag.h"
#include "converter/convert.h"
#include "model/scene.h"

#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct {
    const uint8_t *data;
    size_t size;
    Arena *arena;
} Job;

static void convert(void *arg) {
    Job *job = arg;
    static const char *const libraries[] = {"/usr/share/povray-3.7/include"};
    static const char *library[1];
    library[0] = libraries[0];
    RenderOptions options = options_default();
    options.input = "fuzz.pov";
    options.width = 4;
    options.height = 3;
    options.library_paths = library;
    options.library_path_count = 1;
    options.limits[LIMIT_TOKENS] = 200000;
    options.limits[LIMIT_ELEMENTS] = 100000;
    options.limits[LIMIT_OBJECTS] = 2000;
    options.limits[LIMIT_MEGABYTES] = 256;
    options.limits[LIMIT_SECONDS] = 20;
    MissingList missing = {0};
    convert_bytes(&options, job->arena, job->data, job->size, &missing);
    array_free(&missing);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    diag_quiet(true);
    Job job = {data, size, arena_create()};
    char *message = NULL;
    if (!diag_catch(convert, &job, &message))
        free(message);
    arena_destroy(job.arena);
    return 0;
}
