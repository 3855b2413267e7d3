// SPDX-License-Identifier: MIT
// The data of the larger primitives (facts: sdl 4.2, rendering 8). Their numbers stay as they are
// written: transforms become a matrix beside them.
#include "converter/nodes.h"

_Static_assert(sizeof(QuadricShape) == 10 * sizeof(double), "ten numbers");

#include <math.h>
#include <string.h>

// POV-Ray's limit below which two points are one.
static const double SAME = 1e-10;

void read_floats(Converter *cv, double *out, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        if (i > 0)
            optional_comma(cv);
        out[i] = parse_float(cv);
    }
}

static void die_count(Converter *cv, const Token *token, const char *what, int least) {
    Loc loc = token_loc(cv, token);
    die_at(&loc, "a %s needs at least %d points", what, least);
}

// F(n) first, as a count of what follows. More than any scene has is a mistake, not a loop.
uint32_t read_count(Converter *cv, const char *what, int least) {
    const Token *token = peek_token(cv);
    double count = parse_float(cv);
    if (!(count >= least))
        die_count(cv, token, what, least);
    if (!(count <= 1e8)) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "a %s of %g points is too large", what, count);
    }
    optional_comma(cv);
    return (uint32_t)count;
}

// As many points as the text has, up to count: memory follows what is there.
static Vec2 *read_points(Converter *cv, uint32_t count) {
    ARRAY(Vec2) points = {0};
    for (uint32_t i = 0; i < count; i++) {
        if (i > 0)
            optional_comma(cv);
        array_push(&points, parse_uv(cv));
    }
    Vec2 *kept = arena_copy(cv->arena, points.items, points.count * sizeof(Vec2));
    array_free(&points);
    return kept;
}

static bool accept_outline(Converter *cv, OutlineType *type) {
    static const struct {
        int keyword;
        OutlineType type;
    } words[] = {{KW_linear_spline, OUTLINE_LINEAR},
                 {KW_quadratic_spline, OUTLINE_QUADRATIC},
                 {KW_cubic_spline, OUTLINE_CUBIC},
                 {KW_bezier_spline, OUTLINE_BEZIER},
                 {KW_b_spline, OUTLINE_B_SPLINE}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (accept(cv, words[i].keyword)) {
            *type = words[i].type;
            return true;
        }
    return false;
}

// ---- polynomials ----------------------------------------------------------------------------

static double *read_coefficients(Converter *cv, uint32_t count, const char *where) {
    double *out = ARENA_ARRAY(cv->arena, double, count);
    optional_comma(cv);
    expect(cv, '<', where);
    read_floats(cv, out, count);
    optional_comma(cv);
    expect(cv, '>', where);
    return out;
}

static uint32_t term_count(int order) {
    uint32_t n = (uint32_t)order;
    return (n + 1) * (n + 2) * (n + 3) / 6;
}

static int read_order(Converter *cv) {
    const Token *token = peek_token(cv);
    double given = parse_float(cv);
    if (!(given >= 2 && given <= SCENE_MAX_ORDER)) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "the order of a poly must be from 2 to %d", SCENE_MAX_ORDER);
    }
    return (int)given;
}

// (order + 1)(order + 2)(order + 3) / 6 coefficients
static void parse_poly(Converter *cv, ObjectNode *object) {
    PolyShape *poly = &object->object.shape.poly;
    poly->order = object->keyword == KW_cubic     ? 3
                  : object->keyword == KW_quartic ? 4
                                                  : read_order(cv);
    poly->count = term_count(poly->order);
    poly->coefficients = read_coefficients(cv, poly->count, keyword_name(object->keyword));
}

// How many terms stand before x^i y^j z^k.
static uint32_t term_index(int order, int i, int j, int k) {
    uint32_t index = 0;
    for (int x = order; x > i; x--)
        index += (uint32_t)((order - x + 1) * (order - x + 2) / 2);
    for (int y = order - i; y > j; y--)
        index += (uint32_t)(order - i - y + 1);
    return index + (uint32_t)(order - i - j - k);
}

// F { xyz(F, F, F): F }*
static void parse_polynomial(Converter *cv, ObjectNode *object) {
    PolyShape *poly = &object->object.shape.poly;
    poly->order = read_order(cv);
    poly->count = term_count(poly->order);
    poly->coefficients = ARENA_ARRAY(cv->arena, double, poly->count);
    optional_comma(cv);
    const Token *token = peek_token(cv);
    while (accept(cv, KW_xyz)) {
        double power[3];
        expect(cv, '(', "xyz");
        read_floats(cv, power, 3);
        expect(cv, ')', "xyz");
        expect(cv, ':', "xyz");
        double value = parse_float(cv);
        optional_comma(cv);
        bool good = power[0] >= 0 && power[1] >= 0 && power[2] >= 0 &&
                    power[0] + power[1] + power[2] <= poly->order;
        if (!good) {
            Loc loc = token_loc(cv, token);
            die_at(&loc, "the powers of a term must be from 0 to the order together");
        }
        poly->coefficients[term_index(poly->order, (int)power[0], (int)power[1], (int)power[2])] =
            value;
        token = peek_token(cv);
    }
}

static void parse_quadric(Converter *cv, ObjectNode *object) {
    QuadricShape *quadric = &object->object.shape.quadric;
    quadric->square = parse_vector(cv);
    optional_comma(cv);
    quadric->mixed = parse_vector(cv);
    optional_comma(cv);
    quadric->linear = parse_vector(cv);
    optional_comma(cv);
    quadric->constant = parse_float(cv);
    extent_begin(object);
}

static void parse_superellipsoid(Converter *cv, ObjectNode *object) {
    const Token *token = peek_token(cv);
    Vec2 e = parse_uv(cv);
    if (!(e.u > 0 && e.v > 0)) {
        Loc loc = token_loc(cv, token);
        warn_at(&loc, "an exponent of the superellipsoid is not above 0: it is ignored, POV-Ray "
                      "shows a box or something with holes");
        object->ignored = true;
        return;
    }
    object->object.shape.superellipsoid = (SuperellipsoidShape){e.u, e.v};
}

static void parse_ovus(Converter *cv, ObjectNode *object) {
    const Token *token = peek_token(cv);
    double radii[2];
    read_floats(cv, radii, 2);
    if (radii[0] < 0 || radii[1] < 0) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "a radius of the ovus is negative");
    }
    object->object.shape.ovus = (OvusShape){radii[0], radii[1]};
    if (radii[1] < 2.0 * radii[0])
        return;
    // POV-Ray shows the ball that would swallow the other one.
    object->object.type = OBJECT_SPHERE;
    object->object.shape.sphere = (SphereShape){{0, radii[0], 0}, radii[1]};
}

// ---- outlines -------------------------------------------------------------------------------

static void check_points(Converter *cv, const Token *token, OutlineType type, uint32_t count,
                         const int least[4], const char *what) {
    if (type == OUTLINE_B_SPLINE)
        type = OUTLINE_LINEAR;
    if ((int)count < least[type])
        die_count(cv, token, what, least[type]);
    if (type == OUTLINE_BEZIER && count % 4 != 0) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "a %s with bezier_spline needs four points for each piece", what);
    }
}

static void parse_lathe(Converter *cv, ObjectNode *object) {
    static const int least[] = {2, 3, 4, 4};
    LatheShape *lathe = &object->object.shape.lathe;
    while (accept_outline(cv, &lathe->outline)) {
    }
    const Token *token = peek_token(cv);
    lathe->count = read_count(cv, "lathe", 2);
    check_points(cv, token, lathe->outline, lathe->count, least, "lathe");
    token = peek_token(cv);
    lathe->points = read_points(cv, lathe->count);
    for (uint32_t i = 1; i + 1 < lathe->count; i++)
        if (lathe->points[i].u < 0) {
            Loc loc = token_loc(cv, token);
            die_at(&loc, "point %u of the lathe is on the other side of the axis", i + 1);
        }
}

static void parse_sor(Converter *cv, ObjectNode *object) {
    SorShape *sor = &object->object.shape.sor;
    sor->count = read_count(cv, "sor", 4);
    const Token *token = peek_token(cv);
    sor->points = read_points(cv, sor->count);
    const Vec2 *p = sor->points;
    for (uint32_t i = 0; i < sor->count; i++) {
        bool rises = i < 2 || i + 1 == sor->count || p[i].v > p[i - 1].v;
        bool slopes = i < 2 || fabs(p[i].v - p[i - 2].v) >= SAME;
        if (p[i].u < 0 || !rises || !slopes) {
            Loc loc = token_loc(cv, token);
            die_at(&loc, "point %u of the sor does not follow the one before upwards", i + 1);
        }
    }
    optional_comma(cv);
    sor->open = accept(cv, KW_open);
}

static bool same_point(Vec2 a, Vec2 b) { return fabs(a.u - b.u) < SAME && fabs(a.v - b.v) < SAME; }

// Do the points end where a ring ends? *start: where the last ring begins.
static bool ends_closed(const Vec2 *p, uint32_t count, OutlineType type, Vec2 *start) {
    static const uint32_t skips[] = {1, 2, 3}; // ORDER outline_type
    uint32_t i = type == OUTLINE_LINEAR ? 1 : 2;
    bool closed = false;
    *start = p[i - 1];
    for (; i < count; i++) {
        closed = same_point(*start, p[i]);
        if (!closed)
            continue;
        i += skips[type];
        if (i < count)
            *start = p[i];
    }
    return closed;
}

static bool bezier_closed(const Vec2 *p, uint32_t count) {
    uint32_t start = 0;
    for (uint32_t i = 4; i < count; i += 4) {
        if (same_point(p[i], p[i - 1]))
            continue;
        if (!same_point(p[i - 1], p[start]))
            return false;
        start = i;
    }
    return same_point(p[count - 1], p[start]);
}

// A segment from p[i + 1] to p[i + 2] has its neighbours beside it, as many as the kind of curve
// needs: are they all there? A ring ends where its first point comes again.
static bool has_neighbours(const Vec2 *p, uint32_t count, OutlineType type) {
    const uint32_t reach = type == OUTLINE_QUADRATIC ? 2 : 3;
    Vec2 first = p[1];
    for (uint32_t i = 0; i + 1 < count; i++) {
        if (i + reach >= count)
            return false;
        if (!same_point(p[i + 2], first))
            continue;
        i += reach;
        if (i + 2 < count)
            first = p[i + 2];
    }
    return true;
}

// What is not closed POV-Ray closes if it is linear, and ignores else.
static void close_prism(Converter *cv, ObjectNode *object, const Token *token) {
    PrismShape *prism = &object->object.shape.prism;
    Vec2 start = {0, 0};
    bool closed = prism->outline == OUTLINE_BEZIER
                      ? bezier_closed(prism->points, prism->count)
                      : ends_closed(prism->points, prism->count, prism->outline, &start);
    bool curved = prism->outline == OUTLINE_QUADRATIC || prism->outline == OUTLINE_CUBIC;
    Loc loc = token_loc(cv, token);
    if (curved && !has_neighbours(prism->points, prism->count, prism->outline))
        die_at(&loc, "Too few points in prism: no curve leads back to its first point, or the "
                     "points beside it are missing");
    if (closed)
        return;
    if (prism->outline != OUTLINE_LINEAR) {
        warn_at(&loc, "the prism is not closed: it is ignored");
        object->ignored = true;
        return;
    }
    warn_at(&loc, "the prism is not closed: its last point is joined to the first");
    Vec2 *points = ARENA_ARRAY(cv->arena, Vec2, prism->count + 1);
    memcpy(points, prism->points, prism->count * sizeof *points);
    points[prism->count++] = start;
    prism->points = points;
}

static void parse_prism(Converter *cv, ObjectNode *object) {
    static const int least[] = {3, 5, 6, 4};
    PrismShape *prism = &object->object.shape.prism;
    for (;;) {
        if (accept(cv, KW_conic_sweep))
            prism->conic = true;
        else if (accept(cv, KW_linear_sweep))
            prism->conic = false;
        else if (!accept_outline(cv, &prism->outline))
            break;
    }
    double heights[2];
    read_floats(cv, heights, 2);
    prism->low = fmin(heights[0], heights[1]);
    prism->high = fmax(heights[0], heights[1]);
    optional_comma(cv);
    const Token *token = peek_token(cv);
    prism->count = read_count(cv, "prism", 3);
    check_points(cv, token, prism->outline, prism->count, least, "prism");
    prism->points = read_points(cv, prism->count);
    optional_comma(cv);
    prism->open = accept(cv, KW_open);
    close_prism(cv, object, token);
}

// ---- spheres in a row -----------------------------------------------------------------------

static void parse_sphere_sweep(Converter *cv, ObjectNode *object) {
    SphereSweepShape *sweep = &object->object.shape.sphere_sweep;
    if (!accept_outline(cv, &sweep->outline) || sweep->outline == OUTLINE_QUADRATIC ||
        sweep->outline == OUTLINE_BEZIER)
        die_expected(cv, "linear_spline, cubic_spline or b_spline");
    optional_comma(cv);
    sweep->count = read_count(cv, "sphere_sweep", sweep->outline == OUTLINE_LINEAR ? 2 : 4);
    ARRAY(SweepSphere) spheres = {0};
    for (uint32_t i = 0; i < sweep->count; i++) {
        Vec3 center = parse_vector(cv);
        optional_comma(cv);
        SweepSphere sphere = {center, parse_float(cv)};
        array_push(&spheres, sphere);
        optional_comma(cv);
    }
    sweep->spheres = arena_copy(cv->arena, spheres.items, spheres.count * sizeof *spheres.items);
    array_free(&spheres);
    if (accept(cv, KW_tolerance))
        sweep->tolerance = parse_float(cv);
}

// ---- flat ones ------------------------------------------------------------------------------

static bool same_place(Vec3 a, Vec3 b) {
    return fabs(a.x - b.x) < SAME && fabs(a.y - b.y) < SAME && fabs(a.z - b.z) < SAME;
}

static void parse_polygon(Converter *cv, ObjectNode *object) {
    const Token *token = peek_token(cv);
    uint32_t count = read_count(cv, "polygon", 3);
    ARRAY(Vec3) points = {0};
    Vec3 start = parse_vector(cv);
    array_push(&points, start);
    for (uint32_t i = 1; i < count; i++) {
        optional_comma(cv);
        array_push(&points, parse_vector(cv));
    }
    Vec3 *p = points.items;
    bool closed = false;
    for (uint32_t i = 1; i < count; i++) {
        closed = same_place(start, p[i]);
        if (!closed)
            continue;
        p[i] = start; // exactly, from now on
        if (++i < count)
            start = p[i];
    }
    if (!closed) {
        Loc loc = token_loc(cv, token);
        warn_at(&loc, "the polygon is not closed: its last point is joined to the first");
        array_push(&points, start);
    }
    object->object.shape.polygon = (PolygonShape){
        arena_copy(cv->arena, points.items, points.count * sizeof(Vec3)), (uint32_t)points.count};
    array_free(&points);
}

static void parse_smooth_triangle(Converter *cv, ObjectNode *object) {
    SmoothTriangleShape *triangle = &object->object.shape.smooth_triangle;
    for (int i = 0; i < 3; i++) {
        if (i > 0)
            optional_comma(cv);
        triangle->p[i] = parse_vector(cv);
        optional_comma(cv);
        triangle->n[i] = vec_normalize(parse_vector(cv));
    }
}

// ---- blob -----------------------------------------------------------------------------------

static void component_move(Converter *cv, BlobComponent *component, const TextureNode **texture,
                           Move *move) {
    component->transform =
        component->has_transform ? transform_compose(&component->transform, &move->t) : move->t;
    component->has_transform = true;
    *texture = texture_moved(cv, *texture, move);
}

static void parse_component_modifiers(Converter *cv, BlobComponent *component,
                                      const TextureNode **texture) {
    Move move;
    for (;;) {
        const Token *token = peek_token(cv);
        if (parse_move(cv, &move))
            component_move(cv, component, texture, &move);
        else if (accept(cv, KW_texture))
            *texture = texture_layer(cv, parse_texture_block(cv), *texture, token);
        else if (!parse_partial_texture(cv, texture))
            return;
    }
}

// sphere { V, F, [strength] F mods } | cylinder { V, V, F, [strength] F mods }
static BlobComponent parse_component(Converter *cv, bool cylinder, const TextureNode **texture) {
    BlobComponent component = {.cylinder = cylinder, .texture = NO_INDEX};
    const char *where = cylinder ? "cylinder" : "sphere";
    expect(cv, '{', where);
    const Token *token = peek_token(cv);
    component.base = parse_vector(cv);
    optional_comma(cv);
    if (cylinder) {
        component.apex = parse_vector(cv);
        optional_comma(cv);
        if (vec_length(vec_sub(component.apex, component.base)) < SAME) {
            Loc loc = token_loc(cv, token);
            die_at(&loc, "the two ends of the cylinder are the same point");
        }
    }
    component.radius = parse_float(cv);
    optional_comma(cv);
    accept(cv, KW_strength);
    component.strength = parse_float(cv);
    component.transform = transform_identity();
    parse_component_modifiers(cv, &component, texture);
    expect(cv, '}', where);
    return component;
}

static BlobComponent parse_old_component(Converter *cv) {
    BlobComponent component = {.texture = NO_INDEX, .transform = transform_identity()};
    component.strength = parse_float(cv);
    optional_comma(cv);
    component.radius = parse_float(cv);
    optional_comma(cv);
    component.base = parse_vector(cv);
    return component;
}

static void parse_blob(Converter *cv, ObjectNode *object) {
    BlobShape *blob = &object->object.shape.blob;
    ARRAY(BlobComponent) components = {0};
    ARRAY(const TextureNode *) textures = {0};
    for (;;) {
        const TextureNode *texture = NULL;
        BlobComponent component;
        if (accept(cv, KW_threshold)) {
            blob->threshold = parse_float(cv);
            continue;
        }
        if (accept(cv, KW_sphere))
            component = parse_component(cv, false, &texture);
        else if (accept(cv, KW_cylinder))
            component = parse_component(cv, true, &texture);
        else if (accept(cv, KW_component))
            component = parse_old_component(cv);
        else if (accept(cv, ','))
            continue;
        else
            break;
        array_push(&components, component);
        array_push(&textures, texture);
        object->has_textures = object->has_textures || texture;
    }
    if (!components.count)
        die_expected(cv, "a component (Need at least one component in a blob)");
    blob->count = (uint32_t)components.count;
    blob->components =
        arena_copy(cv->arena, components.items, components.count * sizeof *components.items);
    object->textures =
        arena_copy(cv->arena, textures.items, textures.count * sizeof *textures.items);
    object->texture_count = (uint32_t)textures.count;
    array_free(&components);
    array_free(&textures);
}

static bool finite_table(const double *values, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

static bool blob_is_finite(const BlobShape *blob) {
    for (uint32_t i = 0; i < blob->count; i++) {
        const BlobComponent *part = &blob->components[i];
        if (!vec_is_finite(part->base) || !vec_is_finite(part->apex) || !isfinite(part->radius) ||
            !isfinite(part->strength))
            return false;
    }
    return isfinite(blob->threshold);
}

// Meshes and pictures have been made finite, or are checked with the pools of the scene.
static bool container_is_finite(const Container *container) {
    return vec_is_finite(container->low) && vec_is_finite(container->high) &&
           vec_is_finite(container->center) && isfinite(container->radius);
}

bool solid_is_finite(const Object *object) {
    switch (object->type) {
    case OBJECT_QUADRIC:
        return finite_table(&object->shape.quadric.square.x, 10);
    case OBJECT_POLY:
        return finite_table(object->shape.poly.coefficients, object->shape.poly.count);
    case OBJECT_LATHE:
        return finite_table(&object->shape.lathe.points->u, 2 * (size_t)object->shape.lathe.count);
    case OBJECT_SOR:
        return finite_table(&object->shape.sor.points->u, 2 * (size_t)object->shape.sor.count);
    case OBJECT_PRISM:
        return isfinite(object->shape.prism.low) && isfinite(object->shape.prism.high) &&
               finite_table(&object->shape.prism.points->u, 2 * (size_t)object->shape.prism.count);
    case OBJECT_SPHERE_SWEEP:
        return finite_table(&object->shape.sphere_sweep.spheres->center.x,
                            4 * (size_t)object->shape.sphere_sweep.count);
    case OBJECT_BLOB:
        return blob_is_finite(&object->shape.blob);
    case OBJECT_SMOOTH_TRIANGLE:
        return finite_table(&object->shape.smooth_triangle.p[0].x, 9) &&
               finite_table(&object->shape.smooth_triangle.n[0].x, 9);
    case OBJECT_POLYGON:
        return finite_table(&object->shape.polygon.points->x,
                            3 * (size_t)object->shape.polygon.count);
    case OBJECT_ISOSURFACE:
        return container_is_finite(&object->shape.isosurface.container);
    case OBJECT_PARAMETRIC:
        return container_is_finite(&object->shape.parametric.container) &&
               finite_table(object->shape.parametric.low, 2) &&
               finite_table(object->shape.parametric.high, 2);
    case OBJECT_TEXT:
        return isfinite(object->shape.text.thickness) &&
               finite_table(object->shape.text.arcs, 6 * (size_t)object->shape.text.arc_count);
    default:
        return true;
    }
}

ParseShape *solid_parser(int keyword) {
    static const struct {
        int keyword;
        ParseShape *parse;
    } shapes[] = {
        {KW_blob, parse_blob},
        {KW_cubic, parse_poly},
        {KW_height_field, parse_height_field},
        {KW_isosurface, parse_isosurface},
        {KW_lathe, parse_lathe},
        {KW_mesh, parse_mesh},
        {KW_mesh2, parse_mesh2},
        {KW_ovus, parse_ovus},
        {KW_parametric, parse_parametric},
        {KW_poly, parse_poly},
        {KW_polygon, parse_polygon},
        {KW_polynomial, parse_polynomial},
        {KW_prism, parse_prism},
        {KW_quadric, parse_quadric},
        {KW_quartic, parse_poly},
        {KW_smooth_triangle, parse_smooth_triangle},
        {KW_sor, parse_sor},
        {KW_sphere_sweep, parse_sphere_sweep},
        {KW_superellipsoid, parse_superellipsoid},
        {KW_text, parse_text},
    };
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        if (shapes[i].keyword == keyword)
            return shapes[i].parse;
    return NULL;
}
