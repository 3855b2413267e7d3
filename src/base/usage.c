// SPDX-License-Identifier: MIT
#include "base/usage.h"

#include <sys/resource.h>
#include <time.h>

static double seconds(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double usage_clock(void) { return seconds(CLOCK_MONOTONIC); }
double usage_process(void) { return seconds(CLOCK_PROCESS_CPUTIME_ID); }
double usage_thread(void) { return seconds(CLOCK_THREAD_CPUTIME_ID); }

double usage_peak_megabytes(void) {
    struct rusage use;
    getrusage(RUSAGE_SELF, &use);
    return (double)use.ru_maxrss / 1024.0;
}
