// SPDX-License-Identifier: MIT
// Every primitive but the patch: all hits of a ray, the normal and the texture coordinates at one
// of them, the inside test, a bounding box. One file per primitive; each follows what POV-Ray
// shades and cuts (facts: rendering 0.2, 8), which is not always what mathematics would have.
//
// A Shape is prepared once from an Object and is read-only then. Most primitives live in a local
// space: rays are taken there by the inverse transform, and hits come back as depths of the world's
// ray, since t does not change under an affine map unless the direction is made unit again.
#ifndef SHAPE_SHAPE_H
#define SHAPE_SHAPE_H

#include "function/function.h"
#include "model/scene.h"
#include "shape/facet.h"

// First member: nothing to hit and no inside (no radius, no length, a flattening transform).
typedef enum {
    SHAPE_NONE,
    SHAPE_PLANE,
    SHAPE_SPHERE,
    SHAPE_BOX,
    SHAPE_CYLINDER,
    SHAPE_CONE,
    SHAPE_TORUS,
    SHAPE_DISC,
    SHAPE_TRIANGLE,
    SHAPE_SOLID, // all others: see solid.h
} ShapeKind;

typedef struct {
    Vec3 center;
    double radius, radius2;
} SphereData;

// Unit frame of a cylinder: x^2 + y^2 = 1, 0 <= z <= 1; of a cone: x^2 + y^2 = z^2, start <= z
// <= 1.
typedef struct {
    double start;
    bool open;
} ConeData;

typedef struct {
    double major, minor;
} TorusData;

typedef struct {
    Vec3 center, normal;
    double radius2, hole2;
} DiscData;

typedef struct SolidOps SolidOps;

typedef struct {
    const SolidOps *ops;
    const void *data;
    Box box; // in local space
} SolidData;

typedef struct {
    ShapeKind kind;
    bool inverse; // flips the inside, and the normal of all but quadrics; never set for planes
    const Transform *transform; // local to world; NULL: local space is the world
    const uint32_t *textures;   // what the numbers of a mesh stand for
    union {
        PlaneShape plane;
        SphereData sphere;
        BoxShape box;
        ConeData cone; // also the cylinder
        TorusData torus;
        DiscData disc;
        Facet triangle;
        SolidData solid;
    } as;
} Shape;

enum { SHAPE_MAX_HITS = 4 };

// part: which piece of the surface was hit, in the primitive's own numbering (a side of the box, a
// cap of the cone); keep: what else it wants to remember of the hit. To be handed back to
// shape_normal and shape_uv.
typedef struct {
    double t;
    int part;
    Vec3 keep;
} ShapeHit;

// Takes a hit; returns the depth beyond which hits are of no more interest.
typedef double (*ShapeVisit)(void *context, const ShapeHit *hit);

// Hits farther than this do not exist for most primitives (POV-Ray's limit; in local units for
// sphere, cone and cylinder under a transform).
#define SHAPE_FARTHEST 1e7
// POV-Ray's nearly zero: directions along a surface, and slack of inside tests.
#define SHAPE_EPSILON 1e-10
// Boxes are widened by this share of the numbers at hand: far above the rounding of points and the
// slack of inside tests, and still it costs no tests worth counting.
#define SHAPE_WIDER 1e-6

// object: any type from OBJECT_PLANE on. What must be kept beside the object goes to arena; scene
// and object must outlive the shape. What copies of an object have in common is looked up in, and
// added to, shared (zeroed at first, one for all shapes of a scene).
typedef struct ShapeShared ShapeShared;
ShapeShared *shape_shared_create(const Scene *scene, Arena *arena);
// What the surfaces of functions ask; until it is told, their pigments give nothing. Not while rays
// are traced.
void shape_shared_functions(ShapeShared *shared, const FunctionPool *functions);
Shape shape_prepare(const Scene *scene, const Object *object, ShapeShared *shared, Arena *arena);

// All hits that lie beyond the primitive's own least depth, in POV-Ray's order: of several at the
// same depth the last one counts. ray->dir must be of unit length. Returns how many; none is NaN.
// Not for SHAPE_SOLID, which may have any number.
int shape_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]);
// The same for every kind, one by one. Those that lie outside t_min..t_max may be left out.
// unit: the length that one of the world has where the ray is, if that is not the world itself: the
// primitives' least depths are the world's.
void shape_visit_in(const Shape *shape, const Ray *ray, double unit, double t_min, double t_max,
                    ShapeVisit visit, void *context);
static inline void shape_visit(const Shape *shape, const Ray *ray, double t_min, double t_max,
                               ShapeVisit visit, void *context) {
    shape_visit_in(shape, ray, 1.0, t_min, t_max, visit, context);
}
// The primitive's own textures at a hit, weights adding up to 1; up to SHAPE_MAX_TEXTURES. None:
// the object's counts.
typedef struct {
    uint32_t texture; // in the scene; NO_INDEX: the object's
    float weight;
} ShapeTexture;
enum { SHAPE_MAX_TEXTURES = HIT_MAX_TEXTURES };
uint32_t solid_textures(const Shape *shape, Vec3 p, const ShapeHit *hit,
                        ShapeTexture out[SHAPE_MAX_TEXTURES]);
static inline uint32_t shape_textures(const Shape *shape, Vec3 p, const ShapeHit *hit,
                                      ShapeTexture out[SHAPE_MAX_TEXTURES]) {
    return shape->kind == SHAPE_SOLID ? solid_textures(shape, p, hit, out) : 0;
}
// Unit normal at p, the point of a hit; points out of the inside, `inverse` applied (but not to
// quadrics).
Vec3 shape_normal_of(const Shape *shape, Vec3 p, const ShapeHit *hit);
static inline Vec3 shape_normal(const Shape *shape, Vec3 p, const ShapeHit *hit) {
    return shape->kind == SHAPE_PLANE ? shape->as.plane.normal : shape_normal_of(shape, p, hit);
}
// Texture coordinates at p. Sphere, box and torus have a mapping of their own; for the others
// POV-Ray takes the world's x and y.
Vec2 shape_uv(const Shape *shape, Vec3 p, const ShapeHit *hit);
bool shape_maps_uv(const Shape *shape);        // it has a mapping of its own
bool shape_inside(const Shape *shape, Vec3 p); // `inverse` applied
// False for triangles, SHAPE_NONE and the like: no point is ever inside.
bool shape_has_inside(const Shape *shape);
// Holds the surface (infinite in the directions where that is). The inside too, unless it is
// unbounded: then shape_inside_bounded is false.
Box shape_bounds(const Shape *shape);
bool shape_inside_bounded(const Shape *shape);
// Holds what of the inside and of the surface lies in `around` (which may be infinite): planes
// along the axes cut it, and so do quadrics. Others leave it as it is.
Box shape_within(const Shape *shape, Box around);
// The same of what is behind all the planes, which may lie along the axes of the shape's own space.
Box shape_within_planes(const Shape *shape, const PlaneShape *planes, uint32_t count, Box around);
// The box of what planes enclose, and of the part of each plane (one box each, perhaps an empty
// one) that is on its surface. False: they enclose nothing finite, or are too many.
enum { SHAPE_MOST_PLANES = 32 };
bool shape_planes_box(const PlaneShape *planes, uint32_t count, Box *all, Box *faces);
// The bounds in a space that `space` (NULL: it is the world) takes to the world.
Box shape_bounds_in(const Shape *shape, const Transform *space);

// ---- for the primitives' own files --------------------------------------------------------------

// A ray in local space with its direction made unit; depths there are scale x those of the world.
typedef struct {
    Ray ray;
    double scale;
} LocalRay;

// False when the direction vanishes or overflows there.
bool shape_local_ray(const Transform *transform, const Ray *ray, LocalRay *local);
Vec3 shape_local_point(const Transform *transform, Vec3 p);
// From local to world, unit; fallback (unit, world) where it has no direction.
Vec3 shape_world_normal(const Transform *transform, Vec3 normal, Vec3 fallback);
// The box of center + { a x + b y + c z : |(x, y, z)| <= 1 }, an ellipsoid (an ellipse with c = 0).
Box shape_ellipsoid_box(Vec3 center, Vec3 a, Vec3 b, Vec3 c);
// p mapped from local to world.
Vec3 shape_world_point(const Transform *transform, Vec3 p);
Vec3 shape_world_dir(const Transform *transform, Vec3 d);

// POV-Ray's least depth of a plane.
#define PLANE_NEAREST 1e-6
// The one hit, if there is one. Inline: every ray asks every plane.
static inline bool plane_depth(const PlaneShape *plane, const Ray *ray, double *t) {
    double slope = vec_dot(plane->normal, ray->dir);
    if (!(fabs(slope) >= SHAPE_EPSILON))
        return false;
    *t = -(vec_dot(plane->normal, ray->org) - plane->distance) / slope;
    return *t >= PLANE_NEAREST && *t <= SHAPE_FARTHEST;
}
int plane_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]);
bool plane_inside(const Shape *shape, Vec3 p);

void sphere_prepare(Shape *shape, const SphereShape *sphere);
int sphere_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]);
Vec3 sphere_normal(const Shape *shape, Vec3 p);
Vec2 sphere_uv(const Shape *shape, Vec3 p);
bool sphere_inside(const Shape *shape, Vec3 p); // `inverse` applied
Box sphere_bounds(const Shape *shape);

void box_prepare(Shape *shape, const BoxShape *box);
int box_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]);
Vec3 box_normal(const Shape *shape, int part);
Vec2 box_uv(const Shape *shape, Vec3 p, int part);
bool box_inside(const Shape *shape, Vec3 p);
Box box_bounds(const Shape *shape);

void cone_prepare(Shape *shape, const ConeShape *cone, Arena *arena);
int cone_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]);
Vec3 cone_normal(const Shape *shape, Vec3 p, int part);
bool cone_inside(const Shape *shape, Vec3 p);
Box cone_bounds(const Shape *shape);

void torus_prepare(Shape *shape, const TorusShape *torus);
int torus_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]);
Vec3 torus_normal(const Shape *shape, Vec3 p);
Vec2 torus_uv(const Shape *shape, Vec3 p);
bool torus_inside(const Shape *shape, Vec3 p);
Box torus_bounds(const Shape *shape);

void disc_prepare(Shape *shape, const DiscShape *disc);
int disc_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]);
Vec3 disc_normal(const Shape *shape);
bool disc_inside(const Shape *shape, Vec3 p);
Box disc_bounds(const Shape *shape);

void triangle_prepare(Shape *shape, const TriangleShape *triangle);
int triangle_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]);
Box triangle_bounds(const Shape *shape);

#endif
