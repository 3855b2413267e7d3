// SPDX-License-Identifier: MIT
// The built-in functions and constants that begin a numeric atom (facts: sdl 2.4, 2.5). Functions
// of one float take a FULL expression in their parentheses, the others ADD expressions.
#include "converter/language.h"

#include "base/file.h"
#include "noise/noise.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

// ---- arguments --------------------------------------------------------------------------------

double full_in_parentheses(Converter *cv, const char *where) {
    expect(cv, '(', where);
    double v = parse_full_float(cv);
    expect(cv, ')', where);
    return v;
}

static void two_floats(Converter *cv, double *a, double *b) {
    expect(cv, '(', "function call");
    *a = parse_float(cv);
    optional_comma(cv);
    *b = parse_float(cv);
    expect(cv, ')', "function call");
}

static Vec3 one_vector(Converter *cv) {
    expect(cv, '(', "function call");
    Vec3 v = parse_vector(cv);
    expect(cv, ')', "function call");
    return v;
}

static void two_vectors(Converter *cv, Vec3 *a, Vec3 *b) {
    expect(cv, '(', "function call");
    *a = parse_vector(cv);
    optional_comma(cv);
    *b = parse_vector(cv);
    expect(cv, ')', "function call");
}

static const char *one_string(Converter *cv) {
    expect(cv, '(', "function call");
    const char *s = parse_string(cv);
    expect(cv, ')', "function call");
    return s;
}

// C's conversion to int, with the value that the hardware gives where C leaves it open.
static double to_int(double v) {
    return v > -2147483649.0 && v < 2147483648.0 ? trunc(v) + 0.0 : INT_MIN; // never -0
}

// ---- floats -----------------------------------------------------------------------------------

_Noreturn static void die_domain(Converter *cv, const Token *name, const char *why) {
    Loc loc = token_loc(cv, name);
    die_at(&loc, "Domain error in %s: %s", name->text, why);
}

static double clamp_unit(Converter *cv, const Token *name, double v) {
    if (v >= -1 && v <= 1)
        return v;
    Loc loc = token_loc(cv, name);
    warn_at(&loc, "Domain error in %s: %g is taken as %d", name->text, v, v > 1 ? 1 : -1);
    return v > 1 ? 1 : -1;
}

static uint32_t *random_stream(Converter *cv, const Token *name, double number) {
    Language *l = cv->language;
    double i = to_int(number);
    if (!(i >= 0 && i < (double)l->seeds.count)) {
        Loc loc = token_loc(cv, name);
        die_at(&loc, "Illegal random number generator %g: use what seed() returned", number);
    }
    return &l->seeds.items[(size_t)i];
}

static double next_random(Converter *cv, const Token *name, double number) {
    uint32_t *state = random_stream(cv, name, number);
    *state = *state * 1812433253u + 12345u;
    return (double)*state / 4294967295.0;
}

static double new_random(Converter *cv, double seed) {
    Language *l = cv->language;
    if (l->seeds.count >= limit_of(cv, LIMIT_ELEMENTS)) {
        Loc loc = token_loc(cv, l->last);
        die_at(&loc, "Too many random number generators: call seed() once, not in a loop");
    }
    uint32_t state = (uint32_t)(int64_t)to_int(seed);
    list_push(cv, &l->seeds, state);
    return (double)(l->seeds.count - 1);
}

// Functions of one float. False: name is none of them.
static bool one_float_call(Converter *cv, const Token *name, double *out) {
    static const struct {
        int code;
        double (*of)(double);
    } plain[] = {
        {KW_abs, fabs},    {KW_ceil, ceil},   {KW_floor, floor}, {KW_cos, cos},   {KW_sin, sin},
        {KW_tan, tan},     {KW_exp, exp},     {KW_sinh, sinh},   {KW_cosh, cosh}, {KW_tanh, tanh},
        {KW_asinh, asinh}, {KW_acosh, acosh}, {KW_atanh, atanh}, {KW_atan, atan}, {KW_int, to_int},
    };
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) {
        if (plain[i].code == name->code) {
            *out = plain[i].of(full_in_parentheses(cv, name->text));
            return true;
        }
    }
    switch (name->code) {
    case KW_acos:
        *out = acos(clamp_unit(cv, name, full_in_parentheses(cv, name->text)));
        return true;
    case KW_asin:
        *out = asin(clamp_unit(cv, name, full_in_parentheses(cv, name->text)));
        return true;
    case KW_ln:
    case KW_log:
        *out = full_in_parentheses(cv, name->text);
        if (*out <= 0)
            die_domain(cv, name, "the argument must be greater than 0");
        *out = name->code == KW_ln ? log(*out) : log10(*out);
        return true;
    case KW_sqrt:
        *out = full_in_parentheses(cv, name->text);
        if (*out < 0)
            die_domain(cv, name, "the argument is negative");
        *out = sqrt(*out);
        return true;
    case KW_degrees:
        *out =
            full_in_parentheses(cv, name->text) / (M_PI / 180.0); // a division, as POV-Ray has it
        return true;
    case KW_radians:
        *out = full_in_parentheses(cv, name->text) * (M_PI / 180.0);
        return true;
    case KW_rand:
        *out = next_random(cv, name, full_in_parentheses(cv, name->text));
        return true;
    case KW_seed:
        *out = new_random(cv, full_in_parentheses(cv, name->text));
        return true;
    default:
        return false;
    }
}

static double two_float_call(Converter *cv, const Token *name) {
    double a, b;
    two_floats(cv, &a, &b);
    switch (name->code) {
    case KW_atan2:
        if (!is_true(a) && !is_true(b))
            die_domain(cv, name, "both arguments are 0");
        return atan2(a, b);
    case KW_pow:
        if (a == 0 && b == 0)
            die_domain(cv, name, "both arguments are 0");
        return pow(a, b);
    case KW_mod:
        return fmod(a, b);
    default:
        return to_int(a / b);
    }
}

static double fold(int code, double a, double b) {
    switch (code) {
    case KW_min:
        return b < a ? b : a;
    case KW_max:
        return b > a ? b : a;
    case KW_bitwise_and:
        return (int32_t)to_int(a) & (int32_t)to_int(b);
    case KW_bitwise_or:
        return (int32_t)to_int(a) | (int32_t)to_int(b);
    default:
        return (int32_t)to_int(a) ^ (int32_t)to_int(b);
    }
}

// min, max, bitwise_*: one or more floats, with commas.
static double many_float_call(Converter *cv, const Token *name) {
    expect(cv, '(', name->text);
    double v = parse_float(cv);
    if (name->code != KW_min && name->code != KW_max)
        v = to_int(v);
    while (accept(cv, ','))
        v = fold(name->code, v, parse_float(cv));
    expect(cv, ')', name->text);
    return v;
}

// select ( A , N , Z [, P] )
static double select_call(Converter *cv) {
    double v[4];
    expect(cv, '(', "select");
    for (int i = 0; i < 3; i++) {
        v[i] = parse_float(cv);
        if (i < 2)
            expect(cv, ',', "select");
    }
    v[3] = accept(cv, ',') ? parse_float(cv) : v[2];
    expect(cv, ')', "select");
    return v[0] < 0 ? v[1] : v[0] == 0 ? v[2] : v[3]; // P for what is no number
}

// ---- floats of strings, arrays, names -----------------------------------------------------------

static const Array *one_array(Converter *cv, const char *where) {
    expect(cv, '(', where);
    const Value *value = accept_value(cv, VALUE_ARRAY);
    if (!value)
        die_expected(cv, "array identifier");
    return value->node;
}

static double dimension_size_call(Converter *cv) {
    const Array *array = one_array(cv, "dimension_size");
    optional_comma(cv);
    double d = to_int(parse_float(cv));
    expect(cv, ')', "dimension_size");
    return d >= 1 && d <= array->dimensions ? (double)array->sizes[(int)d - 1] : 0;
}

static double string_call(Converter *cv, const Token *name) {
    if (name->code == KW_strcmp) {
        expect(cv, '(', "strcmp");
        const char *a = parse_string(cv);
        optional_comma(cv);
        const char *b = parse_string(cv);
        expect(cv, ')', "strcmp");
        return string_compare(a, b);
    }
    const char *s = one_string(cv);
    switch (name->code) {
    case KW_strlen:
        return (double)string_units(s);
    case KW_asc:
        return *s ? string_compare(s, "") : 0;
    case KW_val:
        return strtod(s, NULL);
    default:
        return written_source(cv, s) || source_find(cv, s, FILE_TEXT) ? 1 : 0;
    }
}

static double days_since_2000(void) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    return ((double)(now.tv_sec - 946684800) + (double)now.tv_nsec * 1e-9) / 86400;
}

// Constants without parentheses.
static bool constant(Converter *cv, const Token *name, double *out) {
    switch (name->code) {
    case KW_pi:
        *out = M_PI;
        return true;
    case KW_true:
    case KW_yes:
    case KW_on:
        *out = 1;
        return true;
    case KW_false:
    case KW_no:
    case KW_off:
        *out = 0;
        return true;
    case KW_clock:
        *out = (double)(float)cv->options->clock;
        return true;
    case KW_clock_on:
        *out = cv->options->clock_given;
        return true;
    case KW_version:
        *out = cv->version / 100.0;
        return true;
    case KW_now:
        *out = days_since_2000();
        return true;
    default:
        return false;
    }
}

static double float_call(Converter *cv, const Token *name) {
    double v;
    if (constant(cv, name, &v) || one_float_call(cv, name, &v))
        return v;
    switch (name->code) {
    case KW_atan2:
    case KW_pow:
    case KW_mod:
    case KW_div:
        return two_float_call(cv, name);
    case KW_min:
    case KW_max:
    case KW_bitwise_and:
    case KW_bitwise_or:
    case KW_bitwise_xor:
        return many_float_call(cv, name);
    case KW_select:
        return select_call(cv);
    case KW_strcmp:
    case KW_strlen:
    case KW_asc:
    case KW_val:
    case KW_file_exists:
        return string_call(cv, name);
    case KW_defined:
        return place_is_set(cv);
    case KW_dimensions: {
        const Array *array = one_array(cv, "dimensions");
        expect(cv, ')', "dimensions");
        return array->dimensions;
    }
    case KW_dimension_size:
        return dimension_size_call(cv);
    case KW_vdot: {
        Vec3 a, b;
        two_vectors(cv, &a, &b);
        return vec_dot(a, b);
    }
    case KW_vlength:
        return vec_length(one_vector(cv));
    default: // KW_inside
        return inside_call(cv, name);
    }
}

bool is_number_keyword(int code) {
    switch (code) {
    case TOK_NUMBER:
    case KW_abs:
    case KW_acos:
    case KW_acosh:
    case KW_asc:
    case KW_asin:
    case KW_asinh:
    case KW_atan:
    case KW_atan2:
    case KW_atanh:
    case KW_bitwise_and:
    case KW_bitwise_or:
    case KW_bitwise_xor:
    case KW_ceil:
    case KW_clock:
    case KW_clock_on:
    case KW_cos:
    case KW_cosh:
    case KW_defined:
    case KW_degrees:
    case KW_dimension_size:
    case KW_dimensions:
    case KW_div:
    case KW_exp:
    case KW_false:
    case KW_file_exists:
    case KW_floor:
    case KW_inside:
    case KW_int:
    case KW_ln:
    case KW_log:
    case KW_max:
    case KW_min:
    case KW_mod:
    case KW_no:
    case KW_now:
    case KW_off:
    case KW_on:
    case KW_pi:
    case KW_pow:
    case KW_radians:
    case KW_rand:
    case KW_seed:
    case KW_select:
    case KW_sin:
    case KW_sinh:
    case KW_sqrt:
    case KW_strcmp:
    case KW_strlen:
    case KW_tan:
    case KW_tanh:
    case KW_true:
    case KW_val:
    case KW_vdot:
    case KW_version:
    case KW_vlength:
    case KW_yes:
        return true;
    default:
        return false;
    }
}

// ---- vectors ----------------------------------------------------------------------------------

bool is_vector_keyword(int code) {
    switch (code) {
    case KW_max_extent:
    case KW_min_extent:
    case KW_trace:
    case KW_u:
    case KW_v:
    case KW_vaxis_rotate:
    case KW_vcross:
    case KW_vnormalize:
    case KW_vrotate:
    case KW_vturbulence:
    case KW_x:
    case KW_y:
    case KW_z:
        return true;
    default:
        return false;
    }
}

// The rotation about a unit axis, row vectors.
static Vec3 rotate_about(Vec3 p, Vec3 a, double deg) {
    double angle = deg * (M_PI / 180.0), c = cos(angle), s = sin(angle);
    double m[4][4] = {
        {a.x * a.x + c * (1 - a.x * a.x), a.x * a.y * (1 - c) + a.z * s,
         a.x * a.z * (1 - c) - a.y * s},
        {a.x * a.y * (1 - c) - a.z * s, a.y * a.y + c * (1 - a.y * a.y),
         a.y * a.z * (1 - c) + a.x * s},
        {a.x * a.z * (1 - c) + a.y * s, a.y * a.z * (1 - c) - a.x * s,
         a.z * a.z + c * (1 - a.z * a.z)},
    };
    return transform_row_point(m, p);
}

static Vec3 vaxis_rotate_call(Converter *cv) {
    expect(cv, '(', "vaxis_rotate");
    Vec3 p = parse_vector(cv);
    optional_comma(cv);
    Vec3 a = parse_vector(cv);
    optional_comma(cv);
    double deg = parse_float(cv);
    expect(cv, ')', "vaxis_rotate");
    return rotate_about(p, vec_normalize(a), deg);
}

static Vec3 vnormalize_call(Converter *cv, const Token *name) {
    Vec3 v = one_vector(cv);
    if (vec_length(v) != 0)
        return vec_normalize(v);
    Loc loc = token_loc(cv, name);
    warn_at(&loc, "Normalizing zero-length vector: the result is <0,0,0>");
    return vec3(0, 0, 0);
}

// vturbulence ( lambda , omega , octaves , V )
static Vec3 vturbulence_call(Converter *cv) {
    expect(cv, '(', "vturbulence");
    double lambda = parse_float(cv);
    optional_comma(cv);
    double omega = parse_float(cv);
    optional_comma(cv);
    double octaves = to_int(parse_float(cv));
    optional_comma(cv);
    Vec3 p = parse_vector(cv);
    optional_comma(cv);
    expect(cv, ')', "vturbulence");
    const NoiseOctaves sum = {
        .octaves = (int)fmin(fmax(octaves, 1), 10), .lambda = (float)lambda, .omega = (float)omega};
    noise_prepare();
    return noise_turbulence_vector(p, &sum);
}

static Vec3 vector_call(Converter *cv, const Token *name) {
    Vec3 a, b;
    switch (name->code) {
    case KW_vcross:
        two_vectors(cv, &a, &b);
        return vec_cross(a, b);
    case KW_vnormalize:
        return vnormalize_call(cv, name);
    case KW_vrotate: {
        two_vectors(cv, &a, &b);
        Transform t = transform_rotate(b);
        return transform_point(&t, a);
    }
    case KW_vaxis_rotate:
        return vaxis_rotate_call(cv);
    case KW_min_extent:
    case KW_max_extent:
        return extent_call(cv, name);
    case KW_vturbulence:
        return vturbulence_call(cv);
    default: // KW_trace
        return trace_call(cv, name);
    }
}

bool parse_call(Converter *cv, double e[5], int *width, int want) {
    const Token *name = peek_token(cv);
    if (is_number_keyword(name->code)) {
        next_token(cv);
        double v = float_call(cv, name);
        for (int i = 0; i < want; i++)
            e[i] = v;
        *width = want;
        return true;
    }
    if (!is_vector_keyword(name->code))
        return false;
    next_token(cv);
    Vec3 v = vector_call(cv, name);
    e[0] = v.x;
    e[1] = v.y;
    e[2] = v.z;
    *width = 3;
    return true;
}
