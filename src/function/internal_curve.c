// SPDX-License-Identifier: MIT
// Plane curves as surfaces: along z, or (with the switch on) swept around the y axis at a distance,
// tilted by an angle in degrees.
#include "function/internal.h"

typedef struct {
    double x, y, x2, y2;
} Plane;

// own[0]: the switch, own[1]: the distance, own[2]: the angle.
static Plane plane_of(const double *p, const double *own) {
    double x = p[0], y = p[1], z = p[2];
    Plane at = {x, y, x * x, y * y};
    if (!(own[0] > 0))
        return at;
    double from = sqrt(at.x2 + z * z) - own[1], angle = own[2] * INTERNAL_DEGREE;
    at.x = from;
    if (angle != 0) {
        at.x = from * cos(angle) - y * sin(angle);
        at.y = from * sin(angle) + y * cos(angle);
    }
    at.x2 = at.x * at.x;
    at.y2 = at.y * at.y;
    return at;
}

static double within(double limit, double v) {
    return internal_min(limit, internal_max(v, -limit));
}

INTERNAL(f_algbr_cyl1) {
    Plane a = plane_of(p, p + 5);
    double x = fabs(a.x), r = -(a.x2 * x - a.x2 + a.y2);
    return -within(p[4], p[3] * r);
}

INTERNAL(f_algbr_cyl2) {
    Plane a = plane_of(p, p + 5);
    double r = -(2 * a.x2 * a.x2 - 3 * a.x2 * a.y + a.y2 - 2 * a.y2 * a.y + a.y2 * a.y2);
    return within(p[4], p[3] * r);
}

INTERNAL(f_algbr_cyl3) {
    Plane a = plane_of(p, p + 5);
    double r = -(a.x2 * a.x2 + a.x2 * a.y2 - 2 * a.x2 * a.y - a.x * a.y2 + a.y2);
    return within(p[4], p[3] * r);
}

INTERNAL(f_algbr_cyl4) {
    Plane a = plane_of(p, p + 5);
    double r = -(a.x2 * a.x2 + a.y2 * a.y2 + 2 * a.x2 * a.y2 + 3 * a.x2 * a.y - a.y2 * a.y);
    return within(p[4], p[3] * r);
}

INTERNAL(f_devils_curve_2d) {
    Plane a = plane_of(p, p + 6);
    double r = -(a.x2 * (a.x2 - p[4] * p[4]) - a.y2 * (a.y2 - p[5] * p[5]));
    return within(10.0, p[3] * r);
}

INTERNAL(f_folium_surface_2d) {
    Plane a = plane_of(p, p + 6);
    double r = -(a.y2 * (1 + (p[5] - 4 * p[4]) * a.x) + a.x2 * (1 + p[5]));
    return within(10.0, p[3] * r);
}

// Its last factors are those of POV-Ray, where the surface of revolution has the first twice.
INTERNAL(f_kampyle_of_eudoxus_2d) {
    Plane a = plane_of(p, p + 6);
    double r = -(a.y2 - p[5] * p[5] * a.x2 * a.x2 + p[5] * p[5] * p[4] * p[5] * a.x2);
    return within(10.0, p[3] * r);
}

INTERNAL(f_lemniscate_of_gerono_2d) {
    Plane a = plane_of(p, p + 6);
    double r = -(a.y2 - p[5] * p[5] * p[4] * p[4] * a.x2 + p[5] * p[5] * a.x2 * a.x2);
    return within(10.0, p[3] * r);
}

INTERNAL(f_piriform_2d) {
    Plane a = plane_of(p, p + 7);
    double r = -(a.y * a.y - p[4] * p[6] * p[6] * a.x2 * a.x - p[5] * p[6] * p[6] * a.x2 * a.x2);
    return within(10.0, p[3] * r);
}

INTERNAL(f_strophoid_2d) {
    Plane a = plane_of(p, p + 7);
    double k = p[6] * p[6];
    double r = -((p[5] - a.x) * a.y2 - k * p[4] * a.x2 - k * a.x2 * a.x);
    return within(10.0, p[3] * r);
}

INTERNAL(f_witch_of_agnesi_2d) {
    Plane a = plane_of(p, p + 6);
    double r = -(p[4] * p[4] * a.y + a.x2 * a.y - p[5]);
    return within(10.0, p[3] * r);
}
