// SPDX-License-Identifier: MIT
// Rays are traced and judged scene by scene, all methods side by side on the same rays, so that the
// oracle works once for all of them. A method that is slow gets a share of the rays.
#include "stress.h"

#include "stress_judge.h"

#include "patch/embree.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum {
    METHODS = METHOD_COUNT,
    BUCKETS = 40 * 8,
    SHOWN = 4,
    MOST_TRIANGLES = 1000,
    MOST_OTHERS = 100000
};

typedef struct {
    uint64_t rays, hits, open, verdict[STRESS_VERDICTS];
    uint64_t time[BUCKETS]; // of nearest, by eighths of a power of two, in ns
    double worst;           // ns: nearest, any or all, confirmed by repetition
    int64_t worst_scene, worst_ray;
    uint64_t bits; // answers that differ on another instruction set
    int shown;
} Tally;

typedef struct {
    StressRay ray; // t_min = t_max = 0: none
    bool found, any;
    PatchHit hit;
} Kept;

typedef struct {
    const StressOptions *options;
    const StressCase *which;
    uint64_t number; // of the scene
    StressScene scene;
    PatchSet *sets[METHODS];
    Tally *tally; // one a method
    // Of each ray, as qi answers it on the instruction set that was asked for.
    Kept *kept;
} Stage;

StressOptions stress_options_default(void) {
    return (StressOptions){
        .seed = 1, .rays = 1e8, .watertight = 1e8, .scene = -1, .ray = -1, .times = true};
}

// ---- Asking

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

static void collect(void *context, const PatchHit *hit) {
    StressAnswer *a = context;
    if (a->count < STRESS_ALL)
        a->all[a->count++] = *hit;
}

typedef enum { ASK_NEAREST, ASK_ANY, ASK_ALL, ASKS } Ask;

static void ask(const PatchSet *set, const StressRay *r, Ask what, StressAnswer *a) {
    if (what == ASK_NEAREST) {
        a->found = patchset_intersect(set, &r->ray, r->t_min, r->t_max, 1, NULL, &a->hit);
    } else if (what == ASK_ANY) {
        a->any = patchset_occluded(set, &r->ray, r->t_min, r->t_max, 1, NULL);
    } else {
        a->count = 0;
        a->has_all = true;
        patchset_all(set, &r->ray, r->t_min, r->t_max, 1, NULL, collect, a);
    }
}

static int bucket_of(double ns) {
    int at = (int)(8.0 * log2(fmax(ns, 1.0)));
    return at < BUCKETS ? at : BUCKETS - 1;
}

static void answer(const Stage *stage, int method, const StressRay *r, uint64_t ray,
                   StressAnswer *a) {
    Tally *tally = &stage->tally[method];
    a->has_all = a->found = a->any = false;
    a->count = 0;
    for (Ask what = ASK_NEAREST; what < ASKS; what++) {
        if (what == ASK_ALL && (ray % 8 || (stage->which->watertight && ray % 64)))
            break;
        double start = now();
        ask(stage->sets[method], r, what, a);
        double ns = now() - start;
        if (what == ASK_NEAREST) {
#pragma omp atomic
            tally->time[bucket_of(ns)]++;
        }
        double worst;
#pragma omp atomic read
        worst = tally->worst;
        if (ns <= worst || !stage->options->times)
            continue;
        // Was it the ray, or the machine?
        StressAnswer again;
        for (int k = 0; k < 5 && ns > worst; k++) {
            start = now();
            ask(stage->sets[method], r, what, &again);
            ns = fmin(ns, now() - start);
        }
#pragma omp critical(stress_worst)
        if (ns > tally->worst) {
            tally->worst_scene = (int64_t)stage->number;
            tally->worst_ray = (int64_t)ray;
#pragma omp atomic write
            tally->worst = ns;
        }
    }
}

// ---- Instruction sets

static const char *const isas[] = {"scalar", "avx2", "avx512"};

static void keep(const Stage *stage, int method, uint64_t ray, const StressRay *r,
                 const StressAnswer *a) {
    if (method == METHOD_QI && stage->kept)
        stage->kept[ray] = (Kept){*r, a->found, a->any, a->hit};
}

static bool same_bits(const PatchHit *a, const PatchHit *b) {
    const double x[] = {a->t, a->u, a->v, a->normal.x, a->normal.y, a->normal.z, a->bound};
    const double y[] = {b->t, b->u, b->v, b->normal.x, b->normal.y, b->normal.z, b->bound};
    return memcmp(x, y, sizeof x) == 0 && a->id == b->id;
}

static bool same_answer(const Kept *kept, bool found, const PatchHit *hit, bool any) {
    return found == kept->found && (!found || same_bits(hit, &kept->hit)) && any == kept->any;
}

static void count_bits(const Stage *stage, const char *how, uint64_t ray) {
    uint64_t bits;
#pragma omp atomic capture
    bits = ++stage->tally[METHOD_QI].bits;
    if (bits == 1)
        printf("%s differs on %s and %s: scene %llu ray %llu\n", stage->which->name,
               patch_isa_name(), how, (unsigned long long)stage->number, (unsigned long long)ray);
}

// All rays of the scene once more on every other instruction set that this machine has.
static void compare_isas(const Stage *stage, uint64_t count) {
    if (!stage->kept)
        return;
    const char *own = patch_isa_name();
    for (size_t n = 0; n < sizeof isas / sizeof *isas; n++) {
        if (strcmp(isas[n], own) == 0 || patch_isa_choose(isas[n]) != PATCH_ISA_CHOSEN)
            continue;
#pragma omp parallel for schedule(dynamic, 64)
        for (uint64_t ray = 0; ray < count; ray++) {
            StressAnswer a;
            ask(stage->sets[METHOD_QI], &stage->kept[ray].ray, ASK_NEAREST, &a);
            ask(stage->sets[METHOD_QI], &stage->kept[ray].ray, ASK_ANY, &a);
            if (!same_answer(&stage->kept[ray], a.found, &a.hit, a.any))
                count_bits(stage, own, ray);
        }
    }
    patch_isa_choose(own);
}

// The rays as packets: as they follow each other, going all ways, and beside one of them.
static void compare_packet(const Stage *stage, const Kept *kept, int count, uint64_t first) {
    const PatchSet *set = stage->sets[METHOD_QI];
    Ray rays[PATCH_PACKET] = {0};
    PatchRange ranges[PATCH_PACKET] = {0};
    PatchHit hits[PATCH_PACKET];
    bool found[PATCH_PACKET], any[PATCH_PACKET];
    for (int k = 0; k < count; k++) {
        rays[k] = kept[k].ray.ray;
        ranges[k] = (PatchRange){kept[k].ray.t_min, kept[k].ray.t_max, 1};
    }
    patchset_intersect_many(set, rays, ranges, (size_t)count, NULL, found, hits);
    patchset_occluded_many(set, rays, ranges, (size_t)count, NULL, any);
    for (int k = 0; k < count; k++)
        if (!same_answer(&kept[k], found[k], &hits[k], any[k]))
            count_bits(stage, "in packets", first + (uint64_t)k);
}

static void compare_packets(const Stage *stage, uint64_t count) {
#pragma omp parallel for schedule(dynamic, 4)
    for (uint64_t first = 0; first < count; first += PATCH_PACKET) {
        Kept beside[PATCH_PACKET];
        int several = (int)(count - first < PATCH_PACKET ? count - first : PATCH_PACKET);
        if (!stage->kept)
            continue;
        compare_packet(stage, stage->kept + first, several, first);
        Rng rng = {first ^ stage->number << 32};
        double off = pow(10.0, rng_range(&rng, -16.0, -1.0));
        for (int k = 0; k < PATCH_PACKET; k++) {
            beside[k] = stage->kept[first];
            Vec3 *d = &beside[k].ray.ray.dir;
            *d = vec_madd(*d, off * vec_length(*d), stress_direction(&rng));
            StressAnswer a;
            ask(stage->sets[METHOD_QI], &beside[k].ray, ASK_NEAREST, &a);
            ask(stage->sets[METHOD_QI], &beside[k].ray, ASK_ANY, &a);
            beside[k].found = a.found, beside[k].any = a.any, beside[k].hit = a.hit;
        }
        compare_packet(stage, beside, PATCH_PACKET, first);
    }
}

// ---- One ray

static void print_hit(const char *what, const PatchHit *h) {
    printf("  %s: patch %u t %.17g u %.17g v %.17g bound %.3g\n", what, (unsigned)h->id, h->t, h->u,
           h->v, h->bound);
}

static void print_ray(const Stage *stage, int method, const StressRay *r, uint64_t ray,
                      StressVerdict verdict, const StressAnswer *a, StressTruth *truth) {
    printf("%s %s by %s: org %.17g %.17g %.17g dir %.17g %.17g %.17g t %.17g..%.17g\n"
           "  build/stress --seed %llu --case %s --method %s --scene %llu --ray %llu\n",
           stage->which->name, stress_verdict_name(verdict), patch_method_name((PatchMethod)method),
           r->ray.org.x, r->ray.org.y, r->ray.org.z, r->ray.dir.x, r->ray.dir.y, r->ray.dir.z,
           r->t_min, r->t_max, (unsigned long long)stage->options->seed, stage->which->name,
           patch_method_name((PatchMethod)method), (unsigned long long)stage->number,
           (unsigned long long)ray);
    if (a->found)
        print_hit("nearest", &a->hit);
    else
        printf("  nearest: none; any: %s\n", a->any ? "yes" : "no");
    for (int k = 0; k < a->count; k++)
        print_hit("all", &a->all[k]);
    if (r->expect == EXPECT_HIT)
        printf("  known: t %.17g\n", r->t_known);
    if (r->expect != EXPECT_NONE)
        stress_truth_print(truth);
}

static void record(const Stage *stage, int method, const StressRay *r, uint64_t ray,
                   StressVerdict verdict, const StressAnswer *a, StressTruth *truth) {
    Tally *tally = &stage->tally[method];
#pragma omp atomic
    tally->rays++;
#pragma omp atomic
    tally->hits += a->found;
#pragma omp atomic
    tally->open += truth->open;
#pragma omp atomic
    tally->verdict[verdict]++;
    if (verdict == STRESS_FINE && stage->options->ray < 0)
        return;
#pragma omp critical(stress_print)
    if (tally->shown < (method == METHOD_QI ? SHOWN : 0) || stage->options->ray >= 0) {
        tally->shown++;
        print_ray(stage, method, r, ray, verdict, a, truth);
    }
}

// A ray from the hit onwards, clear of all that meets there: see patch_clearance.
static void leave(const Stage *stage, int method, const StressRay *r, uint64_t ray) {
    enum { MOST_SURFACES = 16 };
    const PatchDef *defs = stage->scene.defs;
    StressAnswer a = {0};
    ask(stage->sets[method], r, ASK_NEAREST, &a);
    if (!a.found)
        return;
    StressRay next = {.ray = {vec_madd(r->ray.org, a.hit.t, r->ray.dir), r->onward},
                      .t_max = INFINITY};
    next.t_min = patch_clearance(&defs[a.hit.id], &a.hit, &next.ray);
    PatchHit left = a.hit;
    double bound = a.hit.bound;
    for (int n = 0; n < MOST_SURFACES; n++) {
        ask(stage->sets[method], &next, ASK_NEAREST, &a);
        if (!a.found)
            break;
        PatchHit other = a.hit;
        other.bound = bound = fmax(bound, a.hit.bound);
        Ray rest = {vec_madd(next.ray.org, next.t_min, next.ray.dir), next.ray.dir};
        double clear = next.t_min + patch_clearance(&defs[a.hit.id], &other, &rest);
        if (!(a.hit.t < clear))
            break;
        next.t_min = clear;
    }
    StressTruth truth;
    stress_truth_init(&truth, &stage->scene, &next);
    answer(stage, method, &next, ray, &a);
    keep(stage, method, ray, &next, &a);
    StressVerdict verdict = stress_judge(stage->which, (PatchMethod)method, &truth, &a);
    if (verdict == STRESS_FINE && !stress_is_triangles((PatchMethod)method))
        verdict = stress_judge_left(&a, &truth, &left, bound);
    record(stage, method, &next, ray, verdict, &a, &truth);
}

// Of how many rays the method gets one.
static uint64_t every_of(int method) {
    return method == METHOD_QI ? 1 : method == METHOD_QI_PAPER ? 64 : 16;
}

static void trace(const Stage *stage, uint64_t ray) {
    StressRay r;
    stress_ray_make(stage->which, &stage->scene, stage->options->seed, stage->number, ray, &r);
    StressTruth truth;
    stress_truth_init(&truth, &stage->scene, &r);
    for (int method = 0; method < METHODS; method++) {
        if (!stage->sets[method] || (stage->options->ray < 0 && ray % every_of(method)))
            continue;
        if (r.leaves) {
            leave(stage, method, &r, ray);
            continue;
        }
        StressAnswer a;
        answer(stage, method, &r, ray, &a);
        keep(stage, method, ray, &r, &a);
        truth.open = false;
        StressVerdict verdict = stress_judge(stage->which, (PatchMethod)method, &truth, &a);
        record(stage, method, &r, ray, verdict, &a, &truth);
    }
}

// ---- One case

static bool wants(const char *only, const char *name) { return !only || strcmp(only, name) == 0; }

static void open_stage(Stage *stage, bool all_methods) {
    stress_scene_make(stage->which, stage->options->seed, stage->number, &stage->scene);
    for (int method = 0; method < METHODS; method++) {
        stage->sets[method] = NULL;
        if (!wants(stage->options->only_method, patch_method_name((PatchMethod)method)) ||
            (!all_methods && method != METHOD_QI))
            continue;
        bool plain = method == METHOD_QI_PAPER || stress_is_triangles((PatchMethod)method);
        if ((method == METHOD_TESSELLATION && embree_missing()) ||
            (method != METHOD_QI && stage->scene.count > MOST_OTHERS) ||
            (plain && (stage->scene.defs[0].weights || stage->scene.count > MOST_TRIANGLES)))
            continue;
        PatchSetOptions options = patchset_options_default();
        options.method = (PatchMethod)method;
        // Triangles can't be had at 1e-9.
        options.tolerance = method == METHOD_TESSELLATION ? 1e-3 : stage->which->tolerance;
        if (stage->which->prepared)
            options.prepare = (PatchPrepare)(stage->number % PREPARE_COUNT);
        PatchSet *set = stage->sets[method] = patchset_create(&options);
        for (int n = 0; n < stage->scene.count; n++)
            patchset_add(set, &stage->scene.defs[n]);
        patchset_commit(set);
    }
}

static void close_stage(Stage *stage) {
    for (int method = 0; method < METHODS; method++)
        patchset_destroy(stage->sets[method]);
    stress_scene_destroy(&stage->scene);
}

static void run_case(const StressOptions *options, const StressCase *which, double rays,
                     Tally *tally) {
    uint64_t per_scene = (uint64_t)which->per_scene, total = (uint64_t)ceil(rays);
    if (options->scene >= 0) {
        Stage stage = {options, which, (uint64_t)options->scene, .tally = tally};
        open_stage(&stage, true);
        for (uint64_t ray = 0; ray < per_scene; ray++)
            if (options->ray < 0 || ray == (uint64_t)options->ray)
                trace(&stage, ray);
        close_stage(&stage);
        return;
    }
    for (uint64_t number = 0; number * per_scene < total; number++) {
        // Not every scene is worth the facets' preparation.
        Stage stage = {options, which, number, .tally = tally};
        open_stage(&stage,
                   which->per_scene > 1000 || number % 16 == 0 || options->only_method != NULL);
        uint64_t left = total - number * per_scene, count = left < per_scene ? left : per_scene;
        if (stage.sets[METHOD_QI]) {
            stage.kept = ARENA_ARRAY(stage.scene.arena, Kept, count);
        }
#pragma omp parallel for schedule(dynamic, 64)
        for (uint64_t ray = 0; ray < count; ray++)
            trace(&stage, ray);
        compare_isas(&stage, count);
        compare_packets(&stage, count);
        close_stage(&stage);
    }
}

// ---- Report

static double median_of(const Tally *t) {
    uint64_t half = 0, sum = 0;
    for (int k = 0; k < BUCKETS; k++)
        half += t->time[k];
    half /= 2;
    for (int k = 0; k < BUCKETS; k++) {
        sum += t->time[k];
        if (sum > half)
            return exp2((k + 0.5) / 8.0);
    }
    return 0.0;
}

static bool too_slow(const Tally *t) { return t->worst > 1e6 || t->worst > 100.0 * median_of(t); }

static uint64_t failures_of(const Tally *t) {
    uint64_t sum = 0;
    for (int k = STRESS_FINE + 1; k < STRESS_VERDICTS; k++)
        sum += t->verdict[k];
    return sum + t->bits;
}

static void print_row(const char *name, const Tally *t) {
    printf("| %s | %llu | %llu |", name, (unsigned long long)t->rays, (unsigned long long)t->hits);
    for (int k = STRESS_FINE + 1; k < STRESS_VERDICTS; k++)
        printf(" %llu |", (unsigned long long)t->verdict[k]);
    double median = median_of(t);
    printf(" %llu |", (unsigned long long)t->bits);
    printf(" %llu | %.2f | %.1f | %.0f |\n", (unsigned long long)t->open, median * 1e-3,
           t->worst * 1e-3, median > 0.0 ? t->worst / median : 0.0);
}

static void report(const StressOptions *options, const Tally *tallies, int method) {
    printf("\n%s\n\n| case | rays | hits |", patch_method_name((PatchMethod)method));
    for (int k = STRESS_FINE + 1; k < STRESS_VERDICTS; k++)
        printf(" %s |", stress_verdict_name((StressVerdict)k));
    printf(" bits | open | median, us | worst, us | ratio |\n|---|---|---|");
    for (int k = STRESS_FINE + 1; k < STRESS_VERDICTS; k++)
        printf("---|");
    printf("---|---|---|---|---|\n");
    for (int n = 0; n < stress_case_count; n++)
        if (wants(options->only_case, stress_cases[n].name) && tallies[n * METHODS + method].rays)
            print_row(stress_cases[n].name, &tallies[n * METHODS + method]);
}

// One cell of the matrix: what failed, by its letter, in so many of the rays.
static void print_cell(const Tally *t) {
    static const char letters[STRESS_VERDICTS] = {' ', 'm', 'f', 'o', 'b', 'l', 't', 'd', 'n'};
    if (!t->rays) {
        printf(" - |");
        return;
    }
    bool any = false;
    for (int k = STRESS_FINE + 1; k < STRESS_VERDICTS; k++) {
        if (t->verdict[k])
            printf(" %.2g%c", (double)t->verdict[k] * 1e6 / (double)t->rays, letters[k]);
        any |= t->verdict[k] > 0;
    }
    printf(any ? " |" : " 0 |");
}

// All methods side by side: failures in a million rays.
static void print_matrix(const StressOptions *options, const Tally *tallies) {
    printf(
        "\nfailures in a million rays: m missed, f false, o over its bound, b behind a crossing, "
        "l lost, t twice, d any and nearest differ, n NaN\n\n| case | rays of qi |");
    for (int method = 0; method < METHODS; method++)
        printf(" %s |", patch_method_name((PatchMethod)method));
    printf("\n|---|---|");
    for (int method = 0; method < METHODS; method++)
        printf("---|");
    printf("\n");
    for (int n = 0; n < stress_case_count; n++) {
        const Tally *row = &tallies[n * METHODS];
        if (!wants(options->only_case, stress_cases[n].name))
            continue;
        printf("| %s | %.3g |", stress_cases[n].name, (double)row[METHOD_QI].rays);
        for (int method = 0; method < METHODS; method++)
            print_cell(&row[method]);
        printf("\n");
    }
}

static double share_of(const StressOptions *options, const StressCase *which) {
    double sum = 0.0;
    for (int n = 0; n < stress_case_count; n++)
        if (stress_cases[n].watertight == which->watertight &&
            wants(options->only_case, stress_cases[n].name))
            sum += stress_cases[n].share;
    return which->share / sum * (which->watertight ? options->watertight : options->rays);
}

uint64_t stress_run(const StressOptions *options) {
    static Tally tallies[128 * METHODS]; // too large for the stack
    memset(tallies, 0, sizeof tallies);
    uint64_t failures = 0;
    double start = now();
    for (int n = 0; n < stress_case_count; n++) {
        const StressCase *which = &stress_cases[n];
        if (!wants(options->only_case, which->name))
            continue;
        Tally *tally = &tallies[n * METHODS];
        double rays = share_of(options, which);
        if (rays < which->least && !options->only_case)
            continue;
        run_case(options, which, rays, tally);
        const Tally *qi = &tally[METHOD_QI];
        failures += failures_of(qi);
        if (options->times && !which->endless && too_slow(qi) && options->scene < 0) {
            failures++;
            printf("%s slow: %.0f us, median %.2f us\n"
                   "  build/stress --seed %llu --case %s --method qi --scene %lld --ray %lld\n",
                   which->name, qi->worst * 1e-3, median_of(qi) * 1e-3,
                   (unsigned long long)options->seed, which->name, (long long)qi->worst_scene,
                   (long long)qi->worst_ray);
        }
        fflush(stdout);
    }
    for (int method = 0; method < METHODS && options->ray < 0; method++)
        if (wants(options->only_method, patch_method_name((PatchMethod)method)))
            report(options, tallies, method);
    if (options->ray < 0 && !options->only_method)
        print_matrix(options, tallies);
    printf("\nseed %llu, %s, %d threads, %.0f s: %llu failures of qi\n",
           (unsigned long long)options->seed, patch_isa_name(), omp_get_max_threads(),
           (now() - start) * 1e-9, (unsigned long long)failures);
    return failures;
}
