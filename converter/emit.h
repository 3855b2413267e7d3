// SPDX-License-Identifier: MIT
// What emit.c and its parts, emit_*.c, share: the pools of the scene while they grow.
#ifndef CONVERTER_EMIT_H
#define CONVERTER_EMIT_H

#include "base/hash.h"
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

// emit_instance.c: a declared tree that copies show, by the list of its children.
typedef struct Shared Shared;

typedef struct {
    Converter *cv;
    Scene *scene;
    bool quiet; // gaps are not said; the first one is kept
    const char *gap;
    Said *said[SAID_BUCKETS];
    ARRAY(Object) objects;
    ARRAY(uint32_t) roots;
    ARRAY(Light) lights;
    ARRAY(uint32_t) projections;
    uint32_t group_count; // of light_groups
    uint64_t frame_count; // what POV-Ray has at the top: objects and lights
    ARRAY(Picture) pictures;
    ARRAY(DensityFile) densities;
    ARRAY(Pigment) pigments;
    ARRAY(Normal) normals;
    ARRAY(Function) functions;
    uint32_t *function_index; // emit_function.c
    ARRAY(Texture) textures;
    ARRAY(Interior) interiors;
    InternTable pigment_table, normal_table, texture_table;
    NodeTable pigment_nodes;
    NodeTable normal_nodes[2], texture_nodes[2]; // without and with no_bump_scale from outside
    ARRAY(Mesh) meshes;
    ARRAY(HeightMap) height_maps;
    NodeTable mesh_nodes, map_nodes;
    ARRAY(uint32_t) definitions;
    NodeTable shared_nodes; // numbers of `shared`
    ARRAY(Shared *) shared;
} Emitter;

// requires.c: adds to cv->missing.
void requires_add(Converter *cv, const Loc *loc, const char *text);
// A part of the scene that the text asks about: the object as the only root (none if nothing of it
// is modelled), or the pigment, whose index is stored. *gap: the first thing that is not modelled
// in it, or NULL.
const Scene *emit_part(Converter *cv, const ObjectNode *object, const PatternNode *pigment,
                       uint32_t *index, const char **gap);
// Warns once a place and text.
void emit_gap(Emitter *e, const Loc *loc, const char *text);
void emit_gaps(Emitter *e, const Gap *gaps); // in the order in which they were noted

// ---- emit_object.c -----------------------------------------------------------------------------

// All that stands at top level.
void emit_roots(Emitter *e);
// Is there anything of the object that the scene can hold? An intersection needs all that bounds
// it.
bool object_is_there(const ObjectNode *object);
// Stores an object of which only the shape counts; NO_INDEX: there is nothing.
uint32_t emit_body(Emitter *e, const ObjectNode *object);
// The same, among the objects that are not in the picture: its place in scene->projections.
uint32_t emit_hidden(Emitter *e, const ObjectNode *object);

// ---- emit_pool.c -------------------------------------------------------------------------------

// Hashes (base/hash.h) go over members, not structs, since the bytes between members may be
// anything. The number of the record of that hash for which same(e, number, record) holds. If there
// is none it is the next number, and the record is to be added to the pool.
typedef bool PoolSame(const Emitter *e, uint32_t index, const void *record);
uint32_t pool_keep(Emitter *e, InternTable *table, uint64_t hash, const void *record,
                   PoolSame *same);
bool node_find(const NodeTable *table, const void *node, uint32_t *index);
void node_put(Emitter *e, NodeTable *table, const void *node, uint32_t index);

// ---- emit_pigment.c, emit_normal.c, emit_texture.c ----------------------------------------------

// Where `at` falls in the map: the entry at or above it and the one below.
void map_bracket(const MapNode *map, float at, uint32_t *below, uint32_t *above);

// Can the scene hold it?
bool pattern_is_modelled(const PatternNode *pattern);
// The pattern and its warps as the scene has them; only its warps.
void emit_pattern(Emitter *e, const PatternNode *node, Pattern *pattern);
void emit_warps(Emitter *e, const PatternNode *node, Pattern *pattern);
uint64_t pattern_hash(uint64_t hash, const Pattern *pattern);

// emit_solid.c: fills what the object keeps in the pools of the scene. bare: without textures.
void emit_solid(Emitter *e, const ObjectNode *node, bool bare, Object *object);
// emit_cut.c: says what cutaway_textures in the tree may lack.
void emit_cut_gap(Emitter *e, const ObjectNode *tree);
uint32_t emit_pigment(Emitter *e, const PatternNode *pigment);
// Into the pool, unless it is there; the number.
uint32_t store_pigment(Emitter *e, const Pigment *pigment);
uint32_t store_normal(Emitter *e, const Normal *normal);
uint32_t store_texture(Emitter *e, const Texture *texture);
// emit_moved.c: the texture as it is when the object that has it is moved; itself if that is the
// same.
uint32_t emit_texture_moved(Emitter *e, uint32_t texture, const Transform *move);
// A missing normal (NULL) bends nothing. no_bump_scale: the texture around has it.
uint32_t emit_normal(Emitter *e, const PatternNode *normal, bool no_bump_scale);
uint32_t emit_texture(Emitter *e, const TextureNode *texture);
// The function's number in scene->functions, for a pattern or a surface that uses it.
uint32_t emit_function(Emitter *e, const UserFunction *function);

// ---- emit_instance.c ---------------------------------------------------------------------------

// Copies of a tree that are held once: counted first, over everything that stands at top level.
void instance_count(Emitter *e, const ObjectNode *root);

// What the children of a copy have from around it, as far as it may differ between copies.
typedef struct {
    bool no_shadow, no_image, no_reflection, hollow, double_set, double_illuminate;
    bool no_global_lights;
    uint32_t light_group;
} InstanceFlags;

// A tree of a copy that has been stored as a definition.
typedef struct {
    InstanceFlags flags;
    bool no_split;
    uint32_t definition;
    uint32_t *textures; // of its leaves, ascending
    uint32_t texture_count;
    uint32_t *interiors;
    uint32_t interior_count;
} Definition;

// Is the copy worth it, and can it be exact? *move: where it stands.
Shared *instance_find(Emitter *e, const ObjectNode *node, Transform *move);
const Definition *instance_definition(const Shared *shared, const ObjectNode *node,
                                      const InstanceFlags *flags);
// Keeps a new one: root, and all objects stored from `first` on, are its tree. NULL: no instance
// can show it; its objects are gone.
const Definition *instance_define(Emitter *e, Shared *shared, const ObjectNode *node,
                                  const InstanceFlags *flags, uint32_t root, uint32_t first);
// The instance: object needs only its own texture and interior besides. False: it cannot be.
bool instance_fill(Emitter *e, const Definition *definition, const Transform *move, Object *object);

#endif
