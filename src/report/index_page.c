// SPDX-License-Identifier: MIT
#include "report/index_page.h"

#include "base/file.h"
#include "base/version.h"
#include "report/heat.h"
#include "report/html.h"
#include "report/page_assets.h"

#include <math.h>
#include <string.h>

static void put_causes(FILE *out, const IndexRow *row) {
    bool any = false;
    for (int i = CAUSE_GEOMETRY; i < CAUSE_COUNT; i++) {
        if (!row->causes[i])
            continue;
        fprintf(out, "%s%d %s", any ? ", " : "", row->causes[i], place_cause_name((PlaceCause)i));
        any = true;
    }
    if (!any)
        fputs("&#8211;", out);
}

static void put_row(FILE *out, const IndexRow *row) {
    const ImageDifference *d = &row->difference;
    fputs("<tr><th scope=\"row\">", out);
    if (row->picture) {
        Arena *scratch = arena_create();
        fprintf(out, "<img class=\"small\" width=\"%d\" height=\"%d\" alt=\"\" src=\"",
                row->picture->width, row->picture->height);
        html_png_url(out, heat_shown(scratch, row->picture));
        fputs("\">", out);
        arena_destroy(scratch);
    }
    const char *name = file_name(row->title);
    if (row->failed) {
        html_text(out, name);
        fputs("</th><td class=\"FAILURE\">not compared</td><td colspan=\"6\" class=\"said\">"
              "<details><summary>Why</summary><pre>",
              out);
        html_text(out, row->failed);
        fputs("</pre></details></td></tr>\n", out);
        return;
    }
    fputs("<a href=\"", out);
    html_text(out, row->link);
    fputs("\" title=\"", out);
    html_text(out, row->title);
    fputs("\">", out);
    html_text(out, name);
    fprintf(out, "</a></th><td class=\"%s\">%s</td><td>%.3g&nbsp;%%</td><td>%.3g</td>",
            row->verdict, row->verdict, 100.0 * (double)d->different / (double)d->pixels,
            255.0 * d->max);
    if (isfinite(d->psnr))
        fprintf(out, "<td>%.1f</td>", d->psnr);
    else
        fputs("<td>&#8734;</td>", out);
    fprintf(out, "<td>%.2f</td><td>%.2f</td><td>", row->seconds[0], row->seconds[1]);
    put_causes(out, row);
    fputs("</td></tr>\n", out);
}

void index_page_write(const IndexRow *rows, size_t count, const char *machine, const char *path) {
    OutputFile *file = file_begin(path);
    FILE *out = file_stream(file);
    fprintf(out,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
            "<title>%zu scenes</title>\n<style>\n%s</style>\n</head>\n<body>\n<main>\n"
            "<header>\n<h1>%zu scenes, POV-Ray and qirender</h1>\n</header>\n",
            count, page_style, count);
    fputs("<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">Scene</th><th scope=\"col\">"
          "Verdict</th><th scope=\"col\">Pixels that differ</th><th scope=\"col\">Largest</th>"
          "<th scope=\"col\">PSNR</th><th scope=\"col\">POV-Ray, s</th><th scope=\"col\">qirender, "
          "s</th><th scope=\"col\">Worst places</th></tr></thead>\n<tbody>\n",
          out);
    for (size_t i = 0; i < count; i++)
        put_row(out, &rows[i]);
    fputs("</tbody>\n</table></div>\n<p class=\"soft\"><small>Pixels that differ: by more than one "
          "step of 8&nbsp;bits. Largest: in steps. PSNR in dB. User seconds of whole programs, one "
          "run each",
          out);
    if (machine) {
        fputs(" on ", out);
        html_text(out, machine);
    }
    fprintf(out, ".</small></p>\n<footer>qicompare %s</footer>\n</main>\n</body>\n</html>\n",
            QIPOV_VERSION);
    file_commit(file);
}
