// SPDX-License-Identifier: MIT
// The cases of `make stress`: scenes of patches, and rays aimed at what breaks intersectors. All of
// it is a function of (seed, case, scene, ray), so that any ray can be made again by its numbers.
#ifndef TESTS_STRESS_CASES_H
#define TESTS_STRESS_CASES_H

#include "ray_oracle.h"

#include "base/arena.h"
#include "base/rng.h"
#include "patch/patch.h"

// A side of a patch: 0 u = 0, 1 u = 1, 2 v = 0, 3 v = 1.
typedef struct {
    int patch, side;
} StressSide;

typedef struct {
    Arena *arena;
    int count, capacity;
    PatchDef *defs;                   // ids count from 0
    double *diameter, least_diameter; // of each patch's box
    RayOracleSet *oracle;
    Box box;
    Vec3 middle;
    double size;   // diagonal of box
    double detail; // what the case wants its rays to know
    // Of scenes of up to 64 patches: sides that two patches share, and sides that are points.
    StressSide shared[128], poles[32];
    int shared_count, pole_count;
} StressScene;

typedef enum {
    EXPECT_TRUTH, // what the oracle finds
    EXPECT_HIT,   // by construction a hit at t_known or before
    EXPECT_NONE,  // nothing: not a ray
} StressExpect;

typedef struct {
    Ray ray;
    double t_min, t_max;
    StressExpect expect;
    double t_known;
    // The ray only finds the place from which another leaves, along `onward`: that one is judged.
    bool leaves;
    Vec3 onward;
} StressRay;

typedef struct StressCase {
    const char *name, *what;
    double share;  // of all rays, relative to the others
    int per_scene; // rays
    void (*make)(StressScene *scene, Rng *rng, double parameter);
    void (*aim)(const StressScene *scene, Rng *rng, double parameter, StressRay *out);
    double parameter;
    double tolerance; // of the methods; 0: the default
    bool watertight;  // counts separately: only rays at closed edges, judged by what stops them
    int least;        // rays: fewer are not worth making its scene, and it is left out
    bool prepared;    // scene by scene in another way (PatchPrepare)
    // Some of its rays lie in a surface: infinitely many answers, of which `all` finds some in
    // bounded time. Times are told, and not judged by the median of those that do not.
    bool endless;
} StressCase;

extern const StressCase stress_cases[];
extern const int stress_case_count;

// *scene is made anew (its arena too); destroy it with stress_scene_destroy.
void stress_scene_make(const StressCase *which, uint64_t seed, uint64_t number, StressScene *scene);
void stress_scene_destroy(StressScene *scene);
void stress_ray_make(const StressCase *which, const StressScene *scene, uint64_t seed,
                     uint64_t number, uint64_t ray, StressRay *out);

// ---- Aims (stress_aims_hard.c; the others are in stress_cases.c)
void aim_surface(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_inside(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_bounds(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_uneven(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_tangent(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_secant(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_lattice(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_rulings(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_middle(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_folds(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_curve(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_distant(const StressScene *s, Rng *rng, double decades, StressRay *out);
void aim_leaving_hard(const StressScene *s, Rng *rng, double unused, StressRay *out);
void aim_any(const StressScene *s, Rng *rng, double unused, StressRay *out);

// ---- Scenes (stress_scenes.c, stress_scenes_hard.c): each adds patches to a scene.
void scene_teapot(StressScene *s, Rng *rng, double scale);
void scene_pot(StressScene *s, Rng *rng, double unused);   // the teapot as it is
void scene_sheet(StressScene *s, Rng *rng, double unused); // one bicubic patch
void scene_teapot_moved(StressScene *s, Rng *rng, double offset);
void scene_random(StressScene *s, Rng *rng, double wild); // one bicubic patch
void scene_degrees(StressScene *s, Rng *rng, double wild);
void scene_mesh(StressScene *s, Rng *rng, double wild); // patches that share sides
void scene_point(StressScene *s, Rng *rng, double unused);
void scene_segment(StressScene *s, Rng *rng, double unused);
void scene_flat(StressScene *s, Rng *rng, double unused);
void scene_saddle(StressScene *s, Rng *rng, double unused);
void scene_thin_sheets(StressScene *s, Rng *rng, double gap);
void scene_fold9(StressScene *s, Rng *rng, double unused);
void scene_line18(StressScene *s, Rng *rng, double unused);
void scene_double_rows(StressScene *s, Rng *rng, double unused);
void scene_aspect(StressScene *s, Rng *rng, double ratio);
void scene_ribbon(StressScene *s, Rng *rng, double ratio);
void scene_ribbon10(StressScene *s, Rng *rng, double unused);
void scene_cusp(StressScene *s, Rng *rng, double unused);
void scene_self_crossing(StressScene *s, Rng *rng, double unused);
void scene_twisted(StressScene *s, Rng *rng, double unused);
void scene_collapsed(StressScene *s, Rng *rng, double unused);
void scene_t_junction(StressScene *s, Rng *rng, double unused);
void scene_scaled(StressScene *s, Rng *rng, double scale);
void scene_rational(StressScene *s, Rng *rng, double decades);
void scene_round(StressScene *s, Rng *rng, double unused);
void scene_mixed_sizes(StressScene *s, Rng *rng, double unused);
void scene_many(StressScene *s, Rng *rng, double teapots);
void scene_lattice(StressScene *s, Rng *rng, double unused);
void scene_repeated(StressScene *s, Rng *rng, double wild);
void scene_uneven(StressScene *s, Rng *rng, double decades);
void scene_coincident(StressScene *s, Rng *rng, double wild);
void scene_stack(StressScene *s, Rng *rng, double wild);
void scene_ruled(StressScene *s, Rng *rng, double unused);
void scene_tilted(StressScene *s, Rng *rng, double unused);
void scene_curve(StressScene *s, Rng *rng, double unused);
void scene_folds(StressScene *s, Rng *rng, double unused);
void scene_pinch(StressScene *s, Rng *rng, double unused);
void scene_sphere(StressScene *s, Rng *rng, double unused);
void scene_far_small(StressScene *s, Rng *rng, double offset);
void scene_far_mesh(StressScene *s, Rng *rng, double offset);
void scene_any(StressScene *s, Rng *rng, double unused);

// Adds a patch; returns its points, to be written.
Vec3 *stress_add(StressScene *s, int du, int dv);
// A random linear map of all points, so that no axis is special.
void stress_turn(StressScene *s, Rng *rng);
void stress_move(StressScene *s, double scale, Vec3 offset);

Vec3 stress_direction(Rng *rng);
// A point of a patch, with its tangents.
Vec3 stress_point(const StressScene *s, int patch, double u, double v, Vec3 *su, Vec3 *sv);

#endif
