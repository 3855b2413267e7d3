// SPDX-License-Identifier: MIT
#include "random_scene.h"

#include "random_solid.h"
#include "random_texture.h"
#include "random_value.h"
#include "scene_members.h"

#include <stddef.h>

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
        object.texture = random_index_or_none(rng, scene->texture_count);
        object.interior_texture = random_index_or_none(rng, scene->texture_count);
        object.interior = random_index_or_none(rng, scene->interior_count);
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
        object.texture = random_index_or_none(rng, scene->texture_count);
        object.interior = random_index_or_none(rng, scene->interior_count);
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
        fog.turbulence = random_turbulence(rng);
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
    for (uint32_t i = 0; i < scene->light_count; i++)
        scene->lights[i] = make_light(rng);
    random_textures(rng, arena, scene);
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
        sphere.texture = random_index_or_none(rng, scene->texture_count);
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
