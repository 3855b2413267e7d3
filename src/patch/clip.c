// SPDX-License-Identifier: MIT
// See clip.h. Bicubic nets go through copies of the same code with loops of known length.
#include "patch/clip.h"

#include <string.h>

enum { LINE = BEZIER_MAX_DEGREE + 1, POINTS = BEZIER_MAX_POINTS };

static inline double smaller(double a, double b) { return a < b ? a : b; }
static inline double larger(double a, double b) { return a > b ? a : b; }

// ---- Projection

static inline void project(const double *p, int count, Vec3 e, double shift, double *out) {
    for (int k = 0; k < count; k++)
        out[k] = e.x * p[k] + e.y * p[count + k] + e.z * p[2 * count + k] - shift;
}

// Distances times the weights, which are numbers 3 count and on.
static void project_rational(const double *p, int count, Vec3 e, double shift, double *out) {
    project(p, count, e, 0.0, out);
    for (int k = 0; k < count; k++)
        out[k] -= shift * p[3 * count + k];
}

void clip_project(const RefineRay *ray, const SubPatch *sub, ClipNet *out) {
    const PatchDef *def = ray->patch->def;
    out->rows = (int)def->degree_u;
    out->columns = (int)def->degree_v;
    out->turned = false;
    out->rect = bezier_whole();
    double shift1 = vec_dot(ray->e1, ray->org), shift2 = vec_dot(ray->e2, ray->org);
    int count = (out->rows + 1) * (out->columns + 1);
    if (def->weights) {
        project_rational(sub->net, count, ray->e1, shift1, out->x);
        project_rational(sub->net, count, ray->e2, shift2, out->y);
    } else if (count == 16) {
        project(sub->net, 16, ray->e1, shift1, out->x);
        project(sub->net, 16, ray->e2, shift2, out->y);
    } else {
        project(sub->net, count, ray->e1, shift1, out->x);
        project(sub->net, count, ray->e2, shift2, out->y);
    }
}

static inline void range(const double *p, int count, double *low, double *high) {
    double a = p[0], b = p[0];
    for (int k = 1; k < count; k++) {
        a = smaller(a, p[k]);
        b = larger(b, p[k]);
    }
    *low = a;
    *high = b;
}

bool clip_meets(const ClipNet *net, double slack, double *size) {
    double x0, x1, y0, y1;
    if (net->rows == 3 && net->columns == 3) {
        range(net->x, 16, &x0, &x1);
        range(net->y, 16, &y0, &y1);
    } else {
        range(net->x, (net->rows + 1) * (net->columns + 1), &x0, &x1);
        range(net->y, (net->rows + 1) * (net->columns + 1), &y0, &y1);
    }
    *size = larger(x1 - x0, y1 - y0);
    return x0 <= slack && x1 >= -slack && y0 <= slack && y1 >= -slack;
}

// ---- Clipping

// Where the lower border of the hull of (k, d[k]) comes down to the axis, going from first to last
// (step 1) or back (step -1): the least of the crossings of all chords. n: none does.
static inline double comes_down(const double *d, int n, int step) {
    const double *from = step > 0 ? d : d + n;
    double best = n + 1.0;
    for (int i = 0; i < n; i++) {
        double a = from[i * step];
        if (a <= 0.0)
            continue;
        for (int j = i + 1; j <= n; j++) {
            double b = from[j * step];
            if (b <= 0.0)
                best = smaller(best, i + (j - i) * (a / (a - b)));
        }
    }
    return best;
}

// The part of [0,1] over which the hull of (k/n, low[k]), (k/n, high[k]) meets the axis.
static inline bool hull_span(const double *low, const double *high, int n, double *from,
                             double *to) {
    double below[LINE], start = 0.0, end = 0.0;
    for (int k = 0; k <= n; k++)
        below[k] = -high[k];
    if (low[0] > 0.0)
        start = comes_down(low, n, 1);
    else if (high[0] < 0.0)
        start = comes_down(below, n, 1);
    if (low[n] > 0.0)
        end = comes_down(low, n, -1);
    else if (high[n] < 0.0)
        end = comes_down(below, n, -1);
    if (start > n || end > n)
        return false;
    *from = larger(*from, start / n);
    *to = smaller(*to, 1.0 - end / n);
    return *from <= *to;
}

// Clips by distances along (a, b).
static inline bool clip_by(const ClipNet *net, int rows, int columns, double a, double b,
                           double slack, double *from, double *to) {
    double low[LINE], high[LINE];
    int i = 0; // counted so that gcc sees that there is a first row
    do {
        const double *x = net->x + i * (columns + 1), *y = net->y + i * (columns + 1);
        low[i] = high[i] = a * x[0] + b * y[0];
        for (int j = 1; j <= columns; j++) {
            double d = a * x[j] + b * y[j];
            low[i] = smaller(low[i], d);
            high[i] = larger(high[i], d);
        }
        low[i] -= slack;
        high[i] += slack;
    } while (++i <= rows);
    return hull_span(low, high, rows, from, to);
}

// Sum of both outer edges along the first or the second index.
static inline void edges(const double *p, int rows, int columns, double *first, double *second) {
    int last = rows * (columns + 1);
    double a = p[0], b = p[columns], c = p[last], d = p[last + columns];
    *first = (c - a) + (d - b);
    *second = (b - a) + (d - c);
}

static inline bool clip_range(const ClipNet *net, int rows, int columns, double slack, double *from,
                              double *to) {
    double fx, fy, ex, ey;
    edges(net->x, rows, columns, &fx, &ex);
    edges(net->y, rows, columns, &fy, &ey);
    double ff = fx * fx + fy * fy, ee = ex * ex + ey * ey, turn = fx * ey - fy * ex;
    *from = 0.0;
    *to = 1.0;
    if (ee > 0.0) {
        double unit = 1.0 / sqrt(ee);
        if (!clip_by(net, rows, columns, ey * unit, -ex * unit, slack, from, to))
            return false;
    }
    // At less than 3 degrees to each other the first line says little about this parameter.
    if (ff > 0.0 && turn * turn <= 0.0025 * ee * ff) {
        double unit = 1.0 / sqrt(ff);
        if (!clip_by(net, rows, columns, fx * unit, fy * unit, slack, from, to))
            return false;
    }
    return true;
}

// ---- Cutting down

static inline void lerp_rows(double *row, const double *next, int width, double t) {
    for (int j = 0; j < width; j++)
        row[j] += t * (next[j] - row[j]);
}

// Keeps [a,b] of the first index: what lies beyond a, then of that what lies before b.
static inline void cut(double *p, int rows, int columns, double a, double b) {
    int width = columns + 1;
    if (a > 0.0) {
        for (int level = 0; level < rows; level++) {
            for (int i = 0; i < rows - level; i++)
                lerp_rows(p + i * width, p + (i + 1) * width, width, a);
        }
    }
    if (b < 1.0) {
        // Back to front, so that p[i] becomes the i-th of the low half.
        double share = a < 1.0 ? (b - a) / (1.0 - a) : 0.0;
        for (int level = 1; level <= rows; level++) {
            for (int i = rows; i >= level; i--) {
                double *row = p + i * width, *before = row - width;
                for (int j = 0; j < width; j++)
                    row[j] = before[j] + share * (row[j] - before[j]);
            }
        }
    }
}

static inline void turn_over(double *p, int rows, int columns) {
    double copy[POINTS];
    memcpy(copy, p, sizeof copy[0] * (size_t)((rows + 1) * (columns + 1)));
    for (int i = 0; i <= rows; i++)
        for (int j = 0; j <= columns; j++)
            p[j * (rows + 1) + i] = copy[i * (columns + 1) + j];
}

static inline bool step(ClipNet *net, int rows, int columns, double slack, double *kept) {
    double from, to;
    if (!clip_range(net, rows, columns, slack, &from, &to))
        return false;
    *kept = to - from;
    if (*kept <= CLIP_ENOUGH) {
        cut(net->x, rows, columns, from, to);
        cut(net->y, rows, columns, from, to);
        double *low = net->turned ? &net->rect.v0 : &net->rect.u0;
        double *high = net->turned ? &net->rect.v1 : &net->rect.u1;
        double start = *low, width = *high - *low;
        *low = start + from * width;
        *high = smaller(*high, start + to * width);
    }
    turn_over(net->x, rows, columns);
    turn_over(net->y, rows, columns);
    net->rows = columns;
    net->columns = rows;
    net->turned = !net->turned;
    return true;
}

bool clip_step(ClipNet *net, double slack, double *kept) {
    if (net->rows == 3 && net->columns == 3)
        return step(net, 3, 3, slack, kept);
    return step(net, net->rows, net->columns, slack, kept);
}

void clip_restrict(const ClipNet *whole, BezierRect rect, ClipNet *out) {
    int rows = whole->rows, columns = whole->columns;
    size_t count = (size_t)(rows + 1) * (size_t)(columns + 1);
    out->rows = rows;
    out->columns = columns;
    out->turned = false;
    out->rect = rect;
    memcpy(out->x, whole->x, count * sizeof out->x[0]);
    memcpy(out->y, whole->y, count * sizeof out->y[0]);
    cut(out->x, rows, columns, rect.u0, rect.u1);
    cut(out->y, rows, columns, rect.u0, rect.u1);
    turn_over(out->x, rows, columns);
    turn_over(out->y, rows, columns);
    cut(out->x, columns, rows, rect.v0, rect.v1);
    cut(out->y, columns, rows, rect.v0, rect.v1);
    turn_over(out->x, columns, rows);
    turn_over(out->y, columns, rows);
}

void clip_halve(const ClipNet *net, BezierRect *low, BezierRect *high) {
    double fx, fy, ex, ey;
    edges(net->x, net->rows, net->columns, &fx, &ex);
    edges(net->y, net->rows, net->columns, &fy, &ey);
    BezierRect r = net->rect;
    bool first = fx * fx + fy * fy >= ex * ex + ey * ey;
    bool along_u = first != net->turned;
    // Where the edges cancel, or one range has no middle any more, the other one.
    if (r.u1 - r.u0 < 0x1p-49)
        along_u = false;
    if (r.v1 - r.v0 < 0x1p-49)
        along_u = true;
    *low = *high = r;
    if (along_u)
        low->u1 = high->u0 = 0.5 * (r.u0 + r.u1);
    else
        low->v1 = high->v0 = 0.5 * (r.v0 + r.v1);
}
