// SPDX-License-Identifier: MIT
// A picture made by a function: function W, H { BODY }, evaluated while the scene is read at points
// of the unit square, the first row at y = 0. One number makes a grey picture, a colour one with
// alpha. POV-Ray keeps 16 bits of each and cuts the rest off at both ends: 1.25 becomes 0.25.
#include "converter/nodes.h"

#include <math.h>

// As the conversion to 16 bits goes on the machines that POV-Ray runs on: by way of 32 bits, where
// what does not fit is 0.
static double stored(double value) {
    float scaled = (float)value * 65535.0F;
    bool fits = scaled > -2147483648.0F && scaled < 2147483648.0F;
    return fits ? (double)((uint32_t)(int32_t)scaled & 0xFFFFU) : 0.0;
}

// smallest: 0 where a picture without pixels is accepted.
static int parse_side(Converter *cv, int smallest) {
    Loc loc = here(cv);
    double side = trunc(parse_float(cv) + 0.5);
    if (!(side >= smallest && side <= PICTURE_MAX_SIDE))
        die_at(&loc, "a picture is 1 to %d pixels wide and high, not %g", PICTURE_MAX_SIDE, side);
    return (int)side;
}

static void store_pixel(double *out, int channels, const double color[5]) {
    out[0] = stored(color[0]);
    if (channels == 1)
        return;
    out[1] = stored(color[1]);
    out[2] = stored(color[2]);
    out[3] = stored((double)(1.0F - (float)color[4]));
}

void parse_image_function(Converter *cv, Picture *picture, int smallest) {
    Loc loc = here(cv);
    int width = parse_side(cv, smallest);
    optional_comma(cv);
    int height = parse_side(cv, smallest);
    optional_comma(cv);
    const UserFunction *function = parse_function(cv);
    int components = user_function_width(cv, function);
    if (components != 1 && components != 5)
        die_at(&loc, "Unsupported function type in function image: it gives neither a number nor a "
                     "colour");
    int channels = components == 1 ? 1 : 4;
    picture->type = PICTURE_VALUES;
    picture->decode = DECODE_NONE;
    picture->width = width;
    picture->height = height;
    picture->channels = channels;
    picture->value_count = (uint32_t)(width * height * channels);
    check_room(cv, (uint64_t)picture->value_count * sizeof *picture->values);
    picture->values = ARENA_ARRAY(cv->arena, double, picture->value_count);
    double *out = picture->values;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++, out += channels) {
            const double at[FUNCTION_MAX_PARAMETERS] = {(double)x / (width - 1),
                                                        (double)y / (height - 1)};
            double color[5];
            user_function_evaluate(cv, function, at, color);
            store_pixel(out, channels, color);
        }
}
