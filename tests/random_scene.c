// SPDX-License-Identifier: MIT
#include "random_scene.h"

#include "scene_members.h"
#include "tests/random_solid.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

// ---- numbers --------------------------------------------------------------------------------

double random_double(Rng *rng) {
    switch (rng_next(rng) % 8) {
    case 0:
        return 0.0;
    case 1:
        return -0.0;
    case 2:
        return (double)(int64_t)(rng_next(rng) % 2001) - 1000;
    case 3:
        return 4.9406564584124654e-324 * (double)(rng_next(rng) % 5000);
    case 4:
        return rng_range(rng, -1, 1) * pow(10, rng_range(rng, -300, 60));
    case 5:
        return floor(rng_unit(rng) * 1000) / 1000;
    default:
        return rng_range(rng, -10, 10);
    }
}

float random_float(Rng *rng) {
    if (rng_next(rng) % 2)
        return (float)(floor(rng_unit(rng) * 100) / 100);
    for (;;) {
        uint32_t bits = (uint32_t)rng_next(rng);
        float value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value))
            return value;
    }
}

static bool random_bool(Rng *rng) { return rng_next(rng) % 2; }
static uint32_t random_below(Rng *rng, uint32_t count) { return (uint32_t)(rng_next(rng) % count); }
static uint32_t index_or_none(Rng *rng, uint32_t count) {
    return random_bool(rng) ? NO_INDEX : random_below(rng, count);
}
static Vec3 random_vec3(Rng *rng) {
    double x = random_double(rng), y = random_double(rng);
    return vec3(x, y, random_double(rng));
}
static Vec3 random_unit(Rng *rng) {
    double x = rng_range(rng, -1, 1), y = rng_range(rng, -1, 1);
    return vec_normalize(vec3(x, y, rng_range(rng, 0.1, 1)));
}
static Rgb random_rgb(Rng *rng) {
    float r = random_float(rng), g = random_float(rng);
    return rgb(r, g, random_float(rng));
}
static Color random_color(Rng *rng) {
    Rgb c = random_rgb(rng);
    bool opaque = random_bool(rng);
    float filter = opaque ? 0 : random_float(rng), transmit = opaque ? 0 : random_float(rng);
    return (Color){c.r, c.g, c.b, filter, transmit};
}

static Transform random_transform(Rng *rng) {
    Transform all = transform_identity();
    int count = (int)random_below(rng, 4);
    for (int i = 0; i < count; i++) {
        double x = rng_range(rng, 0.1, 9), y = rng_range(rng, -9, -0.1), z = rng_range(rng, 1, 90);
        Transform t = transform_translate(vec3(x, y, z));
        uint32_t kind = random_below(rng, 4);
        if (kind == 0)
            t = transform_scale(vec3(x, y, z));
        else if (kind == 1)
            t = transform_rotate(vec3(x, y, z));
        else if (kind == 2)
            (void)transform_matrix((const double[4][3]){{x, y, 0}, {0, z, x}, {y, 0, x}, {1, 2, z}},
                                   &t);
        all = transform_compose(&all, &t);
    }
    all.inv[3][3] = 1; // not in the file: nothing looks at it
    return all;
}

// ---- making ---------------------------------------------------------------------------------

static Settings make_settings(Rng *rng) {
    Settings s = settings_default();
    if (random_bool(rng))
        return s;
    s.version = 310 + (int)random_below(rng, 61);
    s.gamma_mode = (GammaMode)random_below(rng, 3);
    s.assumed_gamma = (float)rng_range(rng, 0.1, 3);
    s.ambient_light = random_rgb(rng);
    s.max_trace_level = 1 + (int)random_below(rng, 256);
    s.adc_bailout = random_float(rng);
    s.noise_generator = 1 + (int)random_below(rng, 3);
    s.number_of_waves = (int)random_below(rng, 30);
    s.irid_wavelength = random_rgb(rng);
    s.background = random_color(rng);
    return s;
}

static Camera make_camera(Rng *rng) {
    Camera camera = {
        .type = (CameraType)random_below(rng, CAMERA_SPHERICAL + 1),
        .location = random_vec3(rng),
        .direction = random_unit(rng),
        .up = random_vec3(rng),
        .right = random_vec3(rng),
        .angle_deg = random_double(rng),
        .spherical_deg = {random_double(rng), random_double(rng)},
        .has_blur = random_bool(rng),
        .blur = focal_blur_default(),
    };
    if (camera.has_blur)
        camera.blur = (FocalBlur){
            .aperture = random_double(rng),
            .focal_distance = random_double(rng),
            .samples = 1 + (int)random_below(rng, 100),
            .min_samples = (int)random_below(rng, 10),
            .confidence = rng_range(rng, 0.1, 0.9),
            .variance = random_double(rng),
        };
    return camera;
}

static AreaLight make_area_light(Rng *rng) {
    return (AreaLight){
        .axis = {random_vec3(rng), random_vec3(rng)},
        .size = {1 + (int)random_below(rng, 20), 1 + (int)random_below(rng, 20)},
        .adaptive = (int)random_below(rng, 3) * 50,
        .circular = random_bool(rng),
        .orient = random_bool(rng),
        .jitter = random_bool(rng),
        .illumination = random_bool(rng),
    };
}

static Light make_light(Rng *rng) {
    Light light = light_default((LightType)random_below(rng, LIGHT_CYLINDER + 1));
    light.location = random_vec3(rng);
    light.point_at = vec3(rng_range(rng, 20, 30), random_double(rng), 3); // never the location
    light.color = random_rgb(rng);
    light.shadowless = random_bool(rng);
    light.fade_distance = random_float(rng);
    light.fade_power = random_float(rng);
    if (light.type >= LIGHT_SPOT && random_bool(rng)) {
        light.radius = random_double(rng);
        light.falloff = random_double(rng);
        light.tightness = random_double(rng);
    }
    light.parallel = light.type == LIGHT_SPOT && random_bool(rng);
    light.has_area = random_bool(rng);
    if (light.has_area)
        light.area = make_area_light(rng);
    light.media_attenuation = random_bool(rng);
    light.group = random_below(rng, 3);
    return light;
}

static Turbulence make_turbulence(Rng *rng) {
    return (Turbulence){
        .amount = random_vec3(rng),
        .octaves = 1 + (int)random_below(rng, 10),
        .lambda = random_float(rng),
        .omega = random_float(rng),
    };
}

static Warp make_warp(Rng *rng) {
    Warp warp = warp_default((WarpType)random_below(rng, WARP_TOROIDAL + 1));
    switch (warp.type) {
    case WARP_TRANSFORM:
        warp.transform = random_transform(rng);
        break;
    case WARP_TURBULENCE:
        warp.turbulence = make_turbulence(rng);
        break;
    case WARP_REPEAT: {
        RepeatWarp *repeat = &warp.repeat;
        repeat->axis = (int)random_below(rng, 3);
        repeat->width = (float)rng_range(rng, 0.1, 5);
        repeat->offset = random_vec3(rng);
        repeat->flip = vec3(1, random_bool(rng) ? -1 : 1, random_bool(rng) ? -1 : 1);
        break;
    }
    case WARP_BLACK_HOLE: {
        BlackHoleWarp *hole = &warp.black_hole;
        hole->center = random_vec3(rng);
        hole->radius = rng_range(rng, 0, 5);
        hole->strength = random_double(rng);
        hole->falloff = random_double(rng);
        hole->inverse = random_bool(rng);
        hole->repeat = random_bool(rng);
        if (hole->repeat)
            hole->repeat_size = random_vec3(rng);
        hole->uncertainty = random_vec3(rng);
        break;
    }
    case WARP_TOROIDAL:
        warp.mapping.major_radius = random_double(rng);
        // fall through
    case WARP_SPHERICAL:
    case WARP_CYLINDRICAL:
        warp.mapping.dist_exp = random_double(rng);
        warp.mapping.orientation = random_unit(rng);
        break;
    case WARP_PLANAR:
        warp.mapping.orientation = random_unit(rng);
        warp.mapping.distance = random_double(rng);
        break;
    case WARP_CUBIC:
        break;
    }
    return warp;
}

// What belongs to one pattern each; any of it may stand beside any pattern.
static void make_pattern_shape(Rng *rng, Pattern *p) {
    if (random_bool(rng))
        return;
    p->agate_turb = random_float(rng);
    p->arms = (int)random_below(rng, 9) - 2;
    p->brick_size = vec3(rng_range(rng, 0.1, 9), rng_range(rng, 0.1, 9), rng_range(rng, 0.1, 9));
    p->mortar = random_float(rng);
    p->quilted[0] = random_float(rng);
    p->quilted[1] = random_float(rng);
    p->crackle.form = random_vec3(rng);
    p->crackle.metric = random_double(rng);
    p->crackle.offset = random_double(rng);
    p->crackle.solid = random_bool(rng);
    p->slope =
        (SlopeShape){random_unit(rng), random_bool(rng),   random_double(rng), random_double(rng),
                     random_vec3(rng), random_double(rng), random_double(rng), random_double(rng)};
    p->fractal = (FractalShape){2 + (int)random_below(rng, 32),
                                (int)random_below(rng, 3),
                                (int)random_below(rng, 9999),
                                random_bool(rng),
                                {random_double(rng), random_double(rng)},
                                (int)random_below(rng, 9),
                                (int)random_below(rng, 7),
                                random_double(rng),
                                random_double(rng)};
    p->density_between = (int)random_below(rng, 3);
    p->facets = (FacetsShape){random_double(rng), random_double(rng), random_double(rng)};
}

enum { PICTURES = 3 };

static void make_values(Rng *rng, Arena *arena, Picture *p) {
    p->width = 1 + (int)random_below(rng, 4);
    p->height = 1 + (int)random_below(rng, 4);
    p->channels = random_bool(rng) ? 1 : 4;
    p->value_count = (uint32_t)(p->width * p->height * p->channels);
    p->values = ARENA_ARRAY(arena, double, p->value_count);
    for (uint32_t i = 0; i < p->value_count; i++)
        p->values[i] = rng_range(rng, 0, 65535);
}

static Picture make_picture(Rng *rng, Arena *arena) {
    Picture p = picture_default();
    // Absolute: those stay as they are, whatever folder the scene file is in.
    p.type = (PictureType)random_below(rng, PICTURE_VALUES + 1);
    if (p.type == PICTURE_VALUES)
        make_values(rng, arena, &p);
    else
        p.path = arena_printf(arena, "/pictures/a \"%u\".png", random_below(rng, 99));
    p.decode = (PictureDecode)random_below(rng, DECODE_SRGB + 1);
    p.gamma = (float)rng_range(rng, 0.1, 3);
    p.to_working = random_bool(rng);
    p.layout = (PictureLayout)random_below(rng, LAYOUT_TORUS + 1);
    p.between = (PictureBetween)random_below(rng, BETWEEN_NORMALIZED + 1);
    p.use = (PictureUse)random_below(rng, USE_PICTURE_ALPHA + 1);
    p.once = random_bool(rng);
    p.repeat = (Vec2){rng_range(rng, 0.1, 3), rng_range(rng, 0.1, 3)};
    p.offset = (Vec2){random_double(rng), random_double(rng)};
    p.has_filter = random_bool(rng);
    p.filter = p.has_filter ? random_float(rng) : 0;
    p.has_transmit = random_bool(rng);
    p.transmit = p.has_transmit ? random_float(rng) : 0;
    p.change_count = random_below(rng, 3);
    p.changes = ARENA_ARRAY(arena, PaletteChange, p.change_count);
    for (uint32_t i = 0; i < p.change_count; i++) {
        p.changes[i].place = (int)random_below(rng, 256);
        p.changes[i].transmit = random_bool(rng);
        p.changes[i].value = random_float(rng);
    }
    return p;
}

// Patterns that stand in every kind of record and ask for nothing but a file.
static bool is_common(PatternType type) {
    return type < PATTERN_BUMPS || type == PATTERN_IMAGE || type == PATTERN_SLOPE ||
           type == PATTERN_AOI || type == PATTERN_FRACTAL || type == PATTERN_DENSITY;
}

static Pattern make_pattern(Rng *rng, Arena *arena) {
    Pattern p = pattern_default();
    do
        p.type = (PatternType)random_below(rng, PATTERN_MODELLED);
    while (!is_common(p.type));
    if (p.type == PATTERN_DENSITY || random_bool(rng))
        p.density = random_below(rng, PICTURES);
    if (p.type == PATTERN_IMAGE || random_bool(rng))
        p.picture = random_below(rng, PICTURES);
    p.wave = (WaveType)random_below(rng, 6);
    p.frequency = random_float(rng);
    p.phase = random_float(rng);
    p.exponent = random_float(rng);
    p.noise_generator = (int)random_below(rng, 4);
    p.gradient = random_unit(rng);
    make_pattern_shape(rng, &p);
    p.has_turbulence = random_bool(rng);
    if (p.has_turbulence)
        p.turbulence = make_turbulence(rng);
    p.warp_count = random_below(rng, 4);
    p.warps = ARENA_ARRAY(arena, Warp, p.warp_count);
    for (uint32_t i = 0; i < p.warp_count; i++)
        p.warps[i] = make_warp(rng);
    return p;
}

// Refers only to pigments of a lower index, so that there are no circles.
static Pigment make_pigment(Rng *rng, Arena *arena, uint32_t index) {
    Pigment p = {.pattern = make_pattern(rng, arena), .uv_mapping = random_bool(rng)};
    p.color = random_color(rng);
    if (p.pattern.picture != NO_INDEX && random_bool(rng))
        p.pattern.type = PATTERN_IMAGE_MAP;
    if (index > 0 && random_bool(rng))
        p.pattern.pigment = random_below(rng, index);
    if (p.pattern.pigment != NO_INDEX && p.pattern.type == PATTERN_AOI)
        p.pattern.type = PATTERN_PIGMENT;
    if (p.pattern.type != PATTERN_PLAIN && p.pattern.type != PATTERN_IMAGE_MAP)
        p.entry_count = 6 + random_below(rng, 3); // enough for any list pattern
    p.entries = ARENA_ARRAY(arena, MapEntry, p.entry_count);
    for (uint32_t i = 0; i < p.entry_count; i++) {
        bool map = index > 0 && random_bool(rng);
        p.entries[i] = (MapEntry){
            // weights, where the pattern is the average: their sum must be something
            .value = p.pattern.type == PATTERN_AVERAGE ? 1.5f : random_float(rng),
            .color = random_color(rng),
            .pigment = map ? random_below(rng, index) : NO_INDEX,
        };
    }
    p.has_quick_color = random_bool(rng);
    if (p.has_quick_color)
        p.quick_color = random_color(rng);
    return p;
}

static Finish make_finish(Rng *rng) {
    Finish f = finish_default();
    if (random_bool(rng))
        return f;
#define MAKE(Type, name) f.name = random_float(rng);
    FINISH_FLOATS(MAKE)
#undef MAKE
    f.roughness = (float)rng_range(rng, 0.001, 1);
    f.reflection_exponent = (float)rng_range(rng, 0.1, 3);
    f.ambient = random_rgb(rng);
    f.emission = random_rgb(rng);
    f.reflection_min = random_rgb(rng);
    f.reflection_max = random_rgb(rng);
    f.reflection_fresnel = random_bool(rng);
    f.conserve_energy = random_bool(rng);
    return f;
}

// Entries of a map of normals or textures: only those of a lower index.
static IndexEntry *make_entries(Rng *rng, Arena *arena, PatternType type, uint32_t below,
                                uint32_t count) {
    IndexEntry *entries = ARENA_ARRAY(arena, IndexEntry, count);
    for (uint32_t i = 0; i < count; i++) {
        float value = type == PATTERN_AVERAGE ? 1.5f : random_float(rng);
        entries[i] = (IndexEntry){value, random_below(rng, below)};
    }
    return entries;
}

static Normal make_normal(Rng *rng, Arena *arena, uint32_t index) {
    Normal n = {.pattern = make_pattern(rng, arena), .uv_mapping = random_bool(rng)};
    if (n.pattern.type == PATTERN_PLAIN || (index == 0 && n.pattern.type == PATTERN_AVERAGE))
        n.pattern.type = random_bool(rng) ? PATTERN_BUMPS : PATTERN_FACETS;
    if (n.pattern.picture != NO_INDEX && n.pattern.type != PATTERN_AVERAGE && random_bool(rng))
        n.pattern.type = PATTERN_BUMP_MAP;
    n.amount = random_float(rng);
    n.accuracy = (float)rng_range(rng, 0.001, 1);
    n.no_bump_scale = random_bool(rng);
    if (n.pattern.type == PATTERN_AVERAGE || (index > 0 && random_bool(rng))) {
        n.entry_count = 6;
        n.entries = make_entries(rng, arena, n.pattern.type, index, n.entry_count);
    } else {
        n.slope_count = random_below(rng, 4);
        n.slopes = ARENA_ARRAY(arena, SlopeEntry, n.slope_count);
        for (uint32_t i = 0; i < n.slope_count; i++)
            n.slopes[i] = (SlopeEntry){random_float(rng), random_double(rng), random_double(rng)};
    }
    return n;
}

static Texture make_texture(Rng *rng, Arena *arena, const Scene *scene, uint32_t index) {
    Texture t = {.pattern = pattern_default(), .uv_mapping = random_bool(rng)};
    t.no_bump_scale = random_bool(rng);
    if (index > 0 && random_bool(rng)) {
        t.pattern = make_pattern(rng, arena);
        t.entry_count = 6;
        if (t.pattern.picture != NO_INDEX && random_bool(rng))
            t.pattern.type = PATTERN_MATERIAL_MAP;
        if (t.pattern.type == PATTERN_PLAIN)
            t.entry_count = t.uv_mapping = 1;
        t.entries = make_entries(rng, arena, t.pattern.type, index, t.entry_count);
        return t;
    }
    t.layer_count = 1 + random_below(rng, 3);
    t.layers = ARENA_ARRAY(arena, Layer, t.layer_count);
    for (uint32_t i = 0; i < t.layer_count; i++)
        t.layers[i] = (Layer){random_below(rng, scene->pigment_count), make_finish(rng),
                              index_or_none(rng, scene->normal_count)};
    return t;
}

static Interior make_interior(Rng *rng) {
    return (Interior){
        .ior = (float)rng_range(rng, 0.5, 3),
        .caustics = random_float(rng),
        .fade_distance = random_float(rng),
        .fade_power = random_float(rng),
        .fade_color = random_rgb(rng),
        .refraction = random_float(rng),
        .dispersion = (float)rng_range(rng, 0.5, 2),
        .dispersion_samples = 2 + (int)random_below(rng, 100),
    };
}

static void make_patch(Rng *rng, Arena *arena, PatchShape *patch) {
    if (random_bool(rng)) {
        patch->degree_u = 1 + random_below(rng, 16);
        patch->degree_v = 1 + random_below(rng, 16);
    }
    uint32_t count = (patch->degree_u + 1) * (patch->degree_v + 1);
    patch->points = ARENA_ARRAY(arena, Vec3, count);
    for (uint32_t i = 0; i < count; i++)
        patch->points[i] = random_vec3(rng);
    if (random_below(rng, 3) == 0) {
        patch->weights = ARENA_ARRAY(arena, double, count);
        for (uint32_t i = 0; i < count; i++)
            patch->weights[i] = exp(rng_range(rng, -9, 9));
    }
    if (random_bool(rng))
        return;
    patch->type = (int)random_below(rng, 2);
    patch->flatness = random_double(rng);
    patch->u_steps = (int)random_below(rng, 9);
    patch->v_steps = (int)random_below(rng, 9);
    for (int i = 0; i < 4; i++)
        patch->uv[i] = (Vec2){random_double(rng), random_double(rng)};
}

static void make_shape(Rng *rng, Arena *arena, const Scene *scene, Object *object) {
    double size = rng_range(rng, 0, 100);
    Vec3 a = random_vec3(rng), b = random_vec3(rng);
    switch (object->type) {
    case OBJECT_UNION:
    case OBJECT_MERGE:
    case OBJECT_INTERSECTION:
        break;
    case OBJECT_PATCH:
        make_patch(rng, arena, &object->shape.patch);
        break;
    case OBJECT_PLANE:
        object->shape.plane = (PlaneShape){random_unit(rng), random_double(rng)};
        break;
    case OBJECT_SPHERE:
        object->shape.sphere = (SphereShape){a, size};
        break;
    case OBJECT_BOX:
        object->shape.box = (BoxShape){vec_min(a, b), vec_max(a, b)};
        break;
    case OBJECT_CYLINDER:
    case OBJECT_CONE:
        b.x = a.x == 7 ? 8 : 7; // another point than a
        object->shape.cone = (ConeShape){a, b, size, rng_unit(rng), random_bool(rng)};
        break;
    case OBJECT_TORUS:
        object->shape.torus = (TorusShape){size, rng_unit(rng)};
        break;
    case OBJECT_DISC:
        object->shape.disc = (DiscShape){a, random_unit(rng), size, rng_unit(rng)};
        break;
    case OBJECT_TRIANGLE:
        object->shape.triangle = (TriangleShape){{a, b, random_vec3(rng)}};
        break;
    default:
        random_solid(rng, arena, scene, object);
    }
}

enum { MAX_OBJECTS = 300 };

// A list of objects and what hangs below; writes their indices to *items.
static uint32_t make_objects(Rng *rng, Arena *arena, Scene *scene, int depth, uint32_t **items) {
    uint32_t count = random_below(rng, depth == 0 ? 20 : 5);
    *items = ARENA_ARRAY(arena, uint32_t, count);
    for (uint32_t i = 0; i < count; i++) {
        bool leaf = depth > 3 || scene->object_count > MAX_OBJECTS - 160;
        ObjectType type =
            (ObjectType)(leaf ? OBJECT_PATCH + random_below(rng, OBJECT_INSTANCE - OBJECT_PATCH)
                              : random_below(rng, OBJECT_INSTANCE));
        uint32_t index = scene->object_count++;
        Object object = object_default(type);
        object.texture = index_or_none(rng, scene->texture_count);
        object.interior_texture = index_or_none(rng, scene->texture_count);
        object.interior = index_or_none(rng, scene->interior_count);
        object.light_group = random_below(rng, 3);
#define MAKE(Type, name) object.name = rng_next(rng) % 4 == 0;
        OBJECT_FLAGS(MAKE)
#undef MAKE
        if (object_has_space(type) && random_bool(rng)) {
            object.has_transform = true;
            object.transform = random_transform(rng);
        }
        make_shape(rng, arena, scene, &object);
        if (object_is_tree(&object))
            object.shape.children.count =
                make_objects(rng, arena, scene, depth + 1, &object.shape.children.items);
        if (!leaf && type != OBJECT_PATCH && random_below(rng, 4) == 0)
            object.clips.count = make_objects(rng, arena, scene, depth + 1, &object.clips.items);
        if (!leaf && random_below(rng, 16) == 0)
            object.bounds.count = make_objects(rng, arena, scene, depth + 1, &object.bounds.items);
        object.solid = type == OBJECT_UNION && random_bool(rng);
        for (uint32_t k = 0; object.solid && k < object.shape.children.count; k++) {
            ObjectType child = scene->objects[object.shape.children.items[k]].type;
            object.solid = child == OBJECT_PATCH || child == OBJECT_UNION;
        }
        object.whole = type == OBJECT_UNION && !object.clips.count && random_bool(rng);
        object.difference =
            (type == OBJECT_INTERSECTION || type == OBJECT_MERGE) && random_bool(rng);
        object.cutaway = !object_is_tree(&object) && object.texture == NO_INDEX && random_bool(rng);
        scene->objects[index] = object;
        (*items)[i] = index;
    }
    return count;
}

// Ascending pairs.
static uint32_t make_pairs(Rng *rng, Arena *arena, uint32_t pool, uint32_t **pairs) {
    uint32_t count = 0;
    *pairs = ARENA_ARRAY(arena, uint32_t, 2 * (size_t)pool);
    for (uint32_t i = 0; i < pool; i++) {
        if (random_bool(rng))
            continue;
        (*pairs)[2 * count] = i;
        (*pairs)[2 * count++ + 1] = random_below(rng, pool);
    }
    return count;
}

// Behind the objects at top level, so that these are numbered in order.
static void make_instances(Rng *rng, Arena *arena, Scene *scene) {
    uint32_t count = scene->definition_count ? random_below(rng, 5) : 0;
    uint32_t *roots = ARENA_ARRAY(arena, uint32_t, scene->root_count + count);
    for (uint32_t i = 0; i < scene->root_count; i++)
        roots[i] = scene->roots[i];
    for (uint32_t i = 0; i < count; i++) {
        Object object = object_default(OBJECT_INSTANCE);
        InstanceShape *shape = &object.shape.instance;
        object.texture = index_or_none(rng, scene->texture_count);
        object.interior = index_or_none(rng, scene->interior_count);
        object.has_transform = random_bool(rng);
        if (object.has_transform)
            object.transform = random_transform(rng);
        shape->definition = random_below(rng, scene->definition_count);
        shape->texture_count = make_pairs(rng, arena, scene->texture_count, &shape->textures);
        shape->interior_count = make_pairs(rng, arena, scene->interior_count, &shape->interiors);
        roots[scene->root_count++] = scene->object_count;
        scene->objects[scene->object_count++] = object;
    }
    scene->roots = roots;
}

static void make_sky_sphere(Rng *rng, Arena *arena, Scene *scene) {
    scene->has_sky_sphere = random_bool(rng);
    if (!scene->has_sky_sphere)
        return;
    SkySphere *sky = &scene->sky_sphere;
    sky->pigment_count = 1 + random_below(rng, 3);
    sky->pigments = ARENA_ARRAY(arena, uint32_t, sky->pigment_count);
    for (uint32_t i = 0; i < sky->pigment_count; i++)
        sky->pigments[i] = random_below(rng, scene->pigment_count);
    sky->emission = random_rgb(rng);
    sky->transform = random_transform(rng);
}

static Fog make_fog(Rng *rng) {
    Fog fog = fog_default();
    fog.type = (FogType)random_below(rng, 2);
    fog.distance = rng_range(rng, 0.1, 9);
    fog.alt = random_double(rng), fog.offset = random_double(rng);
    fog.up = random_unit(rng);
    fog.color = random_color(rng);
    fog.has_turbulence = random_bool(rng);
    if (fog.has_turbulence)
        fog.turbulence = make_turbulence(rng);
    fog.turb_depth = random_float(rng);
    return fog;
}

static Rainbow make_rainbow(Rng *rng, const Scene *scene) {
    Rainbow bow = rainbow_default();
    bow.pigment = random_below(rng, scene->pigment_count);
    bow.direction = random_unit(rng), bow.right = random_unit(rng), bow.up = random_unit(rng);
    bow.distance = random_double(rng);
    bow.angle_deg = random_double(rng), bow.width_deg = rng_range(rng, 1, 9);
    if (random_bool(rng))
        bow.arc_deg = rng_range(rng, 100, 200), bow.falloff_deg = rng_range(rng, 0, 100);
    bow.jitter = random_double(rng);
    return bow;
}

static void make_air(Rng *rng, Arena *arena, Scene *scene) {
    scene->fog_count = random_below(rng, 3);
    scene->fogs = ARENA_ARRAY(arena, Fog, scene->fog_count);
    for (uint32_t i = 0; i < scene->fog_count; i++)
        scene->fogs[i] = make_fog(rng);
    scene->rainbow_count = random_below(rng, 3);
    scene->rainbows = ARENA_ARRAY(arena, Rainbow, scene->rainbow_count);
    for (uint32_t i = 0; i < scene->rainbow_count; i++)
        scene->rainbows[i] = make_rainbow(rng, scene);
}

Scene *random_scene(Rng *rng, Arena *arena) {
    Scene *scene = ARENA_NEW(arena, Scene);
    scene->settings = make_settings(rng);
    scene->camera = make_camera(rng);
    scene->light_count = random_below(rng, 4);
    scene->pigment_count = 1 + random_below(rng, 6);
    scene->texture_count = 1 + random_below(rng, 4);
    scene->interior_count = 1 + random_below(rng, 3);
    scene->lights = ARENA_ARRAY(arena, Light, scene->light_count);
    scene->pigments = ARENA_ARRAY(arena, Pigment, scene->pigment_count);
    scene->textures = ARENA_ARRAY(arena, Texture, scene->texture_count);
    scene->interiors = ARENA_ARRAY(arena, Interior, scene->interior_count);
    for (uint32_t i = 0; i < scene->light_count; i++)
        scene->lights[i] = make_light(rng);
    for (uint32_t i = 0; i < scene->pigment_count; i++)
        scene->pigments[i] = make_pigment(rng, arena, i);
    scene->density_count = PICTURES;
    scene->densities = ARENA_ARRAY(arena, DensityFile, PICTURES);
    for (uint32_t i = 0; i < PICTURES; i++)
        scene->densities[i].path = arena_printf(arena, "/densities/%u.df3", i);
    scene->picture_count = PICTURES;
    scene->pictures = ARENA_ARRAY(arena, Picture, PICTURES);
    for (uint32_t i = 0; i < PICTURES; i++)
        scene->pictures[i] = make_picture(rng, arena);
    scene->normal_count = 1 + random_below(rng, 5);
    scene->normals = ARENA_ARRAY(arena, Normal, scene->normal_count);
    for (uint32_t i = 0; i < scene->normal_count; i++)
        scene->normals[i] = make_normal(rng, arena, i);
    for (uint32_t i = 0; i < scene->texture_count; i++)
        scene->textures[i] = make_texture(rng, arena, scene, i);
    for (uint32_t i = 0; i < scene->interior_count; i++)
        scene->interiors[i] = make_interior(rng);
    make_sky_sphere(rng, arena, scene);
    make_air(rng, arena, scene);
    scene->camera.has_normal = random_bool(rng);
    if (scene->camera.has_normal)
        scene->camera.normal = random_below(rng, scene->normal_count);
    random_pools(rng, arena, scene);
    scene->objects = ARENA_ARRAY(arena, Object, MAX_OBJECTS);
    scene->definition_count = random_below(rng, 3);
    scene->root_count = make_objects(rng, arena, scene, 0, &scene->roots);
    make_instances(rng, arena, scene);
    scene->projection_count = make_objects(rng, arena, scene, 2, &scene->projections);
    scene->definitions = ARENA_ARRAY(arena, uint32_t, scene->definition_count);
    for (uint32_t i = 0; i < scene->definition_count; i++) {
        Object sphere = object_default(OBJECT_SPHERE);
        sphere.texture = index_or_none(rng, scene->texture_count);
        scene->definitions[i] = scene->object_count;
        scene->objects[scene->object_count++] = sphere;
    }
    for (uint32_t i = 0; i < scene->pigment_count && scene->projection_count > 0; i++) {
        Pattern *pattern = &scene->pigments[i].pattern;
        if (pattern->type == PATTERN_CHECKER)
            pattern->type = PATTERN_OBJECT;
        if (pattern->type == PATTERN_OBJECT)
            pattern->object = random_below(rng, scene->projection_count);
    }
    for (uint32_t i = 0; i < scene->light_count && scene->projection_count > 0; i++) {
        scene->lights[i].has_projection = random_bool(rng);
        if (scene->lights[i].has_projection)
            scene->lights[i].projection = random_below(rng, scene->projection_count);
    }
    scene_collect_requires(scene, arena);
    return scene;
}
