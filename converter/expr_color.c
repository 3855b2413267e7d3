// SPDX-License-Identifier: MIT
// Colours (facts: sdl 2.3): five components, each rounded to single precision as it is stored.
//
//   COLOR := [color] { BASE | (red|green|blue|filter|transmit) ADD }
//   BASE  := (rgb|rgbf|rgbt|rgbft|srgb|srgbf|srgbt|srgbft) FULL | FULL     only as the first item
#include "converter/language.h"

#include <math.h>

enum { RED, GREEN, BLUE, FILTER, TRANSMIT };

bool is_color_keyword(int code) {
    switch (code) {
    case KW_color:
    case KW_colour:
    case KW_red:
    case KW_green:
    case KW_blue:
    case KW_filter:
    case KW_transmit:
    case KW_alpha:
    case KW_rgb:
    case KW_rgbf:
    case KW_rgbt:
    case KW_rgbft:
    case KW_srgb:
    case KW_srgbf:
    case KW_srgbt:
    case KW_srgbft:
        return true;
    default:
        return false;
    }
}

bool starts_color(Converter *cv) {
    return is_color_keyword(peek_token(cv)->code) || peek_value_type(cv) == VALUE_COLOR;
}

// The transfer curve of IEC 61966-2-1, to linear light. In single precision throughout, as
// POV-Ray has it.
static float srgb_decode(float v) {
    return v <= 0.04045f ? v / 12.92f : powf((v + 0.055f) / 1.055f, 2.4f);
}

// Into the working space that assumed_gamma chose.
static float to_working_space(const Converter *cv, float v) {
    if (cv->gamma_is_srgb)
        return v;
    float linear = srgb_decode(v);
    return cv->gamma == 1 ? linear : powf(linear, 1.0f / (float)cv->gamma);
}

// After a base keyword: how many components it expects, where the last one goes.
static void parse_base(Converter *cv, const Token *keyword, float out[5]) {
    bool srgb = keyword->text[0] == 's';
    const char *letters = keyword->text + (srgb ? 4 : 3); // after "rgb": "", "f", "t" or "ft"
    int want = 3 + (letters[0] != '\0') + (letters[0] != '\0' && letters[1] != '\0');
    if (srgb && !cv->gamma_set) {
        Loc loc = token_loc(cv, keyword);
        die_at(&loc, "Cannot parse sRGB colors before assumed_gamma has been set: write "
                     "global_settings { assumed_gamma 1 } before this");
    }
    double e[5] = {0};
    int width = parse_full(cv, e, want);
    if (width != want) {
        Loc loc = token_loc(cv, keyword);
        warn_at(&loc, "Suspicious expression after %s: it has %d components, not %d", keyword->text,
                width, want);
    }
    for (int i = 0; i < width; i++)
        out[i] = (float)e[i];
    if (want == 4 && letters[0] == 't') {
        out[TRANSMIT] = out[FILTER];
        out[FILTER] = 0;
    }
    for (int i = 0; srgb && i < 3; i++)
        out[i] = to_working_space(cv, out[i]);
}

static bool is_base_keyword(int code) {
    return is_color_keyword(code) && keyword_name(code)[0] != 'c' &&
           (keyword_name(code)[0] == 's' || keyword_name(code)[1] == 'g');
}

static int component_of(Converter *cv, const Token *keyword) {
    switch (keyword->code) {
    case KW_red:
        return RED;
    case KW_green:
        return GREEN;
    case KW_blue:
        return BLUE;
    case KW_transmit:
        return TRANSMIT;
    case KW_alpha: {
        Loc loc = token_loc(cv, keyword);
        warn_at(&loc, "Keyword alpha discontinued: read as filter");
        return FILTER;
    }
    default:
        return FILTER;
    }
}

static void parse_plain_base(Converter *cv, float out[5], bool with_filter) {
    const Token *start = peek_token(cv);
    double e[5] = {0};
    int want = with_filter ? 5 : 3, width = parse_full(cv, e, want);
    if (width < want) {
        Loc loc = token_loc(cv, start);
        die_at(&loc, "Color expression expected but float or vector expression found");
    }
    for (int i = 0; i < width; i++)
        out[i] = (float)e[i];
}

static void parse_color_components(Converter *cv, float out[5], bool with_filter) {
    for (int i = 0; i < 5; i++)
        out[i] = 0;
    const Token *start = peek_token(cv);
    if (!accept(cv, KW_color))
        accept(cv, KW_colour);
    for (bool first = true;; first = false) {
        int code = peek_token(cv)->code;
        if (is_base_keyword(code)) {
            if (!first)
                break;
            const Token *keyword = next_token(cv);
            parse_base(cv, keyword, out);
        } else if (is_color_keyword(code) && code != KW_color && code != KW_colour) {
            const Token *keyword = next_token(cv);
            int component = component_of(cv, keyword);
            out[component] = (float)parse_float(cv);
        } else if (first && starts_expression(cv)) {
            parse_plain_base(cv, out, with_filter);
        } else {
            break;
        }
    }
    if (!with_filter && (out[FILTER] != 0 || out[TRANSMIT] != 0)) {
        Loc loc = token_loc(cv, start);
        warn_at(&loc, "Expected a pure RGB color: filter and transmit have no effect here");
    }
}

Color parse_color(Converter *cv) {
    float c[5];
    parse_color_components(cv, c, true);
    return (Color){c[0], c[1], c[2], c[3], c[4]};
}

Rgb parse_color3(Converter *cv) {
    float c[5];
    parse_color_components(cv, c, false);
    return rgb(c[0], c[1], c[2]);
}
