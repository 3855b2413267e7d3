// SPDX-License-Identifier: MIT
// qicompare as a program: exit status and figures for pictures made here, its page (self-contained,
// nothing escapes, the pictures in it are the pictures), and one scene through both renderers.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "own_folder.h"
#include "base/file.h"
#include "image/image.h"
#include "reference.h"
#include "report/heat.h"
#include "report/html.h"
#include "report/places.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#define PROGRAM "build/test/qicompare"

static void need_program(void) {
    if (access(PROGRAM, X_OK) != 0) {
        print_message("skipped: " PROGRAM " is not built\n");
        skip();
    }
}

// Runs qicompare in the folder; what it prints (both streams) goes to *said.
static int compare(const OwnFolder *place, const char *words, const char **said) {
    need_program();
    const char *command = arena_printf(
        place->arena, "cd %s && ASAN_OPTIONS=detect_leaks=0 %s/" PROGRAM " %s >said.txt 2>&1",
        place->folder, place->root, words);
    int status = system(command);
    *said = file_read(place->arena, own_path(place, "said.txt"), NULL, NULL);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static Image *plain(Arena *arena, int width, int height, float value) {
    Image *image = ARENA_NEW(arena, Image);
    *image = (Image){.width = width, .height = height, .channels = 3, .bits = 8};
    size_t count = (size_t)width * (size_t)height * 3;
    image->pixels = ARENA_ARRAY(arena, float, count);
    for (size_t i = 0; i < count; i++)
        image->pixels[i] = value;
    return image;
}

// one.png is grey; in two.png one pixel of 100 is off by 51 steps (0.2) and one by a single step.
static void write_pictures(const OwnFolder *place) {
    const ImageWriteOptions o = image_write_options_default();
    Image *image = plain(place->arena, 10, 10, 102.0f / 255.0f);
    image_write(own_path(place, "one.png"), image, &o);
    image->pixels[3 * 34 + 2] = 153.0f / 255.0f;
    image->pixels[0] = 103.0f / 255.0f;
    image_write(own_path(place, "two.png"), image, &o);
    image_write(own_path(place, "small.png"), plain(place->arena, 9, 10, 0.4f), &o);
}

// ---- tests -----------------------------------------------------------------------------------

static void exit_status(void **state) {
    OwnFolder *place = *state;
    write_pictures(place);
    const struct {
        const char *words;
        int status;
        const char *says;
    } cases[] = {
        {"one.png one.png", 0, "PASS"},
        {"one.png two.png", 1, "FAILURE"},
        {"one.png two.png --fail 0.21", 0, "WARNING"},
        {"one.png two.png --fail 0.21 --warn 0.21", 0, "PASS"},
        {"one.png two.png --failpercent 1.9", 1, "FAILURE"},
        {"one.png two.png --failpercent 2", 0, "WARNING"},
        {"one.png two.png --failpercent 2 --warnpercent=2", 0, "PASS"},
        {"one.png small.png", 1, "different sizes"},
        {"one.png missing.png", 1, "missing.png"},
        {"nowhere.txt one.png", 2, "nowhere.txt"}, // any other word is an INI file
        {"one.png", 2, "two pictures"},
        {"one.png two.png scene.pov", 2, "not both"},
        {"scene.qi.json", 2, ".pov"},
        {"nowhere.pov", 1, "nowhere.pov"},
        {"--fali 1 one.png two.png", 2, "--fail"},
        {"one.png two.png -o said.txt", 1, "said.txt"},
        {"--help", 0, "usage: qicompare"},
        {"--version", 0, "qicompare"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *said;
        int status = compare(place, cases[i].words, &said);
        if (status != cases[i].status || !strstr(said, cases[i].says))
            fail_msg("%s: status %d, said: %s", cases[i].words, status, said);
    }
}

static void figures_as_printed(void **state) {
    OwnFolder *place = *state;
    write_pictures(place);
    const char *said;
    compare(place, "one.png two.png --fail 0.1", &said);
    double mean = (51.0 + 1.0) / 255 / 300, rms = sqrt((51.0 * 51 + 1) / 300) / 255;
    const char *const lines[] = {
        arena_printf(place->arena, "Mean error = %.6g\n", mean),
        arena_printf(place->arena, "RMS error = %.6g\n", rms),
        arena_printf(place->arena, "Peak SNR = %.4g\n", 20 * log10(1 / rms)),
        "Max error  = 0.2 @ (4, 3, channel 2)\n",
        "1 pixels (1%) off by more than one step",
        "1 pixels (1%) over 0.1\n",
        "2 pixels (2%) over 1e-06\n",
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        if (!strstr(said, lines[i]))
            fail_msg("'%s' is not in: %s", lines[i], said);
}

// The scale doubles every eighth; a class holds what its name says.
static void scale_and_classes(void **state) {
    (void)state;
    for (int k = 0; k <= 8; k++)
        assert_true(fabs(heat_scale((exp2(k) - 1) / 255) - k / 8.0) < 1e-12);
    assert_true(heat_scale(-1) == 0 && heat_scale(7) == 1);
    assert_int_equal(heat_class(0), 0);
    assert_int_equal(heat_class(0.4 / 255), 1);
    for (int steps = 1; steps <= 255; steps++) {
        int expected = 2;
        for (int s = steps; s > 1; s /= 2)
            expected++;
        // As a difference of two values read from files: in float.
        float d = (float)(steps + 0) / 255.0f - 0.0f;
        assert_int_equal(heat_class((double)d), expected);
        float high = 1.0f, low = (float)(255 - steps) / 255.0f;
        assert_int_equal(heat_class((double)(high - low)), expected);
    }
    assert_int_equal(heat_class(100), HEAT_CLASSES - 1);
    for (int i = 0; i < HEAT_CLASSES; i++)
        assert_int_equal(heat_class(heat_class_middle(i)), i);
}

static void cuts_stay_inside(void **state) {
    OwnFolder *place = *state;
    Image *image = plain(place->arena, 50, 20, 0);
    for (int i = 0; i < 50 * 20; i++)
        image->pixels[3 * i] = (float)i;
    const int points[][4] = {{0, 0, 0, 0}, {49, 19, 18, 0}, {25, 10, 9, 0}};
    for (int i = 0; i < 3; i++) {
        int left, top;
        Image *cut = heat_cut(place->arena, image, points[i][0], points[i][1], 32, &left, &top);
        assert_true(cut->width == 32 && cut->height == 20);
        assert_true(left == points[i][2] && top == points[i][3]);
        assert_true(cut->pixels[0] == (float)left);
        assert_true(cut->pixels[3 * (32 * 20 - 1)] == (float)(left + 31 + 50 * 19));
    }
}

static void text_is_escaped(void **state) {
    (void)state;
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    html_text(out, "<b a=\"1\" b='2'>&amp;\033[0m\ttab \xc3\xa9\n");
    fclose(out);
    assert_string_equal(text,
                        "&lt;b a=&quot;1&quot; b=&#39;2&#39;&gt;&amp;amp;[0m\ttab \xc3\xa9\n");
    free(text);
}

// The bytes of the n-th data: URL of the page, or NULL.
static unsigned char *data_url(Arena *arena, const char *page, int n, size_t *size) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = page, *mark = "src=\"data:image/png;base64,";
    for (int i = 0; i <= n; i++) {
        at = strstr(at, mark);
        if (!at)
            return NULL;
        at += strlen(mark);
    }
    size_t length = strcspn(at, "\"");
    unsigned char *bytes = arena_alloc(arena, length);
    unsigned held = 0;
    int bits = 0;
    *size = 0;
    for (size_t i = 0; i < length && at[i] != '='; i++) {
        const char *digit = strchr(digits, at[i]);
        assert_non_null(digit);
        held = held << 6 | (unsigned)(digit - digits);
        bits += 6;
        if (bits >= 8)
            bytes[(*size)++] = (unsigned char)(held >> (bits -= 8));
    }
    return bytes;
}

static size_t count_of(const char *text, const char *part) {
    size_t count = 0;
    for (const char *at = strstr(text, part); at; at = strstr(at + 1, part))
        count++;
    return count;
}

static void page_holds_everything(void **state) {
    OwnFolder *place = *state;
    write_pictures(place);
    const char *odd = "o&dd '<b>.png";
    assert_int_equal(rename(own_path(place, "one.png"), own_path(place, odd)), 0);
    const char *said;
    assert_int_equal(compare(place, "\"o&dd '<b>.png\" two.png -o a/ -V", &said), 1); // a/ is made
    assert_non_null(strstr(said, "a/index.html"));
    const char *page = file_read(place->arena, own_path(place, "a/index.html"), NULL, NULL);
    assert_non_null(page);

    // Nothing from outside, nothing unescaped.
    assert_null(strstr(page, "http"));
    assert_null(strstr(page, "@import"));
    assert_null(strstr(page, "url("));
    assert_null(strstr(page, "<b>."));
    assert_non_null(strstr(page, "o&amp;dd &#39;&lt;b&gt;.png"));
    assert_int_equal(count_of(page, "src="), count_of(page, "src=\"data:image/png;base64,"));
    assert_int_equal(count_of(page, "src="), 7); // two, map, scale, three cut-outs: one place
    assert_int_equal(count_of(page, "<img"), count_of(page, " alt="));
    assert_int_equal(count_of(page, "<figure"), count_of(page, "</figure>"));
    assert_int_equal(count_of(page, "<div"), count_of(page, "</div>"));

    // The pictures are the pictures; the map is dark where they are equal.
    const char *const files[] = {own_path(place, odd), own_path(place, "two.png")};
    for (int i = 0; i < 3; i++) {
        size_t size;
        unsigned char *bytes = data_url(place->arena, page, i, &size);
        assert_non_null(bytes);
        FILE *f = fopen(own_path(place, "back.png"), "wb");
        fwrite(bytes, 1, size, f);
        fclose(f);
        Image *back = image_read(place->arena, own_path(place, "back.png"));
        if (i < 2) {
            Image *file = image_read(place->arena, files[i]);
            assert_true(image_compare(back, file, 0, 0).max == 0);
            continue;
        }
        assert_true(back->width == 10 && back->height == 10);
        float equal = back->pixels[3 * 55] + back->pixels[3 * 55 + 1] + back->pixels[3 * 55 + 2];
        float off = back->pixels[3 * 34] + back->pixels[3 * 34 + 1] + back->pixels[3 * 34 + 2];
        float step = back->pixels[0] + back->pixels[1] + back->pixels[2];
        assert_true(equal < 0.05f && step > equal && off > step);
    }
}

static void script_runs_in_a_browser(void **state) {
    OwnFolder *place = *state;
    if (system("command -v chromium >/dev/null 2>&1") != 0) {
        print_message("skipped: chromium is not installed\n");
        skip();
    }
    write_pictures(place);
    const char *said;
    compare(place, "one.png two.png -o a", &said);
    // The page itself, and after it what a reader does: moves the slider, blinks, comes back.
    const char *command = arena_printf(
        place->arena,
        "cd %s && cat a/index.html >t.html && echo '<script>onload=function(){"
        "var s=document.querySelector(\".stage\"),r=document.querySelector(\".under input\"),"
        "b=document.querySelectorAll(\".bar button\"),said=[];"
        "said.push(Array.from(document.images).every(function(i){return i.naturalWidth>0})?"
        "\"images \"+document.images.length:\"broken\");"
        "function cut(){return s.style.getPropertyValue(\"--cut\")}"
        "r.value=30;r.dispatchEvent(new Event(\"input\"));said.push(\"input \"+cut());"
        "var box=s.getBoundingClientRect();"
        "s.dispatchEvent(new PointerEvent(\"pointermove\",{clientX:box.left+0.75*box.width,"
        "clientY:box.top+5,buttons:1,pointerType:\"touch\",bubbles:true}));"
        "said.push(\"pointer \"+Math.round(parseFloat(cut())));"
        "b.forEach(function(x){if(x.value===\"blink\")x.click()});said.push(s.dataset.mode);"
        "b.forEach(function(x){if(x.value===\"slider\")x.click()});said.push(s.dataset.mode);"
        "document.body.setAttribute(\"data-said\",said.join(\"; \"))}</script>' >>t.html && "
        "timeout 60 chromium --headless --no-sandbox --disable-gpu --user-data-dir=%s/b "
        "--enable-logging=stderr --dump-dom file://%s/t.html >told.html 2>browser.txt && "
        "timeout 60 chromium --headless --no-sandbox --disable-gpu --user-data-dir=%s/b "
        "--enable-logging=stderr --dump-dom file://%s/a/index.html >dom.html 2>>browser.txt",
        place->folder, place->folder, place->folder, place->folder, place->folder);
    if (system(command) != 0) {
        print_message("skipped: chromium does not run here\n");
        skip();
    }
    const char *dom = file_read(place->arena, own_path(place, "dom.html"), NULL, NULL);
    assert_non_null(strstr(dom, "<html lang=\"en\" class=\"js\">"));
    assert_non_null(strstr(dom, "data-mode=\"slider\""));
    assert_non_null(strstr(dom, "--cut: 50%"));
    assert_non_null(strstr(dom, "one.png left, two.png right"));
    dom = file_read(place->arena, own_path(place, "told.html"), NULL, NULL);
    if (!strstr(dom, "data-said=\"images 7; input 30%; pointer 75; blink; slider\""))
        fail_msg("the page says %.200s", strstr(dom, "data-said"));
    assert_null(
        strstr(file_read(place->arena, own_path(place, "browser.txt"), NULL, NULL), "CONSOLE"));
}

// A ball of one colour under an orthographic camera: both renderers give the same bytes.
static void one_scene_both_renderers(void **state) {
    OwnFolder *place = *state;
    if (!reference_available()) {
        print_message("skipped: povray is not installed\n");
        skip();
    }
    FILE *f = fopen(own_path(place, "ball.pov"), "w");
    fputs("#version 3.7; global_settings { assumed_gamma 1.0 }\n"
          "camera { orthographic location -3*z right 4*x up 3*y direction z }\n"
          "sphere { 0, 0.97 pigment { rgb <0.9, 0.6, 0.3> } finish { ambient 1 diffuse 0 } }\n",
          f);
    fclose(f);
    const char *said;
    int status = compare(place, "ball.pov -h48 +W64 -o out --method facets -- +A0.3", &said);
    if (status != 0)
        fail_msg("status %d: %s", status, said);
    assert_non_null(strstr(said, "PASS"));
    assert_non_null(strstr(said, "User seconds: POV-Ray "));
    Image *a = image_read(place->arena, own_path(place, "out/povray.png"));
    Image *b = image_read(place->arena, own_path(place, "out/qirender.png"));
    assert_true(a->width == 64 && a->height == 48);
    assert_true(image_compare(a, b, 0, 0).max == 0);

    // The page names the commands, word for word; ours alone has the word with two dashes.
    const char *page = file_read(place->arena, own_path(place, "out/index.html"), NULL, NULL);
    assert_non_null(strstr(page, "<pre>povray -h48 +W64 +A0.3 +L./ +Iball.pov +Oout/povray.png "
                                 "+W64 +H48 -D -P</pre>"));
    assert_non_null(strstr(page, "/qirender -h48 +W64 +A0.3 +L./ --method facets +Iball.pov "
                                 "+Oout/qirender.png +W64 +H48 -D -P</pre>"));
    assert_non_null(strstr(page, "User seconds"));

    // What POV-Ray does not take stops the comparison, with its words.
    f = fopen(own_path(place, "bad.pov"), "w");
    fputs("sphere { 0, 1 pigment { rgb Redd } }\n", f);
    fclose(f);
    status = compare(place, "bad.pov +W8 +H6 -o out2", &said);
    assert_int_equal(status, 1);
    assert_non_null(strstr(said, "POV-Ray failed"));
    assert_non_null(strstr(said, "Redd"));
}

// Only what --region names is compared; places keep their numbers in the whole picture.
static void regions(void **state) {
    OwnFolder *place = *state;
    write_pictures(place);
    const char *said;
    assert_int_equal(compare(place, "one.png two.png --fail 0.0041 --region 2,1,8,5", &said), 1);
    assert_non_null(strstr(said, "1 pixels (2.5%) off by more than one step"));
    assert_non_null(strstr(said, "@ (4, 3, channel"));
    assert_int_equal(compare(place, "one.png two.png --fail 0.0041 --region 5,0,5,10", &said), 0);
    assert_int_equal(compare(place, "one.png two.png --region 10,0,4,10", &said), 1);
    assert_non_null(strstr(said, "outside"));
    assert_int_equal(compare(place, "one.png two.png --region 1,2,3", &said), 2);
    assert_non_null(strstr(said, "left,top,width,height"));
}

// Places: the worst first, each with its own neighbourhood, none below the limit.
static void places_are_apart(void **state) {
    OwnFolder *p = *state;
    Image *off = ARENA_NEW(p->arena, Image);
    *off = (Image){.width = 64, .height = 48, .channels = 1, .bits = 32};
    off->pixels = ARENA_ARRAY(p->arena, float, 64 * 48);
    off->pixels[10 * 64 + 20] = 0.5f;
    off->pixels[11 * 64 + 21] = 0.45f; // the same place
    off->pixels[40 * 64 + 60] = 0.75f;
    off->pixels[0] = 0.25f;
    off->pixels[63] = 0.05f;
    Place found[8];
    assert_int_equal(places_find(off, 0.1, 8, found), 3);
    assert_true(found[0].x == 60 && found[0].y == 40 && found[0].difference == 0.75);
    assert_true(found[1].x == 20 && found[1].y == 10);
    assert_true(found[2].x == 0 && found[2].y == 0);
    assert_int_equal(places_find(off, 0.1, 2, found), 2);
}

// The causes, each from pictures that can only mean that one.
static void causes_are_proved(void **state) {
    OwnFolder *p = *state;
    Image *a = plain(p->arena, 20, 20, 0.5f), *b = plain(p->arena, 20, 20, 0.5f),
          *c = plain(p->arena, 20, 20, 0.5f);
    b->pixels[3 * (10 * 20 + 10)] = 0.7f;
    c->pixels[3 * (10 * 20 + 10)] = 0.6f;
    const double limit = 1.0 / 255.0;
    Place place = {.x = 10, .y = 10, .difference = 0.2};
    PlaceProof proof = {.povray = a, .ours = b};
    places_judge(&proof, limit, &place, 1);
    assert_int_equal(place.cause, CAUSE_UNKNOWN);
    proof.facets = a, proof.finer = c; // with triangles it is POV-Ray's
    places_judge(&proof, limit, &place, 1);
    assert_int_equal(place.cause, CAUSE_GEOMETRY);
    assert_true(fabs(place.coarse - 0.2) < 1e-6 && fabs(place.fine - 0.1) < 1e-6);
    proof.facets = b; // the triangles change nothing
    places_judge(&proof, limit, &place, 1);
    assert_int_equal(place.cause, CAUSE_SHADING);
    proof.povray_plain = proof.plain = c; // without anti-aliasing they agree
    places_judge(&proof, limit, &place, 1);
    assert_int_equal(place.cause, CAUSE_SAMPLING);
    // Without the agreement, but a ray moved by next to nothing is POV-Ray's: rounding; or POV-Ray
    // sorted otherwise is ours: its bounding.
    Image *d = plain(p->arena, 20, 20, 0.5f);
    d->pixels[3 * (10 * 20 + 11)] = 0.6f; // another pixel flips: of each the nearest counts
    proof.povray_plain = proof.plain = NULL;
    for (int i = 0; i < PLACE_NUDGES; i++)
        proof.nudged[i] = i == 2 ? d : b;
    places_judge(&proof, limit, &place, 1);
    assert_int_equal(place.cause, CAUSE_ROUNDING);
    assert_true(place.nudged == 0.0);
    for (int i = 0; i < PLACE_NUDGES; i++)
        proof.nudged[i] = b;
    proof.povray_sorted = a;
    places_judge(&proof, limit, &place, 1);
    assert_int_equal(place.cause, CAUSE_SHADING);
    proof.povray_sorted = b;
    places_judge(&proof, limit, &place, 1);
    assert_int_equal(place.cause, CAUSE_BOUNDING);
    // A ray that POV-Ray alone sees so, and one that is off with those around it.
    proof.povray_sorted = NULL;
    places_judge(&proof, limit, &place, 1);
    Image *three = plain(p->arena, 3, 3, 0.5f), *other = plain(p->arena, 3, 3, 0.5f);
    three->pixels[3 * 4] = 0.7f;
    three->pixels[3 * 5] = 0.6f;
    places_judge_thirds(&(PlaceThirds){three, other}, limit, &place);
    assert_int_equal(place.cause, CAUSE_SHADING);
    three->pixels[3 * 5] = 0.5f;
    places_judge_thirds(&(PlaceThirds){three, other}, limit, &place);
    assert_int_equal(place.cause, CAUSE_LONE_RAY);
    assert_true(fabs(place.lone - 0.2) < 1e-6 && place.beside == 0.0);
    // A place at the edge of the picture has less around it.
    place = (Place){.x = 0, .y = 19, .difference = 0.2};
    places_judge(&proof, limit, &place, 1);
    assert_true(place.facets == 0.0);
}

// A patch cut coarsely, and a scene that is not there: a page each and one over them.
static void several_scenes(void **state) {
    OwnFolder *place = *state;
    if (!reference_available()) {
        print_message("skipped: povray is not installed\n");
        skip();
    }
    FILE *f = fopen(own_path(place, "patch.pov"), "w");
    fputs("#version 3.7; global_settings { assumed_gamma 1.0 }\n"
          "camera { location -5*z angle 40 }\nlight_source { <3, 5, -9>, 1 }\n"
          "bicubic_patch { type 1 u_steps 1 v_steps 1 <-1,-1,0> <-1,-.3,-2> <-1,.3,-2> <-1,1,0>\n"
          "<-.3,-1,0> <-.3,-.3,2> <-.3,.3,0> <-.3,1,0> <.3,-1,0> <.3,-.3,0> <.3,.3,2> <.3,1,0>\n"
          "<1,-1,0> <1,-.3,0> <1,.3,0> <1,1,0> pigment { rgb <.9,.5,.2> } }\n",
          f);
    fclose(f);
    const char *said;
    int status =
        compare(place, "patch.pov nowhere.pov -o all +W80 +H60 -V --fail 0.0041 --places 3", &said);
    assert_int_equal(status, 1);
    assert_non_null(strstr(said, "3 of the 3 worst places: geometry"));
    assert_non_null(strstr(said, "nowhere.pov: not compared"));
    const char *page = file_read(place->arena, own_path(place, "all/index.html"), NULL, NULL);
    assert_non_null(strstr(page, "href=\"patch/index.html\""));
    assert_non_null(strstr(page, "3 geometry"));
    assert_non_null(strstr(page, "not compared"));
    page = file_read(place->arena, own_path(place, "all/patch/index.html"), NULL, NULL);
    assert_int_equal(count_of(page, "Cause: <b>geometry</b>"), 3);
    assert_int_equal(count_of(page, "How the pixel comes about"), 6);
    assert_non_null(strstr(page, "QI nets down to it"));
}

// Stopped while POV-Ray reads a scene that never ends: the page of the scene before it is whole,
// the index names what is missing, and POV-Ray does not go on behind.
static void interruption_leaves_whole_files(void **state) {
    OwnFolder *place = *state;
    need_program();
    if (!reference_available()) {
        print_message("skipped: povray is not installed\n");
        skip();
    }
    FILE *f = fopen(own_path(place, "ball.pov"), "w");
    fputs("#version 3.7; global_settings { assumed_gamma 1.0 }\ncamera { location -3*z }\n"
          "sphere { 0, 1 pigment { rgb 1 } finish { ambient 1 } }\n",
          f);
    fclose(f);
    // A name that no other process has, so that POV-Ray can be looked for.
    const char *endless = arena_printf(place->arena, "endless%d", (int)getpid());
    f = fopen(own_path(place, arena_printf(place->arena, "%s.pov", endless)), "w");
    fputs("#version 3.7;\n#while (1) #local A = 1; #end\n", f);
    fclose(f);
    const char *command = arena_printf(
        place->arena,
        "cd %s && (ASAN_OPTIONS=detect_leaks=0 exec %s/" PROGRAM " ball.pov %s.pov ball2.pov "
        "+W16 +H12 -o all >said.txt 2>&1) & pid=$!; cd %s; for i in $(seq 1200); do "
        "[ -e all/%s/povray.txt ] && break; sleep 0.05; done; kill -INT $pid; wait $pid; "
        "status=$?; pgrep -f '[+]I%s' && exit 99; exit $status",
        place->folder, place->root, endless, place->folder, endless, endless);
    int status = system(command);
    assert_int_equal(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 2);
    const char *said = file_read(place->arena, own_path(place, "said.txt"), NULL, NULL);
    assert_non_null(strstr(said, ".pov: not compared"));
    assert_non_null(strstr(said, "qicompare: interrupted"));
    const char *page = file_read(place->arena, own_path(place, "all/index.html"), NULL, NULL);
    assert_non_null(page);
    assert_int_equal(count_of(page, "not compared"), 2);
    assert_non_null(strstr(page, "interrupted before it"));
    page = file_read(place->arena, own_path(place, "all/ball/index.html"), NULL, NULL);
    assert_non_null(strstr(page, "</html>"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        OWN_FOLDER_TEST(exit_status),
        OWN_FOLDER_TEST(figures_as_printed),
        OWN_FOLDER_TEST(scale_and_classes),
        OWN_FOLDER_TEST(cuts_stay_inside),
        OWN_FOLDER_TEST(text_is_escaped),
        OWN_FOLDER_TEST(page_holds_everything),
        OWN_FOLDER_TEST(script_runs_in_a_browser),
        OWN_FOLDER_TEST(one_scene_both_renderers),
        OWN_FOLDER_TEST(regions),
        OWN_FOLDER_TEST(places_are_apart),
        OWN_FOLDER_TEST(causes_are_proved),
        OWN_FOLDER_TEST(several_scenes),
        OWN_FOLDER_TEST(interruption_leaves_whole_files),
    };
    return cmocka_run_group_tests_name("compare", tests, NULL, NULL);
}
