// SPDX-License-Identifier: MIT
// Triangles with a normal at each corner. POV-Ray shows them only when all three point to one side.
#include "shape/facet.h"
#include "shape/solid.h"

typedef struct {
    Facet facet;
    Vec3 n[3];
} Smooth;

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Smooth *smooth = data;
    double t;
    if (facet_hit(&smooth->facet, ray, &t))
        sink_put(sink, t, 0, vec3(0, 0, 0));
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const Smooth *smooth = data;
    double w[3];
    (void)hit;
    facet_weights(&smooth->facet, p, w);
    Vec3 n = vec_scale(smooth->n[0], w[0]);
    n = vec_madd(n, w[1], smooth->n[1]);
    return vec_madd(n, w[2], smooth->n[2]);
}

static const SolidOps OPS = {.near = 0.0, .far = INFINITY, .hits = hits, .normal = normal};

SolidData smooth_triangle_prepare(const SmoothTriangleShape *shape, Arena *arena) {
    Smooth *smooth = ARENA_NEW(arena, Smooth);
    if (!facet_make(&smooth->facet, shape->p, (Vec3){0, 0, 0}))
        return (SolidData){0};
    int ahead = 0, behind = 0;
    for (int i = 0; i < 3; i++) {
        double cosine = vec_dot(shape->n[i], smooth->facet.normal);
        ahead += cosine > 0.0;
        behind += cosine < 0.0;
        smooth->n[i] = shape->n[i];
    }
    if (ahead < 3 && behind < 3)
        return (SolidData){0};
    Box box =
        box_extend(box_extend(box_extend(box_empty(), shape->p[0]), shape->p[1]), shape->p[2]);
    return (SolidData){&OPS, smooth, box};
}
