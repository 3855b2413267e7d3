// SPDX-License-Identifier: MIT
// Which textures a hit shows: those of the object, or of its parts (components of a blob, faces of
// a mesh), which POV-Ray shades one by one and mixes by their weights.
#include "render/shading.h"

void hit_find_other_textures(const Scene *scene, WorldHit *hit, double normal_dot_dir) {
    const Object *object = &scene->objects[hit->object];
    bool inside = normal_dot_dir > 0.0 && object->interior_texture != NO_INDEX;
    if (inside || hit->texture_count == 0) {
        hit->textures[0] = (ShapeTexture){hit_own_texture(object, normal_dot_dir), 1.0f};
        hit->texture_count = 1;
    }
    for (uint32_t i = 0; i < hit->texture_count; i++) {
        uint32_t *texture = &hit->textures[i].texture;
        if (*texture == NO_INDEX)
            *texture = object->texture;
        if (hit->instance != NO_INDEX)
            *texture = instance_texture(&scene->objects[hit->instance], *texture);
    }
}

// Textures of parts, and those in a map, are taken to be.
static bool texture_is_lit(const Scene *scene, uint32_t index) {
    if (index == NO_INDEX)
        return false;
    const Texture *texture = &scene->textures[index];
    for (uint32_t i = 0; i < texture->layer_count; i++)
        if (finish_is_lit(&texture->layers[i].finish))
            return true;
    return texture->layer_count == 0;
}

bool surface_is_lit(const Scene *scene, const Object *object) {
    bool parts = object->type == OBJECT_MESH || object->type == OBJECT_BLOB || object->cutaway;
    return parts || texture_is_lit(scene, object->texture) ||
           texture_is_lit(scene, object->interior_texture);
}

bool surface_mirrors(const Scene *scene, const Object *object) {
    if (object->texture == NO_INDEX)
        return false;
    const Texture *texture = &scene->textures[object->texture];
    for (uint32_t i = 0; i < texture->layer_count; i++)
        if (texture->layers[i].normal == NO_INDEX && finish_reflects(&texture->layers[i].finish))
            return true;
    return false;
}

bool surface_is_opaque(const Textures *textures, const Object *object) {
    bool opaque = texture_is_opaque(textures, object->texture) &&
                  (object->interior_texture == NO_INDEX ||
                   texture_is_opaque(textures, object->interior_texture));
    if (object->type == OBJECT_MESH)
        for (uint32_t i = 0; opaque && i < object->shape.mesh.texture_count; i++)
            opaque = texture_is_opaque(textures, object->shape.mesh.textures[i]);
    if (object->type == OBJECT_BLOB)
        for (uint32_t i = 0; opaque && i < object->shape.blob.count; i++)
            opaque = texture_is_opaque(textures, object->shape.blob.components[i].texture);
    return opaque;
}
