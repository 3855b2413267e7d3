// SPDX-License-Identifier: MIT
// What objects have in common, once for all copies: meshes and height maps; and the textures of
// the parts of an object.
#include "converter/emit.h"

static uint32_t pool_mesh(Emitter *e, const Mesh *mesh) {
    uint32_t index;
    if (node_find(&e->mesh_nodes, mesh, &index))
        return index;
    array_push(&e->meshes, *mesh);
    index = (uint32_t)(e->meshes.count - 1);
    node_put(e, &e->mesh_nodes, mesh, index);
    return index;
}

static uint32_t pool_map(Emitter *e, const HeightMap *map) {
    uint32_t index;
    if (node_find(&e->map_nodes, map, &index))
        return index;
    array_push(&e->height_maps, *map);
    index = (uint32_t)(e->height_maps.count - 1);
    node_put(e, &e->map_nodes, map, index);
    return index;
}

static void emit_mesh(Emitter *e, const ObjectNode *node, bool bare, MeshShape *shape) {
    shape->mesh = pool_mesh(e, node->mesh);
    if (!node->has_textures)
        return;
    shape->texture_count = node->texture_count;
    shape->textures = ARENA_ARRAY(e->cv->arena, uint32_t, node->texture_count);
    // Of a body only the shape counts, but the faces' numbers must have something to stand for.
    for (uint32_t i = 0; i < node->texture_count; i++)
        shape->textures[i] = emit_texture(e, node->textures[bare ? 0 : i]);
}

static void emit_blob(Emitter *e, const ObjectNode *node, bool bare, BlobShape *blob) {
    if (!node->has_textures || bare)
        return;
    blob->components =
        arena_copy(e->cv->arena, blob->components, blob->count * sizeof *blob->components);
    for (uint32_t i = 0; i < blob->count; i++)
        if (node->textures[i])
            blob->components[i].texture = emit_texture(e, node->textures[i]);
}

void emit_solid(Emitter *e, const ObjectNode *node, bool bare, Object *object) {
    if (object->type == OBJECT_MESH)
        emit_mesh(e, node, bare, &object->shape.mesh);
    else if (object->type == OBJECT_HEIGHT_FIELD)
        object->shape.height_field.map = pool_map(e, node->map);
    else if (object->type == OBJECT_ISOSURFACE)
        object->shape.isosurface.function = emit_function(e, node->functions[0]);
    else if (object->type == OBJECT_PARAMETRIC)
        for (int axis = 0; axis < 3; axis++)
            object->shape.parametric.functions[axis] = emit_function(e, node->functions[axis]);
    else if (object->type == OBJECT_BLOB)
        emit_blob(e, node, bare, &object->shape.blob);
}
