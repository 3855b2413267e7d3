// SPDX-License-Identifier: MIT
// Meshes: facets below a tree of their own, which all objects with this mesh share.
#include "shape/bvh_walk.h"
#include "shape/facet.h"
#include "shape/solid.h"

typedef struct {
    Facet facet;
    const MeshFace *face;
    bool smooth;
} Triangle;

typedef struct {
    const Mesh *mesh;
    Triangle *triangles; // in the tree's order
    Bvh tree;
    Vec3 inside_dir;
    bool solid;
} MeshData;

static Vec3 row_of(const double *rows, uint32_t index) {
    const double *p = rows + 3 * (size_t)index;
    return vec3(p[0], p[1], p[2]);
}

static Vec3 to_single(Vec3 v) { return vec3((float)v.x, (float)v.y, (float)v.z); }

static Vec3 point_of(const double *rows, uint32_t index) { return to_single(row_of(rows, index)); }

typedef struct {
    const MeshData *data;
    const Ray *ray;
    HitSink *sink;
    uint32_t count; // of hits; sink NULL: only they are counted
} Query;

static double try_triangle(void *context, uint32_t place) {
    Query *query = context;
    double t;
    if (facet_hit(&query->data->triangles[place].facet, query->ray, &t)) {
        query->count++;
        if (query->sink)
            sink_put(query->sink, t, (int)place, vec3(0, 0, 0));
    }
    return query->sink ? query->sink->t_max : INFINITY;
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const MeshData *mesh = data;
    Query query = {mesh, ray, sink, 0};
    bvh_walk(&mesh->tree, ray, fmax(sink->t_min, 0.0), sink->t_max, try_triangle, &query);
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const MeshData *mesh = data;
    const Triangle *triangle = &mesh->triangles[hit->part];
    double w[3];
    if (!triangle->smooth)
        return triangle->facet.normal;
    facet_weights(&triangle->facet, p, w);
    Vec3 n = {0, 0, 0};
    for (int i = 0; i < 3; i++)
        n = vec_madd(n, w[i], point_of(mesh->mesh->normals, triangle->face->n[i]));
    return n;
}

static Vec2 uv(const void *data, Vec3 p, const ShapeHit *hit) {
    const MeshData *mesh = data;
    const Triangle *triangle = &mesh->triangles[hit->part];
    double w[3];
    Vec2 sum = {0, 0};
    if (triangle->face->uv[0] == NO_INDEX)
        return sum;
    facet_weights(&triangle->facet, p, w);
    for (int i = 0; i < 3; i++) {
        const double *at = mesh->mesh->uv + 2 * (size_t)triangle->face->uv[i];
        sum.u += w[i] * at[0], sum.v += w[i] * at[1];
    }
    return sum;
}

static bool inside(const void *data, Vec3 p) {
    const MeshData *mesh = data;
    const Ray ray = {p, mesh->inside_dir};
    Query query = {mesh, &ray, NULL, 0};
    bvh_walk(&mesh->tree, &ray, 0.0, INFINITY, try_triangle, &query);
    return query.count & 1;
}

static uint32_t textures(const void *data, Vec3 p, const ShapeHit *hit, ShapeTexture *out) {
    const MeshData *mesh = data;
    const Triangle *triangle = &mesh->triangles[hit->part];
    const uint32_t *own = triangle->face->texture;
    double w[3];
    if (own[0] == NO_INDEX)
        return 0;
    if (own[1] == NO_INDEX || own[2] == NO_INDEX) {
        out[0] = (ShapeTexture){own[0], 1.0f};
        return 1;
    }
    facet_weights(&triangle->facet, p, w);
    for (int i = 0; i < 3; i++)
        out[i] = (ShapeTexture){own[i], (float)w[i]};
    return 3;
}

static const SolidOps SURFACE = {
    .near = 0.0, .far = INFINITY, .hits = hits, .normal = normal, .uv = uv, .textures = textures};
static const SolidOps SOLID = {.near = 0.0,
                               .far = INFINITY,
                               .hits = hits,
                               .normal = normal,
                               .inside = inside,
                               .uv = uv,
                               .textures = textures};

// POV-Ray takes a face with three (nearly) equal normals for a flat one.
static bool is_smooth(const Mesh *mesh, const MeshFace *face) {
    if (face->n[0] == NO_INDEX)
        return false;
    Vec3 n = point_of(mesh->normals, face->n[0]);
    Vec3 a = vec_sub(n, point_of(mesh->normals, face->n[1]));
    Vec3 b = vec_sub(n, point_of(mesh->normals, face->n[2]));
    return vec_dot(a, a) > SHAPE_EPSILON || vec_dot(b, b) > SHAPE_EPSILON;
}

// POV-Ray takes the plane from the points as they were written, and rounds it and them apart: far
// from the origin the plane of a small triangle is that of its rounded points only to a few digits.
static bool make_triangle(const Mesh *mesh, const MeshFace *face, Triangle *out) {
    Vec3 p[3];
    for (int i = 0; i < 3; i++)
        p[i] = row_of(mesh->points, face->p[i]);
    Vec3 n = vec_cross(vec_sub(p[2], p[0]), vec_sub(p[1], p[0]));
    double length = vec_length(n);
    if (!(length > 0.0) || !isfinite(length) || !isfinite(1.0 / length))
        return false;
    n = vec_scale(n, 1.0 / length);
    double distance = (float)vec_dot(n, p[0]);
    for (int i = 0; i < 3; i++)
        p[i] = to_single(p[i]);
    *out = (Triangle){.face = face, .smooth = is_smooth(mesh, face)};
    if (!facet_make(&out->facet, p, to_single(n)))
        return false;
    out->facet.distance = distance;
    return true;
}

SolidData mesh_prepare(const Mesh *mesh, Arena *arena) {
    MeshData *data = ARENA_NEW(arena, MeshData);
    Arena *scratch = arena_create();
    Triangle *all = ARENA_ARRAY(scratch, Triangle, mesh->face_count);
    Box *boxes = ARENA_ARRAY(scratch, Box, mesh->face_count), box = box_empty();
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->face_count; i++) {
        if (!make_triangle(mesh, &mesh->faces[i], &all[count]))
            continue;
        const Vec3 *p = all[count].facet.p;
        boxes[count] = box_extend(box_extend(box_extend(box_empty(), p[0]), p[1]), p[2]);
        box = box_union(box, boxes[count++]);
    }
    data->mesh = mesh;
    data->tree = bvh_build(boxes, count, arena);
    data->triangles = ARENA_ARRAY(arena, Triangle, count);
    for (uint32_t i = 0; i < count; i++)
        data->triangles[i] = all[data->tree.items[i]];
    if (mesh->has_inside)
        data->inside_dir = vec_normalize(mesh->inside_vector);
    arena_destroy(scratch);
    if (count == 0)
        return (SolidData){0};
    return (SolidData){mesh->has_inside ? &SOLID : &SURFACE, data, box};
}
