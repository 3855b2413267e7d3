// SPDX-License-Identifier: MIT
// The machine: one switch over the steps of a program, the registers of a function and of all that
// it calls in one array (a called function's registers begin at its arguments, as Lua's do). The
// sizes are known before: see model/function_check.c.
#include "function/function.h"
#include "function/internal.h"

#include <limits.h>
#include <math.h>

typedef struct {
    const FunctionPool *pool;
    uint64_t *budget;
} Machine;

// ---- operations ---------------------------------------------------------------------------------

// POV-Ray compares into two flags, less and equal; NaN sets neither and so is greater than all.
static double greater(double a, double b) { return !(a < b) && !(a == b); }
static double greater_equal(double a, double b) { return !(a < b); }

// POV-Ray's (int): what does not fit becomes INT_MIN.
static double whole(double v) {
    return v > -2147483649.0 && v < 2147483648.0 ? trunc(v) + 0.0 : INT_MIN;
}

// POV-Ray keeps the last minimum unless it is greater.
static double minimum(double last, double next) { return greater(last, next) ? next : last; }

static double run(const Machine *m, const Function *f, double *r);

static void run_vector(const Machine *m, uint32_t index, const double *r,
                       double out[FUNCTION_WIDTH]) {
    const Function *f = &m->pool->functions[index];
    for (int i = 0; i < FUNCTION_WIDTH; i++)
        out[i] = 0.0;
    if (f->type == FUNCTION_SPLINE) {
        spline_value(&f->spline, f->spline.kind, r[0], out);
        for (int i = f->spline.width; i < FUNCTION_WIDTH; i++)
            out[i] = 0.0;
        return;
    }
    Vec3 p = vec3(r[0], r[1], r[2]);
    if (f->type == FUNCTION_PIGMENT) {
        m->pool->hooks->pigment(m->pool->world, f->pigment, p, out);
        return;
    }
    p = transform_point(&f->transform, p);
    out[0] = p.x;
    out[1] = p.y;
    out[2] = p.z;
}

static double run_pattern(const Machine *m, const Function *f, const double *r) {
    return m->pool->hooks->pattern(m->pool->world, f->pigment, vec3(r[0], r[1], r[2]));
}

static bool may_go_on(const Machine *m) {
    if (*m->budget == 0)
        return false;
    --*m->budget;
    return true;
}

static double run_call(const Machine *m, const FunctionStep *s, double *r) {
    const Function *f = &m->pool->functions[s->a];
    if (!may_go_on(m))
        return NAN;
    return f->type == FUNCTION_FORMULA ? run(m, f, r + s->b) : run_pattern(m, f, r + s->b);
}

static double run_internal(const Machine *m, const FunctionStep *s, const double *r) {
    const InternalContext context = {m->pool->noise_generator, m->budget};
    return INTERNAL_FUNCTIONS[s->a](r + s->b, &context);
}

// ---- the loop -----------------------------------------------------------------------------------

#define OP1(name, value)                                                                           \
    case FUNCTION_##name: {                                                                        \
        const double a = r[s->a];                                                                  \
        r[s->to] = (value);                                                                        \
        break;                                                                                     \
    }
#define OP2(name, value)                                                                           \
    case FUNCTION_##name: {                                                                        \
        const double a = r[s->a], b = r[s->b];                                                     \
        r[s->to] = (value);                                                                        \
        break;                                                                                     \
    }

static double run(const Machine *m, const Function *f, double *r) {
    const FunctionStep *const steps = f->steps;
    for (const FunctionStep *s = steps;; s++) {
        switch (s->op) {
        case FUNCTION_CONSTANT:
            r[s->to] = s->value;
            break;
            OP1(MOVE, a)
            OP1(NEGATE, -a)
            OP2(ADD, a + b)
            OP2(SUBTRACT, a - b)
            OP2(MULTIPLY, a * b)
            OP2(DIVIDE, a / b)
            OP1(ADD_VALUE, a + s->value)
            OP1(MULTIPLY_VALUE, a * s->value)
            OP1(VALUE_SUBTRACT, s->value - a)
            OP1(VALUE_DIVIDE, s->value / a)
            OP2(EQUAL, a == b)
            OP2(NOT_EQUAL, a != b)
            OP2(LESS, a < b)
            OP2(LESS_EQUAL, a <= b)
            OP2(GREATER, greater(a, b))
            OP2(GREATER_EQUAL, greater_equal(a, b))
            OP2(AND, a != 0 && b != 0)
            OP2(OR, a != 0 || b != 0)
            OP1(SIN, sin(a))
            OP1(COS, cos(a))
            OP1(TAN, tan(a))
            OP1(ASIN, asin(a))
            OP1(ACOS, acos(a))
            OP1(ATAN, atan(a))
            OP1(SINH, sinh(a))
            OP1(COSH, cosh(a))
            OP1(TANH, tanh(a))
            OP1(ASINH, asinh(a))
            OP1(ACOSH, acosh(a))
            OP1(ATANH, atanh(a))
            OP1(ABS, fabs(a))
            OP1(FLOOR, floor(a))
            OP1(CEIL, ceil(a))
            OP1(INT, whole(a))
            OP1(SQRT, sqrt(a))
            OP1(EXP, exp(a))
            OP1(LN, log(a))
            OP1(LOG, log10(a))
            OP2(POW, pow(a, b))
            OP2(ATAN2, atan2(a, b))
            OP2(MOD, fmod(a, b))
            OP2(DIV, whole(a / b))
            OP2(MIN, minimum(a, b))
            OP2(MAX, b > a ? b : a)
        case FUNCTION_JUMP:
            s = steps + s->b - 1;
            break;
        case FUNCTION_JUMP_NEGATIVE:
            if (r[s->a] < 0)
                s = steps + s->b - 1;
            break;
        case FUNCTION_JUMP_POSITIVE:
            if (greater(r[s->a], 0))
                s = steps + s->b - 1;
            break;
        case FUNCTION_WHILE:
            if (!(r[s->a] <= r[s->a + 1]) || !may_go_on(m))
                s = steps + s->b - 1;
            break;
        case FUNCTION_NEXT:
            r[s->a] += 1.0;
            s = steps + s->b - 1;
            break;
        case FUNCTION_CALL:
            r[s->to] = run_call(m, s, r);
            break;
        case FUNCTION_CALL_VECTOR: {
            double out[FUNCTION_WIDTH];
            run_vector(m, (uint32_t)s->a, r + s->b, out);
            for (int i = 0; i < FUNCTION_WIDTH; i++)
                r[s->to + i] = out[i];
            break;
        }
        case FUNCTION_INTERNAL:
            r[s->to] = run_internal(m, s, r);
            break;
        case FUNCTION_RETURN:
        default:
            return r[s->a];
        }
    }
}

// ---- what is asked for --------------------------------------------------------------------------

static void copy(double *to, const double *from, int count) {
    for (int i = 0; i < count; i++)
        to[i] = from[i];
}

// Two sizes of stack: nearly all functions need little, and to reserve much is slow.
enum { SMALL_STACK = 64 };

static double run_small(const Machine *m, const Function *f, const double *arguments) {
    double r[SMALL_STACK];
    copy(r, arguments, f->parameters);
    return run(m, f, r);
}

__attribute__((noinline)) static double run_large(const Machine *m, const Function *f,
                                                  const double *arguments) {
    double r[FUNCTION_MAX_STACK];
    copy(r, arguments, f->parameters);
    return run(m, f, r);
}

static double value_of(const Machine *m, const Function *f, const double *arguments) {
    if (f->type == FUNCTION_PATTERN)
        return run_pattern(m, f, arguments);
    double value =
        f->stack <= SMALL_STACK ? run_small(m, f, arguments) : run_large(m, f, arguments);
    return *m->budget > 0 ? value : NAN;
}

double function_value(const FunctionPool *pool, uint32_t index, const double *arguments) {
    uint64_t budget = FUNCTION_BUDGET;
    const Machine m = {pool, &budget};
    return value_of(&m, &pool->functions[index], arguments);
}

int function_vector(const FunctionPool *pool, uint32_t index, const double *arguments,
                    double out[FUNCTION_WIDTH], uint64_t *budget) {
    const Machine m = {pool, budget};
    const Function *f = &pool->functions[index];
    if (f->type == FUNCTION_FORMULA || f->type == FUNCTION_PATTERN)
        out[0] = value_of(&m, f, arguments);
    else
        run_vector(&m, index, arguments, out);
    return function_width(f);
}
