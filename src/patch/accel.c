// SPDX-License-Identifier: MIT
// METHOD_QI: builds, hands questions to the kernel in use, and takes what it finds.
#include "patch/accel.h"

#include "patch/classes.h"
#include "patch/kernels.h"
#include "patch/walk.h"

// Does the surface, on the way from one to the other, leave the ray by more than the tolerance?
static bool leaves_ray(const PatchRay *ray, const double from[2], const double to[2]) {
    enum { PARTS = 8 };
    double reach = ray->patch->tolerance + 4.0 * ray->error;
    for (int n = 0; n <= PARTS; n++) {
        double at = (double)n / PARTS;
        Vec3 s[3];
        piece_eval(ray->patch, from[0] + at * (to[0] - from[0]), from[1] + at * (to[1] - from[1]),
                   s);
        if (vec_length(vec_cross(vec_sub(s[0], ray->org), ray->dir)) > reach)
            return true;
    }
    return false;
}

// On the straight way, and with one parameter after the other: two sides that are one point are
// joined by their corner.
static bool apart(const PatchRay *ray, const WalkSeen *a, const WalkSeen *b) {
    const double from[2] = {a->u, a->v}, to[2] = {b->u, b->v};
    const double u_first[2] = {b->u, a->v}, v_first[2] = {a->u, b->v};
    return leaves_ray(ray, from, to) &&
           (leaves_ray(ray, from, u_first) || leaves_ray(ray, u_first, to)) &&
           (leaves_ray(ray, from, v_first) || leaves_ray(ray, v_first, to));
}

// The same crossing found from two pieces? Both are right within their errors. Where the surface
// is singular (sign 0) only the place in space is well defined, and what lies between the two. (The
// sheets of a folded ribbon may be nearer to each other than the tolerance.) Within a piece
// crossings were told apart before (qi.h).
static bool same_root(const PatchRay *ray, const WalkSeen *a, const WalkSeen *b) {
    bool alone = a->piece == b->piece;
    double reach = alone ? a->bound_t + b->bound_t : a->error_t + b->error_t;
    if (a->patch != b->patch || a->sign * b->sign < 0 || fabs(a->t - b->t) > reach)
        return false;
    if (a->sign == 0 || b->sign == 0)
        return alone || !apart(ray, a, b);
    return fabs(a->u - b->u) <= a->error_u + b->error_u &&
           fabs(a->v - b->v) <= a->error_v + b->error_v;
}

static bool was_seen(Walk *walk, const Root *root) {
    double bound = root->hit.bound, t_per_s = walk->ray.t_per_s;
    WalkSeen now = {.patch = walk->patch,
                    .piece = walk->piece,
                    .t = root->hit.t,
                    .u = root->hit.u,
                    .v = root->hit.v,
                    .bound_t = bound * t_per_s,
                    .error_t = (bound + walk->ray.patch->tolerance) * t_per_s,
                    .error_u = root->error_u,
                    .error_v = root->error_v,
                    .sign = root->sign};
    uint64_t count = walk->seen_count < WALK_SEEN ? walk->seen_count : WALK_SEEN;
    for (uint64_t i = 0; i < count; i++) {
        if (same_root(&walk->ray, &walk->seen[i], &now))
            return true;
    }
    walk->seen[walk->seen_count++ % WALK_SEEN] = now;
    return false;
}

bool walk_take(Walk *walk, const Root *root) {
    Query *query = walk->query;
    if (query->kind == QUERY_ALL && was_seen(walk, root))
        return true;
    if (query->kind == QUERY_NEAREST) {
        double order = walk_order(walk, root->hit.t);
        if (query->found && order == query->t_max &&
            (walk->patch > walk->best_patch ||
             (walk->patch == walk->best_patch && walk->piece >= walk->best_piece)))
            return true;
        walk->best_patch = walk->patch;
        walk->best_piece = walk->piece;
        query_take(query, &root->hit);
        query->t_max = order;
        return true;
    }
    query_take(query, &root->hit);
    return !query_done(query);
}

Accel *accel_create(Arena *arena, const PatchDef *defs, size_t count, PatchPrepare prepare) {
    return classes_build(arena, defs, count, prepare);
}

void accel_query(const Accel *accel, Query *query) {
    Walk walk;
    walk.query = query;
    walk.t_limit = query->t_max;
    walk.best_patch = walk.best_piece = 0;
    do {
        walk.accel = accel;
        walk.t_least = -INFINITY;
        kernels_chosen()->query(&walk);
        if (query->kind == QUERY_NEAREST && query->found)
            query->t_max = query->best.t;
        // Of hits in the same place that of the larger patch is kept.
        walk.best_patch = walk.best_piece = 0;
        accel = accel->next;
    } while (accel && !query_done(query));
}
