// SPDX-License-Identifier: MIT
// From the top: what was compared, the figures, the two pictures over each other, the map of the
// differences with its scale, the worst places enlarged, with their causes, times, commands.
#include "report/compare_page.h"

#include "base/file.h"
#include "base/version.h"
#include "report/heat.h"
#include "report/html.h"
#include "report/page_assets.h"

#include <math.h>
#include <string.h>

enum {
    SMALL = 480, // pictures narrower than this are shown with square pixels
    CUT = 32,    // side of the enlarged cut-outs in pixels
};

static void put_picture(FILE *out, const Image *image, const char *alt, const char *caption) {
    Arena *scratch = arena_create();
    fprintf(out, "<figure%s><img width=\"%d\" height=\"%d\" alt=\"",
            image->width < SMALL ? " class=\"crisp\"" : "", image->width, image->height);
    html_text(out, alt);
    fputs("\" src=\"", out);
    html_png_url(out, heat_shown(scratch, image));
    fputs("\">", out);
    if (caption) {
        fputs("<figcaption>", out);
        html_text(out, caption);
        fputs("</figcaption>", out);
    }
    fputs("</figure>\n", out);
    arena_destroy(scratch);
}

// ---- sections --------------------------------------------------------------------------------

static void put_head(FILE *out, const ComparePage *page) {
    const Image *image = page->side[0].image;
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>",
          out);
    html_text(out, page->title);
    fprintf(out, "</title>\n<style>\n%s</style>\n</head>\n<body>\n<main>\n<header>\n<h1>",
            page_style);
    html_text(out, page->title);
    fputs("</h1>\n<p class=\"soft\">", out);
    html_text(out, page->side[0].name);
    fputs(" and ", out);
    html_text(out, page->side[1].name);
    fprintf(out, ", %d &#215; %d pixels. <span class=\"verdict %s\">", image->width, image->height,
            page->verdict);
    html_text(out, page->verdict);
    fprintf(out, "</span>: %g&nbsp;%% of the pixels may differ by more than %g.</p>\n</header>\n",
            page->fail_percent, page->fail);
}

static void put_figure(FILE *out, const char *name, const char *value, const char *note) {
    fprintf(out, "<div><dt>%s</dt><dd>%s<small>%s</small></dd></div>\n", name, value, note);
}

static const char *channel_name(int channels, int channel) {
    static const char *const names[] = {"red", "green", "blue", "alpha"};
    return channels < 3 ? (channel == 0 ? "grey" : "alpha") : names[channel < 4 ? channel : 3];
}

static void put_figures(FILE *out, const ComparePage *page) {
    const ImageDifference *d = &page->difference;
    char value[64], note[128];
    double percent = 100.0 / (double)d->pixels;
    fputs("<dl class=\"figures\">\n", out);

    snprintf(value, sizeof value, "%.3g %%", (double)d->different * percent);
    snprintf(note, sizeof note, "%llu pixels, by more than one step of 8&nbsp;bits",
             (unsigned long long)d->different);
    put_figure(out, "Pixels that differ", value, note);

    if (isfinite(d->psnr))
        snprintf(value, sizeof value, "%.2f dB", d->psnr);
    else
        snprintf(value, sizeof value, "&#8734;");
    put_figure(out, "Peak signal to noise", value, isfinite(d->psnr) ? "" : "the same values");

    snprintf(value, sizeof value, "%.3g", 255.0 * d->mean);
    put_figure(out, "Mean error", value, "steps of 8&nbsp;bits");
    snprintf(value, sizeof value, "%.3g", 255.0 * d->rms);
    put_figure(out, "RMS error", value, "steps of 8&nbsp;bits");

    snprintf(value, sizeof value, "%.4g", 255.0 * d->max);
    if (d->max > 0)
        snprintf(note, sizeof note, "steps, %s at (%d, %d)",
                 channel_name(page->side[0].image->channels, d->max_channel), d->max_x + page->left,
                 d->max_y + page->top);
    else
        snprintf(note, sizeof note, "steps of 8&nbsp;bits");
    put_figure(out, "Largest error", value, note);
    if (d->perceptible >= 0) {
        snprintf(value, sizeof value, "%lld", (long long)d->perceptible);
        put_figure(out, "Seen by an eye", value, "pixels, by Yee&#8217;s perceptual metric");
    }
    fputs("</dl>\n", out);
}

static void put_stage(FILE *out, const ComparePage *page) {
    fputs("<section aria-label=\"The two pictures\">\n<div class=\"bar\">"
          "<button type=\"button\" value=\"slider\">Slider</button>"
          "<button type=\"button\" value=\"blink\">Blink</button>"
          "<button type=\"button\" value=\"pair\">Side by side</button></div>\n"
          "<div class=\"pair stage\" data-mode=\"pair\" data-first=\"",
          out);
    html_text(out, page->side[0].name);
    fputs("\" data-second=\"", out);
    html_text(out, page->side[1].name);
    fputs("\">\n", out);
    for (int i = 0; i < 2; i++)
        put_picture(out, page->side[i].image, page->side[i].name, page->side[i].name);
    fputs("</div>\n<div class=\"under\"><b></b><span></span>"
          "<input type=\"range\" min=\"0\" max=\"100\" step=\"0.1\" "
          "aria-label=\"Where one picture ends and the other begins\"></div>\n</section>\n",
          out);
}

// The whole scale as a picture of one row.
static Image *scale_colors(Arena *arena) {
    enum { STEPS = 256 };
    Image values = {.width = STEPS, .height = 1, .channels = 1, .bits = 8};
    values.pixels = ARENA_ARRAY(arena, float, STEPS);
    for (int i = 0; i < STEPS; i++)
        values.pixels[i] = (float)i / (STEPS - 1);
    Image *colors = image_false_color(arena, &values);
    return heat_shown(arena, colors);
}

static void put_counts(FILE *out, const Image *differences, const Image *scale) {
    uint64_t count[HEAT_CLASSES], most = 1;
    double pixels = (double)differences->width * differences->height;
    heat_count(differences, count);
    int last = 1;
    for (int i = 0; i < HEAT_CLASSES; i++) {
        if (count[i] > most)
            most = count[i];
        if (count[i])
            last = i;
    }
    fputs("<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">Difference in steps</th>"
          "<th scope=\"col\">Pixels</th><th "
          "scope=\"col\">Share</th><th></th></tr></thead>\n<tbody>\n",
          out);
    for (int i = 0; i <= last; i++) {
        if (i == 1 && !count[i]) // pictures of 8 bits have none
            continue;
        int at = (int)lround(heat_scale(heat_class_middle(i)) * (scale->width - 1));
        const float *c = scale->pixels + 3 * at;
        // Bars grow with the logarithm: one pixel out of a million should still be seen.
        double bar = count[i] ? 2 + 98 * log1p((double)count[i]) / log1p((double)most) : 0;
        fprintf(out,
                "<tr><th scope=\"row\"><span class=\"swatch\" "
                "style=\"background:rgb(%ld,%ld,%ld)\"></span>%s</th><td>%llu</td>"
                "<td>%.3g&nbsp;%%</td><td class=\"share\">%s",
                lround(255.0 * (double)c[0]), lround(255.0 * (double)c[1]),
                lround(255.0 * (double)c[2]), heat_class_name(i), (unsigned long long)count[i],
                100.0 * (double)count[i] / pixels, count[i] ? "" : "</td></tr>\n");
        if (count[i])
            fprintf(out, "<i style=\"width:%.1f%%\"></i></td></tr>\n", bar);
    }
    fputs(
        "</tbody>\n</table></div>\n<p class=\"soft\"><small>A step is 1/255 of the full range. The "
        "bars grow with the logarithm of the count.</small></p>\n",
        out);
}

static void put_map(FILE *out, const Image *differences, const Image *map, const Image *scale) {
    fputs("<h2>Where they differ</h2>\n", out);
    put_picture(out, map, "Map of the differences", NULL);
    fputs("<div class=\"ramp\"><img width=\"256\" height=\"1\" alt=\"Scale from 0 to 255 steps\" "
          "src=\"",
          out);
    html_png_url(out, scale);
    fputs(
        "\"><div class=\"ticks\"><span>0</span><span>1</span><span>3</span><span>7</span>"
        "<span>15</span><span>31</span><span>63</span><span>127</span><span>255 steps</span></div>"
        "</div>\n"
        "<p class=\"soft\"><small>The largest difference over the channels of each pixel, on a "
        "logarithmic scale: lighter is more.</small></p>\n",
        out);
    put_counts(out, differences, scale);
}

static void put_story(FILE *out, const char *of, const char *story) {
    if (!story)
        return;
    fprintf(out, "<details><summary>How the pixel comes about, %s</summary><pre>", of);
    html_text(out, story);
    fputs("</pre></details>\n", out);
}

// The cause, and the figures that prove it.
static void put_proof(FILE *out, const Place *place) {
    if (place->cause == CAUSE_UNKNOWN)
        return;
    double step = 255.0;
    fprintf(out, "<p>Cause: <b>%s</b>. ", place_cause_name(place->cause));
    switch (place->cause) {
    case CAUSE_GEOMETRY:
        fprintf(out,
                "With POV-Ray&#8217;s own triangles our picture is POV-Ray&#8217;s here (off by "
                "%.3g). From those triangles ours is %.3g off, and %.3g when they are cut once "
                "more",
                step * place->facets, step * place->coarse, step * place->fine);
        break;
    case CAUSE_SAMPLING:
        fprintf(out,
                "Without anti-aliasing both renderers agree here (off by %.3g); with it even "
                "POV-Ray&#8217;s own triangles are %.3g off",
                step * place->plain, step * place->facets);
        break;
    case CAUSE_ROUNDING:
        fprintf(out,
                "The last digit of a sum decides here: a ray meets an edge exactly. With "
                "POV-Ray&#8217;s own triangles our picture is %.3g off, but with all rays moved by "
                "%g of a pixel it is POV-Ray&#8217;s (off by %.3g)",
                step * place->facets, PLACE_NUDGE, step * place->nudged);
        break;
    case CAUSE_BOUNDING:
        fprintf(out,
                "POV-Ray&#8217;s boxes of single precision lose the ray: with its other way of "
                "sorting objects (+BM2) POV-Ray&#8217;s own picture is ours, with its triangles, "
                "here (off by %.3g; %.3g with its boxes)",
                step * place->sorted, step * place->facets);
        break;
    case CAUSE_LONE_RAY:
        fprintf(
            out,
            "POV-Ray is alone with this ray: with its triangles our picture is its own on the "
            "eight rays a third of a pixel away (off by %.3g), and %.3g off on the pixel&#8217;s "
            "own",
            step * place->beside, step * place->lone);
        break;
    default:
        fprintf(out,
                "With POV-Ray&#8217;s own triangles our picture is still %.3g off here, so the "
                "patches&#8217; geometry is not the reason; the stories below name what the ray "
                "meets",
                step * place->facets);
    }
    fputs(".</p>\n", out);
}

static void put_place(FILE *out, const ComparePage *page, int index, const Image *map) {
    Arena *scratch = arena_create();
    const Place *place = &page->places[index];
    int left = 0, top = 0;
    const Image *const whole[3] = {page->side[0].image, page->side[1].image, map};
    const char *const names[3] = {page->side[0].name, page->side[1].name, "difference"};
    fprintf(out, "<h3>%d. Pixel (%d, %d): %.4g steps</h3>\n<div class=\"trio\">\n", index + 1,
            place->x + page->left, place->y + page->top, 255.0 * place->difference);
    for (int i = 0; i < 3; i++) {
        const Image *cut = heat_cut(scratch, whole[i], place->x, place->y, CUT, &left, &top);
        put_picture(out, cut, names[i], names[i]);
    }
    fputs("</div>\n", out);
    put_proof(out, place);
    put_story(out, "ours", place->story[0]);
    put_story(out, "with POV-Ray&#8217;s triangles", place->story[1]);
    arena_destroy(scratch);
}

static void put_places(FILE *out, const ComparePage *page, const Image *map) {
    if (page->place_count == 0)
        return;
    fprintf(out,
            "<h2>The worst places</h2>\n<p class=\"soft\"><small>%d &#215; %d pixels around each, "
            "enlarged; differences in steps of 8&nbsp;bits, the largest within %d "
            "pixels.</small></p>\n",
            CUT, CUT, PLACE_REACH);
    for (int i = 0; i < page->place_count; i++)
        put_place(out, page, i, map);
}

// Lines of what qirender said that name something it does not model.
static void put_missing(FILE *out, const ComparePage *page) {
    const char *log = page->side[1].run.log;
    bool any = false;
    for (const char *line = log; line && *line;) {
        const char *end = line + strcspn(line, "\n"), *found = strstr(line, "not modelled");
        if (found && found < end) {
            if (!any)
                fputs(
                    "<h2>Not modelled</h2>\n<p>What qirender warned of is missing in its picture, "
                    "and is the first thing to suspect where the cause is shading:</p>\n<pre>",
                    out);
            any = true;
            Arena *scratch = arena_create();
            html_text(out, arena_printf(scratch, "%.*s\n", (int)(end - line), line));
            arena_destroy(scratch);
        }
        line = *end ? end + 1 : end;
    }
    if (any)
        fputs("</pre>\n", out);
}

static void put_times(FILE *out, const ComparePage *page) {
    if (page->side[0].run.seconds < 0 || page->side[1].run.seconds < 0)
        return;
    fputs(
        "<h2>Time</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th></th><th scope=\"col\">User "
        "seconds</th><th scope=\"col\">Elapsed</th><th scope=\"col\">Ratio</th></tr></thead>\n"
        "<tbody>\n",
        out);
    for (int i = 0; i < 2; i++) {
        const CompareSide *side = &page->side[i];
        fputs("<tr><th scope=\"row\">", out);
        html_text(out, side->name);
        fprintf(out, "</th><td>%.2f</td><td>%.2f</td>", side->run.seconds, side->run.elapsed);
        if (page->side[0].run.seconds >= 0.005)
            fprintf(out, "<td>%.3g</td></tr>\n", side->run.seconds / page->side[0].run.seconds);
        else
            fputs("<td>&#8211;</td></tr>\n", out);
    }
    fputs("</tbody>\n</table></div>\n<p class=\"soft\"><small>The whole program, reading the scene "
          "and writing the picture included; one run each",
          out);
    if (page->machine) {
        fputs(" on ", out);
        html_text(out, page->machine);
    }
    fputs(".</small></p>\n", out);
}

static void put_commands(FILE *out, const ComparePage *page) {
    if (!page->side[0].run.command || !page->side[1].run.command)
        return;
    fputs("<h2>Commands</h2>\n", out);
    for (int i = 0; i < 2; i++) {
        fputs("<pre>", out);
        html_text(out, page->side[i].run.command);
        fputs("</pre>\n", out);
    }
    for (int i = 0; i < 2; i++) {
        const CompareSide *side = &page->side[i];
        if (!side->run.log || !*side->run.log)
            continue;
        fputs("<details><summary>What ", out);
        html_text(out, side->name);
        fputs(" said</summary><pre>", out);
        html_text(out, side->run.log);
        fputs("</pre></details>\n", out);
    }
}

void compare_page_write(const ComparePage *page, const char *path) {
    Arena *arena = arena_create();
    const Image *differences = image_difference(arena, page->side[0].image, page->side[1].image);
    Image *map = heat_map(arena, differences), *scale = scale_colors(arena);

    OutputFile *file = file_begin(path);
    FILE *out = file_stream(file);
    put_head(out, page);
    put_figures(out, page);
    put_stage(out, page);
    put_map(out, differences, map, scale);
    put_missing(out, page);
    put_places(out, page, map);
    put_times(out, page);
    put_commands(out, page);
    fprintf(out,
            "<footer>qicompare %s</footer>\n</main>\n<script>\n%s</script>\n</body>\n</html>\n",
            QIPOV_VERSION, compare_script);
    file_commit(file);
    arena_destroy(arena);
}
