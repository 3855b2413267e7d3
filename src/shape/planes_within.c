// SPDX-License-Identifier: MIT
// The box of what lies behind several planes, which need not be along the axes, and that of the
// part of each plane that lies behind all others. Bodies cut out of planes alone have boxes then.
// Only saves work.
//
// Where n.p <= d for each of three planes, l1 n1 + l2 n2 + l3 n3 = e with no l below 0 makes
// e.p <= l1 d1 + l2 d2 + l3 d3; in the first plane itself n1.p = d1, and l1 may have any sign. The
// least such bound of all threes of planes is sharp, and where there is none what lies behind the
// planes goes on without end in the direction e.
#include "shape/solid.h"

#include <math.h>

// Threes that span less than this (of unit normals) are left out. So the l are below 1e6, and off
// by 1e-10 of their size at most: far less than boxes are widened.
static const double LEAST_VOLUME = 1e-6;
static const double NO_PART = 1e-9; // a factor this far below 0 is taken for 0

typedef struct {
    Vec3 normal; // unit
    double distance;
    double slack; // of distances: ten times that of inside tests
} HalfSpace;

// The bounds of p along the axes and against them.
typedef struct {
    double bound[6];
} Bounds;

static const Bounds NO_BOUNDS = {{INFINITY, INFINITY, INFINITY, INFINITY, INFINITY, INFINITY}};

typedef struct {
    HalfSpace half[SHAPE_MOST_PLANES];
    Bounds all, face[SHAPE_MOST_PLANES];
} Search;

static void lower(double *bound, double to) { *bound = fmin(*bound, to); }

// part: of the normals of the planes at[0] to at[2] in the direction of that side.
static void try_side(Search *s, const int at[3], const double part[3], int side) {
    double sum = 0.0;
    int below = 0, last = 0;
    for (int i = 0; i < 3; i++) {
        const HalfSpace *half = &s->half[at[i]];
        bool negative = part[i] < -NO_PART;
        below += negative;
        last = negative ? i : last;
        sum += negative ? part[i] * (half->distance - half->slack)
                        : fmax(part[i], 0.0) * (half->distance + half->slack);
    }
    if (below == 0) {
        lower(&s->all.bound[side], sum);
        for (int i = 0; i < 3; i++)
            lower(&s->face[at[i]].bound[side], sum);
    } else if (below == 1) {
        lower(&s->face[at[last]].bound[side], sum);
    }
}

static void try_three(Search *s, const int at[3]) {
    const Vec3 a = s->half[at[0]].normal, b = s->half[at[1]].normal, c = s->half[at[2]].normal;
    const Vec3 bc = vec_cross(b, c);
    double volume = vec_dot(a, bc);
    if (!(fabs(volume) >= LEAST_VOLUME))
        return;
    // Rows of the inverse: what of each normal makes an axis.
    const Vec3 ca = vec_cross(c, a), ab = vec_cross(a, b);
    for (int side = 0; side < 6; side++) {
        double scale = (side & 1 ? -1.0 : 1.0) / volume;
        const double part[3] = {vec_get(bc, side / 2) * scale, vec_get(ca, side / 2) * scale,
                                vec_get(ab, side / 2) * scale};
        try_side(s, at, part, side);
    }
}

static Box box_of(const Bounds *bounds, double by) {
    const double *at = bounds->bound;
    return (Box){vec3(-at[1] - by, -at[3] - by, -at[5] - by),
                 vec3(at[0] + by, at[2] + by, at[4] + by)};
}

bool shape_planes_box(const PlaneShape *planes, uint32_t count, Box *all, Box *faces) {
    Search s;
    if (count > SHAPE_MOST_PLANES)
        return false;
    for (uint32_t i = 0; i < count; i++) {
        double length = vec_length(planes[i].normal);
        if (!(length > 0.0) || !isfinite(length) || !isfinite(planes[i].distance))
            return false;
        double distance = planes[i].distance / length;
        s.half[i] = (HalfSpace){vec_scale(planes[i].normal, 1.0 / length), distance,
                                10.0 * SHAPE_EPSILON * (1.0 + fabs(distance))};
        s.face[i] = NO_BOUNDS;
    }
    s.all = NO_BOUNDS;
    int n = (int)count;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            for (int k = j + 1; k < n; k++)
                try_three(&s, (const int[3]){i, j, k});
    double size = 0.0;
    for (int side = 0; side < 6; side++)
        size = fmax(size, fabs(s.all.bound[side]));
    if (!isfinite(size))
        return false;
    double by = SHAPE_WIDER * (1.0 + size);
    *all = box_of(&s.all, by);
    for (int i = 0; i < n; i++) {
        Box face = box_of(&s.face[i], by);
        faces[i] = (Box){vec_max(all->low, face.low), vec_min(all->high, face.high)};
    }
    return true;
}
