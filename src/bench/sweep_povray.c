// SPDX-License-Identifier: MIT
// The words are replaced by sed in all .pov and .inc of the copy: a scene that computes its steps
// is left as it is, and then all steps give the same picture, which the caller sees.
#include "bench/sweep_povray.h"

#include "base/diag.h"
#include "base/file.h"
#include "report/run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *shell(Arena *arena, const SweepCopy *copy, const char *script) {
    Command command = {.count = 0};
    run_add(&command, "sh");
    run_add(&command, "-c");
    run_add(&command, script);
    char *log = arena_printf(arena, "%s/log.txt", copy->folder);
    return run_command_line(&command, "sh", log, arena).log;
}

// In single quotes for a shell.
static const char *quote(Arena *arena, const char *text) {
    char *out = arena_strdup(arena, "'");
    for (; *text; text++)
        out = arena_printf(arena, *text == '\'' ? "%s'\\'%c'" : "%s%c", out, *text);
    return arena_printf(arena, "%s'", out);
}

typedef struct {
    const SweepOptions *options;
    const SweepCopy *copy;
    Arena *arena;
    int width, height;
    Run run;
} Render;

static void render(void *context) {
    Render *r = context;
    Command command = {.count = 0};
    long kilobytes = sysconf(_SC_PHYS_PAGES) / 2 * (sysconf(_SC_PAGESIZE) / 1024);
    run_add(&command, "sh");
    run_add(&command, "-c");
    run_add(&command,
            arena_printf(r->arena,
                         "cd %s/scene && ulimit -t %.0f && ulimit -v %ld && exec taskset -c 0 "
                         "povray +I%s +Oout.png +W%d +H%d -A -D -P +WT1 +FN16",
                         r->copy->folder, ceil(r->options->patience + r->copy->seconds), kilobytes,
                         quote(r->arena, r->copy->scene), r->width, r->height));
    r->run = run_command_line(&command, "POV-Ray",
                              arena_printf(r->arena, "%s/log.txt", r->copy->folder), r->arena);
}

static const char *render_at(Render *r, int steps) {
    shell(r->arena, r->copy,
          arena_printf(
              r->arena,
              "cd %s/scene && sed -E -i "
              "'s/(u_steps|v_steps)[[:space:]]+[0-9A-Za-z_]+/\\1 %d/g; "
              "s/flatness[[:space:]]+[0-9.A-Za-z_]+/flatness 0/g' $(ls *.pov *.inc 2>/dev/null)",
              r->copy->folder, steps));
    char *message = NULL;
    if (diag_catch(render, r, &message))
        return NULL;
    const char *why = strstr(message, "interrupted")                              ? "too slow"
                      : strstr(message, "memory") || strstr(message, "bad_alloc") ? "too large"
                                                                                  : "fails";
    free(message);
    return why;
}

const char *sweep_povray_begin(const SweepOptions *o, SweepCopy *copy, Arena *arena) {
    if (system("command -v povray >/dev/null 2>&1") != 0)
        return "povray is not installed";
    strcpy(copy->folder, "/tmp/qibench-XXXXXX");
    if (!mkdtemp(copy->folder))
        return "no temporary folder can be made";
    copy->scene = file_name(o->scene);
    char *script = arena_printf(arena, "cp -rL %s. %s/scene",
                                quote(arena, file_folder(arena, o->scene)), copy->folder);
    for (size_t i = 0; i < o->library_path_count; i++)
        script = arena_printf(arena, "%s && cp -L %s/*.inc %s/scene 2>/dev/null; true", script,
                              quote(arena, o->library_paths[i]), copy->folder);
    shell(arena, copy, script);
    copy->seconds = o->patience; // to read it
    const char *said =
        shell(arena, copy, "povray --version 2>&1 | grep -o -m1 'POV-Ray [0-9][^ ]*'");
    copy->version = arena_printf(arena, "%.*s", (int)strcspn(said, "\n"), said);
    Render reading = {o, copy, arena, 1, 1, {0}},
           plain = {o, copy, arena, o->width, o->height, {0}};
    const char *why = render_at(&reading, 0);
    if (!why)
        why = render_at(&plain, 0);
    copy->seconds = reading.run.seconds;
    copy->megabytes = plain.run.megabytes;
    if (why)
        sweep_povray_end(copy);
    return why ? arena_printf(arena, "POV-Ray does not read the scene: %s", why) : NULL;
}

void sweep_povray_end(const SweepCopy *copy) {
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", copy->folder);
    if (system(command) != 0)
        warn("'%s' stays behind", copy->folder);
}

const char *sweep_povray(const SweepOptions *o, const SweepCopy *copy, int steps, SweepPovray *run,
                         Image **picture, Arena *arena) {
    Render whole = {o, copy, arena, o->width, o->height, {0}};
    const char *why = render_at(&whole, steps);
    if (why)
        return why;
    run->seconds = whole.run.seconds - copy->seconds;
    run->used = whole.run.seconds;
    run->megabytes = whole.run.megabytes - copy->megabytes;
    *picture = image_read(arena, arena_printf(arena, "%s/scene/out.png", copy->folder));
    return NULL;
}
