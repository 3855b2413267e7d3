// SPDX-License-Identifier: MIT
// Inside the room: what scene_validate.c and check_texture.c share. Each function dies naming the
// field when the value is not what the renderer relies on.
#ifndef MODEL_CHECK_H
#define MODEL_CHECK_H

#include "model/field_path.h"
#include "model/scene.h"

// Coordinates may be as large as a product of crossed vectors, squared, still fits a double:
// |a x b|^2 <= 4 (1e60)^4 = 4e240 < 1e308.
#define MAX_COORDINATE 1e60

// Records that refer to each other.
typedef struct {
    const char *name; // of one
    uint32_t count;
    uint8_t *met;     // per record: 0 not yet, 1 on the way down, 2 good
    double *cost;     // of the good ones
    uint8_t *nesting; // how many functions lie inside one another in it
} CheckPool;

typedef struct {
    const Scene *scene;
    const char *file;
    const uint32_t *positions;
    bool *met; // per object: already part of a tree
    CheckPool pigments, normals, textures, functions, projections;
    uint8_t *calls; // per function: levels of calls
    Arena *scratch;
} Check;

// The record has another with that nesting in it.
static inline void check_nest(const CheckPool *pool, uint32_t index, uint8_t nesting) {
    if (pool->nesting[index] < nesting)
        pool->nesting[index] = nesting;
}

#define refuse(c, path, ...) path_die((c)->file, path, __VA_ARGS__)

void check_numbers(const Check *c, const FieldPath *up, const char *name, const double *values,
                   int count);
void check_floats(const Check *c, const FieldPath *up, const char *name, const float *values,
                  int count);
void check_float(const Check *c, const FieldPath *up, const char *name, float value);
void check_rgb(const Check *c, const FieldPath *up, const char *name, Rgb value);
void check_color(const Check *c, const FieldPath *up, const char *name, Color value);
void check_vec3(const Check *c, const FieldPath *up, const char *name, Vec3 value);
void check_unit(const Check *c, const FieldPath *up, const char *name, Vec3 value);
void check_size(const Check *c, const FieldPath *up, const char *name, double value);
void check_not_zero(const Check *c, const FieldPath *up, const char *name, double value);
void check_range(const Check *c, const FieldPath *up, const char *name, int value, int low,
                 int high);
void check_index(const Check *c, const FieldPath *path, uint32_t index, uint32_t count,
                 const char *what);
void check_transform(const Check *c, const FieldPath *up, const char *name, const Transform *t);

// check_solid.c: what the larger primitives are made of, and the pools they refer to.
void check_solid(const Check *c, const FieldPath *path, const Object *object);
void check_solid_pools(const Check *c);
// For a pattern of what is inside projection number `index`, a good tree: dies if the functions of
// its surfaces lead back to it; returns how many functions lie inside one another there.
uint8_t check_projection_use(const Check *c, const FieldPath *path, uint32_t index, int depth);

// check_texture.c
void check_texture_pools(const Check *c);
void check_pigment(const Check *c, const FieldPath *path, uint32_t index, int depth);
void check_turbulence(const Check *c, const FieldPath *path, const Turbulence *turbulence);

// check_function.c: that the machine of src/function/ can run them: every register in range and
// written before it is read, jumps that end, room for all calls.
void check_functions(const Check *c);
// For whoever holds the index of a function: dies unless there is one; returns how many functions
// lie inside one another in its pigments, itself among them if it has one.
uint8_t check_function_use(const Check *c, const FieldPath *path, uint32_t function, int depth);
void check_function_uses(const Check *c); // of all

#endif
