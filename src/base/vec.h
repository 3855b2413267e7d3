// SPDX-License-Identifier: MIT
// Points, directions and affine maps in double. Row vectors, as POV-Ray has them: p' = p M, and the
// maps written later multiply on the right.
#ifndef BASE_VEC_H
#define BASE_VEC_H

#include <math.h>
#include <stdbool.h>

typedef struct {
    double x, y, z;
} Vec3;

typedef struct {
    double u, v;
} Vec2;

// A ray is { org + t dir : t > 0 }. dir need not be of unit length; t counts in lengths of dir.
typedef struct {
    Vec3 org, dir;
} Ray;

static inline Vec3 vec3(double x, double y, double z) { return (Vec3){x, y, z}; }
static inline Vec3 vec_add(Vec3 a, Vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec3 vec_sub(Vec3 a, Vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec3 vec_scale(Vec3 a, double s) { return vec3(a.x * s, a.y * s, a.z * s); }
static inline Vec3 vec_neg(Vec3 a) { return vec3(-a.x, -a.y, -a.z); }
static inline Vec3 vec_mul(Vec3 a, Vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }
static inline double vec_dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double vec_length(Vec3 a) { return sqrt(vec_dot(a, a)); }
static inline Vec3 vec_cross(Vec3 a, Vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline Vec3 vec_madd(Vec3 a, double s, Vec3 b) { // a + s b
    return vec3(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}
// By the reciprocal of the length, not by division: the same bits as POV-Ray. The zero vector gives
// NaN.
static inline Vec3 vec_normalize(Vec3 a) { return vec_scale(a, 1.0 / vec_length(a)); }
static inline Vec3 vec_min(Vec3 a, Vec3 b) {
    return vec3(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z);
}
static inline Vec3 vec_max(Vec3 a, Vec3 b) {
    return vec3(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z);
}
static inline bool vec_is_finite(Vec3 a) { return isfinite(a.x) && isfinite(a.y) && isfinite(a.z); }
static inline double vec_get(Vec3 a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }

// An axis-aligned box; empty when low > high in some axis.
typedef struct {
    Vec3 low, high;
} Box;

static inline Box box_empty(void) {
    return (Box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}
static inline Box box_extend(Box b, Vec3 p) { return (Box){vec_min(b.low, p), vec_max(b.high, p)}; }
static inline Box box_union(Box a, Box b) {
    return (Box){vec_min(a.low, b.low), vec_max(a.high, b.high)};
}
static inline bool box_has(const Box *box, Vec3 p) {
    return p.x >= box->low.x && p.x <= box->high.x && p.y >= box->low.y && p.y <= box->high.y &&
           p.z >= box->low.z && p.z <= box->high.z;
}

// An affine map and its inverse, kept side by side as POV-Ray does, so that both have its bits:
// composing multiplies both. Rows 0..2 are the images of the axes, row 3 the translation.
typedef struct {
    double m[4][4], inv[4][4];
} Transform;

Transform transform_identity(void);
Transform transform_translate(Vec3 t);
// A component 0 must have been replaced by 1 (with a warning) by the caller.
Transform transform_scale(Vec3 s);
// Degrees; about x first, then y, then z; left-handed.
Transform transform_rotate(Vec3 deg);
// rows[i] for i < 3: images of the axes, rows[3]: translation. False, and *out untouched, if
// singular.
bool transform_matrix(const double rows[4][3], Transform *out);
// First a, then b.
Transform transform_compose(const Transform *a, const Transform *b);
Transform transform_inverse(const Transform *a);
bool transform_is_identity(const Transform *a);

static inline Vec3 transform_row_point(const double m[4][4], Vec3 p) {
    return vec3(p.x * m[0][0] + p.y * m[1][0] + p.z * m[2][0] + m[3][0],
                p.x * m[0][1] + p.y * m[1][1] + p.z * m[2][1] + m[3][1],
                p.x * m[0][2] + p.y * m[1][2] + p.z * m[2][2] + m[3][2]);
}
static inline Vec3 transform_row_dir(const double m[4][4], Vec3 p) {
    return vec3(p.x * m[0][0] + p.y * m[1][0] + p.z * m[2][0],
                p.x * m[0][1] + p.y * m[1][1] + p.z * m[2][1],
                p.x * m[0][2] + p.y * m[1][2] + p.z * m[2][2]);
}
static inline Vec3 transform_point(const Transform *t, Vec3 p) {
    return transform_row_point(t->m, p);
}
static inline Vec3 transform_dir(const Transform *t, Vec3 d) { return transform_row_dir(t->m, d); }
static inline Vec3 transform_inv_point(const Transform *t, Vec3 p) {
    return transform_row_point(t->inv, p);
}
static inline Vec3 transform_inv_dir(const Transform *t, Vec3 d) {
    return transform_row_dir(t->inv, d);
}
// By the transposed inverse; not normalised.
static inline Vec3 transform_normal(const Transform *t, Vec3 n) {
    const double(*i)[4] = t->inv;
    return vec3(n.x * i[0][0] + n.y * i[0][1] + n.z * i[0][2],
                n.x * i[1][0] + n.y * i[1][1] + n.z * i[1][2],
                n.x * i[2][0] + n.y * i[2][1] + n.z * i[2][2]);
}

#endif
