// SPDX-License-Identifier: MIT
// What the text asks about objects and pigments before the scene is complete.
#ifndef CONVERTER_PROBING_H
#define CONVERTER_PROBING_H

#include "converter/nodes.h"
#include "probe/probe.h"

// NULL: it cannot be asked; then *gap says what is not modelled in it (or is NULL: there is nothing
// to meet).
const Probe *probing_object(Converter *cv, const ObjectNode *object, const char **gap);
// *index: of the pigment in the probe's scene.
const Probe *probing_pigment(Converter *cv, const PatternNode *pigment, uint32_t *index,
                             const char **gap);
void probing_end(Converter *cv); // releases all of them

#endif
