// SPDX-License-Identifier: MIT
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "debug_output.h"

#include "base/arena.h"
#include "base/diag.h"
#include "base/file.h"
#include "converter/convert.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool debug_has_povray(void) { return access("/usr/bin/povray", X_OK) == 0; }

// The lines of a file that begin with '@', and the mark of a wrong program.
static char *marked_lines(const char *path, const char *mark) {
    Arena *arena = arena_create();
    char *text = file_read(arena, path, NULL, NULL), *out = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&out, &size);
    assert_non_null(stream);
    for (char *line = text; line && *line;) {
        char *end = strchr(line, '\n');
        int length = end ? (int)(end - line) : (int)strlen(line);
        // The sign of a NaN is the compiler's.
        char *minus = *line == '@' ? strstr(line, "-nan") : NULL;
        if (minus && (!end || minus < end))
            fprintf(stream, "%.*s%.*s\n", (int)(minus - line), line,
                    length - (int)(minus - line) - 1, minus + 1);
        else if (*line == '@')
            fprintf(stream, "%.*s\n", length, line);
        line = end ? end + 1 : NULL;
    }
    fputs(mark, stream);
    fclose(stream);
    arena_destroy(arena);
    return out;
}

// A file for what is printed, of this program alone.
static void side_path(char out[64], const char *ending) {
    mkdir("build", 0777);
    mkdir("build/test", 0777);
    snprintf(out, 64, "build/test/debug-%d.%s", (int)getpid(), ending);
}

char *debug_of_povray(const char *path) {
    char out[64], command[2048];
    side_path(out, "povray");
    int folder = (int)(file_name(path) - path);
    snprintf(command, sizeof command,
             "root=$PWD && cd build/test && povray +I$root/%s +L$root/%.*s +W4 +H3 -D -F "
             ">/dev/null 2>$root/%s",
             path, folder, path, out);
    bool right = system(command) == 0;
    if (!right) {
        snprintf(command, sizeof command, "grep -a -A2 'rror' %s >&2", out);
        if (system(command) != 0)
            fprintf(stderr, "povray failed on %s\n", path);
    }
    return marked_lines(out, right ? "" : "!");
}

typedef struct {
    RenderOptions options;
    Arena *arena;
} Job;

static void convert(void *arg) {
    Job *job = arg;
    convert_scene(&job->options, job->arena);
}

char *debug_of_converter(const char *path) {
    char out[64];
    side_path(out, "ours");
    fflush(stderr);
    int terminal = dup(STDERR_FILENO), file = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    assert_true(terminal >= 0 && file >= 0);
    dup2(file, STDERR_FILENO);
    close(file);
    diag_quiet(true);
    Job job = {.options = {.width = 4, .height = 3}, .arena = arena_create()};
    job.options.input = path;
    char *message = NULL, *marked = NULL;
    bool right = diag_catch(convert, &job, &message);
    arena_destroy(job.arena);
    fflush(stderr);
    dup2(terminal, STDERR_FILENO);
    close(terminal);
    char *text = marked_lines(out, right ? "" : "!");
    if (right)
        return text;
    if (asprintf(&marked, "%s%s", text, message) < 0)
        abort();
    free(text);
    free(message);
    return marked;
}

// Prints the line of the program that made the output line `line`.
static void print_origin(const char *path, const char *line) {
    Arena *arena = arena_create();
    char *text = file_read(arena, path, NULL, NULL), key[32];
    snprintf(key, sizeof key, "\"%.*s ", (int)strcspn(line, " \n"), line);
    char *at = text ? strstr(text, key) : NULL;
    while (at && at > text && at[-1] != '\n')
        at--;
    if (at)
        fprintf(stderr, "  made by: %.*s\n", (int)strcspn(at, "\n"), at);
    arena_destroy(arena);
}

void assert_debug_equal(const char *path, bool right) {
    char *want = debug_of_povray(path), *got = debug_of_converter(path);
    const char *a = want, *b = got;
    while (*a && *b) {
        size_t n = strcspn(a, "\n") + 1, m = strcspn(b, "\n") + 1;
        if (n != m || strncmp(a, b, n) != 0)
            break;
        a += n;
        b += m;
    }
    if (strcmp(a, b) != 0 && (right || *a != '!' || *b != '!')) {
        fprintf(stderr, "%s:\n  povray: %.*s\n  we:     %.*s\n", path, (int)strcspn(a, "\n"), a,
                (int)strcspn(b, "\n"), b);
        print_origin(path, *a ? a : b);
        fail();
    }
    if (right && strchr(want, '!'))
        fail_msg("povray refuses %s", path);
    free(want);
    free(got);
}
