// SPDX-License-Identifier: MIT
#include "image/picture.h"

#include "base/diag.h"
#include "image/gif.h"
#include "image/png_read.h"

StoredPicture *picture_read(Arena *arena, const char *path, bool png) {
    StoredPicture *picture = ARENA_NEW(arena, StoredPicture);
    if (png) {
        char why[OIIO_WHY];
        if (!png_read_picture(arena, path, picture, why))
            die("cannot read '%s': %s", path, why);
        return picture;
    }
    if (gif_read(arena, path, picture))
        return picture;
    const Image *image = image_read(arena, path);
    *picture = (StoredPicture){.width = image->width,
                               .height = image->height,
                               .channels = image->channels,
                               .bits = image->bits,
                               .values = image->pixels};
    return picture;
}
