// SPDX-License-Identifier: MIT
// Normals on their way into the pool of the scene (facts: textures 5). no_bump_scale comes down
// from the texture and from normals that mix others.
#include "converter/emit.h"

// What stands for a normal that is not modelled, or for one that is missing in a list.
static Normal flat_normal(void) {
    Normal flat = normal_default();
    flat.pattern.type = PATTERN_BUMPS;
    flat.amount = 0;
    return flat;
}

static void copy_slopes(Emitter *e, const MapNode *map, Normal *normal) {
    normal->slopes = ARENA_ARRAY(e->cv->arena, SlopeEntry, map->count);
    normal->slope_count = map->count;
    for (uint32_t i = 0; i < map->count; i++) {
        const MapItem *item = &map->items[i];
        normal->slopes[i] = (SlopeEntry){item->value, item->slope.u, item->slope.v};
    }
}

static void copy_entries(Emitter *e, const MapNode *map, Normal *normal) {
    normal->entries = ARENA_ARRAY(e->cv->arena, IndexEntry, map->count);
    normal->entry_count = map->count;
    for (uint32_t i = 0; i < map->count; i++) {
        uint32_t index = emit_normal(e, map->items[i].node, normal->no_bump_scale);
        normal->entries[i] = (IndexEntry){map->items[i].value, index};
    }
}

// Patterns that bend in ways of their own have no use for a slope_map.
static bool uses_slopes(PatternType type) {
    switch (type) {
    case PATTERN_AVERAGE:
    case PATTERN_BUMPS:
    case PATTERN_BUMP_MAP:
    case PATTERN_DENTS:
    case PATTERN_FACETS:
    case PATTERN_QUILTED:
    case PATTERN_RIPPLES:
    case PATTERN_WAVES:
    case PATTERN_WRINKLES:
        return false;
    default:
        return true;
    }
}

static Normal build_normal(Emitter *e, const PatternNode *node, bool no_bump_scale) {
    Normal normal = normal_default();
    if (!pattern_is_modelled(node)) {
        emit_gap(e, node->loc,
                 arena_printf(e->cv->arena,
                              "a normal with '%s' is not modelled: the surface is smooth",
                              keyword_name(node->info->keyword)));
        return flat_normal();
    }
    emit_pattern(e, node, &normal.pattern);
    if (node->info->keyword == KW_bumps)
        normal.pattern.type = PATTERN_BUMPS;
    normal.amount = node->amount;
    normal.accuracy = node->accuracy;
    normal.no_bump_scale = no_bump_scale || node->no_bump_scale;
    if (node->map && node->map->kind == MAP_NORMAL)
        copy_entries(e, node->map, &normal);
    else if (node->map && node->map->kind == MAP_SLOPE && uses_slopes(normal.pattern.type))
        copy_slopes(e, node->map, &normal);
    return normal;
}

static bool same_normal(const Emitter *e, uint32_t index, const void *record) {
    return normal_equal(&e->normals.items[index], record);
}

uint32_t store_normal(Emitter *e, const Normal *normal) {
    uint64_t hash = pattern_hash(HASH_START, &normal->pattern);
    hash = hash_bytes(hash, &normal->amount, sizeof normal->amount);
    hash = hash_bytes(hash, normal->entries, normal->entry_count * sizeof *normal->entries);
    uint32_t index = pool_keep(e, &e->normal_table, hash, normal, same_normal);
    if (index == e->normals.count)
        array_push(&e->normals, *normal);
    return index;
}

uint32_t emit_normal(Emitter *e, const PatternNode *node, bool no_bump_scale) {
    NodeTable *known = &e->normal_nodes[no_bump_scale];
    Normal normal = flat_normal();
    uint32_t index;
    if (!node)
        return store_normal(e, &normal);
    if (node_find(known, node, &index))
        return index;
    enter_level(e->cv);
    const PatternNode *inner = node;
    bool uv = false, flag = no_bump_scale;
    for (; inner->info->keyword == KW_uv_mapping; inner = inner->map->items[0].node) {
        uv = true;
        flag = flag || inner->no_bump_scale;
    }
    // In a declaration or a default the pattern may still come; on an object it must be there.
    if (inner->info->keyword == 0)
        die_at(inner->block_loc, "No normal type given: a normal needs a pattern");
    normal = build_normal(e, inner, flag);
    normal.uv_mapping = uv;
    index = store_normal(e, &normal);
    leave_level(e->cv);
    node_put(e, known, node, index);
    return index;
}
