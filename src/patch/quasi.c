// SPDX-License-Identifier: MIT
// Quasi-interpolating nets: rows, columns, second differences.
#include "patch/quasi.h"

double quasi_n_infinity(int degree) {
    int low = degree / 2;
    return (double)(low * (degree - low)) / (double)(2 * degree);
}

double quasi_z_infinity(int degree) {
    if (degree < 2)
        return 0.0;
    return degree == 2 ? 1.0 / 16.0 : quasi_n_infinity(degree) - 0.25;
}

// Multiplies a line of d + 1 numbers, `stride` apart, by M_d.
static void quasi_line(double *c, int d, int stride) {
    double before = c[0];
    for (int k = 1; k < d; k++) {
        double here = c[k * stride], after = c[(k + 1) * stride];
        c[k * stride] = 0.25 * (before + 2.0 * here + after);
        before = here;
    }
}

static void quasi_lines(double *p, int coords, int du, int dv) {
    int row = coords * (dv + 1);
    for (int k = 0; k < row; k++)
        quasi_line(p + k, du, row);
    for (int i = 0; i <= du; i++)
        for (int k = 0; k < coords; k++)
            quasi_line(p + i * row + k, dv, coords);
}

void quasi_net(const Bezier *patch, Bezier *net) {
    bezier_copy(net, patch);
    quasi_lines(&net->p[0].x, 3, net->du, net->dv);
}

void quasi_net2(const Bezier2 *patch, Bezier2 *net) {
    bezier2_restrict(patch, bezier_whole(), net); // a copy
    quasi_lines(&net->p[0].u, 2, net->du, net->dv);
}

// The cell of a parameter in a net of degree d, and the place within it.
static int cell_of(double t, int d, double *inside) {
    double at = t * d;
    int cell = (int)at;
    if (cell > d - 1)
        cell = d - 1;
    *inside = at - cell;
    return cell;
}

Vec3 quasi_eval(const Bezier *net, double u, double v) {
    double a, b;
    int i = cell_of(u, net->du, &a), j = cell_of(v, net->dv, &b);
    Vec3 low = vec_madd(vec_scale(bezier_at(net, i, j), 1.0 - b), b, bezier_at(net, i, j + 1));
    Vec3 high =
        vec_madd(vec_scale(bezier_at(net, i + 1, j), 1.0 - b), b, bezier_at(net, i + 1, j + 1));
    return vec_madd(vec_scale(low, 1.0 - a), a, high);
}

static Vec3 second_difference(Vec3 a, Vec3 b, Vec3 c) {
    return vec_sub(vec_sub(c, b), vec_sub(b, a));
}

static void note_difference(Vec3 d, double *length, Vec3 *axis) {
    *length = fmax(*length, vec_length(d));
    *axis = vec_max(*axis, vec3(fabs(d.x), fabs(d.y), fabs(d.z)));
}

QuasiDifferences quasi_differences(const Bezier *s) {
    QuasiDifferences most = {0.0, 0.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    for (int i = 1; i < s->du; i++)
        for (int j = 0; j <= s->dv; j++)
            note_difference(second_difference(bezier_at(s, i - 1, j), bezier_at(s, i, j),
                                              bezier_at(s, i + 1, j)),
                            &most.length_u, &most.axis_u);
    for (int i = 0; i <= s->du; i++)
        for (int j = 1; j < s->dv; j++)
            note_difference(second_difference(bezier_at(s, i, j - 1), bezier_at(s, i, j),
                                              bezier_at(s, i, j + 1)),
                            &most.length_v, &most.axis_v);
    return most;
}

double quasi_deviation(const Bezier *patch) {
    QuasiDifferences d = quasi_differences(patch);
    return quasi_z_infinity(patch->du) * d.length_u + quasi_z_infinity(patch->dv) * d.length_v;
}

Vec3 quasi_deviation_axes(const Bezier *patch) {
    QuasiDifferences d = quasi_differences(patch);
    return vec_madd(vec_scale(d.axis_u, quasi_z_infinity(patch->du)), quasi_z_infinity(patch->dv),
                    d.axis_v);
}

Vec2 quasi_deviation_axes2(const Bezier2 *s) {
    Vec2 along_u = {0.0, 0.0}, along_v = {0.0, 0.0};
    int row = s->dv + 1;
    for (int i = 0; i <= s->du; i++) {
        for (int j = 0; j <= s->dv; j++) {
            const Vec2 *c = &s->p[i * row + j];
            if (i > 0 && i < s->du) {
                along_u.u = fmax(along_u.u, fabs((c[row].u - c->u) - (c->u - c[-row].u)));
                along_u.v = fmax(along_u.v, fabs((c[row].v - c->v) - (c->v - c[-row].v)));
            }
            if (j > 0 && j < s->dv) {
                along_v.u = fmax(along_v.u, fabs((c[1].u - c->u) - (c->u - c[-1].u)));
                along_v.v = fmax(along_v.v, fabs((c[1].v - c->v) - (c->v - c[-1].v)));
            }
        }
    }
    double zu = quasi_z_infinity(s->du), zv = quasi_z_infinity(s->dv);
    return (Vec2){zu * along_u.u + zv * along_v.u, zu * along_u.v + zv * along_v.v};
}
