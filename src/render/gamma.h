// SPDX-License-Identifier: MIT
// Transfer curves in single precision: from the scene's working space to that of a file or of the
// eye (facts: rendering 2.2, 3.1, 3.2).
#ifndef RENDER_GAMMA_H
#define RENDER_GAMMA_H

#include "model/scene.h"

// ORDER curve_type
typedef enum { CURVE_NEUTRAL, CURVE_POWER, CURVE_SRGB } CurveType;

typedef struct {
    CurveType type;
    float exponent; // CURVE_POWER: linear -> encoded is x^exponent
} Curve;

// Takes a number of the working space to an encoded one: encode(decode(x)).
typedef struct {
    Curve working, encoded;
} Transfer;

// gamma is the decoding exponent (2.2 for what old screens did); within 1 % of 1 it is neutral, as
// it is for POV-Ray.
Curve curve_power(float gamma);
Curve curve_srgb(void);
// The space the scene's numbers are in. GAMMA_NONE counts as neutral.
Curve curve_working(const Settings *settings);

// Joined to one curve where POV-Ray joins them, so that the bits are its own.
Transfer transfer_between(Curve working, Curve encoded);
float transfer_apply(const Transfer *transfer, float x);
// From an encoded number back to the working space.
float transfer_undo(const Transfer *transfer, float x);

#endif
