// SPDX-License-Identifier: MIT
// Inside the room: what the writer and the reader of scene files must agree on besides the tables.
#ifndef MODEL_SCENE_FORMAT_H
#define MODEL_SCENE_FORMAT_H

#define SCENE_FORMAT "qipov-scene"

enum {
    SCENE_VERSION = 1,
    SCENE_MAX_PATCHES_IN_TEXT = 10000, // with more, their points go to the side file
    SCENE_MAX_DEGREE = 16,
};

#endif
