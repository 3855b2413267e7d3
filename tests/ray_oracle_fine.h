// SPDX-License-Identifier: MIT
// Numbers of two doubles (106 bits), and the control points of a part of a patch in them, as a ray
// sees them. Only to place a small part exactly: cells of it are then told in double once more,
// with an error relative to their own size.
#ifndef TESTS_RAY_ORACLE_FINE_H
#define TESTS_RAY_ORACLE_FINE_H

#include "ray_oracle_set.h"

#include <string.h>

typedef struct {
    double h, l;
} Fine;

// All of them err by less than 2^-102 of the largest number involved; a lerp, and the projection of
// a point, by less than FINE_UNIT.
#define FINE_UNIT 0x1p-99

static inline Fine fine_quick(double a, double b) { // |a| >= |b|
    double s = a + b;
    return (Fine){s, b - (s - a)};
}

static inline Fine fine_sum(double a, double b) {
    double s = a + b, other = s - a;
    return (Fine){s, (a - (s - other)) + (b - other)};
}

static inline Fine fine_add(Fine a, Fine b) {
    Fine s = fine_sum(a.h, b.h), t = fine_sum(a.l, b.l);
    s = fine_quick(s.h, s.l + t.h);
    return fine_quick(s.h, s.l + t.l);
}

static inline Fine fine_sub(Fine a, Fine b) { return fine_add(a, (Fine){-b.h, -b.l}); }

static inline Fine fine_times(Fine a, double b) {
    const double split = 0x1p27 + 1;
    double ca = split * a.h, cb = split * b, p = a.h * b;
    double ah = ca - (ca - a.h), bh = cb - (cb - b), al = a.h - ah, bl = b - bh;
    double error = ((ah * bh - p) + ah * bl + al * bh) + al * bl;
    return fine_quick(p, error + a.l * b);
}

typedef struct {
    double h[ORACLE_POINTS], l[ORACLE_POINTS];
} FineGrid;

// x, y, z (depth), each times the weight, and the weights of a rational patch.
typedef struct {
    FineGrid grid[4];
    double error[3]; // of the first three; that of the weights does not matter
} FineNet;

static inline double fine_most(const FineGrid *g, int count) {
    double most = 0.0;
    for (int k = 0; k < count; k++)
        most = fabs(g->h[k]) > most ? fabs(g->h[k]) : most;
    return most;
}

// All points of one row moved by t towards those of the next.
static inline void fine_lerp(FineGrid *g, int row, int across, double t) {
    double *h = g->h + row * across, *l = g->l + row * across;
    for (int j = 0; j < across; j++) {
        Fine p = {h[j], l[j]}, q = {h[j + across], l[j + across]};
        p = fine_add(p, fine_times(fine_sub(q, p), t));
        h[j] = p.h, l[j] = p.l;
    }
}

// Control points of the part [a,b] of n + 1 rows: the blossom of a (n - k times) and b (k times).
// Rows become columns.
static inline void fine_restrict(const FineGrid *from, int n, int across, double a, double b,
                                 FineGrid *to) {
    FineGrid by_a, g;
    size_t size = (size_t)((n + 1) * across) * sizeof(double);
    memcpy(by_a.h, from->h, size), memcpy(by_a.l, from->l, size);
    for (int k = n; k >= 0; k--) {
        size_t used = (size_t)((k + 1) * across) * sizeof(double);
        memcpy(g.h, by_a.h, used), memcpy(g.l, by_a.l, used);
        for (int level = k; level > 0; level--)
            for (int i = 0; i < level; i++)
                fine_lerp(&g, i, across, b);
        for (int j = 0; j < across; j++)
            to->h[j * (n + 1) + k] = g.h[j], to->l[j * (n + 1) + k] = g.l[j];
        for (int i = 0; i < k; i++)
            fine_lerp(&by_a, i, across, a);
    }
}

#endif
