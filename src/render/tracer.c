// SPDX-License-Identifier: MIT
// One ray: nearest hit, shade or sky (facts: rendering 4.1); and what surrounds it: the tables made
// once per scene, the tracer of a thread, the bodies the camera stands in.
#include "render/shading.h"

#include "base/array.h"
#include "render/story.h"

#include "noise/noise.h"
#include <math.h>
#include <string.h>

// Rays passed straight through cost no level, so a stack of transparent surfaces nests as deep as
// it is thick. The frames of this many nested rays take 3 MB of the 8 MB of stack that a thread has
// (gcc 12, -O3: 2.4 kB a ray; 4 kB under the sanitizers); what lies behind them is black.
static const uint32_t NESTING_LIMIT = 1200;

static Quality quality_of(int level) {
    return (Quality){
        .ambient_only = level <= 1,
        .quick_color = level <= 5,
        .shadows = level >= 4,
        .area_lights = level >= 5,
        .refraction = level >= 6,
        .reflection = level >= 8,
        .air = level >= 9,
        .normals = level >= 8,
    };
}

// Leaf after leaf of a definition, the interior and whether it is hollow; equal ones behind each
// other once.
typedef ARRAY(uint32_t) Leaves;

static void list_leaves(const Scene *scene, uint32_t object, Leaves *leaves) {
    const Object *part = &scene->objects[object];
    if (object_is_tree(part)) {
        for (uint32_t i = 0; i < part->shape.children.count; i++)
            list_leaves(scene, part->shape.children.items[i], leaves);
        return;
    }
    const Object *last = NULL;
    if (leaves->count > 0)
        last = &scene->objects[leaves->items[leaves->count - 1]];
    if (!last || last->interior != part->interior || last->hollow != part->hollow)
        array_push(leaves, object);
}

// Opaque if all textures are that it gives to its parts. Objects of one body that do not agree
// whether it is hollow: the last decides, as in POV-Ray.
static void prepare_instance(Shading *shading, uint32_t index, const Leaves *leaves) {
    const InstanceShape *shape = &shading->scene->objects[index].shape.instance;
    ObjectInfo *info = &shading->objects[index];
    for (uint32_t i = 0; info->opaque && i < shape->texture_count; i++)
        info->opaque = texture_is_opaque(shading->textures, shape->textures[2 * i + 1]);
    for (size_t i = 0; i < leaves->count; i++)
        shading->hollow[body_of(shading->scene, leaves->items[i], index)] =
            shading->scene->objects[leaves->items[i]].hollow;
}

static Leaves *list_definitions(const Scene *scene, Arena *scratch) {
    Leaves *lists = ARENA_ARRAY(scratch, Leaves, scene->definition_count);
    for (uint32_t i = 0; i < scene->definition_count; i++)
        list_leaves(scene, scene->definitions[i], &lists[i]);
    return lists;
}

static void prepare_objects(Shading *shading) {
    const Scene *scene = shading->scene;
    shading->objects = ARENA_ARRAY(shading->arena, ObjectInfo, scene->object_count);
    size_t bodies = (size_t)scene->interior_count + scene->object_count;
    shading->hollow = ARENA_ARRAY(shading->arena, bool, bodies);
    bool any_clear = false;
    Arena *scratch = arena_create();
    Leaves *leaves = list_definitions(scene, scratch);
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        ObjectInfo *info = &shading->objects[i];
        info->body = body_of(scene, i, NO_INDEX);
        info->opaque = surface_is_opaque(shading->textures, object);
        info->lit = surface_is_lit(scene, object);
        info->mirror = surface_mirrors(scene, object);
        bool instance = object->type == OBJECT_INSTANCE;
        if (instance)
            prepare_instance(shading, i, &leaves[object->shape.instance.definition]);
        any_clear = any_clear || !info->opaque;
        shading->groups |= object->no_global_lights;
        if (!instance)
            shading->hollow[info->body] = object->hollow;
    }
    for (uint32_t i = 0; i < scene->definition_count; i++)
        array_free(&leaves[i]);
    arena_destroy(scratch);
    shading->all_opaque = true;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        ObjectInfo *info = &shading->objects[i];
        if (object->cutaway && any_clear)
            info->opaque = false; // it may show the texture of a clear one
        if (!object_is_tree(object) && !object->no_shadow && !info->opaque)
            shading->all_opaque = false;
    }
}

// The object alone in a world of its own.
static World *lone_world(const Shading *shading, uint32_t projection) {
    Scene *scene = arena_copy(shading->arena, shading->scene, sizeof *scene);
    PatchSetOptions patches = shading->options.patches;
    if (!(patches.tolerance > 0.0))
        patches = patchset_options_default();
    scene->roots = &shading->scene->projections[projection];
    scene->root_count = 1;
    World *world = world_create(scene, &patches);
    world_use_functions(world, &shading->textures->functions);
    return world;
}

// Patterns of objects: each in a world of its own, so that `inside` asks only for it.
static bool body_holds(const void *objects, uint32_t object, Vec3 p) {
    const Shading *shading = objects;
    return world_inside(shading->bodies[object], shading->scene->projections[object], p);
}

static void prepare_body(Shading *shading, const Pattern *pattern) {
    if (pattern->type != PATTERN_OBJECT || shading->bodies[pattern->object] != NULL)
        return;
    shading->bodies[pattern->object] = lone_world(shading, pattern->object);
}

static void prepare_bodies(Shading *shading) {
    const Scene *scene = shading->scene;
    shading->bodies = ARENA_ARRAY(shading->arena, World *, scene->projection_count);
    for (uint32_t i = 0; i < scene->pigment_count; i++)
        prepare_body(shading, &scene->pigments[i].pattern);
    for (uint32_t i = 0; i < scene->normal_count; i++)
        prepare_body(shading, &scene->normals[i].pattern);
    for (uint32_t i = 0; i < scene->texture_count; i++)
        prepare_body(shading, &scene->textures[i].pattern);
    shading->textures->inside = body_holds;
    shading->textures->objects = shading;
}

static void prepare_lights(Shading *shading) {
    const Scene *scene = shading->scene;
    shading->axes = ARENA_ARRAY(shading->arena, LightAxis, scene->light_count);
    shading->projections = ARENA_ARRAY(shading->arena, World *, scene->light_count);
    shading->places = ARENA_ARRAY(shading->arena, Vec2 *, scene->light_count);
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        LightAxis *axis = &shading->axes[i];
        if (light->type != LIGHT_POINT)
            axis->travel = vec_normalize(vec_sub(light->point_at, light->location));
        shading->groups |= light->group != 0;
        shading->grainy |= light->has_area && light->area.jitter;
        if (light->has_projection)
            shading->projections[i] = lone_world(shading, light->projection);
        bool spot = light->type == LIGHT_SPOT;
        axis->radius = spot ? cos(light->radius * M_PI / 180.0) : light->radius;
        axis->falloff = spot ? cos(light->falloff * M_PI / 180.0) : light->falloff;
        size_t points = (size_t)light->area.size[0] * (size_t)light->area.size[1];
        if (light->has_area && points > shading->grid_limit)
            shading->grid_limit = points;
        if (light->has_area)
            shading->places[i] = area_places(&light->area, shading->arena);
    }
}

static void prepare_rainbow(Shading *shading, uint32_t i) {
    shading->bows[i] = rainbow_angles(&shading->scene->rainbows[i]);
    shading->grainy |= shading->scene->rainbows[i].jitter > 0.0;
}

Shading *shading_create(const Scene *scene, const World *world, const TraceOptions *options) {
    Arena *arena = arena_create();
    Shading *shading = ARENA_NEW(arena, Shading);
    shading->arena = arena;
    shading->scene = scene;
    shading->world = world;
    shading->textures = textures_create(scene, arena);
    prepare_bodies(shading);
    world_use_functions(world, &shading->textures->functions);
    shading->options = *options;
    shading->quality = quality_of(options->quality);
    dispersion_prepare(shading);
    shading->legacy = scene->settings.version < 370;
    prepare_objects(shading);
    shading->layer_limit = texture_layer_limit(scene);
    prepare_lights(shading);
    shading->bows = ARENA_ARRAY(arena, BowAngles, scene->rainbow_count);
    for (uint32_t i = 0; i < scene->rainbow_count; i++)
        prepare_rainbow(shading, i);
    for (uint32_t i = 0; i < scene->texture_count; i++)
        for (uint32_t j = 0; j < scene->textures[i].layer_count; j++)
            shading->grainy |= scene->textures[i].layers[j].finish.crand > 0.0f;
    return shading;
}

void shading_destroy(Shading *shading) {
    if (shading == NULL)
        return;
    for (uint32_t i = 0; i < shading->scene->light_count; i++)
        world_destroy(shading->projections[i]);
    for (uint32_t i = 0; i < shading->scene->projection_count; i++)
        world_destroy(shading->bodies[i]);
    arena_destroy(shading->arena);
}

const Textures *shading_textures(const Shading *shading) { return shading->textures; }

Tracer *tracer_create(const Shading *shading) {
    Arena *arena = arena_create();
    Tracer *tracer = ARENA_NEW(arena, Tracer);
    tracer->arena = arena;
    tracer->shading = shading;
    tracer->lights = tracer->own_lights =
        ARENA_ARRAY(arena, LightSample, shading->scene->light_count);
    tracer->blockers = ARENA_ARRAY(arena, uint32_t, shading->scene->light_count);
    for (uint32_t i = 0; i < shading->scene->light_count; i++)
        tracer->blockers[i] = WORLD_NO_BLOCKER;
    tracer->grid = ARENA_ARRAY(arena, Rgb, shading->grid_limit);
    tracer->reflections =
        ARENA_ARRAY(arena, LayerReflection, (size_t)(NESTING_LIMIT + 1) * shading->layer_limit);
    return tracer;
}

void tracer_destroy(Tracer *tracer) {
    if (tracer != NULL)
        arena_destroy(tracer->arena);
}

RayStats tracer_stats(const Tracer *tracer) { return tracer->stats; }

double tracer_random(uint32_t *state) {
    *state = *state * 1812433253u + 12345u;
    return (double)*state / 4294967295.0;
}

// Puts before what is seen what lies before the ray's end, as long as the ray is in the open or in
// hollow bodies.
static void see_through_air(Tracer *tracer, const Path *path, double depth, Color *color) {
    const Shading *shading = tracer->shading;
    const Scene *scene = shading->scene;
    if ((scene->fog_count == 0 && scene->rainbow_count == 0) || !shading->quality.air ||
        !interior_hollow(path->inside, shading->hollow))
        return;
    if (scene->rainbow_count > 0)
        *color = rainbow_see(tracer, &path->ray, depth, *color);
    if (scene->fog_count > 0)
        *color = fog_see(shading, &path->ray, depth, *color);
}

static void tell_hit(const Tracer *tracer, const Path *path, bool continued, const WorldHit *hit,
                     const PatchStats *before) {
    const PatchStats *now = &tracer->stats.patch;
    const PatchStats work = {.patch_tests = now->patch_tests - before->patch_tests,
                             .steps = now->steps - before->steps,
                             .newton = now->newton - before->newton};
    story_ray(tracer->story, path, continued);
    story_hit(tracer->story, path, hit, &work);
}

// What comes along a ray from what it meets; hit is known, where there is one, and here to stay.
static void show(Tracer *tracer, Path *path, bool continued, WorldHit *hit, Color *seen) {
    const Shading *shading = tracer->shading;
    if (!hit) {
        *seen = atmosphere_sky(shading, path->ray.dir, path->alpha);
        see_through_air(tracer, path, SHADE_FAR, seen);
        return;
    }
    const int level = path->level;
    path->level += continued ? 0 : 1;
    shade_hit(tracer, path, hit, seen);
    path->level = level;
    see_through_air(tracer, path, hit->t, seen);
    if (tracer->story)
        story_color(tracer->story, path, *seen);
}

static bool is_of_no_interest(const Tracer *tracer, const Path *path) {
    const Settings *settings = &tracer->shading->scene->settings;
    return path->level >= settings->max_trace_level || path->weight < settings->adc_bailout ||
           path->nesting > NESTING_LIMIT;
}

void trace_path(Tracer *tracer, Path *path, bool continued, Color *seen) {
    const Shading *shading = tracer->shading;
    if (is_of_no_interest(tracer, path)) {
        *seen = (Color){0};
        return;
    }
    WorldHit hit;
    PatchStats before = {0};
    if (tracer->story)
        before = tracer->stats.patch;
    WorldNear near = world_near(shading->world, path->from, path->ray.dir, SHADE_MIN_DEPTH);
    bool met = world_nearest_foreseen(shading->world, &path->ray, near, INFINITY, path->kind,
                                      path->foreseen, &tracer->stats, &hit);
    if (tracer->story)
        tell_hit(tracer, path, continued, met ? &hit : NULL, &before);
    show(tracer, path, continued, met ? &hit : NULL, seen);
}

// The bodies around the start of a camera ray; all rays of a perspective camera share them.
static const InteriorList *starting_interiors(Tracer *tracer, Vec3 org) {
    if (tracer->start_known && memcmp(&tracer->start, &org, sizeof org) == 0)
        return tracer->start_list;
    enum { LIMIT = sizeof tracer->start_nodes / sizeof tracer->start_nodes[0] };
    WorldPlace places[LIMIT];
    uint32_t count = world_containing(tracer->shading->world, org, places, LIMIT);
    tracer->start_list = NULL;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t body = hit_body(tracer->shading, places[i].object, places[i].instance);
        if (interior_inside(tracer->start_list, body))
            continue; // parts of one body that overlap
        tracer->start_nodes[i] = (InteriorList){tracer->start_list, body, false};
        tracer->start_list = &tracer->start_nodes[i];
    }
    tracer->start = org;
    tracer->start_known = true;
    return tracer->start_list;
}

// POV-Ray draws crand's grain from one sequence per thread, so that it depends on how the threads
// share the tiles; the jitter of area lights likewise. Ours start anew for each camera ray, from
// the ray itself (FNV-1a of its bits).
static uint32_t grain_seed(const Ray *ray) {
    unsigned char bytes[sizeof *ray];
    memcpy(bytes, ray, sizeof bytes);
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < sizeof bytes; i++)
        hash = (hash ^ bytes[i]) * 16777619u;
    return hash;
}

Color tracer_trace(Tracer *tracer, const Ray *ray) {
    const Shading *shading = tracer->shading;
    Path path = {
        .ray = *ray,
        .inside = starting_interiors(tracer, ray->org),
        .weight = 1.0f,
        .kind = RAY_CAMERA,
        .alpha = shading->options.alpha,
    };
    if (shading->grainy)
        tracer->crand = tracer->area_jitter = tracer->bow_jitter = grain_seed(ray);
    tracer->stats.primary++;
    AheadHit *ahead = ahead_take(tracer, ray);
    Color color = {0};
    if (!ahead)
        trace_path(tracer, &path, false, &color);
    else if (!is_of_no_interest(tracer, &path))
        show(tracer, &path, false, ahead->met ? &ahead->hit : NULL, &color);
    color.filter = 0.0f;
    if (!shading->options.alpha)
        color.transmit = 0.0f;
    return color;
}
