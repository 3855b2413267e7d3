// SPDX-License-Identifier: MIT
// Pictures on surfaces, in every format that both POV-Ray and OpenImageIO read: decoded, laid on,
// interpolated and made transparent as POV-Ray does it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/array.h"
#include "group_arena.h"
#include "image/image.h"
#include "pictures.h"
#include "texture_rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 23, HEIGHT = 17 };

// A picture with smooth parts and edges; its path.
static const char *draw(const char *name, int channels, int bits, ImageWriteOptions options) {
    const char *path = arena_printf(arena, "%s/%s", scratch_folder(), name);
    Image image = {.width = WIDTH, .height = HEIGHT, .channels = channels, .bits = bits};
    image.pixels = ARENA_ARRAY(arena, float, (size_t)(WIDTH * HEIGHT * channels));
    float steps = bits == 8 ? 255.0f : 65535.0f;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        for (int c = 0; c < channels; c++) {
            int x = i % WIDTH, y = i / WIDTH;
            float v = 0.5f + 0.5f * sinf((float)(x * (c + 1) + y * y % 7) * 0.4f);
            if ((x / 4 + y / 5 + c) % 3 == 0)
                v = 1.0f - v;
            if (c == 3 || (channels == 2 && c == 1))
                v = (float)(x + y) / (WIDTH + HEIGHT);
            image.pixels[i * channels + c] = roundf(v * steps) / steps;
        }
    options.bits = bits;
    image_write(path, &image, &options);
    return path;
}

static ImageWriteOptions as(ImageFormat format) {
    ImageWriteOptions options = image_write_options_default();
    options.format = format;
    options.srgb = false;
    return options;
}

typedef ARRAY(TextureRow) Rows;

// %s in text: the picture.
static void add(Rows *rows, const char *path, const char *text) {
    const char *at = strstr(text, "%s");
    const char *whole =
        at ? arena_printf(arena, "%.*s%s%s", (int)(at - text), text, path, at + 2) : text;
    TextureRow row = {"", whole};
    array_push(rows, row);
}

static void check(Rows *rows) {
    texture_rows_check(rows->items, rows->count);
    array_free(rows);
}

#define LAID "translate -0.5 scale <5,4,1>"

static void formats(void **state) {
    (void)state;
    Rows rows = {0};
    static const char map[] = "pigment { image_map { %s } " LAID " }";
    static const char *const plain[] = {"jpeg \"%s\"", "tga \"%s\"", "bmp \"%s\"",
                                        "ppm \"%s\"",  "hdr \"%s\"", "tiff \"%s\""};
    const char *paths[] = {
        draw("a.jpg", 3, 8, as(IMAGE_JPEG)), draw("a.tga", 3, 8, as(IMAGE_TGA)),
        draw("a.bmp", 3, 8, as(IMAGE_BMP)),  draw("a.ppm", 3, 8, as(IMAGE_PPM)),
        draw("a.hdr", 3, 8, as(IMAGE_HDR)),  draw("a.tif", 3, 8, as(IMAGE_TIFF)),
    };
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) {
        const char *at = strstr(plain[i], "%s");
        add(&rows, arena_printf(arena, "%.*s%s\"", (int)(at - plain[i]), plain[i], paths[i]), map);
    }
    static const char png[] = "pigment { image_map { png \"%s\" } " LAID " }";
    add(&rows, draw("rgb.png", 3, 8, as(IMAGE_PNG)), png);
    add(&rows, draw("rgb16.png", 3, 16, as(IMAGE_PNG)), png);
    add(&rows, draw("grey.png", 1, 8, as(IMAGE_PNG)), png);
    add(&rows, draw("grey16.png", 1, 16, as(IMAGE_PNG)), png);
    add(&rows, draw("srgb.png", 3, 8, image_write_options_default()), png);
    ImageWriteOptions gamma = as(IMAGE_PNG);
    gamma.gamma = 1.8;
    add(&rows, draw("gamma.png", 3, 8, gamma), png);
    add(&rows, "", "pigment { image_map { \"test.png\" } " LAID " }");
    check(&rows);
}

static void transparency(void **state) {
    (void)state;
    Rows rows = {0};
    static const char behind[] = " } plane { z, 3 pigment { checker rgb 1 rgb <0.2,0.3,0.6> }";
    const char *rgba = draw("rgba.png", 4, 8, as(IMAGE_PNG)),
               *rgb = draw("b.png", 3, 8, as(IMAGE_PNG));
    static const char *const texts[] = {
        "pigment { image_map { png \"%s\" } " LAID " }",
        "pigment { image_map { png \"%s\" interpolate 2 } " LAID " }",
        "pigment { image_map { png \"%s\" transmit all 0.3 filter all 0.2 } " LAID " }",
        "pigment { image_map { png \"%s\" once } translate -0.5 scale 3 }",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        add(&rows, rgba, arena_printf(arena, "%s%s", texts[i], behind));
        add(&rows, rgb, arena_printf(arena, "%s%s", texts[i], behind));
    }
    add(&rows, "",
        "pigment { image_map { png \"test.png\" filter 0, 0.7 transmit 2, 0.8 transmit 3, 0.4 "
        "} " LAID " } } plane { z, 3 pigment { checker rgb 1 rgb 0.2 }");
    add(&rows, "",
        "pigment { image_map { png \"test.png\" transmit all 0.5 } " LAID
        " } } plane { z, 3 pigment { checker rgb 1 rgb 0.2 }");
    add(&rows, draw("grey_alpha.png", 2, 8, as(IMAGE_PNG)),
        "pigment { image_map { png \"%s\" } " LAID " } } plane { z, 3 pigment { checker rgb 1 rgb "
        "0.2 }");
    check(&rows);
}

// A GIF of 128 colours, its places in codes of 8 bits: before their strings need a ninth, the table
// is cleared.
static const char *draw_gif(void) {
    const char *path = arena_printf(arena, "%s/places.gif", scratch_folder());
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite("GIF89a", 1, 6, file);
    const unsigned char screen[] = {WIDTH + 1, 0, HEIGHT, 0, 0xf6, 0, 0};
    fwrite(screen, 1, sizeof screen, file);
    for (int i = 0; i < 128; i++)
        for (int c = 0; c < 3; c++)
            fputc((i * (37 + 20 * c) + 50 * c) % 256, file);
    const unsigned char transparent[] = {0x21, 0xf9, 4, 1, 0, 0, 9, 0};
    fwrite(transparent, 1, sizeof transparent, file);
    const unsigned char picture[] = {0x2c, 0, 0, 0, 0, WIDTH + 1, 0, HEIGHT, 0, 0, 7};
    fwrite(picture, 1, sizeof picture, file);
    for (int y = 0; y < HEIGHT; y++) {
        fputc(WIDTH + 2, file);
        fputc(128, file); // clear
        for (int x = 0; x < WIDTH + 1; x++)
            fputc((x / 2 + y / 3 * 5) % 128, file);
    }
    const unsigned char end[] = {1, 129, 0, 0x3b};
    fwrite(end, 1, sizeof end, file);
    assert_int_equal(fclose(file), 0);
    return path;
}

// By the palette and its places. Before, only the colours of a GIF were known: filter and transmit
// of a place were refused, and use_index took the grey.
static void gif_places(void **state) {
    (void)state;
    Rows rows = {0};
    static const char *const texts[] = {
        "pigment { image_map { gif \"%s\" } " LAID
        " } } plane { z, 3 pigment { checker rgb 1 rgb 0.2 }",
        "pigment { image_map { gif \"%s\" filter 3, 0.7 transmit 5, 0.6 interpolate 2 } " LAID
        " } } plane { z, 3 pigment { checker rgb 1 rgb 0.2 }",
        "pigment { image_pattern { gif \"%s\" use_index } " LAID " }",
        "pigment { image_pattern { gif \"%s\" } " LAID " }",
        "pigment { rgb 0.9 } normal { bump_map { gif \"%s\" use_index interpolate 2 bump_size 20 "
        "} " LAID " }",
        "texture { material_map { gif \"%s\" texture { pigment { rgb x } } texture { pigment { rgb "
        "y } } "
        "texture { pigment { rgb z } } } " LAID " }",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        add(&rows, draw_gif(), texts[i]);
    check(&rows);
}

// Pictures made by functions, of numbers and of colours, some over 1 and below 0; through every
// pattern that looks at pictures. Before, they were a plain grey.
static void functions(void **state) {
    (void)state;
    Rows rows = {0};
    static const char *const texts[] = {
        "pigment { image_map { function 9, 7 { x*y } } " LAID " }",
        "pigment { image_map { function 9, 7 { 1.3*x - y } interpolate 2 } " LAID " }",
        "pigment { image_map { function 12, 12 { pattern { bozo scale 0.2 } } once } translate "
        "-0.5 "
        "scale 3 } } plane { z, 3 pigment { rgb 0.4 }",
        "pigment { image_map { function 11, 13 { pigment { gradient x color_map { [0 rgbf "
        "<0.9,0.2,0.1,0.4>] [0.5 rgbt <0.2,0.3,1.2,0.5>] [1 rgb <0,1,0>] } scale 0.7 } } "
        "interpolate 3 } " LAID " } } plane { z, 3 pigment { checker rgb 1 rgb <0.2,0.3,0.6> }",
        "pigment { image_map { function 8, 6 { spline { linear_spline 0, <0.1,0.2,0.9,0,0> 1, "
        "<1,0.5,0.3,0,0.3> } } } " LAID " }",
        "pigment { image_pattern { function 5, 5 { sin(9*x) + y } use_alpha } " LAID " }",
        "pigment { rgb 0.9 } normal { bump_map { function 40, 40 { sin(20*x)*cos(15*y) } "
        "interpolate "
        "2 bump_size 3 } " LAID " }",
        "texture { material_map { function 6, 6 { (floor(6*x) + floor(6*y))/510 } texture { "
        "pigment "
        "{ rgb x } } texture { pigment { rgb y } } texture { pigment { rgb z } } } " LAID " }",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        add(&rows, "", texts[i]);
    check(&rows);
}

static void layouts(void **state) {
    (void)state;
    Rows rows = {0};
    const char *path = draw("c.png", 3, 8, as(IMAGE_PNG));
    static const char *const options[] = {
        "",
        "interpolate 2",
        "interpolate 3",
        "interpolate 4",
        "map_type 1",
        "map_type 2 interpolate 2",
        "map_type 5",
        "map_type 1 interpolate 3",
        "repeat <2,3> offset <0.3,0.2>",
        "once interpolate 2 offset <0.2,0>",
        "map_type 2 once interpolate 3",
        "map_type 5 repeat <3,2>",
    };
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        add(&rows, path,
            arena_printf(
                arena,
                "pigment { image_map { png \"%%s\" %s } scale <1.7,1.4,1.2> rotate <10,20,5> }",
                options[i]));
    add(&rows, path, "uv_mapping pigment { image_map { png \"%s\" interpolate 2 } scale 0.4 }");
    check(&rows);
}

static void gamma_of_files(void **state) {
    (void)state;
    Rows rows = {0};
    const char *path = draw("d.png", 3, 8, as(IMAGE_PNG)),
               *tga = draw("d.tga", 3, 8, as(IMAGE_TGA));
    add(&rows, path, "pigment { image_map { png \"%s\" gamma 1.6 } " LAID " }");
    add(&rows, path, "pigment { image_map { png \"%s\" gamma srgb } " LAID " }");
    add(&rows, path, "pigment { image_map { png \"%s\" gamma 1.0 } " LAID " }");
    add(&rows, tga, "pigment { image_map { tga \"%s\" gamma 2.2 } " LAID " }");
    add(&rows, path,
        "pigment { image_pattern { png \"%s\" gamma 2.2 interpolate 2 } color_map { [0 "
        "rgb x] [1 rgb y] } " LAID " }");
    check(&rows);
}

static void values(void **state) {
    (void)state;
    Rows rows = {0};
    const char *rgb = draw("e.png", 3, 8, as(IMAGE_PNG)),
               *rgba = draw("f.png", 4, 8, as(IMAGE_PNG)),
               *grey = draw("g.png", 1, 8, as(IMAGE_PNG));
    static const char *const texts[] = {
        "pigment { image_pattern { png \"%s\" interpolate 2 } color_map { [0 rgb x] [0.5 rgb 1] [1 "
        "rgb z] } " LAID " }",
        "pigment { image_pattern { png \"%s\" use_alpha } color_map { [0 rgb x] [1 rgb z] } " LAID
        " }",
        "pigment { rgb 0.8 } normal { bump_map { png \"%s\" interpolate 2 bump_size 3 } " LAID " }",
        "pigment { rgb 0.8 } normal { bump_map { png \"%s\" once } bump_size 2 translate -0.5 "
        "scale 3 "
        "}",
        "pigment { rgb 0.8 } normal { image_pattern { png \"%s\" interpolate 3 }, 0.5 " LAID " }",
        "texture { material_map { png \"%s\" texture { pigment { rgb x } } texture { pigment { rgb "
        "y "
        "} normal { bumps scale 0.1 } } texture { pigment { bozo scale 0.1 } } } " LAID " }",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        add(&rows, rgb, texts[i]);
        add(&rows, i == 1 ? rgba : grey, texts[i]);
        add(&rows, "test.png", texts[i]);
    }
    add(&rows, "",
        "pigment { rgb 0.8 } normal { bump_map { png \"test.png\" use_index } bump_size 0.2 " LAID
        " }");
    add(&rows, rgb,
        "texture { image_pattern { png \"%s\" } texture_map { [0.3 pigment { rgb x }] [0.7 "
        "pigment { rgb z }] } " LAID " }");
    check(&rows);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(functions), cmocka_unit_test(gif_places),
        cmocka_unit_test(formats),   cmocka_unit_test(transparency),
        cmocka_unit_test(layouts),   cmocka_unit_test(gamma_of_files),
        cmocka_unit_test(values),
    };
    return cmocka_run_group_tests_name("image_map", tests, create_arena, destroy_arena);
}
