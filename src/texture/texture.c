// SPDX-License-Identifier: MIT
// Textures without light (facts: textures 1.3-1.5); the lit colours are render/shade.c.
#include "texture/texture.h"

#include "texture/image_map.h"
#include "texture/map.h"
#include "texture/normal.h"
#include "texture/pattern.h"
#include "texture/pigment.h"

bool texture_is_opaque(const Textures *textures, uint32_t index) {
    if (index == NO_INDEX)
        return true;
    const Texture *texture = &textures->scene->textures[index];
    for (uint32_t i = 0; i < texture->layer_count; i++)
        if (pigment_is_opaque(textures, texture->layers[i].pigment))
            return true;
    for (uint32_t i = 0; i < texture->entry_count; i++)
        if (!texture_is_opaque(textures, texture->entries[i].index))
            return false;
    return texture->entry_count > 0;
}

uint32_t texture_layer_limit(const Scene *scene) {
    uint32_t limit = 0;
    for (uint32_t i = 0; i < scene->texture_count; i++)
        if (scene->textures[i].layer_count > limit)
            limit = scene->textures[i].layer_count;
    return limit;
}

TextureChoice texture_choose(const Textures *textures, uint32_t index, TextureSpaces *spaces,
                             const TextureHit *hit, Vec3 p) {
    const Texture *texture = &textures->scene->textures[index];
    const Pattern *pattern = &texture->pattern;
    TextureChoice choice = {.p = p, .entries = texture->entries, .share = 1.0};
    if (texture->uv_mapping)
        choice.p = vec3(hit->u, hit->v, 0.0);
    if ((texture->uv_mapping || pattern->type != PATTERN_PLAIN) && spaces->count < TEXTURE_SPACES)
        spaces->textures[spaces->count++] = texture;
    if (texture->layer_count > 0) {
        choice.layers = texture;
        return choice;
    }
    if (pattern->type == PATTERN_PLAIN)
        return choice; // the one entry of a uv_mapping
    choice.p = pattern_point(pattern, choice.p);
    if (pattern->type == PATTERN_AVERAGE) {
        choice.average = true;
        choice.second = texture->entry_count;
        return choice;
    }
    if (pattern->type == PATTERN_MATERIAL_MAP) {
        choice.first = choice.second = image_map_material(&textures->pictures[pattern->picture],
                                                          texture->entry_count, choice.p);
        return choice;
    }
    double v = pattern_value(textures, pattern, hit, choice.p);
    const IndexEntry *entries = texture->entries;
    MapPlace place = map_find(&entries->value, sizeof *entries, texture->entry_count, v);
    choice.first = place.at;
    choice.second = place.before;
    if (place.at != place.before) {
        const IndexEntry *before = &entries[place.before], *at = &entries[place.at];
        choice.share = (v - before->value) / (at->value - before->value);
    }
    return choice;
}

Color texture_mix(double share, Color first, Color second) {
    double rest = 1.0 - share;
    return (Color){
        (float)(share * first.r) + (float)(rest * second.r),
        (float)(share * first.g) + (float)(rest * second.g),
        (float)(share * first.b) + (float)(rest * second.b),
        (float)(share * first.filter) + (float)(rest * second.filter),
        (float)(share * first.transmit) + (float)(rest * second.transmit),
    };
}

TextureMean texture_mean(TextureMean mean, float weight, Color c) {
    mean.sum.r += c.r * weight;
    mean.sum.g += c.g * weight;
    mean.sum.b += c.b * weight;
    mean.sum.filter += c.filter * weight;
    mean.sum.transmit += c.transmit * weight;
    mean.total += weight;
    return mean;
}

Color texture_mean_color(TextureMean mean) {
    Color c = mean.sum;
    float total = mean.total;
    return (Color){c.r / total, c.g / total, c.b / total, c.filter / total, c.transmit / total};
}

Vec3 texture_normal(const Textures *textures, const Layer *layer, const TextureSpaces *spaces,
                    TextureHit *hit, Vec3 p, Vec3 n) {
    if (layer->normal == NO_INDEX)
        return n;
    for (uint32_t i = 0; i < spaces->count; i++)
        n = normal_into(&spaces->textures[i]->pattern, spaces->textures[i]->no_bump_scale, n);
    n = normal_bend(textures, layer->normal, hit, p, n);
    if (textures->scene->normals[layer->normal].no_bump_scale)
        n = vec_normalize(n);
    for (uint32_t i = spaces->count; i-- > 0;)
        n = normal_out(&spaces->textures[i]->pattern, spaces->textures[i]->no_bump_scale, n);
    return n;
}
