// SPDX-License-Identifier: MIT
// Patches and rays of any size that double can hold: products of three coordinates leave the range
// of numbers from about 1e100 on, and denormal numbers have few digits. Such sets are kept in units
// that differ by a power of two, which changes no bit, and so are such rays.
#ifndef PATCH_UNITS_H
#define PATCH_UNITS_H

#include "patch/query.h"

// The power of two that brings a set within bounds to about 1; 0 where it is well as it is.
int units_shift(Box bounds);
// Turns a patch's points (its own copies) and lengths into units: times 2^shift.
void units_enter(PatchDef *def, Vec3 *points, int shift);

static inline double units_largest(Vec3 a) {
    double x = fabs(a.x), y = fabs(a.y), z = fabs(a.z);
    double most = x > y ? x : y;
    return most > z ? most : z;
}

// Must a ray's direction be brought to another length?
static inline bool units_odd(Vec3 dir) {
    double most = units_largest(dir);
    return !(most >= 0x1p-900 && most <= 0x1p900) && most > 0.0;
}

// A query in the units of a set, and the way back.
typedef struct {
    Query query; // ask this
    Query *asked;
    int shift, t_shift; // t of the set's units = t * 2^t_shift
} UnitsQuery;

void units_begin(UnitsQuery *units, Query *query, int shift);
void units_end(UnitsQuery *units);

#endif
