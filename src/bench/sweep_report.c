// SPDX-License-Identifier: MIT
// The figures as text. The page is in sweep_page.c.
#include "bench/sweep_report.h"

#include "base/file.h"
#include "base/version.h"
#include "bench/sweep_page.h"
#include "report/run.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

void sweep_print(const Sweep *s, FILE *out) {
    Arena *arena = arena_create();
    fprintf(out,
            "%s: %u patches, %d x %d, one thread, median of %d.\n\n"
            "| method | picture, s | least to most | memory, MB | Mray/s | prepare, ms | position, "
            "diameters | position, pixels | normal, degrees | wrong hits | picture RMS, steps | "
            "pixels off | front |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
            file_name(s->scene), s->patches, s->width, s->height, s->rounds);
    for (size_t i = 0; i < s->count; i++) {
        const SweepResult *r = &s->results[i];
        fprintf(out, "| %s |", sweep_point_name(&r->point, arena));
        if (r->failed) {
            fprintf(out, " %s | | | | | | | | | | | |\n", r->failed);
            continue;
        }
        fprintf(out, " %.3f | %.3f to %.3f | %.0f |", r->picture.median, r->picture.least,
                r->picture.most, r->megabytes);
        if (r->point.povray)
            fputs(" | | | | | |", out);
        else
            fprintf(out, " %.3g | %.1f | %.2g | %.2g | %.2g | %.2g %% |", r->rays_per_second * 1e-6,
                    1e3 * r->prepare.median, r->position_max, r->position_pixels, r->normal_max,
                    100.0 * r->wrong);
        fprintf(out, " %.3g | %.3g %% | %s |\n", r->rms, 100.0 * r->off, r->front ? "yes" : "");
    }
    arena_destroy(arena);
}

// ---- CSV and JSON: the same columns

typedef struct {
    const char *name;
    double value;
} Column;

enum { COLUMNS = 28, OF_EVERY = 5, OF_THE_PICTURE = 6 };

static void columns_of(const SweepResult *r, Column out[COLUMNS]) {
    const Column columns[COLUMNS] = {
        {"rounds", r->rounds},
        {"picture_s", r->picture.median},
        {"picture_s_min", r->picture.least},
        {"picture_s_max", r->picture.most},
        {"megabytes", r->megabytes},
        {"prepare_s", r->prepare.median},
        {"prepare_s_min", r->prepare.least},
        {"prepare_s_max", r->prepare.most},
        {"trace_s", r->trace.median},
        {"trace_s_min", r->trace.least},
        {"trace_s_max", r->trace.most},
        {"rays_per_s", r->rays_per_second},
        {"position_max_diameters", r->position_max},
        {"position_rms_diameters", r->position_rms},
        {"position_max_pixels", r->position_pixels},
        {"rounding_diameters", r->rounding},
        {"normal_max_degrees", r->normal_max},
        {"normal_rms_degrees", r->normal_rms},
        {"wrong_hits_share", r->wrong},
        {"edge_leaks_share", r->leaks},
        {"pin_hole_pixels", r->holes},
        {"picture_rms_same_hits_steps", r->rms_same},
        {"picture_rms_steps", r->rms},
        {"picture_psnr_db", r->psnr},
        {"pixels_off_share", r->off},
        {"worst_steps", r->worst},
        {"worst_x", r->worst_x},
        {"worst_y", r->worst_y},
    };
    memcpy(out, columns, sizeof columns);
}

// POV-Ray's hits are not known: only its picture.
static bool is_known(const SweepResult *r, int column) {
    return !r->point.povray || column < OF_EVERY || column >= COLUMNS - OF_THE_PICTURE;
}

static const char *method_of(const SweepPoint *p) {
    return p->povray ? "povray" : patch_method_name(p->method);
}

static bool is_qi(const SweepPoint *p) { return !p->povray && p->method == METHOD_QI; }

static void write_csv(const Sweep *const *sweeps, size_t count, const char *path) {
    OutputFile *file = file_begin(path);
    FILE *out = file_stream(file);
    const SweepResult none = {0};
    Column columns[COLUMNS];
    columns_of(&none, columns);
    fputs("scene,method,prepare,tolerance,u_steps,flatness,failed,front", out);
    for (int k = 0; k < COLUMNS; k++)
        fprintf(out, ",%s", columns[k].name);
    putc('\n', out);
    for (size_t i = 0; i < count; i++)
        for (size_t n = 0; n < sweeps[i]->count; n++) {
            const SweepResult *r = &sweeps[i]->results[n];
            fprintf(out, "%s,%s,", file_name(sweeps[i]->scene), method_of(&r->point));
            if (is_qi(&r->point))
                fputs(patch_prepare_name(r->point.prepare), out);
            if (r->point.steps < 0)
                fprintf(out, ",%g,,,", r->point.tolerance);
            else
                fprintf(out, ",,%d,%g,", r->point.steps, r->point.flatness);
            fprintf(out, "%s,%d", r->failed ? r->failed : "", r->front);
            columns_of(r, columns);
            for (int k = 0; k < COLUMNS; k++) {
                putc(',', out);
                if (!r->failed && is_known(r, k))
                    fprintf(out, "%.9g", columns[k].value);
            }
            putc('\n', out);
        }
    file_commit(file);
}

static json_t *result_json(const SweepResult *r) {
    json_t *object = json_object();
    json_object_set_new(object, "method", json_string(method_of(&r->point)));
    if (r->point.steps < 0) {
        json_object_set_new(object, "tolerance", json_real(r->point.tolerance));
    } else {
        json_object_set_new(object, "u_steps", json_integer(r->point.steps));
        json_object_set_new(object, "flatness", json_real(r->point.flatness));
    }
    if (is_qi(&r->point))
        json_object_set_new(object, "prepare", json_string(patch_prepare_name(r->point.prepare)));
    json_object_set_new(object, "front", json_boolean(r->front));
    if (r->failed)
        json_object_set_new(object, "failed", json_string(r->failed));
    Column columns[COLUMNS];
    columns_of(r, columns);
    // JSON has no infinity: the PSNR of equal pictures is left out.
    for (int k = 0; k < COLUMNS; k++)
        if (!r->failed && is_known(r, k) && isfinite(columns[k].value))
            json_object_set_new(object, columns[k].name, json_real(columns[k].value));
    return object;
}

static void write_json(const Sweep *const *sweeps, size_t count, const char *command,
                       const char *path) {
    Arena *arena = arena_create();
    struct utsname system;
    uname(&system);
    json_t *root = json_object(), *scenes = json_array();
    json_object_set_new(root, "qipov", json_string(QIPOV_VERSION));
    json_object_set_new(root, "machine", json_string(run_machine(arena)));
    json_object_set_new(root, "system",
                        json_string(arena_printf(arena, "%s %s", system.sysname, system.release)));
    json_object_set_new(root, "isa", json_string(patch_isa_name()));
    json_object_set_new(root, "compiler", json_string(__VERSION__));
    json_object_set_new(root, "command", json_string(command));
    for (size_t i = 0; i < count; i++) {
        json_t *scene = json_object(), *results = json_array();
        json_object_set_new(scene, "scene", json_string(file_name(sweeps[i]->scene)));
        json_object_set_new(scene, "patches", json_integer(sweeps[i]->patches));
        json_object_set_new(scene, "width", json_integer(sweeps[i]->width));
        json_object_set_new(scene, "height", json_integer(sweeps[i]->height));
        json_object_set_new(scene, "shared_edges", json_integer((json_int_t)sweeps[i]->edges));
        json_object_set_new(scene, "edge_rays", json_integer((json_int_t)sweeps[i]->edge_rays));
        if (sweeps[i]->povray_version)
            json_object_set_new(scene, "povray", json_string(sweeps[i]->povray_version));
        json_object_set_new(scene, "rounds", json_integer(sweeps[i]->rounds));
        for (size_t n = 0; n < sweeps[i]->count; n++)
            json_array_append_new(results, result_json(&sweeps[i]->results[n]));
        json_object_set_new(scene, "results", results);
        json_array_append_new(scenes, scene);
    }
    json_object_set_new(root, "scenes", scenes);
    char *text = json_dumps(root, JSON_INDENT(1) | JSON_REAL_PRECISION(9));
    OutputFile *file = file_begin(path);
    fputs(text, file_stream(file));
    putc('\n', file_stream(file));
    file_commit(file);
    free(text);
    json_decref(root);
    arena_destroy(arena);
}

void sweep_write(const Sweep *const *sweeps, size_t count, const char *folder,
                 const char *command) {
    Arena *arena = arena_create();
    write_csv(sweeps, count, arena_printf(arena, "%s/sweep.csv", folder));
    write_json(sweeps, count, command, arena_printf(arena, "%s/sweep.json", folder));
    sweep_page_write(sweeps, count, command, arena_printf(arena, "%s/index.html", folder));
    arena_destroy(arena);
}
