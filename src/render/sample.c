// SPDX-License-Identifier: MIT
// A tile of pixels from camera rays. Method 1 compares each pixel with its left and upper
// neighbour and supersamples those that differ on a regular grid; method 2 traces the pixels'
// corners and cuts a square in four while its corners differ.
//
// A tile of method 1 with the frame of pixels that only serve the comparison (f), which are traced
// even outside the picture and never change:
//
//       f f f f
//     f . . . .      index 0 of the scratch is the place above and left of the tile;
//     f . . . .      that corner itself is not used
//     f . . . .
//
// Method 2 uses the same scratch for the (w + 1) x (h + 1) upper left corners.
#include "render/sample.h"

#include "base/arena.h"
#include "render/blur.h"

#include <math.h>

enum { PLANNED_ROWS = 4 };

struct Sampler {
    SampleOptions options;
    CameraView view;
    const Blur *blur; // NULL: the picture is sharp everywhere
    int width, height;
    Arena *arena;
    // One tile and its frame.
    Color *block;
    bool *done; // method 1: already supersampled, or part of the frame
    // Method 2, one pixel: (2^depth + 1)^2 places and the pixel for which each was last traced.
    Color *place;
    uint32_t *place_pixel, pixel;
    // Camera rays of some rows of the tile, when all of them exist.
    Ray *planned;
    size_t planned_across;
    bool has_plan;
    uint64_t rays, supersampled;
    SampleForesee foresee; // NULL: nobody wants to know
    SampleTrace trace;     // of the tile at hand
    void *context;
};

Sampler *sampler_create(const SampleOptions *options, const Camera *camera, int width, int height,
                        int block) {
    Arena *arena = arena_create();
    Sampler *s = ARENA_NEW(arena, Sampler);
    s->options = *options;
    s->view = camera_view(camera, options->textures, width, height);
    s->blur = camera->has_blur ? blur_create(camera, arena) : NULL;
    s->width = width;
    s->height = height;
    s->arena = arena;
    size_t across = (size_t)(block < width ? block : width) + 1,
           down = (size_t)(block < height ? block : height) + 1;
    s->planned = ARENA_ARRAY(arena, Ray, PLANNED_ROWS * across);
    if (options->method != 0) {
        s->block = ARENA_ARRAY(arena, Color, across * down);
        s->done = ARENA_ARRAY(arena, bool, across *down);
    }
    if (options->method == 2) {
        size_t side = ((size_t)1 << options->depth) + 1;
        s->place = ARENA_ARRAY(arena, Color, side * side);
        s->place_pixel = ARENA_ARRAY(arena, uint32_t, side * side);
    }
    return s;
}

void sampler_destroy(Sampler *sampler) {
    if (sampler)
        arena_destroy(sampler->arena);
}

void sampler_foresee(Sampler *sampler, SampleForesee foresee) { sampler->foresee = foresee; }

uint64_t sampler_rays(const Sampler *sampler) { return sampler->rays; }
uint64_t sampler_pixels(const Sampler *sampler) { return sampler->supersampled; }

static bool ray_at(const Sampler *s, double x, double y, Ray *ray) {
    return camera_ray(&s->view, x + s->options.nudge[0], y + s->options.nudge[1], ray);
}

static Color trace_at(Sampler *s, double x, double y) {
    if (s->blur)
        return blur_trace(s->blur, &s->view, x + s->options.nudge[0], y + s->options.nudge[1],
                          s->trace, s->context, &s->rays);
    Ray ray;
    if (!ray_at(s, x, y, &ray))
        return (Color){.transmit = 1.0f};
    s->rays++;
    return s->trace(s->context, &ray);
}

// The next rows, at most PLANNED_ROWS, of `across` places a pixel apart; the first is at x, y.
static void plan_rows(Sampler *s, double x, double y, int across, int down) {
    s->has_plan = s->blur == NULL;
    s->planned_across = (size_t)across;
    for (int j = 0; j < down && s->has_plan; j++)
        for (int i = 0; i < across && s->has_plan; i++)
            s->has_plan =
                ray_at(s, x + i, y + j, &s->planned[(size_t)j * s->planned_across + (size_t)i]);
    if (s->has_plan && s->foresee)
        s->foresee(s->context, s->planned, s->planned_across, (size_t)down);
}

// As trace_at, for place i of row j of the plan.
static Color trace_planned(Sampler *s, int i, int j, double x, double y) {
    if (!s->has_plan)
        return trace_at(s, x, y);
    s->rays++;
    return s->trace(s->context, &s->planned[(size_t)j * s->planned_across + (size_t)i]);
}

static int rows_to_plan(int left) { return left < PLANNED_ROWS ? left : PLANNED_ROWS; }

// As trace_at, moved by the jitter of the place; scale is the share of a pixel it may move by.
static Color trace_jittered(Sampler *s, double x, double y, double scale) {
    if (!(scale > 0.0))
        return trace_at(s, x, y);
    double jx, jy;
    sample_jitter(x, y, &jx, &jy);
    return trace_at(s, x + jx * scale, y + jy * scale);
}

static Color color_sum(Color a, Color b) {
    return (Color){a.r + b.r, a.g + b.g, a.b + b.b, a.filter + b.filter, a.transmit + b.transmit};
}

static Color color_divide(Color c, float by) {
    return (Color){c.r / by, c.g / by, c.b / by, c.filter / by, c.transmit / by};
}

// Do the colours differ by the threshold, as the eye would see them?
static bool differ(const Sampler *s, Color a, Color b) {
    const Transfer *eye = &s->options.eye;
    if (a.r == b.r && a.g == b.g && a.b == b.b && a.transmit == b.transmit) // most pairs
        return s->options.threshold <= 0.0;
    float dr = transfer_apply(eye, a.r) - transfer_apply(eye, b.r);
    float dg = transfer_apply(eye, a.g) - transfer_apply(eye, b.g);
    float db = transfer_apply(eye, a.b) - transfer_apply(eye, b.b);
    float distance = fabsf(dr) + fabsf(dg) + fabsf(db) + fabsf(a.transmit - b.transmit);
    return (double)distance >= s->options.threshold;
}

// ---- method 1 -----------------------------------------------------------------------------------

// Adds a grid of depth x depth samples to the colour of the pixel's middle.
static Color supersample(Sampler *s, int x, int y, Color middle) {
    int depth = s->options.depth;
    double step = 1.0 / depth, range = 0.5 - step * 0.5, jitter = s->options.jitter / depth;
    const double rounding = 1e-10; // of the sums below
    Color sum = middle;
    for (double dy = -range; dy <= range + rounding; dy += step)
        for (double dx = -range; dx <= range + rounding; dx += step)
            sum = color_sum(sum, trace_jittered(s, x + dx, y + dy, jitter));
    s->supersampled++;
    return color_divide(sum, (float)(depth * depth + 1));
}

static void tile_on_difference(Sampler *s, PixelRect tile, Color *picture) {
    int across = tile.right - tile.left + 1, down = tile.bottom - tile.top + 1;
    Color *block = s->block;
    bool *done = s->done;

    // The frame above.
    plan_rows(s, tile.left, tile.top - 1, across - 1, 1);
    for (int i = 1; i < across; i++) {
        block[i] = trace_planned(s, i - 1, 0, tile.left + i - 1, tile.top - 1);
        done[i] = true;
    }
    for (int j = 1; j < down; j++) {
        int y = tile.top + j - 1, planned = (j - 1) % PLANNED_ROWS;
        if (planned == 0)
            plan_rows(s, tile.left - 1, y, across, rows_to_plan(down - j));
        Color *row = block + (size_t)j * (size_t)across, *above = row - across;
        bool *row_done = done + (size_t)j * (size_t)across, *above_done = row_done - across;

        // The frame at the left.
        row[0] = trace_planned(s, 0, planned, tile.left - 1, y);
        row_done[0] = true;
        for (int i = 1; i < across; i++) {
            int x = tile.left + i - 1;
            row[i] = trace_planned(s, i, planned, x, y);
            row_done[i] = false;

            // Both comparisons come before any of the three pixels changes.
            bool left = differ(s, row[i - 1], row[i]), top = differ(s, above[i], row[i]);
            if (left && !row_done[i - 1]) {
                row[i - 1] = supersample(s, x - 1, y, row[i - 1]);
                row_done[i - 1] = true;
            }
            if (top && !above_done[i]) {
                above[i] = supersample(s, x, y - 1, above[i]);
                above_done[i] = true;
            }
            if (left || top) {
                row[i] = supersample(s, x, y, row[i]);
                row_done[i] = true;
            }
        }
    }
    for (int j = 1; j < down; j++)
        for (int i = 1; i < across; i++)
            picture[(size_t)(tile.top + j - 1) * (size_t)s->width + (size_t)(tile.left + i - 1)] =
                block[(size_t)j * (size_t)across + (size_t)i];
}

// ---- method 2 -----------------------------------------------------------------------------------

// A square inside one pixel: its middle and half its side in pixels, its first place and its side
// in the pixel's grid of places.
typedef struct {
    double x, y, half;
    int column, row, side;
} Square;

static Color *place_at(Sampler *s, int column, int row) {
    return &s->place[(size_t)row * (((size_t)1 << s->options.depth) + 1) + (size_t)column];
}

// Neighbouring squares of a pixel share their places: each is traced once a pixel.
static void trace_place(Sampler *s, int column, int row, double x, double y) {
    Color *place = place_at(s, column, row);
    uint32_t *traced_for = &s->place_pixel[place - s->place];
    if (*traced_for == s->pixel)
        return;
    *traced_for = s->pixel;
    *place = trace_jittered(s, x, y, s->options.jitter / ((1 << s->options.depth) + 1));
}

static Color mean_of(Color a, Color b, Color c, Color d) {
    return color_divide(color_sum(color_sum(color_sum(a, b), c), d), 4.0f);
}

static Color square_color(Sampler *s, Square q, int levels) {
    Color ul = *place_at(s, q.column, q.row), ll = *place_at(s, q.column, q.row + q.side);
    Color ur = *place_at(s, q.column + q.side, q.row),
          lr = *place_at(s, q.column + q.side, q.row + q.side);
    bool cut = levels > 0 && (differ(s, ul, ll) || differ(s, ul, ur) || differ(s, ul, lr) ||
                              differ(s, ll, ur) || differ(s, ll, lr) || differ(s, ur, lr));
    if (!cut)
        return mean_of(ul, ll, ur, lr);

    int side = q.side / 2;
    trace_place(s, q.column, q.row + side, q.x - q.half, q.y);
    trace_place(s, q.column + side, q.row, q.x, q.y - q.half);
    trace_place(s, q.column + q.side, q.row + side, q.x + q.half, q.y);
    trace_place(s, q.column + side, q.row + q.side, q.x, q.y + q.half);
    trace_place(s, q.column + side, q.row + side, q.x, q.y);

    double half = q.half * 0.5;
    Color part[4];
    for (int i = 0; i < 4; i++) { // upper left, lower left, upper right, lower right
        int right = i >> 1, low = i & 1;
        Square quarter = {.x = right ? q.x + half : q.x - half,
                          .y = low ? q.y + half : q.y - half,
                          .half = half,
                          .column = q.column + right * side,
                          .row = q.row + low * side,
                          .side = side};
        part[i] = square_color(s, quarter, levels - 1);
    }
    return mean_of(part[0], part[1], part[2], part[3]);
}

static void tile_by_corners(Sampler *s, PixelRect tile, Color *picture) {
    int across = tile.right - tile.left + 1, down = tile.bottom - tile.top + 1;
    for (int j = 0; j < down; j++) {
        int planned = j % PLANNED_ROWS;
        double y = (double)(tile.top + j) - 0.5;
        if (planned == 0)
            plan_rows(s, tile.left - 0.5, y, across, rows_to_plan(down - j));
        for (int i = 0; i < across; i++)
            s->block[(size_t)j * (size_t)across + (size_t)i] =
                trace_planned(s, i, planned, (double)(tile.left + i) - 0.5, y);
    }

    int side = 1 << s->options.depth;
    for (int y = tile.top; y < tile.bottom; y++) {
        const Color *row = s->block + (size_t)(y - tile.top) * (size_t)across,
                    *below = row + across;
        for (int x = tile.left; x < tile.right; x++) {
            int i = x - tile.left;
            s->pixel++;
            *place_at(s, 0, 0) = row[i];
            *place_at(s, 0, side) = below[i];
            *place_at(s, side, 0) = row[i + 1];
            *place_at(s, side, side) = below[i + 1];
            Square pixel = {.x = x, .y = y, .half = 0.5, .side = side};
            uint64_t before = s->rays;
            picture[(size_t)y * (size_t)s->width + (size_t)x] =
                square_color(s, pixel, s->options.depth - 1);
            s->supersampled += s->rays != before;
        }
    }
}

// ---- tiles --------------------------------------------------------------------------------------

static void tile_of_middles(Sampler *s, PixelRect tile, Color *picture) {
    for (int y = tile.top; y < tile.bottom; y++) {
        int planned = (y - tile.top) % PLANNED_ROWS;
        if (planned == 0)
            plan_rows(s, tile.left, y, tile.right - tile.left, rows_to_plan(tile.bottom - y));
        for (int x = tile.left; x < tile.right; x++)
            picture[(size_t)y * (size_t)s->width + (size_t)x] =
                trace_planned(s, x - tile.left, planned, x, y);
    }
}

void sampler_tile(Sampler *s, PixelRect tile, SampleTrace trace, void *context, Color *picture) {
    s->trace = trace;
    s->context = context;
    if (s->options.method == 1) {
        tile_on_difference(s, tile, picture);
    } else if (s->options.method == 2) {
        tile_by_corners(s, tile, picture);
    } else {
        tile_of_middles(s, tile, picture);
    }
}
