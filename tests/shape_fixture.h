// SPDX-License-Identifier: MIT
// Shapes made in a test: the arena that holds them, made before a group of tests and freed after
// it. Each test program that includes this has its own.
#ifndef TESTS_SHAPE_FIXTURE_H
#define TESTS_SHAPE_FIXTURE_H

#include "shape/shape.h"

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

static Shape prepare(Object object) {
    Object *kept = arena_copy(arena, &object, sizeof object);
    return shape_prepare(NULL, kept, NULL, arena);
}

#endif
