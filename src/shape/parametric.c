// SPDX-License-Identifier: MIT
// Surfaces given by three functions of u and v, as POV-Ray finds them: the rectangle of u and v is
// halved; a piece is dropped when the bounds of its points, by the values at its corners and the
// largest gradient, keep it off the ray. A piece as small as the accuracy is a hit where the ray
// enters its bounds. The accuracy and too low a gradient are seen. Depths are those of the world.
#include "function/function.h"
#include "shape/container.h"
#include "shape/solid.h"

typedef struct {
    double low, high;
} Range;

typedef struct {
    const ParametricShape *shape;
    const FunctionPool *pool;
    uint32_t known;         // pieces with ranges: 1 .. known - 1
    const Range *ranges[3]; // per axis, NULL: none are kept; piece n is halved into 2n and 2n + 1
} Parametric;

// A rectangle of u and v. The values at its corners (u, v): low low, low high, high low, high high.
typedef struct {
    double low[2], high[2];
    uint32_t number; // 0: too deep to have one
    bool has_values[3];
    double values[3][4];
} Piece;

enum {
    // Halves of a piece lie one above the other on the stack. Two doubles cannot be halved more
    // often than 2 x 2098 times, but no accuracy of use takes so many.
    STACK_SIZE = 128,
    MAX_PIECES = 100000, // for one ray: a scene cannot keep it busy for ever
};

static double value_at(const Parametric *s, int axis, double u, double v) {
    const double arguments[3] = {u, v, 0.0};
    return function_value(s->pool, s->shape->functions[axis], arguments);
}

// ---- bounds ---------------------------------------------------------------------------------

// Of a function between two places `length` apart that has ranges there.
static Range between(const Parametric *s, double length, double a, double b) {
    double gradient = s->shape->max_gradient;
    double more = gradient * (length - fabs(a - b) / gradient) / 2.0;
    if (more < 0.0)
        more = 0.0;
    return (Range){(b < a ? b : a) - more, (a < b ? b : a) + more};
}

// All values are lowered by the accuracy, as POV-Ray has it.
static Range range_of(const Parametric *s, int axis, Piece *piece) {
    double *values = piece->values[axis], by = s->shape->accuracy;
    double width = piece->high[0] - piece->low[0], height = piece->high[1] - piece->low[1];
    if (!piece->has_values[axis])
        for (int i = 0; i < 4; i++)
            values[i] = value_at(s, axis, (i & 2 ? piece->high : piece->low)[0],
                                 (i & 1 ? piece->high : piece->low)[1]);
    piece->has_values[axis] = true;
    Range left = between(s, height, values[0] - by, values[1] - by);
    Range right = between(s, height, values[2] - by, values[3] - by);
    return (Range){between(s, width, left.low, right.low).low,
                   between(s, width, left.high, right.high).high};
}

// Fills the ranges of piece number n and of all below it.
static Range keep_ranges(const Parametric *s, Range *ranges, int axis, uint32_t n, Piece piece) {
    if (2 * n >= s->known) {
        piece.has_values[axis] = false;
        return ranges[n] = range_of(s, axis, &piece);
    }
    int cut = piece.high[0] - piece.low[0] < piece.high[1] - piece.low[1];
    Piece halves[2] = {piece, piece};
    halves[0].high[cut] = halves[1].low[cut] = (piece.low[cut] + piece.high[cut]) / 2.0;
    Range a = keep_ranges(s, ranges, axis, 2 * n, halves[0]);
    Range b = keep_ranges(s, ranges, axis, 2 * n + 1, halves[1]);
    return ranges[n] = (Range){a.low < b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}

static Piece whole(const ParametricShape *shape) {
    return (Piece){.low = {shape->low[0], shape->low[1]},
                   .high = {shape->high[0], shape->high[1]},
                   .number = 1};
}

// ---- rays -----------------------------------------------------------------------------------

typedef struct {
    const Parametric *shape;
    Vec3 org, dir;       // dir: as long as one of the world is here
    double enter, leave; // the container
    double t, u, v;      // the nearest hit so far
} Search;

// Depths between which the ray is within the bounds of a piece along an axis.
typedef struct {
    bool level; // it runs along them
    double enter, leave;
} Slab;

static bool meet_slab(const Search *s, int axis, Range range, Slab *slab) {
    double o = vec_get(s->org, axis), d = vec_get(s->dir, axis);
    slab->level = fabs(d) < SHAPE_EPSILON;
    if (slab->level)
        return !(range.high < o || range.low > o);
    double a = (range.high - o) / d, b = (range.low - o) / d;
    slab->enter = a > b ? b : a;
    slab->leave = a > b ? a : b;
    return !(slab->enter > s->leave || slab->leave < s->enter || slab->enter > s->t);
}

// May the ray meet the piece? *at: where it enters its bounds (along the last axis that it is not
// level with, as POV-Ray takes it; INFINITY: with all); *length: the longest way through the bounds
// of an axis.
static bool meet_piece(const Search *s, Piece *piece, double *at, double *length) {
    const Parametric *shape = s->shape;
    Slab slabs[3];
    *at = INFINITY;
    *length = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        bool known = shape->ranges[axis] && piece->number > 0 && piece->number < shape->known;
        Range range = known ? shape->ranges[axis][piece->number] : range_of(shape, axis, piece);
        Slab *slab = &slabs[axis];
        if (!meet_slab(s, axis, range, slab))
            return false;
        if (slab->level)
            continue;
        *at = slab->enter;
        for (int k = 0; k < axis; k++)
            if (!slabs[k].level && (slab->enter > slabs[k].leave || slab->leave < slabs[k].enter))
                return false;
        if (slab->leave - slab->enter > *length)
            *length = slab->leave - slab->enter;
    }
    return true;
}

// Cuts the piece: the high half stays in its place, the low half is put behind it.
static void halve(const Parametric *shape, Piece *piece, int cut, double middle) {
    Piece *low = piece + 1;
    piece->number = piece->number >= 1U << SCENE_MAX_PRECOMPUTE ? 0 : 2 * piece->number;
    *low = *piece;
    piece->number += piece->number > 0;
    low->high[cut] = piece->low[cut] = middle;
    // The two values between the ends of the cut are new, and the same for both.
    int step = cut == 0 ? 2 : 1, other = 3 - step;
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < 2 && piece->has_values[axis]; i++) {
            double u = cut == 0 ? middle : (i ? piece->high : piece->low)[0];
            double v = cut == 1 ? middle : (i ? piece->high : piece->low)[1];
            double value = value_at(shape, axis, u, v);
            piece->values[axis][other * i] = low->values[axis][other * i + step] = value;
        }
}

static void search(Search *s) {
    const ParametricShape *shape = s->shape->shape;
    Piece stack[STACK_SIZE];
    int top = 0;
    stack[0] = whole(shape);
    for (int left = MAX_PIECES; top >= 0 && left > 0; left--) {
        Piece *piece = &stack[top];
        double width = piece->high[0] - piece->low[0], height = piece->high[1] - piece->low[1];
        double at, length;
        if (!meet_piece(s, piece, &at, &length)) {
            top--;
            continue;
        }
        int cut = height > width;
        double size = cut ? height : width;
        double middle = (piece->high[cut] + piece->low[cut]) / 2.0;
        bool divides =
            middle > piece->low[cut] && middle < piece->high[cut] && top + 1 < STACK_SIZE;
        if (divides && !((size > length ? length : size) < shape->accuracy)) {
            halve(s->shape, piece, cut, middle);
            top++;
            continue;
        }
        if (at < s->t && at > s->enter)
            s->t = at, s->u = piece->low[0], s->v = piece->low[1];
        top--;
    }
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Parametric *shape = data;
    double t[2], accuracy = shape->shape->accuracy;
    if (!container_meet(&shape->shape->container, ray, t, NULL))
        return;
    if (!shape->shape->container.in_sphere)
        t[0] = fmax(t[0], 0.0);
    double enter = t[0] == t[1] ? 0.0 : t[0] / sink->scale;
    Search s = {.shape = shape,
                .org = ray->org,
                .dir = vec_scale(ray->dir, sink->scale),
                .enter = enter + 4.0 * accuracy,
                .leave = t[1] / sink->scale,
                .t = INFINITY};
    if (s.enter > s.leave)
        return;
    search(&s);
    if (s.t < s.leave)
        sink_put(sink, s.t * sink->scale, 0, vec3(s.u, s.v, 0));
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const Parametric *s = data;
    double h = s->shape->accuracy, u = hit->keep.x, v = hit->keep.y;
    double along_u[3], along_v[3];
    (void)p;
    for (int axis = 0; axis < 3; axis++) {
        double at = value_at(s, axis, u, v);
        along_u[axis] = value_at(s, axis, u + h, v) - at;
        along_v[axis] = value_at(s, axis, u, v + h) - at;
    }
    Vec3 n = vec_cross(vec3(along_u[0], along_u[1], along_u[2]),
                       vec3(along_v[0], along_v[1], along_v[2]));
    bool good = vec_is_finite(n) && vec_dot(n, n) > 0.0;
    return good ? n : vec3(1, 0, 0);
}

static Vec2 uv(const void *data, Vec3 p, const ShapeHit *hit) {
    (void)data, (void)p;
    return (Vec2){hit->keep.x, hit->keep.y};
}

static const SolidOps OPS = {
    .near = 0.0, .far = INFINITY, .hits = hits, .normal = normal, .uv = uv};

SolidData parametric_prepare(const ParametricShape *shape, const FunctionPool *pool, Arena *arena) {
    Parametric *s = ARENA_NEW(arena, Parametric);
    *s = (Parametric){.shape = shape, .pool = pool, .known = 1U << shape->depth};
    return (SolidData){&OPS, s, container_bounds(&shape->container)};
}

void parametric_complete(const SolidData *solid, Arena *arena) {
    Parametric *s = (Parametric *)(uintptr_t)solid->data;
    for (int axis = 0; axis < 3; axis++) {
        if (!s->shape->precompute[axis])
            continue;
        Range *ranges = ARENA_ARRAY(arena, Range, s->known);
        keep_ranges(s, ranges, axis, 1, whole(s->shape));
        s->ranges[axis] = ranges;
    }
}
