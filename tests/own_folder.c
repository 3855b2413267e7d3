// SPDX-License-Identifier: MIT
#include "own_folder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int own_folder_create(void **state) {
    OwnFolder *place = calloc(1, sizeof *place);
    if (!place)
        return 1;
    place->arena = arena_create();
    strcpy(place->folder, "/tmp/qipov-test-XXXXXX");
    *state = place;
    return mkdtemp(place->folder) && getcwd(place->root, sizeof place->root) ? 0 : 1;
}

int own_folder_destroy(void **state) {
    OwnFolder *place = *state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", place->folder);
    int status = system(command);
    arena_destroy(place->arena);
    free(place);
    return status;
}

const char *own_path(const OwnFolder *place, const char *name) {
    return arena_printf(place->arena, "%s/%s", place->folder, name);
}
