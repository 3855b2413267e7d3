// SPDX-License-Identifier: MIT
// Primary rays. The order of the operations is POV-Ray's, since the last bit of a direction decides
// on which side of an edge a sample falls.
#include "render/camera.h"

#include "texture/normal.h"

#include <math.h>

static const double DEGREE = 0.01745329251994329576923690768489;      // pi / 180
static const double HALF_DEGREE = 0.00872664625997164788461845384244; // pi / 360
static const double NEAR_ZERO = 1e-10, VERY_FAR = 2e10;               // POV-Ray's

static bool wants_unit_vectors(CameraType type) {
    return type != CAMERA_PERSPECTIVE && type != CAMERA_ORTHOGRAPHIC && type != CAMERA_PANORAMIC &&
           type != CAMERA_SPHERICAL;
}

CameraView camera_view(const Camera *camera, const Textures *textures, int width, int height) {
    CameraView view = {.camera = camera,
                       .textures = textures,
                       .width = width,
                       .height = height,
                       .direction = camera->direction,
                       .right = camera->right,
                       .up = camera->up,
                       .right_length = vec_length(camera->right),
                       .up_length = vec_length(camera->up)};
    if (wants_unit_vectors(camera->type)) {
        view.direction = vec_normalize(view.direction);
        view.right = vec_normalize(view.right);
        view.up = vec_normalize(view.up);
    }
    return view;
}

// a u + b v + c w, summed from left to right.
static Vec3 span(double a, Vec3 u, double b, Vec3 v, double c, Vec3 w) {
    return vec3(a * u.x + b * v.x + c * w.x, a * u.y + b * v.y + c * w.y,
                a * u.z + b * v.z + c * w.z);
}

// A picture on a sphere around the direction: the angle from the right, and that from the
// direction.
static Vec3 polar(const CameraView *view, double around, double away) {
    double cx = cos(around), sx = sin(around), cy = cos(away), sy = sin(away);
    return span(cx * sy, view->right, sx * sy, view->up, cy, view->direction);
}

static double angle_around(double x, double y, double radius) {
    if (radius == 0.0)
        return 0.0;
    return x < 0.0 ? M_PI - asin(y / radius) : asin(y / radius);
}

// (*a, *b): -1 to 1 across the picture; becomes the two angles. False outside the circle.
static bool fisheye(const CameraView *view, double *a, double *b) {
    double x = *a * view->right_length, y = *b * view->up_length;
    double radius = sqrt(x * x + y * y);
    *a = angle_around(x, y, radius);
    *b = radius * view->camera->angle_deg * HALF_DEGREE;
    return radius <= 1.0;
}

// The projection of the dome theatres, with their constants: the dome's rim is cut off below 45
// degrees under the axis, and a screen wider than 1.283458 times its height is filled.
static bool omnimax(const CameraView *view, double *a, double *b) {
    double x = *a, y = *b, aspect = view->right_length / view->up_length;
    if (aspect > 1.283458) {
        x *= aspect / 1.283458;
        y = (y - 1.0) / 1.283458 + 1.0;
    } else if (aspect > 1.0) {
        y = (y - 1.0) / aspect + 1.0;
    } else {
        y /= aspect;
    }
    double r = sqrt(x * x + y * y);
    *a = angle_around(x, y, r);
    *b = 1.411269 * r - 0.09439 * r * r * r + 0.25674 * r * r * r * r * r;
    return r <= 1.0 && !(sin(*a) * sin(*b) < tan(135.0 * DEGREE) * cos(*b));
}

// v turned by an angle about an axis.
static Vec3 turn(Vec3 v, Vec3 axis, double angle) {
    Vec3 u = vec_normalize(axis);
    double c = cos(angle), s = sin(angle);
    const double m[4][4] = {
        {u.x * u.x + c * (1.0 - u.x * u.x), u.x * u.y * (1.0 - c) + u.z * s,
         u.x * u.z * (1.0 - c) - u.y * s},
        {u.x * u.y * (1.0 - c) - u.z * s, u.y * u.y + c * (1.0 - u.y * u.y),
         u.y * u.z * (1.0 - c) + u.x * s},
        {u.x * u.z * (1.0 - c) + u.y * s, u.y * u.z * (1.0 - c) - u.x * s,
         u.z * u.z + c * (1.0 - u.z * u.z)},
    };
    return transform_row_dir(m, v);
}

static Vec3 panoramic(const CameraView *view, double *a, double *b) {
    *a = (1.0 - *a) * M_PI;
    *b = M_PI_2 * *b;
    double height = tan(*b);
    if (fabs(M_PI_2 - fabs(*b)) < NEAR_ZERO)
        height = *b > 0.0 ? VERY_FAR : -VERY_FAR;
    return span(cos(*a), view->right, height, view->up, sin(*a), view->direction);
}

// (*a, *b): -0.5 to 0.5 across the picture. Types 3 and 4 move the origin.
static void cylinder(const CameraView *view, Ray *ray, double *a, double *b) {
    CameraType type = view->camera->type;
    double angle = view->camera->angle_deg * DEGREE;
    bool upright = type == CAMERA_CYLINDER_1 || type == CAMERA_CYLINDER_3;
    bool parallel = type == CAMERA_CYLINDER_3 || type == CAMERA_CYLINDER_4;
    double *round = upright ? a : b, *straight = upright ? b : a;
    *round *= angle;
    *straight *= upright ? view->up_length : view->right_length;
    double c = cos(*round), s = sin(*round), along = parallel ? 0.0 : *straight;
    ray->dir = upright ? span(s, view->right, along, view->up, c, view->direction)
                       : span(along, view->right, s, view->up, c, view->direction);
    if (parallel) {
        Vec3 axis = upright ? view->up : view->right;
        ray->org = vec_add(ray->org, vec_scale(axis, *straight));
    }
}

bool camera_aim(const CameraView *view, double x, double y, Ray *ray, double *a, double *b) {
    const Camera *camera = view->camera;
    ray->org = camera->location;
    // The middle of a pixel lies half a pixel to the right of its corner and half a pixel below.
    x += 0.5;
    y = (view->height - 1) - (y - 0.5);
    *a = x / view->width - 0.5;
    *b = y / view->height - 0.5;
    if (camera->type == CAMERA_PERSPECTIVE) {
        ray->dir = span(1.0, view->direction, *a, view->right, *b, view->up);
        return true;
    }
    double wide = 2.0 * x / view->width - 1.0, high = 2.0 * y / view->height - 1.0;

    switch (camera->type) {
    case CAMERA_ORTHOGRAPHIC:
        ray->org = span(1.0, camera->location, *a, view->right, *b, view->up);
        ray->dir = view->direction;
        return true;
    case CAMERA_FISHEYE:
        *a = wide, *b = high;
        if (!fisheye(view, a, b))
            return false;
        ray->dir = polar(view, *a, *b);
        return true;
    case CAMERA_OMNIMAX:
        *a = wide, *b = high;
        if (!omnimax(view, a, b))
            return false;
        ray->dir = polar(view, *a, *b);
        return true;
    case CAMERA_ULTRA_WIDE_ANGLE:
        *a *= camera->angle_deg * DEGREE;
        *b *= camera->angle_deg * (view->up_length / view->right_length) * DEGREE;
        ray->dir =
            span(sin(*a), view->right, sin(*b), view->up, cos(*a) * cos(*b), view->direction);
        return true;
    case CAMERA_PANORAMIC:
        *a = x / view->width, *b = high;
        ray->dir = panoramic(view, a, b);
        return true;
    case CAMERA_CYLINDER_1:
    case CAMERA_CYLINDER_2:
    case CAMERA_CYLINDER_3:
    case CAMERA_CYLINDER_4:
        cylinder(view, ray, a, b);
        return true;
    case CAMERA_PERSPECTIVE:
    case CAMERA_SPHERICAL:
        break;
    }
    *b *= camera->spherical_deg[1] / 360 * (2.0 * M_PI);
    *a *= camera->spherical_deg[0] / 360 * (2.0 * M_PI);
    ray->dir = turn(turn(view->direction, view->right, -*b), view->up, *a);
    return true;
}

Vec3 camera_bend(const CameraView *view, Vec3 dir, double a, double b) {
    dir = vec_normalize(dir);
    if (!view->camera->has_normal)
        return dir;
    TextureHit hit = texture_no_hit(false);
    return vec_normalize(
        normal_bend(view->textures, view->camera->normal, &hit, vec3(a, b, 0.0), dir));
}

bool camera_ray(const CameraView *view, double x, double y, Ray *ray) {
    double a, b;
    if (!camera_aim(view, x, y, ray, &a, &b))
        return false;
    ray->dir = camera_bend(view, ray->dir, a, b);
    return true;
}
