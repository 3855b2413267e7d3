// SPDX-License-Identifier: MIT
#include "render/story.h"

#include "model/scene_fields.h"
#include "patch/qi.h"
#include "patch/quasi.h"
#include "render/camera.h"

#include <math.h>
#include <stdarg.h>

// One line, two blanks deeper for each ray between it and the camera.
__attribute__((format(printf, 3, 4))) static void line(const Story *story, uint32_t depth,
                                                       const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fprintf(story->out, "%*s", (int)(2 * depth), "");
    vfprintf(story->out, format, arguments);
    putc('\n', story->out);
    va_end(arguments);
}

#define VEC "<%.15g, %.15g, %.15g>"
#define XYZ(v) (v).x, (v).y, (v).z
#define RGB "<%.6g, %.6g, %.6g>"
#define PARTS(c) (double)(c).r, (double)(c).g, (double)(c).b

void story_ray(const Story *story, const Path *path, bool continued) {
    const char *kind = path->nesting == 0             ? "camera ray"
                       : continued                    ? "the ray goes on"
                       : path->kind == RAY_REFLECTION ? "reflected ray"
                                                      : "refracted ray";
    line(story, path->nesting, "%s from " VEC " along " VEC ", weight %.3g, level %d", kind,
         XYZ(path->ray.org), XYZ(path->ray.dir), (double)path->weight, path->level);
}

// The nets of the patch over rectangles that close in on (u,v), each a third of the one before in
// both directions, until the bound is below what doubles can tell. That is the way of the paper's
// loop to this hit.
static void put_nets(const Story *story, uint32_t depth, const Bezier *patch, const Ray *ray,
                     const QiHit *hit) {
    enum { MOST = 16 };
    BezierRect rect = bezier_whole();
    double floor_of = qi_rounding(patch, ray->org);
    line(story, depth, "QI nets down to it, each over a third of the one before:");
    line(story, depth, "  %-4s %-23s %-23s %-12s %s", "step", "u", "v", "epsilon",
         "from the ray to the net at (u,v)");
    for (int step = 0; step < MOST; step++) {
        Bezier part, net;
        bezier_restrict(patch, rect, &part);
        quasi_net(&part, &net);
        double u = (hit->u - rect.u0) / (rect.u1 - rect.u0),
               v = (hit->v - rect.v0) / (rect.v1 - rect.v0), epsilon = quasi_deviation(&part);
        Vec3 q =
            vec_sub(quasi_eval(&net, fmin(fmax(u, 0.0), 1.0), fmin(fmax(v, 0.0), 1.0)), ray->org);
        Vec3 across = vec_sub(q, vec_scale(ray->dir, vec_dot(q, ray->dir)));
        line(story, depth, "  %-4d [%-9.7f, %-9.7f]  [%-9.7f, %-9.7f]  %-12.4g %.4g", step, rect.u0,
             rect.u1, rect.v0, rect.v1, epsilon, vec_length(across));
        if (epsilon <= floor_of)
            break;
        double iu = fmin(floor(3.0 * u), 2.0), iv = fmin(floor(3.0 * v), 2.0);
        double du = (rect.u1 - rect.u0) / 3.0, dv = (rect.v1 - rect.v0) / 3.0;
        rect = (BezierRect){rect.u0 + iu * du, rect.u0 + (iu + 1.0) * du, rect.v0 + iv * dv,
                            rect.v0 + (iv + 1.0) * dv};
        rect.u1 = fmin(rect.u1, 1.0), rect.v1 = fmin(rect.v1, 1.0);
    }
}

// The ray in the space of the patch; its depths stay.
static Ray ray_to_patch(const Story *story, const Path *path, const WorldHit *hit) {
    Ray ray = path->ray;
    if (hit->instance == NO_INDEX)
        return ray;
    const Object *instance = &story->scene->objects[hit->instance];
    if (instance->has_transform) {
        ray.org = transform_inv_point(&instance->transform, ray.org);
        ray.dir = transform_inv_dir(&instance->transform, ray.dir);
    }
    return ray;
}

// The patch's own parameters of the hit are asked for again, by the certified method.
static void put_patch(const Story *story, const Path *path, const WorldHit *hit) {
    const Ray ray = ray_to_patch(story, path, hit);
    uint32_t depth = path->nesting + 1;
    const PatchShape *shape = &story->scene->objects[hit->object].shape.patch;
    Bezier patch;
    bezier_init(&patch, (int)shape->degree_u, (int)shape->degree_v, shape->points);
    double diameter = bezier_diameter(&patch);
    line(story, depth, "bound of the error %.3g, %.2g of the patch's diameter", hit->bound,
         diameter > 0.0 ? hit->bound / diameter : 0.0);
    QiQuery query = qi_query_default(&patch, ray);
    double reach = 2.0 * hit->bound + query.tolerance + qi_rounding(&patch, ray.org);
    query.t_min = fmax(hit->t - reach, 0.0), query.t_max = hit->t + reach;
    QiStats stats = {0};
    QiHit again;
    if (!qi_reduce_nearest(&patch, &query, &stats, &again)) {
        line(story, depth, "(POV-Ray's triangles: the patch itself is not met here)");
        return;
    }
    line(story, depth, "u %.15g v %.15g", again.u, again.v);
    put_nets(story, depth, &patch, &ray, &again);
}

void story_hit(const Story *story, const Path *path, const WorldHit *hit, const PatchStats *work) {
    uint32_t depth = path->nesting + 1;
    line(story, depth, "%llu leaf visits, %llu QI steps, %llu Newton steps",
         (unsigned long long)work->patch_tests, (unsigned long long)work->steps,
         (unsigned long long)work->newton);
    if (!hit) {
        line(story, depth, "nothing is met");
        return;
    }
    uint32_t patch = story->patch_of[hit->object];
    if (patch == NO_INDEX)
        line(story, depth, "meets object %u of the scene file: %s", hit->object,
             OBJECT_TYPE_NAMES[story->scene->objects[hit->object].type]);
    else
        line(story, depth, "meets object %u of the scene file, patch %u of %d", hit->object, patch,
             story->patch_count);
    if (hit->instance != NO_INDEX)
        line(story, depth, "where the instance shows it that is object %u", hit->instance);
    line(story, depth, "distance %.15g, point " VEC, hit->t, XYZ(hit->p));
    line(story, depth, "normal " VEC ", texture coordinates %.9g %.9g", XYZ(hit->normal), hit->u,
         hit->v);
    if (patch != NO_INDEX)
        put_patch(story, path, hit);
}

void story_layer(const Story *story, const Path *path, uint32_t index, Color pigment,
                 double opacity, Rgb reflectivity, Rgb light) {
    line(story, path->nesting + 1,
         "layer %u: pigment " RGB " filter %.4g transmit %.4g, opacity %.4g, reflectivity " RGB
         ", light " RGB,
         index, PARTS(pigment), (double)pigment.filter, (double)pigment.transmit, opacity,
         PARTS(reflectivity), PARTS(light));
}

void story_light(const Story *story, const Path *path, uint32_t index, const LightSample *sample,
                 const char *fate, Rgb added) {
    line(story, path->nesting + 2,
         "light %u %s: towards " VEC ", distance %.9g, arrives " RGB ", adds " RGB, index, fate,
         XYZ(sample->dir), sample->distance, PARTS(sample->color), PARTS(added));
}

void story_color(const Story *story, const Path *path, Color color) {
    line(story, path->nesting + 1, "= " RGB " transmit %.4g", PARTS(color), (double)color.transmit);
}

Color story_of_pixel(const Scene *scene, const Shading *shading, int width, int height, int x,
                     int y, FILE *out) {
    Arena *arena = arena_create();
    uint32_t *patch_of = ARENA_ARRAY(arena, uint32_t, scene->object_count), count = 0;
    for (uint32_t i = 0; i < scene->object_count; i++)
        patch_of[i] = scene->objects[i].type == OBJECT_PATCH ? count++ : NO_INDEX;
    Story story = {out, scene, patch_of, (int)count};
    Tracer *tracer = tracer_create(shading);
    tracer->story = &story;
    const CameraView view = camera_view(&scene->camera, shading->textures, width, height);
    Color color = {.transmit = 1.0f};
    Ray ray;
    fprintf(out, "pixel (%d, %d) of %d x %d, through its middle\n", x, y, width, height);
    if (camera_ray(&view, x, y, &ray))
        color = tracer_trace(tracer, &ray);
    else
        fprintf(out, "the camera sees nothing here\n");
    tracer_destroy(tracer);
    arena_destroy(arena);
    return color;
}
