// SPDX-License-Identifier: MIT
// A render that can be taken up again: the finished tiles of a long one are kept in a file beside
// the picture until the picture is there.
//
// The file holds a header, then one record a tile in the order in which they were finished: its
// number, a check sum, its colours. It is appended to only, so that whatever ends the program
// leaves at most the last record incomplete, and that one is ignored.
#ifndef RENDER_RESUME_H
#define RENDER_RESUME_H

#include "base/color.h"
#include "render/sample.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Resume Resume;

typedef struct {
    // Of scene and options: what is there is only used when it is the same. Asked for when there is
    // a file to read or to write: of a large scene it takes as long as reading that.
    uint64_t (*identity)(const void *context);
    int width; // of the picture, in pixels
    int tile_count;
    PixelRect (*tile)(const void *context, int number); // where a tile lies
    const void *context;
    Color *picture; // where finished tiles are read from and put
} ResumeJob;

// path: of the file. take_up: read what is there, else it will be overwritten. A file of another
// scene or other options is warned of. The caller destroys it.
Resume *resume_create(const char *path, const ResumeJob *job, bool take_up);
void resume_destroy(Resume *resume); // closes; the file stays

bool resume_has(const Resume *resume, int tile); // finished by an earlier run
int resume_count(const Resume *resume);          // so many are

// A tile is finished. Any thread. Nothing is written before the render has lasted a second: a
// shorter one is done again sooner than it is read.
void resume_tile(Resume *resume, int tile);
// The render ends early: writes what has not been written yet. False: the file cannot be written,
// and errno says why.
bool resume_keep(Resume *resume);
// The picture is written: the file has served.
void resume_remove(const char *path);

#endif
