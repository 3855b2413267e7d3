// SPDX-License-Identifier: MIT
#include "tests/povray_pictures.h"

#include "base/diag.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

PovrayPictures *povray_create(int width, int height) {
    PovrayPictures *pictures = calloc(1, sizeof *pictures);
    if (!pictures)
        die("out of memory");
    pictures->width = width;
    pictures->height = height;
    pictures->pixels = calloc((size_t)(width * height) * 3, sizeof *pictures->pixels);
    strcpy(pictures->directory, "/tmp/qipov_pictures_XXXXXX");
    if (!pictures->pixels || !mkdtemp(pictures->directory))
        die("no memory or no directory for test pictures");
    return pictures;
}

void povray_destroy(PovrayPictures *pictures) {
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", pictures->directory);
    if (system(command) != 0)
        fprintf(stderr, "%s stays behind\n", pictures->directory);
    free(pictures->pixels);
    free(pictures);
}

bool povray_render(const PovrayPictures *pictures, size_t count) {
    char command[512];
    if (system("command -v povray >/dev/null") != 0)
        return false;
    snprintf(
        command, sizeof command,
        "cd %s && rm -f *.ppm && n=0 && while [ $n -lt %zu ]; do povray +Ijob$n.pov "
        "+Ojob$n.ppm +FP16 +W%d +H%d -D -A +WT1 File_Gamma=1.0 >log$n 2>&1 & n=$((n+1)); done; "
        "wait",
        pictures->directory, count, pictures->width, pictures->height);
    return system(command) == 0;
}

// A binary PPM with 16 bits, high byte first.
static bool read_ppm(FILE *file, int want_width, int want_height, uint16_t *pixels) {
    int width = 0, height = 0, max = 0;
    char line[256];
    for (int have = -1; have < 2;) {
        if (!fgets(line, sizeof line, file))
            return false;
        if (line[0] == '#')
            continue;
        if (have == -1  ? strncmp(line, "P6", 2) != 0
            : have == 0 ? sscanf(line, "%d %d", &width, &height) != 2
                        : sscanf(line, "%d", &max) != 1)
            return false;
        have++;
    }
    if (width != want_width || height != want_height || max != 65535)
        return false;
    for (size_t i = 0; i < (size_t)(width * height) * 3; i++) {
        int high = getc(file), low = getc(file);
        if (low == EOF)
            return false;
        pixels[i] = (uint16_t)(high << 8 | low);
    }
    return true;
}

bool povray_read_ppm(const char *path, int width, int height, uint16_t *pixels) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return false;
    bool ok = read_ppm(file, width, height, pixels);
    fclose(file);
    return ok;
}

const uint16_t *povray_read(PovrayPictures *pictures, size_t number) {
    char path[128];
    snprintf(path, sizeof path, "%s/job%zu.ppm", pictures->directory, number);
    bool ok = povray_read_ppm(path, pictures->width, pictures->height, pictures->pixels);
    return ok ? pictures->pixels : NULL;
}
