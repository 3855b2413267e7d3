// SPDX-License-Identifier: MIT
// global_settings{} (facts: sdl 4.11, rendering 3.1).
#include "converter/nodes.h"

#include <math.h>

// The first one counts.
static void parse_assumed_gamma(Converter *cv, const Token *token) {
    double gamma = 0;
    bool is_srgb = accept(cv, KW_srgb);
    Loc loc = token_loc(cv, token);
    if (!is_srgb) {
        gamma = parse_float(cv);
        if (!(gamma > 0.0) || !isfinite((float)gamma))
            die_at(&loc, "assumed_gamma must be greater than 0");
    }
    if (cv->gamma_set) {
        warn_at(&loc, "assumed_gamma was given before: this one is ignored");
        return;
    }
    cv->gamma = gamma;
    cv->gamma_is_srgb = is_srgb;
    cv->gamma_set = true;
}

static int parse_limited(Converter *cv, const Token *token, int low, int high) {
    double value = parse_float(cv);
    if (value >= low && value < high + 1.0)
        return (int)value;
    Loc loc = token_loc(cv, token);
    int used = value >= low ? high : low;
    warn_at(&loc, "%s must be from %d to %d: %d is used", token->text, low, high, used);
    return used;
}

static void parse_noise_generator(Converter *cv, const Token *token) {
    double value = parse_float(cv);
    if (!(value >= 1 && value < 4)) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "noise_generator must be 1, 2 or 3");
    }
    cv->noise_generator = (int)value;
    cv->noise_generator_set = true;
}

static void parse_charset(Converter *cv) {
    if (accept(cv, KW_utf8)) {
        cv->utf8 = true;
        return;
    }
    if (!accept(cv, KW_ascii) && !accept(cv, KW_sys))
        die_expected(cv, "'ascii', 'utf8' or 'sys'");
    cv->utf8 = false;
}

static void parse_two_floats(Converter *cv, double out[2]) {
    out[0] = parse_float(cv);
    optional_comma(cv);
    out[1] = parse_float(cv);
}

// What is wrong with a number of radiosity{}, or NULL.
static const char *radiosity_fault(int keyword, double value) {
    bool positive = value > 0;
    switch (keyword) {
    case KW_nearest_count:
        return value >= 1 && value < 21 ? NULL : "nearest_count must be a value from 1 to 20";
    case KW_recursion_limit:
        return value >= 1 && value < 21 ? NULL : "recursion_limit must be in the range 1 to 20";
    case KW_pretrace_start:
    case KW_pretrace_end:
        return positive && value <= 1 ? NULL
                                      : "pretrace must be greater than 0 and no higher than 1";
    case KW_count:
        return value >= 1 ? NULL : "count must be a positive number";
    case KW_gray_threshold:
        return value >= 0 && value <= 1 ? NULL : "gray_threshold must be from 0.0 to 1.0";
    case KW_minimum_reuse:
        return value >= 0 ? NULL : "minimum_reuse can not be a negative number";
    case KW_maximum_reuse:
    case KW_error_bound:
    case KW_low_error_factor:
    case KW_brightness:
        return positive ? NULL : "numbers of this kind must be positive";
    default:
        return NULL;
    }
}

static double parse_radiosity_number(Converter *cv, int keyword) {
    Loc loc = here(cv);
    double value = parse_float(cv);
    const char *fault = radiosity_fault(keyword, value);
    if (fault)
        die_at(&loc, "Radiosity %s", fault);
    return value;
}

// count F [, F]: out of how many directions; nearest_count F [, F]: which may be given up.
static void parse_radiosity_counts(Converter *cv, int keyword) {
    double count = floor(parse_radiosity_number(cv, keyword));
    optional_comma(cv);
    Loc loc = here(cv);
    double other = keyword == KW_count ? fmax(count, 1600) : 0;
    if (starts_expression(cv))
        other = trunc(parse_float(cv));
    if (keyword == KW_count && !(other >= count))
        die_at(&loc, "Radiosity count can not be more than direction pool size");
    if (keyword == KW_nearest_count && !(other >= 0 && other < count))
        die_at(&loc, "Radiosity nearest_count's second value must be below the first");
}

static bool parse_radiosity_item(Converter *cv, RadiosityLimits *limits) {
    int code = peek_token(cv)->code;
    switch (code) {
    case KW_count:
    case KW_nearest_count:
        next_token(cv);
        parse_radiosity_counts(cv, code);
        return true;
    case KW_maximum_reuse:
    case KW_minimum_reuse:
        next_token(cv);
        limits->reuse[code == KW_maximum_reuse] = parse_radiosity_number(cv, code);
        limits->given[code == KW_maximum_reuse] = true;
        return true;
    case KW_pretrace_start:
    case KW_pretrace_end:
        next_token(cv);
        limits->pretrace[code == KW_pretrace_end] = parse_radiosity_number(cv, code);
        return true;
    case KW_always_sample:
    case KW_media:
    case KW_normal:
    case KW_subsurface:
        next_token(cv);
        parse_float(cv);
        return true;
    case KW_load_file:
    case KW_save_file:
        next_token(cv);
        parse_file_name(cv);
        return true;
    case KW_adc_bailout:
    case KW_brightness:
    case KW_error_bound:
    case KW_gray_threshold:
    case KW_low_error_factor:
    case KW_max_sample:
    case KW_recursion_limit:
        next_token(cv);
        parse_radiosity_number(cv, code);
        return true;
    default:
        return false;
    }
}

static void parse_radiosity_block(Converter *cv) {
    RadiosityLimits *limits = &cv->nodes->radiosity;
    Loc loc = here(cv);
    expect(cv, '{', "radiosity");
    while (parse_radiosity_item(cv, limits)) {
    }
    expect(cv, '}', "radiosity");
    if (limits->pretrace[1] > limits->pretrace[0])
        die_at(&loc, "Radiosity pretrace end must be smaller than or equal to pretrace start");
    if (limits->given[0] && limits->given[1] && limits->reuse[0] >= limits->reuse[1])
        die_at(&loc, "Radiosity maximum_reuse must be larger than minimum_reuse");
}

// media F [, F]
static void parse_photons_media(Converter *cv) {
    Loc loc = here(cv);
    double steps = trunc(parse_float(cv)), factor = 1;
    optional_comma(cv);
    if (starts_expression(cv))
        factor = parse_float(cv);
    if (!(steps >= 0) || !(factor > 0))
        die_at(&loc, "photons need a number of media steps that is not negative, and a spacing "
                     "factor above 0");
}

static bool parse_photons_item(Converter *cv, double gather[2]) {
    double unused[2];
    switch (peek_token(cv)->code) {
    case KW_radius:
        next_token(cv);
        for (int i = 0; i < 4; i++) {
            if (starts_expression(cv))
                parse_float(cv);
            optional_comma(cv);
        }
        return true;
    case KW_gather:
        next_token(cv);
        parse_two_floats(cv, gather);
        return true;
    case KW_media:
        next_token(cv);
        parse_photons_media(cv);
        return true;
    case KW_expand_thresholds:
        next_token(cv);
        parse_two_floats(cv, unused);
        return true;
    case KW_load_file:
    case KW_save_file:
        next_token(cv);
        parse_file_name(cv);
        return true;
    case KW_spacing:
    case KW_count:
    case KW_jitter:
    case KW_max_trace_level:
    case KW_adc_bailout:
    case KW_autostop:
        next_token(cv);
        parse_float(cv);
        return true;
    default:
        return false;
    }
}

static void parse_photons_settings(Converter *cv) {
    double gather[2] = {20, 100};
    Loc loc = here(cv);
    expect(cv, '{', "photons");
    while (parse_photons_item(cv, gather)) {
    }
    expect(cv, '}', "photons");
    double least = trunc(gather[0]), most = trunc(gather[1]);
    if (most > 0 && !(least >= 0 && least <= most))
        die_at(&loc, "photons gather %g to %g: the first must be from 0 to the second", least,
               most);
}

static void parse_subsurface_settings(Converter *cv) {
    double samples[2];
    expect(cv, '{', "subsurface");
    for (;;) {
        if (accept(cv, KW_samples))
            parse_two_floats(cv, samples);
        else if (accept(cv, KW_radiosity))
            parse_float(cv);
        else
            break;
    }
    expect(cv, '}', "subsurface");
}

bool parse_number_setting(Converter *cv, const Token *token) {
    Settings *settings = &cv->nodes->settings;
    switch (token->code) {
    case KW_max_trace_level:
        next_token(cv);
        settings->max_trace_level = parse_limited(cv, token, 1, 256);
        return true;
    case KW_adc_bailout:
        next_token(cv);
        settings->adc_bailout = (float)parse_float(cv);
        return true;
    case KW_number_of_waves:
        next_token(cv);
        settings->number_of_waves = parse_limited(cv, token, 1, 1000000);
        return true;
    case KW_noise_generator:
        next_token(cv);
        parse_noise_generator(cv, token);
        return true;
    case KW_mm_per_unit:
    case KW_max_intersections: // without effect
        next_token(cv);
        parse_float(cv);
        return true;
    case KW_hf_gray_16: // without effect
        next_token(cv);
        parse_optional_bool(cv);
        return true;
    default:
        return false;
    }
}

static bool parse_setting(Converter *cv) {
    Nodes *nodes = cv->nodes;
    const Token *token = peek_token(cv);
    if (parse_number_setting(cv, token))
        return true;
    switch (token->code) {
    case KW_assumed_gamma:
        next_token(cv);
        parse_assumed_gamma(cv, token);
        return true;
    case KW_ambient_light:
        next_token(cv);
        nodes->settings.ambient_light = parse_color3(cv);
        return true;
    case KW_irid_wavelength:
        next_token(cv);
        nodes->settings.irid_wavelength = parse_color3(cv);
        return true;
    case KW_charset:
        next_token(cv);
        parse_charset(cv);
        return true;
    case KW_radiosity:
        next_token(cv);
        parse_radiosity_block(cv);
        note_gap(cv, &nodes->gaps, token,
                 "radiosity is not modelled: surfaces do not light one another");
        return true;
    case KW_photons:
        next_token(cv);
        parse_photons_settings(cv);
        note_gap(cv, &nodes->gaps, token,
                 "photons are not modelled: no light is bundled by glass or mirrors");
        return true;
    case KW_subsurface:
        next_token(cv);
        parse_subsurface_settings(cv);
        return true;
    default:
        return false;
    }
}

void parse_global_settings(Converter *cv) {
    expect(cv, '{', "global_settings");
    while (parse_setting(cv)) {
    }
    expect(cv, '}', "global_settings");
}
