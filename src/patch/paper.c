// SPDX-License-Identifier: MIT
// A tree over whole patches; all the rest is qi_paper_*.
#include "patch/paper.h"

#include "base/array.h"
#include "patch/qi.h"
#include "patch/tree.h"

struct Paper {
    const PatchDef *defs;
    Tree tree;
};

typedef struct {
    const Paper *paper;
    Query *query;
    uint32_t id; // of the patch at hand
} Walk;

Paper *paper_create(Arena *arena, const PatchDef *defs, size_t count) {
    Paper *paper = ARENA_NEW(arena, Paper);
    paper->defs = defs;
    ARRAY(Box) boxes = {0};
    for (size_t i = 0; i < count; i++) {
        Box box = box_empty();
        for (uint32_t k = 0; k < (defs[i].degree_u + 1) * (defs[i].degree_v + 1); k++)
            box = box_extend(box, defs[i].points[k]);
        array_push(&boxes, box);
    }
    tree_build(arena, boxes.items, (uint32_t)count, 1, &paper->tree);
    array_free(&boxes);
    return paper;
}

static void take_hit(void *context, const QiHit *hit) {
    Walk *walk = context;
    PatchHit full = {hit->t, hit->u, hit->v, hit->normal, hit->bound, walk->id};
    query_take(walk->query, &full);
}

static void search_patch(Walk *walk, uint32_t number) {
    Query *query = walk->query;
    const PatchDef *def = &walk->paper->defs[number];
    if (!(def->mask & query->mask))
        return;
    query->stats.patch_tests++;
    walk->id = def->id;
    Bezier patch;
    bezier_init(&patch, (int)def->degree_u, (int)def->degree_v, def->points);
    QiQuery ask = {query->ray, query->t_min, query->t_max, def->tolerance, bezier_whole(), NULL};
    QiStats stats = {0};
    QiHit hit;
    if (query->kind == QUERY_ALL)
        qi_paper_all(&patch, &ask, &stats, take_hit, walk);
    else if (query->kind == QUERY_ANY)
        query->found |= qi_paper_any(&patch, &ask, &stats);
    else if (qi_paper_nearest(&patch, &ask, &stats, &hit))
        take_hit(walk, &hit);
    query->stats.steps += stats.steps;
    query->stats.newton += stats.newton;
}

static bool visit_leaf(void *context, uint32_t leaf, TreeRay *ray) {
    Walk *walk = context;
    const Tree *tree = &walk->paper->tree;
    for (uint32_t i = tree->leaf_first[leaf]; i < tree->leaf_first[leaf + 1]; i++) {
        search_patch(walk, tree->order[i]);
        if (query_done(walk->query))
            return false;
    }
    tree_ray_cut(ray, walk->query->t_max);
    return true;
}

void paper_query(const Paper *paper, Query *query) {
    TreeRay ray;
    if (!tree_ray_begin(&paper->tree, &query->ray, query->t_min, query->t_max, &ray))
        return;
    Walk walk = {paper, query, 0};
    tree_walk(&paper->tree, &ray, visit_leaf, &walk);
}
