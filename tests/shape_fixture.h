// SPDX-License-Identifier: MIT
// Shapes made in a test, in the arena of its group.
#ifndef TESTS_SHAPE_FIXTURE_H
#define TESTS_SHAPE_FIXTURE_H

#include "group_arena.h"
#include "shape/shape.h"

static Shape prepare(Object object) {
    Object *kept = arena_copy(arena, &object, sizeof object);
    return shape_prepare(NULL, kept, NULL, arena);
}

#endif
