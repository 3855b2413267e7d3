// SPDX-License-Identifier: MIT
// What is known of the nearest hit of each pixel, as channels of an EXR picture: R, G, B, A of the
// picture itself (linear, as they are before the file's gamma), then of the ray through the pixel's
// middle, whatever the anti-aliasing:
//
//   depth    Z               distance along the ray, scene units; infinite where nothing is
//   normal   N.X N.Y N.Z     unit, the surface's own; 0 where nothing is
//   uv       uv.U uv.V       texture coordinates
//   patch    patch           number of the patch in the order of the scene; -1: none
//   steps    steps.leaf steps.qi steps.newton   work of the ray (PatchStats)
//   bound    bound           the hit's proven bound, scene units
//   object   object          number of the object in the scene file; -1: none
#ifndef RENDER_AOV_H
#define RENDER_AOV_H

#include "image/image.h"
#include "options/options.h"
#include "render/render.h"
#include "render/world.h"

// The channels of options->aovs, over the area to render, as view sees it; picture: its colours
// (width x height). Everything in arena.
ImageLayers *aov_render(const Scene *scene, const World *world, const CameraView *view,
                        const RenderOptions *options, const Color *picture, Arena *arena);

#endif
