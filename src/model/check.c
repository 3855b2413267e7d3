// SPDX-License-Identifier: MIT
#include "model/check.h"

#include <math.h>

// How far a direction's length may be from 1. Six written decimals give 1e-6 at most.
static const double UNIT_TOLERANCE = 1e-6;

void check_numbers(const Check *c, const FieldPath *up, const char *name, const double *values,
                   int count) {
    for (int i = 0; i < count; i++) {
        // Also true for NaN.
        if (!(fabs(values[i]) <= MAX_COORDINATE)) {
            const FieldPath path = path_field(up, name);
            refuse(c, &path, "%g is out of range", values[i]);
        }
    }
}

void check_floats(const Check *c, const FieldPath *up, const char *name, const float *values,
                  int count) {
    for (int i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            const FieldPath path = path_field(up, name);
            refuse(c, &path, "%g is not a finite number", (double)values[i]);
        }
    }
}

void check_float(const Check *c, const FieldPath *up, const char *name, float value) {
    check_floats(c, up, name, &value, 1);
}

void check_rgb(const Check *c, const FieldPath *up, const char *name, Rgb value) {
    check_floats(c, up, name, (float[]){value.r, value.g, value.b}, 3);
}

void check_color(const Check *c, const FieldPath *up, const char *name, Color value) {
    check_floats(c, up, name, (float[]){value.r, value.g, value.b, value.filter, value.transmit},
                 5);
}

void check_vec3(const Check *c, const FieldPath *up, const char *name, Vec3 value) {
    check_numbers(c, up, name, &value.x, 3);
}

void check_unit(const Check *c, const FieldPath *up, const char *name, Vec3 value) {
    const FieldPath path = path_field(up, name);
    check_vec3(c, up, name, value);
    if (!(fabs(vec_length(value) - 1) <= UNIT_TOLERANCE))
        refuse(c, &path, "its length is %g instead of 1", vec_length(value));
}

void check_size(const Check *c, const FieldPath *up, const char *name, double value) {
    const FieldPath path = path_field(up, name);
    check_numbers(c, up, name, &value, 1);
    if (value < 0)
        refuse(c, &path, "%g is negative", value);
}

void check_not_zero(const Check *c, const FieldPath *up, const char *name, double value) {
    const FieldPath path = path_field(up, name);
    check_numbers(c, up, name, &value, 1);
    if (value == 0)
        refuse(c, &path, "0 has no reciprocal");
}

void check_range(const Check *c, const FieldPath *up, const char *name, int value, int low,
                 int high) {
    const FieldPath path = path_field(up, name);
    if (value < low || value > high)
        refuse(c, &path, "%d is not in the range %d to %d", value, low, high);
}

void check_index(const Check *c, const FieldPath *path, uint32_t index, uint32_t count,
                 const char *what) {
    if (index >= count)
        refuse(c, path, "%u, but there %s %u %s%s", index, count == 1 ? "is" : "are", count, what,
               count == 1 ? "" : "s");
}

// matrix x inverse must be the identity, apart from the rounding of many products: that is far
// below a thousandth of the terms summed. Coordinates around 1 are taken as the least scale, since
// rounding leaves small numbers where 0 is meant.
void check_transform(const Check *c, const FieldPath *up, const char *name, const Transform *t) {
    const FieldPath path = path_field(up, name), matrix = path_field(&path, "matrix"),
                    inverse = path_field(&path, "inverse");
    check_numbers(c, &path, "matrix", &t->m[0][0], 16);
    check_numbers(c, &path, "inverse", &t->inv[0][0], 16);
    for (int i = 0; i < 4; i++) {
        double last = i == 3 ? 1 : 0;
        bool affine = i < 3 ? t->inv[i][3] == 0 : fabs(t->inv[3][3] - 1) <= 1e-6; // base/vec.c
        if (t->m[i][3] != last || !affine)
            refuse(c, &matrix, "it is not affine");
        for (int j = 0; j < 4; j++) {
            double sum = 0, terms = 1;
            for (int k = 0; k < 4; k++) {
                sum += t->m[i][k] * t->inv[k][j];
                terms += fabs(t->m[i][k] * t->inv[k][j]);
            }
            if (!(fabs(sum - (i == j ? 1 : 0)) <= 1e-3 * terms))
                refuse(c, &inverse, "it is not the inverse of the matrix");
        }
    }
}
