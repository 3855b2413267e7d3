// SPDX-License-Identifier: MIT
// Constants of function bodies, folded as POV-Ray folds them. That shows in the last bit (x + 1 + 2
// becomes x + 3, x / 3 a product), and sometimes in all of them: in a chain of operators of one
// precedence two constants side by side are taken together by the operator between them, whatever
// stands before. x - 2*3 - 1 becomes x - 5 so, f(1)/2*3 becomes f(1)/6, and 5 < x < 1 + 2 = 3 is
// no chain of comparisons. Only a product after something variable is left alone. What stands in
// parentheses is never folded with its neighbours, and of a call only the first argument is folded
// at all.
#include "converter/function.h"

static void make_constant(Expr *e, double value) {
    e->kind = EXPR_CONSTANT;
    e->number = value;
    e->child = NULL;
    e->first = NULL;
}

// Of two constants; false: not folded.
static bool folded(FunctionOp op, double a, double b, double *value) {
    switch (op) {
    case FUNCTION_EQUAL:
        *value = a == b;
        return true;
    case FUNCTION_NOT_EQUAL:
        *value = a != b;
        return true;
    case FUNCTION_LESS:
        *value = a < b;
        return true;
    case FUNCTION_LESS_EQUAL:
        *value = a <= b;
        return true;
    case FUNCTION_GREATER:
        *value = a > b;
        return true;
    case FUNCTION_GREATER_EQUAL:
        *value = a >= b;
        return true;
    case FUNCTION_ADD:
        *value = a + b;
        return true;
    case FUNCTION_SUBTRACT:
        *value = a - b;
        return true;
    case FUNCTION_MULTIPLY:
        *value = a * b;
        return true;
    case FUNCTION_DIVIDE:
        *value = a / b;
        return true;
    case FUNCTION_AND:
        *value = a != 0 && b != 0;
        return true;
    case FUNCTION_OR:
        *value = a != 0 || b != 0;
        return true;
    case FUNCTION_POW:
        *value = pow(a, b);
        return true;
    default:
        return false;
    }
}

static void fold_chain(Converter *cv, Expr *chain) {
    function_fold(cv, chain->first->operand);
    bool variable = chain->first->operand->variable;
    for (Link *before = chain->first, *link; (link = before->next);) {
        Expr *left = before->operand, *right = link->operand;
        if (link->op == FUNCTION_SUBTRACT && right->kind == EXPR_CONSTANT) {
            link->op = FUNCTION_ADD;
            right->number = -right->number;
        }
        function_fold(cv, right);
        bool product = link->op == FUNCTION_MULTIPLY || link->op == FUNCTION_DIVIDE;
        double value;
        if (left->kind == EXPR_CONSTANT && right->kind == EXPR_CONSTANT && !(product && variable) &&
            folded(link->op, left->number, right->number, &value)) {
            left->number = value;
            before->next = link->next;
        } else {
            variable = variable || right->variable;
            before = link;
        }
    }
    if (!chain->first->next && chain->first->operand->kind == EXPR_CONSTANT)
        make_constant(chain, chain->first->operand->number);
}

// pow(A, B) becomes a chain of its own in parentheses; further arguments are ignored.
static void fold_power(Converter *cv, Expr *call) {
    Expr *chain = ARENA_NEW(cv->arena, Expr);
    Link *links = ARENA_ARRAY(cv->arena, Link, 2);
    *chain = (Expr){.kind = EXPR_CHAIN, .variable = call->variable, .first = links};
    links[0].operand = call->child;
    if (call->child->next) {
        links[0].next = &links[1];
        links[1] = (Link){.op = FUNCTION_POW, .operand = call->child->next};
    }
    call->kind = EXPR_GROUP;
    call->child = chain;
    fold_chain(cv, chain);
}

void function_fold(Converter *cv, Expr *e) {
    switch (e->kind) {
    case EXPR_GROUP:
    case EXPR_USER:
        function_fold(cv, e->child);
        break;
    case EXPR_NEGATE:
        function_fold(cv, e->child);
        if (e->child->kind == EXPR_CONSTANT)
            make_constant(e, -e->child->number);
        break;
    case EXPR_CHAIN:
        fold_chain(cv, e);
        break;
    case EXPR_CALL:
        if (e->code == KW_pow)
            fold_power(cv, e);
        else if (e->code != KW_sum && e->code != KW_prod)
            function_fold(cv, e->child);
        break;
    case EXPR_CONSTANT:
    case EXPR_PARAMETER:
    case EXPR_ABSENT:
    case EXPR_LOCAL:
        break;
    }
}
