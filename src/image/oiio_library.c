// SPDX-License-Identifier: MIT
// Brings in image_oiio.cpp, a shared library beside the programs or in the lib folder next to
// theirs. It is looked for by its whole path: a run path is lost where a sanitizer stands between
// us and dlopen.
#include "image/oiio.h"

#include "base/diag.h"
#include "base/file.h"

#include <dlfcn.h>
#include <limits.h>
#include <pthread.h>
#include <unistd.h>

static void *library; // stays to the end
static const OiioTable *table;
static char problem[PATH_MAX + 256];

static void load(void) {
    static const char *const places[] = {"", "../lib/"};
    char program[PATH_MAX], path[PATH_MAX + 64];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = '\0';
    int folder = (int)(file_name(program) - program);
    for (size_t i = 0; i < sizeof places / sizeof *places && !library; i++) {
        snprintf(path, sizeof path, "%.*s%slibqipov_image.so", folder, program, places[i]);
        library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
        if (!library && (i == 0 || access(path, F_OK) == 0))
            snprintf(problem, sizeof problem, "%s", dlerror());
    }
    table = library ? dlsym(library, OIIO_TABLE_NAME) : NULL;
    if (library && !table)
        snprintf(problem, sizeof problem, "%s is of another version", path);
}

const OiioTable *oiio_library(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, load);
    if (!table)
        die("cannot load OpenImageIO: %s", problem);
    return table;
}
