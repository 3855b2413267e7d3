// SPDX-License-Identifier: MIT
// bounded_by, as far as it decides what is seen: POV-Ray looks for an object only on rays that meet
// its bounds or start inside them (facts: rendering 7.7, 8).
#include "render/csg.h"

#include <math.h>

// POV-Ray's least depth of a hit (facts: rendering 0.2).
static const double LEAST_DEPTH = 1e-4;

typedef struct {
    const Csg *csg;
    uint32_t leaf;
    const Ray *ray;
    bool met;
} BodyQuery;

static double try_body_hit(void *context, const ShapeHit *hit) {
    BodyQuery *query = context;
    if (hit->t >= LEAST_DEPTH &&
        csg_keeps(query->csg, query->leaf, vec_madd(query->ray->org, hit->t, query->ray->dir), 0))
        query->met = true;
    return query->met ? -INFINITY : INFINITY;
}

// Does the ray meet the surface of the body, as its own bounds let it?
static bool meets(const Csg *csg, uint32_t index, const Ray *ray) {
    const CsgNode *node = &csg->nodes[index];
    if (node->shape) {
        double entry;
        if (node->gate != NO_INDEX && !csg_admits(csg, node->gate, ray, &entry))
            return false;
        BodyQuery query = {csg, index, ray, false};
        shape_visit(node->shape, ray, LEAST_DEPTH, INFINITY, try_body_hit, &query);
        return query.met;
    }
    for (uint32_t c = node->first; c != NO_INDEX; c = csg->nodes[c].next)
        if (meets(csg, c, ray))
            return true;
    return false;
}

// Where the ray comes into the body, if that is a box; -INFINITY: it starts inside.
static double box_entry(const CsgNode *body, const Ray *ray) {
    ShapeHit hits[SHAPE_MAX_HITS];
    if (!body->shape || body->shape->kind != SHAPE_BOX || body->shape->transform ||
        body->shape->inverse || shape_hits(body->shape, ray, hits) < 2)
        return -INFINITY;
    return hits[0].t;
}

bool csg_admits(const Csg *csg, uint32_t gate, const Ray *ray, double *entry) {
    *entry = -INFINITY;
    for (uint32_t n = gate; n != NO_INDEX;) {
        const CsgNode *node = &csg->nodes[n];
        for (uint32_t b = node->first_bound; b != NO_INDEX; b = csg->nodes[b].next)
            if (!csg_inside(csg, b, ray->org) && !meets(csg, b, ray))
                return false;
        if (node->outermost)
            *entry = box_entry(&csg->nodes[node->first_bound], ray);
        n = node->parent == NO_INDEX ? NO_INDEX : csg->nodes[node->parent].gate;
    }
    return true;
}

// ---- bounds that hold the whole object ----------------------------------------------------------

static bool box_holds(const BoxShape *box, const Box *reach, double slack) {
    return box->low.x - slack <= reach->low.x && box->low.y - slack <= reach->low.y &&
           box->low.z - slack <= reach->low.z && box->high.x + slack >= reach->high.x &&
           box->high.y + slack >= reach->high.y && box->high.z + slack >= reach->high.z;
}

static bool sphere_holds(const SphereShape *sphere, const Box *reach, double slack) {
    Vec3 low = vec_sub(reach->low, sphere->center), high = vec_sub(reach->high, sphere->center);
    Vec3 far = vec3(fmax(fabs(low.x), fabs(high.x)), fmax(fabs(low.y), fabs(high.y)),
                    fmax(fabs(low.z), fabs(high.z)));
    return vec_length(far) <= fabs(sphere->radius) + slack;
}

bool csg_bounds_cut(const Scene *scene, const ObjectList *bounds, const Box *reach) {
    if (!(reach->low.x <= reach->high.x))
        return false;
    // The reach is wider than the surface by so much.
    double slack = 2.0 * SHAPE_WIDER * fmax(vec_length(reach->low), vec_length(reach->high));
    if (!isfinite(slack))
        return bounds->count > 0;
    for (uint32_t i = 0; i < bounds->count; i++) {
        const Object *body = &scene->objects[bounds->items[i]];
        bool plain = !body->inverse && !body->has_transform && body->clips.count == 0 &&
                     body->bounds.count == 0;
        if (plain && body->type == OBJECT_BOX && box_holds(&body->shape.box, reach, slack))
            continue;
        if (plain && body->type == OBJECT_SPHERE && sphere_holds(&body->shape.sphere, reach, slack))
            continue;
        return true;
    }
    return false;
}
