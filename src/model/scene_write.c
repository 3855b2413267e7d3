// SPDX-License-Identifier: MIT
// Scene -> scene file. The document is built as compact JSON in memory from the tables of
// scene_fields.h, then laid out for reading (json_layout.h). With the side file, patches that stand
// side by side and differ only in their points become one entry with a count, so that a million of
// them are a few lines of JSON.
#include "model/scene.h"

#include "base/diag.h"
#include "base/file.h"
#include "base/hash.h"
#include "model/json_layout.h"
#include "model/scene_binary.h"
#include "model/file_path.h"
#include "model/scene_fields.h"
#include "model/scene_format.h"

#include <assert.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const Scene *scene;
    const char *path;
    const SceneWriteOptions *options;
    Arena *scratch;
    OutputFile *file, *side; // NULL: standard output; no side file
    FILE *out;               // the compact text
    FILE *binary;            // the side file's stream, or NULL
    uint64_t position;       // bytes written to it
} Writer;

// Between two members: nothing at first, then commas.
typedef struct {
    bool any;
} Comma;

static void comma(Writer *w, Comma *state) {
    if (state->any)
        fputc(',', w->out);
    state->any = true;
}

static void member(Writer *w, Comma *state, const char *name) {
    comma(w, state);
    fprintf(w->out, "\"%s\":", name);
}

// ---- values ---------------------------------------------------------------------------------

static void write_double(Writer *w, double value) {
    char text[JSON_NUMBER_SIZE];
    json_double(text, value);
    fputs(text, w->out);
}

static void write_float(Writer *w, float value) {
    char text[JSON_NUMBER_SIZE];
    json_float(text, value);
    fputs(text, w->out);
}

static void write_doubles(Writer *w, const double *values, int count) {
    for (int i = 0; i < count; i++) {
        fputc(i ? ',' : '[', w->out);
        write_double(w, values[i]);
    }
    fputc(']', w->out);
}

static void write_floats(Writer *w, const float *values, int count) {
    for (int i = 0; i < count; i++) {
        fputc(i ? ',' : '[', w->out);
        write_float(w, values[i]);
    }
    fputc(']', w->out);
}

// rows of `columns` numbers, `stride` numbers apart
static void write_rows(Writer *w, const double *values, int rows, int columns, int stride) {
    for (int i = 0; i < rows; i++) {
        fputc(i ? ',' : '[', w->out);
        write_doubles(w, values + (ptrdiff_t)i * stride, columns);
    }
    fputc(']', w->out);
}

// The inverse is left out when it is what transform_matrix makes of the matrix: then a script has
// one matrix to edit, not two.
static void write_transform(Writer *w, const Transform *t) {
    double rows[4][3];
    Transform plain;
    for (int i = 0; i < 4; i++)
        memcpy(rows[i], t->m[i], sizeof rows[i]);
    bool is_plain =
        transform_matrix(rows, &plain) && memcmp(plain.inv, t->inv, sizeof plain.inv) == 0;
    fputs("{\"matrix\":", w->out);
    write_rows(w, &t->m[0][0], 4, 3, 4);
    if (!is_plain) {
        fputs(",\"inverse\":", w->out);
        write_rows(w, &t->inv[0][0], 4, 3, 4);
    }
    fputc('}', w->out);
}

// As a JSON string with its quotes; dies when it is no UTF-8.
static char *quoted(Arena *arena, const char *path, const char *text) {
    json_t *string = json_string(text);
    if (!string)
        die("cannot write '%s': a name in it is not UTF-8", path);
    char *dump = json_dumps(string, JSON_ENCODE_ANY), *copy = arena_strdup(arena, dump);
    free(dump);
    json_decref(string);
    return copy;
}

static void write_path(Writer *w, const char *path) {
    char *from_file = path_from_file(w->scratch, path, w->path);
    fputs(quoted(w->scratch, w->path, from_file), w->out);
}

static void write_color(Writer *w, const Color *color) {
    const float numbers[5] = {color->r, color->g, color->b, color->filter, color->transmit};
    static const float opaque[2];
    bool is_opaque = memcmp(&numbers[3], opaque, sizeof opaque) == 0; // bitwise: -0 is written
    write_floats(w, numbers, is_opaque ? 3 : 5);
}

static void write_fields(Writer *w, Comma *state, const Record *record, const void *at,
                         const void *defaults);

static void write_record(Writer *w, const Record *record, const void *at) {
    union {
        Finish finish;
        Pigment pigment;
        Normal normal;
        SlopeEntry slope;
        IndexEntry index;
        FacetsShape facets;
        Picture picture;
        DensityFile density;
        SlopeShape slope_shape;
        FractalShape fractal;
        PaletteChange change;
        Turbulence turbulence;
        CrackleShape crackle;
        Settings settings;
        Camera camera;
        FocalBlur blur;
        SkySphere sky_sphere;
        Warp warp;
        AreaLight area_light;
        Light light;
        Fog fog;
        Rainbow rainbow;
        MapEntry entry;
        Layer layer;
        Texture texture;
        Interior interior;
        Function function;
        BlobComponent component;
        Mesh mesh;
        HeightMap height_map;
    } defaults; // room for any of them
    assert(record->size <= sizeof defaults);
    record->set_default(&defaults);
    if (record->set_kind_default) {
        size_t kind = record->fields[0].offset;
        memcpy(field_at(&defaults, kind), field_of(at, kind), sizeof(int));
        record->set_kind_default(&defaults);
    }
    Comma state = {false};
    fputc('{', w->out);
    write_fields(w, &state, record, at, &defaults);
    fputc('}', w->out);
}

static uint32_t count_at(const void *record, const Field *field) {
    return *(const uint32_t *)field_of(record, field->link);
}

static void write_list(Writer *w, const Field *field, const void *record) {
    const char *items = *(const void *const *)field_of(record, field->offset);
    uint32_t count = count_at(record, field);
    Comma state = {false};
    fputc('[', w->out);
    for (uint32_t i = 0; i < count; i++) {
        comma(w, &state);
        if (field->type == FIELD_INDICES)
            fprintf(w->out, "%u", ((const uint32_t *)(const void *)items)[i]);
        else
            write_record(w, field->record, items + i * field->record->size);
    }
    fputc(']', w->out);
}

static void write_table(Writer *w, const Field *field, const void *record) {
    const double *numbers = *(const double *const *)field_of(record, field->offset);
    uint32_t count = count_at(record, field);
    if (field->columns == 1)
        write_doubles(w, numbers, (int)count);
    else
        write_rows(w, numbers, (int)count, field->columns, field->columns);
}

static void write_index_table(Writer *w, const Field *field, const void *record) {
    const uint32_t *numbers = *(const uint32_t *const *)field_of(record, field->offset);
    uint32_t count = count_at(record, field) * (uint32_t)field->columns;
    for (uint32_t i = 0; i < count; i++) {
        bool first = field->columns > 1 && i % (uint32_t)field->columns == 0;
        fputs(i == 0 ? "[" : ",", w->out);
        fputs(first ? "[" : "", w->out);
        fprintf(w->out, "%" PRId64, numbers[i] == NO_INDEX ? INT64_C(-1) : (int64_t)numbers[i]);
        if (field->columns > 1 && (i + 1) % (uint32_t)field->columns == 0)
            fputc(']', w->out);
    }
    fputs(count ? "]" : "[]", w->out);
}

// ORDER field_type
static void write_value(Writer *w, const Field *field, const void *record) {
    const void *at = field_of(record, field->offset);
    switch (field->type) {
    case FIELD_BOOL:
        fputs(*(const bool *)at ? "true" : "false", w->out);
        break;
    case FIELD_INT:
        fprintf(w->out, "%d", *(const int *)at);
        break;
    case FIELD_FLOAT:
        write_float(w, *(const float *)at);
        break;
    case FIELD_DOUBLE:
        write_double(w, *(const double *)at);
        break;
    case FIELD_PATH:
        write_path(w, *(const char *const *)at);
        break;
    case FIELD_INDEX:
        fprintf(w->out, "%u", *(const uint32_t *)at);
        break;
    case FIELD_ENUM:
        fprintf(w->out, "\"%s\"", field->names[*(const int *)at]);
        break;
    case FIELD_FLOATS:
        write_floats(w, at, field->columns);
        break;
    case FIELD_DOUBLES:
        write_doubles(w, at, field->columns);
        break;
    case FIELD_COLOR:
        write_color(w, at);
        break;
    case FIELD_ROWS:
        write_rows(w, at, field->rows, field->columns, field->columns);
        break;
    case FIELD_TRANSFORM:
        write_transform(w, at);
        break;
    case FIELD_RECORD:
        write_record(w, field->record, at);
        break;
    case FIELD_RECORDS:
    case FIELD_INDICES:
        write_list(w, field, record);
        break;
    case FIELD_TABLE:
        write_table(w, field, record);
        break;
    case FIELD_INDEX_TABLE:
        write_index_table(w, field, record);
        break;
    }
}

static bool is_written(const Field *field, const void *record, const void *defaults) {
    if (field->presence == FIELD_FLAGGED)
        return *(const bool *)field_of(record, field->link);
    if (field->type >= FIELD_RECORDS)
        return count_at(record, field) > 0;
    return field->presence != FIELD_PLAIN ||
           !field_equal(field, field_of(record, field->offset), field_of(defaults, field->offset));
}

static void write_fields(Writer *w, Comma *state, const Record *record, const void *at,
                         const void *defaults) {
    for (; record; record = record->base) {
        for (const Field *field = record->fields; field->name; field++) {
            if (field_belongs(record, field, at) && is_written(field, at, defaults)) {
                member(w, state, field->name);
                write_value(w, field, at);
            }
        }
    }
}

// ---- objects --------------------------------------------------------------------------------

static uint32_t point_count(const PatchShape *patch) {
    return (patch->degree_u + 1) * (patch->degree_v + 1);
}

static void write_points(Writer *w, const PatchShape *patch) {
    int columns = (int)patch->degree_v + 1;
    for (uint32_t i = 0; i <= patch->degree_u; i++) {
        fputc(i ? ',' : '[', w->out);
        write_rows(w, &patch->points[i * (uint32_t)columns].x, columns, 3, 3);
    }
    fputc(']', w->out);
}

// Could both be entries of one run, apart from the texture coordinates?
static bool same_run(const Object *a, const Object *b) {
    if (b->type != OBJECT_PATCH || b->bounds.count > 0)
        return false;
    const PatchShape *p = &a->shape.patch, *q = &b->shape.patch;
    if (p->degree_u != q->degree_u || p->degree_v != q->degree_v || q->weights)
        return false;
    for (const Record *record = object_record(OBJECT_PATCH); record; record = record->base)
        for (const Field *field = record->fields; field->name; field++)
            if (field->offset != offsetof(Object, shape.patch.uv) &&
                !field_equal(field, field_of(a, field->offset), field_of(b, field->offset)))
                return false;
    return true;
}

static bool has_default_uv(const Object *object, const Object *defaults) {
    return memcmp(object->shape.patch.uv, defaults->shape.patch.uv,
                  sizeof defaults->shape.patch.uv) == 0;
}

static void write_reference(Writer *w, Comma *state, const char *name) {
    member(w, state, name);
    fprintf(w->out, "{\"buffer\":0,\"byteOffset\":%llu}", (unsigned long long)w->position);
}

static void write_run_data(Writer *w, Comma *state, const uint32_t *items, uint32_t count,
                           const Object *defaults) {
    const Object *objects = w->scene->objects;
    uint32_t points = point_count(&objects[items[0]].shape.patch);
    bool uv = false;
    write_reference(w, state, "points");
    for (uint32_t i = 0; i < count; i++) {
        const Object *object = &objects[items[i]];
        uv = uv || !has_default_uv(object, defaults);
        binary_write(w->binary, &object->shape.patch.points[0].x, (size_t)points * 3);
    }
    w->position += (uint64_t)count * points * sizeof(Vec3);
    if (!uv)
        return;
    write_reference(w, state, "uv");
    for (uint32_t i = 0; i < count; i++)
        binary_write(w->binary, &objects[items[i]].shape.patch.uv[0].u, 8);
    w->position += (uint64_t)count * 4 * sizeof(Vec2);
}

// A run of patches as one entry; returns how many of items it took.
static uint32_t write_run(Writer *w, const uint32_t *items, uint32_t available) {
    const Object *objects = w->scene->objects, *first = &objects[items[0]];
    uint32_t count = 1;
    while (count < available && same_run(first, &objects[items[count]]))
        count++;
    Object defaults = object_default(OBJECT_PATCH), like = *first;
    memcpy(like.shape.patch.uv, defaults.shape.patch.uv, sizeof like.shape.patch.uv);
    const PatchShape *patch = &first->shape.patch;
    bool bicubic = patch->degree_u == 3 && patch->degree_v == 3;
    Comma state = {true};
    fprintf(w->out, "{\"type\":\"%s\",\"count\":%u",
            bicubic ? OBJECT_TYPE_NAMES[OBJECT_PATCH] : BEZIER_PATCH_NAME, count);
    if (!bicubic)
        fprintf(w->out, ",\"degree\":[%u,%u]", patch->degree_u, patch->degree_v);
    write_fields(w, &state, object_record(OBJECT_PATCH), &like, &defaults);
    write_run_data(w, &state, items, count, &defaults);
    fputc('}', w->out);
    return count;
}

static void write_objects(Writer *w, const uint32_t *items, uint32_t count);

static void write_object(Writer *w, const Object *object) {
    const Object defaults = object_default(object->type);
    const char *type = OBJECT_TYPE_NAMES[object->type];
    if (object->type == OBJECT_PATCH &&
        (object->shape.patch.degree_u != 3 || object->shape.patch.degree_v != 3 ||
         object->shape.patch.weights))
        type = BEZIER_PATCH_NAME;
    Comma state = {true};
    fprintf(w->out, "{\"type\":\"%s\"", type);
    write_fields(w, &state, object_record(object->type), object, &defaults);
    if (object->type == OBJECT_PATCH) {
        member(w, &state, "points");
        write_points(w, &object->shape.patch);
        if (object->shape.patch.weights) {
            member(w, &state, "weights");
            write_rows(w, object->shape.patch.weights, (int)object->shape.patch.degree_u + 1,
                       (int)object->shape.patch.degree_v + 1,
                       (int)object->shape.patch.degree_v + 1);
        }
    } else if (object_is_tree(object)) {
        member(w, &state, "children");
        write_objects(w, object->shape.children.items, object->shape.children.count);
    }
    if (object->clips.count > 0) {
        member(w, &state, "clipped_by");
        write_objects(w, object->clips.items, object->clips.count);
    }
    if (object->bounds.count > 0) {
        member(w, &state, "bounded_by");
        write_objects(w, object->bounds.items, object->bounds.count);
    }
    fputc('}', w->out);
}

static void write_objects(Writer *w, const uint32_t *items, uint32_t count) {
    Comma state = {false};
    fputc('[', w->out);
    for (uint32_t i = 0; i < count;) {
        const Object *object = &w->scene->objects[items[i]];
        comma(w, &state);
        if (w->binary && object->type == OBJECT_PATCH && !object->shape.patch.weights &&
            !object->bounds.count) {
            i += write_run(w, &items[i], count - i);
        } else {
            write_object(w, object);
            i++;
        }
    }
    fputc(']', w->out);
}

// ---- the document ---------------------------------------------------------------------------

// The side file's size is known only after the objects, so that "buffers" comes last.
static void write_document(Writer *w, const char *uri) {
    const Scene *scene = w->scene;
    Scene defaults;
    SCENE_RECORD.set_default(&defaults);
    Comma state = {true};
    fprintf(w->out, "{\"format\":\"%s\",\"version\":%d", SCENE_FORMAT, SCENE_VERSION);
    member(w, &state, "requires");
    Comma words = {false};
    fputc('[', w->out);
    for (uint32_t i = 0; i < scene->requires_count; i++) {
        comma(w, &words);
        fprintf(w->out, "\"%s\"", scene->requires[i]);
    }
    fputc(']', w->out);
    write_fields(w, &state, &SCENE_RECORD, scene, &defaults);
    member(w, &state, "objects");
    write_objects(w, scene->roots, scene->root_count);
    if (scene->projection_count > 0) {
        member(w, &state, "projections");
        write_objects(w, scene->projections, scene->projection_count);
    }
    if (scene->definition_count > 0) {
        member(w, &state, "definitions");
        write_objects(w, scene->definitions, scene->definition_count);
    }
    if (w->binary) {
        member(w, &state, "buffers");
        fprintf(w->out, "[{\"uri\":%s,\"byteLength\":%llu}]", uri, (unsigned long long)w->position);
    }
    fputc('}', w->out);
}

static bool wants_binary(const Scene *scene, const SceneWriteOptions *options) {
    uint32_t patches = 0;
    for (uint32_t i = 0; i < scene->object_count; i++)
        patches += scene->objects[i].type == OBJECT_PATCH;
    return patches > SCENE_MAX_PATCHES_IN_TEXT || (options->binary && patches > 0);
}

// The whole document as compact text, in the heap.
static char *build_text(Writer *w, const char *uri) {
    char *text = NULL;
    size_t size = 0;
    w->out = open_memstream(&text, &size);
    if (!w->out)
        die("out of memory");
    write_document(w, uri);
    bool complete = !ferror(w->out);
    if (fclose(w->out) != 0 || !complete)
        die("out of memory");
    return text;
}

static void write_files(void *context) {
    Writer *w = context;
    const char *uri = NULL;
    scene_validate(w->scene, w->path); // JSON has no infinities, and the tables trust the types
    bool to_stdout = strcmp(w->path, "-") == 0;
    if (!to_stdout)
        w->file = file_begin(w->path);
    if (!to_stdout && wants_binary(w->scene, w->options)) {
        char *side_path = binary_path(w->scratch, w->path);
        uri = quoted(w->scratch, w->path, file_name(side_path));
        w->side = file_begin(side_path);
        w->binary = file_stream(w->side);
    }
    char *text = build_text(w, uri);
    json_layout(text, to_stdout ? stdout : file_stream(w->file));
    free(text);
    // The side file first: a scene file that is there has its numbers beside it. A commit that dies
    // has cleaned up.
    OutputFile *side = w->side, *file = w->file;
    w->side = NULL;
    if (side)
        file_commit(side);
    w->file = NULL;
    if (file)
        file_commit(file);
    else if (fflush(stdout) != 0 || ferror(stdout))
        die("cannot write to standard output");
}

void scene_write(const Scene *scene, const char *path, const SceneWriteOptions *options) {
    Writer w = {.scene = scene, .path = path, .options = options, .scratch = arena_create()};
    char *message = NULL;
    bool good = diag_catch(write_files, &w, &message);
    if (w.side)
        file_abandon(w.side);
    if (w.file)
        file_abandon(w.file);
    arena_destroy(w.scratch);
    if (!good)
        diag_rethrow(message);
}

// ---- a hash -----------------------------------------------------------------------------------

// What is written to the stream goes into the hash that cookie points to.
static ssize_t hash_written(void *cookie, const char *bytes, size_t size) {
    uint64_t *hash = cookie;
    *hash = hash_bytes(*hash, bytes, size);
    return (ssize_t)size;
}

uint64_t scene_hash(const Scene *scene) {
    uint64_t text = HASH_START, numbers = HASH_START;
    const cookie_io_functions_t hashing = {.write = hash_written};
    const SceneWriteOptions options = {.binary = true};
    Writer w = {.scene = scene, .path = "-", .options = &options, .scratch = arena_create()};
    w.out = fopencookie(&text, "w", hashing);
    w.binary = fopencookie(&numbers, "w", hashing);
    if (!w.out || !w.binary)
        die("out of memory");
    write_document(&w, "\"\"");
    fclose(w.out);
    fclose(w.binary);
    arena_destroy(w.scratch);
    return text ^ (numbers * 0x9e3779b97f4a7c15U);
}
