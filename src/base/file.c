// SPDX-License-Identifier: MIT
// Outputs are written to "<path>.part<pid>" with the final extension kept (OpenImageIO chooses the
// format by it), and renamed when complete.
#include "base/file.h"

#include "base/diag.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

char *file_read(Arena *arena, const char *path, size_t *size, const char **why) {
    const char *reason = NULL;
    struct stat st;
    char *data = NULL;
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) {
        reason = strerror(errno);
    } else if (fstat(fd, &st) != 0 || S_ISDIR(st.st_mode)) {
        reason = "is a directory";
    } else {
        // Not all files know their size (pipes, /proc): read until the end.
        size_t capacity = st.st_size > 0 ? (size_t)st.st_size + 1 : 65536, used = 0;
        char *buffer = malloc(capacity);
        for (ssize_t got = 1; buffer && got != 0;) {
            if (used + 1 >= capacity) {
                capacity *= 2;
                char *grown = realloc(buffer, capacity);
                if (!grown)
                    free(buffer);
                buffer = grown;
                continue;
            }
            got = read(fd, buffer + used, capacity - used - 1);
            if (got < 0 && errno != EINTR) {
                reason = strerror(errno);
                break;
            }
            used += got > 0 ? (size_t)got : 0;
        }
        if (!buffer) {
            reason = "out of memory";
        } else if (!reason) {
            data = arena_alloc(arena, used + 1);
            memcpy(data, buffer, used);
            if (size)
                *size = used;
        }
        free(buffer);
    }
    if (fd >= 0)
        close(fd);
    if (why)
        *why = reason;
    return data;
}

bool file_exists(const char *path) {
    struct stat st;
    return stat(path, &st) == 0 && !S_ISDIR(st.st_mode) && access(path, R_OK) == 0;
}

struct OutputFile {
    char *path, *temporary;
    FILE *stream;
    struct OutputFile *next;
};

// Outputs that are not yet complete, so that an exit or a signal can remove them.
static OutputFile *unfinished;

static void remove_unfinished(void) {
    for (OutputFile *f = unfinished; f; f = f->next)
        unlink(f->temporary);
}

static void on_signal(int number) {
    remove_unfinished();
    (void)number;
    _exit(2);
}

static void install_cleanup(void) {
    static bool registered;
    if (!registered)
        atexit(remove_unfinished);
    registered = true;
    signal(SIGINT, on_signal);
    signal(SIGTERM, on_signal);
}

static void *must(void *p) {
    if (!p)
        die("out of memory");
    return p;
}

const char *file_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

const char *file_folder(Arena *arena, const char *path) {
    int length = (int)(file_name(path) - path);
    return length ? arena_printf(arena, "%.*s", length, path) : "./";
}

OutputFile *file_begin(const char *path) {
    install_cleanup();
    struct stat st;
    if (stat(path, &st) == 0 && S_ISDIR(st.st_mode))
        die("cannot write '%s': is a directory", path);
    const char *name = file_name(path), *dot = strrchr(name, '.');
    if (!dot || dot == name)
        dot = path + strlen(path);
    OutputFile *out = must(calloc(1, sizeof *out));
    size_t room = strlen(path) + 32;
    out->path = must(strdup(path));
    out->temporary = must(malloc(room));
    snprintf(out->temporary, room, "%.*s.part%ld%s", (int)(dot - path), path, (long)getpid(), dot);
    out->stream = fopen(out->temporary, "wb");
    if (!out->stream) {
        int error = errno;
        free(out->temporary);
        free(out->path);
        free(out);
        die("cannot write '%s': %s", path, strerror(error));
    }
    out->next = unfinished;
    unfinished = out;
    return out;
}

FILE *file_stream(OutputFile *out) { return out->stream; }
const char *file_temporary_path(const OutputFile *out) { return out->temporary; }

static void forget(OutputFile *out) {
    for (OutputFile **link = &unfinished; *link; link = &(*link)->next) {
        if (*link == out) {
            *link = out->next;
            break;
        }
    }
    free(out->temporary);
    free(out->path);
    free(out);
}

void file_commit(OutputFile *out) {
    bool bad = fflush(out->stream) != 0 || ferror(out->stream);
    int error = errno;
    if (fclose(out->stream) != 0 && !bad) {
        bad = true;
        error = errno;
    }
    if (!bad && rename(out->temporary, out->path) != 0) {
        bad = true;
        error = errno;
    }
    if (bad) {
        char path[512];
        snprintf(path, sizeof path, "%s", out->path);
        unlink(out->temporary);
        forget(out);
        die("cannot write '%s': %s", path, strerror(error));
    }
    forget(out);
}

void file_abandon(OutputFile *out) {
    fclose(out->stream);
    unlink(out->temporary);
    forget(out);
}
