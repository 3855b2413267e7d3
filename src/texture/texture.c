// SPDX-License-Identifier: MIT
// Stacks of layers without light (facts: textures 1.3, 1.5); the lit colour is render/shade.c.
#include "texture/texture.h"

bool texture_is_opaque(const Scene *scene, uint32_t index) {
    if (index == NO_INDEX)
        return true;
    const Texture *texture = &scene->textures[index];
    for (uint32_t i = 0; i < texture->layer_count; i++)
        if (pigment_is_opaque(scene, texture->layers[i].pigment))
            return true;
    return false;
}

TexturePoint texture_point(const Texture *texture, bool object_uv_mapping, Vec3 p, double u,
                           double v, bool quick) {
    if (texture->uv_mapping || object_uv_mapping)
        p = vec3(u, v, 0.0);
    return (TexturePoint){p, u, v, quick};
}
