// SPDX-License-Identifier: MIT
// Which textures a hit shows: those of the object, or of its parts (components of a blob, faces of
// a mesh), which POV-Ray shades one by one and mixes by their weights.
#include "render/shading.h"

static uint32_t surface_texture(const Object *object, double normal_dot_dir) {
    bool inside = normal_dot_dir > 0.0 && object->interior_texture != NO_INDEX;
    return inside ? object->interior_texture : object->texture;
}

uint32_t surface_textures(const Object *object, const WorldHit *hit, double normal_dot_dir,
                          ShapeTexture out[SHAPE_MAX_TEXTURES]) {
    bool inside = normal_dot_dir > 0.0 && object->interior_texture != NO_INDEX;
    if (inside || hit->texture_count == 0) {
        out[0] = (ShapeTexture){surface_texture(object, normal_dot_dir), 1.0f};
        return 1;
    }
    for (uint32_t i = 0; i < hit->texture_count; i++) {
        out[i] = hit->textures[i];
        if (out[i].texture == NO_INDEX)
            out[i].texture = object->texture;
    }
    return hit->texture_count;
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
