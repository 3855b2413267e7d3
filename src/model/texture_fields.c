// SPDX-License-Identifier: MIT
// The tables of scene_fields.h for pigments, textures and what is in them.
#include "model/texture_fields.h"

#include "model/field_macros.h"

#include <string.h>

// ORDER pattern_type
static const char *const PATTERN_TYPE_NAMES[] = {
    "plain",        "checker",    "gradient",        "agate",     "boxed",        "bozo",
    "brick",        "cells",      "crackle",         "cubic",     "cylindrical",  "dents",
    "granite",      "hexagon",    "leopard",         "marble",    "onion",        "planar",
    "quilted",      "radial",     "ripples",         "spherical", "spiral1",      "spiral2",
    "square",       "triangular", "waves",           "wood",      "wrinkles",     "average",
    "bumps",        "facets",     "image_pattern",   "image_map", "bump_map",     "slope",
    "aoi",          "function",   "pigment_pattern", "object",    "density_file", "fractal",
    "material_map", NULL,
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
const Record TURBULENCE_RECORD = {NULL, TURBULENCE_FIELDS, sizeof(Turbulence), default_turbulence,
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

// ---- pictures -------------------------------------------------------------------------------

// ORDER picture_type
static const char *const PICTURE_TYPE_NAMES[] = {
    "png",  "gif",  "tga", "iff", "pot", "pgm",    "ppm", "sys",
    "jpeg", "tiff", "bmp", "exr", "hdr", "values", NULL,
};
// ORDER picture_decode
static const char *const PICTURE_DECODE_NAMES[] = {"none", "file", "old", "power", "srgb", NULL};
// ORDER picture_layout
static const char *const PICTURE_LAYOUT_NAMES[] = {"planar", "spherical", "cylindrical", "torus",
                                                   NULL};
// ORDER picture_between
static const char *const PICTURE_BETWEEN_NAMES[] = {"none", "bilinear", "bicubic",
                                                    "normalized_distance", NULL};
// ORDER picture_use
static const char *const PICTURE_USE_NAMES[] = {"color", "index", "alpha", NULL};

static const Field PALETTE_CHANGE_FIELDS[] = {
    {.name = "place", .type = FIELD_INT, .presence = FIELD_REQUIRED, AT(PaletteChange, place)},
    BOOL(PaletteChange, transmit, "transmit"),
    {.name = "value", .type = FIELD_FLOAT, .presence = FIELD_REQUIRED, AT(PaletteChange, value)},
    END,
};
static void default_change(void *out) { *(PaletteChange *)out = (PaletteChange){0}; }
static const Record PALETTE_CHANGE = {NULL, PALETTE_CHANGE_FIELDS, sizeof(PaletteChange),
                                      default_change, NULL};

static const Field PICTURE_FIELDS[] = {
    {.name = "path", .type = FIELD_PATH, AT(Picture, path)},
    INT(Picture, width, "width"),
    INT(Picture, height, "height"),
    INT(Picture, channels, "channels"),
    TABLE(Picture, values, value_count, "values", 1),
    {.name = "type",
     .type = FIELD_ENUM,
     .presence = FIELD_ALWAYS,
     AT(Picture, type),
     .names = PICTURE_TYPE_NAMES},
    ENUM(Picture, decode, "decode", PICTURE_DECODE_NAMES),
    FLOAT(Picture, gamma, "gamma"),
    BOOL(Picture, to_working, "to_working"),
    ENUM(Picture, layout, "layout", PICTURE_LAYOUT_NAMES),
    ENUM(Picture, between, "interpolate", PICTURE_BETWEEN_NAMES),
    ENUM(Picture, use, "use", PICTURE_USE_NAMES),
    BOOL(Picture, once, "once"),
    {.name = "repeat", .type = FIELD_DOUBLES, AT(Picture, repeat), .columns = 2},
    {.name = "offset", .type = FIELD_DOUBLES, AT(Picture, offset), .columns = 2},
    {.name = "filter",
     .type = FIELD_FLOAT,
     .presence = FIELD_FLAGGED,
     AT(Picture, filter),
     .link = offsetof(Picture, has_filter)},
    {.name = "transmit",
     .type = FIELD_FLOAT,
     .presence = FIELD_FLAGGED,
     AT(Picture, transmit),
     .link = offsetof(Picture, has_transmit)},
    RECORDS(Picture, changes, change_count, "palette", &PALETTE_CHANGE),
    END,
};
static void default_picture(void *out) { *(Picture *)out = picture_default(); }
static const Field DENSITY_FIELDS[] = {
    {.name = "path", .type = FIELD_PATH, .presence = FIELD_REQUIRED, AT(DensityFile, path)},
    END,
};
static void default_density(void *out) { *(DensityFile *)out = (DensityFile){0}; }
const Record DENSITY_RECORD = {NULL, DENSITY_FIELDS, sizeof(DensityFile), default_density, NULL};

const Record PICTURE_RECORD = {NULL, PICTURE_FIELDS, sizeof(Picture), default_picture, NULL};

static const Field FACETS_FIELDS[] = {
    DOUBLE(FacetsShape, size, "size"),
    DOUBLE(FacetsShape, coords, "coords"),
    DOUBLE(FacetsShape, metric, "metric"),
    END,
};
static void default_facets(void *out) { *(FacetsShape *)out = pattern_default().facets; }
static const Record FACETS = {NULL, FACETS_FIELDS, sizeof(FacetsShape), default_facets, NULL};

static const Field SLOPE_FIELDS[] = {
    VEC3(SlopeShape, slope, "slope"),
    BOOL(SlopeShape, point_at, "point_at"),
    DOUBLE(SlopeShape, low, "low"),
    DOUBLE(SlopeShape, high, "high"),
    VEC3(SlopeShape, altitude, "altitude"),
    DOUBLE(SlopeShape, altitude_low, "altitude_low"),
    DOUBLE(SlopeShape, altitude_high, "altitude_high"),
    DOUBLE(SlopeShape, share, "share"),
    END,
};
static void default_slope(void *out) { *(SlopeShape *)out = pattern_default().slope; }
static const Record SLOPE = {NULL, SLOPE_FIELDS, sizeof(SlopeShape), default_slope, NULL};

static const Field FRACTAL_FIELDS[] = {
    INT(FractalShape, exponent, "exponent"),
    INT(FractalShape, magnet, "magnet"),
    INT(FractalShape, iterations, "iterations"),
    BOOL(FractalShape, julia, "julia"),
    {.name = "c", .type = FIELD_DOUBLES, AT(FractalShape, c), .columns = 2},
    INT(FractalShape, exterior, "exterior"),
    DOUBLE(FractalShape, exterior_factor, "exterior_factor"),
    INT(FractalShape, interior, "interior"),
    DOUBLE(FractalShape, interior_factor, "interior_factor"),
    END,
};
static void default_fractal(void *out) { *(FractalShape *)out = pattern_default().fractal; }
static const Record FRACTAL = {NULL, FRACTAL_FIELDS, sizeof(FractalShape), default_fractal, NULL};

// The pattern inside a pigment, a normal or a texture, in two parts: its kind and shape, and what
// moves the point.
#define PATTERN_SHAPE(Struct, kept)                                                                \
    {.name = "type",                                                                               \
     .type = FIELD_ENUM,                                                                           \
     .presence = kept,                                                                             \
     AT(Struct, pattern.type),                                                                     \
     .names = PATTERN_TYPE_NAMES},                                                                 \
        VEC3(Struct, pattern.gradient, "gradient"),                                                \
        FLOAT(Struct, pattern.agate_turb, "agate_turb"),                                           \
        VEC3(Struct, pattern.brick_size, "brick_size"), FLOAT(Struct, pattern.mortar, "mortar"),   \
        {.name = "crackle",                                                                        \
         .type = FIELD_RECORD,                                                                     \
         AT(Struct, pattern.crackle),                                                              \
         .record = &CRACKLE},                                                                      \
        {.name = "facets", .type = FIELD_RECORD, AT(Struct, pattern.facets), .record = &FACETS},   \
        {.name = "quilted", .type = FIELD_FLOATS, AT(Struct, pattern.quilted), .columns = 2},      \
        INT(Struct, pattern.arms, "arms"), ENUM(Struct, pattern.wave, "wave", WAVE_TYPE_NAMES),    \
        FLOAT(Struct, pattern.frequency, "frequency"), FLOAT(Struct, pattern.phase, "phase"),      \
        FLOAT(Struct, pattern.exponent, "exponent"),                                               \
        INT(Struct, pattern.noise_generator, "noise_generator"),                                   \
        INDEX(Struct, pattern.picture, "picture"),                                                 \
        {.name = "slope", .type = FIELD_RECORD, AT(Struct, pattern.slope), .record = &SLOPE},      \
        {.name = "fractal",                                                                        \
         .type = FIELD_RECORD,                                                                     \
         AT(Struct, pattern.fractal),                                                              \
         .record = &FRACTAL},                                                                      \
        INDEX(Struct, pattern.function, "function"), INDEX(Struct, pattern.pigment, "pigment"),    \
        INDEX(Struct, pattern.object, "object"), INDEX(Struct, pattern.density, "density"),        \
        INT(Struct, pattern.density_between, "density_interpolate")
#define PATTERN_WARPS(Struct)                                                                      \
    RECORDS(Struct, pattern.warps, pattern.warp_count, "warps", &WARP), {                          \
        .name = "turbulence", .type = FIELD_RECORD, .presence = FIELD_FLAGGED,                     \
        AT(Struct, pattern.turbulence), .link = offsetof(Struct, pattern.has_turbulence),          \
        .record = &TURBULENCE_RECORD                                                               \
    }

static const Field PIGMENT_FIELDS[] = {
    PATTERN_SHAPE(Pigment, FIELD_ALWAYS),
    COLOR(Pigment, color, "color"),
    RECORDS(Pigment, entries, entry_count, "map", &MAP_ENTRY),
    PATTERN_WARPS(Pigment),
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
const Record PIGMENT_RECORD = {NULL, PIGMENT_FIELDS, sizeof(Pigment), default_pigment, NULL};

// ---- normals --------------------------------------------------------------------------------

static const Field SLOPE_ENTRY_FIELDS[] = {
    {.name = "value", .type = FIELD_FLOAT, .presence = FIELD_REQUIRED, AT(SlopeEntry, value)},
    DOUBLE_AS(FIELD_ALWAYS, SlopeEntry, height, "height"),
    DOUBLE(SlopeEntry, slope, "slope"),
    END,
};
static void default_slope_entry(void *out) { memset(out, 0, sizeof(SlopeEntry)); }
static const Record SLOPE_ENTRY = {NULL, SLOPE_ENTRY_FIELDS, sizeof(SlopeEntry),
                                   default_slope_entry, NULL};

static const Field NORMAL_ENTRY_FIELDS[] = {
    {.name = "value", .type = FIELD_FLOAT, .presence = FIELD_REQUIRED, AT(IndexEntry, value)},
    {.name = "normal", .type = FIELD_INDEX, .presence = FIELD_REQUIRED, AT(IndexEntry, index)},
    END,
};
static void default_index_entry(void *out) { *(IndexEntry *)out = (IndexEntry){0, NO_INDEX}; }
static const Record NORMAL_ENTRY = {NULL, NORMAL_ENTRY_FIELDS, sizeof(IndexEntry),
                                    default_index_entry, NULL};

static const Field NORMAL_FIELDS[] = {
    PATTERN_SHAPE(Normal, FIELD_ALWAYS),
    FLOAT(Normal, amount, "amount"),
    FLOAT(Normal, accuracy, "accuracy"),
    RECORDS(Normal, slopes, slope_count, "slope_map", &SLOPE_ENTRY),
    RECORDS(Normal, entries, entry_count, "map", &NORMAL_ENTRY),
    PATTERN_WARPS(Normal),
    BOOL(Normal, uv_mapping, "uv_mapping"),
    BOOL(Normal, no_bump_scale, "no_bump_scale"),
    END,
};
static void default_normal(void *out) { *(Normal *)out = normal_default(); }
const Record NORMAL_RECORD = {NULL, NORMAL_FIELDS, sizeof(Normal), default_normal, NULL};

// ---- textures -------------------------------------------------------------------------------

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
    INDEX(Layer, normal, "normal"),
    {.name = "finish", .type = FIELD_RECORD, AT(Layer, finish), .record = &FINISH},
    END,
};
static void default_layer(void *out) {
    *(Layer *)out = (Layer){.pigment = NO_INDEX, .finish = finish_default(), .normal = NO_INDEX};
}
static const Record LAYER = {NULL, LAYER_FIELDS, sizeof(Layer), default_layer, NULL};

static const Field TEXTURE_ENTRY_FIELDS[] = {
    {.name = "value", .type = FIELD_FLOAT, .presence = FIELD_REQUIRED, AT(IndexEntry, value)},
    {.name = "texture", .type = FIELD_INDEX, .presence = FIELD_REQUIRED, AT(IndexEntry, index)},
    END,
};
static const Record TEXTURE_ENTRY = {NULL, TEXTURE_ENTRY_FIELDS, sizeof(IndexEntry),
                                     default_index_entry, NULL};

static const Field TEXTURE_FIELDS[] = {
    PATTERN_SHAPE(Texture, FIELD_PLAIN),
    RECORDS(Texture, layers, layer_count, "layers", &LAYER),
    RECORDS(Texture, entries, entry_count, "map", &TEXTURE_ENTRY),
    PATTERN_WARPS(Texture),
    BOOL(Texture, uv_mapping, "uv_mapping"),
    BOOL(Texture, no_bump_scale, "no_bump_scale"),
    END,
};
static void default_texture(void *out) {
    *(Texture *)out = (Texture){.pattern = pattern_default()};
}
const Record TEXTURE_RECORD = {NULL, TEXTURE_FIELDS, sizeof(Texture), default_texture, NULL};
