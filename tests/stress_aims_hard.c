// SPDX-License-Identifier: MIT
// Rays of stress_cases.h that meet exactly what others meet nearly: ends of the range on a
// crossing, directions in the tangent plane, along rulings, from corner to corner; and numbers as
// uneven as doubles can be.
#include "stress_cases.h"

static int pick(Rng *rng, int count) { return (int)(rng_next(rng) % (uint64_t)count); }

// +-10^-low .. 10^-high, now and then 0.
static double small(Rng *rng, double low, double high) {
    if (pick(rng, 4) == 0)
        return 0.0;
    double x = pow(10.0, rng_range(rng, -high, -low));
    return pick(rng, 2) ? x : -x;
}

// A parameter: at an end, at a half, third, ..., a little beside these, or anywhere.
static double parameter(Rng *rng) {
    static const double places[] = {0.0, 1.0, 0.5, 1.0 / 3.0, 2.0 / 3.0, 0.25, 0.75, 0.125};
    if (pick(rng, 2))
        return rng_unit(rng);
    double at = places[pick(rng, sizeof places / sizeof *places)] + small(rng, 2.0, 17.0);
    return fmin(fmax(at, 0.0), 1.0);
}

// A place of any patch, and where it is in space.
static Vec3 place(const StressScene *s, Rng *rng, Vec3 *su, Vec3 *sv) {
    double u = parameter(rng), v = parameter(rng);
    return stress_point(s, pick(rng, s->count), u, v, su, sv);
}

static Vec3 outside(const StressScene *s, Rng *rng) {
    return vec_madd(s->middle, rng_range(rng, 0.6, 2.0) * s->size, stress_direction(rng));
}

static double length_of(Vec3 d) { return hypot(d.x, hypot(d.y, d.z)); }

// To length 1 without leaving the range of numbers on the way.
static Vec3 unit(Vec3 d) {
    double most = fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z)));
    return most > 0.0 ? vec_normalize(vec3(d.x / most, d.y / most, d.z / most)) : d;
}

// In the tangent plane: one of the tangents itself, or both together; a direction of no meaning
// where there is no such plane.
static Vec3 tangent(Rng *rng, Vec3 su, Vec3 sv) {
    Vec3 d;
    switch (pick(rng, 4)) {
    case 0:
        d = su;
        break;
    case 1:
        d = sv;
        break;
    case 2:
        d = vec_add(unit(su), unit(sv));
        break;
    default:
        d = vec_add(vec_scale(unit(su), rng_range(rng, -1.0, 1.0)),
                    vec_scale(unit(sv), rng_range(rng, -1.0, 1.0)));
    }
    return length_of(d) > 0.0 ? unit(d) : stress_direction(rng);
}

// ---- Ranges

// t_min or t_max is the depth of a place of the surface, or the double beside it, or near; both
// may be.
static double bound_at(Rng *rng, double t) {
    switch (pick(rng, 4)) {
    case 0:
        return t;
    case 1:
        return nextafter(t, INFINITY);
    case 2:
        return nextafter(t, -INFINITY);
    default:
        return t + small(rng, 0.0, 16.0);
    }
}

void aim_bounds(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    Vec3 p = place(s, rng, NULL, NULL), org = outside(s, rng);
    int kind = pick(rng, 8);
    out->ray = (Ray){org, vec_sub(p, org)};
    if (kind < 3)
        out->t_min = bound_at(rng, 1.0);
    else
        out->t_min = kind == 3 ? -INFINITY : 0.0;
    if (kind != 0)
        out->t_max = bound_at(rng, 1.0);
    if (kind == 7) // the ray begins in the surface
        out->ray.org = p, out->t_min = 0.0, out->t_max = pick(rng, 2) ? INFINITY : -0.0;
}

// ---- Directions

// Components up to 300 decades apart, the whole of any length.
void aim_uneven(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    double c[3];
    for (int k = 0; k < 3; k++)
        c[k] = small(rng, 0.0, pick(rng, 2) ? 20.0 : 300.0);
    c[pick(rng, 3)] = pick(rng, 2) ? 1.0 : -1.0;
    Vec3 d = vec3(c[0], c[1], c[2]), p = place(s, rng, NULL, NULL);
    double away = rng_range(rng, 0.1, 2.0) * s->size;
    out->ray.org = vec_madd(p, -away, d);
    // By a power of two: the ray stays the same to the last bit, but for the smallest components.
    out->ray.dir = pick(rng, 2) ? d : vec_scale(d, ldexp(1.0, pick(rng, 1600) - 800));
}

// In the tangent plane or nearly; at the surface or nearly.
void aim_tangent(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    Vec3 su, sv, p = place(s, rng, &su, &sv), d = tangent(rng, su, sv);
    Vec3 n = unit(vec_cross(unit(su), unit(sv)));
    d = vec_madd(d, small(rng, 1.0, 17.0), n);
    p = vec_madd(p, small(rng, 2.0, 17.0) * s->size, n);
    double away = rng_range(rng, -0.5, 2.0) * s->size;
    out->ray = (Ray){vec_madd(p, -away, d), d};
    if (pick(rng, 4) == 0)
        out->ray.org = p;
    if (pick(rng, 4) == 0)
        out->t_min = -INFINITY;
}

// From one point of a net or of a surface to another, corners and straight sides among them.
void aim_secant(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    Vec3 end[2];
    for (int k = 0; k < 2; k++) {
        const PatchDef *def = &s->defs[pick(rng, s->count)];
        int du = (int)def->degree_u, dv = (int)def->degree_v;
        switch (pick(rng, 3)) {
        case 0:
            end[k] = place(s, rng, NULL, NULL);
            break;
        case 1:
            end[k] = def->points[pick(rng, (du + 1) * (dv + 1))];
            break;
        default:
            end[k] = def->points[pick(rng, 2) * du * (dv + 1) + pick(rng, 2) * dv];
        }
    }
    Vec3 d = vec_sub(end[1], end[0]);
    if (!(length_of(d) > 0.0))
        d = vec_scale(stress_direction(rng), s->size > 0.0 ? s->size : 1.0);
    int kind = pick(rng, 3);
    out->ray = (Ray){kind == 0 ? end[0] : vec_sub(end[0], kind == 1 ? d : vec_scale(d, 0.5)), d};
    if (pick(rng, 4) == 0)
        out->t_min = -INFINITY;
}

// From points of the lattice of halves to others.
void aim_lattice(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)s, (void)unused;
    double c[6];
    int fine = pick(rng, 2) ? 1 : pick(rng, 2) ? 2 : 16;
    for (int k = 0; k < 6; k++)
        c[k] = (double)(pick(rng, 4 * fine + 1) - 2 * fine) / fine;
    if (c[3] == 0.0 && c[4] == 0.0 && c[5] == 0.0)
        c[3 + pick(rng, 3)] = 1.0;
    Vec3 target = vec3(0.5 * c[0], 0.5 * c[1], 0.5 * c[2]);
    out->ray = (Ray){target, vec3(c[3], c[4], c[5])};
    if (pick(rng, 4))
        out->ray.org = vec_madd(target, -4.0, out->ray.dir);
    if (pick(rng, 4) == 0)
        out->t_min = -INFINITY;
}

// Along a ruling (v runs along them), or nearly.
void aim_rulings(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    double u = (double)pick(rng, 9) / 8.0;
    if (pick(rng, 2))
        u = rng_unit(rng);
    Vec3 a = stress_point(s, 0, u, 0.0, NULL, NULL), b = stress_point(s, 0, u, 1.0, NULL, NULL);
    Vec3 d = vec_sub(b, a);
    if (!(length_of(d) > 0.0))
        d = stress_direction(rng);
    d = vec_madd(d, small(rng, 0.0, 17.0) * s->size, stress_direction(rng));
    Vec3 off = vec_scale(stress_direction(rng), small(rng, 1.0, 17.0) * s->size);
    out->ray = (Ray){vec_madd(vec_add(a, off), -rng_range(rng, -0.5, 2.0), d), d};
}

// At or beside the middle of a pinch, or the crossings of folds: (x, y) in {-1, 0, 1}.
void aim_middle(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    Vec3 p =
        stress_point(s, 0, 0.5 + small(rng, 1.0, 17.0), 0.5 + small(rng, 1.0, 17.0), NULL, NULL);
    p = vec_madd(p, small(rng, 1.0, 17.0) * s->size, stress_direction(rng));
    Vec3 d = stress_direction(rng);
    if (pick(rng, 2)) // along an axis, nearly
        d = vec3(small(rng, 1.0, 17.0), small(rng, 1.0, 17.0), 1.0);
    out->ray = (Ray){vec_madd(p, -rng_range(rng, 0.1, 2.0) * s->size, d), d};
}

void aim_folds(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    Vec3 p = vec3(pick(rng, 3) - 1 + small(rng, 1.0, 17.0),
                  pick(rng, 3) - 1 + small(rng, 1.0, 17.0), s->middle.z);
    Vec3 d = vec3(small(rng, 1.0, 17.0), small(rng, 1.0, 17.0), pick(rng, 2) ? 1.0 : -1.0);
    out->ray = (Ray){vec_madd(p, -s->size, d), d};
}

// At a point of the curve that is known exactly.
void aim_curve(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    double at = (double)pick(rng, 9) / 8.0;
    Vec3 p = stress_point(s, 0, at, at, NULL, NULL);
    Vec3 org = vec3(pick(rng, 4096) / 64.0 - 32.0, pick(rng, 4096) / 64.0 - 32.0,
                    pick(rng, 4096) / 64.0 - 32.0);
    out->ray = (Ray){org, vec_sub(p, org)};
    out->expect = EXPECT_HIT;
    out->t_known = 1.0;
}

// From as far away as doubles go without losing the scene altogether.
void aim_distant(const StressScene *s, Rng *rng, double decades, StressRay *out) {
    Vec3 d = stress_direction(rng), p = place(s, rng, NULL, NULL);
    double away = s->size * pow(10.0, rng_range(rng, 1.0, decades));
    out->ray = (Ray){vec_madd(p, -away, d), d};
}

// ---- Secondary rays

// From any hit: along the surface to the last bit or nearly, back, onwards, mirrored; of any
// length.
void aim_leaving_hard(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    (void)unused;
    Vec3 su, sv, p = place(s, rng, &su, &sv), org = outside(s, rng);
    out->ray = (Ray){org, vec_sub(p, org)};
    out->leaves = true;
    Vec3 n = unit(vec_cross(unit(su), unit(sv))), d = unit(out->ray.dir);
    bool plane = length_of(n) > 0.5;
    switch (pick(rng, 8)) {
    case 0:
        out->onward = vec_neg(d);
        break;
    case 1:
        out->onward = d;
        break;
    case 2:
        out->onward = plane ? vec_madd(d, -2.0 * vec_dot(d, n), n) : vec_neg(d);
        break;
    case 3:
        out->onward = stress_direction(rng);
        break;
    default:
        out->onward = tangent(rng, su, sv);
        if (plane)
            out->onward = vec_madd(out->onward, small(rng, 0.0, 17.0), n);
    }
    if (pick(rng, 4) == 0)
        out->onward = vec_scale(out->onward, pow(10.0, rng_range(rng, -100.0, 100.0)));
}

void aim_any(const StressScene *s, Rng *rng, double unused, StressRay *out) {
    static void (*const kinds[])(const StressScene *, Rng *, double, StressRay *) = {
        aim_bounds, aim_uneven, aim_tangent, aim_secant, aim_leaving_hard, aim_surface, aim_inside};
    kinds[pick(rng, sizeof kinds / sizeof *kinds)](s, rng, unused, out);
}
