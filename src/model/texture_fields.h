// SPDX-License-Identifier: MIT
// Inside the room: the tables of texture_fields.c that scene_fields.c lists.
#ifndef MODEL_TEXTURE_FIELDS_H
#define MODEL_TEXTURE_FIELDS_H

#include "model/scene_fields.h"

extern const Record DENSITY_RECORD, PICTURE_RECORD, PIGMENT_RECORD, NORMAL_RECORD, TEXTURE_RECORD,
    TURBULENCE_RECORD;

#endif
