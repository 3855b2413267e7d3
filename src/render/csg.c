// SPDX-License-Identifier: MIT
// Nodes of the trees and their boxes, then the three questions about a point. Boxes only save work:
// inside ones skip what cannot contain a point, reaches keep the tree of boxes of the World small.
#include "render/csg.h"

#include "base/array.h"
#include "base/diag.h"
#include "render/world.h"

static const Box EVERYWHERE = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};

static Box box_common(Box a, Box b) {
    return (Box){vec_max(a.low, b.low), vec_min(a.high, b.high)};
}

static Box widened(Box box) {
    if (!(box.low.x <= box.high.x))
        return box;
    double size = fmax(vec_length(box.low), vec_length(box.high));
    if (!isfinite(size))
        return box;
    double by = SHAPE_WIDER * size;
    return (Box){vec_sub(box.low, vec3(by, by, by)), vec_add(box.high, vec3(by, by, by))};
}

// ---- building -------------------------------------------------------------------------------

typedef struct {
    const Scene *scene;
    Arena *arena;
    const PatchSetOptions *patches;
    ShapeShared *shared;
    uint32_t *of_object;
    ARRAY(CsgNode) nodes;
} Maker;

// Returns the node; NO_INDEX: no object there that needs one. Until narrow_reaches a node's reach
// is the box of its own surface.
static uint32_t make_node(Maker *maker, uint32_t index, uint32_t parent, bool framed, int depth);

// All but what an inverted shape encloses is inside it.
static Box outside_of(const Shape *shape) {
    Shape plain = *shape;
    plain.inverse = false;
    bool encloses = shape->inverse && shape_has_inside(shape) && shape_inside_bounded(&plain);
    return encloses ? widened(shape_bounds(shape)) : EVERYWHERE;
}

static void make_leaf(Maker *maker, CsgNode *node) {
    node->inside = box_empty();
    node->outside = EVERYWHERE;
    if (node->object->type == OBJECT_PATCH) {
        node->reach = widened(patch_shape_box(&node->object->shape.patch));
        return;
    }
    Shape *shape = ARENA_NEW(maker->arena, Shape);
    *shape = shape_prepare(maker->scene, node->object, maker->shared, maker->arena);
    node->shape = shape;
    node->solid = shape_has_inside(shape);
    node->outside = outside_of(shape);
    node->reach = widened(shape_bounds(shape));
    if (node->solid)
        node->inside = shape_inside_bounded(shape) ? node->reach : EVERYWHERE;
}

// A list of objects below `parent`, linked in order; returns the first.
static uint32_t make_list(Maker *maker, const ObjectList *list, uint32_t parent, bool framed,
                          int depth) {
    uint32_t first = NO_INDEX, last = NO_INDEX;
    for (uint32_t i = 0; i < list->count; i++) {
        uint32_t node = make_node(maker, list->items[i], parent, framed, depth);
        if (node == NO_INDEX)
            continue;
        if (last == NO_INDEX)
            first = node;
        else
            maker->nodes.items[last].next = node;
        last = node;
    }
    return first;
}

// The first planes of a list and their nodes; returns how many.
static uint32_t find_planes(const Maker *maker, uint32_t list, PlaneShape planes[SHAPE_MOST_PLANES],
                            uint32_t members[SHAPE_MOST_PLANES]) {
    const CsgNode *nodes = maker->nodes.items;
    uint32_t count = 0;
    for (uint32_t c = list; c != NO_INDEX && count < SHAPE_MOST_PLANES; c = nodes[c].next) {
        if (!nodes[c].shape || nodes[c].shape->kind != SHAPE_PLANE)
            continue;
        members[count] = c;
        planes[count++] = nodes[c].shape->as.plane;
    }
    return count;
}

// Planes of an intersection that enclose something: each is seen only where it is a face of that.
static void narrow_to_faces(Maker *maker, CsgNode *node) {
    PlaneShape planes[SHAPE_MOST_PLANES];
    uint32_t members[SHAPE_MOST_PLANES], count = find_planes(maker, node->first, planes, members);
    CsgNode *nodes = maker->nodes.items;
    Box all, faces[SHAPE_MOST_PLANES];
    if (count < 4 || !shape_planes_box(planes, count, &all, faces))
        return;
    for (uint32_t i = 0; i < count; i++)
        nodes[members[i]].reach = box_common(nodes[members[i]].reach, faces[i]);
    node->inside = box_common(node->inside, all);
    node->reach = box_common(node->reach, all);
}

// What is within all of a list of shapes: planes first, since they bound the quadrics; and those
// twice, since they bound one another.
static void narrow(const Maker *maker, CsgNode *node, uint32_t list) {
    PlaneShape planes[SHAPE_MOST_PLANES];
    uint32_t members[SHAPE_MOST_PLANES], count = find_planes(maker, list, planes, members);
    for (int round = 0; round < 3; round++) {
        for (uint32_t c = list; c != NO_INDEX; c = maker->nodes.items[c].next) {
            const Shape *shape = maker->nodes.items[c].shape;
            if (!shape || !maker->nodes.items[c].solid ||
                (shape->kind == SHAPE_PLANE) != (round == 0))
                continue;
            node->inside = shape_within_planes(shape, planes, count, node->inside);
            node->reach = shape_within_planes(shape, planes, count, node->reach);
        }
    }
}

// What all children together contain, and where their surfaces are. The surface of an intersection
// lies within each child, or on it.
static void join_children(Maker *maker, CsgNode *node) {
    bool all = node->object->type == OBJECT_INTERSECTION;
    node->inside = node->reach = all ? EVERYWHERE : box_empty();
    node->outside = all ? box_empty() : EVERYWHERE;
    for (uint32_t c = node->first; c != NO_INDEX; c = maker->nodes.items[c].next) {
        const CsgNode *child = &maker->nodes.items[c];
        Box whole = box_union(child->reach, child->inside);
        node->reach = all ? box_common(node->reach, whole) : box_union(node->reach, child->reach);
        node->inside =
            all ? box_common(node->inside, child->inside) : box_union(node->inside, child->inside);
        node->outside = all ? box_union(node->outside, child->outside)
                            : box_common(node->outside, child->outside);
        node->child_count++;
        node->solid_count += child->solid;
    }
    node->solid = node->solid_count > 0 && (!all || node->solid_count == node->child_count);
    if (!all)
        return;
    if (!vec_is_finite(node->reach.low) || !vec_is_finite(node->reach.high))
        narrow_to_faces(maker, node);
    narrow(maker, node, node->first);
}

// Also inverted it has its surface where it was.
static void fill_patches(const Maker *maker, CsgNode *node) {
    node->body = patch_solid_create(maker->scene, node->object, maker->patches, maker->arena);
    node->solid = true;
    node->outside = EVERYWHERE;
    node->inside = node->object->inverse ? EVERYWHERE : widened(patch_solid_bounds(node->body));
}

// POV-Ray keeps the box of a quadric within those of its clips, in the space of the quadric, though
// the inside of some goes on out of theirs (below a height field): rays that miss it see nothing.
static Box clipped_quadric(const Maker *maker, const CsgNode *node) {
    Shape clipped = *node->shape;
    Box *box = &clipped.as.solid.box;
    for (uint32_t c = node->first_clip; c != NO_INDEX; c = maker->nodes.items[c].next) {
        const Shape *clip = maker->nodes.items[c].shape;
        if (clip && !clip->inverse)
            *box = box_common(*box, shape_bounds_in(clip, clipped.transform));
    }
    if (!(box->low.x <= box->high.x && box->low.y <= box->high.y && box->low.z <= box->high.z))
        return box_empty();
    return widened(shape_bounds(&clipped));
}

static void apply_clips(const Maker *maker, CsgNode *node) {
    for (uint32_t c = node->first_clip; c != NO_INDEX; c = maker->nodes.items[c].next) {
        const CsgNode *clip = &maker->nodes.items[c];
        node->outside = EVERYWHERE;
        node->inside = box_common(node->inside, clip->inside);
        node->reach = box_common(node->reach, clip->inside);
        node->solid = node->solid && clip->solid;
    }
    narrow(maker, node, node->first_clip);
    if (node->shape)
        node->reach = shape_within(node->shape, node->reach);
    if (node->object->type == OBJECT_QUADRIC && node->first_clip != NO_INDEX)
        node->reach = box_common(node->reach, clipped_quadric(maker, node));
}

// framed: something around may hide hits.
static uint32_t make_node(Maker *maker, uint32_t index, uint32_t parent, bool framed, int depth) {
    const Object *object = &maker->scene->objects[index];
    if (depth > SCENE_MAX_DEPTH)
        die("objects[%u]: more than %d unions, merges and intersections inside each other", index,
            SCENE_MAX_DEPTH);
    maker->of_object[index] = NO_INDEX;
    if (object->type == OBJECT_INSTANCE ||
        (object->type == OBJECT_PATCH && !framed && object->bounds.count == 0))
        return NO_INDEX;
    uint32_t at = (uint32_t)maker->nodes.count;
    CsgNode node = {.object = object,
                    .parent = parent,
                    .next = NO_INDEX,
                    .first = NO_INDEX,
                    .first_clip = NO_INDEX,
                    .first_bound = NO_INDEX,
                    .gate = NO_INDEX};
    array_push(&maker->nodes, node); // keeps the place: children come behind
    maker->of_object[index] = at;
    node.first_clip = make_list(maker, &object->clips, NO_INDEX, true, depth + 1);
    if (object_is_tree(object)) {
        bool hides = framed || object->type != OBJECT_UNION || object->clips.count > 0 ||
                     object->bounds.count > 0;
        node.first = make_list(maker, &object->shape.children, at, hides, depth + 1);
        join_children(maker, &node);
        if (object->solid && framed)
            fill_patches(maker, &node);
    } else {
        make_leaf(maker, &node);
    }
    apply_clips(maker, &node);
    if (csg_bounds_cut(maker->scene, &object->bounds, &node.reach))
        node.first_bound = make_list(maker, &object->bounds, NO_INDEX, true, depth + 1);
    maker->nodes.items[at] = node;
    return at;
}

// POV-Ray takes it apart into its children.
static bool is_split(const Object *object) {
    return object->type == OBJECT_UNION && object->clips.count == 0 && !object->whole;
}

static bool judges(const CsgNode *tree) {
    return tree->object->type != OBJECT_UNION || tree->first_clip != NO_INDEX;
}

// A leaf is seen where it is and each tree around it may be, through the bounds of all. Parents
// stand before their children.
static void hand_down(Csg *csg) {
    for (uint32_t n = 0; n < csg->count; n++) {
        CsgNode *node = &csg->nodes[n];
        node->gate = node->first_bound != NO_INDEX ? n : NO_INDEX;
        node->outermost = node->parent == NO_INDEX;
        node->judge = node->judged = NO_INDEX;
        if (node->parent == NO_INDEX)
            continue;
        const CsgNode *parent = &csg->nodes[node->parent];
        node->judge = judges(parent) ? node->parent : parent->judge;
        node->judged = judges(parent) ? n : parent->judged;
        node->outermost = parent->outermost && is_split(parent->object);
        node->reach = box_common(node->reach, parent->reach);
        if (node->gate == NO_INDEX)
            node->gate = parent->gate;
    }
}

// From so many children on a tree of boxes pays.
enum { WIDE = 16 };

static bool is_finite(const Box *box) {
    return vec_is_finite(box->low) && vec_is_finite(box->high) && box->low.x <= box->high.x &&
           box->low.y <= box->high.y && box->low.z <= box->high.z;
}

static CsgWide *make_wide(const Csg *csg, const CsgNode *node, Arena *arena) {
    Arena *scratch = arena_create();
    CsgWide *wide = ARENA_NEW(arena, CsgWide);
    Box *boxes = ARENA_ARRAY(scratch, Box, node->child_count);
    uint32_t *boxed = ARENA_ARRAY(scratch, uint32_t, node->child_count), count = 0;
    bool all = node->object->type == OBJECT_INTERSECTION;
    wide->rest = ARENA_ARRAY(arena, uint32_t, node->child_count);
    for (uint32_t c = node->first; c != NO_INDEX; c = csg->nodes[c].next) {
        const Box *box = all ? &csg->nodes[c].outside : &csg->nodes[c].inside;
        if (is_finite(box))
            boxes[count] = *box, boxed[count++] = c;
        else if (all || csg->nodes[c].solid)
            wide->rest[wide->rest_count++] = c;
    }
    wide->tree = bvh_build(boxes, count, arena);
    wide->nodes = ARENA_ARRAY(arena, uint32_t, count);
    for (uint32_t i = 0; i < count; i++)
        wide->nodes[i] = boxed[wide->tree.items[i]];
    arena_destroy(scratch);
    return wide;
}

Csg csg_create(const Scene *scene, const PatchSetOptions *patches, Arena *arena) {
    Maker maker = {.scene = scene,
                   .arena = arena,
                   .patches = patches,
                   .shared = shape_shared_create(scene, arena),
                   .of_object = ARENA_ARRAY(arena, uint32_t, scene->object_count)};
    for (uint32_t i = 0; i < scene->root_count; i++)
        make_node(&maker, scene->roots[i], NO_INDEX, false, 0);
    for (uint32_t i = 0; i < scene->definition_count; i++)
        make_node(&maker, scene->definitions[i], NO_INDEX, false, 0);
    Csg csg = {
        .count = (uint32_t)maker.nodes.count, .of_object = maker.of_object, .shared = maker.shared};
    csg.nodes = arena_copy(arena, maker.nodes.items, csg.count * sizeof(CsgNode));
    array_free(&maker.nodes);
    hand_down(&csg);
    for (uint32_t n = 0; n < csg.count; n++)
        if (csg.nodes[n].child_count > WIDE && csg.nodes[n].solid)
            csg.nodes[n].wide = make_wide(&csg, &csg.nodes[n], arena);
    return csg;
}

void csg_destroy(Csg *csg) {
    for (uint32_t n = 0; n < csg->count; n++)
        if (csg->nodes[n].body)
            patch_solid_destroy(csg->nodes[n].body);
}

uint64_t csg_memory(const Csg *csg) {
    uint64_t bytes = 0;
    for (uint32_t n = 0; n < csg->count; n++)
        if (csg->nodes[n].body)
            bytes += patch_solid_memory(csg->nodes[n].body);
    return bytes;
}

// ---- points ---------------------------------------------------------------------------------

static bool inside_clips(const Csg *csg, const CsgNode *node, Vec3 p) {
    for (uint32_t c = node->first_clip; c != NO_INDEX; c = csg->nodes[c].next)
        if (!csg_inside(csg, c, p))
            return false;
    return true;
}

// Is p inside all children of a tree, or none, but `own` and those that rays of that kind do not
// see?
typedef struct {
    const Csg *csg;
    const CsgNode *tree;
    uint32_t own;
    Vec3 p;
    bool inside;
    uint32_t kind;
} OthersQuery;

static bool others(const OthersQuery *query);

bool csg_inside_unclipped(const Csg *csg, uint32_t index, Vec3 p) {
    const CsgNode *node = &csg->nodes[index];
    if (node->shape)
        return shape_inside(node->shape, p);
    if (node->body)
        return patch_solid_inside(node->body, p) != node->object->inverse;
    bool all = node->object->type == OBJECT_INTERSECTION;
    return others(&(OthersQuery){csg, node, NO_INDEX, p, all, 0}) == all;
}

bool csg_inside(const Csg *csg, uint32_t index, Vec3 p) {
    const CsgNode *node = &csg->nodes[index];
    return node->solid && box_has(&node->inside, p) && inside_clips(csg, node, p) &&
           csg_inside_unclipped(csg, index, p);
}

// Do rays of that kind pass by the object?
static bool is_hidden(const Object *object, uint32_t kind) {
    return (object->no_image && (kind & RAY_IMAGE)) ||
           (object->no_reflection && (kind & RAY_REFLECTION));
}

static bool differs(const OthersQuery *query, uint32_t child) {
    const Csg *csg = query->csg;
    return child != query->own && csg_inside(csg, child, query->p) != query->inside &&
           !is_hidden(csg->nodes[child].object, query->kind);
}

static bool differs_at(void *context, uint32_t place) {
    const OthersQuery *query = context;
    return differs(query, query->tree->wide->nodes[place]);
}

static bool others(const OthersQuery *query) {
    const CsgWide *wide = query->tree->wide;
    if (!wide) {
        for (uint32_t c = query->tree->first; c != NO_INDEX; c = query->csg->nodes[c].next)
            if (differs(query, c))
                return false;
        return true;
    }
    for (uint32_t i = 0; i < wide->rest_count; i++)
        if (differs(query, wide->rest[i]))
            return false;
    OthersQuery at = *query;
    return !bvh_walk_point(&wide->tree, query->p, differs_at, &at);
}

// Is p inside all children but `own`?
static bool inside_others(const Csg *csg, const CsgNode *tree, uint32_t own, Vec3 p) {
    return others(&(OthersQuery){csg, tree, own, p, true, 0});
}

// Is p outside all children but `own`, as far as rays of that kind see them?
static bool outside_others(const Csg *csg, const CsgNode *tree, uint32_t own, Vec3 p,
                           uint32_t kind) {
    return others(&(OthersQuery){csg, tree, own, p, false, kind});
}

bool csg_keeps(const Csg *csg, uint32_t index, Vec3 p, uint32_t kind) {
    const CsgNode *node = &csg->nodes[index];
    if (!inside_clips(csg, node, p))
        return false;
    while (node->judge != NO_INDEX) {
        const CsgNode *tree = &csg->nodes[node->judge];
        ObjectType type = tree->object->type;
        if (type == OBJECT_INTERSECTION && !inside_others(csg, tree, node->judged, p))
            return false;
        if (type == OBJECT_MERGE && !outside_others(csg, tree, node->judged, p, kind))
            return false;
        if (!inside_clips(csg, tree, p))
            return false;
        node = tree;
    }
    return true;
}

bool csg_fills(const Csg *csg, uint32_t index, Vec3 p) {
    if (!csg_inside(csg, index, p))
        return false;
    for (const CsgNode *node = &csg->nodes[index]; node->judge != NO_INDEX;) {
        const CsgNode *tree = &csg->nodes[node->judge];
        if (tree->object->type == OBJECT_INTERSECTION && !inside_others(csg, tree, node->judged, p))
            return false;
        if (!inside_clips(csg, tree, p))
            return false;
        node = tree;
    }
    return true;
}

bool csg_is_watched(const Csg *csg, uint32_t index) {
    const CsgNode *own = &csg->nodes[index];
    if (own->first_clip != NO_INDEX)
        return true;
    while (own->judge != NO_INDEX) {
        const CsgNode *tree = &csg->nodes[own->judge], *child = &csg->nodes[own->judged];
        bool hides =
            tree->object->type == OBJECT_INTERSECTION
                ? tree->child_count > 1
                : tree->object->type == OBJECT_MERGE && tree->solid_count > (child->solid ? 1 : 0);
        if (hides || tree->first_clip != NO_INDEX)
            return true;
        own = tree;
    }
    return false;
}
