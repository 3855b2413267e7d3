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

// Between two points the square of a sor's radius is a cubic of the height, with the slopes that
// the neighbours give it; the radius may be largest in between.
static double sor_radius(const Vec2 *p) {
    double h = p[2].v - p[1].v, from = p[1].u * p[1].u, to = p[2].u * p[2].u;
    double s = 2.0 * p[1].u * (p[2].u - p[0].u) / (p[2].v - p[0].v) * h;
    double e = 2.0 * p[2].u * (p[3].u - p[1].u) / (p[3].v - p[1].v) * h;
    // from + s x + b x^2 + a x^3, 0 <= x <= 1; its slope is 0 where 3 a x^2 + 2 b x + s is.
    double a = 2.0 * (from - to) + s + e, b = 3.0 * (to - from) - 2.0 * s - e;
    double most = fmax(from, to), root = sqrt(fmax(b * b - 3.0 * a * s, 0.0));
    for (int side = -1; side <= 1; side += 2) {
        // The same root in the form that loses nothing.
        double x = a * side * b > 0.0 || a == 0.0 ? -s / (b + copysign(root, b))
                                                  : (-b + side * root) / (3.0 * a);
        if (x > 0.0 && x < 1.0)
            most = fmax(most, from + x * (s + x * (b + x * a)));
    }
    return sqrt(most);
}

static Box sor_box(const SorShape *sor) {
    double radius = 0;
    for (uint32_t i = 0; i + 3 < sor->count; i++)
        radius = fmax(radius, sor_radius(sor->points + i));
    return around_axis(radius, sor->points[1].v, sor->points[sor->count - 2].v);
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

// Cubic ones get twice the radius around each given ball. place: where the balls are; NULL: as
// given.
static Box sweep_box(const SphereSweepShape *sweep, const Transform *place) {
    Box box = box_empty();
    double k = sweep->outline == OUTLINE_CUBIC ? 2.0 : 1.0;
    for (uint32_t i = 0; i < sweep->count; i++) {
        Vec3 center = sweep->spheres[i].center;
        box = ball_box(box, place ? transform_point(place, center) : center,
                       k * sweep->spheres[i].radius);
    }
    return box;
}

// Does it only turn and shift?
static bool is_rigid(const Transform *t) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            double dot = 0.0;
            for (int k = 0; k < 3; k++)
                dot += t->m[i][k] * t->m[j][k];
            if (fabs(dot - (i == j)) > 1e-12)
                return false;
        }
    return true;
}

bool moved_extent(const Object *object, Box *out) {
    const Transform *t = &object->transform;
    const PolygonShape *polygon = &object->shape.polygon;
    if (!object->has_transform)
        return false;
    if (object->type == OBJECT_SPHERE_SWEEP && is_rigid(t)) {
        *out = sweep_box(&object->shape.sphere_sweep, t);
        return true;
    }
    if (object->type != OBJECT_POLYGON)
        return false;
    *out = box_empty();
    for (uint32_t i = 0; i < polygon->count; i++)
        *out = box_extend(*out, transform_point(t, polygon->points[i]));
    return true;
}

// Around a ball that is moved with its component POV-Ray puts one whose radius is the longest side
// of a moved cube.
static Box moved_ball(Box box, const Transform *t, Vec3 center, double square) {
    double r = sqrt(square), side = 0.0;
    if (!t)
        return ball_box(box, center, r);
    for (int j = 0; j < 3; j++) {
        double length = r * (fabs(t->m[0][j]) + fabs(t->m[1][j]) + fabs(t->m[2][j]));
        side = fmax(side, (double)(float)length);
    }
    return ball_box(box, transform_point(t, center), sqrt(side * side + 1e-10));
}

// Of a cylinder there are three: around it, and around its ends.
static Box blob_box(const BlobShape *blob) {
    Box box = box_empty();
    for (uint32_t i = 0; i < blob->count; i++) {
        const BlobComponent *part = &blob->components[i];
        const Transform *own = part->has_transform ? &part->transform : NULL;
        double square = part->radius * part->radius;
        if (part->strength <= 0.0)
            continue;
        if (!part->cylinder) {
            box = moved_ball(box, own, part->base, square);
            continue;
        }
        Vec3 axis = vec_sub(part->apex, part->base);
        double length = vec_length(axis);
        Transform place = transform_translate(part->base);
        Transform t = axis_rotation(vec_scale(axis, 1.0 / length));
        t = transform_compose(&t, &place);
        if (own)
            t = transform_compose(&t, own);
        box = moved_ball(box, &t, vec3(0, 0, 0), square);
        box = moved_ball(box, &t, vec3(0, 0, length), square);
        box = moved_ball(box, &t, vec3(0, 0, 0.5 * length), square + 0.25 * length * length);
    }
    return box;
}

// The tube between the balls may be wider than they are.
static Box ovus_box(const OvusShape *ovus) {
    double b = ovus->bottom, t = ovus->top, middle, ring;
    if (b > t) {
        double height = 2.0 * t - b - t * t / (2.0 * b);
        ring = sqrt(fmax(b * b - height * height, 0.0));
        middle = 2.0 * b - ring;
    } else {
        double height = -2.0 * t + 1.5 * t * t / b;
        ring = sqrt(fmax(t * t - height * height, 0.0));
        middle = 2.0 * t - ring;
    }
    double r = fmax(fmax(b, t), middle);
    return (Box){vec3(-r, -b, -r), vec3(r, b + t, r)};
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

// Of the points as POV-Ray keeps them.
static Box mesh_box(const Mesh *mesh) {
    Box box = rows_box(mesh->points, mesh->point_count);
    return (Box){vec3((float)box.low.x, (float)box.low.y, (float)box.low.z),
                 vec3((float)box.high.x, (float)box.high.y, (float)box.high.z)};
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

// Of an ellipsoid along the axes; POV-Ray has none of others.
static Box quadric_box(const QuadricShape *q) {
    const Box huge = {vec3(-HUGE_EXTENT, -HUGE_EXTENT, -HUGE_EXTENT),
                      vec3(HUGE_EXTENT, HUGE_EXTENT, HUGE_EXTENT)};
    double sign = copysign(1.0, q->square.x), rest = -q->constant * sign;
    Vec3 k = vec_scale(q->square, sign), l = vec_scale(q->linear, 0.5 * sign);
    bool mixed = q->mixed.x != 0.0 || q->mixed.y != 0.0 || q->mixed.z != 0.0;
    if (mixed || !(k.x > 0.0 && k.y > 0.0 && k.z > 0.0))
        return huge;
    Vec3 middle = vec3(-l.x / k.x, -l.y / k.y, -l.z / k.z);
    rest -= vec_dot(middle, l);
    if (!(rest > 0.0))
        return huge;
    Vec3 reach = vec3(sqrt(rest / k.x), sqrt(rest / k.y), sqrt(rest / k.z));
    return (Box){vec_sub(middle, reach), vec_add(middle, reach)};
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
        return sor_box(&object->shape.sor);
    case OBJECT_PRISM:
        return prism_box(&object->shape.prism);
    case OBJECT_SPHERE_SWEEP:
        return sweep_box(&object->shape.sphere_sweep, NULL);
    case OBJECT_BLOB:
        return blob_box(&object->shape.blob);
    case OBJECT_OVUS:
        return ovus_box(&object->shape.ovus);
    case OBJECT_POLYGON:
        return rows_box(&object->shape.polygon.points->x, object->shape.polygon.count);
    case OBJECT_MESH:
        return mesh_box(node->mesh);
    case OBJECT_HEIGHT_FIELD:
        return height_box(&object->shape.height_field, node->map);
    case OBJECT_ISOSURFACE:
        return container_box(&object->shape.isosurface.container);
    case OBJECT_PARAMETRIC:
        return container_box(&object->shape.parametric.container);
    case OBJECT_TEXT:
        return text_box(&object->shape.text);
    case OBJECT_QUADRIC:
        return quadric_box(&object->shape.quadric);
    default:
        return (Box){vec3(-HUGE_EXTENT, -HUGE_EXTENT, -HUGE_EXTENT),
                     vec3(HUGE_EXTENT, HUGE_EXTENT, HUGE_EXTENT)};
    }
}
