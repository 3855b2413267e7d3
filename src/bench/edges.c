// SPDX-License-Identifier: MIT
// Edges are sorted by one coordinate of their middles; only those close in it are compared.
#include "bench/edges.h"

#include "base/array.h"
#include "base/rng.h"
#include "patch/bezier.h"

#include <math.h>
#include <stdlib.h>

enum { SIDES = 4, MOST_POINTS = BEZIER_MAX_DEGREE + 1, TRIES = 4 };
static const double SAME = 1e-9, REACH = 0.25, SMOOTH_COS = 0.984807753012208; // 10 degrees

typedef struct {
    const PatchShape *patch;
    int side, count; // points of the edge
    double key, diameter;
    Vec3 p[MOST_POINTS];
} Edge;

typedef struct {
    const Edge *a, *b;
    bool backwards;
} Shared;

typedef ARRAY(Edge) EdgeList;
typedef ARRAY(Shared) SharedList;

// Parameters of the point at `at` of the way along a side: u = 0, u = 1, v = 0, v = 1.
static void place_on(int side, double at, double *u, double *v) {
    *u = side < 2 ? side : at;
    *v = side < 2 ? at : side - 2;
}

static void add_edges(const PatchShape *patch, EdgeList *list) {
    int du = (int)patch->degree_u, dv = (int)patch->degree_v;
    const Box box = patch_shape_box(patch);
    double diameter = vec_length(vec_sub(box.high, box.low));
    for (int side = 0; side < SIDES; side++) {
        Edge edge = {.patch = patch, .side = side, .diameter = diameter};
        edge.count = side < 2 ? dv + 1 : du + 1;
        Box around = box_empty();
        for (int k = 0; k < edge.count; k++) {
            int i = side == 0 ? 0 : side == 1 ? du : k, j = side < 2 ? k : side == 2 ? 0 : dv;
            edge.p[k] = patch->points[i * (dv + 1) + j];
            around = box_extend(around, edge.p[k]);
        }
        // A collapsed edge is a point.
        if (!(vec_length(vec_sub(around.high, around.low)) > SAME * diameter))
            continue;
        edge.key = around.low.x + around.high.x;
        array_push(list, edge);
    }
}

static int by_key(const void *a, const void *b) {
    const Edge *x = a, *y = b;
    return (x->key > y->key) - (x->key < y->key);
}

static bool equal_edges(const Edge *a, const Edge *b, bool backwards) {
    for (int k = 0; k < a->count; k++) {
        Vec3 q = b->p[backwards ? b->count - 1 - k : k];
        if (vec_length(vec_sub(a->p[k], q)) > SAME * fmin(a->diameter, b->diameter))
            return false;
    }
    return true;
}

static void find_shared(const EdgeList *edges, SharedList *shared) {
    for (size_t i = 0; i < edges->count; i++) {
        const Edge *a = &edges->items[i];
        for (size_t k = i + 1; k < edges->count; k++) {
            const Edge *b = &edges->items[k];
            if (b->key - a->key > 2.0 * SAME * a->diameter)
                break;
            if (a->count != b->count || a->patch == b->patch)
                continue;
            bool forwards = equal_edges(a, b, false);
            if (forwards || equal_edges(a, b, true))
                array_push(shared, ((Shared){a, b, !forwards}));
        }
    }
}

// The normal of the edge's patch at that place of the edge; zero where it is not plain.
static Vec3 normal_at(const Edge *edge, double at, Vec3 *p) {
    Bezier patch;
    double u, v;
    place_on(edge->side, at, &u, &v);
    bezier_init(&patch, (int)edge->patch->degree_u, (int)edge->patch->degree_v,
                edge->patch->points);
    Vec3 su, sv;
    *p = bezier_eval1(&patch, u, v, &su, &sv);
    Vec3 normal = vec_cross(su, sv);
    double length = vec_length(normal);
    return length > SAME * edge->diameter * edge->diameter ? vec_scale(normal, 1.0 / length)
                                                           : vec3(0, 0, 0);
}

// False: the surface has no single tangent plane at that place.
static bool aim(const Shared *s, bool corner, Rng *rng, Ray *ray) {
    // Every second ray at a quarter of the edge: a corner of all triangles from two steps on.
    double at = rng_unit(rng);
    if (corner)
        at = round(4.0 * at) / 4.0;
    Vec3 p, q, n = normal_at(s->a, at, &p), m = normal_at(s->b, s->backwards ? 1.0 - at : at, &q);
    if (!(fabs(vec_dot(n, m)) > SMOOTH_COS))
        return false;
    // Up to 45 degrees off the normal, from either side.
    Vec3 other = fabs(n.x) < 0.5 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    Vec3 across = vec_normalize(vec_cross(n, other)), along = vec_cross(n, across);
    double turn = rng_range(rng, 0.0, 2.0 * M_PI), tilt = rng_range(rng, 0.0, 0.25 * M_PI);
    double side = rng_unit(rng) < 0.5 ? -1.0 : 1.0;
    Vec3 dir = vec_scale(n, side * cos(tilt));
    dir = vec_madd(dir, sin(tilt) * cos(turn), across);
    dir = vec_madd(dir, sin(tilt) * sin(turn), along);
    dir = vec_scale(dir, REACH * s->a->diameter);
    *ray = (Ray){vec_sub(p, dir), dir};
    return true;
}

static void shuffle(SharedList *list, Rng *rng) {
    for (size_t i = list->count; i > 1; i--) {
        size_t k = (size_t)(rng_unit(rng) * (double)i);
        Shared kept = list->items[i - 1];
        list->items[i - 1] = list->items[k];
        list->items[k] = kept;
    }
}

EdgeRays edges_find(const Scene *scene, size_t most, Arena *arena) {
    EdgeList edges = {0};
    SharedList shared = {0};
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        if (object->type == OBJECT_PATCH && !object->shape.patch.weights)
            add_edges(&object->shape.patch, &edges);
    }
    if (edges.count > 0)
        qsort(edges.items, edges.count, sizeof *edges.items, by_key);
    find_shared(&edges, &shared);
    EdgeRays rays = {.rays = ARENA_ARRAY(arena, Ray, most)};
    Rng rng = {1};
    shuffle(&shared, &rng);
    // In turn over the edges, until there are enough rays or some tries have found no smooth place.
    bool *smooth = ARENA_ARRAY(arena, bool, shared.count);
    size_t tries = shared.count * TRIES;
    for (size_t k = 0; shared.count > 0 && rays.count < most && (k < tries || rays.count > 0);
         k++) {
        size_t i = k % shared.count;
        if (aim(&shared.items[i], k & 1, &rng, &rays.rays[rays.count])) {
            rays.count++;
            rays.edges += !smooth[i];
            smooth[i] = true;
        }
    }
    array_free(&edges);
    array_free(&shared);
    return rays;
}

size_t edges_leaks(const EdgeRays *rays, const PatchSet *set) {
    size_t leaks = 0;
    for (size_t i = 0; i < rays->count; i++) {
        PatchHit hit;
        leaks += !patchset_intersect(set, &rays->rays[i], 0.0, 2.0, UINT32_MAX, NULL, &hit);
    }
    return leaks;
}
