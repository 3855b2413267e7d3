// SPDX-License-Identifier: MIT
// Crossings are counted along directions without relation to how scenes are built. A count is not
// trusted when a crossing grazes the surface, lies at a patch's side, where both neighbours or none
// may report it, or is not told apart from the next one. Two trusted counts that agree decide;
// without such a pair, most of all counts.
#include "render/patch_solid.h"

#include "base/array.h"

#include <math.h>

struct PatchSolid {
    PatchSet *set;
    Box box;
    double size; // its diameter
};

enum { MAX_CROSSINGS = 64, DIRECTIONS = 15 };

// Below this cosine a crossing grazes.
static const double GRAZING = 1e-3;
// So near to a side in u or v.
static const double AT_SIDE = 1e-7;

static void add_patches(const Scene *scene, const Object *tree, PatchSolid *solid) {
    for (uint32_t i = 0; i < tree->shape.children.count; i++) {
        const Object *object = &scene->objects[tree->shape.children.items[i]];
        if (object_is_tree(object))
            add_patches(scene, object, solid);
        if (object->type != OBJECT_PATCH)
            continue;
        const PatchShape *patch = &object->shape.patch;
        PatchDef def = {.degree_u = patch->degree_u,
                        .degree_v = patch->degree_v,
                        .points = patch->points,
                        .weights = patch->weights,
                        .mask = 1,
                        .flatness = patch->flatness,
                        .u_steps = patch->u_steps,
                        .v_steps = patch->v_steps};
        for (uint32_t k = 0; k < (def.degree_u + 1) * (def.degree_v + 1); k++)
            solid->box = box_extend(solid->box, def.points[k]);
        patchset_add(solid->set, &def);
    }
}

PatchSolid *patch_solid_create(const Scene *scene, const Object *tree,
                               const PatchSetOptions *options, Arena *arena) {
    PatchSolid *solid = ARENA_NEW(arena, PatchSolid);
    solid->set = patchset_create(options);
    solid->box = box_empty();
    add_patches(scene, tree, solid);
    patchset_commit(solid->set);
    solid->size = vec_length(vec_sub(solid->box.high, solid->box.low));
    return solid;
}

void patch_solid_destroy(PatchSolid *solid) { patchset_destroy(solid->set); }
Box patch_solid_bounds(const PatchSolid *solid) { return solid->box; }
uint64_t patch_solid_memory(const PatchSolid *solid) { return patchset_memory(solid->set); }

typedef struct {
    const PatchSolid *solid;
    Vec3 dir;
    uint32_t count;
    bool certain;
    double t[MAX_CROSSINGS], bound[MAX_CROSSINGS];
} Crossings;

static bool at_side(double u) { return u < AT_SIDE || u > 1.0 - AT_SIDE; }

static void take_crossing(void *context, const PatchHit *hit) {
    Crossings *c = context;
    if (fabs(vec_dot(hit->normal, c->dir)) < GRAZING || at_side(hit->u) || at_side(hit->v))
        c->certain = false;
    double apart = 1e-9 * c->solid->size;
    if (c->count < MAX_CROSSINGS) {
        for (uint32_t i = 0; i < c->count; i++)
            if (fabs(c->t[i] - hit->t) <= c->bound[i] + hit->bound + apart)
                c->certain = false;
        c->t[c->count] = hit->t;
        c->bound[c->count] = hit->bound;
    } else {
        c->certain = false;
    }
    c->count++;
}

// Directions spread evenly (a lattice by the golden ratio), turned off all axes.
static Vec3 direction(int i) {
    double z = 1.0 - (2.0 * i + 1.0) / DIRECTIONS, r = sqrt(1.0 - z * z);
    double turn = 0.61803398874989485 * (2.0 * M_PI) * i + 0.7;
    Vec3 d = vec3(r * cos(turn), r * sin(turn), z);
    return vec_normalize(vec_add(d, vec3(0.0131, 0.0277, 0.0193)));
}

bool patch_solid_inside(const PatchSolid *solid, Vec3 p) {
    const Box *box = &solid->box;
    if (!(p.x >= box->low.x && p.x <= box->high.x && p.y >= box->low.y && p.y <= box->high.y &&
          p.z >= box->low.z && p.z <= box->high.z))
        return false;
    int odd = 0, even = 0, trusted_odd = 0, trusted_even = 0;
    for (int i = 0; i < DIRECTIONS && trusted_odd < 2 && trusted_even < 2; i++) {
        Crossings c = {.solid = solid, .dir = direction(i), .certain = true};
        Ray ray = {p, c.dir};
        PatchStats stats = {0};
        patchset_all(solid->set, &ray, 0.0, INFINITY, 1, &stats, take_crossing, &c);
        bool inside = c.count % 2 == 1;
        odd += inside, even += !inside;
        trusted_odd += inside && c.certain, trusted_even += !inside && c.certain;
    }
    if (trusted_odd != trusted_even)
        return trusted_odd > trusted_even;
    return odd > even;
}
