// SPDX-License-Identifier: MIT
// From the nodes of the finished scene to the Scene: all around its objects, and the pools. What is
// used but not modelled is said, once a place.
#include "converter/emit.h"

#include <math.h>
#include <string.h>

// ---- messages --------------------------------------------------------------------------------

static bool same_place(const Loc *a, const Loc *b) {
    if (a->line != b->line || a->column != b->column)
        return false;
    return a->file == b->file || (a->file && b->file && strcmp(a->file, b->file) == 0);
}

void emit_gap(Emitter *e, const Loc *loc, const char *text) {
    if (e->quiet) {
        e->gap = e->gap ? e->gap : text;
        return;
    }
    Said **bucket = &e->said[((unsigned)loc->line * 31u + (unsigned)loc->column) % SAID_BUCKETS];
    for (const Said *said = *bucket; said; said = said->next)
        if (same_place(said->loc, loc) && strcmp(said->text, text) == 0)
            return;
    Said *said = ARENA_NEW(e->cv->arena, Said);
    *said = (Said){.next = *bucket, .loc = loc, .text = text};
    *bucket = said;
    if (e->cv->missing)
        requires_add(e->cv, loc, text);
    else
        warn_at(loc, "%s", text);
}

void emit_gaps(Emitter *e, const Gap *gaps) {
    if (!gaps)
        return;
    emit_gaps(e, gaps->next);
    emit_gap(e, gaps->loc, gaps->text);
}

// ---- the scene -------------------------------------------------------------------------------

static void emit_settings(Emitter *e) {
    const Converter *cv = e->cv;
    Settings *settings = &e->scene->settings;
    *settings = cv->nodes->settings;
    int version = effective_version(cv);
    settings->version = version > 0 ? version : 0; // below 1.0 all are one
    settings->noise_generator = cv->noise_generator;
    if (cv->gamma_set) {
        settings->gamma_mode = cv->gamma_is_srgb ? GAMMA_SRGB : GAMMA_POWER;
        settings->assumed_gamma = cv->gamma_is_srgb ? 1.0F : (float)cv->gamma;
    } else {
        settings->gamma_mode = settings->version >= 370 ? GAMMA_POWER : GAMMA_NONE;
        settings->assumed_gamma = 1.0F;
    }
}

static void emit_camera(Emitter *e) {
    const Nodes *nodes = e->cv->nodes;
    const CameraNode *camera = e->cv->options->clockless ? nodes->first_camera : nodes->camera;
    if (!camera)
        camera = &nodes->default_camera;
    emit_gaps(e, camera->gaps);
    e->scene->camera = camera->camera;
    e->scene->camera.has_normal = camera->normal != NULL;
    if (camera->normal)
        e->scene->camera.normal = emit_normal(e, camera->normal, false);
}

static void emit_sky(Emitter *e) {
    const SkySphereNode *node = e->cv->nodes->sky_sphere;
    SkySphere *sky = &e->scene->sky_sphere;
    if (!node)
        return;
    e->scene->has_sky_sphere = true;
    sky->emission = node->emission;
    sky->transform = node->transform;
    for (const PigmentList *list = node->top; list; list = list->next)
        sky->pigment_count++;
    sky->pigments = ARENA_ARRAY(e->cv->arena, uint32_t, sky->pigment_count);
    uint32_t i = sky->pigment_count;
    for (const PigmentList *list = node->top; list; list = list->next)
        sky->pigments[--i] = emit_pigment(e, list->pigment);
}

static void emit_fogs(Emitter *e) {
    Scene *scene = e->scene;
    uint32_t count = 0;
    for (const FogNode *node = e->cv->nodes->fogs; node; node = node->next)
        count++;
    scene->fogs = ARENA_ARRAY(e->cv->arena, Fog, count);
    for (const FogNode *node = e->cv->nodes->fogs; node; node = node->next)
        if (fabs(node->fog.distance) > 1e-10) // POV-Ray's limit
            scene->fogs[scene->fog_count++] = node->fog;
}

static void emit_rainbows(Emitter *e) {
    Scene *scene = e->scene;
    uint32_t count = 0;
    for (const RainbowNode *node = e->cv->nodes->rainbows; node; node = node->next)
        count++;
    scene->rainbows = ARENA_ARRAY(e->cv->arena, Rainbow, count);
    for (const RainbowNode *node = e->cv->nodes->rainbows; node; node = node->next) {
        if (!node->pigment || node->rainbow.distance == 0 || node->rainbow.width_deg == 0)
            continue;
        Rainbow *bow = &scene->rainbows[scene->rainbow_count++];
        *bow = node->rainbow;
        bow->pigment = emit_pigment(e, node->pigment);
    }
}

// Copies a pool into the arena and drops it.
#define KEEP(e, scene, pool, count_field)                                                          \
    do {                                                                                           \
        size_t size = (e)->pool.count * sizeof *(e)->pool.items;                                   \
        if (size)                                                                                  \
            (scene)->pool = arena_copy((e)->cv->arena, (e)->pool.items, size);                     \
        (scene)->count_field = (uint32_t)(e)->pool.count;                                          \
        array_free(&(e)->pool);                                                                    \
    } while (0)

static void keep_pools(Emitter *e) {
    Scene *scene = e->scene;
    KEEP(e, scene, objects, object_count);
    KEEP(e, scene, roots, root_count);
    KEEP(e, scene, lights, light_count);
    KEEP(e, scene, projections, projection_count);
    KEEP(e, scene, definitions, definition_count);
    KEEP(e, scene, pigments, pigment_count);
    KEEP(e, scene, pictures, picture_count);
    KEEP(e, scene, densities, density_count);
    KEEP(e, scene, normals, normal_count);
    KEEP(e, scene, functions, function_count);
    KEEP(e, scene, textures, texture_count);
    KEEP(e, scene, interiors, interior_count);
    KEEP(e, scene, meshes, mesh_count);
    KEEP(e, scene, height_maps, height_map_count);
}

Scene *emit_scene(Converter *cv) {
    Emitter *e = ARENA_NEW(cv->arena, Emitter);
    e->cv = cv;
    e->scene = ARENA_NEW(cv->arena, Scene);
    emit_settings(e);
    emit_camera(e);
    emit_gaps(e, cv->nodes->gaps);
    emit_roots(e);
    emit_sky(e);
    emit_fogs(e);
    emit_rainbows(e);
    keep_pools(e);
    if (e->scene->root_count == 0)
        warn("'%s' shows no objects", cv->options->input);
    scene_collect_requires(e->scene, cv->arena);
    scene_validate(e->scene, cv->options->input);
    return e->scene;
}

const Scene *emit_part(Converter *cv, const ObjectNode *object, const PatternNode *pigment,
                       uint32_t *index, const char **gap) {
    Emitter *e = ARENA_NEW(cv->arena, Emitter);
    e->cv = cv;
    e->quiet = true;
    e->scene = ARENA_NEW(cv->arena, Scene);
    emit_settings(e);
    e->scene->camera = camera_default();
    uint32_t root = object ? emit_body(e, object) : NO_INDEX;
    if (root != NO_INDEX)
        array_push(&e->roots, root);
    if (pigment)
        *index = emit_pigment(e, pigment);
    keep_pools(e);
    // A ray of trace() meets all objects.
    for (uint32_t i = 0; i < e->scene->object_count; i++) {
        Object *flags = &e->scene->objects[i];
        flags->no_image = flags->no_reflection = flags->no_shadow = false;
    }
    scene_validate(e->scene, cv->options->input);
    *gap = e->gap;
    return e->scene;
}
