// SPDX-License-Identifier: MIT
// From the world to the local space of a solid and back.
#include "shape/solid.h"

void sink_put(HitSink *sink, double t_local, int part, Vec3 keep) {
    ShapeHit hit = {t_local / sink->scale, part, keep};
    if (!(hit.t > sink->near && hit.t < sink->far))
        return;
    double limit = sink->visit(sink->context, &hit) * sink->scale;
    if (limit < sink->t_max)
        sink->t_max = limit;
}

// ---- what copies share ----------------------------------------------------------------------

// Prepared data by what it was prepared from: copies of an object have the same lists, which differ
// for all others.
typedef struct Known {
    struct Known *next;
    const void *from;
    ObjectType type;
    SolidData data;
} Known;

enum { BUCKETS = 1024 };

struct ShapeShared {
    Known *buckets[BUCKETS];
};

ShapeShared *shape_shared_create(Arena *arena) { return ARENA_NEW(arena, ShapeShared); }

// NULL: nothing worth sharing.
static const void *identity(const Scene *scene, const Object *object) {
    switch (object->type) {
    case OBJECT_POLY:
        return object->shape.poly.coefficients;
    case OBJECT_BLOB:
        return object->shape.blob.components;
    case OBJECT_MESH:
        return &scene->meshes[object->shape.mesh.mesh];
    case OBJECT_POLYGON:
        return object->shape.polygon.points;
    case OBJECT_TEXT:
        return object->shape.text.arcs;
    case OBJECT_SPHERE_SWEEP:
        return object->shape.sphere_sweep.spheres;
    default:
        return NULL;
    }
}

static SolidData prepare(const Scene *scene, const Object *object, Arena *arena) {
    switch (object->type) {
    case OBJECT_QUADRIC:
        return quadric_prepare(&object->shape.quadric, arena);
    case OBJECT_POLY:
        return poly_prepare(&object->shape.poly, arena);
    case OBJECT_SUPERELLIPSOID:
        return superellipsoid_prepare(&object->shape.superellipsoid, arena);
    case OBJECT_LATHE:
        return lathe_prepare(&object->shape.lathe, arena);
    case OBJECT_SOR:
        return sor_prepare(&object->shape.sor, arena);
    case OBJECT_PRISM:
        return prism_prepare(&object->shape.prism, arena);
    case OBJECT_SPHERE_SWEEP:
        return sphere_sweep_prepare(&object->shape.sphere_sweep, arena);
    case OBJECT_BLOB:
        return blob_prepare(&object->shape.blob, arena);
    case OBJECT_OVUS:
        return ovus_prepare(&object->shape.ovus, arena);
    case OBJECT_SMOOTH_TRIANGLE:
        return smooth_triangle_prepare(&object->shape.smooth_triangle, arena);
    case OBJECT_POLYGON:
        return polygon_prepare(&object->shape.polygon, arena);
    case OBJECT_MESH:
        return mesh_prepare(&scene->meshes[object->shape.mesh.mesh], arena);
    case OBJECT_HEIGHT_FIELD:
        return height_field_prepare(&object->shape.height_field,
                                    &scene->height_maps[object->shape.height_field.map], arena);
    case OBJECT_TEXT:
        return text_prepare(&object->shape.text, arena);
    case OBJECT_ISOSURFACE:
        return isosurface_prepare(scene, &object->shape.isosurface, arena);
    default:
        return (SolidData){0};
    }
}

void solid_prepare(Shape *shape, const Scene *scene, const Object *object, ShapeShared *shared,
                   Arena *arena) {
    const void *from = shared ? identity(scene, object) : NULL;
    Known **bucket = from ? &shared->buckets[(uintptr_t)from / 64 % BUCKETS] : NULL;
    for (const Known *known = bucket ? *bucket : NULL; known; known = known->next)
        if (known->from == from && known->type == object->type)
            shape->as.solid = known->data;
    if (!shape->as.solid.ops) {
        shape->as.solid = prepare(scene, object, arena);
        if (bucket) {
            Known *known = ARENA_NEW(arena, Known);
            *known = (Known){*bucket, from, object->type, shape->as.solid};
            *bucket = known;
        }
    }
    shape->kind = shape->as.solid.ops ? SHAPE_SOLID : SHAPE_NONE;
    if (object->type == OBJECT_MESH)
        shape->textures = object->shape.mesh.textures;
}

// ---- the calls ------------------------------------------------------------------------------

void solid_visit(const Shape *shape, const Ray *ray, double t_min, double t_max, ShapeVisit visit,
                 void *context) {
    const SolidData *solid = &shape->as.solid;
    LocalRay local;
    if (!shape_local_ray(shape->transform, ray, &local))
        return;
    HitSink sink = {.scale = local.scale,
                    .t_min = t_min * local.scale,
                    .t_max = t_max * local.scale,
                    .near = solid->ops->near,
                    .far = solid->ops->far,
                    .visit = visit,
                    .context = context};
    solid->ops->hits(solid->data, &local.ray, &sink);
}

Vec3 solid_normal(const Shape *shape, Vec3 p, const ShapeHit *hit) {
    const SolidData *solid = &shape->as.solid;
    Vec3 local = shape_local_point(shape->transform, p);
    if (solid->ops->world_normal)
        return solid->ops->world_normal(solid->data, shape->transform, local, hit);
    return shape_world_normal(shape->transform, solid->ops->normal(solid->data, local, hit),
                              vec3(1, 0, 0));
}

Vec2 solid_uv(const Shape *shape, Vec3 p, const ShapeHit *hit) {
    const SolidData *solid = &shape->as.solid;
    if (!solid->ops->uv)
        return (Vec2){p.x, p.y};
    return solid->ops->uv(solid->data, shape_local_point(shape->transform, p), hit);
}

uint32_t solid_textures(const Shape *shape, Vec3 p, const ShapeHit *hit,
                        ShapeTexture out[SHAPE_MAX_TEXTURES]) {
    const SolidData *solid = &shape->as.solid;
    if (!solid->ops->textures)
        return 0;
    uint32_t count =
        solid->ops->textures(solid->data, shape_local_point(shape->transform, p), hit, out);
    for (uint32_t i = 0; i < count && shape->textures; i++)
        out[i].texture = shape->textures[out[i].texture];
    return count;
}

bool solid_inside(const Shape *shape, Vec3 p) {
    const SolidData *solid = &shape->as.solid;
    if (!solid->ops->inside)
        return false;
    return solid->ops->inside(solid->data, shape_local_point(shape->transform, p)) !=
           shape->inverse;
}

Box solid_bounds(const Shape *shape) {
    const Box *b = &shape->as.solid.box;
    if (!isfinite(b->low.x) || !isfinite(b->high.x) || !shape->transform)
        return *b;
    Box out = box_empty();
    for (int i = 0; i < 8; i++)
        out = box_extend(out,
                         shape_world_point(shape->transform, vec3(i & 1 ? b->high.x : b->low.x,
                                                                  i & 2 ? b->high.y : b->low.y,
                                                                  i & 4 ? b->high.z : b->low.z)));
    return out;
}

double solid_angle(Vec3 p) {
    double r2 = p.x * p.x + p.z * p.z;
    if (!(r2 > SHAPE_EPSILON))
        return 0.0;
    double angle = acos(fmax(-1.0, fmin(1.0, p.x / sqrt(r2))));
    return (p.z < 0.0 ? 2.0 * M_PI - angle : angle) / (2.0 * M_PI);
}
