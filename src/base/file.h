// SPDX-License-Identifier: MIT
// Whole files in, whole files out. An output appears under its name only when it is complete.
#ifndef BASE_FILE_H
#define BASE_FILE_H

#include "base/arena.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// The whole file, NUL-terminated (the NUL is not counted in *size). On failure NULL, and *why is a
// static text ("no such file", "is a directory", ...). size and why may be NULL.
char *file_read(Arena *arena, const char *path, size_t *size, const char **why);
bool file_exists(const char *path);      // a readable thing that is no directory
const char *file_name(const char *path); // the part behind the last slash, within path
// The part up to and with the last slash; "./" where there is none.
const char *file_folder(Arena *arena, const char *path);

// An output being written beside its final place. file_begin dies if the folder cannot be written.
// file_commit flushes, checks every earlier write, renames; dies (disk full, ...) and leaves no
// file on failure. file_abandon removes what was written; it also runs at exit and on
// SIGINT/SIGTERM.
typedef struct OutputFile OutputFile;
OutputFile *file_begin(const char *path);
FILE *file_stream(OutputFile *out);
const char *file_temporary_path(const OutputFile *out); // for libraries that open by name
void file_commit(OutputFile *out);
void file_abandon(OutputFile *out);

#endif
