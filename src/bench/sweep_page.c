// SPDX-License-Identifier: MIT
// Curves are gnuplot's SVG, put into the page as it is; axes are logarithmic, so an error of 0 is
// drawn at the left border of its axis and the caption says so.
#include "bench/sweep_page.h"

#include "base/diag.h"
#include "base/file.h"
#include "base/version.h"
#include "report/heat.h"
#include "report/html.h"
#include "report/page_assets.h"
#include "report/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The least error that is drawn.
static const double LEAST_POSITION = 1e-17, LEAST_PICTURE = 1e-3;

// One curve: points of one method.
typedef struct {
    const char *title;
    bool povray;
    PatchMethod method;
    bool flat; // facets by flatness rather than steps
    const char *color;
    PatchPrepare prepare; // of qi
} Curve;

static const Curve curves[] = {
    {.title = "qi", .method = METHOD_QI, .color = "#0b63b0"},
    {.title = "qi, prepared light",
     .method = METHOD_QI,
     .prepare = PREPARE_LIGHT,
     .color = "#3f9fd8"},
    {.title = "qi, not prepared", .method = METHOD_QI, .prepare = PREPARE_NONE, .color = "#8fcbea"},
    {.title = "clipping", .method = METHOD_CLIPPING, .color = "#d1495b"},
    {.title = "newton", .method = METHOD_NEWTON, .color = "#edae49"},
    {.title = "Embree's triangles", .method = METHOD_TESSELLATION, .color = "#66a182"},
    {.title = "qi-paper", .method = METHOD_QI_PAPER, .color = "#a0a0a0"},
    {.title = "POV-Ray's triangles, u_steps", .method = METHOD_FACETS, .color = "#8d6a9f"},
    {.title = "POV-Ray's triangles, flatness",
     .method = METHOD_FACETS,
     .flat = true,
     .color = "#c7a9d6"},
    {.title = "POV-Ray itself, u_steps", .povray = true, .color = "#222222"},
};
enum { CURVES = sizeof curves / sizeof *curves };

static bool belongs(const Curve *curve, const SweepResult *r) {
    return !r->failed && r->point.povray == curve->povray &&
           (curve->povray || r->point.method == curve->method) &&
           (curve->povray || r->point.prepare == curve->prepare) &&
           (curve->povray || curve->method != METHOD_FACETS ||
            (r->point.flatness > 0.0) == curve->flat);
}

static double error_of(const SweepResult *r, bool picture) {
    return picture ? fmax(r->rms, LEAST_PICTURE) : fmax(r->position_max, LEAST_POSITION);
}

static int count_points(const Sweep *s, const Curve *curve, bool picture) {
    int count = 0;
    for (size_t i = 0; i < s->count; i++)
        count += belongs(curve, &s->results[i]) && (picture || !curve->povray);
    return count;
}

static int by_error(const void *a, const void *b) {
    const double *x = a, *y = b;
    return (x[0] > y[0]) - (x[0] < y[0]);
}

// The front as a line, from the smallest error on.
static void put_front(const Sweep *s, FILE *script) {
    double(*points)[2] = NULL;
    Arena *scratch = arena_create();
    points = arena_alloc(scratch, s->count * sizeof *points);
    size_t count = 0;
    for (size_t i = 0; i < s->count; i++)
        if (s->results[i].front) {
            points[count][0] = error_of(&s->results[i], true);
            points[count++][1] = s->results[i].picture.median;
        }
    qsort(points, count, sizeof *points, by_error);
    fputs("$front << END\n", script);
    for (size_t i = 0; i < count; i++)
        fprintf(script, "%.9g %.9g\n", points[i][0], points[i][1]);
    fputs("END\n", script);
    arena_destroy(scratch);
}

// gnuplot's script: picture RMS, or the position's error, against the time to the picture.
static void write_script(const Sweep *s, bool picture, const char *svg, const char *path) {
    OutputFile *file = file_begin(path);
    FILE *script = file_stream(file);
    fprintf(script,
            "set terminal svg size 680,600 dynamic font 'sans-serif,15' background '#ffffff'\n"
            "set output '%s'\nset logscale xy\nset format x '10^{%%L}'\nset grid lc '#dddddd'\n"
            "set key tmargin center horizontal maxcols 2 samplen 2 width -3 font ',13' "
            "noenhanced\nset ylabel 'seconds to the "
            "picture'\n"
            "set xlabel '%s'\n",
            svg,
            picture ? "RMS of the picture, steps of 8 bits" : "largest error of a hit, diameters");
    for (int c = 0; c < CURVES; c++) {
        fprintf(script, "$curve%d << END\n", c);
        for (size_t i = 0; i < s->count; i++)
            if (belongs(&curves[c], &s->results[i]) && (picture || !curves[c].povray))
                fprintf(script, "%.9g %.9g\n", error_of(&s->results[i], picture),
                        s->results[i].picture.median);
        fputs("END\n", script);
    }
    if (picture)
        put_front(s, script);
    fputs("plot ", script);
    if (picture)
        fputs("$front with lines lw 6 lc '#e6e6c8' title 'Pareto front', ", script);
    bool any = false;
    for (int c = 0; c < CURVES; c++) {
        if (!count_points(s, &curves[c], picture))
            continue;
        fprintf(script, "%s$curve%d with linespoints lw 1.6 pt %d ps 0.8 lc rgb '%s' title \"%s\"",
                any ? ", " : "", c, c + 4, curves[c].color, curves[c].title);
        any = true;
    }
    putc('\n', script);
    file_commit(file);
}

static void put_curve(FILE *out, const Sweep *s, bool picture, const char *folder) {
    Arena *arena = arena_create();
    const char *script = arena_printf(arena, "%s/curve.gp", folder),
               *svg = arena_printf(arena, "%s/curve.svg", folder);
    write_script(s, picture, svg, script);
    Command command = {.count = 0};
    run_add(&command, "gnuplot");
    run_add(&command, script);
    run_command_line(&command, "gnuplot (package gnuplot-nox)",
                     arena_printf(arena, "%s/curve.txt", folder), arena);
    const char *why, *text = file_read(arena, svg, NULL, &why);
    if (!text)
        die("cannot read what gnuplot drew: %s", why);
    const char *start = strstr(text, "<svg");
    fputs("<figure class=\"curve\">", out);
    fputs(start ? start : text, out);
    fprintf(out, "<figcaption>%s</figcaption></figure>\n",
            picture ? "Lower and further left is better. An RMS below 0.001 is drawn at 0.001."
                    : "An error of 0 is drawn at 1e-17. POV-Ray tells only its picture.");
    arena_destroy(arena);
}

// ---- Maps

// False colours on a logarithmic scale from least to most.
static void put_map(FILE *out, const Image *map, double least, const char *caption,
                    const char *unit) {
    Arena *arena = arena_create();
    double most = least;
    size_t pixels = (size_t)map->width * (size_t)map->height;
    for (size_t i = 0; i < pixels; i++)
        if (isfinite(map->pixels[i]))
            most = fmax(most, (double)map->pixels[i]);
    Image scaled = *map, ramp = {.width = 256, .height = 1, .channels = 1, .bits = 32};
    scaled.pixels = ARENA_ARRAY(arena, float, pixels);
    ramp.pixels = ARENA_ARRAY(arena, float, 256);
    double range = log(most / least);
    for (size_t i = 0; i < pixels; i++) {
        double at = range > 0.0 && map->pixels[i] > 0.0f
                        ? log((double)map->pixels[i] / least) / range
                        : 0.0;
        scaled.pixels[i] = (float)fmin(fmax(at, 0.0), 1.0);
    }
    for (int i = 0; i < 256; i++)
        ramp.pixels[i] = (float)i / 255.0f;
    fprintf(out, "<figure><img width=\"%d\" height=\"%d\" alt=\"%s\" src=\"", map->width,
            map->height, caption);
    html_png_url(out, heat_shown(arena, image_false_color(arena, &scaled)));
    fputs("\"><div class=\"ramp\"><img width=\"256\" height=\"1\" alt=\"\" src=\"", out);
    html_png_url(out, heat_shown(arena, image_false_color(arena, &ramp)));
    fprintf(
        out,
        "\"><div class=\"ticks\"><span>%.2g</span><span>%.2g</span><span>%.2g %s</span></div></div>"
        "<figcaption>%s</figcaption></figure>\n",
        least, sqrt(least * most), most, unit, caption);
    arena_destroy(arena);
}

// ---- The page

static void put_table(FILE *out, const Sweep *s) {
    Arena *arena = arena_create();
    fputs("<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">Method</th><th "
          "scope=\"col\">Picture, s</th><th scope=\"col\">least&#8211;most</th><th "
          "scope=\"col\">Rounds</th><th scope=\"col\">MB</th><th scope=\"col\">Mray/s</th><th "
          "scope=\"col\">Prepare, "
          "ms</th><th scope=\"col\">Position, diameters</th><th "
          "scope=\"col\">pixels</th><th scope=\"col\">Normal, &#176;</th><th scope=\"col\">Wrong "
          "hits</th><th "
          "scope=\"col\">Edge rays lost</th><th scope=\"col\">Pin-holes</th><th scope=\"col\">RMS, "
          "steps</th><th scope=\"col\">PSNR, dB</th><th "
          "scope=\"col\">Pixels off</th></tr></thead>\n<tbody>\n",
          out);
    for (size_t i = 0; i < s->count; i++) {
        const SweepResult *r = &s->results[i];
        fprintf(out, "<tr%s><th scope=\"row\">%s</th>", r->front ? " class=\"front\"" : "",
                sweep_point_name(&r->point, arena));
        if (r->failed) {
            fprintf(out, "<td colspan=\"15\" class=\"said\">%s</td></tr>\n", r->failed);
            continue;
        }
        fprintf(out, "<td>%.3f</td><td class=\"soft\">%.3f&#8211;%.3f</td><td>%d</td><td>%.0f</td>",
                r->picture.median, r->picture.least, r->picture.most, r->rounds, r->megabytes);
        if (r->point.povray)
            fputs("<td colspan=\"8\"></td>", out);
        else
            fprintf(out,
                    "<td>%.3g</td><td>%.1f</td><td>%.2g</td><td>%.2g</td><td>%.2g</td>"
                    "<td>%.2g&nbsp;%%</td><td>%.2g&nbsp;%%</td><td>%d</td>",
                    r->rays_per_second * 1e-6, 1e3 * r->prepare.median, r->position_max,
                    r->position_pixels, r->normal_max, 100.0 * r->wrong, 100.0 * r->leaks,
                    r->holes);
        fprintf(out, "<td>%.3g</td>", r->rms);
        if (isfinite(r->psnr))
            fprintf(out, "<td>%.1f</td>", r->psnr);
        else
            fputs("<td>&#8734;</td>", out);
        fprintf(out, "<td>%.3g&nbsp;%%</td></tr>\n", 100.0 * r->off);
    }
    fputs("</tbody>\n</table></div>\n<p class=\"soft\"><small>Bold: on the Pareto front of time "
          "against the picture&#8217;s RMS. Edge rays go through smooth edges that two patches "
          "share; pin-holes are pixels inside a surface that show what lies behind it. POV-Ray "
          "tells only its picture; its memory and time are those beyond reading the "
          "scene.</small></p>\n",
          out);
    arena_destroy(arena);
}

// Where finer triangles make the picture worse, and what tells why: rays that they lose, cracks, or
// single pixels although all hits come nearer.
static void put_findings(FILE *out, const Sweep *s) {
    Arena *arena = arena_create();
    for (size_t i = 1; i < s->count; i++) {
        const SweepResult *a = &s->results[i - 1], *b = &s->results[i];
        if (a->failed || b->failed || a->point.povray || b->point.povray ||
            a->point.method != METHOD_FACETS || b->point.method != METHOD_FACETS ||
            (a->point.flatness > 0.0) != (b->point.flatness > 0.0) || b->rms <= 1.1 * a->rms + 1e-3)
            continue;
        fprintf(out, "<p>Finer is not nearer: from %s to ", sweep_point_name(&a->point, arena));
        fprintf(out,
                "%s the picture&#8217;s RMS grows from %.3g to %.3g. Over the pixels whose rays "
                "meet what they should it goes from %.3g to %.3g, edge rays lost from %.2g to "
                "%.2g&nbsp;%%, pin-holes from %d to %d, normals&#8217; RMS from %.2g to "
                "%.2g&nbsp;&#176;; the worst pixel is (%d, %d), %.3g steps.</p>\n",
                sweep_point_name(&b->point, arena), a->rms, b->rms, a->rms_same, b->rms_same,
                100.0 * a->leaks, 100.0 * b->leaks, a->holes, b->holes, a->normal_rms,
                b->normal_rms, b->worst_x, b->worst_y, b->worst);
    }
    arena_destroy(arena);
}

static void put_scene(FILE *out, const Sweep *s, const char *folder) {
    fputs("<h2>", out);
    html_text(out, file_name(s->scene));
    fprintf(out,
            "</h2>\n<p class=\"soft\">%u patches, %zu shared edges, %d &#215; %d pixels, one "
            "pinned thread, median of %d round%s in turn. A point may take %g seconds, all rounds "
            "together; then it has no more rounds, or is given up. The truth is qi at "
            "1e-14.</p>\n",
            s->patches, s->edges, s->width, s->height, s->rounds, s->rounds == 1 ? "" : "s",
            s->patience);
    if (s->no_povray) {
        fputs("<p>POV-Ray&#8217;s own points are missing: ", out);
        html_text(out, s->no_povray);
        fputs(".</p>\n", out);
    }
    put_curve(out, s, true, folder);
    put_curve(out, s, false, folder);
    put_table(out, s);
    put_findings(out, s);
    if (!s->distance)
        return;
    fputs("<div class=\"pair\">\n", out);
    put_map(out, s->distance, 1e-4,
            "How far the scene&#8217;s own triangles are from the patches, across them", "pixels");
    put_map(out, s->angle, 1e-3, "How far their normals are off", "degrees");
    put_map(out, s->steps, 1.0, "qi: pieces tested and Newton steps of each camera ray", "");
    put_map(out, s->leaves, 1.0, "qi: pieces in the leaves that each camera ray visits", "");
    fputs("</div>\n", out);
}

void sweep_page_write(const Sweep *const *sweeps, size_t count, const char *command,
                      const char *path) {
    Arena *arena = arena_create();
    char folder[] = "/tmp/qibench-XXXXXX";
    if (!mkdtemp(folder))
        die("cannot make a temporary folder '%s'", folder);
    OutputFile *file = file_begin(path);
    FILE *out = file_stream(file);
    fprintf(
        out,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>Speed against accuracy</title>\n<style>\n%s.curve "
        "svg{width:100%%;max-width:46rem;height:auto}"
        ".scroll table{border-collapse:separate;border-spacing:0}"
        ".scroll th:first-child{position:sticky;left:0;background:var(--paper);"
        "background-clip:padding-box}"
        "@media print{@page{margin:12mm}.curve svg{max-width:26rem}.scroll{overflow:visible}"
        ".scroll th:first-child{position:static}.scroll table{font-size:6pt}"
        ".scroll thead th{white-space:normal;font-size:6pt;vertical-align:bottom}"
        ".scroll th,.scroll td{padding:.12rem 0 .12rem .3rem}}"
        "tr.front th,tr.front td{font-weight:600}figure{margin-bottom:1.2rem}\n</style>\n</head>\n"
        "<body>\n<main>\n<header>\n<h1>Speed against accuracy</h1>\n<p class=\"soft\">",
        page_style);
    html_text(out, run_machine(arena));
    fprintf(out, ", instruction set %s, gcc %s, qipov %s", patch_isa_name(), __VERSION__,
            QIPOV_VERSION);
    if (count > 0 && sweeps[0]->povray_version) {
        fputs(", ", out);
        html_text(out, sweeps[0]->povray_version);
    }
    fputs(".</p>\n</header>\n", out);
    for (size_t i = 0; i < count; i++)
        put_scene(out, sweeps[i], folder);
    fputs("<h2>Command</h2>\n<pre>", out);
    html_text(out, command);
    fprintf(out, "</pre>\n<footer>qibench %s</footer>\n</main>\n</body>\n</html>\n", QIPOV_VERSION);
    file_commit(file);
    char *remove = arena_printf(arena, "rm -rf '%s'", folder);
    if (system(remove) != 0)
        warn("'%s' stays behind", folder);
    arena_destroy(arena);
}
