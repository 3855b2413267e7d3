// SPDX-License-Identifier: MIT
// For the shading tests: one scene written twice, as text for POV-Ray and as our Scene, traced by
// both and compared at 16 bits a channel.
#ifndef TESTS_SHADE_FIXTURE_H
#define TESTS_SHADE_FIXTURE_H

#include "base/array.h"
#include "model/scene.h"
#include "render/trace.h"

#include <stdio.h>

typedef struct {
    Arena *arena;
    char *text; // POV-Ray's, a heap buffer
    size_t text_size, text_room;
    Scene scene;
    const Scene *converted; // stands for all of the above when there is one
    ARRAY(Pigment) pigments;
    ARRAY(Texture) textures;
    ARRAY(Interior) interiors;
    ARRAY(Object) objects;
    ARRAY(uint32_t) roots;
    ARRAY(Light) lights;
    int width, height;
    int quality;
    bool alpha;
    FILE *povray; // under way
    char folder[32];
} Fixture;

bool fixture_povray_available(void);

// An empty scene of that language version (x 100), assumed_gamma 1, defaults of the language.
Fixture *fixture_create(int version);
// The scene of that text, read by the converter, which must have nothing to warn of; version 3.7,
// assumed_gamma 1. Our camera is the renderer's own.
Fixture *fixture_read(int width, int height, const char *text);
void fixture_destroy(Fixture *fixture);
void fixture_text(Fixture *fixture, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The picture: width x height pixels; the plane through the origin parallel to z = 0, seen along z
// from z = -10, `across` units wide and `high` units high about `center` (x, y).
void fixture_orthographic(Fixture *fixture, int width, int height, double across, double high,
                          Vec3 center);
// From location along z, the picture 1 x 1 at distance 1.
void fixture_perspective(Fixture *fixture, int width, int height, Vec3 location);

// Our side only; the text is the caller's.
uint32_t fixture_pigment(Fixture *fixture, Pigment pigment);
uint32_t fixture_plain(Fixture *fixture, Color color);
uint32_t fixture_texture(Fixture *fixture, const Layer *layers, uint32_t count);
uint32_t fixture_interior(Fixture *fixture, Interior interior);
uint32_t fixture_object(Fixture *fixture, Object object);
void fixture_light(Fixture *fixture, Light light);

// A sphere or plane with nothing set.
Object fixture_sphere(Vec3 center, double radius);
Object fixture_plane(Vec3 normal, double distance);

// Our scene as it stands now; valid until the next call of fixture_*().
const Scene *fixture_scene(Fixture *fixture);

// Our picture of it, row by row from the top; valid as long as the fixture.
const Color *fixture_picture(Fixture *fixture, int quality);
// Starts POV-Ray on the finished scene; several may be under way. alpha: with +UA.
void fixture_launch(Fixture *fixture, int quality, bool alpha);
// Renders a launched scene and waits for POV-Ray. The largest difference of a channel in units of
// 1/65535 (with alpha: of 1/255 in the un-premultiplied picture); where it is goes to stderr when
// it is above limit.
int fixture_compare(Fixture *fixture, int limit);

// A Finish that names only what differs from the default; for files that say
// #pragma GCC diagnostic ignored "-Woverride-init".
#define FINISH(...)                                                                                \
    {                                                                                              \
        .ambient = {0.1f, 0.1f, 0.1f}, .diffuse = 0.6f, .brilliance = 1.0f, .phong_size = 40.0f,   \
        .roughness = 0.05f, .reflection_falloff = 1.0f, .reflection_exponent = 1.0f, __VA_ARGS__   \
    }
#define GREY3(x)                                                                                   \
    { x, x, x }

// Four lights, one of each kind; a checkered wall at z = 4 and a floor at y = -3, both dull.
void fixture_add_lights(Fixture *fixture);
void fixture_add_room(Fixture *fixture);
// On both sides; text is what stands behind the radius.
void fixture_add_sphere(Fixture *fixture, Vec3 center, double radius, const char *text,
                        uint32_t texture, uint32_t interior);
uint32_t fixture_one_layer(Fixture *fixture, Color color, Finish finish);

// A test launches all its scenes, then waits for all; not one value of 16 bits may differ: every
// sum is rounded where POV-Ray rounds it. Leaves the test as skipped when there is no povray.
void fixture_compare_later(Fixture *fixture, int quality, bool alpha);
void fixture_compare_now(void);

#endif
