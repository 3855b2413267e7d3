// SPDX-License-Identifier: MIT
#include "patch/units.h"

static double scaled(double a, int shift) { return isfinite(a) ? ldexp(a, shift) : a; }

static Vec3 scaled3(Vec3 a, int shift) {
    return vec3(ldexp(a.x, shift), ldexp(a.y, shift), ldexp(a.z, shift));
}

int units_shift(Box bounds) {
    double most = fmax(units_largest(bounds.low), units_largest(bounds.high));
    return most > 0.0 && isfinite(most) && (most < 0x1p-300 || most > 0x1p300) ? -ilogb(most) : 0;
}

void units_enter(PatchDef *def, Vec3 *points, int shift) {
    for (uint32_t k = 0; k < (def->degree_u + 1) * (def->degree_v + 1); k++)
        points[k] = scaled3(points[k], shift);
    def->tolerance = ldexp(def->tolerance, shift);
    def->flatness = ldexp(def->flatness, shift);
}

// With P = org + t dir and shifts s of the set, e of the direction:
//     P 2^s = org 2^s + (t 2^(s - e)) (dir 2^e).
// Lengths come back rounded up: denormal numbers have an absolute precision only.
static PatchHit left(const UnitsQuery *units, const PatchHit *hit) {
    PatchHit out = *hit;
    out.t = ldexp(hit->t, -units->t_shift);
    out.bound = ldexp(hit->bound, -units->shift);
    if (ldexp(out.bound, units->shift) < hit->bound || out.bound < 0x1p-1000)
        out.bound += 0x1p-1074;
    return out;
}

static void sink(void *context, const PatchHit *hit) {
    const UnitsQuery *units = context;
    PatchHit out = left(units, hit);
    const Query *asked = units->asked;
    if (out.t >= asked->t_min && out.t < asked->t_max)
        asked->sink(asked->context, &out);
}

void units_begin(UnitsQuery *units, Query *query, int shift) {
    int turn = units_odd(query->ray.dir) ? -ilogb(units_largest(query->ray.dir)) : 0;
    units->query = *query;
    units->asked = query;
    units->shift = shift;
    units->t_shift = shift - turn;
    Query *q = &units->query;
    q->ray.org = scaled3(query->ray.org, shift);
    q->ray.dir = scaled3(query->ray.dir, turn);
    q->t_min = scaled(query->t_min, units->t_shift);
    q->t_max = scaled(query->t_max, units->t_shift);
    q->sink = sink;
    q->context = units;
}

void units_end(UnitsQuery *units) {
    Query *asked = units->asked;
    asked->stats = units->query.stats;
    asked->found = units->query.found;
    if (asked->found && asked->kind == QUERY_NEAREST)
        asked->best = left(units, &units->query.best);
}
