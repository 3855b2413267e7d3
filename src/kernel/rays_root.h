// SPDX-License-Identifier: MIT
// The rays of a packet that meet one cubic piece in which each has one root at most: the guess of
// single.h and the steps of newton.h for all of them at once, the same numbers. What does not end
// on a root is left to those.
#ifndef KERNEL_RAYS_ROOT_H
#define KERNEL_RAYS_ROOT_H

#include "kernel/newton.h"
#include "kernel/rays.h"

// Rays in the frame of a piece.
typedef struct {
    RAYS_ALIGNED float p[3][RAYS];
    float q[3][RAYS];
} RaysLocal;

typedef struct {
    WD x, y, z;
} Wide3;

static inline Wide3 wide3_load(const double a[3][RAYS], int i) {
    return (Wide3){wd_load(a[0] + i), wd_load(a[1] + i), wd_load(a[2] + i)};
}
static inline Wide3 wide3_sub(Wide3 a, Wide3 b) { return (Wide3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline Wide3 wide3_scale(Wide3 a, WD s) { return (Wide3){a.x * s, a.y * s, a.z * s}; }
static inline Wide3 wide3_madd(Wide3 a, WD s, Wide3 b) {
    return (Wide3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static inline WD wide3_dot(Wide3 a, Wide3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Wide3 wide3_cross(Wide3 a, Wide3 b) {
    return (Wide3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline WD wide3_length(Wide3 a) { return wd_sqrt(wide3_dot(a, a)); }
static inline WD wide3_length1(Wide3 a) { return wd_abs(a.x) + wd_abs(a.y) + wd_abs(a.z); }
static inline WD wd_clamp(WD x, WD low, WD high) { return wd_max(low, wd_min(high, x)); }

// ---- The guess

static inline WF wf_unit(WF x) { return wf_max(wf_all(-1.0f), wf_min(wf_all(1.0f), x)); }

static inline void rays_guess(const Piece *piece, const RaysLocal *local, int i, float *a_out,
                              float *b_out) {
    WF qz = wf_load(local->q[2] + i), pz = wf_load(local->p[2] + i);
    WF steep = 1.0f / qz;
    WF gx = wf_load(local->q[0] + i) * steep, gy = wf_load(local->q[1] + i) * steep;
    WF x0 = wf_load(local->p[0] + i) - pz * gx, y0 = wf_load(local->p[1] + i) - pz * gy;
    WF a = wf_unit(x0 * piece->scale_a + piece->shift_a);
    WF b = wf_unit(y0 * piece->scale_b + piece->shift_b);
    for (int step = 0; step < GUESS_STEPS; step++) {
        WF b2 = b * b, twice = b + b, thrice = 3.0f * b2;
        WF a2 = a * a, twice_a = 2.0f * a, thrice_a2 = 3.0f * (a * a);
        WF at[3], along_a[3], along_b[3];
        for (int k = 0; k < 3; k++) {
            WF f[4], slope[4]; // by the power of a
            for (int n = 0; n < 4; n++) {
                float c0 = piece->poly[0][n][k], c1 = piece->poly[1][n][k],
                      c2 = piece->poly[2][n][k], c3 = piece->poly[3][n][k];
                f[n] = (c0 + b * c1) + b2 * (c2 + b * c3);
                slope[n] = c1 + (twice * c2 + thrice * c3);
            }
            at[k] = (f[0] + a2 * f[2]) + a * (f[1] + a2 * f[3]);
            along_b[k] = (slope[0] + a2 * slope[2]) + a * (slope[1] + a2 * slope[3]);
            along_a[k] = f[1] + (twice_a * f[2] + thrice_a2 * f[3]);
        }
        WF x = at[0] - gx * at[2] - x0, y = at[1] - gy * at[2] - y0;
        WF xa = along_a[0] - gx * along_a[2], ya = along_a[1] - gy * along_a[2];
        WF xb = along_b[0] - gx * along_b[2], yb = along_b[1] - gy * along_b[2];
        WF part = 1.0f / (xa * yb - xb * ya);
        a = wf_unit(a - (x * yb - y * xb) * part);
        b = wf_unit(b - (y * xa - x * ya) * part);
    }
    wf_store(a_out + i, a);
    wf_store(b_out + i, b);
}

// ---- The steps

// S, Su, Sv, as eval_cubic.
static inline void rays_eval(const double *points, WD u, WD v, Wide3 out[3]) {
    WD r = 1.0 - u, s = 1.0 - v;
    WD wu[3] = {r * r, 2.0 * r * u, u * u}, wv[3] = {s * s, 2.0 * s * v, v * v};
    WD *sums[3] = {&out[0].x, &out[0].y, &out[0].z};
    WD *sums_u[3] = {&out[1].x, &out[1].y, &out[1].z};
    WD *sums_v[3] = {&out[2].x, &out[2].y, &out[2].z};
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        WD low[4], high[4];
#pragma GCC unroll 4
        for (int j = 0; j < 4; j++) {
            const double *p = points + 12 * j + k;
            low[j] = wu[0] * p[0] + wu[1] * p[3] + wu[2] * p[6];
            high[j] = wu[0] * p[3] + wu[1] * p[6] + wu[2] * p[9];
        }
        WD ll = wv[0] * low[0] + wv[1] * low[1] + wv[2] * low[2];
        WD lh = wv[0] * low[1] + wv[1] * low[2] + wv[2] * low[3];
        WD hl = wv[0] * high[0] + wv[1] * high[1] + wv[2] * high[2];
        WD hh = wv[0] * high[1] + wv[1] * high[2] + wv[2] * high[3];
        WD near = s * ll + v * lh, far = s * hl + v * hh;
        *sums[k] = r * near + u * far;
        *sums_u[k] = 3.0 * (far - near);
        *sums_v[k] = 3.0 * (r * (lh - ll) + u * (hh - hl));
    }
}

// As PatchRay.
typedef struct {
    Wide3 org, dir;
    WD t_base, t_per_s, error;
} RaysAtPatch;

static inline RaysAtPatch rays_at_patch(const RayPacket *p, int i, const AccelPatch *patch) {
    Wide3 dir = wide3_load(p->dir, i), org = wide3_load(p->org, i);
    Wide3 away = {org.x - patch->center.x, org.y - patch->center.y, org.z - patch->center.z};
    WD shift = -wide3_dot(away, dir), t_per_s = wd_load(p->t_per_s + i);
    return (RaysAtPatch){wide3_madd(away, shift, dir), dir, shift * t_per_s, t_per_s,
                         24.0 * 0x1p-53 * wide3_length1(away) + 4.0 * patch->rounding};
}

// Hits side by side.
typedef struct {
    WD t, u, v, bound;
    Wide3 normal;
} RaysHit;

// As walk_in_range, but for what only equals hits: rays_take chooses of those.
static inline unsigned rays_in_range(const RayPacket *p, int i, WD t) {
    WD order = p->kind == QUERY_NEAREST ? wd_max(t, wd_load(p->t_least + i)) : t;
    return wd_le(wd_load(p->t_min + i), t) & wd_le(order, wd_load(p->t_max + i));
}

// As walk_take, for the rays i + bits.
static inline void rays_take(RayPacket *p, int i, unsigned bits, const RaysHit *hit, uint32_t patch,
                             uint32_t piece) {
    WD t_max = wd_load(p->t_max + i);
    bits &= wd_le(wd_load(p->t_min + i), hit->t);
    if (p->kind == QUERY_ANY) {
        p->found |= (bits & wd_lt(hit->t, t_max)) << i;
        return;
    }
    WD order = wd_max(hit->t, wd_load(p->t_least + i));
    unsigned equal = bits & wd_eq(order, t_max) & p->found >> i;
    bits &= wd_lt(order, t_max);
    for (; equal; equal &= equal - 1) {
        int lane = i + __builtin_ctz(equal);
        if (patch < p->best_patch[lane] ||
            (patch == p->best_patch[lane] && piece < p->best_piece[lane]))
            bits |= equal & -equal;
    }
    if (!bits)
        return;
    p->found |= bits << i;
    for (unsigned left = bits; left; left &= left - 1) {
        p->best_patch[i + __builtin_ctz(left)] = patch;
        p->best_piece[i + __builtin_ctz(left)] = piece;
    }
    double *to[7] = {p->t + i,         p->u + i,         p->v + i,        p->bound + i,
                     p->normal[0] + i, p->normal[1] + i, p->normal[2] + i};
    const WD from[7] = {hit->t,        hit->u,        hit->v,       hit->bound,
                        hit->normal.x, hit->normal.y, hit->normal.z};
    for (int n = 0; n < 7; n++)
        wd_store(to[n], wd_pick(bits, from[n], wd_load(to[n])));
    order = wd_pick(bits, order, t_max);
    wd_store(p->t_max + i, order);
    rays_cut(p, i, order);
}

// As newton_sharpen from the guesses a, b in the piece, for the rays i + bits. Returns the bits of
// those that got lost on the way.
static inline unsigned rays_sharpen(RayPacket *p, int i, unsigned bits, uint32_t number,
                                    const float *a_guess, const float *b_guess) {
    const Piece *piece = accel_piece(p->accel, number);
    const AccelPatch *patch = &p->accel->patches[piece->patch];
    const BezierRect rect = piece_rect(piece);
    WD u = 0.5 * (rect.u0 + rect.u1) + 0.5 * (rect.u1 - rect.u0) * wd_from_floats(a_guess + i);
    WD v = 0.5 * (rect.v0 + rect.v1) + 0.5 * (rect.v1 - rect.v0) * wd_from_floats(b_guess + i);
    u = wd_clamp(u, wd_all(rect.u0), wd_all(rect.u1));
    v = wd_clamp(v, wd_all(rect.v0), wd_all(rect.v1));
    const RaysAtPatch rays = rays_at_patch(p, i, patch);
    const Wide3 dir = rays.dir;
    const WD error = rays.error;

    double hair_u = PIECE_MARGIN * (rect.u1 - rect.u0), hair_v = PIECE_MARGIN * (rect.v1 - rect.v0);
    const WD u0 = wd_all(larger(rect.u0 - hair_u, 0.0)),
             u1 = wd_all(smaller(rect.u1 + hair_u, 1.0));
    const WD v0 = wd_all(larger(rect.v0 - hair_v, 0.0)),
             v1 = wd_all(smaller(rect.v1 + hair_v, 1.0));
    const double muu = (double)piece->muu, muv = (double)piece->muv, mvv = (double)piece->mvv;
    const WD least = 2.0 * error, tolerance = wd_max(wd_all(patch->tolerance), least);
    const WD beside = wd_max(wd_min(tolerance, wd_all(patch->border)), least);
    const WD zero = wd_all(0.0), one = wd_all(1.0);
    unsigned lost = 0;
    for (int step = 0; step < NEWTON_STEPS && bits; step++) {
        p->stats->newton += (uint64_t)__builtin_popcount(bits);
        Wide3 s[3];
        rays_eval(patch->own, u, v, s);
        Wide3 su = s[1], sv = s[2], r = wide3_sub(rays.org, s[0]);
        Wide3 m1 = wide3_cross(dir, sv), m2 = wide3_cross(su, dir);
        WD det = wide3_dot(su, m1), steep = 1.0 / det;
        unsigned flat = bits & ~wd_lt(wd_all(0.0), wd_abs(det));
        lost |= flat;
        bits &= ~flat;
        WD a = wd_clamp(wide3_dot(r, m1) * steep, u0 - u, u1 - u);
        WD b = wd_clamp(wide3_dot(r, m2) * steep, v0 - v, v1 - v);
        WD turn_u = muu * wd_abs(a) + muv * wd_abs(b), turn_v = muv * wd_abs(a) + mvv * wd_abs(b);
        WD rest = 0.5 * (turn_u * wd_abs(a) + turn_v * wd_abs(b));
        u = wd_clamp(u + a, u0, u1);
        v = wd_clamp(v + b, v0, v1);
        unsigned border = wd_le(u, zero) | wd_le(one, u) | wd_le(v, zero) | wd_le(one, v);
        WD limit = wd_pick(border, beside, tolerance);
        unsigned ends = bits & wd_le(rest, limit);
        if (!ends)
            continue;
        Wide3 off = wide3_sub(wide3_sub(r, wide3_scale(su, a)), wide3_scale(sv, b));
        WD depth = -wide3_dot(off, dir);
        Wide3 across = wide3_madd(off, depth, dir), n = wide3_cross(su, sv);
        WD distance = wide3_length1(across) + rest + error, area = wide3_length(n);
        WD turn = turn_u * wide3_length1(sv) + turn_v * wide3_length1(su);
        unsigned good = ends & wd_le(distance, limit) & wd_le(turn, NEWTON_NORMAL_ERROR * area);
        unsigned nowhere = ends & ~good & wd_lt(4.0 * limit, distance);
        lost |= nowhere;
        bits &= ~nowhere;
        if (!good)
            continue;
        bits &= ~good;
        // Of the others it is known what they are worth.
        WD t = rays.t_base + depth * rays.t_per_s;
        good &= rays_in_range(p, i, t);
        unsigned turns = p->kind == QUERY_ANY ? 0 : good & wd_lt(NEWTON_NORMAL_TURN * area, turn);
        if (turns) {
            rays_eval(patch->own, wd_clamp(u, wd_all(0.0), wd_all(1.0)),
                      wd_clamp(v, wd_all(0.0), wd_all(1.0)), s);
            Wide3 there = wide3_cross(s[1], s[2]);
            n = (Wide3){wd_pick(turns, there.x, n.x), wd_pick(turns, there.y, n.y),
                        wd_pick(turns, there.z, n.z)};
            area = wide3_length(n);
            unsigned none = turns & ~wd_lt(wd_all(0.0), area);
            lost |= none;
            good &= ~none;
        }
        RaysHit hit = {t, u, v, distance, wide3_scale(n, 1.0 / area)};
        rays_take(p, i, good, &hit, piece->patch, number);
    }
    return lost | bits;
}

#endif
