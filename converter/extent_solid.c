// SPDX-License-Identifier: MIT
// The boxes that POV-Ray keeps of the larger primitives, in their local space (facts: sdl 9). They
// are what min_extent and max_extent tell, and what bounded_by compares with.
#include "converter/nodes.h"

#include <math.h>

static const double HUGE_EXTENT = 1e10;

static Box around_axis(double radius, double low, double high) {
    return (Box){vec3(-radius, low, -radius), vec3(radius, high, radius)};
}

// The points of the control polygon; the curve leaves it by so little that nothing is lost.
static Box lathe_box(const Vec2 *points, uint32_t first, uint32_t end) {
    double radius = 0, low = INFINITY, high = -INFINITY;
    for (uint32_t i = first; i < end; i++) {
        radius = fmax(radius, fabs(points[i].u));
        low = fmin(low, points[i].v);
        high = fmax(high, points[i].v);
    }
    return around_axis(radius, low, high);
}

static Box prism_box(const PrismShape *prism) {
    Box box = box_empty();
    for (uint32_t i = 0; i < prism->count; i++)
        for (int end = 0; end < 2; end++) {
            double y = end ? prism->high : prism->low, k = prism->conic ? y : 1.0;
            box = box_extend(box, vec3(prism->points[i].u * k, y, prism->points[i].v * k));
        }
    return box;
}

static Box ball_box(Box box, Vec3 center, double radius) {
    Vec3 reach = vec3(radius, radius, radius);
    return box_extend(box_extend(box, vec_sub(center, reach)), vec_add(center, reach));
}

// Cubic ones get twice the radius around each given ball.
static Box sweep_box(const SphereSweepShape *sweep) {
    Box box = box_empty();
    double k = sweep->outline == OUTLINE_CUBIC ? 2.0 : 1.0;
    for (uint32_t i = 0; i < sweep->count; i++)
        box = ball_box(box, sweep->spheres[i].center, k * sweep->spheres[i].radius);
    return box;
}

static Box blob_box(const BlobShape *blob) {
    Box box = box_empty();
    for (uint32_t i = 0; i < blob->count; i++) {
        const BlobComponent *part = &blob->components[i];
        Box own = ball_box(box_empty(), part->base, fabs(part->radius));
        if (part->cylinder)
            own = ball_box(own, part->apex, fabs(part->radius));
        if (part->strength <= 0.0)
            continue;
        for (int i8 = 0; i8 < 8; i8++) {
            Vec3 corner = vec3(i8 & 1 ? own.high.x : own.low.x, i8 & 2 ? own.high.y : own.low.y,
                               i8 & 4 ? own.high.z : own.low.z);
            box = box_extend(box, part->has_transform ? transform_point(&part->transform, corner)
                                                      : corner);
        }
    }
    return box;
}

static Box ovus_box(const OvusShape *ovus) {
    double r = fmax(ovus->bottom, ovus->top);
    return (Box){vec3(-r, -ovus->bottom, -r), vec3(r, ovus->bottom + ovus->top, r)};
}

static Box container_box(const Container *container) {
    return container->in_sphere ? ball_box(box_empty(), container->center, container->radius)
                                : (Box){container->low, container->high};
}

static Box rows_box(const double *rows, uint32_t count) {
    Box box = box_empty();
    for (uint32_t i = 0; i < count; i++)
        box = box_extend(box, vec3(rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]));
    return box;
}

static Box height_box(const HeightFieldShape *field, const HeightMap *map) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < map->count; i++) {
        low = fmin(low, map->heights[i]);
        high = fmax(high, map->heights[i]);
    }
    return (Box){vec3(0, fmax(low, field->water_level) - 1e-3, 0),
                 vec3(map->width - 1, high + 1e-3, map->depth - 1)};
}

static Box text_box(const TextShape *text) {
    // Of blanks alone nothing is seen; POV-Ray's box of them is a point at the origin, made thick.
    Box box = text->arc_count ? box_empty() : (Box){vec3(0, 0, 0), vec3(0, 0, 0)};
    for (uint32_t i = 0; i < text->arc_count * 3; i++)
        box = box_extend(box, vec3(text->arcs[2 * i], text->arcs[2 * i + 1], 0));
    return box_extend(box, vec3(box.high.x, box.high.y, text->thickness));
}

Box solid_extent(const ObjectNode *node) {
    const Object *object = &node->object;
    switch (object->type) {
    case OBJECT_SUPERELLIPSOID:
        return (Box){vec3(-1.0001, -1.0001, -1.0001), vec3(1.0001, 1.0001, 1.0001)};
    case OBJECT_LATHE: {
        const LatheShape *lathe = &object->shape.lathe;
        uint32_t skip = lathe->outline == OUTLINE_QUADRATIC || lathe->outline == OUTLINE_CUBIC;
        return lathe_box(lathe->points, skip,
                         lathe->count - (lathe->outline == OUTLINE_CUBIC ? 1 : 0));
    }
    case OBJECT_SOR:
        return lathe_box(object->shape.sor.points, 1, object->shape.sor.count - 1);
    case OBJECT_PRISM:
        return prism_box(&object->shape.prism);
    case OBJECT_SPHERE_SWEEP:
        return sweep_box(&object->shape.sphere_sweep);
    case OBJECT_BLOB:
        return blob_box(&object->shape.blob);
    case OBJECT_OVUS:
        return ovus_box(&object->shape.ovus);
    case OBJECT_POLYGON:
        return rows_box(&object->shape.polygon.points->x, object->shape.polygon.count);
    case OBJECT_MESH:
        return rows_box(node->mesh->points, node->mesh->point_count);
    case OBJECT_HEIGHT_FIELD:
        return height_box(&object->shape.height_field, node->map);
    case OBJECT_ISOSURFACE:
        return container_box(&object->shape.isosurface.container);
    case OBJECT_PARAMETRIC:
        return container_box(&object->shape.parametric.container);
    case OBJECT_TEXT:
        return text_box(&object->shape.text);
    default:
        return (Box){vec3(-HUGE_EXTENT, -HUGE_EXTENT, -HUGE_EXTENT),
                     vec3(HUGE_EXTENT, HUGE_EXTENT, HUGE_EXTENT)};
    }
}
