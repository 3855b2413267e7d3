// SPDX-License-Identifier: MIT
// Inside the room: the lines of the tables in scene_fields.c, object_fields.c and texture_fields.c.
#ifndef MODEL_FIELD_MACROS_H
#define MODEL_FIELD_MACROS_H

#include "model/scene_fields.h"

// One line of a table: the struct, its member, what it is called in the file.
#define AT(Struct, member) .offset = offsetof(Struct, member)
#define BOOL(Struct, member, text)                                                                 \
    { .name = text, .type = FIELD_BOOL, AT(Struct, member) }
#define INT(Struct, member, text)                                                                  \
    { .name = text, .type = FIELD_INT, AT(Struct, member) }
#define FLOAT(Struct, member, text)                                                                \
    { .name = text, .type = FIELD_FLOAT, AT(Struct, member) }
#define INDEX(Struct, member, text)                                                                \
    { .name = text, .type = FIELD_INDEX, AT(Struct, member) }
#define ENUM(Struct, member, text, list)                                                           \
    { .name = text, .type = FIELD_ENUM, AT(Struct, member), .names = list }
#define RGB(Struct, member, text)                                                                  \
    { .name = text, .type = FIELD_FLOATS, AT(Struct, member), .columns = 3 }
#define COLOR(Struct, member, text)                                                                \
    { .name = text, .type = FIELD_COLOR, AT(Struct, member) }
#define DOUBLE_AS(kept, Struct, member, text)                                                      \
    { .name = text, .type = FIELD_DOUBLE, .presence = kept, AT(Struct, member) }
#define DOUBLE(Struct, member, text) DOUBLE_AS(FIELD_PLAIN, Struct, member, text)
#define VEC3_AS(kept, Struct, member, text)                                                        \
    { .name = text, .type = FIELD_DOUBLES, .presence = kept, AT(Struct, member), .columns = 3 }
#define VEC3(Struct, member, text) VEC3_AS(FIELD_PLAIN, Struct, member, text)
#define RECORDS(Struct, member, count, text, table)                                                \
    {                                                                                              \
        .name = text, .type = FIELD_RECORDS, AT(Struct, member), .link = offsetof(Struct, count),  \
        .record = table                                                                            \
    }
// Rows of numbers of the member's type, as many as `count` says.
#define TABLE(Struct, member, count, text, width)                                                  \
    {                                                                                              \
        .name = text, .type = FIELD_TABLE, AT(Struct, member), .link = offsetof(Struct, count),    \
        .columns = width                                                                           \
    }
#define INDEX_TABLE(Struct, member, count, text, width)                                            \
    {                                                                                              \
        .name = text, .type = FIELD_INDEX_TABLE, AT(Struct, member),                               \
        .link = offsetof(Struct, count), .columns = width                                          \
    }
#define END                                                                                        \
    { .name = NULL }

#endif
