// SPDX-License-Identifier: MIT
// Scenes built by hand for tests of the World, with every leaf also prepared on its own.
#ifndef TESTS_WORLD_STAGE_H
#define TESTS_WORLD_STAGE_H

#include "base/array.h"
#include "render/world.h"
#include "shape/shape.h"

typedef struct {
    Arena *arena;
    ARRAY(Object) objects;
    ARRAY(uint32_t) roots, definitions;
    Scene scene;
    Shape *shapes;      // of every leaf; NULL unless asked for
    PatchSet **patches; // one for every patch; NULL unless asked for
    World *world;
} Stage;

extern const PatchSetOptions STAGE_FACETS; // POV-Ray's triangles

Stage stage_begin(void);
uint32_t stage_put(Stage *stage, const Object *object); // returns its index
uint32_t stage_put_group(Stage *stage, ObjectType type, const uint32_t *items, uint32_t count);
void stage_put_root(Stage *stage, uint32_t index);
// Makes the world; parts: shapes and patches too.
void stage_ready(Stage *stage, bool parts);
void stage_end(Stage *stage);

bool stage_is_group(const Object *object); // a union or a merge
Object stage_sphere(Vec3 center, double radius);
Object stage_box(Vec3 low, Vec3 high);
// A flat patch over the unit square at the given z: u along x, v along y, uv without uv_vectors.
Object stage_flat_patch(Stage *stage, double z);

#endif
