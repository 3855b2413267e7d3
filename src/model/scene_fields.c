// SPDX-License-Identifier: MIT
// The tables of scene_fields.h, struct by struct in the order of scene.h. The order of the fields
// is the order in the file.
#include "model/field_macros.h"
#include "model/texture_fields.h"

#include <assert.h>
#include <string.h>

_Static_assert(sizeof(Vec3) == 3 * sizeof(double), "vectors are plain rows of doubles");
_Static_assert(sizeof(Vec2) == 2 * sizeof(double), "vectors are plain rows of doubles");
_Static_assert(sizeof(Rgb) == 3 * sizeof(float), "colours are plain rows of floats");
_Static_assert(sizeof(Color) == 5 * sizeof(float), "colours are plain rows of floats");
_Static_assert(sizeof(ObjectType) == sizeof(int) && sizeof(WaveType) == sizeof(int),
               "enumerations are read and written as int");

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
static const char *const CAMERA_TYPE_NAMES[] = {
    "perspective", "orthographic", "fisheye",    "ultra_wide_angle", "omnimax",   "panoramic",
    "cylinder_1",  "cylinder_2",   "cylinder_3", "cylinder_4",       "spherical", NULL,
};

static const Field FOCAL_BLUR_FIELDS[] = {
    DOUBLE_AS(FIELD_REQUIRED, FocalBlur, aperture, "aperture"),
    DOUBLE_AS(FIELD_ALWAYS, FocalBlur, focal_distance, "focal_distance"),
    {.name = "samples", .type = FIELD_INT, .presence = FIELD_REQUIRED, AT(FocalBlur, samples)},
    INT(FocalBlur, min_samples, "min_samples"),
    DOUBLE(FocalBlur, confidence, "confidence"),
    DOUBLE(FocalBlur, variance, "variance"),
    END,
};
static void default_focal_blur(void *out) { *(FocalBlur *)out = focal_blur_default(); }
static const Record FOCAL_BLUR = {NULL, FOCAL_BLUR_FIELDS, sizeof(FocalBlur), default_focal_blur,
                                  NULL};

static const Field CAMERA_FIELDS[] = {
    ENUM(Camera, type, "type", CAMERA_TYPE_NAMES),
    VEC3_AS(FIELD_ALWAYS, Camera, location, "location"),
    VEC3_AS(FIELD_ALWAYS, Camera, direction, "direction"),
    VEC3_AS(FIELD_ALWAYS, Camera, up, "up"),
    VEC3_AS(FIELD_ALWAYS, Camera, right, "right"),
    DOUBLE_AS(FIELD_PLAIN, Camera, angle_deg, "angle"),
    {.name = "spherical_angles", .type = FIELD_DOUBLES, AT(Camera, spherical_deg), .columns = 2},
    {.name = "focal_blur",
     .type = FIELD_RECORD,
     .presence = FIELD_FLAGGED,
     AT(Camera, blur),
     .link = offsetof(Camera, has_blur),
     .record = &FOCAL_BLUR},
    {.name = "normal",
     .type = FIELD_INDEX,
     .presence = FIELD_FLAGGED,
     AT(Camera, normal),
     .link = offsetof(Camera, has_normal)},
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
    BOOL(Light, media_attenuation, "media_attenuation"),
    INDEX(Light, group, "group"),
    {.name = "projected_through",
     .type = FIELD_INDEX,
     .presence = FIELD_FLAGGED,
     AT(Light, projection),
     .link = offsetof(Light, has_projection)},
    END,
};
static void default_light(void *out) { *(Light *)out = light_default(LIGHT_POINT); }
static void default_light_kind(void *out) { *(Light *)out = light_default(((Light *)out)->type); }
static const Record LIGHT = {NULL, LIGHT_FIELDS, sizeof(Light), default_light, default_light_kind};

// ---- interiors, sky ------------------------------------------------------------------------

static const Field INTERIOR_FIELDS[] = {
    FLOAT(Interior, ior, "ior"),
    FLOAT(Interior, caustics, "caustics"),
    FLOAT(Interior, fade_distance, "fade_distance"),
    FLOAT(Interior, fade_power, "fade_power"),
    RGB(Interior, fade_color, "fade_color"),
    FLOAT(Interior, refraction, "refraction"),
    FLOAT(Interior, dispersion, "dispersion"),
    INT(Interior, dispersion_samples, "dispersion_samples"),
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

// ORDER fog_type
static const char *const FOG_TYPE_NAMES[] = {"constant", "ground", NULL};

static const Field FOG_FIELDS[] = {
    ENUM(Fog, type, "type", FOG_TYPE_NAMES),
    DOUBLE_AS(FIELD_REQUIRED, Fog, distance, "distance"),
    {.name = "color", .type = FIELD_COLOR, .presence = FIELD_REQUIRED, AT(Fog, color)},
    DOUBLE(Fog, alt, "alt"),
    DOUBLE(Fog, offset, "offset"),
    VEC3(Fog, up, "up"),
    {.name = "turbulence",
     .type = FIELD_RECORD,
     .presence = FIELD_FLAGGED,
     AT(Fog, turbulence),
     .link = offsetof(Fog, has_turbulence),
     .record = &TURBULENCE_RECORD},
    FLOAT(Fog, turb_depth, "turb_depth"),
    END,
};
static void default_fog(void *out) { *(Fog *)out = fog_default(); }
static const Record FOG = {NULL, FOG_FIELDS, sizeof(Fog), default_fog, NULL};

static const Field RAINBOW_FIELDS[] = {
    {.name = "pigment", .type = FIELD_INDEX, .presence = FIELD_REQUIRED, AT(Rainbow, pigment)},
    VEC3_AS(FIELD_REQUIRED, Rainbow, direction, "direction"),
    VEC3(Rainbow, right, "right"),
    VEC3(Rainbow, up, "up"),
    DOUBLE(Rainbow, distance, "distance"),
    DOUBLE_AS(FIELD_REQUIRED, Rainbow, angle_deg, "angle"),
    DOUBLE_AS(FIELD_REQUIRED, Rainbow, width_deg, "width"),
    DOUBLE(Rainbow, arc_deg, "arc_angle"),
    DOUBLE(Rainbow, falloff_deg, "falloff_angle"),
    DOUBLE(Rainbow, jitter, "jitter"),
    END,
};
static void default_rainbow(void *out) { *(Rainbow *)out = rainbow_default(); }
static const Record RAINBOW = {NULL, RAINBOW_FIELDS, sizeof(Rainbow), default_rainbow, NULL};

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
    RECORDS(Scene, fogs, fog_count, "fogs", &FOG),
    RECORDS(Scene, rainbows, rainbow_count, "rainbows", &RAINBOW),
    RECORDS(Scene, lights, light_count, "lights", &LIGHT),
    RECORDS(Scene, pictures, picture_count, "pictures", &PICTURE_RECORD),
    RECORDS(Scene, densities, density_count, "densities", &DENSITY_RECORD),
    RECORDS(Scene, pigments, pigment_count, "pigments", &PIGMENT_RECORD),
    RECORDS(Scene, normals, normal_count, "normals", &NORMAL_RECORD),
    RECORDS(Scene, functions, function_count, "functions", &FUNCTION_RECORD),
    RECORDS(Scene, textures, texture_count, "textures", &TEXTURE_RECORD),
    RECORDS(Scene, interiors, interior_count, "interiors", &INTERIOR),
    RECORDS(Scene, meshes, mesh_count, "meshes", &MESH_RECORD),
    RECORDS(Scene, height_maps, height_map_count, "height_maps", &HEIGHT_MAP_RECORD),
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

static bool table_equal(const Field *field, const void *a, const void *b) {
    uint32_t count = *(const uint32_t *)field_of(a, field->link);
    if (count != *(const uint32_t *)field_of(b, field->link))
        return false;
    const double *left = *(double *const *)field_of(a, field->offset);
    const double *right = *(double *const *)field_of(b, field->offset);
    return count == 0 ||
           memcmp(left, right, (size_t)count * (size_t)field->columns * sizeof *left) == 0;
}

static bool member_equal(const Field *field, const void *a, const void *b) {
    if (field->type == FIELD_RECORDS || field->type == FIELD_INDICES)
        return list_equal(field, a, b);
    if (field->type == FIELD_TABLE)
        return table_equal(field, a, b);
    assert(field->type != FIELD_INDEX_TABLE);
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

bool pigment_equal(const Pigment *a, const Pigment *b) {
    return record_equal(&PIGMENT_RECORD, a, b);
}

bool picture_equal(const Picture *a, const Picture *b) {
    return record_equal(&PICTURE_RECORD, a, b);
}

bool normal_equal(const Normal *a, const Normal *b) { return record_equal(&NORMAL_RECORD, a, b); }

bool texture_equal(const Texture *a, const Texture *b) {
    return record_equal(&TEXTURE_RECORD, a, b);
}

bool field_belongs(const Record *table, const Field *field, const void *record) {
    return field->kinds == 0 ||
           (field->kinds >> *(const int *)field_of(record, table->fields[0].offset) & 1);
}

static bool same_path(const char *a, const char *b) {
    return a == b || (a && b && strcmp(a, b) == 0);
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
    case FIELD_PATH:
        return same_path(*(const char *const *)a, *(const char *const *)b);
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
    case FIELD_TABLE:
    case FIELD_INDEX_TABLE:
        return false; // lists need the counts beside them: list_equal
    }
    return memcmp(a, b, size) == 0;
}
