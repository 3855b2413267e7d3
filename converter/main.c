// SPDX-License-Identifier: MIT
// pov2qi: a POV-Ray scene becomes a scene file. It behaves as a compiler does: silent when all is
// well, otherwise messages with file, line and column. Exit status: 0 written, 1 wrong input or no
// room for the output, 2 wrong usage.
#include "base/arena.h"
#include "base/diag.h"
#include "base/version.h"
#include "converter/convert.h"
#include "model/scene.h"
#include "options/options.h"

#include <stdio.h>
#include <string.h>

int main(int argc, char **argv) {
    diag_program("pov2qi");
    Arena *arena = arena_create();
    RenderOptions options = options_default();
    options_read_povray_ini(PROGRAM_POV2QI, arena, &options);
    if (!options_parse(PROGRAM_POV2QI, argc, argv, arena, &options))
        return 2;
    if (options.help) {
        options_help(PROGRAM_POV2QI);
        return 0;
    }
    if (options.show_version) {
        puts("pov2qi " QIPOV_VERSION);
        return 0;
    }
    if (!options.input) {
        fputs("pov2qi: error: no scene given (pov2qi scene.pov; pov2qi --help)\n", stderr);
        return 2;
    }
    options.input = options_input_path(&options, arena);
    const char *output = options_output_path(&options, arena, "qi.json");
    if (options.binary && strcmp(output, "-") == 0) {
        fputs("pov2qi: error: --binary needs a file beside which its second file can stand\n",
              stderr);
        return 2;
    }
    diag_strict(options.strict);
    options_report(&options);
    if (options.create_ini)
        options_write_ini(&options, options.create_ini);
    const Scene *scene = convert_scene(&options, arena);
    scene_write(scene, output, &(SceneWriteOptions){.binary = options.binary});
    arena_destroy(arena);
    return 0;
}
