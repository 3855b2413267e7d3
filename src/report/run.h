// SPDX-License-Identifier: MIT
// Other programs, run and waited for: povray, and the qirender beside this program.
#ifndef REPORT_RUN_H
#define REPORT_RUN_H

#include "base/arena.h"

#include <signal.h>
#include <stddef.h>
#include <sys/types.h>

enum { RUN_MOST_WORDS = 1024 };

// The words of a command line; run_add dies when there are too many.
typedef struct {
    const char *words[RUN_MOST_WORDS];
    size_t count;
} Command;

void run_add(Command *command, const char *word);
// The words as a shell would have to be given them.
const char *run_text(Arena *arena, const Command *command);

typedef struct {
    const char *command; // as text
    const char *log;     // what it said on both outputs
    double seconds;      // of processor time in user mode
    double elapsed;      // on the wall
    double megabytes;    // of memory, at its peak
} Run;

// Runs the command with both its outputs in the file `log`, and waits. name: what to call it in
// messages. Dies if it cannot be run, fails, or is interrupted.
Run run_command_line(Command *command, const char *name, const char *log, Arena *arena);

// From here on SIGINT and SIGTERM end the program that runs (run_command_line then dies) and set
// run_interrupted; a second one ends this program at once.
extern volatile sig_atomic_t run_interrupted;
void run_catch_signals(void);
// The same for a process that was started otherwise; 0: there is none.
void run_end_with_us(pid_t child);

const char *run_find_qirender(Arena *arena); // its path; dies if it is not there
const char *run_machine(Arena *arena);       // the processor and its cores, for tables of times

#endif
