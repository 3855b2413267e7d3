// SPDX-License-Identifier: MIT
// Names of files (facts: sdl 5.2): the scene that is meant, and the output that belongs to it.
#include "options/options.h"

#include "base/file.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static bool ends_in(const char *text, const char *end) {
    size_t length = strlen(text), tail = strlen(end);
    return length > tail && strcasecmp(text + length - tail, end) == 0;
}

const char *options_input_path(const RenderOptions *options, Arena *arena) {
    const char *input = options->input;
    if (!input || file_exists(input))
        return input;
    const char *with_pov = arena_printf(arena, "%s.pov", input);
    return file_exists(with_pov) ? with_pov : input;
}

// The length of a scene's name without its extension.
static size_t stem_length(const char *name) {
    const char *const extensions[] = {".qi.json", ".json"};
    for (size_t i = 0; i < 2; i++)
        if (ends_in(name, extensions[i]))
            return strlen(name) - strlen(extensions[i]);
    const char *base = file_name(name), *dot = strrchr(base, '.');
    return dot && dot != base ? (size_t)(dot - name) : strlen(name);
}

// Does the name already say what the file will be?
static bool has_extension(const char *name, const char *extension) {
    ImageFormat named, wanted;
    const char *probe = strrchr(extension, '.'); // of "qi.json" the last part
    if (probe)
        return ends_in(name, probe);
    size_t length = strlen(name), tail = strlen(extension);
    if (length > tail + 1 && name[length - tail - 1] == '.' &&
        strcasecmp(name + length - tail, extension) == 0)
        return true;
    // Formats with two spellings.
    char with_dot[16] = ".";
    strncat(with_dot, extension, sizeof with_dot - 2);
    return image_format_of(name, &named) && image_format_of(with_dot, &wanted) && named == wanted;
}

const char *options_output_path(const RenderOptions *options, Arena *arena, const char *extension) {
    const char *output = options->output, *input = options->input ? options->input : "scene";
    if (output && strcmp(output, "-") == 0)
        return output;
    // A frame's number stands behind the name, before the extension.
    char number[16] = "";
    if (options->frame.digits)
        snprintf(number, sizeof number, "%0*d", options->frame.digits, options->frame.number);
    bool folder = output && *output && output[strlen(output) - 1] == '/';
    if (!output || folder) {
        const char *name = folder ? file_name(input) : input;
        return arena_printf(arena, "%s%.*s%s.%s", folder ? output : "", (int)stem_length(name),
                            name, number, extension);
    }
    if (!has_extension(output, extension))
        return arena_printf(arena, "%s%s.%s", output, number, extension);
    const char *dot = strrchr(output, '.');
    return arena_printf(arena, "%.*s%s%s", (int)(dot - output), output, number, dot);
}
