// SPDX-License-Identifier: MIT
// Inside the room: primitives behind a table of functions, all in a local space of their own, with
// any number of hits. One file each; solid.c takes rays and points there and results back.
#ifndef SHAPE_SOLID_H
#define SHAPE_SOLID_H

#include "function/function.h"
#include "shape/shape.h"

// Where a primitive puts its hits. Depths are those of the local ray, scale times the world's.
typedef struct {
    double scale;
    double t_min, t_max; // of interest
    double near, far;    // what counts as a hit for POV-Ray, in the world: near < t < far
    ShapeVisit visit;
    void *context;
} HitSink;

// Takes a hit if it counts; narrows t_max. NaN never counts.
void sink_put(HitSink *sink, double t_local, int part, Vec3 keep);

struct SolidOps {
    double near, far; // for the sink
    // ray->dir is of unit length.
    void (*hits)(const void *data, const Ray *ray, HitSink *sink);
    // Not of unit length; points out of the inside.
    Vec3 (*normal)(const void *data, Vec3 p, const ShapeHit *hit);
    bool (*inside)(const void *data, Vec3 p);                  // NULL: no point ever is
    Vec2 (*uv)(const void *data, Vec3 p, const ShapeHit *hit); // NULL: the world's x and y
    bool deep;         // points outside of the box may be inside
    bool keeps_normal; // also under `inverse`, as POV-Ray has it
    // NULL: it has none of its own.
    uint32_t (*textures)(const void *data, Vec3 p, const ShapeHit *hit, ShapeTexture *out);
    // Instead of normal: unit, in the world. transform may be NULL.
    Vec3 (*world_normal)(const void *data, const Transform *transform, Vec3 p, const ShapeHit *hit);
};

void solid_prepare(Shape *shape, const Scene *scene, const Object *object, ShapeShared *shared,
                   Arena *arena);
void solid_visit(const Shape *shape, const Ray *ray, double unit, double t_min, double t_max,
                 ShapeVisit visit, void *context);
Vec3 solid_normal(const Shape *shape, Vec3 p, const ShapeHit *hit);
Vec2 solid_uv(const Shape *shape, Vec3 p, const ShapeHit *hit);
bool solid_inside(const Shape *shape, Vec3 p);
Box solid_bounds(const Shape *shape);

// Each returns what it made in arena; an infinite box where the surface has none.
#define SOLID_INFINITE ((Box){{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}})
SolidData quadric_prepare(const QuadricShape *quadric, Arena *arena);
const QuadricShape *solid_quadric(const SolidData *solid); // NULL: it is another primitive
SolidData poly_prepare(const PolyShape *poly, Arena *arena);
SolidData superellipsoid_prepare(const SuperellipsoidShape *shape, Arena *arena);
SolidData lathe_prepare(const LatheShape *lathe, Arena *arena);
SolidData sor_prepare(const SorShape *sor, Arena *arena);
SolidData prism_prepare(const PrismShape *prism, Arena *arena);
SolidData sphere_sweep_prepare(const SphereSweepShape *sweep, Arena *arena);
SolidData blob_prepare(const BlobShape *blob, Arena *arena);
SolidData ovus_prepare(const OvusShape *ovus, Arena *arena);
SolidData smooth_triangle_prepare(const SmoothTriangleShape *triangle, Arena *arena);
SolidData polygon_prepare(const PolygonShape *polygon, Arena *arena);
SolidData mesh_prepare(const Mesh *mesh, Arena *arena);
SolidData height_field_prepare(const HeightFieldShape *field, const HeightMap *map, Arena *arena);
// These two keep the pool, which is filled in later.
SolidData isosurface_prepare(const IsosurfaceShape *shape, const FunctionPool *pool, Arena *arena);
SolidData parametric_prepare(const ParametricShape *shape, const FunctionPool *pool, Arena *arena);
// When the pool is there: what is worked out once of the functions.
void parametric_complete(const SolidData *solid, Arena *arena);
SolidData text_prepare(const TextShape *text, Arena *arena);

// Angle of (x, z) about the y axis, 0..1 from +x towards +z: what lathe and sor have for u.
double solid_angle(Vec3 p);

#endif
