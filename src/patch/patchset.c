// SPDX-License-Identifier: MIT
// The front of patch.h: keeps the patches and hands each question to the method.
#include "patch/patch.h"

#include "base/arena.h"
#include "base/array.h"
#include "base/diag.h"
#include "patch/accel.h"
#include "patch/clipping.h"
#include "patch/facets.h"
#include "patch/kernels.h"
#include "patch/newton.h"
#include "patch/paper.h"
#include "patch/query.h"
#include "patch/rational.h"
#include "patch/tessellation.h"
#include "patch/units.h"

#include <assert.h>
#include <math.h>
#include <string.h>

// ORDER patch_method
static const char *const method_names[] = {"qi",     "qi-paper", "clipping",
                                           "newton", "facets",   "tessellation"};
_Static_assert(sizeof method_names / sizeof method_names[0] == METHOD_COUNT, "a name each");

struct PatchSet {
    PatchSetOptions options;
    Arena *arena;
    ARRAY(PatchDef) defs; // their points lie in the arena
    Box bounds;
    int shift; // the methods see everything times 2^shift (units.h)
    bool committed;
    // The method's own, the others are NULL.
    Accel *accel;
    Rational *rational; // the rational patches of METHOD_QI; accel has the others
    Paper *paper;
    Clipping *clipping;
    Newton *newton;
    Facets *facets;
    Tessellation *tessellation;
};

const char *patch_method_name(PatchMethod method) {
    assert(method >= 0 && method < METHOD_COUNT);
    return method_names[method];
}

bool patch_method_parse(const char *name, PatchMethod *method) {
    for (int i = 0; i < METHOD_COUNT; i++) {
        if (strcmp(name, method_names[i]) == 0) {
            *method = (PatchMethod)i;
            return true;
        }
    }
    return false;
}

// ORDER patch_prepare
static const char *const prepare_names[PREPARE_COUNT] = {"full", "light", "none"};

const char *patch_prepare_name(PatchPrepare prepare) {
    assert(prepare >= 0 && prepare < PREPARE_COUNT);
    return prepare_names[prepare];
}

bool patch_prepare_parse(const char *name, PatchPrepare *prepare) {
    for (int i = 0; i < PREPARE_COUNT; i++) {
        if (strcmp(name, prepare_names[i]) == 0) {
            *prepare = (PatchPrepare)i;
            return true;
        }
    }
    return false;
}

PatchSetOptions patchset_options_default(void) {
    return (PatchSetOptions){.method = METHOD_QI, .tolerance = 1e-9};
}

PatchSet *patchset_create(const PatchSetOptions *options) {
    Arena *arena = arena_create();
    PatchSet *set = ARENA_NEW(arena, PatchSet);
    set->options = *options;
    set->arena = arena;
    set->bounds = box_empty();
    return set;
}

void patchset_destroy(PatchSet *set) {
    if (!set)
        return;
    if (set->tessellation)
        tessellation_release(set->tessellation);
    array_free(&set->defs);
    arena_destroy(set->arena);
}

// Without squares, which could leave the range of numbers.
static double diagonal(Box box) {
    Vec3 d = vec_sub(box.high, box.low);
    return hypot(d.x, hypot(d.y, d.z));
}

double patchset_tolerance(const PatchSetOptions *options, Box bounds) {
    double tolerance =
        options->tolerance_of ? options->tolerance_of(options->context, bounds) : 0.0;
    if (tolerance > 0.0)
        return tolerance;
    return options->tolerance * diagonal(bounds);
}

void patchset_add(PatchSet *set, const PatchDef *def) {
    assert(!set->committed);
    assert(def->degree_u >= 1 && def->degree_u <= 16 && def->degree_v >= 1 && def->degree_v <= 16);
    size_t count = (size_t)(def->degree_u + 1) * (def->degree_v + 1);
    PatchDef own = *def;
    // A cut in half divides the distance of a triangle from the patch by four.
    own.u_steps += set->options.finer;
    own.v_steps += set->options.finer;
    own.flatness = ldexp(own.flatness, -2 * set->options.finer);
    own.points = arena_copy(set->arena, def->points, count * sizeof(Vec3));
    Box box = box_empty();
    for (size_t i = 0; i < count; i++) {
        assert(vec_is_finite(own.points[i]));
        box = box_extend(box, own.points[i]);
    }
    set->bounds = box_union(set->bounds, box);
    if (!(own.tolerance > 0.0))
        own.tolerance = patchset_tolerance(&set->options, box);
    if (def->weights) {
        own.weights = arena_copy(set->arena, def->weights, count * sizeof(double));
        for (size_t i = 0; i < count; i++)
            assert(isfinite(own.weights[i]) && own.weights[i] > 0.0);
    }
    array_push(&set->defs, own);
}

// Polynomial patches first, else in the order in which they came. Returns how many there are.
static size_t part_rational(PatchSet *set) {
    size_t count = set->defs.count, at = 0;
    PatchDef *parted = ARENA_ARRAY(set->arena, PatchDef, count);
    for (int rational = 0; rational < 2; rational++) {
        for (size_t i = 0; i < count; i++) {
            if ((set->defs.items[i].weights != NULL) == (rational == 1))
                parted[at++] = set->defs.items[i];
        }
    }
    memcpy(set->defs.items, parted, count * sizeof(PatchDef));
    size_t polynomial = 0;
    while (polynomial < count && !set->defs.items[polynomial].weights)
        polynomial++;
    return polynomial;
}

static void commit_qi(PatchSet *set) {
    bool rational = false;
    for (size_t i = 0; i < set->defs.count; i++)
        rational |= set->defs.items[i].weights != NULL;
    size_t count = set->defs.count, polynomial = rational ? part_rational(set) : count;
    set->accel = accel_create(set->arena, set->defs.items, polynomial, set->options.prepare);
    if (rational)
        set->rational =
            rational_create(set->arena, set->defs.items + polynomial, count - polynomial);
}

static void refuse_rational(const PatchSet *set) {
    PatchMethod method = set->options.method;
    if (method != METHOD_QI_PAPER && method != METHOD_FACETS && method != METHOD_TESSELLATION)
        return;
    for (size_t i = 0; i < set->defs.count; i++) {
        if (set->defs.items[i].weights)
            die("the method %s has no rational patches; qi, clipping and newton have them",
                method_names[method]);
    }
}

void patchset_commit(PatchSet *set) {
    assert(!set->committed);
    set->committed = true;
    // The facets have POV-Ray's absolute tolerances, whatever the size.
    set->shift = set->options.method == METHOD_FACETS ? 0 : units_shift(set->bounds);
    for (size_t i = 0; set->shift && i < set->defs.count; i++)
        units_enter(&set->defs.items[i], (Vec3 *)set->defs.items[i].points, set->shift);
    const PatchDef *defs = set->defs.items;
    size_t count = set->defs.count;
    refuse_rational(set);
    switch (set->options.method) {
    case METHOD_QI:
        commit_qi(set);
        break;
    case METHOD_QI_PAPER:
        set->paper = paper_create(set->arena, defs, count);
        break;
    case METHOD_CLIPPING:
        set->clipping = clipping_create(set->arena, defs, count);
        break;
    case METHOD_NEWTON:
        set->newton = newton_create(set->arena, defs, count);
        break;
    case METHOD_FACETS:
        set->facets = facets_create(set->arena, defs, count);
        break;
    case METHOD_TESSELLATION:
        set->tessellation = tessellation_create(set->arena, defs, count);
        break;
    case METHOD_COUNT:
        assert(!"no such method");
    }
}

Box patchset_bounds(const PatchSet *set) { return set->bounds; }

uint64_t patchset_memory(const PatchSet *set) {
    return arena_bytes(set->arena) + set->defs.capacity * sizeof(PatchDef) +
           (set->tessellation ? tessellation_memory(set->tessellation) : 0);
}

static void ask_method(const PatchSet *set, Query *query) {
    if (set->accel) {
        accel_query(set->accel, query);
        if (set->rational && !query_done(query))
            rational_query(set->rational, query);
    } else if (set->paper)
        paper_query(set->paper, query);
    else if (set->clipping)
        clipping_query(set->clipping, query);
    else if (set->newton)
        newton_query(set->newton, query);
    else if (set->facets)
        facets_query(set->facets, query);
    else if (set->tessellation)
        tessellation_query(set->tessellation, query);
}

static void ask(const PatchSet *set, Query *query) {
    assert(set->committed);
    if (!vec_is_finite(query->ray.org) || !vec_is_finite(query->ray.dir))
        return;
    if (!set->shift && !units_odd(query->ray.dir)) {
        ask_method(set, query);
        return;
    }
    UnitsQuery units;
    units_begin(&units, query, set->shift);
    if (vec_is_finite(units.query.ray.org))
        ask_method(set, &units.query);
    units_end(&units);
}

static void add_stats(PatchStats *to, const Query *query) {
    if (!to)
        return;
    to->patch_tests += query->stats.patch_tests;
    to->steps += query->stats.steps;
    to->newton += query->stats.newton;
    to->hits += query->kind == QUERY_ALL ? query->stats.hits : query->found;
}

bool patchset_intersect(const PatchSet *set, const Ray *ray, double t_min, double t_max,
                        uint32_t mask, PatchStats *stats, PatchHit *hit) {
    Query query;
    query_begin(&query, QUERY_NEAREST, ray, t_min, t_max, mask);
    ask(set, &query);
    add_stats(stats, &query);
    if (query.found)
        *hit = query.best;
    return query.found;
}

// Looks for the nearest hit that is farther from the ray's origin than its bound.
typedef struct {
    double length; // of the ray's dir
    bool found;
    PatchHit best;
} Leaving;

static bool is_left(const Leaving *leaving, const PatchHit *hit) {
    return hit->t * leaving->length <= hit->bound;
}

static void take_beyond(void *context, const PatchHit *hit) {
    Leaving *leaving = context;
    if (is_left(leaving, hit) || (leaving->found && hit->t >= leaving->best.t))
        return;
    leaving->found = true;
    leaving->best = *hit;
}

bool patchset_intersect_leaving(const PatchSet *set, const Ray *ray, double t_max, uint32_t mask,
                                PatchStats *stats, PatchHit *hit) {
    PatchHit nearest;
    if (!patchset_intersect(set, ray, 0.0, t_max, mask, stats, &nearest))
        return false;
    Leaving leaving = {.length = hypot(hypot(ray->dir.x, ray->dir.y), ray->dir.z)};
    if (!is_left(&leaving, &nearest)) {
        *hit = nearest;
        return true;
    }
    patchset_all(set, ray, 0.0, t_max, mask, stats, take_beyond, &leaving);
    if (leaving.found)
        *hit = leaving.best;
    return leaving.found;
}

bool patchset_occluded(const PatchSet *set, const Ray *ray, double t_min, double t_max,
                       uint32_t mask, PatchStats *stats) {
    Query query;
    query_begin(&query, QUERY_ANY, ray, t_min, t_max, mask);
    ask(set, &query);
    add_stats(stats, &query);
    return query.found;
}

static PatchRange range_of(const PatchRange *ranges, size_t i) {
    return ranges ? ranges[i] : (PatchRange){0.0, INFINITY, UINT32_MAX};
}

static void ask_packet(const PatchSet *set, const Packet *packet, PatchStats *stats, bool *found) {
    PacketAnswer answer = {0, (1u << packet->count) - 1};
    if (set->accel && !set->accel->next && !set->rational && !set->shift)
        answer = kernels_chosen()->packet(packet);
    if (stats)
        stats->hits += (uint64_t)__builtin_popcount(answer.found);
    for (int i = 0; i < packet->count; i++)
        found[i] = answer.found >> i & 1;
    for (unsigned left = answer.left; left; left &= left - 1) {
        int i = __builtin_ctz(left);
        const Ray *ray = &packet->rays[i];
        PatchRange r = range_of(packet->ranges, (size_t)i);
        found[i] =
            packet->kind == QUERY_NEAREST
                ? patchset_intersect(set, ray, r.t_min, r.t_max, r.mask, stats, &packet->hits[i])
                : patchset_occluded(set, ray, r.t_min, r.t_max, r.mask, stats);
    }
}

static void ask_many(const PatchSet *set, Packet *packet, size_t count, PatchStats *stats,
                     bool *found) {
    PatchStats unused = {0};
    assert(set->committed);
    packet->accel = set->accel;
    packet->stats = stats ? stats : &unused;
    for (size_t i = 0; i < count; i += PATCH_PACKET) {
        packet->count = count - i < PATCH_PACKET ? (int)(count - i) : PATCH_PACKET;
        ask_packet(set, packet, stats, found + i);
        packet->rays += PATCH_PACKET;
        packet->ranges += packet->ranges ? PATCH_PACKET : 0;
        packet->hits += packet->hits ? PATCH_PACKET : 0;
    }
}

void patchset_intersect_many(const PatchSet *set, const Ray *rays, const PatchRange *ranges,
                             size_t count, PatchStats *stats, bool *found, PatchHit *hits) {
    Packet packet = {.rays = rays, .ranges = ranges, .kind = QUERY_NEAREST, .hits = hits};
    ask_many(set, &packet, count, stats, found);
}

void patchset_occluded_many(const PatchSet *set, const Ray *rays, const PatchRange *ranges,
                            size_t count, PatchStats *stats, bool *found) {
    Packet packet = {.rays = rays, .ranges = ranges, .kind = QUERY_ANY};
    ask_many(set, &packet, count, stats, found);
}

void patchset_all(const PatchSet *set, const Ray *ray, double t_min, double t_max, uint32_t mask,
                  PatchStats *stats, PatchSink sink, void *context) {
    Query query = {.ray = *ray,
                   .t_min = t_min,
                   .t_max = t_max,
                   .mask = mask,
                   .kind = QUERY_ALL,
                   .sink = sink,
                   .context = context};
    ask(set, &query);
    add_stats(stats, &query);
}
