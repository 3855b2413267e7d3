// SPDX-License-Identifier: MIT
// One question on its way through the tree of METHOD_QI: what accel.c and the kernels share.
#ifndef PATCH_WALK_H
#define PATCH_WALK_H

#include "patch/piece.h"
#include "patch/qi_reduce.h"
#include "patch/query.h"
#include "patch/root.h"

enum { WALK_SEEN = 64 };

// A hit reported to QUERY_ALL, kept to know it again.
typedef struct {
    uint32_t patch, piece;
    double t, u, v;
    double bound_t, error_t; // of t: by the bound; with the tolerance besides
    double error_u, error_v;
    int sign;
} WalkSeen;

typedef struct {
    const Accel *accel;
    Query *query;
    Vec3 dir;       // of unit length
    double t_per_s; // 1 / length of the ray's own
    uint32_t patch; // ray is set up for this one; UINT32_MAX: for none
    uint32_t piece; // being searched
    double t_limit; // the query's own t_max, which shrinks
    double t_least; // of hits in the leaf being visited
    PatchRay ray;
    uint32_t best_patch, best_piece; // where query->best comes from
    uint64_t endless; // nets of searches that found the ray in the surface (search.h)
    uint64_t seen_count;
    WalkSeen seen[WALK_SEEN]; // the last ones, a ring
    bool has_qi;
    QiSearch qi; // of the same patch, if has_qi
} Walk;

// The ray as that patch sees it.
static inline void walk_see(Walk *walk, uint32_t patch) {
    walk->patch = patch;
    walk->has_qi = false;
    patch_ray_init(&walk->ray, &walk->accel->patches[patch], &walk->query->ray, walk->dir,
                   walk->t_per_s);
}

// The nearest hit must not depend on the order in which leaves are visited, so leaves that begin
// behind the best hit are left out only if nothing in them could win. A crossing lies in the box of
// its leaf; but a hit may be taken as far away as the tolerance, and where a ray passes beside a
// box such a hit can come before the box. It counts as if it were where the box begins: then a leaf
// that begins behind a hit has none that counts before it.
static inline double walk_order(const Walk *walk, double t) {
    return t > walk->t_least ? t : walk->t_least;
}

// Does a hit count, as far as is known? Of the nearest hit's equals walk_take chooses.
static inline bool walk_in_range(const Walk *walk, double t) {
    const Query *query = walk->query;
    if (query->kind != QUERY_NEAREST)
        return t >= query->t_min && t < query->t_max;
    double order = walk_order(walk, t);
    return t >= query->t_min && (order < query->t_max || (order == query->t_max && query->found));
}

// Takes a crossing found in walk->piece and in range; false to end the walk. Of hits in the same
// place the one of the first patch is kept. query->t_max is the order of the best.
bool walk_take(Walk *walk, const Root *root);

#endif
