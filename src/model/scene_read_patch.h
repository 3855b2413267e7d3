// SPDX-License-Identifier: MIT
// Inside the room: what a "bezier_patch" may have beside its points.
#ifndef MODEL_SCENE_READ_PATCH_H
#define MODEL_SCENE_READ_PATCH_H

#include "model/scene.h"
#include "model/scene_read_json.h"

// "weights", in rows as the points are; "basis", and for "bspline" perhaps "knots_u" and "knots_v":
// the points and weights become those of the Bézier patch. patch has its degrees and points.
void read_patch_basis(const Reader *r, const FieldPath *up, json_t *json, PatchShape *patch);

#endif
