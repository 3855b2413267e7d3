// SPDX-License-Identifier: MIT
// Of the scene model (scene.h): shapes and the trees they stand in. The larger primitives are in
// solid.h.
#ifndef MODEL_OBJECT_H
#define MODEL_OBJECT_H

#include "base/vec.h"
#include "model/solid.h"

#include <stdbool.h>
#include <stdint.h>

// ORDER object_type
typedef enum {
    OBJECT_UNION,        // children are separate objects
    OBJECT_MERGE,        // hits inside another child are dropped
    OBJECT_INTERSECTION, // hits outside another child are dropped; a difference is one with all
                         // children but the first inverted
    OBJECT_PATCH,
    OBJECT_PLANE,
    OBJECT_SPHERE,
    OBJECT_BOX,
    OBJECT_CYLINDER,
    OBJECT_CONE,
    OBJECT_TORUS,
    OBJECT_DISC,
    OBJECT_TRIANGLE,
    OBJECT_QUADRIC,
    OBJECT_POLY,
    OBJECT_SUPERELLIPSOID,
    OBJECT_LATHE,
    OBJECT_SOR,
    OBJECT_PRISM,
    OBJECT_SPHERE_SWEEP,
    OBJECT_BLOB,
    OBJECT_OVUS,
    OBJECT_SMOOTH_TRIANGLE,
    OBJECT_POLYGON,
    OBJECT_MESH,
    OBJECT_HEIGHT_FIELD,
    OBJECT_TEXT,
    OBJECT_ISOSURFACE,
    OBJECT_PARAMETRIC,
    OBJECT_INSTANCE, // a copy of a definition
    OBJECT_TYPE_COUNT,
} ObjectType;

// A Bézier patch in world space. Row i of points is weighted with u (POV-Ray's first index),
// column j with v. Texture coordinates: bilinear in the four corners (facts: rendering 7.6).
typedef struct {
    uint32_t degree_u, degree_v; // 1..16; 3, 3 for bicubic_patch
    Vec3 *points;                // (degree_u + 1) * (degree_v + 1)
    double *weights;             // of the points, > 0; NULL: all 1
    int type;                    // POV-Ray's 0 or 1; the picture is the same
    double flatness;             // this and the steps matter only to `facets`
    int u_steps, v_steps;        // recursion depths, not counts
    Vec2 uv[4];                  // at (i,j) = (0,0), (0,d), (d,d), (d,0)
} PatchShape;

// About its control points, so about the patch.
Box patch_shape_box(const PatchShape *patch);

// { p : normal . p = distance }, world space; inside is the side that normal points from.
typedef struct {
    Vec3 normal; // unit
    double distance;
} PlaneShape;

// Below: local space; Object.transform takes it to the world.
typedef struct {
    Vec3 center;
    double radius;
} SphereShape;

typedef struct {
    Vec3 low, high;
} BoxShape;

// The cylinder or cone from base to apex (POV-Ray's two end points as written, with its order).
typedef struct {
    Vec3 base, apex;
    double base_radius, apex_radius; // equal for a cylinder
    bool open;
} ConeShape;

typedef struct { // axis y
    double major, minor;
} TorusShape;

typedef struct {
    Vec3 center, normal; // unit
    double radius, hole;
} DiscShape;

typedef struct { // world space
    Vec3 p[3];
} TriangleShape;

typedef struct {
    uint32_t *items;
    uint32_t count;
} ObjectList;

// The tree Scene.definitions[definition] once more, moved by Object.transform; textures are given
// as they are in the world. Only at top level, or in unions without clips and bounds that are not
// whole. Its flags are those of the tree's leaves. Leaves without a texture or an interior have
// those of the instance (which needs none: then they are one body of air).
typedef struct {
    uint32_t definition;
    uint32_t *textures; // pairs, ascending: leaves with the first have the second
    uint32_t texture_count;
    uint32_t *interiors; // the same
    uint32_t interior_count;
} InstanceShape;

// One hit shows no more textures than this at once, of parts of a blob or of what was cut.
enum { HIT_MAX_TEXTURES = 32 };

typedef struct {
    ObjectType type;
    // Leaves: NO_INDEX in texture means POV-Ray's built-in default (black). interior NO_INDEX: an
    // air interior of its own; two objects with the same index are one body to a ray.
    uint32_t texture, interior_texture, interior;
    bool no_shadow, no_image, no_reflection, hollow, double_illuminate;
    bool no_global_lights; // in a light_group: only its lights shine on it
    uint32_t light_group;  // see Light.group; 0: none
    bool inverse;          // of leaves and solid unions: of other trees it is lowered to the leaves
    bool uv_mapping;       // object level: all its textures are evaluated at (u, v, 0)
    bool solid;            // of a union of patches: they are closed, and have an inside
    bool whole;            // of a union without clips: as one object, like other trees
    // Of an intersection or merge, and of a leaf without a texture: POV-Ray's cutaway_textures. A
    // hit of the leaf shows the textures of what contains it in the outermost intersection, merge
    // or clipped union around, each alike; of a difference only the first child counts.
    bool difference, cutaway;
    bool has_transform;
    Transform transform; // local to world, of types with a local space (object_has_space)
    // Hits, and the inside, are only where all of these objects are (their flags and textures do
    // not count). Not on patches: POV-Ray ignores it there.
    ObjectList clips;
    // A ray sees the object only if it meets each of these objects too, or starts inside; the same
    // for all that is in them. Nothing but their shapes counts.
    ObjectList bounds;
    union {
        PatchShape patch;
        PlaneShape plane;
        SphereShape sphere;
        BoxShape box;
        ConeShape cone; // also OBJECT_CYLINDER
        TorusShape torus;
        DiscShape disc;
        TriangleShape triangle;
        QuadricShape quadric;
        PolyShape poly;
        SuperellipsoidShape superellipsoid;
        LatheShape lathe;
        SorShape sor;
        PrismShape prism;
        SphereSweepShape sphere_sweep;
        BlobShape blob;
        OvusShape ovus;
        SmoothTriangleShape smooth_triangle;
        PolygonShape polygon;
        MeshShape mesh;
        HeightFieldShape height_field;
        TextShape text;
        IsosurfaceShape isosurface;
        ParametricShape parametric;
        InstanceShape instance;
        ObjectList children; // UNION, MERGE, INTERSECTION
    } shape;
} Object;

Object object_default(ObjectType type);
// Has it children?
bool object_is_tree(const Object *object);
// Has it a local space, so that it may have a transform?
bool object_has_space(ObjectType type);

// What a leaf of the instance's definition has there whose own texture or interior that is.
uint32_t instance_texture(const Object *instance, uint32_t own);
uint32_t instance_interior(const Object *instance, uint32_t own);

#endif
