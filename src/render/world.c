// SPDX-License-Identifier: MIT
// Rays in a World. A ray walks one tree, nearer boxes first, up to the nearest hit so far; at equal
// depth the lower rank counts. Hits of leaves in trees are judged by csg.c.
//
// All patches together are one item of that tree, and instances are items: below them lie trees of
// their own, those of patches eight boxes wide, in single precision, for each instruction set
// (src/kernel), where solids are met four at a time in any order of depth. One tree of both kinds
// of leaves would walk each at the other's pace; as an item the patches are asked when the ray
// comes to their box, with the nearest solid before it as the limit, and what lies behind their hit
// is left out: 0.1 to 1.2 % fewer instructions in cliche.pov, FMunoz_demo.pov, easychair.pov and
// primitiv.pov than asking all solids first, and the same pictures. Shadow rays, which any hit
// ends, ask the patches first.
#include "render/world_data.h"
#include "shape/bvh_walk.h"

// POV-Ray's least depth of a patch made of triangles.
static const double PATCH_NEAREST = 1e-5;

typedef struct {
    const World *world;
    const Ray *ray; // unit direction
    double unit;    // length of one of the world, in an instance's space
    double t_min, patch_min;
    uint32_t kind;
    bool any;                    // the first hit ends it
    bool patches_done, foreseen; // foreseen: only those that something hides are left
    RayStats *stats;
    // The gate asked last, and the answer: leaves of one object follow one another.
    uint32_t gate;
    bool admits;
    double entry; // where the ray comes into the box of that object
    // The nearest so far; before that both are t_max, with a rank that nothing is below. POV-Ray
    // comes to an object when nothing has been met before the box, even if it then meets it before
    // the box: so the farther of the two is what decides.
    double t, depth;
    double slack; // how far off t may be, of a hit in an instance; else 0
    uint32_t rank;
    const Leaf *leaf;
    const Prim *prim;  // NULL: the hit is on a patch
    const Prim *outer; // the instance that leaf is in; NULL: none
    ShapeHit hit;
    PatchHit patch;
} RayQuery;

static bool is_admitted(RayQuery *query, const Leaf *leaf) {
    if (leaf->gate == NO_INDEX) {
        query->entry = -INFINITY;
        query->gate = NO_INDEX;
        return query->admits = true;
    }
    if (leaf->gate != query->gate) {
        query->gate = leaf->gate;
        query->admits = csg_admits(&query->world->csg, leaf->gate, query->ray, &query->entry);
        if (!query->world->in_order)
            query->entry = -INFINITY;
    }
    return query->admits;
}

static inline bool comes_first(const RayQuery *query, double t, double depth, const Leaf *leaf) {
    if (fabs(t - query->t) > query->slack)
        return t < query->t;
    if (query->outer)
        return leaf->rank < query->rank;
    return depth < query->depth || (depth == query->depth && leaf->rank < query->rank);
}

// Of a leaf that trees or bounds may hide.
static bool is_let_through(RayQuery *query, double depth, const Leaf *leaf, double *t) {
    Vec3 p = vec_madd(query->ray->org, depth, query->ray->dir);
    if (!csg_keeps(&query->world->csg, leaf->node, p, query->kind) || !is_admitted(query, leaf))
        return false;
    *t = fmax(depth, query->entry);
    return comes_first(query, *t, depth, leaf);
}

// *t: what decides.
static inline bool counts(RayQuery *query, double depth, double t_min, const Leaf *leaf,
                          double *t) {
    *t = depth;
    return depth >= t_min && comes_first(query, depth, depth, leaf) &&
           (!leaf->watched || is_let_through(query, depth, leaf, t));
}

static inline void keep(RayQuery *query, double t, double depth, const Leaf *leaf) {
    query->t = t;
    query->depth = depth;
    query->slack = 0.0;
    query->rank = leaf->rank;
    query->leaf = leaf;
    query->outer = NULL;
}

// Up to where hits are of interest.
static double limit_of(const RayQuery *query) { return query->t + query->slack; }

// Of several hits of one primitive at the same depth the last one counts.
typedef struct {
    RayQuery *query;
    const Prim *prim;
    bool any;
} PrimQuery;

static double try_solid_hit(void *context, const ShapeHit *hit) {
    PrimQuery *at = context;
    RayQuery *query = at->query;
    double t;
    at->any = true;
    bool again =
        query->prim == at->prim && query->leaf == &at->prim->leaf && hit->t == query->depth;
    if (again) {
        query->hit = *hit;
    } else if (counts(query, hit->t, query->t_min, &at->prim->leaf, &t)) {
        keep(query, t, hit->t, &at->prim->leaf);
        query->prim = at->prim;
        query->hit = *hit;
    }
    return query->any && query->leaf ? -INFINITY : limit_of(query);
}

// Narrows from..to to the depths within the box; false: there are none. The box is wider than what
// it stands for by far more than rounding.
static bool narrow_to_box(const Box *box, const Ray *ray, double *from, double *to) {
    for (int axis = 0; axis < 3; axis++) {
        double org = vec_get(ray->org, axis), dir = vec_get(ray->dir, axis);
        double a = vec_get(box->low, axis) - org, b = vec_get(box->high, axis) - org;
        if (dir == 0.0) {
            if (a > 0.0 || b < 0.0)
                return false;
            continue;
        }
        a /= dir, b /= dir;
        *from = fmax(*from, fmin(a, b));
        *to = fmin(*to, fmax(a, b));
    }
    return *from <= *to;
}

static void try_solid(RayQuery *query, const Prim *prim) {
    PrimQuery at = {query, prim, false};
    // At the same depth an earlier object counts, though some stop at the limit.
    double from = query->t_min, to = limit_of(query) * (1.0 + 0x1p-52);
    if (!prim->leaf.span || narrow_to_box(prim->leaf.span, query->ray, &from, &to))
        shape_visit_in(&prim->shape, query->ray, query->unit, from, to, try_solid_hit, &at);
    query->stats->shape_tests++;
    query->stats->shape_hits += at.any;
}

// Most infinite objects are planes, which every ray asks.
static inline void try_plane(RayQuery *query, const Prim *prim) {
    double depth, t;
    query->stats->shape_tests++;
    if (!plane_depth(&prim->shape.as.plane, query->ray, &depth))
        return;
    query->stats->shape_hits++;
    if (!counts(query, depth, query->t_min, &prim->leaf, &t))
        return;
    keep(query, t, depth, &prim->leaf);
    query->prim = prim;
    query->hit = (ShapeHit){.t = depth};
}

static void try_instance(RayQuery *query, const Prim *prim);
static void try_patches(RayQuery *query);

static inline void try_prim(RayQuery *query, const Prim *prim) {
    if (!(prim->leaf.mask & query->kind))
        return;
    if (prim->shape.kind == SHAPE_PLANE) {
        try_plane(query, prim);
        return;
    }
    if (prim->shape.kind == SHAPE_SOLID) {
        try_solid(query, prim);
        return;
    }
    if (prim->shape.kind == SHAPE_NONE) {
        if (prim->leaf.instance)
            try_instance(query, prim);
        else if (!query->patches_done)
            try_patches(query);
        return;
    }
    ShapeHit hits[SHAPE_MAX_HITS];
    int count = shape_hits(&prim->shape, query->ray, hits);
    query->stats->shape_tests++;
    query->stats->shape_hits += count > 0;
    for (int i = count - 1; i >= 0; i--) {
        double t;
        if (!counts(query, hits[i].t, query->t_min, &prim->leaf, &t))
            continue;
        keep(query, t, hits[i].t, &prim->leaf);
        query->prim = prim;
        query->hit = hits[i];
    }
}

static inline double try_item(void *context, uint32_t place) {
    RayQuery *query = context;
    try_prim(query, &query->world->prims[place]);
    return query->any && query->leaf ? -INFINITY : limit_of(query);
}

static void try_patch_hit(void *context, const PatchHit *hit) {
    RayQuery *query = context;
    const Leaf *leaf = &query->world->leaves[hit->id];
    double t;
    if (!counts(query, hit->t, query->patch_min, leaf, &t))
        return;
    keep(query, t, hit->t, leaf);
    query->prim = NULL;
    query->patch = *hit;
}

// Hits at the best depth so far are still wanted: an earlier object may have it.
static double reach(const RayQuery *query) {
    return query->leaf ? nextafter(limit_of(query), INFINITY) : query->t;
}

static void try_patches(RayQuery *query) {
    const World *world = query->world;
    PatchStats *stats = &query->stats->patch;
    double t_min = query->patch_min;
    PatchHit hit;
    if (query->any && world->patches &&
        patchset_occluded(world->patches, query->ray, t_min, reach(query), query->kind, stats)) {
        query->depth = query->t = t_min; // some depth, of some patch
        query->leaf = world->leaves;
        return;
    }
    if (!query->foreseen && !query->any && world->patches &&
        patchset_intersect(world->patches, query->ray, t_min, reach(query), query->kind, stats,
                           &hit))
        try_patch_hit(query, &hit);
    if (world->filtered)
        patchset_all(world->filtered, query->ray, t_min, reach(query), query->kind, stats,
                     try_patch_hit, query);
}

static void try_prims(RayQuery *query) {
    const World *world = query->world;
    for (uint32_t i = world->tree_count; i < world->prim_count && !(query->any && query->leaf);
         i++) {
        const Prim *prim = &world->prims[i];
        // Bounds are all that keeps rays away from what has no box.
        if (prim->leaf.gate == NO_INDEX || is_admitted(query, &prim->leaf))
            try_prim(query, prim);
    }
    // In many scenes the patches are all that is in the tree.
    bool left = world->tree_count > (world->patches_in_tree && query->patches_done ? 1 : 0);
    double t_min = query->t_min;
    if (world->patches_in_tree)
        t_min = fmin(t_min, query->patch_min);
    if (left && !(query->any && query->leaf))
        bvh_walk(&world->tree, query->ray, fmax(t_min, 0.0), limit_of(query), try_item, query);
    if (!world->patches_in_tree && !query->patches_done && !(query->any && query->leaf))
        try_patches(query);
}

// The ray in the definition's space, of unit direction; false: nothing can be asked of it.
static bool enter_instance(const Instance *instance, const Ray *ray, LocalRay *local) {
    return shape_local_ray(instance->transform, ray, local) && vec_is_finite(local->ray.org);
}

// A definition is asked for its own nearest hit, up to the nearest so far. Depths that differ by
// less than the way into its space may are the same: there the order of the source decides, as
// it does for all other objects.
static void try_instance(RayQuery *query, const Prim *prim) {
    const Instance *instance = prim->leaf.instance;
    LocalRay local;
    if (!enter_instance(instance, query->ray, &local))
        return;
    double limit = limit_of(query), slack = instance->slack[1];
    const Vec3 *org = &query->ray->org;
    double place = fabs(org->x) + fabs(org->y) + fabs(org->z);
    slack += instance->slack[0] * (place + fmin(limit, 1e3 * SHAPE_FARTHEST));
    RayQuery sub;
    sub.world = instance->world;
    sub.ray = &local.ray;
    sub.unit = local.scale;
    sub.t_min = query->t_min * local.scale;
    sub.patch_min = query->patch_min * local.scale;
    sub.kind = query->kind;
    sub.any = query->any;
    sub.patches_done = sub.foreseen = false;
    sub.stats = query->stats;
    sub.gate = NO_INDEX;
    sub.admits = true;
    sub.entry = -INFINITY;
    sub.t = sub.depth = (limit + slack) * local.scale;
    sub.slack = 0.0;
    sub.rank = 0;
    sub.leaf = NULL;
    sub.prim = sub.outer = NULL;
    try_prims(&sub);
    if (!sub.leaf)
        return;
    double t = sub.depth / local.scale;
    uint32_t rank = prim->leaf.rank + sub.rank;
    slack = fmax(slack, query->slack);
    bool same = query->leaf && fabs(t - query->t) <= slack;
    if (same ? rank > query->rank : t > query->t)
        return;
    query->t = query->depth = t;
    query->slack = slack;
    query->rank = rank;
    query->leaf = sub.leaf;
    query->prim = sub.prim;
    query->outer = prim;
    query->hit = sub.hit;
    query->patch = sub.patch;
}

// The same ray with a unit direction, in *room if it is not this one; *length: the old one's. NULL:
// nothing can be asked of it (no direction, numbers that are not finite).
static inline const Ray *unit_ray(const Ray *ray, Ray *room, double *length) {
    *length = 1.0;
    if (ray_is_unit(ray))
        return ray;
    *length = vec_length(ray->dir);
    if (!vec_is_finite(ray->org) || !(*length > 0.0) || !isfinite(*length))
        return NULL;
    *room = (Ray){ray->org, vec_scale(ray->dir, 1.0 / *length)};
    return room;
}

static double patch_least(const World *world, double t) {
    return world->exact ? t : fmax(t, PATCH_NEAREST);
}

static Vec2 patch_uv(const PatchShape *patch, double u, double v) {
    const double w[4] = {(1.0 - u) * (1.0 - v), (1.0 - u) * v, u * v, u * (1.0 - v)};
    Vec2 uv = {0, 0};
    for (int i = 0; i < 4; i++) {
        uv.u += w[i] * patch->uv[i].u;
        uv.v += w[i] * patch->uv[i].v;
    }
    return uv;
}

double world_unit(const World *world) { return world->unit; }

WorldNear world_near(const World *world, const WorldHit *from, Vec3 dir, double least) {
    least *= world->unit;
    if (!world->exact)
        return (WorldNear){least, fmax(least, PATCH_NEAREST)};
    if (!from)
        return (WorldNear){least, 0.0};
    if (!(from->reach > 0.0))
        return (WorldNear){least, least};
    // The start is off the surface by the hit's bound and the rounding of org + t dir; the surface,
    // or that of a neighbour, is found again as far off as its tolerance allows. At a sine s to it
    // that is a way of d / s; where the ray leaves at less than the angle at which a surface as
    // curved as the whole set is wide departs by d, by that way.
    double place = fabs(from->p.x) + fabs(from->p.y) + fabs(from->p.z) + from->t;
    double d = from->reach + 16.0 * 0x1p-53 * place;
    double sine = fabs(vec_dot(dir, from->normal)) / vec_length(dir);
    double least_sine = sqrt(d / world->size);
    return (WorldNear){least, 2.0 * d / fmax(sine, least_sine) / vec_length(dir)};
}

bool world_intersect(const World *world, const Ray *ray, double t_min, double t_max, RayKind kind,
                     RayStats *stats, WorldHit *hit) {
    return world_nearest(world, ray, (WorldNear){t_min, t_min}, t_max, kind, stats, hit);
}

// All but what is known of a hit, which nobody asks for before there is one. An initializer would
// clear that too, for every ray.
static inline void query_start(RayQuery *query, const World *world, const Ray *unit,
                               const WorldNear *near, double length, double t_max,
                               RayStats *stats) {
    query->world = world;
    query->ray = unit;
    query->unit = 1.0;
    query->t_min = near->shapes * length;
    query->patch_min = patch_least(world, near->patches * length);
    query->stats = stats;
    query->gate = NO_INDEX;
    query->admits = true;
    query->entry = -INFINITY;
    query->t = query->depth = t_max * length;
    query->slack = 0.0;
    query->rank = 0;
    query->leaf = NULL;
    query->prim = query->outer = NULL;
}

// What a cut shows, where it has nothing of its own.
static void add_cut(const RayQuery *query, WorldHit *hit) {
    const Leaf *leaf = query->leaf;
    if (leaf->cut != NO_INDEX && hit->texture_count == 0)
        hit->texture_count = csg_cut_textures(&query->world->csg, leaf->cut, hit->p, hit->textures);
}

// What is known of the query's hit on a primitive, in the space of the world it is in.
static void describe_prim(const RayQuery *query, bool without_uv, WorldHit *hit) {
    const Shape *shape = &query->prim->shape;
    hit->texture_count = shape_textures(shape, hit->p, &query->hit, hit->textures);
    Vec2 uv = {0, 0};
    if (!without_uv)
        uv = shape_uv(shape, hit->p, &query->hit);
    hit->normal = shape_normal(shape, hit->p, &query->hit);
    hit->u = uv.u, hit->v = uv.v;
    hit->bound = hit->reach = 0.0;
    add_cut(query, hit);
}

static void describe_patch(const RayQuery *query, WorldHit *hit) {
    const PatchShape *patch = &query->world->scene->objects[hit->object].shape.patch;
    Vec2 uv = patch_uv(patch, query->patch.u, query->patch.v);
    hit->texture_count = 0;
    hit->normal = query->patch.normal;
    hit->u = uv.u, hit->v = uv.v;
    hit->bound = query->patch.bound;
    hit->reach = query->patch.bound + query->leaf->tolerance;
    add_cut(query, hit);
}

// The same where an instance shows it.
static void describe_moved(const RayQuery *query, bool without_uv, WorldHit *hit) {
    const Instance *instance = query->outer->leaf.instance;
    const Vec3 p = hit->p;
    hit->instance = query->outer->leaf.object;
    hit->p = shape_local_point(instance->transform, p);
    if (query->prim)
        describe_prim(query, without_uv, hit);
    else
        describe_patch(query, hit);
    hit->normal = shape_world_normal(instance->transform, hit->normal, hit->normal);
    hit->bound *= instance->stretch;
    if (query->prim && !shape_maps_uv(&query->prim->shape) && !without_uv)
        hit->u = p.x, hit->v = p.y;
    if (!query->prim)
        hit->reach = hit->reach * instance->stretch + query->slack;
    hit->p = p;
}

bool world_nearest(const World *world, const Ray *ray, WorldNear near, double t_max, RayKind kind,
                   RayStats *stats, WorldHit *hit) {
    return world_nearest_foreseen(world, ray, near, t_max, kind, NULL, stats, hit);
}

bool world_nearest_foreseen(const World *world, const Ray *ray, WorldNear near, double t_max,
                            RayKind kind, const WorldForeseen *foreseen, RayStats *stats,
                            WorldHit *hit) {
    Ray room;
    RayStats unused;
    if (!stats) {
        unused = (RayStats){0};
        stats = &unused;
    }
    double length;
    const Ray *unit = unit_ray(ray, &room, &length);
    if (!unit)
        return false;
    RayQuery query;
    query_start(&query, world, unit, &near, length, t_max, stats);
    query.kind = kind;
    query.any = false;
    query.foreseen = foreseen != NULL;
    query.patches_done = query.foreseen && !world->filtered;
    if (foreseen && foreseen->found)
        try_patch_hit(&query, &foreseen->hit);
    try_prims(&query);
    if (!query.leaf)
        return false;
    hit->t = query.depth / length;
    hit->p = vec_madd(unit->org, query.depth, unit->dir);
    hit->object = query.leaf->object;
    hit->instance = NO_INDEX;
    if (query.outer)
        describe_moved(&query, world->without_uv, hit);
    else if (query.prim)
        describe_prim(&query, world->without_uv, hit);
    else
        describe_patch(&query, hit);
    return true;
}

bool world_occluded(const World *world, const Ray *ray, double t_min, double t_max,
                    RayStats *stats) {
    uint32_t last = WORLD_NO_BLOCKER;
    return world_blocked(world, ray, (WorldNear){t_min, t_min}, t_max, &last, stats);
}

bool world_blocked(const World *world, const Ray *ray, WorldNear near, double t_max, uint32_t *last,
                   RayStats *stats) {
    return world_blocked_foreseen(world, ray, near, t_max, NULL, last, stats);
}

bool world_blocked_foreseen(const World *world, const Ray *ray, WorldNear near, double t_max,
                            const WorldForeseen *foreseen, uint32_t *last, RayStats *stats) {
    Ray room;
    RayStats unused;
    if (!stats) {
        unused = (RayStats){0};
        stats = &unused;
    }
    double length;
    const Ray *unit = unit_ray(ray, &room, &length);
    if (!unit)
        return false;
    RayQuery query;
    query_start(&query, world, unit, &near, length, t_max, stats);
    query.kind = RAY_SHADOW;
    query.any = query.patches_done = true; // those by the quickest way, below
    query.foreseen = false;
    double patch_min = query.patch_min;
    if (*last < world->prim_count) {
        try_prim(&query, &world->prims[*last]);
        if (query.leaf)
            return true;
        *last = WORLD_NO_BLOCKER;
    }
    if (foreseen) {
        if (foreseen->found)
            return true;
    } else if (world->patches && patchset_occluded(world->patches, unit, patch_min, query.t,
                                                   RAY_SHADOW, &query.stats->patch)) {
        return true;
    }
    try_prims(&query);
    if (query.leaf)
        *last = (uint32_t)((query.outer ? query.outer : query.prim) - world->prims);
    if (!query.leaf && world->filtered)
        patchset_all(world->filtered, unit, patch_min, query.t, RAY_SHADOW, &query.stats->patch,
                     try_patch_hit, &query);
    return query.leaf != NULL;
}
