// SPDX-License-Identifier: MIT
// Textures, as far as they can be judged without light.
#ifndef TEXTURE_TEXTURE_H
#define TEXTURE_TEXTURE_H

#include "texture/textures.h"

// A shadow ray that meets this texture ends there: some layer is opaque everywhere, or all textures
// that a pattern mixes are. NO_INDEX, the built-in black, is.
bool texture_is_opaque(const Textures *textures, uint32_t texture);

// The layers of the largest texture that can be met in this one.
uint32_t texture_layer_limit(const Scene *scene);

// The patterned textures around the layers at hand, outermost first: their normals stand in the
// space of all of these. As in POV-Ray the list only grows while a hit is judged, so that what
// stands later in a map is also turned by what was met earlier. POV-Ray's has no end; more than
// these do not turn normals.
enum { TEXTURE_SPACES = 32 };
typedef struct {
    const Texture *textures[TEXTURE_SPACES];
    uint32_t count;
} TextureSpaces;

// What is to be done for a texture at p: its layers at *p; or, with no layers, `count` textures
// (1, 2, or all of an average) at *p with their weights.
typedef struct {
    Vec3 p;
    const Texture *layers;     // or NULL
    const IndexEntry *entries; // those of the map, all of them
    uint32_t first, second;    // indices into entries, the same twice if there is only one
    double share;              // of the first; the second has the rest
    bool average;
} TextureChoice;

// Layers where they are: there is nothing to choose.
static inline bool texture_is_plain(const Texture *texture) {
    return texture->layer_count > 0 && !texture->uv_mapping &&
           texture->pattern.type == PATTERN_PLAIN;
}
TextureChoice texture_choose(const Textures *textures, uint32_t texture, TextureSpaces *spaces,
                             const TextureHit *hit, Vec3 p);

// The colours of those textures mixed as the choice says: two of them, or the mean of an average.
Color texture_mix(double share, Color first, Color second);
typedef struct {
    Color sum;
    float total;
} TextureMean;
TextureMean texture_mean(TextureMean mean, float weight, Color color);
Color texture_mean_color(TextureMean mean);

// The normal of one layer at p (where texture_choose has put it). n: the surface's own, turned
// against the ray.
Vec3 texture_normal(const Textures *textures, const Layer *layer, const TextureSpaces *spaces,
                    TextureHit *hit, Vec3 p, Vec3 n);

#endif
