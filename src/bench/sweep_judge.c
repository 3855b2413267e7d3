// SPDX-License-Identifier: MIT
#include "bench/sweep_judge.h"

#include <math.h>

double *judge_diameters(const Scene *scene, Arena *arena) {
    double *diameter = ARENA_ARRAY(arena, double, scene->object_count);
    for (uint32_t i = 0; i < scene->object_count; i++) {
        if (scene->objects[i].type != OBJECT_PATCH)
            continue;
        const Box box = patch_shape_box(&scene->objects[i].shape.patch);
        diameter[i] = vec_length(vec_sub(box.high, box.low));
    }
    return diameter;
}

Image *judge_image(const SweepShared *shared, const SweepOptions *o, Arena *arena) {
    Image *image = ARENA_NEW(arena, Image);
    *image = (Image){.width = o->width, .height = o->height, .channels = 3, .bits = 16};
    size_t count = 3 * (size_t)o->width * (size_t)o->height;
    image->pixels = arena_copy(arena, shared->pixels, count * sizeof(float));
    return image;
}

// The RMS over the pixels whose rays meet the same object as in truth: what is left of the
// picture's error when rays that slip through, or meet something else, are left out.
static double rms_of_same(const Judge *judge, const SweepShared *shared, const Image *picture) {
    size_t pixels = (size_t)picture->width * (size_t)picture->height, count = 0;
    double squares = 0.0;
    for (size_t i = 0; i < pixels; i++) {
        if (judge->truth->looks[i].object != shared->looks[i].object)
            continue;
        for (size_t k = 3 * i; k < 3 * i + 3; k++) {
            double off = (double)picture->pixels[k] - (double)judge->truth_picture->pixels[k];
            squares += off * off;
        }
        count += 3;
    }
    return count > 0 ? 255.0 * sqrt(squares / (double)count) : 0.0;
}

void judge_picture(const Judge *judge, const SweepShared *shared, const Image *picture,
                   SweepResult *r) {
    const ImageDifference d = image_compare(judge->truth_picture, picture, 1.0, 1.0);
    r->rms = 255.0 * d.rms;
    r->psnr = d.psnr;
    r->off = (double)d.different / (double)d.pixels;
    r->worst = 255.0 * d.max;
    r->worst_x = d.max_x;
    r->worst_y = d.max_y;
    if (shared)
        r->rms_same = rms_of_same(judge, shared, picture);
}

// How far apart two hits on one ray are across the surface, and the angle of their normals.
static double distance_of(const SweepLook *truth, const SweepLook *look) {
    return fabs(look->t - truth->t) * fabs(vec_dot(truth->dir, truth->normal));
}

static double angle_of(const SweepLook *truth, const SweepLook *look) {
    Vec3 across = vec_cross(truth->normal, look->normal);
    return atan2(vec_length(across), vec_dot(truth->normal, look->normal)) * 180.0 / M_PI;
}

// The truth around a pixel is one surface without a step, and the ray went far through it.
static bool is_hole(const Judge *judge, const SweepShared *shared, size_t at) {
    const SweepLook *truth = &judge->truth->looks[at];
    double diameter = truth->object != NO_INDEX ? judge->diameter[truth->object] : 0.0;
    double step = 0.1 * diameter;
    if (!(diameter > 0.0) || !(shared->looks[at].t > truth->t + step))
        return false;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) {
            const SweepLook *near = truth + (ptrdiff_t)y * judge->options->width + x;
            if (near->object == NO_INDEX || !(judge->diameter[near->object] > 0.0) ||
                !(fabs(near->t - truth->t) < step))
                return false;
        }
    return true;
}

static int count_holes(const Judge *judge, const SweepShared *shared) {
    int holes = 0;
    size_t width = (size_t)judge->options->width, height = (size_t)judge->options->height;
    for (size_t y = 1; y + 1 < height; y++)
        for (size_t x = 1; x + 1 < width; x++)
            holes += is_hole(judge, shared, y * width + x);
    return holes;
}

// t and the coordinates of both rays' starts are rounded to half a unit in the last place each, and
// added up in both hits: four units of the largest of them. In diameters of the patch.
static double rounding_of(const Judge *judge, const SweepLook *truth) {
    Vec3 eye = judge->footprint.eye;
    double most = fmax(truth->t, fmax(fabs(eye.x), fmax(fabs(eye.y), fabs(eye.z))));
    return 4.0 * 0x1p-52 * most / judge->diameter[truth->object];
}

void judge_hits(const Judge *judge, const SweepShared *shared, SweepResult *r) {
    size_t pixels = (size_t)judge->options->width * (size_t)judge->options->height, both = 0;
    size_t wrong = 0, patches = 0;
    double squares = 0.0, angle_squares = 0.0;
    for (size_t i = 0; i < pixels; i++) {
        const SweepLook *truth = &judge->truth->looks[i], *look = &shared->looks[i];
        bool on_patch = truth->object != NO_INDEX && judge->diameter[truth->object] > 0.0;
        bool now = look->object != NO_INDEX && judge->diameter[look->object] > 0.0;
        patches += on_patch || now;
        if (truth->object != look->object) {
            wrong += on_patch || now;
            continue;
        }
        if (!on_patch)
            continue;
        double distance = distance_of(truth, look), angle = angle_of(truth, look);
        double share = distance / judge->diameter[truth->object];
        double pixel = fmax(judge->footprint.angle * truth->t, judge->footprint.width);
        r->position_max = fmax(r->position_max, share);
        r->rounding = fmax(r->rounding, rounding_of(judge, truth));
        r->position_pixels = fmax(r->position_pixels, distance / pixel);
        r->normal_max = fmax(r->normal_max, angle);
        squares += share * share;
        angle_squares += angle * angle;
        both++;
    }
    if (both > 0) {
        r->position_rms = sqrt(squares / (double)both);
        r->normal_rms = sqrt(angle_squares / (double)both);
    }
    r->holes = count_holes(judge, shared);
    r->leaks = judge->edges.count > 0 ? (double)shared->leaks / (double)judge->edges.count : 0.0;
    r->wrong = patches > 0 ? (double)wrong / (double)patches : 0.0;
}

// ---- Maps

static Image *new_map(const SweepOptions *o, Arena *arena) {
    Image *map = ARENA_NEW(arena, Image);
    *map = (Image){.width = o->width, .height = o->height, .channels = 1, .bits = 32};
    map->pixels = ARENA_ARRAY(arena, float, (size_t)o->width *(size_t)o->height);
    return map;
}

void judge_maps(const Judge *judge, const SweepShared *facets, Sweep *sweep, Arena *arena) {
    const SweepOptions *o = judge->options;
    sweep->distance = new_map(o, arena);
    sweep->angle = new_map(o, arena);
    sweep->steps = new_map(o, arena);
    sweep->leaves = new_map(o, arena);
    for (size_t i = 0; i < (size_t)o->width * (size_t)o->height; i++) {
        const SweepLook *truth = &judge->truth->looks[i], *look = &facets->looks[i];
        sweep->steps->pixels[i] = (float)(truth->steps + truth->newton);
        sweep->leaves->pixels[i] = (float)truth->leaves;
        if (truth->object == NO_INDEX || truth->object != look->object ||
            !(judge->diameter[truth->object] > 0.0))
            continue;
        double pixel = fmax(judge->footprint.angle * truth->t, judge->footprint.width);
        sweep->distance->pixels[i] = (float)(distance_of(truth, look) / pixel);
        sweep->angle->pixels[i] = (float)angle_of(truth, look);
    }
}
