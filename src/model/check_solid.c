// SPDX-License-Identifier: MIT
// What the renderer relies on in the larger primitives: lists that are long enough, finite numbers,
// indices within their pools.
#include "model/check.h"

#include <math.h>

static void check_table(const Check *c, const FieldPath *up, const char *name, const double *values,
                        size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (!(fabs(values[i]) <= MAX_COORDINATE)) {
            const FieldPath path = path_field(up, name);
            refuse(c, &path, "%g is out of range", values[i]);
        }
    }
}

static void check_count(const Check *c, const FieldPath *up, const char *name, uint32_t count,
                        uint32_t least) {
    const FieldPath path = path_field(up, name);
    if (count < least)
        refuse(c, &path, "%u entries, expected %u at least", count, least);
}

// How many points make one piece of the curve.
static uint32_t least_points(OutlineType curve) {
    static const uint32_t least[] = {2, 3, 4, 4, 4}; // ORDER outline_type
    return least[curve];
}

static void check_curve(const Check *c, const FieldPath *path, OutlineType curve,
                        const Vec2 *points, uint32_t count) {
    check_range(c, path, "outline", (int)curve, OUTLINE_LINEAR, OUTLINE_BEZIER);
    check_count(c, path, "points", count, least_points(curve));
    if (curve == OUTLINE_BEZIER && count % 4 != 0) {
        const FieldPath place = path_field(path, "points");
        refuse(c, &place, "%u entries, expected four for each piece", count);
    }
    check_table(c, path, "points", &points->u, (size_t)count * 2);
}

static void check_poly(const Check *c, const FieldPath *path, const PolyShape *poly) {
    check_range(c, path, "order", poly->order, 1, SCENE_MAX_ORDER);
    uint32_t n = (uint32_t)poly->order, want = (n + 1) * (n + 2) * (n + 3) / 6;
    if (poly->count != want) {
        const FieldPath place = path_field(path, "coefficients");
        refuse(c, &place, "%u entries, expected %u", poly->count, want);
    }
    check_table(c, path, "coefficients", poly->coefficients, poly->count);
}

static void check_above_zero(const Check *c, const FieldPath *up, const char *name, double value) {
    const FieldPath path = path_field(up, name);
    check_numbers(c, up, name, &value, 1);
    if (!(value > 0))
        refuse(c, &path, "%g is not above 0", value);
}

static void check_sor(const Check *c, const FieldPath *path, const SorShape *sor) {
    const FieldPath place = path_field(path, "points");
    check_count(c, path, "points", sor->count, 4);
    check_table(c, path, "points", &sor->points->u, (size_t)sor->count * 2);
    for (uint32_t i = 2; i + 1 < sor->count; i++)
        if (!(sor->points[i].v > sor->points[i - 1].v))
            refuse(c, &place, "point %u is not above the one before", i);
    for (uint32_t i = 0; i + 2 < sor->count; i++)
        if (sor->points[i + 2].v == sor->points[i].v)
            refuse(c, &place, "points %u and %u have the same height", i, i + 2);
}

static void check_sweep(const Check *c, const FieldPath *path, const SphereSweepShape *sweep) {
    const FieldPath place = path_field(path, "outline");
    if (sweep->outline != OUTLINE_LINEAR && sweep->outline != OUTLINE_CUBIC &&
        sweep->outline != OUTLINE_B_SPLINE)
        refuse(c, &place, "a sphere_sweep has linear, cubic or b_spline");
    check_count(c, path, "spheres", sweep->count, least_points(sweep->outline));
    check_table(c, path, "spheres", &sweep->spheres->center.x, (size_t)sweep->count * 4);
    check_numbers(c, path, "tolerance", &sweep->tolerance, 1);
}

static void check_blob(const Check *c, const FieldPath *path, const BlobShape *blob) {
    check_numbers(c, path, "threshold", &blob->threshold, 1);
    for (uint32_t i = 0; i < blob->count; i++) {
        const BlobComponent *part = &blob->components[i];
        const FieldPath place = path_item(path, "components", i);
        const FieldPath texture = path_field(&place, "texture");
        check_vec3(c, &place, "base", part->base);
        check_vec3(c, &place, "apex", part->apex);
        check_numbers(c, &place, "radius", &part->radius, 1);
        check_numbers(c, &place, "strength", &part->strength, 1);
        if (part->has_transform)
            check_transform(c, &place, "transform", &part->transform);
        if (part->texture != NO_INDEX)
            check_index(c, &texture, part->texture, c->scene->texture_count, "texture");
        if (part->cylinder && !(vec_length(vec_sub(part->apex, part->base)) > 0))
            refuse(c, &place, "base and apex are the same point");
    }
}

static void check_text(const Check *c, const FieldPath *path, const TextShape *text) {
    const FieldPath place = path_field(path, "letters");
    check_numbers(c, path, "thickness", &text->thickness, 1);
    check_table(c, path, "arcs", text->arcs, (size_t)text->arc_count * 6);
    for (uint32_t i = 0; i < text->letter_count; i++)
        if (text->letters[i] > text->arc_count ||
            (i > 0 && text->letters[i] < text->letters[i - 1]))
            refuse(c, &place, "%u does not follow, or is no arc", text->letters[i]);
}

// Of three arguments, to one number.
static void check_function(const Check *c, const FieldPath *path, const char *name,
                           uint32_t function) {
    const FieldPath place = path_field(path, name);
    check_index(c, &place, function, c->scene->function_count, "function");
    const Function *f = &c->scene->functions[function];
    if (function_width(f) != 1 || f->parameters != 3)
        refuse(c, &place, "%u is not of three arguments and one number", function);
}

static void check_container(const Check *c, const FieldPath *path, const Container *container) {
    const FieldPath low = path_field(path, "low");
    check_vec3(c, path, "low", container->low);
    check_vec3(c, path, "high", container->high);
    if (container->low.x > container->high.x || container->low.y > container->high.y ||
        container->low.z > container->high.z)
        refuse(c, &low, "it is above 'high'");
    check_vec3(c, path, "center", container->center);
    check_size(c, path, "radius", container->radius);
}

static void check_isosurface(const Check *c, const FieldPath *path, const IsosurfaceShape *iso) {
    check_function(c, path, "function", iso->function);
    check_container(c, path, &iso->container);
    check_numbers(c, path, "threshold", &iso->threshold, 1);
    check_above_zero(c, path, "accuracy", iso->accuracy);
    check_above_zero(c, path, "max_gradient", iso->max_gradient);
    check_range(c, path, "max_trace", iso->max_trace, 1, SCENE_MAX_TRACE);
    check_numbers(c, path, "evaluate_from", &iso->evaluate_from, 1);
    check_numbers(c, path, "evaluate_over", &iso->evaluate_over, 1);
    check_numbers(c, path, "evaluate_fall", &iso->evaluate_fall, 1);
}

static void check_parametric(const Check *c, const FieldPath *path, const ParametricShape *shape) {
    static const char *const functions[3] = {"function_x", "function_y", "function_z"};
    static const char *const lows[2] = {"low_u", "low_v"};
    static const char *const highs[2] = {"high_u", "high_v"};
    for (int axis = 0; axis < 3; axis++)
        check_function(c, path, functions[axis], shape->functions[axis]);
    for (int k = 0; k < 2; k++) {
        const FieldPath low = path_field(path, lows[k]);
        check_numbers(c, path, lows[k], &shape->low[k], 1);
        check_numbers(c, path, highs[k], &shape->high[k], 1);
        if (shape->low[k] > shape->high[k])
            refuse(c, &low, "it is above '%s'", highs[k]);
    }
    check_container(c, path, &shape->container);
    check_above_zero(c, path, "accuracy", shape->accuracy);
    check_above_zero(c, path, "max_gradient", shape->max_gradient);
    check_range(c, path, "depth", shape->depth, 1, SCENE_MAX_PRECOMPUTE);
}

static void check_mesh_textures(const Check *c, const FieldPath *path, const MeshShape *shape) {
    const FieldPath list = path_field(path, "textures");
    int slots = c->scene->meshes[shape->mesh].texture_slots;
    if (slots > 0 && shape->texture_count < (uint32_t)slots)
        refuse(c, &list, "%u entries, but the mesh has %d", shape->texture_count, slots);
    for (uint32_t i = 0; i < shape->texture_count; i++) {
        const FieldPath place = path_item(path, "textures", i);
        check_index(c, &place, shape->textures[i], c->scene->texture_count, "texture");
    }
}

void check_solid(const Check *c, const FieldPath *path, const Object *object) {
    const FieldPath mesh = path_field(path, "mesh"), map = path_field(path, "map");
    switch (object->type) {
    case OBJECT_QUADRIC:
        check_vec3(c, path, "square", object->shape.quadric.square);
        check_vec3(c, path, "mixed", object->shape.quadric.mixed);
        check_vec3(c, path, "linear", object->shape.quadric.linear);
        check_numbers(c, path, "constant", &object->shape.quadric.constant, 1);
        break;
    case OBJECT_POLY:
        check_poly(c, path, &object->shape.poly);
        break;
    case OBJECT_SUPERELLIPSOID:
        check_above_zero(c, path, "e", object->shape.superellipsoid.e);
        check_above_zero(c, path, "n", object->shape.superellipsoid.n);
        break;
    case OBJECT_LATHE:
        check_curve(c, path, object->shape.lathe.outline, object->shape.lathe.points,
                    object->shape.lathe.count);
        break;
    case OBJECT_SOR:
        check_sor(c, path, &object->shape.sor);
        break;
    case OBJECT_PRISM:
        check_curve(c, path, object->shape.prism.outline, object->shape.prism.points,
                    object->shape.prism.count);
        check_numbers(c, path, "low", &object->shape.prism.low, 1);
        check_numbers(c, path, "high", &object->shape.prism.high, 1);
        break;
    case OBJECT_SPHERE_SWEEP:
        check_sweep(c, path, &object->shape.sphere_sweep);
        break;
    case OBJECT_BLOB:
        check_blob(c, path, &object->shape.blob);
        break;
    case OBJECT_OVUS:
        check_size(c, path, "bottom", object->shape.ovus.bottom);
        check_size(c, path, "top", object->shape.ovus.top);
        if (object->shape.ovus.top >= 2 * object->shape.ovus.bottom)
            refuse(c, path, "'top' is not below twice 'bottom'");
        break;
    case OBJECT_SMOOTH_TRIANGLE:
        check_numbers(c, path, "points", &object->shape.smooth_triangle.p[0].x, 9);
        check_numbers(c, path, "normals", &object->shape.smooth_triangle.n[0].x, 9);
        break;
    case OBJECT_POLYGON:
        check_count(c, path, "points", object->shape.polygon.count, 3);
        check_table(c, path, "points", &object->shape.polygon.points->x,
                    (size_t)object->shape.polygon.count * 3);
        break;
    case OBJECT_MESH:
        check_index(c, &mesh, object->shape.mesh.mesh, c->scene->mesh_count, "mesh");
        check_mesh_textures(c, path, &object->shape.mesh);
        break;
    case OBJECT_HEIGHT_FIELD:
        check_index(c, &map, object->shape.height_field.map, c->scene->height_map_count,
                    "height map");
        check_numbers(c, path, "water_level", &object->shape.height_field.water_level, 1);
        break;
    case OBJECT_TEXT:
        check_text(c, path, &object->shape.text);
        break;
    case OBJECT_ISOSURFACE:
        check_isosurface(c, path, &object->shape.isosurface);
        break;
    case OBJECT_PARAMETRIC:
        check_parametric(c, path, &object->shape.parametric);
        break;
    default:
        break;
    }
}

// ---- what patterns look into ------------------------------------------------------------------

typedef struct {
    uint8_t nesting;
    double cost; // evaluations to tell whether a point is inside
} Inside;

static void check_list_use(const Check *c, const FieldPath *path, const uint32_t *items,
                           uint32_t count, int depth, Inside *inside);

static void check_function_inside(const Check *c, const FieldPath *path, uint32_t function,
                                  int depth, Inside *inside) {
    uint8_t nesting = check_function_use(c, path, function, depth + 1);
    if (nesting >= inside->nesting)
        inside->nesting = (uint8_t)(nesting + 1);
    inside->cost += c->functions.cost[function];
}

static void check_list_use(const Check *c, const FieldPath *path, const uint32_t *items,
                           uint32_t count, int depth, Inside *inside) {
    for (uint32_t i = 0; i < count; i++) {
        const Object *object = &c->scene->objects[items[i]];
        if (object->type == OBJECT_ISOSURFACE)
            check_function_inside(c, path, object->shape.isosurface.function, depth, inside);
        if (object_is_tree(object))
            check_list_use(c, path, object->shape.children.items, object->shape.children.count,
                           depth, inside);
        check_list_use(c, path, object->clips.items, object->clips.count, depth, inside);
    }
}

uint8_t check_projection_use(const Check *c, const FieldPath *path, uint32_t index, int depth) {
    uint8_t *met = &c->projections.met[index];
    if (*met == 1)
        refuse(c, path, "projection %u is part of itself", index);
    if (*met == 0) {
        Inside inside = {0};
        *met = 1;
        check_list_use(c, path, &c->scene->projections[index], 1, depth, &inside);
        *met = 2;
        c->projections.nesting[index] = inside.nesting;
        c->projections.cost[index] = inside.cost;
    }
    return c->projections.nesting[index];
}

// ---- pools ----------------------------------------------------------------------------------

static void check_face(const Check *c, const FieldPath *path, const Mesh *mesh,
                       const MeshFace *face) {
    for (int i = 0; i < 3; i++) {
        check_index(c, path, face->p[i], mesh->point_count, "point");
        if (face->n[0] != NO_INDEX)
            check_index(c, path, face->n[i], mesh->normal_count, "normal");
        if (face->uv[0] != NO_INDEX)
            check_index(c, path, face->uv[i], mesh->uv_count, "uv vector");
        if (face->texture[i] != NO_INDEX)
            check_index(c, path, face->texture[i], (uint32_t)mesh->texture_slots, "texture");
    }
}

static void check_mesh(const Check *c, const FieldPath *path, const Mesh *mesh) {
    check_table(c, path, "points", mesh->points, (size_t)mesh->point_count * 3);
    check_table(c, path, "normals", mesh->normals, (size_t)mesh->normal_count * 3);
    check_table(c, path, "uv", mesh->uv, (size_t)mesh->uv_count * 2);
    if (mesh->has_inside)
        check_vec3(c, path, "inside_vector", mesh->inside_vector);
    check_range(c, path, "texture_slots", mesh->texture_slots, 0, 1 << 30);
    for (uint32_t i = 0; i < mesh->face_count; i++) {
        const FieldPath place = path_item(path, "faces", i);
        check_face(c, &place, mesh, &mesh->faces[i]);
    }
}

static void check_height_map(const Check *c, const FieldPath *path, const HeightMap *map) {
    const FieldPath place = path_field(path, "heights");
    // So that a cell fits an int.
    check_range(c, path, "width", map->width, 2, 1 << 15);
    check_range(c, path, "depth", map->depth, 2, 1 << 15);
    if (map->count != (uint32_t)map->width * (uint32_t)map->depth)
        refuse(c, &place, "%u entries, expected %d x %d", map->count, map->width, map->depth);
    check_table(c, path, "heights", map->heights, map->count);
}

void check_solid_pools(const Check *c) {
    for (uint32_t i = 0; i < c->scene->mesh_count; i++) {
        const FieldPath path = path_item(NULL, "meshes", i);
        check_mesh(c, &path, &c->scene->meshes[i]);
    }
    for (uint32_t i = 0; i < c->scene->height_map_count; i++) {
        const FieldPath path = path_item(NULL, "height_maps", i);
        check_height_map(c, &path, &c->scene->height_maps[i]);
    }
}
