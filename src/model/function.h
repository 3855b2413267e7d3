// SPDX-License-Identifier: MIT
// User functions as the scene holds them: a formula compiled to a program for registers of doubles,
// or what POV-Ray lets stand for one (a pigment, a pattern, a transform, a spline). src/function/
// runs them. Function i calls only functions before it, so that no call leads back to itself.
#ifndef MODEL_FUNCTION_H
#define MODEL_FUNCTION_H

#include "base/vec.h"

#include <stdint.h>

enum {
    FUNCTION_MAX_PARAMETERS = 256,
    FUNCTION_MAX_STACK = 2048,   // registers of a function and all that it calls
    FUNCTION_MAX_CALLS = 200,    // levels of calls
    FUNCTION_MAX_NESTING = 32,   // functions inside the pigments that functions ask
    FUNCTION_WIDTH = 5,          // of a colour, the widest value
    FUNCTION_INTERNAL_COUNT = 79 // numbers of internal()
};

// The operations and how they use the members of FunctionStep: W writes register `to`, A and B read
// registers `a` and `b`, V uses `value`, J: `b` is the number of the step that comes next (later
// ones only, but for `next`). The names stand in the scene file.
#define FUNCTION_OPS(X)                                                                            \
    X(CONSTANT, "constant", W | V)                                                                 \
    X(MOVE, "move", W | A)                                                                         \
    X(NEGATE, "negate", W | A)                                                                     \
    X(ADD, "add", W | A | B)                                                                       \
    X(SUBTRACT, "subtract", W | A | B)                                                             \
    X(MULTIPLY, "multiply", W | A | B)                                                             \
    X(DIVIDE, "divide", W | A | B)                                                                 \
    X(ADD_VALUE, "add_value", W | A | V)                                                           \
    X(MULTIPLY_VALUE, "multiply_value", W | A | V)                                                 \
    X(VALUE_SUBTRACT, "value_subtract", W | A | V) /* value - a */                                 \
    X(VALUE_DIVIDE, "value_divide", W | A | V)     /* value / a */                                 \
    X(EQUAL, "equal", W | A | B) /* exact; NaN is larger than all, as in POV-Ray */                \
    X(NOT_EQUAL, "not_equal", W | A | B)                                                           \
    X(LESS, "less", W | A | B)                                                                     \
    X(LESS_EQUAL, "less_equal", W | A | B)                                                         \
    X(GREATER, "greater", W | A | B)                                                               \
    X(GREATER_EQUAL, "greater_equal", W | A | B)                                                   \
    X(AND, "and", W | A | B)                                                                       \
    X(OR, "or", W | A | B)                                                                         \
    X(SIN, "sin", W | A)                                                                           \
    X(COS, "cos", W | A)                                                                           \
    X(TAN, "tan", W | A)                                                                           \
    X(ASIN, "asin", W | A)                                                                         \
    X(ACOS, "acos", W | A)                                                                         \
    X(ATAN, "atan", W | A)                                                                         \
    X(SINH, "sinh", W | A)                                                                         \
    X(COSH, "cosh", W | A)                                                                         \
    X(TANH, "tanh", W | A)                                                                         \
    X(ASINH, "asinh", W | A)                                                                       \
    X(ACOSH, "acosh", W | A)                                                                       \
    X(ATANH, "atanh", W | A)                                                                       \
    X(ABS, "abs", W | A)                                                                           \
    X(FLOOR, "floor", W | A)                                                                       \
    X(CEIL, "ceil", W | A)                                                                         \
    X(INT, "int", W | A)                                                                           \
    X(SQRT, "sqrt", W | A)                                                                         \
    X(EXP, "exp", W | A)                                                                           \
    X(LN, "ln", W | A)                                                                             \
    X(LOG, "log", W | A)                                                                           \
    X(POW, "pow", W | A | B)                                                                       \
    X(ATAN2, "atan2", W | A | B)                                                                   \
    X(MOD, "mod", W | A | B)                                                                       \
    X(DIV, "div", W | A | B)                                                                       \
    X(MIN, "min", W | A | B)                                                                       \
    X(MAX, "max", W | A | B)                                                                       \
    X(JUMP, "jump", J)                                                                             \
    X(JUMP_NEGATIVE, "jump_negative", A | J) /* if a < 0 */                                        \
    X(JUMP_POSITIVE, "jump_positive", A | J) /* unless a <= 0 */                                   \
    X(WHILE, "while", A | J) /* a: the running index, the limit after it; over it: goes to b */    \
    X(NEXT, "next", A | J)   /* a + 1, then back to b */                                           \
    X(CALL, "call", W)       /* function a with the arguments in the registers from b on */        \
    X(CALL_VECTOR, "call_vector", W) /* the same; its components go to `to` and the 4 after it */  \
    X(INTERNAL, "internal", W)       /* built-in function number a; arguments from b on */         \
    X(RETURN, "return", A)

// ORDER function_op
typedef enum {
#define X(op, name, uses) FUNCTION_##op,
    FUNCTION_OPS(X)
#undef X
        FUNCTION_OP_COUNT
} FunctionOp;

typedef struct {
    FunctionOp op;
    int to, a, b;
    double value;
} FunctionStep;

// ORDER spline_kind
typedef enum { SPLINE_LINEAR, SPLINE_QUADRATIC, SPLINE_CUBIC, SPLINE_NATURAL } SplineKind;

typedef struct {
    double at, value[5];
    double second[5]; // natural: the second derivative here
} SplineKey;

typedef struct {
    SplineKind kind;
    int width;       // components of its value: 2 to 5
    SplineKey *keys; // ascending; never empty
    uint32_t key_count;
} Spline;

// ORDER function_type
typedef enum {
    FUNCTION_FORMULA,   // of `parameters`, to one number
    FUNCTION_PIGMENT,   // of x, y, z, to a colour
    FUNCTION_PATTERN,   // of x, y, z, to the value of the pigment's pattern
    FUNCTION_TRANSFORM, // of x, y, z, to a point
    FUNCTION_SPLINE,    // of one, to the spline's value
} FunctionType;

typedef struct {
    FunctionType type;
    int parameters;      // how many; they are the first registers
    int registers;       // formulas: how many its program uses
    int stack;           // and with those of what it calls
    FunctionStep *steps; // the last one is a `return`
    uint32_t step_count;
    uint32_t pigment; // of the scene
    Transform transform;
    Spline spline;
} Function;

Function function_default(FunctionType type);
// How many arguments internal(number) takes; 0: there is none of that number.
int function_internal_arguments(int number);
// How many numbers the function gives.
int function_width(const Function *function);

#endif
