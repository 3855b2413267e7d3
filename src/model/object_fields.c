// SPDX-License-Identifier: MIT
// The tables of scene_fields.h for objects and what they share, in the order of scene.h.
#include "model/scene_fields.h"

#include "model/field_macros.h"

_Static_assert(sizeof(MeshFace) == MESH_FACE_COLUMNS * sizeof(uint32_t),
               "faces are rows of numbers");
_Static_assert(sizeof(SweepSphere) == 4 * sizeof(double), "spheres are rows of numbers");

// ---- objects --------------------------------------------------------------------------------

// ORDER object_type
const char *const OBJECT_TYPE_NAMES[] = {
    "union",        "merge",    "intersection",   "bicubic_patch",   "plane",    "sphere",
    "box",          "cylinder", "cone",           "torus",           "disc",     "triangle",
    "quadric",      "poly",     "superellipsoid", "lathe",           "sor",      "prism",
    "sphere_sweep", "blob",     "ovus",           "smooth_triangle", "polygon",  "mesh",
    "height_field", "text",     "isosurface",     "parametric",      "instance", NULL,
};
_Static_assert(sizeof OBJECT_TYPE_NAMES / sizeof *OBJECT_TYPE_NAMES == OBJECT_TYPE_COUNT + 1,
               "a name for each type");
const char BEZIER_PATCH_NAME[] = "bezier_patch";

static const Field OBJECT_FIELDS[] = {
    INDEX(Object, texture, "texture"),
    INDEX(Object, interior_texture, "interior_texture"),
    INDEX(Object, interior, "interior"),
    BOOL(Object, no_shadow, "no_shadow"),
    BOOL(Object, no_image, "no_image"),
    BOOL(Object, no_reflection, "no_reflection"),
    BOOL(Object, hollow, "hollow"),
    INDEX(Object, light_group, "light_group"),
    BOOL(Object, no_global_lights, "no_global_lights"),
    BOOL(Object, inverse, "inverse"),
    BOOL(Object, double_illuminate, "double_illuminate"),
    BOOL(Object, uv_mapping, "uv_mapping"),
    BOOL(Object, solid, "solid"),
    BOOL(Object, whole, "whole"),
    BOOL(Object, difference, "difference"),
    BOOL(Object, cutaway, "cutaway"),
    END,
};
static const Record OBJECT = {NULL, OBJECT_FIELDS, sizeof(Object), NULL, NULL};

// The types with a local space have these last, so that the file shows the shape first.
#define OBJECT_TRANSFORM                                                                           \
    {                                                                                              \
        .name = "transform", .type = FIELD_TRANSFORM, .presence = FIELD_FLAGGED,                   \
        AT(Object, transform), .link = offsetof(Object, has_transform)                             \
    }
#define SHAPE_VEC3(member, text) VEC3_AS(FIELD_REQUIRED, Object, shape.member, text)
#define SHAPE_DOUBLE(member, text) DOUBLE_AS(FIELD_REQUIRED, Object, shape.member, text)

static const Field PATCH_FIELDS[] = {
    INT(Object, shape.patch.type, "patch_type"),
    DOUBLE_AS(FIELD_PLAIN, Object, shape.patch.flatness, "flatness"),
    INT(Object, shape.patch.u_steps, "u_steps"),
    INT(Object, shape.patch.v_steps, "v_steps"),
    {.name = "uv", .type = FIELD_ROWS, AT(Object, shape.patch.uv), .rows = 4, .columns = 2},
    END,
};
static const Field PLANE_FIELDS[] = {
    SHAPE_VEC3(plane.normal, "normal"),
    SHAPE_DOUBLE(plane.distance, "distance"),
    END,
};
static const Field SPHERE_FIELDS[] = {
    SHAPE_VEC3(sphere.center, "center"),
    SHAPE_DOUBLE(sphere.radius, "radius"),
    OBJECT_TRANSFORM,
    END,
};
static const Field BOX_FIELDS[] = {
    SHAPE_VEC3(box.low, "low"),
    SHAPE_VEC3(box.high, "high"),
    OBJECT_TRANSFORM,
    END,
};
static const Field CONE_FIELDS[] = {
    SHAPE_VEC3(cone.base, "base"),
    SHAPE_DOUBLE(cone.base_radius, "base_radius"),
    SHAPE_VEC3(cone.apex, "apex"),
    SHAPE_DOUBLE(cone.apex_radius, "apex_radius"),
    BOOL(Object, shape.cone.open, "open"),
    OBJECT_TRANSFORM,
    END,
};
static const Field TORUS_FIELDS[] = {
    SHAPE_DOUBLE(torus.major, "major"),
    SHAPE_DOUBLE(torus.minor, "minor"),
    OBJECT_TRANSFORM,
    END,
};
static const Field DISC_FIELDS[] = {
    SHAPE_VEC3(disc.center, "center"),
    SHAPE_VEC3(disc.normal, "normal"),
    SHAPE_DOUBLE(disc.radius, "radius"),
    DOUBLE_AS(FIELD_PLAIN, Object, shape.disc.hole, "hole"),
    OBJECT_TRANSFORM,
    END,
};
static const Field TRIANGLE_FIELDS[] = {
    {.name = "points",
     .type = FIELD_ROWS,
     .presence = FIELD_REQUIRED,
     AT(Object, shape.triangle.p),
     .rows = 3,
     .columns = 3},
    END,
};

static const Field QUADRIC_FIELDS[] = {
    SHAPE_VEC3(quadric.square, "square"),
    SHAPE_VEC3(quadric.mixed, "mixed"),
    SHAPE_VEC3(quadric.linear, "linear"),
    SHAPE_DOUBLE(quadric.constant, "constant"),
    OBJECT_TRANSFORM,
    END,
};
static const Field POLY_FIELDS[] = {
    {.name = "order", .type = FIELD_INT, .presence = FIELD_REQUIRED, AT(Object, shape.poly.order)},
    TABLE(Object, shape.poly.coefficients, shape.poly.count, "coefficients", 1),
    BOOL(Object, shape.poly.sturm, "sturm"),
    OBJECT_TRANSFORM,
    END,
};
static const Field SUPERELLIPSOID_FIELDS[] = {
    SHAPE_DOUBLE(superellipsoid.e, "e"),
    SHAPE_DOUBLE(superellipsoid.n, "n"),
    OBJECT_TRANSFORM,
    END,
};

// ORDER outline_type
static const char *const OUTLINE_TYPE_NAMES[] = {"linear", "quadratic", "cubic",
                                                 "bezier", "b_spline",  NULL};

static const Field LATHE_FIELDS[] = {
    ENUM(Object, shape.lathe.outline, "outline", OUTLINE_TYPE_NAMES),
    TABLE(Object, shape.lathe.points, shape.lathe.count, "points", 2),
    OBJECT_TRANSFORM,
    END,
};
static const Field SOR_FIELDS[] = {
    TABLE(Object, shape.sor.points, shape.sor.count, "points", 2),
    BOOL(Object, shape.sor.open, "open"),
    OBJECT_TRANSFORM,
    END,
};
static const Field PRISM_FIELDS[] = {
    ENUM(Object, shape.prism.outline, "outline", OUTLINE_TYPE_NAMES),
    BOOL(Object, shape.prism.conic, "conic"),
    SHAPE_DOUBLE(prism.low, "low"),
    SHAPE_DOUBLE(prism.high, "high"),
    TABLE(Object, shape.prism.points, shape.prism.count, "points", 2),
    BOOL(Object, shape.prism.open, "open"),
    OBJECT_TRANSFORM,
    END,
};
static const Field SPHERE_SWEEP_FIELDS[] = {
    ENUM(Object, shape.sphere_sweep.outline, "outline", OUTLINE_TYPE_NAMES),
    TABLE(Object, shape.sphere_sweep.spheres, shape.sphere_sweep.count, "spheres", 4),
    DOUBLE(Object, shape.sphere_sweep.tolerance, "tolerance"),
    OBJECT_TRANSFORM,
    END,
};

static const Field COMPONENT_FIELDS[] = {
    BOOL(BlobComponent, cylinder, "cylinder"),
    VEC3_AS(FIELD_REQUIRED, BlobComponent, base, "base"),
    VEC3(BlobComponent, apex, "apex"),
    DOUBLE_AS(FIELD_REQUIRED, BlobComponent, radius, "radius"),
    DOUBLE_AS(FIELD_REQUIRED, BlobComponent, strength, "strength"),
    INDEX(BlobComponent, texture, "texture"),
    {.name = "transform",
     .type = FIELD_TRANSFORM,
     .presence = FIELD_FLAGGED,
     AT(BlobComponent, transform),
     .link = offsetof(BlobComponent, has_transform)},
    END,
};
static void default_component(void *out) {
    *(BlobComponent *)out = (BlobComponent){.texture = NO_INDEX, .transform = transform_identity()};
}
static const Record COMPONENT = {NULL, COMPONENT_FIELDS, sizeof(BlobComponent), default_component,
                                 NULL};
static const Field BLOB_FIELDS[] = {
    DOUBLE(Object, shape.blob.threshold, "threshold"),
    RECORDS(Object, shape.blob.components, shape.blob.count, "components", &COMPONENT),
    OBJECT_TRANSFORM,
    END,
};
static const Field OVUS_FIELDS[] = {
    SHAPE_DOUBLE(ovus.bottom, "bottom"),
    SHAPE_DOUBLE(ovus.top, "top"),
    OBJECT_TRANSFORM,
    END,
};
#define THREE_POINTS(member, text)                                                                 \
    {                                                                                              \
        .name = text, .type = FIELD_ROWS, .presence = FIELD_REQUIRED, AT(Object, shape.member),    \
        .rows = 3, .columns = 3                                                                    \
    }
static const Field SMOOTH_TRIANGLE_FIELDS[] = {
    THREE_POINTS(smooth_triangle.p, "points"),
    THREE_POINTS(smooth_triangle.n, "normals"),
    END,
};
static const Field POLYGON_FIELDS[] = {
    TABLE(Object, shape.polygon.points, shape.polygon.count, "points", 3),
    OBJECT_TRANSFORM,
    END,
};
static const Field MESH_FIELDS[] = {
    {.name = "mesh", .type = FIELD_INDEX, .presence = FIELD_REQUIRED, AT(Object, shape.mesh.mesh)},
    {.name = "textures",
     .type = FIELD_INDICES,
     AT(Object, shape.mesh.textures),
     .link = offsetof(Object, shape.mesh.texture_count)},
    OBJECT_TRANSFORM,
    END,
};
static const Field HEIGHT_FIELD_FIELDS[] = {
    {.name = "map",
     .type = FIELD_INDEX,
     .presence = FIELD_REQUIRED,
     AT(Object, shape.height_field.map)},
    DOUBLE(Object, shape.height_field.water_level, "water_level"),
    BOOL(Object, shape.height_field.smooth, "smooth"),
    OBJECT_TRANSFORM,
    END,
};
static const Field TEXT_FIELDS[] = {
    SHAPE_DOUBLE(text.thickness, "thickness"),
    TABLE(Object, shape.text.arcs, shape.text.arc_count, "arcs", 6),
    INDEX_TABLE(Object, shape.text.letters, shape.text.letter_count, "letters", 1),
    OBJECT_TRANSFORM,
    END,
};

#define CONTAINER(member)                                                                          \
    BOOL(Object, member.in_sphere, "in_sphere"), VEC3(Object, member.low, "low"),                  \
        VEC3(Object, member.high, "high"), VEC3(Object, member.center, "center"),                  \
        DOUBLE(Object, member.radius, "radius")
static const Field ISOSURFACE_FIELDS[] = {
    {.name = "function",
     .type = FIELD_INDEX,
     .presence = FIELD_REQUIRED,
     AT(Object, shape.isosurface.function)},
    CONTAINER(shape.isosurface.container),
    DOUBLE(Object, shape.isosurface.threshold, "threshold"),
    DOUBLE(Object, shape.isosurface.accuracy, "accuracy"),
    DOUBLE(Object, shape.isosurface.max_gradient, "max_gradient"),
    INT(Object, shape.isosurface.max_trace, "max_trace"),
    BOOL(Object, shape.isosurface.open, "open"),
    BOOL(Object, shape.isosurface.evaluate, "evaluate"),
    DOUBLE(Object, shape.isosurface.evaluate_from, "evaluate_from"),
    DOUBLE(Object, shape.isosurface.evaluate_over, "evaluate_over"),
    DOUBLE(Object, shape.isosurface.evaluate_fall, "evaluate_fall"),
    OBJECT_TRANSFORM,
    END,
};

#define FUNCTION_OF(axis, field)                                                                   \
    {                                                                                              \
        .name = (field), .type = FIELD_INDEX, .presence = FIELD_REQUIRED,                          \
        AT(Object, shape.parametric.functions[axis])                                               \
    }
static const Field PARAMETRIC_FIELDS[] = {
    FUNCTION_OF(0, "function_x"),
    FUNCTION_OF(1, "function_y"),
    FUNCTION_OF(2, "function_z"),
    DOUBLE(Object, shape.parametric.low[0], "low_u"),
    DOUBLE(Object, shape.parametric.low[1], "low_v"),
    DOUBLE(Object, shape.parametric.high[0], "high_u"),
    DOUBLE(Object, shape.parametric.high[1], "high_v"),
    CONTAINER(shape.parametric.container),
    DOUBLE(Object, shape.parametric.accuracy, "accuracy"),
    DOUBLE(Object, shape.parametric.max_gradient, "max_gradient"),
    BOOL(Object, shape.parametric.precompute[0], "precompute_x"),
    BOOL(Object, shape.parametric.precompute[1], "precompute_y"),
    BOOL(Object, shape.parametric.precompute[2], "precompute_z"),
    INT(Object, shape.parametric.depth, "depth"),
    OBJECT_TRANSFORM,
    END,
};

static const Field INSTANCE_FIELDS[] = {
    {.name = "definition",
     .type = FIELD_INDEX,
     .presence = FIELD_REQUIRED,
     AT(Object, shape.instance.definition)},
    INDEX_TABLE(Object, shape.instance.textures, shape.instance.texture_count, "textures", 2),
    INDEX_TABLE(Object, shape.instance.interiors, shape.instance.interior_count, "interiors", 2),
    OBJECT_TRANSFORM,
    END,
};

// ORDER object_type
static const Record OBJECT_RECORDS[] = {
    {NULL, OBJECT_FIELDS, sizeof(Object), NULL, NULL}, // union
    {NULL, OBJECT_FIELDS, sizeof(Object), NULL, NULL}, // merge
    {NULL, OBJECT_FIELDS, sizeof(Object), NULL, NULL}, // intersection
    {&OBJECT, PATCH_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, PLANE_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, SPHERE_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, BOX_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, CONE_FIELDS, sizeof(Object), NULL, NULL}, // cylinder
    {&OBJECT, CONE_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, TORUS_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, DISC_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, TRIANGLE_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, QUADRIC_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, POLY_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, SUPERELLIPSOID_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, LATHE_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, SOR_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, PRISM_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, SPHERE_SWEEP_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, BLOB_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, OVUS_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, SMOOTH_TRIANGLE_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, POLYGON_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, MESH_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, HEIGHT_FIELD_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, TEXT_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, ISOSURFACE_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, PARAMETRIC_FIELDS, sizeof(Object), NULL, NULL},
    {&OBJECT, INSTANCE_FIELDS, sizeof(Object), NULL, NULL},
};
_Static_assert(sizeof OBJECT_RECORDS / sizeof *OBJECT_RECORDS == OBJECT_TYPE_COUNT,
               "a record for each type");

const Record *object_record(ObjectType type) { return &OBJECT_RECORDS[type]; }

// ---- pools of what objects share ------------------------------------------------------------

static const Field MESH_POOL_FIELDS[] = {
    TABLE(Mesh, points, point_count, "points", 3),
    TABLE(Mesh, normals, normal_count, "normals", 3),
    TABLE(Mesh, uv, uv_count, "uv", 2),
    INDEX_TABLE(Mesh, faces, face_count, "faces", MESH_FACE_COLUMNS),
    INT(Mesh, texture_slots, "texture_slots"),
    {.name = "inside_vector",
     .type = FIELD_DOUBLES,
     .presence = FIELD_FLAGGED,
     AT(Mesh, inside_vector),
     .link = offsetof(Mesh, has_inside),
     .columns = 3},
    END,
};
static void default_mesh(void *out) { *(Mesh *)out = (Mesh){0}; }
const Record MESH_RECORD = {NULL, MESH_POOL_FIELDS, sizeof(Mesh), default_mesh, NULL};

static const Field HEIGHT_MAP_FIELDS[] = {
    INT(HeightMap, width, "width"),
    INT(HeightMap, depth, "depth"),
    TABLE(HeightMap, heights, count, "heights", 1),
    END,
};
static void default_height_map(void *out) { *(HeightMap *)out = (HeightMap){0}; }
const Record HEIGHT_MAP_RECORD = {NULL, HEIGHT_MAP_FIELDS, sizeof(HeightMap), default_height_map,
                                  NULL};
