// SPDX-License-Identifier: MIT
// Objects and pigments that the text asks about while it is read: each becomes a small scene once,
// when it is first asked about, and is kept by the address of its node, since nodes do not change.
// The kind of noise may: with another one it becomes another scene.
#include "converter/probing.h"

#include "converter/emit.h"
#include "converter/language.h"

#include <stdint.h>

struct ProbeEntry {
    const void *node; // NULL: free
    int noise_generator;
    Probe *probe;    // NULL: not possible
    const char *gap; // why not, or NULL
    uint32_t pigment;
};

static size_t slot_of(const ProbeTable *table, const void *node, int noise) {
    size_t slot = ((uintptr_t)node >> 4) * 0x9E3779B97F4A7C15u >> 20 & (table->capacity - 1);
    while (table->entries[slot].node &&
           (table->entries[slot].node != node || table->entries[slot].noise_generator != noise))
        slot = (slot + 1) & (table->capacity - 1);
    return slot;
}

static void grow(Converter *cv, ProbeTable *table) {
    ProbeTable grown = {.capacity = table->capacity ? 2 * table->capacity : 16,
                        .count = table->count};
    grown.entries = ARENA_ARRAY(cv->arena, ProbeEntry, grown.capacity);
    for (size_t i = 0; i < table->capacity; i++)
        if (table->entries[i].node)
            grown.entries[slot_of(&grown, table->entries[i].node,
                                  table->entries[i].noise_generator)] = table->entries[i];
    *table = grown;
}

// The place of the node in the table; *made: it is new.
static ProbeEntry *entry_of(Converter *cv, const void *node, bool *made) {
    ProbeTable *table = &cv->language->probes;
    if (2 * (table->count + 1) > table->capacity)
        grow(cv, table);
    ProbeEntry *entry = &table->entries[slot_of(table, node, cv->noise_generator)];
    *made = !entry->node;
    entry->noise_generator = cv->noise_generator;
    if (*made)
        table->count++;
    entry->node = node;
    return entry;
}

// What the text asks about may take long to prepare, and much room: patches become triangles.
static Probe *make_probe(Converter *cv, const Scene *scene) {
    check_limits(cv, UINT64_MAX);
    Probe *probe = probe_create(scene);
    cv->language->probe_bytes += (size_t)probe_memory(probe);
    return probe;
}

const Probe *probing_object(Converter *cv, const ObjectNode *object, const char **gap) {
    bool made;
    ProbeEntry *entry = entry_of(cv, object, &made);
    if (made) {
        const Scene *scene = emit_part(cv, object, NULL, NULL, &entry->gap);
        if (scene->root_count > 0)
            entry->probe = make_probe(cv, scene);
    }
    *gap = entry->gap;
    return entry->probe;
}

const Probe *probing_pigment(Converter *cv, const PatternNode *pigment, uint32_t *index,
                             const char **gap) {
    bool made;
    ProbeEntry *entry = entry_of(cv, pigment, &made);
    if (made) {
        const Scene *scene = emit_part(cv, NULL, pigment, &entry->pigment, &entry->gap);
        if (!entry->gap)
            entry->probe = make_probe(cv, scene);
    }
    *gap = entry->gap;
    *index = entry->pigment;
    return entry->probe;
}

void probing_end(Converter *cv) {
    ProbeTable *table = &cv->language->probes;
    for (size_t i = 0; i < table->capacity; i++)
        probe_destroy(table->entries[i].probe);
    *table = (ProbeTable){0};
}
