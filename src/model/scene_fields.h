// SPDX-License-Identifier: MIT
// Inside the room: what the scene file calls each member of the structs in scene.h, and how it is
// stored. scene_write.c and scene_read.c both walk these tables, so a member added here is written,
// read and refused when wrong.
#ifndef MODEL_SCENE_FIELDS_H
#define MODEL_SCENE_FIELDS_H

#include "model/scene.h"

#include <stddef.h>

// ORDER field_type (write_value in scene_write.c, read_value in scene_read.c)
typedef enum {
    FIELD_BOOL,
    FIELD_INT,
    FIELD_FLOAT,
    FIELD_DOUBLE,
    FIELD_PATH,      // const char *: of a file; relative ones start at the scene file
    FIELD_INDEX,     // uint32_t; NO_INDEX by leaving it out
    FIELD_ENUM,      // stored as int, written as names[value]
    FIELD_FLOATS,    // `columns` floats: [r, g, b]
    FIELD_DOUBLES,   // `columns` doubles: [x, y, z]
    FIELD_COLOR,     // [r, g, b] or [r, g, b, filter, transmit]
    FIELD_ROWS,      // `rows` of `columns` doubles
    FIELD_TRANSFORM, // {"matrix": 4 rows of 3, "inverse": the same}
    FIELD_RECORD,    // a struct inside the struct
    FIELD_RECORDS,   // a pointer to structs, their count at `link`
    FIELD_INDICES,   // a pointer to uint32_t, their count at `link`
    FIELD_TABLE,     // a pointer to rows of `columns` doubles, their count at `link`
    // The same of uint32_t; NO_INDEX is written as -1.
    FIELD_INDEX_TABLE,
} FieldType;

typedef enum {
    FIELD_PLAIN,    // left out when it has its default value
    FIELD_ALWAYS,   // always written, may be missing when read
    FIELD_REQUIRED, // always written, refused when missing
    FIELD_FLAGGED,  // present exactly when the bool at `link` is true
} FieldPresence;

typedef struct Record Record;

typedef struct {
    const char *name;
    FieldType type;
    FieldPresence presence;
    size_t offset; // in the struct
    size_t link;   // offset of the count or of the bool
    int rows, columns;
    const char *const *names; // FIELD_ENUM, ended by NULL
    const Record *record;     // FIELD_RECORD, FIELD_RECORDS
    uint32_t kinds;           // one bit a kind of record that has the field; 0: all have it
} Field;

// A struct: its fields, ended by one without a name, and after them those of `base`.
struct Record {
    const Record *base;
    const Field *fields;
    size_t size;
    void (*set_default)(void *out); // fills the struct; NULL: the caller does
    // A struct with a union: its first field is its kind, an enumeration. Fills all that the kind
    // decides on, the kind being set. NULL: there is only one kind.
    void (*set_kind_default)(void *out);
};

extern const Record FUNCTION_RECORD; // function_fields.c
enum { MESH_FACE_COLUMNS = 12 };

extern const Record MESH_RECORD, HEIGHT_MAP_RECORD;
extern const Record SCENE_RECORD;             // all of Scene but objects, roots, requires
const Record *object_record(ObjectType type); // without type, points and children

// ORDER object_type; OBJECT_PATCH is "bicubic_patch", and BEZIER_PATCH_NAME for other degrees.
extern const char *const OBJECT_TYPE_NAMES[];
extern const char BEZIER_PATCH_NAME[];

// Has the struct at `record` this field? (A union has those of its kind.)
bool field_belongs(const Record *table, const Field *field, const void *record);

// Are both the same, bit by bit, as far as the file can tell? a and b point to the members.
bool field_equal(const Field *field, const void *a, const void *b);

static inline void *field_at(void *record, size_t offset) { return (char *)record + offset; }
static inline const void *field_of(const void *record, size_t offset) {
    return (const char *)record + offset;
}

#endif
