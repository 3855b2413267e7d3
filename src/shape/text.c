// SPDX-License-Identifier: MIT
// Letters: outlines of quadratic arcs in the plane z = 0, extruded to z = thickness. What is within
// an outline goes by the even-odd rule; letters that overlap are a union.
#include "shape/curve.h"
#include "shape/roots.h"
#include "shape/solid.h"

typedef struct {
    double thickness;
    Curve *letters;
    uint32_t count;
} Text;

enum { PART_FRONT = -1, PART_BACK = -2, PART_SIDE = 0 };

static void lid(const Text *text, const Curve *letter, const Ray *ray, double z, int part,
                HitSink *sink) {
    (void)text;
    double t = (z - ray->org.z) / ray->dir.z;
    if (t > 0.0 && curve_holds(letter, ray->org.x + t * ray->dir.x, ray->org.y + t * ray->dir.y))
        sink_put(sink, t, part, vec3(0, 0, part == PART_FRONT ? -1 : 1));
}

static void side_hits(const Text *text, const CurvePiece *piece, const Ray *ray, HitSink *sink) {
    const Vec3 o = ray->org, d = ray->dir;
    // The ray's shadow: a x + b y + c = 0.
    double a = d.y, b = -d.x, c = o.y * d.x - o.x * d.y;
    double middle =
        a * 0.5 * (piece->low.u + piece->high.u) + b * 0.5 * (piece->low.v + piece->high.v) + c;
    double reach = fabs(a) * 0.5 * (piece->high.u - piece->low.u) +
                   fabs(b) * 0.5 * (piece->high.v - piece->low.v);
    if (fabs(middle) > reach + 1e-12 * (reach + fabs(c)))
        return;
    double p[4], roots[4];
    for (int i = 0; i <= piece->degree; i++)
        p[i] = a * piece->u[i] + b * piece->v[i];
    p[0] += c;
    for (int count = roots_find(p, piece->degree, 0.0, 1.0, roots); count > 0; count--) {
        double w = roots[count - 1];
        Vec2 at = curve_at(piece, w), slope = curve_slope(piece, w);
        double t = fabs(d.x) > fabs(d.y) ? (at.u - o.x) / d.x : (at.v - o.y) / d.y;
        double z = o.z + t * d.z;
        if (z >= 0.0 && z <= text->thickness)
            sink_put(sink, t, PART_SIDE, vec3(slope.v, -slope.u, 0));
    }
}

// Where the ray's shadow lies while the ray is between front and back.
static CurveBox shadow_of(const Text *text, const Ray *ray) {
    if (ray->dir.z == 0.0)
        return CURVE_EVERYWHERE;
    double a = -ray->org.z / ray->dir.z, b = (text->thickness - ray->org.z) / ray->dir.z;
    Vec3 p = vec_madd(ray->org, a, ray->dir), q = vec_madd(ray->org, b, ray->dir);
    // Depths are rounded, and then the points.
    return curve_shadow(p.x, p.y, q.x, q.y, 1e-12 * (vec_length(ray->org) + fabs(a) + fabs(b)));
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Text *text = data;
    const CurveBox shadow = shadow_of(text, ray);
    for (uint32_t i = 0; i < text->count; i++) {
        const Curve *letter = &text->letters[i];
        if (curve_apart(&shadow, letter->low, letter->high))
            continue;
        if (fabs(ray->dir.z) > SHAPE_EPSILON) {
            lid(text, letter, ray, 0.0, PART_FRONT, sink);
            lid(text, letter, ray, text->thickness, PART_BACK, sink);
        }
        if (fabs(ray->dir.x) < SHAPE_EPSILON && fabs(ray->dir.y) < SHAPE_EPSILON)
            continue;
        for (uint32_t k = 0; k < letter->count; k++)
            if (!curve_apart(&shadow, letter->pieces[k].low, letter->pieces[k].high))
                side_hits(text, &letter->pieces[k], ray, sink);
    }
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    (void)data, (void)p;
    return hit->keep;
}

static bool inside(const void *data, Vec3 p) {
    const Text *text = data;
    if (!(p.z > 0.0 && p.z < text->thickness))
        return false;
    for (uint32_t i = 0; i < text->count; i++)
        if (curve_holds(&text->letters[i], p.x, p.y))
            return true;
    return false;
}

static const SolidOps OPS = {
    .near = 1e-6, .far = INFINITY, .hits = hits, .normal = normal, .inside = inside};

SolidData text_prepare(const TextShape *shape, Arena *arena) {
    Text *text = ARENA_NEW(arena, Text);
    *text = (Text){.thickness = shape->thickness,
                   .letters = ARENA_ARRAY(arena, Curve, shape->letter_count)};
    Box box = box_empty();
    for (uint32_t i = 0; i < shape->letter_count; i++) {
        uint32_t first = shape->letters[i];
        uint32_t end = i + 1 < shape->letter_count ? shape->letters[i + 1] : shape->arc_count;
        Curve letter = curve_of_arcs(shape->arcs + 6 * (size_t)first, end - first, arena);
        if (letter.count == 0)
            continue;
        text->letters[text->count++] = letter;
        box = box_extend(box, vec3(letter.low.u, letter.low.v, 0));
        box = box_extend(box, vec3(letter.high.u, letter.high.v, shape->thickness));
    }
    if (text->count == 0)
        return (SolidData){0};
    return (SolidData){&OPS, text, box};
}
