// SPDX-License-Identifier: MIT
#include "tests/world_stage.h"

const PatchSetOptions STAGE_FACETS = {.method = METHOD_FACETS, .tolerance = 1e-9};

Stage stage_begin(void) { return (Stage){.arena = arena_create()}; }

uint32_t stage_put(Stage *stage, const Object *object) {
    array_push(&stage->objects, *object);
    return (uint32_t)stage->objects.count - 1;
}

uint32_t stage_put_group(Stage *stage, ObjectType type, const uint32_t *items, uint32_t count) {
    Object object = {.type = type};
    object.shape.children.items = arena_copy(stage->arena, items, count * sizeof *items);
    object.shape.children.count = count;
    return stage_put(stage, &object);
}

void stage_put_root(Stage *stage, uint32_t index) { array_push(&stage->roots, index); }

static PatchSet *single_patch(const Object *object, uint32_t id) {
    const PatchShape *patch = &object->shape.patch;
    PatchDef def = {.degree_u = patch->degree_u,
                    .degree_v = patch->degree_v,
                    .points = patch->points,
                    .id = id,
                    .mask = RAY_ALL,
                    .flatness = patch->flatness,
                    .u_steps = patch->u_steps,
                    .v_steps = patch->v_steps};
    PatchSet *set = patchset_create(&STAGE_FACETS);
    patchset_add(set, &def);
    patchset_commit(set);
    return set;
}

void stage_ready(Stage *stage, bool parts) {
    stage->scene = (Scene){.objects = stage->objects.items,
                           .object_count = (uint32_t)stage->objects.count,
                           .roots = stage->roots.items,
                           .root_count = (uint32_t)stage->roots.count,
                           .definitions = stage->definitions.items,
                           .definition_count = (uint32_t)stage->definitions.count};
    stage->world = world_create(&stage->scene, &STAGE_FACETS);
    if (!parts)
        return;
    size_t n = stage->objects.count;
    stage->shapes = ARENA_ARRAY(stage->arena, Shape, n);
    stage->patches = ARENA_ARRAY(stage->arena, PatchSet *, n);
    for (uint32_t i = 0; i < n; i++) {
        stage->shapes[i] =
            shape_prepare(&stage->scene, &stage->objects.items[i], NULL, stage->arena);
        if (stage->objects.items[i].type == OBJECT_PATCH)
            stage->patches[i] = single_patch(&stage->objects.items[i], i);
    }
}

void stage_end(Stage *stage) {
    world_destroy(stage->world);
    for (size_t i = 0; stage->patches && i < stage->objects.count; i++)
        if (stage->patches[i])
            patchset_destroy(stage->patches[i]);
    array_free(&stage->objects);
    array_free(&stage->roots);
    array_free(&stage->definitions);
    arena_destroy(stage->arena);
}

bool stage_is_group(const Object *object) { return object_is_tree(object); }

Object stage_sphere(Vec3 center, double radius) {
    return (Object){.type = OBJECT_SPHERE, .shape.sphere = {center, radius}};
}

Object stage_box(Vec3 low, Vec3 high) {
    return (Object){.type = OBJECT_BOX, .shape.box = {low, high}};
}

Object stage_flat_patch(Stage *stage, double z) {
    Object object = {.type = OBJECT_PATCH};
    PatchShape *patch = &object.shape.patch;
    *patch = (PatchShape){.degree_u = 3, .degree_v = 3, .u_steps = 1, .v_steps = 1};
    patch->points = ARENA_ARRAY(stage->arena, Vec3, 16);
    for (int i = 0; i < 16; i++)
        patch->points[i] = vec3(i / 4 / 3.0, i % 4 / 3.0, z);
    patch->uv[1] = (Vec2){1, 0}, patch->uv[2] = (Vec2){1, 1}, patch->uv[3] = (Vec2){0, 1};
    return object;
}
