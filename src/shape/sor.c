// SPDX-License-Identifier: MIT
// Surfaces of revolution: between two points r^2 is a cubic in the height, with POV-Ray's slopes
// from the neighbours (facts: rendering 8). So each piece is a cubic in the depth.
#include "shape/roots.h"
#include "shape/solid.h"

typedef struct {
    double low, high; // heights
    double c[4];      // r^2 = c[0] + c[1] s + ..., s = height - low
} Piece;

typedef struct {
    Piece *pieces;
    uint32_t count;
    bool open;
    double base2, cap2; // squares of the radii of the lids
    double radius;
} Sor;

enum { PART_BASE = -1, PART_CAP = -2 }; // else the piece

static void lid(const Ray *ray, double height, double radius2, int part, HitSink *sink) {
    if (!(radius2 > 1e-4)) // POV-Ray leaves out lids as small as this
        return;
    double t = (height - ray->org.y) / ray->dir.y;
    double x = ray->org.x + t * ray->dir.x, z = ray->org.z + t * ray->dir.z;
    if (x * x + z * z <= radius2)
        sink_put(sink, t, part, vec3(0, 0, 0));
}

static void piece_hits(const Ray *ray, const Piece *piece, uint32_t index, HitSink *sink) {
    // The depths at which the ray is at the piece's heights.
    double d = ray->dir.y, from = 0.0, to = fmin(sink->t_max, SHAPE_FARTHEST * sink->scale);
    if (d != 0.0) {
        double a = (piece->low - ray->org.y) / d, b = (piece->high - ray->org.y) / d;
        from = fmax(from, fmin(a, b));
        to = fmin(to, fmax(a, b));
    } else if (ray->org.y < piece->low || ray->org.y > piece->high) {
        return;
    }
    if (!(from <= to))
        return;
    // Depths are counted from where the ray is nearest to the axis, or enters the piece.
    double flat = ray->dir.x * ray->dir.x + ray->dir.z * ray->dir.z;
    double middle = flat > 0.0 ? -(ray->org.x * ray->dir.x + ray->org.z * ray->dir.z) / flat : from;
    middle = fmin(fmax(middle, from), to);
    Vec3 o = vec_madd(ray->org, middle, ray->dir);
    double s = o.y - piece->low;
    const double *c = piece->c;
    double p[4] = {((c[3] * s + c[2]) * s + c[1]) * s + c[0] - o.x * o.x - o.z * o.z,
                   ((3.0 * c[3] * s + 2.0 * c[2]) * s + c[1]) * d -
                       2.0 * (o.x * ray->dir.x + o.z * ray->dir.z),
                   (3.0 * c[3] * s + c[2]) * d * d - flat, c[3] * d * d * d};
    double roots[4];
    double bound = roots_bound(p, 3);
    int count = roots_find(p, 3, fmax(from - middle, -bound), fmin(to - middle, bound), roots);
    for (int i = 0; i < count; i++)
        sink_put(sink, middle + roots[i], (int)index, vec3(0, 0, 0));
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Sor *sor = data;
    double flat = ray->dir.x * ray->dir.x + ray->dir.z * ray->dir.z;
    double away = ray->org.x * ray->dir.z - ray->org.z * ray->dir.x;
    if (away * away > sor->radius * sor->radius * flat * (1.0 + 1e-9))
        return;
    if (!sor->open && fabs(ray->dir.y) > SHAPE_EPSILON) {
        lid(ray, sor->pieces[0].low, sor->base2, PART_BASE, sink);
        lid(ray, sor->pieces[sor->count - 1].high, sor->cap2, PART_CAP, sink);
    }
    for (uint32_t i = 0; i < sor->count; i++)
        piece_hits(ray, &sor->pieces[i], i, sink);
}

static double square_at(const Piece *piece, double height) {
    return roots_value(piece->c, 3, height - piece->low);
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const Sor *sor = data;
    if (hit->part < 0)
        return vec3(0, hit->part == PART_BASE ? -1 : 1, 0);
    const Piece *piece = &sor->pieces[hit->part];
    double s = p.y - piece->low;
    double slope = (3.0 * piece->c[3] * s + 2.0 * piece->c[2]) * s + piece->c[1];
    return vec3(p.x, -0.5 * slope, p.z);
}

static bool inside(const void *data, Vec3 p) {
    const Sor *sor = data;
    for (uint32_t i = 0; i < sor->count; i++) {
        const Piece *piece = &sor->pieces[i];
        if (p.y >= piece->low && p.y <= piece->high)
            return p.x * p.x + p.z * p.z <= square_at(piece, p.y);
    }
    return false;
}

static Vec2 uv(const void *data, Vec3 p, const ShapeHit *hit) {
    const Sor *sor = data;
    double u = solid_angle(p), r = sqrt(p.x * p.x + p.z * p.z);
    if (hit->part == PART_BASE)
        return (Vec2){u, r / sqrt(sor->base2) - 1.0};
    if (hit->part == PART_CAP)
        return (Vec2){u, 2.0 - r / sqrt(sor->cap2)};
    const Piece *piece = &sor->pieces[hit->part];
    return (Vec2){u, ((p.y - piece->low) / (piece->high - piece->low) + hit->part) / sor->count};
}

// The cubic through the squares of the radii with the slopes of the lines between the neighbours.
static Piece make_piece(const Vec2 *p) {
    double h = p[2].v - p[1].v;
    double start = p[1].u * p[1].u, end = p[2].u * p[2].u;
    double start_slope = 2.0 * p[1].u * (p[2].u - p[0].u) / (p[2].v - p[0].v);
    double end_slope = 2.0 * p[2].u * (p[3].u - p[1].u) / (p[3].v - p[1].v);
    double mean = (end - start) / h;
    return (Piece){p[1].v,
                   p[2].v,
                   {start, start_slope, (3.0 * mean - 2.0 * start_slope - end_slope) / h,
                    (start_slope + end_slope - 2.0 * mean) / (h * h)}};
}

// The largest radius of the piece.
static double widest(const Piece *piece) {
    const double slope[3] = {piece->c[1], 2.0 * piece->c[2], 3.0 * piece->c[3]};
    double turns[3], h = piece->high - piece->low;
    double r2 = fmax(piece->c[0], roots_value(piece->c, 3, h));
    for (int n = roots_find(slope, 2, 0.0, h, turns); n > 0; n--)
        r2 = fmax(r2, roots_value(piece->c, 3, turns[n - 1]));
    return sqrt(fmax(r2, 0.0));
}

static const SolidOps OPS = {.near = 1e-4,
                             .far = SHAPE_FARTHEST,
                             .hits = hits,
                             .normal = normal,
                             .inside = inside,
                             .uv = uv};

SolidData sor_prepare(const SorShape *sor, Arena *arena) {
    Sor *data = ARENA_NEW(arena, Sor);
    *data = (Sor){.pieces = ARENA_ARRAY(arena, Piece, sor->count - 3),
                  .count = sor->count - 3,
                  .open = sor->open};
    for (uint32_t i = 0; i < data->count; i++) {
        data->pieces[i] = make_piece(sor->points + i);
        data->radius = fmax(data->radius, widest(&data->pieces[i]));
    }
    const Piece *last = &data->pieces[data->count - 1];
    data->base2 = fmax(data->pieces[0].c[0], 0.0);
    data->cap2 = fmax(square_at(last, last->high), 0.0);
    double r = data->radius;
    return (SolidData){&OPS, data, {{-r, data->pieces[0].low, -r}, {r, last->high, r}}};
}
