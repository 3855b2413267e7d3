// SPDX-License-Identifier: MIT
// Sides that are one point (poles), met by the ray. Every slice of the patch contains the pole, so
// halving alone comes down to it level by level; where a whole piece at the pole leaves the ray to
// one side, that is seen at once.
#ifndef PATCH_QI_POLE_H
#define PATCH_QI_POLE_H

#include "patch/qi_bound.h"

// Sides that are a point on the ray, up to rounding; bit 0: u = 0, 1: u = 1, 2: v = 0, 3: v = 1.
// None of a rational patch.
unsigned qi_poles(const QiTarget *target);

// Sides that are a point as the ray sees them, wherever it is. None of a rational patch.
unsigned qi_collapsed(const QiTarget *target);

// Clips the piece's own parameters by a form of its coordinates, where the piece has such sides.
// slack: the form's rounding. False: the form is 0 nowhere.
bool qi_pole_clip(const QiTarget *target, unsigned collapsed, const QiNet *net, BezierRect rect,
                  QiForm form, double slack, Span *u, Span *v);

// A piece with its net. If it has one of these sides, and all its other points that can be on the
// ray are within the tolerance of that pole: settles the pole and returns true.
bool qi_pole_settle(QiTarget *target, unsigned poles, const QiNet *net, BezierRect rect);

#endif
