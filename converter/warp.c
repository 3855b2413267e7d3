// SPDX-License-Identifier: MIT
// What moves a point before a pattern looks at it (facts: textures 1.6, 3.6): transforms, the block
// warp { ... }, and the turbulence of the pattern itself, which is one value a pattern wherever it
// is written.
#include "converter/nodes.h"

#include <math.h>

enum { MAX_OCTAVES = 10 }; // POV-Ray's own limit

static void push_warp(Converter *cv, PatternNode *pattern, const Warp *warp) {
    WarpNode *node = ARENA_NEW(cv->arena, WarpNode);
    *node = (WarpNode){.next = pattern->warps, .warp = *warp};
    pattern->warps = node;
}

// Consecutive transforms are one.
void pattern_move(Converter *cv, PatternNode *pattern, const Transform *transform) {
    Warp warp = warp_default(WARP_TRANSFORM);
    warp.transform = *transform;
    const WarpNode *head = pattern->warps;
    if (head && head->warp.type == WARP_TRANSFORM) {
        warp.transform = transform_compose(&head->warp.transform, transform);
        pattern->warps = head->next;
    }
    push_warp(cv, pattern, &warp);
}

static float parse_finite_float(Converter *cv) {
    Loc loc = here(cv);
    float value = (float)parse_float(cv);
    if (!isfinite(value))
        die_at(&loc, "%g is too large for single precision", (double)value);
    return value;
}

// octaves, omega, lambda, if the next token is one of them.
static bool parse_octaves(Converter *cv, Turbulence *turbulence) {
    switch (peek_token(cv)->code) {
    case KW_octaves: {
        next_token(cv);
        double octaves = parse_float(cv);
        turbulence->octaves = octaves >= MAX_OCTAVES ? MAX_OCTAVES : octaves < 1 ? 1 : (int)octaves;
        return true;
    }
    case KW_omega:
        next_token(cv);
        turbulence->omega = parse_finite_float(cv);
        return true;
    case KW_lambda:
        next_token(cv);
        turbulence->lambda = parse_finite_float(cv);
        return true;
    default:
        return false;
    }
}

bool parse_turbulence(Converter *cv, PatternNode *pattern) {
    Turbulence *turbulence = &pattern->shape.turbulence;
    if (accept(cv, KW_turbulence))
        turbulence->amount = parse_vector(cv);
    else if (!parse_octaves(cv, turbulence))
        return false;
    pattern->shape.has_turbulence = true;
    return true;
}

// ---- warp { KIND arguments } --------------------------------------------------------------------

static void parse_turbulence_warp(Converter *cv, Warp *warp) {
    warp->turbulence.amount = parse_vector(cv);
    while (parse_octaves(cv, &warp->turbulence)) {
    }
}

static void parse_repeat_warp(Converter *cv, Warp *warp) {
    RepeatWarp *repeat = &warp->repeat;
    Loc loc = here(cv);
    Vec3 v = parse_vector(cv);
    int axes = (v.x != 0) + (v.y != 0) + (v.z != 0);
    if (axes != 1)
        die_at(&loc, axes ? "a pattern can be repeated along one axis only"
                          : "the axis along which to repeat is missing");
    repeat->axis = v.x != 0 ? 0 : v.y != 0 ? 1 : 2;
    repeat->width = (float)vec_get(v, repeat->axis);
    if (repeat->width == 0 || !isfinite(repeat->width))
        die_at(&loc, "the width %g is out of range", vec_get(v, repeat->axis));
    for (;;) {
        if (accept(cv, KW_offset)) {
            repeat->offset = parse_vector(cv);
        } else if (accept(cv, KW_flip)) {
            Vec3 flip = parse_vector(cv);
            repeat->flip = vec3(flip.x != 0 ? -1 : 1, flip.y != 0 ? -1 : 1, flip.z != 0 ? -1 : 1);
        } else {
            return;
        }
    }
}

// Repeated holes must not overlap: along each repeated axis the centre moves in until the sphere
// is inside its block, and the block grows until it holds the sphere wherever it is shaken to.
static void make_room(BlackHoleWarp *hole) {
    double *center = &hole->center.x, *size = &hole->repeat_size.x;
    const double *shake = &hole->uncertainty.x;
    for (int i = 0; i < 3; i++) {
        if (!(size[i] > 0))
            continue;
        center[i] = fmax(center[i], hole->radius);
        size[i] = fmax(size[i], center[i] + hole->radius + shake[i]);
    }
}

// False: the warp does nothing (of another type than 0).
static bool parse_black_hole(Converter *cv, Warp *warp) {
    BlackHoleWarp *hole = &warp->black_hole;
    bool acts = true;
    hole->center = parse_vector(cv);
    optional_comma(cv);
    hole->radius = fabs(parse_float(cv)); // only its square counts
    for (;;) {
        if (accept(cv, KW_strength))
            hole->strength = parse_float(cv);
        else if (accept(cv, KW_falloff))
            hole->falloff = parse_float(cv);
        else if (accept(cv, KW_inverse))
            hole->inverse = true;
        else if (accept(cv, KW_type))
            acts = fabs(parse_float(cv)) < 1;
        else if (accept(cv, KW_repeat)) {
            hole->repeat = true;
            hole->repeat_size = parse_vector(cv);
        } else if (accept(cv, KW_turbulence))
            hole->uncertainty = parse_vector(cv);
        else
            break;
    }
    if (hole->repeat)
        make_room(hole);
    else
        hole->uncertainty = vec3(0, 0, 0);
    return acts;
}

static Vec3 parse_orientation(Converter *cv) {
    Loc loc = here(cv);
    Vec3 v = parse_vector(cv);
    if (!(vec_length(v) > 0) || !isfinite(vec_length(v)))
        die_at(&loc, "an orientation must have a length");
    return vec_normalize(v);
}

static void parse_mapping(Converter *cv, Warp *warp) {
    MappingWarp *mapping = &warp->mapping;
    if (warp->type == WARP_PLANAR) {
        if (starts_expression(cv)) {
            mapping->orientation = parse_orientation(cv);
            optional_comma(cv);
            mapping->distance = parse_float(cv);
        }
        return;
    }
    for (;;) {
        if (accept(cv, KW_orientation))
            mapping->orientation = parse_orientation(cv);
        else if (accept(cv, KW_dist_exp))
            mapping->dist_exp = parse_float(cv);
        else if (warp->type == WARP_TOROIDAL && accept(cv, KW_major_radius))
            mapping->major_radius = parse_float(cv);
        else
            return;
    }
}

static bool warp_kind(int code, WarpType *type) {
    static const struct {
        int keyword;
        WarpType type;
    } kinds[] = {
        {KW_turbulence, WARP_TURBULENCE}, {KW_repeat, WARP_REPEAT},
        {KW_black_hole, WARP_BLACK_HOLE}, {KW_cubic, WARP_CUBIC},
        {KW_planar, WARP_PLANAR},         {KW_spherical, WARP_SPHERICAL},
        {KW_toroidal, WARP_TOROIDAL},     {KW_cylindrical, WARP_CYLINDRICAL},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (kinds[i].keyword == code) {
            *type = kinds[i].type;
            return true;
        }
    return false;
}

void parse_warp(Converter *cv, PatternNode *pattern) {
    WarpType type;
    bool acts = true;
    expect(cv, '{', "warp");
    if (!warp_kind(peek_token(cv)->code, &type))
        die_expected(cv, "a kind of warp");
    next_token(cv);
    Warp warp = warp_default(type);
    switch (type) {
    case WARP_TURBULENCE:
        parse_turbulence_warp(cv, &warp);
        break;
    case WARP_REPEAT:
        parse_repeat_warp(cv, &warp);
        break;
    case WARP_BLACK_HOLE:
        acts = parse_black_hole(cv, &warp);
        break;
    case WARP_PLANAR:
    case WARP_SPHERICAL:
    case WARP_CYLINDRICAL:
    case WARP_TOROIDAL:
        parse_mapping(cv, &warp);
        break;
    case WARP_CUBIC:
    case WARP_TRANSFORM: // no kind of this block
        break;
    }
    expect(cv, '}', "warp");
    if (acts)
        push_warp(cv, pattern, &warp);
}
