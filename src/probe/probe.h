// SPDX-License-Identifier: MIT
// Questions that a scene's text asks about objects and pigments while it is still being read:
// trace(), inside(), values of pigments and patterns. The part of the scene that is asked about is
// a Scene of its own. This room is the converter's only way to the rooms that render.
#ifndef PROBE_PROBE_H
#define PROBE_PROBE_H

#include "model/scene.h"

typedef struct Probe Probe;

// scene: valid, must outlive the probe; its first root is the object that is asked about.
Probe *probe_create(const Scene *scene);
void probe_destroy(Probe *probe);
uint64_t probe_memory(const Probe *probe); // bytes

// The nearest hit of the object, as POV-Ray's trace() has it: patches are POV-Ray's triangles here,
// whatever renders them later, so that what a scene builds on the answer is the same. The normal is
// the object's own, of unit length.
bool probe_trace(const Probe *probe, const Ray *ray, Vec3 *p, Vec3 *normal);
bool probe_inside(const Probe *probe, Vec3 p);
// Of scene->pigments[pigment]: its colour; the value of its pattern.
void probe_color(const Probe *probe, uint32_t pigment, Vec3 p, double color[FUNCTION_WIDTH]);
double probe_pattern(const Probe *probe, uint32_t pigment, Vec3 p);

#endif
