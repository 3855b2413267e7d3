// SPDX-License-Identifier: MIT
// pov2qi --requires: what the scene needs of a renderer. What is modelled is what its scene file
// would name; what is not comes from the warnings, with their places.
#include "converter/convert.h"
#include "converter/emit.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

// The keyword of a warning: in quotes, else its first word (nodes.h, note_gap).
static const char *feature_of(Converter *cv, const char *text) {
    const char *start = strchr(text, '\''), *colon = strchr(text, ':');
    if (start && (!colon || start < colon))
        start++;
    else
        start = text + (strncmp(text, "the camera's ", 13) == 0 ? 13 : 0);
    return arena_printf(cv->arena, "%.*s", (int)strcspn(start, "' :,;"), start);
}

void requires_add(Converter *cv, const Loc *loc, const char *text) {
    MissingList *list = cv->missing;
    Missing missing = {feature_of(cv, text), text, *loc};
    array_push(list, missing);
}

static int compare_missing(const void *a, const void *b) {
    const Missing *first = a, *second = b;
    int order = strcmp(first->feature, second->feature);
    if (!order)
        order = strcmp(first->loc.file, second->loc.file);
    if (!order)
        order = first->loc.line - second->loc.line;
    return order ? order : first->loc.column - second->loc.column;
}

static const char *lacks(const Missing *missing) {
    const char *colon = strchr(missing->text, ':');
    return colon ? colon + 1 + strspn(colon + 1, " ") : missing->text;
}

// Is entry i of the sorted list the first of its feature?
static bool begins_feature(const Missing *items, size_t i) {
    return i == 0 || strcmp(items[i - 1].feature, items[i].feature) != 0;
}

static void print_text(FILE *out, const Scene *scene, const Missing *items, size_t count) {
    for (uint32_t i = 0; i < scene->requires_count; i++)
        fprintf(out, "%s\n", scene->requires[i]);
    for (size_t i = 0; i < count; i++) {
        if (begins_feature(items, i))
            fprintf(out, "%s: not modelled\n", items[i].feature);
        fprintf(out, "    %s:%d:%d: %s\n", items[i].loc.file, items[i].loc.line,
                items[i].loc.column, lacks(&items[i]));
    }
}

// Names of files may hold any bytes; JSON text may not.
static json_t *text_of(const char *text) {
    json_t *value = json_string(text);
    if (value)
        return value;
    char *copy = strdup(text);
    if (!copy)
        die("out of memory");
    for (char *p = copy; *p; p++)
        *p = (unsigned char)*p > 127 ? '?' : *p;
    value = json_string(copy);
    free(copy);
    return value;
}

static void print_json(FILE *out, const char *input, const Scene *scene, const Missing *items,
                       size_t count) {
    json_t *root = json_object(), *modelled = json_array(), *missing = json_array();
    for (uint32_t i = 0; i < scene->requires_count; i++)
        json_array_append_new(modelled, json_string(scene->requires[i]));
    json_t *places = NULL;
    for (size_t i = 0; i < count; i++) {
        if (begins_feature(items, i)) {
            json_t *feature = json_object();
            places = json_array();
            json_object_set_new(feature, "feature", json_string(items[i].feature));
            json_object_set_new(feature, "places", places);
            json_array_append_new(missing, feature);
        }
        json_t *place = json_object();
        json_object_set_new(place, "file", text_of(items[i].loc.file));
        json_object_set_new(place, "line", json_integer(items[i].loc.line));
        json_object_set_new(place, "column", json_integer(items[i].loc.column));
        json_object_set_new(place, "lacks", json_string(lacks(&items[i])));
        json_array_append_new(places, place);
    }
    json_object_set_new(root, "scene", text_of(input));
    json_object_set_new(root, "modelled", modelled);
    json_object_set_new(root, "not_modelled", missing);
    json_dumpf(root, out, JSON_INDENT(2));
    fputc('\n', out);
    json_decref(root);
}

void requires_print(FILE *out, const RenderOptions *options, const Scene *scene,
                    const MissingList *missing) {
    if (missing->count)
        qsort(missing->items, missing->count, sizeof *missing->items, compare_missing);
    if (options->json)
        print_json(out, options->input, scene, missing->items, missing->count);
    else
        print_text(out, scene, missing->items, missing->count);
}
