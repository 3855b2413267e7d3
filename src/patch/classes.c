// SPDX-License-Identifier: MIT
#include "patch/classes.h"

#include <string.h>

// A class holds sizes down to this share of its largest. Then a patch's box grows by a sixteenth of
// its size on each side in the tree's single precision (TREE_PAD).
static const double SPAN = 0x1p-16;

// Smaller patches than that, if there are no more, stay with the large ones: a ray asks a tree of
// its own for about as much. In the hostile test build each class is one.
#ifdef HOSTILE
enum { STAY = 0 };
#else
enum { STAY = 16 };
#endif
enum { MAX_CLASSES = 16 }; // the last takes what is left

static double larger(double a, double b) { return a > b ? a : b; }

static double size_of(const PatchDef *def) {
    Box box = box_empty();
    size_t count = (size_t)(def->degree_u + 1) * (def->degree_v + 1);
    for (size_t i = 0; i < count; i++)
        box = box_extend(box, def->points[i]);
    Vec3 d = vec_sub(box.high, box.low);
    return larger(d.x, larger(d.y, d.z));
}

// Moves the patches of the largest class to the front, all in their order; returns their number.
static size_t part_largest(PatchDef *defs, double *sizes, size_t count, PatchDef *spare,
                           double *spare_sizes) {
    double most = 0.0;
    for (size_t i = 0; i < count; i++)
        most = larger(most, sizes[i]);
    size_t front = 0, back = 0;
    for (size_t i = 0; i < count; i++) {
        if (sizes[i] >= SPAN * most) {
            sizes[front] = sizes[i];
            defs[front++] = defs[i];
        } else {
            spare_sizes[back] = sizes[i];
            spare[back++] = defs[i];
        }
    }
    memcpy(sizes + front, spare_sizes, back * sizeof *sizes);
    memcpy(defs + front, spare, back * sizeof *defs);
    return front;
}

static bool is_one_class(const double *sizes, size_t count) {
    double most = 0.0;
    size_t small = 0;
    for (size_t i = 0; i < count; i++)
        most = larger(most, sizes[i]);
    for (size_t i = 0; i < count; i++)
        small += sizes[i] < SPAN * most;
    return small <= STAY;
}

Accel *classes_build(Arena *arena, const PatchDef *defs, size_t count, PatchPrepare prepare) {
    Arena *scratch = arena_create();
    double *sizes = ARENA_ARRAY(scratch, double, count);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < count; i++)
        sizes[i] = size_of(&defs[i]);
    Accel *first = ARENA_NEW(arena, Accel), *last = first;
    if (is_one_class(sizes, count)) {
        pieces_build(arena, defs, count, count, prepare, first);
        arena_destroy(scratch);
        return first;
    }
    PatchDef *sorted = arena_copy(arena, defs, count * sizeof *defs);
    PatchDef *spare = ARENA_ARRAY(scratch, PatchDef, count);
    double *spare_sizes = ARENA_ARRAY(scratch, double, count);
    for (size_t at = 0, classes = 1; at < count; classes++) {
        size_t some = count - at;
        if (classes < MAX_CLASSES && !is_one_class(sizes + at, some))
            some = part_largest(sorted + at, sizes + at, some, spare, spare_sizes);
        if (at > 0)
            last = last->next = ARENA_NEW(arena, Accel);
        pieces_build(arena, sorted + at, some, count, prepare, last);
        last->is_class = true;
        at += some;
    }
    arena_destroy(scratch);
    return first;
}

// ---- Rays from far away

// high + low, twice the digits of double (Dekker 1971).
typedef struct {
    double high, low;
} Twice;

static Twice twice_sum(double a, double b) {
    double high = a + b, part = high - a;
    return (Twice){high, (a - (high - part)) + (b - part)};
}

static Twice twice_product(double a, double b) {
    double high = a * b, x = 134217729.0 * a, y = 134217729.0 * b; // 2^27 + 1
    double a1 = x - (x - a), a2 = a - a1, b1 = y - (y - b), b2 = b - b1;
    return (Twice){high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2};
}

// From org + t1 d + t2 d. All but the last sum is exact; t1 is rounded, so t1 d brings the point as
// near to 0 as 2^-53 of the way, and t2 d the rest. *error: of the result.
static double along(double org, double d, double t1, double t2, double *error) {
    Twice far = twice_product(t1, d), near = twice_product(t2, d);
    Twice a = twice_sum(org, far.high), b = twice_sum(a.high, far.low);
    Twice c = twice_sum(b.high, near.high);
    double small = ((a.low + b.low) + near.low) + c.low, at = c.high + small;
    *error =
        0x1p-50 * (fabs(a.low) + fabs(b.low) + fabs(near.low) + fabs(c.low)) + 0x1p-53 * fabs(at);
    return at;
}

bool classes_near(const Accel *accel, const Ray *ray, Ray *near) {
    const Vec3 center = accel->tree.center, d = ray->dir;
    double square = vec_dot(d, d), error[3];
    double t1 = -vec_dot(vec_sub(ray->org, center), d) / square;
    Vec3 p =
        vec3(along(ray->org.x, d.x, t1, 0.0, &error[0]), along(ray->org.y, d.y, t1, 0.0, &error[1]),
             along(ray->org.z, d.z, t1, 0.0, &error[2]));
    double t2 = -vec_dot(vec_sub(p, center), d) / square;
    near->dir = d;
    near->org =
        vec3(along(ray->org.x, d.x, t1, t2, &error[0]), along(ray->org.y, d.y, t1, t2, &error[1]),
             along(ray->org.z, d.z, t1, t2, &error[2]));
    // A quarter of TREE_PAD is not used (tree.c), and this is a quarter of that. What is not a
    // number, or beyond the range of numbers, is not known.
    double most = (error[0] + error[1] + error[2]) * accel->tree.scale;
    return most <= 0.0625 * (double)TREE_PAD;
}
