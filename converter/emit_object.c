// SPDX-License-Identifier: MIT
// Objects of the scene from their nodes: what children inherit is worked out here (facts: sdl 4.5,
// rendering 4.6), lights leave their unions, and what is not modelled is left out.
#include "converter/emit.h"

#include <math.h>

// ---- interiors -------------------------------------------------------------------------------

// The interior that the children of an object without one of their own share. It is stored when
// the first child needs it.
typedef struct {
    const InteriorNode *node; // NULL: air
    const TextureNode *texture;
    uint32_t index;
    bool outside; // of a definition: it is the instance's
} SharedInterior;

static uint32_t store_interior(Emitter *e, const InteriorNode *node) {
    Interior interior = node ? node->interior : interior_default();
    if (node)
        emit_gaps(e, node->gaps);
    if (node && !node->bends)
        interior.ior = interior.dispersion = 1.0F;
    array_push(&e->interiors, interior);
    return (uint32_t)(e->interiors.count - 1);
}

// Before 3.1 ior and caustics stood in the finish. A plain top layer still passes them on.
static bool finish_has_interior(const TextureNode *texture) {
    return texture && texture_is_plain(texture) &&
           (texture->finish->ior >= 0 || texture->finish->caustics >= 0 ||
            texture->finish->refraction != 1.0F);
}

static void take_from_finish(Emitter *e, uint32_t index, const TextureNode *texture) {
    if (index == NO_INDEX || !texture || !texture_is_plain(texture))
        return;
    Interior *interior = &e->interiors.items[index];
    interior->refraction = texture->finish->refraction;
    if (texture->finish->ior >= 0) {
        interior->ior = texture->finish->ior == 0.0F ? 1.0F : texture->finish->ior;
        interior->dispersion = 1.0F;
    }
    if (texture->finish->caustics >= 0)
        interior->caustics = texture->finish->caustics;
}

static uint32_t use_shared(Emitter *e, SharedInterior *shared) {
    if (shared->index == NO_INDEX && !shared->outside) {
        shared->index = store_interior(e, shared->node);
        take_from_finish(e, shared->index, shared->texture);
    }
    return shared->index;
}

// ---- what comes down the tree ----------------------------------------------------------------

typedef struct {
    const TextureNode *texture, *interior_texture;
    SharedInterior *interior; // NULL at top level
    bool cutaway;             // cutaway_textures around
    bool textured;            // texture has come down; else POV-Ray has none so far
    bool cuts;                // what is right below may stay without a texture
    bool body;                // of clipped_by and the like: only its shape counts
    bool nested;              // in something that is one object to POV-Ray
    bool uv_mapping, no_shadow, no_image, no_reflection;
    bool hollow, double_set, double_illuminate;
    bool grouped;          // some light_group is around
    bool no_global_lights; // the outermost one says so
    uint32_t light_group;  // the innermost one that has lights and something to light
    uint32_t own_lights;   // the group of a light that stands here
} Inherited;

static uint32_t emit_object(Emitter *e, const ObjectNode *node, const Inherited *from);

static void emit_missing(Emitter *e, const ObjectNode *node);

static void emit_clips(Emitter *e, const ObjectNode *node, Object *object);

static uint32_t store_object(Emitter *e, const Object *object) {
    array_push(&e->objects, *object);
    return (uint32_t)(e->objects.count - 1);
}

// What the object is to its children, or, for a leaf, what it finally has.
static Inherited inherit(const ObjectNode *node, const Inherited *from) {
    const Object *object = &node->object;
    Inherited own = *from;
    own.texture = node->texture ? node->texture : from->texture;
    bool by_default = !node->textured && !from->cuts;
    own.textured = node->texture || from->textured || by_default;
    own.cutaway = node->cutaway || from->cutaway;
    own.cuts = own.cutaway && object->type == OBJECT_INTERSECTION;
    own.interior_texture = node->interior_texture ? node->interior_texture : from->interior_texture;
    bool takes_uv = !node->texture || !node->interior_texture;
    own.uv_mapping = object->uv_mapping || (from->uv_mapping && takes_uv);
    own.no_shadow |= object->no_shadow;
    own.no_image |= object->no_image;
    own.no_reflection |= object->no_reflection;
    own.hollow = node->hollow_set ? object->hollow : from->hollow;
    if (!from->double_set && node->double_set) {
        own.double_set = true;
        own.double_illuminate = object->double_illuminate;
    }
    return own;
}

static void apply_flags(Object *object, const Inherited *own) {
    object->uv_mapping = own->uv_mapping;
    object->no_shadow = own->no_shadow;
    object->no_image = own->no_image;
    object->no_reflection = own->no_reflection;
    object->hollow = own->hollow;
    object->light_group = own->light_group;
    object->no_global_lights = own->no_global_lights;
    object->double_illuminate = own->double_illuminate;
}

// ---- lights ----------------------------------------------------------------------------------

// What light_groups are to the objects and lights in them.
static void enter_group(Emitter *e, const ObjectNode *node, Inherited *own) {
    own->own_lights = 0;
    if (node->keyword != KW_light_group)
        return;
    if (!own->grouped)
        own->no_global_lights = !node->global_lights;
    own->grouped = true;
    bool lights = false, objects = false;
    for (const ObjectNode *child = node->first; child; child = child->next) {
        lights = lights || child->light;
        objects = objects || !child->light;
    }
    if (lights)
        own->own_lights = ++e->group_count;
    if (lights && objects)
        own->light_group = own->own_lights;
}

uint32_t emit_body(Emitter *e, const ObjectNode *node) {
    const Inherited from = {.body = true};
    return emit_object(e, node, &from);
}

uint32_t emit_hidden(Emitter *e, const ObjectNode *body) {
    // Whatever keeps other rays from seeing it does not count.
    uint32_t index = emit_body(e, body);
    if (index == NO_INDEX)
        return NO_INDEX;
    array_push(&e->projections, index);
    return (uint32_t)(e->projections.count - 1);
}

static void store_light(Emitter *e, const LightNode *node, uint32_t group) {
    Light light = light_finished(node);
    emit_gaps(e, node->gaps);
    light.group = group;
    if (node->projected_through) {
        light.projection = emit_hidden(e, node->projected_through);
        light.has_projection = light.projection != NO_INDEX;
    }
    array_push(&e->lights, light);
}

static uint32_t emit_light(Emitter *e, const ObjectNode *node, const Inherited *from) {
    store_light(e, node->light, from->own_lights);
    if (!node->light->looks_like)
        return NO_INDEX;
    Inherited own = *from;
    own.no_global_lights = false; // the group's word does not reach into its lights
    return emit_object(e, node->light->looks_like, &own);
}

// ---- bounds (facts: rendering 7.7, 8) --------------------------------------------------------

// Top-level unions are taken apart, but not those with bounds.
static bool is_split(const ObjectNode *node) {
    return node->object.type == OBJECT_UNION && !node->clips && !node->no_split &&
           (!node->bounds || node->keyword == KW_light_group);
}

// POV-Ray drops the bounds of what is cheap to meet, where it is an object of its own.
static bool drops_bounds(const ObjectNode *node, const Inherited *from) {
    if (from->nested || from->body)
        return false;
    return object_is_tree(&node->object)
               ? is_split(node)
               : node->object.type != OBJECT_POLY && node->object.type != OBJECT_TEXT;
}

static uint64_t count_frames(const ObjectNode *node) {
    if (node->light || !is_split(node))
        return 1;
    uint64_t count = 0;
    for (const ObjectNode *child = node->first; child; child = child->next)
        count += count_frames(child);
    return count;
}

// What POV-Ray has as one object is looked for only on rays that meet its box; a few types only as
// far as a tree of boxes leads to them, which there is from so many objects on.
enum { BOUNDING_THRESHOLD = 3 };

static bool looks_at_box(const Emitter *e, const ObjectNode *node, const Inherited *from) {
    switch (node->object.type) {
    case OBJECT_PLANE:
    case OBJECT_SPHERE:
    case OBJECT_BOX:
    case OBJECT_POLY:
    case OBJECT_TRIANGLE:
    case OBJECT_SMOOTH_TRIANGLE:
        return !from->body && e->frame_count >= BOUNDING_THRESHOLD;
    default:
        return true;
    }
}

static bool find_box(const Emitter *e, const ObjectNode *node, const Inherited *from, Box *box) {
    if (from->nested || is_split(node) || !node_extent_cuts(node) || !looks_at_box(e, node, from) ||
        !node_extent(node, box))
        return false;
    Vec3 size = vec_sub(box->high, box->low);
    return fmin(size.x, fmin(size.y, size.z)) >= 0 && vec_length(size) < 1e10;
}

// from: what is around the node.
static void emit_bounds(Emitter *e, const ObjectNode *node, const Inherited *from, Object *object) {
    const ObjectNode *bounds = drops_bounds(node, from) ? NULL : node->bounds;
    Box box;
    uint32_t count = 1;
    for (const ObjectNode *bound = bounds; bound; bound = bound->next)
        count++;
    ObjectList list = {ARENA_ARRAY(e->cv->arena, uint32_t, count), 0};
    if (find_box(e, node, from, &box)) {
        Object limit = object_default(OBJECT_BOX);
        limit.shape.box = (BoxShape){box.low, box.high};
        list.items[list.count++] = store_object(e, &limit);
    }
    for (const ObjectNode *bound = bounds; bound; bound = bound->next) {
        if (!object_is_there(bound)) {
            emit_missing(e, bound);
            emit_gap(e, node->bound_loc, "bounded_by is left out: what it would cut away is shown");
            continue;
        }
        uint32_t index = emit_body(e, bound);
        if (index != NO_INDEX)
            list.items[list.count++] = index;
    }
    if (list.count > 0)
        object->bounds = list;
}

// ---- cutaway_textures ------------------------------------------------------------------------

// Does POV-Ray ask only its parts for their textures?
static bool asks_nobody(ObjectType type) { return type == OBJECT_BLOB || type == OBJECT_MESH; }

// Has POV-Ray no texture for it, not even the default one? It puts that on what it takes for
// untextured where it stands, but not right below an intersection with cutaway_textures.
static bool is_bare(const Inherited *own) { return own->cutaway && !own->textured; }

// ---- trees -----------------------------------------------------------------------------------

// A union whose parts throw no shadow throws none.
static bool throws_none(const Emitter *e, const Object *tree) {
    for (uint32_t i = 0; i < tree->shape.children.count; i++)
        if (!e->objects.items[tree->shape.children.items[i]].no_shadow)
            return false;
    return true;
}

// from: what is around it; own: what it is to its children.
static uint32_t emit_tree(Emitter *e, const ObjectNode *node, const Inherited *from,
                          Inherited *own) {
    own->nested = from->nested || !is_split(node);
    if (own->nested && !from->nested)
        emit_cut_gap(e, node);
    SharedInterior shared = {
        .node = node->interior, .texture = is_bare(own) ? NULL : own->texture, .index = NO_INDEX};
    if (node->interior || !own->interior)
        own->interior = &shared;
    uint32_t count = 0;
    for (const ObjectNode *child = node->first; child; child = child->next)
        count++;
    uint32_t *items = ARENA_ARRAY(e->cv->arena, uint32_t, count);
    count = 0;
    for (const ObjectNode *child = node->first; child; child = child->next) {
        uint32_t index = emit_object(e, child, own);
        if (index != NO_INDEX)
            items[count++] = index;
    }
    if (count == 0)
        return NO_INDEX;
    Object object = node->object;
    apply_flags(&object, own);
    object.shape.children = (ObjectList){items, count};
    emit_clips(e, node, &object);
    emit_bounds(e, node, from, &object);
    bool union_alone = object.type == OBJECT_UNION && own->nested && !from->nested;
    object.whole = union_alone && !object.clips.count;
    object.difference = node->difference;
    object.no_shadow = object.no_shadow || (union_alone && throws_none(e, &object));
    if (patch_solid_is_meant(e->cv, node)) {
        object.solid = patch_solid_is_closed(node);
        if (!object.solid)
            emit_gap(e, node->loc, "union: these patches are not closed: they are no solid");
    }
    return store_object(e, &object);
}

static uint32_t emit_leaf(Emitter *e, const ObjectNode *node, const Inherited *from,
                          const Inherited *own) {
    Object object = node->object;
    apply_flags(&object, own);
    if (object.type != OBJECT_PATCH)
        emit_clips(e, node, &object);
    emit_bounds(e, node, from, &object);
    emit_solid(e, node, own->body, &object);
    if (own->body)
        return store_object(e, &object);
    // Letters are children of a union to POV-Ray, which is an intersection when it is inverted.
    bool bare = is_bare(own) && (object.type != OBJECT_TEXT || object.inverse);
    const TextureNode *texture = bare ? NULL : own->texture;
    object.texture = texture ? emit_texture(e, texture) : NO_INDEX;
    object.cutaway = bare && !asks_nobody(object.type);
    if (own->interior_texture)
        object.interior_texture = emit_texture(e, own->interior_texture);
    if (node->interior)
        object.interior = store_interior(e, node->interior);
    else if (own->interior)
        object.interior = use_shared(e, own->interior);
    else if (finish_has_interior(texture))
        object.interior = store_interior(e, NULL);
    take_from_finish(e, object.interior, texture);
    return store_object(e, &object);
}

// Lights shine even out of an object that is left out.
static void emit_lights(Emitter *e, const ObjectNode *node, const Inherited *from) {
    Inherited own = *from;
    if (node->light)
        store_light(e, node->light, from->own_lights);
    else
        enter_group(e, node, &own);
    for (const ObjectNode *child = node->first; child; child = child->next)
        emit_lights(e, child, &own);
}

// ---- what is not modelled --------------------------------------------------------------------

// Does it only take away, where it stands in an intersection? Then that can do without it.
static bool only_cuts(const ObjectNode *node) {
    if (node->light)
        return !node->light->looks_like;
    if (!keyword_is_csg(node->keyword))
        return node->object.inverse;
    for (const ObjectNode *child = node->first; child; child = child->next)
        if (!only_cuts(child))
            return false;
    return true;
}

bool object_is_there(const ObjectNode *node) {
    if (node->light)
        return node->light->looks_like && object_is_there(node->light->looks_like);
    if (!node->modelled || !object_is_tree(&node->object))
        return node->modelled && !node->ignored;
    bool any = false;
    for (const ObjectNode *child = node->first; child; child = child->next) {
        bool there = object_is_there(child);
        if (!there && node->object.type == OBJECT_INTERSECTION && !only_cuts(child))
            return false;
        any = any || there;
    }
    return any;
}

// Says what is missing in a tree that is left out.
static void emit_missing(Emitter *e, const ObjectNode *node) {
    for (const ObjectNode *child = node->first; child; child = child->next)
        emit_missing(e, child);
    if (node->modelled)
        emit_gaps(e, node->gaps);
    else
        emit_gap(e, node->loc,
                 arena_printf(e->cv->arena,
                              "'%s' is not modelled: the object is missing in the picture",
                              keyword_name(node->keyword)));
}

// Clips make the object smaller; without one that is not modelled it would be wrong to keep others.
static void emit_clips(Emitter *e, const ObjectNode *node, Object *object) {
    uint32_t count = 0;
    for (const ObjectNode *clip = node->clips; clip; clip = clip->next, count++)
        if (!object_is_there(clip)) {
            emit_missing(e, clip);
            emit_gap(e, node->clip_loc, "clipped_by is left out: the object is shown whole");
            return;
        }
    if (count == 0)
        return;
    object->clips.items = ARENA_ARRAY(e->cv->arena, uint32_t, count);
    for (const ObjectNode *clip = node->clips; clip; clip = clip->next)
        if ((object->clips.items[object->clips.count] = emit_body(e, clip)) != NO_INDEX)
            object->clips.count++;
}

// ---- copies of declared trees ----------------------------------------------------------------

// A copy with children of its own.
static const ObjectNode *apart(Emitter *e, const ObjectNode *node) {
    ObjectNode *copy = object_copy(e->cv, node);
    object_unshare(e->cv, copy);
    return copy;
}

// The tree as it was declared, without the texture and the interior that the copy has.
static const Definition *define(Emitter *e, Shared *shared, const ObjectNode *node,
                                const Inherited *from, const InstanceFlags *flags) {
    uint32_t first = (uint32_t)e->objects.count;
    ObjectNode *tree = object_copy(e->cv, node);
    SharedInterior outside = {.index = NO_INDEX, .outside = true};
    tree->late = NULL;
    tree->interior = NULL;
    Inherited own = inherit(node, from);
    own.texture = NULL;
    own.interior = &outside;
    uint32_t root = emit_tree(e, tree, from, &own);
    return instance_define(e, shared, node, flags, root, first);
}

// One more copy of what the scene has once. False: it must be emitted like any other object.
static bool emit_instance(Emitter *e, const ObjectNode *node, const Inherited *from,
                          uint32_t *index) {
    Transform move;
    Shared *shared = NULL;
    bool open = !from->nested && !from->body && !from->cutaway && !from->uv_mapping;
    if (open && !from->interior_texture && !finish_has_interior(from->texture))
        shared = instance_find(e, node, &move);
    if (!shared)
        return false;
    Inherited own = inherit(node, from);
    const InstanceFlags flags = {.no_shadow = own.no_shadow,
                                 .no_image = own.no_image,
                                 .no_reflection = own.no_reflection,
                                 .hollow = own.hollow,
                                 .double_set = own.double_set,
                                 .double_illuminate = own.double_illuminate,
                                 .no_global_lights = own.no_global_lights,
                                 .light_group = own.light_group};
    const Definition *definition = instance_definition(shared, node, &flags);
    if (!definition)
        definition = define(e, shared, node, from, &flags);
    Object object = object_default(OBJECT_INSTANCE);
    if (!definition)
        return false;
    object.texture = emit_texture(e, own.texture);
    if (node->interior)
        object.interior = store_interior(e, node->interior);
    else if (from->interior)
        object.interior = use_shared(e, from->interior);
    if (!instance_fill(e, definition, &move, &object))
        return false;
    *index = store_object(e, &object);
    return true;
}

// ---- any object ------------------------------------------------------------------------------

static uint32_t emit_object(Emitter *e, const ObjectNode *node, const Inherited *from) {
    uint32_t instance;
    if (node->late && emit_instance(e, node, from, &instance))
        return instance;
    if (node->late)
        node = apart(e, node);
    if (!node->light && !object_is_there(node)) {
        emit_lights(e, node, from);
        emit_missing(e, node);
        return NO_INDEX;
    }
    emit_gaps(e, node->gaps);
    Inherited own = inherit(node, from);
    if (node->light)
        return emit_light(e, node, &own);
    enter_group(e, node, &own);
    if (object_is_tree(&node->object))
        return emit_tree(e, node, from, &own);
    return emit_leaf(e, node, from, &own);
}

void emit_roots(Emitter *e) {
    for (const RootNode *root = e->cv->nodes->first; root; root = root->next) {
        e->frame_count += count_frames(root->object);
        instance_count(e, root->object);
    }
    for (const RootNode *root = e->cv->nodes->first; root; root = root->next) {
        Inherited from = {.texture = root->default_texture};
        uint32_t index = emit_object(e, root->object, &from);
        if (index != NO_INDEX)
            array_push(&e->roots, index);
    }
}
