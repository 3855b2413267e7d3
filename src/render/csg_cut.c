// SPDX-License-Identifier: MIT
// cutaway_textures: a surface without a texture, where a body was cut, shows the textures of what
// contains the place (measured on POV-Ray's pictures). All that contain it count alike, whatever
// their own clips say, but of a difference only the first child.
#include "render/csg.h"

typedef struct {
    ShapeTexture *out; // weights count how often
    uint32_t count, total;
} CutList;

static void add_texture(CutList *list, uint32_t texture) {
    if (texture == NO_INDEX)
        return;
    list->total++;
    uint32_t at = 0;
    while (at < list->count && list->out[at].texture != texture)
        at++;
    if (at == SHAPE_MAX_TEXTURES)
        return;
    if (at == list->count)
        list->out[list->count++] = (ShapeTexture){texture, 0.0f};
    list->out[at].weight += 1.0f;
}

// The texture of a leaf; of patches that are one body, that of the first.
static uint32_t first_texture(const Csg *csg, const CsgNode *node) {
    while (node->first != NO_INDEX)
        node = &csg->nodes[node->first];
    return node->object->texture;
}

static void add_tree(const Csg *csg, const CsgNode *tree, Vec3 p, CutList *list) {
    for (uint32_t c = tree->first; c != NO_INDEX; c = csg->nodes[c].next) {
        const CsgNode *child = &csg->nodes[c];
        if (csg_inside_unclipped(csg, c, p)) {
            if (child->shape || child->body)
                add_texture(list, first_texture(csg, child));
            else
                add_tree(csg, child, p, list);
        }
        if (tree->object->difference)
            break;
    }
}

uint32_t csg_cut_textures(const Csg *csg, uint32_t tree, Vec3 p,
                          ShapeTexture out[SHAPE_MAX_TEXTURES]) {
    CutList list = {out, 0, 0};
    add_tree(csg, &csg->nodes[tree], p, &list);
    float share = 1.0f / (float)(list.total > 0 ? list.total : 1);
    for (uint32_t i = 0; i < list.count; i++)
        out[i].weight *= share;
    return list.count;
}

// The outermost that puts its hits on a stack of its own, as POV-Ray does.
uint32_t csg_cut_tree(const Csg *csg, uint32_t leaf) {
    uint32_t tree = NO_INDEX;
    if (leaf == NO_INDEX || !csg->nodes[leaf].object->cutaway)
        return NO_INDEX;
    for (uint32_t t = csg->nodes[leaf].parent; t != NO_INDEX; t = csg->nodes[t].parent)
        if (csg->nodes[t].object->type != OBJECT_UNION || csg->nodes[t].first_clip != NO_INDEX)
            tree = t;
    return tree;
}
