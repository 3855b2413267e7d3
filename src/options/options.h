// SPDX-License-Identifier: MIT
// POV-Ray's command line -> one struct. facts: sdl 5. The value is glued to its switch, letters in
// any case, '+' and '-' alike except where a boolean is meant; later words win. The INI forms
// Keyword=value mean the same as the switches.
#ifndef OPTIONS_OPTIONS_H
#define OPTIONS_OPTIONS_H

#include "base/arena.h"
#include "base/console.h"
#include "base/diag.h"
#include "image/image.h"
#include "patch/patch.h"

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    const char *name;
    double value;
} OptionDeclare;

enum { FRAME_NONE = INT_MIN };

// One frame of an animation, as the scene sees it; its clock is RenderOptions.clock.
typedef struct {
    int number, initial, final;
    int digits; // of the number in the file's name; 0: no animation
    double initial_clock, final_clock, clock_delta;
} OptionFrame;

// What is to be said of an option that was taken, but not followed.
typedef struct {
    Loc loc; // no file: on the command line
    const char *text;
    bool warning;
} OptionRemark;

// ORDER dither_method (dither_codes in table.c)
typedef enum {
    DITHER_NONE,
    DITHER_B2, // patterns of 2 x 2, 3 x 3 and 4 x 4 pixels
    DITHER_B3,
    DITHER_B4,
    DITHER_D1, // what is lost goes to the next pixel of the row
    DITHER_D2, // ... and to those below
    DITHER_FS, // Floyd and Steinberg
} DitherMethod;

// ORDER aov (names in table.c): what --aov writes of the nearest hit of each pixel's middle
typedef enum {
    AOV_DEPTH,
    AOV_NORMAL,
    AOV_UV,
    AOV_PATCH,
    AOV_STEPS,
    AOV_BOUND,
    AOV_OBJECT,
    AOV_COUNT,
} AovKind;

// How much the reading of a scene may take. ORDER limit (limit_names)
typedef enum {
    LIMIT_CALLS,     // macro calls inside one another
    LIMIT_ELEMENTS,  // of all arrays
    LIMIT_INCLUDES,  // inside one another
    LIMIT_MEGABYTES, // of memory
    LIMIT_NESTING,   // of braces and parentheses
    LIMIT_OBJECTS,   // all copies counted
    LIMIT_SECONDS,
    LIMIT_STRING, // bytes of one
    LIMIT_TOKENS, // read in all, loops and macros as often as they run
    LIMIT_COUNT,
} Limit;

// ORDER bench_command (names in options.c): what qibench is to do, its first word
typedef enum { BENCH_TRACE, BENCH_SPEED, BENCH_SWEEP, BENCH_COMMANDS } BenchCommand;

typedef struct {
    BenchCommand command;
    const char **words; // bare names: a file, tables, scenes
    size_t word_count;
    int rounds; // odd; 0: not given
    bool method_given, tolerance_given;
    double share;     // of the rays, 1e-4..1
    const char *view; // NULL: all
    int patches;      // the most of the lattices
    const char *html; // a folder; NULL: no page
    double patience;  // seconds, from 1 on
    bool povray;      // run POV-Ray too
    bool study;       // print the study instead of the table
} BenchOptions;

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
    bool dither;
    DitherMethod dither_method; // used only with dither
    bool clockless;             // +KLA: of several cameras the first one is meant
    const char **library_paths;
    size_t library_path_count;
    const char **write_folders; // --allow-write: where #write may make files
    size_t write_folder_count;
    OptionDeclare *declares;
    size_t declare_count;
    double clock; // single precision, as POV-Ray has it
    bool clock_given;
    // Animation (animation.h).
    int initial_frame, final_frame;    // FRAME_NONE: not given
    double initial_clock, final_clock; // single precision
    bool cyclic;
    double subset_start, subset_end; // numbers of frames, or shares below 1; < 0: not given
    int frame_step;
    OptionFrame frame;   // the one to render; zeroes: no animation
    int version;         // +MV x 100; 0: not given
    int threads;         // +WT; 0: all cores
    bool continue_trace; // +C: take up what an interrupted run has kept
    const char *state;   // where a run keeps its finished tiles, set by the program; NULL: nowhere
    bool verbose, display, pause;
    bool console[CONSOLE_COUNT];             // is the stream shown?
    const char *console_file[CONSOLE_COUNT]; // a copy of it; NULL: none
    const char *all_file;                    // one of all streams
    bool append_file;                        // to files that are there
    PatchMethod method;
    int finer;            // --finer: facets cuts the patches so many times more
    PatchPrepare prepare; // --prepare
    bool prepare_given;   // else by the patches and pixels there are
    double tolerance;     // --tolerance, relative to the patch (PatchSetOptions)
    double pixels;        // the same in pixels, in place of it; 0: not given
    double nudge[2];      // --nudge: camera rays moved by so many pixels, right and down
    int pixel[2];         // --pixel: column and row from 0; -1: none
    bool explain;         // --explain
    unsigned aovs;        // --aov: bit 1 << AovKind each
    bool strict;
    bool patch_solids;   // closed unions of patches with an interior are solids
    bool binary;         // pov2qi
    bool check;          // pov2qi: read the scene, write nothing
    bool requires, json; // pov2qi: list what the scene needs, write nothing
    bool help, show_version, manual, completion; // what options_inform prints
    uint64_t limits[LIMIT_COUNT];                // --limit; 0: not given
    // qicompare only.
    const char *pictures[2]; // bare names of pictures
    int picture_count;
    const char **scenes; // bare names of scenes
    size_t scene_count;
    int region[4]; // --region: left, top, width, height in pixels; width 0: the whole picture
    int places;    // how many of the worst places are looked into
    double fail, fail_percent, warn, warn_percent; // as OpenImageIO's idiff has them
    const char **shared;                           // the words that povray understands, as given
    size_t shared_count;
    const char **own; // the words for qirender alone (--method ...), as given
    size_t own_count;
    BenchOptions bench;         // qibench only
    const char *povray_ini;     // the one that was read; NULL: none
    const char *include_header; // read before the scene; NULL: none
    const char *create_ini;     // where to write the settings; NULL: nowhere
    OptionRemark *remarks;
    size_t remark_count;
} RenderOptions;

// ORDER program: which words a program takes
typedef enum {
    PROGRAM_QIRENDER,
    PROGRAM_POV2QI,
    PROGRAM_QICOMPARE,
    PROGRAM_QIBENCH,
} OptionsProgram;

// The named tolerances, the coarsest first: points of the curve of time against error; README has
// what they were measured to give.
typedef struct {
    const char *name;
    double tolerance, pixels; // as in RenderOptions
} Accuracy;
enum { ACCURACY_COUNT = 4 };
extern const Accuracy options_accuracies[ACCURACY_COUNT];

RenderOptions options_default(void);
const char *options_limit_name(Limit limit);

// Parses argv[1..]. A wrong word prints a message that names it and suggests the nearest, and a
// hint at --help; the return value is then false (exit status 2). Memory in arena. For qicompare,
// words after "--" are read like those before it.
bool options_parse(OptionsProgram program, int argc, char **argv, Arena *arena,
                   RenderOptions *options);

// Reads the povray.ini that POV-Ray would read: the first of $POVINI, ./povray.ini,
// ~/.povray/3.7/povray.ini, /etc/povray/3.7/povray.ini, ~/.povrayrc, /etc/povray.ini. To be called
// before options_parse, whose words then win. With one, a size it does not give is POV-Ray's 160 x
// 120; without one, the options stay as they are. Dies at what is wrong in it.
void options_read_povray_ini(OptionsProgram program, Arena *arena, RenderOptions *options);

// Writes the options as an INI file, which read again gives the same options: POV-Ray's, without
// create_ini and what --words say. Dies if it cannot.
void options_write_ini(const RenderOptions *options, const char *path);

// Opens the streams of messages (base/console.h), then prints what the parsing had to remark. To be
// called when the diagnostics know of --strict and -V: with the first a warning is an error.
void options_report(const RenderOptions *options);

// Prints on standard output what was asked for instead of work (--help, --version, --man,
// --completion). False: nothing was.
bool options_inform(OptionsProgram program, const RenderOptions *options);

// The scene that is meant: options->input, or with ".pov" added if only that is there. NULL if none
// was given.
const char *options_input_path(const RenderOptions *options, Arena *arena);

// The path to write: options->output with POV-Ray's rules (directory, added extension), or the
// input's name with the format's extension. "-": standard output.
const char *options_output_path(const RenderOptions *options, Arena *arena, const char *extension);

#endif
