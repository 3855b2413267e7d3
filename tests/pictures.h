// SPDX-License-Identifier: MIT
// What tests on pictures share: running programs, a folder that is removed again, povray's and
// qirender's pictures of one scene and how far they differ.
#ifndef TESTS_PICTURES_H
#define TESTS_PICTURES_H

#include "image/image.h"

#include <stdbool.h>

#define EXAMPLES "/usr/share/doc/povray/examples/"
#define CORPUS "../shared/corpus/"

// An absolute path of a new folder below build/test; the same one until the program ends, then it
// is removed.
const char *scratch_folder(void);

// Runs a shell command; its exit status, or -1. Output goes to <scratch>/log, whose text is in *log
// when log is not NULL (in the heap, valid until the next call).
int run_command(const char **log, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Renders scene (a path, absolute or from the project's folder) with switches, in the scene's
// folder, into <scratch>/<name>.png. Ends the test with the program's own words when it fails.
const char *render_with_povray(const char *name, const char *scene, const char *switches);
const char *render_with_qirender(const char *name, const char *scene, const char *switches);

// The share in percent of pixels that differ by more than limit (1 = full range) in some channel.
double percent_over(const char *picture_a, const char *picture_b, double limit);

#endif
