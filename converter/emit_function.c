// SPDX-License-Identifier: MIT
// Functions that the final scene uses, with all that they call, into its pool. The converter's list
// has them in the order of their declaration, so that what is called comes first there too.
#include "converter/emit.h"

#include "converter/language.h"

#include <string.h>

// Where the language's function number i went; NO_INDEX: nowhere yet.
static uint32_t *place_of(Emitter *e, uint32_t i) {
    size_t count = e->cv->language->functions.count;
    if (!e->function_index) {
        e->function_index = ARENA_ARRAY(e->cv->arena, uint32_t, count);
        memset(e->function_index, 0xFF, count * sizeof *e->function_index); // NO_INDEX each
    }
    return &e->function_index[i];
}

static uint32_t emit_number(Emitter *e, uint32_t number) {
    uint32_t *place = place_of(e, number);
    if (*place != NO_INDEX)
        return *place;
    Function f = e->cv->language->functions.items[number];
    FunctionStep *steps = ARENA_ARRAY(e->cv->arena, FunctionStep, f.step_count);
    for (uint32_t i = 0; i < f.step_count; i++) {
        steps[i] = f.steps[i];
        if (steps[i].op == FUNCTION_CALL || steps[i].op == FUNCTION_CALL_VECTOR)
            steps[i].a = (int)emit_number(e, (uint32_t)steps[i].a);
    }
    f.steps = steps;
    if (f.type == FUNCTION_PIGMENT || f.type == FUNCTION_PATTERN)
        f.pigment = emit_pigment(e, e->cv->language->function_pigments.items[f.pigment].node);
    array_push(&e->functions, f);
    *place = (uint32_t)(e->functions.count - 1);
    return *place;
}

uint32_t emit_function(Emitter *e, const UserFunction *function) {
    return emit_number(e, user_function_number(function));
}
