// SPDX-License-Identifier: MIT
#include "report/heat.h"

#include "render/gamma.h"

#include <math.h>
#include <string.h>

double heat_scale(double difference) {
    double steps = 255.0 * (difference > 0 ? difference : 0.0);
    return fmin(log2(1.0 + steps) / 8.0, 1.0);
}

// Values read from 8-bit files are whole steps up to the rounding of a float.
static double steps_of(double difference) {
    double steps = 255.0 * difference, whole = round(steps);
    return fabs(steps - whole) < 1e-3 ? whole : steps;
}

int heat_class(double difference) {
    double steps = steps_of(difference);
    if (!(difference > 0))
        return 0;
    if (steps < 1)
        return 1;
    int class = 2 + (int)floor(log2(steps));
    return class < HEAT_CLASSES ? class : HEAT_CLASSES - 1;
}

const char *heat_class_name(int index) {
    static const char *const names[HEAT_CLASSES] = {
        "equal",      "under 1",     "1",           "2&#8211;3",    "4&#8211;7",
        "8&#8211;15", "16&#8211;31", "32&#8211;63", "64&#8211;127", "128&#8211;255",
    };
    return names[index];
}

double heat_class_middle(int index) {
    if (index == 0)
        return 0.0;
    return index == 1 ? 0.5 / 255.0 : 1.5 * exp2(index - 2) / 255.0;
}

Image *heat_map(Arena *arena, const Image *differences) {
    Arena *scratch = arena_create();
    size_t pixels = (size_t)differences->width * (size_t)differences->height;
    Image scaled = *differences;
    scaled.pixels = ARENA_ARRAY(scratch, float, pixels);
    for (size_t i = 0; i < pixels; i++)
        scaled.pixels[i] = (float)heat_scale((double)differences->pixels[i]);
    Image *colors = image_false_color(arena, &scaled);
    arena_destroy(scratch);
    return colors;
}

void heat_count(const Image *differences, uint64_t count[HEAT_CLASSES]) {
    memset(count, 0, HEAT_CLASSES * sizeof *count);
    size_t pixels = (size_t)differences->width * (size_t)differences->height;
    for (size_t i = 0; i < pixels; i++)
        count[heat_class((double)differences->pixels[i])]++;
}

static int first_inside(int middle, int side, int size) {
    int first = middle - side / 2;
    if (first + side > size)
        first = size - side;
    return first > 0 ? first : 0;
}

Image *heat_cut(Arena *arena, const Image *image, int x, int y, int side, int *left, int *top) {
    int width = side < image->width ? side : image->width,
        height = side < image->height ? side : image->height;
    *left = first_inside(x, width, image->width);
    *top = first_inside(y, height, image->height);
    return image_cut(arena, image, *left, *top, width, height);
}

Image *heat_shown(Arena *arena, const Image *image) {
    Image *shown = ARENA_NEW(arena, Image);
    *shown = *image;
    if (image->bits != 32)
        return shown;
    size_t channels = (size_t)image->channels;
    size_t count = (size_t)image->width * (size_t)image->height * channels;
    bool alpha = channels % 2 == 0;
    Transfer screen = transfer_between(curve_power(1.0f), curve_srgb());
    shown->pixels = ARENA_ARRAY(arena, float, count);
    for (size_t i = 0; i < count; i++) {
        bool opacity = alpha && i % channels == channels - 1;
        shown->pixels[i] = opacity ? image->pixels[i] : transfer_apply(&screen, image->pixels[i]);
    }
    return shown;
}
