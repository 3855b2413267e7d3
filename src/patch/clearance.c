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
//
// That holds where s and k are known, the surface is its second order as far as t, and the patch
// does not end before (or t is no more than ten bounds itself). Of a ribbon 1e10 times longer than
// wide whose tangents are nearly parallel neither is: curvatures of 1e18 come out. There the
// surface itself is followed: from t = 2 b on, by a fifth at a time, the points of the ray are
// asked whether the patch has a point within 3 b of them, and between the first that has none and
// the one before, the same by halves. The t that comes out is proved to be farther than b from all
// of the patch, and no farther than 7 b (follow_surface).
#include "patch/patch.h"

#include "patch/bezier.h"
#include "patch/qi_bound.h"

static double largest_of(Vec3 a) { return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z))); }

// The unit direction d in the tangent plane as a Su + b Sv; false where the tangents span none.
// With N = Su x Sv: of a ribbon 1e10 times longer than wide N is what cancellation leaves of the
// tangents, still six digits; the determinant of their products would have none.
static bool parameters_of(const BezierJet *s, Vec3 d, double *a, double *b) {
    Vec3 across = vec_cross(s->su, s->sv);
    double square = vec_dot(across, across);
    double least = 64.0 * DBL_EPSILON * vec_length(s->su) * vec_length(s->sv);
    if (!(square > least * least))
        return false;
    *a = vec_dot(vec_cross(d, s->sv), across) / square;
    *b = vec_dot(vec_cross(s->su, d), across) / square;
    return true;
}

// What of a is across the unit vector e.
static Vec3 across_of(Vec3 a, Vec3 e) { return vec_madd(a, -vec_dot(a, e), e); }

// Of the surface along a Su + b Sv. *terms: the sizes of what is added, across the longer tangent.
static double normal_curvature(const BezierJet *s, Vec3 n, Vec3 longer, double a, double b,
                               double *terms) {
    Vec3 uu = across_of(s->suu, longer), uv = across_of(s->suv, longer);
    Vec3 vv = across_of(s->svv, longer);
    *terms = vec_length(uu) * a * a + 2.0 * vec_length(uv) * fabs(a * b) + vec_length(vv) * b * b;
    return fabs(vec_dot(uu, n) * a * a + 2.0 * vec_dot(uv, n) * a * b + vec_dot(vv, n) * b * b);
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

// The patch at unit size, and the ray in its place. Weights: those of the points, or NULL.
typedef struct {
    Bezier patch;
    const double *weights;
    Vec3 org, dir; // |dir| = 1
    double bound;  // b
    double u, v;   // of the last point of the patch found near the ray
} Leaving;

static void jet_at(const Leaving *l, double u, double v, BezierJet *jet) {
    if (!l->weights) {
        bezier_eval2(&l->patch, u, v, jet);
        return;
    }
    Bezier product = {.du = l->patch.du, .dv = l->patch.dv}, weights = product;
    for (int k = 0; k < bezier_count(&product); k++) {
        weights.p[k] = vec3(l->weights[k], 0.0, 0.0);
        product.p[k] = vec_scale(l->patch.p[k], l->weights[k]);
    }
    bezier_eval2(&product, u, v, jet);
    divide_jet(&weights, u, v, jet);
}

// ---- Following the surface

static double inside_unit(double x) { return x > 1.0 ? 1.0 : x > 0.0 ? x : 0.0; }

// Moves (u,v) from the last point towards p: along the longer tangent, and along what of the other
// is across it, since the products of a ribbon's tangents would lose all digits. Is it within
// reach?
static bool step_near(Leaving *l, Vec3 p, double reach) {
    enum { STEPS = 12 };
    double at[2] = {l->u, l->v};
    for (int n = 0; n < STEPS; n++) {
        BezierJet s;
        jet_at(l, at[0], at[1], &s);
        Vec3 off = vec_sub(p, s.s);
        if (vec_length(off) <= reach) {
            l->u = at[0], l->v = at[1];
            return true;
        }
        int first = vec_length(s.su) >= vec_length(s.sv) ? 0 : 1;
        Vec3 along = first == 0 ? s.su : s.sv, across = first == 0 ? s.sv : s.su;
        double length = vec_length(along);
        if (!(length > 0.0))
            return false;
        along = vec_scale(along, 1.0 / length);
        double share = vec_dot(along, across);
        across = vec_madd(across, -share, along);
        double square = vec_dot(across, across);
        double y = square > 0.0 ? vec_dot(across, off) / square : 0.0;
        at[first] = inside_unit(at[first] + (vec_dot(along, off) - share * y) / length);
        at[1 - first] = inside_unit(at[1 - first] + y);
    }
    return false;
}

// Control points of a part as seen from p, times their weights.
typedef struct {
    double x[POINTS], y[POINTS], z[POINTS], w[POINTS];
} Part;

static Vec3 part_at(const Part *s, int k) { return vec3(s->x[k], s->y[k], s->z[k]); }

// Is all of the part farther from p than reach along n? Its points are means of the control points
// by the weights.
static bool far_along(const Part *s, int count, Vec3 n, double reach) {
    bool above = true, below = true;
    for (int k = 0; k < count; k++) {
        double height = vec_dot(n, part_at(s, k)), least = reach * s->w[k];
        above = above && height > least;
        below = below && height < -least;
    }
    return above || below;
}

// Clips the part's rectangle to where its points may be within reach of p along n. False: nowhere.
// n S = au u + av v + r over the part, r in the span of its control points.
static bool clip_part(const Part *s, int du, int dv, Vec3 n, double reach, BezierRect *rect) {
    double height[POINTS], most = s->w[0];
    for (int k = 0; k < (du + 1) * (dv + 1); k++) {
        height[k] = vec_dot(n, part_at(s, k));
        most = larger(most, s->w[k]);
    }
    double au = trend_u(height, du, dv), av = trend_v(height, du, dv);
    for (int i = 0; i <= du; i++)
        for (int j = 0; j <= dv; j++)
            height[i * (dv + 1) + j] -= au * ((double)i / du) + av * ((double)j / dv);
    Span r = span_of(height, (du + 1) * (dv + 1)), u = {0.0, 1.0}, v = u;
    double slack = reach * most + 16.0 * DBL_EPSILON * (fabs(au) + fabs(av));
    r.low -= slack, r.high += slack;
    if (!clip(au, av, r, v, &u) || !clip(av, au, r, u, &v))
        return false;
    // Rounded outwards by the last bits of [0,1], as far as the part goes.
    double width_u = rect->u1 - rect->u0, width_v = rect->v1 - rect->v0, last = 2.0 * DBL_EPSILON;
    *rect = (BezierRect){fmax(rect->u0, rect->u0 + u.low * width_u - last),
                         fmin(rect->u1, rect->u0 + u.high * width_u + last),
                         fmax(rect->v0, rect->v0 + v.low * width_v - last),
                         fmin(rect->v1, rect->v0 + v.high * width_v + last)};
    return true;
}

// Along the longer of the part's two trends, the other across it, or both. Where it is not far it
// is clipped along the first: of a ribbon that leaves little.
static bool part_is_far(const Part *s, int du, int dv, double reach, BezierRect *rect) {
    Vec3 u = vec3(trend_u(s->x, du, dv), trend_u(s->y, du, dv), trend_u(s->z, du, dv));
    Vec3 v = vec3(trend_v(s->x, du, dv), trend_v(s->y, du, dv), trend_v(s->z, du, dv));
    bool u_first = vec_length(u) >= vec_length(v);
    Vec3 along = u_first ? u : v, across = u_first ? v : u;
    double length = vec_length(along);
    along = length > 0.0 ? vec_scale(along, 1.0 / length) : vec3(1.0, 0.0, 0.0);
    across = vec_madd(across, -vec_dot(across, along), along);
    if (!(vec_length(across) > 0.0))
        across = vec_cross(along, fabs(along.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    across = vec_normalize(across);
    across = vec_normalize(vec_madd(across, -vec_dot(across, along), along));
    int count = (du + 1) * (dv + 1);
    return far_along(s, count, vec_cross(along, across), reach) ||
           far_along(s, count, across, reach) || !clip_part(s, du, dv, along, reach, rect);
}

static double step_length(const Part *s, int a, int b) {
    return vec_length(
        vec_sub(vec_scale(part_at(s, a), 1.0 / s->w[a]), vec_scale(part_at(s, b), 1.0 / s->w[b])));
}

static bool longer_along_u(const Part *s, int du, int dv) {
    double u = 0.0, v = 0.0;
    for (int i = 0; i <= du; i++) {
        for (int j = 0; j <= dv; j++) {
            int k = i * (dv + 1) + j;
            u = i < du ? larger(u, du * step_length(s, k, k + dv + 1)) : u;
            v = j < dv ? larger(v, dv * step_length(s, k, k + 1)) : v;
        }
    }
    return u >= v;
}

static void cut_part(const Part *whole, int du, int dv, BezierRect r, Part *part) {
    double wu[LINE * LINE], wv[LINE * LINE];
    restriction(wu, du + 1, 1, du, r.u0, r.u1);
    restriction(wv, 1, dv + 1, dv, r.v0, r.v1);
    restrict_axis(whole->x, wu, wv, du, dv, part->x);
    restrict_axis(whole->y, wu, wv, du, dv, part->y);
    restrict_axis(whole->z, wu, wv, du, dv, part->z);
    restrict_axis(whole->w, wu, wv, du, dv, part->w);
}

// What rounding may do to a distance. With w = 2^-53 and C the farthest coordinate from p: the
// differences 2 w C, the weights of a part 3 w a degree, their sums w a degree and 2 more, products
// with the weights 2: 4 w a degree and 6. Over three coordinates sqrt(3) times that, along a
// direction that is rounded itself no more than twice. The bound covers the ray's place.
static double rounding_of(const Leaving *l, double far) {
    return (8.0 * (l->patch.du + l->patch.dv) + 16.0) * 0x1p-53 * far;
}

// The patch as seen from p, and what rounding may do to a distance from there.
static double see_from(const Leaving *l, Vec3 p, Part *whole) {
    double far = 0.0;
    for (int k = 0; k < bezier_count(&l->patch); k++) {
        double w = l->weights ? l->weights[k] : 1.0;
        Vec3 off = vec_sub(l->patch.p[k], p);
        far = fmax(far, largest_of(off));
        whole->x[k] = off.x * w, whole->y[k] = off.y * w, whole->z[k] = off.z * w;
        whole->w[k] = w;
    }
    return rounding_of(l, far);
}

// Has the patch a point within reach of p? Parts that are surely farther than the bound are left
// out, the others halved until a corner is near enough, or a point that is found from their middle:
// where the tangents are nearly parallel what is within reach is a sliver askew to all parts.
// False: all are farther than the bound, or it took too long to tell.
static bool search_near(Leaving *l, Vec3 p, double reach) {
    enum { MOST_PARTS = 1024, WAITING = 256, EVERY = 16 };
    int du = l->patch.du, dv = l->patch.dv, count = 0;
    Part whole, part;
    double rounding = see_from(l, p, &whole);
    BezierRect stack[WAITING];
    stack[count++] = bezier_whole();
    for (int n = 0; count > 0 && n < MOST_PARTS; n++) {
        BezierRect r = stack[--count];
        cut_part(&whole, du, dv, r, &part);
        BezierRect left = r;
        if (part_is_far(&part, du, dv, l->bound + rounding, &left))
            continue;
        for (int k = 0; k < 4; k++) {
            int at = (k & 2 ? du * (dv + 1) : 0) + (k & 1 ? dv : 0);
            if (vec_length(part_at(&part, at)) <= reach * part.w[at]) {
                l->u = k & 2 ? r.u1 : r.u0;
                l->v = k & 1 ? r.v1 : r.v0;
                return true;
            }
        }
        if (n % EVERY == EVERY - 1) {
            l->u = 0.5 * (r.u0 + r.u1);
            l->v = 0.5 * (r.v0 + r.v1);
            if (step_near(l, p, reach))
                return true;
        }
        bool shrank =
            (left.u1 - left.u0) * (left.v1 - left.v0) <= 0.5 * (r.u1 - r.u0) * (r.v1 - r.v0);
        if (shrank) {
            stack[count++] = left;
            continue;
        }
        BezierRect low = left, high = left;
        if (longer_along_u(&part, du, dv))
            low.u1 = high.u0 = 0.5 * (left.u0 + left.u1);
        else
            low.v1 = high.v0 = 0.5 * (left.v0 + left.v1);
        if (count + 2 > WAITING)
            return false;
        stack[count++] = high;
        stack[count++] = low;
    }
    return false;
}

static bool is_near(Leaving *l, double t) {
    Vec3 p = vec_madd(l->org, t, l->dir);
    return step_near(l, p, 3.0 * l->bound) || search_near(l, p, 3.0 * l->bound);
}

// The first of the places asked that is clear, then halved towards the last that was not until it
// is within 4 b of it, so within 7 b of the surface. The patch ends before 4, its own size being 1:
// past that the ray is farther away than any bound that is not itself as large.
static double follow_surface(Leaving *l) {
    // No less than what rounding may do beside the patch: 3 b must exceed b and that.
    l->bound = fmax(l->bound, rounding_of(l, 1.0));
    double near = 0.0, t = 2.0 * l->bound;
    for (; t < 4.0 && is_near(l, t); t *= 1.2)
        near = t;
    while (t - near > 4.0 * l->bound) {
        double middle = 0.5 * (near + t);
        *(is_near(l, middle) ? &near : &t) = middle;
    }
    return t;
}

// ---- Second order

// Does the patch go on as far as that way leads? Where it ends the ray is beside nothing any more.
static bool stays_inside(const Leaving *l, double along_u, double along_v) {
    double u = l->u + along_u, v = l->v + along_v;
    return u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0;
}

// The formula's t; negative where it is not certain.
//
// The tangents err by a few dozen roundings of the patch's size, the normal by that in shares of
// the shorter times 1 / sine between them: but only across the longer tangent e, since it is made
// square to e, which is known far better. Second derivatives are taken across e as well.
static double second_order(const Leaving *l, Vec3 normal) {
    double b = l->bound, curvature = 0.0;
    double du = 0.0, dv = 0.0, terms = 0.0;
    BezierJet jet;
    jet_at(l, l->u, l->v, &jet);
    double u = vec_length(jet.su), v = vec_length(jet.sv);
    double plane = vec_length(vec_cross(jet.su, jet.sv));
    if (!(plane > 0.0))
        return -1.0;
    Vec3 longer = u >= v ? vec_scale(jet.su, 1.0 / u) : vec_scale(jet.sv, 1.0 / v);
    normal = vec_normalize(across_of(across_of(normal, longer), longer));
    double sine = vec_dot(l->dir, normal);
    Vec3 flat = vec_madd(l->dir, -sine, normal);
    sine = fabs(sine);
    if (vec_length(flat) > 0.0 && parameters_of(&jet, vec_normalize(flat), &du, &dv))
        curvature = normal_curvature(&jet, normal, longer, du, dv, &terms);
    double roundings = 16.0 * (l->patch.du + l->patch.dv) * DBL_EPSILON, way = fabs(du) + fabs(dv);
    double off = roundings * (u + v) / plane, error = off * terms + 4.0 * roundings * way * way;
    // In the first case it may be no more than that, and is taken for 1 at least, so that the third
    // order is little beside it; in the second it must be that much.
    double t = sine * sine >= 4.0 * (fmax(curvature, 1.0) + error) * b ? 2.0 * b / sine : -1.0;
    if (t < 0.0 && curvature >= 1.0 && error <= 0.125 * curvature)
        t = 4.5 * sqrt(b / curvature);
    // And b moves (u,v), beside the way to t.
    bool certain =
        off <= 0.125 * fmax(sine, sqrt(b)) && t * way <= 0x1p-6 && b * fmax(u, v) / plane <= 0x1p-6;
    return certain && (t <= 10.0 * b || stays_inside(l, t * du, t * dv)) ? t : -1.0;
}

double patch_clearance(const PatchDef *def, const PatchHit *hit, const Ray *ray) {
    Leaving l = {.weights = def->weights, .u = hit->u, .v = hit->v};
    bezier_init(&l.patch, (int)def->degree_u, (int)def->degree_v, def->points);
    Box box = bezier_bounds(&l.patch);
    double extent = largest_of(vec_sub(box.high, box.low)), most = largest_of(ray->dir);
    // The start was computed from t dir and an origin as large as itself, two roundings each.
    double bound = hit->bound + 8.0 * DBL_EPSILON * largest_of(ray->org);
    if (!(most > 0.0) || !(extent > 0.0))
        return 0.0;
    // To unit size: no product may leave the range of numbers.
    int exponent;
    frexp(extent, &exponent);
    double half = ldexp(1.0, -exponent / 2), rest = ldexp(1.0, -exponent - -exponent / 2);
    for (int k = 0; k < bezier_count(&l.patch); k++)
        l.patch.p[k] = vec_scale(vec_scale(vec_sub(l.patch.p[k], box.low), half), rest);
    l.org = vec_scale(vec_scale(vec_sub(ray->org, box.low), half), rest);
    l.bound = bound * half * rest;

    Vec3 d = vec_scale(ray->dir, 1.0 / most);
    double length = vec_length(d);
    l.dir = vec_scale(d, 1.0 / length);
    double t = second_order(&l, hit->normal);
    if (t < 0.0)
        t = follow_surface(&l);
    // Beside a singular corner it may bend within less than the bound: of that nothing is known.
    t = fmax(t, 2.0 * l.bound);
    return t / (half * rest) / (length * most);
}
