// SPDX-License-Identifier: MIT
// POV-Ray's command line -> one struct. facts: sdl 5. The value is glued to its switch, letters in
// any case, '+' and '-' alike except where a boolean is meant; later words win.
#ifndef OPTIONS_OPTIONS_H
#define OPTIONS_OPTIONS_H

#include "base/arena.h"
#include "image/image.h"
#include "patch/patch.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    const char *name;
    double value;
} OptionDeclare;

typedef struct {
    const char *input;   // +I, Input_File_Name=, or a bare name ending in .pov or .json; NULL: none
    const char *output;  // +O as given; NULL: beside the input
    bool output_to_file; // -F turns it off
    int width, height;
    double start_row, end_row, start_column, end_column; // 1-based inclusive; < 0: not given
    bool antialias;
    double antialias_threshold; // default 0.3, clipped to 0..1
    int sampling_method;        // 1, 2
    int antialias_depth;        // 1..9, default 3
    bool jitter;
    double jitter_amount; // 0..1, default 1
    double antialias_gamma;
    int quality; // 0..9
    ImageFormat format;
    bool format_given; // else the output's extension decides
    int bits;          // per channel, default 8
    bool grayscale;
    bool compressed;
    bool alpha;        // +UA
    double file_gamma; // 0: sRGB
    const char **library_paths;
    size_t library_path_count;
    OptionDeclare *declares;
    size_t declare_count;
    double clock; // single precision, as POV-Ray has it
    bool clock_given;
    int version; // +MV x 100; 0: not given
    int threads; // +WT; 0: all cores
    bool verbose, display, pause;
    PatchMethod method;
    double tolerance; // --tolerance, relative to the patch (PatchSetOptions)
    bool strict;
    bool binary; // pov2qi
    bool help, show_version;
    const char **rest; // what follows "--", for qicompare
    size_t rest_count;
} RenderOptions;

// ORDER program: which words a program takes
typedef enum { PROGRAM_QIRENDER, PROGRAM_POV2QI, PROGRAM_QICOMPARE } OptionsProgram;

RenderOptions options_default(void);

// Parses argv[1..]. A wrong word prints a message that names it and suggests the nearest, and a
// hint at --help; the return value is then false (exit status 2). Memory in arena.
bool options_parse(OptionsProgram program, int argc, char **argv, Arena *arena,
                   RenderOptions *options);

// The text of --help for that program, on standard output.
void options_help(OptionsProgram program);

// The path to write: options->output with POV-Ray's rules (directory, added extension), or the
// input's name with the format's extension. "-": standard output.
const char *options_output_path(const RenderOptions *options, Arena *arena, const char *extension);

#endif
