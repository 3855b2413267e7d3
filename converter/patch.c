// SPDX-License-Identifier: MIT
// bicubic_patch { keywords [uv_vectors UV UV UV UV] 16 points (facts: sdl 4.2, rendering 7.1).
// Group i of four points is weighted with u, position j inside it with v.
#include "converter/nodes.h"

#include <limits.h>
#include <math.h>

// What the keywords say. POV-Ray cuts the numbers off to integers.
typedef struct {
    bool has_type;
    int type;
    double flatness;
    int u_steps, v_steps;
} Header;

static int truncated(double value) {
    if (!(value > (double)INT_MIN)) // NaN too
        return value < 0 ? INT_MIN : 0;
    return value < (double)INT_MAX ? (int)value : INT_MAX;
}

static bool is_header_keyword(int code) {
    return code == KW_type || code == KW_flatness || code == KW_u_steps || code == KW_v_steps ||
           code == KW_accuracy || code == KW_uv_vectors;
}

// { type F | flatness F | u_steps F | v_steps F | accuracy F }*, no commas between them.
static void parse_keywords(Converter *cv, Header *header) {
    for (;;) {
        if (accept(cv, KW_type)) {
            header->type = truncated(parse_float(cv));
            header->has_type = true;
        } else if (accept(cv, KW_flatness)) {
            header->flatness = parse_float(cv);
        } else if (accept(cv, KW_u_steps)) {
            header->u_steps = truncated(parse_float(cv));
        } else if (accept(cv, KW_v_steps)) {
            header->v_steps = truncated(parse_float(cv));
        } else if (accept(cv, KW_accuracy)) {
            parse_float(cv); // without effect
        } else {
            return;
        }
    }
}

// The form before 3.0: F(type) [F(flatness) if type is 2 or 3] F(u) F(v).
static void parse_old_header(Converter *cv, Header *header) {
    Loc loc = here(cv);
    warn_at(&loc, "numbers without keywords are an old form of bicubic_patch");
    header->type = truncated(parse_float(cv));
    header->has_type = true;
    header->flatness = header->type == 2 || header->type == 3 ? parse_float(cv) : 0.1;
    header->u_steps = truncated(parse_float(cv));
    header->v_steps = truncated(parse_float(cv));
}

static void check_type(Converter *cv, const Token *start, Header *header) {
    Loc loc = token_loc(cv, start);
    if (!header->has_type || header->type < 0)
        die_at(&loc, "bicubic_patch needs 'type' with 0 or 1");
    if (header->type > 1) {
        warn_at(&loc, "bicubic_patch type %d is treated as type 1", header->type);
        header->type = 1;
    }
}

static void parse_points(Converter *cv, Vec3 *points) {
    for (int i = 0; i < 16; i++) {
        if (i > 0)
            optional_comma(cv);
        const Token *token = peek_token(cv);
        if (!starts_expression(cv))
            die_expected(cv, arena_printf(cv->arena, "point %d of 16 in bicubic_patch", i + 1));
        points[i] = parse_vector(cv);
        if (!vec_is_finite(points[i])) {
            Loc loc = token_loc(cv, token);
            die_at(&loc,
                   "point %d of the patch (group %d, position %d) is not finite: <%g, %g, %g>",
                   i + 1, i / 4 + 1, i % 4 + 1, points[i].x, points[i].y, points[i].z);
        }
    }
    if (starts_expression(cv))
        die_expected(cv, "a modifier or '}' after the 16 points of bicubic_patch");
}

void parse_patch_data(Converter *cv, ObjectNode *object) {
    const Token *start = peek_token(cv);
    Header header = {0};
    PatchShape *patch = &object->object.shape.patch;
    const Vec2 corners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    if (start->code == TOK_NUMBER || peek_value_type(cv) == VALUE_FLOAT)
        parse_old_header(cv, &header);
    else
        parse_keywords(cv, &header);
    for (int i = 0; i < 4; i++)
        patch->uv[i] = corners[i];
    if (accept(cv, KW_uv_vectors)) {
        for (int i = 0; i < 4; i++) {
            if (i > 0)
                optional_comma(cv);
            patch->uv[i] = parse_uv(cv);
        }
    }
    check_type(cv, start, &header);
    bool comma = accept(cv, ',');
    if (is_header_keyword(peek_token(cv)->code)) {
        Loc loc = here(cv);
        die_at(&loc, "%s",
               comma ? "no comma may stand between the keywords of bicubic_patch"
                     : "in bicubic_patch uv_vectors must be the last keyword");
    }
    patch->degree_u = patch->degree_v = 3;
    patch->type = header.type;
    patch->flatness = header.flatness;
    patch->u_steps = header.u_steps < 0 ? 0 : header.u_steps;
    patch->v_steps = header.v_steps < 0 ? 0 : header.v_steps;
    patch->points = ARENA_ARRAY(cv->arena, Vec3, 16);
    parse_points(cv, patch->points);
}
