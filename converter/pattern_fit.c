// SPDX-License-Identifier: MIT
// Which modifiers belong to which patterns: a modifier of another pattern is a mistake, as it is
// for POV-Ray.
#include "converter/nodes.h"

// The patterns that take a modifier.
typedef struct {
    int modifier;
    int patterns[7]; // ends with 0
    const char *names;
} Fit;

static const Fit fits[] = {
    {KW_agate_turb, {KW_agate}, "agate"},
    {KW_brick_size, {KW_brick}, "brick"},
    {KW_mortar, {KW_brick}, "brick"},
    {KW_control0, {KW_quilted}, "quilted"},
    {KW_control1, {KW_quilted}, "quilted"},
    {KW_form, {KW_crackle, KW_pavement}, "crackle or pavement"},
    {KW_offset, {KW_crackle}, "crackle"},
    {KW_solid, {KW_crackle}, "crackle"},
    {KW_metric, {KW_crackle, KW_facets}, "facets or crackle"},
    {KW_coords, {KW_facets}, "facets"},
    {KW_size, {KW_facets}, "facets"},
    {KW_exponent, {KW_mandel, KW_julia, KW_magnet}, "mandel or julia"},
    {KW_interior,
     {KW_mandel, KW_julia, KW_magnet, KW_pavement},
     "mandel, julia, magnet or pavement"},
    {KW_exterior,
     {KW_mandel, KW_julia, KW_magnet, KW_pavement},
     "mandel, julia, magnet or pavement"},
    {KW_interpolate, {KW_density_file}, "density_file"},
    {KW_number_of_sides, {KW_pavement}, "pavement"},
    {KW_number_of_tiles, {KW_pavement}, "pavement"},
    {KW_pattern, {KW_pavement}, "pavement"},
};

void check_modifier_fits(Converter *cv, const PatternInfo *info) {
    const Token *token = peek_token(cv);
    for (size_t i = 0; i < sizeof fits / sizeof *fits; i++) {
        if (fits[i].modifier != token->code)
            continue;
        for (const int *pattern = fits[i].patterns; *pattern; pattern++)
            if (*pattern == info->keyword)
                return;
        Loc loc = token_loc(cv, token);
        die_at(&loc, "Keyword '%s' can only be used in %s", token->text, fits[i].names);
    }
}

void parse_pavement_number(Converter *cv, PatternNode *pattern, int keyword) {
    double value = parse_float(cv);
    if (keyword == KW_form)
        return;
    // POV-Ray keeps a byte.
    int byte = fabs(value) < 2147483648.0 ? (int)value & 255 : 0;
    pattern->pavement[keyword == KW_number_of_sides   ? 0
                      : keyword == KW_number_of_tiles ? 1
                                                      : 2] = byte;
}

void check_pavement(const PatternNode *pattern) {
    static const int most[3][7] = {
        {3, 1, 1, 1, 3, 4, 12}, {4, 1, 1, 2, 5, 12, 35}, {6, 1, 1, 3, 7, 22}};
    const int sides = pattern->pavement[0], tiles = pattern->pavement[1];
    for (int i = 0; i < 3; i++) {
        if (most[i][0] != sides)
            continue;
        if (tiles < 1 || tiles > 6 || most[i][tiles] == 0)
            die_at(pattern->loc, "number_of_tiles of pavement must be from 1 to %d, not %d",
                   sides == 6 ? 5 : 6, tiles);
        if (pattern->pavement[2] < 1 || pattern->pavement[2] > most[i][tiles])
            die_at(pattern->loc,
                   "pattern of a pavement with %d sides and %d tiles must be from 1 to %d, not %d",
                   sides, tiles, most[i][tiles], pattern->pavement[2]);
        return;
    }
    die_at(pattern->loc, "number_of_sides of pavement must be 3, 4 or 6, not %d", sides);
}
