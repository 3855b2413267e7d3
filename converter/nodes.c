// SPDX-License-Identifier: MIT
// The start of the statements' state, and the notes that wait until a node is used.
#include "converter/nodes.h"

const Loc *keep_place(Converter *cv, const Token *token) {
    Loc loc = token_loc(cv, token);
    return arena_copy(cv->arena, &loc, sizeof loc);
}

void note_gap(Converter *cv, const Gap **list, const Token *token, const char *text) {
    Gap *gap = ARENA_NEW(cv->arena, Gap);
    *gap = (Gap){.next = *list, .loc = keep_place(cv, token), .text = text};
    *list = gap;
}

double number_within(Converter *cv, const char *what, double low, double high) {
    Loc loc = here(cv);
    double value = parse_float(cv);
    if (!(value >= low && value < high + 1))
        die_at(&loc, "The %s must be in the range from %g to %g, %g is not", what, low, high,
               value);
    return value;
}

void nodes_begin(Converter *cv) {
    Nodes *nodes = ARENA_NEW(cv->arena, Nodes);
    nodes->radiosity.pretrace[0] = 0.08, nodes->radiosity.pretrace[1] = 0.04;
    PatternNode *pigment = ARENA_NEW(cv->arena, PatternNode);
    FinishNode *finish = ARENA_NEW(cv->arena, FinishNode);
    TextureNode *texture = ARENA_NEW(cv->arena, TextureNode);
    *pigment = pattern_node_default();
    *finish = (FinishNode){.finish = finish_default(), .ior = -1, .caustics = -1, .refraction = 1};
    *texture =
        (TextureNode){.pattern = pattern_node_default(), .pigment = pigment, .finish = finish};
    nodes->default_texture = texture;
    nodes->default_camera =
        (CameraNode){.camera = camera_default(), .sky = vec3(0, 1, 0), .look_at = vec3(0, 0, 1)};
    nodes->settings = settings_default();
    cv->nodes = nodes;
}
