// SPDX-License-Identifier: MIT
// A compiled user function, between its compiler (function_parse.c) and its machine (function.c).
#ifndef CONVERTER_FUNCTION_H
#define CONVERTER_FUNCTION_H

#include "converter/language.h"

typedef enum {
    OP_CONSTANT, // push value
    OP_ARGUMENT, // push argument i
    OP_LOCAL,    // push the running index of sum or prod number i
    OP_NEGATE,
    OP_ADD,
    OP_SUBTRACT,
    OP_MULTIPLY,
    OP_DIVIDE,
    OP_EQUAL,
    OP_NOT_EQUAL,
    OP_LESS,
    OP_LESS_EQUAL,
    OP_GREATER,
    OP_GREATER_EQUAL,
    OP_AND,
    OP_OR,
    OP_CALL1, // C function of one
    OP_CALL2, // C function of two
    OP_SELECT3,
    OP_SELECT4,
    OP_USER, // other function; i: the component taken
    OP_SUM,  // from, to on the stack; the next `length` instructions are the term
    OP_PRODUCT,
} Op;

typedef struct {
    Op op;
    int i;
    size_t length;
    double value;
    union {
        double (*one)(double);
        double (*two)(double, double);
        const Function *user;
    };
} Instruction;

typedef enum {
    BODY_FORMULA,
    BODY_INTERNAL,
    BODY_TRANSFORM,
    BODY_SPLINE,
    BODY_PIGMENT,
    BODY_PATTERN
} BodyKind;

struct Function {
    Loc loc; // of its body
    BodyKind kind;
    int parameter_count;
    LIST(Instruction) code;
    int depth, max_depth; // of the stack; depth is used while compiling
    int calls;            // how deep calls of other functions nest
    int locals;
    int internal;
    const Spline *spline;
    Value value; // of transform and pigment bodies
};

enum { MAX_STACK = 2048, MAX_LOCALS = 16, MAX_CALL_DEPTH = 200 };

#endif
