// SPDX-License-Identifier: MIT
// Evaluates user functions: formulas as postfix programs on a stack of doubles, splines and
// transforms by what they are. Pigments, patterns and the built-in internal functions have no value
// here yet; needing one is an error at the function's body.
#include "converter/function.h"

// Instructions of one evaluation.
#ifdef HOSTILE
static const uint64_t MAX_STEPS = 1000000;
#else
static const uint64_t MAX_STEPS = 1000000000;
#endif

int function_parameter_count(const Function *f) { return f->parameter_count; }

int function_width(const Function *f) {
    double e[5];
    switch (f->kind) {
    case BODY_TRANSFORM:
        return 3;
    case BODY_SPLINE:
        return spline_evaluate(f->spline, SPLINE_LINEAR, 0, e);
    case BODY_PIGMENT:
        return 5;
    default:
        return 1;
    }
}

typedef struct {
    const Function *f;
    const double *arguments;
    double locals[MAX_LOCALS];
    double *stack;
    uint64_t *steps; // left for the whole evaluation
} Machine;

static size_t run(Machine *m, size_t from, size_t to, size_t top);

static size_t run_series(Machine *m, size_t at, size_t top) {
    const Instruction *in = &m->f->code.items[at];
    double low = m->stack[top - 2], high = m->stack[top - 1], all = in->op == OP_SUM ? 0 : 1;
    for (double i = low; i <= high; i++) {
        m->locals[in->i] = i;
        run(m, at + 1, at + 1 + in->length, top);
        all = in->op == OP_SUM ? all + m->stack[top] : all * m->stack[top];
    }
    m->stack[top - 2] = all;
    return top - 1;
}

static void evaluate_body(const Function *f, const double *arguments, uint64_t *steps, double e[5]);

static size_t run_user(Machine *m, const Instruction *in, size_t top) {
    size_t first = top - (size_t)in->user->parameter_count;
    double e[5] = {0};
    evaluate_body(in->user, m->stack + first, m->steps, e);
    // Component -1 is the grey of a colour.
    m->stack[first] = in->i < 0 ? 0.297 * e[0] + 0.589 * e[1] + 0.114 * e[2] : e[in->i];
    return first + 1;
}

static double binary(Op op, double a, double b) {
    switch (op) {
    case OP_ADD:
        return a + b;
    case OP_SUBTRACT:
        return a - b;
    case OP_MULTIPLY:
        return a * b;
    case OP_DIVIDE:
        return a / b;
    case OP_EQUAL:
        return a == b;
    case OP_NOT_EQUAL:
        return a != b;
    case OP_LESS:
        return a < b;
    case OP_LESS_EQUAL:
        return a <= b;
    case OP_GREATER:
        return a > b;
    case OP_GREATER_EQUAL:
        return a >= b;
    case OP_AND:
        return a != 0 && b != 0;
    default:
        return a != 0 || b != 0;
    }
}

// Runs the instructions [from, to); the stack has `top` values. Returns its new height.
static size_t run(Machine *m, size_t from, size_t to, size_t top) {
    double *s = m->stack;
    for (size_t at = from; at < to; at++) {
        const Instruction *in = &m->f->code.items[at];
        if (--*m->steps == 0)
            die_at(&m->f->loc, "The evaluation of this function has run too long");
        switch (in->op) {
        case OP_CONSTANT:
            s[top++] = in->value;
            break;
        case OP_ARGUMENT:
            s[top++] = m->arguments[in->i];
            break;
        case OP_LOCAL:
            s[top++] = m->locals[in->i];
            break;
        case OP_NEGATE:
            s[top - 1] = -s[top - 1];
            break;
        case OP_CALL1:
            s[top - 1] = in->one(s[top - 1]);
            break;
        case OP_CALL2:
            top--;
            s[top - 1] = in->two(s[top - 1], s[top]);
            break;
        case OP_SELECT3:
            top -= 2;
            s[top - 1] = s[top - 1] < 0 ? s[top] : s[top + 1];
            break;
        case OP_SELECT4:
            top -= 3;
            s[top - 1] = s[top - 1] < 0 ? s[top] : s[top - 1] > 0 ? s[top + 2] : s[top + 1];
            break;
        case OP_USER:
            top = run_user(m, in, top);
            break;
        case OP_SUM:
        case OP_PRODUCT:
            top = run_series(m, at, top);
            at += in->length;
            break;
        default:
            top--;
            s[top - 1] = binary(in->op, s[top - 1], s[top]);
        }
    }
    return top;
}

static double evaluate_formula(const Function *f, const double *arguments, uint64_t *steps) {
    double small[64], *stack = small;
    Arena *arena = NULL;
    if (f->max_depth + 2 > (int)(sizeof small / sizeof *small)) {
        arena = arena_create();
        stack = ARENA_ARRAY(arena, double, (size_t)f->max_depth + 2);
    }
    Machine m = {.f = f, .arguments = arguments, .stack = stack, .steps = steps};
    run(&m, 0, f->code.count, 0);
    double result = stack[0];
    arena_destroy(arena);
    return result;
}

static void evaluate_body(const Function *f, const double *arguments, uint64_t *steps,
                          double e[5]) {
    switch (f->kind) {
    case BODY_FORMULA:
        e[0] = evaluate_formula(f, arguments, steps);
        return;
    case BODY_SPLINE:
        spline_evaluate(f->spline, spline_kind(f->spline), arguments[0], e);
        return;
    case BODY_TRANSFORM: {
        const Transform *t = f->value.node;
        Vec3 p = transform_point(t, vec3(arguments[0], arguments[1], arguments[2]));
        e[0] = p.x;
        e[1] = p.y;
        e[2] = p.z;
        return;
    }
    case BODY_INTERNAL:
        die_at(&f->loc,
               "The value of the built-in function internal(%d) is needed to read this "
               "scene, and is not modelled yet",
               f->internal);
    default:
        die_at(&f->loc, "The value of this pigment or pattern is needed to read this scene, and is "
                        "not modelled yet");
    }
}

void function_evaluate_vector(const Function *f, const double *arguments, double e[5]) {
    uint64_t steps = MAX_STEPS;
    evaluate_body(f, arguments, &steps, e);
}

double function_evaluate(const Function *f, const double *arguments) {
    double e[5] = {0};
    function_evaluate_vector(f, arguments, e);
    return e[0];
}
