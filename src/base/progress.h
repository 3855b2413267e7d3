// SPDX-License-Identifier: MIT
// A line on stderr that says how far a long work has come and how long it will take; only on a
// terminal, never in a pipe or a file.
#ifndef BASE_PROGRESS_H
#define BASE_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    const char *what;
    uint64_t total, done;  // done is advanced atomically by any thread
    double started, shown; // seconds
    bool on;
} Progress;

// enabled false: silent.
Progress progress_begin(const char *what, uint64_t total, bool enabled);
// Any thread; redraws at most 10 times a second.
void progress_add(Progress *progress, uint64_t amount);
void progress_say(Progress *progress, const char *what); // what is done now; one thread
void progress_end(Progress *progress);                   // wipes the line

#endif
