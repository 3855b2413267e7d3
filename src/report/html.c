// SPDX-License-Identifier: MIT
#include "report/html.h"

void html_text(FILE *out, const char *text) {
    for (; *text; text++) {
        switch (*text) {
        case '&':
            fputs("&amp;", out);
            break;
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        case '\'':
            fputs("&#39;", out);
            break;
        default:
            // Control characters of a log have no place in a page.
            if ((unsigned char)*text >= 32 || *text == '\n' || *text == '\t')
                putc(*text, out);
        }
    }
}

static void put_base64(FILE *out, const unsigned char *bytes, size_t size) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        unsigned three = (unsigned)bytes[i] << 16 | (left > 1 ? (unsigned)bytes[i + 1] << 8 : 0) |
                         (left > 2 ? bytes[i + 2] : 0);
        putc(digits[three >> 18], out);
        putc(digits[three >> 12 & 63], out);
        putc(left > 1 ? digits[three >> 6 & 63] : '=', out);
        putc(left > 2 ? digits[three & 63] : '=', out);
    }
}

void html_png_url(FILE *out, const Image *image) {
    Arena *scratch = arena_create();
    size_t size;
    const unsigned char *bytes = image_encode_png(scratch, image, &size);
    fputs("data:image/png;base64,", out);
    put_base64(out, bytes, size);
    arena_destroy(scratch);
}
