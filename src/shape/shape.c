// SPDX-License-Identifier: MIT
// From an Object to a Shape, and the way from the common calls to each primitive.
#include "shape/shape.h"

#include "shape/solid.h"

#include <assert.h>

Shape shape_prepare(const Scene *scene, const Object *object, ShapeShared *shared, Arena *arena) {
    Shape shape = {.kind = SHAPE_NONE, .inverse = object->inverse};
    if (object->has_transform)
        shape.transform = &object->transform;
    switch (object->type) {
    case OBJECT_PLANE:
        // A plane turns round by negating what defines it, not its normal at the hit.
        shape.kind = SHAPE_PLANE;
        shape.as.plane = object->shape.plane;
        if (object->inverse) {
            shape.as.plane.normal = vec_neg(shape.as.plane.normal);
            shape.as.plane.distance = -shape.as.plane.distance;
        }
        shape.inverse = false;
        shape.transform = NULL;
        break;
    case OBJECT_SPHERE:
        sphere_prepare(&shape, &object->shape.sphere);
        break;
    case OBJECT_BOX:
        box_prepare(&shape, &object->shape.box);
        break;
    case OBJECT_CYLINDER:
    case OBJECT_CONE:
        cone_prepare(&shape, &object->shape.cone, arena);
        break;
    case OBJECT_TORUS:
        torus_prepare(&shape, &object->shape.torus);
        break;
    case OBJECT_DISC:
        disc_prepare(&shape, &object->shape.disc);
        break;
    case OBJECT_TRIANGLE:
        // Has no inside to turn out, and POV-Ray leaves its normal alone.
        shape.inverse = false;
        shape.transform = NULL;
        triangle_prepare(&shape, &object->shape.triangle);
        break;
    case OBJECT_UNION:
    case OBJECT_MERGE:
    case OBJECT_INTERSECTION:
    case OBJECT_PATCH:
    case OBJECT_TYPE_COUNT:
        break;
    default:
        solid_prepare(&shape, scene, object, shared, arena);
        break;
    }
    return shape;
}

int shape_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]) {
    switch (shape->kind) {
    case SHAPE_NONE:
        return 0;
    case SHAPE_PLANE:
        return plane_hits(shape, ray, hits);
    case SHAPE_SPHERE:
        return sphere_hits(shape, ray, hits);
    case SHAPE_BOX:
        return box_hits(shape, ray, hits);
    case SHAPE_CYLINDER:
    case SHAPE_CONE:
        return cone_hits(shape, ray, hits);
    case SHAPE_TORUS:
        return torus_hits(shape, ray, hits);
    case SHAPE_DISC:
        return disc_hits(shape, ray, hits);
    case SHAPE_TRIANGLE:
        return triangle_hits(shape, ray, hits);
    case SHAPE_SOLID:
        assert(!"a solid has any number of hits");
        break;
    }
    return 0;
}

void shape_visit_in(const Shape *shape, const Ray *ray, double unit, double t_min, double t_max,
                    ShapeVisit visit, void *context) {
    if (shape->kind == SHAPE_SOLID) {
        solid_visit(shape, ray, unit, t_min, t_max, visit, context);
        return;
    }
    ShapeHit hits[SHAPE_MAX_HITS];
    int count = shape_hits(shape, ray, hits);
    for (int i = 0; i < count; i++)
        visit(context, &hits[i]);
}

static Vec3 normal_of(const Shape *shape, Vec3 p, const ShapeHit *hit) {
    switch (shape->kind) {
    case SHAPE_NONE:
        break;
    case SHAPE_PLANE:
        return shape->as.plane.normal;
    case SHAPE_SPHERE:
        return sphere_normal(shape, p);
    case SHAPE_BOX:
        return box_normal(shape, hit->part);
    case SHAPE_CYLINDER:
    case SHAPE_CONE:
        return cone_normal(shape, p, hit->part);
    case SHAPE_TORUS:
        return torus_normal(shape, p);
    case SHAPE_DISC:
        return disc_normal(shape);
    case SHAPE_TRIANGLE:
        return shape->as.triangle.normal;
    case SHAPE_SOLID:
        return solid_normal(shape, p, hit);
    }
    return vec3(0, 1, 0);
}

Vec3 shape_normal_of(const Shape *shape, Vec3 p, const ShapeHit *hit) {
    Vec3 normal = normal_of(shape, p, hit);
    bool turned =
        shape->inverse && !(shape->kind == SHAPE_SOLID && shape->as.solid.ops->keeps_normal);
    return turned ? vec_neg(normal) : normal;
}

Vec2 shape_uv(const Shape *shape, Vec3 p, const ShapeHit *hit) {
    switch (shape->kind) {
    case SHAPE_SPHERE:
        return sphere_uv(shape, p);
    case SHAPE_BOX:
        return box_uv(shape, p, hit->part);
    case SHAPE_TORUS:
        return torus_uv(shape, p);
    case SHAPE_SOLID:
        return solid_uv(shape, p, hit);
    default:
        return (Vec2){p.x, p.y};
    }
}

bool shape_maps_uv(const Shape *shape) {
    return shape->kind == SHAPE_SPHERE || shape->kind == SHAPE_BOX || shape->kind == SHAPE_TORUS ||
           (shape->kind == SHAPE_SOLID && shape->as.solid.ops->uv);
}

bool shape_inside(const Shape *shape, Vec3 p) {
    switch (shape->kind) {
    case SHAPE_NONE:
    case SHAPE_TRIANGLE:
        return false;
    case SHAPE_PLANE:
        return plane_inside(shape, p);
    case SHAPE_SPHERE:
        return sphere_inside(shape, p);
    case SHAPE_BOX:
        return box_inside(shape, p) != shape->inverse;
    case SHAPE_CYLINDER:
    case SHAPE_CONE:
        return cone_inside(shape, p) != shape->inverse;
    case SHAPE_TORUS:
        return torus_inside(shape, p) != shape->inverse;
    case SHAPE_DISC:
        return disc_inside(shape, p) != shape->inverse;
    case SHAPE_SOLID:
        return solid_inside(shape, p);
    }
    return false;
}

bool shape_has_inside(const Shape *shape) {
    if (shape->kind == SHAPE_SOLID)
        return shape->as.solid.ops->inside != NULL;
    return shape->kind != SHAPE_NONE && shape->kind != SHAPE_TRIANGLE;
}

bool shape_inside_bounded(const Shape *shape) {
    if (shape->kind == SHAPE_SOLID &&
        (shape->as.solid.ops->deep || !vec_is_finite(shape->as.solid.box.high)))
        return false;
    return shape->kind != SHAPE_PLANE && shape->kind != SHAPE_DISC && !shape->inverse;
}

Box shape_bounds(const Shape *shape) {
    switch (shape->kind) {
    case SHAPE_NONE:
        break;
    case SHAPE_PLANE:
        return (Box){{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    case SHAPE_SPHERE:
        return sphere_bounds(shape);
    case SHAPE_BOX:
        return box_bounds(shape);
    case SHAPE_CYLINDER:
    case SHAPE_CONE:
        return cone_bounds(shape);
    case SHAPE_TORUS:
        return torus_bounds(shape);
    case SHAPE_DISC:
        return disc_bounds(shape);
    case SHAPE_TRIANGLE:
        return triangle_bounds(shape);
    case SHAPE_SOLID:
        return solid_bounds(shape);
    }
    return box_empty();
}

Box shape_bounds_in(const Shape *shape, const Transform *space) {
    if (!space)
        return shape_bounds(shape);
    Shape moved = *shape;
    Transform back = transform_inverse(space), whole = back;
    if (shape->transform)
        whole = transform_compose(shape->transform, &back);
    moved.transform = &whole;
    return shape_bounds(&moved);
}

// ---- between the spaces -------------------------------------------------------------------------

bool shape_local_ray(const Transform *transform, const Ray *ray, LocalRay *local) {
    if (!transform) {
        *local = (LocalRay){*ray, 1.0};
        return true;
    }
    Vec3 dir = transform_inv_dir(transform, ray->dir);
    double length = vec_length(dir);
    if (!(length > 0.0) || !isfinite(1.0 / length))
        return false;
    local->ray.org = transform_inv_point(transform, ray->org);
    local->ray.dir = vec_scale(dir, 1.0 / length);
    local->scale = length;
    return true;
}

Vec3 shape_local_point(const Transform *transform, Vec3 p) {
    return transform ? transform_inv_point(transform, p) : p;
}

Vec3 shape_world_point(const Transform *transform, Vec3 p) {
    return transform ? transform_point(transform, p) : p;
}

Vec3 shape_world_dir(const Transform *transform, Vec3 d) {
    return transform ? transform_dir(transform, d) : d;
}

Vec3 shape_world_normal(const Transform *transform, Vec3 normal, Vec3 fallback) {
    Vec3 n = transform ? transform_normal(transform, normal) : normal;
    double length = vec_length(n);
    if (!(length > 0.0) || !isfinite(1.0 / length) || !isfinite(length))
        return fallback;
    return vec_scale(n, 1.0 / length);
}

Box shape_ellipsoid_box(Vec3 center, Vec3 a, Vec3 b, Vec3 c) {
    Vec3 half =
        vec3(sqrt(a.x * a.x + b.x * b.x + c.x * c.x), sqrt(a.y * a.y + b.y * b.y + c.y * c.y),
             sqrt(a.z * a.z + b.z * b.z + c.z * c.z));
    return (Box){vec_sub(center, half), vec_add(center, half)};
}
