// SPDX-License-Identifier: MIT
// The list of bodies a ray is inside of (facts: rendering 4.6). Leaving the newest body gives back
// the parent's chain; leaving an older one puts a node in front that cancels it.
#include "render/interior.h"

uint32_t body_of(const Scene *scene, uint32_t object, uint32_t instance) {
    uint32_t interior = scene->objects[object].interior;
    if (instance != NO_INDEX)
        interior = instance_interior(&scene->objects[instance], interior);
    if (interior != NO_INDEX)
        return interior;
    return scene->interior_count + (instance != NO_INDEX ? instance : object);
}

const Interior *body_interior(const Scene *scene, uint32_t body) {
    return body < scene->interior_count ? &scene->interiors[body] : NULL;
}

static const Interior *interior_or_air(const Scene *scene, uint32_t body) {
    static const Interior AIR = {
        .ior = 1.0f, .refraction = 1.0f, .dispersion = 1.0f, .dispersion_samples = 7};
    const Interior *interior = body_interior(scene, body);
    return interior != NULL ? interior : &AIR;
}

static float body_ior(const Scene *scene, uint32_t body) {
    const Interior *interior = body_interior(scene, body);
    return interior != NULL ? interior->ior : 1.0f;
}

bool interior_inside(const InteriorList *list, uint32_t body) {
    for (; list != NULL; list = list->outer)
        if (list->body == body)
            return !list->left;
    return false;
}

// Is the body entered at node still around, seen from the newest end of the list?
static bool is_current(const InteriorList *list, const InteriorList *node) {
    for (; list != node; list = list->outer)
        if (list->body == node->body)
            return false;
    return !node->left;
}

bool interior_hollow(const InteriorList *list, const bool *hollow) {
    for (const InteriorList *node = list; node != NULL; node = node->outer)
        if (!hollow[node->body] && is_current(list, node))
            return false;
    return true;
}

// The chain from the last body entered and not left, or NULL.
static const InteriorList *innermost(const InteriorList *list) {
    for (const InteriorList *node = list; node != NULL; node = node->outer)
        if (is_current(list, node))
            return node;
    return NULL;
}

// The last one that is still around when `body` is taken away; NULL: the open.
static const InteriorList *innermost_but(const InteriorList *list, uint32_t body) {
    for (const InteriorList *node = list; node != NULL; node = node->outer)
        if (node->body != body && is_current(list, node))
            return node;
    return NULL;
}

// POV-Ray keeps the indices as float: between two bodies the quotient is rounded to float, against
// the open (a double 1) it is not.
static Bending leave(const Scene *scene, uint32_t body, const InteriorList *next) {
    const Interior *from = interior_or_air(scene, body);
    Bending bending = {from->ior, from->dispersion, from->dispersion_samples};
    if (next != NULL) {
        const Interior *to = interior_or_air(scene, next->body);
        bending.ior = from->ior / to->ior;
        bending.dispersion = from->dispersion / to->dispersion;
        if (to->dispersion_samples > bending.samples)
            bending.samples = to->dispersion_samples;
    }
    return bending;
}

static Bending enter(const Scene *scene, uint32_t body, const InteriorList *last) {
    const Interior *to = interior_or_air(scene, body);
    if (last == NULL)
        return (Bending){1.0 / to->ior, 1.0 / to->dispersion, to->dispersion_samples};
    const Interior *from = interior_or_air(scene, last->body);
    return (Bending){from->ior / to->ior, from->dispersion / to->dispersion,
                     to->dispersion_samples};
}

Bending interior_cross(const Scene *scene, const InteriorList *list, uint32_t body,
                       InteriorList *node, const InteriorList **after) {
    const InteriorList *last = innermost(list);
    if (last != NULL && last->body == body) {
        const InteriorList *next = innermost_but(list, body);
        if (last == list) {
            *after = list->outer;
        } else {
            *node = (InteriorList){list, body, true};
            *after = next == NULL ? NULL : node;
        }
        return leave(scene, body, next);
    }
    *node = (InteriorList){list, body, false};
    *after = node;
    if (interior_inside(list, body)) {
        // Overlapping bodies: the other one was taken to begin where this one still went on.
        node->left = true;
        return (Bending){1.0, 1.0, 0};
    }
    return enter(scene, body, last);
}

double interior_relative_ior(const Scene *scene, const InteriorList *list, uint32_t body) {
    const InteriorList *last = innermost(list);
    float ior = body_ior(scene, body);
    if (last == NULL)
        return ior;
    if (!interior_inside(list, body))
        return ior / body_ior(scene, last->body);
    if (innermost_but(list, body) == NULL)
        return 1.0 / ior;
    return body_ior(scene, last->body) / ior;
}
