// SPDX-License-Identifier: MIT
// Inside the room: the functions that functions.inc declares (f_sphere, f_heart, ...), by their
// numbers. Each has POV-Ray's formula in POV-Ray's order of operations, so that its values are the
// same to the last bit.
#ifndef FUNCTION_INTERNAL_H
#define FUNCTION_INTERNAL_H

#include <math.h>
#include <stdint.h>

typedef struct {
    int noise_generator; // of the scene
    uint64_t *budget;    // rounds of loops that may still run
} InternalContext;

// p: x, y, z and then the function's own arguments.
typedef double InternalFunction(const double *p, const InternalContext *context);

// ORDER internal_number; 77 is none and gives 0.
extern InternalFunction *const INTERNAL_FUNCTIONS[];

// As std::max and std::min: of a NaN and a number the first.
static inline double internal_max(double a, double b) { return a < b ? b : a; }
static inline double internal_min(double a, double b) { return b < a ? b : a; }
static inline double square(double v) { return v * v; }

#define INTERNAL_PI 3.1415926535897932384626
#define INTERNAL_TWO_PI 6.283185307179586476925286766560
#define INTERNAL_DEGREE 0.01745329251994329576

#define INTERNAL(name)                                                                             \
    double name(const double *p, const InternalContext *context __attribute__((unused)))

// polynomials (internal_polynomial.c)
InternalFunction f_bicorn, f_bifolia, f_boy_surface, f_crossed_trough, f_cubic_saddle, f_cushion,
    f_devils_curve, f_dupin_cyclid, f_enneper, f_folium_surface, f_glob, f_heart, f_hunt_surface,
    f_hyperbolic_torus, f_kampyle_of_eudoxus, f_klein_bottle, f_kummer_surface_v1,
    f_kummer_surface_v2, f_lemniscate_of_gerono, f_mitre, f_nodal_cubic, f_odd, f_ovals_of_cassini,
    f_paraboloid, f_parabolic_torus, f_pillow, f_piriform, f_quartic_paraboloid, f_quartic_saddle,
    f_quartic_cylinder, f_steiners_roman, f_strophoid, f_torus2, f_torus_gumdrop, f_umbrella,
    f_witch_of_agnesi;
// plane curves, extruded or swept (internal_curve.c)
InternalFunction f_algbr_cyl1, f_algbr_cyl2, f_algbr_cyl3, f_algbr_cyl4, f_devils_curve_2d,
    f_folium_surface_2d, f_kampyle_of_eudoxus_2d, f_lemniscate_of_gerono_2d, f_piriform_2d,
    f_strophoid_2d, f_witch_of_agnesi_2d;
// the rest (internal_shape.c)
InternalFunction f_blob, f_blob2, f_comma, f_cross_ellipsoids, f_ellipsoid, f_flange_cover,
    f_helical_torus, f_helix1, f_helix2, f_hex_x, f_hex_y, f_isect_ellipsoids, f_mesh1, f_ph,
    f_poly4, f_polytubes, f_quantum, f_r, f_rounded_box, f_sphere, f_spikes, f_spikes_2d, f_spiral,
    f_superellipsoid, f_th, f_torus;
// noise (internal_noise.c)
InternalFunction f_hetero_mf, f_ridge, f_ridged_mf, f_noise3d, f_noise_generator;

#endif
