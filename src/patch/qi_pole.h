// SPDX-License-Identifier: MIT
// Sides that are one point (poles), met by the ray. Every slice of the patch contains the pole, so
// halving alone comes down to it level by level; where a whole piece at the pole leaves the ray to
// one side, that is seen at once.
#ifndef PATCH_QI_POLE_H
#define PATCH_QI_POLE_H

#include "patch/qi_root.h"

// Sides that are a point on the ray, up to rounding; bit 0: u = 0, 1: u = 1, 2: v = 0, 3: v = 1.
// None of a rational patch.
unsigned qi_poles(const QiTarget *target);

// A piece with its net. If it has one of these sides, and all its other points that can be on the
// ray are within the tolerance of that pole: settles the pole and returns true.
bool qi_pole_settle(QiTarget *target, unsigned poles, const QiNet *net, BezierRect rect);

#endif
