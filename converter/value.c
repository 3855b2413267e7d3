// SPDX-License-Identifier: MIT
// Values: what stands right of '=' in a #declare, as a macro's argument, in an array (facts: sdl
// 3.2, 3.4, 2.9).
#include "converter/language.h"

#include <string.h>

// ORDER value_type
static const char *const type_names[] = {
    "undeclared",  "float",      "uv vector", "vector",      "4d vector",   "color",   "string",
    "array",       "function",   "spline",    "macro",       "file",        "pigment", "normal",
    "finish",      "texture",    "material",  "interior",    "media",       "density", "color_map",
    "pigment_map", "normal_map", "slope_map", "texture_map", "density_map", "fog",     "rainbow",
    "sky_sphere",  "camera",     "transform", "object",
};
_Static_assert(sizeof type_names / sizeof *type_names == VALUE_OBJECT + 1, "ORDER value_type");

const char *value_type_name(ValueType type) { return type_names[type]; }

int value_width(ValueType type) {
    return type >= VALUE_FLOAT && type <= VALUE_COLOR ? (int)type - VALUE_FLOAT + 1 : 0;
}

Value value_number(const double c[5], int width) {
    Value v = {.type = (ValueType)(VALUE_FLOAT + width - 1)};
    for (int i = 0; i < width; i++)
        v.c[i] = width == 5 ? (double)(float)c[i] : c[i];
    return v;
}

ValueType peek_value_type(Converter *cv) {
    const Place *place = ahead_place(cv);
    return place ? place->value->type : VALUE_NONE;
}

const Value *accept_value(Converter *cv, ValueType type) {
    const Place *place = ahead_place(cv);
    if (!place || place->value->type != type || type == VALUE_NONE)
        return NULL;
    const Value *value = place->value;
    next_token(cv);
    return value;
}

// ---- arrays -----------------------------------------------------------------------------------

_Noreturn static void die_elements(Converter *cv, double count, const Loc *loc) {
    die_at(loc, "Too many array elements: %.0f here, %llu in all are the limit %s", count,
           (unsigned long long)limit_of(cv, LIMIT_ELEMENTS), limit_hint(cv, LIMIT_ELEMENTS));
}

static Array *new_array(Converter *cv, const Array *shape, const Loc *loc) {
    Language *l = cv->language;
    if (shape->count > limit_of(cv, LIMIT_ELEMENTS) - l->elements)
        die_elements(cv, (double)shape->count, loc);
    l->elements += shape->count;
    Array *array = ARENA_NEW(cv->arena, Array);
    *array = *shape;
    array->items = ARENA_ARRAY(cv->arena, Value, shape->count);
    return array;
}

static Array *clone_array(Converter *cv, const Array *array);

static Value clone_value(Converter *cv, const Value *value) {
    Value copy = *value;
    if (copy.type == VALUE_ARRAY)
        copy.node = clone_array(cv, copy.node);
    return copy;
}

static Array *clone_array(Converter *cv, const Array *array) {
    enter_level(cv);
    Loc loc = token_loc(cv, cv->language->last);
    Array *copy = new_array(cv, array, &loc);
    for (size_t i = 0; i < array->count; i++)
        copy->items[i] = clone_value(cv, &array->items[i]);
    leave_level(cv);
    return copy;
}

// '{' elements '}' per dimension, commas optional, all of them.
static void parse_initializer(Converter *cv, Array *array, int dimension, size_t base) {
    expect(cv, '{', "array initializer");
    size_t stride = 1;
    for (int d = dimension + 1; d < array->dimensions; d++)
        stride *= array->sizes[d];
    for (size_t i = 0; i < array->sizes[dimension]; i++) {
        if (next_is(cv, '}')) {
            Loc loc = here(cv);
            die_at(&loc, "Insufficient number of initializers: %zu of %zu found", i,
                   array->sizes[dimension]);
        }
        if (dimension + 1 < array->dimensions) {
            parse_initializer(cv, array, dimension + 1, base + i * stride);
            continue;
        }
        Loc loc = here(cv);
        Value value;
        if (!parse_rvalue(cv, RVALUE_ELEMENT, &value, NULL))
            die_expected(cv, "an array element");
        Place place = {.value = &array->items[base + i], .array = array};
        place_assign(cv, &place, &value, &loc);
        optional_comma(cv);
    }
    expect(cv, '}', "array initializer");
    if (dimension > 0)
        optional_comma(cv);
}

// array[F]...[F] [ initializer ], after the keyword
static Array *parse_array(Converter *cv) {
    Array shape = {.count = 1};
    bool held = hold_directives(cv);
    Loc loc = here(cv);
    while (accept(cv, '[')) {
        if (shape.dimensions == MAX_DIMENSIONS)
            die_at(&loc, "Too many array dimensions (%d are the limit)", MAX_DIMENSIONS);
        Loc at = here(cv);
        double size = parse_float(cv) + EPSILON;
        if (!(size >= 1))
            die_at(&at, "Invalid dimension size for an array: %g", size - EPSILON);
        if (size > (double)limit_of(cv, LIMIT_ELEMENTS))
            die_elements(cv, size, &at);
        shape.sizes[shape.dimensions++] = (size_t)size;
        shape.count *= (size_t)size;
        if (shape.count > limit_of(cv, LIMIT_ELEMENTS))
            die_elements(cv, (double)shape.count, &at);
        expect(cv, ']', "array");
    }
    if (!shape.dimensions)
        die_expected(cv, "'[': an array declaration must have at least one dimension");
    Array *array = new_array(cv, &shape, &loc);
    bool initialized = next_is(cv, '{');
    restore_directives(cv, held);
    if (initialized)
        parse_initializer(cv, array, 0, 0);
    return array;
}

// ---- the right side ---------------------------------------------------------------------------

static void require_semicolon(Converter *cv) {
    if (accept(cv, ';') || cv->version < 350)
        return;
    Loc loc = token_loc(cv, cv->language->last);
    die_at(&loc,
           "All #declares of float, vector, and color require semi-colon ';' at end, but %s was "
           "found after this",
           token_describe(cv, peek_token(cv)));
}

// Does the scope of this name live longer than the argument?
static bool outlives(const Reference *reference, const Place *place) {
    return reference && place->symbol && place->symbol->scope <= reference->outermost;
}

// An ADD expression, or the bare name of a function or spline.
static void parse_numeric(Converter *cv, RvalueUse use, Value *out, Reference *reference) {
    const Place *ahead = ahead_place(cv);
    Place place = ahead ? *ahead : (Place){0};
    ValueType type = ahead ? place.value->type : VALUE_NONE;
    const Token *after = raw_peek(cv);
    bool lasting = outlives(reference, &place), bare = false;
    bool held = hold_directives(cv);
    if ((type == VALUE_FUNCTION || type == VALUE_SPLINE) && (!after || after->code != '(')) {
        next_token(cv);
        *out = *place.value;
        bare = type == VALUE_SPLINE; // functions always go by value
    } else {
        uint64_t start = cv->language->consumed;
        double e[5] = {0};
        int width = parse_add(cv, e, 1);
        *out = value_number(e, width);
        bare = type != VALUE_NONE && cv->language->consumed == start + 1;
    }
    if (bare && lasting)
        reference->place = place;
    if (use == RVALUE_DECLARE)
        require_semicolon(cv);
    restore_directives(cv, held);
}

static void parse_color_value(Converter *cv, RvalueUse use, Value *out) {
    bool held = hold_directives(cv);
    Color c = parse_color(cv);
    *out =
        (Value){.type = VALUE_COLOR,
                .c = {(double)c.r, (double)c.g, (double)c.b, (double)c.filter, (double)c.transmit}};
    if (use == RVALUE_DECLARE)
        require_semicolon(cv);
    restore_directives(cv, held);
}

static bool parse_named(Converter *cv, RvalueUse use, Value *out, Reference *reference) {
    const Place *ahead = ahead_place(cv);
    if (!ahead) {
        const Token *token = peek_token(cv);
        Loc loc = token_loc(cv, token);
        die_at(&loc,
               use == RVALUE_ARGUMENT
                   ? "Undeclared identifier '%s': it cannot be passed to a macro before it "
                     "has a value%s"
                   : "Undeclared identifier '%s': it has no value to assign%s",
               token->text, spelling_hint(cv, token));
    }
    Place place = *ahead;
    if (value_width(place.value->type) || place.value->type == VALUE_FUNCTION ||
        place.value->type == VALUE_SPLINE)
        return false;
    if (place.value->type == VALUE_FILE)
        die_expected(cv, "a value");
    next_token(cv);
    if (outlives(reference, &place)) {
        reference->place = place;
        *out = *place.value;
    } else {
        *out = clone_value(cv, place.value);
    }
    return true;
}

static bool parse_kind(Converter *cv, RvalueUse use, Value *out, Reference *reference) {
    int code = peek_token(cv)->code;
    if (code == TOK_IDENTIFIER && parse_named(cv, use, out, reference))
        return true;
    bool old_color = cv->version < 350 && peek_value_type(cv) == VALUE_COLOR;
    if (is_color_keyword(code) || old_color) {
        parse_color_value(cv, use, out);
    } else if (code == TOK_STRING || is_string_keyword(code)) {
        *out = (Value){.type = VALUE_STRING, .string = parse_string(cv)};
    } else if (accept(cv, KW_array)) {
        *out = (Value){.type = VALUE_ARRAY, .node = parse_array(cv)};
    } else if (accept(cv, KW_function)) {
        *out = (Value){.type = VALUE_FUNCTION, .node = parse_function(cv)};
    } else if (accept(cv, KW_spline)) {
        *out = (Value){.type = VALUE_SPLINE, .node = parse_spline(cv)};
    } else if (starts_expression(cv)) {
        parse_numeric(cv, use, out, reference);
    } else {
        return parse_statement_value(cv, out);
    }
    return true;
}

bool parse_rvalue(Converter *cv, RvalueUse use, Value *out, Reference *reference) {
    enter_level(cv);
    *out = (Value){0};
    bool held = release_directives(cv);
    bool found = parse_kind(cv, use, out, reference);
    restore_directives(cv, held);
    leave_level(cv);
    return found;
}

Value parse_value(Converter *cv) {
    Value value;
    if (!parse_rvalue(cv, RVALUE_ELEMENT, &value, NULL))
        die_expected(cv, "a value");
    return value;
}
