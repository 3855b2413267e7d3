// SPDX-License-Identifier: MIT
// POV-Ray's command line -> one struct. facts: sdl 5. The value is glued to its switch, letters in
// any case, '+' and '-' alike except where a boolean is meant; later words win. The INI forms
// Keyword=value mean the same as the switches.
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
    const char *output;  // +O as given; NULL: beside the input; qicompare: a folder
    bool output_to_file; // -F turns it off
    int width, height;
    // 1-based inclusive, or shares of the size (render_area); < 0: not given.
    double start_row, end_row, start_column, end_column;
    int block_size; // +BS: side of a tile in pixels, default 32; method 1 depends on it
    bool antialias;
    double antialias_threshold; // default 0.3, clipped to 0..1
    int sampling_method;        // 1, 2
    int antialias_depth;        // 1..9, default 3
    bool jitter;
    double jitter_amount;   // 0..1, default 1
    double antialias_gamma; // default 2.5
    int quality;            // 0..9
    ImageFormat format;
    bool format_given; // by +F or Output_File_Type=; else the output's extension has decided
    int bits;          // per channel, 5..16, default 8
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
    // qicompare only.
    const char *pictures[2]; // bare names of pictures
    int picture_count;
    double fail, fail_percent, warn, warn_percent; // as OpenImageIO's idiff has them
    const char **shared;                           // the words that povray understands, as given
    size_t shared_count;
    const char **own; // the words for qirender alone (--method ...), as given
    size_t own_count;
} RenderOptions;

// ORDER program: which words a program takes
typedef enum { PROGRAM_QIRENDER, PROGRAM_POV2QI, PROGRAM_QICOMPARE } OptionsProgram;

RenderOptions options_default(void);

// Parses argv[1..]. A wrong word prints a message that names it and suggests the nearest, and a
// hint at --help; the return value is then false (exit status 2). Memory in arena. For qicompare,
// words after "--" are read like those before it.
bool options_parse(OptionsProgram program, int argc, char **argv, Arena *arena,
                   RenderOptions *options);

// The text of --help for that program, on standard output.
void options_help(OptionsProgram program);

// The scene that is meant: options->input, or with ".pov" added if only that is there. NULL if none
// was given.
const char *options_input_path(const RenderOptions *options, Arena *arena);

// The path to write: options->output with POV-Ray's rules (directory, added extension), or the
// input's name with the format's extension. "-": standard output.
const char *options_output_path(const RenderOptions *options, Arena *arena, const char *extension);

#endif
