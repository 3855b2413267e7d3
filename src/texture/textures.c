// SPDX-License-Identifier: MIT
#include "texture/textures.h"

#include "noise/noise.h"

Textures textures_make(const Scene *scene) {
    noise_prepare();
    return (Textures){.scene = scene};
}

TextureHit texture_no_hit(bool quick) { return (TextureHit){.quick = quick}; }
