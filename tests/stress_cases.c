// SPDX-License-Identifier: MIT
// The list of cases, and how their rays are aimed.
#include "stress_cases.h"

#include <string.h>

enum { SIDE_SCENE = 64 };

// ---- Places

static int pick(Rng *rng, int count) { return (int)(rng_next(rng) % (uint64_t)count); }

static Vec3 in_box(Rng *rng, const Box *box) {
    return vec3(rng_range(rng, box->low.x, box->high.x), rng_range(rng, box->low.y, box->high.y),
                rng_range(rng, box->low.z, box->high.z));
}

static Vec3 random_point(const StressScene *s, Rng *rng) {
    double u = rng_unit(rng), v = rng_unit(rng);
    return stress_point(s, pick(rng, s->count), u, v, NULL, NULL);
}

static Vec3 side_point(const StressScene *s, StressSide side, double t) {
    double end = side.side % 2;
    return side.side < 2 ? stress_point(s, side.patch, end, t, NULL, NULL)
                         : stress_point(s, side.patch, t, end, NULL, NULL);
}

// Towards a point from outside of the scene, in one step of t.
static Ray from_outside(const StressScene *s, Rng *rng, Vec3 target) {
    Vec3 org = vec_madd(s->middle, rng_range(rng, 0.6, 2.0) * s->size, stress_direction(rng));
    return (Ray){org, vec_sub(target, org)};
}

// ---- Aims

static void aim_hull(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    out->ray = from_outside(s, rng, in_box(rng, &s->box));
}

void aim_inside(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    out->ray = (Ray){in_box(rng, &s->box), stress_direction(rng)};
    if (rng_next(rng) % 4 == 0) // both ways
        out->t_min = -INFINITY;
}

void aim_surface(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    out->ray = from_outside(s, rng, random_point(s, rng));
}

static void aim_far(const StressScene *s, Rng *rng, double far, StressRay *out) {
    Vec3 d = stress_direction(rng), p = random_point(s, rng);
    double away = s->size * pow(10.0, rng_range(rng, 1.0, log10(far)));
    out->ray = (Ray){vec_madd(p, -away, d), d};
}

// At edges and corners that patches share, from outside and from within.
static void aim_edges(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    uint64_t kind = rng_next(rng) % 16;
    double t = kind == 0 ? 0.0 : kind == 1 ? 1.0 : kind == 2 ? 0.5 : rng_unit(rng);
    Vec3 target = side_point(s, s->shared[pick(rng, s->shared_count)], t);
    if (rng_next(rng) % 2) {
        out->ray = from_outside(s, rng, target);
    } else {
        Vec3 org = vec_madd(s->middle, 0.1 * s->size * rng_unit(rng), stress_direction(rng));
        out->ray = (Ray){org, vec_sub(target, org)};
    }
    out->expect = EXPECT_HIT;
    out->t_known = 1.0;
}

static Vec3 beside(Rng *rng, const StressScene *s, Vec3 at) {
    if (rng_next(rng) % 4 == 0)
        return at;
    double off = s->size * pow(10.0, rng_range(rng, -13.0, -1.0));
    return vec_madd(at, off, stress_direction(rng));
}

// At a collapsed side exactly, or a little beside it.
static void aim_pole(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    Vec3 pole = side_point(s, s->poles[pick(rng, s->pole_count)], rng_unit(rng));
    out->ray = from_outside(s, rng, beside(rng, s, pole));
}

// The range begins or ends on a pole to the last bit, or nearly.
static void aim_pole_range(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    Vec3 pole = side_point(s, s->poles[pick(rng, s->pole_count)], 0.0);
    out->ray = from_outside(s, rng, pole);
    uint64_t kind = rng_next(rng) % 4;
    double at = 1.0 + (kind % 2 ? rng_range(rng, -1.0, 1.0) * 1e-15 : 0.0);
    if (kind < 2)
        out->t_min = at;
    else
        out->t_max = at;
    if (rng_next(rng) % 4 == 0) // the ray itself begins there
        out->ray.org = pole, out->t_min = 0.0, out->t_max = INFINITY;
}

// Both ends of the range among the crossings.
static void aim_range(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    out->ray = from_outside(s, rng, random_point(s, rng));
    out->t_min = rng_next(rng) % 2 ? 1.0 : rng_range(rng, 0.5, 1.0);
    out->t_max = rng_next(rng) % 2 ? INFINITY : rng_range(rng, 1.0, 1.5);
}

static void aim_parameters(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    static const int parts[] = {2, 3, 4, 8, 9, 16, 27, 32, 64, 81};
    double at[2];
    for (int k = 0; k < 2; k++) {
        int n = parts[rng_next(rng) % (sizeof parts / sizeof *parts)];
        at[k] = rng_next(rng) % 4 ? (double)pick(rng, n + 1) / n : rng_unit(rng);
    }
    Vec3 p = stress_point(s, pick(rng, s->count), at[0], at[1], NULL, NULL);
    out->ray = from_outside(s, rng, p);
}

// Along an axis, zeros of either sign.
static void aim_axis(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    double c[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < 3; k++)
        c[k] = rng_next(rng) % 2 ? 0.0 : -0.0;
    c[pick(rng, 3)] = rng_next(rng) % 2 ? 1.0 : -1.0;
    if (rng_next(rng) % 4 == 0)
        c[pick(rng, 3)] = rng_range(rng, -1.0, 1.0);
    Vec3 d = vec3(c[0], c[1], c[2]);
    out->ray = (Ray){vec_madd(random_point(s, rng), -rng_range(rng, 0.1, 2.0) * s->size, d), d};
    if (rng_next(rng) % 8 == 0) {
        double *zero = pick(rng, 2) ? &out->ray.org.x : &out->ray.org.y;
        *zero = -0.0;
    }
}

// Parallel to a tangent plane, `height` sizes above or below it.
static void aim_grazing(const StressScene *s, Rng *rng, double height, StressRay *out) {
    Vec3 su, sv;
    double u = rng_unit(rng), v = rng_unit(rng);
    Vec3 p = stress_point(s, pick(rng, s->count), u, v, &su, &sv);
    Vec3 n = vec_cross(su, sv);
    Vec3 d = vec_add(vec_scale(su, rng_range(rng, -1, 1)), vec_scale(sv, rng_range(rng, -1, 1)));
    if (!(vec_length(n) > 0.0) || !(vec_length(d) > 0.0)) {
        aim_surface(s, rng, 0.0, out);
        return;
    }
    double up = (rng_next(rng) % 2 ? height : -height) * s->size;
    p = vec_madd(p, up, vec_normalize(n));
    d = vec_normalize(d);
    out->ray = (Ray){vec_madd(p, -rng_range(rng, 0.1, 2.0) * s->size, d), d};
}

// From a hit on the surface, in any direction.
static void aim_leaving(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    Vec3 su, sv;
    int patch = pick(rng, s->count);
    Vec3 p = stress_point(s, patch, rng_unit(rng), rng_unit(rng), &su, &sv);
    out->ray = from_outside(s, rng, p);
    out->leaves = true;
    out->onward = stress_direction(rng);
    if (rng_next(rng) % 3 == 0) { // flat along the surface
        Vec3 n = vec_normalize(vec_cross(su, sv));
        double up = pow(10.0, rng_range(rng, -6.0, 0.0));
        Vec3 d = vec_madd(out->onward, -vec_dot(out->onward, n), n);
        if (vec_length(d) > 0.0 && vec_is_finite(d))
            out->onward = vec_madd(d, rng_next(rng) % 2 ? up : -up, n);
    }
}

static void aim_unequal(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    out->ray = from_outside(s, rng, random_point(s, rng));
    out->ray.dir = vec_scale(vec_normalize(out->ray.dir), pow(10.0, rng_range(rng, -290, 290)));
}

static void aim_no_numbers(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    static const double odd[] = {NAN, INFINITY, -INFINITY};
    out->ray = from_outside(s, rng, random_point(s, rng));
    double *const place[] = {&out->ray.org.x, &out->ray.org.y, &out->ray.org.z,
                             &out->ray.dir.x, &out->ray.dir.y, &out->ray.dir.z};
    uint64_t kind = rng_next(rng) % 8;
    if (kind == 0)
        out->ray.dir = vec3(0.0, -0.0, 0.0);
    else if (kind == 1)
        out->t_min = NAN;
    else if (kind == 2)
        out->t_max = NAN;
    else if (kind == 3)
        out->t_min = 2.0, out->t_max = 1.0;
    else
        *place[rng_next(rng) % 6] = odd[rng_next(rng) % 3];
    out->expect = EXPECT_NONE;
}

static Vec3 dyadic_near(Rng *rng) {
    return vec3((double)(rng_next(rng) % 4096) / 64.0 - 32.0,
                (double)(rng_next(rng) % 4096) / 64.0 - 32.0,
                (double)(rng_next(rng) % 4096) / 64.0 - 32.0);
}

// All coordinates have few bits: the ray goes through the point exactly.
static void aim_point(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    Vec3 p = s->defs[0].points[0], org = dyadic_near(rng);
    out->ray = (Ray){org, vec_sub(p, org)};
    out->expect = EXPECT_HIT;
    out->t_known = 1.0;
}

static void aim_segment(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    Vec3 a = s->defs[0].points[0], b = s->defs[0].points[15], along = vec_sub(b, a);
    out->expect = EXPECT_HIT;
    out->t_known = 1.0;
    if (rng_next(rng) % 4 == 0) { // along it
        out->ray = (Ray){vec_sub(a, along), along};
        return;
    }
    Vec3 p = vec_add(a, vec_scale(along, (double)(rng_next(rng) % 33) / 32.0));
    Vec3 org = dyadic_near(rng);
    out->ray = (Ray){org, vec_sub(p, org)};
}

// In the plane of a flat patch, or parameter x size above it.
static void aim_in_plane(const StressScene *s, Rng *rng, double above, StressRay *out) {
    Vec3 p = random_point(s, rng), d = stress_direction(rng);
    p.z = s->detail + above * s->size;
    d.z = 0.0;
    out->ray = (Ray){vec_sub(p, d), d};
    if (above == 0.0) {
        out->expect = EXPECT_HIT;
        out->t_known = 1.0;
    }
}

// Along a ruling of z = x y / 4 over [0,3]^2.
static void aim_ruling(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)s, (void)unused;
    double x = (double)(rng_next(rng) % 193) / 64.0;
    double y = (double)(rng_next(rng) % 384) / 64.0 - 3.0, step = (double)(1 + rng_next(rng) % 8);
    Vec3 org = vec3(x, y, 0.25 * x * y), d = vec3(0.0, step, 0.25 * x * step);
    if (rng_next(rng) % 2) // of the other family
        org = vec3(org.y, org.x, org.z), d = vec3(d.y, d.x, d.z);
    out->ray = (Ray){org, d};
    out->expect = EXPECT_HIT;
    out->t_known = y < 0.0 ? -y / step : 0.0;
}

// Near the 18-fold line, or the nine-fold one.
static void aim_line(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    double side = 0.3 * rng_unit(rng);
    Vec3 d = vec3(1e-2 * rng_range(rng, -1, 1), 1e-2 * rng_range(rng, -1, 1), 1.0);
    Vec3 p = vec3(side * rng_range(rng, -1, 1), side * rng_range(rng, -1, 1), 0.0);
    if (rng_next(rng) % 8 == 0)
        p = vec3(0, 0, 0), d = vec3(0, 0, 1);
    out->ray = (Ray){vec_madd(p, -s->size, d), d};
}

// Through the cusp's edge, or close to it.
static void aim_cusp(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    double u = 0.5 + (rng_next(rng) % 2 ? 0.0 : pow(10.0, rng_range(rng, -12, -1)));
    Vec3 p = stress_point(s, 0, u, rng_unit(rng), NULL, NULL);
    out->ray = from_outside(s, rng, beside(rng, s, p));
}

// ---- The list

#define CASE(name, what, share, rays, make, aim, parameter)                                        \
    { name, what, share, rays, scene_##make, aim_##aim, parameter, 1e-9, .endless = false }
#define ENDLESS(name, what, share, rays, make, aim, parameter)                                     \
    { name, what, share, rays, scene_##make, aim_##aim, parameter, 1e-9, .endless = true }
#define PREPARED(name, what, share, make, aim, tolerance)                                          \
    {                                                                                              \
        name, what, share, 100, scene_##make, aim_##aim, 0.0, tolerance, .prepared = true,         \
                                                                         .endless = true           \
    }
#define EDGES(name, what, rays, make, parameter)                                                   \
    { name, what, 1.0, rays, scene_##make, aim_edges, parameter, 1e-9, .watertight = true }
#define LOOSE(name, tolerance)                                                                     \
    { name, "another tolerance", 1.0, 200000, scene_teapot, aim_hull, 1.0, tolerance, .least = 0 }
#define HUGE(name, what, teapots, smallest)                                                        \
    { name, what, 0.2, 1000000, scene_many, aim_hull, teapots, 1e-9, .least = smallest }
const StressCase stress_cases[] = {
    // Shared edges, corners
    EDGES("edge_watertight", "teapot, at shared edges and corners, from outside and inside", 200000,
          teapot, 1),
    EDGES("mesh_watertight", "3x3 wild patches with common sides, at these", 2000, mesh, 0.1),
    CASE("t_junction", "a side against two half as long", 1, 2000, t_junction, edges, 0),
    // Ordinary
    CASE("teapot_outside", "teapot, from outside", 4, 200000, teapot, hull, 1),
    CASE("teapot_inside", "teapot, from within its hull", 4, 200000, teapot, inside, 1),
    CASE("random", "bicubic patches, smooth to wild", 4, 500, random, surface, 0.5),
    CASE("degrees", "bi-degrees 1 to 16, mixed", 0.5, 200, degrees, surface, 0.3),
    CASE("rational", "weights 1/3 to 3, bi-degrees 1 to 4", 0.5, 200, rational, surface, 0.5),
    CASE("rational_1e6", "weights 1e-6 to 1e6", 0.5, 200, rational, surface, 6),
    CASE("rational_round", "a quarter of a torus, exactly", 0.5, 200, round, surface, 0),
    CASE("rational_grazing", "tangent to the last bit", 0.2, 200, round, grazing, 0),
    CASE("subdiv_params", "at u, v of halves, thirds, quarters, ...", 2, 500, random, parameters,
         0.3),
    CASE("axis_aligned", "along axes, zeros of either sign", 2, 200000, teapot, axis, 1),
    CASE("inside_hull", "origin within the hull, both ways", 2, 500, random, inside, 0.5),
    CASE("range_ends", "t_min and t_max among the crossings", 2, 500, random, range, 0.5),
    CASE("mixed_sizes", "five patches of sizes 1e-6 to 1e6", 1, 2000, mixed_sizes, surface, 0),
    CASE("many_patches", "12,800 different patches", 1, 200000, many, hull, 400),
    HUGE("million_patches", "1,000,000 different patches", 31250, 1000),
    // Singular
    CASE("collapsed_pole", "teapot, at collapsed sides or 1e-13..0.1 beside", 1, 200000, teapot,
         pole, 1),
    CASE("pole_range", "the range begins or ends on a pole", 1, 200000, teapot, pole_range, 1),
    CASE("collapsed_kinds", "sides and corners that are points, in five ways", 1, 500, collapsed,
         parameters, 0),
    CASE("double_rows", "rows of points doubled", 1, 500, double_rows, parameters, 0),
    CASE("cusp", "at a cusp, or 1e-12..0.1 beside", 1, 500, cusp, cusp, 0),
    CASE("self_crossing", "a loop that crosses itself", 1, 500, self_crossing, surface, 0),
    CASE("twisted", "corners turned inside out", 1, 500, twisted, parameters, 0),
    CASE("fold9", "nine sheets", 1, 500, fold9, line, 0),
    CASE("line18", "18 crossings of one line", 1, 500, line18, line, 0),
    // Grazing
    CASE("grazing_1e-2", "parallel to a tangent plane, 1e-2 beside it", 1, 500, sheet, grazing,
         1e-2),
    CASE("grazing_1e-4", "1e-4", 1, 500, sheet, grazing, 1e-4),
    CASE("grazing_1e-6", "1e-6", 1, 500, sheet, grazing, 1e-6),
    CASE("grazing_1e-8", "1e-8", 1, 500, sheet, grazing, 1e-8),
    CASE("tangent", "tangent to the last bit", 0.5, 500, sheet, grazing, 0),
    CASE("tangent_teapot", "the same on the teapot", 0.5, 200000, pot, grazing, 0),
    // Sizes
    CASE("aspect_1e5", "1 : 1e5", 1, 500, aspect, surface, 1e5),
    CASE("aspect_1e10", "1 : 1e10", 1, 500, aspect, surface, 1e10),
    CASE("ribbon_1e5", "wild, singular, turned, 1 : 1e5", 1, 500, ribbon, surface, 1e5),
    CASE("ribbon_1e10", "1 : 1e10", 1, 500, ribbon, surface, 1e10),
    CASE("ribbon_1e15", "1 : 1e15", 0.5, 500, ribbon, surface, 1e15),
    CASE("ribbon_params", "1 : 1e10, at u, v of halves, thirds, ...", 0.5, 500, ribbon, parameters,
         1e10),
    CASE("ribbon_grazing", "1 : 1e10, tangent to the last bit", 0.2, 500, ribbon10, grazing, 0),
    CASE("scale_1e-9", "teapot of size 1e-9", 1, 200000, teapot, hull, 1e-9),
    CASE("scale_1e-6", "1e-6", 1, 200000, teapot, hull, 1e-6),
    CASE("scale_1e-4", "1e-4", 1, 200000, teapot, hull, 1e-4),
    CASE("scale_1e-2", "1e-2", 1, 200000, teapot, hull, 1e-2),
    CASE("scale_1e4", "1e4", 1, 200000, teapot, hull, 1e4),
    CASE("scale_1e6", "1e6", 1, 200000, teapot, hull, 1e6),
    CASE("scale_1e9", "1e9", 1, 200000, teapot, hull, 1e9),
    CASE("scale_1e-300", "patches of size 1e-300", 0.5, 500, scaled, surface, 1e-300),
    CASE("scale_1e150", "1e150", 0.5, 500, scaled, surface, 1e150),
    CASE("denormals", "1e-310: all coordinates are denormal", 0.5, 500, scaled, surface, 1e-310),
    CASE("scale_1e300", "1e300", 0.5, 500, scaled, surface, 1e300),
    CASE("offset_1e4", "teapot 1e4 away", 1, 200000, teapot_moved, hull, 1e4),
    CASE("offset_1e7", "teapot 1e7 away", 1, 200000, teapot_moved, hull, 1e7),
    CASE("far_origin", "rays from up to 1e7 sizes away", 1, 500, sheet, far, 1e7),
    CASE("unequal_dirs", "directions of length 1e-290..1e290", 1, 500, random, unequal, 0.3),
    CASE("thin_sheets_1e-6", "two sheets 1e-6 apart", 1, 500, thin_sheets, surface, 1e-6),
    // Secondary rays
    CASE("self_hit_leaving", "from a hit of the teapot, any way", 1, 200000, teapot, leaving, 1),
    CASE("leaving_random", "from a hit of a wild patch", 1, 500, random, leaving, 0.5),
    CASE("leaving_round", "from a quarter of a torus, exactly round", 0.5, 500, round, leaving, 0),
    CASE("leaving_collapsed", "from a hit of a patch with sides that are points", 0.5, 500,
         collapsed, leaving_hard, 0),
    CASE("leaving_cusp", "from a hit beside a cusp", 0.5, 500, cusp, leaving, 0),
    CASE("leaving_aspect", "from a hit of a patch 1 : 1e10", 0.5, 500, aspect, leaving, 1e10),
    CASE("leaving_ribbon", "wild, singular, turned, 1 : 1e10", 0.1, 500, ribbon, leaving, 1e10),
    CASE("leaving_rational", "weights 1e-6 to 1e6", 0.2, 200, rational, leaving, 6),
    CASE("leaving_sheets", "from one of two sheets 1e-6 apart", 1, 500, thin_sheets, leaving_hard,
         1e-6),
    // Infinitely many answers, and none
    CASE("degenerate_point", "all 16 points equal", 0.2, 200, point, point, 0),
    CASE("degenerate_segment", "all points on a segment, across it and along it", 0.2, 200, segment,
         segment, 0),
    CASE("inplane_flat", "in the plane of a flat patch", 0.2, 200, flat, in_plane, 0),
    CASE("inplane_offset_1e-9", "1e-9 above it", 0.2, 200, flat, in_plane, 1e-9),
    CASE("along_ruling", "along a ruling of a saddle", 0.2, 200, saddle, ruling, 0),
    CASE("no_numbers", "NaN, infinities, no direction, empty range", 0.5, 2000, random, no_numbers,
         0.3),
    // All of that exactly, and as uneven as numbers can be
    ENDLESS("lattice", "points of -1, 0, 1; rays from such to such", 1, 100, lattice, lattice, 0),
    ENDLESS("lattice_secants", "the same, from corners and points of the net to others", 0.5, 100,
            lattice, secant, 0),
    ENDLESS("repeated_points", "any point may be a copy of another", 0.5, 200, repeated, parameters,
            0.4),
    CASE("uneven_points", "each of a size of its own, 1e-6 to 1e6", 0.5, 200, uneven, surface, 6),
    CASE("coincident", "four times the same patch, reversed and swapped", 0.5, 200, coincident,
         parameters, 0.3),
    CASE("stack", "twelve sheets, 1e-12 to 1e-3 apart", 0.5, 200, stack, surface, 0.2),
    CASE("range_bounds", "t_min and t_max on a crossing to the last bit", 1, 500, random, bounds,
         0.3),
    ENDLESS("range_folds", "the same where the surface is folded", 0.5, 200, folds, bounds, 0),
    CASE("uneven_dirs", "components up to 300 decades apart", 0.5, 500, random, uneven, 0.3),
    CASE("secants", "from points of a wild patch to others, corners among them", 0.5, 500, random,
         secant, 0.5),
    ENDLESS("rulings", "cylinders, cones: along rulings or 1e-17..1 beside", 0.5, 100, ruled,
            rulings, 0),
    ENDLESS("rulings_tangent", "tangents of such, to the last bit or nearly", 0.5, 100, ruled,
            tangent, 0),
    ENDLESS("edge_on", "in the plane of a flat patch that no axis lies in, or nearly", 0.5, 100,
            tilted, tangent, 0),
    CASE("tangent_hard", "tangents at ends, halves, ..., 1e-17..0.1 beside", 1, 500, random,
         tangent, 0.5),
    CASE("tangent_mesh", "the same on 3x3 patches", 0.5, 500, mesh, tangent, 0.1),
    CASE("tangent_degrees", "bi-degrees 1 to 16", 0.2, 200, degrees, tangent, 0.3),
    CASE("tangent_round", "a quarter of a torus", 0.2, 200, round, tangent, 0),
    CASE("folds", "where folds cross, or 1e-17..0.1 beside", 0.5, 200, folds, folds, 0),
    ENDLESS("pinch", "where all derivatives vanish, or 1e-17..0.1 beside", 0.5, 200, pinch, middle,
            0),
    ENDLESS("pinch_tangent", "tangents there", 0.5, 200, pinch, tangent, 0),
    CASE("collapsed_tangent", "tangents of sides and corners that are points", 0.5, 200, collapsed,
         tangent, 0),
    CASE("curve", "all points on one curve, met exactly", 0.2, 100, curve, curve, 0),
    CASE("sphere", "a sphere of eight patches, at poles and sides", 0.2, 200, sphere, parameters,
         0),
    CASE("sphere_tangent", "tangents of it", 0.2, 200, sphere, tangent, 0),
    CASE("scale_1e38", "where single floats end", 0.5, 500, scaled, surface, 1e38),
    CASE("scale_1e-38", "and begin", 0.5, 500, scaled, surface, 1e-38),
    CASE("scale_1e-45", "and are 0", 0.5, 500, scaled, surface, 1e-45),
    CASE("distant", "rays from up to 1e14 sizes away", 0.5, 500, random, distant, 14),
    CASE("far_edges", "at shared sides 1e7 away", 0.5, 500, far_mesh, edges, 1e7),
    CASE("far_small", "patches of size 1e-3 to 1, 1e7 away", 0.5, 500, far_small, surface, 1e7),
    CASE("far_tangent", "tangents of such", 0.5, 500, far_small, tangent, 1e7),
    CASE("far_leaving", "from a hit of such", 0.5, 500, far_small, leaving_hard, 1e7),
    CASE("leaving_mesh", "from sides and halves of 3x3 patches, along the surface or 1e-17..1 off",
         0.5, 500, mesh, leaving_hard, 0.1),
    ENDLESS("leaving_ruled", "from cylinders and cones", 0.5, 200, ruled, leaving_hard, 0),
    ENDLESS("leaving_pinch", "from where derivatives vanish", 0.5, 200, pinch, leaving_hard, 0),
    ENDLESS("leaving_lattice", "from points of -1, 0, 1", 0.5, 100, lattice, leaving_hard, 0),
    CASE("leaving_stack", "from one of twelve sheets", 0.5, 200, stack, leaving_hard, 0.2),
    CASE("leaving_sphere", "from a sphere", 0.2, 200, sphere, leaving_hard, 0),
    CASE("leaving_degrees", "bi-degrees 1 to 16", 0.2, 200, degrees, leaving_hard, 0.3),
    PREPARED("any", "any of all these, of any size, anywhere, prepared in any way", 2, any, any,
             1e-9),
    PREPARED("any_1e-3", "another tolerance", 0.5, any, any, 1e-3),
    PREPARED("any_1e-6", "another tolerance", 0.5, any, any, 1e-6),
    PREPARED("any_1e-12", "another tolerance", 0.5, any, any, 1e-12),
    // Other tolerances
    LOOSE("tolerance_1e-3", 1e-3),
    LOOSE("tolerance_1e-6", 1e-6),
    LOOSE("tolerance_1e-12", 1e-12),
};
const int stress_case_count = sizeof stress_cases / sizeof *stress_cases;

// ---- Making them

static void side_of(const PatchDef *def, int side, bool backwards, Vec3 out[4]) {
    for (int k = 0; k < 4; k++) {
        int at = backwards ? 3 - k : k;
        out[k] = def->points[side < 2 ? 12 * side + at : 4 * at + 3 * (side - 2)];
    }
}

static bool is_bicubic(const PatchDef *def) {
    return def->degree_u == 3 && def->degree_v == 3 && !def->weights;
}

static void find_sides(StressScene *s) {
    for (int a = 0; a < s->count * 4; a++) {
        Vec3 own[4], other[4];
        if (!is_bicubic(&s->defs[a / 4]))
            continue;
        side_of(&s->defs[a / 4], a % 4, false, own);
        if (memcmp(&own[0], &own[1], sizeof own[0]) == 0 &&
            memcmp(&own[0], &own[2], sizeof own[0]) == 0 &&
            memcmp(&own[0], &own[3], sizeof own[0]) == 0) {
            if (s->pole_count < (int)(sizeof s->poles / sizeof *s->poles))
                s->poles[s->pole_count++] = (StressSide){a / 4, a % 4};
            continue;
        }
        for (int b = (a / 4 + 1) * 8; b < s->count * 8; b++) {
            if (!is_bicubic(&s->defs[b / 8]))
                continue;
            side_of(&s->defs[b / 8], b / 2 % 4, b % 2, other);
            if (memcmp(own, other, sizeof own) == 0 &&
                s->shared_count < (int)(sizeof s->shared / sizeof *s->shared))
                s->shared[s->shared_count++] = (StressSide){a / 4, a % 4};
        }
    }
}

static uint64_t mixed(uint64_t a, uint64_t b) {
    Rng rng = {a};
    rng.state = rng_next(&rng) ^ b;
    return rng_next(&rng);
}

static uint64_t case_seed(const StressCase *which, uint64_t seed) {
    for (const char *c = which->name; *c; c++) // not the place in the list: that may change
        seed = mixed(seed, (uint64_t)*c);
    return seed;
}

void stress_scene_make(const StressCase *which, uint64_t seed, uint64_t number,
                       StressScene *scene) {
    *scene = (StressScene){.arena = arena_create(), .box = box_empty()};
    Rng rng = {mixed(case_seed(which, seed), number)};
    which->make(scene, &rng, which->parameter);
    scene->least_diameter = INFINITY;
    scene->diameter = ARENA_ARRAY(scene->arena, double, (size_t)scene->count);
    for (int n = 0; n < scene->count; n++) {
        Box box = box_empty();
        for (uint32_t k = 0; k < (scene->defs[n].degree_u + 1) * (scene->defs[n].degree_v + 1); k++)
            box = box_extend(box, scene->defs[n].points[k]);
        Vec3 d = vec_sub(box.high, box.low);
        scene->diameter[n] = hypot(d.x, hypot(d.y, d.z));
        scene->least_diameter = fmin(scene->least_diameter, scene->diameter[n]);
        scene->box = box_union(scene->box, box);
    }
    scene->oracle = ray_oracle_prepare(scene->arena, scene->defs, scene->count);
    scene->middle = vec_add(vec_scale(scene->box.low, 0.5), vec_scale(scene->box.high, 0.5));
    // Without squares: they would leave the range of numbers.
    Vec3 d = vec_sub(scene->box.high, scene->box.low);
    scene->size = hypot(d.x, hypot(d.y, d.z));
    if (scene->count <= SIDE_SCENE)
        find_sides(scene);
    if (which->make == scene_t_junction)
        scene->shared[0] = (StressSide){0, 1}, scene->shared_count = 1;
}

void stress_scene_destroy(StressScene *scene) { arena_destroy(scene->arena); }

void stress_ray_make(const StressCase *which, const StressScene *scene, uint64_t seed,
                     uint64_t number, uint64_t ray, StressRay *out) {
    Rng rng = {mixed(mixed(case_seed(which, seed), number) ^ 0x5ace, ray)};
    *out = (StressRay){.t_max = INFINITY};
    which->aim(scene, &rng, which->parameter, out);
}
