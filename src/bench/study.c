// SPDX-License-Identifier: MIT
// POV-Ray's hits are those of our `facets`, which the tests hold equal to it; its time and memory
// are its own.
#include "bench/study.h"

#include "base/arena.h"
#include "base/file.h"

#include <string.h>

// The errors that a picture may have to be good enough: of a pixel, of a step of 8 bits.
static const double SMALL_PIXELS = 0.1, SMALL_STEPS = 1.0;

static bool is_facets(const SweepResult *r) {
    return !r->point.povray && r->point.method == METHOD_FACETS;
}

// POV-Ray's own run at the same depth; NULL: there is none.
static const SweepResult *povray_at(const Sweep *s, int steps) {
    for (size_t i = 0; i < s->count; i++)
        if (s->results[i].point.povray && s->results[i].point.steps == steps &&
            !s->results[i].failed)
            return &s->results[i];
    return NULL;
}

// The fastest of qi's points that is nowhere farther off than that; NULL: none.
static const SweepResult *qi_within(const Sweep *s, double position) {
    const SweepResult *best = NULL;
    for (size_t i = 0; i < s->count; i++) {
        const SweepResult *r = &s->results[i];
        if (r->failed || r->point.povray || r->point.method != METHOD_QI ||
            r->point.prepare != PREPARE_FULL || !(r->position_max <= position))
            continue;
        if (!best || r->picture.median < best->picture.median)
            best = r;
    }
    return best;
}

static void put_cost(const Sweep *s, const SweepResult *r, FILE *out) {
    const SweepResult *povray = r->point.flatness > 0.0 ? NULL : povray_at(s, r->point.steps);
    const SweepResult *qi = qi_within(s, r->position_max);
    if (povray)
        fprintf(out, " %.2f s, %.0f MB |", povray->picture.median, povray->megabytes);
    else
        fputs(r->point.flatness > 0.0 ? " |" : " gave up |", out);
    if (qi)
        fprintf(out, " %.2f s, %.0f MB |", qi->picture.median, qi->megabytes);
    else
        fputs(" none |", out);
    putc('\n', out);
}

static void put_row(const Sweep *s, const SweepResult *r, const char *name, FILE *out) {
    fprintf(out, "| %s |", name);
    if (r->failed) {
        fprintf(out, " %s | | | | | | | |", r->failed);
        put_cost(s, r, out);
        return;
    }
    fprintf(out, " %.2g | %.2g | %.2g | %.2g | %.3g | %.3g %% | %.2g %% | %d |", r->position_max,
            r->position_pixels, r->normal_max, r->normal_rms, r->rms, 100.0 * r->off,
            100.0 * r->leaks, r->holes);
    put_cost(s, r, out);
}

void study_print(const Sweep *s, FILE *out) {
    Arena *arena = arena_create();
    fprintf(out,
            "%s, %u patches, %zu smooth shared edges, %d x %d:\n\n"
            "| triangles | farthest off, diameters | pixels | normal, degrees | RMS | picture "
            "RMS, steps | pixels off | edge rays lost | pin-holes | POV-Ray | qi, no farther off "
            "|\n|---|---|---|---|---|---|---|---|---|---|---|\n",
            file_name(s->scene), s->patches, s->edges, s->width, s->height);
    for (size_t i = 0; i < s->count; i++) {
        const SweepResult *r = &s->results[i];
        if (!is_facets(r))
            continue;
        put_row(s, r,
                r->point.flatness > 0.0 ? arena_printf(arena, "flatness %g", r->point.flatness)
                                        : arena_printf(arena, "u_steps %d", r->point.steps),
                out);
    }
    for (size_t i = 0; i < s->count; i++) {
        const SweepResult *r = &s->results[i];
        if (r->failed || r->point.povray || r->point.method != METHOD_QI ||
            r->point.prepare != PREPARE_FULL)
            continue;
        fprintf(out,
                "| qi %g | %.2g | %.2g | %.2g | %.2g | %.3g | %.3g %% | %.2g %% | %d | | %.2f s, "
                "%.0f MB |\n",
                r->point.tolerance, r->position_max, r->position_pixels, r->normal_max,
                r->normal_rms, r->rms, 100.0 * r->off, 100.0 * r->leaks, r->holes,
                r->picture.median, r->megabytes);
    }
    arena_destroy(arena);
}

// The first depth that is good enough; NULL: none was.
static const SweepResult *first_good(const Sweep *s, bool picture) {
    for (size_t i = 0; i < s->count; i++) {
        const SweepResult *r = &s->results[i];
        if (!is_facets(r) || r->failed || r->point.flatness > 0.0)
            continue;
        if (picture ? r->rms < SMALL_STEPS : r->position_pixels < SMALL_PIXELS)
            return r;
    }
    return NULL;
}

static void put_good(const Sweep *s, bool picture, FILE *out) {
    const SweepResult *r = first_good(s, picture);
    const SweepResult *povray = r ? povray_at(s, r->point.steps) : NULL;
    const SweepResult *qi = r ? qi_within(s, r->position_max) : NULL;
    if (!r) {
        fputs(" beyond 8 | | |", out);
        return;
    }
    fprintf(out, " u_steps %d |", r->point.steps);
    if (povray)
        fprintf(out, " %.2f s, %.0f MB |", povray->picture.median, povray->megabytes);
    else
        fputs(" |", out);
    if (qi)
        fprintf(out, " %.2f s, %.0f MB |", qi->picture.median, qi->megabytes);
    else
        fputs(" |", out);
}

void study_print_all(const Sweep *const *sweeps, size_t count, FILE *out) {
    fprintf(
        out,
        "\nWhat it takes:\n\n| scene | patches | off by less than %g pixels from | POV-Ray | "
        "qi | picture RMS below %g step from | POV-Ray | qi |\n|---|---|---|---|---|---|---|---|\n",
        SMALL_PIXELS, SMALL_STEPS);
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "| %s | %u |", file_name(sweeps[i]->scene), sweeps[i]->patches);
        put_good(sweeps[i], false, out);
        put_good(sweeps[i], true, out);
        putc('\n', out);
    }
}
