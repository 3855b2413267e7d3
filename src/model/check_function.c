// SPDX-License-Identifier: MIT
// A program from a file may hold anything. Read once from front to back, with the set of registers
// written so far: jumps lead forward, so that the set at a step is what all the ways to it have in
// common. The one way back, from the end of a loop to its start, must come with at least the set
// that the loop began with; how often it is taken the machine counts.
#include "model/check.h"
#include "model/scene_format.h"

#include <math.h>
#include <string.h>

enum { W = 1, A = 2, B = 4, V = 8, J = 16 };

static const unsigned char uses[] = {
#define X(op, name, use) use,
    FUNCTION_OPS(X)
#undef X
};

enum { SET_WORDS = FUNCTION_MAX_STACK / 64 };
typedef struct {
    uint64_t words[SET_WORDS];
} Set;

typedef struct {
    const Check *check;
    const Function *function;
    const FieldPath *path;
    uint32_t at;  // the step
    Set written;  // before it
    bool reached; // can the step be reached at all?
    Set **before; // per step: what jumps to it have in common, or NULL
    int stack;    // that calls need
    int level;
} Walk;

#define refuse_step(w, name, ...)                                                                  \
    do {                                                                                           \
        const FieldPath step_path = path_item((w)->path, "steps", (w)->at);                        \
        const FieldPath field_path = path_field(&step_path, name);                                 \
        path_die((w)->check->file, &field_path, __VA_ARGS__);                                      \
    } while (0)

static bool set_has(const Set *set, int i) { return set->words[i / 64] >> (i % 64) & 1; }
static void set_add(Set *set, int i) { set->words[i / 64] |= UINT64_C(1) << (i % 64); }

static void check_register(const Walk *w, const char *name, int i) {
    if (i < 0 || i >= w->function->registers)
        refuse_step(w, name, "%d, but the function has %d registers", i, w->function->registers);
}

static void check_read(const Walk *w, const char *name, int i) {
    check_register(w, name, i);
    if (w->reached && !set_has(&w->written, i))
        refuse_step(w, name, "register %d is read before it is written", i);
}

static void check_write(Walk *w, int i) {
    check_register(w, "to", i);
    set_add(&w->written, i);
}

// A jump forward to step b.
static void check_jump(Walk *w, int b) {
    if (b <= (int64_t)w->at || (uint32_t)b >= w->function->step_count)
        refuse_step(w, "b", "step %d is not one of the later steps", b);
    if (!w->reached)
        return;
    Set **before = &w->before[b];
    if (!*before) {
        *before = ARENA_NEW(w->check->scratch, Set);
        **before = w->written;
        return;
    }
    for (int i = 0; i < SET_WORDS; i++)
        (*before)->words[i] &= w->written.words[i];
}

// The set at a step: what comes from the step before and from jumps have in common.
static void enter_step(Walk *w) {
    const Set *before = w->before[w->at];
    if (before && w->reached) {
        for (int i = 0; i < SET_WORDS; i++)
            w->written.words[i] &= before->words[i];
    } else if (before) {
        w->written = *before;
        w->reached = true;
    }
}

static void check_next(const Walk *w, const FunctionStep *step) {
    const FunctionStep *start = w->function->steps + (step->b < 0 ? 0 : step->b);
    if (step->b < 0 || step->b >= (int64_t)w->at || start->op != FUNCTION_WHILE ||
        start->a != step->a)
        refuse_step(w, "b", "step %d is not the start of this loop", step->b);
    // enter_step has left the set of the start there.
    for (int i = 0; w->reached && i < SET_WORDS; i++)
        if (w->before[step->b]->words[i] & ~w->written.words[i])
            refuse_step(w, "b", "the loop begins with registers that are not written here");
}

static void check_arguments(const Walk *w, int first, int count) {
    for (int i = 0; i < count; i++)
        check_read(w, "b", first > INT32_MAX - i ? -1 : first + i);
}

static void check_call(Walk *w, const FunctionStep *step, uint32_t index) {
    if (step->a < 0 || (uint32_t)step->a >= index)
        refuse_step(w, "a", "function %d is not one of those before this one", step->a);
    const Function *callee = &w->check->scene->functions[step->a];
    check_arguments(w, step->b, callee->parameters);
    bool vector = step->op == FUNCTION_CALL_VECTOR;
    if (vector == (callee->type == FUNCTION_FORMULA || callee->type == FUNCTION_PATTERN))
        refuse_step(w, "a", "function %d gives %s", step->a,
                    vector ? "one number" : "several numbers");
    for (int i = 0; i < (vector ? FUNCTION_WIDTH : 1); i++)
        check_write(w, step->to > INT32_MAX - i ? -1 : step->to + i);
    if (step->b + callee->stack > w->stack)
        w->stack = step->b + callee->stack;
    if (w->check->calls[step->a] >= w->level)
        w->level = w->check->calls[step->a] + 1;
    if (w->level > FUNCTION_MAX_CALLS)
        refuse_step(w, "a", "more than %d levels of calls", FUNCTION_MAX_CALLS);
}

static void check_step(Walk *w, uint32_t index) {
    const FunctionStep *step = &w->function->steps[w->at];
    if ((int)step->op < 0 || step->op >= FUNCTION_OP_COUNT)
        refuse_step(w, "op", "unknown operation %d", (int)step->op);
    enter_step(w);
    unsigned use = uses[step->op];
    if (use & V && !isfinite(step->value))
        refuse_step(w, "value", "%g is not a finite number", step->value);
    if (use & A)
        check_read(w, "a", step->a);
    if (use & B)
        check_read(w, "b", step->b);
    switch (step->op) {
    case FUNCTION_WHILE:
        check_read(w, "a", step->a + 1); // a is a register, so this does not overflow
        if (w->reached && !w->before[w->at])
            w->before[w->at] = ARENA_NEW(w->check->scratch, Set);
        if (w->reached)
            *w->before[w->at] = w->written;
        check_jump(w, step->b);
        break;
    case FUNCTION_NEXT:
        check_next(w, step);
        w->reached = false;
        break;
    case FUNCTION_CALL:
    case FUNCTION_CALL_VECTOR:
        check_call(w, step, index);
        break;
    case FUNCTION_INTERNAL:
        if (function_internal_arguments(step->a) == 0)
            refuse_step(w, "a", "internal(%d) does not exist", step->a);
        check_arguments(w, step->b, function_internal_arguments(step->a));
        check_write(w, step->to);
        break;
    case FUNCTION_RETURN:
        w->reached = false;
        break;
    default:
        if (use & J)
            check_jump(w, step->b);
        if (step->op == FUNCTION_JUMP)
            w->reached = false;
        if (use & W)
            check_write(w, step->to);
    }
}

static void check_formula(const Check *c, const FieldPath *path, uint32_t index) {
    const Function *f = &c->scene->functions[index];
    const FieldPath steps = path_field(path, "steps");
    check_range(c, path, "registers", f->registers, f->parameters, FUNCTION_MAX_STACK);
    if (f->step_count == 0 || f->step_count > INT32_MAX ||
        f->steps[f->step_count - 1].op != FUNCTION_RETURN)
        refuse(c, &steps, "the last step is not 'return'");
    Walk w = {.check = c, .function = f, .path = path, .reached = true, .stack = f->registers};
    w.before = ARENA_ARRAY(c->scratch, Set *, f->step_count);
    for (int i = 0; i < f->parameters; i++)
        set_add(&w.written, i);
    for (; w.at < f->step_count; w.at++)
        check_step(&w, index);
    check_range(c, path, "stack", f->stack, w.stack, FUNCTION_MAX_STACK);
    c->calls[index] = (uint8_t)w.level;
}

static void check_spline(const Check *c, const FieldPath *path, const Spline *s) {
    const FieldPath keys = path_field(path, "keys");
    check_range(c, path, "kind", (int)s->kind, SPLINE_LINEAR, SPLINE_NATURAL);
    check_range(c, path, "width", s->width, 2, FUNCTION_WIDTH);
    if (s->key_count == 0)
        refuse(c, &keys, "it has no keys");
    for (uint32_t i = 0; i < s->key_count; i++) {
        const FieldPath key = path_item(path, "keys", i);
        const SplineKey *k = &s->keys[i];
        bool finite = isfinite(k->at);
        for (int j = 0; j < FUNCTION_WIDTH; j++)
            finite = finite && isfinite(k->value[j]) && isfinite(k->second[j]);
        if (!finite)
            refuse(c, &key, "it is not finite");
        if (i > 0 && !(k->at > k[-1].at))
            refuse(c, &key, "%g is not after the key before", k->at);
    }
}

static void check_function(const Check *c, uint32_t index) {
    const FieldPath path = path_item(NULL, "functions", index);
    const FieldPath pigment = path_field(&path, "pigment"), spline = path_field(&path, "spline");
    const Function *f = &c->scene->functions[index];
    int least = f->type == FUNCTION_FORMULA || f->type == FUNCTION_SPLINE ? 1 : 3;
    check_range(c, &path, "type", (int)f->type, FUNCTION_FORMULA, FUNCTION_SPLINE);
    check_range(c, &path, "parameters", f->parameters, least,
                f->type == FUNCTION_FORMULA ? FUNCTION_MAX_PARAMETERS : least);
    switch (f->type) {
    case FUNCTION_FORMULA:
        check_formula(c, &path, index);
        return;
    case FUNCTION_PIGMENT:
    case FUNCTION_PATTERN:
        check_index(c, &pigment, f->pigment, c->scene->pigment_count, "pigment");
        PatternType type = c->scene->pigments[f->pigment].pattern.type;
        if (f->type == FUNCTION_PATTERN && (type == PATTERN_PLAIN || type == PATTERN_AVERAGE))
            refuse(c, &pigment, "its pattern has no value");
        break;
    case FUNCTION_TRANSFORM:
        check_transform(c, &path, "transform", &f->transform);
        break;
    case FUNCTION_SPLINE:
        check_spline(c, &spline, &f->spline);
        break;
    }
    check_range(c, &path, "stack", f->stack, 0, FUNCTION_MAX_STACK);
}

void check_functions(const Check *c) {
    for (uint32_t i = 0; i < c->scene->function_count; i++)
        check_function(c, i);
}

// What the steps of a formula call. The cost of a function is that of the pigments it asks.
static void check_callees(const Check *c, const FieldPath *path, uint32_t index, int depth) {
    const Function *f = &c->scene->functions[index];
    for (uint32_t i = 0; i < f->step_count; i++) {
        if (f->steps[i].op != FUNCTION_CALL && f->steps[i].op != FUNCTION_CALL_VECTOR)
            continue;
        uint32_t callee = (uint32_t)f->steps[i].a;
        check_nest(&c->functions, index, check_function_use(c, path, callee, depth));
        c->functions.cost[index] += c->functions.cost[callee];
    }
}

uint8_t check_function_use(const Check *c, const FieldPath *path, uint32_t index, int depth) {
    static const double MOST = 1e5;
    check_index(c, path, index, c->scene->function_count, "function");
    const Function *f = &c->scene->functions[index];
    uint8_t *met = &c->functions.met[index];
    if (*met == 2)
        return c->functions.nesting[index];
    if (*met == 1)
        refuse(c, path, "function %u is part of itself", index);
    if (depth > SCENE_MAX_DEPTH)
        refuse(c, path, "more than %d pigments inside one another", SCENE_MAX_DEPTH);
    *met = 1;
    if (f->type == FUNCTION_FORMULA)
        check_callees(c, path, index, depth);
    if (f->type == FUNCTION_PIGMENT || f->type == FUNCTION_PATTERN) {
        check_pigment(c, path, f->pigment, depth + 1);
        check_nest(&c->functions, index, (uint8_t)(c->pigments.nesting[f->pigment] + 1));
        c->functions.cost[index] = c->pigments.cost[f->pigment];
    }
    if (c->functions.nesting[index] > FUNCTION_MAX_NESTING)
        refuse(c, path, "more than %d functions inside one another's pigments",
               FUNCTION_MAX_NESTING);
    if (c->functions.cost[index] > MOST)
        refuse(c, path, "%g evaluations of pigments at each point are more than %g",
               c->functions.cost[index], MOST);
    *met = 2;
    return c->functions.nesting[index];
}

void check_function_uses(const Check *c) {
    for (uint32_t i = 0; i < c->scene->function_count; i++) {
        const FieldPath path = path_item(NULL, "functions", i);
        check_function_use(c, &path, i, 0);
    }
}
