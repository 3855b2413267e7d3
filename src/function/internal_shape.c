// SPDX-License-Identifier: MIT
// Distances, spirals, helices, meshes of wire and sums of bells. q: the arguments after x, y, z.
#include "function/internal.h"

#include "noise/noise.h"

#define POINT                                                                                      \
    const double x __attribute__((unused)) = p[0], y __attribute__((unused)) = p[1],               \
                   z __attribute__((unused)) = p[2], *q __attribute__((unused)) = p + 3

// On the y axis POV-Ray takes another x before it asks for an angle.
static double off_axis(double x, double z, double instead) {
    return x == 0 && z == 0 ? instead : x;
}

// The angle brought to 0..2 pi.
static double whole_turn(double angle) {
    double th = fmod(angle, INTERNAL_TWO_PI);
    return th < 0 ? th + INTERNAL_TWO_PI : th;
}

INTERNAL(f_blob) {
    POINT;
    double y2 = y * y, z2 = z * z, half = q[0] * 0.5;
    double a = ((x + half) * (x + half) + y2 + z2) * q[2] * q[2];
    double b = ((x - half) * (x - half) + y2 + z2) * q[4] * q[4];
    a = a > 1.0 ? 1.0 : a;
    b = b > 1 ? 1.0 : b;
    return -(q[1] * (1.0 - a) * (1.0 - a) + q[3] * (1.0 - b) * (1.0 - b));
}

INTERNAL(f_blob2) {
    POINT;
    double x2 = x * x, y2 = y * y, z2 = z * z;
    double r = exp(-(x2 + y2 + z2) * q[1]) + exp(-((x - q[0]) * (x - q[0]) + y2 + z2) * q[1]);
    return q[3] - r * q[2];
}

INTERNAL(f_comma) {
    POINT;
    double x1 = off_axis(x, z, 0.0001), th = atan2(z, x1);
    double r = sqrt((x1 + q[0] * 0.25) * (x1 + q[0] * 0.25) + z * z);
    double tail = cos(th * 0.5) * q[0] * 0.5 - sqrt((r - q[0] * 0.75) * (r - q[0] * 0.75) + y * y);
    tail = internal_min(z, tail);
    r = q[0] * 0.5 - sqrt((x1 - q[0] * 0.5) * (x1 - q[0] * 0.5) + z * z + y * y);
    return -internal_max(tail, r);
}

// Three bells, flattened along one axis each.
typedef struct {
    double z, y, x; // the one that is wide along z, ...
} Bells;

static Bells bells_of(const double *p, double flat, double strength) {
    double x2 = p[0] * p[0], y2 = p[1] * p[1], z2 = p[2] * p[2];
    return (Bells){exp(-(x2 * flat + y2 * flat + z2) * strength),
                   exp(-(x2 * flat + y2 + z2 * flat) * strength),
                   exp(-(x2 + y2 * flat + z2 * flat) * strength)};
}

INTERNAL(f_cross_ellipsoids) {
    POINT;
    Bells b = bells_of(p, q[0], q[1]);
    return q[3] - internal_max(internal_max(b.z, b.y), b.x) * q[2];
}

INTERNAL(f_isect_ellipsoids) {
    POINT;
    Bells b = bells_of(p, q[0], q[1]);
    return q[3] - internal_min(internal_min(b.z, b.y), b.x) * q[2];
}

INTERNAL(f_flange_cover) {
    POINT;
    Bells b = bells_of(p, q[0], q[1]);
    return q[3] - (b.z + b.y + b.x) * q[2];
}

INTERNAL(f_spikes) {
    POINT;
    Bells b = bells_of(p, q[0], q[1]);
    double r = exp(-(x * x + y * y + z * z) * q[3]) * q[4] - b.z - b.y - b.x;
    return -r * q[2];
}

INTERNAL(f_ellipsoid) {
    POINT;
    return sqrt(x * x * q[0] * q[0] + y * y * q[1] * q[1] + z * z * q[2] * q[2]);
}

INTERNAL(f_helical_torus) {
    POINT;
    double from = sqrt(x * x + z * z), ph = atan2(off_axis(x, z, 0.000001), z);
    double turn = atan2(from - q[0], y);
    double r = sqrt((from - q[0]) * (from - q[0]) + y * y);
    double th = whole_turn(ph * q[1] + turn * q[2]);
    turn = atan2((th - INTERNAL_PI) * q[8], r - q[5]);
    double depth = cos(turn * q[7] + ph * q[9]) * q[3] + q[4];
    double hole = q[4] + q[5] - q[0] - from;
    th = th - INTERNAL_PI;
    depth = depth - internal_min(sqrt((r - q[5]) * (r - q[5]) + th * th * q[6]), r + q[5]);
    return -internal_max(hole, depth);
}

// The distance from the middle of a cross section: 1 a circle, 2 a diamond, less a rounded
// rectangle, 0 a rectangle.
static double superellipse(double a, double b, double shape) {
    if (shape == 0)
        return internal_max(fabs(a), fabs(b));
    double e = 2.0 / shape;
    return pow(pow(fabs(a), e) + pow(fabs(b), e), shape * 0.5);
}

INTERNAL(f_helix1) {
    POINT;
    double r = sqrt(x * x + z * z), r2;
    double th = atan2(z, off_axis(x, z, 0.000001));
    th = whole_turn(th * q[0] + y * q[1] * q[0]);
    double b = (th - INTERNAL_PI) / q[4] / (q[1] * q[0]), a = r - q[3];
    if (q[5] == 1) {
        r2 = sqrt(a * a + b * b);
    } else {
        if (q[6] != 0) {
            double c = cos(q[6] * INTERNAL_DEGREE), s = sin(q[6] * INTERNAL_DEGREE);
            double turned = a * c - b * s;
            b = a * s + b * c;
            a = turned;
        }
        r2 = superellipse(a, b, q[5]);
    }
    return -q[2] + internal_min(q[3] + r, r2);
}

INTERNAL(f_helix2) {
    POINT;
    double th = y * q[1], c = cos(th), s = sin(th);
    double x2 = x - q[3] * c, z2 = z - q[3] * s;
    double a = x2 * c + z2 * s, b = -x2 * s + z2 * c;
    if (q[5] == 1)
        return sqrt(a * a + b * b) - q[2];
    return superellipse(a, b, q[5]) - q[2];
}

// Where a point lies in its hexagon: folded into an eighth of the cell around the nearest centre.
static double hexagon_fold(const double *p, double *x1, double *y1) {
    *x1 = fabs(fmod(fabs(p[0]), sqrt(3.0)) - sqrt(3.0) / 2);
    *y1 = fabs(fmod(fabs(p[1]), 3) - 1.5);
    double x2 = sqrt(3.0) / 2 - *x1, y2 = 1.5 - *y1;
    if ((*x1 * *x1 + *y1 * *y1) > (x2 * x2 + y2 * y2)) {
        *x1 = x2;
        *y1 = y2;
    }
    return atan2(*y1, *x1);
}

INTERNAL(f_hex_x) {
    double x1, y1, th = hexagon_fold(p, &x1, &y1);
    if (th < INTERNAL_PI / 6)
        return x1;
    return cos(INTERNAL_PI / 3) * x1 + sin(INTERNAL_PI / 3) * y1;
}

INTERNAL(f_hex_y) {
    double x1, y1, th = hexagon_fold(p, &x1, &y1);
    if (th < INTERNAL_PI / 6)
        return y1;
    return fabs(-sin(INTERNAL_PI / 3) * x1 + cos(INTERNAL_PI / 3) * y1);
}

// The distance of v from the middle of its period, scaled.
static double wire_distance(double v, double half, double scale) {
    double r = fmod(v, half * 2);
    if (r < 0)
        r += half * 2;
    return fabs(r - half) * scale;
}

// y_wave: how far the wire's height is from y.
static double wire(double r, double y_wave, double scale) {
    double h = y_wave * scale;
    return -sqrt(h * h + r * r);
}

INTERNAL(f_mesh1) {
    POINT;
    double th = INTERNAL_PI / q[0], ph = INTERNAL_PI / q[1];
    double best = wire(wire_distance(x, q[0], q[2]), y - cos(z * ph) * q[3], q[4]);
    best =
        internal_max(wire(wire_distance(x - q[0], q[0], q[2]), y + cos(z * ph) * q[3], q[4]), best);
    best = internal_max(wire(wire_distance(z, q[1], q[2]), y + cos(x * th) * q[3], q[4]), best);
    return -internal_max(wire(wire_distance(z - q[1], q[1], q[2]), y - cos(x * th) * q[3], q[4]),
                         best);
}

INTERNAL(f_ph) {
    POINT;
    return atan2(sqrt(x * x + z * z), y);
}

INTERNAL(f_poly4) {
    POINT;
    double y2 = y * y, r = q[0] + q[1] * y + q[2] * y2 + q[3] * y2 * y + q[4] * y2 * y2;
    if (r < -5.0)
        r = -5.0;
    return -r + sqrt(x * x + z * z);
}

INTERNAL(f_polytubes) {
    POINT;
    double y2 = y * y;
    double from = q[1] + q[2] * y + q[3] * y2 + q[4] * y2 * y + q[5] * y2 * y2;
    double r = -10000;
    int count = noise_int(q[0]);
    for (int i = 0; i<count && * context->budget> 0; i++, --*context->budget) {
        double x2 = x - from * sin(2 * INTERNAL_PI / q[0] * i);
        double z2 = z - from * cos(2 * INTERNAL_PI / q[0] * i);
        r = internal_max(r, -sqrt(x2 * x2 + z2 * z2));
    }
    return -r;
}

INTERNAL(f_quantum) {
    POINT;
    double x1 = off_axis(x, z, 1e-6), r = sqrt(x1 * x1 + z * z);
    double th = cos(atan2(r, y));
    r = sqrt(r * r + y * y) * 2.0;
    double wave = r * r * exp(-r * 0.33333333) * (3.0 * th * th - 1);
    return (wave * wave - 12.0) * (-0.1);
}

INTERNAL(f_r) {
    POINT;
    return sqrt(x * x + y * y + z * z);
}

INTERNAL(f_rounded_box) {
    double outside[3];
    for (int i = 0; i < 3; i++) {
        double low = p[3] - p[4 + i], high = p[4 + i] - p[3];
        double above = p[i] < high ? 0 : p[i] - high, below = p[i] > low ? 0 : low - p[i];
        outside[i] = internal_max(below, above);
    }
    return -p[3] +
           sqrt(outside[0] * outside[0] + outside[1] * outside[1] + outside[2] * outside[2]) - 1e-6;
}

INTERNAL(f_sphere) {
    POINT;
    return -q[0] + sqrt(x * x + y * y + z * z);
}

INTERNAL(f_spikes_2d) {
    POINT;
    return -(q[0] * cos(q[1] * x) * cos(q[2] * z) * exp(-q[3] * (x * x + z * z)) - y);
}

INTERNAL(f_spiral) {
    POINT;
    double x1 = off_axis(x, z, 0.000001), th = atan2(z, x1);
    double r = sqrt(x * x + z * z) + q[0] * th / INTERNAL_TWO_PI;
    double r2 = fmod(r, q[0]) - q[0] * 0.5;
    if (q[5] == 1) {
        r2 = sqrt(r2 * r2 + y * y);
    } else if (q[5] != 0) {
        double e = 2 / q[5];
        r2 = pow(pow(fabs(r2), e) + pow(fabs(y), e), 1.0 / e);
    } else {
        r2 = internal_max(fabs(r2), fabs(y));
    }
    r = sqrt(x1 * x1 + y * y + z * z);
    return -internal_min(q[2] - r, q[1] - internal_min(r2, r));
}

INTERNAL(f_superellipsoid) {
    POINT;
    double e = 2 / q[0], n = 1 / q[1];
    return 1 -
           pow(pow(pow(fabs(x), e) + pow(fabs(y), e), q[0] * n) + pow(fabs(z), 2 * n), q[1] * 0.5);
}

INTERNAL(f_th) {
    POINT;
    return atan2(x, z);
}

INTERNAL(f_torus) {
    POINT;
    double from = sqrt(x * x + z * z) - q[0];
    return -q[1] + sqrt(from * from + y * y);
}
