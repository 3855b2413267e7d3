// SPDX-License-Identifier: MIT
// With (s, t) in [-1,1]^2 over the part, c its middle and h its half sizes, Taylor says
//     S = sum over i + j <= 3 of T_ij s^i t^j + R,    T_ij = hu^i hv^j S_(i,j)(c) / (i! j!),
//     |R| <= sum over i + j = 4 of hu^i hv^j max |S_(i,j)| / (i! j!).
// R's derivative along s is the same sum with each term times i, that along t times j: 4 times the
// bound in all, and twice that along parameters that run from 0 to 1.
//
// A fourth derivative of a Bézier patch lies within its fourth differences times d!/(d-i)!. Of the
// net's rounding e the derivative of order i, j gets (2 du)^i (2 dv)^j e at most, and as much by
// its own evaluation; over all T_ij that is e times the first terms of exp(2 du hu + 2 dv hv).
#include "patch/qi_local.h"

#include <float.h>
#include <string.h>

enum { LINE = BEZIER_MAX_DEGREE + 1 };

bool qi_local_pays(int du, int dv) { return (du + 1) * (dv + 1) >= 64; }

static double larger(double a, double b) { return a > b ? a : b; }

// d (d-1) ... of so many factors; 0 when there are fewer.
static double falling(int d, int factors) {
    double product = 1.0;
    for (int k = 0; k < factors; k++)
        product *= d - k > 0 ? d - k : 0;
    return product;
}

// The largest j-th differences along the rows of a net, which is used up. By column first, so that
// the loops vectorise.
static double largest_along_rows(double *net, int rows, int row, int j) {
    double columns[LINE] = {0.0}, most = 0.0;
    for (int i = 0; i < rows; i++, net += row) {
        for (int n = 1; n <= j; n++)
            for (int m = 0; m < row - n; m++)
                net[m] = net[m + 1] - net[m];
        for (int m = 0; m < row - j; m++)
            columns[m] = larger(columns[m], fabs(net[m]));
    }
    for (int m = 0; m < row - j; m++)
        most = larger(most, columns[m]);
    return most;
}

// most[i]: the largest of the i-th differences in u and (4-i)-th in v.
static void fourth_differences(const double *net, int du, int dv, double most[5]) {
    double across[BEZIER_MAX_POINTS], copy[BEZIER_MAX_POINTS];
    int row = dv + 1;
    memcpy(across, net, (size_t)((du + 1) * row) * sizeof(double));
    for (int i = 0; i <= 4; i++) {
        int count = (du + 1 > i ? du + 1 - i : 0) * row;
        memcpy(copy, across, (size_t)count * sizeof(double));
        most[i] = largest_along_rows(copy, count / row, row, 4 - i);
        for (int m = 0; m < count - row; m++)
            across[m] = across[m + row] - across[m];
    }
}

void qi_local_init(QiLocal *local, const QiFrame *frame, int du, int dv, const QiNet *net,
                   BezierRect over) {
    local->du = du;
    local->dv = dv;
    local->over = over;
    size_t size = (size_t)((du + 1) * (dv + 1)) * sizeof(double);
    memcpy(local->net.x, net->x, size);
    memcpy(local->net.y, net->y, size);
    memcpy(local->net.z, net->z, size);
    local->slack[0] = frame->slack_x;
    local->slack[1] = frame->slack_y;
    local->slack[2] = frame->slack_z;
    const double *nets[3] = {net->x, net->y, net->z};
    for (int k = 0; k < 3; k++) {
        double *fourth = local->fourth[k];
        fourth_differences(nets[k], du, dv, fourth);
        for (int i = 0; i <= 4; i++) // 16 points' rounding, and as much of the differences
            fourth[i] = falling(du, i) * falling(dv, 4 - i) * (fourth[i] + 32.0 * local->slack[k]);
    }
}

// Of the Bernstein polynomials of degree d at c: h^i / i! times their i-th derivatives, as
// weights[4 k + i] of control point k.
static void taylor_weights(int d, double c, double h, double *weights) {
    double b[LINE + 1] = {0.0, 1.0}; // of degree n, shifted by one
    int low = d > 3 ? d - 3 : 0;
    for (int n = 0; n <= d; n++) {
        if (n > 0) {
            for (int i = n + 1; i > 0; i--)
                b[i] = b[i] * (1.0 - c) + b[i - 1] * c;
        }
        if (n < low)
            continue;
        // d - n times the derivative: backward differences, times d! / n!.
        int order = d - n;
        double line[LINE + 4] = {0.0}, factor = 1.0;
        for (int i = 0; i <= n; i++)
            line[i] = b[i + 1];
        for (int k = 1; k <= order; k++) {
            factor *= (d - k + 1) * h / k;
            for (int i = n + k; i > 0; i--)
                line[i] = line[i - 1] - line[i];
            line[0] = -line[0];
        }
        for (int i = 0; i <= d; i++)
            weights[4 * i + order] = factor * line[i];
    }
    for (int order = d + 1; order < 4; order++)
        for (int i = 0; i <= d; i++)
            weights[4 * i + order] = 0.0;
}

void qi_local_part(const QiLocal *q, BezierRect rect, QiLocalPart *part) {
    double width = q->over.u1 - q->over.u0, height = q->over.v1 - q->over.v0;
    part->hu = 0.5 * (rect.u1 - rect.u0) / width;
    part->hv = 0.5 * (rect.v1 - rect.v0) / height;
    taylor_weights(q->du, (rect.u0 - q->over.u0) / width + part->hu, part->hu, part->u);
    taylor_weights(q->dv, (rect.v0 - q->over.v0) / height + part->hv, part->hv, part->v);
}

void qi_local_cut(const QiLocal *q, const QiLocalPart *part, int coordinate, double out[16],
                  double *rest) {
    int du = q->du, dv = q->dv;
    const double *p = coordinate == 0 ? q->net.x : coordinate == 1 ? q->net.y : q->net.z;
    const double *wu = part->u, *wv = part->v;
    double hu = part->hu, hv = part->hv, t[4][4] = {{0.0}};
    for (int i = 0; i <= du; i++, p += dv + 1) {
        double row[4] = {0.0};
        for (int j = 0; j <= dv; j++)
            for (int k = 0; k < 4; k++)
                row[k] += p[j] * wv[4 * j + k];
        for (int a = 0; a < 4; a++)
            for (int b = 0; a + b < 4; b++)
                t[a][b] += wu[4 * i + a] * row[b];
    }

    // Powers of s in [-1,1] as control points.
    static const double power[4][4] = {{1.0, 1.0, 1.0, 1.0},
                                       {-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0},
                                       {1.0, -1.0 / 3.0, -1.0 / 3.0, 1.0},
                                       {-1.0, 1.0, -1.0, 1.0}};
    for (int k = 0; k < 4; k++) {
        double line[4] = {0.0};
        for (int a = 0; a < 4; a++)
            for (int b = 0; a + b < 4; b++)
                line[b] += t[a][b] * power[a][k];
        for (int m = 0; m < 4; m++)
            out[4 * k + m] =
                line[0] + line[1] * power[1][m] + line[2] * power[2][m] + line[3] * power[3][m];
    }

    const double *f = q->fourth[coordinate];
    double u2 = hu * hu, v2 = hv * hv, y = 2.0 * (du * hu + dv * hv);
    double taylor = (f[4] * u2 * u2 + f[0] * v2 * v2) / 24.0 +
                    (f[3] * u2 + f[1] * v2) * hu * hv / 6.0 + f[2] * u2 * v2 / 4.0;
    double rounding = 4.0 * q->slack[coordinate] * (1.0 + y * (1.0 + y * (0.5 + y / 6.0)));
    *rest = taylor * (1.0 + 0x1p-40) + rounding;
}
