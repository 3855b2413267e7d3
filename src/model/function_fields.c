// SPDX-License-Identifier: MIT
// The tables of functions, for scene_fields.c.
#include "model/field_macros.h"

_Static_assert(sizeof(FunctionType) == sizeof(int) && sizeof(FunctionOp) == sizeof(int) &&
                   sizeof(SplineKind) == sizeof(int),
               "enumerations are read and written as int");

#define OF(type) (1u << FUNCTION_##type)

static const char *const OP_NAMES[] = {
#define X(op, name, uses) name,
    FUNCTION_OPS(X)
#undef X
        NULL};

static const Field STEP_FIELDS[] = {
    {.name = "op",
     .type = FIELD_ENUM,
     .presence = FIELD_REQUIRED,
     AT(FunctionStep, op),
     .names = OP_NAMES},
    {.name = "to", .type = FIELD_INT, AT(FunctionStep, to)},
    {.name = "a", .type = FIELD_INT, AT(FunctionStep, a)},
    {.name = "b", .type = FIELD_INT, AT(FunctionStep, b)},
    {.name = "value", .type = FIELD_DOUBLE, AT(FunctionStep, value)},
    END,
};
static void default_step(void *out) { *(FunctionStep *)out = (FunctionStep){0}; }
static const Record STEP = {NULL, STEP_FIELDS, sizeof(FunctionStep), default_step, NULL};

static const Field KEY_FIELDS[] = {
    {.name = "at", .type = FIELD_DOUBLE, .presence = FIELD_REQUIRED, AT(SplineKey, at)},
    {.name = "value",
     .type = FIELD_DOUBLES,
     .presence = FIELD_REQUIRED,
     AT(SplineKey, value),
     .columns = FUNCTION_WIDTH},
    {.name = "second", .type = FIELD_DOUBLES, AT(SplineKey, second), .columns = FUNCTION_WIDTH},
    END,
};
static void default_key(void *out) { *(SplineKey *)out = (SplineKey){0}; }
static const Record KEY = {NULL, KEY_FIELDS, sizeof(SplineKey), default_key, NULL};

// ORDER spline_kind
static const char *const SPLINE_KIND_NAMES[] = {"linear", "quadratic", "cubic", "natural", NULL};

static const Field SPLINE_FIELDS[] = {
    {.name = "kind",
     .type = FIELD_ENUM,
     .presence = FIELD_ALWAYS,
     AT(Spline, kind),
     .names = SPLINE_KIND_NAMES},
    {.name = "width", .type = FIELD_INT, AT(Spline, width)},
    {.name = "keys",
     .type = FIELD_RECORDS,
     AT(Spline, keys),
     .link = offsetof(Spline, key_count),
     .record = &KEY},
    END,
};
static void default_spline(void *out) { *(Spline *)out = (Spline){.width = 2}; }
static const Record SPLINE = {NULL, SPLINE_FIELDS, sizeof(Spline), default_spline, NULL};

// ORDER function_type
static const char *const FUNCTION_TYPE_NAMES[] = {"formula",   "pigment", "pattern",
                                                  "transform", "spline",  NULL};

static const Field FUNCTION_FIELDS[] = {
    {.name = "type",
     .type = FIELD_ENUM,
     .presence = FIELD_ALWAYS,
     AT(Function, type),
     .names = FUNCTION_TYPE_NAMES},
    {.name = "parameters", .type = FIELD_INT, AT(Function, parameters), .kinds = OF(FORMULA)},
    {.name = "registers",
     .type = FIELD_INT,
     .presence = FIELD_REQUIRED,
     AT(Function, registers),
     .kinds = OF(FORMULA)},
    {.name = "stack",
     .type = FIELD_INT,
     .presence = FIELD_REQUIRED,
     AT(Function, stack),
     .kinds = OF(FORMULA)},
    {.name = "steps",
     .type = FIELD_RECORDS,
     AT(Function, steps),
     .link = offsetof(Function, step_count),
     .record = &STEP,
     .kinds = OF(FORMULA)},
    {.name = "pigment",
     .type = FIELD_INDEX,
     .presence = FIELD_REQUIRED,
     AT(Function, pigment),
     .kinds = OF(PIGMENT) | OF(PATTERN)},
    {.name = "transform",
     .type = FIELD_TRANSFORM,
     .presence = FIELD_REQUIRED,
     AT(Function, transform),
     .kinds = OF(TRANSFORM)},
    {.name = "spline",
     .type = FIELD_RECORD,
     .presence = FIELD_REQUIRED,
     AT(Function, spline),
     .record = &SPLINE,
     .kinds = OF(SPLINE)},
    END,
};
static void set_default(void *out) { *(Function *)out = function_default(FUNCTION_FORMULA); }
static void set_kind_default(void *out) {
    *(Function *)out = function_default(((Function *)out)->type);
}
const Record FUNCTION_RECORD = {NULL, FUNCTION_FIELDS, sizeof(Function), set_default,
                                set_kind_default};
