// SPDX-License-Identifier: MIT
// What a ray sees that hits nothing (facts: rendering 6): the pigments of the sky sphere from the
// top, then the background. Scenes older than 3.7 mix them in another way.
#include "render/shading.h"

#include "texture/pigment.h"

#include <math.h>

static Color sky_pigment(const Shading *shading, uint32_t i, Vec3 dir) {
    const SkySphere *sky = &shading->scene->sky_sphere;
    TextureHit at = texture_no_hit(shading->quality.quick_color);
    Color c = {0};
    pigment_color(shading->textures, sky->pigments[i], &at,
                  transform_inv_point(&sky->transform, dir), &c);
    return c;
}

// As if the sky were a sphere with one layer a pigment, and the background the last of them.
static Color sky_layered(const Shading *shading, Vec3 dir, bool alpha) {
    const Scene *scene = shading->scene;
    Rgb through = rgb(1.0f, 1.0f, 1.0f), sum = {0};
    for (uint32_t i = scene->has_sky_sphere ? scene->sky_sphere.pigment_count : 0; i-- > 0;) {
        Color c = sky_pigment(shading, i, dir);
        Rgb own = rgb_scale(color_rgb(c), (float)(1.0 - c.filter - c.transmit));
        sum = rgb_add(sum, rgb_mul(rgb_mul(own, through), scene->sky_sphere.emission));
        through = rgb_mul(through, color_through(c));
    }
    Color back = scene->settings.background;
    if (!shading->options.alpha) {
        // A picture without alpha shows what is not transmitted, over black.
        Rgb shown = rgb_scale(color_rgb(back), 1.0 - back.transmit);
        back = (Color){shown.r, shown.g, shown.b, 0.0f, 0.0f};
    }
    if (!alpha)
        back.filter = back.transmit = 0.0f;
    Rgb own = rgb_scale(color_rgb(back), (float)(1.0 - back.filter - back.transmit));
    sum = rgb_add(sum, rgb_mul(own, through));
    through = rgb_mul(through, color_through(back));
    float transmit = fabsf(rgb_grey(through));
    return (Color){sum.r, sum.g, sum.b, 0.0f, transmit < 1.0f ? transmit : 1.0f};
}

static Color color_mul(Color a, Color b) {
    return (Color){a.r * b.r, a.g * b.g, a.b * b.b, a.filter * b.filter, a.transmit * b.transmit};
}

// Before 3.7: each pigment filters by the components of all above it, one by one.
static Color sky_legacy(const Shading *shading, Vec3 dir, bool alpha) {
    const Scene *scene = shading->scene;
    if (alpha)
        return (Color){.transmit = 1.0f};
    Color back = scene->settings.background;
    if (!scene->has_sky_sphere || scene->sky_sphere.pigment_count == 0)
        return back;
    Rgb sum = {0};
    Color filter = {1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
    double trans = 1.0;
    for (uint32_t i = scene->sky_sphere.pigment_count; i-- > 0;) {
        Color c = sky_pigment(shading, i, dir);
        double own = trans * (1.0 - c.filter - c.transmit);
        sum = rgb_add(sum, rgb_scale(color_rgb(c), own));
        filter = color_mul(filter, c);
        trans = fabsf(filter.filter) + fabsf(filter.transmit);
    }
    sum = rgb_add(rgb_mul(sum, scene->sky_sphere.emission),
                  rgb_mul(color_rgb(back), color_through(filter)));
    return (Color){sum.r, sum.g, sum.b, back.filter * filter.filter,
                   back.transmit * filter.transmit};
}

Color atmosphere_sky(const Shading *shading, Vec3 dir, bool alpha) {
    return shading->legacy ? sky_legacy(shading, dir, alpha) : sky_layered(shading, dir, alpha);
}
