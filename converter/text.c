// SPDX-License-Identifier: MIT
// text: from a TrueType font (read by FreeType, in the font's own units) to outlines. Letters are
// set as POV-Ray sets them (facts: rendering 8): the first begins at x = 0, the next ones follow by
// the advance of the one before and the pair's kerning; the whole is turned by a thousandth of a
// degree about each axis.
#include "converter/nodes.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H

typedef struct {
    ARRAY(double) arcs;
    Vec2 pen, origin; // in font units; where the letter stands, in ems
    double unit;
    bool cubic; // the font has arcs that a TrueType font has not
} Pen;

static void put_point(Pen *pen, double x, double y) {
    array_push(&pen->arcs, pen->origin.u + x * pen->unit);
    array_push(&pen->arcs, pen->origin.v + y * pen->unit);
}

static void put_arc(Pen *pen, Vec2 control, Vec2 end) {
    put_point(pen, pen->pen.u, pen->pen.v);
    put_point(pen, control.u, control.v);
    put_point(pen, end.u, end.v);
    pen->pen = end;
}

static Vec2 from_ft(const FT_Vector *v) { return (Vec2){(double)v->x, (double)v->y}; }

static int move_to(const FT_Vector *to, void *context) {
    ((Pen *)context)->pen = from_ft(to);
    return 0;
}

static int line_to(const FT_Vector *to, void *context) {
    Pen *pen = context;
    Vec2 end = from_ft(to);
    if (end.u != pen->pen.u || end.v != pen->pen.v)
        put_arc(pen, (Vec2){0.5 * (pen->pen.u + end.u), 0.5 * (pen->pen.v + end.v)}, end);
    return 0;
}

static int conic_to(const FT_Vector *control, const FT_Vector *to, void *context) {
    put_arc(context, from_ft(control), from_ft(to));
    return 0;
}

static int cubic_to(const FT_Vector *a, const FT_Vector *b, const FT_Vector *to, void *context) {
    (void)a, (void)b;
    ((Pen *)context)->cubic = true;
    return line_to(to, context);
}

// The next code point of UTF-8 text; what is no UTF-8 counts byte by byte.
static unsigned next_code(const char **text) {
    const unsigned char *s = (const unsigned char *)*text;
    int more = s[0] >= 0xf0 ? 3 : s[0] >= 0xe0 ? 2 : s[0] >= 0xc0 ? 1 : 0;
    unsigned code = more == 0 ? s[0] : s[0] & (0x3fU >> more);
    for (int i = 1; i <= more; i++) {
        if ((s[i] & 0xc0) != 0x80) {
            (*text)++;
            return s[0];
        }
        code = code << 6 | (s[i] & 0x3fU);
    }
    *text += more + 1;
    return code;
}

// Symbol fonts keep their letters in a private area.
static FT_UInt glyph_of(FT_Face face, unsigned code) {
    FT_UInt glyph = FT_Get_Char_Index(face, code);
    return glyph ? glyph : FT_Get_Char_Index(face, 0xf000U + code);
}

static double kerning(FT_Face face, FT_UInt left, FT_UInt right) {
    FT_Vector delta = {0, 0};
    if (!FT_HAS_KERNING(face) || FT_Get_Kerning(face, left, right, FT_KERNING_UNSCALED, &delta))
        return 0.0;
    return (double)delta.x;
}

typedef struct {
    Pen pen;
    ARRAY(uint32_t) letters;
} Setter;

static bool set_letters(Setter *s, FT_Face face, const char *text, Vec3 offset) {
    static const FT_Outline_Funcs calls = {move_to, line_to, conic_to, cubic_to, 0, 0};
    Vec2 at = {0, 0};
    FT_UInt left = 0;
    s->pen.unit = 1.0 / (double)face->units_per_EM;
    for (bool first = true; *text; first = false) {
        FT_UInt glyph = glyph_of(face, next_code(&text));
        if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE))
            return false;
        FT_BBox box;
        FT_Outline_Get_CBox(&face->glyph->outline, &box);
        double bearing = (double)face->glyph->metrics.horiBearingX;
        double low = face->glyph->outline.n_points > 0 ? (double)box.xMin : bearing;
        double advance = (double)face->glyph->metrics.horiAdvance;
        double pair = first ? 0.0 : kerning(face, left, glyph);
        s->pen.origin = at;
        s->pen.origin.u += s->pen.unit * (first ? -low : bearing - low + pair);
        array_push(&s->letters, (uint32_t)(s->pen.arcs.count / 6));
        if (FT_Outline_Decompose(&face->glyph->outline, &calls, &s->pen))
            return false;
        at.u += s->pen.unit * (first ? advance - bearing : advance + pair) + offset.x;
        at.v += offset.y;
        left = glyph;
    }
    return true;
}

// The file with the outlines; what the library keeps does not outlive the call.
static const char *set_text(Setter *s, const char *path, const char *text, Vec3 offset) {
    FT_Library library;
    FT_Face face;
    const char *why = NULL;
    if (FT_Init_FreeType(&library))
        return "FreeType does not start";
    if (FT_New_Face(library, path, 0, &face)) {
        why = "it is no font";
    } else {
        if (!FT_IS_SCALABLE(face) || !set_letters(s, face, text, offset) || s->pen.cubic)
            why = "it is no TrueType font";
        FT_Done_Face(face);
    }
    FT_Done_FreeType(library);
    return why;
}

// POV-Ray's built-in fonts, which its includes also have as files.
static const char *internal_font(Converter *cv) {
    static const char *const names[] = {"povlogo.ttf", "timrom.ttf", "cyrvetic.ttf", "crystal.ttf"};
    double number = parse_float(cv);
    return names[number >= 1 && number < 4 ? (int)number : 0];
}

// ttf S | internal F; S [,] F [,] V
void parse_text(Converter *cv, ObjectNode *object) {
    const Token *token = peek_token(cv);
    const char *name;
    if (accept(cv, KW_internal)) {
        name = internal_font(cv);
    } else {
        expect(cv, KW_ttf, "text");
        token = peek_token(cv);
        name = parse_file_name(cv);
    }
    optional_comma(cv);
    const char *text = parse_string(cv);
    optional_comma(cv);
    double thickness = parse_float(cv);
    optional_comma(cv);
    Vec3 offset = parse_vector(cv);
    const char *path = source_find(cv, name, FILE_FONT), *why = "it is not there";
    Setter s = {0};
    if (path)
        why = set_text(&s, path, text, offset);
    if (why) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "cannot use the font '%s': %s", name, why);
    }
    TextShape *shape = &object->object.shape.text;
    shape->thickness = thickness;
    shape->arc_count = (uint32_t)(s.pen.arcs.count / 6);
    shape->arcs = arena_copy(cv->arena, s.pen.arcs.items, s.pen.arcs.count * sizeof(double));
    shape->letter_count = (uint32_t)s.letters.count;
    shape->letters =
        arena_copy(cv->arena, s.letters.items, s.letters.count * sizeof *s.letters.items);
    array_free(&s.pen.arcs);
    array_free(&s.letters);
    object->object.has_transform = true;
    object->object.transform = transform_rotate(vec3(1e-3, 1e-3, 1e-3));
}
