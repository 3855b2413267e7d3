// SPDX-License-Identifier: MIT
// What the statements become on their way from the text to the Scene: nodes that keep POV-Ray's
// order-dependent rules (layers, inheritance, transforms of textures) until the scene is complete.
//
// A node in a Value is never changed: whoever edits one edits a copy. Pattern, texture, finish and
// interior nodes are small and copied at every edit; objects are copied lazily (object_copy).
// What the scene model cannot hold is noted with its place (Gap, loc) and is only warned of when
// emit.c meets it in the final scene, once a place.
#ifndef CONVERTER_NODES_H
#define CONVERTER_NODES_H

#include "converter/converter.h"
#include "model/scene.h"

typedef struct Gap {
    const struct Gap *next; // the one noted before
    const Loc *loc;
    const char *text; // "fog is left out: ..."
} Gap;

// The place of a token, kept.
const Loc *keep_place(Converter *cv, const Token *token);
// Puts a gap in front of *list. text is kept as it is. It names the keyword that is left out, in
// quotes or as its first word, and behind a ':' what the picture lacks.
void note_gap(Converter *cv, const Gap **list, const Token *token, const char *text);

// F, which must lie from low to high (in whole numbers: up to anything below high + 1).
double number_within(Converter *cv, const char *what, double low, double high);

// ---- transforms: transform.c -------------------------------------------------------------------

// ORDER move: how a shape takes a transform depends on how it was written.
typedef enum { MOVE_TRANSLATE, MOVE_ROTATE, MOVE_SCALE, MOVE_MATRIX } MoveKind;

struct TextureNode;
enum { MOVE_CACHE = 32 };

// One transform statement. The cache keeps textures that many objects of a union share shared.
typedef struct Move {
    MoveKind kind;
    Vec3 v; // as written; MOVE_MATRIX: unused
    Transform t;
    struct {
        const struct TextureNode *from, *to;
    } cache[MOVE_CACHE];
    struct Move *kept; // the same in the arena, for trees that take it later; NULL: none yet
} Move;

// A transform that the children of a tree are still to take.
typedef struct LateMove {
    const struct LateMove *before; // the one written before
    Move *move;
} LateMove;

// translate, rotate, scale, matrix, transform: if the next token is one, consumes the statement.
bool parse_move(Converter *cv, Move *move);
// After the keyword `transform`: an identifier or a block.
Transform parse_transform(Converter *cv);

// ---- patterns: pattern.c, pattern_args.c, warp.c, map.c, image.c -----------------------------

// In which kind of block a pattern stands.
typedef enum { USE_PIGMENT, USE_NORMAL, USE_TEXTURE, USE_DENSITY } PatternUse;

typedef struct WarpNode {
    const struct WarpNode *next; // the one written before
    Warp warp;
} WarpNode;

typedef enum { MAP_COLOR, MAP_SLOPE, MAP_PIGMENT, MAP_NORMAL, MAP_TEXTURE, MAP_DENSITY } MapKind;

typedef struct {
    float value; // position, or weight in `average`
    Color color; // MAP_COLOR
    Vec2 slope;  // MAP_SLOPE: height, slope
    const void *node;
} MapItem;

// Also the lists of checker and its like: positions 0, 1, 2 ...
typedef struct {
    MapKind kind;
    const MapItem *items;
    uint32_t count;
    int depth; // of maps inside one another
} MapNode;

// What is known of a pattern keyword before its arguments.
typedef struct {
    int keyword;      // 0: no pattern, KW_color: one colour
    PatternType type; // PATTERN_MODELLED: parsed, but not modelled
    bool triangle;    // sets triangle_wave
    bool still;       // sets frequency 0
    int list;         // takes up to so many items instead of a map
} PatternInfo;

// A pigment, a normal, a density, or the pattern of a texture.
typedef struct PatternNode {
    const PatternInfo *info;
    const Loc *loc; // of the keyword, if the pattern is not modelled
    Pattern shape;  // all but the type and the warps
    const WarpNode *warps;
    const MapNode *map;     // NULL: the default one. uv_mapping: one item, the rest of the block
    const Picture *picture; // of the patterns that have one
    const UserFunction *function;      // function
    const struct PatternNode *pigment; // pigment_pattern
    const struct ObjectNode *object;   // object
    const char *density;               // density_file: its path
    Color color;                       // one colour
    bool has_quick_color;
    Color quick_color;
    int pavement[3];        // sides, tiles, number of the pattern
    float amount, accuracy; // normal: depth, and how far the pattern is looked at around the point
    bool no_bump_scale;     // normal, texture
    const Loc *block_loc;   // normal: of its block
} PatternNode;

const PatternInfo *pattern_find(int keyword);
PatternNode pattern_node_default(void);
void pattern_move(Converter *cv, PatternNode *pattern, const Transform *transform);
// turbulence, octaves, omega, lambda: if the next token is one, reads it.
bool parse_turbulence(Converter *cv, PatternNode *pattern);
void parse_warp(Converter *cv, PatternNode *pattern); // the block behind the keyword
// The contents of a block: [pattern] modifiers, on top of what *pattern holds. Identifiers are the
// caller's. `texture_map` and its like are read by the functions of texture.c.
void parse_pattern(Converter *cv, PatternUse use, PatternNode *pattern);
// Its first item alone: a colour, or a pattern with what stands right behind it. False: there is
// none, *pattern stays as it is.
bool parse_pattern_start(Converter *cv, PatternUse use, PatternNode *pattern);
void parse_quick_color(Converter *cv, PatternNode *pattern); // behind the keyword
// pattern_fit.c: dies if the next token is a modifier that this pattern does not take.
void check_modifier_fits(Converter *cv, const PatternInfo *info);
void parse_pavement_number(Converter *cv, PatternNode *pattern, int keyword); // behind the word
void check_pavement(const PatternNode *pattern); // at its end: is there such a pattern?
// Reads the arguments that stand right behind the pattern's keyword (and list items).
void parse_pattern_arguments(Converter *cv, PatternUse use, PatternNode *pattern);
// The keyword of a map (color_map ...) at the cursor: its kind; false: there is none.
bool map_keyword(int code, MapKind *kind);
// From the '{' to the '}' of a map. `average`: positions are weights and may be missing.
const MapNode *parse_map(Converter *cv, MapKind kind, bool average);
const MapNode *parse_pattern_list(Converter *cv, PatternUse use, const PatternInfo *info);
const MapNode *map_create(Converter *cv, MapKind kind, const MapItem *items, uint32_t count);
const MapNode *map_default(Converter *cv, const PatternInfo *info);
// The block of image_map, bump_map, image_pattern; what height_field and material_map begin with.
// amount: what bump_size sets.
const Picture *parse_image_block(Converter *cv, int keyword, float *amount);
// to_working: its colours are meant, not numbers. refused: the type that may not stand here.
void parse_image(Converter *cv, Picture *picture, bool to_working, PictureType refused);
// image_function.c: after the keyword `function`. smallest: of the sides, 0 or 1.
void parse_image_function(Converter *cv, Picture *picture, int smallest);
// block: the keyword of what they stand in. amount: needed by a bump_map.
void parse_image_options(Converter *cv, Picture *picture, int block, float *amount);
// palette.c: the colours that the palette of the picture has, 0 without one; dies when the file is
// broken. modelled: the renderer can make single ones of them clear.
typedef struct {
    int size;
    bool modelled;
} ImagePalette;
ImagePalette image_palette(const Picture *picture);

// ---- textures: texture.c, finish.c, interior.c -----------------------------------------------

typedef struct {
    Finish finish;
    float ior, caustics; // old places of the interior's values; < 0: not given. POV-Ray takes these
                         // caustics as they are, not 45 times as an interior's
    float refraction;    // 1: none
    const Gap *gaps;
} FinishNode;

typedef struct TextureNode {
    PatternNode pattern;        // plain unless info->keyword is a pattern's
    const PatternNode *pigment; // plain
    const PatternNode *normal;  // plain; NULL: none
    const FinishNode *finish;   // plain
    bool no_bump_scale;
    const struct TextureNode *below; // the next layer
} TextureNode;

typedef struct {
    Interior interior;
    bool bends; // an ior was written, and not 0: without one POV-Ray has no dispersion either
    const Gap *gaps;
} InteriorNode;

typedef struct {
    const TextureNode *texture, *interior_texture;
    const InteriorNode *interior;
} MaterialNode;

typedef struct {
    const Loc *loc;
} MediaNode;

bool texture_is_plain(const TextureNode *texture);
// Bodies are what stands between the braces; blocks include them. base: what is edited.
const PatternNode *parse_pigment_body(Converter *cv, const PatternNode *base);
const PatternNode *parse_normal_body(Converter *cv, const PatternNode *base); // base may be NULL
const PatternNode *parse_density_body(Converter *cv, const PatternNode *base);
const TextureNode *parse_texture_body(Converter *cv);
const PatternNode *parse_pigment_block(Converter *cv, const PatternNode *base);
const PatternNode *parse_normal_block(Converter *cv, const PatternNode *base);
const TextureNode *parse_texture_block(Converter *cv);
// texture_old.c: the items of a texture before version 3.0, on top of a plain one.
const TextureNode *parse_old_items(Converter *cv, const TextureNode *texture);
const FinishNode *parse_finish_block(Converter *cv, const FinishNode *base);
const InteriorNode *parse_interior_block(Converter *cv, const InteriorNode *base);
void parse_material_block(Converter *cv, MaterialNode *material);
const MediaNode *parse_media_block(Converter *cv);
const PatternNode *parse_density_block(Converter *cv);
// pigment{}, normal{}, finish{} of an object: if the next token is one, edits the top layer.
bool parse_partial_texture(Converter *cv, const TextureNode **texture);
// Puts `top` over `below` (may be NULL). Dies at token if one of them is patterned.
const TextureNode *texture_layer(Converter *cv, const TextureNode *top, const TextureNode *below,
                                 const Token *token);
const TextureNode *texture_moved(Converter *cv, const TextureNode *texture, Move *move);

// What the numbers of radiosity{} are checked for. Index 0: start, minimum_reuse.
typedef struct {
    double pretrace[2], reuse[2];
    bool given[2]; // of reuse
} RadiosityLimits;

// ---- lights, camera, surroundings: light.c, camera.c, atmosphere.c, settings.c ---------------

typedef struct ObjectNode ObjectNode;

typedef struct {
    Light light;
    bool directed; // spotlight, cylinder or parallel was written: point_at may follow
    bool parallel; // `parallel` was written
    bool no_interaction, attenuation; // media_interaction off, media_attenuation
    ObjectNode *looks_like, *projected_through;
    const Gap *gaps;
} LightNode;

typedef struct {
    Camera camera; // its vectors are final
    Vec3 sky, look_at;
    bool has_look_at;
    const PatternNode *normal;
    bool has_focus; // camera.blur.focal_distance is known
    const Gap *gaps;
} CameraNode;

typedef struct PigmentList {
    const struct PigmentList *next; // the one below
    const PatternNode *pigment;
} PigmentList;

typedef struct {
    const PigmentList *top;
    Rgb emission;
    Transform transform;
} SkySphereNode;

// All that were written, the last first.
typedef struct FogNode {
    const struct FogNode *next;
    Fog fog; // distance 0: it does nothing
} FogNode;

typedef struct RainbowNode {
    const struct RainbowNode *next;
    Rainbow rainbow;            // all but the pigment
    const PatternNode *pigment; // NULL: no color_map, it does nothing
} RainbowNode;

CameraNode *parse_camera_block(Converter *cv);
const SkySphereNode *parse_sky_sphere_block(Converter *cv);
FogNode *parse_fog_block(Converter *cv);
RainbowNode *parse_rainbow_block(Converter *cv);
void parse_global_settings(Converter *cv);
// A setting that is one number: if token, the next one, names it.
bool parse_number_setting(Converter *cv, const Token *token);
void parse_light_data(Converter *cv, ObjectNode *object);
void parse_light_items(Converter *cv, ObjectNode *object);
void light_move(LightNode *light, const Move *move);
// What the light is when all of it has been read.
Light light_finished(const LightNode *node);

// ---- objects: object.c, shapes.c, patch.c, shapes_other.c, csg.c, modifiers.c, extent.c ------

// `object` carries the shape, the transform and the flags in the scene's own form; its texture,
// interior and children are filled by emit.c.
struct ObjectNode {
    ObjectNode *next; // in the list of the parent
    int keyword;      // of the statement: KW_sphere, KW_union, ...
    bool modelled;
    bool surface; // POV-Ray's patch objects: they have no inside
    Object object;
    const TextureNode *texture, *interior_texture;
    const InteriorNode *interior;
    bool hollow_set, double_set;
    bool shared; // children, points and light belong to another node too: copy before a change
    const LateMove *late;     // of a shared tree: its children have not taken these yet
    bool lit;                 // a light is below
    int depth;                // of the tree below
    uint64_t below;           // objects in the tree below, all copies counted
    ObjectNode *first, *last; // children
    ObjectNode *bounds, *clips;
    const Loc *bound_loc, *clip_loc;
    const Loc *cutaway; // of cutaway_textures
    // What POV-Ray takes for textured, in it or below, and for a difference: it forgets both of a
    // CSG that is inverted.
    bool textured, difference;
    bool global_lights; // of a light_group
    // Of the parts of a blob (NULL: it has none of its own), or of a mesh's faces.
    const TextureNode **textures;
    uint32_t texture_count;
    bool has_textures;
    const Mesh *mesh; // copies of an object have the same one
    const HeightMap *map;
    const UserFunction *functions[3]; // of an isosurface (one) or a parametric
    bool ignored;                     // POV-Ray leaves it out
    Box box;                          // of a CSG, as extent.c keeps it
    bool has_box;
    bool ended;    // the statement that made it; what follows are modifiers of object { }
    bool boxed;    // a leaf: bounds and clips stand around its box, as extent.c takes them
    bool clip_box; // a plane or poly that was moved with its clips: it has the first one's box
    bool flipped;  // a CSG: inverted an odd number of times
    bool no_split; // a union or merge: split_union off
    LightNode *light;
    const Loc *loc; // of the statement, if it is not modelled
    const Gap *gaps;
};

// The next tokens as an object (statement or name), owned by the caller; NULL: there is none.
ObjectNode *parse_object(Converter *cv);
ObjectNode *object_copy(Converter *cv, const ObjectNode *object);
// part is held by parent in any way: dies if the tree becomes too deep or has too many objects.
void object_put_below(Converter *cv, ObjectNode *parent, const ObjectNode *part);
// *count grows by the object and all below it, up to the limit.
void object_count(Converter *cv, uint64_t *count, const ObjectNode *object);
void object_add_child(Converter *cv, ObjectNode *parent, ObjectNode *child);
// Gives the object its own children, points and light before they are changed, and the children
// the transforms that waited.
void object_unshare(Converter *cv, ObjectNode *object);
void object_move(Converter *cv, ObjectNode *object, Move *move);
void object_invert(Converter *cv, ObjectNode *object);
// patch_solid.c, for --patch-solids: a union of patches with an interior; is it closed? Turns it
// inside out; false: it is no solid.
bool patch_solid_is_meant(const Converter *cv, const ObjectNode *object);
bool patch_solid_is_closed(const ObjectNode *object);
bool patch_solid_invert(const Converter *cv, ObjectNode *object);
bool parse_photons_modifier(Converter *cv); // photons { ... } of an object or a light
void parse_importance_block(Converter *cv); // radiosity { ... } of an object or of #default
// All modifiers; dies if a rule that holds at the end is broken.
void parse_object_modifiers(Converter *cv, ObjectNode *object);

// Data behind '{': one function a statement; they leave the cursor at the first modifier.
typedef void ParseShape(Converter *cv, ObjectNode *object);
ParseShape *shape_parser(int keyword);       // shapes.c, patch.c; NULL: not one of theirs
ParseShape *shape_other_parser(int keyword); // shapes_other.c
ParseShape *solid_parser(int keyword);       // solid.c and the files named like their statements
ParseShape parse_patch_data, parse_mesh, parse_mesh2, parse_height_field, parse_text,
    parse_isosurface, parse_parametric;
// For those: n numbers; a count of at least so many points and the comma behind it.
void read_floats(Converter *cv, double *out, uint32_t count);
uint32_t read_count(Converter *cv, const char *what, int least);
bool solid_is_finite(const Object *object);
Box solid_extent(const ObjectNode *node);
// The same in the world, of those that POV-Ray moves point by point.
bool moved_extent(const Object *object, Box *out); // extent_solid.c
// The rotation that takes the z axis to the unit vector axis, about an axis in the plane z = 0.
Transform axis_rotation(Vec3 axis);
bool shape_is_finite(const Object *object); // are the numbers that were read finite?
void shape_move(ObjectNode *object, const Move *move);
bool keyword_is_csg(int keyword);
void parse_csg_data(Converter *cv, ObjectNode *object);

// The axis-aligned box as POV-Ray keeps it, in single precision; false: the object is not modelled.
bool node_extent(const ObjectNode *object, Box *out);
// Rays that miss the box miss the object in POV-Ray: may it be smaller than the object?
bool node_extent_cuts(const ObjectNode *object);
// The kept box of a CSG: from its children, after a transform.
void csg_box_begin(ObjectNode *object);
void extent_begin(ObjectNode *object); // of meshes and quadrics
void extent_move(ObjectNode *object, const Move *move);
void extent_bound(ObjectNode *object); // of any object, at the end of its modifiers

// ---- the whole: statement.c, emit.c ----------------------------------------------------------

typedef struct RootNode {
    struct RootNode *next;
    ObjectNode *object;
    const TextureNode *default_texture; // in force at the end of the statement
} RootNode;

struct Nodes {
    const TextureNode *default_texture;
    RadiosityLimits radiosity;
    bool in_default; // the block of #default is being read
    CameraNode default_camera;
    CameraNode *camera;       // the last one; NULL: none yet
    CameraNode *first_camera; // the one that is meant with RenderOptions.clockless
    RootNode *first, *last;
    uint64_t object_count; // all copies counted
    const SkySphereNode *sky_sphere;
    const FogNode *fogs;
    const RainbowNode *rainbows;
    Settings settings; // version, noise and gamma are filled by emit.c
    const Gap *gaps;   // fog, radiosity, ...
};

// Creates cv->nodes with POV-Ray's defaults.
void nodes_begin(Converter *cv);

#endif
