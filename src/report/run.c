// SPDX-License-Identifier: MIT
#include "report/run.h"

#include "base/diag.h"
#include "base/file.h"
#include "base/usage.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

void run_add(Command *command, const char *word) {
    if (command->count + 1 >= RUN_MOST_WORDS)
        die("more than %d words on a command line", RUN_MOST_WORDS - 1);
    command->words[command->count++] = word;
}

const char *run_text(Arena *arena, const Command *command) {
    const char *plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-=_./:,@%";
    char *text = arena_strdup(arena, "");
    for (size_t i = 0; i < command->count; i++) {
        const char *word = command->words[i], *gap = i ? " " : "";
        if (*word && !word[strspn(word, plain)]) {
            text = arena_printf(arena, "%s%s%s", text, gap, word);
            continue;
        }
        text = arena_printf(arena, "%s%s'", text, gap);
        for (; *word; word++)
            text = arena_printf(arena, *word == '\'' ? "%s'\\'%c'" : "%s%c", text, *word);
        text = arena_printf(arena, "%s'", text);
    }
    return text;
}

// The end of a log: its last lines, which say what went wrong.
static const char *tail(const char *text) {
    enum { LINES = 12 };
    const char *at = text + strlen(text);
    for (int lines = 0; at > text && lines <= LINES; at--)
        lines += at[-1] == '\n';
    return at > text ? at + 1 : text;
}

static double user_seconds(const struct rusage *use) {
    return (double)use->ru_utime.tv_sec + 1e-6 * (double)use->ru_utime.tv_usec;
}

volatile sig_atomic_t run_interrupted;
static volatile pid_t running;

static void on_signal(int number) {
    (void)number;
    if (run_interrupted)
        _exit(2);
    run_interrupted = 1;
    if (running > 0)
        kill(running, SIGTERM);
}

static bool catching;

void run_catch_signals(void) {
    catching = true;
    signal(SIGINT, on_signal);
    signal(SIGTERM, on_signal);
}

void run_end_with_us(pid_t child) {
    running = child;
    if (child > 0 && run_interrupted)
        kill(child, SIGTERM);
}

// The child: both outputs to the file, then the program.
_Noreturn static void become(const Command *command, const char *log) {
    int file = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666), none = open("/dev/null", O_RDONLY);
    if (file >= 0 && none >= 0 && dup2(none, 0) == 0 && dup2(file, 1) == 1 && dup2(file, 2) == 2)
        execvp(command->words[0], (char *const *)(uintptr_t)command->words);
    _exit(127);
}

Run run_command_line(Command *command, const char *name, const char *log, Arena *arena) {
    command->words[command->count] = NULL;
    if (catching) // a file that was written in between (base/file.h) has taken the signals
        run_catch_signals();
    Run run = {.command = run_text(arena, command)};
    double start = usage_clock();
    fflush(NULL);
    // No signal may come between the fork and the moment when both know what to do with it.
    sigset_t all, before;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    pid_t child = fork();
    if (child < 0)
        die("cannot start %s: %s", command->words[0], strerror(errno));
    if (child == 0) {
        signal(SIGINT, SIG_DFL);
        signal(SIGTERM, SIG_DFL);
        sigprocmask(SIG_SETMASK, &before, NULL);
        become(command, log);
    }
    running = child;
    sigprocmask(SIG_SETMASK, &before, NULL);
    if (run_interrupted)
        kill(child, SIGTERM);
    int status;
    struct rusage use;
    while (wait4(child, &status, 0, &use) < 0)
        if (errno != EINTR)
            die("cannot wait for %s: %s", command->words[0], strerror(errno));
    running = 0;
    run.elapsed = usage_clock() - start;
    run.seconds = user_seconds(&use);
    run.megabytes = (double)use.ru_maxrss / 1024.0;
    const char *said = file_read(arena, log, NULL, NULL);
    run.log = said ? said : "";
    if (run_interrupted)
        die("interrupted");
    if (WIFSIGNALED(status) || (WIFEXITED(status) && WEXITSTATUS(status) == 2))
        die("%s was interrupted or misused:\n%s\n%s", name, run.command, tail(run.log));
    if (WEXITSTATUS(status) == 127)
        die("%s could not be run; is it installed?\n%s", name, run.command);
    if (status != 0)
        die("%s failed:\n%s\n%s", name, run.command, tail(run.log));
    return run;
}

const char *run_find_qirender(Arena *arena) {
    char own[4096];
    ssize_t length = readlink("/proc/self/exe", own, sizeof own - 1);
    if (length < 0)
        die("cannot find the folder of this program: %s", strerror(errno));
    own[length] = '\0';
    const char *path = arena_printf(arena, "%sqirender", file_folder(arena, own));
    if (access(path, X_OK) != 0)
        die("cannot run '%s': %s", path, strerror(errno));
    return path;
}

const char *run_machine(Arena *arena) {
    const char *text = file_read(arena, "/proc/cpuinfo", NULL, NULL);
    const char *model = text ? strstr(text, "model name") : NULL;
    const char *colon = model ? strchr(model, ':') : NULL;
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    if (!colon)
        return arena_printf(arena, "%ld cores", cores);
    return arena_printf(arena, "%.*s, %ld core%s", (int)strcspn(colon + 2, "\n"), colon + 2, cores,
                        cores == 1 ? "" : "s");
}
