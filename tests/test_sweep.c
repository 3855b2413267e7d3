// SPDX-License-Identifier: MIT
// qibench sweep on a small scene: errors fall with the tolerance, qi keeps its promise, POV-Ray's
// points are those of our own triangles, the page shows the figures of the table and opens in a
// browser.
#include "pictures.h"

#include "base/file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define POVRAY_IS_HERE (run_command(NULL, "command -v povray") == 0)

typedef struct {
    char method[32], prepare[8];
    double tolerance, flatness, position, rms, picture, leaks, off;
    int steps, holes;
    bool failed;
} Row;

static Row rows[128];
static int row_count;

// The field of a line, empty when there is none.
static const char *field(const char *line, int index) {
    static char text[256];
    for (; index > 0; index--) {
        line = strchr(line, ',');
        if (!line)
            return "";
        line++;
    }
    size_t length = strcspn(line, ",\n");
    snprintf(text, sizeof text, "%.*s", (int)length, line);
    return text;
}

static int column(const char *heading, const char *name) {
    for (int i = 0; i < 64; i++)
        if (strcmp(field(heading, i), name) == 0)
            return i;
    fail_msg("no column %s", name);
    return -1;
}

static void read_rows(const char *csv) {
    int position = column(csv, "position_max_diameters"), rms = column(csv, "picture_rms_steps"),
        picture = column(csv, "picture_s"), leaks = column(csv, "edge_leaks_share"),
        holes = column(csv, "pin_hole_pixels"), off = column(csv, "pixels_off_share");
    for (const char *line = strchr(csv, '\n') + 1; *line; line = strchr(line, '\n') + 1) {
        Row *r = &rows[row_count++];
        snprintf(r->method, sizeof r->method, "%s", field(line, 1));
        snprintf(r->prepare, sizeof r->prepare, "%s", field(line, 2));
        r->tolerance = atof(field(line, 3));
        r->steps = *field(line, 4) ? atoi(field(line, 4)) : -1;
        r->flatness = atof(field(line, 5));
        r->failed = *field(line, 6) != '\0';
        r->leaks = atof(field(line, leaks));
        r->holes = atoi(field(line, holes));
        r->off = atof(field(line, off));
        r->position = atof(field(line, position));
        r->rms = atof(field(line, rms));
        r->picture = atof(field(line, picture));
    }
}

static int sweep_once(void **state) {
    (void)state;
    if (run_command(NULL, "command -v gnuplot") != 0)
        return 0;
    const char *log;
    int status = run_command(&log,
                             "build/qibench sweep scenes/teapot-matte/teapot-matte.pov --include "
                             "scenes/teapot --size 64x48 --rounds 1 --html '%s/sweep' --povray %s",
                             scratch_folder(), POVRAY_IS_HERE ? "on" : "off");
    if (status != 0) {
        print_message("%s\n", log);
        return 1;
    }
    Arena *arena = arena_create();
    char path[4400];
    snprintf(path, sizeof path, "%s/sweep/sweep.csv", scratch_folder());
    read_rows(file_read(arena, path, NULL, NULL));
    arena_destroy(arena);
    return 0;
}

static void need_rows(void) {
    if (row_count > 0)
        return;
    print_message("skipped: gnuplot is not installed\n");
    skip();
}

// For each method: a smaller tolerance, or more steps, is no farther from the truth. Noise: below
// 1e-12 diameters rounding decides; the triangles' cracks and silhouettes are not monotone, so
// theirs is the picture's error, which may not grow by more than a tenth.
static void errors_fall(void **state) {
    (void)state;
    need_rows();
    int compared = 0;
    for (int i = 1; i < row_count; i++) {
        const Row *a = &rows[i - 1], *b = &rows[i];
        if (strcmp(a->method, b->method) != 0 || strcmp(a->prepare, b->prepare) != 0 || a->failed ||
            b->failed || a->flatness != b->flatness)
            continue;
        // Newton's method without bounds loses hits of its own; how many is not a matter of
        // tolerance.
        if (b->steps < 0 && strcmp(b->method, "newton") != 0)
            assert_true(b->position <= a->position || b->position < 1e-12);
        if (b->rms > 1.1 * a->rms + 1e-3)
            fail_msg("%s: RMS grows from %g to %g at tolerance %g, u_steps %d, flatness %g",
                     b->method, a->rms, b->rms, b->tolerance, b->steps, b->flatness);
        compared++;
    }
    assert_true(compared >= 15);
}

static void qi_keeps_its_tolerance(void **state) {
    (void)state;
    need_rows();
    int count = 0;
    for (int i = 0; i < row_count; i++)
        if (strcmp(rows[i].method, "qi") == 0) {
            assert_false(rows[i].failed);
            assert_true(rows[i].position <= rows[i].tolerance);
            assert_true(rows[i].leaks == 0.0 && rows[i].holes == 0);
            count++;
        }
    assert_int_equal(count, 12); // four tolerances, three ways to prepare
}

// The teapot's patches share edges at which triangles are cut alike: rays slip through all the
// same, since POV-Ray tests the edges of its triangles without tolerance.
static void triangles_leak(void **state) {
    (void)state;
    need_rows();
    int leaky = 0;
    for (int i = 0; i < row_count; i++)
        leaky += strcmp(rows[i].method, "facets") == 0 && rows[i].leaks > 0.0;
    assert_true(leaky > 0);
}

// The same steps give the same picture in POV-Ray and in ours, so the same error: to 0.01 steps.
static void povray_points_are_right(void **state) {
    (void)state;
    need_rows();
    if (!POVRAY_IS_HERE) {
        print_message("skipped: povray is not installed\n");
        skip();
    }
    int count = 0;
    for (int i = 0; i < row_count; i++)
        for (int k = 0; k < row_count; k++)
            if (strcmp(rows[i].method, "povray") == 0 && strcmp(rows[k].method, "facets") == 0 &&
                rows[i].steps == rows[k].steps && rows[k].flatness == 0) {
                assert_false(rows[i].failed);
                if (!(rows[i].rms - rows[k].rms < 0.01 && rows[k].rms - rows[i].rms < 0.01))
                    fail_msg("u_steps %d: %g and %g", rows[i].steps, rows[i].rms, rows[k].rms);
                count++;
            }
    assert_int_equal(count, 7);
}

static void page_shows_the_figures(void **state) {
    (void)state;
    need_rows();
    Arena *arena = arena_create();
    char path[4400], text[64];
    snprintf(path, sizeof path, "%s/sweep/index.html", scratch_folder());
    const char *page = file_read(arena, path, NULL, NULL);
    for (int i = 0; i < row_count; i++) {
        if (rows[i].failed)
            continue;
        snprintf(text, sizeof text, ">%.3f</td>", rows[i].picture);
        assert_non_null(strstr(page, text));
        snprintf(text, sizeof text, "<td>%.3g</td>", rows[i].rms);
        assert_non_null(strstr(page, text));
        if (strcmp(rows[i].method, "povray") == 0)
            continue; // tells only its picture
        snprintf(text, sizeof text, "<td>%.2g</td>", rows[i].position);
        assert_non_null(strstr(page, text));
        snprintf(text, sizeof text, "<td>%.2g&nbsp;%%</td><td>%d</td>", 100.0 * rows[i].leaks,
                 rows[i].holes);
        assert_non_null(strstr(page, text));
    }
    assert_null(strstr(page, "src=\"http"));
    if (run_command(NULL, "command -v chromium") != 0) {
        print_message("skipped: chromium is not installed\n");
    } else {
        const char *log;
        int status = run_command(
            &log,
            "cd '%s' && cat sweep/index.html >t.html && echo '<script>onload=function(){document."
            "title=Array.from(document.images).every(function(i){return i.naturalWidth>0})?"
            "\"all \"+document.images.length:\"broken\"}</script>' >>t.html && timeout 60 chromium "
            "--headless --no-sandbox --disable-gpu --user-data-dir='%s/b' --enable-logging=stderr "
            "--dump-dom 'file://%s/t.html' 2>browser.txt && ! grep CONSOLE browser.txt",
            scratch_folder(), scratch_folder(), scratch_folder());
        assert_int_equal(status, 0);
        assert_non_null(strstr(log, "<title>all 8</title>"));
    }
    arena_destroy(arena);
}

// Stopped in its second scene: the files of the first are whole, what is missing is named, and no
// process goes on.
static void interruption_leaves_whole_files(void **state) {
    need_rows();
    (void)state;
    char path[4400];
    snprintf(path, sizeof path, "%s/plain.pov", scratch_folder());
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs("camera { location -4*z } light_source { -9*z, 1 } bicubic_patch { type 1\n", f);
    for (int i = 0; i < 16; i++)
        fprintf(f, "<%g, %g, %g>\n", i / 4 / 1.5 - 1.0, i % 4 / 1.5 - 1.0, i == 5 ? -1.0 : 0.0);
    fputs("pigment { rgb 1 } }\n", f);
    fclose(f);
    const char *log;
    int status = run_command(
        &log,
        "cp '%s' '%s/other.pov'; build/qibench sweep '%s' '%s/other.pov' --size 8x8 --rounds 1 "
        "--povray off --html '%s/stopped' & pid=$!; for i in $(seq 1200); do [ -e "
        "'%s/stopped/index.html' ] && break; sleep 0.05; done; sleep 0.5; kill -INT $pid; wait "
        "$pid; status=$?; pgrep -f '^build/qibench sweep %s' && exit 99; exit $status",
        path, scratch_folder(), path, scratch_folder(), scratch_folder(), scratch_folder(), path);
    if (status != 2)
        fail_msg("status %d: %s", status, log);
    const char *said = strstr(log, "qibench: interrupted; not measured: ");
    assert_non_null(said);
    assert_non_null(strstr(said, "/other.pov; "));
    assert_null(strstr(said, "/plain.pov"));
    Arena *arena = arena_create();
    static const char *const files[] = {"index.html", "sweep.csv", "sweep.json"};
    static const char *const ends[] = {"</html>\n", "\n", "}\n"};
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/stopped/%s", scratch_folder(), files[i]);
        const char *text = file_read(arena, path, NULL, NULL);
        assert_non_null(text);
        assert_non_null(strstr(text, "plain.pov"));
        assert_string_equal(text + strlen(text) - strlen(ends[i]), ends[i]);
    }
    arena_destroy(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_fall),
        cmocka_unit_test(qi_keeps_its_tolerance),
        cmocka_unit_test(triangles_leak),
        cmocka_unit_test(povray_points_are_right),
        cmocka_unit_test(page_shows_the_figures),
        cmocka_unit_test(interruption_leaves_whole_files),
    };
    return cmocka_run_group_tests(tests, sweep_once, NULL);
}
