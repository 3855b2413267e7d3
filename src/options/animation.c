// SPDX-License-Identifier: MIT
// The frames of an animation: clock = KI + (number - KFI) / (KFF - KFI) * (KF - KI), where for a
// cyclic one KFF is one more than was given, and the scene is told so.
#include "options/animation.h"

#include <math.h>

static int at_least(int least, int value) { return value > least ? value : least; }

// A number of a frame, or between 0 and 1 a share of all of them.
static int frame_at(double subset, int frames) {
    double s = (double)(float)subset;
    return s == 0.0 || s >= 1.0 ? (int)s : (int)(float)(frames * s);
}

bool animation_of(const RenderOptions *o, Animation *animation) {
    bool initial_given = o->initial_frame != FRAME_NONE, final_given = o->final_frame != FRAME_NONE;
    int initial = initial_given ? o->initial_frame : 0, final = final_given ? o->final_frame : 0;
    if (initial == final && (initial == 0 || initial == 1))
        return false;

    Animation a = {.step = o->frame_step};
    a.frame.initial = initial_given ? at_least(0, initial) : 1;
    a.frame.final = at_least(a.frame.initial, final_given ? final : 1);
    if (o->cyclic)
        a.frame.final++;
    int frames = a.frame.final - a.frame.initial + 1;
    a.first = a.frame.initial;
    if (o->subset_start >= 0)
        a.first = at_least(a.frame.initial, frame_at(o->subset_start, frames));
    a.last = o->cyclic ? a.frame.final - 1 : a.frame.final;
    if (o->subset_end >= 0)
        a.last = at_least(a.first, frame_at(o->subset_end, frames));
    else
        a.last = at_least(a.first, a.last); // POV-Ray always renders one

    a.frame.initial_clock = (double)(float)o->initial_clock;
    a.frame.final_clock = (double)(float)o->final_clock;
    a.frame.clock_delta = (double)((float)o->final_clock - (float)o->initial_clock) /
                          (double)(a.frame.final - a.frame.initial);
    a.frame.digits = 1;
    for (int rest = a.frame.final; rest >= 10; rest /= 10)
        a.frame.digits++;
    *animation = a;
    return true;
}

void animation_set_frame(const Animation *animation, int number, RenderOptions *options) {
    const OptionFrame *f = &animation->frame;
    options->frame = *f;
    options->frame.number = number;
    options->clock =
        (double)(float)(f->clock_delta * (double)(number - f->initial) + f->initial_clock);
    options->clock_given = true;
}
