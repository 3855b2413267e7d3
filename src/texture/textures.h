// SPDX-License-Identifier: MIT
// A scene's textures made ready to be asked, and what is known of the point that is asked about.
#ifndef TEXTURE_TEXTURES_H
#define TEXTURE_TEXTURES_H

#include "function/function.h"
#include "model/scene.h"

struct ImageMap;
struct Density;

typedef struct {
    const Scene *scene;              // must outlive this
    const struct ImageMap *pictures; // one per picture of the scene
    const struct Density *densities; // likewise
    FunctionPool functions;
    // Is p in the object of a pattern: number `object` of scene->projections? Who makes the objects
    // ready fills these in.
    bool (*inside)(const void *objects, uint32_t object, Vec3 p);
    const void *objects;
} Textures;

// Builds the tables of the noise too, and reads the files; dies with a message if one cannot be
// read. All memory in arena.
Textures *textures_create(const Scene *scene, Arena *arena);

// The surface where a ray has met it.
typedef struct {
    Vec3 p;      // in the world
    Vec3 dir;    // of the ray
    double u, v; // texture coordinates
    Vec3 normal; // what `slope` and `aoi` see: the surface's, turned against the ray, until a
                 // normal bends it; then whatever was bent last
    bool quick;  // quality 0..5: a quick_color stands for its pigment
} TextureHit;

// Where nothing was met: skies, fog, functions.
TextureHit texture_no_hit(bool quick);

#endif
