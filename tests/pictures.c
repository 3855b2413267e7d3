// SPDX-License-Identifier: MIT
#include "pictures.h"

#include "base/arena.h"
#include "base/file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[2200], project[2048];

static void remove_folder(void) {
    char command[4200];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    if (system(command) != 0)
        fprintf(stderr, "cannot remove %s\n", folder);
}

const char *scratch_folder(void) {
    if (!folder[0]) {
        if (!getcwd(project, sizeof project))
            abort();
        snprintf(folder, sizeof folder, "%s/build/test/scratch.XXXXXX", project);
        if (!mkdtemp(folder))
            abort();
        atexit(remove_folder);
    }
    return folder;
}

int run_command(const char **log, const char *format, ...) {
    static char *text;
    char command[8192], whole[12800];
    va_list args;
    va_start(args, format);
    vsnprintf(command, sizeof command, format, args);
    va_end(args);
    snprintf(whole, sizeof whole, "{ %s\n} >'%s/log' 2>&1 </dev/null", command, scratch_folder());
    int status = system(whole);
    if (log) {
        free(text);
        text = calloc(1, 65536);
        char path[4200];
        snprintf(path, sizeof path, "%s/log", scratch_folder());
        FILE *in = fopen(path, "r");
        if (!text || !in)
            abort();
        text[fread(text, 1, 65535, in)] = '\0';
        fclose(in);
        *log = text;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static const char *render(const char *program, const char *name, const char *scene,
                          const char *switches) {
    static char paths[16][4400];
    static int turn;
    char *out = paths[turn++ % 16];
    snprintf(out, sizeof paths[0], "%s/%s.png", scratch_folder(), name);
    char directory[4400];
    snprintf(directory, sizeof directory, "%s%s%s", scene[0] == '/' ? "" : project,
             scene[0] == '/' ? "" : "/", scene);
    const char *file = file_name(directory), *log;
    int status = run_command(&log, "cd '%.*s' && %s '+I%s' '+O%s' %s", (int)(file - directory),
                             directory, program, file, out, switches);
    if (status != 0)
        fail_msg("%s of %s ended with %d:\n%s", program, scene, status, log);
    return out;
}

const char *render_with_povray(const char *name, const char *scene, const char *switches) {
    scratch_folder();
    char all[2048];
    snprintf(all, sizeof all, "-D %s", switches);
    return render("povray", name, scene, all);
}

const char *render_with_qirender(const char *name, const char *scene, const char *switches) {
    scratch_folder();
    char program[2200];
    snprintf(program, sizeof program, "'%s/build/qirender'", project);
    return render(program, name, scene, switches);
}

double percent_over(const char *picture_a, const char *picture_b, double limit) {
    Arena *arena = arena_create();
    Image *a = image_read(arena, picture_a), *b = image_read(arena, picture_b);
    ImageDifference d = image_compare(a, b, limit, limit);
    double percent = 100.0 * (double)d.failed / ((double)a->width * a->height);
    arena_destroy(arena);
    return percent;
}
