// SPDX-License-Identifier: MIT
// The tables of scene_fields.h, struct by struct in the order of scene.h. The order of the fields
// is the order in the file.
#include "model/scene_fields.h"

#include <string.h>

_Static_assert(sizeof(Vec3) == 3 * sizeof(double), "vectors are plain rows of doubles");
_Static_assert(sizeof(Vec2) == 2 * sizeof(double), "vectors are plain rows of doubles");
_Static_assert(sizeof(Rgb) == 3 * sizeof(float), "colours are plain rows of floats");
_Static_assert(sizeof(Color) == 5 * sizeof(float), "colours are plain rows of floats");
_Static_assert(sizeof(ObjectType) == sizeof(int) && sizeof(WaveType) == sizeof(int),
               "enumerations are read and written as int");

// One line of a table: the struct, its member, what it is called in the file.
#define AT(Struct, member) .offset = offsetof(Struct, member)
#define BOOL(Struct, member, text)                                                                 \
    { .name = text, .type = FIELD_BOOL, AT(Struct, member) }
#define INT(Struct, member, text)                                                                  \
    { .name = text, .type = FIELD_INT, AT(Struct, member) }
#define FLOAT(Struct, member, text)                                                                \
    { .name = text, .type = FIELD_FLOAT, AT(Struct, member) }
#define INDEX(Struct, member, text)                                                                \
    { .name = text, .type = FIELD_INDEX, AT(Struct, member) }
#define ENUM(Struct, member, text, list)                                                           \
    { .name = text, .type = FIELD_ENUM, AT(Struct, member), .names = list }
#define RGB(Struct, member, text)                                                                  \
    { .name = text, .type = FIELD_FLOATS, AT(Struct, member), .columns = 3 }
#define COLOR(Struct, member, text)                                                                \
    { .name = text, .type = FIELD_COLOR, AT(Struct, member) }
#define DOUBLE_AS(kept, Struct, member, text)                                                      \
    { .name = text, .type = FIELD_DOUBLE, .presence = kept, AT(Struct, member) }
#define DOUBLE(Struct, member, text) DOUBLE_AS(FIELD_PLAIN, Struct, member, text)
#define VEC3_AS(kept, Struct, member, text)                                                        \
    { .name = text, .type = FIELD_DOUBLES, .presence = kept, AT(Struct, member), .columns = 3 }
#define VEC3(Struct, member, text) VEC3_AS(FIELD_PLAIN, Struct, member, text)
#define RECORDS(Struct, member, count, text, table)                                                \
    {                                                                                              \
        .name = text, .type = FIELD_RECORDS, AT(Struct, member), .link = offsetof(Struct, count),  \
        .record = table                                                                            \
    }
#define END                                                                                        \
    { .name = NULL }

// ---- settings, camera, lights ---------------------------------------------------------------

// ORDER gamma_mode
static const char *const GAMMA_MODE_NAMES[] = {"none", "power", "srgb", NULL};

static const Field SETTINGS_FIELDS[] = {
    INT(Settings, version, "version"),
    ENUM(Settings, gamma_mode, "gamma_mode", GAMMA_MODE_NAMES),
    FLOAT(Settings, assumed_gamma, "assumed_gamma"),
    COLOR(Settings, background, "background"),
    RGB(Settings, ambient_light, "ambient_light"),
    INT(Settings, max_trace_level, "max_trace_level"),
    FLOAT(Settings, adc_bailout, "adc_bailout"),
    INT(Settings, noise_generator, "noise_generator"),
    INT(Settings, number_of_waves, "number_of_waves"),
    RGB(Settings, irid_wavelength, "irid_wavelength"),
    END,
};
static void default_settings(void *out) { *(Settings *)out = settings_default(); }
static const Record SETTINGS = {NULL, SETTINGS_FIELDS, sizeof(Settings), default_settings, NULL};

// ORDER camera_type
static const char *const CAMERA_TYPE_NAMES[] = {"perspective", "orthographic", NULL};

static const Field CAMERA_FIELDS[] = {
    ENUM(Camera, type, "type", CAMERA_TYPE_NAMES),
    VEC3_AS(FIELD_ALWAYS, Camera, location, "location"),
    VEC3_AS(FIELD_ALWAYS, Camera, direction, "direction"),
    VEC3_AS(FIELD_ALWAYS, Camera, up, "up"),
    VEC3_AS(FIELD_ALWAYS, Camera, right, "right"),
    DOUBLE_AS(FIELD_PLAIN, Camera, angle_deg, "angle"),
    END,
};
static void default_camera(void *out) { *(Camera *)out = camera_default(); }
static const Record CAMERA = {NULL, CAMERA_FIELDS, sizeof(Camera), default_camera, NULL};

// ORDER light_type
static const char *const LIGHT_TYPE_NAMES[] = {"point", "parallel", "spot", "cylinder", NULL};

static const Field AREA_LIGHT_FIELDS[] = {
    VEC3_AS(FIELD_REQUIRED, AreaLight, axis[0], "axis1"),
    VEC3_AS(FIELD_REQUIRED, AreaLight, axis[1], "axis2"),
    INT(AreaLight, size[0], "size1"),
    INT(AreaLight, size[1], "size2"),
    INT(AreaLight, adaptive, "adaptive"),
    BOOL(AreaLight, circular, "circular"),
    BOOL(AreaLight, orient, "orient"),
    BOOL(AreaLight, jitter, "jitter"),
    BOOL(AreaLight, illumination, "area_illumination"),
    END,
};
static void default_area_light(void *out) { *(AreaLight *)out = area_light_default(); }
static const Record AREA_LIGHT = {NULL, AREA_LIGHT_FIELDS, sizeof(AreaLight), default_area_light,
                                  NULL};

#define LIGHT_DOUBLE(member)                                                                       \
    {                                                                                              \
        .name = #member, .type = FIELD_DOUBLE, AT(Light, member),                                  \
        .kinds = 1u << LIGHT_SPOT | 1u << LIGHT_CYLINDER                                           \
    }

static const Field LIGHT_FIELDS[] = {
    {.name = "type",
     .type = FIELD_ENUM,
     .presence = FIELD_ALWAYS,
     AT(Light, type),
     .names = LIGHT_TYPE_NAMES},
    VEC3_AS(FIELD_REQUIRED, Light, location, "location"),
    VEC3(Light, point_at, "point_at"),
    {.name = "color",
     .type = FIELD_FLOATS,
     .presence = FIELD_REQUIRED,
     AT(Light, color),
     .columns = 3},
    BOOL(Light, shadowless, "shadowless"),
    LIGHT_DOUBLE(radius),
    LIGHT_DOUBLE(falloff),
    LIGHT_DOUBLE(tightness),
    {.name = "parallel", .type = FIELD_BOOL, AT(Light, parallel), .kinds = 1u << LIGHT_SPOT},
    DOUBLE(Light, fade_distance, "fade_distance"),
    DOUBLE(Light, fade_power, "fade_power"),
    {.name = "area",
     .type = FIELD_RECORD,
     .presence = FIELD_FLAGGED,
     AT(Light, area),
     .link = offsetof(Light, has_area),
     .record = &AREA_LIGHT},
    END,
};
static void default_light(void *out) { *(Light *)out = light_default(LIGHT_POINT); }
static void default_light_kind(void *out) { *(Light *)out = light_default(((Light *)out)->type); }
static const Record LIGHT = {NULL, LIGHT_FIELDS, sizeof(Light), default_light, default_light_kind};

// ---- textures -------------------------------------------------------------------------------

// ORDER pattern_type
static const char *const PATTERN_TYPE_NAMES[] = {
    "plain",   "checker",    "gradient",    "agate",  "boxed",    "bozo",      "brick",   "cells",
    "crackle", "cubic",      "cylindrical", "dents",  "granite",  "hexagon",   "leopard", "marble",
    "onion",   "planar",     "quilted",     "radial", "ripples",  "spherical", "spiral1", "spiral2",
    "square",  "triangular", "waves",       "wood",   "wrinkles", "average",   NULL,
};
_Static_assert(sizeof PATTERN_TYPE_NAMES / sizeof *PATTERN_TYPE_NAMES == PATTERN_MODELLED + 1,
               "a name for each pattern");
// ORDER wave_type
static const char *const WAVE_TYPE_NAMES[] = {"ramp",  "triangle", "sine", "scallop",
                                              "cubic", "poly",     NULL};
// ORDER warp_type
static const char *const WARP_TYPE_NAMES[] = {
    "transform", "turbulence", "repeat",      "black_hole", "cubic",
    "planar",    "spherical",  "cylindrical", "toroidal",   NULL,
};

#define TURBULENCE(Struct, at, limit)                                                              \
    {.name = "amount",                                                                             \
     .type = FIELD_DOUBLES,                                                                        \
     .presence = FIELD_REQUIRED,                                                                   \
     AT(Struct, at amount),                                                                        \
     .columns = 3,                                                                                 \
     .kinds = limit},                                                                              \
        {.name = "octaves", .type = FIELD_INT, AT(Struct, at octaves), .kinds = limit},            \
        {.name = "lambda", .type = FIELD_FLOAT, AT(Struct, at lambda), .kinds = limit}, {          \
        .name = "omega", .type = FIELD_FLOAT, AT(Struct, at omega), .kinds = limit                 \
    }

static const Field TURBULENCE_FIELDS[] = {
    TURBULENCE(Turbulence, , 0),
    END,
};
static void default_turbulence(void *out) { *(Turbulence *)out = turbulence_default(); }
static const Record TURBULENCE = {NULL, TURBULENCE_FIELDS, sizeof(Turbulence), default_turbulence,
                                  NULL};

static const Field CRACKLE_FIELDS[] = {
    VEC3(CrackleShape, form, "form"),
    DOUBLE(CrackleShape, metric, "metric"),
    DOUBLE(CrackleShape, offset, "offset"),
    BOOL(CrackleShape, solid, "solid"),
    END,
};
static void default_crackle(void *out) { *(CrackleShape *)out = pattern_default().crackle; }
static const Record CRACKLE = {NULL, CRACKLE_FIELDS, sizeof(CrackleShape), default_crackle, NULL};

// Fields of a warp: `kinds` says which ones have it.
#define OF(type) (1u << WARP_##type)
#define WARP_VEC3(limit, member, text)                                                             \
    { .name = text, .type = FIELD_DOUBLES, AT(Warp, member), .columns = 3, .kinds = limit }
#define WARP_DOUBLE(limit, member, text)                                                           \
    { .name = text, .type = FIELD_DOUBLE, AT(Warp, member), .kinds = limit }

static const Field WARP_FIELDS[] = {
    {.name = "type",
     .type = FIELD_ENUM,
     .presence = FIELD_ALWAYS,
     AT(Warp, type),
     .names = WARP_TYPE_NAMES},
    {.name = "transform", .type = FIELD_TRANSFORM, AT(Warp, transform), .kinds = OF(TRANSFORM)},
    TURBULENCE(Warp, turbulence., OF(TURBULENCE)),
    {.name = "axis",
     .type = FIELD_INT,
     .presence = FIELD_REQUIRED,
     AT(Warp, repeat.axis),
     .kinds = OF(REPEAT)},
    {.name = "width",
     .type = FIELD_FLOAT,
     .presence = FIELD_REQUIRED,
     AT(Warp, repeat.width),
     .kinds = OF(REPEAT)},
    WARP_VEC3(OF(REPEAT), repeat.offset, "offset"),
    WARP_VEC3(OF(REPEAT), repeat.flip, "flip"),
    {.name = "center",
     .type = FIELD_DOUBLES,
     .presence = FIELD_REQUIRED,
     AT(Warp, black_hole.center),
     .columns = 3,
     .kinds = OF(BLACK_HOLE)},
    {.name = "radius",
     .type = FIELD_DOUBLE,
     .presence = FIELD_REQUIRED,
     AT(Warp, black_hole.radius),
     .kinds = OF(BLACK_HOLE)},
    WARP_DOUBLE(OF(BLACK_HOLE), black_hole.strength, "strength"),
    WARP_DOUBLE(OF(BLACK_HOLE), black_hole.falloff, "falloff"),
    {.name = "inverse", .type = FIELD_BOOL, AT(Warp, black_hole.inverse), .kinds = OF(BLACK_HOLE)},
    {.name = "repeat_size",
     .type = FIELD_DOUBLES,
     .presence = FIELD_FLAGGED,
     AT(Warp, black_hole.repeat_size),
     .link = offsetof(Warp, black_hole.repeat),
     .columns = 3,
     .kinds = OF(BLACK_HOLE)},
    WARP_VEC3(OF(BLACK_HOLE), black_hole.uncertainty, "uncertainty"),
    WARP_VEC3(OF(PLANAR) | OF(SPHERICAL) | OF(CYLINDRICAL) | OF(TOROIDAL), mapping.orientation,
              "orientation"),
    WARP_DOUBLE(OF(PLANAR), mapping.distance, "distance"),
    WARP_DOUBLE(OF(SPHERICAL) | OF(CYLINDRICAL) | OF(TOROIDAL), mapping.dist_exp, "dist_exp"),
    WARP_DOUBLE(OF(TOROIDAL), mapping.major_radius, "major_radius"),
    END,
};
static void default_warp(void *out) { *(Warp *)out = warp_default(WARP_TRANSFORM); }
static void default_warp_kind(void *out) { *(Warp *)out = warp_default(((Warp *)out)->type); }
static const Record WARP = {NULL, WARP_FIELDS, sizeof(Warp), default_warp, default_warp_kind};

static const Field MAP_ENTRY_FIELDS[] = {
    {.name = "value", .type = FIELD_FLOAT, .presence = FIELD_REQUIRED, AT(MapEntry, value)},
    COLOR(MapEntry, color, "color"),
    INDEX(MapEntry, pigment, "pigment"),
    END,
};
static void default_map_entry(void *out) { *(MapEntry *)out = (MapEntry){.pigment = NO_INDEX}; }
static const Record MAP_ENTRY = {NULL, MAP_ENTRY_FIELDS, sizeof(MapEntry), default_map_entry, NULL};

static const Field PIGMENT_FIELDS[] = {
    {.name = "type",
     .type = FIELD_ENUM,
     .presence = FIELD_ALWAYS,
     AT(Pigment, pattern.type),
     .names = PATTERN_TYPE_NAMES},
    VEC3(Pigment, pattern.gradient, "gradient"),
    FLOAT(Pigment, pattern.agate_turb, "agate_turb"),
    VEC3(Pigment, pattern.brick_size, "brick_size"),
    FLOAT(Pigment, pattern.mortar, "mortar"),
    {.name = "crackle", .type = FIELD_RECORD, AT(Pigment, pattern.crackle), .record = &CRACKLE},
    {.name = "quilted", .type = FIELD_FLOATS, AT(Pigment, pattern.quilted), .columns = 2},
    INT(Pigment, pattern.arms, "arms"),
    ENUM(Pigment, pattern.wave, "wave", WAVE_TYPE_NAMES),
    FLOAT(Pigment, pattern.frequency, "frequency"),
    FLOAT(Pigment, pattern.phase, "phase"),
    FLOAT(Pigment, pattern.exponent, "exponent"),
    INT(Pigment, pattern.noise_generator, "noise_generator"),
    COLOR(Pigment, color, "color"),
    RECORDS(Pigment, entries, entry_count, "map", &MAP_ENTRY),
    RECORDS(Pigment, pattern.warps, pattern.warp_count, "warps", &WARP),
    {.name = "turbulence",
     .type = FIELD_RECORD,
     .presence = FIELD_FLAGGED,
     AT(Pigment, pattern.turbulence),
     .link = offsetof(Pigment, pattern.has_turbulence),
     .record = &TURBULENCE},
    BOOL(Pigment, uv_mapping, "uv_mapping"),
    {.name = "quick_color",
     .type = FIELD_COLOR,
     .presence = FIELD_FLAGGED,
     AT(Pigment, quick_color),
     .link = offsetof(Pigment, has_quick_color)},
    END,
};
static void default_pigment(void *out) {
    *(Pigment *)out = (Pigment){.pattern = pattern_default()};
}
static const Record PIGMENT = {NULL, PIGMENT_FIELDS, sizeof(Pigment), default_pigment, NULL};

static const Field FINISH_FIELDS[] = {
    RGB(Finish, ambient, "ambient"),
    RGB(Finish, emission, "emission"),
    FLOAT(Finish, diffuse, "diffuse"),
    FLOAT(Finish, diffuse_back, "diffuse_back"),
    FLOAT(Finish, brilliance, "brilliance"),
    FLOAT(Finish, crand, "crand"),
    FLOAT(Finish, phong, "phong"),
    FLOAT(Finish, phong_size, "phong_size"),
    FLOAT(Finish, specular, "specular"),
    FLOAT(Finish, roughness, "roughness"),
    FLOAT(Finish, metallic, "metallic"),
    RGB(Finish, reflection_min, "reflection_min"),
    RGB(Finish, reflection_max, "reflection_max"),
    FLOAT(Finish, reflection_falloff, "reflection_falloff"),
    FLOAT(Finish, reflection_exponent, "reflection_exponent"),
    FLOAT(Finish, reflection_metallic, "reflection_metallic"),
    BOOL(Finish, reflection_fresnel, "reflection_fresnel"),
    BOOL(Finish, conserve_energy, "conserve_energy"),
    FLOAT(Finish, irid, "irid"),
    FLOAT(Finish, irid_thickness, "irid_thickness"),
    FLOAT(Finish, irid_turbulence, "irid_turbulence"),
    END,
};
static void default_finish(void *out) { *(Finish *)out = finish_default(); }
static const Record FINISH = {NULL, FINISH_FIELDS, sizeof(Finish), default_finish, NULL};

static const Field LAYER_FIELDS[] = {
    {.name = "pigment", .type = FIELD_INDEX, .presence = FIELD_REQUIRED, AT(Layer, pigment)},
    {.name = "finish", .type = FIELD_RECORD, AT(Layer, finish), .record = &FINISH},
    END,
};
static void default_layer(void *out) {
    *(Layer *)out = (Layer){.pigment = NO_INDEX, .finish = finish_default()};
}
static const Record LAYER = {NULL, LAYER_FIELDS, sizeof(Layer), default_layer, NULL};

static const Field TEXTURE_FIELDS[] = {
    RECORDS(Texture, layers, layer_count, "layers", &LAYER),
    BOOL(Texture, uv_mapping, "uv_mapping"),
    END,
};
static void default_texture(void *out) { memset(out, 0, sizeof(Texture)); }
static const Record TEXTURE = {NULL, TEXTURE_FIELDS, sizeof(Texture), default_texture, NULL};

static const Field INTERIOR_FIELDS[] = {
    FLOAT(Interior, ior, "ior"),
    FLOAT(Interior, caustics, "caustics"),
    FLOAT(Interior, fade_distance, "fade_distance"),
    FLOAT(Interior, fade_power, "fade_power"),
    RGB(Interior, fade_color, "fade_color"),
    END,
};
static void default_interior(void *out) { *(Interior *)out = interior_default(); }
static const Record INTERIOR = {NULL, INTERIOR_FIELDS, sizeof(Interior), default_interior, NULL};

static const Field SKY_SPHERE_FIELDS[] = {
    {.name = "pigments",
     .type = FIELD_INDICES,
     AT(SkySphere, pigments),
     .link = offsetof(SkySphere, pigment_count)},
    RGB(SkySphere, emission, "emission"),
    {.name = "transform", .type = FIELD_TRANSFORM, AT(SkySphere, transform)},
    END,
};
static void default_sky_sphere(void *out) {
    *(SkySphere *)out = (SkySphere){.emission = {1, 1, 1}, .transform = transform_identity()};
}
static const Record SKY_SPHERE = {NULL, SKY_SPHERE_FIELDS, sizeof(SkySphere), default_sky_sphere,
                                  NULL};

// ---- objects --------------------------------------------------------------------------------

// ORDER object_type
const char *const OBJECT_TYPE_NAMES[] = {
    "union",    "merge", "intersection", "bicubic_patch", "plane",    "sphere", "box",
    "cylinder", "cone",  "torus",        "disc",          "triangle", NULL,
};
const char BEZIER_PATCH_NAME[] = "bezier_patch";

static const Field OBJECT_FIELDS[] = {
    INDEX(Object, texture, "texture"),
    INDEX(Object, interior_texture, "interior_texture"),
    INDEX(Object, interior, "interior"),
    BOOL(Object, no_shadow, "no_shadow"),
    BOOL(Object, no_image, "no_image"),
    BOOL(Object, no_reflection, "no_reflection"),
    BOOL(Object, hollow, "hollow"),
    BOOL(Object, inverse, "inverse"),
    BOOL(Object, double_illuminate, "double_illuminate"),
    BOOL(Object, uv_mapping, "uv_mapping"),
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
};

const Record *object_record(ObjectType type) { return &OBJECT_RECORDS[type]; }

// ---- the document ---------------------------------------------------------------------------

static const Field SCENE_FIELDS[] = {
    {.name = "settings", .type = FIELD_RECORD, AT(Scene, settings), .record = &SETTINGS},
    {.name = "camera",
     .type = FIELD_RECORD,
     .presence = FIELD_ALWAYS,
     AT(Scene, camera),
     .record = &CAMERA},
    {.name = "sky_sphere",
     .type = FIELD_RECORD,
     .presence = FIELD_FLAGGED,
     AT(Scene, sky_sphere),
     .link = offsetof(Scene, has_sky_sphere),
     .record = &SKY_SPHERE},
    RECORDS(Scene, lights, light_count, "lights", &LIGHT),
    RECORDS(Scene, pigments, pigment_count, "pigments", &PIGMENT),
    RECORDS(Scene, textures, texture_count, "textures", &TEXTURE),
    RECORDS(Scene, interiors, interior_count, "interiors", &INTERIOR),
    END,
};
static void default_scene(void *out) {
    Scene *scene = out;
    *scene = (Scene){.settings = settings_default(), .camera = camera_default()};
    default_sky_sphere(&scene->sky_sphere);
}
const Record SCENE_RECORD = {NULL, SCENE_FIELDS, sizeof(Scene), default_scene, NULL};

// ---- comparing ------------------------------------------------------------------------------

static bool record_equal(const Record *record, const void *a, const void *b);

// Both are lists, `a` and `b` the structs that hold them.
static bool list_equal(const Field *field, const void *a, const void *b) {
    uint32_t count = *(const uint32_t *)field_of(a, field->link);
    const char *items_a = *(const void *const *)field_of(a, field->offset);
    const char *items_b = *(const void *const *)field_of(b, field->offset);
    if (count != *(const uint32_t *)field_of(b, field->link))
        return false;
    if (field->type == FIELD_INDICES)
        return count == 0 || memcmp(items_a, items_b, count * sizeof(uint32_t)) == 0;
    for (size_t i = 0; i < count; i++)
        if (!record_equal(field->record, items_a + i * field->record->size,
                          items_b + i * field->record->size))
            return false;
    return true;
}

static bool member_equal(const Field *field, const void *a, const void *b) {
    if (field->type == FIELD_RECORDS || field->type == FIELD_INDICES)
        return list_equal(field, a, b);
    if (field->presence == FIELD_FLAGGED) {
        bool present = *(const bool *)field_of(a, field->link);
        if (present != *(const bool *)field_of(b, field->link))
            return false;
        if (!present)
            return true;
    }
    return field_equal(field, field_of(a, field->offset), field_of(b, field->offset));
}

// The kind is the first field, so that both have the same fields after it.
static bool record_equal(const Record *record, const void *a, const void *b) {
    for (const Field *field = record->fields; field->name; field++)
        if (field_belongs(record, field, a) && !member_equal(field, a, b))
            return false;
    return true;
}

bool pigment_equal(const Pigment *a, const Pigment *b) { return record_equal(&PIGMENT, a, b); }

bool field_belongs(const Record *table, const Field *field, const void *record) {
    return field->kinds == 0 ||
           (field->kinds >> *(const int *)field_of(record, table->fields[0].offset) & 1);
}

bool field_equal(const Field *field, const void *a, const void *b) {
    size_t size = 0;
    switch (field->type) {
    case FIELD_BOOL:
        size = sizeof(bool);
        break;
    case FIELD_INT:
    case FIELD_ENUM:
        size = sizeof(int);
        break;
    case FIELD_INDEX:
        size = sizeof(uint32_t);
        break;
    case FIELD_FLOAT:
        size = sizeof(float);
        break;
    case FIELD_DOUBLE:
        size = sizeof(double);
        break;
    case FIELD_FLOATS:
        size = (size_t)field->columns * sizeof(float);
        break;
    case FIELD_COLOR:
        size = sizeof(Color);
        break;
    case FIELD_DOUBLES:
        size = (size_t)field->columns * sizeof(double);
        break;
    case FIELD_ROWS:
        size = (size_t)field->rows * (size_t)field->columns * sizeof(double);
        break;
    case FIELD_TRANSFORM:
        size = sizeof(Transform);
        break;
    case FIELD_RECORD:
        return record_equal(field->record, a, b);
    case FIELD_RECORDS:
    case FIELD_INDICES:
        return false; // lists need the counts beside them: list_equal
    }
    return memcmp(a, b, size) == 0;
}
