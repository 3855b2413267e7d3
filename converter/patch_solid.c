// SPDX-License-Identifier: MIT
// --patch-solids: a union of patches that has an interior, and is closed, is a solid in
// intersections and differences. Closed: each side of each patch is that of one other patch, or
// shrunk to a point.
#include "converter/nodes.h"

#include <math.h>
#include <stdlib.h>

// Sides are the same when their points are, within this share of the size of all.
static const double SAME_SHARE = 1e-6;

static bool only_patches(const ObjectNode *node, uint32_t *count) {
    if (node->light || !node->modelled || node->clips || node->bounds)
        return false;
    if (node->object.type == OBJECT_PATCH) {
        (*count)++;
        return true;
    }
    if (node->object.type != OBJECT_UNION || node->keyword == KW_light_group || !node->first)
        return false;
    for (const ObjectNode *child = node->first; child; child = child->next)
        if (!only_patches(child, count))
            return false;
    return true;
}

bool patch_solid_is_meant(const Converter *cv, const ObjectNode *node) {
    uint32_t count = 0;
    return cv->options->patch_solids && node->object.type == OBJECT_UNION && node->interior &&
           !node->clips && !node->bounds && only_patches(node, &count);
}

typedef struct {
    Vec3 p[4];
    bool met; // its other patch has been found
} Side;

typedef struct {
    ARRAY(Side) sides;
    Box box;
} Sides;

static void add_sides(Sides *sides, const ObjectNode *node) {
    static const int order[4][4] = {{0, 1, 2, 3}, {3, 7, 11, 15}, {15, 14, 13, 12}, {12, 8, 4, 0}};
    for (const ObjectNode *child = node->first; child; child = child->next)
        add_sides(sides, child);
    if (node->object.type != OBJECT_PATCH)
        return;
    const Vec3 *points = node->object.shape.patch.points;
    for (int s = 0; s < 4; s++) {
        Side side = {.met = false};
        for (int i = 0; i < 4; i++) {
            side.p[i] = points[order[s][i]];
            sides->box = box_extend(sides->box, side.p[i]);
        }
        array_push(&sides->sides, side);
    }
}

static bool near(Vec3 a, Vec3 b, double slack) {
    return fabs(a.x - b.x) <= slack && fabs(a.y - b.y) <= slack && fabs(a.z - b.z) <= slack;
}

static bool is_point(const Side *side, double slack) {
    return near(side->p[0], side->p[1], slack) && near(side->p[0], side->p[2], slack) &&
           near(side->p[0], side->p[3], slack);
}

static bool same_side(const Side *a, const Side *b, double slack) {
    bool forth = true, back = true;
    for (int i = 0; i < 4; i++) {
        forth = forth && near(a->p[i], b->p[i], slack);
        back = back && near(a->p[i], b->p[3 - i], slack);
    }
    return forth || back;
}

// A side and its other way round have the same key.
static double key_of(const Side *side) { return side->p[0].x + side->p[3].x; }

static int by_key(const void *a, const void *b) {
    double ka = key_of(a), kb = key_of(b);
    return (ka > kb) - (ka < kb);
}

bool patch_solid_is_closed(const ObjectNode *node) {
    Sides sides = {.box = box_empty()};
    add_sides(&sides, node);
    double slack = SAME_SHARE * vec_length(vec_sub(sides.box.high, sides.box.low));
    Side *items = sides.sides.items;
    size_t count = sides.sides.count;
    qsort(items, count, sizeof *items, by_key);
    bool closed = count > 0;
    for (size_t i = 0; closed && i < count; i++) {
        if (items[i].met || is_point(&items[i], slack))
            continue;
        size_t k = i + 1;
        while (k < count && key_of(&items[k]) <= key_of(&items[i]) + 2.0 * slack &&
               (items[k].met || !same_side(&items[i], &items[k], slack)))
            k++;
        closed = k < count && !items[k].met && same_side(&items[i], &items[k], slack);
        if (closed)
            items[k].met = true;
    }
    array_free(&sides.sides);
    return closed;
}

bool patch_solid_invert(const Converter *cv, ObjectNode *node) {
    if (!patch_solid_is_meant(cv, node) || !patch_solid_is_closed(node))
        return false;
    node->object.inverse = !node->object.inverse;
    return true;
}
