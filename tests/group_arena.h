// SPDX-License-Identifier: MIT
// An arena for a group of tests, made before it and freed after it. Each test program that includes
// this has its own.
#ifndef TESTS_GROUP_ARENA_H
#define TESTS_GROUP_ARENA_H

#include "base/arena.h"

static Arena *arena;

static int create_arena(void **state) {
    (void)state;
    arena = arena_create();
    return 0;
}

static int destroy_arena(void **state) {
    (void)state;
    arena_destroy(arena);
    return 0;
}

#endif
