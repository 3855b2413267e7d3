// SPDX-License-Identifier: MIT
// The bodies a ray is inside of. A list is a chain of nodes, newest first, that live in the stack
// frames of the rays which crossed the surfaces: a ray shares what its parent had and never changes
// it. NULL is the empty list: the ray is in the open.
#ifndef RENDER_INTERIOR_H
#define RENDER_INTERIOR_H

#include "model/scene.h"

typedef struct InteriorList {
    const struct InteriorList *outer;
    uint32_t body; // see body_of()
    bool left;     // the body was left here although others were entered after it
} InteriorList;

// Which body an object belongs to: objects with the same interior are one; an object without one
// has an air interior of its own, those of an instance (NO_INDEX: none) together. Bodies count on
// after the scene's interiors.
uint32_t body_of(const Scene *scene, uint32_t object, uint32_t instance);
// The interior's record, or NULL for an air interior.
const Interior *body_interior(const Scene *scene, uint32_t body);

bool interior_inside(const InteriorList *list, uint32_t body);

// Are all bodies around hollow (one flag a body)?
bool interior_hollow(const InteriorList *list, const bool *hollow);

// How light bends at a surface: ratios here / beyond.
typedef struct {
    double ior, dispersion;
    int samples; // of the spectrum, where dispersion is not 1
} Bending;

// Crosses the surface of body: the first crossing enters, the second leaves, whatever side it is.
// node is the new ray's own storage, *after its list.
Bending interior_cross(const Scene *scene, const InteriorList *list, uint32_t body,
                       InteriorList *node, const InteriorList **after);

// The index of the body relative to what surrounds it, inverted when the ray is inside: what
// Fresnel's reflection is computed with.
double interior_relative_ior(const Scene *scene, const InteriorList *list, uint32_t body);

#endif
