// SPDX-License-Identifier: MIT
// How far infinite shapes reach into a box: planes that lie along the axes cut it, and a quadric
// between two planes is finite if its section is. Only saves work: bodies cut out of such shapes
// then have boxes, as in POV-Ray.
#include "shape/solid.h"

#include <math.h>

typedef struct {
    double low, high;
} Range;

static Range box_range(const Box *box, int axis) {
    return (Range){vec_get(box->low, axis), vec_get(box->high, axis)};
}

static Box box_of_ranges(const Range range[3]) {
    return (Box){vec3(range[0].low, range[1].low, range[2].low),
                 vec3(range[0].high, range[1].high, range[2].high)};
}

static Range common(Range a, Range b) { return (Range){fmax(a.low, b.low), fmin(a.high, b.high)}; }

// What is left of a right angle by rounding of rotations: a plane so near to an axis is off by less
// than boxes are widened, out to 1e8 units.
static const double NEARLY = 1e-14;

static Box plane_within(const PlaneShape *plane, Box around) {
    for (int axis = 0; axis < 3; axis++) {
        double k = vec_get(plane->normal, axis), b = vec_get(plane->normal, (axis + 1) % 3),
               c = vec_get(plane->normal, (axis + 2) % 3);
        if (k == 0.0 || fmax(fabs(b), fabs(c)) > NEARLY * fabs(k))
            continue;
        double at = plane->distance / k, by = SHAPE_WIDER * (1.0 + fabs(at));
        Range half = k > 0.0 ? (Range){-INFINITY, at + by} : (Range){at - by, INFINITY};
        Range range[3] = {box_range(&around, 0), box_range(&around, 1), box_range(&around, 2)};
        range[axis] = common(range[axis], half);
        return box_of_ranges(range);
    }
    return around;
}

// Where the box lies in the space that m takes points from; infinite sides stay where no other axis
// has a part of them.
static Box box_moved(const double m[4][4], const Box *box) {
    Range out[3];
    for (int to = 0; to < 3; to++) {
        out[to] = (Range){m[3][to], m[3][to]};
        for (int from = 0; from < 3; from++) {
            double k = m[from][to];
            if (k == 0.0)
                continue;
            Range in = box_range(box, from);
            out[to].low += fmin(k * in.low, k * in.high);
            out[to].high += fmax(k * in.low, k * in.high);
        }
    }
    return box_of_ranges(out);
}

// The least of k x^2 + l x over the range.
static double least(double k, double l, Range x) {
    if (k == 0.0 && l == 0.0)
        return 0.0;
    if (k == 0.0)
        return l > 0.0 ? l * x.low : l * x.high;
    double top = -0.5 * l / k; // of the parabola
    if (k > 0.0) {
        double at = fmin(fmax(top, x.low), x.high);
        return (k * at + l) * at;
    }
    if (isinf(x.low) || isinf(x.high))
        return -INFINITY;
    return fmin((k * x.low + l) * x.low, (k * x.high + l) * x.high);
}

// Where k x^2 + l x <= rest.
static Range solutions(double k, double l, double rest) {
    const Range all = {-INFINITY, INFINITY};
    if (k == 0.0 && l != 0.0)
        return l > 0.0 ? (Range){-INFINITY, rest / l} : (Range){rest / l, INFINITY};
    if (!(k > 0.0) || isinf(rest))
        return all;
    double middle = -0.5 * l / k, reach = sqrt(fmax(rest / k + middle * middle, 0.0));
    return (Range){middle - reach, middle + reach};
}

// The largest number among the ends that are finite.
static double finite_size(const Range *range, int count) {
    double size = 0.0;
    for (int i = 0; i < count; i++) {
        if (isfinite(range[i].low))
            size = fmax(size, fabs(range[i].low));
        if (isfinite(range[i].high))
            size = fmax(size, fabs(range[i].high));
    }
    return size;
}

// In the quadric's own space. Each round bounds an axis by the other two.
static Box quadric_within(const QuadricShape *q, Box around) {
    if (q->mixed.x != 0.0 || q->mixed.y != 0.0 || q->mixed.z != 0.0)
        return around;
    Range range[3] = {box_range(&around, 0), box_range(&around, 1), box_range(&around, 2)};
    for (int round = 0; round < 2; round++) {
        for (int axis = 0; axis < 3; axis++) {
            double rest = -q->constant;
            for (int other = 0; other < 3; other++)
                if (other != axis)
                    rest -=
                        least(vec_get(q->square, other), vec_get(q->linear, other), range[other]);
            Range found = solutions(vec_get(q->square, axis), vec_get(q->linear, axis), rest);
            if (isnan(found.low) || isnan(found.high))
                return around;
            double by = SHAPE_WIDER * fmax(finite_size(range, 3), finite_size(&found, 1));
            range[axis] = common(range[axis], (Range){found.low - by, found.high + by});
        }
    }
    return box_of_ranges(range);
}

// The plane where it is in the space that t takes to the world.
static PlaneShape plane_moved(const Transform *t, const PlaneShape *plane) {
    const double n[3] = {plane->normal.x, plane->normal.y, plane->normal.z};
    double moved[4];
    for (int i = 0; i < 4; i++)
        moved[i] = t->m[i][0] * n[0] + t->m[i][1] * n[1] + t->m[i][2] * n[2];
    return (PlaneShape){vec3(moved[0], moved[1], moved[2]), plane->distance - moved[3]};
}

Box shape_within(const Shape *shape, Box around) {
    return shape_within_planes(shape, NULL, 0, around);
}

Box shape_within_planes(const Shape *shape, const PlaneShape *planes, uint32_t count, Box around) {
    bool empty = !(around.low.x <= around.high.x);
    if (shape->kind == SHAPE_PLANE && !empty)
        return plane_within(&shape->as.plane, around);
    const QuadricShape *quadric =
        shape->kind == SHAPE_SOLID ? solid_quadric(&shape->as.solid) : NULL;
    if (!quadric || shape->inverse || empty)
        return around;
    const Transform *t = shape->transform;
    Box local = t ? box_moved(t->inv, &around) : around;
    for (uint32_t i = 0; t && i < count && local.low.x <= local.high.x; i++) {
        const PlaneShape plane = plane_moved(t, &planes[i]);
        local = plane_within(&plane, local);
    }
    Box found = quadric_within(quadric, local);
    if (t)
        found = box_moved(t->m, &found);
    Range range[3];
    for (int axis = 0; axis < 3; axis++)
        range[axis] = common(box_range(&around, axis), box_range(&found, axis));
    return box_of_ranges(range);
}
