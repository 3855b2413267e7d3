// SPDX-License-Identifier: MIT
// The tables by which equal records and nodes are stored once.
#include "converter/emit.h"

#include <string.h>

static void intern_grow(Emitter *e, InternTable *table) {
    InternTable grown = {.capacity = table->capacity ? 2 * table->capacity : 64,
                         .count = table->count};
    grown.entries = ARENA_ARRAY(e->cv->arena, struct InternEntry, grown.capacity);
    for (size_t i = 0; i < grown.capacity; i++)
        grown.entries[i].index = NO_INDEX;
    for (size_t i = 0; i < table->capacity; i++) {
        if (table->entries[i].index == NO_INDEX)
            continue;
        size_t slot = table->entries[i].hash & (grown.capacity - 1);
        while (grown.entries[slot].index != NO_INDEX)
            slot = (slot + 1) & (grown.capacity - 1);
        grown.entries[slot] = table->entries[i];
    }
    *table = grown;
}

uint32_t pool_keep(Emitter *e, InternTable *table, uint64_t hash, const void *record,
                   PoolSame *same) {
    if (2 * (table->count + 1) > table->capacity)
        intern_grow(e, table);
    size_t mask = table->capacity - 1, at = hash & mask;
    for (; table->entries[at].index != NO_INDEX; at = (at + 1) & mask)
        if (table->entries[at].hash == hash && same(e, table->entries[at].index, record))
            return table->entries[at].index;
    table->entries[at].hash = hash;
    table->entries[at].index = (uint32_t)table->count;
    return (uint32_t)table->count++;
}

static size_t node_slot(const NodeTable *table, const void *node) {
    size_t slot = ((uintptr_t)node >> 6) & (table->capacity - 1);
    while (table->entries[slot].node && table->entries[slot].node != node)
        slot = (slot + 1) & (table->capacity - 1);
    return slot;
}

bool node_find(const NodeTable *table, const void *node, uint32_t *index) {
    if (table->capacity == 0)
        return false;
    size_t slot = node_slot(table, node);
    *index = table->entries[slot].index;
    return table->entries[slot].node != NULL;
}

void node_put(Emitter *e, NodeTable *table, const void *node, uint32_t index) {
    if (2 * (table->count + 1) > table->capacity) {
        NodeTable grown = {.capacity = table->capacity ? 2 * table->capacity : 64,
                           .count = table->count};
        grown.entries = ARENA_ARRAY(e->cv->arena, struct NodeEntry, grown.capacity);
        for (size_t i = 0; i < table->capacity; i++)
            if (table->entries[i].node)
                grown.entries[node_slot(&grown, table->entries[i].node)] = table->entries[i];
        *table = grown;
    }
    table->entries[node_slot(table, node)] = (struct NodeEntry){node, index};
    table->count++;
}
