// SPDX-License-Identifier: MIT
// The name of a picture and how it is laid on (facts: sdl 4.11): image_map, bump_map,
// image_pattern, material_map, height_field. The file must be there; the renderer reads it.
#include "converter/nodes.h"

#include <math.h>
#include <string.h>
#include <strings.h>

// Types of pictures, and what their files' names end in. A name that ends in none of them means one
// of the type that is given, and else a PNG, as the output of a render would be.
static const struct {
    int keyword;
    const char *extensions[3];
    PictureType type;
} file_types[] = {
    {KW_png, {".png"}, PICTURE_PNG},
    {KW_gif, {".gif"}, PICTURE_GIF},
    {KW_tga, {".tga"}, PICTURE_TGA},
    {KW_iff, {".iff"}, PICTURE_IFF},
    {KW_pot, {".gif"}, PICTURE_POT},
    {KW_pgm, {".pgm"}, PICTURE_PGM},
    {KW_ppm, {".ppm"}, PICTURE_PPM},
    {KW_sys, {".bmp"}, PICTURE_SYS},
    {KW_jpeg, {".jpg", ".jpeg"}, PICTURE_JPEG},
    {KW_tiff, {".tif", ".tiff"}, PICTURE_TIFF},
    {KW_bmp, {".bmp"}, PICTURE_BMP},
    {KW_exr, {".exr"}, PICTURE_EXR},
    {KW_hdr, {".hdr"}, PICTURE_HDR},
};
enum { FILE_TYPES = sizeof file_types / sizeof *file_types };

// The type that is named, or -1.
static int accept_file_type(Converter *cv) {
    for (int i = 0; i < FILE_TYPES; i++)
        if (accept(cv, file_types[i].keyword))
            return i;
    return -1;
}

// The type that the name's ending means, or 0, a PNG.
static int type_of_name(const char *name) {
    const char *dot = strrchr(name, '.');
    for (int i = 0; dot && i < FILE_TYPES; i++)
        for (size_t k = 0; file_types[i].extensions[k]; k++)
            if (strcasecmp(dot, file_types[i].extensions[k]) == 0)
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
static const char *find_image(Converter *cv, const char *name, int type, const Loc *loc) {
    const char *path = NULL;
    for (size_t k = 0; !path && !has_image_extension(name) && file_types[type].extensions[k]; k++)
        path = source_find(
            cv, arena_printf(cv->arena, "%s%s", name, file_types[type].extensions[k]), FILE_IMAGE);
    return path ? path : source_require(cv, name, FILE_IMAGE, loc);
}

// How the values of a picture become light when nothing is said. What is no colour (a height, say)
// stays as it is.
static PictureDecode usual_decode(const Converter *cv, bool to_working) {
    if (!to_working)
        return DECODE_NONE;
    if (cv->gamma_set)
        return cv->version >= 370 ? DECODE_FILE : DECODE_OLD;
    return effective_version(cv) >= 370 ? DECODE_FILE : DECODE_NONE;
}

static void parse_gamma(Converter *cv, Picture *picture) {
    if (accept(cv, KW_srgb)) {
        picture->decode = DECODE_SRGB;
        return;
    }
    Loc loc = here(cv);
    picture->decode = DECODE_POWER;
    picture->gamma = (float)parse_float(cv);
    if (!(picture->gamma > 0) || !isfinite(picture->gamma))
        die_at(&loc, "the gamma value must be positive");
}

// premultiplied [F]
static void parse_premultiplied(Converter *cv) {
    Loc loc = here(cv);
    expect(cv, KW_premultiplied, "a picture");
    if (parse_optional_bool(cv))
        warn_at(&loc, "premultiplied is not modelled: where the picture is transparent its colours "
                      "will be darker than POV-Ray's");
}

// [V]… [TYPE] S [gamma F | gamma srgb] [premultiplied F]  |  function W, H { BODY }
void parse_image(Converter *cv, Picture *picture, bool to_working, PictureType refused) {
    *picture = picture_default();
    picture->to_working = to_working;
    picture->decode = usual_decode(cv, to_working);
    // Old: the direction of projection, which a height_field, the only one to have POT, never had.
    while (refused == PICTURE_POT && !starts_string(cv) && starts_expression(cv))
        parse_vector(cv);
    if (accept(cv, KW_function)) {
        parse_image_function(cv, picture, refused == PICTURE_POT ? 1 : 0);
        return;
    }
    int type = accept_file_type(cv);
    Loc loc = here(cv);
    const char *name = parse_file_name(cv);
    if (type < 0)
        type = type_of_name(name);
    picture->path = find_image(cv, name, type, &loc);
    picture->type = file_types[type].type;
    if (picture->type == refused)
        die_at(&loc, "File type not supported here: '%s'", keyword_name(file_types[type].keyword));
    for (;;) {
        if (accept(cv, KW_gamma))
            parse_gamma(cv, picture);
        else if (next_is(cv, KW_premultiplied))
            parse_premultiplied(cv);
        else
            return;
    }
}

// filter all F | filter F [,] F
static void parse_clear(Converter *cv, Picture *picture, int keyword) {
    bool transmit = keyword == KW_transmit;
    if (accept(cv, KW_all)) {
        *(transmit ? &picture->has_transmit : &picture->has_filter) = true;
        *(transmit ? &picture->transmit : &picture->filter) = (float)parse_float(cv);
        return;
    }
    Loc loc = here(cv);
    ImagePalette palette = image_palette(picture);
    if (palette.size == 0)
        die_at(&loc, "Keyword '%s' cannot be used with non color-mapped image",
               keyword_name(keyword));
    double place = parse_float(cv) + 0.01;
    if (!(place > -1 && place < palette.size))
        die_at(&loc, "%s color register value out of range: the palette has %d colors",
               transmit ? "TRANSMIT" : "FILTER", palette.size);
    optional_comma(cv);
    float value = (float)parse_float(cv);
    if (!palette.modelled) {
        warn_at(&loc,
                "palettes are modelled of PNG and GIF only: color %d of this picture stays "
                "as opaque as it is",
                (int)place);
        return;
    }
    PaletteChange *changes = ARENA_ARRAY(cv->arena, PaletteChange, picture->change_count + 1);
    for (uint32_t i = 0; i < picture->change_count; i++)
        changes[i] = picture->changes[i];
    changes[picture->change_count++] = (PaletteChange){(int)place, transmit, value};
    picture->changes = changes;
}

static void parse_between(Converter *cv, Picture *picture, bool strict) {
    Loc loc = here(cv);
    double value = parse_float(cv);
    switch (value > -1 && value < 10 ? (int)value : -1) {
    case 0:
        if (strict)
            break;
        picture->between = BETWEEN_NONE;
        return;
    case 2:
        picture->between = BETWEEN_BILINEAR;
        return;
    case 3:
        picture->between = BETWEEN_BICUBIC;
        return;
    case 4:
        picture->between = BETWEEN_NORMALIZED;
        return;
    default:
        break;
    }
    die_at(&loc, "%g is no kind of interpolation: 2, 3 and 4 are", value);
}

static void parse_layout(Converter *cv, Picture *picture, bool strict) {
    Loc loc = here(cv);
    double value = parse_float(cv);
    picture->layout = LAYOUT_PLANAR;
    switch (value > -1 && value < 10 ? (int)value : -1) {
    case 0:
        return;
    case 1:
        picture->layout = LAYOUT_SPHERICAL;
        return;
    case 2:
        picture->layout = LAYOUT_CYLINDRICAL;
        return;
    case 5:
        picture->layout = LAYOUT_TORUS;
        return;
    default:
        break;
    }
    if (strict)
        die_at(&loc, "%g is no map_type: 0, 1, 2 and 5 are", value);
}

static void parse_repeat(Converter *cv, Picture *picture) {
    Loc loc = here(cv);
    picture->repeat = parse_uv(cv);
    if (!(picture->repeat.u > 0 && picture->repeat.v > 0))
        die_at(&loc, "a picture must repeat a positive number of times");
}

// Whether the option is one of those that not every block with a picture has, and this one has not.
static bool is_foreign(int option, int block) {
    switch (option) {
    case KW_use_color:
    case KW_use_colour:
    case KW_use_index:
        return block == KW_material_map;
    case KW_use_alpha:
        return block != KW_image_pattern;
    case KW_bump_size:
        return block != KW_bump_map;
    case KW_filter:
    case KW_transmit:
        return block != KW_image_map;
    default:
        return false;
    }
}

// One option of the block of that keyword; false: the next token is none. amount: what bump_size
// sets; only a bump_map needs it.
static bool parse_option(Converter *cv, Picture *picture, int block, float *amount) {
    int code = peek_token(cv)->code;
    if (is_foreign(code, block))
        return false;
    switch (code) {
    case KW_once:
    case KW_use_color:
    case KW_use_colour:
    case KW_use_index:
    case KW_use_alpha:
        next_token(cv);
        picture->once = picture->once || code == KW_once;
        if (code != KW_once)
            picture->use = code == KW_use_index   ? USE_PICTURE_INDEX
                           : code == KW_use_alpha ? USE_PICTURE_ALPHA
                                                  : USE_PICTURE_COLOR;
        return true;
    case KW_map_type:
        next_token(cv);
        parse_layout(cv, picture, picture->to_working);
        return true;
    case KW_interpolate:
        next_token(cv);
        parse_between(cv, picture, picture->to_working);
        return true;
    case KW_bump_size:
        next_token(cv);
        *amount = (float)parse_float(cv);
        return true;
    case KW_repeat:
        next_token(cv);
        parse_repeat(cv, picture);
        return true;
    case KW_offset:
        next_token(cv);
        picture->offset = parse_uv(cv);
        return true;
    case KW_filter:
    case KW_transmit:
        next_token(cv);
        parse_clear(cv, picture, code);
        return true;
    default:
        return false;
    }
}

void parse_image_options(Converter *cv, Picture *picture, int block, float *amount) {
    while (parse_option(cv, picture, block, amount))
        continue;
}

const Picture *parse_image_block(Converter *cv, int keyword, float *amount) {
    const char *where = keyword_name(keyword);
    Picture picture;
    expect(cv, '{', where);
    parse_image(cv, &picture, keyword == KW_image_map, PICTURE_POT);
    parse_image_options(cv, &picture, keyword, amount);
    expect(cv, '}', where);
    return arena_copy(cv->arena, &picture, sizeof picture);
}
