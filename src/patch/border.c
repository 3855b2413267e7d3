// SPDX-License-Identifier: MIT
// Sides are sorted by the place of their middle along a direction that no scene has built itself
// along, so that the same side of two patches comes next to each other. See border.h.
#include "patch/border.h"

#include <string.h>

// Points that two patches share, but that each has in its own rounding: that of the coordinates
// themselves, and of some cuts by midpoints (three roundings each, of a cubic), on both sides.
static const double ROUNDINGS = 32.0 * 0x1p-53;

// Where more sides than that have one middle (copies of a patch, a spine of many sheets) not all
// pairs are compared.
enum { SIDES = 4, MOST_COMPARED = 32 };

typedef struct {
    double place;  // of the middle between the side's corners
    uint32_t bits; // of the points in whichever order
    uint32_t side; // patch * 4 + side; u = 0, u = 1, v = 0, v = 1
} Side;

// Point k of a side.
static Vec3 side_point(const PatchDef *def, uint32_t side, uint32_t k) {
    uint32_t row = def->degree_v + 1;
    switch (side % SIDES) {
    case 0:
        return def->points[k];
    case 1:
        return def->points[def->degree_u * row + k];
    case 2:
        return def->points[k * row];
    default:
        return def->points[k * row + def->degree_v];
    }
}

static uint32_t side_degree(const PatchDef *def, uint32_t side) {
    return side % SIDES < 2 ? def->degree_v : def->degree_u;
}

static uint64_t mix(uint64_t h, double x) {
    uint64_t bits;
    x += 0.0; // -0 is 0
    memcpy(&bits, &x, sizeof bits);
    h = (h ^ bits) * 0x9e3779b97f4a7c15u;
    return h ^ h >> 29;
}

static Side side_of(const PatchDef *def, uint32_t number) {
    uint32_t degree = side_degree(def, number);
    uint64_t sum = degree;
    for (uint32_t k = 0; k <= degree; k++) {
        Vec3 p = side_point(def, number, k);
        sum += mix(mix(mix(0, p.x), p.y), p.z);
    }
    // Halves, since a sum may overflow; of unit length.
    Vec3 a = side_point(def, number, 0), b = side_point(def, number, degree);
    Vec3 middle = vec_add(vec_scale(a, 0.5), vec_scale(b, 0.5));
    double place = vec_dot(middle, vec3(0.6180339887, 0.5411961001, 0.5702951));
    return (Side){place, (uint32_t)(sum ^ sum >> 32), number};
}

// Bits that sort as the numbers do.
static uint64_t key_of(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits >> 63 ? ~bits : bits | (uint64_t)1 << 63;
}

// By radix, stable. Returns the one of the two arrays that has the result.
static Side *sort_sides(Side *from, Side *to, size_t count) {
    for (int shift = 0; shift < 64; shift += 8) {
        size_t first[257] = {0};
        for (size_t i = 0; i < count; i++)
            first[(key_of(from[i].place) >> shift & 255) + 1]++;
        for (int k = 0; k < 256; k++)
            first[k + 1] += first[k];
        for (size_t i = 0; i < count; i++)
            to[first[key_of(from[i].place) >> shift & 255]++] = from[i];
        Side *swap = from;
        from = to, to = swap;
    }
    return from;
}

// Largest distance between points of two sides, in the order in which they are alike.
static double mismatch(const PatchDef *a, uint32_t side_a, const PatchDef *b, uint32_t side_b) {
    uint32_t degree = side_degree(a, side_a);
    if (side_degree(b, side_b) != degree)
        return INFINITY;
    double forth = 0.0, back = 0.0;
    for (uint32_t k = 0; k <= degree; k++) {
        Vec3 p = side_point(a, side_a, k);
        forth = fmax(forth, vec_length(vec_sub(p, side_point(b, side_b, k))));
        back = fmax(back, vec_length(vec_sub(p, side_point(b, side_b, degree - k))));
    }
    return fmin(forth, back);
}

// How far side i is off those next to it in the list that are the same within the tolerance.
static double off_neighbours(const AccelPatch *patches, const Side *sides, size_t count, size_t i) {
    const Side *own = &sides[i];
    const AccelPatch *patch = &patches[own->side / SIDES];
    // The places carry 8 roundings.
    double reach = patch->tolerance + 8.0 * 0x1p-53 * fabs(own->place), most = 0.0;
    for (int way = -1; way <= 1; way += 2) {
        size_t at = i;
        for (int n = 0; n < MOST_COMPARED && (way < 0 ? at > 0 : at + 1 < count); n++) {
            at = way < 0 ? at - 1 : at + 1;
            const Side *other = &sides[at];
            if (!(fabs(other->place - own->place) <= reach))
                break;
            if (other->place == own->place && other->bits == own->bits)
                continue;
            double off =
                mismatch(patch->def, own->side, patches[other->side / SIDES].def, other->side);
            if (off <= patch->tolerance)
                most = fmax(most, off);
        }
    }
    return most;
}

void borders_find(AccelPatch *patches, size_t count) {
    if (count > UINT32_MAX / SIDES)
        count = 0; // more than the tree has room for
    Arena *scratch = arena_create();
    size_t side_count = SIDES * count;
    Side *sides = ARENA_ARRAY(scratch, Side, side_count);
    Side *room = ARENA_ARRAY(scratch, Side, side_count);
    double *off = ARENA_ARRAY(scratch, double, side_count);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < side_count; i++)
        sides[i] = side_of(patches[i / SIDES].def, (uint32_t)i);
    sides = sort_sides(sides, room, side_count);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < side_count; i++)
        off[sides[i].side] = off_neighbours(patches, sides, side_count, i);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < count; i++) {
        AccelPatch *p = &patches[i];
        double size = fmax(fabs(p->center.x), fmax(fabs(p->center.y), fabs(p->center.z)));
        p->border = ROUNDINGS * (size + p->radius);
        for (size_t k = 0; k < SIDES; k++)
            p->border = fmax(p->border, off[SIDES * i + k]);
    }
    arena_destroy(scratch);
}
