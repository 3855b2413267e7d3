// SPDX-License-Identifier: MIT
// A short way for what programs are full of: sums and products of floats, conditions on them,
// literal vectors. It reads the tokens of the frame as they stand and either ends with the value
// that expr.c would give, or touches nothing and says so: at a macro, a directive, a value of
// another type, a warning that is due, anything it does not know. Nothing it evaluates has effects.
#include "converter/language.h"

#include <math.h>

typedef struct {
    Converter *cv;
    const Token *at, *start, *end;
} Quick;

enum { QUICK_DEPTH = 40 }; // parentheses inside one another

static bool quick_full(Quick *q, double *out, int depth);
static bool quick_add(Quick *q, double *out, int depth);

static int code_at(const Quick *q) { return q->at < q->end ? q->at->code : TOK_EOF; }

static bool take(Quick *q, int code) {
    if (code_at(q) != code)
        return false;
    q->at++;
    return true;
}

// From the next token on; false: it came from elsewhere, or was read while directives were held.
static bool begin(Converter *cv, Quick *q) {
    const Language *l = cv->language;
    const Frame *f = cv->frame;
    *q = (Quick){.cv = cv, .at = f->tokens + f->at, .end = f->tokens + f->count};
    if (l->ahead) {
        if (f->at == 0 || l->ahead != q->at - 1 || l->ahead_raw)
            return false;
        q->at--;
    }
    q->start = q->at;
    return cv->version >= 150;
}

static void finish(const Quick *q) {
    Language *l = q->cv->language;
    Frame *f = q->cv->frame;
    uint64_t taken = (uint64_t)(q->at - q->start);
    uint64_t fresh = taken - (l->ahead != NULL); // that one was counted when it was read
    l->ahead = NULL;
    l->last = q->at - 1;
    l->consumed += taken;
    f->at = (size_t)(q->at - f->tokens);
    if (fresh > 0) {
        check_limits(q->cv, fresh);
        l->read += fresh - 1;
        count_token(q->cv);
    }
}

// ---- floats -----------------------------------------------------------------------------------

// [ ADD ] ...: the element; NULL: not the short way.
static Value *quick_element(Quick *q, const Array *array, int depth) {
    size_t index = 0;
    for (int d = 0; d < array->dimensions; d++) {
        double v;
        if (!take(q, '[') || !quick_add(q, &v, depth - 1) || !take(q, ']') || !(v >= -EPSILON) ||
            v + EPSILON >= (double)array->sizes[d])
            return NULL;
        index = index * array->sizes[d] + (size_t)(v + EPSILON);
    }
    return &array->items[index];
}

// The value that a name, with its subscripts, stands for.
static Value *quick_place(Quick *q, Symbol **symbol, Array **array, int depth) {
    *symbol = name_symbol(q->cv, q->at++->name);
    *array = NULL;
    if (!*symbol)
        return NULL;
    Value *value = (*symbol)->target ? (*symbol)->target : &(*symbol)->value;
    while (value && value->type == VALUE_ARRAY && code_at(q) == '[') {
        *array = value->node;
        value = quick_element(q, *array, depth);
    }
    return value;
}

static bool quick_call(Quick *q, double *out, int depth) {
    static const struct {
        int code;
        double (*of)(double);
    } calls[] = {{KW_sin, sin},   {KW_cos, cos}, {KW_abs, fabs}, {KW_sqrt, sqrt}, {KW_floor, floor},
                 {KW_ceil, ceil}, {KW_exp, exp}, {KW_tan, tan},  {KW_atan, atan}};
    int code = q->at++->code;
    double v;
    if (code == KW_pi) {
        *out = M_PI;
        return true;
    }
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        if (calls[i].code != code)
            continue;
        if (!take(q, '(') || !quick_full(q, &v, depth - 1) || !take(q, ')') ||
            (code == KW_sqrt && !(v >= 0)))
            return false;
        *out = calls[i].of(v);
        return true;
    }
    return false;
}

static bool quick_atom(Quick *q, double *out, int depth) {
    Symbol *symbol;
    Array *array;
    const Value *value;
    switch (code_at(q)) {
    case TOK_NUMBER:
        *out = q->at++->number;
        break;
    case TOK_IDENTIFIER:
        value = quick_place(q, &symbol, &array, depth);
        if (!value || value->type != VALUE_FLOAT || symbol->deprecated)
            return false;
        *out = value->c[0];
        break;
    case '(':
        q->at++;
        if (!quick_full(q, out, depth - 1) || !take(q, ')'))
            return false;
        break;
    default:
        if (code_at(q) < KW_FIRST || !quick_call(q, out, depth))
            return false;
    }
    return code_at(q) != '.' && code_at(q) != '[';
}

static bool quick_factor(Quick *q, double *out, int depth) {
    if (take(q, '-')) {
        if (depth <= 0 || !quick_factor(q, out, depth - 1))
            return false;
        *out = -*out;
        return true;
    }
    return depth > 0 && quick_atom(q, out, depth);
}

static bool quick_term(Quick *q, double *out, int depth) {
    if (!quick_factor(q, out, depth))
        return false;
    for (int code; code = code_at(q), code == '*' || code == '/';) {
        double other;
        q->at++;
        if (!quick_factor(q, &other, depth) || (code == '/' && other == 0))
            return false;
        *out = code == '*' ? *out * other : *out / other;
    }
    return true;
}

static bool quick_add(Quick *q, double *out, int depth) {
    if (!quick_term(q, out, depth))
        return false;
    for (int code; code = code_at(q), code == '+' || code == '-';) {
        double other;
        q->at++;
        if (!quick_term(q, &other, depth))
            return false;
        *out = code == '+' ? *out + other : *out - other;
    }
    return true;
}

static bool quick_relation(Quick *q, double *out, int depth) {
    if (!quick_add(q, out, depth))
        return false;
    for (int code; is_comparison(code = code_at(q));) {
        double other;
        q->at++;
        if (!quick_add(q, &other, depth))
            return false;
        *out = compare_floats(code, *out, other);
    }
    return true;
}

static bool quick_full(Quick *q, double *out, int depth) {
    if (!quick_relation(q, out, depth))
        return false;
    for (int code; code = code_at(q), code == '&' || code == '|';) {
        double other;
        q->at++;
        if (!quick_relation(q, &other, depth))
            return false;
        bool a = is_true(*out), b = is_true(other);
        *out = code == '&' ? a && b : a || b;
    }
    return code_at(q) != '?';
}

// ---- what is asked for ------------------------------------------------------------------------

// Could the token behind a sum continue it? Macros and directives could bring anything.
static bool ends_sum(const Quick *q) {
    int code = code_at(q);
    switch (code) {
    case ',':
    case ';':
    case ')':
    case ']':
    case '{':
    case '}':
    case '<':
    case '>':
    case TOK_NUMBER:
        return true;
    default:
        return code >= KW_FIRST;
    }
}

bool quick_float(Converter *cv, double *out) {
    Quick q;
    if (!begin(cv, &q) || !quick_add(&q, out, QUICK_DEPTH) || !ends_sum(&q))
        return false;
    finish(&q);
    return true;
}

bool quick_vector(Converter *cv, double out[3]) {
    Quick q;
    if (!begin(cv, &q) || !take(&q, '<'))
        return false;
    for (int i = 0; i < 3; i++) {
        if (!quick_add(&q, &out[i], QUICK_DEPTH) || !take(&q, i < 2 ? ',' : '>'))
            return false;
    }
    if (!ends_sum(&q))
        return false;
    finish(&q);
    return true;
}

bool quick_condition(Converter *cv, double *out) {
    Quick q;
    if (!begin(cv, &q) || !take(&q, '(') || !quick_full(&q, out, QUICK_DEPTH) || !take(&q, ')'))
        return false;
    finish(&q);
    return true;
}

bool quick_declare(Converter *cv, bool local) {
    Quick q;
    Symbol *symbol;
    Array *array;
    double v;
    if (!begin(cv, &q) || code_at(&q) != TOK_IDENTIFIER)
        return false;
    Value *value = quick_place(&q, &symbol, &array, QUICK_DEPTH);
    bool known = value && (value->type == VALUE_FLOAT ||
                           (value->type == VALUE_NONE && array && array->type == VALUE_FLOAT));
    if (!known || (local && symbol->scope != scope_level(cv)) || !take(&q, '=') ||
        !quick_add(&q, &v, QUICK_DEPTH) || !take(&q, ';') || code_at(&q) == ';')
        return false;
    *value = (Value){.type = VALUE_FLOAT, .c = {v}};
    finish(&q);
    return true;
}
