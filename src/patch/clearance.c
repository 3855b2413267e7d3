// SPDX-License-Identifier: MIT
// From where on a ray that starts at a hit is clear of the surface that it leaves.
//
// The start lies within b of the surface: b is the hit's bound and the start's own rounding. Let s
// be the sine of the angle between the ray and the tangent plane, k the normal curvature along the
// ray. Up to second order the surface's height over the start is e + k t^2 / 2, |e| <= b, and the
// ray's is s t; they meet at t about e / s by mistake, and where the surface bends towards the ray
// at t about 2 s / k, truly.
//   s^2 >= 4 k b: t = 2 b / s lies beyond the first for every e, and before half of the second.
//   else          ray and surface touch as far as b can tell: both crossings lie before
//                 t = (s + sqrt(s^2 + 2 k b)) / k <= 4.5 sqrt(b / k), where the surface is still
//                 within 10 b of the ray.
// So what lies before t is within ten bounds of the ray all the way from its start, and nothing
// that is farther from the surface than that is lost.
#include "patch/patch.h"

#include "patch/bezier.h"

#include <float.h>

static double largest(Vec3 a) { return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z))); }

// Of the surface along a unit direction d in its tangent plane; 0 where the tangents span no plane.
// With N = Su x Sv, d = a Su + b Sv: of a ribbon 1e10 times longer than wide N is what cancellation
// leaves of the tangents, still six digits; the determinant of their products would have none.
static double normal_curvature(const BezierJet *s, Vec3 n, Vec3 d) {
    Vec3 across = vec_cross(s->su, s->sv);
    double square = vec_dot(across, across);
    double least = 64.0 * DBL_EPSILON * vec_length(s->su) * vec_length(s->sv);
    if (!(square > least * least))
        return 0.0;
    double a = vec_dot(vec_cross(d, s->sv), across) / square;
    double b = vec_dot(vec_cross(s->su, d), across) / square;
    Vec3 bend = vec_scale(s->suu, a * a);
    bend = vec_madd(bend, 2.0 * a * b, s->suv);
    bend = vec_madd(bend, b * b, s->svv);
    return fabs(vec_dot(bend, n));
}

// The jet of N / W from those of N and W, by the quotient's rule.
static void divide_jet(const Bezier *weights, double u, double v, BezierJet *s) {
    BezierJet j;
    bezier_eval2(weights, u, v, &j);
    double w = 1.0 / j.s.x, wu = j.su.x, wv = j.sv.x;
    s->s = vec_scale(s->s, w);
    s->su = vec_scale(vec_madd(s->su, -wu, s->s), w);
    s->sv = vec_scale(vec_madd(s->sv, -wv, s->s), w);
    s->suu = vec_scale(vec_madd(vec_madd(s->suu, -2.0 * wu, s->su), -j.suu.x, s->s), w);
    s->svv = vec_scale(vec_madd(vec_madd(s->svv, -2.0 * wv, s->sv), -j.svv.x, s->s), w);
    s->suv = vec_madd(vec_madd(vec_madd(s->suv, -wu, s->sv), -wv, s->su), -j.suv.x, s->s);
    s->suv = vec_scale(s->suv, w);
}

static void jet_at(const PatchDef *def, Bezier *patch, const PatchHit *hit, BezierJet *jet) {
    if (def->weights) {
        Bezier weights = {.du = patch->du, .dv = patch->dv};
        for (int k = 0; k < bezier_count(patch); k++) {
            weights.p[k] = vec3(def->weights[k], 0.0, 0.0);
            patch->p[k] = vec_scale(patch->p[k], def->weights[k]);
        }
        bezier_eval2(patch, hit->u, hit->v, jet);
        divide_jet(&weights, hit->u, hit->v, jet);
    } else {
        bezier_eval2(patch, hit->u, hit->v, jet);
    }
}

double patch_clearance(const PatchDef *def, const PatchHit *hit, const Ray *ray) {
    Bezier patch;
    bezier_init(&patch, (int)def->degree_u, (int)def->degree_v, def->points);
    Box box = bezier_bounds(&patch);
    double extent = largest(vec_sub(box.high, box.low)), most = largest(ray->dir);
    // The start was computed from t dir and an origin as large as itself, two roundings each.
    double bound = hit->bound + 8.0 * DBL_EPSILON * largest(ray->org);
    if (!(most > 0.0) || !(extent > 0.0))
        return 0.0;
    // To unit size: no product may leave the range of numbers.
    int exponent;
    frexp(extent, &exponent);
    double half = ldexp(1.0, -exponent / 2), rest = ldexp(1.0, -exponent - -exponent / 2);
    for (int k = 0; k < bezier_count(&patch); k++)
        patch.p[k] = vec_scale(vec_scale(vec_sub(patch.p[k], box.low), half), rest);
    double b = bound * half * rest;

    Vec3 d = vec_scale(ray->dir, 1.0 / most);
    double length = vec_length(d);
    d = vec_scale(d, 1.0 / length);
    double sine = vec_dot(d, hit->normal);
    Vec3 flat = vec_madd(d, -sine, hit->normal);
    sine = fabs(sine);
    double curvature = 1.0; // at least: a patch is no longer than it is
    if (vec_length(flat) > 0.0) {
        BezierJet jet;
        jet_at(def, &patch, hit, &jet);
        curvature = fmax(curvature, normal_curvature(&jet, hit->normal, vec_normalize(flat)));
    }
    double t = sine * sine >= 4.0 * curvature * b ? 2.0 * b / sine : 4.5 * sqrt(b / curvature);
    return t / (half * rest) / (length * most);
}
