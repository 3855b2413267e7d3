// SPDX-License-Identifier: MIT
// Warps: a point is moved before a pattern looks at it.
#ifndef TEXTURE_WARP_H
#define TEXTURE_WARP_H

#include "model/scene.h"

Vec3 warp_apply(const Warp *warp, Vec3 p);
Vec3 warp_turbulence(const Turbulence *turbulence, Vec3 p);

#endif
