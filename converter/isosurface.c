// SPDX-License-Identifier: MIT
// isosurface (facts: sdl 4.2).
#include "converter/nodes.h"

#include <math.h>

// contained_by { box { V, V } | sphere { V, F } }
static void parse_container(Converter *cv, IsosurfaceShape *iso) {
    expect(cv, '{', "contained_by");
    if (accept(cv, KW_box)) {
        expect(cv, '{', "box");
        Vec3 a = parse_vector(cv);
        optional_comma(cv);
        Vec3 b = parse_vector(cv);
        iso->in_sphere = false;
        iso->low = vec_min(a, b);
        iso->high = vec_max(a, b);
    } else {
        expect(cv, KW_sphere, "contained_by");
        expect(cv, '{', "sphere");
        iso->in_sphere = true;
        iso->center = parse_vector(cv);
        optional_comma(cv);
        iso->radius = fabs(parse_float(cv));
    }
    expect(cv, '}', "contained_by");
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
        parse_container(cv, iso);
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

void parse_isosurface(Converter *cv, ObjectNode *object) {
    IsosurfaceShape *iso = &object->object.shape.isosurface;
    const Token *token = peek_token(cv);
    expect(cv, KW_function, "isosurface");
    object->function = parse_function(cv);
    if (user_function_parameters(cv, object->function) != 3 ||
        user_function_width(cv, object->function) != 1) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "the function of an isosurface has three arguments and gives one number");
    }
    optional_comma(cv);
    while (parse_option(cv, iso)) {
    }
    object->loc = keep_place(cv, token);
}
