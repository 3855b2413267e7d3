// SPDX-License-Identifier: MIT
// From the world to the local space of a solid and back.
#include "shape/solid.h"

#include "base/hash.h"

#include <string.h>

void sink_put(HitSink *sink, double t_local, int part, Vec3 keep) {
    ShapeHit hit = {t_local / sink->scale, part, keep};
    if (!(hit.t > sink->near && hit.t < sink->far))
        return;
    double limit = sink->visit(sink->context, &hit) * sink->scale;
    if (limit < sink->t_max)
        sink->t_max = limit;
}

// ---- what copies share ----------------------------------------------------------------------

// Prepared data by what it was prepared from: the bytes of the object's shape, whose lists copies
// have in common.
typedef struct Known {
    struct Known *next;
    const Object *from;
    uint64_t hash;
    SolidData data;
} Known;

enum { BUCKETS = 1024 };

struct ShapeShared {
    Arena *arena;
    FunctionPool functions;
    Known *buckets[BUCKETS];
    Known *parametrics;
};

// Before the textures are there functions get nothing from pigments.
static void no_color(const void *world, uint32_t pigment, Vec3 p, double color[FUNCTION_WIDTH]) {
    (void)world, (void)pigment, (void)p;
    for (int i = 0; i < FUNCTION_WIDTH; i++)
        color[i] = 0.0;
}

static double no_value(const void *world, uint32_t pigment, Vec3 p) {
    (void)world, (void)pigment, (void)p;
    return 0.0;
}

ShapeShared *shape_shared_create(const Scene *scene, Arena *arena) {
    static const FunctionHooks hooks = {no_color, no_value};
    ShapeShared *shared = ARENA_NEW(arena, ShapeShared);
    shared->arena = arena;
    shared->functions = (FunctionPool){.functions = scene->functions,
                                       .noise_generator = scene->settings.noise_generator,
                                       .hooks = &hooks};
    return shared;
}

void shape_shared_functions(ShapeShared *shared, const FunctionPool *functions) {
    shared->functions = *functions;
    for (const Known *known = shared->parametrics; known; known = known->next)
        parametric_complete(&known->data, shared->arena);
    shared->parametrics = NULL;
}

// Is more made of it than its own few numbers?
static bool is_shared(ObjectType type) {
    return type != OBJECT_QUADRIC && type != OBJECT_SUPERELLIPSOID && type != OBJECT_OVUS &&
           type != OBJECT_SMOOTH_TRIANGLE;
}

// The bytes that decide; the textures of a mesh do not.
static size_t identity(const Object *object, const unsigned char **bytes) {
    bool mesh = object->type == OBJECT_MESH;
    *bytes = mesh ? (const unsigned char *)&object->shape.mesh.mesh
                  : (const unsigned char *)&object->shape;
    return mesh ? sizeof object->shape.mesh.mesh : sizeof object->shape;
}

static uint64_t hash_of(const Object *object) {
    const unsigned char *bytes;
    size_t size = identity(object, &bytes);
    return hash_bytes(HASH_START, bytes, size);
}

static bool same_shape(const Object *a, const Object *b) {
    const unsigned char *bytes, *others;
    if (a->type != b->type)
        return false;
    size_t size = identity(a, &bytes);
    identity(b, &others);
    return memcmp(bytes, others, size) == 0;
}

static SolidData prepare(const Scene *scene, const Object *object, ShapeShared *shared,
                         Arena *arena) {
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
        return isosurface_prepare(&object->shape.isosurface, &shared->functions, arena);
    case OBJECT_PARAMETRIC:
        return parametric_prepare(&object->shape.parametric, &shared->functions, arena);
    default:
        return (SolidData){0};
    }
}

static const Known *find(const ShapeShared *shared, const Object *object, uint64_t hash) {
    for (const Known *known = shared->buckets[hash % BUCKETS]; known; known = known->next)
        if (known->hash == hash && same_shape(known->from, object))
            return known;
    return NULL;
}

static void add(Known **list, const Object *object, uint64_t hash, SolidData data, Arena *arena) {
    Known *known = ARENA_NEW(arena, Known);
    *known = (Known){*list, object, hash, data};
    *list = known;
}

void solid_prepare(Shape *shape, const Scene *scene, const Object *object, ShapeShared *shared,
                   Arena *arena) {
    bool shares = shared && is_shared(object->type);
    uint64_t hash = shares ? hash_of(object) : 0;
    const Known *known = shares ? find(shared, object, hash) : NULL;
    shape->as.solid = known ? known->data : prepare(scene, object, shared, arena);
    if (shares && !known) {
        add(&shared->buckets[hash % BUCKETS], object, hash, shape->as.solid, arena);
        if (object->type == OBJECT_PARAMETRIC)
            add(&shared->parametrics, object, hash, shape->as.solid, arena);
    }
    shape->kind = shape->as.solid.ops ? SHAPE_SOLID : SHAPE_NONE;
    if (object->type == OBJECT_MESH)
        shape->textures = object->shape.mesh.textures;
}

// ---- the calls ------------------------------------------------------------------------------

void solid_visit(const Shape *shape, const Ray *ray, double unit, double t_min, double t_max,
                 ShapeVisit visit, void *context) {
    const SolidData *solid = &shape->as.solid;
    LocalRay local;
    if (!shape_local_ray(shape->transform, ray, &local))
        return;
    HitSink sink = {.scale = local.scale,
                    .t_min = t_min * local.scale,
                    .t_max = t_max * local.scale,
                    .near = solid->ops->near * unit,
                    .far = solid->ops->far * unit,
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
    const Transform *t = shape->transform;
    if (!t || !(b->low.x <= b->high.x))
        return *b;
    double low[3], high[3];
    for (int to = 0; to < 3; to++) {
        low[to] = high[to] = t->m[3][to];
        // An infinite side counts only where the axis has a part of it.
        for (int from = 0; from < 3; from++) {
            double k = t->m[from][to];
            if (k == 0.0)
                continue;
            double x = k * vec_get(b->low, from), y = k * vec_get(b->high, from);
            low[to] += fmin(x, y), high[to] += fmax(x, y);
        }
    }
    return (Box){vec3(low[0], low[1], low[2]), vec3(high[0], high[1], high[2])};
}

double solid_angle(Vec3 p) {
    double r2 = p.x * p.x + p.z * p.z;
    if (!(r2 > SHAPE_EPSILON))
        return 0.0;
    double angle = acos(fmax(-1.0, fmin(1.0, p.x / sqrt(r2))));
    return (p.z < 0.0 ? 2.0 * M_PI - angle : angle) / (2.0 * M_PI);
}
