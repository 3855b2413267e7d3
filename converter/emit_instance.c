// SPDX-License-Identifier: MIT
// Copies of a declared tree: where there are many, the scene has the tree once, as a definition,
// and an instance for each copy. What is shown is the same, so all that POV-Ray works out for each
// copy anew keeps it from being shared: bounds, whose boxes lie along the axes of the world;
// lights; triangles and patches under a mirror, whose outside does not turn with them; patches that
// are stretched, or cut by a flatness: their triangles are others; and so on (part_fits, below).
//
// In a field of 1,000 bushes of 100 parts a copy takes 5 KB instead of 700, and the picture a
// quarter of the time; with 3 bushes neither differs. So a tree is shared when its copies would
// make SHARE_LEAST parts, 14 MB of them: a smaller scene keeps each object where it is.
#include "converter/emit.h"

#include <math.h>
#include <stdlib.h>

enum { SHARE_LEAST = 2000 };

// What some of the parts forbid: a mirror, that shows them inside out; to be stretched.
typedef struct {
    bool mirrors, stretches;
} Parts;

struct Shared {
    uint64_t copies;
    bool judged, fits;
    Parts parts;
    ARRAY(Definition) definitions;
};

// ---- counting ---------------------------------------------------------------------------------

void instance_count(Emitter *e, const ObjectNode *node) {
    uint32_t index;
    if (!node->late) {
        for (const ObjectNode *child = node->first; child; child = child->next)
            instance_count(e, child);
        return;
    }
    if (!node_find(&e->shared_nodes, node->first, &index)) {
        index = (uint32_t)e->shared.count;
        node_put(e, &e->shared_nodes, node->first, index);
        array_push(&e->shared, ARENA_NEW(e->cv->arena, Shared));
    }
    e->shared.items[index]->copies++;
}

// ---- what can be shared -----------------------------------------------------------------------

// Old places of the interior's values: a texture that has them changes the interior.
static bool bends(const TextureNode *texture) {
    return texture && texture_is_plain(texture) &&
           (texture->finish->ior >= 0 || texture->finish->caustics >= 0 ||
            texture->finish->refraction != 1.0F);
}

static bool part_fits(const ObjectNode *node, Parts *parts) {
    const Object *object = &node->object;
    bool tree = object_is_tree(object);
    if (node->light || node->keyword == KW_light_group || node->bounds || node->cutaway)
        return false;
    if (bends(node->texture) || bends(node->interior_texture))
        return false;
    // Whose textures move is only clear where the leaf has one of its own.
    if (object->uv_mapping && (tree || !node->texture || node->has_textures))
        return false;
    // A sphere stays a sphere of the world when it is turned, with its coordinates.
    if (object->uv_mapping && object->type == OBJECT_SPHERE)
        return false;
    // What is found to an accuracy depends on the rounding of the way there.
    if (object->type == OBJECT_ISOSURFACE || object->type == OBJECT_PARAMETRIC)
        return false;
    // Where patches are cut by flatness they are cut by their size. Tolerances are shares of it.
    if (object->type == OBJECT_PATCH && object->shape.patch.flatness > 0)
        return false;
    parts->stretches |= object->type == OBJECT_PATCH;
    if (node->clips && (object->type == OBJECT_PLANE || object->type == OBJECT_POLY ||
                        object->type == OBJECT_QUADRIC))
        return false;
    parts->mirrors |= object->type == OBJECT_TRIANGLE || object->type == OBJECT_PATCH ||
                      object->type == OBJECT_SMOOTH_TRIANGLE;
    return true;
}

static bool list_fits(const ObjectNode *list, Parts *parts) {
    for (; list; list = list->next)
        if (!part_fits(list, parts) || !list_fits(list->first, parts) ||
            !list_fits(list->clips, parts))
            return false;
    return true;
}

// POV-Ray takes what is larger for infinite, and looks at it first.
static const double INFINITE_VOLUME = 2e10;

static bool is_bounded(const ObjectNode *node) {
    Box box;
    if (!node_extent(node, &box))
        return false;
    Vec3 size = vec_sub(box.high, box.low);
    return size.x * size.y * size.z < INFINITE_VOLUME;
}

// The least depths of hits are lengths of the world, those of small primitives 1e-6 or less, and
// rays begin at 1e-4: in spaces this much smaller or larger nothing comes between.
static const double MOST_SCALE = 50.0;

static bool is_moderate(const Transform *t) {
    double out = 0, in = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out += t->m[i][j] * t->m[i][j], in += t->inv[i][j] * t->inv[i][j];
    return out <= MOST_SCALE * MOST_SCALE && in <= MOST_SCALE * MOST_SCALE;
}

// Does it mirror, or stretch one way more than another (but for rounding)?
static Parts forbidden_by(const Transform *t) {
    Vec3 row[3];
    for (int i = 0; i < 3; i++)
        row[i] = vec3(t->m[i][0], t->m[i][1], t->m[i][2]);
    double size = vec_dot(row[0], row[0]), off = 0;
    for (int i = 0; i < 3; i++)
        off = fmax(off, fmax(fabs(vec_dot(row[i], row[i]) - size),
                             fabs(vec_dot(row[i], row[(i + 1) % 3]))));
    bool mirrors = vec_dot(vec_cross(row[0], row[1]), row[2]) < 0;
    return (Parts){mirrors, off > 1e-9 * size};
}

Shared *instance_find(Emitter *e, const ObjectNode *node, Transform *move) {
    uint32_t index;
    if (!node->late || !node_find(&e->shared_nodes, node->first, &index))
        return NULL;
    Shared *shared = e->shared.items[index];
    if (shared->copies * node->below < SHARE_LEAST)
        return NULL;
    if (!shared->judged) {
        shared->judged = true;
        shared->fits = list_fits(node->first, &shared->parts);
    }
    *move = transform_identity();
    for (const LateMove *late = node->late; late; late = late->before)
        *move = transform_compose(&late->move->t, move);
    bool fits = shared->fits && !node->cutaway && !node_extent_cuts(node) && is_bounded(node) &&
                !bends(node->texture) && !node->interior_texture && !node->object.uv_mapping;
    const Parts off = forbidden_by(move), *parts = &shared->parts;
    fits = fits && is_moderate(move) && !(parts->mirrors && off.mirrors) &&
           !(parts->stretches && off.stretches);
    return fits ? shared : NULL;
}

// ---- definitions ------------------------------------------------------------------------------

static bool same_flags(const InstanceFlags *a, const InstanceFlags *b) {
    return a->no_shadow == b->no_shadow && a->no_image == b->no_image &&
           a->no_reflection == b->no_reflection && a->hollow == b->hollow &&
           a->double_set == b->double_set && a->double_illuminate == b->double_illuminate &&
           a->no_global_lights == b->no_global_lights && a->light_group == b->light_group;
}

const Definition *instance_definition(const Shared *shared, const ObjectNode *node,
                                      const InstanceFlags *flags) {
    for (size_t i = 0; i < shared->definitions.count; i++) {
        const Definition *d = &shared->definitions.items[i];
        if (d->no_split == node->no_split && same_flags(&d->flags, flags))
            return d;
    }
    return NULL;
}

static int compare_index(const void *a, const void *b) {
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

typedef ARRAY(uint32_t) Indices;

// Sorted, each once, in the arena.
static uint32_t *keep_indices(Emitter *e, Indices *list, uint32_t *count) {
    uint32_t n = 0;
    if (list->count > 1)
        qsort(list->items, list->count, sizeof *list->items, compare_index);
    for (size_t i = 0; i < list->count; i++)
        if (n == 0 || list->items[n - 1] != list->items[i])
            list->items[n++] = list->items[i];
    uint32_t *kept = arena_copy(e->cv->arena, list->items, n * sizeof *kept);
    *count = n;
    array_free(list);
    return kept;
}

static void note_index(Indices *list, uint32_t index) {
    if (index != NO_INDEX)
        array_push(list, index);
}

static void note_textures(const Object *object, Indices *list) {
    note_index(list, object->texture);
    note_index(list, object->interior_texture);
    if (object->type == OBJECT_MESH)
        for (uint32_t i = 0; i < object->shape.mesh.texture_count; i++)
            note_index(list, object->shape.mesh.textures[i]);
    if (object->type == OBJECT_BLOB)
        for (uint32_t i = 0; i < object->shape.blob.count; i++)
            note_index(list, object->shape.blob.components[i].texture);
}

// Is any of the texture taken at the surface's own coordinates?
static bool asks_uv(const Emitter *e, uint32_t index);

static bool pigment_asks_uv(const Emitter *e, uint32_t index) {
    const Pigment *pigment = &e->pigments.items[index];
    bool asks = pigment->uv_mapping;
    for (uint32_t i = 0; !asks && i < pigment->entry_count; i++)
        asks = pigment->entries[i].pigment != NO_INDEX &&
               pigment_asks_uv(e, pigment->entries[i].pigment);
    return asks;
}

static bool normal_asks_uv(const Emitter *e, uint32_t index) {
    const Normal *normal = &e->normals.items[index];
    bool asks = normal->uv_mapping;
    for (uint32_t i = 0; !asks && i < normal->entry_count; i++)
        asks = normal_asks_uv(e, normal->entries[i].index);
    return asks;
}

static bool asks_uv(const Emitter *e, uint32_t index) {
    const Texture *texture = &e->textures.items[index];
    bool asks = texture->uv_mapping;
    for (uint32_t i = 0; !asks && i < texture->layer_count; i++)
        asks =
            pigment_asks_uv(e, texture->layers[i].pigment) ||
            (texture->layers[i].normal != NO_INDEX && normal_asks_uv(e, texture->layers[i].normal));
    for (uint32_t i = 0; !asks && i < texture->entry_count; i++)
        asks = asks_uv(e, texture->entries[i].index);
    return asks;
}

const Definition *instance_define(Emitter *e, Shared *shared, const ObjectNode *node,
                                  const InstanceFlags *flags, uint32_t root, uint32_t first) {
    Indices moving = {0}, still = {0}, interiors = {0};
    bool good = root != NO_INDEX;
    for (size_t i = first; good && i < e->objects.count; i++) {
        const Object *object = &e->objects.items[i];
        if (object_is_tree(object))
            continue;
        note_textures(object, object->uv_mapping ? &still : &moving);
        note_index(&interiors, object->interior);
        if (object->type == OBJECT_SPHERE && object->texture != NO_INDEX)
            good = !asks_uv(e, object->texture);
    }
    Definition d = {.flags = *flags, .no_split = node->no_split};
    d.textures = keep_indices(e, &moving, &d.texture_count);
    d.interiors = keep_indices(e, &interiors, &d.interior_count);
    // A texture cannot both move and stay.
    for (size_t i = 0; good && i < still.count; i++)
        for (uint32_t k = 0; k < d.texture_count; k++)
            good = good && d.textures[k] != still.items[i];
    array_free(&still);
    if (!good) {
        e->objects.count = first;
        shared->fits = false;
        return NULL;
    }
    d.definition = (uint32_t)e->definitions.count;
    array_push(&e->definitions, root);
    array_push(&shared->definitions, d);
    return &shared->definitions.items[shared->definitions.count - 1];
}

// ---- instances --------------------------------------------------------------------------------

bool instance_fill(Emitter *e, const Definition *d, const Transform *move, Object *object) {
    InstanceShape *shape = &object->shape.instance;
    Arena *arena = e->cv->arena;
    // What the sphere of a definition has from the instance is taken at coordinates of the world.
    if (object->texture != NO_INDEX && asks_uv(e, object->texture))
        return false;
    shape->definition = d->definition;
    object->has_transform = !transform_is_identity(move);
    if (object->has_transform)
        object->transform = *move;
    Indices pairs = {0};
    for (uint32_t i = 0; i < d->texture_count; i++) {
        uint32_t moved = emit_texture_moved(e, d->textures[i], move);
        if (moved == d->textures[i])
            continue;
        array_push(&pairs, d->textures[i]);
        array_push(&pairs, moved);
    }
    shape->texture_count = (uint32_t)(pairs.count / 2);
    if (pairs.count > 0)
        shape->textures = arena_copy(arena, pairs.items, pairs.count * sizeof *pairs.items);
    array_free(&pairs);
    shape->interior_count = d->interior_count;
    shape->interiors = ARENA_ARRAY(arena, uint32_t, 2 * (size_t)d->interior_count);
    for (uint32_t i = 0; i < d->interior_count; i++) {
        Interior interior = e->interiors.items[d->interiors[i]];
        shape->interiors[2 * (size_t)i] = d->interiors[i];
        shape->interiors[2 * (size_t)i + 1] = (uint32_t)e->interiors.count;
        array_push(&e->interiors, interior);
    }
    return true;
}
