// SPDX-License-Identifier: MIT
#include "render/aov.h"

#include "render/camera.h"

#include <math.h>

enum { MOST_CHANNELS = 4 + 12 };

// ORDER aov
static const char *const channel_names[AOV_COUNT][4] = {
    {"Z"},
    {"N.X", "N.Y", "N.Z"},
    {"uv.U", "uv.V"},
    {"patch"},
    {"steps.leaf", "steps.qi", "steps.newton"},
    {"bound"},
    {"object"},
};

// One pixel's ray and what became of it.
typedef struct {
    bool met;
    WorldHit hit;
    RayStats stats;
    uint32_t patch;
} Look;

static float *put_kind(float *out, AovKind kind, const Look *look) {
    const WorldHit *hit = &look->hit;
    const PatchStats *work = &look->stats.patch;
    switch (kind) {
    case AOV_DEPTH:
        *out++ = look->met ? (float)hit->t : INFINITY;
        break;
    case AOV_NORMAL:
        *out++ = (float)hit->normal.x;
        *out++ = (float)hit->normal.y;
        *out++ = (float)hit->normal.z;
        break;
    case AOV_UV:
        *out++ = (float)hit->u;
        *out++ = (float)hit->v;
        break;
    case AOV_PATCH:
        *out++ = look->patch == NO_INDEX ? -1.0f : (float)look->patch;
        break;
    case AOV_STEPS:
        *out++ = (float)work->patch_tests;
        *out++ = (float)work->steps;
        *out++ = (float)work->newton;
        break;
    case AOV_BOUND:
        *out++ = (float)hit->bound;
        break;
    case AOV_OBJECT:
        *out++ = look->met ? (float)hit->object : -1.0f;
        break;
    case AOV_COUNT:
        break;
    }
    return out;
}

// For each object its number among the patches, or NO_INDEX.
static uint32_t *number_patches(const Scene *scene, Arena *arena) {
    uint32_t *number = ARENA_ARRAY(arena, uint32_t, scene->object_count), next = 0;
    for (uint32_t i = 0; i < scene->object_count; i++)
        number[i] = scene->objects[i].type == OBJECT_PATCH ? next++ : NO_INDEX;
    return number;
}

ImageLayers *aov_render(const Scene *scene, const World *world, const CameraView *view,
                        const RenderOptions *o, const Color *picture, Arena *arena) {
    const char **names = ARENA_ARRAY(arena, const char *, MOST_CHANNELS);
    static const char *const colors[] = {"R", "G", "B", "A"};
    int channels = o->alpha ? 4 : 3;
    for (int i = 0; i < channels; i++)
        names[i] = colors[i];
    for (int kind = 0; kind < AOV_COUNT; kind++)
        for (int i = 0; o->aovs >> kind & 1u && i < 4 && channel_names[kind][i]; i++)
            names[channels++] = channel_names[kind][i];

    ImageLayers *layers = ARENA_NEW(arena, ImageLayers);
    *layers = (ImageLayers){o->width, o->height, channels, names, NULL};
    size_t width = (size_t)o->width, count = width * (size_t)o->height;
    layers->pixels = ARENA_ARRAY(arena, float, count *(size_t)channels);
    const uint32_t *patch_of = number_patches(scene, arena);
    PixelRect area = render_area(o);
#pragma omp parallel for schedule(dynamic, 1)
    for (int y = area.top; y < area.bottom; y++)
        for (int x = area.left; x < area.right; x++) {
            size_t at = (size_t)y * width + (size_t)x;
            float *out = layers->pixels + at * (size_t)channels;
            const Color *color = &picture[at];
            *out++ = color->r;
            *out++ = color->g;
            *out++ = color->b;
            if (o->alpha)
                *out++ = 1.0f - color->transmit;
            Ray ray;
            Look look = {.patch = NO_INDEX};
            look.met =
                camera_ray(view, x, y, &ray) &&
                world_intersect(world, &ray, 0.0, INFINITY, RAY_CAMERA, &look.stats, &look.hit);
            if (look.met)
                look.patch = patch_of[look.hit.object];
            for (int kind = 0; kind < AOV_COUNT; kind++)
                if (o->aovs >> kind & 1u)
                    out = put_kind(out, (AovKind)kind, &look);
        }
    return layers;
}
