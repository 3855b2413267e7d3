// SPDX-License-Identifier: MIT
// User functions between their stages: function_parse.c reads a body into a tree, function_fold.c
// folds its constants, function_compile.c makes the program that src/function/ runs; function.c
// keeps what is declared and evaluates it while the scene is read.
#ifndef CONVERTER_FUNCTION_H
#define CONVERTER_FUNCTION_H

#include "converter/language.h"
#include "function/function.h"

struct PatternNode;

struct UserFunction {
    Loc loc;        // of its body
    uint32_t index; // in Language.functions
    int calls;      // levels of calls in it
};

typedef enum {
    EXPR_CONSTANT,
    EXPR_PARAMETER, // register `index`
    EXPR_ABSENT,    // x, y or z that is no parameter: 0
    EXPR_LOCAL,     // the running index of sum or prod number `index`
    EXPR_GROUP,     // ( child )
    EXPR_NEGATE,    // - child
    EXPR_CHAIN,     // operands of one precedence
    EXPR_CALL,      // of the keyword `code`
    EXPR_USER,      // of a user function
} ExprKind;

typedef struct Expr Expr;

typedef struct Link {
    FunctionOp op; // from the operand before to this one; not of the first
    Expr *operand;
    struct Link *next;
} Link;

struct Expr {
    ExprKind kind;
    bool variable; // is there anything but constants in it?
    int code, index;
    double number;
    Expr *child; // a call's first argument
    Expr *next;  // the next argument
    Link *first;
    const UserFunction *user;
    int member;         // of a function of several components: which one is taken
    const Token *token; // of a call
};

// Members of a colour that are sums of its components.
enum { MEMBER_GRAY = -1, MEMBER_HEIGHT = -2 };
enum { MAX_SERIES = 16 }; // sum and prod inside one another

// What is known while a function is read.
typedef struct {
    Converter *cv;
    int parameter_count;
    int codes[FUNCTION_MAX_PARAMETERS]; // TOK_IDENTIFIER or KW_x and its like
    uint32_t names[FUNCTION_MAX_PARAMETERS];
    uint32_t series_names[MAX_SERIES];
    int series_count; // that are visible
    Loc loc;
} FunctionReader;

Expr *function_parse_body(FunctionReader *reader);
// As POV-Ray folds them (see there), not as mathematics would.
void function_fold(Converter *cv, Expr *e);
// The program of a formula, in *out; also its levels of calls.
int function_compile(const FunctionReader *reader, const Expr *body, Function *out);

#endif
