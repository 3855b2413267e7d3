// SPDX-License-Identifier: MIT
#include "model/scene_read_json.h"

#include "model/file_path.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <string.h>

// So that a count, and a count of bytes, fits its type.
enum { MAX_TABLE = 0x7fffffff };

static const char *type_name(json_type type) {
    switch (type) {
    case JSON_OBJECT:
        return "an object {...}";
    case JSON_ARRAY:
        return "an array [...]";
    case JSON_STRING:
        return "a string";
    case JSON_INTEGER:
        return "a whole number";
    case JSON_REAL:
        return "a number";
    case JSON_TRUE:
    case JSON_FALSE:
        return "true or false";
    case JSON_NULL:
        break;
    }
    return "null";
}

_Noreturn static void refuse_type(const Reader *r, const FieldPath *path, const char *expected,
                                  const json_t *value) {
    path_die(r->file, path, "expected %s, found %s", expected, type_name(json_typeof(value)));
}

void read_expect(const Reader *r, const FieldPath *path, const json_t *value, json_type type) {
    if (json_typeof(value) != type)
        refuse_type(r, path, type_name(type), value);
}

static double read_double(const Reader *r, const FieldPath *path, const json_t *value) {
    if (!json_is_number(value))
        refuse_type(r, path, "a number", value);
    return json_number_value(value);
}

static float read_float(const Reader *r, const FieldPath *path, const json_t *value) {
    double number = read_double(r, path, value);
    if (fabs(number) > (double)FLT_MAX)
        path_die(r->file, path, "%g is too large for single precision", number);
    return (float)number;
}

static int64_t read_integer(const Reader *r, const FieldPath *path, const json_t *value,
                            int64_t low, int64_t high) {
    int64_t number = 0;
    if (json_is_integer(value)) {
        number = json_integer_value(value);
    } else {
        double real = read_double(r, path, value);
        if (real != floor(real) || fabs(real) > 0x1p53)
            path_die(r->file, path, "expected a whole number, found %g", real);
        number = (int64_t)real;
    }
    if (number < low || number > high)
        path_die(r->file, path, "%lld is not in the range %lld to %lld", (long long)number,
                 (long long)low, (long long)high);
    return number;
}

uint64_t read_whole(const Reader *r, const FieldPath *path, const json_t *value, uint64_t low,
                    uint64_t high) {
    return (uint64_t)read_integer(r, path, value, (int64_t)low, (int64_t)high);
}

static void expect_count(const Reader *r, const FieldPath *path, const json_t *value, int count) {
    read_expect(r, path, value, JSON_ARRAY);
    if (json_array_size(value) != (size_t)count)
        path_die(r->file, path, "expected %d values, found %zu", count, json_array_size(value));
}

void read_doubles(const Reader *r, const FieldPath *path, const json_t *value, double *out,
                  int count) {
    expect_count(r, path, value, count);
    for (int i = 0; i < count; i++) {
        const FieldPath item = path_item(path, NULL, (uint32_t)i);
        out[i] = read_double(r, &item, json_array_get(value, (size_t)i));
    }
}

static void read_floats(const Reader *r, const FieldPath *path, const json_t *value, float *out,
                        int count) {
    expect_count(r, path, value, count);
    for (int i = 0; i < count; i++) {
        const FieldPath item = path_item(path, NULL, (uint32_t)i);
        out[i] = read_float(r, &item, json_array_get(value, (size_t)i));
    }
}

static void read_rows(const Reader *r, const FieldPath *path, const json_t *value, double *out,
                      int rows, int columns, int stride) {
    expect_count(r, path, value, rows);
    for (int i = 0; i < rows; i++) {
        const FieldPath row = path_item(path, NULL, (uint32_t)i);
        read_doubles(r, &row, json_array_get(value, (size_t)i), out + (ptrdiff_t)i * stride,
                     columns);
    }
}

static void read_color(const Reader *r, const FieldPath *path, const json_t *value, Color *out) {
    float numbers[5] = {0};
    bool clear = json_is_array(value) && json_array_size(value) == 5;
    read_floats(r, path, value, numbers, clear ? 5 : 3);
    *out = (Color){numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]};
}

static int read_enum(const Reader *r, const FieldPath *path, const json_t *value,
                     const char *const *names) {
    read_expect(r, path, value, JSON_STRING);
    for (int i = 0; names[i]; i++)
        if (strcmp(json_string_value(value), names[i]) == 0)
            return i;
    path_die(r->file, path, "unknown word '%s'", json_string_value(value));
}

// {"matrix": ..., "inverse": ...}; without the second it is computed.
static void read_transform(const Reader *r, const FieldPath *path, json_t *value, Transform *out) {
    static const char *const KEYS[] = {"matrix", "inverse", NULL};
    const FieldPath matrix_path = path_field(path, "matrix");
    const FieldPath inverse_path = path_field(path, "inverse");
    read_expect(r, path, value, JSON_OBJECT);
    read_only_keys(r, path, value, NULL, KEYS);
    json_t *matrix = json_object_get(value, "matrix");
    json_t *inverse = json_object_get(value, "inverse");
    if (!matrix)
        path_die(r->file, path, "'matrix' is missing");
    *out = transform_identity();
    read_rows(r, &matrix_path, matrix, &out->m[0][0], 4, 3, 4);
    if (inverse) {
        read_rows(r, &inverse_path, inverse, &out->inv[0][0], 4, 3, 4);
        return;
    }
    double rows[4][3];
    for (int i = 0; i < 4; i++)
        memcpy(rows[i], out->m[i], sizeof rows[i]);
    if (!transform_matrix(rows, out))
        path_die(r->file, &matrix_path, "it cannot be inverted");
}

static uint32_t read_index(const Reader *r, const FieldPath *path, const json_t *value) {
    return (uint32_t)read_whole(r, path, value, 0, NO_INDEX - 1);
}

static const char *read_path(const Reader *r, const FieldPath *path, const json_t *value) {
    read_expect(r, path, value, JSON_STRING);
    if (json_string_length(value) == 0)
        path_die(r->file, path, "it is empty");
    return path_beside_file(r->arena, json_string_value(value), r->file);
}

// An array into a pointer and a count, both members of the struct at `at`.
static void read_list(const Reader *r, const FieldPath *up, const json_t *value, const Field *field,
                      void *at) {
    const FieldPath path = path_field(up, field->name);
    read_expect(r, &path, value, JSON_ARRAY);
    size_t count = json_array_size(value);
    if (count >= NO_INDEX)
        path_die(r->file, &path, "too many entries");
    bool indices = field->type == FIELD_INDICES;
    size_t size = indices ? sizeof(uint32_t) : field->record->size;
    char *items = arena_array(r->arena, count, size);
    for (size_t i = 0; i < count; i++) {
        const FieldPath item_path = path_item(up, field->name, (uint32_t)i);
        json_t *item = json_array_get(value, i);
        void *out = items + i * size;
        if (indices) {
            *(uint32_t *)out = read_index(r, &item_path, item);
        } else {
            field->record->set_default(out);
            read_record(r, &item_path, item, field->record, out, NULL);
        }
    }
    *(void **)field_at(at, field->offset) = items;
    *(uint32_t *)field_at(at, field->link) = (uint32_t)count;
}

// Rows of numbers into a pointer and a count, both members of the struct at `at`.
static void read_table(const Reader *r, const FieldPath *path, const json_t *value,
                       const Field *field, void *at) {
    bool indices = field->type == FIELD_INDEX_TABLE;
    size_t columns = (size_t)field->columns;
    read_expect(r, path, value, JSON_ARRAY);
    size_t count = json_array_size(value);
    if (count > MAX_TABLE / columns)
        path_die(r->file, path, "too many entries");
    void *items =
        arena_array(r->arena, count * columns, indices ? sizeof(uint32_t) : sizeof(double));
    for (size_t i = 0; i < count; i++) {
        const FieldPath row_path = path_item(path, NULL, (uint32_t)i);
        json_t *row = json_array_get(value, i);
        if (columns > 1)
            expect_count(r, &row_path, row, field->columns);
        for (size_t j = 0; j < columns; j++) {
            const json_t *number = columns > 1 ? json_array_get(row, j) : row;
            if (indices)
                ((uint32_t *)items)[i * columns + j] =
                    (uint32_t)read_integer(r, &row_path, number, -1, NO_INDEX - 1);
            else
                ((double *)items)[i * columns + j] = read_double(r, &row_path, number);
        }
    }
    *(void **)field_at(at, field->offset) = items;
    *(uint32_t *)field_at(at, field->link) = (uint32_t)count;
}

// ORDER field_type
static void read_value(const Reader *r, const FieldPath *up, json_t *value, const Field *field,
                       void *record) {
    const FieldPath path = path_field(up, field->name);
    void *at = field_at(record, field->offset);
    switch (field->type) {
    case FIELD_BOOL:
        if (!json_is_boolean(value))
            refuse_type(r, &path, "true or false", value);
        *(bool *)at = json_is_true(value);
        break;
    case FIELD_INT:
        *(int *)at = (int)read_integer(r, &path, value, INT_MIN, INT_MAX);
        break;
    case FIELD_FLOAT:
        *(float *)at = read_float(r, &path, value);
        break;
    case FIELD_DOUBLE:
        *(double *)at = read_double(r, &path, value);
        break;
    case FIELD_PATH:
        *(const char **)at = read_path(r, &path, value);
        break;
    case FIELD_INDEX:
        *(uint32_t *)at = read_index(r, &path, value);
        break;
    case FIELD_ENUM:
        *(int *)at = read_enum(r, &path, value, field->names);
        break;
    case FIELD_FLOATS:
        read_floats(r, &path, value, at, field->columns);
        break;
    case FIELD_DOUBLES:
        read_doubles(r, &path, value, at, field->columns);
        break;
    case FIELD_COLOR:
        read_color(r, &path, value, at);
        break;
    case FIELD_ROWS:
        read_rows(r, &path, value, at, field->rows, field->columns, field->columns);
        break;
    case FIELD_TRANSFORM:
        read_transform(r, &path, value, at);
        break;
    case FIELD_RECORD:
        read_record(r, &path, value, field->record, at, NULL);
        break;
    case FIELD_RECORDS:
    case FIELD_INDICES:
        read_list(r, up, value, field, record);
        break;
    case FIELD_TABLE:
    case FIELD_INDEX_TABLE:
        read_table(r, &path, value, field, record);
        break;
    }
}

static bool is_field(const Record *record, const char *key) {
    for (; record; record = record->base)
        for (const Field *field = record->fields; field->name; field++)
            if (strcmp(key, field->name) == 0)
                return true;
    return false;
}

void read_only_keys(const Reader *r, const FieldPath *path, json_t *object, const Record *record,
                    const char *const *also) {
    const char *key;
    json_t *value;
    json_object_foreach(object, key, value) {
        bool known = is_field(record, key);
        for (int i = 0; !known && also && also[i]; i++)
            known = strcmp(key, also[i]) == 0;
        if (!known)
            path_die(r->file, path, "unknown field '%s'", key);
    }
}

// The texture coordinates of a run of patches are an object, in the side file (scene_read.c).
static bool is_reference(const Field *field, const json_t *value) {
    return field->type == FIELD_ROWS && json_is_object(value);
}

void read_record(const Reader *r, const FieldPath *path, json_t *object, const Record *record,
                 void *at, const char *const *also) {
    read_expect(r, path, object, JSON_OBJECT);
    read_only_keys(r, path, object, record, also);
    for (; record; record = record->base) {
        for (const Field *field = record->fields; field->name; field++) {
            json_t *value = json_object_get(object, field->name);
            if (!field_belongs(record, field, at)) {
                if (value)
                    path_die(r->file, path, "'%s' does not go with this type", field->name);
                continue;
            }
            if (value && field->presence == FIELD_FLAGGED)
                *(bool *)field_at(at, field->link) = true;
            if (value && !is_reference(field, value))
                read_value(r, path, value, field, at);
            else if (!value && field->presence == FIELD_REQUIRED)
                path_die(r->file, path, "'%s' is missing", field->name);
            if (field == record->fields && record->set_kind_default)
                record->set_kind_default(at);
        }
    }
}
