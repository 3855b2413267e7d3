// SPDX-License-Identifier: MIT
// A GIF (its first picture) by its own few rules: a palette, blocks, then codes of growing length
// for strings of places in it (LZW).
#include "image/gif.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MAX_SIDE = 1 << 15 };

typedef struct {
    const uint8_t *bytes;
    size_t size, at;
    // Of the picture's data: what is left of the block, and bits not yet taken.
    unsigned block, bits;
    int bit_count;
} Gif;

static unsigned byte(Gif *gif) { return gif->at < gif->size ? gif->bytes[gif->at++] : 0; }

static unsigned word(Gif *gif) {
    unsigned low = byte(gif);
    return low | byte(gif) << 8;
}

static void skip_blocks(Gif *gif) {
    for (unsigned size = byte(gif); size > 0 && gif->at < gif->size; size = byte(gif))
        gif->at += size;
}

// The next code; -1 at the end of the data.
static int next_code(Gif *gif, int length) {
    while (gif->bit_count < length) {
        if (gif->block == 0 && (gif->block = byte(gif)) == 0)
            return -1;
        if (gif->at >= gif->size)
            return -1;
        gif->bits |= byte(gif) << gif->bit_count;
        gif->bit_count += 8;
        gif->block--;
    }
    int code = (int)(gif->bits & ((1U << length) - 1));
    gif->bits >>= length;
    gif->bit_count -= length;
    return code;
}

enum { MAX_CODES = 4096 };

// Strings: the one before and one index more.
typedef struct {
    int16_t before[MAX_CODES];
    uint8_t last[MAX_CODES];
    uint16_t length[MAX_CODES];
} Strings;

// Writes the string of the code so that it begins at out; returns its first index.
static uint8_t put_string(const Strings *s, int code, uint8_t *out, size_t room) {
    size_t length = s->length[code];
    uint8_t first = 0;
    for (; code >= 0 && length > 0; code = s->before[code]) {
        first = s->last[code];
        if (--length < room)
            out[length] = first;
    }
    return first;
}

static bool unpack(Gif *gif, uint8_t *out, size_t count) {
    Strings s;
    int least = (int)byte(gif);
    if (least < 1 || least > 8)
        return false;
    int clear = 1 << least, end = clear + 1, next = end + 1, length = least + 1, old = -1;
    for (int i = 0; i < clear; i++)
        s.before[i] = -1, s.last[i] = (uint8_t)i, s.length[i] = 1;
    s.length[clear] = s.length[end] = 0;
    size_t done = 0;
    while (done < count) {
        int code = next_code(gif, length);
        if (code < 0 || code == end)
            return done > 0;
        if (code == clear) {
            next = end + 1, length = least + 1, old = -1;
            continue;
        }
        if (code > next || (code == next && old < 0))
            return false;
        if (old >= 0 && next < MAX_CODES) {
            s.before[next] = (int16_t)old;
            s.length[next] = (uint16_t)(s.length[old] + 1);
            // A code that is just being made ends as it begins.
            uint8_t first[1];
            s.last[next] = put_string(&s, code == next ? old : code, first, 0);
            next++;
            if (next == 1 << length && length < 12)
                length++;
        } else if (code == next) {
            return false;
        }
        put_string(&s, code, out + done, count - done);
        done += s.length[code];
        old = code;
    }
    return true;
}

// Where a row of an interlaced picture belongs: four passes.
static int interlaced_row(int row, int height) {
    static const int first[] = {0, 4, 2, 1}, step[] = {8, 8, 4, 2};
    for (int pass = 0; pass < 4; pass++) {
        int rows = (height - first[pass] + step[pass] - 1) / step[pass];
        if (row < rows)
            return first[pass] + row * step[pass];
        row -= rows > 0 ? rows : 0;
    }
    return height - 1;
}

// A table of colours, as the flags say that there is one; all opaque.
static void read_palette(Gif *gif, unsigned flags, StoredPicture *out) {
    if (!(flags & 0x80))
        return;
    out->palette_size = 2 << (flags & 7);
    for (int i = 0; i < out->palette_size; i++) {
        for (int c = 0; c < 3; c++)
            out->palette[i][c] = (uint8_t)byte(gif);
        out->palette[i][3] = 255;
    }
}

// One may make a colour transparent.
static void read_extension(Gif *gif, StoredPicture *out) {
    if (byte(gif) == 0xf9 && gif->at + 4 < gif->size && gif->bytes[gif->at] >= 4 &&
        (gif->bytes[gif->at + 1] & 1) && gif->bytes[gif->at + 4] < out->palette_size)
        out->palette[gif->bytes[gif->at + 4]][3] = 0;
    skip_blocks(gif);
}

static bool read_places(Gif *gif, Arena *arena, StoredPicture *out) {
    gif->at += 4; // where it stands on the screen
    int width = (int)word(gif), height = (int)word(gif);
    unsigned flags = byte(gif);
    read_palette(gif, flags, out);
    if (out->palette_size == 0 || width < 1 || height < 1 || width > MAX_SIDE || height > MAX_SIDE)
        return false;
    size_t row_size = (size_t)width;
    uint8_t *places = arena_array(arena, row_size, (size_t)height);
    out->width = width, out->height = height;
    out->places = places;
    if (!unpack(gif, places, row_size * (size_t)height))
        return false;
    if (!(flags & 0x40))
        return true;
    out->places = arena_array(arena, row_size, (size_t)height);
    for (int row = 0; row < height; row++)
        memcpy(out->places + (size_t)interlaced_row(row, height) * row_size,
               places + (size_t)row * row_size, row_size);
    return true;
}

static bool read_blocks(Gif *gif, Arena *arena, StoredPicture *out) {
    gif->at = 10;
    unsigned flags = byte(gif);
    gif->at = 13;
    read_palette(gif, flags, out);
    while (gif->at < gif->size) {
        unsigned kind = byte(gif);
        if (kind == 0x2c)
            return read_places(gif, arena, out);
        if (kind != 0x21)
            return false;
        read_extension(gif, out);
    }
    return false;
}

static bool read_file(FILE *in, Arena *arena, StoredPicture *out) {
    if (fseek(in, 0, SEEK_END) != 0)
        return false;
    long size = ftell(in);
    if (size < 14 || size > 1L << 30)
        return false;
    rewind(in);
    uint8_t *bytes = arena_alloc(arena, (size_t)size);
    Gif gif = {.bytes = bytes, .size = fread(bytes, 1, (size_t)size, in)};
    return read_blocks(&gif, arena, out);
}

bool gif_read(Arena *arena, const char *path, StoredPicture *out) {
    char start[4] = {0};
    FILE *in = fopen(path, "rb");
    if (!in)
        return false;
    *out = (StoredPicture){.channels = 3, .bits = 8};
    bool good = fread(start, 1, sizeof start, in) == sizeof start &&
                memcmp(start, "GIF8", 4) == 0 && read_file(in, arena, out);
    fclose(in);
    return good;
}
