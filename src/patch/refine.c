// SPDX-License-Identifier: MIT
// Cutting, the walk, and hits. See refine.h.
#include "patch/refine.h"

#include "base/array.h"
#include "patch/bernstein.h"
#include "patch/quasi.h"
#include "patch/rational.h"

#include <string.h>

enum {
    MAX_DEPTH = 16,        // halvings of a patch
    MAX_WEIGHT_DEPTH = 64, // of a rational patch, towards ends where weights grow
    SUBS_A_PATCH = 1024,   // more are needed only where nothing makes a patch flat
    SUBS_IN_ALL = 1 << 20  // 600 MB; many patches are cut more coarsely
};

typedef struct {
    BezierRect rect;
    Box box;
    size_t net; // in the list of numbers
    double least_weight;
} Cut;

// A piece of a patch: its points, and its weights if it is rational.
typedef struct {
    Bezier s;
    bool rational;
    double w[BEZIER_MAX_POINTS];
} Piece;

typedef struct {
    const RefinePatch *patch;
    double share, size, rounding;
    double alike; // how far a piece's weights may differ
    size_t limit;
    ARRAY(Cut) cuts;
    ARRAY(double) numbers;
} Cutter;

// A rational point is a quotient of two sums of positive terms, with products and a quotient more
// than a polynomial's (qi_frame.c has the same factor).
static const double RATIONAL_ROUNDING = 2.0;

// ---- Cutting

static double second_difference(Vec3 a, Vec3 b, Vec3 c) {
    return vec_length(vec_add(vec_sub(a, b), vec_sub(c, b)));
}

// The longest second difference along each direction and the twist across both, as sags: a second
// derivative D has the sag D / 8.
static bool cut_across_u(const Bezier *s) {
    double bend_u = 0.0, bend_v = 0.0;
    int du = s->du, dv = s->dv;
    for (int i = 0; i <= du; i++) {
        for (int j = 0; j <= dv; j++) {
            Vec3 p = bezier_at(s, i, j);
            if (i > 0 && i < du)
                bend_u = fmax(bend_u,
                              second_difference(bezier_at(s, i - 1, j), p, bezier_at(s, i + 1, j)));
            if (j > 0 && j < dv)
                bend_v = fmax(bend_v,
                              second_difference(bezier_at(s, i, j - 1), p, bezier_at(s, i, j + 1)));
        }
    }
    bend_u *= du * (du - 1);
    bend_v *= dv * (dv - 1);
    Vec3 a = bezier_at(s, 0, 0), b = bezier_at(s, 0, dv), c = bezier_at(s, du, 0);
    Vec3 twist = vec_sub(vec_sub(bezier_at(s, du, dv), b), vec_sub(c, a));
    if (2.0 * vec_length(twist) > fmax(bend_u, bend_v))
        return vec_length(vec_sub(c, a)) > vec_length(vec_sub(b, a));
    return bend_u > bend_v;
}

// How far the net is from the parallelogram of its corners' means, in length.
static double thickness(const Bezier *s, double *size) {
    int du = s->du, dv = s->dv;
    Vec3 a = bezier_at(s, 0, 0), b = bezier_at(s, 0, dv), c = bezier_at(s, du, 0),
         d = bezier_at(s, du, dv);
    Vec3 eu = vec_scale(vec_add(vec_sub(c, a), vec_sub(d, b)), 0.5);
    Vec3 ev = vec_scale(vec_add(vec_sub(b, a), vec_sub(d, c)), 0.5);
    Box rest = box_empty();
    for (int i = 0; i <= du; i++) {
        Vec3 along = vec_scale(eu, (double)i / du);
        for (int j = 0; j <= dv; j++)
            rest =
                box_extend(rest, vec_sub(bezier_at(s, i, j), vec_madd(along, (double)j / dv, ev)));
    }
    *size = fmax(vec_length(eu), vec_length(ev));
    return 0.5 * vec_length(vec_sub(rest.high, rest.low));
}

// The box of a sub-patch: of its control net, or where that is tighter of its QI net +- its bound.
// Halving MAX_DEPTH times adds less than 7 bezier_rounding().
static Box local_box(const Piece *p, double rounding) {
    const Bezier *s = &p->s;
    Bezier net;
    if (p->rational) {
        Box box = bezier_bounds(s);
        Vec3 slack = vec3(8.0 * rounding, 8.0 * rounding, 8.0 * rounding);
        return (Box){vec_sub(box.low, slack), vec_add(box.high, slack)};
    }
    quasi_net(s, &net);
    double error = 8.0 * rounding;
    Vec3 slack = vec3(error, error, error), e = vec_add(quasi_deviation_axes(s), slack);
    Box hull = bezier_bounds(s), thick = bezier_bounds(&net);
    return (Box){vec_max(vec_sub(hull.low, slack), vec_sub(thick.low, e)),
                 vec_min(vec_add(hull.high, slack), vec_add(thick.high, e))};
}

static Box scene_box(const RefinePatch *patch, Box local) {
    double unit = 1.0 / patch->scale;
    return (Box){vec_madd(patch->center, unit, local.low),
                 vec_madd(patch->center, unit, local.high)};
}

static void weight_range(const Piece *p, double *least, double *most) {
    *least = *most = p->rational ? p->w[0] : 1.0;
    for (int i = 1; p->rational && i < bezier_count(&p->s); i++) {
        *least = fmin(*least, p->w[i]);
        *most = fmax(*most, p->w[i]);
    }
}

static void keep(Cutter *k, const Piece *p, BezierRect rect) {
    const Bezier *s = &p->s;
    double least, most;
    weight_range(p, &least, &most);
    Cut cut = {rect, scene_box(k->patch, local_box(p, k->rounding)), k->numbers.count,
               least / most};
    int count = bezier_count(s);
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < count; i++)
            array_push(&k->numbers, vec_get(s->p[i], axis) * (p->rational ? p->w[i] / most : 1.0));
    }
    for (int i = 0; p->rational && i < count; i++)
        array_push(&k->numbers, p->w[i] / most);
    array_push(&k->cuts, cut);
}

// Halves by blossoms of x w, y w, z w and w: the points of the halves are means of the points with
// positive weights again.
static void halve(const Piece *p, bool across_u, Piece *low, Piece *high) {
    int count = bezier_count(&p->s);
    Bezier times = p->s, w = p->s;
    low->rational = high->rational = p->rational;
    for (int i = 0; p->rational && i < count; i++) {
        times.p[i] = vec_scale(p->s.p[i], p->w[i]);
        w.p[i] = vec3(p->w[i], 0.0, 0.0);
    }
    (across_u ? bezier_split_u : bezier_split_v)(&times, 0.5, &low->s, &high->s);
    if (!p->rational)
        return;
    Bezier w_low, w_high;
    (across_u ? bezier_split_u : bezier_split_v)(&w, 0.5, &w_low, &w_high);
    for (int i = 0; i < count; i++) {
        low->w[i] = w_low.p[i].x;
        high->w[i] = w_high.p[i].x;
        low->s.p[i] = vec_scale(low->s.p[i], 1.0 / low->w[i]);
        high->s.p[i] = vec_scale(high->s.p[i], 1.0 / high->w[i]);
    }
}

// Flat, and with weights alike.
static bool fine_enough(const Cutter *k, const Piece *p, int depth) {
    double size, thick = thickness(&p->s, &size), least, most;
    // Near a collapsed edge pieces stay wide for their length however often they are cut.
    size = fmax(size, k->size / 16.0);
    weight_range(p, &least, &most);
    bool flat = thick <= fmax(k->share * size, 20.0 * k->rounding) || depth >= MAX_DEPTH;
    bool alike = most <= k->alike * least || depth >= MAX_WEIGHT_DEPTH;
    return flat && alike;
}

// Across the direction in which the weights differ most, where they differ much.
static bool cut_weights_across_u(const Piece *p) {
    int row = p->s.dv + 1;
    double u = 1.0, v = 1.0;
    for (int i = 0; i <= p->s.du; i++) {
        for (int j = 0; j <= p->s.dv; j++) {
            double w = p->w[i * row + j];
            if (i > 0)
                u = fmax(u, fmax(w / p->w[(i - 1) * row + j], p->w[(i - 1) * row + j] / w));
            if (j > 0)
                v = fmax(v, fmax(w / p->w[i * row + j - 1], p->w[i * row + j - 1] / w));
        }
    }
    return u >= v;
}

static void cut_rect(Cutter *k, const Piece *p, BezierRect rect, int depth) {
    if (fine_enough(k, p, depth) || k->cuts.count > k->limit) {
        keep(k, p, rect);
        return;
    }
    double least, most;
    weight_range(p, &least, &most);
    bool across_u = most > k->alike * least ? cut_weights_across_u(p) : cut_across_u(&p->s);
    Piece low, high;
    BezierRect a = rect, b = rect;
    if (across_u)
        a.u1 = b.u0 = 0.5 * (rect.u0 + rect.u1);
    else
        a.v1 = b.v0 = 0.5 * (rect.v0 + rect.v1);
    halve(p, across_u, &low, &high);
    cut_rect(k, &low, a, depth + 1);
    cut_rect(k, &high, b, depth + 1);
}

static Vec3 to_local(const RefinePatch *patch, Vec3 p) {
    return vec_scale(vec_sub(p, patch->center), patch->scale);
}

static void cut_patch(Cutter *k) {
    const PatchDef *def = k->patch->def;
    Piece whole = {.rational = def->weights != NULL};
    whole.s.du = (int)def->degree_u;
    whole.s.dv = (int)def->degree_v;
    for (int i = 0; i < bezier_count(&whole.s); i++) {
        whole.s.p[i] = to_local(k->patch, def->points[i]);
        if (whole.rational)
            whole.w[i] = def->weights[i];
    }
    k->rounding = (whole.rational ? RATIONAL_ROUNDING : 1.0) * bezier_rounding(&whole.s);
    k->size = bezier_diameter(&whole.s);
    k->alike = 4.0;
    cut_rect(k, &whole, bezier_whole(), 0);
    while (k->cuts.count > k->limit) {
        k->cuts.count = k->numbers.count = 0;
        k->share *= 1.5;
        k->alike *= 4.0; // where the weights alone ask for too many
        cut_rect(k, &whole, bezier_whole(), 0);
    }
}

// The power of two that makes the largest extent about 1; 2^+-1000 at most.
static double unit_of(Vec3 extent) {
    double most = fmax(extent.x, fmax(extent.y, extent.z));
    int exponent = 0;
    if (most > 0.0 && isfinite(most))
        frexp(most, &exponent);
    return ldexp(1.0, exponent > 1000 ? -1000 : exponent < -1000 ? 1000 : -exponent);
}

static RefinePatch make_patch(const PatchDef *def) {
    Bezier whole;
    bezier_init(&whole, (int)def->degree_u, (int)def->degree_v, def->points);
    Box box = bezier_bounds(&whole);
    RefinePatch patch = {.def = def,
                         .center = vec_add(vec_scale(box.low, 0.5), vec_scale(box.high, 0.5)),
                         .scale = unit_of(vec_sub(box.high, box.low))};
    patch.tolerance = def->tolerance * patch.scale;
    for (int i = 0; i < bezier_count(&whole); i++)
        whole.p[i] = to_local(&patch, whole.p[i]);
    // Cutting, and then a value of S from the sub-patch's net: 8 for the first, at most one more
    // for the second by the same count.
    patch.rounding = 9.0 * (def->weights ? RATIONAL_ROUNDING : 1.0) * bezier_rounding(&whole);
    return patch;
}

void refine_build(Arena *arena, const PatchDef *defs, size_t count, double share, Refined *out) {
    out->patches = ARENA_ARRAY(arena, RefinePatch, count);
    size_t limit = SUBS_IN_ALL / (count + 1) + 1;
    limit = limit > SUBS_A_PATCH ? SUBS_A_PATCH : limit;
    ARRAY(Cutter) cutters = {0};
    for (size_t i = 0; i < count; i++) {
        out->patches[i] = make_patch(&defs[i]);
        array_push(&cutters, ((Cutter){.patch = &out->patches[i], .share = share, .limit = limit}));
    }
#pragma omp parallel for schedule(dynamic, 4)
    for (size_t i = 0; i < count; i++)
        cut_patch(&cutters.items[i]);

    // One list in the order of the patches, whatever the threads did.
    ARRAY(Box) boxes = {0};
    ARRAY(SubPatch) subs = {0};
    for (size_t i = 0; i < count; i++) {
        Cutter *k = &cutters.items[i];
        const double *numbers =
            arena_copy(arena, k->numbers.items, k->numbers.count * sizeof(double));
        for (size_t c = 0; c < k->cuts.count; c++) {
            const Cut *cut = &k->cuts.items[c];
            array_push(&subs,
                       ((SubPatch){(uint32_t)i, cut->rect, numbers + cut->net, cut->least_weight}));
            array_push(&boxes, cut->box);
        }
        array_free(&k->cuts);
        array_free(&k->numbers);
    }
    array_free(&cutters);
    tree_build(arena, boxes.items, (uint32_t)boxes.count, 1, &out->tree);
    out->subs = ARENA_ARRAY(arena, SubPatch, subs.count);
    for (size_t i = 0; i < subs.count; i++)
        out->subs[i] = subs.items[out->tree.order[i]];
    array_free(&boxes);
    array_free(&subs);
}

// ---- The walk

static void across(Vec3 dir, Vec3 *e1, Vec3 *e2) {
    double x = fabs(dir.x), y = fabs(dir.y), z = fabs(dir.z);
    Vec3 far = x <= y && x <= z ? vec3(1.0, 0.0, 0.0)
               : y <= z         ? vec3(0.0, 1.0, 0.0)
                                : vec3(0.0, 0.0, 1.0);
    *e1 = vec_normalize(vec_cross(dir, far));
    *e2 = vec_cross(dir, *e1);
}

// The same count of roundings as in root.h: w = 2^-53, A the distance from the ray's origin to the
// center; the origin's own 12 w A, t_base + s t_per_s 8 w A, the directions across 4 w A.
static void set_ray(RefineWalk *walk, uint32_t number) {
    const RefinePatch *patch = &walk->refined->patches[number];
    Vec3 away = to_local(patch, walk->query->ray.org);
    double t_per_s = walk->t_per_s / patch->scale;
    double shift = -vec_dot(away, walk->dir);
    double error =
        24.0 * 0x1p-53 * (fabs(away.x) + fabs(away.y) + fabs(away.z)) + 4.0 * patch->rounding;
    walk->patch = number;
    walk->ray = (RefineRay){.patch = patch,
                            .org = vec_madd(away, shift, walk->dir),
                            .dir = walk->dir,
                            .e1 = walk->e1,
                            .e2 = walk->e2,
                            .t_base = shift * t_per_s,
                            .t_per_s = t_per_s,
                            .error = error,
                            .tolerance = fmax(patch->tolerance, 4.0 * error)};
}

typedef struct {
    RefineWalk *walk;
    RefineSearch search;
} Visit;

static bool visit_leaf(void *context, uint32_t leaf, TreeRay *ray) {
    Visit *visit = context;
    RefineWalk *walk = visit->walk;
    Query *query = walk->query;
    const SubPatch *sub = &walk->refined->subs[leaf];
    if (!(walk->refined->patches[sub->patch].def->mask & query->mask))
        return true;
    query->stats.patch_tests++;
    if (walk->patch != sub->patch)
        set_ray(walk, sub->patch);
    double before = query->t_max;
    visit->search(walk, sub);
    if (query->t_max < before)
        tree_ray_cut(ray, query->t_max);
    return !query_done(query);
}

void refine_query(const Refined *refined, Query *query, RefineSearch search) {
    TreeRay ray;
    if (!tree_ray_begin(&refined->tree, &query->ray, query->t_min, query->t_max, &ray))
        return;
    RefineWalk walk;
    walk.refined = refined;
    walk.query = query;
    walk.dir = ray.unit;
    across(walk.dir, &walk.e1, &walk.e2);
    walk.t_per_s = refined->tree.scale / ray.s_per_t;
    walk.patch = UINT32_MAX;
    walk.seen_count = 0;
    walk.work = 0;
    Visit visit = {&walk, search};
    tree_walk(&refined->tree, &ray, visit_leaf, &visit);
}

// ---- Hits

// S, dS/du and dS/dv by the sub-patch's own parameters.
static void eval_rational(const double *p, int du, int dv, double u, double v, Vec3 out[3]) {
    double wu[BEZIER_MAX_DEGREE + 1], wv[BEZIER_MAX_DEGREE + 1];
    double su[BEZIER_MAX_DEGREE + 1], sv[BEZIER_MAX_DEGREE + 1], result[3][4] = {{0.0}};
    bernstein(du, u, wu, su);
    bernstein(dv, v, wv, sv);
    for (int c = 0; c < 4; c++) {
        for (int i = 0; i <= du; i++, p += dv + 1) {
            for (int j = 0; j <= dv; j++) {
                result[0][c] += wu[i] * wv[j] * p[j];
                result[1][c] += su[i] * wv[j] * p[j];
                result[2][c] += wu[i] * sv[j] * p[j];
            }
        }
    }
    double unit = 1.0 / result[0][3];
    for (int k = 0; k < 3; k++) {
        Vec3 n = vec3(result[k][0], result[k][1], result[k][2]);
        out[k] = vec_scale(k ? vec_madd(n, -result[k][3], out[0]) : n, unit);
    }
}

static inline void eval_net(const double *p, int du, int dv, double u, double v, Vec3 out[3]) {
    double wu[BEZIER_MAX_DEGREE + 1], wv[BEZIER_MAX_DEGREE + 1];
    double su[BEZIER_MAX_DEGREE + 1], sv[BEZIER_MAX_DEGREE + 1], result[3][3] = {{0.0}};
    bernstein(du, u, wu, su);
    bernstein(dv, v, wv, sv);
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i <= du; i++, p += dv + 1) {
            double row = 0.0, slope = 0.0;
            for (int j = 0; j <= dv; j++) {
                row += wv[j] * p[j];
                slope += sv[j] * p[j];
            }
            result[0][axis] += wu[i] * row;
            result[1][axis] += su[i] * row;
            result[2][axis] += wu[i] * slope;
        }
    }
    for (int k = 0; k < 3; k++)
        out[k] = vec3(result[k][0], result[k][1], result[k][2]);
}

static void eval_sub(const PatchDef *def, const SubPatch *sub, double u, double v, Vec3 out[3]) {
    if (def->weights)
        eval_rational(sub->net, (int)def->degree_u, (int)def->degree_v, u, v, out);
    else if (def->degree_u == 3 && def->degree_v == 3)
        eval_net(sub->net, 3, 3, u, v, out); // a copy with loops of known length
    else
        eval_net(sub->net, (int)def->degree_u, (int)def->degree_v, u, v, out);
}

// Of a place where the tangents span no plane to speak of: the limit.
static Vec3 normal_limit(const PatchDef *def, double u, double v, Vec3 facing) {
    Bezier whole;
    bezier_init(&whole, (int)def->degree_u, (int)def->degree_v, def->points);
    if (def->weights)
        return rational_normal(&whole, def->weights, u, v, facing);
    return bezier_normal(&whole, u, v, facing);
}

// Was this root reported before? Two values for one root differ by the bounds over the slopes,
// as the ray sees them: along a ray near the tangent plane little is certain. at: S and its
// derivatives by the patch's parameters.
static bool seen_before(RefineWalk *walk, const PatchHit *hit, const Vec3 at[3]) {
    double steep = fabs(vec_dot(vec_cross(at[1], at[2]), walk->dir));
    double slope_u = steep / vec_length(vec_cross(walk->dir, at[2]));
    double slope_v = steep / vec_length(vec_cross(at[1], walk->dir));
    double reach = 2.0 * (hit->bound * walk->ray.patch->scale + walk->ray.tolerance);
    double t = hit->t, reach_t = reach * walk->ray.t_per_s;
    double reach_u = reach / slope_u, reach_v = reach / slope_v;
    uint64_t count = walk->seen_count < REFINE_SEEN ? walk->seen_count : REFINE_SEEN;
    for (uint64_t i = 0; i < count; i++) {
        if (walk->seen[i].patch == walk->patch &&
            fabs(walk->seen[i].t - t) <= walk->seen[i].reach_t + reach_t &&
            fabs(walk->seen[i].u - hit->u) <= walk->seen[i].reach_u + reach_u &&
            fabs(walk->seen[i].v - hit->v) <= walk->seen[i].reach_v + reach_v)
            return true;
    }
    uint64_t next = walk->seen_count++ % REFINE_SEEN;
    walk->seen[next].patch = walk->patch;
    walk->seen[next].t = t;
    walk->seen[next].u = hit->u;
    walk->seen[next].v = hit->v;
    walk->seen[next].reach_t = reach_t;
    walk->seen[next].reach_u = reach_u;
    walk->seen[next].reach_v = reach_v;
    return false;
}

void refine_report(RefineWalk *walk, const SubPatch *sub, double u, double v) {
    const RefineRay *ray = &walk->ray;
    const PatchDef *def = ray->patch->def;
    Query *query = walk->query;
    Vec3 at[3];
    eval_sub(def, sub, u, v, at);
    Vec3 away = vec_sub(at[0], ray->org);
    double s = vec_dot(away, ray->dir), t = ray->t_base + s * ray->t_per_s;
    if (!(t >= query->t_min && t < query->t_max))
        return;
    double width = sub->rect.u1 - sub->rect.u0, height = sub->rect.v1 - sub->rect.v0;
    PatchHit hit = {.t = t,
                    .u = sub->rect.u0 + u * width,
                    .v = sub->rect.v0 + v * height,
                    .bound = vec_length(vec_madd(away, -s, ray->dir)) + ray->error,
                    .id = def->id};
    Vec3 n = vec_cross(at[1], at[2]);
    double area = vec_length(n), lu = vec_length(at[1]), lv = vec_length(at[2]);
    // Derivatives err by twice the degree, 32 at most, times the rounding of S in each coordinate.
    bool certain = area > 1e6 * 64.0 * ray->patch->rounding * (lu + lv);
    hit.normal =
        certain ? vec_scale(n, 1.0 / area) : normal_limit(def, hit.u, hit.v, vec_neg(ray->dir));
    at[1] = vec_scale(at[1], 1.0 / width);
    at[2] = vec_scale(at[2], 1.0 / height);
    // Two roundings of each parameter. Weights that differ by powers of ten make that count.
    hit.bound += 0x1p-52 * (vec_length(at[1]) + vec_length(at[2]));
    hit.bound /= ray->patch->scale;
    if (query->kind != QUERY_ALL || !seen_before(walk, &hit, at))
        query_take(query, &hit);
}

void refine_take(RefineWalk *walk, const PatchHit *hit) {
    Query *query = walk->query;
    if (!(hit->t >= query->t_min && hit->t < query->t_max))
        return;
    if (query->kind == QUERY_ALL) {
        const PatchDef *def = walk->ray.patch->def;
        Bezier whole;
        Vec3 at[3];
        bezier_init(&whole, (int)def->degree_u, (int)def->degree_v, def->points);
        rational_eval(&whole, def->weights, hit->u, hit->v, at);
        for (int k = 1; k < 3; k++)
            at[k] = vec_scale(at[k], walk->ray.patch->scale);
        if (seen_before(walk, hit, at))
            return;
    }
    query_take(query, hit);
}
