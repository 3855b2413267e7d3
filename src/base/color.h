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
// Channel by channel; the scale is a double and each product is rounded to float once.
static inline Rgb rgb_add(Rgb a, Rgb b) { return rgb(a.r + b.r, a.g + b.g, a.b + b.b); }
static inline Rgb rgb_mul(Rgb a, Rgb b) { return rgb(a.r * b.r, a.g * b.g, a.b * b.b); }
static inline Rgb rgb_scale(Rgb a, double s) {
    return rgb((float)(a.r * s), (float)(a.g * s), (float)(a.b * s));
}
// What a surface of this colour lets through of what lies behind it.
static inline Rgb color_through(Color c) {
    return rgb(c.r * c.filter + c.transmit, c.g * c.filter + c.transmit,
               c.b * c.filter + c.transmit);
}
// POV-Ray's luminance (0.297, 0.589, 0.114), used wherever it wants one number for a colour.
static inline float rgb_grey(Rgb c) { return (float)(0.297 * c.r + 0.589 * c.g + 0.114 * c.b); }

#endif
