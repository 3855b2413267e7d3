// SPDX-License-Identifier: MIT
#include "shape/container.h"

#include "shape/shape.h"

static bool meet_sphere(const Container *container, const Ray *ray, double t[2]) {
    Vec3 o = vec_sub(ray->org, container->center);
    double b = vec_dot(o, ray->dir);
    double half = container->radius * container->radius - vec_dot(o, o) + b * b;
    if (!(half > SHAPE_EPSILON))
        return false;
    t[0] = -b - sqrt(half), t[1] = -b + sqrt(half);
    return t[1] > 0.0;
}

static bool meet_box(const Container *container, const Ray *ray, double t[2], int part[2]) {
    t[0] = -INFINITY, t[1] = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double o = vec_get(ray->org, axis), d = vec_get(ray->dir, axis);
        double low = vec_get(container->low, axis), high = vec_get(container->high, axis);
        if (d == 0.0) {
            if (o < low || o > high)
                return false;
            continue;
        }
        double a = (low - o) / d, b = (high - o) / d;
        int side = 2 * axis;
        if (fmin(a, b) > t[0])
            t[0] = fmin(a, b), part[0] = side + (d > 0.0 ? 0 : 1);
        if (fmax(a, b) < t[1])
            t[1] = fmax(a, b), part[1] = side + (d > 0.0 ? 1 : 0);
    }
    return t[0] <= t[1] && t[1] > 0.0;
}

bool container_meet(const Container *container, const Ray *ray, double t[2], int part[2]) {
    int unused[2];
    if (!part)
        part = unused;
    part[0] = part[1] = CONTAINER_SPHERE;
    return container->in_sphere ? meet_sphere(container, ray, t)
                                : meet_box(container, ray, t, part);
}

Vec3 container_normal(const Container *container, Vec3 p, int part) {
    if (part == CONTAINER_SPHERE)
        return vec_sub(p, container->center);
    double side = part % 2 ? 1.0 : -1.0;
    int axis = part / 2;
    return vec3(axis == 0 ? side : 0.0, axis == 1 ? side : 0.0, axis == 2 ? side : 0.0);
}

bool container_holds(const Container *container, Vec3 p) {
    if (container->in_sphere) {
        Vec3 o = vec_sub(p, container->center);
        return vec_dot(o, o) <= container->radius * container->radius;
    }
    return p.x >= container->low.x && p.x <= container->high.x && p.y >= container->low.y &&
           p.y <= container->high.y && p.z >= container->low.z && p.z <= container->high.z;
}

Box container_bounds(const Container *container) {
    if (!container->in_sphere)
        return (Box){container->low, container->high};
    Vec3 reach = vec3(container->radius, container->radius, container->radius);
    return (Box){vec_sub(container->center, reach), vec_add(container->center, reach)};
}
