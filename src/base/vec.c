// SPDX-License-Identifier: MIT
// Affine maps. The operation order is POV-Ray's where a picture could tell: 1/s for the inverse of
// a scale, the transposes for the inverse of a rotation, products summed left to right.
#include "base/vec.h"

#include <string.h>

static const double RADIANS_PER_DEGREE = 0.01745329251994329576;

Transform transform_identity(void) {
    Transform t;
    memset(&t, 0, sizeof t);
    for (int i = 0; i < 4; i++)
        t.m[i][i] = t.inv[i][i] = 1.0;
    return t;
}

Transform transform_translate(Vec3 d) {
    Transform t = transform_identity();
    t.m[3][0] = d.x, t.m[3][1] = d.y, t.m[3][2] = d.z;
    t.inv[3][0] = -d.x, t.inv[3][1] = -d.y, t.inv[3][2] = -d.z;
    return t;
}

Transform transform_scale(Vec3 s) {
    Transform t = transform_identity();
    t.m[0][0] = s.x, t.m[1][1] = s.y, t.m[2][2] = s.z;
    t.inv[0][0] = 1.0 / s.x, t.inv[1][1] = 1.0 / s.y, t.inv[2][2] = 1.0 / s.z;
    return t;
}

static void multiply(double out[4][4], const double a[4][4], const double b[4][4]) {
    double r[4][4];
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            r[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] + a[i][3] * b[3][j];
    memcpy(out, r, sizeof r);
}

static void transpose(double out[4][4], const double a[4][4]) {
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            out[i][j] = a[j][i];
}

// The rotation about one axis; (a, b) are the two axes that turn, and sine stands at [a][b].
static Transform rotate_axis(double deg, int a, int b) {
    Transform t = transform_identity();
    double angle = deg * RADIANS_PER_DEGREE, c = cos(angle), s = sin(angle);
    t.m[a][a] = t.m[b][b] = c;
    t.m[a][b] = s;
    t.m[b][a] = 0.0 - s;
    transpose(t.inv, t.m);
    return t;
}

Transform transform_rotate(Vec3 deg) {
    Transform x = rotate_axis(deg.x, 1, 2), y = rotate_axis(deg.y, 2, 0),
              z = rotate_axis(deg.z, 0, 1), t;
    multiply(t.m, x.m, y.m);
    multiply(t.m, t.m, z.m);
    multiply(t.inv, y.inv, x.inv);
    multiply(t.inv, z.inv, t.inv);
    return t;
}

// The determinant of three rows, its terms in POV-Ray's order.
static double minor_of(const double a[3], const double b[3], const double c[3]) {
    return a[0] * b[1] * c[2] + a[1] * b[2] * c[0] + a[2] * b[0] * c[1] - c[0] * b[1] * a[2] -
           c[1] * b[2] * a[0] - c[2] * b[0] * a[1];
}

bool transform_matrix(const double rows[4][3], Transform *out) {
    Transform t = transform_identity();
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++)
            t.m[i][j] = rows[i][j];
    // By cofactors, the translation too: POV-Ray inverts all of a 4x4 matrix so.
    Vec3 a = vec3(rows[0][0], rows[0][1], rows[0][2]), b = vec3(rows[1][0], rows[1][1], rows[1][2]),
         c = vec3(rows[2][0], rows[2][1], rows[2][2]);
    Vec3 bc = vec_cross(b, c), ca = vec_cross(c, a), ab = vec_cross(a, b);
    double det = vec_dot(a, bc);
    if (!(fabs(det) > 0.0) || !isfinite(det) || !isfinite(1.0 / det))
        return false;
    const Vec3 columns[3] = {bc, ca, ab};
    for (int j = 0; j < 3; j++) {
        t.inv[0][j] = columns[j].x / det;
        t.inv[1][j] = columns[j].y / det;
        t.inv[2][j] = columns[j].z / det;
    }
    t.inv[3][0] = -minor_of(rows[1], rows[2], rows[3]) / det;
    t.inv[3][1] = minor_of(rows[0], rows[2], rows[3]) / det;
    t.inv[3][2] = -minor_of(rows[0], rows[1], rows[3]) / det;
    // The same determinant, summed in another order: a last bit from 1. It counts where this map
    // follows another.
    t.inv[3][3] = minor_of(rows[0], rows[1], rows[2]) / det;
    *out = t;
    return true;
}

Transform transform_compose(const Transform *a, const Transform *b) {
    Transform t;
    multiply(t.m, a->m, b->m);
    multiply(t.inv, b->inv, a->inv);
    return t;
}

Transform transform_inverse(const Transform *a) {
    Transform t;
    memcpy(t.m, a->inv, sizeof t.m);
    memcpy(t.inv, a->m, sizeof t.inv);
    return t;
}

bool transform_is_identity(const Transform *a) {
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            if (a->m[i][j] != (i == j ? 1.0 : 0.0))
                return false;
    return true;
}
