// SPDX-License-Identifier: MIT
// Colours in single precision, as POV-Ray keeps them. Products are formed in double where POV-Ray
// forms them so, and stored back to float.
#ifndef BASE_COLOR_H
#define BASE_COLOR_H

typedef struct {
    float r, g, b;
} Rgb;

// A pigment's colour: filter multiplies what is seen through by rgb, transmit lets it pass
// unchanged.
typedef struct {
    float r, g, b, filter, transmit;
} Color;

static inline Rgb rgb(float r, float g, float b) { return (Rgb){r, g, b}; }
static inline Rgb color_rgb(Color c) { return (Rgb){c.r, c.g, c.b}; }
// POV-Ray's luminance (0.297, 0.589, 0.114), used wherever it wants one number for a colour.
static inline float rgb_grey(Rgb c) { return (float)(0.297 * c.r + 0.589 * c.g + 0.114 * c.b); }

#endif
