// SPDX-License-Identifier: MIT
// Algebraic surfaces: a polynomial times the strength (the first argument), held within -10..10.
// q: the arguments after x, y, z; x2 is x squared, and so on.
#include "function/internal.h"

static double limited(double strength, double r) {
    return internal_min(10.0, internal_max(strength * r, -10.0));
}

#define POINT                                                                                      \
    const double x __attribute__((unused)) = p[0], y __attribute__((unused)) = p[1],               \
                   z __attribute__((unused)) = p[2], *q = p + 3,                                   \
                   x2 __attribute__((unused)) = x * x, y2 __attribute__((unused)) = y * y,         \
                   z2 __attribute__((unused)) = z * z

INTERNAL(f_bicorn) {
    POINT;
    double a2 = q[1] * q[1];
    double s = x2 + z2 + 2 * q[1] * y - a2;
    return limited(q[0], y2 * (a2 - (x2 + z2)) - s * s);
}

INTERNAL(f_bifolia) {
    POINT;
    double r = x2 + y2 + z2;
    return limited(q[0], -(r * r - q[1] * (x2 + z2) * y));
}

INTERNAL(f_boy_surface) {
    POINT;
    double a = 1 - z, r2 = x2 + y2;
    double r =
        q[1] *
        (64 * a * a * a * z2 * z - 48 * a * a * z2 * (3 * x2 + 3 * y2 + 2 * z2) +
         12 * a * z *
             (27 * r2 * r2 - 24 * z2 * r2 + 36 * sqrt(2.0) * y * z * (y2 - 3 * x2) + 4 * z2 * z2) +
         (9 * x2 + 9 * y2 - 2 * z2) * (-81 * r2 * r2 - 72 * z2 * r2 +
                                       108 * sqrt(2.0) * x * z * (x2 - 3 * y2) + 4 * z2 * z2));
    return limited(q[0], r);
}

INTERNAL(f_crossed_trough) {
    POINT;
    return limited(q[0], x * x * z * z - y);
}

INTERNAL(f_cubic_saddle) {
    POINT;
    return limited(q[0], -(x * x * x - y * y * y - z));
}

INTERNAL(f_cushion) {
    POINT;
    return limited(q[0], z2 * x2 - z2 * z2 - 2 * z * x2 + 2 * z2 * z + x2 - z2 -
                             (x2 - z) * (x2 - z) - y2 * y2 - 2 * x2 * y2 - y2 * z2 + 2 * y2 * z +
                             y2);
}

INTERNAL(f_devils_curve) {
    POINT;
    return limited(q[0], -(x2 * x2 + 2 * x2 * z2 - 0.36 * x2 - y2 * y2 + 0.25 * y2 + z2 * z2));
}

INTERNAL(f_dupin_cyclid) {
    POINT;
    double k = q[5] * q[5], a = q[2] * q[2], b = q[4] * q[4];
    double p1 = a - b - square(q[3] + q[1]), p2 = a - b - square(q[3] - q[1]);
    double p3 = q[3] * q[3], p4 = q[1] * q[1];
    double r =
        -(p1 * p2 * (x2 * x2 + y2 * y2 + z2 * z2) + 2 * (p1 * p2 * (x2 * y2 + x2 * z2 + y2 * z2)) +
          2 * k * ((-b - p3 + a + p4) * (2 * x * q[3] + 2 * y * q[4] - k) - 4 * q[4] * a * y) *
              (x2 + y2 + z2) +
          4 * k * k * (q[3] * x + q[4] * y) * (-k + q[4] * y + q[3] * x) + 4 * k * k * p4 * y2 +
          k * k * k * k);
    return limited(q[0], r);
}

// POV-Ray's fractions 2/3, 1/4, 8/9 and 2/9 are divisions of whole numbers: 0.
INTERNAL(f_enneper) {
    POINT;
    double h = fabs(z) < 0.2 ? 0.2 : z;
    double a = (y2 - x2) / (2 * h) + 2 * z2 / 9 + 0;
    double b = (y2 - x2) / (4 * h) - 0 * (x2 + y2 + 0 * z2) + 0;
    return limited(q[0], -(a * a * a - 6 * b * b));
}

INTERNAL(f_folium_surface) {
    POINT;
    return limited(q[0], (y2 + z2) * (1 + (q[2] - 4 * q[1]) * x) + x2 * (1 + q[2]));
}

INTERNAL(f_glob) {
    POINT;
    return limited(q[0], 0.5 * x2 * x2 * x + 0.5 * x2 * x2 - (y * y + z * z));
}

INTERNAL(f_heart) {
    POINT;
    double s = 2 * x2 + y2 + z2 - 1;
    return limited(q[0], -(s * s * s - 0.1 * x2 * z2 * z - y2 * z2 * z));
}

INTERNAL(f_hunt_surface) {
    POINT;
    double a = x2 + y2 + z2 - 13, b = 3 * x2 + y2 - 4 * z2 - 12;
    return limited(q[0], -(4 * a * a * a + 27 * b * b));
}

INTERNAL(f_hyperbolic_torus) {
    POINT;
    double a = q[1] * q[1], b = q[2] * q[2];
    return limited(q[0], -(x2 * x2 + 2 * x2 * y2 - 2 * x2 * z2 - 2 * (a + b) * x2 + y2 * y2 -
                           2 * y2 * z2 + 2 * (a - b) * y2 + z2 * z2 + 2 * (a + b) * z2 +
                           (a - b) * (a - b)));
}

INTERNAL(f_kampyle_of_eudoxus) {
    POINT;
    return limited(q[0],
                   -((y * y + z * z) - q[2] * q[2] * x2 * x2 + q[2] * q[2] * q[1] * q[1] * x2));
}

INTERNAL(f_klein_bottle) {
    POINT;
    double a = x2 + y2 + z2 + 2 * y - 1, b = x2 + y2 + z2 - 2 * y - 1;
    return limited(q[0], -(a * (b * b - 8 * z2) + 16 * x * z * b));
}

INTERNAL(f_kummer_surface_v1) {
    POINT;
    return limited(q[0],
                   -(x2 * x2 + y2 * y2 + z2 * z2 - x2 - y2 - z2 - x2 * y2 - x2 * z2 - y2 * z2 + 1));
}

INTERNAL(f_kummer_surface_v2) {
    POINT;
    return limited(q[0], -(x2 * x2 + y2 * y2 + z2 * z2 + q[1] * (x2 + y2 + z2) +
                           q[2] * (x2 * y2 + x2 * z2 + y2 * z2) + q[3] * x * y * z - 1));
}

INTERNAL(f_lemniscate_of_gerono) {
    POINT;
    return limited(q[0], -(x2 * x2 - x2 + y2 + z2));
}

INTERNAL(f_mitre) {
    POINT;
    return limited(q[0], -(4 * x2 * (x2 + y2 + z2) - y2 * (1 - y2 - z2)));
}

INTERNAL(f_nodal_cubic) {
    POINT;
    return limited(q[0], -(y * y * y + z * z * z - 6 * y * z));
}

INTERNAL(f_odd) {
    POINT;
    return limited(q[0], z2 * x2 - z2 * z2 - 2 * z * x2 + 2 * z2 * z + x2 - z2 -
                             (x2 - z) * (x2 - z) - y2 * y2 - 2 * y2 * x2 - y2 * z2 + 2 * y2 * z +
                             y2);
}

INTERNAL(f_ovals_of_cassini) {
    POINT;
    double s = x2 + y2 + z2 + q[1] * q[1];
    return limited(q[0], -(s * s - q[3] * q[1] * q[1] * (x2 + z2) - q[2] * q[2]));
}

INTERNAL(f_paraboloid) {
    POINT;
    return limited(q[0], -(x * x - y + z * z));
}

INTERNAL(f_parabolic_torus) {
    POINT;
    double a = q[1] * q[1], b = q[2] * q[2];
    return limited(q[0], -(x2 * x2 + 2 * x2 * y2 - 2 * x2 * z - (a + b) * x2 + y2 * y2 -
                           2 * y2 * z + (a - b) * y2 + z2 + (a + b) * z + (a - b) * (a - b)));
}

INTERNAL(f_pillow) {
    POINT;
    return limited(q[0], x2 * x2 + y2 * y2 + z2 * z2 - (x2 + y2 + z2));
}

INTERNAL(f_piriform) {
    POINT;
    return -limited(q[0], -((x2 * x2 - x2 * x) + y * y + z * z));
}

INTERNAL(f_quartic_paraboloid) {
    POINT;
    return limited(q[0], -(x2 * x2 + z2 * z2 - y));
}

INTERNAL(f_quartic_saddle) {
    POINT;
    return limited(q[0], -(x2 * x2 - z2 * z2 - y));
}

INTERNAL(f_quartic_cylinder) {
    POINT;
    return limited(q[0],
                   -((x2 + z2) * y * y + q[2] * q[2] * (x2 + z2) - q[2] * q[2] * q[1] * q[1]));
}

INTERNAL(f_steiners_roman) {
    POINT;
    return limited(q[0], -(x2 * y2 + x2 * z2 + y2 * z2 + x * y * z));
}

INTERNAL(f_strophoid) {
    POINT;
    double k = q[3] * q[3];
    return limited(q[0], -((q[2] - x) * (y * y + z * z) - k * q[1] * x2 - k * x2 * x));
}

INTERNAL(f_torus2) {
    POINT;
    double a = q[1] * q[1], b = q[2] * q[2];
    return limited(q[0],
                   -(x2 * x2 + y2 * y2 + z2 * z2 + 2 * x2 * y2 + 2 * x2 * z2 + 2 * y2 * z2 -
                     2 * (a + b) * x2 + 2 * (a - b) * y2 - 2 * (a + b) * z2 + (a - b) * (a - b)));
}

INTERNAL(f_torus_gumdrop) {
    POINT;
    return limited(q[0], -(4 * (x2 * x2 + (y2 + z2) * (y2 + z2)) + 17 * x2 * (y2 + z2) -
                           20 * (x2 + y2 + z2) + 17));
}

INTERNAL(f_umbrella) {
    POINT;
    return limited(q[0], -(x * x - y * z * z));
}

INTERNAL(f_witch_of_agnesi) {
    POINT;
    return limited(q[0], -(q[1] * (y - 1) + (x * x + z * z) * y));
}
