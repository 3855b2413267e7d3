// SPDX-License-Identifier: MIT
#include "reference.h"

#include "base/diag.h"
#include "base/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool reference_available(void) {
    static int found = -1;
    if (found < 0)
        found = system("command -v povray >/dev/null 2>&1") == 0;
    return found != 0;
}

struct Reference {
    Arena *arena;
    char folder[64];
    const char *switches;
    FILE *process;
};

Reference *reference_begin(Arena *arena, const char *scene, const char *switches) {
    Reference *r = ARENA_NEW(arena, Reference);
    r->arena = arena;
    r->switches = switches;
    strcpy(r->folder, "/tmp/qipov-test-XXXXXX");
    if (!mkdtemp(r->folder))
        die("cannot make a temporary folder");
    OutputFile *out = file_begin(arena_printf(arena, "%s/scene.pov", r->folder));
    fputs(scene, file_stream(out));
    file_commit(out);
    fflush(NULL);
    r->process = popen(arena_printf(arena,
                                    "cd %s && povray +Iscene.pov +Oscene.png -D -P %s "
                                    ">log.txt 2>&1",
                                    r->folder, switches),
                       "r");
    if (!r->process)
        die("cannot start povray");
    return r;
}

Image *reference_end(Reference *r) {
    int status = pclose(r->process);
    Image *image = NULL;
    const char *log = NULL;
    if (status == 0)
        image = image_read(r->arena, arena_printf(r->arena, "%s/scene.png", r->folder));
    else
        log = file_read(r->arena, arena_printf(r->arena, "%s/log.txt", r->folder), NULL, NULL);
    if (system(arena_printf(r->arena, "rm -r %s", r->folder)) != 0)
        fprintf(stderr, "%s was left behind\n", r->folder);
    if (!image)
        die("povray %s failed:\n%s", r->switches, log ? log : "");
    return image;
}

Image *reference_render(Arena *arena, const char *scene, const char *switches) {
    return reference_end(reference_begin(arena, scene, switches));
}

size_t reference_mismatches(const Image *a, const Image *b, char *first, size_t room) {
    snprintf(first, room, "none");
    if (a->width != b->width || a->height != b->height || a->channels != b->channels) {
        snprintf(first, room, "sizes: %d x %d x %d, %d x %d x %d", a->width, a->height, a->channels,
                 b->width, b->height, b->channels);
        return SIZE_MAX;
    }
    size_t count = 0, values = (size_t)a->width * (size_t)a->height * (size_t)a->channels;
    for (size_t i = 0; i < values; i++) {
        long x = lround(a->pixels[i] * 65535.0), y = lround(b->pixels[i] * 65535.0);
        if (x != y && count++ == 0) {
            size_t pixel = i / (size_t)a->channels;
            snprintf(first, room, "(%zu, %zu) channel %zu: %ld, %ld of 65535",
                     pixel % (size_t)a->width, pixel / (size_t)a->width, i % (size_t)a->channels, x,
                     y);
        }
    }
    return count;
}
