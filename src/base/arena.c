// SPDX-License-Identifier: MIT
// Blocks of growing size; a piece larger than a block gets its own. In the hostile test build every
// piece is its own block, so that AddressSanitizer sees its edges.
#include "base/arena.h"

#include "base/diag.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { ALIGN = 64 };
static const size_t HUGE_PAGE = (size_t)1 << 21;
#ifdef HOSTILE
static const size_t BLOCK_SIZE = 0;
#else
static const size_t BLOCK_SIZE = (size_t)1 << 18;
#endif

typedef struct Block {
    struct Block *next;
    size_t size, used; // bytes after the header
    char *data;
} Block;

struct Arena {
    Block *blocks; // the newest first; only that one has room
    size_t bytes;
};

Arena *arena_create(void) {
    Arena *arena = calloc(1, sizeof *arena);
    if (!arena)
        die("out of memory");
    return arena;
}

void arena_destroy(Arena *arena) {
    if (!arena)
        return;
    for (Block *b = arena->blocks, *next; b; b = next) {
        next = b->next;
        free(b->data);
        free(b);
    }
    free(arena);
}

static Block *add_block(Arena *arena, size_t size) {
    Block *b = calloc(1, sizeof *b);
    void *data = NULL;
    bool huge = size >= 2 * HUGE_PAGE;
    if (!b || posix_memalign(&data, huge ? HUGE_PAGE : ALIGN, size ? size : 1) != 0)
        die("out of memory (%zu bytes wanted)", size);
    // Rays jump about in large tables: with small pages the processor looks up as many addresses.
    if (huge)
        madvise(data, size, MADV_HUGEPAGE);
    memset(data, 0, size);
    b->data = data;
    b->size = size;
    b->next = arena->blocks;
    arena->blocks = b;
    return b;
}

void *arena_alloc(Arena *arena, size_t size) {
    if (size > SIZE_MAX / 2)
        die("out of memory (%zu bytes wanted)", size);
#ifdef HOSTILE
    size_t rounded = size;
#else
    size_t rounded = (size + ALIGN - 1) / ALIGN * ALIGN;
#endif
    Block *b = arena->blocks;
    if (!b || b->size - b->used < rounded || BLOCK_SIZE == 0) {
        b = add_block(arena, rounded > BLOCK_SIZE / 4 ? rounded : BLOCK_SIZE);
        // A large piece fills its own block; keep filling the old one after it.
        if (b->size == rounded && b->next && b->next->size - b->next->used > 0) {
            Block *old = b->next;
            b->next = old->next;
            old->next = b;
            arena->blocks = old;
        }
    }
    void *p = b->data + b->used;
    b->used += rounded;
    arena->bytes += rounded;
    return p;
}

void *arena_array(Arena *arena, size_t count, size_t size) {
    if (size && count > SIZE_MAX / 2 / size)
        die("out of memory (%zu elements of %zu bytes wanted)", count, size);
    return arena_alloc(arena, count * size);
}

void *arena_copy(Arena *arena, const void *data, size_t size) {
    void *p = arena_alloc(arena, size);
    if (size)
        memcpy(p, data, size);
    return p;
}

void *arena_adopt(Arena *arena, void *heap, size_t size) {
    if (!heap || size == 0) {
        free(heap);
        return arena_alloc(arena, 0);
    }
    Block *b = calloc(1, sizeof *b);
    void *fitted = realloc(heap, size); // gives back what the array had in reserve
    if (!b || !fitted)
        die("out of memory (%zu bytes wanted)", size);
    *b = (Block){.size = size, .used = size, .data = fitted};
    // Behind the block that is being filled.
    Block **place = arena->blocks ? &arena->blocks->next : &arena->blocks;
    b->next = *place;
    *place = b;
    arena->bytes += size;
    return fitted;
}

char *arena_strdup(Arena *arena, const char *text) {
    return arena_copy(arena, text, strlen(text) + 1);
}

char *arena_printf(Arena *arena, const char *format, ...) {
    va_list args;
    va_start(args, format);
    int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    char *text = arena_alloc(arena, (size_t)(length < 0 ? 0 : length) + 1);
    va_start(args, format);
    vsnprintf(text, (size_t)(length < 0 ? 0 : length) + 1, format, args);
    va_end(args);
    return text;
}

size_t arena_bytes(const Arena *arena) { return arena->bytes; }
