// SPDX-License-Identifier: MIT
// Splines (facts: sdl 2.8): keys in ascending order, each with a value of up to five components.
#include "converter/language.h"

#include <string.h>

typedef struct {
    double at, value[5];
    double second[5]; // natural: the second derivative here
} Key;

struct Spline {
    SplineKind kind;
    int width;
    LIST(Key) keys;
};

SplineKind spline_kind(const Spline *s) { return s->kind; }

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

// Keeps the keys sorted; an equal key takes the new value, but not the last one.
static void insert_key(Converter *cv, Spline *s, const Key *key) {
    size_t i = s->keys.count;
    if (i > 0 && key->at == s->keys.items[i - 1].at)
        return;
    while (i > 0 && s->keys.items[i - 1].at > key->at)
        i--;
    if (i > 0 && s->keys.items[i - 1].at == key->at) {
        s->keys.items[i - 1] = *key;
        return;
    }
    list_push(cv, &s->keys, *key);
    Key *items = s->keys.items;
    memmove(&items[i + 1], &items[i], (s->keys.count - 1 - i) * sizeof *items);
    items[i] = *key;
}

// The tridiagonal system of the C2 spline whose second derivatives vanish at both ends.
static void solve_natural(Converter *cv, Spline *s) {
    size_t n = s->keys.count;
    Key *k = s->keys.items;
    if (n < 3)
        return;
    double *diagonal = ARENA_ARRAY(cv->arena, double, n);
    for (int c = 0; c < 5; c++) {
        for (size_t i = 1; i + 1 < n; i++) {
            double h0 = k[i].at - k[i - 1].at, h1 = k[i + 1].at - k[i].at;
            double right = 6 * ((k[i + 1].value[c] - k[i].value[c]) / h1 -
                                (k[i].value[c] - k[i - 1].value[c]) / h0);
            double factor = i > 1 ? h0 / diagonal[i - 1] : 0;
            diagonal[i] = 2 * (h0 + h1) - factor * h0;
            k[i].second[c] = right - factor * k[i - 1].second[c];
        }
        for (size_t i = n - 2; i >= 1; i--) {
            double h1 = k[i + 1].at - k[i].at;
            k[i].second[c] = (k[i].second[c] - h1 * k[i + 1].second[c]) / diagonal[i];
        }
    }
}

// { [SPLINE] [kind] F [,] V [,] ... }
Spline *parse_spline(Converter *cv) {
    expect(cv, '{', "spline");
    Spline *s = ARENA_NEW(cv->arena, Spline);
    s->width = 2;
    const Value *base = accept_value(cv, VALUE_SPLINE);
    if (base) {
        const Spline *old = base->node;
        s->kind = old->kind;
        s->width = old->width;
        for (size_t i = 0; i < old->keys.count; i++)
            list_push(cv, &s->keys, old->keys.items[i]);
    }
    accept_spline_kind(cv, &s->kind);
    while (starts_expression(cv)) {
        Key key = {.at = parse_float(cv)};
        optional_comma(cv);
        int width = parse_full(cv, key.value, 2);
        s->width = width > s->width ? width : s->width;
        optional_comma(cv);
        insert_key(cv, s, &key);
    }
    if (!s->keys.count)
        die_expected(cv, "at least one key of the spline");
    expect(cv, '}', "spline");
    solve_natural(cv, s);
    return s;
}

// ---- evaluation: one component c at t in the segment that ends at key i -----------------------

static double linear(const Key *k, size_t i, int c, double t) {
    double p = (t - k[i - 1].at) / (k[i].at - k[i - 1].at);
    return k[i - 1].value[c] + p * (k[i].value[c] - k[i - 1].value[c]);
}

// The parabola through three keys, in Lagrange's form.
static double quadratic(const Key *k, size_t i, int c, double t) {
    const Key *a = i == 1 ? &k[0] : &k[i - 2], *b = a + 1, *d = a + 2;
    return a->value[c] * (t - b->at) * (t - d->at) / ((a->at - b->at) * (a->at - d->at)) +
           b->value[c] * (t - a->at) * (t - d->at) / ((b->at - a->at) * (b->at - d->at)) +
           d->value[c] * (t - a->at) * (t - b->at) / ((d->at - a->at) * (d->at - b->at));
}

// Hermite's cubic; the tangent at a key is the mean of the slopes on both sides.
static double cubic(const Key *k, size_t i, int c, double t) {
    const Key *a = &k[i - 1], *b = &k[i];
    double h = b->at - a->at, p = (t - a->at) / h;
    double slope = (b->value[c] - a->value[c]) / h;
    double before = (a->value[c] - k[i - 2].value[c]) / (a->at - k[i - 2].at);
    double after = (k[i + 1].value[c] - b->value[c]) / (k[i + 1].at - b->at);
    double ta = (before + slope) / 2 * h, tb = (slope + after) / 2 * h, q = p - 1;
    return a->value[c] * (1 + 2 * p) * q * q + b->value[c] * p * p * (3 - 2 * p) + ta * p * q * q +
           tb * p * p * q;
}

static double natural(const Key *k, size_t i, int c, double t) {
    const Key *a = &k[i - 1], *b = &k[i];
    double h = b->at - a->at, p = (t - a->at) / h, q = 1 - p;
    return q * a->value[c] + p * b->value[c] +
           h * h / 6 * ((q * q * q - q) * a->second[c] + (p * p * p - p) * b->second[c]);
}

static double evaluate(const Spline *s, SplineKind kind, double t, int c) {
    const Key *k = s->keys.items;
    size_t n = s->keys.count, i = 1;
    if (n == 1)
        return k[0].value[c];
    if (kind == SPLINE_CUBIC) {
        // Without a key on both sides there is no tangent: only the inner segments exist.
        if (n == 2)
            return (k[0].value[c] + k[1].value[c]) / 2;
        if (t <= k[1].at)
            return k[1].value[c];
        if (t >= k[n - 2].at)
            return k[n - 2].value[c];
    }
    if (!(t > k[0].at))
        return k[0].value[c];
    if (t >= k[n - 1].at)
        return k[n - 1].value[c];
    while (k[i].at < t)
        i++;
    switch (kind) {
    case SPLINE_QUADRATIC:
        return n > 2 ? quadratic(k, i, c, t) : linear(k, i, c, t);
    case SPLINE_CUBIC:
        return cubic(k, i, c, t);
    case SPLINE_NATURAL:
        return natural(k, i, c, t);
    default:
        return linear(k, i, c, t);
    }
}

int spline_evaluate(const Spline *s, SplineKind kind, double at, double e[5]) {
    for (int c = 0; c < 5; c++)
        e[c] = evaluate(s, kind, at, c);
    return s->width;
}
