// SPDX-License-Identifier: MIT
// Regular files are mapped, so that pages come and go as they are read; anything else (a pipe) is
// read whole. Numbers of up to 19 digits with small exponents, which is nearly all of them, are
// converted exactly by one multiplication or division; strtod has the rest.
#include "bench/ray_file.h"

#include "base/diag.h"
#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { POINTS = 16, LONGEST_NUMBER = 1100 }; // a double has 767 digits at most

struct RayFile {
    const char *path;
    const char *at, *end;   // what is still to be read
    const char *line_start; // of the line that holds `at`
    int line;
    void *map; // NULL: the text lies in the arena
    size_t map_size;
    uint32_t patch_count;
    Vec3 *points;
    uint64_t ray_count, ray_next;
};

// ---- Words and numbers

static Loc place_of(const RayFile *f, const char *at) {
    return (Loc){.file = f->path, .line = f->line, .column = (int)(at - f->line_start) + 1};
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

static void skip_blanks(RayFile *f) {
    while (f->at < f->end && is_blank(*f->at))
        f->at++;
}

static void skip_empty_lines(RayFile *f) {
    for (skip_blanks(f); f->at < f->end && *f->at == '\n'; skip_blanks(f)) {
        f->line_start = ++f->at;
        f->line++;
    }
}

// Up to the next blank or the line's end.
static size_t word_length(const RayFile *f) {
    const char *at = f->at;
    while (at < f->end && !is_blank(*at) && *at != '\n')
        at++;
    return (size_t)(at - f->at);
}

// What stands where something else should: a word, shortened, or the end.
static const char *found_here(const RayFile *f, char text[64]) {
    size_t length = word_length(f);
    if (f->at >= f->end)
        return "the end of the file";
    if (length == 0)
        return "the end of the line";
    size_t shown = length < 40 ? length : 40;
    text[0] = '\'';
    for (size_t i = 0; i < shown; i++)
        text[i + 1] = (unsigned char)f->at[i] < 32 || f->at[i] == 127 ? '?' : f->at[i];
    strcpy(text + shown + 1, shown < length ? "…'" : "'");
    return text;
}

_Noreturn static void die_here(const RayFile *f, const char *expected) {
    char text[64];
    Loc loc = place_of(f, f->at);
    die_at(&loc, "expected %s, found %s", expected, found_here(f, text));
}

static void read_line_end(RayFile *f) {
    skip_blanks(f);
    if (f->at < f->end && *f->at != '\n')
        die_here(f, "the end of the line");
}

// What the short cut does not do.
static double read_any_number(RayFile *f, const char *what) {
    char text[LONGEST_NUMBER];
    size_t length = word_length(f);
    if (length == 0 || length >= sizeof text)
        die_here(f, what);
    memcpy(text, f->at, length);
    text[length] = '\0';
    char *stop;
    double value = strtod(text, &stop);
    if (*stop)
        die_here(f, what);
    f->at += length;
    return value;
}

static const double powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                       1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                       1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Digits that make a number up to 2^53, and powers of ten up to 22, are doubles exactly: their
// product or quotient is rounded once, as strtod does.
static double read_number(RayFile *f, const char *what) {
    skip_blanks(f);
    const char *at = f->at, *end = f->end;
    bool negative = at < end && *at == '-';
    at += at < end && (*at == '-' || *at == '+');
    uint64_t digits = 0;
    int count = 0, exponent = 0;
    for (; at < end && *at >= '0' && *at <= '9'; at++, count++)
        digits = digits * 10 + (uint64_t)(*at - '0');
    if (at < end && *at == '.') {
        const char *point = ++at;
        for (; at < end && *at >= '0' && *at <= '9'; at++, count++)
            digits = digits * 10 + (uint64_t)(*at - '0');
        exponent = -(int)(at - point);
    }
    if (count == 0 || count > 19) // 10^19 - 1 fits into 64 bits
        return read_any_number(f, what);
    if (at < end && (*at == 'e' || *at == 'E')) {
        bool down = ++at < end && *at == '-';
        at += at < end && (*at == '-' || *at == '+');
        int power = 0, length = 0;
        for (; at < end && *at >= '0' && *at <= '9' && length < 4; at++, length++)
            power = power * 10 + (*at - '0');
        if (length == 0)
            return read_any_number(f, what);
        exponent += down ? -power : power;
    }
    bool whole_word = at == end || is_blank(*at) || *at == '\n';
    if (!whole_word || digits > (UINT64_C(1) << 53) || exponent < -22 || exponent > 22)
        return read_any_number(f, what);
    f->at = at;
    double value = (double)digits;
    value = exponent < 0 ? value / powers_of_ten[-exponent] : value * powers_of_ten[exponent];
    return negative ? -value : value;
}

// word, then a count on the same line.
static uint64_t read_count(RayFile *f, const char *word, uint64_t limit) {
    char expected[64];
    snprintf(expected, sizeof expected, "'%s' and their number", word);
    skip_empty_lines(f);
    size_t length = word_length(f);
    if (length != strlen(word) || memcmp(f->at, word, length) != 0)
        die_here(f, expected);
    f->at += length;
    skip_blanks(f);
    const char *start = f->at;
    uint64_t count = 0;
    for (; f->at < f->end && *f->at >= '0' && *f->at <= '9' && f->at - start < 18; f->at++)
        count = count * 10 + (uint64_t)(*f->at - '0');
    bool whole_word = f->at == f->end || is_blank(*f->at) || *f->at == '\n';
    if (f->at == start || !whole_word) {
        f->at = start;
        snprintf(expected, sizeof expected, "the number of %s", word);
        die_here(f, expected);
    }
    if (count > limit) {
        Loc loc = place_of(f, start);
        die_at(&loc, "%llu %s: the file is too short for them", (unsigned long long)count, word);
    }
    read_line_end(f);
    return count;
}

static Vec3 read_vec(RayFile *f, const char *what) {
    double x = read_number(f, what), y = read_number(f, what);
    return vec3(x, y, read_number(f, what));
}

// ---- The file

// The text of a file, mapped if it can be.
static void take_text(RayFile *f, Arena *arena) {
    const char *why = NULL;
    int fd = open(f->path, O_RDONLY | O_CLOEXEC);
    struct stat st;
    if (fd >= 0 && fstat(fd, &st) == 0 && S_ISREG(st.st_mode) && st.st_size > 0) {
        void *map = mmap(NULL, (size_t)st.st_size, PROT_READ, MAP_PRIVATE, fd, 0);
        if (map != MAP_FAILED) {
            posix_madvise(map, (size_t)st.st_size, POSIX_MADV_SEQUENTIAL);
            f->map = map;
            f->map_size = (size_t)st.st_size;
            f->at = map;
            f->end = f->at + f->map_size;
        }
    }
    if (fd >= 0)
        close(fd);
    if (!f->map) {
        size_t size = 0;
        f->at = file_read(arena, f->path, &size, &why);
        if (!f->at)
            die("cannot read '%s': %s", f->path, why);
        f->end = f->at + size;
    }
    f->line_start = f->at;
    f->line = 1;
}

RayFile *ray_file_open(Arena *arena, const char *path) {
    RayFile *f = ARENA_NEW(arena, RayFile);
    f->path = path;
    take_text(f, arena);
    // A point takes six bytes at least, a ray twelve.
    uint64_t size = (uint64_t)(f->end - f->at);
    uint64_t most =
        size / (6 * POINTS) < UINT32_MAX / POINTS ? size / (6 * POINTS) + 1 : UINT32_MAX / POINTS;
    f->patch_count = (uint32_t)read_count(f, "patches", most);
    f->points = ARENA_ARRAY(arena, Vec3, (size_t)f->patch_count * POINTS);
    for (size_t i = 0; i < (size_t)f->patch_count * POINTS; i++) {
        skip_empty_lines(f);
        const char *start = f->at;
        f->points[i] = read_vec(f, "x, y and z of a patch's point");
        if (!vec_is_finite(f->points[i])) {
            Loc loc = place_of(f, start);
            die_at(&loc, "point %zu of patch %zu is not finite", i % POINTS, i / POINTS);
        }
        read_line_end(f);
    }
    f->ray_count = read_count(f, "rays", size / 12 + 1);
    return f;
}

void ray_file_close(RayFile *f) {
    if (f->map)
        munmap(f->map, f->map_size);
    f->map = NULL;
    f->at = f->end = NULL;
}

uint32_t ray_file_patch_count(const RayFile *f) { return f->patch_count; }
const Vec3 *ray_file_points(const RayFile *f) { return f->points; }
uint64_t ray_file_ray_count(const RayFile *f) { return f->ray_count; }

size_t ray_file_next(RayFile *f, Ray *rays, size_t capacity) {
    static const char what[] = "ox oy oz dx dy dz of a ray";
    size_t count = 0;
    for (; count < capacity && f->ray_next < f->ray_count; count++, f->ray_next++) {
        skip_empty_lines(f);
        rays[count].org = read_vec(f, what);
        rays[count].dir = read_vec(f, what);
        read_line_end(f);
    }
    if (f->ray_next == f->ray_count) {
        skip_empty_lines(f);
        if (f->at < f->end)
            die_here(f, "the end of the file after the last ray");
    }
    return count;
}
