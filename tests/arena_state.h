// SPDX-License-Identifier: MIT
// Tests whose state is an arena of their own.
#ifndef TESTS_ARENA_STATE_H
#define TESTS_ARENA_STATE_H

#include "base/arena.h"

static int create_arena(void **state) {
    *state = arena_create();
    return 0;
}

static int destroy_arena(void **state) {
    arena_destroy(*state);
    return 0;
}

#define ARENA_TEST(function) cmocka_unit_test_setup_teardown(function, create_arena, destroy_arena)

#endif
