// SPDX-License-Identifier: MIT
// Scenes of stress_cases.h.
#include "stress_cases.h"

#include "ray_oracle.h"

#include "base/diag.h"

#include <stdio.h>
#include <string.h>

Vec3 *stress_add(StressScene *s, int du, int dv) {
    if (s->count == s->capacity) {
        int capacity = s->capacity ? 2 * s->capacity : 64;
        PatchDef *defs = ARENA_ARRAY(s->arena, PatchDef, (size_t)capacity);
        if (s->count)
            memcpy(defs, s->defs, (size_t)s->count * sizeof *defs);
        s->defs = defs;
        s->capacity = capacity;
    }
    Vec3 *points = ARENA_ARRAY(s->arena, Vec3, (size_t)((du + 1) * (dv + 1)));
    s->defs[s->count] = (PatchDef){.degree_u = (uint32_t)du,
                                   .degree_v = (uint32_t)dv,
                                   .points = points,
                                   .id = (uint32_t)s->count,
                                   .mask = 1,
                                   .u_steps = 5,
                                   .v_steps = 5};
    s->count++;
    return points;
}

static Vec3 *points_of(const StressScene *s, int patch) { return (Vec3 *)s->defs[patch].points; }

static int count_of(const StressScene *s, int patch) {
    return (int)((s->defs[patch].degree_u + 1) * (s->defs[patch].degree_v + 1));
}

// A sheet over [0,1]^2 with noise.
static Vec3 *add_sheet(StressScene *s, Rng *rng, int du, int dv, double wild) {
    Vec3 *p = stress_add(s, du, dv);
    for (int i = 0; i <= du; i++)
        for (int j = 0; j <= dv; j++)
            p[i * (dv + 1) + j] = vec3((double)i / du + wild * rng_range(rng, -1.0, 1.0),
                                       (double)j / dv + wild * rng_range(rng, -1.0, 1.0),
                                       (0.3 + wild) * rng_range(rng, -1.0, 1.0));
    return p;
}

void stress_turn(StressScene *s, Rng *rng) {
    Vec3 a = vec_normalize(stress_direction(rng)), b = stress_direction(rng);
    b = vec_normalize(vec_madd(b, -vec_dot(a, b), a));
    Vec3 c = vec_cross(a, b);
    for (int n = 0; n < s->count; n++) {
        Vec3 *p = points_of(s, n);
        for (int k = 0; k < count_of(s, n); k++)
            p[k] = vec_madd(vec_madd(vec_scale(a, p[k].x), p[k].y, b), p[k].z, c);
    }
}

void stress_move(StressScene *s, double scale, Vec3 offset) {
    for (int n = 0; n < s->count; n++) {
        Vec3 *p = points_of(s, n);
        for (int k = 0; k < count_of(s, n); k++)
            p[k] = vec_add(vec_scale(p[k], scale), offset);
    }
}

static void load_teapot(StressScene *s, double scale, Vec3 offset) {
    static Vec3 teapot[32 * 16];
    static int loaded;
#pragma omp critical(stress_teapot)
    if (!loaded) {
        FILE *f = fopen("scenes/teapot/teapot_patches.inc", "r");
        if (!f)
            die("scenes/teapot/teapot_patches.inc: run from the project's folder");
        char line[1000];
        int count = 0;
        while (fgets(line, sizeof line, f)) {
            if (strstr(line, "//"))
                continue;
            for (char *p = line; (p = strchr(p, '<')) != NULL; p++) {
                Vec3 q;
                if (sscanf(p, "<%lf, %lf, %lf>", &q.x, &q.y, &q.z) == 3 && count < 32 * 16)
                    teapot[count++] = q;
            }
        }
        fclose(f);
        if (count != 32 * 16)
            die("scenes/teapot/teapot_patches.inc: %d points", count);
        loaded = 1;
    }
    for (int n = 0; n < 32; n++) {
        Vec3 *p = stress_add(s, 3, 3);
        for (int k = 0; k < 16; k++)
            p[k] = vec_add(vec_scale(teapot[16 * n + k], scale), offset);
    }
}

void scene_teapot(StressScene *s, Rng *rng, double scale) {
    (void)rng;
    load_teapot(s, scale, vec3(0.0, 0.0, 0.0));
}

void scene_pot(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    scene_teapot(s, rng, 1.0);
}

void scene_sheet(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    scene_random(s, rng, 0.4);
}

void scene_teapot_moved(StressScene *s, Rng *rng, double offset) {
    (void)rng;
    load_teapot(s, 1.0, vec3(offset, -offset, offset / 3.0));
}

void scene_random(StressScene *s, Rng *rng, double wild) {
    add_sheet(s, rng, 3, 3, wild * rng_unit(rng));
    stress_turn(s, rng);
}

void scene_degrees(StressScene *s, Rng *rng, double wild) {
    int du = 1 + (int)(rng_next(rng) % 16), dv = 1 + (int)(rng_next(rng) % 16);
    if (rng_next(rng) % 2) // mostly small ones
        du = 1 + du % 6, dv = 1 + dv % 6;
    add_sheet(s, rng, du, dv, wild * rng_unit(rng));
    stress_turn(s, rng);
}

// 3 x 3 patches of different bi-degrees that share their sides exactly: one of degree 3 all along.
void scene_mesh(StressScene *s, Rng *rng, double wild) {
    Vec3 grid[10][10];
    for (int i = 0; i < 10; i++)
        for (int j = 0; j < 10; j++)
            grid[i][j] = vec3(i / 3.0 + wild * rng_range(rng, -1, 1),
                              j / 3.0 + wild * rng_range(rng, -1, 1), rng_range(rng, -1, 1));
    for (int n = 0; n < 9; n++) {
        Vec3 *p = stress_add(s, 3, 3);
        bool turned = rng_next(rng) % 2; // u and v swapped: the side is read the other way
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                p[turned ? 4 * (3 - j) + i : 4 * i + j] = grid[3 * (n / 3) + i][3 * (n % 3) + j];
    }
}

// Coordinates with few bits, so that rays can be aimed at them without any rounding.
static Vec3 dyadic(Rng *rng) {
    return vec3((double)(rng_next(rng) % 2048) / 256.0 - 4.0,
                (double)(rng_next(rng) % 2048) / 256.0 - 4.0,
                (double)(rng_next(rng) % 2048) / 256.0 - 4.0);
}

void scene_point(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 *p = stress_add(s, 3, 3), at = dyadic(rng);
    for (int k = 0; k < 16; k++)
        p[k] = at;
}

void scene_segment(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 *p = stress_add(s, 3, 3), a = dyadic(rng), b = dyadic(rng);
    bool plain = rng_next(rng) % 2; // else back and forth
    for (int k = 0; k < 16; k++) {
        double share = plain ? (double)(k / 4 + k % 4) / 8.0 : (double)(rng_next(rng) % 33) / 32.0;
        p[k] = vec_add(a, vec_scale(vec_sub(b, a), share));
    }
    p[0] = a;
    p[15] = b;
}

void scene_flat(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 *p = add_sheet(s, rng, 3, 3, 0.05);
    for (int k = 0; k < 16; k++)
        p[k].z = 0.25;
    s->detail = 0.25;
}

// z = x y + linear, exactly: all rulings are straight lines with few bits.
void scene_saddle(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    bool cubic = rng_next(rng) % 2;
    int d = cubic ? 3 : 1;
    Vec3 *p = stress_add(s, d, d);
    // Corners (i, j) of [0,3]^2: thirds of a cubic fall on whole numbers.
    for (int i = 0; i <= d; i++)
        for (int j = 0; j <= d; j++) {
            double x = 3.0 * i / d, y = 3.0 * j / d;
            p[i * (d + 1) + j] = vec3(x, y, 0.25 * x * y);
        }
}

void scene_thin_sheets(StressScene *s, Rng *rng, double gap) {
    Vec3 *p = add_sheet(s, rng, 3, 3, 0.2 * rng_unit(rng)), *q = stress_add(s, 3, 3);
    for (int k = 0; k < 16; k++)
        q[k] = vec3(p[k].x, p[k].y, p[k].z + gap);
    s->detail = gap;
}

// Bernstein coefficients of the Chebyshev cubic: three passes over [-1,1].
static const double THRICE[4] = {-1.0, 5.0, -5.0, 1.0};

void scene_fold9(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 *p = stress_add(s, 3, 3);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            p[4 * i + j] = vec3(THRICE[i] + 0.05 * rng_unit(rng), THRICE[j] + 0.05 * rng_unit(rng),
                                i / 3.0 + 4.0 * j / 3.0);
}

// With a = T3(u), b = T3(v): x = a - b, y = a b - 1/4 vanish together at a = b = +-1/2, each of
// which nine (u,v) have: 18 crossings, as many as two curves of bi-degree (3,3) can have.
void scene_line18(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 *p = stress_add(s, 3, 3);
    double tilt = rng_range(rng, -1.0, 1.0);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            p[4 * i + j] = vec3(THRICE[i] - THRICE[j], THRICE[i] * THRICE[j] - 0.25,
                                2.0 * i / 3.0 + 7.0 * j / 3.0 + tilt * (THRICE[i] - THRICE[j]));
}

void scene_double_rows(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 *p = add_sheet(s, rng, 3, 3, 0.1);
    uint64_t which = rng_next(rng) % 15 + 1;
    for (int k = 0; k < 4; k++) {
        if (which & 1)
            p[4 + k] = p[k];
        if (which & 2)
            p[8 + k] = p[12 + k];
        if (which & 4)
            p[4 * k + 1] = p[4 * k];
        if (which & 8)
            p[4 * k + 2] = p[4 * k + 3];
    }
    stress_turn(s, rng);
}

void scene_aspect(StressScene *s, Rng *rng, double ratio) {
    Vec3 *p = add_sheet(s, rng, 3, 3, 0.1);
    uint64_t axis = rng_next(rng) % 6;
    Vec3 stretch = axis == 0   ? vec3(ratio, 1, 1)
                   : axis == 1 ? vec3(1, ratio, 1)
                   : axis == 2 ? vec3(1, 1, ratio)
                   : axis == 3 ? vec3(1 / ratio, 1, 1)
                   : axis == 4 ? vec3(1, 1 / ratio, 1)
                               : vec3(1, 1, 1 / ratio);
    for (int k = 0; k < 16; k++)
        p[k] = vec_mul(p[k], stretch);
}

// All that is above, and below, stretched: also along a direction that is no axis, so that all
// three coordinates have the rounding of the longest.
void scene_ribbon(StressScene *s, Rng *rng, double ratio) {
    static void (*const kinds[])(StressScene *, Rng *, double) = {
        scene_random,        scene_twisted,   scene_cusp,
        scene_self_crossing, scene_collapsed, scene_double_rows};
    kinds[rng_next(rng) % (sizeof kinds / sizeof *kinds)](s, rng, 0.3);
    double by[3] = {ratio, 1.0, 1.0};
    uint64_t kind = rng_next(rng) % 4;
    if (kind == 1)
        by[1] = ratio; // a sheet thinner than it is wide
    else if (kind == 2)
        by[1] = sqrt(ratio);
    for (int k = 2; k > 0; k--) {
        int other = (int)(rng_next(rng) % (uint64_t)(k + 1));
        double swap = by[k];
        by[k] = by[other], by[other] = swap;
    }
    for (int k = 0; k < count_of(s, 0); k++)
        points_of(s, 0)[k] = vec_mul(points_of(s, 0)[k], vec3(by[0], by[1], by[2]));
    if (rng_next(rng) % 2)
        stress_turn(s, rng);
}

void scene_ribbon10(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    scene_ribbon(s, rng, 1e10);
}

// x = s^3 over z = s^2 along u: a cusp along v, bent a little.
void scene_cusp(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    static const double cube[4] = {-1.0, 1.0, -1.0, 1.0},
                        square[4] = {1.0, -1.0 / 3, -1.0 / 3, 1.0};
    Vec3 *p = stress_add(s, 3, 3);
    double bend = rng_range(rng, -0.2, 0.2);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            p[4 * i + j] = vec3(cube[i] + bend * j * j, j / 3.0, square[i]);
    if (rng_next(rng) % 2)
        stress_turn(s, rng);
}

// A loop along u that crosses itself, swept along v.
void scene_self_crossing(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    static const double x[4] = {0, 1.5, -0.5, 1}, z[4] = {0, 1, 1, 0};
    Vec3 *p = stress_add(s, 3, 3);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            p[4 * i + j] = vec3(x[i] + 0.05 * rng_unit(rng), j / 3.0 + 0.05 * rng_unit(rng),
                                z[i] + 0.05 * rng_unit(rng));
    stress_turn(s, rng);
}

// Inner points beyond the far corner: the sheet is turned inside out near one corner, or all.
void scene_twisted(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 *p = add_sheet(s, rng, 3, 3, 0.05);
    static const int inner[4] = {5, 6, 9, 10}, corner[4] = {0, 3, 12, 15};
    for (int k = 0; k < 4; k++)
        if (k == 0 || rng_next(rng) % 2) {
            Vec3 out = vec_sub(p[corner[k]], p[inner[k]]);
            p[inner[k]] = vec_madd(p[inner[k]], rng_range(rng, 1.5, 4.0), out);
        }
    stress_turn(s, rng);
}

// Sides and corners that are points, in all the ways that modellers make triangles and leaves.
void scene_collapsed(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 *p = add_sheet(s, rng, 3, 3, 0.1);
    uint64_t kind = rng_next(rng) % 5;
    for (int k = 0; k < 4; k++) {
        if (kind == 0 || kind == 1)
            p[k] = p[0]; // one side
        if (kind == 1)
            p[12 + k] = p[12]; // and the opposite one
        if (kind == 2)
            p[4 * k] = p[0], p[k] = p[0]; // two neighbours: a corner of six
    }
    if (kind == 3) // a corner with its neighbours
        p[1] = p[4] = p[5] = p[0];
    if (kind == 4) // both corners on one point
        p[12] = p[0];
    stress_turn(s, rng);
}

// The first half of a cubic.
static void first_half(const Vec3 curve[4], Vec3 out[4]) {
    Vec3 c[4] = {curve[0], curve[1], curve[2], curve[3]};
    for (int k = 0; k < 4; k++) {
        out[k] = c[0];
        for (int i = 0; i < 3 - k; i++)
            c[i] = vec_scale(vec_add(c[i], c[i + 1]), 0.5);
    }
}

// A side of one patch against two half as long. Few bits, so that the halves are exact.
void scene_t_junction(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 *p = add_sheet(s, rng, 3, 3, 0.1);
    for (int j = 0; j < 4; j++) {
        Vec3 at = dyadic(rng);
        p[12 + j] = vec3(1.0, (double)j, 0.125 * at.z);
    }
    for (int half = 0; half < 2; half++) {
        Vec3 side[4], out[4], *q = stress_add(s, 3, 3);
        for (int j = 0; j < 4; j++)
            side[j] = p[12 + (half ? 3 - j : j)];
        first_half(side, out);
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                q[4 * i + j] =
                    i == 0 ? out[j]
                           : vec_add(out[j], vec3(i / 3.0, 0.05 * rng_unit(rng), rng_unit(rng)));
    }
}

void scene_scaled(StressScene *s, Rng *rng, double scale) {
    add_sheet(s, rng, 3, 3, 0.3 * rng_unit(rng));
    stress_turn(s, rng);
    stress_move(s, scale, vec3(0, 0, 0));
}

// Weights between 10^-decades and 10^decades.
void scene_rational(StressScene *s, Rng *rng, double decades) {
    int du = 1 + (int)(rng_next(rng) % 4), dv = 1 + (int)(rng_next(rng) % 4);
    add_sheet(s, rng, du, dv, 0.3 * rng_unit(rng));
    double *weights = ARENA_ARRAY(s->arena, double, (size_t)count_of(s, 0));
    for (int k = 0; k < count_of(s, 0); k++)
        weights[k] = pow(10.0, rng_range(rng, -decades, decades));
    s->defs[0].weights = weights;
    stress_turn(s, rng);
}

// A quarter of a torus's outside, exactly round both ways: weights 1, 1/sqrt(2), 1.
void scene_round(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    static const double x[3] = {1, 1, 0}, y[3] = {0, 1, 1};
    double weight[3] = {1.0, sqrt(0.5), 1.0}, minor = rng_range(rng, 0.1, 1.0);
    Vec3 *p = stress_add(s, 2, 2);
    double *weights = ARENA_ARRAY(s->arena, double, 9);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double r = 1.0 + minor * x[j];
            p[3 * i + j] = vec3(r * x[i], r * y[i], minor * y[j]);
            weights[3 * i + j] = weight[i] * weight[j];
        }
    }
    s->defs[0].weights = weights;
    stress_turn(s, rng);
}

void scene_mixed_sizes(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    for (int n = 0; n < 5; n++) {
        Vec3 *p = add_sheet(s, rng, 3, n == 1 ? 7 : 3, 0.1);
        double scale = pow(10.0, 3 * n - 6);
        for (int k = 0; k < count_of(s, n); k++)
            p[k] = vec_scale(vec_add(p[k], vec3(-0.5, -0.5, 2.0 * n)), scale);
    }
}

// A lattice of teapots, each patch jittered as a whole so that none are equal.
void scene_many(StressScene *s, Rng *rng, double teapots) {
    int side = (int)ceil(cbrt(teapots));
    for (int n = 0; n < (int)teapots; n++) {
        int first = s->count;
        load_teapot(s, 1.0,
                    vec3(8.0 * (n % side), 6.0 * (n / side % side), 6.0 * (n / side / side)));
        for (int k = first; k < s->count; k++) {
            Vec3 by = vec_scale(stress_direction(rng), 1e-3);
            for (int i = 0; i < 16; i++)
                points_of(s, k)[i] = vec_add(points_of(s, k)[i], by);
        }
    }
}

Vec3 stress_direction(Rng *rng) {
    for (;;) {
        Vec3 d = vec3(rng_range(rng, -1, 1), rng_range(rng, -1, 1), rng_range(rng, -1, 1));
        double length = vec_length(d);
        if (length > 0.1 && length < 1.0)
            return vec_scale(d, 1.0 / length);
    }
}

Vec3 stress_point(const StressScene *s, int patch, double u, double v, Vec3 *su, Vec3 *sv) {
    Vec3 jet[3];
    ray_oracle_jet(&s->defs[patch], u, v, jet);
    if (su)
        *su = jet[1];
    if (sv)
        *sv = jet[2];
    return jet[0];
}
