// SPDX-License-Identifier: MIT
// After a render: what its tolerance cost and what it bought, measured anew on a sample of its
// camera rays, beside the next coarser and the next finer of the named accuracies.
#ifndef RENDER_EXPLAIN_H
#define RENDER_EXPLAIN_H

#include "render/render.h"

#include <stdio.h>

void explain_print(const Scene *scene, const RenderOptions *options, const RenderStats *stats,
                   FILE *out);

#endif
