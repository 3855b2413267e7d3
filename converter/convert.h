// SPDX-License-Identifier: MIT
// The converter's face to the outside: a POV-Ray source becomes a Scene.
#ifndef CONVERTER_CONVERT_H
#define CONVERTER_CONVERT_H

#include "base/arena.h"
#include "base/array.h"
#include "base/diag.h"
#include "model/scene.h"
#include "options/options.h"

#include <stdio.h>

// Reads options->input with options' library paths, declares, clock and sizes (image_width ...).
// Wrong input dies with file:line:col. The scene is valid, and lives in arena.
Scene *convert_scene(const RenderOptions *options, Arena *arena);

// One place at which the scene uses what is not modelled.
typedef struct {
    const char *feature; // the keyword
    const char *text;    // what the warning would have said
    Loc loc;
} Missing;

typedef ARRAY(Missing) MissingList;

// The same, but lists what is not modelled instead of warning of it. The strings are the arena's;
// the list is the caller's to free.
Scene *convert_scene_listing(const RenderOptions *options, Arena *arena, MissingList *missing);

// The same for a scene in memory, called options->input in messages.
Scene *convert_bytes(const RenderOptions *options, Arena *arena, const void *bytes, size_t size,
                     MissingList *missing);

// What the scene of options->input requires and what of it is missing, for people or as JSON.
void requires_print(FILE *out, const RenderOptions *options, const Scene *scene,
                    const MissingList *missing);

#endif
