// SPDX-License-Identifier: MIT
// The worlds of up to three accuracies are prepared, and the same rays traced through them in turn.
// A ray's time is the least of some rounds: what disturbs a measurement only makes it longer.
#include "render/explain.h"

#include "base/usage.h"
#include "render/footprint.h"

#include <math.h>
#include <string.h>

enum { MOST_RAYS = 20000, ROUNDS = 3, SLOW = 10, MOST_VARIANTS = 3 };
static const double ROUND_TIME = 0.02; // seconds, at least

typedef struct {
    bool met;
    WorldHit hit;
    uint64_t steps;
} Look;

typedef struct {
    const char *name; // NULL: the tolerance has none
    RenderOptions options;
    Footprint footprint;
    World *world;
    double share;   // of the patches' diameters: the tolerance, geometric mean
    double prepare; // seconds of the clock
    double ray;     // seconds of processor time
    Look *looks;
    RayStats stats; // of one round
} Variant;

typedef struct {
    const Scene *scene;
    Arena *arena;
    Ray *samples;
    size_t count;
    Footprint pixel; // of one pixel
} Sampling;

// Every nth pixel of every nth row, so that there are no more than MOST_RAYS.
static Sampling take_samples(const Scene *scene, const RenderOptions *o, Arena *arena) {
    Camera smooth = scene->camera;
    smooth.has_normal = false;
    const CameraView view = camera_view(&smooth, NULL, o->width, o->height);
    Sampling s = {.scene = scene, .arena = arena, .pixel = footprint_create(&view, 1.0)};
    const PixelRect area = render_area(o);
    double pixels = (double)(area.right - area.left) * (area.bottom - area.top);
    int by = (int)ceil(sqrt(fmax(pixels, 1.0) / MOST_RAYS));
    s.samples = ARENA_ARRAY(arena, Ray, (size_t)(pixels / by) + (size_t)o->width + 1);
    for (int y = area.top + by / 2; y < area.bottom; y += by)
        for (int x = area.left + by / 2; x < area.right; x += by)
            s.count += camera_ray(&view, x, y, &s.samples[s.count]);
    return s;
}

static double mean_share(const Scene *scene, const PatchSetOptions *options) {
    double sum = 0.0;
    size_t count = 0;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        if (scene->objects[i].type != OBJECT_PATCH)
            continue;
        const Box box = patch_shape_box(&scene->objects[i].shape.patch);
        double share = patchset_tolerance(options, box) / vec_length(vec_sub(box.high, box.low));
        if (!(share > 0.0) || !isfinite(share))
            continue;
        sum += log(share);
        count++;
    }
    return count > 0 ? exp(sum / (double)count) : 0.0;
}

// The accuracy at a share of the diameter that is next to that of `own`: coarser or finer. False:
// there is none.
static bool find_next(const Sampling *s, const Variant *own, bool coarser, Variant *out) {
    bool found = false;
    for (int i = 0; i < ACCURACY_COUNT; i++) {
        Variant v = {.name = options_accuracies[i].name, .options = own->options};
        v.options.tolerance = options_accuracies[i].tolerance;
        v.options.pixels = options_accuracies[i].pixels;
        const PatchSetOptions patches = render_patch_options(s->scene, &v.options, &v.footprint);
        v.share = mean_share(s->scene, &patches);
        bool beyond = coarser ? v.share > own->share * 1.01 : v.share < own->share * 0.99;
        bool nearer = !found || (coarser ? v.share < out->share : v.share > out->share);
        if (beyond && nearer) {
            *out = v;
            found = true;
        }
    }
    return found;
}

static void prepare(const Sampling *s, Variant *v) {
    double start = usage_clock();
    const PatchSetOptions patches = render_patch_options(s->scene, &v->options, &v->footprint);
    v->world = world_create(s->scene, &patches);
    v->prepare = usage_clock() - start;
    v->looks = ARENA_ARRAY(s->arena, Look, s->count);
    v->ray = INFINITY;
}

static void trace(const Sampling *s, Variant *v) {
    double start = usage_thread(), took;
    int times = 0;
    do {
        memset(&v->stats, 0, sizeof v->stats);
        for (size_t i = 0; i < s->count; i++) {
            Look *look = &v->looks[i];
            uint64_t before = v->stats.patch.steps + v->stats.patch.newton;
            look->met = world_intersect(v->world, &s->samples[i], 0.0, INFINITY, RAY_CAMERA,
                                        &v->stats, &look->hit);
            look->steps = v->stats.patch.steps + v->stats.patch.newton - before;
        }
        times++;
        took = usage_thread() - start;
    } while (took < ROUND_TIME);
    v->ray = fmin(v->ray, took / times / (double)s->count);
}

static bool is_patch(const Sampling *s, const Look *look) {
    return look->met && s->scene->objects[look->hit.object].type == OBJECT_PATCH;
}

static double pixel_at(const Sampling *s, const Look *look) {
    return fmax(s->pixel.angle * look->hit.t, s->pixel.width);
}

// ---- Text

static void put_tolerance(const Variant *v, FILE *out) {
    if (v->options.pixels > 0.0)
        fprintf(out, "%gpx", v->options.pixels);
    else
        fprintf(out, "%g of a patch's diameter", v->options.tolerance);
    if (v->name)
        fprintf(out, " (%s)", v->name);
}

static void put_cost(const Sampling *s, const Variant *v, const RenderStats *stats, FILE *out) {
    const PatchStats *work = &v->stats.patch;
    double rays = (double)s->count, mean = (double)(work->steps + work->newton) / rays;
    size_t slow = 0;
    for (size_t i = 0; i < s->count; i++)
        slow += (double)v->looks[i].steps > SLOW * fmax(mean, 1.0);
    fprintf(out, "It cost:\n  preparing %.3f s, %.1f MB\n", stats->prepare_seconds,
            (double)stats->memory / 1e6);
    fprintf(out,
            "  a camera ray %.0f ns: %.3g pieces in the leaves it visits, %.3g tests and QI steps, "
            "%.3g Newton steps\n  slow searches: %zu of %zu rays took over %d times as many "
            "steps\n",
            1e9 * v->ray, (double)work->patch_tests / rays, (double)work->steps / rays,
            (double)work->newton / rays, slow, s->count, SLOW);
    const RayStats *r = &stats->rays;
    double all =
        (double)(stats->samples + r->reflected + r->refracted + r->transmitted + r->shadow);
    double whole = stats->work_seconds, geometry = all * v->ray;
    fprintf(out,
            "  geometry %.3f s of processor time, if all %.0f rays cost as much; all else %.3f s "
            "(%.0f %% of the rendering)\n",
            geometry, all, fmax(whole - geometry, 0.0),
            whole > 0.0 ? 100.0 * fmax(1.0 - geometry / whole, 0.0) : 0.0);
}

static void put_gain(const Sampling *s, const Variant *v, FILE *out) {
    double most = 0.0, sum = 0.0, most_share = 0.0;
    size_t hits = 0;
    for (size_t i = 0; i < s->count; i++) {
        const Look *look = &v->looks[i];
        if (!is_patch(s, look))
            continue;
        double pixels = look->hit.bound / pixel_at(s, look);
        most = fmax(most, pixels);
        most_share = fmax(most_share, look->hit.bound);
        sum += pixels;
        hits++;
    }
    fputs("It bought:\n", out);
    if (v->options.method == METHOD_FACETS || v->options.method == METHOD_TESSELLATION)
        fputs("  no proof: triangles do not know how far they are from the patch\n", out);
    else if (hits > 0)
        fprintf(out,
                "  %zu hits of patches in the sample, each proved to lie within its bound: %.3g "
                "pixels at most, %.3g in the mean (%.3g units at most)\n",
                hits, most, sum / (double)hits, most_share);
    else
        fputs("  nothing: no ray of the sample meets a patch\n", out);
}

static void put_change(const Sampling *s, const Variant *own, const Variant *v, bool coarser,
                       FILE *out) {
    double most = 0.0;
    size_t other = 0, moved = 0;
    for (size_t i = 0; i < s->count; i++) {
        const Look *a = &own->looks[i], *b = &v->looks[i];
        if (a->met != b->met || (a->met && a->hit.object != b->hit.object)) {
            other++;
            continue;
        }
        if (!is_patch(s, a))
            continue;
        double off = fabs(a->hit.t - b->hit.t) / pixel_at(s, a);
        most = fmax(most, off);
        moved += off > 0.0;
    }
    fprintf(out, "The next %s, ", coarser ? "coarser" : "finer");
    put_tolerance(v, out);
    fprintf(out,
            ": a ray takes %.2f of the time, preparing %.2f; %zu hits move along their rays, by up "
            "to %.3g pixels; %zu of %zu rays meet something else\n",
            v->ray / own->ray, own->prepare > 0.0 ? v->prepare / own->prepare : 1.0, moved, most,
            other, s->count);
}

void explain_print(const Scene *scene, const RenderOptions *o, const RenderStats *stats,
                   FILE *out) {
    if (stats->patches == 0) {
        fputs("Explained: the scene has no patches, so nothing depends on the tolerance.\n", out);
        return;
    }
    Arena *arena = arena_create();
    Sampling s = take_samples(scene, o, arena);
    Variant variants[MOST_VARIANTS] = {{.options = *o}};
    Variant *own = &variants[0];
    for (int i = 0; i < ACCURACY_COUNT; i++)
        if (o->pixels > 0.0 ? o->pixels == options_accuracies[i].pixels
                            : options_accuracies[i].pixels == 0.0 &&
                                  o->tolerance == options_accuracies[i].tolerance)
            own->name = options_accuracies[i].name;
    const PatchSetOptions patches = render_patch_options(scene, o, &own->footprint);
    own->share = mean_share(scene, &patches);
    int count = 1;
    bool coarser = false;
    if (o->method != METHOD_FACETS) {
        coarser = find_next(&s, own, true, &variants[count]);
        count += coarser;
        count += find_next(&s, own, false, &variants[count]);
    }
    for (int i = 0; i < count; i++)
        prepare(&s, &variants[i]);
    for (int round = 0; round < ROUNDS && s.count > 0; round++)
        for (int i = 0; i < count; i++)
            trace(&s, &variants[i]);

    fprintf(out, "Explained, by %s", patch_method_name(o->method));
    if (o->method != METHOD_FACETS) {
        fputs(" at ", out);
        put_tolerance(own, out);
    }
    fprintf(out, ", from a sample of %zu camera rays:\n", s.count);
    if (s.count > 0) {
        put_cost(&s, own, stats, out);
        put_gain(&s, own, out);
        for (int i = 1; i < count; i++)
            put_change(&s, own, &variants[i], coarser && i == 1, out);
    }
    if (o->method == METHOD_FACETS)
        fputs("Triangles have no tolerance: --finer n cuts them more often.\n", out);
    for (int i = 0; i < count; i++)
        world_destroy(variants[i].world);
    arena_destroy(arena);
}
