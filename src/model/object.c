// SPDX-License-Identifier: MIT
// POV-Ray 3.7's defaults of objects (see scene.c), and what can be asked of one.
#include "model/object.h"

#include "model/scene.h"

#include <string.h>

static PatchShape patch_default(void) {
    return (PatchShape){
        .degree_u = 3,
        .degree_v = 3,
        .type = 1,
        .uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
    };
}

Object object_default(ObjectType type) {
    const Container unit_container = {.low = {-1, -1, -1}, .high = {1, 1, 1}};
    Object object;
    memset(&object, 0, sizeof object);
    object.type = type;
    object.texture = object.interior_texture = object.interior = NO_INDEX;
    object.transform = transform_identity();
    if (type == OBJECT_PATCH)
        object.shape.patch = patch_default();
    if (type == OBJECT_BLOB)
        object.shape.blob.threshold = 1;
    if (type == OBJECT_SPHERE_SWEEP)
        object.shape.sphere_sweep.tolerance = 1e-6;
    if (type == OBJECT_ISOSURFACE)
        object.shape.isosurface = (IsosurfaceShape){.function = NO_INDEX,
                                                    .container = unit_container,
                                                    .accuracy = 1e-3,
                                                    .max_gradient = 1.1,
                                                    .max_trace = 1};
    if (type == OBJECT_PARAMETRIC)
        object.shape.parametric = (ParametricShape){.functions = {NO_INDEX, NO_INDEX, NO_INDEX},
                                                    .container = unit_container,
                                                    .accuracy = 1e-3,
                                                    .max_gradient = 1,
                                                    .depth = 1};
    return object;
}

bool object_has_space(ObjectType type) {
    return (type >= OBJECT_SPHERE && type <= OBJECT_DISC) ||
           (type >= OBJECT_QUADRIC && type != OBJECT_SMOOTH_TRIANGLE);
}

bool object_is_tree(const Object *object) {
    return object->type == OBJECT_UNION || object->type == OBJECT_MERGE ||
           object->type == OBJECT_INTERSECTION;
}

Box patch_shape_box(const PatchShape *patch) {
    Box box = box_empty();
    for (uint32_t k = 0; k < (patch->degree_u + 1) * (patch->degree_v + 1); k++)
        box = box_extend(box, patch->points[k]);
    return box;
}

// The second of the pair that begins with own, or own.
static uint32_t find_pair(const uint32_t *pairs, uint32_t count, uint32_t own) {
    uint32_t low = 0, high = count; // of the pairs not below own
    while (low < high) {
        uint32_t middle = (low + high) / 2;
        if (pairs[2 * middle] < own)
            low = middle + 1;
        else
            high = middle;
    }
    return low < count && pairs[2 * low] == own ? pairs[2 * low + 1] : own;
}

uint32_t instance_texture(const Object *instance, uint32_t own) {
    const InstanceShape *shape = &instance->shape.instance;
    return own == NO_INDEX ? instance->texture
                           : find_pair(shape->textures, shape->texture_count, own);
}

uint32_t instance_interior(const Object *instance, uint32_t own) {
    const InstanceShape *shape = &instance->shape.instance;
    return own == NO_INDEX ? instance->interior
                           : find_pair(shape->interiors, shape->interior_count, own);
}
