// SPDX-License-Identifier: MIT
// A table of scene texts, rendered by POV-Ray and, converted and traced here, compared with it
// pixel by pixel. Patches are POV-Ray's own triangles, so that every pixel may agree.
#ifndef TESTS_POVRAY_TABLE_H
#define TESTS_POVRAY_TABLE_H

#include <stddef.h>

// A bent patch P, for a stage.
#define TABLE_PATCH                                                                                \
    "#declare P = bicubic_patch { type 1 flatness 0 u_steps 2 v_steps 2\n"                         \
    "  <-1.5,-1.2,0>, <-1.5,-0.2,0.4>, <-1.5,0.8,0.8>, <-1.5,1.8,0>,\n"                            \
    "  <-0.5,-1.2,0.4>, <-0.5,-0.2,0.8>, <-0.5,0.8,-1>, <-0.5,1.8,0.4>,\n"                         \
    "  <0.5,-1.2,0.8>, <0.5,-0.2,-1>, <0.5,0.8,0.4>, <0.5,1.8,0.8>,\n"                             \
    "  <1.5,-1.2,0>, <1.5,-0.2,0.4>, <1.5,0.8,0.8>, <1.5,1.8,0> }\n"

enum { TABLE_WIDTH = 64, TABLE_HEIGHT = 48 };

typedef struct {
    const char *name; // of the test program
    // What stands in front of every text, after "#version 3.7; global_settings { assumed_gamma 1
    // }".
    const char *stage;
    const char *const *scenes;
    size_t count;
    double share; // of a scene's pixels that may be off by more than a rounding of 16 bits
} PovrayTable;

// A test program's whole work; returns what its main does. Passes over with a message when there is
// no povray.
int povray_table_run(const PovrayTable *table);

#endif
