// SPDX-License-Identifier: MIT
// Normals (facts: textures 5). A normal is carried through the pattern's transforms, bent there,
// and carried back; the four corners of a small pyramid around the point tell how the pattern's
// value slopes, unless the pattern bends in a way of its own (bump.c) or chooses among normals.
#include "texture/normal.h"

#include "texture/formula.h"
#include "texture/image_map.h"
#include "texture/map.h"
#include "texture/pattern.h"

#include <assert.h>

// Into the space of a transform: by the transposed matrix.
static Vec3 turn_into(const Transform *t, Vec3 n) {
    const double(*m)[4] = t->m;
    return vec3(n.x * m[0][0] + n.y * m[0][1] + n.z * m[0][2],
                n.x * m[1][0] + n.y * m[1][1] + n.z * m[1][2],
                n.x * m[2][0] + n.y * m[2][1] + n.z * m[2][2]);
}

Vec3 normal_into(const Pattern *pattern, bool no_bump_scale, Vec3 n) {
    if (!no_bump_scale)
        n = vec_normalize(n);
    for (uint32_t i = 0; i < pattern->warp_count; i++)
        if (pattern->warps[i].type == WARP_TRANSFORM)
            n = turn_into(&pattern->warps[i].transform, n);
    return no_bump_scale ? n : vec_normalize(n);
}

Vec3 normal_out(const Pattern *pattern, bool no_bump_scale, Vec3 n) {
    if (!no_bump_scale)
        n = vec_normalize(n);
    for (uint32_t i = pattern->warp_count; i-- > 0;)
        if (pattern->warps[i].type == WARP_TRANSFORM)
            n = transform_normal(&pattern->warps[i].transform, n);
    return no_bump_scale ? n : vec_normalize(n);
}

// The height that a slope_map gives a value: a cubic between two entries, t not being scaled by
// their distance.
static double slope_height(const Normal *normal, double v) {
    if (normal->slope_count == 0)
        return v;
    const SlopeEntry *slopes = normal->slopes;
    MapPlace place = map_find(&slopes->value, sizeof *slopes, normal->slope_count, v);
    const SlopeEntry *a = &slopes[place.before], *b = &slopes[place.at];
    if (a == b)
        return b->height;
    double t = (v - a->value) / (b->value - a->value), t2 = t * t, t3 = t2 * t;
    double h = t3 * (a->slope + b->slope + 2.0 * (a->height - b->height));
    h += -t2 * (2.0 * a->slope + b->slope + 3.0 * (a->height - b->height));
    h += t * a->slope + a->height;
    return h;
}

static Vec3 bend_by_height(const Textures *textures, const Normal *normal, const TextureHit *hit,
                           Vec3 p, Vec3 n) {
    static const Vec3 corners[4] = {{0.942809041, -0.333333333, 0.0},
                                    {-0.471404521, -0.333333333, 0.816496581},
                                    {-0.471404521, -0.333333333, -0.816496581},
                                    {0.0, 1.0, 0.0}};
    double amount = normal->amount * -5.0;
    amount *= 0.02 / normal->accuracy;
    for (int i = 0; i < 4; i++) {
        Vec3 at = vec_madd(p, normal->accuracy, corners[i]);
        double v = pattern_value(textures, &normal->pattern, hit, at);
        n = vec_madd(n, slope_height(normal, v) * amount, corners[i]);
    }
    return n;
}

static Vec3 bend_average(const Textures *textures, const Normal *normal, TextureHit *hit, Vec3 p,
                         Vec3 n) {
    Vec3 sum = vec3(0.0, 0.0, 0.0);
    float total = 0.0f;
    for (uint32_t i = 0; i < normal->entry_count; i++) {
        const IndexEntry *entry = &normal->entries[i];
        sum = vec_madd(sum, entry->value, normal_bend(textures, entry->index, hit, p, n));
        total += entry->value;
    }
    return vec_scale(sum, 1.0 / total);
}

// Two neighbours of a normal_map; each bends the same normal, the later one first.
static Vec3 bend_map(const Textures *textures, const Normal *normal, TextureHit *hit, Vec3 p,
                     Vec3 n) {
    double v = pattern_value(textures, &normal->pattern, hit, p);
    const IndexEntry *entries = normal->entries;
    MapPlace place = map_find(&entries->value, sizeof *entries, normal->entry_count, v);
    const IndexEntry *a = &entries[place.before], *b = &entries[place.at];
    Vec3 bent = normal_bend(textures, b->index, hit, p, n);
    if (a == b)
        return bent;
    Vec3 other = normal_bend(textures, a->index, hit, p, n);
    double share = (v - a->value) / (b->value - a->value), rest = 1.0 - share;
    return vec3(rest * other.x + share * bent.x, rest * other.y + share * bent.y,
                rest * other.z + share * bent.z);
}

static Vec3 bend(const Textures *textures, const Normal *normal, TextureHit *hit, Vec3 p, Vec3 n) {
    const Pattern *pattern = &normal->pattern;
    double amount = normal->amount;
    switch (pattern->type) {
    case PATTERN_AVERAGE:
        return bend_average(textures, normal, hit, p, n);
    case PATTERN_BUMP_MAP:
        return image_map_bump(&textures->pictures[pattern->picture], amount, p, n);
    case PATTERN_BUMPS:
        return bump_bumps(amount, p, n);
    case PATTERN_DENTS:
        return bump_dents(amount, p, n, pattern_generator(textures, pattern));
    case PATTERN_FACETS:
        return bump_facets(&pattern->facets, p, n);
    case PATTERN_QUILTED:
        return bump_quilted(pattern, amount, p, n);
    case PATTERN_RIPPLES:
    case PATTERN_WAVES:
        return bump_waves(pattern, amount, p, n, textures->scene->settings.number_of_waves);
    case PATTERN_WRINKLES:
        return bump_wrinkles(amount, p, n);
    default:
        return bend_by_height(textures, normal, hit, p, n);
    }
}

Vec3 normal_bend(const Textures *textures, uint32_t index, TextureHit *hit, Vec3 p, Vec3 n) {
    assert(index < textures->scene->normal_count);
    const Normal *normal = &textures->scene->normals[index];
    const Pattern *pattern = &normal->pattern;
    if (normal->uv_mapping)
        p = vec3(hit->u, hit->v, 0.0);
    p = pattern_point(pattern, p);
    n = normal_into(pattern, normal->no_bump_scale, n);
    if (normal->entry_count > 0 && pattern->type != PATTERN_AVERAGE) {
        n = bend_map(textures, normal, hit, p, n);
        n = vec_normalize(normal_out(pattern, normal->no_bump_scale, n));
    } else {
        n = bend(textures, normal, hit, p, n);
        n = normal_out(pattern, normal->no_bump_scale, n);
    }
    if (normal->uv_mapping)
        n = vec_normalize(n);
    hit->normal = n;
    return n;
}
