// SPDX-License-Identifier: MIT
// Cuts patches into thick parallelograms and lays them out for accel.c; see piece.h.
#include "patch/piece.h"

#include "base/array.h"
#include "base/diag.h"
#include "base/lanes.h"
#include "patch/bernstein.h"
#include "patch/border.h"
#include "patch/qi_local.h"
#include "patch/quasi.h"

#include <assert.h>
#include <float.h>
#include <string.h>

// A patch is cut until the thickness of its pieces is this share of their size. The teapot: from 3
// % to 1 % views of it gain a tenth, since one step in single precision is then enough for the
// guess, and scattered rays lose as much to the cache.
static const double SHARE = 0.014;
// And until its parameters run as evenly as this (the whole being 2).
static const double EVEN = 0.5;

// Halvings, u and v together: so many bits a float holds.
enum { MAX_DEPTH = 20, FEW = 64 };

// How far to go, by --prepare: pieces a patch and pieces in all, of about 350 bytes each. The patch
// itself is 1,000 bytes.
// ORDER patch_prepare
static const struct { size_t a_patch, in_all; } limits[] = {{4096, 4000000}, {16, 900000}, {1, 1}};

typedef struct {
    BezierRect rect;
    uint32_t patch;
    double badness; // how much thicker or less even than it should be
} Cut;

typedef struct {
    ARRAY(Cut) cuts;
    ARRAY(Box) boxes; // scene units
} CutList;

typedef struct {
    const AccelPatch *patch;
    uint32_t number;
    Bezier whole; // about the patch's center
    double share, size;
    double rounding; // bezier_rounding() of the patch about its center
    size_t limit, first;
    CutList *out;
} Cutter;

// ---- Evaluation

// Points as [column][row][x y z]: loops over adjacent numbers, which become vector code.
static void eval_cubic(const double *p, double u, double v, Vec3 out[3]) {
    double wu[4], du[4], wv[4], dv[4], row[12], slope[12], s[3], su[3], sv[3];
    bernstein_cubic(u, wu, du);
    bernstein_cubic(v, wv, dv);
    for (int k = 0; k < 12; k++) {
        row[k] = wv[0] * p[k] + wv[1] * p[12 + k] + wv[2] * p[24 + k] + wv[3] * p[36 + k];
        slope[k] = dv[0] * p[k] + dv[1] * p[12 + k] + dv[2] * p[24 + k] + dv[3] * p[36 + k];
    }
    for (int k = 0; k < 3; k++) {
        s[k] = wu[0] * row[k] + wu[1] * row[3 + k] + wu[2] * row[6 + k] + wu[3] * row[9 + k];
        su[k] = du[0] * row[k] + du[1] * row[3 + k] + du[2] * row[6 + k] + du[3] * row[9 + k];
        sv[k] =
            wu[0] * slope[k] + wu[1] * slope[3 + k] + wu[2] * slope[6 + k] + wu[3] * slope[9 + k];
    }
    out[0] = vec3(s[0], s[1], s[2]);
    out[1] = vec3(su[0], su[1], su[2]);
    out[2] = vec3(sv[0], sv[1], sv[2]);
}

static void eval_any(const AccelPatch *patch, double u, double v, Vec3 out[3]) {
    int nu = (int)patch->def->degree_u, nv = (int)patch->def->degree_v;
    double wu[BEZIER_MAX_DEGREE + 1], du[BEZIER_MAX_DEGREE + 1];
    double wv[BEZIER_MAX_DEGREE + 1], dv[BEZIER_MAX_DEGREE + 1];
    bernstein(nu, u, wu, du);
    bernstein(nv, v, wv, dv);
    // Weights and their derivatives side by side, the coordinates in turn.
    Lanes2 both[BEZIER_MAX_DEGREE + 1], low[3] = {{0.0}}, high[3] = {{0.0}};
    for (int j = 0; j <= nv; j++)
        both[j] = (Lanes2){wv[j], dv[j]};
    const double *p = patch->local;
    const int next = (nu + 1) * (nv + 1);
    for (int i = 0; i <= nu; i++, p += nv + 1) {
        Lanes2 x = {0.0}, y = {0.0}, z = {0.0};
        for (int j = 0; j <= nv; j++) {
            x += both[j] * p[j];
            y += both[j] * p[next + j];
            z += both[j] * p[2 * next + j];
        }
        low[0] += wu[i] * x, high[0] += du[i] * x;
        low[1] += wu[i] * y, high[1] += du[i] * y;
        low[2] += wu[i] * z, high[2] += du[i] * z;
    }
    out[0] = vec3(low[0][0], low[1][0], low[2][0]);
    out[1] = vec3(high[0][0], high[1][0], high[2][0]);
    out[2] = vec3(low[0][1], low[1][1], low[2][1]);
}

void piece_eval(const AccelPatch *patch, double u, double v, Vec3 out[3]) {
    if (patch->cubic)
        eval_cubic(patch->local, u, v, out);
    else
        eval_any(patch, u, v, out);
}

// ---- Cutting

static double larger(double a, double b) { return a > b ? a : b; }

static void patch_about_center(const AccelPatch *patch, Bezier *out) {
    const PatchDef *def = patch->def;
    out->du = (int)def->degree_u;
    out->dv = (int)def->degree_v;
    for (int i = 0; i < bezier_count(out); i++)
        out->p[i] = vec_sub(def->points[i], patch->center);
}

// Blossom weights of the part [a,b] of a cubic: out control point k is the sum of w[k][i] p_i. All
// are positive and carry less than 8 roundings.
static void part_weights(double a, double b, double w[4][4]) {
    for (int k = 0; k < 4; k++) {
        double row[4] = {1.0, 0.0, 0.0, 0.0};
        for (int n = 0; n < 3; n++) {
            double t = n < k ? b : a, s = 1.0 - t;
            for (int i = n + 1; i > 0; i--)
                row[i] = row[i] * s + row[i - 1] * t;
            row[0] *= s;
        }
        for (int i = 0; i < 4; i++)
            w[k][i] = row[i];
    }
}

// As bezier_restrict, faster for cubics, and within net_rounding: two sums of four products with
// such weights err by less than 24 roundings of the largest coordinate.
static void piece_part(const Bezier *whole, BezierRect rect, Bezier *out) {
    if (whole->du != 3 || whole->dv != 3) {
        bezier_restrict(whole, rect, out);
        return;
    }
    double wu[4][4], wv[4][4];
    Vec3 half[16];
    part_weights(rect.u0, rect.u1, wu);
    part_weights(rect.v0, rect.v1, wv);
    for (int k = 0; k < 4; k++) {
        for (int j = 0; j < 4; j++) {
            Vec3 sum = vec_scale(whole->p[j], wu[k][0]);
            for (int i = 1; i < 4; i++)
                sum = vec_madd(sum, wu[k][i], whole->p[4 * i + j]);
            half[4 * k + j] = sum;
        }
    }
    out->du = out->dv = 3;
    for (int k = 0; k < 4; k++) {
        for (int m = 0; m < 4; m++) {
            Vec3 sum = vec_scale(half[4 * k], wv[m][0]);
            for (int j = 1; j < 4; j++)
                sum = vec_madd(sum, wv[m][j], half[4 * k + j]);
            out->p[4 * k + m] = sum;
        }
    }
}

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
static double net_rounding(const Bezier *whole) { return 8.0 * bezier_rounding(whole); }

// Upwards, with room for the rounding of differences of points that are off by `error`, and for
// PIECE_MARGIN = m: outside of [0,1] by m the Bernstein weights' absolute values sum up to
// (1 + 2 m)^n, for 16 twice that is below 1 + 2^-13. A float rounds by less than that, too, unless
// it is denormal: of a patch of size 1e-40 it may come out as a tenth, or as 0.
static float bound_up(double bound, double error) {
    double up = (bound + error) * (1.0 + 0x1p-12) + DBL_MIN;
    if (!(up < (double)FLT_MAX))
        return INFINITY;
    return up < (double)FLT_MIN ? (float)up + FLT_TRUE_MIN : (float)up;
}

// What is to be known of a piece besides its frame.
static void complete(const Bezier *s, double net_error, BezierRect rect, uint32_t patch,
                     Piece *out) {
    double error = 8.0 * net_error; // four points, in length
    int du = s->du, dv = s->dv;
    double width = rect.u1 - rect.u0, height = rect.v1 - rect.v0;
    double uu = 1.0 / (width * width), uv = 1.0 / (width * height), vv = 1.0 / (height * height);
    Bends bends = bends_of(s);
    out->u0 = (float)rect.u0;
    out->u1 = (float)rect.u1;
    out->v0 = (float)rect.v0;
    out->v1 = (float)rect.v1;
    out->muu = bound_up(bends.uu * uu, error * du * du * uu);
    out->muv = bound_up(bends.uv * uv, error * du * dv * uv);
    out->mvv = bound_up(bends.vv * vv, error * dv * dv * vv);
    out->patch = patch;
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

static void halve_rect(bool across_u, BezierRect *low, BezierRect *high) {
    if (across_u)
        low->u1 = high->u0 = 0.5 * (low->u0 + low->u1);
    else
        low->v1 = high->v0 = 0.5 * (low->v0 + low->v1);
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

// How much thicker than its share, or less even, a piece is: at most 1 is good enough. Where the
// piece is cut anyway (whole = false) the larger of two numbers above 1 need not be known.
static double judge(const Cutter *k, const Bezier *s, bool whole) {
    FrameWeight weight;
    frame_weigh(s, k->rounding, &weight);
    // Size is not taken below a sixteenth of the patch's: near a collapsed edge pieces stay wide
    // for their length however often they are cut.
    double size = larger(larger(mean_side(s, true), mean_side(s, false)), k->size / 16.0);
    // Thickness of rounding alone does not go away. A flat piece may still be bent in its plane.
    double thin = larger(k->share * size, larger(4.0 * k->rounding, FRAME_LEAST));
    double badness = weight.half / thin;
    if (badness > 1.0 && !whole)
        return badness;
    double even = EVEN * k->share / SHARE;
    if (weight.regular && size > k->size / 16.0)
        badness = larger(badness, frame_unevenness(&weight, even) / even);
    return badness;
}

static void add_cut(Cutter *k, const Bezier *s, BezierRect rect, double badness) {
    Box box = frame_box(s, k->rounding);
    Vec3 center = k->patch->center;
    array_push(&k->out->cuts, ((Cut){rect, k->number, badness}));
    array_push(&k->out->boxes, ((Box){vec_add(box.low, center), vec_add(box.high, center)}));
}

static void cut_rect(Cutter *k, const Bezier *s, BezierRect rect, int depth) {
    double badness = judge(k, s, false);
    if (badness <= 1.0 || depth == MAX_DEPTH || k->out->cuts.count - k->first > k->limit) {
        add_cut(k, s, rect, badness);
        return;
    }
    BezierRect low = rect, high = rect;
    bool across_u = cut_across_u(s);
    halve_rect(across_u, &low, &high);
    Bezier half[2];
    halve(s, across_u, &half[0], &half[1]);
    cut_rect(k, &half[0], low, depth + 1);
    cut_rect(k, &half[1], high, depth + 1);
}

static void forget(Cutter *k) { k->out->cuts.count = k->out->boxes.count = k->first; }

// Few pieces: cuts the worst again and again.
static void cut_worst(Cutter *k) {
    size_t first = k->first;
    add_cut(k, &k->whole, bezier_whole(), judge(k, &k->whole, true));
    while (k->out->cuts.count - first < k->limit) {
        size_t worst = first;
        for (size_t i = first; i < k->out->cuts.count; i++) {
            if (k->out->cuts.items[i].badness > k->out->cuts.items[worst].badness)
                worst = i;
        }
        Cut cut = k->out->cuts.items[worst];
        if (!(cut.badness > 1.0))
            break;
        if ((cut.rect.u1 - cut.rect.u0) * (cut.rect.v1 - cut.rect.v0) <= ldexp(1.0, -MAX_DEPTH)) {
            k->out->cuts.items[worst].badness = 0.0;
            continue;
        }
        Bezier part, half[2];
        BezierRect low = cut.rect, high = cut.rect;
        piece_part(&k->whole, cut.rect, &part);
        bool across_u = cut_across_u(&part);
        halve_rect(across_u, &low, &high);
        halve(&part, across_u, &half[0], &half[1]);
        add_cut(k, &half[0], low, judge(k, &half[0], true));
        size_t last = k->out->cuts.count - 1;
        k->out->cuts.items[worst] = k->out->cuts.items[last];
        k->out->boxes.items[worst] = k->out->boxes.items[last];
        k->out->cuts.count = k->out->boxes.count = last;
        add_cut(k, &half[1], high, judge(k, &half[1], true));
    }
}

static void cut_patch(Cutter *k) {
    patch_about_center(k->patch, &k->whole);
    k->rounding = net_rounding(&k->whole);
    k->size = bezier_diameter(&k->whole);
    k->share = SHARE;
    k->first = k->out->cuts.count;
    if (k->limit <= FEW) {
        cut_worst(k);
        return;
    }
    cut_rect(k, &k->whole, bezier_whole(), 0);
    while (k->out->cuts.count - k->first > k->limit) {
        forget(k);
        k->share *= 1.5;
        cut_rect(k, &k->whole, bezier_whole(), 0);
    }
}

// ---- Layout

static bool is_cubic(const PatchDef *def) { return def->degree_u == 3 && def->degree_v == 3; }

// own: room for the points of a patch that is not bicubic.
static void make_patch(const PatchDef *def, double *own, AccelPatch *out) {
    int rows = (int)def->degree_u + 1, columns = (int)def->degree_v + 1;
    Box box = box_empty();
    for (int i = 0; i < rows * columns; i++)
        box = box_extend(box, def->points[i]);
    *out = (AccelPatch){.def = def,
                        .center = vec_add(vec_scale(box.low, 0.5), vec_scale(box.high, 0.5)),
                        .cubic = is_cubic(def),
                        .id = def->id,
                        .tolerance = def->tolerance};
    double *local = out->cubic ? out->own : own;
    out->local = local;
    double reach = 0.0;
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < columns; j++) {
            Vec3 q = vec_sub(def->points[i * columns + j], out->center);
            out->radius = larger(out->radius, vec_length(q));
            for (int axis = 0; axis < 3; axis++) {
                int at = out->cubic ? (4 * j + i) * 3 + axis : (axis * rows + i) * columns + j;
                local[at] = vec_get(q, axis);
                reach = larger(reach, fabs(local[at]));
            }
        }
    }
    // The weights are positive and sum up to 1; each carries at most 2 n roundings, the double sum
    // 2 (du + dv) more: 4 (du + dv) in all, and one for the points less the center.
    out->rounding = reach * 0x1p-53 * (4.0 * (def->degree_u + def->degree_v) + 1.0);
}

static void make_patches(Arena *arena, Accel *accel) {
    size_t *first = ARENA_ARRAY(arena, size_t, accel->patch_count), sum = 0;
    for (size_t i = 0; i < accel->patch_count; i++) {
        const PatchDef *def = &accel->defs[i];
        first[i] = sum;
        if (!is_cubic(def))
            sum += 3 * (size_t)(def->degree_u + 1) * (def->degree_v + 1);
    }
    double *local = ARENA_ARRAY(arena, double, sum);
    accel->patches = ARENA_ARRAY(arena, AccelPatch, accel->patch_count);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < accel->patch_count; i++)
        make_patch(&accel->defs[i], local + first[i], &accel->patches[i]);
    borders_find(accel->patches, accel->patch_count);
}

// cuts and boxes: of the whole set, not in the order of the tree.
static void make_block(const Accel *accel, const Cut *cuts, const Box *boxes, const uint32_t *order,
                       Block *block) {
    const Tree *tree = &accel->tree;
    Box box = box_empty();
    for (uint32_t i = 0; i < block->count; i++)
        box = box_union(box, boxes[order[i]]);
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
        if (i >= block->count) {
            // Beside the box of every ray: all axes are 0.
            block->shift[0][i] = block->shift[1][i] = block->shift[2][i] = 2.0f;
            continue;
        }
        const Cut *cut = &cuts[order[i]];
        const AccelPatch *patch = &accel->patches[cut->patch];
        Piece *piece = (Piece *)accel_piece(accel, block_piece(block, i));
        Bezier whole, part;
        PieceFrame frame;
        patch_about_center(patch, &whole);
        double error = net_rounding(&whole);
        piece_part(&whole, cut->rect, &part);
        frame_measure(&part, error, &frame);
        complete(&part, error, cut->rect, cut->patch, piece);
        if (qi_local_pays(part.du, part.dv)) {
            piece->fourth = (uint32_t)(order - tree->order) + i;
            qi_local_fourth(&part, error, accel->fourth[piece->fourth].most);
        }
        frame_to_lane(&frame, &part, tree, patch->center, reach, block, (int)i, piece);
        block->patch[i] = cut->patch;
        block->mask[i] = patch->def->mask;
    }
}

// The line at which the block of a leaf begins, or what comes after the last leaf.
static size_t leaf_line(const Tree *tree, uint32_t leaf) {
    return (size_t)LINES_OF_BLOCK * leaf + (size_t)LINES_OF_PIECE * tree->leaf_first[leaf];
}

// A leaf's number becomes that of its block.
static uint32_t child_by_line(const Tree *tree, uint32_t child) {
    if (child == TREE_NONE || !(child & TREE_LEAF))
        return child;
    return TREE_LEAF | (uint32_t)leaf_line(tree, child & ~TREE_LEAF);
}

static void make_leaves(Arena *arena, const CutList *all, Accel *accel) {
    Tree *tree = &accel->tree;
    accel->line_count = leaf_line(tree, tree->leaf_count);
    if (accel->line_count >= TREE_LEAF)
        die("%zu patches are too many", accel->patch_count);
    accel->lines = arena_array(arena, accel->line_count, LINE);
#pragma omp parallel for schedule(dynamic, 64)
    for (uint32_t leaf = 0; leaf < tree->leaf_count; leaf++) {
        size_t line = leaf_line(tree, leaf);
        Block *block = (Block *)accel_block(accel, (uint32_t)line);
        block->first = (uint32_t)line + LINES_OF_BLOCK;
        block->count = tree->leaf_first[leaf + 1] - tree->leaf_first[leaf];
        assert(block->count >= 1 && block->count <= BLOCK_LANES);
        make_block(accel, all->cuts.items, all->boxes.items, tree->order + tree->leaf_first[leaf],
                   block);
    }
    for (uint32_t i = 0; i < tree->node_count; i++) {
        for (int k = 0; k < TREE_WIDTH; k++)
            tree->nodes[i].child[k] = child_by_line(tree, tree->nodes[i].child[k]);
    }
    tree->root = child_by_line(tree, tree->root);
}

static size_t piece_limit(PatchPrepare prepare, size_t patches) {
    size_t limit = limits[prepare].in_all / (patches + 1) + 1;
    return limit < limits[prepare].a_patch ? limit : limits[prepare].a_patch;
}

// Cuts all patches: *cuts and *boxes in the order of the patches, whatever the threads did.
static void cut_all(const Accel *accel, size_t limit, CutList *all) {
    enum { GROUP = 64 }; // patches of one list
    size_t groups = (accel->patch_count + GROUP - 1) / GROUP;
    ARRAY(CutList) lists = {0};
    for (size_t g = 0; g < groups; g++)
        array_push(&lists, (CutList){0});
#pragma omp parallel for schedule(dynamic, 1)
    for (size_t g = 0; g < groups; g++) {
        size_t end = (g + 1) * GROUP < accel->patch_count ? (g + 1) * GROUP : accel->patch_count;
        for (size_t i = g * GROUP; i < end; i++) {
            Cutter cutter;
            cutter.patch = &accel->patches[i];
            cutter.number = (uint32_t)i;
            cutter.limit = limit;
            cutter.out = &lists.items[g];
            cut_patch(&cutter);
        }
    }
    for (size_t g = 0; g < groups; g++) {
        for (size_t c = 0; c < lists.items[g].cuts.count; c++) {
            array_push(&all->cuts, lists.items[g].cuts.items[c]);
            array_push(&all->boxes, lists.items[g].boxes.items[c]);
        }
        array_free(&lists.items[g].cuts);
        array_free(&lists.items[g].boxes);
    }
    array_free(&lists);
}

void pieces_build(Arena *arena, const PatchDef *defs, size_t count, size_t total,
                  PatchPrepare prepare, Accel *accel) {
    accel->defs = defs;
    accel->patch_count = count;
    make_patches(arena, accel);
    CutList all = {0};
    cut_all(accel, piece_limit(prepare, total), &all);
    tree_build(arena, all.boxes.items, (uint32_t)all.boxes.count, BLOCK_LANES, &accel->tree);

    bool high = false;
    for (size_t i = 0; i < count; i++)
        high |= qi_local_pays((int)defs[i].degree_u, (int)defs[i].degree_v);
    accel->fourth = high ? ARENA_ARRAY(arena, PieceFourth, all.cuts.count) : NULL;
    make_leaves(arena, &all, accel);
    array_free(&all.cuts);
    array_free(&all.boxes);
}
