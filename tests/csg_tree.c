// SPDX-License-Identifier: MIT
#include "tests/csg_tree.h"

#include <math.h>

// ---- making ---------------------------------------------------------------------------------

static double decimal(Rng *rng, double low, double high) {
    return round(rng_range(rng, low, high) * 1000.0) / 1000.0;
}

static Vec3 point(Rng *rng, double range) {
    double x = decimal(rng, -range, range), y = decimal(rng, -range, range);
    return vec3(x, y, decimal(rng, -range, range));
}

static void put(double *out, Vec3 v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

static bool one_in(Rng *rng, unsigned n) { return rng_next(rng) % n == 0; }

static void random_points(Rng *rng, double numbers[48]) {
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            Vec3 away = point(rng, 0.9);
            put(&numbers[3 * (4 * i + j)], vec3(i - 1.5 + 0.3 * away.x, j - 1.5, away.z));
        }
    for (int i = 0; i < 48; i++)
        numbers[i] = round(numbers[i] * 1000.0) / 1000.0;
}

static void random_numbers(Rng *rng, CsgTree *tree) {
    double *n = tree->numbers;
    Vec3 center = point(rng, 0.7);
    double radius = decimal(rng, 0.5, 1.6);
    switch (tree->kind) {
    case TREE_SPHERE:
        put(n, center), n[3] = radius;
        break;
    case TREE_BOX:
        put(n, vec3(-radius, decimal(rng, -1.5, -0.3), decimal(rng, -1.5, -0.3)));
        put(n + 3, vec3(radius, decimal(rng, 0.3, 1.5), decimal(rng, 0.3, 1.5)));
        break;
    case TREE_CYLINDER:
    case TREE_CONE:
        put(n, vec3(center.x, decimal(rng, -1.5, -0.4), center.z));
        put(n + 3, vec3(-center.x, decimal(rng, 0.4, 1.5), center.y));
        n[6] = n[7] = radius;
        if (tree->kind == TREE_CONE)
            n[7] = decimal(rng, 0.0, 0.4);
        tree->open = one_in(rng, 4);
        break;
    case TREE_TORUS:
        n[0] = radius, n[1] = decimal(rng, 0.15, 0.6);
        break;
    case TREE_PLANE:
        do
            put(n, point(rng, 1));
        while (fabs(n[0]) + fabs(n[1]) + fabs(n[2]) < 0.5);
        n[3] = decimal(rng, -0.3, 0.8);
        break;
    default:
        random_points(rng, n);
        break;
    }
}

static CsgTree *random_leaf(Rng *rng, Arena *arena, bool solid) {
    CsgTree *leaf = ARENA_NEW(arena, CsgTree);
    leaf->kind = (TreeKind)(rng_next(rng) % (solid ? TREE_PATCH : TREE_UNION));
    random_numbers(rng, leaf);
    return leaf;
}

// Of one tree all surfaces let light through or none does: once an opaque part has thrown a shadow,
// POV-Ray takes all of the tree that lies before the light for opaque.
static void random_texture(Rng *rng, double transmit, CsgTree *tree) {
    tree->textured = true;
    for (int i = 0; i < 3; i++)
        tree->color[i] = decimal(rng, 0.05, 1);
    tree->color[3] = transmit;
}

static void random_place(Rng *rng, CsgTree *tree) {
    tree->scale = vec3(1, 1, 1);
    if (one_in(rng, 2))
        tree->rotate = point(rng, 180);
    if (one_in(rng, 3))
        tree->scale = vec3(decimal(rng, 0.6, 1.4), decimal(rng, 0.6, 1.4), decimal(rng, 0.6, 1.4));
    if (one_in(rng, 2))
        tree->translate = point(rng, 0.6);
}

// A body that clips: without textures, and of solids only.
static CsgTree *random_body(Rng *rng, Arena *arena) {
    CsgTree *body = random_leaf(rng, arena, true);
    random_place(rng, body);
    if (one_in(rng, 3)) {
        CsgTree *group = ARENA_NEW(arena, CsgTree);
        group->kind = (TreeKind)(TREE_UNION + rng_next(rng) % 4);
        group->scale = vec3(1, 1, 1);
        group->first = body;
        body->next = random_leaf(rng, arena, true);
        random_place(rng, body->next);
        body = group;
    }
    body->inverse = one_in(rng, 3);
    return body;
}

// A whole one reaches down to the depth itself, others may end before.
// What all of one tree have in common.
typedef struct {
    Arena *arena;
    double transmit;
    bool bounded; // some have bounds
} Style;

static CsgTree *random_tree(Rng *rng, const Style *style, int depth, bool whole) {
    Arena *arena = style->arena;
    CsgTree *tree;
    if (depth == 0 || (!whole && one_in(rng, 3))) {
        tree = random_leaf(rng, arena, false);
    } else {
        tree = ARENA_NEW(arena, CsgTree);
        tree->kind = (TreeKind)(TREE_UNION + rng_next(rng) % 4);
        unsigned count = 2 + (unsigned)(rng_next(rng) % 2),
                 deep = (unsigned)(rng_next(rng) % count);
        CsgTree **end = &tree->first;
        for (unsigned i = 0; i < count; i++, end = &(*end)->next)
            *end = random_tree(rng, style, depth - 1, whole && i == deep);
    }
    random_place(rng, tree);
    tree->inverse = one_in(rng, 6);
    if (tree->kind < TREE_UNION || one_in(rng, 4))
        random_texture(rng, style->transmit, tree);
    if (tree->kind < TREE_UNION && one_in(rng, 4))
        tree->textured = false;
    if (tree->kind != TREE_PATCH && one_in(rng, 10))
        tree->clips = random_body(rng, arena);
    if (style->bounded && one_in(rng, 4))
        tree->bounds = random_body(rng, arena);
    if (style->bounded && tree->kind == TREE_PATCH && one_in(rng, 4))
        tree->clips = random_body(rng, arena);
    return tree;
}

CsgTree *csg_tree_random(Rng *rng, Arena *arena, int depth, bool bounded) {
    const Style style = {arena, one_in(rng, 2) ? 0.5 : 0.0, bounded};
    CsgTree *tree = random_tree(rng, &style, depth, true);
    if (!tree->textured)
        random_texture(rng, style.transmit, tree);
    return tree;
}

// ---- writing --------------------------------------------------------------------------------

static void write_vec(FILE *file, const char *before, const double *v) {
    fprintf(file, "%s<%.3f, %.3f, %.3f>", before, v[0], v[1], v[2]);
}

static void write_leaf(const CsgTree *tree, FILE *file) {
    const double *n = tree->numbers;
    switch (tree->kind) {
    case TREE_SPHERE:
        write_vec(file, "sphere { ", n);
        fprintf(file, ", %.3f", n[3]);
        break;
    case TREE_BOX:
        write_vec(file, "box { ", n);
        write_vec(file, ", ", n + 3);
        break;
    case TREE_CYLINDER:
    case TREE_CONE:
        write_vec(file, tree->kind == TREE_CONE ? "cone { " : "cylinder { ", n);
        if (tree->kind == TREE_CONE)
            fprintf(file, ", %.3f", n[6]);
        write_vec(file, ", ", n + 3);
        fprintf(file, ", %.3f%s", n[7], tree->open ? " open" : "");
        break;
    case TREE_TORUS:
        fprintf(file, "torus { %.3f, %.3f", n[0], n[1]);
        break;
    case TREE_PLANE:
        write_vec(file, "plane { ", n);
        fprintf(file, ", %.3f", n[3]);
        break;
    default:
        fprintf(file, "bicubic_patch { type 1 flatness 0 u_steps 2 v_steps 2");
        for (int i = 0; i < 16; i++)
            write_vec(file, i ? ", " : " ", n + (size_t)(3 * i));
        break;
    }
}

static void write_moves(const CsgTree *tree, FILE *file) {
    if (tree->rotate.x != 0 || tree->rotate.y != 0 || tree->rotate.z != 0)
        write_vec(file, " rotate ", &tree->rotate.x);
    if (tree->scale.x != 1 || tree->scale.y != 1 || tree->scale.z != 1)
        write_vec(file, " scale ", &tree->scale.x);
    if (tree->translate.x != 0 || tree->translate.y != 0 || tree->translate.z != 0)
        write_vec(file, " translate ", &tree->translate.x);
}

void csg_tree_write(const CsgTree *tree, FILE *file) {
    static const char *const groups[] = {"union", "merge", "intersection", "difference"};
    if (tree->kind < TREE_UNION) {
        write_leaf(tree, file);
    } else {
        fprintf(file, "%s {\n", groups[tree->kind - TREE_UNION]);
        for (const CsgTree *child = tree->first; child; child = child->next)
            csg_tree_write(child, file);
    }
    for (int bound = 0; bound < 2; bound++) {
        const CsgTree *body = bound ? tree->bounds : tree->clips;
        if (body)
            fprintf(file, "\n%s {\n", bound ? "bounded_by" : "clipped_by");
        for (; body; body = body->next) {
            csg_tree_write(body, file);
            if (!body->next)
                fprintf(file, "}");
        }
    }
    if (tree->textured)
        fprintf(file, " pigment { rgbt <%.3f, %.3f, %.3f, %.3f> }", tree->color[0], tree->color[1],
                tree->color[2], tree->color[3]);
    write_moves(tree, file);
    fprintf(file, "%s }\n", tree->inverse && tree->kind != TREE_PATCH ? " inverse" : "");
}
