// SPDX-License-Identifier: MIT
// The options themselves (facts: sdl 5.2).
#include "options/table.h"

#include "options/table_bench.h"
#include "options/table_values.h"

#define FIELD(name) .offset = offsetof(RenderOptions, name)
#define CLIP(least, most) .low = (least), .high = (most)
#define HEADING(text)                                                                              \
    { .kind = OPTION_HEADING, .programs = IN_EVERY, .help = (text) }
#define DRAWS (IN_QIRENDER | IN_QICOMPARE)
#define IGNORED(switch_letters, ini, what)                                                         \
    {                                                                                              \
        .kind = OPTION_IGNORED, .letters = (switch_letters), .keyword = (ini), .value = (what),    \
        .programs = IN_ALL                                                                         \
    }

#define COMMAND(ini)                                                                               \
    {                                                                                              \
        .kind = OPTION_SPECIAL, .keyword = (ini), .value = "command", .programs = IN_ALL,          \
        .apply = option_apply_command                                                              \
    }
#define STREAM(letters_of, name, which, what)                                                      \
    {OPTION_SPECIAL,                                                                               \
     letters_of,                                                                                   \
     NULL,                                                                                         \
     NULL,                                                                                         \
     "[name]",                                                                                     \
     IN_ALL,                                                                                       \
     FIELD(console_file[which]),                                                                   \
     .apply = option_apply_console,                                                                \
     .help = (what)},                                                                              \
        {OPTION_FLAG, NULL, name "_Console", NULL, NULL, IN_ALL, FIELD(console[which])}, {         \
        OPTION_TEXT, NULL, name "_File", NULL, "name", IN_ALL, FIELD(console_file[which])          \
    }
#define FRAMES CLIP(-1e9, 1e9)

// Where one switch sets two things in the INI form, the second stands below it without letters.
const OptionRow option_rows[] = {
    HEADING("Input and output"),
    {OPTION_TEXT, "I", "Input_File_Name", NULL, "name", IN_ALL, FIELD(input),
     .help = "the scene; .pov is added if need be"},
    {OPTION_TEXT, "O", "Output_File_Name", "output", "name", IN_ALL, FIELD(output),
     .help = "the file to write, or a folder if it ends in '/'; - is standard output"},
    {OPTION_SPECIAL, "F", NULL, NULL, "[type][bits|g]", DRAWS, .apply = option_apply_format,
     .help = "type N PNG, T TGA, C packed TGA, P PPM, B BMP, J JPEG, E EXR, H HDR; bits of each "
             "colour (8); g greyscale (N, P). -F writes no file"},
    {OPTION_SPECIAL, NULL, "Output_File_Type", NULL, "type", DRAWS,
     .apply = option_apply_format_keyword},
    {OPTION_FLAG, NULL, "Output_to_File", NULL, NULL, DRAWS, FIELD(output_to_file)},
    {OPTION_INT, NULL, "Bits_Per_Color", NULL, "n", DRAWS, FIELD(bits), CLIP(5, 16)},
    {OPTION_FLAG, NULL, "Grayscale_Output", NULL, NULL, DRAWS, FIELD(grayscale)},
    {OPTION_FLAG, "UA", "Output_Alpha", NULL, NULL, DRAWS, FIELD(alpha),
     .help = "where nothing is, the picture is transparent"},
    {OPTION_SPECIAL, NULL, "File_Gamma", NULL, "x", DRAWS, .apply = option_apply_file_gamma,
     .help = "the gamma of the file: a number, or sRGB (default)"},
    {OPTION_SPECIAL, "TH", NULL, NULL, "[method]", DRAWS, .apply = option_apply_dither,
     .help = "dither the file's values: B2 B3 B4 D1 D2 FS (FS); -TH off"},
    {OPTION_FLAG, NULL, "Dither", NULL, NULL, DRAWS, FIELD(dither)},
    {OPTION_SPECIAL, NULL, "Dither_Method", NULL, "name", DRAWS,
     .apply = option_apply_dither_method},
    {OPTION_SPECIAL, "L", "Library_Path", NULL, "folder", IN_ALL, .apply = option_apply_library,
     .help = "where includes are looked for; may be repeated; so is a bare folder/"},
    {OPTION_SPECIAL, NULL, "Declare", NULL, "name=x", IN_ALL, .apply = option_apply_declare,
     .help = "a number that the scene can use"},
    {OPTION_TEXT, "HI", "Include_Header", NULL, "name", IN_ALL, FIELD(include_header),
     .help = "a file that is included before the scene"},
    {OPTION_TEXT, "GI", "Create_Ini", NULL, "name", IN_QIRENDER | IN_POV2QI, FIELD(create_ini),
     .help = "write these settings to an INI file"},
    {OPTION_SPECIAL, "K", "Clock", NULL, "x", IN_ALL, .apply = option_apply_clock,
     .help = "the value of `clock`"},
    {OPTION_SPECIAL, "MV", "Version", NULL, "x", IN_ALL, .apply = option_apply_version,
     .help = "the version of the language before the scene's #version"},
    {OPTION_FLAG, NULL, NULL, "binary", NULL, IN_POV2QI, FIELD(binary),
     .help = "large arrays to a second file"},
    {OPTION_FLAG, NULL, NULL, "check", NULL, IN_POV2QI, FIELD(check),
     .help = "read the scene to its end and write nothing"},
    {OPTION_FLAG, NULL, NULL, "requires", NULL, IN_POV2QI, FIELD(requires),
     .help = "list what the scene requires, and which of it is not modelled; write nothing"},
    {OPTION_FLAG, NULL, NULL, "json", NULL, IN_POV2QI, FIELD(json),
     .help = "with --requires: the list as JSON"},

    HEADING("Size and part of the picture"),
    {OPTION_INT, "W", "Width", NULL, "n", IN_ALL, FIELD(width), CLIP(-1e9, 1e9),
     .help = "pixels across (800)"},
    {OPTION_INT, "H", "Height", NULL, "n", IN_ALL, FIELD(height), CLIP(-1e9, 1e9),
     .help = "pixels down (600)"},
    {OPTION_NUMBER, "SC", "Start_Column", NULL, "x", DRAWS, FIELD(start_column), CLIP(0, 1e9),
     .help = "the first column, from 1, or a share below 1; the rest stays black"},
    {OPTION_NUMBER, "EC", "End_Column", NULL, "x", DRAWS, FIELD(end_column), CLIP(0, 1e9),
     .help = "the last column, or a share up to 1"},
    {OPTION_NUMBER, "SR", "Start_Row", NULL, "x", DRAWS, FIELD(start_row), CLIP(0, 1e9),
     .help = "the first row"},
    {OPTION_NUMBER, "ER", "End_Row", NULL, "x", DRAWS, FIELD(end_row), CLIP(0, 1e9),
     .help = "the last row"},

    HEADING("Quality"),
    {OPTION_SPECIAL, "A", NULL, NULL, "[0.x]", DRAWS, .apply = option_apply_antialias,
     .help = "anti-aliasing where colours differ by 0.x (0.3); -A off"},
    {OPTION_SPECIAL, NULL, "Antialias", NULL, "on|off", DRAWS,
     .apply = option_apply_antialias_flag},
    {OPTION_NUMBER, NULL, "Antialias_Threshold", NULL, "x", DRAWS, FIELD(antialias_threshold),
     CLIP(0, 1)},
    {OPTION_INT, "AM", "Sampling_Method", NULL, "n", DRAWS, FIELD(sampling_method), CLIP(1, 2),
     .help = "1 compares neighbours (default), 2 corners, adaptively"},
    {OPTION_INT, "R", "Antialias_Depth", NULL, "n", DRAWS, FIELD(antialias_depth), CLIP(1, 9),
     .help = "samples a side (3), 1 to 9"},
    {OPTION_SPECIAL, "J", NULL, NULL, "[x]", DRAWS, .apply = option_apply_jitter,
     .help = "jitter of the samples, 0 to 1 (1); -J off"},
    {OPTION_FLAG, NULL, "Jitter", NULL, NULL, DRAWS, FIELD(jitter)},
    {OPTION_NUMBER, NULL, "Jitter_Amount", NULL, "x", DRAWS, FIELD(jitter_amount), CLIP(0, 1)},
    {OPTION_NUMBER, "AG", "Antialias_Gamma", NULL, "x", DRAWS, FIELD(antialias_gamma),
     CLIP(0.01, 100), .help = "the gamma in which colours are compared (2.5)"},
    {OPTION_INT, "Q", "Quality", NULL, "n", DRAWS, FIELD(quality), CLIP(0, 9),
     .help = "0 quick colours ... 4 shadows ... 9 everything (default)"},
    {OPTION_SPECIAL, NULL, NULL, "method", "name", DRAWS | IN_QIBENCH, .apply = option_apply_method,
     .help = "how patches are met: qi (default), qi-paper, clipping, newton, facets (POV-Ray's "
             "triangles), tessellation (Embree's)",
     .commands = FOR_TRACE | FOR_SPEED},
    {OPTION_INT, NULL, NULL, "finer", "n", DRAWS, FIELD(finer), CLIP(0, 8),
     .help = "facets: u_steps and v_steps n higher than the scene says, flatness a 4^n-th of it"},
    {OPTION_SPECIAL, NULL, NULL, "tolerance", "x", DRAWS | IN_QIBENCH,
     .apply = option_apply_tolerance,
     .help = "the largest error of a hit, as a share of its patch's diameter (1e-9), or of a pixel "
             "there (0.1px)",
     .commands = FOR_TRACE | FOR_SPEED},
    {OPTION_SPECIAL, NULL, NULL, "accuracy", "name", DRAWS, .apply = option_apply_accuracy,
     .help = "a named tolerance: draft (0.1px), pixel (1e-6px), fine (1e-9), exact (1e-14)"},
    {OPTION_FLAG, NULL, NULL, "explain", NULL, IN_QIRENDER, FIELD(explain),
     .help = "after the picture, print what the tolerance cost and what it bought, and what the "
             "next coarser and finer accuracy would change, measured on a sample of the rays"},
    {OPTION_SPECIAL, NULL, NULL, "aov", "list", IN_QIRENDER, .apply = option_apply_aov,
     .help = "more channels, to NAME.aov.exr (with +FE to the picture): depth,normal,uv,patch,"
             "steps,bound,object"},
    {OPTION_SPECIAL, NULL, NULL, "pixel", "x,y", IN_QIRENDER, .apply = option_apply_pixel,
     .help = "instead of a picture, print how this pixel comes about: rays, hits, nets, lights"},
    {OPTION_SPECIAL, NULL, NULL, "nudge", "x,y", IN_QIRENDER, .apply = option_apply_nudge,
     .help =
         "move every camera ray by so many pixels, right and down: what changes at 1e-9 hangs on "
         "the last digits"},
    {OPTION_SPECIAL, NULL, NULL, "prepare", "how", DRAWS | IN_QIBENCH,
     .apply = option_apply_prepare,
     .help = "sub-patches for qi: full, light (few), none (the paper's); full or light by the work",
     .commands = FOR_TRACE | FOR_SPEED},
    {OPTION_SPECIAL, NULL, NULL, "isa", "name", DRAWS | IN_QIBENCH, .apply = option_apply_isa,
     .help = "instruction set for qi: scalar, avx2, avx512 (the best there is; same pictures)"},

    HEADING("Comparing"),
    {OPTION_NUMBER, NULL, NULL, "fail", "x", IN_QICOMPARE, FIELD(fail), CLIP(0, 1e9),
     .help = "a pixel fails when a channel differs by more than x (1e-6; full range is 1)"},
    {OPTION_NUMBER, NULL, NULL, "failpercent", "x", IN_QICOMPARE, FIELD(fail_percent), CLIP(0, 100),
     .help = "so many percent of the pixels may fail (0)"},
    {OPTION_NUMBER, NULL, NULL, "warn", "x", IN_QICOMPARE, FIELD(warn), CLIP(0, 1e9),
     .help = "likewise for a warning (1e-6)"},
    {OPTION_NUMBER, NULL, NULL, "warnpercent", "x", IN_QICOMPARE, FIELD(warn_percent), CLIP(0, 100),
     .help = "likewise for a warning (0)"},
    {OPTION_SPECIAL, NULL, NULL, "region", "x,y,w,h", IN_QICOMPARE, .apply = option_apply_region,
     .help = "compare only this part of the pictures"},
    {OPTION_INT, NULL, NULL, "places", "n", IN_QICOMPARE, FIELD(places), CLIP(0, 100),
     .help = "look into so many of the worst places (10): enlarged, told, and why they differ"},

    HEADING("Measuring"),
    {OPTION_SPECIAL, NULL, NULL, "threads", "n", IN_QIBENCH, FIELD(threads), CLIP(0, 512),
     .apply = bench_apply_whole, .commands = FOR_TRACE,
     .help = "trace: threads (0: as many as there are cores)"},
    {OPTION_SPECIAL, NULL, NULL, "rounds", "n", IN_QIBENCH, .apply = bench_apply_rounds,
     .commands = FOR_SPEED | FOR_SWEEP,
     .help = "speed, sweep: the median of n rounds, odd (5; sweep: 3)"},
    {OPTION_SPECIAL, NULL, NULL, "share", "x", IN_QIBENCH, FIELD(bench.share), CLIP(1e-4, 1),
     .apply = bench_apply_within, .commands = FOR_SPEED,
     .help = "speed methods: this share of the rays (1)"},
    {OPTION_SPECIAL, NULL, NULL, "view", "name", IN_QIBENCH, .apply = bench_apply_view,
     .commands = FOR_SPEED, .help = "speed methods: full, zoom or scattered alone"},
    {OPTION_SPECIAL, NULL, NULL, "patches", "n", IN_QIBENCH, FIELD(bench.patches), CLIP(32, 1e8),
     .apply = bench_apply_whole, .commands = FOR_SPEED,
     .help = "speed lattices: up to n patches (1000000)"},
    {OPTION_SPECIAL, NULL, NULL, "size", "WxH", IN_QIBENCH, .apply = bench_apply_size,
     .commands = FOR_SWEEP, .help = "sweep: of the pictures (320x240)"},
    {OPTION_SPECIAL, NULL, NULL, "include", "folder", IN_QIBENCH, .apply = option_apply_library,
     .commands = FOR_SWEEP, .help = "sweep: where includes are looked for; may be repeated"},
    {OPTION_TEXT, NULL, NULL, "html", "folder", IN_QIBENCH, FIELD(bench.html),
     .commands = FOR_SWEEP, .help = "sweep: also write index.html, sweep.csv and sweep.json there"},
    {OPTION_SPECIAL, NULL, NULL, "patience", "s", IN_QIBENCH, FIELD(bench.patience), CLIP(1, 1e6),
     .apply = bench_apply_within, .commands = FOR_SWEEP,
     .help = "sweep: what a point may take, all rounds together, before it is given up (60)"},
    {OPTION_SPECIAL, NULL, NULL, "povray", "on|off", IN_QIBENCH, .apply = bench_apply_povray,
     .commands = FOR_SWEEP, .help = "sweep: run POV-Ray too (on)"},
    {OPTION_FLAG, NULL, NULL, "study", NULL, IN_QIBENCH, FIELD(bench.study), .commands = FOR_SWEEP,
     .help = "sweep: print how wrong POV-Ray's triangles are, where they crack, and what equal "
             "errors cost, instead of the whole table"},

    HEADING("The run"),
    {OPTION_INT, "WT", "Work_Threads", NULL, "n", IN_ALL, FIELD(threads), CLIP(0, 512),
     .help = "threads (0: as many as there are cores); the picture is the same"},
    {OPTION_SPECIAL, "BS", "Render_Block_Size", NULL, "n", DRAWS, .apply = option_apply_block_size,
     .help = "side of a tile (32); method 1 of anti-aliasing depends on it"},
    {OPTION_FLAG, "C", "Continue_Trace", "continue", NULL, IN_ALL, FIELD(continue_trace),
     .help = "take up a render that was interrupted; of an animation, frames that are there stay"},
    {OPTION_FLAG, "V", "Verbose", "verbose", NULL, IN_ALL, FIELD(verbose),
     .help = "progress and statistics (default; pov2qi: notes, off by default); -V silent"},
    {OPTION_SPECIAL, "D", NULL, NULL, NULL, IN_ALL, .apply = option_apply_display,
     .help = "taken for POV-Ray's sake: there is no window"},
    {OPTION_FLAG, NULL, "Display", NULL, NULL, IN_ALL, FIELD(display)},
    {OPTION_FLAG, "P", "Pause_When_Done", NULL, NULL, IN_ALL, FIELD(pause),
     .help = "likewise: without a window nothing waits"},
    {OPTION_FLAG, NULL, NULL, "strict", NULL, IN_ALL, FIELD(strict),
     .help = "what is not modelled is an error instead of a warning"},
    {OPTION_FLAG, NULL, NULL, "patch-solids", NULL, IN_ALL, FIELD(patch_solids),
     .help = "closed unions of patches that have an interior are solids in intersections and "
             "differences; to POV-Ray patches have no inside"},
    {OPTION_SPECIAL, NULL, NULL, "allow-write", "folder", IN_ALL, .apply = option_apply_allow_write,
     .help = "files that the scene writes (#fopen, #write) may be made in this folder and those "
             "below it; without it a scene writes no files; may be repeated"},
    {OPTION_SPECIAL, NULL, NULL, "limit", "name=n", IN_ALL, .apply = option_apply_limit,
     .help = "the most that reading a scene may take: calls, elements (of arrays), includes, "
             "megabytes, nesting, objects, seconds, string (bytes), tokens"},
    {OPTION_FLAG, NULL, NULL, "help", NULL, IN_EVERY, FIELD(help), .help = "this text"},
    {OPTION_FLAG, NULL, NULL, "version", NULL, IN_EVERY, FIELD(show_version),
     .help = "the version of this program"},
    {OPTION_FLAG, NULL, NULL, "man", NULL, IN_EVERY, FIELD(manual),
     .help = "the manual page, for man -l -"},
    {OPTION_FLAG, NULL, NULL, "completion", NULL, IN_EVERY, FIELD(completion),
     .help = "a script that makes bash complete this program's words"},

    HEADING("Messages"),
    {OPTION_SPECIAL, "GA", NULL, NULL, "[name]", IN_ALL, FIELD(all_file),
     .apply = option_apply_console,
     .help = "shows all messages, -GA only errors; with a name, they are copied to that file"},
    {OPTION_SPECIAL, NULL, "All_Console", NULL, "on|off", IN_ALL,
     .apply = option_apply_all_console},
    {OPTION_TEXT, NULL, "All_File", NULL, "name", IN_ALL, FIELD(all_file)},
    STREAM("GD", "Debug", CONSOLE_DEBUG, "likewise what the scene prints with #debug"),
    STREAM("GF", "Fatal", CONSOLE_FATAL, "likewise errors"),
    STREAM("GR", "Render", CONSOLE_RENDER, "likewise notes and progress"),
    STREAM("GS", "Statistic", CONSOLE_STATISTIC, "likewise statistics"),
    STREAM("GW", "Warning", CONSOLE_WARNING, "likewise warnings"),
    {OPTION_FLAG, "GP", "Append_File", NULL, NULL, IN_ALL, FIELD(append_file),
     .help = "appends to the files of messages that are there"},

    HEADING("Animation"),
    {OPTION_INT, "KFI", "Initial_Frame", NULL, "n", IN_ALL, FIELD(initial_frame), FRAMES,
     .help = "the number of the first frame (1)"},
    {OPTION_INT, "KFF", "Final_Frame", NULL, "n", IN_ALL, FIELD(final_frame), FRAMES,
     .help = "the number of the last frame; makes it an animation, a picture a frame"},
    {OPTION_SPECIAL, "KI", "Initial_Clock", NULL, "x", IN_ALL, FIELD(initial_clock),
     .apply = option_apply_float, .help = "the clock of the first frame (0)"},
    {OPTION_SPECIAL, "KF", "Final_Clock", NULL, "x", IN_ALL, FIELD(final_clock),
     .apply = option_apply_float, .help = "the clock of the last frame (1)"},
    {OPTION_FLAG, "KC", "Cyclic_Animation", NULL, NULL, IN_ALL, FIELD(cyclic),
     .help = "the frame after the last one would be the first again"},
    {OPTION_NUMBER, "SF", "Subset_Start_Frame", NULL, "x", IN_ALL, FIELD(subset_start),
     CLIP(0, 1e9), .help = "render from this frame on; below 1 a share of the frames"},
    {OPTION_NUMBER, "EF", "Subset_End_Frame", NULL, "x", IN_ALL, FIELD(subset_end), CLIP(0, 1e9),
     .help = "render up to this frame; below 1 a share of the frames"},
    {OPTION_INT, "STP", "Frame_Step", NULL, "n", IN_ALL, FIELD(frame_step), CLIP(1, 1e9),
     .help = "render every nth frame (1)"},
    {OPTION_FLAG, "KLA", "Clockless_Animation", NULL, NULL, IN_ALL, FIELD(clockless),
     .help = "of several cameras the first one is meant"},

    {OPTION_INT, NULL, "Bits_Per_Colour", NULL, "n", DRAWS, FIELD(bits), CLIP(5, 16)},
    {OPTION_SPECIAL, NULL, "Include_Ini", NULL, "name", IN_ALL, .apply = option_apply_include_ini},
    COMMAND("Pre_Scene_Command"),
    COMMAND("Pre_Frame_Command"),
    COMMAND("Post_Frame_Command"),
    COMMAND("Post_Scene_Command"),
    COMMAND("User_Abort_Command"),
    COMMAND("Fatal_Error_Command"),

    // Buffers, bounding, previews, fields, radiosity's files: no picture of ours depends on them.
    IGNORED("B", "Bounding", NULL),
    IGNORED("MB", "Bounding_Threshold", "n"),
    IGNORED("BM", "Bounding_Method", "n"),
    IGNORED(NULL, "BSP_BaseAccessCost", "x"),
    IGNORED(NULL, "BSP_ChildAccessCost", "x"),
    IGNORED(NULL, "BSP_ISectCost", "x"),
    IGNORED(NULL, "BSP_MaxDepth", "n"),
    IGNORED(NULL, "BSP_MissChance", "x"),
    IGNORED("UR", "Remove_Bounds", NULL),
    IGNORED("SU", "Split_Unions", NULL),
    IGNORED("UL", "Light_Buffer", NULL),
    IGNORED("UV", "Vista_Buffer", NULL),
    IGNORED("UD", "Draw_Vistas", NULL),
    IGNORED("UF", "Field_Render", NULL),
    IGNORED("UO", "Odd_Field", NULL),
    IGNORED("X", "Test_Abort", "n"),
    IGNORED(NULL, "Test_Abort_Count", "n"),
    IGNORED("SP", "Preview_Start_Size", "n"),
    IGNORED("EP", "Preview_End_Size", "n"),
    IGNORED("RP", "Render_Pattern", "n"),
    IGNORED("RS", "Render_Block_Step", "n"),
    IGNORED("RTR", "Real_Time_Raytracing", NULL),
    IGNORED("MI", "Max_Image_Buffer_Memory", "n"),
    IGNORED("HR", "High_Reproducibility", NULL),
    IGNORED("WL", "Warning_Level", "n"),
    IGNORED("RF", "Radiosity_File_Name", "name"),
    IGNORED("RFI", "Radiosity_From_File", NULL),
    IGNORED("RFO", "Radiosity_To_File", NULL),
    IGNORED("RVP", "Radiosity_Vain_Pretrace", NULL),
    IGNORED(NULL, "Pre_Scene_Return", "letter"),
    IGNORED(NULL, "Pre_Frame_Return", "letter"),
    IGNORED(NULL, "Post_Frame_Return", "letter"),
    IGNORED(NULL, "Post_Scene_Return", "letter"),
    IGNORED(NULL, "User_Abort_Return", "letter"),
    IGNORED(NULL, "Fatal_Error_Return", "letter"),
    IGNORED(NULL, "Palette", "letter"),
    IGNORED(NULL, "Video_Mode", "letter"),
    IGNORED(NULL, "Display_Gamma", "x"),
    IGNORED(NULL, "Compression", "n"),
    IGNORED(NULL, "Buffer_Output", NULL),
    IGNORED(NULL, "Buffer_Size", "n"),
    IGNORED(NULL, "Create_Histogram", NULL),
    IGNORED(NULL, "Histogram_Name", "name"),
    IGNORED(NULL, "Histogram_Grid_Size", "n"),
    IGNORED(NULL, "Histogram_Type", "letter"),
};
const size_t option_row_count = sizeof option_rows / sizeof *option_rows;
