// SPDX-License-Identifier: MIT
// Small scene texts converted in process, for the tests of the converter.
#ifndef TESTS_CONVERT_HELP_H
#define TESTS_CONVERT_HELP_H

#include "converter/convert.h"

typedef struct {
    Scene *scene;    // NULL: it died
    char *message;   // then why, with file:line:col
    size_t warnings; // printed or not
} Converted;

// The text behind "#version 3.7; global_settings { assumed_gamma 1 }" and a line end.
Converted convert_text(const char *text);
// The text as it is.
Converted convert_raw(const char *text);
// A file, with its own folder (and more, NULL at the end) as library paths.
Converted convert_file(const char *path, const char *const *libraries);
// The first warning that the text gives (as --strict makes it an error), or "".
const char *first_warning(const char *text);

// What povray prints with #write(Out, ...) for that text; NULL: povray is not there.
char *povray_output(const char *text);

// ---- for cmocka tests: these fail the running one ----------------------------------------------

Scene *scene_of(const char *text); // as convert_text, which must succeed
const Object *root(const Scene *scene, uint32_t i);
const Object *child(const Scene *scene, const Object *object, uint32_t i);
const Texture *texture_of(const Scene *scene, const Object *object);
const Pigment *pigment_of(const Scene *scene, const Object *object, uint32_t layer);
void assert_near(double a, double b);
void assert_vec(Vec3 v, double x, double y, double z);
void assert_color(Color c, double r, double g, double b, double filter, double transmit);
void assert_dies(const char *text, const char *fragment);
void assert_warns(const char *text, const char *fragment);
void assert_silent(const char *text);

#define PATCH_POINTS                                                                               \
    "<0,0,0><1,0,0><2,0,0><3,0,0> <0,1,0><1,1,0><2,1,0><3,1,0> "                                   \
    "<0,2,0><1,2,0><2,2,0><3,2,0> <0,3,0><1,3,0><2,3,0><3,3,1> "

#endif
