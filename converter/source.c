// SPDX-License-Identifier: MIT
// Finding and reading files. POV-Ray's order first (facts: sdl 1.6): for each candidate name (with
// and without the extensions of that kind) the working directory, then the library paths. What POV-
// Ray does not try comes after that, with a note: the folders of the files being read, and names
// that differ only in the case of their letters.
#include "converter/language.h"

#include "base/file.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

// ORDER FileKind
static const char *const extensions[][16] = {
    {".pov", ".POV", NULL}, {".inc", ".INC", NULL}, {NULL}, // image.c knows them
    {".ttf", ".TTF", NULL}, {".df3", ".DF3", NULL}, {NULL},
};

enum { MAX_NAMES = 18 };

// The names to try, in order: an own standard extension is tried first, else last.
static int candidate_names(Converter *cv, const char *name, FileKind kind, const char **out) {
    const char *dot = strrchr(file_name(name), '.');
    int count = 0;
    bool standard = false;
    for (int i = 0; dot && extensions[kind][i]; i++)
        standard = standard || strcasecmp(dot, extensions[kind][i]) == 0;
    if (standard)
        out[count++] = name;
    for (int i = 0; extensions[kind][i]; i++)
        out[count++] = arena_printf(cv->arena, "%s%s", name, extensions[kind][i]);
    if (!standard)
        out[count++] = name;
    return count;
}

static void add_library(Converter *cv, const char *path) {
    struct stat st;
    if (!*path || stat(path, &st) != 0 || !S_ISDIR(st.st_mode))
        return;
    for (size_t i = 0; i < cv->language->library.count; i++) {
        if (strcmp(cv->language->library.items[i], path) == 0)
            return;
    }
    list_push(cv, &cv->language->library, path);
}

static void add_given(Converter *cv) {
    for (size_t i = 0; i < cv->options->library_path_count; i++)
        add_library(cv, cv->options->library_paths[i]);
    const char *env = getenv("POVINC");
    if (env)
        add_library(cv, arena_strdup(cv->arena, env));
}

// The folders of povray.ini, those of the command line, POVINC: POV-Ray's order. Without a
// povray.ini what the distribution's says comes first; with another one it comes last.
static void find_library(Converter *cv) {
    static const char *const standard[] = {
        "/usr/share/povray-3.7",
        "/usr/share/povray-3.7/ini",
        "/usr/share/povray-3.7/include",
        "/usr/local/share/povray-3.7",
        "/usr/local/share/povray-3.7/include",
    };
    if (cv->options->povray_ini)
        add_given(cv);
    for (size_t i = 0; i < sizeof standard / sizeof *standard; i++)
        add_library(cv, standard[i]);
    add_given(cv);
}

// What a scene names is a regular file: a device would never end, a pipe might never begin.
static bool is_file(const char *path) {
    struct stat st;
    return stat(path, &st) == 0 && S_ISREG(st.st_mode) && access(path, R_OK) == 0;
}

static const char *join(Converter *cv, const char *folder, const char *name) {
    if (!*folder || name[0] == '/')
        return name;
    const char *slash = folder[strlen(folder) - 1] == '/' ? "" : "/";
    return arena_printf(cv->arena, "%s%s%s", folder, slash, name);
}

static const char *folder_of(Converter *cv, const char *path) {
    int length = (int)(file_name(path) - path);
    return length ? arena_printf(cv->arena, "%.*s", length - 1, path) : "";
}

// The entry of the folder that equals name but for the case of its letters, or NULL. Only the last
// part of the name may differ.
static const char *find_other_case(Converter *cv, const char *folder, const char *name) {
    const char *path = join(cv, folder, name), *where = folder_of(cv, path);
    const char *base = file_name(path);
    bool in_folder = base > path;
    const char *found = NULL;
    DIR *dir = opendir(*where ? where : in_folder ? "/" : ".");
    if (!dir)
        return NULL;
    for (struct dirent *e; !found && (e = readdir(dir));) {
        if (strcasecmp(e->d_name, base) == 0) {
            const char *entry =
                arena_printf(cv->arena, "%s%s%s", where, in_folder ? "/" : "", e->d_name);
            found = is_file(entry) ? entry : NULL;
        }
    }
    closedir(dir);
    return found;
}

static void note_found(Converter *cv, const char *path, const char *how) {
    if (!cv->language->last)
        return;
    Loc loc = token_loc(cv, cv->language->last);
    note_at(&loc, "found as '%s': %s, which POV-Ray does not try", path, how);
}

// Beyond POV-Ray: beside the files that are being read, innermost first.
static const char *find_beside(Converter *cv, const char *const *names, int count) {
    for (const Frame *f = cv->frame; f; f = f->outer) {
        const Source *source = f->source ? f->source : f->tokens->source;
        for (int i = 0; i < count; i++) {
            const char *path = join(cv, folder_of(cv, source->name), names[i]);
            if (is_file(path)) {
                note_found(cv, path, "in the folder of the including file");
                return path;
            }
        }
    }
    return NULL;
}

static const char *find_any_case(Converter *cv, const char *const *names, int count) {
    for (int i = 0; i < count; i++) {
        const char *path = find_other_case(cv, "", names[i]);
        for (size_t k = 0; !path && k < cv->language->library.count; k++)
            path = find_other_case(cv, cv->language->library.items[k], names[i]);
        for (const Frame *f = cv->frame; !path && f; f = f->outer) {
            const Source *source = f->source ? f->source : f->tokens->source;
            path = find_other_case(cv, folder_of(cv, source->name), names[i]);
        }
        if (path) {
            note_found(cv, path, "its letters differ in case");
            return path;
        }
    }
    return NULL;
}

const char *source_find(Converter *cv, const char *name, FileKind kind) {
    if (!*name)
        return NULL;
    if (!cv->language->library.count)
        find_library(cv);
    const char *names[MAX_NAMES];
    int count = candidate_names(cv, name, kind, names);
    for (int i = 0; i < count; i++) {
        if (kind == FILE_SCENE ? file_exists(names[i]) : is_file(names[i]))
            return names[i];
        for (size_t k = 0; names[i][0] != '/' && k < cv->language->library.count; k++) {
            const char *path = join(cv, cv->language->library.items[k], names[i]);
            if (is_file(path))
                return path;
        }
    }
    const char *path = find_beside(cv, names, count);
    return path ? path : find_any_case(cv, names, count);
}

static const Source *known_source(const Converter *cv, const char *path) {
    for (size_t i = 0; i < cv->language->sources.count; i++) {
        if (strcmp(cv->language->sources.items[i]->name, path) == 0)
            return cv->language->sources.items[i];
    }
    return NULL;
}

// ORDER FileKind
static const char *const kind_names[] = {"scene file", "include file", "image file",
                                         "font file",  "density file", "file"};

_Noreturn static void die_missing(const char *name, FileKind kind, const Loc *loc) {
    die_at(loc, "Cannot open %s '%s': it is not in the working directory, in a library path (+L)%s",
           kind_names[kind], name, kind == FILE_SCENE ? "" : " or beside the scene");
}

const char *source_require(Converter *cv, const char *name, FileKind kind, const Loc *loc) {
    const Source *written = written_source(cv, name);
    const char *path = written ? written->name : source_find(cv, name, kind);
    if (!path)
        die_missing(name, kind, loc);
    return path;
}

const char *parse_required_file(Converter *cv, FileKind kind) {
    Loc loc = here(cv);
    return source_require(cv, parse_file_name(cv), kind, &loc);
}

// A symbolic link that was copied as a file holds nothing but the name of the file it leads to.
// The path of that, or NULL.
static const char *followed_link(Converter *cv, const char *path, const char *text, size_t size) {
    enum { LONGEST = 255 };
    size_t length = strcspn(text, " \t\r\n\"'#{}();");
    if (size > LONGEST || length == 0 || length + strspn(text + length, "\r\n") != size)
        return NULL;
    const char *name = arena_printf(cv->arena, "%.*s", (int)length, text);
    const char *target = join(cv, folder_of(cv, path), name);
    if (strcmp(target, path) == 0 || !is_file(target))
        return NULL;
    note_found(cv, target, "the file only names it, as a copied symbolic link does");
    return target;
}

const Source *source_create(Converter *cv, const char *name, const char *text, size_t size,
                            FileKind kind) {
    Source *source = ARENA_NEW(cv->arena, Source);
    *source = (Source){.name = name, .text = text, .size = size};
    source->utf8 = kind == FILE_SCENE && size > 0 && (unsigned char)text[0] > 127;
    list_push(cv, &cv->language->sources, source);
    return source;
}

// link: may the file be a copied link? What it leads to is none.
static const Source *open_file(Converter *cv, const char *name, FileKind kind, bool link,
                               const Loc *loc) {
    const Source *written = kind == FILE_SCENE ? NULL : written_source(cv, name);
    if (written)
        return written;
    // A name that exists but is no file gets its own reason.
    struct stat st;
    bool folder = stat(name, &st) == 0 && S_ISDIR(st.st_mode);
    const char *path = source_find(cv, name, kind), *why = folder ? "it is a directory" : NULL;
    const Source *known = path ? known_source(cv, path) : NULL;
    if (known)
        return known;
    char *text = NULL;
    size_t size = 0;
    if (path)
        text = file_read(cv->arena, path, &size, &why);
    if (!text) {
        if (why)
            die_at(loc, "Cannot open %s '%s': %s", kind_names[kind], name, why);
        die_missing(name, kind, loc);
    }
    const char *target = link ? followed_link(cv, path, text, size) : NULL;
    if (target)
        return open_file(cv, target, kind, false, loc);
    return source_create(cv, path, text, size, kind);
}

const Source *source_open(Converter *cv, const char *name, FileKind kind, const Loc *loc) {
    return open_file(cv, name, kind, kind == FILE_INCLUDE, loc);
}
