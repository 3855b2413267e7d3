// SPDX-License-Identifier: MIT
// The name of a picture and how it is laid on (facts: sdl 4.11): image_map, bump_map,
// image_pattern, material_map, height_field. Nothing of it is modelled, but the
// file must be there.
#include "converter/nodes.h"

#include <string.h>
#include <strings.h>

// Types of pictures, and what their files' names end in. A name that ends in none of them means one
// of the type that is given, and else a PNG, as the output of a render would be.
static const struct {
    int keyword;
    const char *extensions[3];
} file_types[] = {
    {KW_png, {".png"}},           {KW_gif, {".gif"}}, {KW_tga, {".tga"}},
    {KW_iff, {".iff"}},           {KW_pot, {".gif"}}, {KW_pgm, {".pgm"}},
    {KW_ppm, {".ppm"}},           {KW_sys, {".bmp"}}, {KW_jpeg, {".jpg", ".jpeg"}},
    {KW_tiff, {".tif", ".tiff"}}, {KW_bmp, {".bmp"}}, {KW_exr, {".exr"}},
    {KW_hdr, {".hdr"}},
};
enum { FILE_TYPES = sizeof file_types / sizeof *file_types };

static size_t accept_file_type(Converter *cv) {
    for (size_t i = 0; i < FILE_TYPES; i++)
        if (accept(cv, file_types[i].keyword))
            return i;
    return 0;
}

static bool has_image_extension(const char *name) {
    const char *dot = strrchr(name, '.');
    for (size_t i = 0; dot && i < FILE_TYPES; i++)
        for (size_t k = 0; file_types[i].extensions[k]; k++)
            if (strcasecmp(dot, file_types[i].extensions[k]) == 0)
                return true;
    return false;
}

// The path of the picture of that type; dies at loc when there is none.
static const char *find_image(Converter *cv, const char *name, size_t type, const Loc *loc) {
    const char *path = NULL;
    for (size_t k = 0; !path && !has_image_extension(name) && file_types[type].extensions[k]; k++)
        path = source_find(
            cv, arena_printf(cv->arena, "%s%s", name, file_types[type].extensions[k]), FILE_IMAGE);
    return path ? path : source_require(cv, name, FILE_IMAGE, loc);
}

// [V] [TYPE] S [gamma F | gamma srgb] [premultiplied F]  |  function W, H { BODY }
void parse_image(Converter *cv) {
    if (accept(cv, KW_function)) {
        parse_float(cv);
        optional_comma(cv);
        parse_float(cv);
        optional_comma(cv);
        parse_function(cv);
        return;
    }
    if (!starts_string(cv) && starts_expression(cv))
        parse_vector(cv); // old: the direction of projection
    size_t type = accept_file_type(cv);
    Loc loc = here(cv);
    find_image(cv, parse_file_name(cv), type, &loc);
    if (accept(cv, KW_gamma) && !accept(cv, KW_srgb))
        parse_float(cv);
    if (accept(cv, KW_premultiplied))
        parse_optional_bool(cv);
}

// filter all F | filter F [,] F
static void parse_palette(Converter *cv) {
    if (!accept(cv, KW_all)) {
        parse_float(cv);
        optional_comma(cv);
    }
    parse_float(cv);
}

void parse_image_options(Converter *cv) {
    for (;;) {
        int code = peek_token(cv)->code;
        switch (code) {
        case KW_once:
        case KW_use_color:
        case KW_use_colour:
        case KW_use_index:
        case KW_use_alpha:
            next_token(cv);
            break;
        case KW_map_type:
        case KW_interpolate:
        case KW_bump_size:
            next_token(cv);
            parse_float(cv);
            break;
        case KW_repeat:
        case KW_offset:
            next_token(cv);
            parse_uv(cv);
            break;
        case KW_filter:
        case KW_transmit:
            next_token(cv);
            parse_palette(cv);
            break;
        default:
            return;
        }
        optional_comma(cv);
    }
}

void parse_image_block(Converter *cv, const char *where) {
    expect(cv, '{', where);
    parse_image(cv);
    parse_image_options(cv);
    expect(cv, '}', where);
}
