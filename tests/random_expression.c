// SPDX-License-Identifier: MIT
#include "random_expression.h"

#include <stdbool.h>
#include <string.h>

typedef struct {
    FILE *out;
    Rng *rng;
    int series; // running indices that are visible
} Gen;

static unsigned below(Gen *g, unsigned count) { return (unsigned)(rng_next(g->rng) % count); }
static bool chance(Gen *g, unsigned percent) { return below(g, 100) < percent; }

static void put(Gen *g, const char *text) { fputs(text, g->out); }

#define PICK(g, ...)                                                                               \
    pick((g), (const char *const[]){__VA_ARGS__},                                                  \
         sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *))
static const char *pick(Gen *g, const char *const *words, size_t count) {
    return words[below(g, (unsigned)count)];
}

// pattern: text; '%' stands for what `part` writes.
static void fill(Gen *g, const char *pattern, void (*part)(Gen *, int), int depth) {
    for (; *pattern; pattern++) {
        if (*pattern == '%')
            part(g, depth);
        else
            fputc(*pattern, g->out);
    }
}

static void number(Gen *g) {
    if (chance(g, 20))
        fprintf(g->out, "%.3f", rng_range(g->rng, 0, 9));
    else
        put(g, PICK(g, "0", "1", "2", "3", "0.5", "1e-11", "7", "2.5e3", "0.1", "K", "pi", "Neg"));
}

// ---- expressions ------------------------------------------------------------------------------

static void add(Gen *g, int depth, int width);
static void full(Gen *g, int depth, int width);

static void add_float(Gen *g, int depth) { add(g, depth, 1); }
static void add_vector(Gen *g, int depth) { add(g, depth, 3); }
static void full_float(Gen *g, int depth) { full(g, depth, 1); }

static void leaf(Gen *g, int width) {
    if (width == 1 || chance(g, 40)) {
        number(g);
        return;
    }
    switch (width) {
    case 2:
        put(g, PICK(g, "UV", "u", "v"));
        break;
    case 3:
        put(g, PICK(g, "V", "x", "y", "z"));
        break;
    case 4:
        put(g, PICK(g, "V4", "t"));
        break;
    default:
        put(g, "C");
    }
}

static void literal(Gen *g, int depth, int width) {
    put(g, "<");
    for (int i = 0; i < width; i++) {
        put(g, i ? "," : "");
        add(g, depth, 1);
    }
    put(g, ">");
}

static void float_call(Gen *g, int depth) {
    switch (below(g, 6)) {
    case 0:
    case 1:
        put(g, PICK(g, "abs", "ceil", "floor", "cos", "sin", "tan", "exp", "sinh", "cosh", "tanh",
                    "asinh", "atan", "int", "degrees", "radians"));
        fill(g, "(%)", full_float, depth);
        break;
    case 2:
        put(g, PICK(g, "min", "max", "bitwise_and", "bitwise_or", "bitwise_xor"));
        fill(g, PICK(g, "(%)", "(%,%)", "(%,%,%)"), add_float, depth);
        break;
    case 3:
        fill(g,
             PICK(g, "select(%,%,%)", "select(%,%,%,%)", "atan2(%,1+abs(%))", "mod(%,1+%)",
                  "div(%,2+%)", "pow(2+abs(%),mod(%,3))"),
             add_float, depth);
        break;
    case 4:
        fill(g, PICK(g, "vdot(%,%)", "vlength(%-%)", "(V*0+(%)).y", "(V*0+(%)).x"), add_vector,
             depth);
        break;
    default:
        put(g, PICK(g, "strcmp(\"ab\",\"b\")", "strlen(\"abc\")", "asc(\"z\")", "val(\"1.5e2\")",
                    "V.x", "C.gray", "V.v"));
    }
}

static void atom(Gen *g, int depth, int width) {
    if (depth <= 0 || chance(g, 30)) {
        leaf(g, width);
    } else if (chance(g, 25)) {
        put(g, "(");
        full(g, depth - 1, width);
        put(g, ")");
    } else if (width > 1 && chance(g, 40)) {
        literal(g, depth - 2, width);
    } else if (width == 3 && chance(g, 50)) {
        fill(g, PICK(g, "vcross(%,%)", "vrotate(%,%)", "vaxis_rotate(%,<1,2,3>,30)"), add_vector,
             depth - 1);
    } else {
        float_call(g, depth - 1);
    }
}

static void factor(Gen *g, int depth, int width) {
    put(g, chance(g, 20) ? PICK(g, "-", "+", "!") : "");
    atom(g, depth, width);
}

static void term(Gen *g, int depth, int width) {
    factor(g, depth, width);
    for (unsigned n = below(g, 3); n > 1; n--) {
        if (chance(g, 66)) {
            put(g, "*");
            factor(g, depth - 1, chance(g, 33) ? 1 : width);
        } else {
            fill(g, "/(2+abs(%))", add_float, depth - 1);
        }
    }
}

static void add(Gen *g, int depth, int width) {
    if (depth < -1) {
        number(g);
        return;
    }
    term(g, depth, width);
    for (unsigned n = below(g, 4); n > 1; n--) {
        put(g, PICK(g, " + ", " - "));
        term(g, depth - 1, chance(g, 33) ? 1 : width);
    }
}

static void relation(Gen *g, int depth, int width) {
    add(g, depth, width);
    if (width > 1 || !chance(g, 25))
        return;
    put(g, PICK(g, " < ", " > ", " <= ", " >= ", " = ", " != "));
    add(g, depth - 1, width);
}

static void full(Gen *g, int depth, int width) {
    if (chance(g, 10)) {
        put(g, "(");
        relation(g, depth - 1, 1);
        put(g, ") ? ");
        add(g, depth - 1, width);
        put(g, " : ");
        add(g, depth - 1, width);
        return;
    }
    relation(g, depth, width);
    if (width > 1 || !chance(g, 15))
        return;
    put(g, PICK(g, " & ", " | "));
    relation(g, depth - 1, width);
}

static const char PRELUDE[] = "#version 3.7; global_settings { assumed_gamma 1 }\n"
                              "#declare K = 2.5; #declare Neg = -3; #declare UV = <0.25, 3>;\n"
                              "#declare V = <1, -2, 0.3>; #declare V4 = <1, 2, 3, 4>;\n"
                              "#declare C = rgbft <0.1, 0.7, 0.3, 0.5, 0.25>;\n";

void random_expressions(FILE *out, Rng *rng, int count) {
    static const char *const members[] = {"x", "y", "z", "t", "transmit"};
    static const char *const ones[] = {"1", "<1,1>", "<1,1,1>", "<1,1,1,1>", "<1,1,1,1,1>"};
    Gen g = {.out = out, .rng = rng};
    put(&g, PRELUDE);
    for (int i = 0; i < count; i++) {
        int width = 1 + (int)below(&g, 5);
        put(&g, "#declare R = (");
        full(&g, 3, width);
        fprintf(out, ") * %s;\n", ones[width - 1]);
        for (int k = 0; k < width; k++)
            fprintf(out, "#debug concat(\"@%d.%d \", str(R%s%s, 0, 17), \"\\n\")\n", i, k,
                    width > 1 ? "." : "", width > 1 ? members[k] : "");
    }
    put(&g, "sphere { 0, 1 }\n");
}

// ---- functions --------------------------------------------------------------------------------

static void body(Gen *g, int depth);

static void series(Gen *g, int depth) {
    int index = g->series++;
    fprintf(g->out, "%s(i%d,%d,%d,", PICK(g, "sum", "prod"), index, (int)below(g, 4) - 1,
            1 + (int)below(g, 4));
    body(g, depth);
    put(g, ")");
    g->series--;
}

static void call(Gen *g, int depth) {
    switch (below(g, 6)) {
    case 0:
        put(g, PICK(g, "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh",
                    "acosh", "atanh", "abs", "radians", "degrees", "int", "floor", "ceil", "sqrt",
                    "exp"));
        fill(g, "(%)", body, depth);
        break;
    case 1:
        fill(g,
             PICK(g, "ln(1+abs(%))", "log(1+abs(%))", "min(%,%)", "max(%,%,%)", "atan2(%,%)",
                  "mod(%,%)", "div(%,%)"),
             body, depth);
        break;
    case 2:
        fill(g, "pow(%,", body, depth);
        if (chance(g, 60))
            fprintf(g->out, "%d)", (int)below(g, 11) - 1);
        else
            fill(g, "%)", body, depth);
        break;
    case 3:
        fill(g, PICK(g, "select(%,%,%)", "select(%,%,%,%)", "G(%,%)", "G(%,%)"), body, depth);
        break;
    case 4:
        fill(g, PICK(g, "T(%,%,%).x", "T(%,%,%).z", "S(%).u", "S(%).y"), body, depth);
        break;
    default:
        series(g, depth - 1);
    }
}

static void primary(Gen *g, int depth) {
    if (chance(g, 14))
        put(g, PICK(g, "-", "+", "-"));
    if (depth > 0 && chance(g, 55)) {
        if (chance(g, 30))
            fill(g, "(%)", body, depth - 1);
        else
            call(g, depth - 1);
    } else if (chance(g, 60)) {
        number(g);
    } else if (g->series > 0 && chance(g, 40)) {
        fprintf(g->out, "i%d", (int)below(g, (unsigned)g->series));
    } else {
        put(g, PICK(g, "x", "y", "a"));
    }
}

static void body(Gen *g, int depth) {
    primary(g, depth);
    for (unsigned n = below(g, 4); n > 0; n--) {
        const char *op = PICK(g, " + ", " - ", " * ", " / ", " + ", " - ", " * ", " / ", " < ",
                              " > ", " <= ", " >= ", " = ", " != ", " & ", " | ");
        put(g, op);
        if (strcmp(op, " / ") != 0)
            primary(g, depth - 1);
        else if (chance(g, 50))
            fill(g, "(%)", body, depth - 1);
        else
            put(g, PICK(g, "3", "0.7", "x", "K", "G(a,1)"));
    }
}

void random_functions(FILE *out, Rng *rng, int count) {
    Gen g = {.out = out, .rng = rng};
    put(&g, PRELUDE);
    put(&g, "#declare G = function(x, y) { x*3 + y - 0.3 }\n"
            "#declare T = function { transform { rotate <10, 20, 30> translate 3*x } }\n"
            "#declare S = function { spline { 0, <1, 2>, 1, <3, 5>, 2.5, <-1, 0> } }\n");
    for (int i = 0; i < count; i++) {
        fprintf(out, "#declare f%d = function(x, y, a) { ", i);
        body(&g, 3);
        put(&g, " }\n");
        for (int k = 0; k < 2; k++)
            fprintf(out, "#debug concat(\"@%d.%d \", str(f%d(%.3f, %s, %s), 0, 17), \"\\n\")\n", i,
                    k, i, rng_range(rng, -3, 3), PICK(&g, "0", "1", "-2", "0.7"),
                    PICK(&g, "0", "5", "-0.25"));
    }
    put(&g, "sphere { 0, 1 }\n");
}
