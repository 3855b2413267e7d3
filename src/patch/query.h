// SPDX-License-Identifier: MIT
// What one call of patch.h asks: the three forms (nearest, any, all hits) as one record that every
// method fills in. t_max shrinks as nearer hits are found, so that it can cull.
#ifndef PATCH_QUERY_H
#define PATCH_QUERY_H

#include "patch/patch.h"

typedef enum {
    QUERY_NEAREST,
    QUERY_ANY,
    QUERY_ALL,
} QueryKind;

typedef struct {
    Ray ray;
    double t_min, t_max; // a hit counts when t_min <= t < t_max
    uint32_t mask;
    QueryKind kind;
    bool found;     // at least one hit
    PatchHit best;  // QUERY_NEAREST, when found
    PatchSink sink; // QUERY_ALL
    void *context;
    PatchStats stats;
} Query;

// All but best, sink and context, of which nobody knows before there is a hit.
static inline void query_begin(Query *query, QueryKind kind, const Ray *ray, double t_min,
                               double t_max, uint32_t mask) {
    query->ray = *ray;
    query->t_min = t_min;
    query->t_max = t_max;
    query->mask = mask;
    query->kind = kind;
    query->found = false;
    query->stats = (PatchStats){0};
}

// Nothing more can change the answer.
static inline bool query_done(const Query *query) {
    return query->kind == QUERY_ANY && query->found;
}

// Takes a hit whose t lies in the range.
static inline void query_take(Query *query, const PatchHit *hit) {
    query->found = true;
    if (query->kind == QUERY_NEAREST) {
        query->best = *hit;
        query->t_max = hit->t;
    } else if (query->kind == QUERY_ALL) {
        query->stats.hits++;
        query->sink(query->context, hit);
    }
}

#endif
