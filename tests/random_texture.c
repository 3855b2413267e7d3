// SPDX-License-Identifier: MIT
#include "random_texture.h"

#include "random_value.h"
#include "scene_members.h"

Turbulence random_turbulence(Rng *rng) {
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
        warp.turbulence = random_turbulence(rng);
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
        p.turbulence = random_turbulence(rng);
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
                              random_index_or_none(rng, scene->normal_count)};
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

void random_textures(Rng *rng, Arena *arena, Scene *scene) {
    scene->pigments = ARENA_ARRAY(arena, Pigment, scene->pigment_count);
    scene->textures = ARENA_ARRAY(arena, Texture, scene->texture_count);
    scene->interiors = ARENA_ARRAY(arena, Interior, scene->interior_count);
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
}
