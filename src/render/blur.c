// SPDX-License-Identifier: MIT
// A pixel's rays start at points of the lens, moved by a jitter that depends on the place, and meet
// where the camera is sharp. They come in batches; after each a test of the variance of their mean
// may end the pixel. Nothing is random, so that the picture is POV-Ray's.
#include "render/blur.h"

#include <math.h>

enum { PIXEL_GRID = 16 }; // a sample's place in its pixel is a cell of this grid

struct Blur {
    const Camera *camera;
    const Vec2 *points;      // of the lens, -0.5 to 0.5
    const double *threshold; // by the number of samples - 1: variances below it are good enough
    const int *batches;      // ended by 0; then batches of 4
    double jitter;
    Vec3 across, along; // unit vectors of the lens
    double reach;       // focal distance in lengths of the camera's direction
};

// ---- the chi-square distribution ----------------------------------------------------------------

// log Gamma(a) for whole and half a. POV-Ray's has an error at the halves below 13, which its
// pictures show: tests of an odd number of samples end sooner or later than they should.
static double log_gamma(double a) {
    const double error = 0.0395695996574004;
    return lgamma(a) + (a < 13.0 && a != floor(a) ? error : 0.0);
}

// Q(a, x) = 1/Gamma(a) * integral of t^(a-1) e^-t from x on.
static double upper_gamma(double a, double x) {
    double scale = exp(a * log(x) - x - log_gamma(a));
    if (x < 1.0 || x < a) {
        // The series of 1 - Q; its terms fall from the start.
        double term = 1.0 / a, sum = term;
        for (double n = a + 1.0; term > sum * 1e-17; n += 1.0)
            sum += term *= x / n;
        return 1.0 - scale * sum;
    }
    // The continued fraction, by Lentz.
    double b = x + 1.0 - a, c = 1e300, d = 1.0 / b, h = d;
    for (int i = 1; i < 100000; i++) {
        double an = -i * (i - a);
        b += 2.0;
        d = 1.0 / (an * d + b);
        c = b + an / c;
        double step = c * d;
        h *= step;
        if (fabs(step - 1.0) < 1e-16)
            break;
    }
    return scale * h;
}

// z with the area p of the normal distribution below it.
static double normal_inverse(double p) {
    double low = -40.0, high = 40.0;
    for (int i = 0; i < 100; i++) {
        double z = 0.5 * (low + high);
        if (0.5 * erfc(-z / M_SQRT2) < p)
            low = z;
        else
            high = z;
    }
    return 0.5 * (low + high);
}

// x with the probability `upper` above it. As POV-Ray does it, with Wilson and Hilferty's start and
// no more than ten Newton steps: where these leave the positive numbers it takes 0. normal: the
// inverse of the normal distribution at `upper`.
static double chi_square_inverse(double freedom, double upper, double normal) {
    double a = 0.5 * freedom, d = 1.0 / (9.0 * a);
    double root = 1.0 - d - normal * sqrt(d);
    double x = a * root * root * root, shift = log_gamma(a);
    for (int i = 0; i < 10; i++) {
        if (!(x > 0.0))
            return 0.0;
        double slope = -exp((a - 1.0) * log(x) - x - shift);
        if (slope == 0.0)
            break;
        double step = (upper_gamma(a, x) - upper) / slope;
        x -= step;
        if (i >= 3 && fabs(step / x) < 2.3e-16)
            break;
    }
    return 2.0 * x;
}

static const double *thresholds(const FocalBlur *blur, Arena *arena) {
    double *t = ARENA_ARRAY(arena, double, (size_t)blur->samples);
    if (blur->samples < 2)
        return t;
    double normal = normal_inverse(blur->confidence);
    double unit = blur->variance / chi_square_inverse(blur->samples - 1, blur->confidence, normal);
    for (int i = 0; i < blur->samples; i++)
        t[i] = unit * chi_square_inverse(i + 1, blur->confidence, normal);
    return t;
}

// ---- the points of the lens ---------------------------------------------------------------------

// Corners of hexagons: x in steps of 1 / (n sqrt 3), y in steps of 1 / n, to six decimals. They are
// traced in batches that are even over the lens themselves.
typedef struct {
    int count, n;
    signed char at[37][2];
    int batches[9];
} LensGrid;

static const LensGrid GRID_7 = {
    7, 4, {{-2, 0}, {0, 0}, {2, 0}, {-1, 1}, {-1, -1}, {1, 1}, {1, -1}}, {7}};
static const LensGrid GRID_19 = {19,
                                 6,
                                 {{-2, 2},
                                  {-2, -2},
                                  {2, 2},
                                  {2, -2},
                                  {4, 0},
                                  {-4, 0},
                                  {0, 0},
                                  {0, 2},
                                  {0, -2},
                                  {-3, 1},
                                  {-3, -1},
                                  {3, 1},
                                  {3, -1},
                                  {-1, 1},
                                  {-1, -1},
                                  {1, 1},
                                  {1, -1},
                                  {-2, 0},
                                  {2, 0}},
                                 {7, 6, 6}};
static const LensGrid GRID_37 = {
    37,
    8,
    {{0, 0},   {-3, 3},  {3, -3}, {-3, -3}, {3, 3},   {-6, 0}, {6, 0},  {-2, 2},
     {2, -2},  {-2, -2}, {2, 2},  {-4, 0},  {4, 0},   {-1, 1}, {1, -1}, {-1, -1},
     {1, 1},   {-2, 0},  {2, 0},  {-5, 1},  {-5, -1}, {5, 1},  {5, -1}, {-4, 2},
     {-4, -2}, {4, 2},   {4, -2}, {-1, 3},  {-1, -3}, {1, 3},  {1, -3}, {-3, 1},
     {-3, -1}, {3, 1},   {3, -1}, {0, 2},   {0, -2}},
    {7, 6, 6, 4, 4, 4, 4, 2}};

static const Vec2 SQUARE[4] = {{-0.25, 0.25}, {0.25, 0.25}, {-0.25, -0.25}, {0.25, -0.25}};

static double six_decimals(double x) { return round(x * 1e6) / 1e6; }

static const LensGrid *hexagons(int samples) {
    if (samples >= GRID_37.count)
        return &GRID_37;
    if (samples >= GRID_19.count)
        return &GRID_19;
    return samples >= GRID_7.count ? &GRID_7 : NULL;
}

// The digits of i behind the point in that base, mirrored.
static double halton(uint64_t i, unsigned base) {
    double sum = 0.0;
    for (double q = 1.0 / base; i > 0; i /= base, q /= base)
        sum += (double)(i % base) * q;
    return sum;
}

static Vec2 disc_point(uint64_t i) {
    double r = sqrt(halton(i, 2) * 0.25), angle = halton(i, 3) * (2.0 * M_PI);
    double x = r * cos(angle), y = r * sin(angle);
    return (Vec2){x, y};
}

// More points than the standard ones: each in a cell of its own of a grid, as long as tries last.
static void add_points(Vec2 *points, int first, int samples, Arena *arena) {
    int side = 2 * (int)ceil(sqrt(samples / M_PI)) + 1;
    bool *used = ARENA_ARRAY(arena, bool, (size_t)side *(size_t)side);
    int64_t tries = (int64_t)samples * 10;
    uint64_t drawn = 0;
    for (int i = 0; i < samples; i++) {
        Vec2 p;
        size_t cell;
        bool bad;
        do {
            p = i < first ? points[i] : disc_point(++drawn);
            int x = (int)((p.u + 0.5) * side), y = (int)((p.v + 0.5) * side);
            x = x < side ? x : side - 1;
            y = y < side ? y : side - 1;
            cell = (size_t)y * (size_t)side + (size_t)x;
            bad = i >= first && (used[cell] || p.u * p.u + p.v * p.v > 0.25);
            tries -= i >= first;
        } while (bad && tries > samples - i);
        used[cell] = true;
        points[i] = p;
    }
}

static const Vec2 *lens_points(int samples, Arena *arena) {
    const LensGrid *grid = hexagons(samples);
    Vec2 *points = ARENA_ARRAY(arena, Vec2, (size_t)samples);
    int standard = grid ? grid->count : (int)(sizeof SQUARE / sizeof *SQUARE);
    for (int i = 0; i < standard && i < samples; i++) {
        if (grid) {
            points[i].u = six_decimals(grid->at[i][0] / (grid->n * sqrt(3.0)));
            points[i].v = six_decimals((double)grid->at[i][1] / grid->n);
        } else {
            points[i] = SQUARE[i];
        }
    }
    if (samples > standard)
        add_points(points, standard, samples, arena);
    return points;
}

static double lens_jitter(int samples) {
    if (samples == GRID_7.count)
        return 0.144338;
    if (samples == GRID_19.count)
        return 0.096225;
    return samples == GRID_37.count ? 0.0721688 : 0.5 / sqrt(samples);
}

const Blur *blur_create(const Camera *camera, Arena *arena) {
    static const int FOURS[] = {0};
    const LensGrid *grid = hexagons(camera->blur.samples);
    Blur *blur = ARENA_NEW(arena, Blur);
    blur->camera = camera;
    blur->points = lens_points(camera->blur.samples, arena);
    blur->threshold = thresholds(&camera->blur, arena);
    blur->batches = grid ? grid->batches : FOURS;
    blur->jitter = lens_jitter(camera->blur.samples);
    blur->across = vec_normalize(vec_cross(camera->up, camera->direction));
    blur->along = vec_normalize(vec_cross(camera->direction, blur->across));
    blur->reach = camera->blur.focal_distance / vec_length(camera->direction);
    return blur;
}

// ---- one pixel ----------------------------------------------------------------------------------

// Moves the ray to a point of the lens. (x, y): the place as camera_aim's, from the pixel's corner.
static void deflect(const Blur *blur, const Vec2 *point, double x, double y, Ray *ray) {
    double jx, jy, r = blur->camera->blur.aperture * 0.5;
    sample_jitter(x, y, &jx, &jy);
    double u = r * (point->u + jx * (blur->jitter * 2.0));
    double v = r * (point->v + jy * (blur->jitter * 2.0));
    Vec3 shift = vec_sub(vec_scale(blur->across, u), vec_scale(blur->along, v));
    ray->org = vec_add(blur->camera->location, shift);
    ray->dir = vec_normalize(vec_sub(vec_scale(ray->dir, blur->reach), shift));
}

// Where in its pixel a sample lies; the jitter is off the middle of the cell, as in POV-Ray.
static void place_in_pixel(int64_t seed, double *dx, double *dy) {
    int i = sample_permutation((int)(seed & 4095)) % PIXEL_GRID;
    int j = sample_permutation((int)((seed + 1) & 4095)) % PIXEL_GRID;
    double jx, jy;
    *dx = (double)(2 * i + 1) / (2 * PIXEL_GRID) - 0.5;
    *dy = (double)(2 * j + 1) / (2 * PIXEL_GRID) - 0.5;
    sample_jitter(*dx, *dy, &jx, &jy);
    *dx += (jx - 0.5) / PIXEL_GRID;
    *dy += (jy - 0.5) / PIXEL_GRID;
}

typedef struct {
    float sum[4], squares[4];
} Moments;

static void add_moments(Moments *m, Color c) {
    const float values[4] = {c.r, c.g, c.b, c.transmit};
    for (int i = 0; i < 4; i++) {
        m->sum[i] += values[i];
        m->squares[i] += values[i] * values[i];
    }
}

// Is the variance of the mean of n samples below the limit in every channel?
static bool good_enough(const Moments *m, int n, double limit) {
    for (int i = 0; i < 4; i++) {
        double mean = m->sum[i] / (double)n;
        float variance = (float)((m->squares[i] / (double)n - mean * mean) / n);
        if (!(variance < limit))
            return false;
    }
    return true;
}

Color blur_trace(const Blur *blur, const CameraView *view, double x, double y, SampleTrace trace,
                 void *context, uint64_t *rays) {
    const FocalBlur *lens = &blur->camera->blur;
    const int *batch = blur->batches;
    int64_t seed = (int64_t)(x * 313.0 + 11.0) + (int64_t)(y * 311.0 + 17.0);
    int count = 0;
    Color sum = {0};
    Moments moments = {{0}, {0}};
    do {
        int end = count + (*batch > 0 ? *batch++ : 4);
        for (; count < end && count < lens->samples; count++) {
            double dx, dy, a, b;
            Ray ray;
            Color c = {.transmit = 1.0f};
            place_in_pixel(seed + count, &dx, &dy);
            if (camera_aim(view, x + dx, y + dy, &ray, &a, &b)) {
                deflect(blur, &blur->points[count], x + dx + 0.5, y + dy - 0.5, &ray);
                ray.dir = camera_bend(view, ray.dir, a, b);
                c = trace(context, &ray);
                ++*rays;
                sum.r += c.r, sum.g += c.g, sum.b += c.b;
                sum.filter += c.filter, sum.transmit += c.transmit;
            }
            add_moments(&moments, c);
        }
        if (count >= lens->min_samples && good_enough(&moments, count, blur->threshold[count - 1]))
            break;
    } while (count < lens->samples);
    float n = (float)count;
    return (Color){sum.r / n, sum.g / n, sum.b / n, sum.filter / n, sum.transmit / n};
}
