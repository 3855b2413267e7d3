// SPDX-License-Identifier: MIT
// Memory by lifetime: an arena hands out zeroed pieces and gives them back all at once. Allocation
// never returns NULL; out of memory is the machine's error and ends the program (see diag.h).
#ifndef BASE_ARENA_H
#define BASE_ARENA_H

#include <stddef.h>

typedef struct Arena Arena;

Arena *arena_create(void);
void arena_destroy(Arena *arena);
// size bytes, zeroed, aligned to 64. size 0 gives a valid pointer. A size that overflows dies.
void *arena_alloc(Arena *arena, size_t size);
// count * size bytes with the product checked.
void *arena_array(Arena *arena, size_t count, size_t size);
void *arena_copy(Arena *arena, const void *data, size_t size);
// Takes over what is in the heap (of realloc and its like; NULL is nothing), of size bytes, which
// it returns: large arrays need no second copy.
void *arena_adopt(Arena *arena, void *heap, size_t size);
char *arena_strdup(Arena *arena, const char *text);
char *arena_printf(Arena *arena, const char *format, ...) __attribute__((format(printf, 2, 3)));
size_t arena_bytes(const Arena *arena); // handed out so far

#define ARENA_NEW(arena, Type) ((Type *)arena_alloc((arena), sizeof(Type)))
#define ARENA_ARRAY(arena, Type, count) ((Type *)arena_array((arena), (count), sizeof(Type)))

#endif
