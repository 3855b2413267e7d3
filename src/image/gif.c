// SPDX-License-Identifier: MIT
// A GIF (its first picture) by its own few rules: blocks, then codes of growing length for strings
// of indices (LZW).
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

static uint8_t *gif_picture(Gif *gif, Arena *arena, int *width, int *height) {
    gif->at += 4; // where it stands on the screen
    *width = (int)word(gif), *height = (int)word(gif);
    unsigned flags = byte(gif);
    if (flags & 0x80)
        gif->at += 3U << ((flags & 7) + 1);
    if (*width < 1 || *height < 1 || *width > MAX_SIDE || *height > MAX_SIDE)
        return NULL;
    size_t row_size = (size_t)*width;
    uint8_t *pixels = arena_array(arena, row_size, (size_t)*height);
    if (!unpack(gif, pixels, row_size * (size_t)*height))
        return NULL;
    if (!(flags & 0x40))
        return pixels;
    uint8_t *ordered = arena_array(arena, row_size, (size_t)*height);
    for (int row = 0; row < *height; row++)
        memcpy(ordered + (size_t)interlaced_row(row, *height) * row_size,
               pixels + (size_t)row * row_size, row_size);
    return ordered;
}

static uint8_t *read_gif(Gif *gif, Arena *arena, int *width, int *height) {
    gif->at = 10;
    unsigned flags = byte(gif);
    gif->at = 13 + (flags & 0x80 ? 3U << ((flags & 7) + 1) : 0);
    while (gif->at < gif->size) {
        unsigned kind = byte(gif);
        if (kind == 0x2c)
            return gif_picture(gif, arena, width, height);
        if (kind != 0x21)
            return NULL;
        byte(gif); // which extension
        skip_blocks(gif);
    }
    return NULL;
}

static uint8_t *try_gif(FILE *in, Arena *arena, int *width, int *height) {
    if (fseek(in, 0, SEEK_END) != 0)
        return NULL;
    long size = ftell(in);
    if (size < 14 || size > 1L << 30)
        return NULL;
    rewind(in);
    uint8_t *bytes = arena_alloc(arena, (size_t)size);
    Gif gif = {.bytes = bytes, .size = fread(bytes, 1, (size_t)size, in)};
    return read_gif(&gif, arena, width, height);
}

uint8_t *gif_read(Arena *arena, const char *path, int *width, int *height) {
    char start[4] = {0};
    FILE *in = fopen(path, "rb");
    if (!in)
        return NULL;
    uint8_t *pixels = NULL;
    if (fread(start, 1, sizeof start, in) == sizeof start && memcmp(start, "GIF8", 4) == 0)
        pixels = try_gif(in, arena, width, height);
    fclose(in);
    return pixels;
}
