// SPDX-License-Identifier: MIT
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "shade_fixture.h"

#include "base/diag.h"
#include "convert_help.h"
#include "render/sample.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

bool fixture_povray_available(void) { return system("command -v povray >/dev/null 2>&1") == 0; }

void fixture_text(Fixture *f, const char *format, ...) {
    va_list args;
    va_start(args, format);
    char *piece;
    int length = vasprintf(&piece, format, args);
    va_end(args);
    if (length < 0)
        die("out of memory");
    size_t need = f->text_size + (size_t)length + 1;
    if (need > f->text_room) {
        f->text_room = 2 * need;
        f->text = realloc(f->text, f->text_room);
        if (f->text == NULL)
            die("out of memory");
    }
    memcpy(f->text + f->text_size, piece, (size_t)length + 1);
    f->text_size += (size_t)length;
    free(piece);
}

Fixture *fixture_create(int version) {
    Fixture *f = calloc(1, sizeof *f);
    if (f == NULL)
        die("out of memory");
    f->arena = arena_create();
    f->scene.settings = (Settings){
        .version = version,
        .gamma_mode = GAMMA_POWER,
        .assumed_gamma = 1.0f,
        .ambient_light = {1.0f, 1.0f, 1.0f},
        .max_trace_level = 5,
        .adc_bailout = 1.0f / 255.0f,
        .noise_generator = 2,
        .number_of_waves = 10,
        .irid_wavelength = {0.70f, 0.52f, 0.48f},
        .background = {0.0f, 0.0f, 0.0f, 0.0f, 1.0f},
    };
    fixture_text(f, "#version %g;\nglobal_settings { assumed_gamma 1.0 }\n", version / 100.0);
    return f;
}

Fixture *fixture_read(int width, int height, const char *text) {
    Fixture *f = fixture_create(370);
    fixture_text(f, "%s", text);
    Converted converted = convert_text(text);
    if (converted.scene == NULL)
        die("%s", converted.message);
    if (converted.warnings != 0)
        die("a warning: %s", first_warning(text));
    f->converted = converted.scene;
    f->width = width, f->height = height;
    return f;
}

void fixture_destroy(Fixture *f) {
    array_free(&f->pigments);
    array_free(&f->textures);
    array_free(&f->interiors);
    array_free(&f->objects);
    array_free(&f->roots);
    array_free(&f->lights);
    arena_destroy(f->arena);
    free(f->text);
    free(f);
}

void fixture_orthographic(Fixture *f, int width, int height, double across, double high,
                          Vec3 center) {
    f->width = width, f->height = height;
    f->scene.camera = (Camera){
        .type = CAMERA_ORTHOGRAPHIC,
        .location = vec3(center.x, center.y, -10.0),
        .direction = vec3(0.0, 0.0, 1.0),
        .up = vec3(0.0, high, 0.0),
        .right = vec3(across, 0.0, 0.0),
    };
    fixture_text(f,
                 "camera { orthographic location <%.17g, %.17g, -10> direction z up %.17g*y "
                 "right %.17g*x }\n",
                 center.x, center.y, high, across);
}

void fixture_perspective(Fixture *f, int width, int height, Vec3 at) {
    f->width = width, f->height = height;
    f->scene.camera = (Camera){
        .type = CAMERA_PERSPECTIVE,
        .location = at,
        .direction = vec3(0.0, 0.0, 1.0),
        .up = vec3(0.0, 1.0, 0.0),
        .right = vec3(1.0, 0.0, 0.0),
    };
    fixture_text(f, "camera { location <%.17g, %.17g, %.17g> direction z up y right x }\n", at.x,
                 at.y, at.z);
}

uint32_t fixture_pigment(Fixture *f, Pigment pigment) {
    array_push(&f->pigments, pigment);
    return (uint32_t)f->pigments.count - 1;
}

uint32_t fixture_plain(Fixture *f, Color color) {
    return fixture_pigment(f, (Pigment){.color = color});
}

uint32_t fixture_texture(Fixture *f, const Layer *layers, uint32_t count) {
    Texture texture = {.layers = arena_copy(f->arena, layers, count * sizeof *layers),
                       .layer_count = count,
                       .pattern = pattern_default()};
    for (uint32_t i = 0; i < count; i++)
        texture.layers[i].normal = NO_INDEX; // no test here bends one
    array_push(&f->textures, texture);
    return (uint32_t)f->textures.count - 1;
}

// The tests' own interiors name only what they are about; none of them is about dispersion.
uint32_t fixture_interior(Fixture *f, Interior interior) {
    interior.dispersion = 1.0f;
    interior.dispersion_samples = 7;
    array_push(&f->interiors, interior);
    return (uint32_t)f->interiors.count - 1;
}

uint32_t fixture_object(Fixture *f, Object object) {
    array_push(&f->objects, object);
    uint32_t index = (uint32_t)f->objects.count - 1;
    array_push(&f->roots, index);
    return index;
}

void fixture_light(Fixture *f, Light light) { array_push(&f->lights, light); }

static Object bare(ObjectType type) {
    Object object = {
        .type = type, .texture = NO_INDEX, .interior_texture = NO_INDEX, .interior = NO_INDEX};
    object.transform = transform_identity();
    return object;
}

Object fixture_sphere(Vec3 center, double radius) {
    Object object = bare(OBJECT_SPHERE);
    object.shape.sphere = (SphereShape){center, radius};
    return object;
}

Object fixture_plane(Vec3 normal, double distance) {
    Object object = bare(OBJECT_PLANE);
    object.shape.plane = (PlaneShape){normal, distance};
    return object;
}

const Scene *fixture_scene(Fixture *f) {
    Scene *s = &f->scene;
    if (f->converted != NULL)
        return f->converted;
    s->pigments = f->pigments.items, s->pigment_count = (uint32_t)f->pigments.count;
    s->textures = f->textures.items, s->texture_count = (uint32_t)f->textures.count;
    s->interiors = f->interiors.items, s->interior_count = (uint32_t)f->interiors.count;
    s->objects = f->objects.items, s->object_count = (uint32_t)f->objects.count;
    s->roots = f->roots.items, s->root_count = (uint32_t)f->roots.count;
    s->lights = f->lights.items, s->light_count = (uint32_t)f->lights.count;
    return s;
}

// Facts: rendering 1.3.
static Ray look_through(const Fixture *f, int x, int y) {
    const Camera *c = &f->scene.camera;
    double a = (x + 0.5) / f->width - 0.5, b = ((f->height - 1) - (y - 0.5)) / f->height - 0.5;
    Vec3 offset = vec_add(vec_scale(c->right, a), vec_scale(c->up, b));
    if (c->type == CAMERA_ORTHOGRAPHIC)
        return (Ray){vec_add(c->location, offset), c->direction};
    return (Ray){c->location, vec_normalize(vec_add(c->direction, offset))};
}

static Color trace_with(void *tracer, const Ray *ray) { return tracer_trace(tracer, ray); }

static void trace_picture(const Scene *scene, const Textures *textures, Tracer *tracer, int width,
                          int height, Color *pixels) {
    const SampleOptions options = {.method = 0, .textures = textures};
    Sampler *sampler = sampler_create(&options, &scene->camera, width, height, width + height);
    sampler_tile(sampler, (PixelRect){0, 0, width, height}, trace_with, tracer, pixels);
    sampler_destroy(sampler);
}

static Color *our_picture(Fixture *f) {
    const Scene *scene = fixture_scene(f);
    PatchSetOptions patches = {.method = METHOD_FACETS, .tolerance = 1e-9};
    World *world = world_create(scene, &patches);
    TraceOptions options = {.quality = f->quality, .alpha = f->alpha};
    Shading *shading = shading_create(scene, world, &options);
    Tracer *tracer = tracer_create(shading);
    Color *pixels = ARENA_ARRAY(f->arena, Color, (size_t)f->width * (size_t)f->height);
    if (f->converted) {
        trace_picture(scene, shading_textures(shading), tracer, f->width, f->height, pixels);
    } else {
        for (int i = 0; i < f->width * f->height; i++) {
            Ray ray = look_through(f, i % f->width, i / f->width);
            pixels[i] = tracer_trace(tracer, &ray);
        }
    }
    tracer_destroy(tracer);
    shading_destroy(shading);
    world_destroy(world);
    return pixels;
}

const Color *fixture_picture(Fixture *f, int quality) {
    f->quality = quality;
    return our_picture(f);
}

static unsigned char *read_all(Fixture *f, const char *path, size_t *size) {
    FILE *in = fopen(path, "rb");
    if (in == NULL)
        return NULL;
    fseek(in, 0, SEEK_END);
    *size = (size_t)ftell(in);
    rewind(in);
    unsigned char *data = arena_alloc(f->arena, *size + 1);
    if (fread(data, 1, *size, in) != *size)
        *size = 0;
    fclose(in);
    return data;
}

// PPM of 16 bits, or with alpha TGA of 8 bits (blue first, four bytes a pixel, rows from the top).
void fixture_launch(Fixture *f, int quality, bool alpha) {
    f->quality = quality;
    f->alpha = alpha;
    strcpy(f->folder, "/tmp/qipov-test-XXXXXX");
    if (mkdtemp(f->folder) == NULL)
        die("cannot make a temporary folder");
    const char *source = arena_printf(f->arena, "%s/scene.pov", f->folder);
    FILE *out = fopen(source, "w");
    if (out == NULL || fputs(f->text, out) < 0 || fclose(out) != 0)
        die("cannot write %s", source);
    f->povray = popen(arena_printf(f->arena,
                                   "cd %s && povray +Iscene.pov +Oscene.%s +W%d +H%d +Q%d %s "
                                   "File_Gamma=1.0 -D -A +WT1 >log.txt 2>&1",
                                   f->folder, alpha ? "tga" : "ppm", f->width, f->height, quality,
                                   alpha ? "+FT +UA" : "+FP16"),
                      "r");
    if (f->povray == NULL)
        die("cannot start povray");
}

static const unsigned char *povray_picture(Fixture *f) {
    int status = pclose(f->povray);
    const char *name = status != 0 ? "log.txt" : f->alpha ? "scene.tga" : "scene.ppm";
    size_t size = 0;
    const unsigned char *data =
        read_all(f, arena_printf(f->arena, "%s/%s", f->folder, name), &size);
    if (system(arena_printf(f->arena, "rm -r %s", f->folder)) != 0)
        fprintf(stderr, "%s was left behind\n", f->folder);
    if (status != 0 || data == NULL)
        die("povray failed:\n%s\n%s", data != NULL ? (const char *)data : "", f->text);
    size_t pixels = (size_t)f->width * (size_t)f->height * (f->alpha ? 4 : 6);
    if (size < pixels + 18)
        die("povray's picture is too short");
    // Whatever the header says, the pixels come last; TGA may have a footer.
    return f->alpha ? data + 18 + data[0] : data + size - pixels;
}

static int quantise(double value, int max) {
    value = value < 0.0 ? 0.0 : value > 1.0 ? 1.0 : value;
    return (int)floorf((float)value * (float)max + 0.5f); // POV-Ray rounds in float
}

// Facts: rendering 3.4.
static void straight_alpha(Color c, double out[4]) {
    double alpha = 1.0 - c.transmit, grey = rgb_grey(color_rgb(c));
    if (grey > alpha)
        alpha = grey < 1.0 ? grey : 1.0;
    double divisor = alpha == 0.0 ? 1e-6 : alpha;
    out[0] = c.b / divisor, out[1] = c.g / divisor, out[2] = c.r / divisor, out[3] = alpha;
}

int fixture_compare(Fixture *f, int limit) {
    const Color *ours = our_picture(f);
    const unsigned char *theirs = povray_picture(f);
    bool alpha = f->alpha;
    int worst = -1, worst_at = 0, worst_channel = 0, channels = alpha ? 4 : 3;
    int a = 0, b = 0, lit = 0, over = 0;
    for (int i = 0; i < f->width * f->height; i++) {
        double v[4] = {ours[i].r, ours[i].g, ours[i].b};
        if (alpha)
            straight_alpha(ours[i], v);
        for (int c = 0; c < channels; c++) {
            int have = quantise(v[c], alpha ? 255 : 65535);
            int want =
                alpha ? theirs[i * 4 + c] : theirs[i * 6 + c * 2] << 8 | theirs[i * 6 + c * 2 + 1];
            lit += want != 0;
            over += abs(have - want) > limit;
            if (abs(have - want) > worst)
                worst = abs(have - want), worst_at = i, worst_channel = c, a = have, b = want;
        }
    }
    if (worst > limit)
        fprintf(stderr, "%d values differ; pixel (%d, %d) channel %d: %d, povray %d\n", over,
                worst_at % f->width, worst_at / f->width, worst_channel, a, b);
    if (lit == 0)
        die("povray's picture is black: the test shows nothing");
    return worst;
}

// ---- parts that several tests share ---

// The macro lets a finish name only what differs from the default; later initialisers win on
// purpose.
#pragma GCC diagnostic ignored "-Woverride-init"

void fixture_add_lights(Fixture *f) {
    fixture_text(f,
                 "light_source { <-30, 40, -50> rgb <0.8, 0.7, 0.6> }\n"
                 "light_source { <20, 5, -30> rgb <0.1, 0.2, 0.4> parallel point_at <3, -1, 2> }\n"
                 "light_source { <2, -30, -20> rgb <0.15, 0.05, 0.1> shadowless }\n"
                 "light_source { <1, 7, -6> rgb <0.3, 0.35, 0.2> fade_distance 5.3 "
                 "fade_power 1.7 }\n");
    fixture_light(
        f, (Light){.type = LIGHT_POINT, .location = {-30, 40, -50}, .color = {0.8f, 0.7f, 0.6f}});
    fixture_light(f, (Light){.type = LIGHT_PARALLEL,
                             .location = {20, 5, -30},
                             .point_at = {3, -1, 2},
                             .color = {0.1f, 0.2f, 0.4f}});
    fixture_light(f, (Light){.type = LIGHT_POINT,
                             .location = {2, -30, -20},
                             .color = {0.15f, 0.05f, 0.1f},
                             .shadowless = true});
    fixture_light(f, (Light){.type = LIGHT_POINT,
                             .location = {1, 7, -6},
                             .color = {0.3f, 0.35f, 0.2f},
                             .fade_distance = 5.3,
                             .fade_power = 1.7});
}

void fixture_add_room(Fixture *f) {
    fixture_text(f, "plane { z, 4 pigment { checker rgb <0.9, 0.8, 0.7> rgb <0.1, 0.2, 0.5> "
                    "scale 0.73 translate <0.11, 0.17, 0.31> } }\n"
                    "plane { y, -3 pigment { rgb <0.4, 0.6, 0.3> } }\n");
    static MapEntry checks[2] = {{0.0f, {0.9f, 0.8f, 0.7f, 0.0f, 0.0f}, NO_INDEX},
                                 {1.0f, {0.1f, 0.2f, 0.5f, 0.0f, 0.0f}, NO_INDEX}};
    Transform scale = transform_scale(vec3(0.73, 0.73, 0.73)),
              shift = transform_translate(vec3(0.11, 0.17, 0.31));
    Warp *warp = ARENA_NEW(f->arena, Warp);
    *warp = (Warp){.type = WARP_TRANSFORM, .transform = transform_compose(&scale, &shift)};
    Pigment wall = {
        .pattern = {.type = PATTERN_CHECKER, .exponent = 1.0f, .warps = warp, .warp_count = 1},
        .entries = checks,
        .entry_count = 2,
    };
    Layer layer = {fixture_pigment(f, wall), FINISH(), NO_INDEX};
    Object object = fixture_plane(vec3(0, 0, 1), 4.0);
    object.texture = fixture_texture(f, &layer, 1);
    fixture_object(f, object);
    layer = (Layer){fixture_plain(f, (Color){0.4f, 0.6f, 0.3f, 0.0f, 0.0f}), FINISH(), NO_INDEX};
    object = fixture_plane(vec3(0, 1, 0), -3.0);
    object.texture = fixture_texture(f, &layer, 1);
    fixture_object(f, object);
}

void fixture_add_sphere(Fixture *f, Vec3 center, double radius, const char *text, uint32_t texture,
                        uint32_t interior) {
    fixture_text(f, "sphere { <%.17g, %.17g, %.17g>, %.17g %s }\n", center.x, center.y, center.z,
                 radius, text);
    Object sphere = fixture_sphere(center, radius);
    sphere.texture = texture;
    sphere.interior = interior;
    fixture_object(f, sphere);
}

uint32_t fixture_one_layer(Fixture *f, Color color, Finish finish) {
    Layer layer = {fixture_plain(f, color), finish, NO_INDEX};
    return fixture_texture(f, &layer, 1);
}

// POV-Ray takes most of a second for the smallest scene, and sleeps through most of that: a test
// starts all its scenes before it looks at the first.
static Fixture *launched[32];
static size_t launched_count;

void fixture_compare_later(Fixture *f, int quality, bool alpha) {
    if (!fixture_povray_available()) {
        printf("skipped: no povray to compare with\n");
        skip();
    }
    assert_true(launched_count < sizeof launched / sizeof *launched);
    fixture_launch(f, quality, alpha);
    launched[launched_count++] = f;
}

void fixture_compare_now(void) {
    int worst = 0;
    for (size_t i = 0; i < launched_count; i++) {
        int difference = fixture_compare(launched[i], 0);
        worst = difference > worst ? difference : worst;
        fixture_destroy(launched[i]);
    }
    launched_count = 0;
    assert_int_equal(worst, 0);
}
