// SPDX-License-Identifier: MIT
// Which objects of a World contain a point. Those whose inside has a box are found by the tree of
// rays; in an instance the point is looked for in its space.
#include "render/world_data.h"
#include "shape/bvh_walk.h"

#include <assert.h>

// The leaves that contain a point.
typedef struct {
    const World *world;
    Vec3 p;
    const Leaf *outer; // the instance; NULL: none
    WorldPlace *found; // ascending: positions, and those of the instances
    uint32_t count, max;
} PointQuery;

static void query_world(PointQuery *query);

static bool comes_before(const WorldPlace *a, const WorldPlace *b) {
    return a->instance != b->instance ? a->instance < b->instance : a->object < b->object;
}

// Insert in order; the last one falls out when there is no room.
static void insert_place(PointQuery *query, WorldPlace place) {
    uint32_t at = query->count;
    while (at > 0 && comes_before(&place, &query->found[at - 1]))
        at--;
    if (at >= query->max)
        return;
    if (query->count < query->max)
        query->count++;
    for (uint32_t i = query->count - 1; i > at; i--)
        query->found[i] = query->found[i - 1];
    query->found[at] = place;
}

static void query_instance(PointQuery *query, const Leaf *leaf) {
    PointQuery sub = *query;
    sub.world = leaf->instance->world;
    sub.p = shape_local_point(leaf->instance->transform, query->p);
    sub.outer = leaf;
    query_world(&sub);
    query->count = sub.count;
}

static void query_prim(PointQuery *query, const Prim *prim) {
    const Leaf *leaf = &prim->leaf;
    if (leaf->instance) {
        query_instance(query, leaf);
        return;
    }
    if (!shape_inside(&prim->shape, query->p) ||
        !csg_fills(&query->world->csg, leaf->node, query->p))
        return;
    bool direct = !query->outer;
    insert_place(query, (WorldPlace){.object = direct ? 0 : leaf->position,
                                     .instance = direct ? leaf->position : query->outer->position});
}

static bool query_item(void *context, uint32_t place) {
    PointQuery *query = context;
    const Prim *prim = &query->world->prims[place];
    const Instance *instance = prim->leaf.instance;
    if (instance ? instance->world->boundless_count == 0 : shape_inside_bounded(&prim->shape))
        query_prim(query, prim);
    return false;
}

static void query_world(PointQuery *query) {
    const World *world = query->world;
    for (uint32_t i = 0; i < world->boundless_count; i++)
        if (box_has(&world->boundless_boxes[i], query->p))
            query_prim(query, &world->prims[world->boundless[i]]);
    bvh_walk_point(&world->tree, query->p, query_item, query);
}

uint32_t world_containing(const World *world, Vec3 p, WorldPlace *places, uint32_t max) {
    PointQuery query = {.world = world, .p = p, .found = places, .max = max};
    if (max == 0)
        return 0;
    query_world(&query);
    for (uint32_t i = 0; i < query.count; i++) {
        const Leaf *outer = &world->leaves[places[i].instance];
        const Instance *instance = outer->instance;
        uint32_t object = instance ? instance->world->leaves[places[i].object].object : NO_INDEX;
        places[i].object = instance ? object : outer->object;
        places[i].instance = instance ? outer->object : NO_INDEX;
    }
    return query.count;
}

bool world_inside(const World *world, uint32_t object, Vec3 p) {
    assert(object < world->scene->object_count);
    uint32_t node = world->csg.of_object[object];
    return node != NO_INDEX && csg_inside(&world->csg, node, p);
}
