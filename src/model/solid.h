// SPDX-License-Identifier: MIT
// What the larger primitives are made of, in their local space: Object.transform takes it to the
// world. Lists live in the scene's arena; objects that are copies of one another may share them.
#ifndef MODEL_SOLID_H
#define MODEL_SOLID_H

#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

enum { SCENE_MAX_ORDER = 35 }; // of a polynomial: POV-Ray's limit

// ORDER outline_type (names in object_fields.c)
typedef enum {
    OUTLINE_LINEAR,
    OUTLINE_QUADRATIC,
    OUTLINE_CUBIC,  // Catmull-Rom
    OUTLINE_BEZIER, // four points a segment
    OUTLINE_B_SPLINE
} OutlineType;

// square . p^2 + mixed . (xy, xz, yz) + linear . p + constant <= 0
typedef struct {
    Vec3 square, mixed, linear;
    double constant;
} QuadricShape;

// Coefficients in POV-Ray's order: x^n first, the constant last; within it by falling powers of x,
// then y, then z. (order + 1)(order + 2)(order + 3) / 6 of them.
typedef struct {
    int order; // 2..SCENE_MAX_ORDER
    double *coefficients;
    uint32_t count;
    bool sturm;
} PolyShape;

typedef struct {
    double e, n; // east-west and north-south exponents, > 0
} SuperellipsoidShape;

// A curve of (radius, height), turned about the y axis.
typedef struct {
    OutlineType outline; // not B_SPLINE
    Vec2 *points;
    uint32_t count;
} LatheShape;

// The same, with radius^2 a cubic in the height of each piece; the first and the last point only
// give slopes.
typedef struct {
    Vec2 *points;
    uint32_t count; // >= 4
    bool open;
} SorShape;

// Closed curves of (x, z), swept from y = low to y = high; conic: scaled with y meanwhile.
typedef struct {
    OutlineType outline; // not B_SPLINE
    bool conic, open;
    double low, high;
    Vec2 *points;
    uint32_t count;
} PrismShape;

typedef struct {
    Vec3 center;
    double radius;
} SweepSphere;

// The union of all balls between the given ones.
typedef struct {
    OutlineType outline; // LINEAR, CUBIC, B_SPLINE
    SweepSphere *spheres;
    uint32_t count;
    double tolerance; // hits nearer than this do not count
} SphereSweepShape;

// Field of a component: strength (1 - d^2 / radius^2)^2, d from the centre, or from the line
// between base and apex.
typedef struct {
    bool cylinder;
    Vec3 base, apex; // sphere: base alone
    double radius, strength;
    uint32_t texture; // of its own, or NO_INDEX
    bool has_transform;
    Transform transform; // from the component's space to that of the blob
} BlobComponent;

// Where the sum of the fields is above the threshold.
typedef struct {
    double threshold;
    BlobComponent *components;
    uint32_t count;
} BlobShape;

typedef struct {        // axis y
    double bottom, top; // radii; top < 2 bottom
} OvusShape;

typedef struct {     // world space
    Vec3 p[3], n[3]; // unit normals
} SmoothTriangleShape;

// Rings in one plane, one after the other; each ends where it meets its first point again. A point
// is within where it is within an odd number of them.
typedef struct {
    Vec3 *points;
    uint32_t count;
} PolygonShape;

typedef struct {
    uint32_t p[3], n[3], uv[3]; // indices; n[0] or uv[0] NO_INDEX: it has none
    // Into the textures of the object with this mesh, mixed when there are three; NO_INDEX: the
    // object's own.
    uint32_t texture[3];
} MeshFace;

// A pool of the scene, since many objects may show the same mesh.
typedef struct {
    double *points; // rows of three; the faces' planes are theirs, the corners are rounded to float
    uint32_t point_count;
    double *normals; // rows of three, unit
    uint32_t normal_count;
    double *uv; // rows of two
    uint32_t uv_count;
    MeshFace *faces;
    uint32_t face_count;
    int texture_slots; // textures that the faces refer to
    bool has_inside;
    Vec3 inside_vector;
} Mesh;

typedef struct {
    uint32_t mesh;
    uint32_t *textures; // of the scene; at least the mesh's texture_slots
    uint32_t texture_count;
} MeshShape;

// A pool of the scene: a grid of heights (of pictures 0..65535), rows from z = 0, which is the last
// one of a picture.
typedef struct {
    int width, depth; // samples along x and z
    double *heights;  // width * depth
    uint32_t count;
} HeightMap;

// Over 0 <= x <= width - 1, 0 <= z <= depth - 1 of its local space.
typedef struct {
    uint32_t map;
    double water_level; // of heights: what is below is not there
    bool smooth;
} HeightFieldShape;

// Letters of quadratic arcs in the plane z = 0, extruded to z = thickness.
typedef struct {
    double thickness;
    double *arcs; // rows of six: (x, y) of start, control and end point
    uint32_t arc_count;
    uint32_t *letters; // first arc of each letter; it ends where the next begins
    uint32_t letter_count;
} TextShape;

// What bounds a surface that functions describe.
typedef struct {
    bool in_sphere; // around center; else the box from low to high
    Vec3 low, high, center;
    double radius;
} Container;

// Where a function of x, y and z is not above the threshold.
typedef struct {
    uint32_t function; // of the scene: of three arguments, to one number
    Container container;
    double threshold;
    double accuracy;     // as a depth in the world
    double max_gradient; // that the surface is found with
    int max_trace;       // surfaces along a ray, 1 to 10
    bool open;           // not closed where the container cuts it
    bool evaluate;       // the gradient grows as it is met: by these three numbers
    double evaluate_from, evaluate_over, evaluate_fall;
} IsosurfaceShape;

enum { SCENE_MAX_TRACE = 10 };

// The points (x, y, z) of three functions of u and v.
typedef struct {
    uint32_t functions[3];  // of the scene, as that of an isosurface: of u, v and 0
    double low[2], high[2]; // of u and v
    Container container;
    double accuracy;     // of u and v, and as a depth in the world
    double max_gradient; // that each function is bounded with
    bool precompute[3];  // bounds of that function are found in advance, ...
    int depth;           // ... for pieces halved so often, 1 to SCENE_MAX_PRECOMPUTE
} ParametricShape;

enum { SCENE_MAX_PRECOMPUTE = 20 };

#endif
