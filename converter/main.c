// SPDX-License-Identifier: MIT
// pov2qi: a POV-Ray scene becomes a scene file. It behaves as a compiler does: silent when all is
// well, otherwise messages with file, line and column. Exit status: 0 written, 1 wrong input or no
// room for the output, 2 wrong usage.
#include "base/arena.h"
#include "base/diag.h"
#include "converter/convert.h"
#include "model/scene.h"
#include "options/animation.h"
#include "options/options.h"

#include <stdio.h>
#include <string.h>

static void convert(const RenderOptions *o) {
    Arena *arena = arena_create();
    const char *output = options_output_path(o, arena, "qi.json");
    if (o->requires) {
        MissingList missing = {0};
        const Scene *scene = convert_scene_listing(o, arena, &missing);
        requires_print(stdout, o, scene, &missing);
        array_free(&missing);
        arena_destroy(arena);
        return;
    }
    const Scene *scene = convert_scene(o, arena);
    if (!o->check)
        scene_write(scene, output, &(SceneWriteOptions){.binary = o->binary});
    arena_destroy(arena);
}

// Each frame of an animation is a scene of its own: its clock can change everything in it.
static void convert_all(RenderOptions *o) {
    Animation animation;
    if (!animation_of(o, &animation)) {
        convert(o);
        return;
    }
    for (long n = animation.first; n <= animation.last; n += animation.step) {
        animation_set_frame(&animation, (int)n, o);
        convert(o);
    }
}

int main(int argc, char **argv) {
    diag_program("pov2qi");
    Arena *arena = arena_create();
    RenderOptions options = options_default();
    options_read_povray_ini(PROGRAM_POV2QI, arena, &options);
    options.verbose = false; // povray.ini speaks of rendering
    if (!options_parse(PROGRAM_POV2QI, argc, argv, arena, &options))
        return 2;
    if (options_inform(PROGRAM_POV2QI, &options))
        return 0;
    if (!options.input) {
        fputs("pov2qi: error: no scene given (pov2qi scene.pov; pov2qi --help)\n", stderr);
        return 2;
    }
    options.input = options_input_path(&options, arena);
    const char *output = options.output;
    if (options.binary && output && strcmp(output, "-") == 0) {
        fputs("pov2qi: error: --binary needs a file beside which its second file can stand\n",
              stderr);
        return 2;
    }
    diag_strict(options.strict);
    diag_verbose(options.verbose);
    options_report(&options);
    if (options.create_ini)
        options_write_ini(&options, options.create_ini);
    convert_all(&options);
    arena_destroy(arena);
    return 0;
}
