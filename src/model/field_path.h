// SPDX-License-Identifier: MIT
// Where a value stands in a scene, for messages: "textures[3].layers[0].finish.roughness". Paths
// are chains of small structs on the C stack, so that naming a place costs nothing until something
// is wrong there.
#ifndef MODEL_FIELD_PATH_H
#define MODEL_FIELD_PATH_H

#include <stdint.h>

typedef struct FieldPath {
    const struct FieldPath *up; // NULL: top level
    const char *name;           // NULL: only an index, "points[2][3]"
    int64_t index;              // < 0: none
} FieldPath;

static inline FieldPath path_field(const FieldPath *up, const char *name) {
    return (FieldPath){up, name, -1};
}
static inline FieldPath path_item(const FieldPath *up, const char *name, uint32_t index) {
    return (FieldPath){up, name, (int64_t)index};
}

// Dies with "FILE: PATH: message"; path may be NULL.
_Noreturn void path_die(const char *file, const FieldPath *path, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
