// SPDX-License-Identifier: MIT
// The primitives that are modelled, except the patch: their data, and how transforms change them.
// POV-Ray moves numbers where it can and keeps a matrix where it cannot (facts: rendering 8); we do
// the same, so that the numbers have its bits.
#include "converter/nodes.h"

#include <math.h>

// POV-Ray's limit below which two radii, or the two ends of an axis, are one.
static const double EQUAL = 1e-10;

static Vec3 parse_direction(Converter *cv, const char *what) {
    const Token *token = peek_token(cv);
    Vec3 v = parse_vector(cv);
    if (!(vec_length(v) > 0.0) || !isfinite(vec_length(v))) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "the normal of a %s must have a length", what);
    }
    return vec_normalize(v);
}

static void parse_plane(Converter *cv, ObjectNode *object) {
    PlaneShape *plane = &object->object.shape.plane;
    plane->normal = parse_direction(cv, "plane");
    optional_comma(cv);
    plane->distance = parse_float(cv);
}

// With a negative radius POV-Ray shows the same sphere, its outside turned in.
static void parse_sphere(Converter *cv, ObjectNode *object) {
    SphereShape *sphere = &object->object.shape.sphere;
    sphere->center = parse_vector(cv);
    optional_comma(cv);
    double radius = parse_float(cv);
    sphere->radius = fabs(radius);
    object->object.inverse = radius < 0;
}

// Of what has such a number POV-Ray shows nothing, or some part that its bounding box leaves.
static void ignore_shape(Converter *cv, ObjectNode *object, const Token *token, const char *why) {
    Loc loc = token_loc(cv, token);
    warn_at(&loc, "%s: it is ignored, POV-Ray shows a part of it or nothing", why);
    object->ignored = true;
}

static void parse_box(Converter *cv, ObjectNode *object) {
    Vec3 a = parse_vector(cv);
    optional_comma(cv);
    Vec3 b = parse_vector(cv);
    object->object.shape.box = (BoxShape){vec_min(a, b), vec_max(a, b)};
    if (!vec_is_finite(a)) // NaN gets lost in comparisons
        object->object.shape.box.low = a;
    if (!vec_is_finite(b))
        object->object.shape.box.high = b;
}

static void check_axis(Converter *cv, const Token *token, const ConeShape *cone, const char *what) {
    if (vec_length(vec_sub(cone->apex, cone->base)) < EQUAL) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "the two ends of the %s are the same point", what);
    }
}

static void parse_cylinder(Converter *cv, ObjectNode *object) {
    const Token *token = peek_token(cv);
    ConeShape *cone = &object->object.shape.cone;
    cone->base = parse_vector(cv);
    optional_comma(cv);
    cone->apex = parse_vector(cv);
    optional_comma(cv);
    cone->base_radius = cone->apex_radius = fabs(parse_float(cv));
    cone->open = accept(cv, KW_open);
    check_axis(cv, token, cone, "cylinder");
}

static void parse_cone(Converter *cv, ObjectNode *object) {
    const Token *token = peek_token(cv);
    ConeShape *cone = &object->object.shape.cone;
    cone->base = parse_vector(cv);
    optional_comma(cv);
    cone->base_radius = parse_float(cv);
    optional_comma(cv);
    cone->apex = parse_vector(cv);
    optional_comma(cv);
    cone->apex_radius = parse_float(cv);
    cone->open = accept(cv, KW_open);
    check_axis(cv, token, cone, "cone");
    if (cone->base_radius < 0 || cone->apex_radius < 0)
        ignore_shape(cv, object, token, "a radius of the cone is negative");
    if (fabs(cone->apex_radius - cone->base_radius) < EQUAL)
        object->object.type = OBJECT_CYLINDER;
}

static void parse_torus(Converter *cv, ObjectNode *object) {
    TorusShape *torus = &object->object.shape.torus;
    const Token *token = peek_token(cv);
    torus->major = parse_float(cv);
    optional_comma(cv);
    torus->minor = parse_float(cv);
    if (torus->major < 0 || torus->minor < 0)
        ignore_shape(cv, object, token, "a radius of the torus is negative");
}

static void parse_disc(Converter *cv, ObjectNode *object) {
    DiscShape *disc = &object->object.shape.disc;
    disc->center = parse_vector(cv);
    optional_comma(cv);
    const Token *token = peek_token(cv);
    Vec3 normal = parse_vector(cv);
    if (vec_length(normal) > 0.0)
        disc->normal = vec_normalize(normal);
    else
        ignore_shape(cv, object, token, "the normal of the disc has no length");
    optional_comma(cv);
    disc->radius = fabs(parse_float(cv));
    optional_comma(cv);
    while (starts_expression(cv)) // the last one counts
        disc->hole = fabs(parse_float(cv));
}

static void parse_triangle(Converter *cv, ObjectNode *object) {
    for (int i = 0; i < 3; i++) {
        if (i > 0)
            optional_comma(cv);
        object->object.shape.triangle.p[i] = parse_vector(cv);
    }
}

bool shape_is_finite(const Object *object) {
    switch (object->type) {
    case OBJECT_PLANE:
        return isfinite(object->shape.plane.distance);
    case OBJECT_SPHERE:
        return vec_is_finite(object->shape.sphere.center) && isfinite(object->shape.sphere.radius);
    case OBJECT_BOX:
        return vec_is_finite(object->shape.box.low) && vec_is_finite(object->shape.box.high);
    case OBJECT_CYLINDER:
    case OBJECT_CONE: {
        const ConeShape *cone = &object->shape.cone;
        return vec_is_finite(cone->base) && vec_is_finite(cone->apex) &&
               isfinite(cone->base_radius) && isfinite(cone->apex_radius);
    }
    case OBJECT_TORUS:
        return isfinite(object->shape.torus.major) && isfinite(object->shape.torus.minor);
    case OBJECT_DISC: {
        const DiscShape *disc = &object->shape.disc;
        return vec_is_finite(disc->center) && isfinite(disc->radius) && isfinite(disc->hole);
    }
    case OBJECT_TRIANGLE: {
        const Vec3 *p = object->shape.triangle.p;
        return vec_is_finite(p[0]) && vec_is_finite(p[1]) && vec_is_finite(p[2]);
    }
    case OBJECT_PATCH: // checked point by point
    case OBJECT_UNION:
    case OBJECT_MERGE:
    case OBJECT_INTERSECTION:
        break;
    default:
        return solid_is_finite(object);
    }
    return true;
}

ParseShape *shape_parser(int keyword) {
    switch (keyword) {
    case KW_bicubic_patch:
        return parse_patch_data;
    case KW_plane:
        return parse_plane;
    case KW_sphere:
        return parse_sphere;
    case KW_box:
        return parse_box;
    case KW_cylinder:
        return parse_cylinder;
    case KW_cone:
        return parse_cone;
    case KW_torus:
        return parse_torus;
    case KW_disc:
        return parse_disc;
    case KW_triangle:
        return parse_triangle;
    default:
        return NULL;
    }
}

// ---- transforms ------------------------------------------------------------------------------

static Vec3 move_point(Vec3 p, const Move *move) {
    switch (move->kind) {
    case MOVE_TRANSLATE:
        return vec_add(p, move->v);
    case MOVE_SCALE:
        return vec_mul(p, move->v);
    case MOVE_ROTATE:
    case MOVE_MATRIX:
        break;
    }
    return transform_point(&move->t, p);
}

static void move_by_matrix(Object *object, const Move *move) {
    object->transform =
        object->has_transform ? transform_compose(&object->transform, &move->t) : move->t;
    object->has_transform = true;
}

static void scale_plane(PlaneShape *plane, Vec3 s) {
    Vec3 n = vec3(plane->normal.x / s.x, plane->normal.y / s.y, plane->normal.z / s.z);
    double length = vec_length(n);
    plane->normal = vec_scale(n, 1.0 / length);
    plane->distance /= length;
}

// p' = p M: n . (p' M^-1) = d, so n' = M^-1 n (as a column) and d' = d - n . (last row of M^-1).
static void move_plane(PlaneShape *plane, const Move *move) {
    switch (move->kind) {
    case MOVE_TRANSLATE:
        plane->distance += vec_dot(plane->normal, move->v);
        break;
    case MOVE_ROTATE:
        plane->normal = transform_dir(&move->t, plane->normal);
        break;
    case MOVE_SCALE:
        scale_plane(plane, move->v);
        break;
    case MOVE_MATRIX: {
        const double *back = move->t.inv[3];
        plane->distance -= vec_dot(plane->normal, vec3(back[0], back[1], back[2]));
        Vec3 n = transform_normal(&move->t, plane->normal);
        double length = vec_length(n);
        plane->normal = vec_scale(n, 1.0 / length);
        plane->distance /= length;
        break;
    }
    }
}

static void move_sphere(Object *object, const Move *move) {
    SphereShape *sphere = &object->shape.sphere;
    bool even = move->v.x == move->v.y && move->v.x == move->v.z;
    if (object->has_transform || move->kind == MOVE_MATRIX || (move->kind == MOVE_SCALE && !even)) {
        move_by_matrix(object, move);
        return;
    }
    sphere->center = move_point(sphere->center, move);
    if (move->kind == MOVE_SCALE)
        sphere->radius *= fabs(move->v.x);
}

static void move_box(Object *object, const Move *move) {
    if (object->has_transform || move->kind == MOVE_MATRIX || move->kind == MOVE_ROTATE) {
        move_by_matrix(object, move);
        return;
    }
    Vec3 a = move_point(object->shape.box.low, move), b = move_point(object->shape.box.high, move);
    object->shape.box = (BoxShape){vec_min(a, b), vec_max(a, b)};
}

static void move_points(Vec3 *points, size_t count, const Move *move) {
    for (size_t i = 0; i < count; i++)
        points[i] = move_point(points[i], move);
}

static void move_normal(Vec3 *n, const Move *move) {
    Vec3 turned = transform_normal(&move->t, *n);
    double length = vec_length(turned);
    if (length > 0.0 && isfinite(length))
        *n = vec_scale(turned, 1.0 / length);
}

void shape_move(ObjectNode *node, const Move *move) {
    Object *object = &node->object;
    if (!node->modelled)
        return;
    switch (object->type) {
    case OBJECT_UNION:
    case OBJECT_MERGE:
    case OBJECT_INTERSECTION:
        break;
    case OBJECT_PATCH: {
        PatchShape *patch = &object->shape.patch;
        move_points(patch->points, (size_t)(patch->degree_u + 1) * (patch->degree_v + 1), move);
        break;
    }
    case OBJECT_PLANE:
        move_plane(&object->shape.plane, move);
        break;
    case OBJECT_SPHERE:
        move_sphere(object, move);
        break;
    case OBJECT_BOX:
        move_box(object, move);
        break;
    case OBJECT_TRIANGLE:
        move_points(object->shape.triangle.p, 3, move);
        break;
    case OBJECT_SMOOTH_TRIANGLE:
        move_points(object->shape.smooth_triangle.p, 3, move);
        for (int i = 0; i < 3; i++)
            move_normal(&object->shape.smooth_triangle.n[i], move);
        break;
    default:
        move_by_matrix(object, move);
        break;
    }
}
