// SPDX-License-Identifier: MIT
// With (s, t) in [-1,1]^2 over the part, c its middle and h its half sizes, Taylor says
//     S = sum over i + j <= 3 of T_ij s^i t^j + R,    T_ij = hu^i hv^j S_(i,j)(c) / (i! j!),
//     |R| <= sum over i + j = 4 of hu^i hv^j max |S_(i,j)| / (i! j!).
// T_ij comes from the patch's whole net, so nothing has to be made for the part but weights; the
// largest fourth derivatives over all of the patch would be far too large.
// R's derivative along s is the same sum with each term times i, that along t times j: 4 times the
// bound in all, and twice that along parameters that run from 0 to 1.
//
// A fourth derivative of a Bézier patch lies within its fourth differences times d!/(d-i)!. Of the
// net's rounding e the derivative of order i, j gets (2 du)^i (2 dv)^j e at most, and as much by
// its own evaluation; over all T_ij that is e times the first terms of exp(2 du hu + 2 dv hv).
#include "patch/qi_local.h"

#include "patch/qi_bound.h"

bool qi_local_pays(int du, int dv) { return (du + 1) * (dv + 1) >= 24; }

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

void qi_local_fourth(const Bezier *part, double error, float most[3][5]) {
    double net[BEZIER_MAX_POINTS], fourth[5];
    for (int k = 0; k < 3; k++) {
        for (int n = 0; n < bezier_count(part); n++)
            net[n] = vec_get(part->p[n], k);
        fourth_differences(net, part->du, part->dv, fourth);
        for (int i = 0; i <= 4; i++) {
            // 16 points' rounding, and as much of the differences.
            double bound =
                falling(part->du, i) * falling(part->dv, 4 - i) * (fourth[i] + 32.0 * error);
            bound = bound * (1.0 + 0x1p-20) + (double)FLT_MIN;
            most[k][i] = bound < (double)FLT_MAX ? (float)bound : INFINITY;
        }
    }
}

// Of the frame's coordinates, which are linear functions of space.
static bool known_fourth(QiLocal *local, const QiFrame *frame, const QiFourth *known) {
    local->over = known->over;
    for (int k = 0; k < 3; k++) {
        const Vec3 axis = frame->axes[k];
        for (int i = 0; i <= 4; i++) {
            double bound = fabs(axis.x) * (double)known->most[0][i] +
                           fabs(axis.y) * (double)known->most[1][i] +
                           fabs(axis.z) * (double)known->most[2][i];
            local->fourth[k][i] = ldexp(bound * (1.0 + 0x1p-40), frame->exponent);
            if (!isfinite(local->fourth[k][i]))
                return false;
        }
    }
    return true;
}

static void own_fourth(QiLocal *local, BezierRect rect) {
    int du = local->du, dv = local->dv;
    const double *nets[3] = {local->net->x, local->net->y, local->net->z};
    Bezier part = {.du = du, .dv = dv};
    local->over = rect;
    for (int n = 0; n < bezier_count(&part); n++)
        part.p[n] = vec3(nets[0][n], nets[1][n], nets[2][n]);
    bezier_restrict(&part, rect, &part);
    for (int k = 0; k < 3; k++) {
        float most[3][5];
        qi_local_fourth(&part, local->slack[k], most);
        for (int i = 0; i <= 4; i++)
            local->fourth[k][i] = (double)most[k][i];
    }
}

bool qi_local_init(QiLocal *local, const QiTarget *target, BezierRect rect,
                   const QiFourth *fourth) {
    if (target->rational || !qi_local_pays(target->du, target->dv) ||
        !(rect.u0 < rect.u1 && rect.v0 < rect.v1))
        return false;
    const QiFrame *frame = &target->frame;
    local->made = false;
    local->du = target->du;
    local->dv = target->dv;
    local->net = &target->whole;
    local->slack[0] = frame->slack_x;
    local->slack[1] = frame->slack_y;
    local->slack[2] = frame->slack_z;
    if (fourth)
        return known_fourth(local, frame, fourth);
    own_fourth(local, rect);
    return true;
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

// A coordinate of the bicubic over `from`.
static void make_cubic(const QiLocal *q, int coordinate, double out[16], double *rest) {
    int du = q->du, dv = q->dv;
    const double *p = coordinate == 0 ? q->net->x : coordinate == 1 ? q->net->y : q->net->z;
    const double *wu = q->u, *wv = q->v;
    double hu = 0.5 * (q->from.u1 - q->from.u0), hv = 0.5 * (q->from.v1 - q->from.v0);
    // t[a][0] has T_a0 and T_a1, t[a][1] has T_a2 and T_a3; those of higher orders are left out.
    Lanes2 t[4][2] = {{{0.0}}};
    for (int i = 0; i <= du; i++, p += dv + 1) {
        Lanes2 low = {0.0}, high = {0.0};
        for (int j = 0; j <= dv; j++) {
            low += p[j] * lanes2_load(wv + 4 * j);
            high += p[j] * lanes2_load(wv + 4 * j + 2);
        }
        for (int a = 0; a < 4; a++)
            t[a][0] += wu[4 * i + a] * low;
        for (int a = 0; a < 2; a++)
            t[a][1] += wu[4 * i + a] * high;
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
                line[b] += t[a][b / 2][b % 2] * power[a][k];
        for (int m = 0; m < 4; m++)
            out[4 * k + m] =
                line[0] + line[1] * power[1][m] + line[2] * power[2][m] + line[3] * power[3][m];
    }

    const double *f = q->fourth[coordinate];
    double a = hu / (q->over.u1 - q->over.u0), b = hv / (q->over.v1 - q->over.v0);
    double a2 = a * a, b2 = b * b, y = 2.0 * (du * hu + dv * hv);
    double taylor = (f[4] * a2 * a2 + f[0] * b2 * b2) / 24.0 +
                    (f[3] * a2 + f[1] * b2) * a * b / 6.0 + f[2] * a2 * b2 / 4.0;
    double rounding = 4.0 * q->slack[coordinate] * (1.0 + y * (1.0 + y * (0.5 + y / 6.0)));
    *rest = taylor * (1.0 + 0x1p-40) + rounding;
}

static bool holds(BezierRect a, BezierRect b) {
    return a.u0 <= b.u0 && a.u1 >= b.u1 && a.v0 <= b.v0 && a.v1 >= b.v1;
}

void qi_local_part(QiLocal *q, BezierRect rect, QiLocalPart *part) {
    BezierRect from = q->from;
    if (!q->made || !holds(from, rect)) {
        double hu = 0.5 * (rect.u1 - rect.u0), hv = 0.5 * (rect.v1 - rect.v0);
        taylor_weights(q->du, rect.u0 + hu, hu, q->u);
        taylor_weights(q->dv, rect.v0 + hv, hv, q->v);
        q->from = from = rect;
        q->made = true;
        q->has[0] = q->has[1] = q->has[2] = false;
    }
    part->whole = holds(rect, from);
    if (part->whole)
        return;
    double width = from.u1 - from.u0, height = from.v1 - from.v0;
    restriction(part->u, 4, 1, 3, (rect.u0 - from.u0) / width, (rect.u1 - from.u0) / width);
    restriction(part->v, 1, 4, 3, (rect.v0 - from.v0) / height, (rect.v1 - from.v0) / height);
}

void qi_local_forget(QiLocal *local) { local->made = false; }

void qi_local_cut(QiLocal *q, const QiLocalPart *part, int k, double out[16], double *rest) {
    if (!q->has[k]) {
        make_cubic(q, k, q->cubic[k], &q->rest[k]);
        q->has[k] = true;
    }
    *rest = q->rest[k];
    if (part->whole) {
        memcpy(out, q->cubic[k], sizeof q->cubic[k]);
        return;
    }
    restrict_axis(q->cubic[k], part->u, part->v, 3, 3, out);
    *rest += 2.0 * q->slack[k]; // so that 8 hold the rounding of slopes, 12 slacks, as well
}
