// SPDX-License-Identifier: MIT
// See bspline.h.
#include "patch/bspline.h"

#include <math.h>
#include <stddef.h>

enum { LINE = BEZIER_MAX_DEGREE + 1 };

const char *bspline_knots_fault(const double *knots, int degree) {
    for (int i = 0; i < 2 * degree; i++) {
        if (!isfinite(knots[i]))
            return "a knot is not finite";
        if (i > 0 && knots[i] < knots[i - 1])
            return "the knots do not grow";
    }
    if (!(knots[degree - 1] < knots[degree]))
        return "the middle two knots are the ends of the patch, and must differ";
    return NULL;
}

// The polar form of one coordinate at the arguments t[0..d). Level r turns points j - 1 and j into
// a mean by where t lies between the knots j - 1 and j - 1 + d - r that both depend on; arguments
// are the span's ends, so the mean is one of two positive shares.
static double polar_form(const double *p, const double *knots, int d, const double *t) {
    double c[LINE];
    for (int j = 0; j <= d; j++)
        c[j] = p[j];
    for (int r = 0; r < d; r++) {
        for (int j = d; j > r; j--) {
            double low = knots[j - 1], high = knots[j - 1 + d - r];
            double share = (t[r] - low) / (high - low), rest = (high - t[r]) / (high - low);
            c[j] = rest * c[j - 1] + share * c[j];
        }
    }
    return c[d];
}

static void span_line(double *p, const double *knots, int d) {
    double out[LINE], t[LINE];
    double a = knots[d - 1], b = knots[d];
    for (int i = 0; i <= d; i++) {
        for (int r = 0; r < d; r++)
            t[r] = r < d - i ? a : b;
        out[i] = polar_form(p, knots, d, t);
    }
    for (int i = 0; i <= d; i++)
        p[i] = out[i];
}

// One coordinate of the net, first along its rows, then along its columns.
static void span_net(double *p, const BsplineSpan *s, const double *knots_u,
                     const double *knots_v) {
    int rows = s->degree_u + 1, columns = s->degree_v + 1;
    double line[LINE];
    for (int i = 0; i < rows; i++)
        span_line(p + i * columns, knots_v, s->degree_v);
    for (int j = 0; j < columns; j++) {
        for (int i = 0; i < rows; i++)
            line[i] = p[i * columns + j];
        span_line(line, knots_u, s->degree_u);
        for (int i = 0; i < rows; i++)
            p[i * columns + j] = line[i];
    }
}

void bspline_span(const BsplineSpan *s, Vec3 *points, double *weights) {
    double uniform[2 * BEZIER_MAX_DEGREE], p[4][BEZIER_MAX_POINTS];
    int count = (s->degree_u + 1) * (s->degree_v + 1);
    for (int i = 0; i < 2 * BEZIER_MAX_DEGREE; i++)
        uniform[i] = i;
    for (int k = 0; k < count; k++) {
        double w = s->weights ? s->weights[k] : 1.0;
        p[0][k] = s->points[k].x * w;
        p[1][k] = s->points[k].y * w;
        p[2][k] = s->points[k].z * w;
        p[3][k] = w;
    }
    for (int c = 0; c < (s->weights ? 4 : 3); c++)
        span_net(p[c], s, s->knots_u ? s->knots_u : uniform, s->knots_v ? s->knots_v : uniform);
    for (int k = 0; k < count; k++) {
        points[k] = vec3(p[0][k], p[1][k], p[2][k]);
        if (s->weights) {
            points[k] = vec3(p[0][k] / p[3][k], p[1][k] / p[3][k], p[2][k] / p[3][k]);
            weights[k] = p[3][k];
        }
    }
}

int bspline_spans(const double *knots, int n, int degree, int *first) {
    int count = 0;
    for (int k = degree; k < n; k++) {
        if (knots[k] < knots[k + 1]) {
            if (first)
                first[count] = k - degree;
            count++;
        }
    }
    return count;
}
