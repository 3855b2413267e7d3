// SPDX-License-Identifier: MIT
// isosurface, parametric (facts: sdl 4.2).
#include "converter/nodes.h"

#include <math.h>

// contained_by { [box { V, V } | sphere { V, F }] }
static void parse_container(Converter *cv, Container *out) {
    expect(cv, '{', "contained_by");
    if (accept(cv, KW_box)) {
        expect(cv, '{', "box");
        Vec3 a = parse_vector(cv);
        optional_comma(cv);
        Vec3 b = parse_vector(cv);
        out->in_sphere = false;
        out->low = vec_min(a, b);
        out->high = vec_max(a, b);
        expect(cv, '}', "box");
    } else if (accept(cv, KW_sphere)) {
        expect(cv, '{', "sphere");
        out->in_sphere = true;
        out->center = parse_vector(cv);
        optional_comma(cv);
        out->radius = fabs(parse_float(cv));
        expect(cv, '}', "sphere");
    }
    expect(cv, '}', "contained_by");
}

// A number that must be above 0, or its default takes its place.
static double parse_positive(Converter *cv, const Token *token, double usual) {
    double value = parse_float(cv);
    if (value > 0)
        return value;
    Loc loc = token_loc(cv, token);
    warn_at(&loc, "'%s' is not above 0: %g takes its place", token->text, usual);
    return usual;
}

static bool parse_option(Converter *cv, IsosurfaceShape *iso) {
    const Token *token = peek_token(cv);
    if (accept(cv, KW_contained_by)) {
        parse_container(cv, &iso->container);
    } else if (accept(cv, KW_threshold)) {
        iso->threshold = parse_float(cv);
    } else if (accept(cv, KW_accuracy)) {
        iso->accuracy = parse_positive(cv, token, 1e-3);
    } else if (accept(cv, KW_max_gradient)) {
        iso->max_gradient = parse_positive(cv, token, 1.1);
    } else if (accept(cv, KW_max_trace)) {
        iso->max_trace = (int)fmin(fmax(parse_float(cv), 1), SCENE_MAX_TRACE);
    } else if (accept(cv, KW_all_intersections)) {
        iso->max_trace = SCENE_MAX_TRACE;
    } else if (accept(cv, KW_open)) {
        iso->open = true;
    } else if (accept(cv, KW_evaluate)) {
        double numbers[3];
        read_floats(cv, numbers, 3);
        iso->evaluate = true;
        iso->evaluate_from = numbers[0];
        iso->evaluate_over = numbers[1];
        iso->evaluate_fall = numbers[2];
    } else {
        return false;
    }
    return true;
}

// function { ... } [,] of three arguments, to one number
static const UserFunction *parse_function_of(Converter *cv, const char *where) {
    const Token *token = peek_token(cv);
    expect(cv, KW_function, where);
    const UserFunction *function = parse_function(cv);
    if (user_function_parameters(cv, function) != 3 || user_function_width(cv, function) != 1) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "a function of '%s' has three arguments and gives one number", where);
    }
    optional_comma(cv);
    return function;
}

void parse_isosurface(Converter *cv, ObjectNode *object) {
    IsosurfaceShape *iso = &object->object.shape.isosurface;
    object->functions[0] = parse_function_of(cv, "isosurface");
    while (parse_option(cv, iso)) {
    }
}

// precompute F [,] [x] [,] [y] [,] [z]
static void parse_precompute(Converter *cv, ParametricShape *shape) {
    static const int axes[3] = {KW_x, KW_y, KW_z};
    const Token *token = peek_token(cv);
    double depth = parse_float(cv);
    bool any = false;
    for (int axis = 0; axis < 3; axis++) {
        optional_comma(cv);
        shape->precompute[axis] = shape->precompute[axis] || accept(cv, axes[axis]);
        any = any || shape->precompute[axis];
    }
    if (any && !(depth >= 1 && depth < SCENE_MAX_PRECOMPUTE + 1)) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "precompute must be from 1 to %d", SCENE_MAX_PRECOMPUTE);
    }
    shape->depth = any ? (int)depth : 1;
}

void parse_parametric(Converter *cv, ObjectNode *object) {
    ParametricShape *shape = &object->object.shape.parametric;
    for (int axis = 0; axis < 3; axis++)
        object->functions[axis] = parse_function_of(cv, "parametric");
    Vec2 from = parse_uv(cv);
    optional_comma(cv);
    Vec2 to = parse_uv(cv);
    shape->low[0] = fmin(from.u, to.u), shape->high[0] = fmax(from.u, to.u);
    shape->low[1] = fmin(from.v, to.v), shape->high[1] = fmax(from.v, to.v);
    for (;;) {
        const Token *token = peek_token(cv);
        if (accept(cv, KW_contained_by))
            parse_container(cv, &shape->container);
        else if (accept(cv, KW_accuracy))
            shape->accuracy = parse_positive(cv, token, 1e-3);
        else if (accept(cv, KW_max_gradient))
            shape->max_gradient = parse_positive(cv, token, 1);
        else if (accept(cv, KW_precompute))
            parse_precompute(cv, shape);
        else
            return;
    }
}
