// SPDX-License-Identifier: MIT
// translate, rotate, scale, matrix and transform (facts: sdl 4.4). Row vectors; what is written
// later is applied later.
#include "converter/nodes.h"

// A zero component would flatten the object for ever; POV-Ray makes it 1.
static Vec3 parse_scale(Converter *cv) {
    const Token *token = peek_token(cv);
    Vec3 s = parse_vector(cv);
    const double *given[3] = {&s.x, &s.y, &s.z};
    Vec3 used = vec3(s.x == 0.0 ? 1.0 : s.x, s.y == 0.0 ? 1.0 : s.y, s.z == 0.0 ? 1.0 : s.z);
    for (int i = 0; i < 3; i++) {
        if (*given[i] == 0.0) {
            Loc loc = token_loc(cv, token);
            warn_at(&loc, "scale by 0 in %c is changed to 1", "xyz"[i]);
        }
    }
    return used;
}

// matrix < 12 floats >: the images of the axes, then the translation.
static Transform parse_matrix(Converter *cv) {
    const Token *token = peek_token(cv);
    double rows[4][3];
    expect(cv, '<', "matrix");
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 3; j++) {
            rows[i][j] = parse_float(cv);
            optional_comma(cv);
        }
    }
    expect(cv, '>', "matrix");
    Loc loc = token_loc(cv, token);
    for (int j = 0; j < 3; j++) {
        if (rows[0][j] == 0.0 && rows[1][j] == 0.0 && rows[2][j] == 0.0) {
            warn_at(&loc, "column %d of the matrix is 0: its diagonal is changed to 1", j + 1);
            rows[j][j] = 1.0;
        }
    }
    Transform t;
    if (!transform_matrix(rows, &t))
        die_at(&loc, "the matrix has no inverse");
    return t;
}

// { translate V | rotate V | scale V | matrix <...> | transform ... | ID | inverse }*
static Transform parse_transform_block(Converter *cv) {
    Transform t = transform_identity();
    bool inverse = false;
    Move move;
    expect(cv, '{', "transform");
    for (;;) {
        const Value *value;
        if (parse_move(cv, &move)) {
            t = transform_compose(&t, &move.t);
        } else if (accept(cv, KW_inverse)) {
            inverse = true;
        } else if ((value = accept_value(cv, VALUE_TRANSFORM))) {
            t = transform_compose(&t, value->node);
        } else {
            break;
        }
    }
    expect(cv, '}', "transform");
    return inverse ? transform_inverse(&t) : t;
}

Transform parse_transform(Converter *cv) {
    const Value *value = accept_value(cv, VALUE_TRANSFORM);
    if (value)
        return *(const Transform *)value->node;
    enter_level(cv);
    Transform t = parse_transform_block(cv);
    leave_level(cv);
    return t;
}

bool parse_move(Converter *cv, Move *move) {
    int code = peek_token(cv)->code;
    if (code != KW_translate && code != KW_rotate && code != KW_scale && code != KW_matrix &&
        code != KW_transform)
        return false;
    next_token(cv);
    *move = (Move){.kind = MOVE_MATRIX};
    if (code == KW_translate) {
        move->kind = MOVE_TRANSLATE;
        move->v = parse_vector(cv);
        move->t = transform_translate(move->v);
    } else if (code == KW_rotate) {
        move->kind = MOVE_ROTATE;
        move->v = parse_vector(cv);
        move->t = transform_rotate(move->v);
    } else if (code == KW_scale) {
        move->kind = MOVE_SCALE;
        move->v = parse_scale(cv);
        move->t = transform_scale(move->v);
    } else if (code == KW_matrix) {
        move->t = parse_matrix(cv);
    } else {
        move->t = parse_transform(cv);
    }
    return true;
}
