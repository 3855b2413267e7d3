// SPDX-License-Identifier: MIT
#include "model/file_path.h"

#include "base/file.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_PARTS = 256 };

typedef struct {
    const char *names[MOST_PARTS];
    int count;
} Parts;

// "." is dropped and ".." takes back the name before. False: too many.
static bool split(Parts *parts, char *path) {
    char *save = NULL;
    for (char *name = strtok_r(path, "/", &save); name; name = strtok_r(NULL, "/", &save)) {
        if (strcmp(name, ".") == 0)
            continue;
        if (strcmp(name, "..") == 0) {
            parts->count -= parts->count > 0;
            continue;
        }
        if (parts->count == MOST_PARTS)
            return false;
        parts->names[parts->count++] = name;
    }
    return true;
}

static char *absolute(Arena *arena, const char *path) {
    char *here = path[0] == '/' ? NULL : getcwd(NULL, 0);
    char *whole = arena_printf(arena, "%s/%s", here ? here : "", path);
    free(here);
    return whole;
}

char *path_from_file(Arena *arena, const char *path, const char *file) {
    Parts to = {.count = 0}, from = {.count = 0};
    if (path[0] == '/' || !split(&to, absolute(arena, path)) ||
        !split(&from, absolute(arena, file)))
        return arena_strdup(arena, path);
    int shared = 0, folders = from.count - 1;
    while (shared < folders && shared < to.count - 1 &&
           strcmp(to.names[shared], from.names[shared]) == 0)
        shared++;
    char *out = arena_strdup(arena, "");
    for (int i = shared; i < folders; i++)
        out = arena_printf(arena, "%s../", out);
    for (int i = shared; i < to.count; i++)
        out = arena_printf(arena, "%s%s%s", out, to.names[i], i + 1 < to.count ? "/" : "");
    return out;
}

char *path_beside_file(Arena *arena, const char *path, const char *file) {
    if (path[0] == '/')
        return arena_strdup(arena, path);
    return arena_printf(arena, "%.*s%s", (int)(file_name(file) - file), file, path);
}
