// SPDX-License-Identifier: MIT
// What the benchmarks shoot at, and from where: the teapot of POV-Ray's examples in three views,
// and lattices of jittered teapots.
#ifndef BENCH_VIEWS_H
#define BENCH_VIEWS_H

#include "base/arena.h"
#include "base/vec.h"
#include "patch/patch.h"

#include <stddef.h>

enum {
    VIEW_SIDE = 1024,
    VIEW_RAYS = VIEW_SIDE * VIEW_SIDE,
    VIEW_GROUP = 16, // so many rays belong together: 4 x 4 pixels
    TEAPOT_PATCHES = 32
};

// Points of 32 patches, 16 each. Dies when povray-examples is not installed.
const Vec3 *teapot_points(Arena *arena);

// As many patches as asked, from teapots in a cubic lattice, each point moved by up to 1e-3 at
// random, so that no two patches are alike.
const Vec3 *lattice_points(Arena *arena, size_t patches);

Box points_bounds(const Vec3 *points, size_t count);

// The set of bicubic patches, not yet committed.
PatchSet *set_of_points(const Vec3 *points, size_t patches, const PatchSetOptions *options);

// ORDER view (names in views.c). full and zoom: 1024 x 1024 cameras at (0,-10,1.5) along y, windows
// on y = 0; full x +-3.6, z -2.1 to 5.1 (22.6 % hit), zoom x +-1.35, z 0.15 to 2.2 (all hit).
// scattered: between two random points of the sphere about the box.
typedef enum { VIEW_FULL, VIEW_ZOOM, VIEW_SCATTERED, VIEW_COUNT } View;
const char *view_name(View view);
// VIEW_RAYS of them.
const Ray *view_rays(Arena *arena, View view, Box bounds);

#endif
