// SPDX-License-Identifier: MIT
#include "model/scene_read_patch.h"

#include "patch/bspline.h"

#include <string.h>

static void read_weights(const Reader *r, const FieldPath *up, json_t *json, PatchShape *patch) {
    const FieldPath path = path_field(up, "weights");
    size_t rows = patch->degree_u + 1, columns = patch->degree_v + 1;
    read_expect(r, &path, json, JSON_ARRAY);
    if (json_array_size(json) != rows)
        path_die(r->file, &path, "%zu rows, but there are %zu of points", json_array_size(json),
                 rows);
    patch->weights = ARENA_ARRAY(r->arena, double, rows *columns);
    for (size_t i = 0; i < rows; i++) {
        const FieldPath row = path_item(up, "weights", (uint32_t)i);
        double *weights = patch->weights + i * columns;
        read_doubles(r, &row, json_array_get(json, i), weights, (int)columns);
        for (size_t j = 0; j < columns; j++) {
            const FieldPath path_j = path_item(&row, NULL, (uint32_t)j);
            if (!(weights[j] > 0.0))
                path_die(r->file, &path_j, "the weight %g is not above 0", weights[j]);
        }
    }
}

static const double *read_knots(const Reader *r, const FieldPath *up, json_t *json,
                                const char *name, uint32_t degree) {
    json_t *value = json_object_get(json, name);
    if (!value)
        return NULL;
    const FieldPath path = path_field(up, name);
    double *knots = ARENA_ARRAY(r->scratch, double, 2 * degree);
    read_doubles(r, &path, value, knots, (int)(2 * degree));
    const char *fault = bspline_knots_fault(knots, (int)degree);
    if (fault)
        path_die(r->file, &path, "%s", fault);
    return knots;
}

// The name of a basis, and the degree that it always has (0: any).
static const struct {
    const char *name;
    uint32_t degree;
} bases[] = {{"bezier", 0}, {"bspline", 0}, {"catmull_clark", 3}, {"doo_sabin", 2}};

static size_t read_basis_name(const Reader *r, const FieldPath *up, json_t *json,
                              const PatchShape *patch) {
    json_t *value = json_object_get(json, "basis");
    const FieldPath path = path_field(up, "basis");
    if (!value)
        return 0;
    read_expect(r, &path, value, JSON_STRING);
    const char *name = json_string_value(value);
    size_t k = 0, count = sizeof bases / sizeof bases[0];
    while (k < count && strcmp(name, bases[k].name) != 0)
        k++;
    if (k == count)
        path_die(r->file, &path,
                 "'%s' is none of \"bezier\", \"bspline\", \"catmull_clark\", \"doo_sabin\"", name);
    uint32_t degree = bases[k].degree;
    if (degree && (patch->degree_u != degree || patch->degree_v != degree))
        path_die(r->file, &path, "a regular '%s' patch has %u rows of %u points", name, degree + 1,
                 degree + 1);
    return k;
}

void read_patch_basis(const Reader *r, const FieldPath *up, json_t *json, PatchShape *patch) {
    json_t *weights = json_object_get(json, "weights");
    if (weights)
        read_weights(r, up, weights, patch);
    size_t basis = read_basis_name(r, up, json, patch);
    bool knots = json_object_get(json, "knots_u") || json_object_get(json, "knots_v");
    if (knots && strcmp(bases[basis].name, "bspline") != 0)
        path_die(r->file, up, "knots go only with the basis \"bspline\"");
    if (basis == 0)
        return;
    BsplineSpan span = {(int)patch->degree_u,
                        (int)patch->degree_v,
                        patch->points,
                        patch->weights,
                        read_knots(r, up, json, "knots_u", patch->degree_u),
                        read_knots(r, up, json, "knots_v", patch->degree_v)};
    size_t count = (size_t)(patch->degree_u + 1) * (patch->degree_v + 1);
    Vec3 *points = ARENA_ARRAY(r->arena, Vec3, count);
    double *out_weights = patch->weights ? ARENA_ARRAY(r->arena, double, count) : NULL;
    bspline_span(&span, points, out_weights);
    patch->points = points;
    patch->weights = out_weights;
}
