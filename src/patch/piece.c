// SPDX-License-Identifier: MIT
// Cuts patches into thick parallelograms and lays them out for accel.c; see piece.h.
#include "patch/piece.h"

#include "base/array.h"
#include "patch/quasi.h"

#include <assert.h>
#include <float.h>
#include <string.h>

// A patch is cut until the thickness of its pieces is this share of their size.
static const double SHARE = 0.03;

enum {
    MAX_DEPTH = 20,         // halvings, u and v together
    PIECES_A_PATCH = 4096,  // more are not worth their memory
    PIECES_IN_ALL = 1 << 22 // about 500 MB; many patches are cut more coarsely
};

typedef struct {
    Piece piece;
    Vec3 c, eu, ev, rho; // about the patch's center, scene units
    Box box;             // the same
} Cut;

typedef struct {
    const AccelPatch *patch;
    const Bezier *whole; // about its center
    uint32_t number;
    double share, size;
    size_t limit;
    ARRAY(Cut) cuts;
} Cutter;

// ---- Evaluation

static void weights_cubic(double t, double w[4], double dw[4]) {
    double s = 1.0 - t;
    w[0] = s * s * s;
    w[1] = 3.0 * s * s * t;
    w[2] = 3.0 * s * t * t;
    w[3] = t * t * t;
    dw[0] = -3.0 * s * s;
    dw[1] = 3.0 * s * (s - 2.0 * t);
    dw[2] = 3.0 * t * (2.0 * s - t);
    dw[3] = 3.0 * t * t;
}

// Bernstein weights of degree n and their derivatives.
static void weights(int n, double t, double *w, double *dw) {
    double s = 1.0 - t, low[BEZIER_MAX_DEGREE + 2] = {0.0, 1.0}; // degree n - 1, shifted by one
    for (int k = 1; k < n; k++) {
        for (int i = k + 1; i > 0; i--)
            low[i] = low[i] * s + low[i - 1] * t;
    }
    for (int i = 0; i <= n; i++) {
        w[i] = low[i + 1] * s + low[i] * t;
        dw[i] = n * (low[i] - low[i + 1]);
    }
}

static void eval_cubic(const double *local, double u, double v, Vec3 out[3]) {
    double wu[4], du[4], wv[4], dv[4], result[3][3];
    weights_cubic(u, wu, du);
    weights_cubic(v, wv, dv);
    for (int axis = 0; axis < 3; axis++) {
        const double *p = local + 16 * axis;
        double row[4], slope[4];
        for (int i = 0; i < 4; i++) {
            row[i] = wv[0] * p[i] + wv[1] * p[4 + i] + wv[2] * p[8 + i] + wv[3] * p[12 + i];
            slope[i] = dv[0] * p[i] + dv[1] * p[4 + i] + dv[2] * p[8 + i] + dv[3] * p[12 + i];
        }
        result[0][axis] = wu[0] * row[0] + wu[1] * row[1] + wu[2] * row[2] + wu[3] * row[3];
        result[1][axis] = du[0] * row[0] + du[1] * row[1] + du[2] * row[2] + du[3] * row[3];
        result[2][axis] = wu[0] * slope[0] + wu[1] * slope[1] + wu[2] * slope[2] + wu[3] * slope[3];
    }
    for (int k = 0; k < 3; k++)
        out[k] = vec3(result[k][0], result[k][1], result[k][2]);
}

static void eval_any(const AccelPatch *patch, double u, double v, Vec3 out[3]) {
    int nu = (int)patch->def->degree_u, nv = (int)patch->def->degree_v;
    double wu[BEZIER_MAX_DEGREE + 1], du[BEZIER_MAX_DEGREE + 1];
    double wv[BEZIER_MAX_DEGREE + 1], dv[BEZIER_MAX_DEGREE + 1], result[3][3] = {{0.0}};
    weights(nu, u, wu, du);
    weights(nv, v, wv, dv);
    const double *p = patch->local;
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i <= nu; i++, p += nv + 1) {
            double row = 0.0, slope = 0.0;
            for (int j = 0; j <= nv; j++) {
                row += wv[j] * p[j];
                slope += dv[j] * p[j];
            }
            result[0][axis] += wu[i] * row;
            result[1][axis] += du[i] * row;
            result[2][axis] += wu[i] * slope;
        }
    }
    for (int k = 0; k < 3; k++)
        out[k] = vec3(result[k][0], result[k][1], result[k][2]);
}

void piece_eval(const AccelPatch *patch, double u, double v, Vec3 out[3]) {
    if (patch->cubic)
        eval_cubic(patch->local, u, v, out);
    else
        eval_any(patch, u, v, out);
}

// ---- Cutting

// The bound of |S_uu|, from the second differences of the net over the rectangle.
static double bound_uu(const Bezier *s, double width) {
    if (s->du < 2)
        return 0.0;
    double largest = 0.0;
    for (int i = 0; i + 2 <= s->du; i++) {
        for (int j = 0; j <= s->dv; j++) {
            Vec3 d = vec_add(vec_sub(bezier_at(s, i, j), vec_scale(bezier_at(s, i + 1, j), 2.0)),
                             bezier_at(s, i + 2, j));
            largest = fmax(largest, vec_length(d));
        }
    }
    return largest * s->du * (s->du - 1) / (width * width);
}

static double bound_vv(const Bezier *s, double height) {
    if (s->dv < 2)
        return 0.0;
    double largest = 0.0;
    for (int i = 0; i <= s->du; i++) {
        for (int j = 0; j + 2 <= s->dv; j++) {
            Vec3 d = vec_add(vec_sub(bezier_at(s, i, j), vec_scale(bezier_at(s, i, j + 1), 2.0)),
                             bezier_at(s, i, j + 2));
            largest = fmax(largest, vec_length(d));
        }
    }
    return largest * s->dv * (s->dv - 1) / (height * height);
}

static double bound_uv(const Bezier *s, double area) {
    double largest = 0.0;
    for (int i = 0; i < s->du; i++) {
        for (int j = 0; j < s->dv; j++) {
            Vec3 d = vec_sub(vec_sub(bezier_at(s, i + 1, j + 1), bezier_at(s, i + 1, j)),
                             vec_sub(bezier_at(s, i, j + 1), bezier_at(s, i, j)));
            largest = fmax(largest, vec_length(d));
        }
    }
    return largest * s->du * s->dv / area;
}

// Upwards, with room for the rounding of the differences of a net whose points are off by `error`.
static float bound_up(double bound, double error) {
    double up = (bound + error) * (1.0 + 0x1p-20) + DBL_MIN;
    return up < (double)FLT_MAX ? (float)up : INFINITY;
}

// What float cannot hold is left out: it only makes a guess better.
static float to_float(double x) { return fabs(x) < (double)FLT_MAX ? (float)x : 0.0f; }

// The affine part of the net, the box of the rest, and the box of the surface.
static void make_cut(const Cutter *k, const Bezier *s, const Bezier *net, BezierRect rect,
                     Cut *out) {
    int du = s->du, dv = s->dv;
    Vec3 a = bezier_at(net, 0, 0), b = bezier_at(net, 0, dv);
    Vec3 c = bezier_at(net, du, 0), d = bezier_at(net, du, dv);
    out->eu = vec_scale(vec_add(vec_sub(c, a), vec_sub(d, b)), 0.5);
    out->ev = vec_scale(vec_add(vec_sub(b, a), vec_sub(d, c)), 0.5);
    Box rest = box_empty();
    for (int i = 0; i <= du; i++) {
        for (int j = 0; j <= dv; j++) {
            Vec3 affine = vec_madd(vec_scale(out->eu, (double)i / du), (double)j / dv, out->ev);
            rest = box_extend(rest, vec_sub(bezier_at(net, i, j), affine));
        }
    }
    out->c = vec_scale(vec_add(rest.low, rest.high), 0.5);
    // bezier_rounding() covers the net; the affine part adds as much again.
    double error = 2.0 * bezier_rounding(k->whole);
    Vec3 slack = vec3(error, error, error), e = quasi_deviation_axes(s);
    out->rho = vec_add(vec_scale(vec_sub(rest.high, rest.low), 0.5), vec_add(e, slack));
    Box hull = bezier_bounds(s), thick = bezier_bounds(net);
    hull = (Box){vec_sub(hull.low, slack), vec_add(hull.high, slack)};
    e = vec_add(e, slack);
    out->box.low = vec_max(hull.low, vec_sub(thick.low, e));
    out->box.high = vec_min(hull.high, vec_add(thick.high, e));
    double width = rect.u1 - rect.u0, height = rect.v1 - rect.v0;
    error = 8.0 * bezier_rounding(k->whole);
    out->piece =
        (Piece){.rect = rect,
                .muu = bound_up(bound_uu(s, width), error * du * du / (width * width)),
                .muv = bound_up(bound_uv(s, width * height), error * du * dv / (width * height)),
                .mvv = bound_up(bound_vv(s, height), error * dv * dv / (height * height)),
                .patch = k->number};
    BezierJet jet;
    bezier_eval2(s, 0.5, 0.5, &jet);
    for (int axis = 0; axis < 3; axis++) {
        out->piece.suu[axis] = to_float(vec_get(jet.suu, axis) / (width * width));
        out->piece.suv[axis] = to_float(vec_get(jet.suv, axis) / (width * height));
        out->piece.svv[axis] = to_float(vec_get(jet.svv, axis) / (height * height));
    }
}

// Is a cut across u (rather than v) what makes the piece flatter? A bend of second differences D
// in degree n has the sag n^2 D / 8; a twist gives way to either, then the longer side is cut.
static bool cut_across_u(const Bezier *s, const Cut *cut) {
    QuasiDifferences d = quasi_differences(s);
    double bend_u = d.length_u * s->du * s->du / 8.0, bend_v = d.length_v * s->dv * s->dv / 8.0;
    Vec3 twist = vec_sub(vec_sub(bezier_at(s, s->du, s->dv), bezier_at(s, s->du, 0)),
                         vec_sub(bezier_at(s, 0, s->dv), bezier_at(s, 0, 0)));
    if (vec_length(twist) / 4.0 > fmax(bend_u, bend_v))
        return vec_length(cut->eu) > vec_length(cut->ev);
    return bend_u > bend_v;
}

static void cut_rect(Cutter *k, BezierRect rect, int depth) {
    Bezier s, net;
    bezier_copy(&s, k->whole);
    bezier_restrict(&s, rect, &s);
    quasi_net(&s, &net);
    Cut cut;
    make_cut(k, &s, &net, rect, &cut);
    // Size is not taken below a sixteenth of the patch's: near a collapsed edge pieces stay wide
    // for their length however often they are cut.
    double size = fmax(fmax(vec_length(cut.eu), vec_length(cut.ev)), k->size / 16.0);
    double thick = vec_length(cut.rho);
    // Thickness of rounding alone (4 sqrt(3) of it, see make_cut) does not go away.
    bool enough = thick <= fmax(k->share * size, 8.0 * bezier_rounding(k->whole));
    if (enough || depth == MAX_DEPTH || k->cuts.count > k->limit) {
        array_push(&k->cuts, cut);
        return;
    }
    BezierRect low = rect, high = rect;
    if (cut_across_u(&s, &cut))
        low.u1 = high.u0 = 0.5 * (rect.u0 + rect.u1);
    else
        low.v1 = high.v0 = 0.5 * (rect.v0 + rect.v1);
    cut_rect(k, low, depth + 1);
    cut_rect(k, high, depth + 1);
}

static void cut_patch(Cutter *k) {
    const PatchDef *def = k->patch->def;
    Bezier whole;
    whole.du = (int)def->degree_u;
    whole.dv = (int)def->degree_v;
    for (int i = 0; i < bezier_count(&whole); i++)
        whole.p[i] = vec_sub(def->points[i], k->patch->center);
    k->whole = &whole;
    k->size = bezier_diameter(&whole);
    cut_rect(k, bezier_whole(), 0);
    while (k->cuts.count > k->limit) {
        k->cuts.count = 0;
        k->share *= 1.5;
        cut_rect(k, bezier_whole(), 0);
    }
    k->whole = NULL;
}

// ---- Layout

static AccelPatch make_patch(Arena *arena, const PatchDef *def, double tolerance) {
    int rows = (int)def->degree_u + 1, columns = (int)def->degree_v + 1;
    Box box = box_empty();
    for (int i = 0; i < rows * columns; i++)
        box = box_extend(box, def->points[i]);
    AccelPatch patch = {.def = def,
                        .center = vec_add(vec_scale(box.low, 0.5), vec_scale(box.high, 0.5)),
                        .cubic = rows == 4 && columns == 4,
                        .tolerance = tolerance * vec_length(vec_sub(box.high, box.low))};
    double *local = ARENA_ARRAY(arena, double, (size_t)(3 * rows * columns)), reach = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < rows; i++) {
            for (int j = 0; j < columns; j++) {
                double x =
                    vec_get(def->points[i * columns + j], axis) - vec_get(patch.center, axis);
                int at = patch.cubic ? j * rows + i : i * columns + j;
                local[axis * rows * columns + at] = x;
                reach = fmax(reach, fabs(x));
            }
        }
    }
    patch.local = local;
    // The weights are positive and sum up to 1; each carries at most 2 n roundings, the double sum
    // 2 (du + dv) more: 4 (du + dv) in all, and one for the points less the center.
    patch.rounding = reach * 0x1p-53 * (4.0 * (def->degree_u + def->degree_v) + 1.0);
    return patch;
}

static void set_lane(Block *block, int lane, const Tree *tree, Vec3 patch_center, const Cut *cut) {
    for (int axis = 0; axis < 3; axis++) {
        double scale = tree->scale;
        double place = (vec_get(patch_center, axis) - vec_get(tree->center, axis)) * scale;
        double c = vec_get(cut->c, axis) * scale + place - block->center[axis];
        block->c[axis][lane] = (float)c;
        block->eu[axis][lane] = (float)(vec_get(cut->eu, axis) * scale);
        block->ev[axis][lane] = (float)(vec_get(cut->ev, axis) * scale);
        // The place is rounded to 2^-52 tree units, upwards rounding to float needs one ulp.
        double rho = vec_get(cut->rho, axis) * scale + 0x1p-50;
        block->rho[axis][lane] = nextafterf((float)rho, INFINITY);
        block->edge = fmax(block->edge, fmax(fabs(vec_get(cut->eu, axis)) * scale,
                                             fabs(vec_get(cut->ev, axis)) * scale));
    }
}

static Box place_box(const AccelPatch *patch, const Cut *cut) {
    return (Box){vec_add(cut->box.low, patch->center), vec_add(cut->box.high, patch->center)};
}

static void make_block(const Accel *accel, const Cut *cuts, uint32_t leaf, Block *block) {
    const Tree *tree = &accel->tree;
    block->first = tree->leaf_first[leaf];
    block->count = tree->leaf_first[leaf + 1] - block->first;
    assert(block->count >= 1 && block->count <= BLOCK_LANES);
    Box box = box_empty();
    for (uint32_t i = 0; i < block->count; i++) {
        const Cut *cut = &cuts[tree->order[block->first + i]];
        box = box_union(box, place_box(&accel->patches[cut->piece.patch], cut));
    }
    double square = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double low = (vec_get(box.low, axis) - vec_get(tree->center, axis)) * tree->scale;
        double high = (vec_get(box.high, axis) - vec_get(tree->center, axis)) * tree->scale;
        block->center[axis] = 0.5 * (low + high);
        square += 0.25 * (high - low) * (high - low);
    }
    block->radius = sqrt(square) * (1.0 + 0x1p-40) + 0x1p-48;
    for (uint32_t i = 0; i < BLOCK_LANES; i++) {
        // Lanes not in use repeat the first; nobody asks for them.
        const Cut *cut = &cuts[tree->order[block->first + (i < block->count ? i : 0)]];
        set_lane(block, (int)i, tree, accel->patches[cut->piece.patch].center, cut);
    }
}

void pieces_build(Arena *arena, const PatchDef *defs, size_t count, double tolerance,
                  Accel *accel) {
    accel->defs = defs;
    accel->patch_count = count;
    accel->patches = ARENA_ARRAY(arena, AccelPatch, count);
    for (size_t i = 0; i < count; i++)
        accel->patches[i] = make_patch(arena, &defs[i], tolerance);
    size_t limit = PIECES_IN_ALL / (count + 1) + 1;
    limit = limit > PIECES_A_PATCH ? PIECES_A_PATCH : limit;

    // Cut the patches, each into a list of its own.
    ARRAY(Cutter) cutters = {0};
    for (size_t i = 0; i < count; i++)
        array_push(&cutters, ((Cutter){.patch = &accel->patches[i],
                                       .number = (uint32_t)i,
                                       .share = SHARE,
                                       .limit = limit}));
#pragma omp parallel for schedule(dynamic, 4)
    for (size_t i = 0; i < count; i++)
        cut_patch(&cutters.items[i]);

    // One list in the order of the patches, whatever the threads did.
    ARRAY(Cut) cuts = {0};
    ARRAY(Box) boxes = {0};
    for (size_t i = 0; i < count; i++) {
        for (size_t c = 0; c < cutters.items[i].cuts.count; c++) {
            array_push(&cuts, cutters.items[i].cuts.items[c]);
            array_push(&boxes, place_box(&accel->patches[i], &cuts.items[cuts.count - 1]));
        }
        array_free(&cutters.items[i].cuts);
    }
    array_free(&cutters);
    tree_build(arena, boxes.items, (uint32_t)boxes.count, BLOCK_LANES, &accel->tree);
    array_free(&boxes);

    accel->piece_count = cuts.count;
    accel->pieces = ARENA_ARRAY(arena, Piece, cuts.count);
    for (size_t i = 0; i < cuts.count; i++)
        accel->pieces[i] = cuts.items[accel->tree.order[i]].piece;
    accel->blocks = ARENA_ARRAY(arena, Block, accel->tree.leaf_count);
    for (uint32_t leaf = 0; leaf < accel->tree.leaf_count; leaf++)
        make_block(accel, cuts.items, leaf, &accel->blocks[leaf]);
    array_free(&cuts);
}
