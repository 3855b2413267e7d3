// SPDX-License-Identifier: MIT
// A folder of a test's own below /tmp, and an arena; both are gone after the test. root is the
// folder that the tests run in.
#ifndef TESTS_OWN_FOLDER_H
#define TESTS_OWN_FOLDER_H

#include "base/arena.h"

typedef struct {
    Arena *arena;
    char folder[64], root[512];
} OwnFolder;

// cmocka's setup and teardown; the state is a OwnFolder.
int own_folder_create(void **state);
int own_folder_destroy(void **state);
// The name within the folder.
const char *own_path(const OwnFolder *place, const char *name);

#define OWN_FOLDER_TEST(function)                                                                  \
    cmocka_unit_test_setup_teardown(function, own_folder_create, own_folder_destroy)

#endif
