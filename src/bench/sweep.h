// SPDX-License-Identifier: MIT
// The trade of speed against accuracy on one scene: every method at several tolerances, POV-Ray's
// triangles at several depths, and POV-Ray itself, each against the truth (`qi` at 1e-14).
//
// Each point is measured in a process of its own on one pinned thread, in rounds that go through
// all points in turn; times are processor time, medians with the least and the largest.
#ifndef BENCH_SWEEP_H
#define BENCH_SWEEP_H

#include "base/arena.h"
#include "image/image.h"
#include "patch/patch.h"

#include <stdbool.h>
#include <stddef.h>

enum { SWEEP_MOST_ROUNDS = 21 };

typedef struct {
    const char *scene;          // a .pov
    const char **library_paths; // for its includes, the scene's folder not among them
    size_t library_path_count;
    int width, height;
    int rounds; // odd
    // Seconds of processor time that a point may take: one that takes longer is given up, and so
    // are those of its curve that are finer; one that has taken them after some rounds has no more.
    double patience;
    bool povray; // run it too
} SweepOptions;

SweepOptions sweep_options_default(void); // no scene; 320 x 240, 3 rounds, 60 s

// What is measured.
typedef struct {
    bool povray;
    PatchMethod method;
    PatchPrepare prepare; // of qi
    double tolerance;     // of ours but facets
    int steps;            // of triangles: u_steps and v_steps; else -1
    double flatness;      // of triangles: 0 cuts down to the steps
} SweepPoint;

typedef struct {
    double median, least, most;
} Spread;

typedef struct {
    SweepPoint point;
    const char *failed;     // why there is nothing more; NULL: there is
    int rounds;             // that were measured
    Spread prepare, trace;  // seconds: patches and tree; one ray a pixel. Not of POV-Ray
    Spread picture;         // seconds: all of the picture, of POV-Ray without reading the scene
    double rays_per_second; // of trace
    double megabytes;       // at the peak, beyond what the scene that was read takes
    // Of hits, where both met the same patch; not of POV-Ray. Distances along the true normal.
    double position_max, position_rms; // in diameters of the patch
    double rounding;                   // of the hits' own numbers at most, diameters
    double position_pixels;            // the largest, in pixels there
    double normal_max, normal_rms;     // degrees
    double wrong;                      // share of pixels that met something else, or nothing
    double leaks;                      // share of the rays through shared edges that slip through
    int holes;                         // pixels inside a surface that show what lies behind it
    // Of the picture.
    double rms, psnr; // steps of 8 bits; dB
    double off;       // share of pixels off by more than a step
    double rms_same;  // rms over pixels whose rays meet the same object; not of POV-Ray
    double worst;     // the largest difference, steps, and where
    int worst_x, worst_y;
    bool front; // nothing is both faster to its picture and nearer to the truth
} SweepResult;

typedef struct {
    const char *scene;
    int width, height, rounds;
    double patience;
    uint32_t patches;
    size_t edges, edge_rays; // shared smooth edges, rays through them (edges.h)
    SweepResult *results;
    size_t count;
    const char *no_povray;      // why POV-Ray's own points are missing; NULL: they are there
    const char *povray_version; // NULL: not there
    // Maps, one value a pixel: of the scene's own triangles against the truth, and of qi's work.
    Image *distance, *angle, *steps, *leaves;
    Image *picture; // the truth
} Sweep;

// Takes the signals (report/run.h). Dies when the scene cannot be read. NULL when it was
// interrupted. Memory in arena.
Sweep *sweep_run(const SweepOptions *options, Arena *arena);

// "qi 1e-09", "qi prepared light 1e-09", "povray u_steps 4"
const char *sweep_point_name(const SweepPoint *point, Arena *arena);

#endif
