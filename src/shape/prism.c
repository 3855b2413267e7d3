// SPDX-License-Identifier: MIT
// Prisms: a curve in (x, z) swept along y. Straight up, the ray's shadow in the plane y = 0 is a
// line that meets the curve; swept to a point at the origin, the plane through ray and origin meets
// the curve's plane y = 1 in a line. Both give a cubic in the curve's parameter.
#include "shape/curve.h"
#include "shape/roots.h"
#include "shape/solid.h"

typedef struct {
    Curve curve;
    double low, high;
    bool conic, open, turned; // turned: the normals point to the other side
} Prism;

enum { PART_BASE = -1, PART_CAP = -2 }; // else the piece

static void lid(const Prism *prism, const Ray *ray, double height, int part, HitSink *sink) {
    double t = (height - ray->org.y) / ray->dir.y;
    double size = prism->conic ? height : 1.0;
    if (fabs(size) <= SHAPE_EPSILON || !(t > 1e-4 && t < SHAPE_FARTHEST))
        return;
    if (curve_holds(&prism->curve, (ray->org.x + t * ray->dir.x) / size,
                    (ray->org.z + t * ray->dir.z) / size))
        sink_put(sink, t, part, vec3(0, 0, 0));
}

// The line of points (x, z) with a x + b z + c = 0.
typedef struct {
    double a, b, c;
} Line;

static bool line_misses(const Line *line, const CurvePiece *piece) {
    double x = 0.5 * (piece->low.u + piece->high.u), z = 0.5 * (piece->low.v + piece->high.v);
    double reach = fabs(line->a) * 0.5 * (piece->high.u - piece->low.u) +
                   fabs(line->b) * 0.5 * (piece->high.v - piece->low.v);
    double away = line->a * x + line->b * z + line->c;
    // Rounding of the sums, generously.
    double slack = 1e-12 * (fabs(line->a * x) + fabs(line->b * z) + fabs(line->c) + reach);
    return fabs(away) > reach + slack;
}

// Where the ray's shadow lies while the ray is at the prism's heights; everywhere for a cone.
static CurveBox shadow_of(const Prism *prism, const Ray *ray) {
    if (prism->conic || ray->dir.y == 0.0)
        return CURVE_EVERYWHERE;
    double a = (prism->low - ray->org.y) / ray->dir.y, b = (prism->high - ray->org.y) / ray->dir.y;
    Vec3 p = vec_madd(ray->org, a, ray->dir), q = vec_madd(ray->org, b, ray->dir);
    // Depths are rounded, and then the points.
    return curve_shadow(p.x, p.z, q.x, q.z, 1e-12 * (vec_length(ray->org) + fabs(a) + fabs(b)));
}

// The depth at which the ray stands over p; false: it never does.
static bool depth_at(const Prism *prism, const Ray *ray, Vec2 p, double *t) {
    if (!prism->conic) {
        *t = fabs(ray->dir.x) > fabs(ray->dir.z) ? (p.u - ray->org.x) / ray->dir.x
                                                 : (p.v - ray->org.z) / ray->dir.z;
        return true;
    }
    // x = p.u y along the ray; the better conditioned of the two.
    double h = ray->dir.x - p.u * ray->dir.y, k = ray->dir.z - p.v * ray->dir.y;
    if (fabs(h) <= SHAPE_EPSILON && fabs(k) <= SHAPE_EPSILON)
        return false;
    *t = fabs(h) > fabs(k) ? (p.u * ray->org.y - ray->org.x) / h
                           : (p.v * ray->org.y - ray->org.z) / k;
    return true;
}

static void piece_hits(const Prism *prism, const Ray *ray, const Line *line, uint32_t index,
                       HitSink *sink) {
    const CurvePiece *piece = &prism->curve.pieces[index];
    double c[4], roots[4], t;
    for (int i = 0; i <= piece->degree; i++)
        c[i] = line->a * piece->u[i] + line->b * piece->v[i];
    c[0] += line->c;
    for (int count = roots_find(c, piece->degree, 0.0, 1.0, roots); count > 0; count--) {
        double w = roots[count - 1];
        if (!depth_at(prism, ray, curve_at(piece, w), &t))
            continue;
        double height = ray->org.y + t * ray->dir.y;
        if (height >= prism->low && height <= prism->high)
            sink_put(sink, t, (int)index, vec3(w, 0, 0));
    }
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Prism *prism = data;
    const Vec3 o = ray->org, d = ray->dir;
    if (fabs(d.y) < SHAPE_EPSILON) {
        if (o.y < prism->low || o.y > prism->high)
            return;
    } else if (!prism->open) {
        lid(prism, ray, prism->high, PART_CAP, sink);
        lid(prism, ray, prism->low, PART_BASE, sink);
    }
    if (fabs(d.x) <= SHAPE_EPSILON && fabs(d.z) <= SHAPE_EPSILON)
        return;
    Line line = {d.z, -d.x, d.x * o.z - d.z * o.x};
    if (prism->conic)
        line = (Line){o.z * d.y - o.y * d.z, o.y * d.x - o.x * d.y, o.x * d.z - o.z * d.x};
    const CurveBox shadow = shadow_of(prism, ray);
    for (uint32_t i = 0; i < prism->curve.count; i++)
        if (!curve_apart(&shadow, prism->curve.pieces[i].low, prism->curve.pieces[i].high) &&
            !line_misses(&line, &prism->curve.pieces[i]))
            piece_hits(prism, ray, &line, i, sink);
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const Prism *prism = data;
    if (hit->part < 0)
        return vec3(0, 1, 0); // POV-Ray has this for both lids
    Vec2 s = curve_slope(&prism->curve.pieces[hit->part], hit->keep.x);
    Vec3 n = vec3(s.v, 0, -s.u);
    if (prism->turned)
        n = vec_neg(n);
    if (prism->conic) {
        if (!(fabs(p.y) > SHAPE_EPSILON))
            return vec3(0, 1, 0);
        n.y = -(p.x * n.x + p.z * n.z) / p.y;
    }
    return n;
}

static bool inside(const void *data, Vec3 p) {
    const Prism *prism = data;
    if (!(p.y >= prism->low && p.y < prism->high))
        return false;
    double size = prism->conic ? p.y : 1.0;
    return fabs(size) > SHAPE_EPSILON && curve_holds(&prism->curve, p.x / size, p.z / size);
}

static const SolidOps OPS = {
    .near = 1e-4, .far = SHAPE_FARTHEST, .hits = hits, .normal = normal, .inside = inside};

SolidData prism_prepare(const PrismShape *prism, Arena *arena) {
    Prism *data = ARENA_NEW(arena, Prism);
    *data = (Prism){.curve = curve_make(prism->outline, prism->points, prism->count, true, arena),
                    .low = fmin(prism->low, prism->high),
                    .high = fmax(prism->low, prism->high),
                    .conic = prism->conic,
                    .open = prism->open,
                    .turned = prism->outline == OUTLINE_BEZIER};
    const Curve *c = &data->curve;
    Box box = {{c->low.u, data->low, c->low.v}, {c->high.u, data->high, c->high.v}};
    if (prism->conic) {
        box = box_empty();
        for (int i = 0; i < 8; i++) {
            double y = i & 1 ? data->high : data->low;
            box = box_extend(box, vec3((i & 2 ? c->high.u : c->low.u) * y, y,
                                       (i & 4 ? c->high.v : c->low.v) * y));
        }
    }
    return (SolidData){&OPS, data, box};
}
