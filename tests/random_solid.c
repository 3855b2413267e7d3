// SPDX-License-Identifier: MIT
#include "tests/random_solid.h"

#include "tests/random_value.h"

#include <string.h>

static double *random_table(Rng *rng, Arena *arena, size_t count) {
    double *table = ARENA_ARRAY(arena, double, count);
    for (size_t i = 0; i < count; i++)
        table[i] = rng_range(rng, -10, 10);
    return table;
}

static Vec3 random_point(Rng *rng) {
    double x = rng_range(rng, -10, 10), y = rng_range(rng, -10, 10);
    return vec3(x, y, rng_range(rng, -10, 10));
}

static MeshFace random_face(Rng *rng, const Mesh *mesh) {
    MeshFace face;
    bool smooth = random_below(rng, 2), mapped = random_below(rng, 2),
         textured = random_below(rng, 2);
    for (int i = 0; i < 3; i++) {
        face.p[i] = random_below(rng, mesh->point_count);
        face.n[i] = smooth ? random_below(rng, mesh->normal_count) : NO_INDEX;
        face.uv[i] = mapped ? random_below(rng, mesh->uv_count) : NO_INDEX;
        face.texture[i] = textured ? random_below(rng, (uint32_t)mesh->texture_slots) : NO_INDEX;
    }
    return face;
}

static Mesh random_mesh(Rng *rng, Arena *arena) {
    Mesh mesh = {.point_count = 3 + random_below(rng, 9),
                 .normal_count = 1 + random_below(rng, 9),
                 .uv_count = 1 + random_below(rng, 9),
                 .face_count = 1 + random_below(rng, 9),
                 .texture_slots = 1 + (int)random_below(rng, 3),
                 .has_inside = random_below(rng, 2)};
    mesh.points = random_table(rng, arena, 3 * (size_t)mesh.point_count);
    mesh.normals = random_table(rng, arena, 3 * (size_t)mesh.normal_count);
    mesh.uv = random_table(rng, arena, 2 * (size_t)mesh.uv_count);
    mesh.faces = ARENA_ARRAY(arena, MeshFace, mesh.face_count);
    for (uint32_t i = 0; i < mesh.face_count; i++)
        mesh.faces[i] = random_face(rng, &mesh);
    if (mesh.has_inside)
        mesh.inside_vector = random_point(rng);
    return mesh;
}

// The first argument, unchanged.
static void put_function(Arena *arena, Scene *scene) {
    Function *f = scene->functions = ARENA_NEW(arena, Function);
    scene->function_count = 1;
    *f = function_default(FUNCTION_FORMULA);
    f->parameters = f->registers = f->stack = 3;
    f->steps = ARENA_NEW(arena, FunctionStep);
    f->steps[0].op = FUNCTION_RETURN;
    f->step_count = 1;
}

void random_pools(Rng *rng, Arena *arena, Scene *scene) {
    if (scene->function_count == 0)
        put_function(arena, scene);
    scene->mesh_count = 1 + random_below(rng, 3);
    scene->meshes = ARENA_ARRAY(arena, Mesh, scene->mesh_count);
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        scene->meshes[i] = random_mesh(rng, arena);
    scene->height_map_count = 1 + random_below(rng, 2);
    scene->height_maps = ARENA_ARRAY(arena, HeightMap, scene->height_map_count);
    for (uint32_t i = 0; i < scene->height_map_count; i++) {
        HeightMap *map = &scene->height_maps[i];
        map->width = 2 + (int)random_below(rng, 5);
        map->depth = 2 + (int)random_below(rng, 5);
        map->count = (uint32_t)(map->width * map->depth);
        map->heights = random_table(rng, arena, map->count);
    }
}

static void *random_rows(Rng *rng, Arena *arena, uint32_t count, size_t columns) {
    return random_table(rng, arena, count * columns);
}

static void random_sor(Rng *rng, Arena *arena, SorShape *sor) {
    sor->count = 4 + random_below(rng, 5);
    sor->points = random_rows(rng, arena, sor->count, 2);
    for (uint32_t i = 1; i < sor->count; i++)
        sor->points[i].v = sor->points[i - 1].v + rng_range(rng, 0.1, 1);
    sor->open = random_below(rng, 2);
}

static void random_blob(Rng *rng, Arena *arena, const Scene *scene, BlobShape *blob) {
    blob->threshold = rng_unit(rng);
    blob->count = random_below(rng, 5);
    blob->components = ARENA_ARRAY(arena, BlobComponent, blob->count);
    for (uint32_t i = 0; i < blob->count; i++) {
        Transform turn = transform_rotate(random_point(rng));
        blob->components[i] = (BlobComponent){
            .cylinder = random_below(rng, 2),
            .base = random_point(rng),
            .apex = random_point(rng),
            .radius = rng_unit(rng),
            .strength = rng_range(rng, -1, 1),
            .texture = random_below(rng, 2) ? NO_INDEX : random_below(rng, scene->texture_count),
            .has_transform = random_below(rng, 2),
            .transform = transform_identity(),
        };
        if (blob->components[i].has_transform)
            blob->components[i].transform = turn;
    }
}

static void random_text(Rng *rng, Arena *arena, TextShape *text) {
    text->thickness = rng_unit(rng);
    text->arc_count = 1 + random_below(rng, 9);
    text->arcs = random_rows(rng, arena, text->arc_count, 6);
    text->letter_count = 1 + random_below(rng, 4);
    text->letters = ARENA_ARRAY(arena, uint32_t, text->letter_count);
    for (uint32_t i = 1; i < text->letter_count; i++)
        text->letters[i] =
            text->letters[i - 1] + random_below(rng, text->arc_count - text->letters[i - 1] + 1);
}

static void random_mesh_shape(Rng *rng, Arena *arena, const Scene *scene, MeshShape *shape) {
    shape->mesh = random_below(rng, scene->mesh_count);
    shape->texture_count = (uint32_t)scene->meshes[shape->mesh].texture_slots;
    shape->textures = ARENA_ARRAY(arena, uint32_t, shape->texture_count);
    for (uint32_t i = 0; i < shape->texture_count; i++)
        shape->textures[i] = random_below(rng, scene->texture_count);
}

// A function that such a surface can have; NO_INDEX: the scene has none.
static uint32_t function_of_three(const Scene *scene) {
    for (uint32_t i = 0; i < scene->function_count; i++)
        if (scene->functions[i].parameters == 3 && function_width(&scene->functions[i]) == 1)
            return i;
    return NO_INDEX;
}

static Container random_container(Rng *rng) {
    return (Container){.in_sphere = random_below(rng, 2),
                       .low = vec3(-1, -2, -rng_unit(rng)),
                       .high = vec3(1, 2, rng_unit(rng)),
                       .center = random_point(rng),
                       .radius = rng_unit(rng)};
}

static void random_isosurface(Rng *rng, uint32_t function, Object *object) {
    object->shape.isosurface = (IsosurfaceShape){.function = function,
                                                 .container = random_container(rng),
                                                 .threshold = rng_unit(rng),
                                                 .accuracy = rng_range(rng, 0.1, 1),
                                                 .max_gradient = rng_range(rng, 0.1, 9),
                                                 .max_trace = 1 + (int)random_below(rng, 10),
                                                 .open = random_below(rng, 2),
                                                 .evaluate = random_below(rng, 2),
                                                 .evaluate_from = rng_unit(rng),
                                                 .evaluate_over = rng_unit(rng),
                                                 .evaluate_fall = rng_unit(rng)};
}

static void random_parametric(Rng *rng, uint32_t function, Object *object) {
    object->shape.parametric = (ParametricShape){
        .functions = {function, function, function},
        .low = {-rng_unit(rng), -rng_unit(rng)},
        .high = {rng_unit(rng), rng_unit(rng)},
        .container = random_container(rng),
        .accuracy = rng_range(rng, 0.1, 1),
        .max_gradient = rng_range(rng, 0.1, 9),
        .precompute = {random_below(rng, 2), random_below(rng, 2), random_below(rng, 2)},
        .depth = 1 + (int)random_below(rng, 8)};
}

static void random_function_surface(Rng *rng, const Scene *scene, Object *object) {
    uint32_t function = function_of_three(scene);
    if (function == NO_INDEX) {
        object->type = OBJECT_SPHERE;
        object->shape.sphere = (SphereShape){random_point(rng), 1};
    } else if (object->type == OBJECT_ISOSURFACE) {
        random_isosurface(rng, function, object);
    } else {
        random_parametric(rng, function, object);
    }
}

void random_solid(Rng *rng, Arena *arena, const Scene *scene, Object *object) {
    switch (object->type) {
    case OBJECT_QUADRIC:
        object->shape.quadric =
            (QuadricShape){random_point(rng), random_point(rng), random_point(rng), rng_unit(rng)};
        break;
    case OBJECT_POLY: {
        PolyShape *poly = &object->shape.poly;
        poly->order = 2 + (int)random_below(rng, 3);
        uint32_t n = (uint32_t)poly->order;
        poly->count = (n + 1) * (n + 2) * (n + 3) / 6;
        poly->coefficients = random_table(rng, arena, poly->count);
        poly->sturm = random_below(rng, 2);
        break;
    }
    case OBJECT_SUPERELLIPSOID:
        object->shape.superellipsoid =
            (SuperellipsoidShape){rng_range(rng, 0.1, 3), rng_range(rng, 0.1, 3)};
        break;
    case OBJECT_LATHE:
        object->shape.lathe.outline = (OutlineType)random_below(rng, 4);
        object->shape.lathe.count = 4 * (1 + random_below(rng, 3));
        object->shape.lathe.points = random_rows(rng, arena, object->shape.lathe.count, 2);
        break;
    case OBJECT_SOR:
        random_sor(rng, arena, &object->shape.sor);
        break;
    case OBJECT_PRISM:
        object->shape.prism = (PrismShape){.outline = (OutlineType)random_below(rng, 4),
                                           .conic = random_below(rng, 2),
                                           .open = random_below(rng, 2),
                                           .low = rng_unit(rng),
                                           .high = rng_unit(rng) + 1,
                                           .count = 4 * (1 + random_below(rng, 3))};
        object->shape.prism.points = random_rows(rng, arena, object->shape.prism.count, 2);
        break;
    case OBJECT_SPHERE_SWEEP: {
        static const OutlineType kinds[] = {OUTLINE_LINEAR, OUTLINE_CUBIC, OUTLINE_B_SPLINE};
        SphereSweepShape *sweep = &object->shape.sphere_sweep;
        sweep->outline = kinds[random_below(rng, 3)];
        sweep->count = 4 + random_below(rng, 4);
        sweep->spheres = random_rows(rng, arena, sweep->count, 4);
        sweep->tolerance = rng_unit(rng);
        break;
    }
    case OBJECT_BLOB:
        random_blob(rng, arena, scene, &object->shape.blob);
        break;
    case OBJECT_OVUS:
        object->shape.ovus = (OvusShape){rng_range(rng, 0.6, 1), rng_unit(rng)};
        break;
    case OBJECT_SMOOTH_TRIANGLE:
        for (int i = 0; i < 3; i++) {
            object->shape.smooth_triangle.p[i] = random_point(rng);
            object->shape.smooth_triangle.n[i] = random_point(rng);
        }
        break;
    case OBJECT_POLYGON:
        object->shape.polygon.count = 3 + random_below(rng, 5);
        object->shape.polygon.points = random_rows(rng, arena, object->shape.polygon.count, 3);
        break;
    case OBJECT_MESH:
        random_mesh_shape(rng, arena, scene, &object->shape.mesh);
        break;
    case OBJECT_HEIGHT_FIELD:
        object->shape.height_field = (HeightFieldShape){random_below(rng, scene->height_map_count),
                                                        rng_unit(rng), random_below(rng, 2)};
        break;
    case OBJECT_TEXT:
        random_text(rng, arena, &object->shape.text);
        break;
    case OBJECT_ISOSURFACE:
    case OBJECT_PARAMETRIC:
        random_function_surface(rng, scene, object);
        break;
    default:
        break;
    }
}

// ---- comparing ------------------------------------------------------------------------------

#define SAME(member)                                                                               \
    if (memcmp(&a->member, &b->member, sizeof a->member) != 0)                                     \
    return #member
#define SAME_ROWS(member, count, columns)                                                          \
    SAME(count);                                                                                   \
    if (a->count > 0 &&                                                                            \
        memcmp(a->member, b->member, (size_t)a->count * (columns) * sizeof *a->member) != 0)       \
    return #member

static const char *component_difference(const BlobComponent *a, const BlobComponent *b) {
    SAME(cylinder);
    SAME(base);
    SAME(apex);
    SAME(radius);
    SAME(strength);
    SAME(texture);
    SAME(has_transform);
    SAME(transform);
    return NULL;
}

static const char *blob_difference(const BlobShape *a, const BlobShape *b) {
    SAME(threshold);
    SAME(count);
    for (uint32_t i = 0; i < a->count; i++) {
        const char *found = component_difference(&a->components[i], &b->components[i]);
        if (found)
            return found;
    }
    return NULL;
}

static const char *isosurface_difference(const IsosurfaceShape *a, const IsosurfaceShape *b) {
    SAME(function);
    SAME(container.in_sphere);
    SAME(container.low);
    SAME(container.high);
    SAME(container.center);
    SAME(container.radius);
    SAME(threshold);
    SAME(accuracy);
    SAME(max_gradient);
    SAME(max_trace);
    SAME(open);
    SAME(evaluate);
    SAME(evaluate_from);
    SAME(evaluate_over);
    SAME(evaluate_fall);
    return NULL;
}

static const char *parametric_difference(const ParametricShape *a, const ParametricShape *b) {
    SAME(functions);
    SAME(low);
    SAME(high);
    SAME(container.in_sphere);
    SAME(container.low);
    SAME(container.high);
    SAME(container.center);
    SAME(container.radius);
    SAME(accuracy);
    SAME(max_gradient);
    SAME(precompute);
    SAME(depth);
    return NULL;
}

const char *solid_difference(const Object *a, const Object *b) {
    switch (a->type) {
    case OBJECT_QUADRIC:
        SAME(shape.quadric);
        break;
    case OBJECT_POLY:
        SAME(shape.poly.order);
        SAME(shape.poly.sturm);
        SAME_ROWS(shape.poly.coefficients, shape.poly.count, 1);
        break;
    case OBJECT_SUPERELLIPSOID:
        SAME(shape.superellipsoid);
        break;
    case OBJECT_LATHE:
        SAME(shape.lathe.outline);
        SAME_ROWS(shape.lathe.points, shape.lathe.count, 1);
        break;
    case OBJECT_SOR:
        SAME(shape.sor.open);
        SAME_ROWS(shape.sor.points, shape.sor.count, 1);
        break;
    case OBJECT_PRISM:
        SAME(shape.prism.outline);
        SAME(shape.prism.conic);
        SAME(shape.prism.open);
        SAME(shape.prism.low);
        SAME(shape.prism.high);
        SAME_ROWS(shape.prism.points, shape.prism.count, 1);
        break;
    case OBJECT_SPHERE_SWEEP:
        SAME(shape.sphere_sweep.outline);
        SAME(shape.sphere_sweep.tolerance);
        SAME_ROWS(shape.sphere_sweep.spheres, shape.sphere_sweep.count, 1);
        break;
    case OBJECT_BLOB:
        return blob_difference(&a->shape.blob, &b->shape.blob);
    case OBJECT_OVUS:
        SAME(shape.ovus);
        break;
    case OBJECT_SMOOTH_TRIANGLE:
        SAME(shape.smooth_triangle);
        break;
    case OBJECT_POLYGON:
        SAME_ROWS(shape.polygon.points, shape.polygon.count, 1);
        break;
    case OBJECT_MESH:
        SAME(shape.mesh.mesh);
        SAME_ROWS(shape.mesh.textures, shape.mesh.texture_count, 1);
        break;
    case OBJECT_HEIGHT_FIELD:
        SAME(shape.height_field.map);
        SAME(shape.height_field.water_level);
        SAME(shape.height_field.smooth);
        break;
    case OBJECT_TEXT:
        SAME(shape.text.thickness);
        SAME_ROWS(shape.text.arcs, shape.text.arc_count, 6);
        SAME_ROWS(shape.text.letters, shape.text.letter_count, 1);
        break;
    case OBJECT_ISOSURFACE:
        return isosurface_difference(&a->shape.isosurface, &b->shape.isosurface);
    case OBJECT_PARAMETRIC:
        return parametric_difference(&a->shape.parametric, &b->shape.parametric);
    default:
        break;
    }
    return NULL;
}

static const char *mesh_difference(const Mesh *a, const Mesh *b) {
    SAME_ROWS(points, point_count, 3);
    SAME_ROWS(normals, normal_count, 3);
    SAME_ROWS(uv, uv_count, 2);
    SAME_ROWS(faces, face_count, 1);
    SAME(texture_slots);
    SAME(has_inside);
    SAME(inside_vector);
    return NULL;
}

static const char *map_difference(const HeightMap *a, const HeightMap *b) {
    SAME(width);
    SAME(depth);
    SAME_ROWS(heights, count, 1);
    return NULL;
}

const char *pool_difference(const Scene *a, const Scene *b) {
    const char *found = NULL;
    SAME(mesh_count);
    SAME(height_map_count);
    for (uint32_t i = 0; i < a->mesh_count && !found; i++)
        found = mesh_difference(&a->meshes[i], &b->meshes[i]);
    for (uint32_t i = 0; i < a->height_map_count && !found; i++)
        found = map_difference(&a->height_maps[i], &b->height_maps[i]);
    return found;
}
