// SPDX-License-Identifier: MIT
// Blobs: the field of each part is a quadratic in the square of a distance, so a polynomial of
// degree 4 in the depth, between the depths where the ray enters and leaves the part. Between two
// such depths the sum of those around is one polynomial. A cylinder has three parts: itself and
// half a sphere at each end. Of many parts a tree of boxes tells which are near; sums are made in
// their order all the same, so that they are the same to the last bit.
#include "shape/bvh_walk.h"
#include "shape/roots.h"
#include "shape/solid.h"

typedef enum { PART_SPHERE, PART_BASE, PART_CYLINDER, PART_APEX } PartKind;

typedef struct {
    PartKind kind;
    bool moved;        // by to_part, to where the axis is z
    Transform to_part; // m only
    Vec3 center;       // of a sphere that is not moved
    double length;     // of a cylinder
    double radius2;
    double c[3]; // field = c[0] + c[1] q + c[2] q^2, q the square of the distance
    uint32_t component;
} Part;

typedef struct {
    double threshold;
    Part *parts;
    uint32_t count;
    const BlobComponent *components;
    Bvh tree; // of the parts, if there are many
} Blob;

// So many parts are remembered along a ray or around a point; where there are more, all of the
// blob's are looked at. No memory is taken for a ray, and no blob is too large.
enum { REMEMBERED = 64 };

// The parts near a ray or a point, ascending.
typedef struct {
    const Blob *blob;
    bool all; // too many
    uint32_t count, parts[REMEMBERED];
} Near;

static bool note_part(void *context, uint32_t place) {
    Near *near = context;
    uint32_t part = near->blob->tree.items[place], at = near->count;
    if (at == REMEMBERED)
        return near->all = true;
    for (near->count++; at > 0 && near->parts[at - 1] > part; at--)
        near->parts[at] = near->parts[at - 1];
    near->parts[at] = part;
    return false;
}

static double note_part_on_ray(void *context, uint32_t place) {
    return note_part(context, place) ? -INFINITY : INFINITY;
}

static void finish_near(Near *near) {
    if (near->all)
        near->count = near->blob->count;
}

static void near_point(const Blob *blob, Vec3 p, Near *near) {
    near->blob = blob;
    near->count = 0;
    near->all = blob->tree.item_count == 0;
    if (!near->all)
        bvh_walk_point(&blob->tree, p, note_part, near);
    finish_near(near);
}

static void near_ray(const Blob *blob, const Ray *ray, double t_min, Near *near) {
    near->blob = blob;
    near->count = 0;
    near->all = blob->tree.item_count == 0;
    if (!near->all)
        bvh_walk(&blob->tree, ray, fmax(t_min, 0.0), INFINITY, note_part_on_ray, near);
    finish_near(near);
}

static const Part *near_part(const Near *near, uint32_t i) {
    return &near->blob->parts[near->all ? i : near->parts[i]];
}

static Vec3 to_part(const Part *part, Vec3 p) {
    Vec3 q = part->moved ? transform_point(&part->to_part, p) : vec_sub(p, part->center);
    if (part->kind == PART_APEX)
        q.z -= part->length;
    if (part->kind == PART_CYLINDER)
        q.z = 0.0;
    return q;
}

// What the ray has of a part: its field from `enter` to `leave`, q = a s^2 + 2 b s + c with s the
// depth from `origin`.
typedef struct {
    double enter, leave;
    double a, b, c;
} Interval;

// Cuts to where z is on the part's side.
static bool cut_ends(const Part *part, double z, double dz, double low, double high,
                     Interval *interval) {
    if (dz == 0.0)
        return z >= low && z <= high;
    double s = (low - z) / dz, t = (high - z) / dz;
    (void)part;
    interval->enter = fmax(interval->enter, fmin(s, t));
    interval->leave = fmin(interval->leave, fmax(s, t));
    return interval->enter < interval->leave;
}

static bool part_interval(const Part *part, const Ray *ray, double origin, Interval *interval) {
    Vec3 at = vec_madd(ray->org, origin, ray->dir);
    Vec3 o = part->moved ? transform_point(&part->to_part, at) : vec_sub(at, part->center);
    Vec3 d = part->moved ? transform_dir(&part->to_part, ray->dir) : ray->dir;
    double z = o.z, dz = d.z;
    if (part->kind == PART_APEX)
        o.z -= part->length;
    if (part->kind == PART_CYLINDER)
        o.z = d.z = 0.0;
    double a = vec_dot(d, d), b = vec_dot(o, d), c = vec_dot(o, o);
    *interval = (Interval){-INFINITY, INFINITY, a, b, c};
    if (a > 0.0) {
        double half = b * b - a * (c - part->radius2);
        if (!(half > 0.0))
            return false;
        interval->enter = (-b - sqrt(half)) / a;
        interval->leave = (-b + sqrt(half)) / a;
    } else if (!(c < part->radius2)) {
        return false;
    }
    if (part->kind == PART_CYLINDER)
        return cut_ends(part, z, dz, 0.0, part->length, interval);
    if (part->kind == PART_BASE)
        return cut_ends(part, z, dz, -INFINITY, 0.0, interval);
    if (part->kind == PART_APEX)
        return cut_ends(part, z, dz, part->length, INFINITY, interval);
    return true;
}

static void add_field(const Part *part, const Interval *i, double sum[5]) {
    const double *k = part->c;
    double b = 2.0 * i->b;
    sum[0] += k[0] + i->c * (k[1] + i->c * k[2]);
    sum[1] += b * (k[1] + 2.0 * k[2] * i->c);
    sum[2] += k[1] * i->a + k[2] * (b * b + 2.0 * i->a * i->c);
    sum[3] += 2.0 * k[2] * i->a * b;
    sum[4] += k[2] * i->a * i->a;
}

// With too many intervals each is worked out anew when it is looked at.
typedef struct {
    const Blob *blob;
    const Ray *ray;
    double origin;
    uint32_t count; // of those remembered; of all parts when there are too many
    bool all;
    Interval intervals[REMEMBERED];
    double peaks[REMEMBERED]; // the most that each field comes to on the ray
    uint32_t parts[REMEMBERED];
} Crossed;

// A field that takes away comes to nothing at its end.
static double peak_of(const Part *part, const Interval *i) {
    const double *k = part->c;
    double q = i->a > 0.0 ? i->c - i->b * i->b / i->a : i->c;
    q = q < 0.0 ? 0.0 : q;
    return k[0] > 0.0 ? k[0] + q * (k[1] + q * k[2]) : 0.0;
}

static void cross_parts(Crossed *crossed, double nearest) {
    const Blob *blob = crossed->blob;
    Near near;
    near_ray(blob, crossed->ray, crossed->origin + nearest, &near);
    for (uint32_t k = 0; k < near.count; k++) {
        uint32_t i = near.all ? k : near.parts[k];
        Interval interval;
        if (!part_interval(&blob->parts[i], crossed->ray, crossed->origin, &interval) ||
            interval.leave <= nearest)
            continue;
        if (crossed->count == REMEMBERED) {
            crossed->all = true;
            crossed->count = blob->count;
            return;
        }
        crossed->intervals[crossed->count] = interval;
        crossed->peaks[crossed->count] = peak_of(&blob->parts[i], &interval);
        crossed->parts[crossed->count++] = i;
    }
}

// The stretch that begins at `from`: the sum of the fields there, and where it ends. Each interval
// is worked out anew.
static double next_stretch(const Crossed *crossed, double from, double sum[5], bool *any) {
    double end = INFINITY;
    *any = false;
    sum[0] = -crossed->blob->threshold;
    sum[1] = sum[2] = sum[3] = sum[4] = 0.0;
    for (uint32_t i = 0; i < crossed->count; i++) {
        const Part *part = &crossed->blob->parts[i];
        Interval interval;
        if (!part_interval(part, crossed->ray, crossed->origin, &interval))
            continue;
        if (interval.enter > from) {
            end = fmin(end, interval.enter);
        } else if (interval.leave > from) {
            end = fmin(end, interval.leave);
            add_field(part, &interval, sum);
            *any = true;
        }
    }
    return end;
}

static void put_roots(const Crossed *crossed, const double sum[5], double from, double to,
                      HitSink *sink) {
    double roots[4];
    int count = roots_find(sum, 4, from, to, roots);
    for (int i = 0; i < count; i++)
        sink_put(sink, crossed->origin + roots[i], 0, vec3(0, 0, 0));
}

static void walk_all(const Crossed *crossed, double from, HitSink *sink) {
    for (;;) {
        double sum[5];
        bool any;
        double to = next_stretch(crossed, from, sum, &any);
        if (!(to < INFINITY) || crossed->origin + from > sink->t_max)
            return;
        if (any)
            put_roots(crossed, sum, from, to, sink);
        from = to;
    }
}

// ---- the same with all intervals remembered: of parts around a stretch there is a bit each -----

typedef struct {
    double at;
    uint32_t interval;
    bool leaves;
} Border;

_Static_assert(REMEMBERED <= 64, "one bit each");

// The borders beyond `from`, ascending; *around: the intervals that are open there.
static uint32_t sort_borders(const Crossed *crossed, double from, Border *borders,
                             uint64_t *around) {
    uint32_t count = 0;
    *around = 0;
    for (uint32_t i = 0; i < crossed->count; i++) {
        const Interval *interval = &crossed->intervals[i];
        if (interval->enter <= from)
            *around |= (uint64_t)1 << i;
        for (int leaves = interval->enter <= from; leaves < 2; leaves++) {
            double at = leaves ? interval->leave : interval->enter;
            uint32_t place = count++;
            for (; place > 0 && borders[place - 1].at > at; place--)
                borders[place] = borders[place - 1];
            borders[place] = (Border){at, i, leaves};
        }
    }
    return count;
}

// Does the sum of the fields come to the threshold? Their peaks, as far from right as the sum is,
// tell mostly that it doesn't; the slack is for parts 1e6 radii from the place where depths begin.
static bool may_reach(const Crossed *crossed, uint64_t around) {
    double most = 0.0, size = 0.0;
    for (; around; around &= around - 1) {
        int i = __builtin_ctzll(around);
        most += crossed->peaks[i];
        size += fabs(crossed->blob->parts[crossed->parts[i]].c[0]);
    }
    return !(most < crossed->blob->threshold - 1e-3 * size);
}

static void walk_borders(const Crossed *crossed, double from, HitSink *sink) {
    Border borders[2 * REMEMBERED];
    uint64_t around;
    uint32_t count = sort_borders(crossed, from, borders, &around);
    for (uint32_t k = 0; k < count;) {
        double to = borders[k].at;
        if (!(to < INFINITY) || crossed->origin + from > sink->t_max)
            return;
        if (around && may_reach(crossed, around)) {
            double sum[5] = {-crossed->blob->threshold, 0, 0, 0, 0};
            for (uint64_t rest = around; rest; rest &= rest - 1) {
                int i = __builtin_ctzll(rest);
                add_field(&crossed->blob->parts[crossed->parts[i]], &crossed->intervals[i], sum);
            }
            put_roots(crossed, sum, from, to, sink);
        }
        for (from = to; k < count && borders[k].at <= from; k++) {
            uint64_t bit = (uint64_t)1 << borders[k].interval;
            around = borders[k].leaves ? around & ~bit : around | bit;
        }
    }
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Blob *blob = data;
    // Depths are counted from the place nearest to the origin, which the parts are not far from.
    // Member by member: an initializer would clear the lists for every ray.
    Crossed crossed;
    crossed.blob = blob;
    crossed.ray = ray;
    crossed.origin = -vec_dot(ray->org, ray->dir);
    crossed.count = 0;
    crossed.all = false;
    double from = sink->near * sink->scale - crossed.origin;
    cross_parts(&crossed, from);
    if (crossed.all)
        walk_all(&crossed, from, sink);
    else
        walk_borders(&crossed, from, sink);
}

// The square of the distance; false: outside the part.
static bool distance2(const Part *part, Vec3 p, Vec3 *q, double *square) {
    Vec3 whole = part->moved ? transform_point(&part->to_part, p) : p;
    if ((part->kind == PART_BASE && whole.z > 0.0) ||
        (part->kind == PART_APEX && whole.z < part->length) ||
        (part->kind == PART_CYLINDER && (whole.z < 0.0 || whole.z > part->length)))
        return false;
    *q = to_part(part, p);
    *square = vec_dot(*q, *q);
    return *square <= part->radius2;
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const Blob *blob = data;
    Vec3 sum = {0, 0, 0}, q;
    double square;
    (void)hit;
    Near near;
    near_point(blob, p, &near);
    for (uint32_t i = 0; i < near.count; i++) {
        const Part *part = near_part(&near, i);
        if (!distance2(part, p, &q, &square))
            continue;
        Vec3 down = vec_scale(q, -2.0 * (part->c[1] + 2.0 * part->c[2] * square));
        if (part->moved) {
            const double(*m)[4] = part->to_part.m;
            down = vec3(m[0][0] * down.x + m[0][1] * down.y + m[0][2] * down.z,
                        m[1][0] * down.x + m[1][1] * down.y + m[1][2] * down.z,
                        m[2][0] * down.x + m[2][1] * down.y + m[2][2] * down.z);
        }
        sum = vec_add(sum, down);
    }
    return sum;
}

// Every component shows its own texture as far as its field makes up the sum here. Of more
// than SHAPE_MAX_TEXTURES the first count.
static uint32_t textures(const void *data, Vec3 p, const ShapeHit *hit, ShapeTexture *out) {
    const Blob *blob = data;
    uint32_t count = 0;
    double sum = 0.0, square;
    Vec3 q;
    (void)hit;
    Near near;
    near_point(blob, p, &near);
    for (uint32_t i = 0; i < near.count; i++) {
        const Part *part = near_part(&near, i);
        if (!distance2(part, p, &q, &square))
            continue;
        double weight = fabs(part->c[0] + square * (part->c[1] + square * part->c[2]));
        uint32_t texture = blob->components[part->component].texture, at = 0;
        while (at < count && out[at].texture != texture)
            at++;
        if (!(weight > 0.0) || at == SHAPE_MAX_TEXTURES)
            continue;
        if (at == count)
            out[count++] = (ShapeTexture){texture, 0.0f};
        out[at].weight += (float)weight;
        sum += weight;
    }
    for (uint32_t i = 0; i < count; i++)
        out[i].weight = (float)(out[i].weight / sum);
    return count;
}

static double field_at(const Blob *blob, Vec3 p) {
    double sum = 0.0, square;
    Vec3 q;
    Near near;
    near_point(blob, p, &near);
    for (uint32_t i = 0; i < near.count; i++) {
        const Part *part = near_part(&near, i);
        if (distance2(part, p, &q, &square))
            sum += part->c[0] + square * (part->c[1] + square * part->c[2]);
    }
    return sum;
}

// POV-Ray's slack of the threshold.
static const double INSIDE_SLACK = 1e-6;

static bool inside(const void *data, Vec3 p) {
    const Blob *blob = data;
    return field_at(blob, p) > blob->threshold - INSIDE_SLACK;
}

static const SolidOps OPS = {
    .near = 1e-2, .far = SHAPE_FARTHEST, .hits = hits, .normal = normal, .inside = inside};
static const SolidOps TEXTURED = {.near = 1e-2,
                                  .far = SHAPE_FARTHEST,
                                  .hits = hits,
                                  .normal = normal,
                                  .inside = inside,
                                  .textures = textures};

// ---- preparing ------------------------------------------------------------------------------

// From the component's own space to one with its axis along z, the base at the origin.
static Transform stand_up(Vec3 base, Vec3 axis) {
    Vec3 z = vec_normalize(axis);
    Vec3 side = fabs(z.x) < 0.5 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    Vec3 x = vec_normalize(vec_cross(side, z)), y = vec_cross(z, x);
    Transform t = transform_identity();
    const Vec3 columns[3] = {x, y, z};
    for (int j = 0; j < 3; j++) {
        t.m[0][j] = columns[j].x, t.m[1][j] = columns[j].y, t.m[2][j] = columns[j].z;
        t.m[3][j] = -vec_dot(base, columns[j]);
    }
    return t;
}

static void put_part(Blob *blob, const BlobComponent *component, uint32_t index, PartKind kind,
                     const Transform *inverse) {
    double r2 = component->radius * component->radius, s = component->strength;
    Part part = {
        .kind = kind, .radius2 = r2, .c = {s, -2.0 * s / r2, s / (r2 * r2)}, .component = index};
    if (kind == PART_SPHERE) {
        part.center = component->base;
        if (inverse) {
            part.moved = true;
            part.to_part = *inverse;
            for (int j = 0; j < 3; j++)
                part.to_part.m[3][j] -= vec_get(component->base, j);
        }
    } else {
        Vec3 axis = vec_sub(component->apex, component->base);
        Transform up = stand_up(component->base, axis);
        part.length = vec_length(axis);
        part.moved = true;
        part.to_part = inverse ? transform_compose(inverse, &up) : up;
    }
    blob->parts[blob->count++] = part;
}

static Box component_box(const BlobComponent *component) {
    double r = fabs(component->radius);
    Vec3 reach = vec3(r, r, r), end = component->cylinder ? component->apex : component->base;
    Box local = box_extend(box_empty(), vec_sub(component->base, reach));
    local = box_extend(local, vec_add(component->base, reach));
    local = box_extend(local, vec_sub(end, reach));
    local = box_extend(local, vec_add(end, reach));
    if (!component->has_transform)
        return local;
    Box out = box_empty();
    for (int i = 0; i < 8; i++)
        out = box_extend(
            out, transform_point(&component->transform, vec3(i & 1 ? local.high.x : local.low.x,
                                                             i & 2 ? local.high.y : local.low.y,
                                                             i & 4 ? local.high.z : local.low.z)));
    return out;
}

// From so many parts on a tree of their boxes pays.
enum { MANY = 16 };

static void make_tree(Blob *blob, Arena *arena) {
    Arena *scratch = arena_create();
    Box *boxes = ARENA_ARRAY(scratch, Box, blob->count);
    bool finite = true;
    for (uint32_t i = 0; i < blob->count; i++) {
        boxes[i] = component_box(&blob->components[blob->parts[i].component]);
        finite = finite && vec_is_finite(boxes[i].low) && vec_is_finite(boxes[i].high);
    }
    if (finite)
        blob->tree = bvh_build(boxes, blob->count, arena);
    arena_destroy(scratch);
}

SolidData blob_prepare(const BlobShape *shape, Arena *arena) {
    Blob *blob = ARENA_NEW(arena, Blob);
    blob->threshold = shape->threshold;
    blob->components = shape->components;
    bool textured = false;
    blob->parts = ARENA_ARRAY(arena, Part, 3 * (size_t)shape->count);
    Box box = box_empty();
    for (uint32_t i = 0; i < shape->count; i++) {
        const BlobComponent *component = &shape->components[i];
        Transform inverse;
        textured = textured || component->texture != NO_INDEX;
        if (component->radius == 0.0)
            continue;
        if (component->has_transform) {
            inverse = transform_identity();
            for (int r = 0; r < 4; r++)
                for (int c = 0; c < 3; c++) {
                    inverse.m[r][c] = component->transform.inv[r][c];
                    inverse.inv[r][c] = component->transform.m[r][c];
                }
        }
        const Transform *moved = component->has_transform ? &inverse : NULL;
        if (component->cylinder) {
            put_part(blob, component, i, PART_BASE, moved);
            put_part(blob, component, i, PART_CYLINDER, moved);
            put_part(blob, component, i, PART_APEX, moved);
        } else {
            put_part(blob, component, i, PART_SPHERE, moved);
        }
        // A part that only takes away shows no surface of its own.
        if (component->strength > 0.0)
            box = box_union(box, component_box(component));
    }
    // Below 0 the surface is where all fields have ended, or inside out.
    if (shape->threshold <= 0.0)
        for (uint32_t i = 0; i < shape->count; i++)
            box = box_union(box, component_box(&shape->components[i]));
    if (blob->count == 0 || !(box.low.x <= box.high.x))
        return (SolidData){0};
    if (blob->count > MANY)
        make_tree(blob, arena);
    return (SolidData){textured ? &TEXTURED : &OPS, blob, box};
}
