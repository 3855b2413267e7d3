// SPDX-License-Identifier: MIT
// cutaway_textures of more textures than a hit has room for.
#include "converter/emit.h"

// The different textures in the tree, counted until there are more than a hit shows.
typedef struct {
    const TextureNode *seen[HIT_MAX_TEXTURES];
    uint32_t count;
} CutTextures;

static void collect(const ObjectNode *node, CutTextures *all) {
    uint32_t i = 0;
    while (i < all->count && all->seen[i] != node->texture)
        i++;
    if (node->texture && i == all->count) {
        if (i < HIT_MAX_TEXTURES)
            all->seen[i] = node->texture;
        all->count++;
    }
    for (const ObjectNode *child = node->first; child && all->count <= HIT_MAX_TEXTURES;
         child = child->next)
        collect(child, all);
}

static const Loc *find_cutaway(const ObjectNode *node) {
    const Loc *found = node->cutaway;
    for (const ObjectNode *child = node->first; child && !found; child = child->next)
        found = find_cutaway(child);
    return found;
}

void emit_cut_gap(Emitter *e, const ObjectNode *tree) {
    const Loc *place = find_cutaway(tree);
    if (!place)
        return;
    CutTextures all = {.count = 0};
    collect(tree, &all);
    if (all.count > HIT_MAX_TEXTURES)
        emit_gap(e, place,
                 arena_printf(e->cv->arena,
                              "cutaway_textures among so many textures: where more than %d of them "
                              "meet only those are shown, and it is darker",
                              HIT_MAX_TEXTURES));
}
