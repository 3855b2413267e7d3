// SPDX-License-Identifier: MIT
// camera{} (facts: sdl 4.10, rendering 1.1, 1.2). From version 3.5 on the values are collected and
// applied at the end in a fixed order; before, each acts where it stands. The order of the
// operations is POV-Ray's, since every ray depends on the last bits of these vectors.
#include "converter/nodes.h"

#include <math.h>

static const double RADIANS_PER_HALF_DEGREE = 0.00872664625997164788461845384244; // pi / 360
static const double NEAR_ZERO = 1e-10;                                            // POV-Ray's limit

typedef struct {
    CameraNode *node;
    bool old; // version < 3.5: everything acts at once
    bool has_up, has_right, has_angle, has_look_at;
    double angle;
    double direction_length; // when it was measured last; the focal distance if none is given
    bool has_focal_point;
    Vec3 focal_point;
    const Token *bokeh;
    Transform transform;
} Reader;

static bool is_type(int code) {
    return code == KW_perspective || code == KW_orthographic || code == KW_fisheye ||
           code == KW_ultra_wide_angle || code == KW_omnimax || code == KW_panoramic ||
           code == KW_spherical || code == KW_cylinder || code == KW_mesh_camera;
}

// |direction| = |right| / (2 tan(angle / 2))
static void apply_angle(Reader *reader, double angle) {
    Camera *camera = &reader->node->camera;
    camera->direction = vec_normalize(camera->direction);
    double length = vec_length(camera->right) / tan(angle * RADIANS_PER_HALF_DEGREE) / 2.0;
    camera->direction = vec_scale(camera->direction, length);
    reader->direction_length = length;
}

static bool vanishes(Vec3 v) {
    return fabs(v.x) < NEAR_ZERO && fabs(v.y) < NEAR_ZERO && fabs(v.z) < NEAR_ZERO;
}

// Turns the camera towards look_at; lengths and handedness stay as they were before.
static void apply_look_at(Converter *cv, Reader *reader, const Token *token) {
    CameraNode *node = reader->node;
    Camera *camera = &node->camera;
    double direction = vec_length(camera->direction), up = vec_length(camera->up),
           right = vec_length(camera->right);
    reader->direction_length = direction;
    double handedness = vec_dot(vec_cross(camera->up, camera->direction), camera->right);
    Vec3 towards = vec_sub(node->look_at, camera->location);
    Loc loc = token_loc(cv, token);
    // POV-Ray refuses less than 1e-5, too; a scene may be as small as that.
    if (!(vec_dot(towards, towards) > 0.0))
        die_at(&loc, "look_at is the same point as the camera's location");
    towards = vec_normalize(towards);
    Vec3 across = vec_cross(node->sky, towards);
    if (vanishes(across)) {
        if (!reader->old)
            warn_at(&loc, "the camera looks along the sky vector: its own right vector is used");
        across = camera->right;
    }
    across = vec_normalize(across);
    camera->up = vec_scale(vec_cross(towards, across), up);
    camera->direction = vec_scale(towards, direction);
    camera->right = vec_scale(across, handedness > 0.0 ? right : -right);
}

// An orthographic picture is as large as the perspective one at look_at.
static void apply_orthographic(CameraNode *node) {
    Camera *camera = &node->camera;
    double distance = vec_length(vec_sub(node->look_at, camera->location)),
           direction = vec_length(camera->direction);
    if (distance > NEAR_ZERO && direction > NEAR_ZERO) {
        camera->right = vec_scale(camera->right, distance / direction);
        camera->up = vec_scale(camera->up, distance / direction);
    }
}

static void apply_focal_point(Reader *reader) {
    CameraNode *node = reader->node;
    Vec3 towards = vec_sub(reader->focal_point, node->camera.location);
    node->camera.blur.focal_distance = vec_length(towards);
    node->has_focus = true;
}

static void move_camera(Camera *camera, const Transform *t) {
    camera->location = transform_point(t, camera->location);
    camera->direction = transform_dir(t, camera->direction);
    camera->up = transform_dir(t, camera->up);
    camera->right = transform_dir(t, camera->right);
}

static void move_camera_now(Camera *camera, const Move *move) {
    if (move->kind == MOVE_TRANSLATE)
        camera->location = vec_add(camera->location, move->v);
    else
        move_camera(camera, &move->t);
}

// mesh_camera { F F [F] meshes [smooth] }
static void parse_mesh_camera(Converter *cv) {
    expect(cv, '{', "mesh_camera");
    const Token *token = peek_token(cv);
    double rays = floor(number_within(cv, "number of rays per pixel", 1, 4e9));
    double method = floor(number_within(cv, "distribution method", 0, 3));
    if (starts_expression(cv))
        parse_float(cv);
    uint32_t meshes = 0;
    while (next_is(cv, KW_mesh) || next_is(cv, KW_mesh2)) {
        parse_object(cv);
        meshes++;
    }
    Loc loc = here(cv);
    if (accept(cv, KW_smooth) && method != 3)
        die_at(&loc, "Smooth can only be used with distribution method 3");
    expect(cv, '}', "mesh_camera");
    loc = token_loc(cv, token);
    if (meshes == 0)
        die_at(&loc, "a mesh_camera needs a mesh or a mesh2");
    if (method >= 2 && rays != 1)
        die_at(&loc, "Rays per pixel must be 1 for distribution methods 2 and 3");
    if (method == 0 && rays > meshes)
        die_at(&loc, "Rays per pixel must be at most the number of meshes for method 0");
}

static CameraType parse_cylinder_type(Converter *cv, const Reader *reader, const Token *token) {
    double kind = parse_float(cv);
    Loc loc = token_loc(cv, token);
    bool known = kind >= 1 && kind < 5;
    if (!known && !reader->old)
        die_at(&loc, "a cylinder camera is of type 1, 2, 3 or 4");
    return known ? (CameraType)(CAMERA_CYLINDER_1 + (int)kind - 1) : reader->node->camera.type;
}

static void parse_type(Converter *cv, Reader *reader) {
    static const struct {
        int keyword;
        CameraType type;
    } types[] = {{KW_orthographic, CAMERA_ORTHOGRAPHIC},
                 {KW_fisheye, CAMERA_FISHEYE},
                 {KW_ultra_wide_angle, CAMERA_ULTRA_WIDE_ANGLE},
                 {KW_omnimax, CAMERA_OMNIMAX},
                 {KW_panoramic, CAMERA_PANORAMIC},
                 {KW_spherical, CAMERA_SPHERICAL}};
    const Token *token = next_token(cv);
    CameraNode *node = reader->node;
    node->gaps = NULL; // of another type before
    CameraType type = CAMERA_PERSPECTIVE;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (types[i].keyword == token->code)
            type = types[i].type;
    node->camera.type = token->code == KW_cylinder ? parse_cylinder_type(cv, reader, token) : type;
    if (token->code == KW_mesh_camera) {
        parse_mesh_camera(cv);
        note_gap(cv, &node->gaps, token,
                 "mesh_camera is not modelled: the picture is a perspective one");
    }
    if (reader->old && token->code == KW_orthographic)
        apply_orthographic(node);
}

static bool is_flat(const Reader *reader) {
    CameraType type = reader->node->camera.type;
    return type == CAMERA_PERSPECTIVE || type == CAMERA_ORTHOGRAPHIC;
}

static double parse_one_angle(Converter *cv, const Token *token) {
    double angle = parse_float(cv);
    Loc loc = token_loc(cv, token);
    if (angle < 0.0)
        die_at(&loc, "the angle of a camera must not be negative");
    return angle;
}

// angle F [, F]; an orthographic camera may do without a number
static void parse_angle(Converter *cv, Reader *reader, const Token *token) {
    Camera *camera = &reader->node->camera;
    if (camera->type == CAMERA_SPHERICAL && !reader->old) {
        camera->spherical_deg[0] = parse_one_angle(cv, token);
        optional_comma(cv);
        camera->spherical_deg[1] = camera->spherical_deg[0] * 0.5;
        if (starts_expression(cv))
            camera->spherical_deg[1] = parse_one_angle(cv, token);
        return;
    }
    bool bare = camera->type == CAMERA_ORTHOGRAPHIC && !reader->old && !starts_expression(cv);
    reader->angle = bare ? 0.0 : parse_one_angle(cv, token);
    reader->has_angle = true;
    Loc loc = token_loc(cv, token);
    if (is_flat(reader) && reader->angle >= 180.0)
        die_at(&loc, "the angle of a camera must be less than 180 degrees");
    optional_comma(cv);
    if (reader->old) {
        camera->angle_deg = reader->angle;
        if (camera->type == CAMERA_PERSPECTIVE)
            apply_angle(reader, reader->angle);
    }
}

static bool parse_vectors(Converter *cv, Reader *reader, const Token *token) {
    CameraNode *node = reader->node;
    switch (token->code) {
    case KW_location:
        next_token(cv);
        node->camera.location = parse_vector(cv);
        return true;
    case KW_direction:
        next_token(cv);
        node->camera.direction = parse_vector(cv);
        return true;
    case KW_right:
        next_token(cv);
        node->camera.right = parse_vector(cv);
        reader->has_right = true;
        return true;
    case KW_up:
        next_token(cv);
        node->camera.up = parse_vector(cv);
        reader->has_up = true;
        return true;
    case KW_sky:
        next_token(cv);
        node->sky = parse_vector(cv);
        return true;
    case KW_look_at:
        next_token(cv);
        node->look_at = parse_vector(cv);
        reader->has_look_at = true;
        if (reader->old)
            apply_look_at(cv, reader, token);
        return true;
    case KW_angle:
        next_token(cv);
        parse_angle(cv, reader, token);
        return true;
    default:
        return false;
    }
}

// blur_samples [F,] F
static void parse_blur_samples(Converter *cv, const Reader *reader, const Token *token) {
    FocalBlur *blur = &reader->node->camera.blur;
    double first = parse_float(cv), last = 0.0;
    optional_comma(cv);
    if (starts_expression(cv) && !reader->old)
        last = trunc(parse_float(cv));
    Loc loc = token_loc(cv, token);
    double least = last != 0.0 ? first : 0.0, most = last != 0.0 ? last : first;
    if (!(first > 0.0))
        die_at(&loc, "blur_samples must be positive");
    if (!(most <= CAMERA_MAX_BLUR_SAMPLES))
        die_at(&loc, "blur_samples must be at most %d", CAMERA_MAX_BLUR_SAMPLES);
    if (trunc(least) > most)
        die_at(&loc, "the least number of blur_samples must not be larger than the largest");
    blur->samples = (int)most;
    blur->min_samples = (int)least;
}

static void parse_share(Converter *cv, const Token *token, bool ends, double *to) {
    double value = parse_float(cv);
    Loc loc = token_loc(cv, token);
    if ((value > 0.0 && value < 1.0) || (ends && value >= 0.0 && value <= 1.0))
        *to = value;
    else
        warn_at(&loc, "%s must lie between 0 and 1: the default is used", token->text);
}

static bool parse_blur(Converter *cv, Reader *reader, const Token *token) {
    FocalBlur *blur = &reader->node->camera.blur;
    switch (token->code) {
    case KW_aperture:
        next_token(cv);
        blur->aperture = parse_float(cv);
        return true;
    case KW_blur_samples:
        next_token(cv);
        parse_blur_samples(cv, reader, token);
        return true;
    case KW_focal_point:
        next_token(cv);
        reader->focal_point = parse_vector(cv);
        reader->has_focal_point = true;
        if (reader->old)
            apply_focal_point(reader);
        return true;
    case KW_confidence:
        next_token(cv);
        parse_share(cv, token, false, &blur->confidence);
        return true;
    case KW_variance:
        next_token(cv);
        parse_share(cv, token, true, &blur->variance);
        return true;
    default:
        return false;
    }
}

static bool parse_rest(Converter *cv, Reader *reader, const Token *token) {
    switch (token->code) {
    case KW_bokeh:
        next_token(cv);
        expect(cv, '{', "bokeh");
        if (accept(cv, KW_pigment))
            parse_pigment_block(cv, cv->nodes->default_texture->pigment);
        expect(cv, '}', "bokeh");
        reader->bokeh = token;
        return true;
    case KW_normal:
        next_token(cv);
        reader->node->normal = parse_normal_block(cv, reader->node->normal);
        return true;
    default:
        return false;
    }
}

static bool parse_item(Converter *cv, Reader *reader) {
    const Token *token = peek_token(cv);
    Move move;
    if (parse_vectors(cv, reader, token) || parse_blur(cv, reader, token) ||
        parse_rest(cv, reader, token))
        return true;
    if (parse_move(cv, &move)) {
        if (reader->old)
            move_camera_now(&reader->node->camera, &move);
        else
            reader->transform = transform_compose(&reader->transform, &move.t);
        return true;
    }
    if (!is_type(token->code))
        return false;
    if (!reader->old) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "the camera type '%s' must be the first item of the camera", token->text);
    }
    parse_type(cv, reader);
    return true;
}

// What version 3.5 and later do at the end, whatever the order of writing.
static void apply_collected(Converter *cv, Reader *reader) {
    CameraNode *node = reader->node;
    Camera *camera = &node->camera;
    if (reader->has_angle) {
        camera->angle_deg = reader->angle;
        if (is_flat(reader) && reader->angle > 0.0)
            apply_angle(reader, reader->angle);
    }
    if (reader->has_look_at)
        apply_look_at(cv, reader, peek_token(cv));
    bool sized = reader->has_up || reader->has_right;
    if (camera->type == CAMERA_ORTHOGRAPHIC && (!sized || reader->has_angle))
        apply_orthographic(node);
    if (reader->has_focal_point)
        apply_focal_point(reader);
    move_camera(camera, &reader->transform);
}

static void apply_blur(Converter *cv, Reader *reader) {
    CameraNode *node = reader->node;
    FocalBlur *blur = &node->camera.blur;
    if (!node->has_focus)
        blur->focal_distance = reader->direction_length;
    if (blur->focal_distance == 0.0)
        blur->focal_distance = 1.0;
    node->has_focus = true;
    node->camera.has_blur = blur->aperture != 0.0 && blur->samples > 0;
    if (node->camera.has_blur && reader->bokeh)
        note_gap(cv, &node->gaps, reader->bokeh,
                 "bokeh is not modelled: all of the lens is equally clear");
}

// From version 3.5 on only transforms may follow the name of a camera.
static CameraNode *parse_named(Converter *cv, const CameraNode *named) {
    CameraNode *node = arena_copy(cv->arena, named, sizeof *named);
    Move move;
    while (parse_move(cv, &move))
        move_camera_now(&node->camera, &move);
    return node;
}

CameraNode *parse_camera_block(Converter *cv) {
    Nodes *nodes = cv->nodes;
    expect(cv, '{', "camera");
    bool old = cv->version < 350;
    const Value *value = accept_value(cv, VALUE_CAMERA);
    if (value && !old) {
        CameraNode *node = parse_named(cv, value->node);
        expect(cv, '}', "camera after its name");
        return node;
    }
    const CameraNode *base = value                  ? value->node
                             : old && nodes->camera ? nodes->camera
                                                    : &nodes->default_camera;
    Reader reader = {.node = arena_copy(cv->arena, base, sizeof *base),
                     .old = old,
                     .direction_length = 1.0,
                     .transform = transform_identity()};
    reader.node->gaps = NULL;
    while (!old && is_type(peek_token(cv)->code))
        parse_type(cv, &reader);
    while (parse_item(cv, &reader)) {
    }
    if (!old)
        apply_collected(cv, &reader);
    apply_blur(cv, &reader);
    expect(cv, '}', "camera");
    return reader.node;
}
