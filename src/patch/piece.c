// SPDX-License-Identifier: MIT
// Cuts patches into thick parallelograms and lays them out for accel.c; see piece.h.
#include "patch/piece.h"

#include "base/array.h"
#include "patch/quasi.h"

#include <assert.h>
#include <float.h>
#include <string.h>

// A patch is cut until the thickness of its pieces is this share of their size. The teapot: 2 % to
// 4 % trace equally fast, 1 % takes four times the memory for nothing, and at 6 % rays at
// silhouettes that qi_reduce must settle, 0.2 % of all before, begin to tell.
static const double SHARE = 0.03;
// And until its parameters run as evenly as this (the whole being 2).
static const double EVEN = 0.5;

enum {
    MAX_DEPTH = 20,         // halvings, u and v together
    PIECES_A_PATCH = 4096,  // more are not worth their memory
    PIECES_IN_ALL = 1 << 20 // about 250 MB; many patches are cut more coarsely
};

typedef struct {
    Piece piece;
    PieceFrame frame;
    Box box; // about the patch's center, scene units
} Cut;

typedef struct {
    const AccelPatch *patch;
    uint32_t number;
    double share, size;
    double rounding; // bezier_rounding() of the patch about its center
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

// Points as [column][row][x y z 0]: loops over adjacent numbers, which become vector code.
static void eval_cubic(const double *p, double u, double v, Vec3 out[3]) {
    double wu[4], du[4], wv[4], dv[4], row[16], slope[16], s[4], su[4], sv[4];
    weights_cubic(u, wu, du);
    weights_cubic(v, wv, dv);
    for (int k = 0; k < 16; k++) {
        row[k] = wv[0] * p[k] + wv[1] * p[16 + k] + wv[2] * p[32 + k] + wv[3] * p[48 + k];
        slope[k] = dv[0] * p[k] + dv[1] * p[16 + k] + dv[2] * p[32 + k] + dv[3] * p[48 + k];
    }
    for (int k = 0; k < 4; k++) {
        s[k] = wu[0] * row[k] + wu[1] * row[4 + k] + wu[2] * row[8 + k] + wu[3] * row[12 + k];
        su[k] = du[0] * row[k] + du[1] * row[4 + k] + du[2] * row[8 + k] + du[3] * row[12 + k];
        sv[k] =
            wu[0] * slope[k] + wu[1] * slope[4 + k] + wu[2] * slope[8 + k] + wu[3] * slope[12 + k];
    }
    out[0] = vec3(s[0], s[1], s[2]);
    out[1] = vec3(su[0], su[1], su[2]);
    out[2] = vec3(sv[0], sv[1], sv[2]);
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

// Second differences of a net are derivatives of the surface: at most these lengths.
typedef struct {
    double uu, uv, vv;
} Bends;

static double longer(double square, Vec3 a) {
    double other = vec_dot(a, a);
    return other > square ? other : square;
}

static Bends bends_of(const Bezier *s) {
    int du = s->du, dv = s->dv, row = dv + 1;
    double uu = 0.0, uv = 0.0, vv = 0.0;
    for (int i = 0; i <= du; i++) {
        for (int j = 0; j <= dv; j++) {
            const Vec3 *p = &s->p[i * row + j];
            if (i + 2 <= du)
                uu = longer(uu, vec_sub(vec_sub(p[2 * row], p[row]), vec_sub(p[row], p[0])));
            if (j + 2 <= dv)
                vv = longer(vv, vec_sub(vec_sub(p[2], p[1]), vec_sub(p[1], p[0])));
            if (i < du && j < dv)
                uv = longer(uv, vec_sub(vec_sub(p[row + 1], p[row]), vec_sub(p[1], p[0])));
        }
    }
    return (Bends){sqrt(uu) * du * (du - 1), sqrt(uv) * du * dv, sqrt(vv) * dv * (dv - 1)};
}

// A net halved MAX_DEPTH times is off by MAX_DEPTH (du + dv) 2^-53 of the largest coordinate, one
// for each midpoint on the way. That is less than 7 bezier_rounding(); one more is for the QI net.
static double net_rounding(const Cutter *k) { return 8.0 * k->rounding; }

// Upwards, with room for the rounding of differences of points that are off by `error`, and for
// PIECE_MARGIN = m: outside of [0,1] by m the Bernstein weights' absolute values sum up to
// (1 + 2 m)^n, for 16 twice that is below 1 + 2^-13.
static float bound_up(double bound, double error) {
    double up = (bound + error) * (1.0 + 0x1p-12) + DBL_MIN;
    return up < (double)FLT_MAX ? (float)up : INFINITY;
}

// The piece's box about the patch's center: of the control points, and of the net with the QI
// bound.
static Box piece_box(const Cutter *k, const Bezier *s) {
    double error = net_rounding(k);
    Bezier net;
    quasi_net(s, &net);
    Vec3 slack = vec3(error, error, error), e = vec_add(quasi_deviation_axes(s), slack);
    Box hull = bezier_bounds(s), thick = bezier_bounds(&net);
    return (Box){vec_max(vec_sub(hull.low, slack), vec_sub(thick.low, e)),
                 vec_min(vec_add(hull.high, slack), vec_add(thick.high, e))};
}

// The rest of what is to be known of a piece.
static void complete(const Cutter *k, const Bezier *s, BezierRect rect, Cut *out) {
    double error = 8.0 * net_rounding(k); // four points, in length
    int du = s->du, dv = s->dv;
    double width = rect.u1 - rect.u0, height = rect.v1 - rect.v0;
    double uu = 1.0 / (width * width), uv = 1.0 / (width * height), vv = 1.0 / (height * height);
    Bends bends = bends_of(s);
    out->box = piece_box(k, s);
    out->piece.rect = rect;
    out->piece.muu = bound_up(bends.uu * uu, error * du * du * uu);
    out->piece.muv = bound_up(bends.uv * uv, error * du * dv * uv);
    out->piece.mvv = bound_up(bends.vv * vv, error * dv * dv * vv);
    out->piece.patch = k->number;
    out->piece.mask = k->patch->def->mask;
}

// Length of a mean of opposite sides.
static double mean_side(const Bezier *s, bool along_u) {
    Vec3 a = bezier_at(s, 0, 0), b = bezier_at(s, 0, s->dv);
    Vec3 c = bezier_at(s, s->du, 0), d = bezier_at(s, s->du, s->dv);
    Vec3 sum =
        along_u ? vec_add(vec_sub(c, a), vec_sub(d, b)) : vec_add(vec_sub(b, a), vec_sub(d, c));
    return 0.5 * vec_length(sum);
}

// Is a cut across u (rather than v) what makes the piece flatter? A second derivative D has the
// sag D / 8; a twist gives way to either cut, then the longer side is taken.
static bool cut_across_u(const Bezier *s) {
    Bends bends = bends_of(s);
    Vec3 twist = vec_sub(vec_sub(bezier_at(s, s->du, s->dv), bezier_at(s, s->du, 0)),
                         vec_sub(bezier_at(s, 0, s->dv), bezier_at(s, 0, 0)));
    if (2.0 * vec_length(twist) > fmax(bends.uu, bends.vv))
        return mean_side(s, true) > mean_side(s, false);
    return bends.uu > bends.vv;
}

// Both halves of n + 1 points, `step` apart, by midpoints.
static void halve_line(int n, int step, const Vec3 *from, Vec3 *low, Vec3 *high) {
    Vec3 row[BEZIER_MAX_DEGREE + 1];
    for (int i = 0; i <= n; i++)
        row[i] = from[i * step];
    for (int k = 0; k <= n; k++) {
        low[k * step] = row[0];
        high[(n - k) * step] = row[n - k];
        for (int i = 0; i < n - k; i++)
            row[i] = vec_scale(vec_add(row[i], row[i + 1]), 0.5);
    }
}

static void halve(const Bezier *s, bool across_u, Bezier *low, Bezier *high) {
    int row = s->dv + 1;
    low->du = high->du = s->du;
    low->dv = high->dv = s->dv;
    if (across_u) {
        for (int j = 0; j < row; j++)
            halve_line(s->du, row, s->p + j, low->p + j, high->p + j);
    } else {
        for (int i = 0; i < bezier_count(s); i += row)
            halve_line(s->dv, 1, s->p + i, low->p + i, high->p + i);
    }
}

static void cut_rect(Cutter *k, const Bezier *s, BezierRect rect, int depth) {
    Cut cut;
    frame_make(s, net_rounding(k), &cut.frame, &cut.piece);
    // Size is not taken below a sixteenth of the patch's: near a collapsed edge pieces stay wide
    // for their length however often they are cut.
    double size = fmax(fmax(mean_side(s, true), mean_side(s, false)), k->size / 16.0);
    // Thickness of rounding alone does not go away. A flat piece may still be bent in its plane.
    double uneven = fmax((double)cut.piece.rest_a, (double)cut.piece.rest_b);
    bool even = !cut.frame.regular || uneven <= EVEN * k->share / SHARE;
    double thin = fmax(k->share * size, fmax(20.0 * k->rounding, FRAME_LEAST));
    bool enough = cut.frame.half[2] <= thin && (even || size <= k->size / 16.0);
    if (enough || depth == MAX_DEPTH || k->cuts.count > k->limit) {
        complete(k, s, rect, &cut);
        array_push(&k->cuts, cut);
        return;
    }
    BezierRect low = rect, high = rect;
    bool across_u = cut_across_u(s);
    if (across_u)
        low.u1 = high.u0 = 0.5 * (rect.u0 + rect.u1);
    else
        low.v1 = high.v0 = 0.5 * (rect.v0 + rect.v1);
    Bezier half[2];
    halve(s, across_u, &half[0], &half[1]);
    cut_rect(k, &half[0], low, depth + 1);
    cut_rect(k, &half[1], high, depth + 1);
}

static void cut_patch(Cutter *k) {
    const PatchDef *def = k->patch->def;
    Bezier whole;
    whole.du = (int)def->degree_u;
    whole.dv = (int)def->degree_v;
    for (int i = 0; i < bezier_count(&whole); i++)
        whole.p[i] = vec_sub(def->points[i], k->patch->center);
    k->rounding = bezier_rounding(&whole);
    k->size = bezier_diameter(&whole);
    cut_rect(k, &whole, bezier_whole(), 0);
    while (k->cuts.count > k->limit) {
        k->cuts.count = 0;
        k->share *= 1.5;
        cut_rect(k, &whole, bezier_whole(), 0);
    }
}

// ---- Layout

static AccelPatch make_patch(Arena *arena, const PatchDef *def) {
    int rows = (int)def->degree_u + 1, columns = (int)def->degree_v + 1;
    Box box = box_empty();
    for (int i = 0; i < rows * columns; i++)
        box = box_extend(box, def->points[i]);
    AccelPatch patch = {.def = def,
                        .center = vec_add(vec_scale(box.low, 0.5), vec_scale(box.high, 0.5)),
                        .cubic = rows == 4 && columns == 4,
                        .tolerance = def->tolerance};
    size_t count = patch.cubic ? 64 : (size_t)(3 * rows * columns);
    double *local = ARENA_ARRAY(arena, double, count), reach = 0.0;
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < columns; j++) {
            Vec3 q = vec_sub(def->points[i * columns + j], patch.center);
            for (int axis = 0; axis < 3; axis++) {
                int at = patch.cubic ? (4 * j + i) * 4 + axis : (axis * rows + i) * columns + j;
                local[at] = vec_get(q, axis);
                reach = fmax(reach, fabs(local[at]));
            }
        }
    }
    patch.local = local;
    // The weights are positive and sum up to 1; each carries at most 2 n roundings, the double sum
    // 2 (du + dv) more: 4 (du + dv) in all, and one for the points less the center.
    patch.rounding = reach * 0x1p-53 * (4.0 * (def->degree_u + def->degree_v) + 1.0);
    return patch;
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
        block->center[axis] = (float)(0.5 * (low + high));
        square += (high - low) * (high - low);
    }
    // The tree's boxes are larger by TREE_PAD on each side, and rays come within rounding of them.
    double reach = sqrt(square) + 8.0 * (double)TREE_PAD;
    for (uint32_t i = 0; i < BLOCK_LANES; i++) {
        if (i < block->count) {
            const Cut *cut = &cuts[tree->order[block->first + i]];
            frame_to_lane(&cut->frame, tree, accel->patches[cut->piece.patch].center, reach, block,
                          (int)i, &accel->pieces[block->first + i]);
        } else {
            block->shift[0][i] = 2.0f; // beside the box of every ray: all axes are 0
            block->shift[1][i] = block->shift[2][i] = 2.0f;
        }
    }
}

void pieces_build(Arena *arena, const PatchDef *defs, size_t count, Accel *accel) {
    accel->defs = defs;
    accel->patch_count = count;
    accel->patches = ARENA_ARRAY(arena, AccelPatch, count);
    for (size_t i = 0; i < count; i++)
        accel->patches[i] = make_patch(arena, &defs[i]);
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
