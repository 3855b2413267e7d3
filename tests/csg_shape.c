// SPDX-License-Identifier: MIT
#include "tests/csg_shape.h"

#include <math.h>

// ---- vectors and places ---------------------------------------------------------------------

static Point point(long double x, long double y, long double z) { return (Point){x, y, z}; }
Point csg_point_of(Vec3 v) { return point(v.x, v.y, v.z); }
Point csg_point_add(Point a, Point b) { return point(a.x + b.x, a.y + b.y, a.z + b.z); }
Point csg_point_sub(Point a, Point b) { return point(a.x - b.x, a.y - b.y, a.z - b.z); }
Point csg_point_scale(Point a, long double s) { return point(a.x * s, a.y * s, a.z * s); }
Point csg_point_cross(Point a, Point b) {
    return point(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
long double csg_point_dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point csg_point_unit(Point a) { return csg_point_scale(a, 1.0L / sqrtl(csg_point_dot(a, a))); }

static Point along(Point org, long double t, Point dir) {
    return csg_point_add(org, csg_point_scale(dir, t));
}

static Point place_dir(const Place *place, Point d) {
    return csg_point_add(
        csg_point_add(csg_point_scale(place->a[0], d.x), csg_point_scale(place->a[1], d.y)),
        csg_point_scale(place->a[2], d.z));
}
static Point place_point(const Place *place, Point p) {
    return csg_point_add(place_dir(place, p), place->a[3]);
}

Place csg_place_none(void) { return (Place){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}}; }

// Rotations by degrees about x, then y, then z, left-handed.
static Point turned(Point p, Vec3 deg) {
    const long double degree = acosl(-1.0L) / 180.0L;
    long double c = cosl(deg.x * degree), s = sinl(deg.x * degree);
    p = point(p.x, c * p.y - s * p.z, s * p.y + c * p.z);
    c = cosl(deg.y * degree), s = sinl(deg.y * degree);
    p = point(c * p.x + s * p.z, p.y, c * p.z - s * p.x);
    c = cosl(deg.z * degree), s = sinl(deg.z * degree);
    return point(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
}

Place csg_place_within(const CsgTree *tree, const Place *around) {
    Place own = csg_place_none();
    for (int i = 0; i < 4; i++) {
        Point p = turned(own.a[i], tree->rotate);
        p = point(p.x * tree->scale.x, p.y * tree->scale.y, p.z * tree->scale.z);
        own.a[i] = i < 3 ? place_dir(around, p)
                         : place_point(around, csg_point_add(p, csg_point_of(tree->translate)));
    }
    return own;
}

static Place place_inverse(const Place *place) {
    const Point *a = place->a;
    long double det = csg_point_dot(a[0], csg_point_cross(a[1], a[2]));
    Point r0 = csg_point_scale(csg_point_cross(a[1], a[2]), 1.0L / det);
    Point r1 = csg_point_scale(csg_point_cross(a[2], a[0]), 1.0L / det);
    Point r2 = csg_point_scale(csg_point_cross(a[0], a[1]), 1.0L / det);
    Place back = {{{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, {0, 0, 0}}};
    back.a[3] = csg_point_scale(place_dir(&back, a[3]), -1.0L);
    return back;
}

// ---- patches: POV-Ray's triangles -----------------------------------------------------------

enum { STEPS = 4, CELLS = STEPS * STEPS }; // 2^2 for u_steps 2, v_steps 2

struct Cell {
    Point corner[4], normal[4]; // at (u0, v0), (u0, v1), (u1, v1), (u1, v0)
};

static void bernstein(long double t, long double b[4], long double d[4]) {
    long double s = 1.0L - t;
    b[0] = s * s * s, b[1] = 3 * s * s * t, b[2] = 3 * s * t * t, b[3] = t * t * t;
    d[0] = -3 * s * s, d[1] = 3 * s * s - 6 * s * t, d[2] = 6 * s * t - 3 * t * t, d[3] = 3 * t * t;
}

static void patch_at(const Point p[16], long double u, long double v, Point *at, Point *normal) {
    long double bu[4], du[4], bv[4], dv[4];
    Point along_u = {0, 0, 0}, along_v = {0, 0, 0};
    *at = along_u;
    bernstein(u, bu, du);
    bernstein(v, bv, dv);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            *at = along(*at, bu[i] * bv[j], p[4 * i + j]);
            along_u = along(along_u, du[i] * bv[j], p[4 * i + j]);
            along_v = along(along_v, bu[i] * dv[j], p[4 * i + j]);
        }
    *normal = csg_point_unit(csg_point_cross(along_u, along_v));
}

static struct Cell *patch_cells(const double *numbers, const Place *place, Arena *arena) {
    struct Cell *cells = ARENA_ARRAY(arena, struct Cell, CELLS);
    Point p[16];
    for (int i = 0; i < 16; i++)
        p[i] = place_point(place, point(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]));
    for (int c = 0; c < CELLS; c++)
        for (int k = 0; k < 4; k++) {
            int i = c / STEPS + (k >= 2), j = c % STEPS + (k == 1 || k == 2);
            patch_at(p, i / (long double)STEPS, j / (long double)STEPS, &cells[c].corner[k],
                     &cells[c].normal[k]);
        }
    return cells;
}

static bool triangle_root(const struct Cell *cell, const int k[3], Point org, Point dir,
                          SolidRoot *root) {
    Point a = csg_point_sub(cell->corner[k[1]], cell->corner[k[0]]);
    Point b = csg_point_sub(cell->corner[k[2]], cell->corner[k[0]]), n = csg_point_cross(a, b);
    long double across = csg_point_dot(n, dir), square = csg_point_dot(n, n);
    if (across == 0 || square == 0)
        return false;
    root->t = csg_point_dot(n, csg_point_sub(cell->corner[k[0]], org)) / across;
    Point at = csg_point_sub(along(org, root->t, dir), cell->corner[k[0]]);
    long double u = csg_point_dot(csg_point_cross(at, b), n) / square;
    long double v = csg_point_dot(csg_point_cross(a, at), n) / square;
    if (u < 0 || v < 0 || u + v > 1)
        return false;
    Point normal = csg_point_scale(cell->normal[k[0]], 1 - u - v);
    normal = along(along(normal, u, cell->normal[k[1]]), v, cell->normal[k[2]]);
    root->normal = csg_point_unit(normal);
    return true;
}

static int patch_roots(const SolidShape *shape, Point org, Point dir, SolidRoot *roots) {
    static const int triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    int count = 0;
    for (int c = 0; c < CELLS; c++)
        for (int i = 0; i < 2; i++)
            count += triangle_root(&shape->cells[c], triangles[i], org, dir, &roots[count]);
    return count;
}

// ---- roots of solids, in their own space ----------------------------------------------------

static long double polynomial(const long double *c, int degree, long double t) {
    long double sum = c[degree];
    for (int i = degree - 1; i >= 0; i--)
        sum = sum * t + c[i];
    return sum;
}

// Roots of c[0] + c[1] t + ... within low..high: between two extremes there is one at most.
static int polynomial_roots(const long double *c, int degree, long double low, long double high,
                            long double *roots) {
    long double slope[4], turns[6];
    if (degree == 1) {
        roots[0] = -c[0] / c[1];
        return c[1] != 0 && roots[0] >= low && roots[0] <= high;
    }
    for (int i = 0; i < degree; i++)
        slope[i] = (long double)(i + 1) * c[i + 1];
    turns[0] = low;
    int turn_count = 1 + polynomial_roots(slope, degree - 1, low, high, turns + 1), count = 0;
    turns[turn_count] = high;
    for (int i = 0; i < turn_count; i++) {
        long double a = turns[i], b = turns[i + 1];
        bool rises = polynomial(c, degree, a) < 0;
        if (rises == (polynomial(c, degree, b) < 0))
            continue;
        for (int k = 0; k < 100; k++) {
            long double middle = 0.5L * (a + b);
            if ((polynomial(c, degree, middle) < 0) == rises)
                a = middle;
            else
                b = middle;
        }
        roots[count++] = 0.5L * (a + b);
    }
    return count;
}

static int quadratic_roots(long double a, long double b, long double c, long double t[2]) {
    long double square = b * b - 4 * a * c;
    if (square <= 0 || a == 0)
        return 0;
    long double q = -0.5L * (b + copysignl(sqrtl(square), b));
    t[0] = q / a, t[1] = c / q;
    return 2;
}

static int sphere_roots(const double *n, Point org, Point dir, SolidRoot *roots) {
    Point o = csg_point_sub(org, point(n[0], n[1], n[2]));
    long double t[2];
    int count = quadratic_roots(csg_point_dot(dir, dir), 2 * csg_point_dot(o, dir),
                                csg_point_dot(o, o) - (long double)n[3] * n[3], t);
    for (int i = 0; i < count; i++)
        roots[i] = (SolidRoot){t[i], along(o, t[i], dir)};
    return count;
}

static long double part(Point p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

static int box_roots(const double *n, Point org, Point dir, SolidRoot *roots) {
    int count = 0;
    for (int face = 0; face < 6; face++) {
        int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        long double t = (n[axis + 3 * (face % 2)] - part(org, axis)) / part(dir, axis);
        Point p = along(org, t, dir);
        if (part(dir, axis) != 0 && part(p, u) >= n[u] && part(p, u) <= n[u + 3] &&
            part(p, v) >= n[v] && part(p, v) <= n[v + 3])
            roots[count++] = (SolidRoot){t, point(axis == 0, axis == 1, axis == 2)};
    }
    return count;
}

// Where along its axis, and how far from it.
typedef struct {
    Point base, axis; // axis: unit
    long double length, r0, grows;
} Cone;

static Cone cone_of(const double *n) {
    Point base = point(n[0], n[1], n[2]), way = csg_point_sub(point(n[3], n[4], n[5]), base);
    long double length = sqrtl(csg_point_dot(way, way));
    return (Cone){base, csg_point_scale(way, 1 / length), length, n[6], (n[7] - n[6]) / length};
}

static int cone_roots(const CsgTree *tree, Point org, Point dir, SolidRoot *roots) {
    Cone cone = cone_of(tree->numbers);
    Point o = csg_point_sub(org, cone.base);
    long double h = csg_point_dot(o, cone.axis), dh = csg_point_dot(dir, cone.axis), t[2];
    Point across = along(o, -h, cone.axis), step = along(dir, -dh, cone.axis);
    long double r = cone.r0 + cone.grows * h, dr = cone.grows * dh;
    int count = 0, sides = quadratic_roots(csg_point_dot(step, step) - dr * dr,
                                           2 * (csg_point_dot(across, step) - r * dr),
                                           csg_point_dot(across, across) - r * r, t);
    for (int i = 0; i < sides; i++) {
        long double at = h + t[i] * dh;
        Point out = along(across, t[i], step);
        if (at >= 0 && at <= cone.length)
            roots[count++] =
                (SolidRoot){t[i], along(out, -cone.grows * (cone.r0 + cone.grows * at), cone.axis)};
    }
    for (int end = 0; end < 2 && !tree->open && dh != 0; end++) {
        long double at = end * cone.length, s = (at - h) / dh, limit = cone.r0 + cone.grows * at;
        Point out = along(across, s, step);
        if (csg_point_dot(out, out) <= limit * limit)
            roots[count++] = (SolidRoot){s, cone.axis};
    }
    return count;
}

static int torus_roots(const double *n, Point org, Point dir, SolidRoot *roots) {
    long double major = n[0], minor = n[1], length = sqrtl(csg_point_dot(dir, dir)), t[6];
    Point d = csg_point_scale(dir, 1 / length);
    long double middle = -csg_point_dot(org, d), reach = major + minor + 0.1L;
    Point o = along(org, middle, d);
    if (csg_point_dot(o, o) > reach * reach)
        return 0;
    // (|p|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + z^2), with |p|^2 = o.o + t^2
    long double k = csg_point_dot(o, o) + major * major - minor * minor, m = 4 * major * major;
    const long double c[5] = {k * k - m * (o.x * o.x + o.z * o.z), -2 * m * (o.x * d.x + o.z * d.z),
                              2 * k - m * (d.x * d.x + d.z * d.z), 0, 1};
    int count = polynomial_roots(c, 4, -reach, reach, t);
    for (int i = 0; i < count; i++) {
        Point p = along(o, t[i], d);
        long double ring = major / sqrtl(p.x * p.x + p.z * p.z);
        roots[i] = (SolidRoot){(middle + t[i]) / length,
                               csg_point_sub(p, point(p.x * ring, 0, p.z * ring))};
    }
    return count;
}

static int plane_roots(const double *n, Point org, Point dir, SolidRoot *roots) {
    Point normal = csg_point_unit(point(n[0], n[1], n[2]));
    long double across = csg_point_dot(normal, dir);
    *roots = (SolidRoot){(n[3] - csg_point_dot(normal, org)) / across, normal};
    return across != 0;
}

static int local_roots(const CsgTree *tree, Point org, Point dir, SolidRoot *roots) {
    switch (tree->kind) {
    case TREE_SPHERE:
        return sphere_roots(tree->numbers, org, dir, roots);
    case TREE_BOX:
        return box_roots(tree->numbers, org, dir, roots);
    case TREE_CYLINDER:
    case TREE_CONE:
        return cone_roots(tree, org, dir, roots);
    case TREE_TORUS:
        return torus_roots(tree->numbers, org, dir, roots);
    default:
        return plane_roots(tree->numbers, org, dir, roots);
    }
}

// ---- shapes ---------------------------------------------------------------------------------

SolidShape csg_solid_shape(const CsgTree *leaf, const Place *place, Arena *arena) {
    SolidShape shape = {leaf->kind, leaf, *place, place_inverse(place), NULL};
    if (leaf->kind == TREE_PATCH)
        shape.cells = patch_cells(leaf->numbers, place, arena);
    return shape;
}

int csg_solid_roots(const SolidShape *shape, Point org, Point dir,
                    SolidRoot roots[SOLID_MAX_ROOTS]) {
    if (shape->kind == TREE_PATCH)
        return patch_roots(shape, org, dir, roots);
    int count = local_roots(shape->tree, place_point(&shape->back, org),
                            place_dir(&shape->back, dir), roots);
    for (int i = 0; i < count; i++) {
        // A normal is a row of the inverse.
        Point n = roots[i].normal;
        const Point *b = shape->back.a;
        roots[i].normal = csg_point_unit(
            point(csg_point_dot(b[0], n), csg_point_dot(b[1], n), csg_point_dot(b[2], n)));
    }
    return count;
}

bool csg_solid_inside(const SolidShape *shape, Point p) {
    const double *n = shape->tree->numbers;
    p = place_point(&shape->back, p);
    switch (shape->kind) {
    case TREE_SPHERE:
        p = csg_point_sub(p, point(n[0], n[1], n[2]));
        return csg_point_dot(p, p) <= (long double)n[3] * n[3];
    case TREE_BOX:
        return p.x >= n[0] && p.x <= n[3] && p.y >= n[1] && p.y <= n[4] && p.z >= n[2] &&
               p.z <= n[5];
    case TREE_CYLINDER:
    case TREE_CONE: {
        Cone cone = cone_of(n);
        p = csg_point_sub(p, cone.base);
        long double h = csg_point_dot(p, cone.axis), r = cone.r0 + cone.grows * h;
        p = along(p, -h, cone.axis);
        return h >= 0 && h <= cone.length && csg_point_dot(p, p) <= r * r;
    }
    case TREE_TORUS: {
        long double ring = sqrtl(p.x * p.x + p.z * p.z) - n[0];
        return ring * ring + p.y * p.y <= (long double)n[1] * n[1];
    }
    case TREE_PLANE:
        return csg_point_dot(csg_point_unit(point(n[0], n[1], n[2])), p) <= n[3];
    default:
        return false;
    }
}
