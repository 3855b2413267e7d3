// SPDX-License-Identifier: MIT
// The triangle over corners h apart in both parameters is linear, and differs from S at the same
// (u,v) by at most h^2 (|Suu| + 2 |Suv| + |Svv|) / 8; second differences of the net bound the
// derivatives. So n cuts with n^2 = that sum / (8 distance) are enough.
#include "patch/tessellation.h"

#include "base/diag.h"
#include "patch/bernstein.h"
#include "patch/embree.h"

#include <assert.h>
#include <float.h>

enum {
    SEEN = 64,
    MAX_CUTS = 4096,
    TRIANGLES_IN_ALL = 1 << 24 // about 2 GB with Embree's tree
};

uint32_t tessellation_cuts(const PatchDef *def, double distance) {
    int du = (int)def->degree_u, dv = (int)def->degree_v, row = dv + 1;
    double uu = 0.0, uv = 0.0, vv = 0.0;
    for (int i = 0; i <= du; i++) {
        for (int j = 0; j <= dv; j++) {
            const Vec3 *p = &def->points[i * row + j];
            if (i + 2 <= du)
                uu = fmax(uu,
                          vec_length(vec_sub(vec_sub(p[2 * row], p[row]), vec_sub(p[row], p[0]))));
            if (j + 2 <= dv)
                vv = fmax(vv, vec_length(vec_sub(vec_sub(p[2], p[1]), vec_sub(p[1], p[0]))));
            if (i < du && j < dv)
                uv =
                    fmax(uv, vec_length(vec_sub(vec_sub(p[row + 1], p[row]), vec_sub(p[1], p[0]))));
        }
    }
    double sum = uu * du * (du - 1) + 2.0 * uv * du * dv + vv * dv * (dv - 1);
    double cuts = ceil(sqrt(sum / (8.0 * distance)));
    return cuts >= 1.0 ? (uint32_t)fmin(cuts, MAX_CUTS) : 1;
}

#if !EMBREE_HEADERS

Tessellation *tessellation_create(Arena *arena, const PatchDef *defs, size_t count) {
    (void)arena, (void)defs, (void)count;
    die("no method tessellation: %s", embree_missing());
}

void tessellation_release(Tessellation *tessellation) { (void)tessellation; }

uint64_t tessellation_memory(const Tessellation *tessellation) {
    (void)tessellation;
    return 0;
}

void tessellation_query(const Tessellation *tessellation, Query *query) {
    (void)tessellation, (void)query;
}

#else

struct Tessellation {
    const PatchDef *defs;
    EmbreeMesh *mesh;
    Box bounds;    // of the control points
    double radius; // of a ball about the mesh's center that holds them
    double reach;  // largest coordinate
};

// Chooses the cuts; more than memory allows are scaled down together.
static void choose_cuts(const PatchDef *defs, size_t count, uint32_t *cuts) {
    double wanted = 0.0, tightest = INFINITY; // tolerance as a share of the diameter
    for (size_t i = 0; i < count; i++) {
        Box box = box_empty();
        for (uint32_t k = 0; k < (defs[i].degree_u + 1) * (defs[i].degree_v + 1); k++)
            box = box_extend(box, defs[i].points[k]);
        // Single precision rounds the vertices to 2^-24: finer triangles are not nearer.
        double diameter = vec_length(vec_sub(box.high, box.low));
        tightest = fmin(tightest, diameter > 0.0 ? defs[i].tolerance / diameter : INFINITY);
        cuts[i] = tessellation_cuts(&defs[i], fmax(defs[i].tolerance, 0x1p-24 * diameter));
        wanted += 2.0 * cuts[i] * cuts[i];
    }
    double shrink = fmin(1.0, sqrt(TRIANGLES_IN_ALL / wanted));
    for (size_t i = 0; i < count && shrink < 1.0; i++) {
        double fewer = floor(cuts[i] * shrink);
        cuts[i] = fewer >= 1.0 ? (uint32_t)fewer : 1;
    }
    if (tightest < 0x1p-24 || shrink < 1.0)
        warn("triangles cannot keep to the tolerance %g: they are within %.2g of the patches' "
             "diameters",
             tightest, fmax(tightest, 0x1p-24) / (shrink * shrink));
}

Tessellation *tessellation_create(Arena *arena, const PatchDef *defs, size_t count) {
    if (embree_missing())
        die("no method tessellation: %s", embree_missing());
    Tessellation *t = ARENA_NEW(arena, Tessellation);
    t->defs = defs;
    uint32_t *cuts = ARENA_ARRAY(arena, uint32_t, count);
    choose_cuts(defs, count, cuts);
    t->mesh =
        embree_mesh_create(arena, defs, count, cuts, RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION, 0);
    t->bounds = box_empty();
    for (size_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < (defs[i].degree_u + 1) * (defs[i].degree_v + 1); k++)
            t->bounds = box_extend(t->bounds, defs[i].points[k]);
    }
    for (int axis = 0; axis < 3 && count; axis++)
        t->reach = fmax(t->reach, fmax(fabs(vec_get(t->bounds.low, axis)),
                                       fabs(vec_get(t->bounds.high, axis))));
    t->radius = 0.5 * vec_length(vec_sub(t->bounds.high, t->bounds.low));
    return t;
}

void tessellation_release(Tessellation *t) { embree_mesh_release(t->mesh); }

uint64_t tessellation_memory(const Tessellation *t) { return t->mesh->bytes; }

// ---- Rays

// The context comes first: Embree hands its address to the filter.
typedef struct {
    struct RTCIntersectContext context;
    const Tessellation *tessellation;
    Query *query;
    double t_base, t_per_s; // t = t_base + s t_per_s, s what Embree counts in
    // Triangles reported to QUERY_ALL, the last ones: Embree's spatial splits can meet one twice.
    uint32_t seen[SEEN];
    uint64_t seen_count;
} Walk;

static bool seen_before(Walk *walk, uint32_t triangle) {
    uint64_t count = walk->seen_count < SEEN ? walk->seen_count : SEEN;
    for (uint64_t i = 0; i < count; i++) {
        if (walk->seen[i] == triangle)
            return true;
    }
    walk->seen[walk->seen_count++ % SEEN] = triangle;
    return false;
}

// S, dS/du and dS/dv.
static inline void sum_up(const Vec3 *p, int du, int dv, double u, double v, Vec3 out[3]) {
    double wu[BEZIER_MAX_DEGREE + 1], su[BEZIER_MAX_DEGREE + 1];
    double wv[BEZIER_MAX_DEGREE + 1], sv[BEZIER_MAX_DEGREE + 1];
    bernstein(du, u, wu, su);
    bernstein(dv, v, wv, sv);
    out[0] = out[1] = out[2] = vec3(0.0, 0.0, 0.0);
    for (int i = 0; i <= du; i++) {
        Vec3 row = vec3(0.0, 0.0, 0.0), slope = row;
        for (int j = 0; j <= dv; j++, p++) {
            row = vec_madd(row, wv[j], *p);
            slope = vec_madd(slope, sv[j], *p);
        }
        out[0] = vec_madd(out[0], wu[i], row);
        out[1] = vec_madd(out[1], su[i], row);
        out[2] = vec_madd(out[2], wu[i], slope);
    }
}

static void eval_patch(const PatchDef *def, double u, double v, Vec3 out[3]) {
    if (def->degree_u == 3 && def->degree_v == 3)
        sum_up(def->points, 3, 3, u, v, out); // a copy with loops of known length
    else
        sum_up(def->points, (int)def->degree_u, (int)def->degree_v, u, v, out);
}

static Vec3 normal_limit(const PatchDef *def, double u, double v, Vec3 facing) {
    Bezier whole;
    bezier_init(&whole, (int)def->degree_u, (int)def->degree_v, def->points);
    return bezier_normal(&whole, u, v, facing);
}

static bool finish_hit(const Walk *walk, double s, uint32_t triangle, double a, double b,
                       PatchHit *hit) {
    const Tessellation *t = walk->tessellation;
    const Ray *ray = &walk->query->ray;
    double u, v;
    uint32_t patch = embree_mesh_place(t->mesh, triangle, a, b, &u, &v);
    const PatchDef *def = &t->defs[patch];
    if (!(def->mask & walk->query->mask))
        return false;
    *hit = (PatchHit){.t = walk->t_base + s * walk->t_per_s, .u = u, .v = v, .id = def->id};
    if (!(hit->t >= walk->query->t_min && hit->t < walk->query->t_max))
        return false;
    // How far the triangle's point is from the patch's, measured, and the rounding of both: of S
    // as in piece.h, 4 (du + dv) half ulps; of the ray's point 2 of each coordinate.
    Vec3 at[3];
    eval_patch(def, u, v, at);
    Vec3 off = vec_sub(vec_madd(ray->org, hit->t, ray->dir), at[0]);
    double far = fabs(ray->org.x) + fabs(ray->org.y) + fabs(ray->org.z) + vec_length(off);
    double ulps = 4.0 * (def->degree_u + def->degree_v) * DBL_EPSILON * t->reach;
    hit->bound = vec_length(off) + 4.0 * DBL_EPSILON * far + ulps;
    hit->normal = vec_cross(at[1], at[2]);
    double area = vec_length(hit->normal);
    if (area > 1e6 * 32.0 * ulps * (vec_length(at[1]) + vec_length(at[2])))
        hit->normal = vec_scale(hit->normal, 1.0 / area);
    else
        hit->normal = normal_limit(def, u, v, vec_neg(ray->dir));
    return true;
}

// Called for each triangle met: takes what counts itself, and lets Embree go on.
static void filter(const struct RTCFilterFunctionNArguments *args) {
    assert(args->N == 1);
    if (args->valid[0] != -1)
        return;
    Walk *walk = (Walk *)args->context;
    const struct RTCRay *ray = (const struct RTCRay *)args->ray;
    const struct RTCHit *at = (const struct RTCHit *)args->hit;
    PatchHit hit;
    args->valid[0] = 0;
    walk->query->stats.steps++;
    if (!finish_hit(walk, (double)ray->tfar, at->primID, (double)at->u, (double)at->v, &hit))
        return;
    if (walk->query->kind == QUERY_ALL && seen_before(walk, at->primID))
        return;
    query_take(walk->query, &hit); // the nearest lowers t_max
    if (query_done(walk->query))
        args->valid[0] = -1;
}

// The part of the ray that can meet the ball about the set, as Embree's numbers. False: none.
static bool set_ray(Walk *walk, struct RTCRay *out) {
    const Tessellation *t = walk->tessellation;
    const Query *query = walk->query;
    const Vec3 d = query->ray.dir;
    double most = fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z)));
    if (!(most > 0.0))
        return false;
    Vec3 unit = vec_normalize(vec_scale(d, 1.0 / most));
    Vec3 away = vec_sub(query->ray.org, t->mesh->center);
    double shift = -vec_dot(away, unit);
    Vec3 near = vec_madd(away, shift, unit);
    double reach = t->radius * (1.0 + 0x1p-20);
    if (!(vec_length(near) <= reach))
        return false;
    walk->t_per_s = 1.0 / (most * vec_length(vec_scale(d, 1.0 / most)));
    // Start on the ball's near side, where s is small and positive.
    near = vec_madd(near, -reach, unit);
    walk->t_base = (shift - reach) * walk->t_per_s;
    double low = fmax((query->t_min - walk->t_base) / walk->t_per_s, 0.0);
    double high = fmin((query->t_max - walk->t_base) / walk->t_per_s, 2.0 * reach);
    if (!(low <= high))
        return false;
    *out = (struct RTCRay){.org_x = (float)near.x,
                           .org_y = (float)near.y,
                           .org_z = (float)near.z,
                           .dir_x = (float)unit.x,
                           .dir_y = (float)unit.y,
                           .dir_z = (float)unit.z,
                           .tnear = (float)low * (1.0f - 0x1p-22f),
                           .tfar = (float)high * (1.0f + 0x1p-22f),
                           .mask = UINT32_MAX};
    return true;
}

void tessellation_query(const Tessellation *t, Query *query) {
    Walk walk;
    walk.tessellation = t;
    walk.query = query;
    walk.seen_count = 0;
    struct RTCRayHit ask;
    if (!set_ray(&walk, &ask.ray))
        return;
    ask.hit.geomID = ask.hit.primID = RTC_INVALID_GEOMETRY_ID;
    rtcInitIntersectContext(&walk.context);
    query->stats.patch_tests++;
    // Without a filter if the first hit will do: then Embree shortens the ray by itself.
    if (query->kind == QUERY_NEAREST) {
        embree()->rtcIntersect1(t->mesh->scene, &walk.context, &ask);
        PatchHit hit;
        if (ask.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            return;
        if (finish_hit(&walk, (double)ask.ray.tfar, ask.hit.primID, (double)ask.hit.u,
                       (double)ask.hit.v, &hit)) {
            query_take(query, &hit);
            return;
        }
        // It does not count (mask, or the range's ends): look at all of them.
        set_ray(&walk, &ask.ray);
        ask.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
    walk.context.filter = filter;
    if (query->kind == QUERY_ANY)
        embree()->rtcOccluded1(t->mesh->scene, &walk.context, &ask.ray);
    else
        embree()->rtcIntersect1(t->mesh->scene, &walk.context, &ask);
}

#endif
