// SPDX-License-Identifier: MIT
// height_field (facts: rendering 8): the picture, or the values of a function, become numbers of 16
// bits, as POV-Ray has them: grey as it is, two bytes from red and green, or 256 times the index
// into a palette.
#include "converter/nodes.h"

#include "image/picture.h"

#include <math.h>

static double clip16(double v) { return v >= 65535.0 ? 65535.0 : v > 0.0 ? floor(v) : 0.0; }

enum { MAX_SIDE = 1 << 14 };

// The value as POV-Ray has it in single precision: the file's number divided by the largest.
static float value_of(const StoredPicture *picture, float value) {
    if (picture->bits > 16)
        return value;
    float largest = picture->bits > 8 ? 65535.0F : 255.0F;
    return roundf(value * largest) / largest;
}

// On its way into a grey picture POV-Ray weighs the value as if it were three, and cuts what the
// rounding leaves: many values lose one step of the file's (measured).
static double grey_height(float v, float largest) {
    float grey = floorf((0.297F * v + 0.589F * v + 0.114F * v) * largest) / largest;
    return clip16((double)(grey * 65535.0F));
}

// Of PGM the value is kept as it is.
static double height_of_grey(const StoredPicture *picture, float value, PictureType type) {
    if (type == PICTURE_PGM || picture->bits > 16)
        return clip16((double)(value * 65535.0F));
    return grey_height(value, picture->bits > 8 ? 65535.0F : 255.0F);
}

// TIFF is read with eight bits, grey by its upper ones, colours rounded.
static float eight_bits(const StoredPicture *picture, float value) {
    if (picture->bits <= 8 || picture->bits > 16)
        return value;
    unsigned v = (unsigned)lroundf(value * 65535.0F);
    return (float)(picture->channels < 3 ? v >> 8 : (v + 128) / 257) / 255.0F;
}

static double height_of(const StoredPicture *picture, const float *pixel, PictureType type) {
    // Only these keep grey as such; the others have it as red, green and blue.
    bool keeps_grey = type == PICTURE_PNG || type == PICTURE_PGM || picture->bits > 16;
    bool grey = picture->channels < 3, bytes = picture->bits <= 8 || type == PICTURE_TIFF;
    float r = value_of(picture, pixel[0]);
    if (grey && keeps_grey)
        return height_of_grey(picture, r, type);
    float g = grey ? r : value_of(picture, pixel[1]), b = grey ? r : value_of(picture, pixel[2]);
    if (type == PICTURE_TIFF)
        r = eight_bits(picture, r), g = eight_bits(picture, g);
    if (!bytes)
        return clip16((double)((0.297F * r + 0.589F * g + 0.114F * b) * 65535.0F));
    return clip16(((double)r * 256.0 + (double)g) * 255.0);
}

static HeightMap *make_map(Converter *cv, int width, int depth) {
    HeightMap *map = ARENA_NEW(cv->arena, HeightMap);
    map->width = width;
    map->depth = depth;
    map->count = (uint32_t)width * (uint32_t)depth;
    check_room(cv, (uint64_t)map->count * sizeof *map->heights);
    map->heights = ARENA_ARRAY(cv->arena, double, map->count);
    return map;
}

// False: it is too small to have a surface (POV-Ray accepts it, and reads past its ends).
static bool check_size(Converter *cv, const Token *token, int width, int height) {
    if (width >= 2 && height >= 2 && width <= MAX_SIDE && height <= MAX_SIDE)
        return true;
    Loc loc = token_loc(cv, token);
    if (width > MAX_SIDE || height > MAX_SIDE)
        die_at(&loc, "a picture of %d x %d makes no height_field", width, height);
    warn_at(&loc, "a picture of %d x %d makes no height_field: the picture will lack it", width,
            height);
    return false;
}

// The picture's last row is at z = 0.
static HeightMap *map_of_values(Converter *cv, const StoredPicture *picture, PictureType type) {
    int width = picture->width, height = picture->height;
    HeightMap *map = make_map(cv, width, height);
    for (int z = 0; z < height; z++)
        for (int x = 0; x < width; x++) {
            size_t at = (size_t)(height - 1 - z) * (size_t)width + (size_t)x;
            double *out = &map->heights[(size_t)z * (size_t)width + (size_t)x];
            if (!picture->places)
                *out = height_of(picture, picture->values + at * (size_t)picture->channels, type);
            else if (picture->grey_palette)
                *out =
                    grey_height((float)picture->palette[picture->places[at]][0] / 255.0F, 255.0F);
            else
                *out = picture->places[at] * 256.0;
        }
    return map;
}

// POT: the right half of the picture has the lower bytes of the left half's numbers.
static HeightMap *map_of_halves(Converter *cv, const StoredPicture *gif) {
    int width = gif->width / 2, height = gif->height;
    HeightMap *map = make_map(cv, width, height);
    for (int z = 0; z < height; z++)
        for (int x = 0; x < width; x++) {
            const uint8_t *row = gif->places + (size_t)(height - 1 - z) * (size_t)gif->width;
            map->heights[(size_t)z * (size_t)width + (size_t)x] = row[x] * 256.0 + row[x + width];
        }
    return map;
}

// NULL: too small.
static const HeightMap *map_of_picture(Converter *cv, const Picture *source, const Token *token) {
    Arena *scratch = arena_create();
    const StoredPicture *picture = picture_read(scratch, source->path, source->type == PICTURE_PNG);
    bool pot = source->type == PICTURE_POT && picture->places && !picture->grey_palette;
    const HeightMap *map = NULL;
    if (check_size(cv, token, pot ? picture->width / 2 : picture->width, picture->height))
        map = pot ? map_of_halves(cv, picture) : map_of_values(cv, picture, source->type);
    arena_destroy(scratch);
    return map;
}

// What a function made is in numbers of 16 bits already; a step of them is lost where the division
// rounds down.
static double height_of_values(const double *value, int channels) {
    float v[3];
    for (int i = 0; i < 3; i++)
        v[i] = (float)value[channels == 1 ? 0 : i] / 65535.0F;
    float grey = channels == 1 ? v[0] : 0.297F * v[0] + 0.589F * v[1] + 0.114F * v[2];
    return clip16((double)(grey * 65535.0F));
}

// NULL: too small.
static const HeightMap *map_of_function(Converter *cv, const Picture *source, const Token *token) {
    if (!check_size(cv, token, source->width, source->height))
        return NULL;
    HeightMap *map = make_map(cv, source->width, source->height);
    const double *value = source->values;
    for (int row = 0; row < map->depth; row++)
        for (int x = 0; x < map->width; x++, value += source->channels)
            map->heights[(size_t)(map->depth - 1 - row) * (size_t)map->width + (size_t)x] =
                height_of_values(value, source->channels);
    return map;
}

void parse_height_field(Converter *cv, ObjectNode *object) {
    HeightFieldShape *field = &object->object.shape.height_field;
    const Token *token = peek_token(cv);
    Picture source;
    parse_image(cv, &source, false, PICTURE_IFF);
    const HeightMap *map = source.type == PICTURE_VALUES ? map_of_function(cv, &source, token)
                                                         : map_of_picture(cv, &source, token);
    for (;;) {
        if (accept(cv, KW_water_level))
            field->water_level = (cv->version < 200 ? 256.0 : 65536.0) * parse_float(cv);
        else if (accept(cv, KW_smooth))
            field->smooth = true;
        else
            break;
    }
    if (!map) { // nothing: flat, and all of it under water
        map = make_map(cv, 2, 2);
        field->water_level = 65536.0;
    }
    object->map = map;
    object->object.has_transform = true;
    object->object.transform =
        transform_scale(vec3(1.0 / (map->width - 1), 1.0 / 65536.0, 1.0 / (map->depth - 1)));
}
