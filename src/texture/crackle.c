// SPDX-License-Identifier: MIT
// Crackle: the distances to the nearest of points strewn one a cell (facts: textures 2.2). The 81
// cells looked at are those of the 5 x 5 x 5 block that could hold one of the three nearest.
#include "texture/formula.h"
#include "noise/noise.h"

#include <math.h>

// A distance that grows with the real one and costs no root.
static double measure(double metric, Vec3 d) {
    if (metric == 2.0)
        return d.x * d.x + d.y * d.y + d.z * d.z;
    if (metric == 1.0)
        return fabs(d.x) + fabs(d.y) + fabs(d.z);
    return pow(fabs(d.x), metric) + pow(fabs(d.y), metric) + pow(fabs(d.z), metric);
}

// The same as far as it may be below `most`; else some number that is not. A sum of numbers that
// are not negative is no less than the first, so that two of three powers are often spared.
static double measure_below(double metric, Vec3 d, double most) {
    if (metric == 2.0 || metric == 1.0 || !(metric > 0.0))
        return measure(metric, d);
    double s = pow(fabs(d.x), metric);
    if (s >= most)
        return s;
    s += pow(fabs(d.y), metric);
    return s >= most ? s : s + pow(fabs(d.z), metric);
}

static double rooted(double metric, double s) {
    return metric == 2.0 ? sqrt(s) : metric == 1.0 ? s : pow(s, 1.0 / metric);
}

typedef struct {
    double s[3]; // the three smallest, ascending
    Vec3 site;   // of the smallest
} Nearest;

static void keep(Nearest *nearest, double s, Vec3 site) {
    double *t = nearest->s;
    if (s < t[0]) {
        t[2] = t[1], t[1] = t[0], t[0] = s;
        nearest->site = site;
    } else if (s < t[1]) {
        t[2] = t[1], t[1] = s;
    } else if (s < t[2]) {
        t[2] = s;
    }
}

static Vec3 site_of(int x, int y, int z) {
    uint32_t i = noise_cell(x, y, z);
    return vec3(x + noise_random(i), y + noise_random(i + 1), z + noise_random(i + 2));
}

Vec3 crackle_site(Vec3 p) {
    double x = floor(p.x - FORMULA_EPS), y = floor(p.y - FORMULA_EPS), z = floor(p.z - FORMULA_EPS);
    uint32_t i = noise_cell(noise_int(x), noise_int(y), noise_int(z));
    return vec3(x + noise_random(i), y + noise_random(i + 1), z + noise_random(i + 2));
}

// From the cell at hand outwards, so that most of the others are too far away from the start.
static const int ORDER_OUT[5] = {0, -1, 1, -2, 2};

// The least that measure() can give along one axis for sites of the five cells, in that order:
// x is the cell's side, p the point. Rounding keeps order, so that no site comes out nearer.
static void least_measures(double metric, double x, double p, double least[5]) {
    for (int k = 0; k < 5; k++) {
        int step = ORDER_OUT[k];
        double d = step > 0 ? (x + step) - p : step < 0 ? p - (x + step + 1) : 0.0;
        d = d > 0.0 ? d : 0.0;
        // Powers keep order but for their error, less than 2^-52 of each.
        least[k] = metric == 2.0   ? d * d
                   : metric == 1.0 ? d
                   : metric > 0.0  ? pow(d, metric) * (1.0 - 0x1p-48)
                                   : 0.0;
    }
}

static Nearest nearest_sites(double metric, Vec3 p) {
    // Cells so far away that they are no int share one; a step of 2 from them must still be one.
    const double far = 2147483640.0;
    int x = (int)fmax(-far, fmin(far, floor(p.x - FORMULA_EPS)));
    int y = (int)fmax(-far, fmin(far, floor(p.y - FORMULA_EPS)));
    int z = (int)fmax(-far, fmin(far, floor(p.z - FORMULA_EPS)));
    Nearest nearest = {{INFINITY, INFINITY, INFINITY}, {0, 0, 0}};
    double least_x[5], least_y[5], least_z[5];
    least_measures(metric, x, p.x, least_x);
    least_measures(metric, y, p.y, least_y);
    least_measures(metric, z, p.z, least_z);
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 5; j++) {
            if ((i > 2) + (j > 2) > 1 || least_x[i] + least_y[j] > nearest.s[2])
                continue;
            for (int k = 0; k < 5; k++) {
                if ((i > 2) + (j > 2) + (k > 2) > 1 ||
                    least_x[i] + least_y[j] + least_z[k] > nearest.s[2])
                    continue;
                Vec3 site = site_of(x + ORDER_OUT[i], y + ORDER_OUT[j], z + ORDER_OUT[k]);
                keep(&nearest, measure_below(metric, vec_sub(site, p), nearest.s[2]), site);
            }
        }
    return nearest;
}

double crackle_value(const CrackleShape *shape, Vec3 p, int generator) {
    double metric = shape->metric;
    Nearest nearest = nearest_sites(metric, p);
    double value;
    if (shape->solid) {
        value = noise_value(nearest.site, generator);
    } else {
        double d[3];
        for (int i = 0; i < 3; i++) {
            double s = nearest.s[i];
            if (shape->offset != 0.0)
                s += metric == 2.0   ? shape->offset * shape->offset
                     : metric == 1.0 ? shape->offset
                                     : pow(shape->offset, metric);
            d[i] = rooted(metric, s);
        }
        value = shape->form.x * d[0] + shape->form.y * d[1] + shape->form.z * d[2];
    }
    return value < 0.0 ? 0.0 : value > 1.0 ? 1.0 : value;
}
