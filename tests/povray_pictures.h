// SPDX-License-Identifier: MIT
// POV-Ray's own pictures as truth for tests: the test writes job0.pov, job1.pov, ... into a
// directory of its own, all are rendered at once (a run is mostly waiting), and read back as linear
// 16-bit values.
#ifndef TESTS_POVRAY_PICTURES_H
#define TESTS_POVRAY_PICTURES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    char directory[64];
    int width, height;
    uint16_t *pixels; // of the picture read last
} PovrayPictures;

// Makes the directory; dies if it cannot.
PovrayPictures *povray_create(int width, int height);
void povray_destroy(PovrayPictures *pictures); // with the directory
// Renders job0.pov .. job<count-1>.pov without anti-aliasing. False when there is no povray.
bool povray_render(const PovrayPictures *pictures, size_t count);
// Picture of job<number>.pov: rows from the top, r g b. Valid until the next call; NULL when
// POV-Ray refused the scene (log<number> says why).
const uint16_t *povray_read(PovrayPictures *pictures, size_t number);
// A binary PPM of 16 bits and of that size into pixels. False: it is not there or not like that.
bool povray_read_ppm(const char *path, int width, int height, uint16_t *pixels);

#endif
