// SPDX-License-Identifier: MIT
// For tests: POV-Ray's own picture of a scene.
#ifndef TESTS_REFERENCE_H
#define TESTS_REFERENCE_H

#include "image/image.h"

// Is povray there to be asked?
bool reference_available(void);
// Renders the scene's text with those switches to PNG (no display, no other options than POV-Ray's
// own defaults) and reads the picture. Dies with POV-Ray's messages if it fails.
Image *reference_render(Arena *arena, const char *scene, const char *switches);
// The same in two steps, so that several can run at once: most of povray's time is waiting.
typedef struct Reference Reference;
Reference *reference_begin(Arena *arena, const char *scene, const char *switches);
Image *reference_end(Reference *reference);
// The two pictures' values as whole numbers of 16 bits: how many differ, and where the first does.
size_t reference_mismatches(const Image *a, const Image *b, char *first, size_t room);

#endif
