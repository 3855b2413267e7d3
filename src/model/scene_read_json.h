// SPDX-License-Identifier: MIT
// Inside the room: JSON values into the members of structs, each refused by its path when it is not
// what the tables say.
#ifndef MODEL_SCENE_READ_JSON_H
#define MODEL_SCENE_READ_JSON_H

#include "model/field_path.h"
#include "model/scene_binary.h"
#include "model/scene_fields.h"

#include <jansson.h>

typedef struct {
    const char *file;
    Arena *arena, *scratch; // the scene's; what is gone after reading
    Scene *scene;
    json_t *root;
    Mapping *buffers;
    uint32_t buffer_count;
    uint64_t patch_budget; // how many patches of runs the buffers can still hold
    uint32_t object_count; // numbered so far
    uint32_t *positions;   // per object: which entry of its list it is
} Reader;

// Dies unless the value is of that type.
void read_expect(const Reader *r, const FieldPath *path, const json_t *value, json_type type);
// A whole number low..high; written with or without a fraction of zero.
uint64_t read_whole(const Reader *r, const FieldPath *path, const json_t *value, uint64_t low,
                    uint64_t high);
// An array of exactly count numbers.
void read_doubles(const Reader *r, const FieldPath *path, const json_t *value, double *out,
                  int count);
// Dies if the object has a key that is neither a field of record (may be NULL) nor in also (ended
// by NULL).
void read_only_keys(const Reader *r, const FieldPath *path, json_t *object, const Record *record,
                    const char *const *also);
// Fills the struct at `at`, which holds its defaults, from an object; also: the keys that the
// caller reads itself.
void read_record(const Reader *r, const FieldPath *path, json_t *object, const Record *record,
                 void *at, const char *const *also);

#endif
