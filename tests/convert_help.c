// SPDX-License-Identifier: MIT
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "convert_help.h"

#include "base/diag.h"
#include "base/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    RenderOptions options;
    Arena *arena;
    Scene *scene;
} Job;

static void run_job(void *arg) {
    Job *job = arg;
    job->scene = convert_scene(&job->options, job->arena);
}

static Converted convert_path(const char *path, const char *const *libraries) {
    static const char *const standard = "/usr/share/povray-3.7/include";
    const char *paths[8] = {standard};
    size_t count = 1;
    for (; libraries && *libraries && count < 8; libraries++)
        paths[count++] = *libraries;
    Job job = {.arena = arena_create()};
    job.options.input = path;
    job.options.width = 320;
    job.options.height = 240;
    job.options.library_paths = paths;
    job.options.library_path_count = count;
    Converted result = {0};
    size_t before = diag_warning_count();
    if (diag_catch(run_job, &job, &result.message))
        result.scene = job.scene;
    result.warnings = diag_warning_count() - before;
    return result;
}

static const char *temporary_folder(void) {
    static char folder[64];
    if (!folder[0]) {
        strcpy(folder, "/tmp/qipov-test-XXXXXX");
        if (!mkdtemp(folder))
            abort();
        // What the texts name as pictures must be there; nothing of them is read.
        static const char *const files[] = {"a.png", "none.png", "a.df3"};
        for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
            char path[128];
            snprintf(path, sizeof path, "%s/%s", folder, files[i]);
            FILE *out = fopen(path, "w");
            if (!out)
                abort();
            fclose(out);
        }
    }
    return folder;
}

static char *write_text(const char *name, const char *prelude, const char *text) {
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", temporary_folder(), name);
    FILE *out = fopen(path, "w");
    if (!out)
        abort();
    fputs(prelude, out);
    fputs(text, out);
    fclose(out);
    return path;
}

static const char PRELUDE[] = "#version 3.7; global_settings { assumed_gamma 1 }\n";

Converted convert_raw(const char *text) {
    diag_quiet(true);
    return convert_path(write_text("scene.pov", "", text), NULL);
}

Converted convert_text(const char *text) {
    diag_quiet(true);
    return convert_path(write_text("scene.pov", PRELUDE, text), NULL);
}

Converted convert_file(const char *path, const char *const *libraries) {
    const char *paths[7] = {0};
    size_t count = 0;
    char *folder = strdup(path), *slash = strrchr(folder, '/');
    if (slash) {
        *slash = '\0';
        paths[count++] = folder;
    }
    for (; libraries && *libraries && count < 6; libraries++)
        paths[count++] = *libraries;
    diag_quiet(true);
    return convert_path(path, paths);
}

const char *first_warning(const char *text) {
    diag_strict(true);
    Converted result = convert_text(text);
    diag_strict(false);
    return result.message ? result.message : "";
}

char *povray_output(const char *text) {
    if (access("/usr/bin/povray", X_OK) != 0)
        return NULL;
    const char *folder = temporary_folder();
    char prelude[256], command[256], path[128];
    snprintf(path, sizeof path, "%s/out.txt", folder);
    snprintf(prelude, sizeof prelude, "%s#fopen Out \"%s\" write\n", PRELUDE, path);
    unlink(path);
    const char *scene = write_text("povray.pov", prelude, text);
    snprintf(command, sizeof command, "povray +I%s +W4 +H4 -D -F >/dev/null 2>&1", scene);
    if (system(command) != 0)
        return NULL;
    return file_read(arena_create(), path, NULL, NULL);
}

Scene *scene_of(const char *text) {
    Converted result = convert_text(text);
    if (!result.scene)
        fail_msg("%s\n%s", text, result.message);
    return result.scene;
}

const Object *root(const Scene *scene, uint32_t i) {
    assert_true(i < scene->root_count);
    return &scene->objects[scene->roots[i]];
}

const Object *child(const Scene *scene, const Object *object, uint32_t i) {
    assert_true(object_is_tree(object));
    assert_true(i < object->shape.children.count);
    return &scene->objects[object->shape.children.items[i]];
}

const Pigment *pigment_of(const Scene *scene, const Object *object, uint32_t layer) {
    const Texture *texture = &scene->textures[object->texture];
    assert_true(layer < texture->layer_count);
    return &scene->pigments[texture->layers[layer].pigment];
}

void assert_near(double a, double b) {
    if (!(fabs(a - b) <= 1e-12 * (1 + fabs(b))))
        fail_msg("%.17g is not %.17g", a, b);
}

void assert_vec(Vec3 v, double x, double y, double z) {
    assert_near(v.x, x);
    assert_near(v.y, y);
    assert_near(v.z, z);
}

void assert_dies(const char *text, const char *fragment) {
    Converted result = convert_text(text);
    if (result.scene || !strcasestr(result.message, fragment))
        fail_msg("%s\nexpected \"%s\", got: %s", text, fragment,
                 result.scene ? "no error" : result.message);
}

void assert_warns(const char *text, const char *fragment) {
    const char *warning = first_warning(text);
    if (!strstr(warning, fragment))
        fail_msg("%s\nexpected \"%s\", got: %s", text, fragment, warning);
}

void assert_silent(const char *text) {
    const char *warning = first_warning(text);
    if (*warning)
        fail_msg("%s\nexpected silence, got: %s", text, warning);
}

const Texture *texture_of(const Scene *scene, const Object *object) {
    assert_int_not_equal(object->texture, NO_INDEX);
    return &scene->textures[object->texture];
}

void assert_color(Color c, double r, double g, double b, double filter, double transmit) {
    const double want[5] = {r, g, b, filter, transmit};
    const float got[5] = {c.r, c.g, c.b, c.filter, c.transmit};
    for (int i = 0; i < 5; i++)
        if (got[i] != (float)want[i])
            fail_msg("component %d of the colour is %.9g, not %.9g", i, (double)got[i], want[i]);
}
