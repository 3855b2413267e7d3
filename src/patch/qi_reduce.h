// SPDX-License-Identifier: MIT
// qi_reduce_* of several parts of one patch by one ray, which is set up once: a fifth of the work
// of a bicubic patch's part, half of that of bi-degree (16,16). Private to qi_*.c, accel.c and the
// kernels.
#ifndef PATCH_QI_REDUCE_H
#define PATCH_QI_REDUCE_H

#include "patch/qi_local.h"

typedef struct {
    QiTarget target;
    bool sound;                // else there is no hit: zero or infinite direction, NaN
    unsigned poles, collapsed; // qi_poles(), qi_collapsed()
    uint64_t steps, full, work_limit;
    bool has_local;
    QiLocal local;
} QiSearch;

void qi_search_init(QiSearch *search, const Bezier *patch, const double *weights, const Ray *ray);

// As qi_reduce_* and qi_rational_*; patch, weights and the query's ray are those of the
// initialisation.
int qi_search_all(QiSearch *search, const Bezier *patch, const double *weights,
                  const QiQuery *query, QiStats *stats, QiSink sink, void *context);
bool qi_search_nearest(QiSearch *search, const Bezier *patch, const double *weights,
                       const QiQuery *query, QiStats *stats, QiHit *hit);

#endif
