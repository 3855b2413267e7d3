// SPDX-License-Identifier: MIT
// A point becomes a colour: the pattern's value looked up in the pigment's map (facts: textures
// 4.1). A map holds colours or pigments; those are evaluated where the outer pattern's warps have
// put the point, so that nested transforms compose.
#include "texture/pigment.h"

#include "texture/pattern.h"

#include <assert.h>
#include <math.h>

static const float EPS = 1e-10f; // POV-Ray's near-zero: less does not make a colour transparent

// The two neighbours of v in the map; the same one twice when no blending is needed. Entries keep
// the order of the file; at a position written twice the first counts, but at the last one the
// last.
static void map_find(const Pigment *pigment, double v, uint32_t *before, uint32_t *at) {
    const MapEntry *entries = pigment->entries;
    uint32_t last = pigment->entry_count - 1, i = 0;
    if (v >= entries[last].value) {
        *before = *at = last;
        return;
    }
    while (i < last && v > entries[i].value)
        i++;
    *at = i;
    *before = i == 0 || v == entries[i].value ? i : i - 1;
}

static Color blend(Color from, Color to, double w) {
    return (Color){
        from.r + (float)(w * (to.r - from.r)),
        from.g + (float)(w * (to.g - from.g)),
        from.b + (float)(w * (to.b - from.b)),
        from.filter + (float)(w * (to.filter - from.filter)),
        from.transmit + (float)(w * (to.transmit - from.transmit)),
    };
}

static bool entry_color(const Scene *scene, const MapEntry *entry, const TexturePoint *at,
                        Color *color) {
    if (entry->pigment != NO_INDEX)
        return pigment_color(scene, entry->pigment, at, color);
    *color = entry->color;
    return true;
}

// The mean of the entries by their weights; sums and weights are float.
static Color average(const Scene *scene, const Pigment *pigment, const TexturePoint *at) {
    Color sum = {0};
    float total = 0.0f;
    for (uint32_t i = 0; i < pigment->entry_count; i++) {
        const MapEntry *entry = &pigment->entries[i];
        Color c;
        entry_color(scene, entry, at, &c);
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

bool pigment_color(const Scene *scene, uint32_t index, const TexturePoint *at, Color *color) {
    assert(index < scene->pigment_count);
    const Pigment *pigment = &scene->pigments[index];
    if (at->quick && pigment->has_quick_color) {
        *color = pigment->quick_color;
        return true;
    }
    if (pigment->pattern.type == PATTERN_PLAIN) {
        *color = pigment->color;
        return true;
    }
    TexturePoint inner = *at;
    if (pigment->uv_mapping)
        inner.p = vec3(at->u, at->v, 0.0);
    inner.p = pattern_point(&pigment->pattern, inner.p);
    if (pigment->pattern.type == PATTERN_AVERAGE) {
        *color = average(scene, pigment, &inner);
        return true;
    }
    double v = pattern_value(&scene->settings, &pigment->pattern, inner.p);
    uint32_t i, j;
    map_find(pigment, v, &i, &j);
    const MapEntry *before = &pigment->entries[i], *entry = &pigment->entries[j];
    bool found = entry_color(scene, entry, &inner, color);
    if (i != j) {
        Color from;
        found |= entry_color(scene, before, &inner, &from);
        *color = blend(from, *color, (v - before->value) / (entry->value - before->value));
    }
    return found;
}

static bool color_is_opaque(Color c) { return fabsf(c.filter) <= EPS && fabsf(c.transmit) <= EPS; }

bool pigment_is_opaque(const Scene *scene, uint32_t index) {
    const Pigment *pigment = &scene->pigments[index];
    if (pigment->pattern.type == PATTERN_PLAIN)
        return color_is_opaque(pigment->color);
    for (uint32_t i = 0; i < pigment->entry_count; i++) {
        const MapEntry *entry = &pigment->entries[i];
        if (entry->pigment != NO_INDEX ? !pigment_is_opaque(scene, entry->pigment)
                                       : !color_is_opaque(entry->color))
            return false;
    }
    return true;
}
