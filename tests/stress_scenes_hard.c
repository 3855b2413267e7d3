// SPDX-License-Identifier: MIT
// Scenes of stress_cases.h at the edge of what is a surface: lattices, points that are repeated,
// rulings, folds without noise, points where all derivatives vanish, sheets upon sheets.
#include "stress_cases.h"

static int whole(Rng *rng, int low, int high) {
    return low + (int)(rng_next(rng) % (uint64_t)(high - low + 1));
}

// Bi-degrees 1 to 4, all points in {-1,0,1}^3: half of them lie on others, sides are straight or
// points, tangents are along axes, and rays from points of the lattice meet all that exactly.
void scene_lattice(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    int du = whole(rng, 1, 4), dv = whole(rng, 1, 4);
    if (rng_next(rng) % 2)
        du = dv = 3;
    Vec3 *p = stress_add(s, du, dv);
    uint64_t flat = rng_next(rng) % 4;
    for (int k = 0; k < (du + 1) * (dv + 1); k++)
        p[k] = vec3(whole(rng, -1, 1), whole(rng, -1, 1), flat ? whole(rng, -1, 1) : 0.0);
}

// Any point may be a copy of any other.
void scene_repeated(StressScene *s, Rng *rng, double wild) {
    scene_random(s, rng, wild);
    Vec3 *p = (Vec3 *)s->defs[0].points;
    double share = rng_unit(rng);
    for (int k = 0; k < 16; k++)
        if (rng_unit(rng) < share)
            p[k] = p[whole(rng, 0, 15)];
}

// Each point has a size of its own, of so many decades.
void scene_uneven(StressScene *s, Rng *rng, double decades) {
    scene_random(s, rng, 0.4);
    Vec3 *p = (Vec3 *)s->defs[0].points;
    for (int k = 0; k < 16; k++)
        p[k] = vec_scale(p[k], pow(10.0, rng_range(rng, -decades, decades)));
}

// The patch once more, read in another order.
static void add_copy(StressScene *s, int from, bool back_u, bool back_v, bool swapped) {
    Vec3 *q = stress_add(s, 3, 3);
    const Vec3 *p = s->defs[from].points;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            int at = 4 * (back_u ? 3 - i : i) + (back_v ? 3 - j : j);
            q[swapped ? 4 * j + i : 4 * i + j] = p[at];
        }
}

void scene_coincident(StressScene *s, Rng *rng, double wild) {
    scene_random(s, rng, wild);
    for (int n = 0; n < 3; n++)
        add_copy(s, 0, rng_next(rng) % 2, rng_next(rng) % 2, rng_next(rng) % 2);
}

// Twelve sheets, each 1e-12 to 1e-3 above one of those before.
void scene_stack(StressScene *s, Rng *rng, double wild) {
    scene_random(s, rng, wild);
    for (int n = 1; n < 12; n++) {
        int below = whole(rng, 0, n - 1);
        Vec3 by = vec_scale(stress_direction(rng), pow(10.0, rng_range(rng, -12.0, -3.0)));
        add_copy(s, below, false, false, false);
        Vec3 *p = (Vec3 *)s->defs[n].points;
        for (int k = 0; k < 16; k++)
            p[k] = vec_add(p[k], by);
    }
}

static Vec3 few_bits(Rng *rng) {
    return vec3(whole(rng, -512, 512) / 256.0, whole(rng, -512, 512) / 256.0,
                whole(rng, -512, 512) / 256.0);
}

// A curve moved along a line (kind 0), or drawn together to a point (1), or to another curve (2): v
// is a ruling. Few bits, so that rulings are known exactly.
void scene_ruled(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 curve[4], other[4], apex = few_bits(rng), by = few_bits(rng);
    uint64_t kind = rng_next(rng) % 3;
    for (int i = 0; i < 4; i++) {
        curve[i] = few_bits(rng);
        other[i] = kind == 0 ? vec_add(curve[i], by) : kind == 1 ? apex : few_bits(rng);
    }
    // Thirds have no few bits; of 3 times a point they have.
    int dv = rng_next(rng) % 2 ? 1 : 3;
    Vec3 *p = stress_add(s, 3, dv);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j <= dv; j++)
            p[i * (dv + 1) + j] = vec_add(vec_scale(curve[i], 3.0 * (dv - j) / dv),
                                          vec_scale(other[i], 3.0 * j / dv));
}

// In a plane that no axis lies in: exactly, or as near as rounding leaves it.
void scene_tilted(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    bool exact = rng_next(rng) % 2;
    Vec3 *p = stress_add(s, 3, 3);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            double x = i + whole(rng, -32, 32) / 64.0, y = j + whole(rng, -32, 32) / 64.0;
            p[4 * i + j] = vec3(x, y, 0.5 * x - 0.25 * y + 1.0);
        }
    if (!exact)
        stress_turn(s, rng);
}

// All points are on one curve, and v does nothing; few bits.
void scene_curve(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 *p = stress_add(s, 3, 3), c[4];
    for (int i = 0; i < 4; i++)
        c[i] = few_bits(rng);
    bool along_u = rng_next(rng) % 2;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            p[4 * i + j] = c[along_u ? i : j];
}

// Bernstein coefficients over [-1,1] of 1, s, s^2, s^3, and of the Chebyshev cubic.
static const double POWER[4][4] = {
    {1, 1, 1, 1}, {-1, -1.0 / 3, 1.0 / 3, 1}, {1, -1.0 / 3, -1.0 / 3, 1}, {-1, 1, -1, 1}};
static const double FOLD[4] = {-1, 5, -5, 1};

// Folds at x = -1, 1 and y = -1, 1, exactly; where two of them cross four crossings are one.
void scene_folds(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    Vec3 *p = stress_add(s, 3, 3);
    double a = whole(rng, -4, 4), b = whole(rng, -4, 4);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            p[4 * i + j] = vec3(FOLD[i], FOLD[j], a * i / 2.0 + b * j / 2.0);
}

// Sum of c a^m b^n, in Bernstein coefficients: one coordinate.
typedef struct {
    double c;
    int m, n;
} Term;

static double coordinate(const Term *terms, int i, int j) {
    double sum = 0.0;
    for (int k = 0; k < 3; k++)
        sum += terms[k].c * POWER[terms[k].m][i] * POWER[terms[k].n][j];
    return sum;
}

// At a = b = 0, u = v = 1/2, all of the map across the z axis vanishes to first order or to more.
void scene_pinch(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    static const Term kinds[][3][3] = {
        // Whitney's umbrella: a line of crossings that ends in a point
        {{{1, 1, 0}}, {{1, 1, 1}}, {{1, 0, 2}}},
        // (a + i b)^2, (a + i b)^3: two and three sheets around one point
        {{{1, 2, 0}, {-1, 0, 2}}, {{2, 1, 1}}, {{1, 1, 0}}},
        {{{1, 3, 0}, {-3, 1, 2}}, {{3, 2, 1}, {-1, 0, 3}}, {{1, 1, 0}}},
        // a cube both ways
        {{{1, 3, 0}}, {{1, 0, 3}}, {{1, 1, 1}}},
        // all three at once
        {{{1, 3, 0}}, {{1, 0, 3}}, {{1, 2, 2}}},
        // cusps' line that ends: a swallow's tail
        {{{1, 3, 0}, {1, 1, 1}}, {{1, 0, 1}}, {{1, 2, 0}, {0.5, 2, 1}}},
    };
    const Term(*kind)[3] = kinds[rng_next(rng) % (sizeof kinds / sizeof *kinds)];
    Vec3 *p = stress_add(s, 3, 3);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            p[4 * i + j] = vec3(coordinate(kind[0], i, j), coordinate(kind[1], i, j),
                                coordinate(kind[2], i, j));
    if (rng_next(rng) % 2)
        stress_turn(s, rng);
}

// Eight patches that are a sphere, each with a side that is a point.
void scene_sphere(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    static const double x[3] = {1, 1, 0}, y[3] = {0, 1, 1};
    double weight[3] = {1.0, sqrt(0.5), 1.0}, radius = pow(10.0, rng_range(rng, -3.0, 3.0));
    Vec3 middle = vec_scale(stress_direction(rng), rng_next(rng) % 2 ? 0.0 : 1.0);
    for (int n = 0; n < 8; n++) {
        Vec3 *p = stress_add(s, 2, 2);
        double *weights = ARENA_ARRAY(s->arena, double, 9);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                double a = x[j] * x[i], b = x[j] * y[i], c = y[j];
                Vec3 q = vec3(n & 1 ? -a : a, n & 2 ? -b : b, n & 4 ? -c : c);
                p[3 * i + j] = vec_madd(middle, radius, q);
                weights[3 * i + j] = weight[i] * weight[j];
            }
        s->defs[s->count - 1].weights = weights;
    }
}

// 1e-3 to 1 in size, `offset` away: few digits are left.
void scene_far_small(StressScene *s, Rng *rng, double offset) {
    scene_random(s, rng, 0.4);
    double size = pow(10.0, rng_range(rng, -3.0, 0.0));
    stress_move(s, size, vec3(offset, -0.7 * offset, offset / 3.0));
}

void scene_far_mesh(StressScene *s, Rng *rng, double offset) {
    scene_mesh(s, rng, 0.1);
    stress_move(s, 1.0, vec3(offset, -0.7 * offset, offset / 3.0));
}

// Any of all these, of any size, anywhere.
void scene_any(StressScene *s, Rng *rng, double unused) {
    (void)unused;
    static const struct {
        void (*make)(StressScene *, Rng *, double);
        double parameter;
    } kinds[] = {
        {scene_random, 0.5},       {scene_mesh, 0.1},       {scene_collapsed, 0},
        {scene_double_rows, 0},    {scene_cusp, 0},         {scene_self_crossing, 0},
        {scene_twisted, 0},        {scene_fold9, 0},        {scene_line18, 0},
        {scene_aspect, 1e5},       {scene_lattice, 0},      {scene_repeated, 0.3},
        {scene_uneven, 3},         {scene_coincident, 0.3}, {scene_stack, 0.2},
        {scene_ruled, 0},          {scene_tilted, 0},       {scene_folds, 0},
        {scene_pinch, 0},          {scene_sphere, 0},       {scene_rational, 1},
        {scene_thin_sheets, 1e-9}, {scene_round, 0},        {scene_segment, 0},
    };
    size_t k = rng_next(rng) % (sizeof kinds / sizeof *kinds);
    kinds[k].make(s, rng, kinds[k].parameter);
    double size = rng_next(rng) % 2 ? 1.0 : pow(10.0, rng_range(rng, -30.0, 30.0));
    double away = rng_next(rng) % 2 ? 0.0 : size * pow(10.0, rng_range(rng, -3.0, 7.0));
    stress_move(s, size, vec_scale(stress_direction(rng), away));
}
