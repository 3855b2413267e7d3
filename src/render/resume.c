// SPDX-License-Identifier: MIT
#include "render/resume.h"

#include "base/arena.h"
#include "base/diag.h"
#include "base/hash.h"
#include "base/usage.h"

#include <assert.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const double QUIET_SECONDS = 1.0;
static const char MAGIC[8] = "QIPOVST2";

typedef struct {
    char magic[8];
    uint64_t identity;
    int32_t width, tile_count;
} Header;

typedef struct {
    uint64_t check;
    int32_t tile;
    uint32_t pixels;
} Record;

_Static_assert(sizeof(Header) == 24 && sizeof(Record) == 16, "no padding goes to the file");

// What has become of a tile.
enum { OPEN, READ, DONE, WRITTEN };

struct Resume {
    Arena *arena;
    ResumeJob job;
    const char *path;
    unsigned char *state; // of each tile
    Color *colors;        // one tile, row by row
    FILE *file;           // NULL: not begun
    int error;            // errno of what went wrong; 0: nothing
    int read;
    long good; // bytes of the file that are sound
    double started;
};

static size_t pixels_of(PixelRect tile) {
    return (size_t)(tile.right - tile.left) * (size_t)(tile.bottom - tile.top);
}

// Over the tile's number and its colours.
static uint64_t check_of(int tile, const Color *colors, size_t count) {
    return hash_words(hash_bytes(HASH_START, &tile, sizeof tile), colors,
                      count * (sizeof *colors / sizeof(uint32_t)));
}

static Header header_of(const ResumeJob *job) {
    Header header = {.identity = job->identity(job->context),
                     .width = job->width,
                     .tile_count = job->tile_count};
    memcpy(header.magic, MAGIC, sizeof MAGIC);
    return header;
}

static PixelRect tile_of(const Resume *r, int number) {
    return r->job.tile(r->job.context, number);
}

static Color *row_of(const Resume *r, PixelRect tile, int y) {
    return r->job.picture + (size_t)y * (size_t)r->job.width + (size_t)tile.left;
}

static bool read_record(Resume *r, FILE *file) {
    Record record;
    if (fread(&record, sizeof record, 1, file) != 1 || record.tile < 0 ||
        record.tile >= r->job.tile_count)
        return false;
    PixelRect tile = tile_of(r, record.tile);
    size_t count = pixels_of(tile), across = (size_t)(tile.right - tile.left);
    if (record.pixels != count || fread(r->colors, sizeof(Color), count, file) != count ||
        record.check != check_of(record.tile, r->colors, count))
        return false;
    for (int y = tile.top; y < tile.bottom; y++)
        memcpy(row_of(r, tile, y), r->colors + (size_t)(y - tile.top) * across,
               across * sizeof(Color));
    r->read += r->state[record.tile] == OPEN;
    r->state[record.tile] = READ;
    return true;
}

static void take_up_file(Resume *r) {
    FILE *file = fopen(r->path, "rb");
    if (!file)
        return;
    const Header ours = header_of(&r->job);
    Header header;
    if (fread(&header, sizeof header, 1, file) == 1 && memcmp(&header, &ours, sizeof ours) == 0) {
        do
            r->good = ftell(file);
        while (read_record(r, file));
    } else {
        warn("'%s' is of another scene or of other options: rendering from the start", r->path);
    }
    fclose(file);
}

Resume *resume_create(const char *path, const ResumeJob *job, bool take_up) {
    Arena *arena = arena_create();
    Resume *r = ARENA_NEW(arena, Resume);
    r->arena = arena;
    r->job = *job;
    r->path = arena_strdup(arena, path);
    r->state = ARENA_ARRAY(arena, unsigned char, (size_t)job->tile_count);
    size_t most = 0;
    for (int i = 0; i < job->tile_count; i++) {
        size_t pixels = pixels_of(tile_of(r, i));
        most = pixels > most ? pixels : most;
    }
    r->colors = ARENA_ARRAY(arena, Color, most);
    if (take_up)
        take_up_file(r);
    r->started = usage_clock();
    return r;
}

void resume_destroy(Resume *resume) {
    if (!resume)
        return;
    if (resume->file)
        fclose(resume->file);
    arena_destroy(resume->arena);
}

bool resume_has(const Resume *resume, int tile) { return resume->state[tile] == READ; }
int resume_count(const Resume *resume) { return resume->read; }

static bool write_record(Resume *r, int number) {
    PixelRect tile = tile_of(r, number);
    size_t count = pixels_of(tile), across = (size_t)(tile.right - tile.left);
    for (int y = tile.top; y < tile.bottom; y++)
        memcpy(r->colors + (size_t)(y - tile.top) * across, row_of(r, tile, y),
               across * sizeof(Color));
    const Record record = {check_of(number, r->colors, count), number, (uint32_t)count};
    if (fwrite(&record, sizeof record, 1, r->file) != 1 ||
        fwrite(r->colors, sizeof(Color), count, r->file) != count)
        return false;
    r->state[number] = WRITTEN;
    return true;
}

// What was read stays, what follows it is cut off; or a new file with its header.
static bool begin_file(Resume *r) {
    if (r->good > 0) {
        r->file = fopen(r->path, "r+b");
        return r->file && ftruncate(fileno(r->file), r->good) == 0 &&
               fseek(r->file, r->good, SEEK_SET) == 0;
    }
    r->file = fopen(r->path, "wb");
    const Header header = header_of(&r->job);
    return r->file && fwrite(&header, sizeof header, 1, r->file) == 1;
}

// Writes all that is done. Once something has failed it stays that way: the picture itself does not
// need the file.
static void write_done(Resume *r) {
    if (r->error)
        return;
    errno = 0;
    bool good = r->file || begin_file(r);
    for (int i = 0; good && i < r->job.tile_count; i++)
        good = r->state[i] != DONE || write_record(r, i);
    good = good && fflush(r->file) == 0;
    if (!good)
        r->error = errno ? errno : EIO;
}

static void write_one(Resume *r, int tile) {
    if (r->error)
        return;
    errno = 0;
    if (!write_record(r, tile) || fflush(r->file) != 0)
        r->error = errno ? errno : EIO;
}

void resume_tile(Resume *resume, int tile) {
#pragma omp critical(resume_file)
    {
        resume->state[tile] = DONE;
        if (resume->file)
            write_one(resume, tile);
        else if (usage_clock() - resume->started >= QUIET_SECONDS)
            write_done(resume);
    }
}

bool resume_keep(Resume *resume) {
    write_done(resume);
    errno = resume->error;
    return resume->error == 0;
}

void resume_remove(const char *path) { (void)unlink(path); }
