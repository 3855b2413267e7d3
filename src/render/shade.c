// SPDX-License-Identifier: MIT
// A hit becomes a colour (facts: rendering 4.2, 4.3, 4.6): the texture's layers from the top, each
// with its ambient, emission and lights, as long as something shines through; then what is seen
// through all of them; then what each layer reflects.
#include "render/shading.h"
#include "render/story.h"

#include "texture/pigment.h"

#include <math.h>

// What the layers leave for the rest of the hit.
typedef struct {
    Rgb color;   // their own light
    Rgb through; // the product of what they let through
    double translucency;
    bool found;          // some layer had a colour here
    uint32_t count;      // done so far
    Vec3 normal;         // of the top one
    uint32_t first, end; // their reflections on the tracer's stack
} Layers;

// How bright a layer's own colour is next to what it lets through. The older form is kept by
// POV-Ray for older scenes.
static double opacity(const Shading *shading, Color c) {
    if (!shading->legacy)
        return (float)(1.0 - c.filter - c.transmit);
    float m = c.r > c.g ? c.r : c.g;
    m = m > c.b ? m : c.b;
    return 1.0 - (c.filter * m + c.transmit);
}

static inline Rgb layer_light(Tracer *tracer, const LitLayer *layer) {
    const Finish *finish = layer->finish;
    Rgb ambient = rgb_mul(rgb_mul(layer->color, finish->ambient),
                          tracer->shading->scene->settings.ambient_light);
    Rgb sum = rgb_scale(ambient, layer->opacity);
    sum = rgb_add(sum, rgb_scale(rgb_mul(layer->color, finish->emission), layer->opacity));
    lights_add(tracer, layer, &sum);
    return sum;
}

static Rgb conserve_energy(Rgb through, Rgb reflectivity) {
    double r = 1.0 - reflectivity.r, g = 1.0 - reflectivity.g, b = 1.0 - reflectivity.b;
    return rgb_mul(through, rgb((float)(r < 1.0 ? r : 1.0), (float)(g < 1.0 ? g : 1.0),
                                (float)(b < 1.0 ? b : 1.0)));
}

// What the layer reflects is traced when all layers are done.
static Rgb add_reflection(Tracer *tracer, const Surface *surface, const LitLayer *layer,
                          Layers *layers) {
    LayerReflection *reflection = &tracer->reflections[layers->end];
    reflection->weight = surface->path->weight * layers->translucency;
    reflect_layer(tracer->shading, surface, layer->finish, layer->normal, layer->color, reflection);
    if (!rgb_is_black(reflection->reflectivity))
        layers->end++;
    return reflection->reflectivity;
}

static void shade_layer(Tracer *tracer, const Surface *surface, const Layer *layer, Vec3 p,
                        Layers *layers) {
    const Shading *shading = tracer->shading;
    Vec3 normal = surface->normal;
    if (layer->normal != NO_INDEX && shading->quality.normals)
        normal = texture_normal(shading->textures, layer, surface->spaces, surface->at, p, normal);
    uint32_t index = layers->count++;
    if (index == 0)
        layers->normal = normal;
    Color c = {0};
    bool found = pigment_color(shading->textures, layer->pigment, surface->at, p, &c);
    layers->found |= found;
    Rgb reflectivity = {0};
    if (shading->quality.ambient_only) {
        layers->color = color_rgb(c);
    } else {
        LitLayer lit = {surface, &layer->finish, normal, color_rgb(c), opacity(shading, c)};
        if (finish_reflects(lit.finish))
            reflectivity = add_reflection(tracer, surface, &lit, layers);
        Rgb light = layer_light(tracer, &lit);
        if (tracer->story)
            story_layer(tracer->story, surface->path, index, c, lit.opacity, reflectivity, light);
        layers->color = rgb_add(layers->color, rgb_mul(light, layers->through));
    }
    if (found) {
        layers->through = rgb_mul(layers->through, color_through(c));
        if (layer->finish.conserve_energy)
            layers->through = conserve_energy(layers->through, reflectivity);
    }
    double grey = fabsf(rgb_grey(layers->through));
    layers->translucency = grey < 1.0 ? grey : 1.0;
}

static void shade_layers(Tracer *tracer, const Surface *surface, const Texture *texture, Vec3 p,
                         Layers *layers) {
    double bailout = tracer->shading->scene->settings.adc_bailout;
    *layers = (Layers){.through = {1.0f, 1.0f, 1.0f}, .translucency = 1.0};
    layers->first = layers->end = tracer->reflection_top;
    // Rays that a texture before in the same map has sent on had hits of their own to light.
    if (tracer->lights_hit != surface->number)
        lights_reset(tracer, surface->hit);
    tracer->lights_hit = surface->number;
    for (uint32_t i = 0; i < texture->layer_count && layers->translucency > bailout; i++)
        shade_layer(tracer, surface, &texture->layers[i], p, layers);
}

// Adds what is seen through the surface, with the top layer's finish; returns whether it was
// totally reflected instead.
static bool add_transmitted(Tracer *tracer, const Surface *surface, const Finish *finish,
                            const Layers *layers, Color *color) {
    const Path *path = surface->path;
    Rgb through = layers->through;
    double high = fmax(fabs(through.r), fmax(fabs(through.g), fabs(through.b)));
    Color seen;
    bool total =
        refract_trace(tracer, surface, finish, layers->normal, (float)(path->weight * high), &seen);
    Rgb fade = rgb(1.0f, 1.0f, 1.0f);
    const Interior *interior = body_interior(tracer->shading->scene, surface->body);
    if (interior != NULL) {
        fade = rgb_scale(fade, interior->refraction);
        if (interior_inside(path->inside, surface->body))
            fade = rgb_mul(fade, refract_fade(interior, surface->hit->t));
    }
    Rgb light = rgb_mul(fade, color_rgb(seen));
    if (!total) {
        color->transmit = rgb_grey(fade) * seen.transmit;
        if (layers->found) {
            light = rgb_mul(light, through);
            color->transmit = (float)(color->transmit * layers->translucency);
        }
    }
    color->r += light.r, color->g += light.g, color->b += light.b;
    return total;
}

static void add_reflected(Tracer *tracer, const Surface *surface, const Layers *layers, bool total,
                          Color *color) {
    for (uint32_t i = layers->first; i < layers->end; i++) {
        const LayerReflection *reflection = &tracer->reflections[i];
        Vec3 d = vec_sub(layers->normal, reflection->normal);
        if (total && fabs(d.x) <= SHADE_EPS && fabs(d.y) <= SHADE_EPS && fabs(d.z) <= SHADE_EPS)
            continue; // the total reflection has already shown it
        Rgb seen = reflect_trace(tracer, surface, reflection);
        if (reflection->finish->reflection_exponent != 1.0f) {
            float e = (float)(1.0 / reflection->finish->reflection_exponent);
            seen = rgb(powf(seen.r, e), powf(seen.g, e), powf(seen.b, e));
        }
        Rgb light = rgb_mul(reflection->reflectivity, seen);
        color->r += light.r, color->g += light.g, color->b += light.b;
    }
}

static void shade_plain(Tracer *tracer, const Surface *surface, const Texture *texture, Vec3 p,
                        Color *color) {
    const Shading *shading = tracer->shading;
    Layers layers;
    shade_layers(tracer, surface, texture, p, &layers);
    tracer->reflection_top = layers.end;
    *color = (Color){layers.color.r, layers.color.g, layers.color.b, 0.0f, 0.0f};
    bool total = false;
    if (layers.translucency > shading->scene->settings.adc_bailout && shading->quality.refraction)
        total = add_transmitted(tracer, surface, &texture->layers[0].finish, &layers, color);
    if (shading->quality.reflection)
        add_reflected(tracer, surface, &layers, total, color);
    tracer->reflection_top = layers.first;
}

// Textures in a map are shaded to the end, reflections and all, and the colours are mixed.
static void shade_texture(Tracer *tracer, const Surface *surface, uint32_t index, Vec3 p,
                          Color *color) {
    const Texture *texture = &tracer->shading->scene->textures[index];
    if (texture_is_plain(texture)) {
        shade_plain(tracer, surface, texture, p, color);
        return;
    }
    TextureChoice choice =
        texture_choose(tracer->shading->textures, index, surface->spaces, surface->at, p);
    if (choice.layers != NULL) {
        shade_plain(tracer, surface, choice.layers, choice.p, color);
        return;
    }
    if (choice.average) {
        TextureMean mean = {0};
        for (uint32_t i = choice.first; i < choice.second; i++) {
            Color c;
            shade_texture(tracer, surface, choice.entries[i].index, choice.p, &c);
            mean = texture_mean(mean, choice.entries[i].value, c);
        }
        *color = texture_mean_color(mean);
        return;
    }
    shade_texture(tracer, surface, choice.entries[choice.first].index, choice.p, color);
    if (choice.first == choice.second)
        return;
    Color second;
    shade_texture(tracer, surface, choice.entries[choice.second].index, choice.p, &second);
    *color = texture_mix(choice.share, *color, second);
}

// Parts of an object side by side in one hit; what weighs next to nothing is left out.
static void shade_textures(Tracer *tracer, const Surface *surface, const ShapeTexture *textures,
                           uint32_t count, Vec3 p, Color *color) {
    if (count == 1) {
        shade_texture(tracer, surface, textures[0].texture, p, color);
        return;
    }
    Color sum = {0};
    for (uint32_t i = 0; i < count; i++) {
        float w = textures[i].weight;
        if (textures[i].texture == NO_INDEX || w < tracer->shading->scene->settings.adc_bailout)
            continue;
        Color c;
        shade_texture(tracer, surface, textures[i].texture, p, &c);
        sum.r += w * c.r, sum.g += w * c.g, sum.b += w * c.b;
        sum.filter += w * c.filter, sum.transmit += w * c.transmit;
    }
    *color = sum;
}

void shade_hit(Tracer *tracer, const Path *path, WorldHit *hit, Color *color) {
    const Shading *shading = tracer->shading;
    const Object *object = &shading->scene->objects[hit->object];
    double cosine = vec_dot(hit->normal, path->ray.dir);
    hit_find_textures(shading->scene, hit, cosine);
    if (hit->texture_count == 1 && hit->textures[0].texture == NO_INDEX) {
        *color = (Color){0}; // the built-in texture is black and opaque under any light
        return;
    }
    Vec3 normal = cosine > 0.0 ? vec_neg(hit->normal) : hit->normal;
    TextureHit at = {hit->p, path->ray.dir, hit->u, hit->v, normal, shading->quality.quick_color};
    TextureSpaces spaces;
    spaces.count = 0;
    Surface surface = {
        .path = path,
        .hit = hit,
        .normal = normal,
        .body = hit_body(shading, hit->object, hit->instance),
        .double_illuminate = object->double_illuminate,
        .number = ++tracer->hits,
        .at = &at,
        .spaces = &spaces,
    };
    shade_textures(tracer, &surface, hit->textures, hit->texture_count,
                   object->uv_mapping ? vec3(hit->u, hit->v, 0.0) : hit->p, color);
}
