// SPDX-License-Identifier: MIT
// Patterns of tiles and cells (facts: textures 2, 2.1, 2.4). Most give the number of a colour.
#include "texture/formula.h"
#include "noise/noise.h"

#include <math.h>

static const double ROOT_3 = 1.7320508075688772935;
// Height of a triangle of side 1, with POV-Ray's digits, of which the hexagons have fewer.
static const double HALF_ROOT_3 = 0.86602540378443864676, HEXAGON_HEIGHT = 0.866025404;
static const double HEXAGON_PERIOD = 5.196152424; // 6 times that

// Rounds towards minus infinity, but whole negative numbers go one further down.
static double floor_mirrored(double x) { return x >= 0.0 ? floor(x) : -floor(-x) - 1.0; }

// Half of it is exact.
static bool is_odd(double whole) { return floor(0.5 * whole) != 0.5 * whole; }

// The parity of the unit cube; EPS keeps points on its faces in it.
double tiles_checker(Vec3 p) {
    return is_odd(floor(p.x + FORMULA_EPS) + floor(p.y + FORMULA_EPS) + floor(p.z + FORMULA_EPS))
               ? 1.0
               : 0.0;
}

double tiles_cells(Vec3 p) {
    uint32_t cell =
        noise_cell(noise_int(floor(p.x + FORMULA_EPS)), noise_int(floor(p.y + FORMULA_EPS)),
                   noise_int(floor(p.z + FORMULA_EPS)));
    double v = noise_random(cell);
    return v < 1.0 ? v : 1.0;
}

static double fraction(double t) {
    double f = t - trunc(t);
    return f < 0.0 ? f + 1.0 : f;
}

double tiles_brick(const Pattern *pattern, Vec3 p) {
    float mortar = (float)(pattern->mortar - 2.0 * FORMULA_EPS);
    double fudge = FORMULA_EPS + mortar;
    Vec3 size = pattern->brick_size;
    double x = (p.x + fudge) / size.x, y = (p.y + fudge) / size.y, z = (p.z + fudge) / size.z;
    double mx = mortar / size.x, my = mortar / size.y, mz = mortar / size.z;
    if (fraction(y) <= my)
        return 0.0;
    bool upper = fraction(y * 0.5) > 0.5; // every other row is shifted by half a brick
    if (fraction(upper ? x + 0.5 : x) <= mx)
        return 0.0;
    return fraction(upper ? z : z + 0.5) <= mz ? 0.0 : 1.0;
}

double tiles_cubic(Vec3 p) {
    double ax = fabs(p.x), ay = fabs(p.y), az = fabs(p.z);
    if (p.x >= 0.0 && p.x >= ay && p.x >= az)
        return 0.0;
    if (p.y >= 0.0 && p.y >= ax && p.y >= az)
        return 1.0;
    if (p.z >= 0.0 && p.z >= ax && p.z >= ay)
        return 2.0;
    if (p.x < 0.0 && ax >= ay && ax >= az)
        return 3.0;
    return p.y < 0.0 && ay >= ax && ay >= az ? 4.0 : 5.0;
}

double tiles_square(Vec3 p) {
    bool x = is_odd(floor(p.x)), z = is_odd(floor(p.z));
    return x ? (z ? 2.0 : 3.0) : (z ? 1.0 : 0.0);
}

// 0..5 also where a far coordinate's rounding has left a negative remainder.
static int modulo6(double whole) {
    int m = (int)fmod(whole, 6.0);
    return m < 0 ? m + 6 : m;
}

double tiles_hexagon(Vec3 p) {
    // Columns of half a side, rows of half a height; six of each repeat. The rows of the columns
    // that the slanted sides cross depend on the side.
    static const unsigned char straight[2][6] = {{0, 1, 1, 2, 2, 0}, {2, 2, 0, 0, 1, 1}};
    static const unsigned char slanted[2][6] = {{0, 2, 1, 0, 2, 1}, {2, 1, 0, 2, 1, 0}};
    double x = fabs(p.x), z = p.z < 0.0 ? HEXAGON_PERIOD - fabs(p.z) : p.z;
    x /= 0.5, z /= HEXAGON_HEIGHT;
    x -= 6.0 * floor(x / 6.0), z -= 6.0 * floor(z / 6.0);
    double xf = floor_mirrored(x), zf = floor_mirrored(z);
    int i = modulo6(xf), j = modulo6(zf);
    if (i == 0 || i == 5)
        return straight[0][j];
    if (i == 2 || i == 3)
        return straight[1][j];
    double u = x - xf, w = z - zf;
    if ((i + j) % 2 == 1)
        u = 1.0 - u;
    if (u == 0.0)
        u = 0.0001;
    return slanted[w / u < 1.0 ? 0 : 1][j];
}

double tiles_triangular(Vec3 p) {
    double x = p.x - 3.0 * floor(p.x / 3.0), z = p.z - ROOT_3 * floor(p.z / ROOT_3);
    double column = floor(x);
    int a = (int)column, r = 1;
    x -= column;
    bool upper = z >= HALF_ROOT_3;
    if (upper)
        z = ROOT_3 - z;
    if (x != 0.0 && 1.0 - x != 0.0) {
        int code = (z / x < ROOT_3 ? 1 : 0) + (z / (1.0 - x) < ROOT_3 ? 2 : 0);
        r = code == 3 ? 0 : code == 2 ? 1 : code == 1 ? 3 : 1;
    }
    r = r % 2 == 1 ? (r + 2 * a) % 6 : (6 + r - 2 * a) % 6;
    return upper ? 5 - r : r;
}

Vec3 tiles_quilt(const Pattern *pattern, Vec3 p) {
    Vec3 v = vec3(p.x - floor_mirrored(p.x) - 0.5, p.y - floor_mirrored(p.y) - 0.5,
                  p.z - floor_mirrored(p.z) - 0.5);
    double t = vec_length(v), c0 = pattern->quilted[0], c1 = pattern->quilted[1];
    double t2 = t * t, t3 = t * t2, rest = 1.0 - t;
    double q = t3 + 3.0 * t * (rest * rest) * c0 + 3.0 * t2 * rest * c1;
    q *= 1.154700538;
    return vec_scale(v, q);
}

double tiles_quilted(const Pattern *pattern, Vec3 p) {
    Vec3 v = tiles_quilt(pattern, p);
    return (fabs(v.x) + fabs(v.y) + fabs(v.z)) / 3.0;
}
