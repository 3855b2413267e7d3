// SPDX-License-Identifier: MIT
// A point becomes a place in the picture, in pixels from its top left corner; what lies between
// pixels is mixed in double and rounded to float once. Every step is POV-Ray's (facts: textures
// 2.9).
#include "texture/image_map.h"

#include <math.h>

static const double EPS = 1e-10;                    // POV-Ray's near-zero
static const double PI_2 = 6.283185307179586476925; // POV-Ray's 2 pi

// ---- where ------------------------------------------------------------------------------------

// Within 0 .. size, size excluded; also for what is no number.
static double wrapped(double x, double size) {
    double w = fmod(x, size);
    if (w < 0.0)
        w += size;
    return w >= 0.0 && w < size ? w : 0.0;
}

// The angle of (x, z) about y, 0..2 pi; length is that of (x, z).
static double angle_about_y(double x, double z, double length) {
    if (z == 0.0)
        return x > 0.0 ? 0.0 : M_PI;
    double angle = acos(x / length);
    return z < 0.0 ? PI_2 - angle : angle;
}

static bool outside(double x) { return x < 0.0 || x > 1.0; }

static bool planar(const ImageMap *map, Vec3 p, double *u, double *v) {
    if (map->layout->once && (outside(p.x) || outside(p.y)))
        return false;
    *u = fmod(p.x * map->across, map->across);
    *v = fmod(p.y * map->down, map->down);
    return true;
}

static bool spherical(const ImageMap *map, Vec3 p, double *u, double *v) {
    double length = vec_length(p);
    if (length == 0.0)
        return false;
    p = vec3(p.x / length, p.y / length, p.z / length);
    double phi = 0.5 + asin(p.y) / M_PI, across = sqrt(p.x * p.x + p.z * p.z);
    double theta = across == 0.0 ? 0.0 : angle_about_y(p.x, p.z, across) / PI_2;
    *u = theta * map->across;
    *v = phi * map->down;
    return true;
}

static bool cylindrical(const ImageMap *map, Vec3 p, double *u, double *v) {
    if (map->layout->once && outside(p.y))
        return false;
    *v = fmod(p.y * map->down, map->down);
    double length = vec_length(p);
    if (length == 0.0)
        return false;
    double x = p.x / length, z = p.z / length, across = sqrt(x * x + z * z);
    if (across == 0.0)
        return false;
    *u = angle_about_y(x, z, across) / PI_2 * map->across;
    return true;
}

// Around a ring of radius 1.
static bool torus(const ImageMap *map, Vec3 p, double *u, double *v) {
    double across = sqrt(p.x * p.x + p.z * p.z);
    if (across == 0.0)
        return false;
    double theta = angle_about_y(p.x, p.z, across), x = across - 1.0;
    double phi = acos(-x / sqrt(x * x + p.y * p.y));
    if (p.y > 0.0)
        phi = PI_2 - phi;
    *u = theta / PI_2 * map->across;
    *v = phi / PI_2 * map->down;
    return true;
}

// False: there is no picture.
static bool place(const ImageMap *map, Vec3 p, double *u, double *v) {
    bool there = false;
    switch (map->layout->layout) {
    case LAYOUT_PLANAR:
        there = planar(map, p, u, v);
        break;
    case LAYOUT_SPHERICAL:
        there = spherical(map, p, u, v);
        break;
    case LAYOUT_CYLINDRICAL:
        there = cylindrical(map, p, u, v);
        break;
    case LAYOUT_TORUS:
        there = torus(map, p, u, v);
        break;
    }
    if (!there)
        return false;
    *u += map->offset.u + EPS;
    *v += map->offset.v + EPS;
    if (map->layout->once && (*u >= map->width || *v >= map->height || *u < 0.0 || *v < 0.0))
        return false;
    *u = wrapped(*u, map->width);
    *v = wrapped(-*v, map->height); // rows count from the top
    return true;
}

// ---- what -------------------------------------------------------------------------------------

// Whole pixels beyond the edge: the edge's, or those of the repeated picture.
static int pixel_along(const ImageMap *map, int x, int size) {
    if (map->layout->once)
        return x < 0 ? 0 : x >= size ? size - 1 : x;
    x %= size;
    return x < 0 ? x + size : x;
}

static Color pixel(const ImageMap *map, int x, int y, int *index) {
    size_t at = (size_t)pixel_along(map, y, map->height) * (size_t)map->width +
                (size_t)pixel_along(map, x, map->width);
    *index = -1;
    if (map->places) {
        *index = map->places[at];
        return map->colors[*index];
    }
    const Picture *layout = map->layout;
    const float *v = map->values + at * (size_t)map->channels;
    bool grey = map->channels < 3;
    Color c = {v[0], grey ? v[0] : v[1], grey ? v[0] : v[2], 0.0f, 0.0f};
    if (map->channels % 2 == 0)
        c.transmit = 1.0f - v[map->channels - 1];
    if (map->indexed) {
        c.filter = layout->has_filter ? layout->filter : c.filter;
        c.transmit = layout->has_transmit ? layout->transmit : c.transmit;
    } else {
        c.filter += layout->filter;
        c.transmit += layout->transmit;
    }
    return c;
}

typedef struct {
    double r, g, b, filter, transmit, index;
} Sum;

static void add(Sum *sum, const ImageMap *map, int x, int y, double weight) {
    int index;
    Color c = pixel(map, x, y, &index);
    sum->r += c.r * weight;
    sum->g += c.g * weight;
    sum->b += c.b * weight;
    sum->filter += c.filter * weight;
    sum->transmit += c.transmit * weight;
    sum->index += index * weight;
}

static Color sum_color(const Sum *sum, int *index) {
    *index = sum->index >= -1.0 && sum->index < 256.0 ? (int)sum->index : -1;
    return (Color){(float)sum->r, (float)sum->g, (float)sum->b, (float)sum->filter,
                   (float)sum->transmit};
}

static double square(double x) { return x * x; }

// From the four pixels around; u and v are already moved by half a pixel.
static Color mix_four(const ImageMap *map, double u, double v, int *index) {
    int x = (int)u, y = (int)v;
    double p = u - x, q = v - y, weights[4];
    if (map->layout->between == BETWEEN_BILINEAR) {
        weights[0] = p * q;
        weights[1] = (1.0 - p) * q;
        weights[2] = p * (1.0 - q);
        weights[3] = (1.0 - p) * (1.0 - q);
    } else {
        weights[0] = 1.0 / (square(1.0 - p) + square(1.0 - q));
        weights[1] = 1.0 / (square(p) + square(1.0 - q));
        weights[2] = 1.0 / (square(1.0 - p) + square(q));
        weights[3] = 1.0 / (square(p) + square(q));
        double total = 0.0;
        for (int i = 0; i < 4; i++)
            total += weights[i];
        for (int i = 0; i < 4; i++)
            weights[i] /= total;
    }
    Sum sum = {0};
    for (int i = 0; i < 4; i++)
        add(&sum, map, x - i % 2, y - i / 2, weights[i]);
    return sum_color(&sum, index);
}

static void cubic_weights(double x, double weights[4]) {
    double p = x - (int)x, q = 1.0 - p;
    weights[0] = -0.5 * p * q * q;
    weights[1] = 0.5 * q * (q * (3.0 * p + 1.0) + 1.0);
    weights[2] = 0.5 * p * (p * (3.0 * q + 1.0) + 1.0);
    weights[3] = -0.5 * q * p * p;
}

static Color mix_sixteen(const ImageMap *map, double u, double v, int *index) {
    double across[4], down[4];
    cubic_weights(u, across);
    cubic_weights(v, down);
    Sum sum = {0};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            add(&sum, map, (int)u + i - 2, (int)v + j - 2, across[i] * down[j]);
    return sum_color(&sum, index);
}

// index: of the palette, -1 without one.
static Color color_at(const ImageMap *map, double u, double v, int *index) {
    switch (map->layout->between) {
    case BETWEEN_NONE:
        return pixel(map, (int)u, (int)v, index);
    case BETWEEN_BICUBIC:
        return mix_sixteen(map, u + 0.5, v + 0.5, index);
    case BETWEEN_BILINEAR:
    case BETWEEN_NORMALIZED:
        break;
    }
    return mix_four(map, u + 0.5, v + 0.5, index);
}

// ---- the patterns -----------------------------------------------------------------------------

bool image_map_color(const ImageMap *map, Vec3 p, Color *color) {
    double u, v;
    int index;
    if (!place(map, p, &u, &v)) {
        *color = (Color){1.0f, 1.0f, 1.0f, 0.0f, 1.0f};
        return false;
    }
    *color = color_at(map, u, v, &index);
    float alpha = 1.0f - color->transmit;
    if (map->premultiplied && alpha > EPS) {
        color->r /= alpha;
        color->g /= alpha;
        color->b /= alpha;
    }
    return true;
}

double image_map_value(const ImageMap *map, Vec3 p) {
    double u, v, value;
    int index;
    if (!place(map, p, &u, &v))
        return 0.0;
    Color c = color_at(map, u, v, &index);
    bool clear = map->indexed || map->channels % 2 == 0;
    if (map->layout->use == USE_PICTURE_ALPHA)
        value = clear ? c.transmit : c.r;
    else
        value = rgb_grey(color_rgb(c));
    return value < 0.0 ? 0.0 : value > 1.0 ? 1.0 : value;
}

static double folded(double x, double size) {
    return x < 0.0 ? x + size : x >= size ? x - size : x;
}

// The slope of the triangle of the pixel and its two lower neighbours, put upright on the normal.
Vec3 image_map_bump(const ImageMap *map, double amount, Vec3 p, Vec3 n) {
    double u, v;
    int index[3];
    if (!place(map, p, &u, &v))
        return n;
    Color c[3];
    c[0] = color_at(map, u, v, &index[0]);
    u = folded(u - 1.0, map->width);
    v = folded(v + 1.0, map->height);
    c[1] = color_at(map, u, v, &index[1]);
    u = folded(u + 2.0, map->width);
    c[2] = color_at(map, u, v, &index[2]);
    bool by_color =
        map->layout->use != USE_PICTURE_INDEX || index[0] == -1 || index[1] == -1 || index[2] == -1;
    double h[3];
    for (int i = 0; i < 3; i++)
        h[i] = amount * (by_color ? rgb_grey(color_rgb(c[i])) : (float)index[i]);
    Vec3 corner = vec3(-1.0, h[1], 1.0);
    Vec3 slope = vec_normalize(
        vec_cross(vec_sub(vec3(1.0, h[2], 1.0), corner), vec_sub(vec3(0.0, h[0], 0.0), corner)));
    Vec3 up = n, right = vec_cross(up, vec3(0.0, 1.0, 0.0));
    double length = vec_length(right);
    if (length < EPS) {
        up = vec3(0.0, fabs(n.y - 1.0) < EPS ? 1.0 : -1.0, 0.0);
        right = vec3(1.0, 0.0, 0.0);
        length = 1.0;
    }
    right = vec_scale(right, 1.0 / length);
    Vec3 ahead = vec_normalize(vec_cross(right, up));
    Vec3 sum = vec_add(vec_scale(right, slope.x), vec_scale(up, slope.y));
    return vec_add(sum, vec_neg(vec_scale(ahead, slope.z)));
}

uint32_t image_map_material(const ImageMap *map, uint32_t count, Vec3 p) {
    double u, v;
    int index, number = 0;
    if (place(map, p, &u, &v)) {
        Color c = color_at(map, u, v, &index);
        number = index == -1 ? (int)(c.r * 255.0) : index;
    }
    if (number < 0)
        return 0;
    if ((uint32_t)number > count)
        number %= (int)count;
    return (uint32_t)number < count ? (uint32_t)number : count - 1;
}
