// SPDX-License-Identifier: MIT
// What lies between a surface and a light (facts: rendering 4.7): surface by surface until one is
// opaque or the light is reached. Where everything is opaque one any-hit query answers.
//
// POV-Ray also remembers, per thread and light, the last opaque blocker, and tries that first with
// smaller margins. It changes only pixels with geometry closer than SHADE_SHADOW_TOL to a surface,
// and makes them depend on the pixels before; we leave it out.
#include "render/shading.h"

#include "texture/pigment.h"

#include <float.h>
#include <math.h>

// POV-Ray takes depths > SHADE_SHADOW_TOL; our queries take t >= t_min: the next number.
static const double SHADOW_T_MIN = SHADE_SHADOW_TOL * (1.0 + DBL_EPSILON);

static double shadow_tolerance(const Shading *shading) {
    return SHADE_SHADOW_TOL * world_unit(shading->world);
}

// The bodies that swallow light and that the shadow ray has crossed an odd number of times: it is
// inside those and those of the surface's own ray, but not inside both. Only fading and fog need
// it.
typedef struct {
    uint32_t bodies[64]; // more of them around each other: the innermost do not count
    uint32_t count;
} Crossed;

static bool has_crossed(const Crossed *crossed, uint32_t body) {
    for (uint32_t i = 0; i < crossed->count; i++)
        if (crossed->bodies[i] == body)
            return true;
    return false;
}

static void cross(Crossed *crossed, uint32_t body) {
    for (uint32_t i = 0; i < crossed->count; i++)
        if (crossed->bodies[i] == body) {
            crossed->bodies[i] = crossed->bodies[--crossed->count];
            return;
        }
    if (crossed->count < sizeof crossed->bodies / sizeof crossed->bodies[0])
        crossed->bodies[crossed->count++] = body;
}

typedef struct {
    const Shading *shading;
    Vec3 dir, normal; // the ray's; the surface's, turned against it
    float caustics;
    TextureHit *at;
    TextureSpaces *spaces;
} Filter;

// What one stack of layers lets through at p, as a colour that filters all of it.
static Color layers_filter(const Filter *f, const Texture *texture, Vec3 p) {
    const Textures *textures = f->shading->textures;
    Rgb through = rgb(1.0f, 1.0f, 1.0f);
    for (uint32_t i = 0; i < texture->layer_count; i++) {
        const Layer *layer = &texture->layers[i];
        Color c;
        if (pigment_color(textures, layer->pigment, f->at, p, &c))
            through = rgb_mul(through, color_through(c));
        if (f->caustics == 0.0f)
            continue;
        Vec3 normal = f->normal;
        if (f->shading->quality.normals)
            normal = texture_normal(textures, layer, f->spaces, f->at, p, normal);
        through = rgb_scale(through, 1.0 + pow(fabs(vec_dot(normal, f->dir)), f->caustics));
    }
    return (Color){through.r, through.g, through.b, 1.0f, 0.0f};
}

static Color texture_filter(const Filter *f, uint32_t index, Vec3 p) {
    TextureChoice choice = texture_choose(f->shading->textures, index, f->spaces, f->at, p);
    if (choice.layers != NULL)
        return layers_filter(f, choice.layers, choice.p);
    if (choice.average) {
        TextureMean mean = {0};
        for (uint32_t i = choice.first; i < choice.second; i++)
            mean = texture_mean(mean, choice.entries[i].value,
                                texture_filter(f, choice.entries[i].index, choice.p));
        return texture_mean_color(mean);
    }
    Color first = texture_filter(f, choice.entries[choice.first].index, choice.p);
    if (choice.first == choice.second)
        return first;
    return texture_mix(choice.share, first,
                       texture_filter(f, choice.entries[choice.second].index, choice.p));
}

// A shadow ray on its way.
typedef struct {
    const Shading *shading;
    const Light *light;
    Ray ray;
    WorldNear near;
    const InteriorList *inside;
    Crossed crossed;
} Way;

// Member by member: an initializer would clear the list of bodies for every ray.
static void way_begin(Way *way, const Shading *shading, uint32_t light, Ray ray,
                      const InteriorList *inside) {
    way->shading = shading;
    way->light = &shading->scene->lights[light];
    way->ray = ray;
    way->inside = inside;
    way->crossed.count = 0;
}

static bool is_inside(const Way *way, uint32_t body) {
    return interior_inside(way->inside, body) != has_crossed(&way->crossed, body);
}

// Are all bodies hollow that the ray is in?
static bool is_in_air(const Way *way) {
    const bool *hollow = way->shading->hollow;
    for (const InteriorList *node = way->inside; node != NULL; node = node->outer)
        if (!hollow[node->body] && is_inside(way, node->body))
            return false;
    for (uint32_t i = 0; i < way->crossed.count; i++)
        if (!hollow[way->crossed.bodies[i]] && is_inside(way, way->crossed.bodies[i]))
            return false;
    return true;
}

static void add_fog(const Way *way, double depth, Rgb *color) {
    const Shading *shading = way->shading;
    if (way->light->media_attenuation && shading->scene->fog_count > 0 && shading->quality.air &&
        is_in_air(way))
        *color = fog_dim(shading, &way->ray, depth, *color);
}

// The same for the parts of an object that share the hit.
static Color textures_filter(const Filter *f, const ShapeTexture *textures, uint32_t count,
                             Vec3 p) {
    if (count == 1)
        return texture_filter(f, textures[0].texture, p);
    Color sum = {0};
    for (uint32_t i = 0; i < count; i++) {
        if (textures[i].texture == NO_INDEX)
            continue;
        Rgb through = color_through(texture_filter(f, textures[i].texture, p));
        sum.r += textures[i].weight * through.r;
        sum.g += textures[i].weight * through.g;
        sum.b += textures[i].weight * through.b;
    }
    sum.filter = 1.0f;
    return sum;
}

// What the surface at hit lets through; false when nothing.
static bool surface_filter(Way *way, WorldHit *hit, Rgb *color) {
    const Shading *shading = way->shading;
    const Ray *ray = &way->ray;
    if (hit_is_opaque(shading, hit))
        return false;
    const Object *object = &shading->scene->objects[hit->object];
    double cosine = vec_dot(hit->normal, ray->dir);
    hit_find_textures(shading->scene, hit, cosine);
    if (hit->texture_count == 1 && hit->textures[0].texture == NO_INDEX)
        return false;

    uint32_t body = hit_body(shading, hit->object, hit->instance);
    const Interior *interior = body_interior(shading->scene, body);
    Vec3 normal = cosine > 0.0 ? vec_neg(hit->normal) : hit->normal;
    TextureHit at = {hit->p, ray->dir, hit->u, hit->v, normal, shading->quality.quick_color};
    TextureSpaces spaces;
    spaces.count = 0;
    Filter f = {shading, ray->dir, normal, interior != NULL ? interior->caustics : 0.0f,
                &at,     &spaces};
    Vec3 p = object->uv_mapping ? vec3(hit->u, hit->v, 0.0) : hit->p;
    Rgb through = color_through(textures_filter(&f, hit->textures, hit->texture_count, p));
    bool fades = interior != NULL && interior->fade_power > 0.0f;
    if (fades && is_inside(way, body))
        through = rgb_mul(through, refract_fade(interior, hit->t));
    *color = rgb_mul(*color, through);
    add_fog(way, hit->t, color);
    if (fades || way->light->media_attenuation)
        cross(&way->crossed, body);
    return true;
}

// How far before the light the object ends that it shines through: nothing there throws a shadow.
// False: the ray misses it, or it lies behind the light.
static bool find_projection(Tracer *tracer, uint32_t light, const Ray *ray, double distance,
                            double *before) {
    const World *world = tracer->shading->projections[light];
    WorldHit hit;
    *before = 0.0;
    if (world == NULL)
        return true;
    if (!world_intersect(world, ray, SHADE_MIN_DEPTH, distance, RAY_ALL, &tracer->stats, &hit))
        return false;
    *before = distance - hit.t + shadow_tolerance(tracer->shading);
    return true;
}

// From surface to surface; what is left of the distance.
static double follow(Tracer *tracer, Way *way, double distance, double before,
                     const WorldForeseen *foreseen, Rgb *color) {
    const World *world = way->shading->world;
    const Rgb black = {0};
    if (way->shading->all_opaque) {
        if (world_blocked_foreseen(world, &way->ray, way->near, distance - before, foreseen,
                                   &tracer->blockers[way->light - way->shading->scene->lights],
                                   &tracer->stats))
            *color = black;
        return distance;
    }
    WorldHit hit;
    for (; world_nearest_foreseen(world, &way->ray, way->near, distance - before, RAY_SHADOW,
                                  foreseen, &tracer->stats, &hit);
         foreseen = NULL) {
        if (!surface_filter(way, &hit, color)) {
            *color = black;
            break;
        }
        distance -= hit.t;
        way->ray.org = hit.p;
        way->near = world_near(world, &hit, way->ray.dir, SHADOW_T_MIN);
    }
    return distance;
}

static double filter_by_objects(Tracer *tracer, Way *way, uint32_t light, double distance,
                                const WorldForeseen *foreseen, Rgb *color) {
    double before;
    tracer->stats.shadow++;
    if (!find_projection(tracer, light, &way->ray, distance, &before))
        *color = (Rgb){0};
    else if (!way->light->shadowless)
        return follow(tracer, way, distance, fmax(before, shadow_tolerance(way->shading)), foreseen,
                      color);
    return distance;
}

static void fog_the_rest(const Way *way, double distance, Rgb *color) {
    if (distance > shadow_tolerance(way->shading))
        add_fog(way, distance, color);
}

double shadow_limit(const Shading *shading, double distance) {
    return distance - shadow_tolerance(shading);
}

WorldNear shadow_near(const Shading *shading, const WorldHit *from, Vec3 dir) {
    return world_near(shading->world, from, dir, SHADOW_T_MIN);
}

void shadow_filter(Tracer *tracer, uint32_t light, const WorldHit *from, LightSample *s,
                   const InteriorList *inside) {
    const Shading *shading = tracer->shading;
    Ray ray = {from->p, s->dir};
    WorldNear near = s->foreseen ? s->near : shadow_near(shading, from, s->dir);
    // One question, as a rule.
    if (shading->all_opaque && shading->projections[light] == NULL &&
        shading->scene->fog_count == 0) {
        tracer->stats.shadow++;
        if (world_blocked_foreseen(shading->world, &ray, near, shadow_limit(shading, s->distance),
                                   s->foreseen, &tracer->blockers[light], &tracer->stats))
            s->color = (Rgb){0};
        return;
    }
    Way way;
    way_begin(&way, shading, light, ray, inside);
    way.near = near;
    double left = filter_by_objects(tracer, &way, light, s->distance, s->foreseen, &s->color);
    fog_the_rest(&way, left, &s->color);
}

double shadow_filter_point(Tracer *tracer, uint32_t light, const WorldHit *from, Vec3 dir,
                           double distance, const InteriorList *inside, Rgb *color) {
    Way way;
    way_begin(&way, tracer->shading, light, (Ray){from->p, dir}, inside);
    way.near = shadow_near(tracer->shading, from, dir);
    return filter_by_objects(tracer, &way, light, distance, NULL, color);
}

void shadow_fog(const Shading *shading, uint32_t light, Ray ray, double distance,
                const InteriorList *inside, Rgb *color) {
    Way way;
    way_begin(&way, shading, light, ray, inside);
    fog_the_rest(&way, distance, color);
}
