// SPDX-License-Identifier: MIT
// The walk through the tree and the test of eight thick parallelograms at a time.
//
// A point of a piece is X = c + a eu + b ev + e with |e| <= rho in each coordinate. On the ray
// o + s d, with r = o - c, m1 = d x ev, m2 = eu x d, n = eu x ev and det = eu . m1 = -d . n:
//     det a = (r - e) . m1     det b = (r - e) . m2     det s = (r - e) . n
// so each of a, b, s has an interval without a division: it misses [0,1] (or the ray's limits)
// if the numerators say so. Whatever is left holds the intervals of (a,b) in which root.c looks.
//
// Rounding. Let w = 2^-24, L >= |eu|, |ev|, R the block's radius or L if that is more, all numbers
// relative to the block's center. Per coordinate: |m| <= 2 L, off by 8 L w (inputs 2 w, products
// 1 w, sum 1 w); |r| <= 2 R, off by 4 R w and by the ray's own error; a dot product of three
// adds 3 w of its terms. So
//     r . m: 3 (4 R 2 L + 2 R 8 L + 3 . 4 R L) w = 108 R L w;  rho . |m| the same or less;
//     det:   3 (8 L L + 2 L L + 3 . 2 L L) w = 48 L L w;       comparisons: under 32 R L w,
// together below 512 R L w. For s: |n| <= 2 L^2, off by 8 L^2 w, and s, at most 2 R, times det:
// below 1024 R L^2 w in the same way.
#include "patch/accel.h"

#include "patch/piece.h"
#include "patch/root.h"

#include <assert.h>
#include <string.h>

enum { MERGE = 64 };

// A hit reported to QUERY_ALL, kept to know it again.
typedef struct {
    uint32_t patch;
    double t, u, v, error_t, error_u, error_v;
    int sign;
} Seen;

typedef struct {
    const Accel *accel;
    Query *query;
    Vec3 dir;       // of unit length
    double t_per_s; // 1 / length of the ray's own
    uint32_t patch; // ray is set up for this one
    PatchRay ray;
    Seen seen[MERGE]; // the last ones, a ring
    uint64_t seen_count;
} Walk;

// ---- Hits

// The same crossing found from two pieces? Both are right within their errors. Where the surface
// is singular (sign 0) only the place in space is well defined.
static bool same_root(const Seen *a, const Seen *b) {
    if (a->patch != b->patch || a->sign * b->sign < 0 ||
        fabs(a->t - b->t) > a->error_t + b->error_t)
        return false;
    if (a->sign == 0 || b->sign == 0)
        return true;
    return fabs(a->u - b->u) <= a->error_u + b->error_u &&
           fabs(a->v - b->v) <= a->error_v + b->error_v;
}

static bool take_root(void *context, const Root *root) {
    Walk *walk = context;
    Query *query = walk->query;
    if (query->kind == QUERY_ALL) {
        const AccelPatch *patch = walk->ray.patch;
        Seen now = {walk->patch,
                    root->hit.t,
                    root->hit.u,
                    root->hit.v,
                    (root->hit.bound + patch->tolerance) * walk->ray.t_per_s,
                    root->error_u,
                    root->error_v,
                    root->sign};
        uint64_t count = walk->seen_count < MERGE ? walk->seen_count : MERGE;
        for (uint64_t i = 0; i < count; i++) {
            if (same_root(&walk->seen[i], &now))
                return true;
        }
        walk->seen[walk->seen_count++ % MERGE] = now;
    }
    query_take(query, &root->hit);
    return !query_done(query);
}

// ---- A leaf

// The numerators and their uncertainties for eight lanes, det made positive.
typedef struct {
    float det[BLOCK_LANES], a[BLOCK_LANES], b[BLOCK_LANES], s[BLOCK_LANES];
    float wa[BLOCK_LANES], wb[BLOCK_LANES], ws[BLOCK_LANES];
    int32_t meets[BLOCK_LANES];
} Lanes;

typedef struct {
    float o[3], d[3];
    float s_low, s_high; // limits
    float error, error_s;
} LocalRay;

static inline float cross_x(float ay, float az, float by, float bz) { return ay * bz - az * by; }

static inline void test_lanes(const Block *block, const LocalRay *ray, Lanes *out) {
    const float dx = ray->d[0], dy = ray->d[1], dz = ray->d[2];
    for (int i = 0; i < BLOCK_LANES; i++) {
        float ux = block->eu[0][i], uy = block->eu[1][i], uz = block->eu[2][i];
        float vx = block->ev[0][i], vy = block->ev[1][i], vz = block->ev[2][i];
        float hx = block->rho[0][i], hy = block->rho[1][i], hz = block->rho[2][i];
        float rx = ray->o[0] - block->c[0][i], ry = ray->o[1] - block->c[1][i],
              rz = ray->o[2] - block->c[2][i];
        float m1x = cross_x(dy, dz, vy, vz), m1y = cross_x(dz, dx, vz, vx),
              m1z = cross_x(dx, dy, vx, vy);
        float m2x = cross_x(uy, uz, dy, dz), m2y = cross_x(uz, ux, dz, dx),
              m2z = cross_x(ux, uy, dx, dy);
        float nx = cross_x(uy, uz, vy, vz), ny = cross_x(uz, ux, vz, vx),
              nz = cross_x(ux, uy, vx, vy);
        float det = ux * m1x + uy * m1y + uz * m1z;
        float sign = det < 0.0f ? -1.0f : 1.0f;
        float a = sign * (rx * m1x + ry * m1y + rz * m1z);
        float b = sign * (rx * m2x + ry * m2y + rz * m2z);
        float s = sign * (rx * nx + ry * ny + rz * nz);
        float wa = hx * fabsf(m1x) + hy * fabsf(m1y) + hz * fabsf(m1z) + ray->error;
        float wb = hx * fabsf(m2x) + hy * fabsf(m2y) + hz * fabsf(m2z) + ray->error;
        float ws = hx * fabsf(nx) + hy * fabsf(ny) + hz * fabsf(nz) + ray->error_s;
        det *= sign;
        out->det[i] = det;
        out->a[i] = a;
        out->b[i] = b;
        out->s[i] = s;
        out->wa[i] = wa;
        out->wb[i] = wb;
        out->ws[i] = ws;
        out->meets[i] = (a + wa >= 0.0f) & (a - wa <= det) & (b + wb >= 0.0f) & (b - wb <= det) &
                        (s + ws >= ray->s_low * det) & (s - ws <= ray->s_high * det);
    }
}

// Moves the ray's origin to where it is nearest to the block's center. False: it passes the ball.
static inline bool to_block(const Block *block, const TreeRay *ray, LocalRay *out) {
    double x = ray->origin[0] - block->center[0], y = ray->origin[1] - block->center[1],
           z = ray->origin[2] - block->center[2];
    const double *d = ray->dir;
    double shift = -(x * d[0] + y * d[1] + z * d[2]);
    x += shift * d[0];
    y += shift * d[1];
    z += shift * d[2];
    double radius = block->radius, reach = radius + 4.0 * ray->error;
    if (x * x + y * y + z * z > reach * reach * (1.0 + 0x1p-40))
        return false;
    out->o[0] = (float)x;
    out->o[1] = (float)y;
    out->o[2] = (float)z;
    for (int axis = 0; axis < 3; axis++)
        out->d[axis] = (float)d[axis];
    // Limits outside the ball say nothing, and would be large numbers.
    double low = (double)ray->s_min - shift, high = (double)ray->s_max - shift;
    if (ray->far || low < -2.0 * radius)
        low = -2.0 * radius;
    if (ray->far || high > 2.0 * radius)
        high = 2.0 * radius;
    if (low > high)
        return false;
    out->s_low = (float)low;
    out->s_high = (float)high;
    double edge = block->edge, error = 512.0 * 0x1p-24 * fmax(radius, edge) + 8.0 * ray->error;
    out->error = (float)(error * edge);
    out->error_s = (float)(2.0 * error * edge * edge);
    return true;
}

// The interval of a numerator as a part of [0,1], in the parameters from `from` to `to`.
static void narrow(float n, float w, float det, double *from, double *to) {
    double low = ((double)n - (double)w) / (double)det,
           high = ((double)n + (double)w) / (double)det;
    double start = *from, width = *to - *from;
    if (low > 0.0)
        *from = fmin(start + width * low, *to);
    if (high < 1.0)
        *to = fmax(start + width * high, *from);
}

static bool search_piece(Walk *walk, const Block *block, const Lanes *lanes, int lane) {
    const Accel *accel = walk->accel;
    const Piece *piece = &accel->pieces[block->first + (uint32_t)lane];
    const AccelPatch *patch = &accel->patches[piece->patch];
    if (!(patch->def->mask & walk->query->mask))
        return true;
    if (walk->patch != piece->patch) {
        walk->patch = piece->patch;
        patch_ray_init(&walk->ray, patch, &walk->query->ray, walk->dir, walk->t_per_s);
    }
    BezierRect rect = piece->rect;
    if (lanes->det[lane] > 0.0f) {
        narrow(lanes->a[lane], lanes->wa[lane], lanes->det[lane], &rect.u0, &rect.u1);
        narrow(lanes->b[lane], lanes->wb[lane], lanes->det[lane], &rect.v0, &rect.v1);
    }
    return root_search(&walk->ray, piece, rect, walk->query, take_root, walk);
}

static bool visit_leaf(void *context, uint32_t leaf, TreeRay *ray) {
    Walk *walk = context;
    const Block *block = &walk->accel->blocks[leaf];
    LocalRay local;
    walk->query->stats.patch_tests += block->count;
    if (!to_block(block, ray, &local))
        return true;
    walk->query->stats.steps += block->count;
    Lanes lanes;
    test_lanes(block, &local, &lanes);

    // Search what is left from near to far.
    int order[BLOCK_LANES], count = 0;
    float near[BLOCK_LANES];
    for (int i = 0; i < (int)block->count; i++) {
        if (!lanes.meets[i])
            continue;
        float from = lanes.det[i] > 0.0f ? (lanes.s[i] - lanes.ws[i]) / lanes.det[i] : local.s_low;
        int at = count++;
        for (; at > 0 && near[at - 1] > from; at--) {
            near[at] = near[at - 1];
            order[at] = order[at - 1];
        }
        near[at] = from;
        order[at] = i;
    }
    for (int i = 0; i < count; i++) {
        double before = walk->query->t_max;
        if (!search_piece(walk, block, &lanes, order[i]))
            return false;
        if (walk->query->t_max < before) {
            tree_ray_cut(ray, walk->query->t_max);
            LocalRay cut;
            if (!to_block(block, ray, &cut))
                return true;
            while (i + 1 < count && near[i + 1] > cut.s_high)
                count--;
        }
    }
    return true;
}

Accel *accel_create(Arena *arena, const PatchDef *defs, size_t count, double tolerance) {
    Accel *accel = ARENA_NEW(arena, Accel);
    pieces_build(arena, defs, count, tolerance, accel);
    return accel;
}

void accel_query(const Accel *accel, Query *query) {
    TreeRay ray;
    if (!tree_ray_begin(&accel->tree, &query->ray, query->t_min, query->t_max, &ray))
        return;
    Walk walk;
    walk.accel = accel;
    walk.query = query;
    walk.dir = ray.unit;
    walk.t_per_s = accel->tree.scale / ray.s_per_t;
    walk.patch = UINT32_MAX;
    walk.seen_count = 0;
    tree_walk(&accel->tree, &ray, visit_leaf, &walk);
}
