// SPDX-License-Identifier: MIT
// Clips along both parameters in turn until what is left is smaller than the tolerance as the ray
// sees it; where neither clip takes a fifth away there may be several roots, and the part is halved
// (Nishita). Roots of one part are found one after the other; the walk keeps the nearest.
#include "patch/clipping.h"

#include "patch/clip.h"

// Sub-patches are cut until they are flat to this share of their size: of 0.03, 0.05, 0.1, 0.2 and
// 0.4 the fastest on the teapot (`qibench speed methods`), by 5 to 15 %.
static const double SHARE = 0.1;

enum {
    STACK = 128, // halvings of both parameters down to rounding, and some
    // Clips of one sub-patch: a ray in the surface meets all of it. Of a ray: then its other
    // sub-patches get few.
    MAX_STEPS = 4096,
    MAX_WORK = 4096,
    FEW_STEPS = 32
};

struct Clipping {
    Refined refined;
};

Clipping *clipping_create(Arena *arena, const PatchDef *defs, size_t count) {
    Clipping *clipping = ARENA_NEW(arena, Clipping);
    refine_build(arena, defs, count, SHARE, &clipping->refined);
    return clipping;
}

static void report_middle(RefineWalk *walk, const SubPatch *sub, BezierRect r) {
    refine_report(walk, sub, 0.5 * (r.u0 + r.u1), 0.5 * (r.v0 + r.v1));
}

// Clips until one root is left, or none, or several. True: what is left must be halved.
static bool clip_down(RefineWalk *walk, const SubPatch *sub, ClipNet *net, int *steps) {
    const RefineRay *ray = &walk->ray;
    int idle = 0; // clips in a row that took too little
    while (idle < 2) {
        double size, kept;
        if (!clip_meets(net, ray->error, &size))
            return false;
        // The middle of a box that holds the ray is within half of its diagonal of it.
        if (size <= ray->tolerance * sub->least_weight) {
            report_middle(walk, sub, net->rect);
            return false;
        }
        walk->query->stats.steps++;
        walk->work++;
        if (++*steps > (walk->work > MAX_WORK ? FEW_STEPS : MAX_STEPS) ||
            !clip_step(net, ray->error, &kept))
            return false;
        idle = kept > CLIP_ENOUGH ? idle + 1 : 0;
    }
    // Nothing left to halve: rounding decides.
    if (net->rect.u1 - net->rect.u0 < 0x1p-49 && net->rect.v1 - net->rect.v0 < 0x1p-49) {
        report_middle(walk, sub, net->rect);
        return false;
    }
    return true;
}

static void search(RefineWalk *walk, const SubPatch *sub) {
    if (walk->work > 4 * MAX_WORK && walk->query->found)
        return;
    ClipNet whole, net;
    int steps = 0;
    clip_project(&walk->ray, sub, &net);
    double size;
    if (!clip_meets(&net, walk->ray.error, &size))
        return;
    if (!clip_down(walk, sub, &net, &steps))
        return;
    BezierRect stack[STACK];
    int top = 2;
    clip_project(&walk->ray, sub, &whole);
    clip_halve(&net, &stack[0], &stack[1]);
    while (top > 0 && !query_done(walk->query)) {
        clip_restrict(&whole, stack[--top], &net);
        if (clip_down(walk, sub, &net, &steps) && top + 2 <= STACK) {
            clip_halve(&net, &stack[top], &stack[top + 1]);
            top += 2;
        }
    }
}

void clipping_query(const Clipping *clipping, Query *query) {
    refine_query(&clipping->refined, query, search);
}
