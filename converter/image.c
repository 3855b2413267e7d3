// SPDX-License-Identifier: MIT
// The name of a picture and how it is laid on (facts: sdl 4.11): image_map, bump_map,
// image_pattern, material_map, height_field. Nothing of it is modelled; the file is not opened.
#include "converter/nodes.h"

static bool accept_file_type(Converter *cv) {
    static const int types[] = {KW_gif, KW_tga,  KW_iff,  KW_pot, KW_png, KW_pgm, KW_ppm,
                                KW_sys, KW_jpeg, KW_tiff, KW_bmp, KW_exr, KW_hdr};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (accept(cv, types[i]))
            return true;
    return false;
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
    accept_file_type(cv);
    parse_file_name(cv);
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
