// SPDX-License-Identifier: MIT
// A file becomes a picture made of light (facts: textures 2.9, gamma of input images). All in
// float, each value by itself as POV-Ray's tables have it.
#include "base/diag.h"
#include "image/picture.h"
#include "texture/image_map.h"

#include <math.h>

// ORDER curve: how a stored value becomes light, or the reverse.
typedef enum { CURVE_NEUTRAL, CURVE_SRGB, CURVE_POWER } CurveKind;

typedef struct {
    CurveKind kind;
    float encoding; // CURVE_POWER: stored = light ^ encoding
} Curve;

static Curve power_curve(float encoding) {
    bool neutral = fabs(1.0 - encoding) <= 0.01; // so POV-Ray
    return (Curve){neutral ? CURVE_NEUTRAL : CURVE_POWER, encoding};
}

static float decode(Curve curve, float x) {
    switch (curve.kind) {
    case CURVE_NEUTRAL:
        return x;
    case CURVE_SRGB:
        return x < 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
    case CURVE_POWER:
        break;
    }
    return powf(x > 0.0f ? x : 0.0f, 1.0f / curve.encoding);
}

static float encode(Curve curve, float x) {
    switch (curve.kind) {
    case CURVE_NEUTRAL:
        return x;
    case CURVE_SRGB:
        return x <= 0.0031308f ? x * 12.92f : 1.055f * powf(x, 1.0f / 2.4f) - 0.055f;
    case CURVE_POWER:
        break;
    }
    return powf(x > 0.0f ? x : 0.0f, curve.encoding);
}

// What a file of that format holds when it does not say.
static Curve usual_curve(PictureType type) {
    switch (type) {
    case PICTURE_PNG:
    case PICTURE_GIF:
    case PICTURE_TGA:
    case PICTURE_SYS:
    case PICTURE_JPEG:
    case PICTURE_BMP:
        return (Curve){CURVE_SRGB, 0.0f};
    case PICTURE_EXR:
    case PICTURE_HDR:
    case PICTURE_IFF:
    case PICTURE_POT:
    case PICTURE_PGM:
    case PICTURE_PPM:
    case PICTURE_TIFF:
    case PICTURE_VALUES:
        break;
    }
    return (Curve){CURVE_NEUTRAL, 1.0f};
}

static Curve working_curve(const Settings *settings) {
    if (settings->gamma_mode == GAMMA_SRGB)
        return (Curve){CURVE_SRGB, 0.0f};
    return power_curve(settings->gamma_mode == GAMMA_POWER ? 1.0f / settings->assumed_gamma : 1.0f);
}

// The formats that are taken to be in the working space already.
static bool is_working(PictureType type) {
    return type == PICTURE_PGM || type == PICTURE_PPM || type == PICTURE_TIFF ||
           type == PICTURE_IFF;
}

// From the file to the numbers of the scene, as at most two curves: decode `from`, encode `to`.
typedef struct {
    Curve from, to;
} Passage;

static Passage passage_of(const Settings *settings, const Picture *picture,
                          const StoredPicture *file) {
    const Curve neutral = {CURVE_NEUTRAL, 1.0f};
    Passage passage = {neutral, picture->to_working ? working_curve(settings) : neutral};
    switch (picture->decode) {
    case DECODE_NONE:
        return (Passage){neutral, neutral};
    case DECODE_POWER:
        passage.from = power_curve(1.0f / picture->gamma);
        break;
    case DECODE_SRGB:
        passage.from.kind = CURVE_SRGB;
        break;
    case DECODE_FILE:
    case DECODE_OLD:
        if (file->encoding == ENCODING_SRGB)
            passage.from.kind = CURVE_SRGB;
        else if (file->encoding == ENCODING_POWER)
            passage.from = power_curve(file->gamma);
        else if (picture->decode == DECODE_OLD || is_working(picture->type))
            return (Passage){neutral, neutral};
        else
            passage.from = usual_curve(picture->type);
        break;
    }
    // Two powers are one; the same curve both ways is none.
    Curve from = passage.from, to = passage.to;
    if (from.kind == CURVE_SRGB && to.kind == CURVE_SRGB)
        return (Passage){neutral, neutral};
    if (to.kind == CURVE_POWER && from.kind != CURVE_SRGB) {
        float decoding = 1.0f / to.encoding;
        if (from.kind == CURVE_POWER)
            return (Passage){power_curve(decoding / (1.0f / from.encoding)), neutral};
        return (Passage){power_curve(decoding), neutral};
    }
    return passage;
}

static float pass(const Passage *passage, float x) {
    return encode(passage->to, decode(passage->from, x));
}

static void make_palette(ImageMap *map, const StoredPicture *file, const Passage *passage,
                         Arena *arena) {
    const Picture *layout = map->layout;
    map->places = file->places;
    map->colors = ARENA_ARRAY(arena, Color, 256);
    for (int i = 0; i < file->palette_size; i++) {
        const uint8_t *entry = file->palette[i];
        Color *c = &map->colors[i];
        c->r = pass(passage, (float)entry[0] / 255.0f);
        c->g = pass(passage, (float)entry[1] / 255.0f);
        c->b = pass(passage, (float)entry[2] / 255.0f);
        c->transmit = 1.0f - (float)entry[3] / 255.0f;
        c->filter = layout->has_filter ? layout->filter : 0.0f;
        c->transmit = layout->has_transmit ? layout->transmit : c->transmit;
    }
    for (uint32_t i = 0; i < layout->change_count; i++) {
        const PaletteChange *change = &layout->changes[i];
        if (change->place >= file->palette_size)
            die("'%s' has %d colours: there is no %d to make transparent", layout->path,
                file->palette_size, change->place);
        Color *c = &map->colors[change->place];
        *(change->transmit ? &c->transmit : &c->filter) = change->value;
    }
}

// Grey pictures of up to 8 bits go through bytes once more in POV-Ray, and lose a step.
static void make_grey(ImageMap *map, const StoredPicture *file, const Passage *passage,
                      Arena *arena) {
    size_t count = (size_t)file->width * (size_t)file->height;
    float *values = ARENA_ARRAY(arena, float, count), levels[256];
    for (int i = 0; i < file->palette_size; i++) {
        float v = pass(passage, (float)file->palette[i][0] / 255.0f);
        float grey = v * 0.297f + v * 0.589f + v * 0.114f;
        levels[i] = (float)(unsigned char)(grey * 255.0f) / 255.0f;
    }
    for (size_t i = 0; i < count; i++)
        values[i] = levels[file->places[i]];
    map->values = values;
    map->channels = 1;
}

// In place: nobody else has the values.
static void make_values(ImageMap *map, StoredPicture *file, const Passage *passage) {
    size_t count = (size_t)file->width * (size_t)file->height;
    int colors = file->channels < 3 ? 1 : 3;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < colors; c++) {
            float *v = &file->values[i * (size_t)file->channels + (size_t)c];
            *v = pass(passage, *v);
        }
    map->values = file->values;
    map->channels = file->channels;
}

static bool has_alpha_below_1(const ImageMap *map) {
    size_t count = (size_t)map->width * (size_t)map->height;
    for (size_t i = 0; map->values && map->channels % 2 == 0 && i < count; i++)
        if (map->values[(i + 1) * (size_t)map->channels - 1] < 1.0f)
            return true;
    return false;
}

static bool is_opaque(const ImageMap *map, const StoredPicture *file) {
    const Picture *layout = map->layout;
    if (layout->once || layout->filter != 0.0f || layout->transmit != 0.0f)
        return false;
    for (int i = 0; map->places && i < file->palette_size; i++)
        if (map->colors[i].filter != 0.0f || map->colors[i].transmit != 0.0f)
            return false;
    return map->places || !has_alpha_below_1(map);
}

static StoredPicture *picture_of_values(const Picture *picture, Arena *arena) {
    StoredPicture *file = ARENA_NEW(arena, StoredPicture);
    *file = (StoredPicture){
        .width = picture->width,
        .height = picture->height,
        .channels = picture->channels,
        .bits = 16,
        .values = ARENA_ARRAY(arena, float, picture->value_count),
    };
    for (uint32_t i = 0; i < picture->value_count; i++)
        file->values[i] = (float)picture->values[i] / 65535.0f;
    return file;
}

ImageMap image_map_make(const Settings *settings, const Picture *picture, Arena *arena) {
    StoredPicture *file = picture->type == PICTURE_VALUES
                              ? picture_of_values(picture, arena)
                              : picture_read(arena, picture->path, picture->type == PICTURE_PNG);
    Passage passage = passage_of(settings, picture, file);
    ImageMap map = {
        .layout = picture,
        .width = file->width,
        .height = file->height,
        .across = (float)((double)file->width * picture->repeat.u),
        .down = (float)((double)file->height * picture->repeat.v),
        .offset = {picture->offset.u * -file->width, picture->offset.v * -file->height},
        .indexed = (file->palette_size > 0 && !file->grey_palette) || picture->type == PICTURE_GIF,
        .premultiplied = picture->type == PICTURE_EXR && file->channels == 4,
    };
    if (file->grey_palette)
        make_grey(&map, file, &passage, arena);
    else if (file->palette_size > 0)
        make_palette(&map, file, &passage, arena);
    else
        make_values(&map, file, &passage);
    if (picture->change_count > 0 && !map.places)
        die("'%s' has no palette of which colours could be made transparent",
            picture->path ? picture->path : "a function");
    map.opaque = is_opaque(&map, file);
    return map;
}
