// SPDX-License-Identifier: MIT
// Functions of declared objects (facts: sdl 2.4, 2.5): trace, inside, min_extent, max_extent.
#include "converter/language.h"
#include "converter/probing.h"

// The object's name in the parentheses.
static const ObjectNode *expect_object(Converter *cv, const Token **what) {
    *what = peek_token(cv);
    const Value *value = accept_value(cv, VALUE_OBJECT);
    if (!value)
        die_expected(cv, "object identifier");
    return value->node;
}

// Has it, or anything in it, no inside?
static const ObjectNode *find_surface(const ObjectNode *object) {
    if (object->surface)
        return object;
    const ObjectNode *found = NULL;
    for (const ObjectNode *child = object->first; child && !found; child = child->next)
        found = find_surface(child);
    return found;
}

// A question about an object, in tokens' worth: a ray may go a long way through an isosurface.
enum { QUESTION_WORK = 100 };

// NULL: there is nothing to meet. Dies if it holds what is not modelled.
static const Probe *probe_of(Converter *cv, const Token *name, const Token *what,
                             const ObjectNode *object) {
    const char *gap;
    check_limits(cv, QUESTION_WORK);
    const Probe *probe = probing_object(cv, object, &gap);
    if (!probe && gap) {
        Loc loc = token_loc(cv, what);
        die_at(&loc, "%s() is needed to read this scene: %s", name->text, gap);
    }
    return probe;
}

// ( OBJECT , V , V [, NAME] ): NAME, the name of a vector, receives the normal.
Vec3 trace_call(Converter *cv, const Token *name) {
    const Token *what;
    expect(cv, '(', "trace");
    const ObjectNode *object = expect_object(cv, &what);
    optional_comma(cv);
    Ray ray = {.org = parse_vector(cv)};
    optional_comma(cv);
    ray.dir = vec_normalize(parse_vector(cv));
    optional_comma(cv);
    const Probe *probe = probe_of(cv, name, what, object);
    Vec3 p = vec3(0, 0, 0), normal = vec3(0, 0, 0);
    if (probe)
        probe_trace(probe, &ray, &p, &normal);
    const Place *place = ahead_place(cv);
    if (place && place->value->type == VALUE_VECTOR) {
        Value *value = place->value;
        next_token(cv);
        value->c[0] = normal.x;
        value->c[1] = normal.y;
        value->c[2] = normal.z;
    }
    expect(cv, ')', "trace");
    return p;
}

// ( OBJECT , V )
double inside_call(Converter *cv, const Token *name) {
    const Token *what;
    expect(cv, '(', "inside");
    const ObjectNode *object = expect_object(cv, &what);
    const ObjectNode *surface = find_surface(object);
    if (surface) {
        Loc loc = token_loc(cv, what);
        die_at(&loc, "Solid object identifier expected: a '%s' has no inside",
               keyword_name(surface->keyword));
    }
    optional_comma(cv);
    Vec3 p = parse_vector(cv);
    const Probe *probe = probe_of(cv, name, what, object);
    expect(cv, ')', "inside");
    return probe && probe_inside(probe, p);
}

// ( OBJECT ), for max_extent also ( image_map PIGMENT )
Vec3 extent_call(Converter *cv, const Token *name) {
    expect(cv, '(', name->text);
    const Token *what = peek_token(cv);
    const Value *value = accept_value(cv, VALUE_OBJECT);
    if (!value)
        value = accept_value(cv, VALUE_PIGMENT);
    if (!value)
        die_expected(cv, "object identifier");
    Box box;
    if (!object_extent(cv, value, &box)) {
        Loc loc = token_loc(cv, what);
        die_at(&loc, "%s of this %s is not known", name->text, value_type_name(value->type));
    }
    expect(cv, ')', name->text);
    return name->code == KW_min_extent ? box.low : box.high;
}
