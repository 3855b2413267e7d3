// SPDX-License-Identifier: MIT
// Height fields: each cell of the grid is two triangles, cut along the diagonal x + z = 1. Cells in
// squares of BLOCK stand below a tree; inside one the ray goes from cell to cell.
#include "shape/bvh_walk.h"
#include "shape/solid.h"

enum { BLOCK = 8 };

typedef struct {
    const HeightMap *map;
    bool smooth;
    Vec3 low, high; // the box in which POV-Ray looks: its bottom is the water
    Bvh tree;
    int blocks; // along x
    short (*normals)[3];
} Field;

static double height(const Field *field, int x, int z) {
    return field->map->heights[(size_t)z * (size_t)field->map->width + (size_t)x];
}

typedef struct {
    const Field *field;
    const Ray *ray;
    HitSink *sink;
    double enter, leave; // the box
} Query;

// POV-Ray's slack at the edges of a triangle, in cells.
static const double EDGE = 1e-4;

// The plane of one of the cell's triangles, through p with the normal n.
static void try_plane(const Query *query, int x, int z, bool upper, Vec3 p, Vec3 n) {
    const Ray *ray = query->ray;
    double slope = vec_dot(n, ray->dir);
    if (!(fabs(slope) > SHAPE_EPSILON))
        return;
    double t = vec_dot(n, vec_sub(p, ray->org)) / slope;
    if (!(t >= query->enter && t <= query->leave))
        return;
    double s = ray->org.x + t * ray->dir.x - x, r = ray->org.z + t * ray->dir.z - z;
    bool hit = upper ? s <= 1.0 + EDGE && r <= 1.0 + EDGE && s + r >= 1.0 - EDGE
                     : s >= -EDGE && r >= -EDGE && s + r <= 1.0 + EDGE;
    if (hit)
        sink_put(query->sink, t, upper, n);
}

static void try_cell(const Query *query, int x, int z) {
    const Field *field = query->field;
    double y1 = height(field, x, z), y2 = height(field, x + 1, z);
    double y3 = height(field, x, z + 1), y4 = height(field, x + 1, z + 1);
    try_plane(query, x, z, false, vec3(x, y1, z), vec3(y1 - y2, 1.0, y1 - y3));
    try_plane(query, x, z, true, vec3(x + 1, y4, z + 1), vec3(y3 - y4, 1.0, y2 - y4));
}

// Depths between which the ray is between low and high along one axis.
static bool slab(double org, double dir, double low, double high, double *enter, double *leave) {
    if (dir == 0.0)
        return org >= low && org <= high;
    double a = (low - org) / dir, b = (high - org) / dir;
    *enter = fmax(*enter, fmin(a, b));
    *leave = fmin(*leave, fmax(a, b));
    return *enter <= *leave;
}

// The cells of a row that the ray is over while it is over the row, with those that it touches.
static void try_row(const Query *query, int z, int from, int end) {
    const Ray *ray = query->ray;
    double enter = query->enter, leave = query->leave;
    if (!slab(ray->org.z, ray->dir.z, z - EDGE, z + 1 + EDGE, &enter, &leave))
        return;
    double a = ray->org.x + enter * ray->dir.x, b = ray->org.x + leave * ray->dir.x;
    double first = floor(fmin(a, b) - EDGE), last = floor(fmax(a, b) + EDGE);
    int x0 = first > from ? (int)fmin(first, end) : from;
    int x1 = last < end - 1 ? (int)fmax(last, from - 1) : end - 1;
    for (int x = x0; x <= x1; x++)
        try_cell(query, x, z);
}

static int least(int a, int b) { return a < b ? a : b; }

static double try_block(void *context, uint32_t place) {
    Query *query = context;
    const Field *field = query->field;
    int block = (int)field->tree.items[place];
    int x = block % field->blocks * BLOCK, z = block / field->blocks * BLOCK;
    int x_end = least(x + BLOCK, field->map->width - 1);
    int z_end = least(z + BLOCK, field->map->depth - 1);
    for (int row = z; row < z_end; row++)
        try_row(query, row, x, x_end);
    return query->sink->t_max;
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Field *field = data;
    Query query = {field, ray, sink, 0.0, INFINITY};
    for (int axis = 0; axis < 3; axis++)
        if (!slab(vec_get(ray->org, axis), vec_get(ray->dir, axis), vec_get(field->low, axis),
                  vec_get(field->high, axis), &query.enter, &query.leave))
            return;
    query.enter = fmax(query.enter, 1e-6 * sink->scale);
    bvh_walk(&field->tree, ray, fmax(sink->t_min, 0.0), sink->t_max, try_block, &query);
}

static int clamp(double v, int high) { return v <= 0.0 ? 0 : v >= high ? high : (int)v; }

static Vec3 smooth_normal(const Field *field, const Transform *transform, Vec3 p) {
    int width = field->map->width;
    int x = clamp(p.x, width - 2), z = clamp(p.z, field->map->depth - 2);
    double s = p.x - x, r = p.z - z;
    const double w[4] = {(1.0 - s) * (1.0 - r), s * (1.0 - r), (1.0 - s) * r, s * r};
    Vec3 sum = {0, 0, 0};
    for (int i = 0; i < 4; i++) {
        const short *n = field->normals[(size_t)(z + i / 2) * (size_t)width + (size_t)(x + i % 2)];
        // Each corner's normal is taken to the world before they are mixed.
        sum = vec_madd(sum, w[i],
                       shape_world_normal(transform, vec3(n[0], n[1], n[2]), vec3(0, 1, 0)));
    }
    return shape_world_normal(NULL, sum, vec3(0, 1, 0));
}

static Vec3 world_normal(const void *data, const Transform *transform, Vec3 p,
                         const ShapeHit *hit) {
    const Field *field = data;
    if (field->smooth)
        return smooth_normal(field, transform, p);
    return shape_world_normal(transform, hit->keep, vec3(0, 1, 0));
}

static bool inside(const void *data, Vec3 p) {
    const Field *field = data;
    if (p.x < 0.0 || p.x >= field->high.x || p.z < 0.0 || p.z >= field->high.z ||
        p.y >= field->high.y)
        return false;
    double water = field->low.y;
    if (p.y < water)
        return true;
    int x = (int)p.x, z = (int)p.z;
    double s = p.x - x, r = p.z - z;
    double y2 = fmax(height(field, x + 1, z), water), y3 = fmax(height(field, x, z + 1), water);
    if (s + r < 1.0) {
        double y1 = fmax(height(field, x, z), water);
        return p.y < y1 + s * (y2 - y1) + r * (y3 - y1);
    }
    double y4 = fmax(height(field, x + 1, z + 1), water);
    return p.y < y4 + (1.0 - s) * (y3 - y4) + (1.0 - r) * (y2 - y4);
}

// Below the water everything is inside.
static const SolidOps OPS = {.near = 0.0,
                             .far = INFINITY,
                             .hits = hits,
                             .world_normal = world_normal,
                             .inside = inside,
                             .deep = true};

// ---- preparing ------------------------------------------------------------------------------

// Adds the normal of the triangle between a grid point and its neighbours at (x1, z1), (x2, z2).
static void add_normal(const Field *field, int x, int z, int x1, int z1, int x2, int z2,
                       Vec3 *sum) {
    int width = field->map->width, depth = field->map->depth;
    if (x1 < 0 || z1 < 0 || x2 < 0 || z2 < 0 || x1 >= width || x2 >= width || z1 >= depth ||
        z2 >= depth)
        return;
    double y = height(field, x, z);
    Vec3 a = vec3(x1 - x, height(field, x1, z1) - y, z1 - z);
    Vec3 b = vec3(x2 - x, height(field, x2, z2) - y, z2 - z);
    Vec3 n = vec_normalize(vec_cross(b, a));
    *sum = vec_add(*sum, n.y < 0.0 ? vec_neg(n) : n);
}

// Kept as POV-Ray keeps them: three whole numbers of 16 bits.
static void make_normals(Field *field, Arena *arena) {
    int width = field->map->width, depth = field->map->depth;
    field->normals = arena_array(arena, (size_t)width * (size_t)depth, sizeof *field->normals);
    for (int z = 0; z < depth; z++)
        for (int x = 0; x < width; x++) {
            Vec3 sum = {0, 0, 0};
            add_normal(field, x, z, x + 1, z, x, z + 1, &sum);
            add_normal(field, x, z, x, z + 1, x - 1, z, &sum);
            add_normal(field, x, z, x - 1, z, x, z - 1, &sum);
            add_normal(field, x, z, x, z - 1, x + 1, z, &sum);
            sum = vec_normalize(sum);
            short *n = field->normals[(size_t)z * (size_t)width + (size_t)x];
            n[0] = (short)(32767 * sum.x);
            n[1] = (short)(32767 * sum.y);
            n[2] = (short)(32767 * sum.z);
        }
}

static Box block_box(const Field *field, int block) {
    int x = block % field->blocks * BLOCK, z = block / field->blocks * BLOCK;
    int x_end = least(x + BLOCK, field->map->width - 1);
    int z_end = least(z + BLOCK, field->map->depth - 1);
    Box box = box_empty();
    for (int j = z; j <= z_end; j++)
        for (int i = x; i <= x_end; i++)
            box = box_extend(box, vec3(i, height(field, i, j), j));
    Vec3 slack = vec3(EDGE, 0, EDGE);
    return (Box){vec_sub(box.low, slack), vec_add(box.high, slack)};
}

SolidData height_field_prepare(const HeightFieldShape *shape, const HeightMap *map, Arena *arena) {
    Field *field = ARENA_NEW(arena, Field);
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < map->count; i++) {
        low = fmin(low, map->heights[i]);
        high = fmax(high, map->heights[i]);
    }
    // POV-Ray's box is a thousandth of a step larger.
    *field = (Field){.map = map,
                     .smooth = shape->smooth,
                     .low = vec3(0, fmax(low, shape->water_level) - 1e-3, 0),
                     .high = vec3(map->width - 1, high + 1e-3, map->depth - 1),
                     .blocks = (map->width - 2) / BLOCK + 1};
    if (field->smooth)
        make_normals(field, arena);
    Arena *scratch = arena_create();
    int count = field->blocks * ((map->depth - 2) / BLOCK + 1);
    Box *boxes = ARENA_ARRAY(scratch, Box, (size_t)count);
    for (int i = 0; i < count; i++)
        boxes[i] = block_box(field, i);
    field->tree = bvh_build(boxes, (uint32_t)count, arena);
    arena_destroy(scratch);
    if (!(field->low.y <= field->high.y))
        return (SolidData){0};
    return (SolidData){&OPS, field, {field->low, field->high}};
}
