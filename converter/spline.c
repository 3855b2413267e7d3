// SPDX-License-Identifier: MIT
// Splines as they are written (facts: sdl 2.8); src/function/spline.c evaluates them.
#include "converter/language.h"
#include "function/function.h"

#include <string.h>

bool accept_spline_kind(Converter *cv, SplineKind *kind) {
    static const int codes[] = {KW_linear_spline, KW_quadratic_spline, KW_cubic_spline,
                                KW_natural_spline}; // ORDER SplineKind
    for (int i = 0; i < 4; i++) {
        if (accept(cv, codes[i])) {
            *kind = (SplineKind)i;
            return true;
        }
    }
    return false;
}

typedef LIST(SplineKey) Keys;

// Keeps the keys sorted; an equal key takes the new value, but not the last one.
static void insert_key(Converter *cv, Keys *keys, const SplineKey *key) {
    size_t i = keys->count;
    if (i > 0 && key->at == keys->items[i - 1].at)
        return;
    while (i > 0 && keys->items[i - 1].at > key->at)
        i--;
    if (i > 0 && keys->items[i - 1].at == key->at) {
        keys->items[i - 1] = *key;
        return;
    }
    list_push(cv, keys, *key);
    SplineKey *items = keys->items;
    memmove(&items[i + 1], &items[i], (keys->count - 1 - i) * sizeof *items);
    items[i] = *key;
}

// { [SPLINE] [kind] F [,] V [,] ... }
Spline *parse_spline(Converter *cv) {
    expect(cv, '{', "spline");
    Spline *s = ARENA_NEW(cv->arena, Spline);
    Keys keys = {0};
    s->width = 2;
    const Value *base = accept_value(cv, VALUE_SPLINE);
    if (base) {
        const Spline *old = base->node;
        s->kind = old->kind;
        s->width = old->width;
        for (size_t i = 0; i < old->key_count; i++)
            list_push(cv, &keys, old->keys[i]);
    }
    accept_spline_kind(cv, &s->kind);
    // The components that a value does not give stay those of the value before, as in POV-Ray.
    SplineKey key = {0};
    while (starts_expression(cv)) {
        key.at = parse_float(cv);
        optional_comma(cv);
        int width = parse_full(cv, key.value, 2);
        s->width = width > s->width ? width : s->width;
        optional_comma(cv);
        insert_key(cv, &keys, &key);
    }
    if (!keys.count)
        die_expected(cv, "at least one key of the spline");
    expect(cv, '}', "spline");
    s->keys = keys.items;
    s->key_count = (uint32_t)keys.count;
    spline_prepare(s, ARENA_ARRAY(cv->arena, double, 2 * keys.count));
    return s;
}
