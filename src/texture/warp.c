// SPDX-License-Identifier: MIT
// One step of a pattern's chain of warps (facts: textures 1.6, 3.6).
#include "texture/warp.h"

#include "noise/noise.h"

#include <math.h>

static const double PI_2 = 6.283185307179586476925; // POV-Ray's 2 pi
static const double EPS = 1e-10;                    // POV-Ray's near-zero

Vec3 warp_turbulence(const Turbulence *turbulence, Vec3 p) {
    NoiseOctaves octaves = {turbulence->octaves, turbulence->lambda, turbulence->omega};
    return vec_add(p, vec_mul(turbulence->amount, noise_turbulence_vector(p, &octaves)));
}

// Tiles of `width` along one axis; the number of the tile and its product with the width are float.
static Vec3 repeat(const RepeatWarp *warp, Vec3 p) {
    double *along = warp->axis == 0 ? &p.x : warp->axis == 1 ? &p.y : &p.z;
    float tile = (float)floor(*along / warp->width);
    *along -= tile * warp->width;
    if (fmodf(tile, 2.0f) != 0.0f) {
        p = vec_mul(p, warp->flip);
        if (vec_get(warp->flip, warp->axis) < 0.0)
            *along = warp->width + *along;
    }
    return vec_add(p, vec_scale(warp->offset, tile));
}

static double block(double x, double size) { return size >= EPS ? floor(x / size) : 0.0; }

// Points within the radius are pulled to (inverse: pushed from) the centre.
static Vec3 black_hole(const BlackHoleWarp *warp, Vec3 p) {
    Vec3 center = warp->center;
    if (warp->repeat) {
        Vec3 size = warp->repeat_size, u = warp->uncertainty;
        Vec3 b = vec3(block(p.x, size.x), block(p.y, size.y), block(p.z, size.z));
        if (u.x != 0.0 || u.y != 0.0 || u.z != 0.0) {
            uint32_t i = noise_cell(noise_int(b.x), noise_int(b.y), noise_int(b.z));
            center = vec_add(center, vec3(noise_random(i) * u.x, noise_random(i + 1) * u.y,
                                          noise_random(i + 2) * u.z));
        }
        center = vec_add(center, vec_mul(size, b));
    }
    Vec3 d = vec_sub(p, center);
    double distance = vec_length(d);
    if (distance >= warp->radius)
        return p;
    double k = pow((warp->radius - distance) / warp->radius, warp->falloff) * warp->strength;
    k = k > 1.0 ? 1.0 : k;
    return vec_madd(p, warp->inverse ? -k : k, d);
}

// -1..1 across a face of the cube becomes 0..1.
static double across_face(double ratio) { return (ratio + 1.0) * 0.5; }

// Each face of the cube gets its part of a 4 x 3 cross, unfolded: a and b are the places across it.
static Vec3 cubic(Vec3 p) {
    const double third = 1.0 / 3.0;
    double ax = fabs(p.x), ay = fabs(p.y), az = fabs(p.z), a, b;
    if (ax >= ay && ax >= az && p.x >= 0.0) {
        a = across_face(p.z / ax), b = across_face(p.y / ax);
        return vec3(0.75 - 0.25 * a, third + third * b, ax);
    }
    if (ay >= ax && ay >= az && p.y >= 0.0) {
        a = across_face(p.x / ay), b = across_face(p.z / ay);
        return vec3(0.25 + 0.25 * a, 1.0 - third * b, ay);
    }
    if (az >= ax && az >= ay && p.z >= 0.0) {
        a = across_face(p.x / az), b = across_face(p.y / az);
        return vec3(0.25 + 0.25 * a, third + third * b, az);
    }
    if (ax >= ay && ax >= az) {
        a = across_face(p.z / ax), b = across_face(p.y / ax);
        return vec3(0.25 * a, third + third * b, ax);
    }
    if (ay >= az) {
        a = across_face(p.x / ay), b = across_face(p.z / ay);
        return vec3(0.25 + 0.25 * a, third * b, ay);
    }
    a = across_face(p.x / az), b = across_face(p.y / az);
    return vec3(1.0 - 0.25 * a, third + third * b, az);
}

// The angle of (x, z) about y, 0..2 pi; length is that of (x, z).
static double angle_about_y(double x, double z, double length) {
    if (z == 0.0)
        return x > 0.0 ? 0.0 : M_PI;
    double angle = acos(x / length);
    return z < 0.0 ? PI_2 - angle : angle;
}

// The mapped coordinates a, b (across) and c (out of the surface), turned to the orientation.
static Vec3 oriented(const MappingWarp *warp, double a, double b, double c) {
    Vec3 o = warp->orientation;
    if (o.x == 0.0 && o.y == 0.0 && o.z == 1.0)
        return vec3(a, b, c);
    return vec3(o.x * c + o.y * a + o.z * a, o.x * b + o.y * -c + o.z * b,
                o.x * -a + o.y * b + o.z * c);
}

// dist_exp e: what is mapped grows with the distance to the power e.
static double stretched(const MappingWarp *warp, double v, double distance) {
    if (warp->dist_exp == 1.0)
        return v * distance;
    return warp->dist_exp == 0.0 ? v : v * pow(distance, warp->dist_exp);
}

static Vec3 spherical(const MappingWarp *warp, Vec3 p) {
    double distance = vec_length(p);
    if (distance == 0.0)
        return p;
    Vec3 n = vec3(p.x / distance, p.y / distance, p.z / distance);
    double phi = 0.5 + asin(n.y) / M_PI, across = sqrt(n.x * n.x + n.z * n.z);
    double theta = across == 0.0 ? 0.0 : angle_about_y(n.x, n.z, across) / PI_2;
    return oriented(warp, stretched(warp, theta, distance), stretched(warp, phi, distance),
                    distance);
}

static Vec3 cylindrical(const MappingWarp *warp, Vec3 p) {
    double across = sqrt(p.x * p.x + p.z * p.z);
    if (across == 0.0)
        return p;
    double theta = angle_about_y(p.x, p.z, across) / PI_2;
    return oriented(warp, stretched(warp, theta, across), p.y, across);
}

static Vec3 toroidal(const MappingWarp *warp, Vec3 p) {
    double across = sqrt(p.x * p.x + p.z * p.z);
    if (across == 0.0)
        return p;
    double theta = angle_about_y(p.x, p.z, across) / PI_2;
    double x = across - warp->major_radius, distance = sqrt(x * x + p.y * p.y);
    double phi = acos(-x / distance);
    if (p.y > 0.0)
        phi = PI_2 - phi;
    phi /= PI_2;
    return oriented(warp, stretched(warp, theta, distance), stretched(warp, phi, distance),
                    distance);
}

Vec3 warp_apply(const Warp *warp, Vec3 p) {
    switch (warp->type) {
    case WARP_TRANSFORM:
        return transform_inv_point(&warp->transform, p);
    case WARP_TURBULENCE:
        return warp_turbulence(&warp->turbulence, p);
    case WARP_REPEAT:
        return repeat(&warp->repeat, p);
    case WARP_BLACK_HOLE:
        return black_hole(&warp->black_hole, p);
    case WARP_CUBIC:
        return cubic(p);
    case WARP_PLANAR:
        return oriented(&warp->mapping, p.x, p.y, warp->mapping.distance);
    case WARP_SPHERICAL:
        return spherical(&warp->mapping, p);
    case WARP_CYLINDRICAL:
        return cylindrical(&warp->mapping, p);
    case WARP_TOROIDAL:
        return toroidal(&warp->mapping, p);
    }
    return p;
}
