// SPDX-License-Identifier: MIT
// What this process has used of time and memory.
#ifndef BASE_USAGE_H
#define BASE_USAGE_H

double usage_clock(void);          // seconds of a monotonic clock, from some start
double usage_process(void);        // seconds of processor time, of all threads together
double usage_thread(void);         // seconds of processor time of this thread
double usage_peak_megabytes(void); // the most memory so far

#endif
