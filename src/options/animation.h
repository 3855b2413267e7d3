// SPDX-License-Identifier: MIT
// Which frames an animation has, and what each of them is told (facts: sdl 5.2).
#ifndef OPTIONS_ANIMATION_H
#define OPTIONS_ANIMATION_H

#include "options/options.h"

// The frames first, first + step ... up to last are rendered. frame holds what all share.
typedef struct {
    int first, last, step;
    OptionFrame frame;
} Animation;

// False: a single picture is meant; *animation is not touched. It is an animation once a first or a
// final frame is given, unless both are 0 or both are 1.
bool animation_of(const RenderOptions *options, Animation *animation);

// Sets the frame and its clock in options. The clock is in single precision, as POV-Ray has it; it
// is not a number when the first frame is the final one (POV-Ray divides by their distance).
void animation_set_frame(const Animation *animation, int number, RenderOptions *options);

#endif
