// SPDX-License-Identifier: MIT
// Small pieces of self-contained pages: text that cannot break out of its place, pictures inside.
#ifndef REPORT_HTML_H
#define REPORT_HTML_H

#include "image/image.h"

#include <stdio.h>

// text with & < > " ' escaped, for elements and for attributes in double quotes.
void html_text(FILE *out, const char *text);
// The picture as a data: URL of a PNG with 8 bits, the values as they are.
void html_png_url(FILE *out, const Image *image);

#endif
