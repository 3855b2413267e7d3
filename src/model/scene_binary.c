// SPDX-License-Identifier: MIT
#include "model/scene_binary.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

_Static_assert(sizeof(double) == 8, "the side file holds IEEE doubles");

char *binary_path(Arena *arena, const char *scene_path) {
    size_t length = strlen(scene_path);
    if (length > 5 && strcmp(scene_path + length - 5, ".json") == 0)
        length -= 5;
    return arena_printf(arena, "%.*s.bin", (int)length, scene_path);
}

#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__

void binary_write(FILE *out, const double *values, size_t count) {
    fwrite(values, sizeof *values, count, out);
}

void binary_read(double *out, const unsigned char *bytes, size_t count) {
    memcpy(out, bytes, count * sizeof *out);
}

#else

void binary_write(FILE *out, const double *values, size_t count) {
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        bits = __builtin_bswap64(bits);
        fwrite(&bits, sizeof bits, 1, out);
    }
}

void binary_read(double *out, const unsigned char *bytes, size_t count) {
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, bytes + i * sizeof bits, sizeof bits);
        bits = __builtin_bswap64(bits);
        memcpy(&out[i], &bits, sizeof bits);
    }
}

#endif

bool binary_map(const char *path, Mapping *mapping, const char **why) {
    struct stat st;
    *mapping = (Mapping){NULL, 0};
    // O_NONBLOCK: a named pipe is refused below instead of waiting for its writer.
    int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0 || fstat(fd, &st) != 0) {
        *why = strerror(errno);
    } else if (!S_ISREG(st.st_mode)) {
        *why = "not a regular file";
    } else {
        *why = NULL;
        mapping->size = (size_t)st.st_size;
        // mmap refuses a length of 0. All of it will be read once, in order.
        if (mapping->size > 0) {
            void *bytes = mmap(NULL, mapping->size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, fd, 0);
            if (bytes == MAP_FAILED)
                *why = strerror(errno);
            else
                mapping->bytes = bytes;
        }
    }
    if (fd >= 0)
        close(fd);
    return !*why;
}

void binary_unmap(Mapping *mapping) {
    if (mapping->bytes)
        munmap((void *)(uintptr_t)mapping->bytes, mapping->size);
    *mapping = (Mapping){NULL, 0};
}
