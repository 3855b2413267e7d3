// SPDX-License-Identifier: MIT
// What emit.c and emit_texture.c share: the pools of the scene while they grow.
#ifndef CONVERTER_EMIT_H
#define CONVERTER_EMIT_H

#include "converter/nodes.h"

// Equal records are stored once: hashes of what is in a pool, with their indices.
typedef struct {
    struct InternEntry {
        uint64_t hash;
        uint32_t index; // NO_INDEX: free
    } * entries;
    size_t count, capacity;
} InternTable;

// The same for nodes, by address.
typedef struct {
    struct NodeEntry {
        const void *node;
        uint32_t index;
    } * entries;
    size_t count, capacity;
} NodeTable;

typedef struct Said {
    struct Said *next;
    const Loc *loc;
    const char *text;
} Said;

enum { SAID_BUCKETS = 256 };

typedef struct {
    Converter *cv;
    Scene *scene;
    Said *said[SAID_BUCKETS];
    ARRAY(Object) objects;
    ARRAY(uint32_t) roots;
    ARRAY(Light) lights;
    ARRAY(Pigment) pigments;
    ARRAY(Texture) textures;
    ARRAY(Interior) interiors;
    InternTable pigment_table, texture_table;
    NodeTable pigment_nodes, texture_nodes;
} Emitter;

// requires.c: adds to cv->missing.
void requires_add(Converter *cv, const Loc *loc, const char *text);
// Warns once a place and text.
void emit_gap(Emitter *e, const Loc *loc, const char *text);
void emit_gaps(Emitter *e, const Gap *gaps); // in the order in which they were noted

uint32_t emit_pigment(Emitter *e, const PatternNode *pigment);
uint32_t emit_texture(Emitter *e, const TextureNode *texture);

#endif
