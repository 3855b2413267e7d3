// SPDX-License-Identifier: MIT
// From the scene's trees to what rays meet. Every leaf is on its own, in the order of the source;
// what the trees around it hide is asked of csg.c hit by hit. The patches go to a PatchSet, which
// is an item of the tree of boxes like each bounded primitive (or one that a tree bounds) and each
// instance; planes are tried by every ray.
//
// Flags as POV-Ray keeps them: a tree other than a plain union at top level casts a shadow as a
// whole, by its own no_shadow. Inside it a merge heeds no_image and no_reflection of its children,
// a union no_reflection, and no_image but for rays straight from the camera (measured), an
// intersection neither.
#include "render/world_data.h"

#include "base/array.h"

// A box of more than this volume is infinite to POV-Ray, and is tried before all others.
static const double INFINITE_VOLUME = 2e10;
// Fewer objects than this, lights counted, are tried in the order of the source by POV-Ray.
enum { BOUNDING_THRESHOLD = 3 };

static const Box EVERYWHERE = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};

// What POV-Ray has as one object: the leaves from `first` to that of the next frame.
typedef struct {
    uint32_t object, first;
} Frame;

typedef struct {
    World *world;
    ARRAY(Leaf) leaves;
    ARRAY(Frame) frames;
} Maker;

typedef struct {
    uint32_t frame;  // the outermost tree around that is one object to POV-Ray, or NO_INDEX
    uint32_t parent; // object, or NO_INDEX
    uint32_t blind;  // bits of the rays that some child around is hidden from
} Place;

// Are its hits put on a stack of their own?
static bool has_stack(const Object *object) {
    return object->type != OBJECT_UNION || object->clips.count > 0;
}

static bool is_frame(const Object *object) { return has_stack(object) || object->whole; }

// Bits of the rays that pass by the object for its flags, where it stands.
static uint32_t blind_to(const Scene *scene, const Object *object, const Place *place) {
    uint32_t image = object->no_image ? RAY_IMAGE : 0;
    uint32_t reflection = object->no_reflection ? RAY_REFLECTION : 0;
    if (place->frame == NO_INDEX)
        return is_frame(object) ? image | reflection | (object->no_shadow ? RAY_SHADOW : 0) : 0;
    switch (scene->objects[place->parent].type) {
    case OBJECT_MERGE:
        return image | reflection;
    case OBJECT_UNION:
        return (image & ~(uint32_t)RAY_CAMERA) | reflection;
    default:
        return 0;
    }
}

// The most that rows 0 to 2 of m stretch a length: the root of a bound on the eigenvalues of m
// times its transpose (Gershgorin), which is exact for turned and evenly scaled spaces.
static double stretch_of(const double m[4][4]) {
    double most = 0.0;
    for (int i = 0; i < 3; i++) {
        double sum = 0.0;
        for (int j = 0; j < 3; j++)
            sum += fabs(m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2]);
        most = fmax(most, sum);
    }
    return sqrt(most);
}

// A ray's origin and direction are taken into the definition's space, and a depth back. Each
// number is a sum of four products: 8 roundings of 2^-53 of the largest of them, which in the world
// is as much larger as the way back stretches.
static void add_instance(Maker *maker, uint32_t index, uint32_t position) {
    World *world = maker->world;
    const Object *object = &world->scene->objects[index];
    Instance *instance = ARENA_NEW(world->arena, Instance);
    instance->world = world->definitions[object->shape.instance.definition];
    instance->stretch = 1.0;
    if (object->has_transform) {
        const Transform *t = instance->transform = &object->transform;
        const double *away = t->inv[3];
        instance->stretch = stretch_of(t->m);
        double unit = 8.0 * 0x1p-53 * instance->stretch;
        instance->slack[0] = unit * stretch_of(t->inv);
        instance->slack[1] = unit * (fabs(away[0]) + fabs(away[1]) + fabs(away[2]));
    }
    array_push(&maker->leaves, ((Leaf){.object = index,
                                       .position = position,
                                       .mask = RAY_ALL,
                                       .node = NO_INDEX,
                                       .gate = NO_INDEX,
                                       .cut = NO_INDEX,
                                       .instance = instance}));
}

// An infinite surface whose roots cost much, where trees around let it be seen only here.
static const Box *span_of(const Csg *csg, uint32_t node) {
    if (node == NO_INDEX || csg->nodes[node].object->type != OBJECT_POLY)
        return NULL;
    const Box *reach = &csg->nodes[node].reach;
    return vec_is_finite(reach->low) && vec_is_finite(reach->high) ? reach : NULL;
}

static void add_object(Maker *maker, uint32_t index, Place place) {
    World *world = maker->world;
    const Object *object = &world->scene->objects[index];
    uint32_t first = (uint32_t)maker->leaves.count;
    place.blind |= blind_to(world->scene, object, &place);
    if (place.frame == NO_INDEX && (is_frame(object) || object->type == OBJECT_INSTANCE)) {
        place.frame = index;
        array_push(&maker->frames, ((Frame){index, first}));
    }
    if (object_is_tree(object)) {
        place.parent = index;
        for (uint32_t i = 0; i < object->shape.children.count; i++)
            add_object(maker, object->shape.children.items[i], place);
        return;
    }
    if (object->type == OBJECT_INSTANCE) {
        add_instance(maker, index, first);
        return;
    }
    uint32_t node = world->csg.of_object[index];
    Leaf leaf = {.object = index,
                 .position = first,
                 .mask = RAY_ALL & ~place.blind,
                 .node = node,
                 .gate = node == NO_INDEX ? NO_INDEX : world->csg.nodes[node].gate,
                 .watched = node != NO_INDEX && csg_is_watched(&world->csg, node),
                 .cut = csg_cut_tree(&world->csg, node),
                 .span = span_of(&world->csg, node)};
    leaf.watched = leaf.watched || leaf.gate != NO_INDEX;
    array_push(&maker->leaves, leaf);
}

static Box moved_box(const Transform *t, Box box) {
    if (!t || !(box.low.x <= box.high.x))
        return box;
    if (!vec_is_finite(box.low) || !vec_is_finite(box.high))
        return EVERYWHERE;
    Box out = box_empty();
    for (int corner = 0; corner < 8; corner++)
        out = box_extend(out, transform_point(t, vec3(corner & 1 ? box.high.x : box.low.x,
                                                      corner & 2 ? box.high.y : box.low.y,
                                                      corner & 4 ? box.high.z : box.low.z)));
    return out;
}

static Box bounds_of(const World *world, const Leaf *leaf) {
    if (leaf->instance)
        return moved_box(leaf->instance->transform, leaf->instance->world->bounds);
    if (leaf->node != NO_INDEX)
        return world->csg.nodes[leaf->node].reach;
    return patch_shape_box(&world->scene->objects[leaf->object].shape.patch);
}

static bool is_empty(const Box *box) {
    return !(box->low.x <= box->high.x && box->low.y <= box->high.y && box->low.z <= box->high.z);
}

static bool is_bounded(const Box *box) {
    return vec_is_finite(box->low) && vec_is_finite(box->high);
}

// Of hits at the same depth POV-Ray takes the first it looks at. It stacks the hits of a tree child
// by child and looks at the last one first; every tree inside a tree, but a plain union, turns the
// order of its hits round once more. Hands out ranks in the order of looking.
static void rank_tree(World *world, uint32_t index, bool reversed, uint32_t *of_object,
                      uint32_t *next) {
    const Object *object = &world->scene->objects[index];
    if (!object_is_tree(object)) {
        bool instance = object->type == OBJECT_INSTANCE;
        of_object[index] = *next;
        *next += instance ? world->definitions[object->shape.instance.definition]->leaf_count : 1;
        return;
    }
    const ObjectList *list = &object->shape.children;
    for (uint32_t i = 0; i < list->count; i++)
        rank_tree(world, list->items[reversed ? list->count - 1 - i : i],
                  has_stack(object) ? !reversed : reversed, of_object, next);
}

// All leaves, those of instances counted.
static uint32_t rank_count(const World *world) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < world->leaf_count; i++)
        count += world->leaves[i].instance ? world->leaves[i].instance->world->leaf_count : 1;
    return count;
}

// Infinite objects come first at equal depth, then the order of the source. The leaves of an
// instance follow its own rank.
static void rank_leaves(World *world, const Maker *maker, const Box *boxes) {
    size_t frame_count = maker->frames.count;
    uint32_t next = 0, ranks = rank_count(world);
    Arena *scratch = arena_create();
    uint32_t *order = ARENA_ARRAY(scratch, uint32_t, world->scene->object_count);
    world->in_order = frame_count + world->scene->light_count >= BOUNDING_THRESHOLD;
    for (size_t f = 0; f < frame_count; f++) {
        uint32_t first = maker->frames.items[f].first;
        uint32_t end = f + 1 < frame_count ? maker->frames.items[f + 1].first : world->leaf_count;
        Box box = box_empty();
        for (uint32_t i = first; i < end; i++)
            box = box_union(box, boxes[i]);
        Vec3 size = vec_sub(box.high, box.low);
        bool infinite = !is_bounded(&box) || size.x * size.y * size.z > INFINITE_VOLUME;
        bool later = world->in_order && !infinite && !world->inner;
        rank_tree(world, maker->frames.items[f].object, true, order, &next);
        for (uint32_t i = first; i < end; i++)
            world->leaves[i].rank = order[world->leaves[i].object] + (later ? ranks : 0);
    }
    arena_destroy(scratch);
}

static void add_patches(World *world, const PatchSetOptions *options) {
    const Scene *scene = world->scene;
    for (uint32_t i = 0; i < world->leaf_count; i++) {
        const Leaf *leaf = &world->leaves[i];
        const Object *object = &scene->objects[leaf->object];
        if (object->type != OBJECT_PATCH)
            continue;
        PatchSet **set = leaf->watched ? &world->filtered : &world->patches;
        if (!*set)
            *set = patchset_create(options);
        const PatchShape *patch = &object->shape.patch;
        PatchDef def = {.degree_u = patch->degree_u,
                        .degree_v = patch->degree_v,
                        .points = patch->points,
                        .weights = patch->weights,
                        .id = leaf->position,
                        .mask = leaf->mask,
                        .flatness = patch->flatness,
                        .u_steps = patch->u_steps,
                        .v_steps = patch->v_steps};
        world->leaves[i].tolerance = patchset_tolerance(options, patch_shape_box(patch));
        patchset_add(*set, &def);
    }
    if (world->patches)
        patchset_commit(world->patches);
    if (world->filtered)
        patchset_commit(world->filtered);
}

// What least depths are measured by.
static void measure_patches(World *world, PatchMethod method) {
    Box box = box_empty();
    if (world->patches)
        box = box_union(box, patchset_bounds(world->patches));
    if (world->filtered)
        box = box_union(box, patchset_bounds(world->filtered));
    for (uint32_t i = 0; i < world->leaf_count; i++) {
        const Instance *instance = world->leaves[i].instance;
        if (instance && instance->world->size > 0.0)
            box = box_union(box, moved_box(instance->transform, instance->world->bounds));
    }
    bool any = box.low.x <= box.high.x;
    world->size = any ? vec_length(vec_sub(box.high, box.low)) : 0.0;
    world->packets = method == METHOD_QI;
    world->exact = method != METHOD_FACETS && method != METHOD_TESSELLATION;
    bool tiny = world->exact && world->size > 0.0 && world->size < 0.05;
    world->unit = tiny ? 0.25 * world->size : 1.0;
}

static const Shape *shape_of(const World *world, uint32_t leaf) {
    uint32_t node = world->leaves[leaf].node;
    return node == NO_INDEX ? NULL : world->csg.nodes[node].shape;
}

// Where the leaf is inside, as far as the trees around can let that be.
static Box fill_box(const Csg *csg, uint32_t node) {
    Box box = csg->nodes[node].inside;
    for (uint32_t t = csg->nodes[node].parent; t != NO_INDEX; t = csg->nodes[t].parent) {
        box.low = vec_max(box.low, csg->nodes[t].inside.low);
        box.high = vec_min(box.high, csg->nodes[t].inside.high);
    }
    return box;
}

// Around all patches, and their hits.
static Box patch_box(const World *world) {
    Box box = box_empty();
    double most = 0.0;
    if (world->patches)
        box = box_union(box, patchset_bounds(world->patches));
    if (world->filtered)
        box = box_union(box, patchset_bounds(world->filtered));
    for (uint32_t i = 0; i < world->leaf_count; i++)
        most = fmax(most, world->leaves[i].tolerance);
    Vec3 by = vec3(most, most, most);
    return (Box){vec_sub(box.low, by), vec_add(box.high, by)};
}

// Puts the primitives in the tree's order, those without a box behind them. What cannot be seen is
// left out.
static void add_prims(World *world, const Box *boxes) {
    uint32_t n = world->leaf_count, bounded = 0, count = 0;
    Arena *scratch = arena_create();
    uint32_t *order = ARENA_ARRAY(scratch, uint32_t, n + 1);
    uint32_t *wide = ARENA_ARRAY(scratch, uint32_t, n);
    Box *tree_boxes = ARENA_ARRAY(scratch, Box, n + 1);
    for (uint32_t i = 0; i < n; i++) {
        const Shape *shape = shape_of(world, i);
        bool there = world->leaves[i].instance || (shape && shape->kind != SHAPE_NONE);
        if (!there || is_empty(&boxes[i]))
            continue;
        // Boxes of instances are rounded like points.
        world->bounds = box_union(world->bounds, boxes[i]);
        if (is_bounded(&boxes[i]))
            tree_boxes[bounded] = boxes[i], order[bounded++] = i;
        else
            wide[count++] = i;
    }
    world->patches_in_tree = bounded > 0 && (world->patches || world->filtered);
    if (world->patches_in_tree)
        tree_boxes[bounded] = patch_box(world), order[bounded++] = n;
    for (uint32_t i = 0; i < count; i++)
        order[bounded + i] = wide[i];
    count += bounded;
    world->tree = bvh_build(tree_boxes, bounded, world->arena);
    world->prims = ARENA_ARRAY(world->arena, Prim, count);
    world->boundless = ARENA_ARRAY(world->arena, uint32_t, count);
    world->boundless_boxes = ARENA_ARRAY(world->arena, Box, count);
    world->tree_count = bounded;
    world->prim_count = count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t leaf = order[i < bounded ? world->tree.items[i] : i];
        if (leaf == n) {
            world->prims[i] = (Prim){{.kind = SHAPE_NONE}, {.mask = RAY_ALL}};
            continue;
        }
        const Shape *shape = shape_of(world, leaf);
        if (!shape) {
            world->prims[i] = (Prim){{.kind = SHAPE_NONE}, world->leaves[leaf]};
            if (world->leaves[leaf].instance->world->boundless_count > 0) {
                world->boundless_boxes[world->boundless_count] = EVERYWHERE;
                world->boundless[world->boundless_count++] = i;
            }
            continue;
        }
        world->prims[i] = (Prim){*shape, world->leaves[leaf]};
        bool in_tree = i < bounded && shape_inside_bounded(shape);
        if (shape_has_inside(shape) && !in_tree) {
            world->boundless_boxes[world->boundless_count] =
                fill_box(&world->csg, world->leaves[leaf].node);
            world->boundless[world->boundless_count++] = i;
        }
    }
    arena_destroy(scratch);
}

static void fill(World *world, const uint32_t *roots, uint32_t root_count,
                 const PatchSetOptions *patches) {
    Arena *scratch = arena_create();
    Maker maker = {.world = world};
    for (uint32_t i = 0; i < root_count; i++)
        add_object(&maker, roots[i], (Place){NO_INDEX, NO_INDEX, 0});
    uint32_t n = world->leaf_count = (uint32_t)maker.leaves.count;
    world->leaves = arena_copy(world->arena, maker.leaves.items, n * sizeof(Leaf));
    Box *boxes = ARENA_ARRAY(scratch, Box, n);
    for (uint32_t i = 0; i < n; i++)
        boxes[i] = bounds_of(world, &world->leaves[i]);
    world->bounds = box_empty();
    rank_leaves(world, &maker, boxes);
    add_patches(world, patches);
    measure_patches(world, patches->method);
    add_prims(world, boxes);
    if (world->size > 0.0)
        for (uint32_t i = 0; i < n; i++)
            if (world->scene->objects[world->leaves[i].object].type == OBJECT_PATCH)
                world->bounds = box_union(world->bounds, boxes[i]);
    array_free(&maker.leaves);
    array_free(&maker.frames);
    arena_destroy(scratch);
}

// Tolerances of a definition's patches: what the most demanding instance asks for.
typedef struct {
    const Scene *scene;
    const PatchSetOptions *options;
    uint32_t definition;
} InnerTolerance;

static double inner_tolerance(const void *context, Box bounds) {
    const InnerTolerance *inner = context;
    const Scene *scene = inner->scene;
    double least = INFINITY;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        if (object->type != OBJECT_INSTANCE ||
            object->shape.instance.definition != inner->definition)
            continue;
        const Transform *t = object->has_transform ? &object->transform : NULL;
        double there = inner->options->tolerance_of(inner->options->context, moved_box(t, bounds));
        if (!(there > 0.0))
            return 0.0;
        least = fmin(least, t ? there / stretch_of(t->m) : there);
    }
    return isfinite(least) ? least : 0.0;
}

static World *create_inner(const World *world, uint32_t index, const PatchSetOptions *patches) {
    World *part = ARENA_NEW(world->arena, World);
    const InnerTolerance tolerance = {world->scene, patches, index};
    PatchSetOptions options = *patches;
    if (options.tolerance_of) {
        options.tolerance_of = inner_tolerance;
        options.context = &tolerance;
    }
    *part = (World){.arena = world->arena, .scene = world->scene, .csg = world->csg, .inner = true};
    fill(part, &world->scene->definitions[index], 1, &options);
    return part;
}

World *world_create(const Scene *scene, const PatchSetOptions *patches) {
    Arena *arena = arena_create();
    World *world = ARENA_NEW(arena, World);
    world->arena = arena;
    world->scene = scene;
    world->csg = csg_create(scene, patches, arena);
    world->definitions = ARENA_ARRAY(arena, World *, scene->definition_count);
    world->definition_count = scene->definition_count;
    for (uint32_t i = 0; i < scene->definition_count; i++)
        world->definitions[i] = create_inner(world, i, patches);
    fill(world, scene->roots, scene->root_count, patches);
    return world;
}

void world_use_functions(const World *world, const FunctionPool *functions) {
    shape_shared_functions(world->csg.shared, functions);
}

void world_without_uv(World *world) { world->without_uv = true; }

static void destroy_patches(World *world) {
    if (world->patches)
        patchset_destroy(world->patches);
    if (world->filtered)
        patchset_destroy(world->filtered);
}

static uint64_t patch_memory(const World *world) {
    return (world->patches ? patchset_memory(world->patches) : 0) +
           (world->filtered ? patchset_memory(world->filtered) : 0);
}

void world_destroy(World *world) {
    if (!world)
        return;
    for (uint32_t i = 0; i < world->definition_count; i++)
        destroy_patches(world->definitions[i]);
    destroy_patches(world);
    csg_destroy(&world->csg);
    arena_destroy(world->arena);
}

uint64_t world_memory(const World *world) {
    uint64_t bytes = arena_bytes(world->arena) + patch_memory(world) + csg_memory(&world->csg);
    for (uint32_t i = 0; i < world->definition_count; i++)
        bytes += patch_memory(world->definitions[i]);
    return bytes;
}
