// SPDX-License-Identifier: MIT
// What the files of the shading share (trace.h is their contract with the rest):
//   tracer.c      one ray: nearest hit, shade or sky; start and end of a camera ray
//   ahead.c       camera rays of neighbouring pixels, and the light rays of their hits, in packets
//   shade.c       a hit: its layers, then what is seen through it and in it
//   finish.c      diffuse, phong, specular, metallic, iridescence: one light on one layer
//   light.c       light rays and the sum over the lights
//   light_area.c  the same for lights that have a size
//   shadow.c      what is between the hit and a light
//   reflect.c     reflectivity and the reflected direction
//   interior.c    the list of bodies a ray is in
//   refract.c     the refracted direction, fading
//   dispersion.c  the colours that refraction takes apart
//   atmosphere.c  what a ray sees that hits nothing
//   fog.c rainbow.c  what lies before anything that a ray sees
#ifndef RENDER_SHADING_H
#define RENDER_SHADING_H

#include "render/interior.h"
#include "render/trace.h"
#include "texture/texture.h"

// POV-Ray's constants (facts: rendering 0.2).
#define SHADE_EPS 1e-10       // near zero: a light that is black, a surface edge-on, ratios of 1
#define SHADE_MIN_DEPTH 1e-4  // a hit nearer than this is ignored, whatever the ray is for
#define SHADE_FAR 2e10        // the depth of what is not hit
#define SHADE_SHADOW_TOL 1e-3 // shadow rays: nearer to the surface, or to the light, is no shadow

// +Q: what is left out below 9.
typedef struct {
    bool ambient_only, quick_color, shadows, area_lights, refraction, reflection, air, normals;
} Quality;

typedef struct {
    uint32_t body;
    bool opaque; // a shadow ray ends here without looking at the texture
    bool lit;    // lights may matter to it
    bool mirror; // it reflects, and its normals are those of the shape
} ObjectInfo;

// What is known of a light before there is a surface.
typedef struct {
    Vec3 travel;            // unit, from location to point_at; not of a point light
    double radius, falloff; // spot: cosines; cylinder: lengths
} LightAxis;

// Of a rainbow, in radians: where it starts from its direction, how wide it is; where its arc ends
// and begins to fade.
typedef struct {
    double start, width, arc, falloff;
} BowAngles;

enum { DISPERSION_HUES = 74 }; // one every 5 nm

struct Shading {
    const Scene *scene;
    const World *world;
    Textures *textures;
    World **bodies; // one per projection of the scene that a pattern looks into
    TraceOptions options;
    Quality quality;
    bool legacy;          // effective version < 3.7: other formulas for opacity and sky
    bool all_opaque;      // everything that throws a shadow has ObjectInfo.opaque
    uint32_t layer_limit; // layers in the largest texture
    ObjectInfo *objects;  // one per scene object
    bool *hollow;         // one per body: fog goes on inside
    LightAxis *axes;      // one per light
    World **projections;  // one per light: what it shines through, or NULL
    bool groups;          // some light does not shine on everything
    bool grainy;          // crand or a jitter draws random numbers
    BowAngles *bows;      // one per rainbow
    Rgb hues[DISPERSION_HUES];
    size_t grid_limit; // points in the largest area light
    Vec2 **places;     // one per light: its points, in shares of its axes; NULL where they jitter
    Arena *arena;
};

// A ray on its way: what its parent hands down.
typedef struct {
    Ray ray;
    const WorldHit *from; // where it starts; NULL: at the camera
    const InteriorList *inside;
    float weight;     // how much of the pixel it can still change; below adc_bailout it is black
    int level;        // counts up to max_trace_level; passing straight through costs none
    uint32_t nesting; // rays between this and the camera ray, of whatever kind
    RayKind kind;
    const WorldForeseen *foreseen; // what the ray meets of the patches; NULL: unknown
    bool alpha;                    // the background is transparent to this ray
    float wavelength;              // in nm, of a ray that dispersion has split off; 0: all of them
} Path;

// A light seen from the current hit: worked out once and kept for all layers.
typedef struct {
    Vec3 dir; // unit, towards the light
    double distance;
    Rgb color; // attenuated; after shadow_done also by what lies between
    double attenuation;
    bool ready, shadow_done;
    const WorldForeseen *foreseen; // what the ray to it meets of the patches; NULL: unknown
    WorldNear near;                // from where on; of those that are foreseen
} LightSample;

// A layer's reflection, kept until the layers are all done.
typedef struct {
    double weight;
    Vec3 normal;
    Rgb reflectivity;
    const Finish *finish;
} LayerReflection;

static inline bool rgb_is_black(Rgb c) { return c.r == 0.0f && c.g == 0.0f && c.b == 0.0f; }
static inline bool finish_reflects(const Finish *finish) {
    return !rgb_is_black(finish->reflection_max) || !rgb_is_black(finish->reflection_min);
}

// A camera ray that has been looked at before it is traced: what it meets, and what the ray along
// mirror_dir meets of the patches.
typedef struct {
    bool met, mirrors;
    WorldHit hit;
    Vec3 mirror_dir;
    WorldForeseen mirror;
} AheadHit;

enum { AHEAD_LIGHTS = 8 }; // scenes with more look at none

typedef struct {
    const Ray *rays; // of the sampler, in the order in which they come
    size_t count, next, room;
    WorldForeseen *patches;
    AheadHit *hits;
    uint32_t light_count;  // of each ray:
    LightSample *lights;   // those that are not ready have not been looked at
    WorldForeseen *shades; // what they mean by foreseen
} Ahead;

typedef struct Story Story; // story.h

struct Tracer {
    const Shading *shading;
    RayStats stats;
    uint32_t crand;       // state of the generator, from the camera ray's bits
    uint32_t area_jitter; // the same for points of area lights
    uint32_t bow_jitter;  // and of rainbows
    LightSample *lights;  // one per light, for the hit being shaded: own_lights or ahead's
    LightSample *own_lights;
    uint32_t *blockers;           // one per light: what was before it last (world_blocked)
    uint64_t hits, lights_hit;    // shaded so far; the number of the one that lights is for
    Rgb *grid;                    // light_area.c: what is known of the area light at hand
    LayerReflection *reflections; // a stack; each hit under way holds a piece of it
    uint32_t reflection_top;      // pieces in use
    Ahead ahead;
    Vec3 start; // where the last camera ray began
    bool start_known;
    InteriorList start_nodes[32]; // bodies around it, POV-Ray's list is as long as it needs
    const InteriorList *start_list;
    const Story *story; // NULL but for --pixel
    Arena *arena;
};

// A hit with its surroundings, shared by the layers.
typedef struct {
    const Path *path;
    const WorldHit *hit;
    Vec3 normal; // of unit length, turned against the ray
    uint32_t body;
    bool double_illuminate;
    uint64_t number;       // of the hit
    TextureHit *at;        // what the textures see of it
    TextureSpaces *spaces; // those that are around the texture at hand
} Surface;

// One layer under the lights.
typedef struct {
    const Surface *surface;
    const Finish *finish;
    Vec3 normal; // perturbed
    Rgb color;
    double opacity; // the layer's own brightness is scaled by this
} LitLayer;

// Colours go through pointers: what a call has just written number by number and hands back as a
// whole is read again before it is in the cache, and waits there.

// tracer.c: the colour that comes along path->ray. continued: a ray passed straight through.
// path is as it was afterwards.
void trace_path(Tracer *tracer, Path *path, bool continued, Color *seen);

// The next number in [0, 1] of POV-Ray's generator for crand.
double tracer_random(uint32_t *state);

// ahead.c: the hit that is known of the camera ray that is about to be traced; NULL: nothing is.
AheadHit *ahead_take(Tracer *tracer, const Ray *ray);
// The lights as they are for that hit; NULL: nothing is known of it.
LightSample *ahead_lights(const Tracer *tracer, const WorldHit *hit);
// What a reflection from that hit meets of the patches; NULL: unknown.
const WorldForeseen *ahead_mirror(const Tracer *tracer, const WorldHit *hit, Vec3 dir);

// shade.c
// The hit's list of textures becomes that of hit_find_textures().
void shade_hit(Tracer *tracer, const Path *path, WorldHit *hit, Color *color);
// hit_texture.c
// Puts in the hit's list the textures that it shows on that side, as they are where an instance
// shows them: at least one. In place, since rays nest in the hits of others.
void hit_find_other_textures(const Scene *scene, WorldHit *hit, double normal_dot_dir);
static inline uint32_t hit_own_texture(const Object *object, double normal_dot_dir) {
    bool inside = normal_dot_dir > 0.0 && object->interior_texture != NO_INDEX;
    return inside ? object->interior_texture : object->texture;
}
static inline void hit_find_textures(const Scene *scene, WorldHit *hit, double normal_dot_dir) {
    if (hit->texture_count > 0 || hit->instance != NO_INDEX) {
        hit_find_other_textures(scene, hit, normal_dot_dir);
        return;
    }
    uint32_t own = hit_own_texture(&scene->objects[hit->object], normal_dot_dir);
    hit->textures[0] = (ShapeTexture){own, 1.0f};
    hit->texture_count = 1;
}
// Of a hit: its body; and whether a shadow ray ends there without looking at the texture.
static inline uint32_t hit_body(const Shading *shading, uint32_t object, uint32_t instance) {
    return instance == NO_INDEX ? shading->objects[object].body
                                : body_of(shading->scene, object, instance);
}
static inline bool hit_is_opaque(const Shading *shading, const WorldHit *hit) {
    return shading->objects[hit->object].opaque &&
           (hit->instance == NO_INDEX || shading->objects[hit->instance].opaque);
}
bool surface_is_lit(const Scene *scene, const Object *object);  // by some light, perhaps
bool surface_mirrors(const Scene *scene, const Object *object); // and nothing bends its normal
bool surface_is_opaque(const Textures *textures, const Object *object); // on both sides, everywhere

// light.c: adds what the lights give to a layer.
void lights_add(Tracer *tracer, const LitLayer *layer, Rgb *color);
// Does it take light from lights?
static inline bool finish_is_lit(const Finish *finish) {
    return finish->diffuse != 0.0f || finish->diffuse_back != 0.0f || finish->specular != 0.0f ||
           finish->phong != 0.0f;
}
void lights_reset(Tracer *tracer, const WorldHit *hit); // a new hit is being shaded

// Is there something to ask between a surface and the light itself?
bool light_has_shadow(const Shading *shading, uint32_t index);
// What arrives of a light at p when nothing is between: from its location moved by offset.
void light_sample(const Shading *shading, uint32_t index, Vec3 p, Vec3 offset, LightSample *s);
// Only its direction and distance; false where they are the same point.
bool light_aim(const Shading *shading, uint32_t index, Vec3 p, Vec3 offset, LightSample *sample);
static inline bool light_is_black(const Rgb *c) {
    return fabsf(c->r) < SHADE_EPS && fabsf(c->g) < SHADE_EPS && fabsf(c->b) < SHADE_EPS;
}
// Is it behind the surface? False also where that does not matter. *dark: then nothing is lit.
bool light_behind(const LitLayer *layer, Vec3 dir, bool *dark);

// light_area.c
// The points of an area light before any jitter; NULL: it has some.
Vec2 *area_places(const AreaLight *area, Arena *arena);
// Replaces sample->color by the mean over the grid of what the shadows leave of it.
void area_shadow(Tracer *tracer, const Surface *surface, uint32_t index, LightSample *sample);
// area_illumination: the layer under each point of the grid. color: what one of them sends.
void area_shine(Tracer *tracer, const LitLayer *layer, uint32_t index, const LightSample *sample,
                Rgb *color);

// shadow.c: multiplies the sample's color by what is let through from the hit to the light at
// that distance. inside: the bodies around the surface's own ray.
void shadow_filter(Tracer *tracer, uint32_t light, const WorldHit *from, LightSample *sample,
                   const InteriorList *inside);
// Up to where it asks the world first, of a light without projection.
double shadow_limit(const Shading *shading, double distance);
WorldNear shadow_near(const Shading *shading, const WorldHit *from, Vec3 dir);
// The two halves of it. One point of an area light: all but the fog behind the last surface between
// them; returns how long that way is. And that fog, for the light as a whole.
double shadow_filter_point(Tracer *tracer, uint32_t light, const WorldHit *from, Vec3 dir,
                           double distance, const InteriorList *inside, Rgb *color);
void shadow_fog(const Shading *shading, uint32_t light, Ray ray, double distance,
                const InteriorList *inside, Rgb *color);

// finish.c
// One light, from one direction: what the finish makes of it.
void light_shine(Tracer *tracer, const LitLayer *layer, bool shadowless, const LightSample *sample,
                 bool backside, Rgb *color);
void finish_irid(const Scene *scene, const Finish *finish, Vec3 p, Vec3 eye, Vec3 dir, Vec3 normal,
                 Rgb *color);
// The empirical Fresnel curve that `metallic` uses: 0 head-on to 1 at grazing cosines.
double finish_metallic_fresnel(double cosine);

// reflect.c
void reflect_layer(const Shading *shading, const Surface *surface, const Finish *finish,
                   Vec3 normal, Rgb layer_color, LayerReflection *out);
// The mirrored direction; raw_normal: the surface's, which it does not go below.
Vec3 reflect_dir(Vec3 dir, Vec3 normal, Vec3 raw_normal);
Rgb reflect_trace(Tracer *tracer, const Surface *surface, const LayerReflection *reflection);

// refract.c
// How much of the light a distance inside the body swallows; shadow rays need fade_power > 0.
Rgb refract_fade(const Interior *interior, double distance);
// Traces what is seen through the surface; true: total internal reflection took its place.
bool refract_trace(Tracer *tracer, const Surface *surface, const Finish *finish, Vec3 normal,
                   float weight, Color *color);

// dispersion.c
// A part of the spectrum: its middle, and what of white light it is, times the number of bands.
typedef struct {
    float wavelength;
    Rgb hue;
} Band;
void dispersion_prepare(Shading *shading); // fills hues
Band dispersion_band(const Shading *shading, int index, int count);
// The ratio of the indices at that wavelength.
double dispersion_ratio(double ratio, double dispersion, float wavelength);

// atmosphere.c
Color atmosphere_sky(const Shading *shading, Vec3 dir, bool alpha);

// fog.c: what is left at the ray's start of what is seen at that depth, and of light from there.
Color fog_see(const Shading *shading, const Ray *ray, double depth, Color seen);
Rgb fog_dim(const Shading *shading, const Ray *ray, double depth, Rgb light);

// rainbow.c
BowAngles rainbow_angles(const Rainbow *bow);
Color rainbow_see(Tracer *tracer, const Ray *ray, double depth, Color seen);

#endif
