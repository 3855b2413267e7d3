// SPDX-License-Identifier: MIT
// From the scene's trees to what rays meet. Unions only group, so every leaf is on its own, in the
// order of the source; a merge drops the hits of a child that lie inside another child of it. The
// patches go to a PatchSet, bounded primitives to a tree of boxes, planes are tried by every ray.
//
// Flags as POV-Ray keeps them (measured): a merge casts a shadow as a whole, by its own no_shadow;
// no_image of a leaf counts unless its parent is a union inside a merge; no_reflection always.
#include "render/world_data.h"

#include "base/array.h"
#include "base/diag.h"

enum { MAX_NESTING = 200 };

// A box of more than this volume is infinite to POV-Ray, and is tried before all others.
static const double INFINITE_VOLUME = 2e10;
// Fewer objects than this, lights counted, are tried in the order of the source by POV-Ray.
enum { BOUNDING_THRESHOLD = 3 };

typedef struct {
    World *world;
    ARRAY(Leaf) leaves;
    ARRAY(Filter) filters;
    ARRAY(uint32_t) frames; // position of the first leaf of each object that POV-Ray has on its own
} Maker;

typedef struct {
    uint32_t merge;  // the outermost merge around, or NO_INDEX
    uint32_t filter; // of the innermost merge around, or NO_INDEX
    bool in_union;   // the parent is a union
    int depth;
} Place;

static uint32_t mask_of(const Scene *scene, const Object *object, const Place *place) {
    const Object *merge = place->merge == NO_INDEX ? NULL : &scene->objects[place->merge];
    bool no_image = object->no_image, no_shadow = object->no_shadow;
    bool no_reflection = object->no_reflection;
    if (merge) {
        no_image = merge->no_image || (no_image && !place->in_union);
        no_shadow = merge->no_shadow;
        no_reflection = no_reflection || merge->no_reflection;
    }
    return (no_image ? 0 : RAY_CAMERA) | (no_reflection ? 0 : RAY_REFLECTION) |
           (no_shadow ? 0 : RAY_SHADOW);
}

static void add_object(Maker *maker, uint32_t index, Place place);

static void add_merge(Maker *maker, uint32_t index, Place place) {
    const Object *object = &maker->world->scene->objects[index];
    uint32_t outer = place.filter, first = (uint32_t)maker->leaves.count;
    uint32_t first_filter = (uint32_t)maker->filters.count,
             child_count = object->shape.children.count;
    if (place.merge == NO_INDEX)
        place.merge = index;
    place.in_union = false;
    for (uint32_t i = 0; i < child_count; i++)
        array_push(&maker->filters, ((Filter){.first = first, .outer = outer}));
    for (uint32_t i = 0; i < child_count; i++) {
        place.filter = first_filter + i;
        uint32_t own_first = (uint32_t)maker->leaves.count;
        add_object(maker, object->shape.children.items[i], place);
        maker->filters.items[place.filter].own_first = own_first;
        maker->filters.items[place.filter].own_end = (uint32_t)maker->leaves.count;
    }
    for (uint32_t i = 0; i < child_count; i++)
        maker->filters.items[first_filter + i].end = (uint32_t)maker->leaves.count;
}

static void add_object(Maker *maker, uint32_t index, Place place) {
    const Object *object = &maker->world->scene->objects[index];
    uint32_t first = (uint32_t)maker->leaves.count;
    if (++place.depth > MAX_NESTING)
        die("objects[%u]: more than %d unions and merges inside each other", index, MAX_NESTING);
    if (place.merge == NO_INDEX && object->type != OBJECT_UNION)
        array_push(&maker->frames, first);
    if (object->type == OBJECT_UNION) {
        place.in_union = true;
        for (uint32_t i = 0; i < object->shape.children.count; i++)
            add_object(maker, object->shape.children.items[i], place);
    } else if (object->type == OBJECT_MERGE) {
        add_merge(maker, index, place);
    } else {
        Leaf leaf = {.object = index,
                     .position = first,
                     .mask = mask_of(maker->world->scene, object, &place),
                     .filter = place.filter};
        array_push(&maker->leaves, leaf);
    }
    maker->world->spans[index] = (Span){first, (uint32_t)maker->leaves.count};
}

static Box bounds_of(const Object *object, const Shape *shape) {
    if (object->type != OBJECT_PATCH)
        return shape_bounds(shape);
    const PatchShape *patch = &object->shape.patch;
    Box box = box_empty();
    for (uint32_t i = 0; i < (patch->degree_u + 1) * (patch->degree_v + 1); i++)
        box = box_extend(box, patch->points[i]);
    return box;
}

static bool is_bounded(const Box *box) {
    return vec_is_finite(box->low) && vec_is_finite(box->high);
}

// Infinite objects come first at equal depth, then the order of the source.
static void rank_leaves(World *world, const Maker *maker, const Box *boxes) {
    size_t frame_count = maker->frames.count;
    for (size_t f = 0; f < frame_count; f++) {
        uint32_t first = maker->frames.items[f];
        uint32_t end = f + 1 < frame_count ? maker->frames.items[f + 1] : world->leaf_count;
        Box box = box_empty();
        for (uint32_t i = first; i < end; i++)
            box = box_union(box, boxes[i]);
        Vec3 size = vec_sub(box.high, box.low);
        bool infinite = !is_bounded(&box) || size.x * size.y * size.z > INFINITE_VOLUME;
        bool later = frame_count + world->scene->light_count >= BOUNDING_THRESHOLD && !infinite;
        for (uint32_t i = first; i < end; i++)
            world->leaves[i].rank = i + (later ? world->leaf_count : 0);
    }
}

// Forgets the filters that can hide nothing. solid[i]: leaves before i that have an inside.
static void drop_idle_filters(World *world, const uint32_t *solid) {
    for (uint32_t i = 0; i < world->leaf_count; i++) {
        bool busy = false;
        for (uint32_t f = world->leaves[i].filter; f != NO_INDEX; f = world->filters[f].outer) {
            const Filter *filter = &world->filters[f];
            busy = busy || solid[filter->end] - solid[filter->first] >
                               solid[filter->own_end] - solid[filter->own_first];
        }
        if (!busy)
            world->leaves[i].filter = NO_INDEX;
    }
}

static void add_patches(World *world, const PatchSetOptions *options) {
    const Scene *scene = world->scene;
    for (uint32_t i = 0; i < world->leaf_count; i++) {
        const Leaf *leaf = &world->leaves[i];
        const Object *object = &scene->objects[leaf->object];
        if (object->type != OBJECT_PATCH)
            continue;
        PatchSet **set = leaf->filter == NO_INDEX ? &world->patches : &world->filtered;
        if (!*set)
            *set = patchset_create(options);
        const PatchShape *patch = &object->shape.patch;
        PatchDef def = {.degree_u = patch->degree_u,
                        .degree_v = patch->degree_v,
                        .points = patch->points,
                        .id = leaf->position,
                        .mask = leaf->mask,
                        .flatness = patch->flatness,
                        .u_steps = patch->u_steps,
                        .v_steps = patch->v_steps};
        patchset_add(*set, &def);
    }
    if (world->patches)
        patchset_commit(world->patches);
    if (world->filtered)
        patchset_commit(world->filtered);
}

// Puts the primitives in the tree's order, those without a box behind them.
static void add_prims(World *world, const Shape *shapes, const Box *boxes) {
    uint32_t n = world->leaf_count, bounded = 0, count = 0;
    Arena *scratch = arena_create();
    uint32_t *order = ARENA_ARRAY(scratch, uint32_t, n);
    Box *tree_boxes = ARENA_ARRAY(scratch, Box, n);
    for (uint32_t i = 0; i < n; i++)
        if (shapes[i].kind != SHAPE_NONE && is_bounded(&boxes[i]))
            tree_boxes[bounded] = boxes[i], order[bounded++] = i;
    count = bounded;
    for (uint32_t i = 0; i < n; i++)
        if (shapes[i].kind != SHAPE_NONE && !is_bounded(&boxes[i]))
            order[count++] = i;
    world->tree = bvh_build(tree_boxes, bounded, world->arena);
    world->prims = ARENA_ARRAY(world->arena, Prim, count);
    world->boundless = ARENA_ARRAY(world->arena, uint32_t, count);
    world->tree_count = bounded;
    world->prim_count = count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t leaf = order[i < bounded ? world->tree.items[i] : i];
        world->prims[i] = (Prim){shapes[leaf], world->leaves[leaf]};
        bool in_tree = i < bounded && shape_inside_bounded(&shapes[leaf]);
        if (shape_has_inside(&shapes[leaf]) && !in_tree)
            world->boundless[world->boundless_count++] = i;
    }
    arena_destroy(scratch);
}

World *world_create(const Scene *scene, const PatchSetOptions *patches) {
    Arena *arena = arena_create(), *scratch = arena_create();
    World *world = ARENA_NEW(arena, World);
    world->arena = arena;
    world->scene = scene;
    world->spans = ARENA_ARRAY(arena, Span, scene->object_count);
    Maker maker = {.world = world};
    for (uint32_t i = 0; i < scene->root_count; i++)
        add_object(&maker, scene->roots[i], (Place){NO_INDEX, NO_INDEX, false, 0});
    uint32_t n = world->leaf_count = (uint32_t)maker.leaves.count;
    world->filter_count = (uint32_t)maker.filters.count;
    world->leaves = arena_copy(arena, maker.leaves.items, n * sizeof(Leaf));
    world->filters = arena_copy(arena, maker.filters.items, world->filter_count * sizeof(Filter));

    Shape *shapes = ARENA_ARRAY(scratch, Shape, n);
    Box *boxes = ARENA_ARRAY(scratch, Box, n);
    uint32_t *solid = ARENA_ARRAY(scratch, uint32_t, (size_t)n + 1);
    for (uint32_t i = 0; i < n; i++) {
        const Object *object = &scene->objects[world->leaves[i].object];
        shapes[i] = shape_prepare(object, arena);
        boxes[i] = bounds_of(object, &shapes[i]);
        solid[i + 1] = solid[i] + (shape_has_inside(&shapes[i]) ? 1 : 0);
    }
    rank_leaves(world, &maker, boxes);
    drop_idle_filters(world, solid);
    add_prims(world, shapes, boxes);
    add_patches(world, patches);
    array_free(&maker.leaves);
    array_free(&maker.filters);
    array_free(&maker.frames);
    arena_destroy(scratch);
    return world;
}

void world_destroy(World *world) {
    if (!world)
        return;
    if (world->patches)
        patchset_destroy(world->patches);
    if (world->filtered)
        patchset_destroy(world->filtered);
    arena_destroy(world->arena);
}

uint64_t world_memory(const World *world) {
    uint64_t bytes = arena_bytes(world->arena);
    if (world->patches)
        bytes += patchset_memory(world->patches);
    if (world->filtered)
        bytes += patchset_memory(world->filtered);
    return bytes;
}
