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

// The second derivatives of the C2 spline that has none at both ends: the tridiagonal system of
// the middle keys, eliminated downwards, solved upwards.
static void solve_natural(Converter *cv, Spline *s) {
    size_t n = s->keys.count;
    Key *k = s->keys.items;
    double *pivot = ARENA_ARRAY(cv->arena, double, n), *right = ARENA_ARRAY(cv->arena, double, n);
    for (int c = 0; n > 2 && c < 5; c++) {
        double before = 0, slope_before = 0; // length and slope of the segment before key i
        for (size_t i = 0; i + 1 < n; i++) {
            double after = k[i + 1].at - k[i].at;
            double slope_after = (k[i + 1].value[c] - k[i].value[c]) / after;
            if (i > 0) {
                pivot[i] = 2 * (after + before);
                right[i] = 6 * (slope_after - slope_before);
            }
            if (i > 1) {
                pivot[i] -= before * before / pivot[i - 1];
                right[i] -= before * right[i - 1] / pivot[i - 1];
            }
            before = after;
            slope_before = slope_after;
        }
        k[n - 1].second[c] = k[0].second[c] = 0;
        for (size_t i = n - 2; i > 0; i--)
            k[i].second[c] = (right[i] - (k[i + 1].at - k[i].at) * k[i + 1].second[c]) / pivot[i];
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
    // The components that a value does not give stay those of the value before, as in POV-Ray.
    Key key = {0};
    while (starts_expression(cv)) {
        key.at = parse_float(cv);
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

// ---- evaluation ---------------------------------------------------------------------------------
// One component c at t, in the segment from key a to a + 1. The order of the operations is POV-
// Ray's: spline values become coordinates, and must have its bits.

static double linear(const Key *a, int c, double t) {
    const Key *b = a + 1;
    return (t - a->at) * (b->value[c] - a->value[c]) / (b->at - a->at) + a->value[c];
}

// Through the keys a - 1, a, a + 1: the coefficients by Cramer's rule, then Horner.
static double quadratic(const Key *a, int c, double t) {
    double t0 = a[-1].at, t1 = a[0].at, t2 = a[1].at;
    double v0 = a[-1].value[c], v1 = a[0].value[c], v2 = a[1].value[c];
    double det = (t1 - t0) * (t2 - t0) * (t2 - t1);
    double square = -t1 * v0 + t2 * v0 + t0 * v1 - t2 * v1 - t0 * v2 + t1 * v2;
    double first =
        t1 * t1 * v0 - t2 * t2 * v0 - t0 * t0 * v1 + t2 * t2 * v1 + t0 * t0 * v2 - t1 * t1 * v2;
    double constant = -t1 * t1 * t2 * v0 + t1 * t2 * t2 * v0 + t0 * t0 * t2 * v1 -
                      t0 * t2 * t2 * v1 - t0 * t0 * t1 * v2 + t0 * t1 * t1 * v2;
    return (square / det * t + first / det) * t + constant / det;
}

// Hermite's cubic; the tangent at a key is the mean of the slopes on both sides.
static double cubic(const Key *a, int c, double t) {
    double h = a[1].at - a[0].at, u = (t - a[0].at) / h;
    double slope = (a[1].value[c] - a[0].value[c]) / (a[1].at - a[0].at);
    double before = (a[0].value[c] - a[-1].value[c]) / (a[0].at - a[-1].at);
    double after = (a[2].value[c] - a[1].value[c]) / (a[2].at - a[1].at);
    double tangent_a = (before + slope) / 2 * h, tangent_b = (after + slope) / 2 * h;
    return a[0].value[c] * (2 * u * u * u - 3 * u * u + 1) +
           a[1].value[c] * (3 * u * u - 2 * u * u * u) + tangent_a * (u * u * u - 2 * u * u + u) +
           tangent_b * (u * u * u - u * u);
}

// Taylor's polynomial about key a.
static double natural(const Key *a, int c, double t) {
    double h = a[1].at - a[0].at, d = t - a[0].at;
    double curve = a[0].second[c] / 2 + d * (a[1].second[c] - a[0].second[c]) / (6 * h);
    double slope = -(h / 6) * (a[1].second[c] + 2 * a[0].second[c]) +
                   (a[1].value[c] - a[0].value[c]) / h + d * curve;
    return a[0].value[c] + d * slope;
}

static double evaluate(const Spline *s, SplineKind kind, double t, int c) {
    const Key *k = s->keys.items;
    size_t n = s->keys.count, i = 0; // keys before t
    if (n == 1)
        return k[0].value[c];
    while (i < n && k[i].at < t)
        i++;
    if (kind == SPLINE_CUBIC) {
        // Without a key on both sides there is no tangent: only the inner segments exist.
        if (n == 2)
            return (k[0].value[c] + k[1].value[c]) / 2;
        if (i < 2)
            return k[1].value[c];
        return i >= n - 1 ? k[n - 2].value[c] : cubic(&k[i - 1], c, t);
    }
    if (i == 0)
        return k[0].value[c];
    if (t >= k[n - 1].at || i == n)
        return k[n - 1].value[c];
    if (kind == SPLINE_QUADRATIC && n > 2)
        return quadratic(&k[i == 1 ? 1 : i - 1], c, t);
    return kind == SPLINE_NATURAL ? natural(&k[i - 1], c, t) : linear(&k[i - 1], c, t);
}

int spline_evaluate(const Spline *s, SplineKind kind, double at, double e[5]) {
    for (int c = 0; c < 5; c++)
        e[c] = evaluate(s, kind, at, c);
    return s->width;
}
