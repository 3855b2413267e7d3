// SPDX-License-Identifier: MIT
// qirender: a scene to a picture. Options -> scene (converted from POV-Ray's language, or read) ->
// render -> file -> statistics.
#include "base/console.h"
#include "base/diag.h"
#include "base/file.h"
#include "base/usage.h"
#include "base/version.h"
#include "converter/convert.h"
#include "options/animation.h"
#include "render/explain.h"
#include "render/render.h"
#include "render/resume.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

// The first time the tiles at work are finished; the second time nothing is.
static void on_interrupt(int number) {
    static volatile sig_atomic_t times;
    (void)number;
    render_interrupted = 1;
    if (times++ == 0)
        return;
    static const char message[] = "\nqirender: interrupted, nothing written\n";
    ssize_t written = write(STDERR_FILENO, message, sizeof message - 1);
    (void)written;
    _exit(2);
}

// Says what is missing, and how to get it.
_Noreturn static void end_interrupted(const RenderOptions *o, const char *output,
                                      const RenderStats *s) {
    fprintf(stderr, "\nqirender: interrupted at %.0f %%", 100.0 * s->share);
    if (o->output_to_file)
        fprintf(stderr, ", '%s' is not written", output);
    fputs(s->kept ? "; the same command with +C goes on from there\n" : "\n", stderr);
    if (o->state && !s->kept)
        fprintf(stderr, "qirender: cannot keep what is finished in '%s'\n", o->state);
    exit(2);
}

// A long render should not end with the news that its folder cannot be written.
static void check_output(const char *path, Arena *arena) {
    struct stat st;
    if (strcmp(path, "-") == 0)
        return;
    if (stat(path, &st) == 0 && S_ISDIR(st.st_mode))
        die("cannot write '%s': is a directory (a folder's name ends in '/')", path);
    if (access(file_folder(arena, path), W_OK) != 0)
        die("cannot write '%s': %s", path, strerror(errno));
}

static bool is_scene_file(const char *path) {
    size_t length = strlen(path);
    return length > 5 && strcasecmp(path + length - 5, ".json") == 0;
}

// ---- statistics ------------------------------------------------------------------------------

static void print_count(const char *what, uint64_t count) {
    if (count)
        console_print(CONSOLE_STATISTIC, "  %-22s %15llu\n", what, (unsigned long long)count);
}

// A count and what it is of another ("1.07 a ray").
static void print_share(const char *what, uint64_t count, uint64_t of, const char *unit) {
    if (count)
        console_print(CONSOLE_STATISTIC, "  %-22s %15llu   %.3g %s\n", what,
                      (unsigned long long)count, of ? (double)count / (double)of : 0.0, unit);
}

static void print_statistics(const RenderOptions *o, const RenderStats *s, double read_seconds) {
    const RayStats *r = &s->rays;
    const char *rule =
        "----------------------------------------------------------------------------";
    console_print(CONSOLE_STATISTIC, "%s\nRender statistics: %d x %d, %s, %d thread%s\n%s\n", rule,
                  o->width, o->height, patch_method_name(o->method), s->threads,
                  s->threads == 1 ? "" : "s", rule);
    print_count("Pixels", s->pixels);
    print_count("Pixels taken up", s->taken_up);
    print_count("Pixels supersampled", s->supersampled);
    print_share("Camera rays", s->samples, s->pixels, "a pixel");
    print_count("Reflected rays", r->reflected);
    print_count("Refracted rays", r->refracted);
    print_count("Transmitted rays", r->transmitted);
    print_count("Shadow rays", r->shadow);

    uint64_t rays = s->samples + r->reflected + r->refracted + r->transmitted + r->shadow;
    print_count("Patches", s->patches);
    print_share("Patch tests", r->patch.patch_tests, rays, "a ray");
    print_share(o->method == METHOD_FACETS ? "Triangle tests" : "QI steps", r->patch.steps, rays,
                "a ray");
    print_share("Newton steps", r->patch.newton, r->patch.hits, "a hit");
    print_share("Patch hits", r->patch.hits, rays, "a ray");
    print_count("Other shape tests", r->shape_tests);
    print_count("Other shape hits", r->shape_hits);

    console_print(CONSOLE_STATISTIC, "%s\n", rule);
    console_print(CONSOLE_STATISTIC, "  Reading the scene      %15.3f s\n", read_seconds);
    console_print(CONSOLE_STATISTIC,
                  "  Preparing the patches  %15.3f s   %.1f MB, %.0f bytes a patch\n",
                  s->prepare_seconds, (double)s->memory / 1e6,
                  s->patches ? (double)s->memory / (double)s->patches : 0.0);
    console_print(CONSOLE_STATISTIC, "  Tracing                %15.3f s   %.3g rays/s\n",
                  s->trace_seconds, s->trace_seconds > 0 ? (double)rays / s->trace_seconds : 0.0);
    console_print(CONSOLE_STATISTIC,
                  "  Processor time         %15.3f s   peak memory %.0f MB\n%s\n", usage_process(),
                  usage_peak_megabytes(), rule);
}

// ---- main ----------------------------------------------------------------------------------

// POV-Ray renders a scene without objects: a sky may be all that is wanted, or the objects of an
// animation come later. Where there is not even a light the file is mostly one to be included.
static void check_not_empty(const Scene *scene, const char *file, Arena *arena) {
    const Color *b = &scene->settings.background;
    if (scene->root_count > 0 || scene->has_sky_sphere || b->r != 0 || b->g != 0 || b->b != 0)
        return;
    const char *text = file_read(arena, file, NULL, NULL);
    if (text && text[strspn(text, " \t\r\n")] == '\0')
        die("'%s' is empty: there is nothing to render", file);
    if (scene->light_count == 0)
        warn("'%s' shows no lights, no sky_sphere and no background either: the picture is black; "
             "is it to be included by another file?",
             file);
}

// The picture, and its further channels: in one EXR file, or in one beside it.
static void write_output(const RenderOptions *o, const char *output, const Image *image,
                         const ImageWriteOptions *write, const RenderStats *stats) {
    if (!stats->layers || o->format != IMAGE_EXR)
        image_write(output, image, write);
    if (!stats->layers)
        return;
    Arena *scratch = arena_create();
    const char *path = output, *dot = strrchr(file_name(output), '.');
    size_t stem = dot ? (size_t)(dot - output) : strlen(output);
    if (o->format != IMAGE_EXR)
        path = strcmp(output, "-") == 0 ? "aov.exr"
                                        : arena_printf(scratch, "%.*s.aov.exr", (int)stem, output);
    image_write_layers(path, stats->layers, write->software);
    if (o->verbose && path != output)
        console_print(CONSOLE_RENDER, "%s\n", path);
    arena_destroy(scratch);
}

// One picture: a scene read, rendered and written.
static void render_picture(RenderOptions *o, bool frame) {
    Arena *arena = arena_create();
    const char *output = options_output_path(o, arena, image_extension(o->format));
    bool to_file = o->output_to_file && strcmp(output, "-") != 0;
    if (o->output_to_file && o->pixel[0] < 0)
        check_output(output, arena);
    o->state = to_file ? arena_printf(arena, "%s.qi-state", output) : NULL;
    if (frame && o->continue_trace && to_file && file_exists(output)) {
        if (o->verbose)
            console_print(CONSOLE_RENDER, "%s is there already\n", output);
        arena_destroy(arena);
        return;
    }

    // Writing a file takes over the signals: for each picture anew.
    signal(SIGINT, on_interrupt);
    signal(SIGTERM, on_interrupt);
    double start = usage_clock();
    const Scene *scene =
        is_scene_file(o->input) ? scene_read(o->input, arena) : convert_scene(o, arena);
    double read_seconds = usage_clock() - start;
    check_not_empty(scene, o->input, arena);

    if (o->pixel[0] >= 0) {
        render_pixel(scene, o, stdout);
        arena_destroy(arena);
        return;
    }
    RenderStats stats;
    ImageWriteOptions write;
    Image *image = render_scene(scene, o, arena, &write, &stats);
    if (!image)
        end_interrupted(o, output, &stats);
    write.software = "qipov " QIPOV_VERSION;
    if (o->output_to_file)
        write_output(o, output, image, &write, &stats);
    if (o->state)
        resume_remove(o->state);
    if (o->explain) // a picture on standard output stays alone there
        explain_print(scene, o, &stats,
                      o->output_to_file && strcmp(output, "-") == 0 ? stderr : stdout);
    if (o->verbose) {
        print_statistics(o, &stats, read_seconds);
        if (to_file)
            console_print(CONSOLE_RENDER, "%s\n", output);
    }
    arena_destroy(arena);
}

// The scene is read anew for each frame: its clock can change everything in it.
static void render_animation(const Animation *animation, RenderOptions *o) {
    if (is_scene_file(o->input))
        die("an animation needs the .pov scene: in '%s' nothing depends on the clock any more",
            o->input);
    const OptionFrame *frame = &animation->frame;
    if (frame->initial == frame->final)
        warn("the only frame is the initial and the final one: its clock is not a number (+Kx "
             "without +KFF gives one picture)");
    for (long number = animation->first; number <= animation->last; number += animation->step) {
        animation_set_frame(animation, (int)number, o);
        if (o->verbose)
            console_print(CONSOLE_RENDER, "frame %ld of %d to %d, clock %g\n", number,
                          animation->first, animation->last, o->clock);
        render_picture(o, true);
    }
}

static void render(RenderOptions *o) {
    Animation animation;
    render_check(o);
    if (animation_of(o, &animation))
        render_animation(&animation, o);
    else
        render_picture(o, false);
}

int main(int argc, char **argv) {
    diag_program("qirender");
    Arena *arena = arena_create();
    RenderOptions options = options_default();
    options_read_povray_ini(PROGRAM_QIRENDER, arena, &options);
    if (!options_parse(PROGRAM_QIRENDER, argc, argv, arena, &options))
        return 2;
    if (options_inform(PROGRAM_QIRENDER, &options))
        return 0;
    diag_strict(options.strict);
    diag_verbose(options.verbose);
    options_report(&options);
    if (!options.input) {
        fputs("qirender: error: no scene given (qirender scene.pov; qirender --help)\n", stderr);
        return 2;
    }
    options.input = options_input_path(&options, arena);
    if (options.create_ini)
        options_write_ini(&options, options.create_ini);
    render(&options);
    arena_destroy(arena);
    return 0;
}
