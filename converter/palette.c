// SPDX-License-Identifier: MIT
// How many colours the palette of a picture has, without which no single one can be made clear.
#include "converter/nodes.h"

#include "image/picture.h"

#include <stdio.h>

enum { HEADER = 50 }; // bytes: as far as the number of a BMP's colours

static int little(const uint8_t *at, int bytes) {
    uint32_t value = 0;
    for (int i = bytes - 1; i >= 0; i--)
        value = value << 8 | at[i];
    return value < 256 ? (int)value : 256;
}

static int size_in_bmp(const uint8_t header[HEADER]) {
    bool old = little(header + 14, 4) == 12; // the header of OS/2
    int bits = little(header + (old ? 24 : 28), 2);
    if (bits < 1 || bits > 8)
        return 0;
    int used = old ? 0 : little(header + 46, 4);
    return used > 0 ? used : 1 << bits;
}

static int size_in_tga(const uint8_t header[HEADER]) {
    bool mapped = header[1] == 1 && (header[2] == 1 || header[2] == 9);
    return mapped ? little(header + 5, 2) : 0;
}

static int size_in_header(const char *path, PictureType type) {
    uint8_t header[HEADER] = {0};
    FILE *file = fopen(path, "rb");
    if (!file)
        return 0;
    size_t count = fread(header, 1, HEADER, file);
    fclose(file);
    if (count == 0)
        return 0;
    return type == PICTURE_TGA ? size_in_tga(header) : size_in_bmp(header);
}

static int size_in_file(const Picture *picture) {
    Arena *scratch = arena_create();
    const StoredPicture *file = picture_read(scratch, picture->path, picture->type == PICTURE_PNG);
    int size = file->grey_palette ? 0 : file->palette_size;
    arena_destroy(scratch);
    return size;
}

ImagePalette image_palette(const Picture *picture) {
    switch (picture->type) {
    case PICTURE_PNG:
    case PICTURE_GIF:
        return (ImagePalette){size_in_file(picture), true};
    case PICTURE_TGA:
    case PICTURE_BMP:
    case PICTURE_SYS:
        return (ImagePalette){size_in_header(picture->path, picture->type), false};
    case PICTURE_TIFF: // without a look inside
    case PICTURE_IFF:
        return (ImagePalette){256, false};
    default:
        return (ImagePalette){0, false};
    }
}
