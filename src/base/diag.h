// SPDX-License-Identifier: MIT
// Three kinds of trouble, three tools: wrong input is die_at() or warn_at(), our own mistakes are
// assert(), a machine that is out of memory or disk is die(). die* jumps to the innermost
// diag_catch(); without one it prints the message and exits with status 1.
#ifndef BASE_DIAG_H
#define BASE_DIAG_H

#include <stdbool.h>
#include <stddef.h>

// A place in a source text. text is the whole text (NUL-terminated, for the caret line) and may be
// NULL, then only the name and the numbers are printed. line and column count from 1.
typedef struct Loc {
    const char *file; // as shown to the user; NULL: no place
    const char *text;
    int line, column;
    const struct Loc *from; // where the include or the macro call stands that led here, or NULL
    const char *what;       // with from: "included" or "in macro NAME"
} Loc;

_Noreturn void die(const char *format, ...) __attribute__((format(printf, 1, 2)));
_Noreturn void die_at(const Loc *loc, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Printed at once on stderr as "file:line:col: warning: ...", with the line and a caret; counted.
// The same words of the same place are printed once (counted each time). After diag_strict(true) a
// warning is an error.
void warn_at(const Loc *loc, const char *format, ...) __attribute__((format(printf, 2, 3)));
// Printed as often as it is called.
void warn_each_at(const Loc *loc, const char *format, ...) __attribute__((format(printf, 2, 3)));
void warn(const char *format, ...) __attribute__((format(printf, 1, 2)));
// A remark that is no warning ("file:line:col: note: ..."); shown only when verbose.
void note_at(const Loc *loc, const char *format, ...) __attribute__((format(printf, 2, 3)));

void diag_strict(bool on);
void diag_verbose(bool on);
void diag_quiet(bool on); // no warnings are printed (still counted); for tests
// The prefix of messages without a place: "qirender: error: ..."
void diag_program(const char *name);
size_t diag_warning_count(void);

// Runs body(arg). True if it returned; false if it died, and then *message (in the heap, to be
// freed by free(), whole text as it would have been printed, without the trailing newline) says
// why. Locals of the caller that body changes through arg are safe; register copies are not.
bool diag_catch(void (*body)(void *), void *arg, char **message);
// Dies again with a message that diag_catch gave, after the catcher has cleaned up.
_Noreturn void diag_rethrow(char *message);

#endif
