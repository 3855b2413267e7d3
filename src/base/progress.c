// SPDX-License-Identifier: MIT
#include "base/progress.h"

#include "base/usage.h"

#include <stdio.h>
#include <unistd.h>

Progress progress_begin(const char *what, uint64_t total, bool enabled) {
    Progress p = {.what = what, .total = total ? total : 1, .started = usage_clock()};
    p.on = enabled && isatty(STDERR_FILENO);
    return p;
}

static void draw(Progress *p, uint64_t done, double now) {
    p->shown = now;
    double share = (double)done / (double)p->total, elapsed = now - p->started;
    fprintf(stderr, "\r%s %5.1f %%", p->what, 100.0 * share);
    if (share > 0)
        fprintf(stderr, ", %.0f s left", elapsed * (1 - share) / share);
    fputs(" \033[K", stderr);
    fflush(stderr);
}

void progress_add(Progress *p, uint64_t amount) {
    uint64_t done = __atomic_add_fetch(&p->done, amount, __ATOMIC_RELAXED);
    if (!p->on)
        return;
#pragma omp critical(progress_line)
    {
        double now = usage_clock();
        if (now - p->shown >= 0.1)
            draw(p, done, now);
    }
}

void progress_say(Progress *p, const char *what) {
    p->what = what;
    if (p->on)
        draw(p, p->done, usage_clock());
}

void progress_end(Progress *p) {
    if (p->on && p->shown > 0)
        fputs("\r\033[K", stderr);
}
