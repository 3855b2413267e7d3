// SPDX-License-Identifier: MIT
// A point becomes a colour: the pattern's value looked up in the pigment's map (facts: textures
// 4.1). A map holds colours or pigments; those are evaluated where the outer pattern's warps have
// put the point, so that nested transforms compose.
#include "texture/pigment.h"

#include "texture/image_map.h"
#include "texture/map.h"
#include "texture/pattern.h"

#include <assert.h>
#include <math.h>

static const float EPS = 1e-10f; // POV-Ray's near-zero: less does not make a colour transparent

static Color blend(Color from, Color to, double w) {
    return (Color){
        from.r + (float)(w * (to.r - from.r)),
        from.g + (float)(w * (to.g - from.g)),
        from.b + (float)(w * (to.b - from.b)),
        from.filter + (float)(w * (to.filter - from.filter)),
        from.transmit + (float)(w * (to.transmit - from.transmit)),
    };
}

static bool entry_color(const Textures *textures, const MapEntry *entry, const TextureHit *hit,
                        Vec3 p, Color *color) {
    if (entry->pigment != NO_INDEX)
        return pigment_color(textures, entry->pigment, hit, p, color);
    *color = entry->color;
    return true;
}

// The mean of the entries by their weights; sums and weights are float.
static Color average(const Textures *textures, const Pigment *pigment, const TextureHit *hit,
                     Vec3 p) {
    Color sum = {0};
    float total = 0.0f;
    for (uint32_t i = 0; i < pigment->entry_count; i++) {
        const MapEntry *entry = &pigment->entries[i];
        Color c;
        entry_color(textures, entry, hit, p, &c);
        sum.r += c.r * entry->value;
        sum.g += c.g * entry->value;
        sum.b += c.b * entry->value;
        sum.filter += c.filter * entry->value;
        sum.transmit += c.transmit * entry->value;
        total += entry->value;
    }
    return (Color){sum.r / total, sum.g / total, sum.b / total, sum.filter / total,
                   sum.transmit / total};
}

bool pigment_color(const Textures *textures, uint32_t index, const TextureHit *hit, Vec3 p,
                   Color *color) {
    assert(index < textures->scene->pigment_count);
    const Pigment *pigment = &textures->scene->pigments[index];
    if (hit->quick && pigment->has_quick_color) {
        *color = pigment->quick_color;
        return true;
    }
    if (pigment->pattern.type == PATTERN_PLAIN) {
        *color = pigment->color;
        return true;
    }
    if (pigment->uv_mapping)
        p = vec3(hit->u, hit->v, 0.0);
    p = pattern_point(&pigment->pattern, p);
    if (pigment->pattern.type == PATTERN_IMAGE_MAP)
        return image_map_color(&textures->pictures[pigment->pattern.picture], p, color);
    if (pigment->pattern.type == PATTERN_AVERAGE) {
        *color = average(textures, pigment, hit, p);
        return true;
    }
    double v = pattern_value(textures, &pigment->pattern, hit, p);
    const MapEntry *entries = pigment->entries;
    MapPlace place = map_find(&entries->value, sizeof *entries, pigment->entry_count, v);
    const MapEntry *before = &entries[place.before], *entry = &entries[place.at];
    bool found = entry_color(textures, entry, hit, p, color);
    if (before != entry) {
        Color from;
        found |= entry_color(textures, before, hit, p, &from);
        *color = blend(from, *color, (v - before->value) / (entry->value - before->value));
    }
    return found;
}

static bool color_is_opaque(Color c) { return fabsf(c.filter) <= EPS && fabsf(c.transmit) <= EPS; }

bool pigment_is_opaque(const Textures *textures, uint32_t index) {
    const Pigment *pigment = &textures->scene->pigments[index];
    if (pigment->pattern.type == PATTERN_IMAGE_MAP)
        return textures->pictures[pigment->pattern.picture].opaque;
    if (pigment->pattern.type == PATTERN_PLAIN)
        return color_is_opaque(pigment->color);
    for (uint32_t i = 0; i < pigment->entry_count; i++) {
        const MapEntry *entry = &pigment->entries[i];
        if (entry->pigment != NO_INDEX ? !pigment_is_opaque(textures, entry->pigment)
                                       : !color_is_opaque(entry->color))
            return false;
    }
    return true;
}
