// SPDX-License-Identifier: MIT
// Numeric expressions of one to five components (facts: sdl 2.1, 2.2).
//
//   FULL   := LOGIC [ '?' FULL ':' FULL ]
//   LOGIC  := REL { ('&' | '|') REL }                 one precedence, left to right
//   REL    := STRING op STRING | ADD { op ADD }       op: < <= = != >= >
//   ADD    := TERM { ('+' | '-') TERM }
//   TERM   := FACTOR { ('*' | '/') FACTOR }
//   FACTOR := { '+' } ('-' | '!') FACTOR | ATOM [ '.' member ]
//
// Every level fills e and returns how many components it has. `want` is how many the place expects:
// a literal is repeated into that many at once. A member access sets only e[0]; where it starts a
// sum, the other components stay behind it, as in POV-Ray.
#include "converter/language.h"
#include "function/function.h"

#include <math.h>
#include <string.h>

static void promote(double e[5], int *width, int to) {
    if (*width >= to)
        return;
    for (int i = *width; i < to; i++)
        e[i] = *width == 1 ? e[0] : 0;
    *width = to;
}

static const char *width_name(int width) {
    return value_type_name((ValueType)(VALUE_FLOAT + width - 1));
}

bool starts_expression(Converter *cv) {
    int code = peek_token(cv)->code;
    switch (code) {
    case TOK_NUMBER:
    case '+':
    case '-':
    case '!':
    case '(':
    case '<':
        return true;
    case TOK_IDENTIFIER: {
        ValueType type = peek_value_type(cv);
        return value_width(type) || type == VALUE_FUNCTION || type == VALUE_SPLINE;
    }
    default:
        return is_number_keyword(code) || is_vector_keyword(code);
    }
}

// ---- atoms ------------------------------------------------------------------------------------

// '<' F [,] F [,] [F [,] [F [,] [F]]] '>'
static int vector_literal(Converter *cv, double e[5]) {
    int width = 0;
    do {
        e[width++] = parse_float(cv);
        optional_comma(cv);
    } while (width < 2 || (width < 5 && starts_expression(cv)));
    expect(cv, '>', "vector");
    return width;
}

static int fill(double e[5], double value, int want) {
    for (int i = 0; i < want; i++)
        e[i] = value;
    return want;
}

// After the function's name: ( F [,] F ... )
static int function_call(Converter *cv, const UserFunction *f, double e[5], int want) {
    double arguments[FUNCTION_MAX_PARAMETERS];
    int count = user_function_parameters(cv, f);
    expect(cv, '(', "function call");
    for (int i = 0; i < count; i++) {
        if (next_is(cv, ')')) {
            Loc loc = here(cv);
            die_at(&loc, "This function takes %d arguments, only %d found", count, i);
        }
        arguments[i] = parse_float(cv);
        optional_comma(cv);
    }
    expect(cv, ')', "function call");
    double value[5] = {0};
    int width = user_function_evaluate(cv, f, arguments, value);
    if (width == 1)
        return fill(e, value[0], want);
    memcpy(e, value, sizeof *e * (size_t)width);
    return width;
}

// After the spline's name: ( F [, kind] )
static int spline_call(Converter *cv, const Spline *s, double e[5]) {
    expect(cv, '(', "spline call");
    double at = parse_float(cv);
    SplineKind kind = s->kind;
    if (accept(cv, ',') && !accept_spline_kind(cv, &kind))
        die_expected(cv, "linear_spline, quadratic_spline, cubic_spline or natural_spline");
    expect(cv, ')', "spline call");
    spline_value(s, kind, at, e);
    return s->width;
}

static int identifier(Converter *cv, double e[5], int want) {
    const Place *place = ahead_place(cv);
    ValueType type = place ? place->value->type : VALUE_NONE;
    int width = value_width(type);
    if (!place || (!width && type != VALUE_FUNCTION && type != VALUE_SPLINE))
        die_expected(cv, "numeric expression");
    const Value *value = place->value;
    void *node = value->node;
    next_token(cv);
    if (type == VALUE_FUNCTION)
        return function_call(cv, node, e, want);
    if (type == VALUE_SPLINE)
        return spline_call(cv, node, e);
    if (width == 1)
        return fill(e, value->c[0], want);
    memcpy(e, value->c, sizeof(double) * (size_t)width);
    return width;
}

static int axis(double e[5], int width, int one) {
    fill(e, 0, width);
    e[one] = 1;
    return width;
}

static int atom(Converter *cv, double e[5], int want) {
    const Token *token = peek_token(cv);
    int width = want;
    switch (token->code) {
    case TOK_NUMBER:
        next_token(cv);
        return fill(e, token->number, want);
    case TOK_IDENTIFIER:
        return identifier(cv, e, want);
    case '(':
        next_token(cv);
        width = parse_full(cv, e, want);
        expect(cv, ')', "expression");
        return width;
    case '<':
        next_token(cv);
        return vector_literal(cv, e);
    case KW_x:
    case KW_y:
    case KW_z:
        next_token(cv);
        return axis(e, 3, token->code == KW_x ? 0 : token->code == KW_y ? 1 : 2);
    case KW_u:
    case KW_v:
        next_token(cv);
        return axis(e, 2, token->code == KW_u ? 0 : 1);
    case KW_t:
        next_token(cv);
        return axis(e, 4, 3);
    default:
        if (!parse_call(cv, e, &width, want))
            die_expected(cv, "numeric expression");
        return width;
    }
}

// After '.': which component, -1 for gray.
static int member_index(Converter *cv) {
    const Token *token = peek_token(cv);
    switch (token->code) {
    case KW_x:
    case KW_u:
    case KW_red:
        return 0;
    case KW_y:
    case KW_v:
    case KW_green:
        return 1;
    case KW_z:
    case KW_blue:
        return 2;
    case KW_t:
    case KW_filter:
        return 3;
    case KW_transmit:
        return 4;
    case KW_gray:
        return -1;
    default:
        die_expected(cv, "x, y, z, u, v, t or a color component after '.'");
    }
}

static int member(Converter *cv, double e[5], int width) {
    int index = member_index(cv);
    const Token *token = next_token(cv);
    if (index < 0) {
        for (int i = width; i < 3; i++)
            e[i] = 0;
        e[0] = 0.297 * e[0] + 0.589 * e[1] + 0.114 * e[2];
        return 1;
    }
    if (index >= width) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "Bad operands for period operator: the value has only %d component%s", width,
               width == 1 ? "" : "s");
    }
    e[0] = e[index];
    return 1;
}

// ---- operators --------------------------------------------------------------------------------

static int factor(Converter *cv, double e[5], int want) {
    enter_level(cv);
    bool held = release_directives(cv);
    while (accept(cv, '+'))
        continue;
    int code = peek_token(cv)->code, width;
    if (code == '-' || code == '!') {
        next_token(cv);
        restore_directives(cv, held);
        width = factor(cv, e, want);
        for (int i = 0; i < width; i++)
            e[i] = code == '-' ? -e[i] : is_true(e[i]) ? 0 : 1;
    } else {
        width = atom(cv, e, want);
        restore_directives(cv, held);
    }
    if (accept(cv, '.'))
        width = member(cv, e, width);
    leave_level(cv);
    return width;
}

static void match(double a[5], int *wa, double b[5], int *wb) {
    promote(a, wa, *wb);
    promote(b, wb, *wa);
}

static void divide(Converter *cv, double e[5], const double by[5], int width) {
    for (int i = 0; i < width; i++) {
        if (by[i] == 0) {
            Loc loc = token_loc(cv, cv->language->last);
            warn_at(&loc, "Divide by zero: the result is infinite");
            e[i] = HUGE_VAL;
        } else {
            e[i] /= by[i];
        }
    }
}

static int term(Converter *cv, double e[5], int want) {
    int width = factor(cv, e, want), other_width = width;
    double other[5] = {0};
    for (int code; code = peek_token(cv)->code, code == '*' || code == '/';) {
        next_token(cv);
        other_width = factor(cv, other, other_width);
        match(e, &width, other, &other_width);
        if (code == '/') {
            divide(cv, e, other, width);
        } else {
            for (int i = 0; i < width; i++)
                e[i] *= other[i];
        }
    }
    return width;
}

int parse_add(Converter *cv, double e[5], int want) {
    if (cv->version < 150)
        return factor(cv, e, want);
    int width = term(cv, e, want), other_width = width;
    double other[5] = {0};
    for (int code; code = peek_token(cv)->code, code == '+' || code == '-';) {
        next_token(cv);
        other_width = term(cv, other, other_width);
        match(e, &width, other, &other_width);
        for (int i = 0; i < width; i++)
            e[i] = code == '+' ? e[i] + other[i] : e[i] - other[i];
    }
    return width;
}

bool is_comparison(int code) {
    return code == '<' || code == '>' || code == '=' || code == TOK_LE || code == TOK_GE ||
           code == TOK_NE;
}

// Exact for < and >, with EPSILON for the others.
bool compare_floats(int code, double a, double b) {
    bool equal = !is_true(a - b);
    switch (code) {
    case '<':
        return a < b;
    case '>':
        return a > b;
    case TOK_LE:
        return a <= b || equal;
    case TOK_GE:
        return a >= b || equal;
    case '=':
        return equal;
    default:
        return is_true(a - b);
    }
}

// STRING op STRING: not to be continued.
static int string_relation(Converter *cv, double e[5], int want) {
    const char *a = parse_string(cv);
    int code = peek_token(cv)->code;
    if (!is_comparison(code))
        die_expected(cv, "string comparison operator");
    next_token(cv);
    int order = string_compare(a, parse_string(cv));
    return fill(e, compare_floats(code, order, 0), want);
}

static int relation(Converter *cv, double e[5], int want) {
    bool held = release_directives(cv);
    bool string = starts_string(cv);
    if (string) {
        int width = string_relation(cv, e, want);
        restore_directives(cv, held);
        return width;
    }
    restore_directives(cv, held);
    int width = parse_add(cv, e, want), other_width = width;
    double other[5] = {0};
    for (int code; is_comparison(code = peek_token(cv)->code);) {
        next_token(cv);
        other_width = parse_add(cv, other, other_width);
        promote(e, &width, other_width);
        for (int i = 0; i < width; i++)
            e[i] = compare_floats(code, e[i], other[i]);
    }
    return width;
}

static int logic(Converter *cv, double e[5], int want) {
    int width = relation(cv, e, want), other_width = width;
    double other[5] = {0};
    for (int code; code = peek_token(cv)->code, code == '&' || code == '|';) {
        next_token(cv);
        other_width = relation(cv, other, other_width);
        promote(e, &width, other_width);
        for (int i = 0; i < width; i++) {
            bool a = is_true(e[i]), b = is_true(other[i]);
            e[i] = code == '&' ? a && b : a || b;
        }
    }
    return width;
}

int parse_full(Converter *cv, double e[5], int want) {
    enter_level(cv);
    int width = logic(cv, e, 1);
    if (!next_is(cv, '?')) {
        promote(e, &width, want);
        leave_level(cv);
        return width;
    }
    const Token *question = next_token(cv);
    if (width != 1) {
        Loc loc = token_loc(cv, question);
        die_at(&loc, "Conditional must evaluate to a float: what stands before '?' is a %s",
               width_name(width));
    }
    double yes[5] = {0}, no[5] = {0};
    int yes_width = parse_full(cv, yes, want);
    expect(cv, ':', "conditional expression");
    int no_width = parse_full(cv, no, want);
    bool chosen = is_true(e[0]);
    memcpy(e, chosen ? yes : no, sizeof yes);
    leave_level(cv);
    return chosen ? yes_width : no_width;
}

// ---- the places of the statements -------------------------------------------------------------

_Noreturn static void die_width(Converter *cv, const Token *start, int want, int width) {
    static const char *const wanted[] = {"Float", "UV vector", "Vector", "4d vector"};
    Loc loc = token_loc(cv, start);
    die_at(&loc, "%s expected but %s expression found", wanted[want - 1], width_name(width));
}

double parse_float(Converter *cv) {
    double e[5] = {0};
    if (quick_float(cv, e))
        return e[0];
    const Token *start = peek_token(cv);
    int width = parse_add(cv, e, 1);
    if (width > 1)
        die_width(cv, start, 1, width);
    return e[0];
}

double parse_full_float(Converter *cv) {
    double e[5] = {0};
    const Token *start = peek_token(cv);
    int width = parse_full(cv, e, 1);
    if (width > 1)
        die_width(cv, start, 1, width);
    return e[0];
}

static void parse_components(Converter *cv, double e[5], int want) {
    const Token *start = peek_token(cv);
    int width = parse_add(cv, e, want);
    if (width > want)
        die_width(cv, start, want, width);
}

Vec2 parse_uv(Converter *cv) {
    double e[5] = {0};
    parse_components(cv, e, 2);
    return (Vec2){e[0], e[1]};
}

Vec3 parse_vector(Converter *cv) {
    double e[5] = {0};
    if (quick_vector(cv, e))
        return vec3(e[0], e[1], e[2]);
    parse_components(cv, e, 3);
    return vec3(e[0], e[1], e[2]);
}

void parse_vector4(Converter *cv, double out[4]) {
    double e[5] = {0};
    parse_components(cv, e, 4);
    memcpy(out, e, 4 * sizeof *out);
}

bool parse_optional_bool(Converter *cv) {
    return starts_expression(cv) ? parse_float(cv) > 0 : true;
}
