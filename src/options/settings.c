// SPDX-License-Identifier: MIT
// Options -> an INI file (+GI). Plain rows of the table write themselves; the others stand here.
#include "options/table.h"

#include "base/file.h"

#include <string.h>

// In the quotes that the text does not hold.
static void write_text(FILE *out, const char *keyword, const char *text) {
    char quote = strchr(text, '"') ? '\'' : '"';
    fprintf(out, "%s=%c%s%c\n", keyword, quote, text, quote);
}

static void write_flag(FILE *out, const char *keyword, bool on) {
    fprintf(out, "%s=%s\n", keyword, on ? "On" : "Off");
}

static void write_row(FILE *out, const OptionRow *row, const RenderOptions *options) {
    const void *field = (const char *)options + row->offset;
    switch (row->kind) {
    case OPTION_FLAG:
        write_flag(out, row->keyword, *(const bool *)field);
        break;
    case OPTION_INT:
        if (*(const int *)field >= row->low) // else not given
            fprintf(out, "%s=%d\n", row->keyword, *(const int *)field);
        break;
    case OPTION_NUMBER:
        if (*(const double *)field >= row->low)
            fprintf(out, "%s=%.17g\n", row->keyword, *(const double *)field);
        break;
    case OPTION_TEXT:
        if (*(const char *const *)field && row->offset != offsetof(RenderOptions, create_ini))
            write_text(out, row->keyword, *(const char *const *)field);
        break;
    case OPTION_SPECIAL: // write_specials
    case OPTION_HEADING:
    case OPTION_IGNORED:
        break;
    }
}

static char type_letter(const RenderOptions *o) {
    switch (o->format) {
    case IMAGE_TGA:
        return o->compressed ? 'C' : 'T';
    case IMAGE_PPM:
        return 'P';
    case IMAGE_BMP:
        return 'B';
    case IMAGE_JPEG:
        return 'J';
    case IMAGE_EXR:
        return 'E';
    case IMAGE_HDR:
        return 'H';
    default:
        return 'N';
    }
}

static void write_specials(FILE *out, const RenderOptions *o) {
    if (o->format_given)
        fprintf(out, "Output_File_Type=%c\n", type_letter(o));
    if (o->file_gamma > 0)
        fprintf(out, "File_Gamma=%.17g\n", o->file_gamma);
    if (o->dither_method != DITHER_NONE)
        fprintf(out, "Dither_Method=%s\n", option_dither_code(o->dither_method));
    write_flag(out, "Antialias", o->antialias);
    fprintf(out, "Render_Block_Size=%d\n", o->block_size);
    if (o->clock_given)
        fprintf(out, "Clock=%.9g\n", o->clock);
    fprintf(out, "Initial_Clock=%.9g\nFinal_Clock=%.9g\n", o->initial_clock, o->final_clock);
    if (o->version)
        fprintf(out, "Version=%.2f\n", 0.01 * o->version);
    for (size_t i = 0; i < o->library_path_count; i++)
        write_text(out, "Library_Path", o->library_paths[i]);
    for (size_t i = 0; i < o->declare_count; i++)
        fprintf(out, "Declare=%s=%.6g\n", o->declares[i].name, o->declares[i].value);
}

void options_write_ini(const RenderOptions *options, const char *path) {
    OutputFile *file = file_begin(path);
    FILE *out = file_stream(file);
    for (size_t i = 0; i < option_row_count; i++) {
        const OptionRow *row = &option_rows[i];
        if (row->keyword && strcmp(row->keyword, "Bits_Per_Colour") != 0)
            write_row(out, row, options);
    }
    write_specials(out, options);
    file_commit(file);
}
