// SPDX-License-Identifier: MIT
// Two pictures compared for qicompare: those of a scene, rendered by povray and by the qirender
// beside this program at the same switches, with the reasons why they differ (places.h); or two
// that are there already.
#ifndef REPORT_COMPARE_SCENE_H
#define REPORT_COMPARE_SCENE_H

#include "base/progress.h"
#include "options/options.h"
#include "report/compare_page.h"

// One scene at work. The page, and all it refers to, is in the arena.
typedef struct {
    const RenderOptions *options;
    const char *scene, *folder; // pictures and logs are written to the folder
    ComparePage *page;
    Arena *arena;
    Progress *progress; // counts programs run
} CompareJob;

// The programs that a scene may need.
uint64_t compare_most_programs(const RenderOptions *o);

// Fills the page. Dies if a program fails or is interrupted.
void compare_scene(const CompareJob *job);

// The same of options->pictures; nothing is rendered. Dies if one cannot be read.
void compare_pictures(const RenderOptions *o, ComparePage *page, Arena *arena);

#endif
