// SPDX-License-Identifier: MIT
// The box or sphere within which surfaces of functions are looked for, in their local space.
#ifndef SHAPE_CONTAINER_H
#define SHAPE_CONTAINER_H

#include "model/scene.h"

// Where a ray crosses a container: 2 axis + (1 at its high end) of a box, or its sphere.
enum { CONTAINER_SPHERE = 6 };

// Depths at which the ray (of unit direction) enters and leaves, and through what; part may be
// NULL. Never where all of it lies behind the ray.
bool container_meet(const Container *container, const Ray *ray, double t[2], int part[2]);
// Outwards, not of unit length.
Vec3 container_normal(const Container *container, Vec3 p, int part);
bool container_holds(const Container *container, Vec3 p);
Box container_bounds(const Container *container);

#endif
