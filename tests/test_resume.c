// SPDX-License-Identifier: MIT
// A render that was interrupted or killed goes on from where it was, to the same bytes; and the
// file that makes it possible is not trusted further than its check sums reach.
#include "pictures.h"

#include "base/file.h"
#include "render/resume.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

// ---- the file -------------------------------------------------------------------------------

enum { WIDE = 6, HIGH = 5, SIDE = 2, ACROSS = 3, TILES = 9 };

static PixelRect tile_at(const void *context, int i) {
    (void)context;
    int left = i % ACROSS * SIDE, top = i / ACROSS * SIDE;
    return (PixelRect){left, top, left + SIDE, top + SIDE < HIGH ? top + SIDE : HIGH};
}

static Color color_of(int x, int y) { return (Color){(float)x, (float)y, 0.25f, -1.0f, 0.5f}; }

// The context is the number, and how often it was asked for.
typedef struct {
    uint64_t number;
    int asked;
} Identity;

static uint64_t identity_of(const void *context) {
    Identity *identity = (Identity *)context;
    identity->asked++;
    return identity->number;
}

static ResumeJob job_of(Color *picture, const Identity *identity) {
    return (ResumeJob){.identity = identity_of,
                       .context = identity,
                       .width = WIDE,
                       .tile_count = TILES,
                       .tile = tile_at,
                       .picture = picture};
}

static void fill(Color *picture, int tile) {
    PixelRect t = tile_at(NULL, tile);
    for (int y = t.top; y < t.bottom; y++)
        for (int x = t.left; x < t.right; x++)
            picture[y * WIDE + x] = color_of(x, y);
}

// How many tiles are taken up; those are right, all else is black.
static int taken_up(const char *path, uint64_t number) {
    Color picture[WIDE * HIGH] = {{0}};
    const Identity identity = {.number = number};
    const ResumeJob job = job_of(picture, &identity);
    Resume *resume = resume_create(path, &job, true);
    Color want[WIDE * HIGH] = {{0}};
    for (int i = 0; i < TILES; i++)
        if (resume_has(resume, i))
            fill(want, i);
    assert_memory_equal(picture, want, sizeof want);
    int count = resume_count(resume);
    resume_destroy(resume);
    return count;
}

static void keep(const char *path, bool take_up, int from, int to) {
    Color picture[WIDE * HIGH] = {{0}};
    const Identity identity = {.number = 7};
    const ResumeJob job = job_of(picture, &identity);
    Resume *resume = resume_create(path, &job, take_up);
    for (int i = from; i < to; i++) {
        fill(picture, i);
        resume_tile(resume, i);
    }
    // It was worked out for every picture, a fifth of the time of 200,000 small solids.
    assert_int_equal(identity.asked, take_up ? 1 : 0);
    assert_true(resume_keep(resume));
    resume_destroy(resume);
}

static void tiles_come_back(void **state) {
    (void)state;
    char path[4400];
    snprintf(path, sizeof path, "%s/tiles", scratch_folder());
    assert_int_equal(taken_up(path, 7), 0); // no file
    keep(path, false, 0, 4);
    assert_int_equal(taken_up(path, 7), 4);
    keep(path, true, 4, 7);
    assert_int_equal(taken_up(path, 7), 7);
    assert_int_equal(taken_up(path, 8), 0); // of another scene
    keep(path, false, 8, 9);
    assert_int_equal(taken_up(path, 7), 1);
    resume_remove(path);
    assert_false(file_exists(path));
}

// Cut at every byte, and with every byte changed: sound records before the place count, no other.
static void damage_is_seen(void **state) {
    (void)state;
    char path[4400];
    snprintf(path, sizeof path, "%s/damaged", scratch_folder());
    keep(path, false, 0, 3);
    Arena *arena = arena_create();
    size_t size, record = 16 + SIDE * SIDE * sizeof(Color);
    const char *bytes = file_read(arena, path, &size, NULL);
    assert_int_equal(size, 24 + 3 * record);
    for (size_t at = 0; at < size; at++) {
        int before = at < 24 ? 0 : (int)((at - 24) / record);
        for (int change = 0; change < 2; change++) {
            char *copy = arena_copy(arena, bytes, size);
            copy[at] = (char)(copy[at] ^ 0x5a);
            FILE *f = fopen(path, "wb");
            assert_int_equal(fwrite(copy, 1, change ? size : at, f), change ? size : at);
            fclose(f);
            assert_int_equal(taken_up(path, 7), before);
        }
    }
    // What follows a damaged record is written anew.
    keep(path, true, 2, 9);
    assert_int_equal(taken_up(path, 7), 9);
    arena_destroy(arena);
}

// ---- the program ----------------------------------------------------------------------------

#define RENDER                                                                                     \
    "build/test/qirender +Iscenes/shells/shells.pov +W240 +H180 +A0.05 +R6 +BS8 +WT2 -V "          \
    "'+O%s/%s.png'"

// Renders until the state file is `share` of all colours, then sends the signal; its status.
static int stop_at(const char *name, double share, const char *signal, const char **log) {
    const char *folder = scratch_folder();
    char render[4500];
    snprintf(render, sizeof render, RENDER, folder, name);
    return run_command(log,
                       "%s & pid=$!; for i in $(seq 6000); do"
                       " size=$(stat -c %%s '%s/%s.png.qi-state' 2>/dev/null || echo 0);"
                       " [ $size -ge %d ] && break; kill -0 $pid 2>/dev/null || break; sleep 0.01;"
                       " done; kill -%s $pid; wait $pid",
                       render, folder, name, (int)(share * 240 * 180 * sizeof(Color)), signal);
}

// Stops a render there, and goes on with +C.
static void stop_and_go_on(const char *name, double share, const char *signal, int status) {
    const char *folder = scratch_folder();
    char render[4500];
    snprintf(render, sizeof render, RENDER, folder, name);
    const char *log;
    assert_int_equal(stop_at(name, share, signal, &log), status);
    if (status == 2)
        assert_non_null(strstr(log, "+C goes on from there"));
    char path[4500];
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    assert_false(file_exists(path));
    assert_int_equal(run_command(&log, "%s +C +V", render), 0);
    assert_non_null(strstr(log, "Pixels taken up"));
    assert_int_equal(run_command(NULL, "cmp '%s/whole.png' '%s/%s.png'", folder, folder, name), 0);
    assert_int_equal(run_command(NULL, "ls '%s'/*.qi-state 2>/dev/null", folder), 2);
}

static void interrupted_renders_go_on(void **state) {
    (void)state;
    char render[4500];
    snprintf(render, sizeof render, RENDER, scratch_folder(), "whole");
    assert_int_equal(run_command(NULL, "%s", render), 0);
    stop_and_go_on("third", 0.3, "INT", 2);
    stop_and_go_on("late", 0.6, "INT", 2);
    stop_and_go_on("ended", 0.45, "TERM", 2);
    stop_and_go_on("killed", 0.5, "KILL", 128 + 9);
}

// Tiles of a run with other options are not mixed in. --prepare moves the last bits of hits, and
// was forgotten: its tiles were taken up.
static void other_options_start_anew(void **state) {
    (void)state;
    char render[4500];
    const char *log;
    snprintf(render, sizeof render, RENDER, scratch_folder(), "other");
    assert_int_equal(stop_at("other", 0.1, "KILL", &log), 128 + 9);
    // Which no picture gets unless it is asked for.
    assert_int_equal(run_command(&log, "%s +C --prepare none", render), 0);
    assert_non_null(strstr(log, "of other options"));
}

// Frames whose pictures are there stay as they are: the first one here is not even a picture.
static void animations_go_on(void **state) {
    (void)state;
    const char *folder = scratch_folder();
    assert_int_equal(
        run_command(NULL,
                    "cd '%s' && echo 'sphere { 0, 1 pigment { rgb 1 } finish { ambient 1 } }"
                    " camera { location <0,0,-3> }' >a.pov && echo mine >a1.png &&"
                    " '%s/build/test/qirender' a.pov +W8 +H6 +KFF2 +C && cat a1.png && ls a2.png",
                    folder, getenv("PWD")),
        0);
    size_t size;
    Arena *arena = arena_create();
    char path[4400];
    snprintf(path, sizeof path, "%s/a1.png", folder);
    assert_string_equal(file_read(arena, path, &size, NULL), "mine\n");
    arena_destroy(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiles_come_back),           cmocka_unit_test(damage_is_seen),
        cmocka_unit_test(interrupted_renders_go_on), cmocka_unit_test(other_options_start_anew),
        cmocka_unit_test(animations_go_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
