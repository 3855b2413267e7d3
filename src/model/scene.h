// SPDX-License-Identifier: MIT
// The scene model: the contract between the converter (or a .qi.json file) and the renderer. Plain
// structs in one arena; records refer to records by uint32_t index, NO_INDEX means none.
//
// Everything that POV-Ray's language makes depend on order is already done: transforms are applied,
// textures are inherited from parents and defaults, the camera vectors are final, CSG parents have
// pushed their flags down. Angles in degrees, lengths in scene units, colours in the working space.
#ifndef MODEL_SCENE_H
#define MODEL_SCENE_H

#include "base/arena.h"
#include "base/color.h"
#include "base/vec.h"
#include "model/function.h"
#include "model/solid.h"

#include <stdbool.h>
#include <stdint.h>

#define NO_INDEX UINT32_MAX

// Of unions, maps and the like inside one another: what walks them calls itself. jansson reads 2048
// nested brackets.
enum { SCENE_MAX_DEPTH = 1000 };

// ---- settings -------------------------------------------------------------------------------

// ORDER gamma_mode (names in scene_fields.c)
typedef enum {
    GAMMA_NONE,  // no assumed_gamma and effective version < 3.7: numbers are written unchanged
    GAMMA_POWER, // working space is a power law; assumed_gamma 1.0 is linear
    GAMMA_SRGB,  // assumed_gamma srgb
} GammaMode;

typedef struct {
    int version; // effective language version x 100 (370, 362 when none was ever set)
    GammaMode gamma_mode;
    float assumed_gamma; // with GAMMA_POWER
    Rgb ambient_light;
    int max_trace_level;
    float adc_bailout;
    int noise_generator; // 1, 2, 3: in force at the end of parsing
    int number_of_waves;
    Rgb irid_wavelength;
    Color background; // default black with transmit 1
} Settings;

// ---- camera ---------------------------------------------------------------------------------

// ORDER camera_type
typedef enum {
    CAMERA_PERSPECTIVE,
    CAMERA_ORTHOGRAPHIC,
    CAMERA_FISHEYE,
    CAMERA_ULTRA_WIDE_ANGLE,
    CAMERA_OMNIMAX,
    CAMERA_PANORAMIC,
    CAMERA_CYLINDER_1, // axis up, rays from one point
    CAMERA_CYLINDER_2, // axis right, rays from one point
    CAMERA_CYLINDER_3, // axis up, rays across it
    CAMERA_CYLINDER_4, // axis right, rays across it
    CAMERA_SPHERICAL,
} CameraType;

enum { CAMERA_MAX_BLUR_SAMPLES = 100000 }; // room for so many lens points is taken

// A lens as wide as `aperture`, sharp at focal_distance.
typedef struct {
    double aperture, focal_distance;
    int samples;     // 1 to CAMERA_MAX_BLUR_SAMPLES: at most so many points of the lens
    int min_samples; // no fewer, whatever the statistics say
    double confidence, variance;
} FocalBlur;

// The vectors as they stand after angle, look_at and all transforms (facts: rendering 1.2).
typedef struct {
    CameraType type;
    Vec3 location, direction, up, right;
    double angle_deg; // as stored by `angle`: fisheye, ultra_wide_angle, cylinder; default 90
    double spherical_deg[2]; // spherical: across and up; default 360, 180
    bool has_blur;
    FocalBlur blur;
    bool has_normal;
    uint32_t normal; // bends the rays, as if each were the normal of the picture's plane
} Camera;

// ---- lights ---------------------------------------------------------------------------------

// ORDER light_type
typedef enum { LIGHT_POINT, LIGHT_PARALLEL, LIGHT_SPOT, LIGHT_CYLINDER } LightType;

enum { LIGHT_MAX_GRID = 2048 };

// The grid of points from which the shadows of a light fall: size[0] x size[1] of them, between
// the sides axis[0] and axis[1] about its location.
typedef struct {
    Vec3 axis[2];
    int size[2];  // 1 to LIGHT_MAX_GRID: the shading keeps a colour for each point
    int adaptive; // levels of the grid that are always divided; default 100, which is all
    bool circular;
    bool orient; // faces each point it lights; only with circular
    bool jitter;
    bool illumination; // not only the shadows come from the grid but all of the light
} AreaLight;

typedef struct {
    LightType type;
    Vec3 location;
    Vec3 point_at; // parallel, cylinder: the light travels along point_at - location everywhere
    Rgb color;
    bool shadowless;  // no shadow test, diffuse only
    double radius;    // spot: half the angle in degrees (default 30); cylinder: a length (0.75)
    double falloff;   // the same, where the light ends; default 45 and 1
    bool parallel;    // spot: its rays run along its axis, so that it shines before its plane
    double tightness; // spot, cylinder: exponent; default 0
    double fade_distance;
    double fade_power;
    bool has_area;
    AreaLight area;
    bool media_attenuation; // fog dims it on its way
    uint32_t group;         // lights only objects of that light_group; 0: all
    bool has_projection;    // only light that has met this object counts, and what is nearer to
    uint32_t projection;    // the light than it throws no shadow: index in Scene.projections
} Light;

// ---- textures -------------------------------------------------------------------------------

// ORDER pattern_type. Modelled: those before PATTERN_MODELLED; the rest is parsed, warned of and
// replaced by the converter, so that a Scene never holds it.
typedef enum {
    PATTERN_PLAIN,
    PATTERN_CHECKER,  // list pattern: entries at 0, 1
    PATTERN_GRADIENT, // along `gradient`
    PATTERN_AGATE,    // agate_turb; always with a turbulence (its octaves, omega, lambda)
    PATTERN_BOXED,
    PATTERN_BOZO,  // also spotted, bumps
    PATTERN_BRICK, // list pattern: mortar at 0, brick at 1; brick_size, mortar
    PATTERN_CELLS,
    PATTERN_CRACKLE, // crackle
    PATTERN_CUBIC,   // list pattern: entries at 0..5
    PATTERN_CYLINDRICAL,
    PATTERN_DENTS,
    PATTERN_GRANITE,
    PATTERN_HEXAGON, // list pattern: entries at 0, 1, 2
    PATTERN_LEOPARD,
    PATTERN_MARBLE,
    PATTERN_ONION,
    PATTERN_PLANAR,
    PATTERN_QUILTED, // quilted
    PATTERN_RADIAL,
    PATTERN_RIPPLES,
    PATTERN_SPHERICAL,
    PATTERN_SPIRAL1,    // arms
    PATTERN_SPIRAL2,    // arms
    PATTERN_SQUARE,     // list pattern: entries at 0..3
    PATTERN_TRIANGULAR, // list pattern: entries at 0..5
    PATTERN_WAVES,
    PATTERN_WOOD,
    PATTERN_WRINKLES,
    PATTERN_AVERAGE,      // no value: the mean of the entries, weighted by theirs
    PATTERN_BUMPS,        // of normals only, this and the next; the pigment is PATTERN_BOZO
    PATTERN_FACETS,       // facets
    PATTERN_IMAGE,        // picture: image_pattern, its brightness or transparency
    PATTERN_IMAGE_MAP,    // picture; of pigments only, which have no map then
    PATTERN_BUMP_MAP,     // picture; of normals only
    PATTERN_SLOPE,        // slope
    PATTERN_AOI,          // the angle to the ray
    PATTERN_FUNCTION,     // function, of three parameters
    PATTERN_PIGMENT,      // pigment: its brightness
    PATTERN_OBJECT,       // list pattern: outside at 0, inside at 1; object
    PATTERN_DENSITY,      // density, density_between
    PATTERN_FRACTAL,      // fractal: mandel, julia, magnet
    PATTERN_MATERIAL_MAP, // picture; of textures only: its entries by number, without values
    PATTERN_MODELLED,     // patterns from here on are not in a Scene
} PatternType;

// ORDER wave_type
typedef enum {
    WAVE_RAMP,
    WAVE_TRIANGLE,
    WAVE_SINE,
    WAVE_SCALLOP,
    WAVE_CUBIC,
    WAVE_POLY,
} WaveType;

// Moves a point by amount (componentwise) times a sum of octaves of noise.
typedef struct {
    Vec3 amount;
    int octaves;         // 1..10; default 6
    float lambda, omega; // default 2, 0.5
} Turbulence;

// ORDER warp_type
typedef enum {
    WARP_TRANSFORM, // the point is multiplied by the inverse
    WARP_TURBULENCE,
    WARP_REPEAT,
    WARP_BLACK_HOLE,
    WARP_CUBIC,
    WARP_PLANAR, // this and the next three: `mapping`
    WARP_SPHERICAL,
    WARP_CYLINDRICAL,
    WARP_TOROIDAL,
} WarpType;

typedef struct {
    int axis; // 0, 1, 2
    float width;
    Vec3 offset; // added once a tile
    Vec3 flip;   // each 1, or -1: mirrored in every other tile
} RepeatWarp;

typedef struct {
    Vec3 center; // with repeat: as the parser has raised it (facts: textures 3.6)
    double radius, strength, falloff;
    bool inverse;
    bool repeat;
    Vec3 repeat_size, uncertainty; // a component 0: not repeated along it
} BlackHoleWarp;

typedef struct {
    Vec3 orientation; // unit; default z
    double distance;  // planar
    double dist_exp;
    double major_radius; // toroidal
} MappingWarp;

typedef struct {
    WarpType type;
    union {
        Transform transform;
        Turbulence turbulence;
        RepeatWarp repeat;
        BlackHoleWarp black_hole;
        MappingWarp mapping;
    };
} Warp;

typedef struct {
    Vec3 form;
    double metric, offset;
    bool solid;
} CrackleShape;

typedef struct {
    double size, coords, metric; // coords 0: cells of the normal itself, else of the point
} FacetsShape;

// How steep the surface is, and how high the point; each may have a range that becomes 0..1 (none:
// high == low).
typedef struct {
    Vec3 slope; // unit: how much the surface's normal points there; with point_at: a place to face
    bool point_at;
    double low, high;
    Vec3 altitude; // unit: how far the point lies along it; 0: it does not count
    double altitude_low, altitude_high;
    double share; // of the slope, 0..1; the altitude has the rest
} SlopeShape;

enum { FRACTAL_MAX_EXPONENT = 33, FRACTAL_MAX_ITERATIONS = 10000000 };

typedef struct {
    int exponent;           // 2..33
    int magnet;             // 1 or 2: of that magnet, without an exponent
    int iterations;         // at most
    bool julia;             // else Mandelbrot's: c is the point
    Vec2 c;                 // with julia
    int exterior, interior; // what is shown: 0..8, 0..6
    double exterior_factor, interior_factor;
} FractalShape;

// ORDER picture_type: the formats that a scene names.
typedef enum {
    PICTURE_PNG,
    PICTURE_GIF,
    PICTURE_TGA,
    PICTURE_IFF,
    PICTURE_POT,
    PICTURE_PGM,
    PICTURE_PPM,
    PICTURE_SYS, // BMP
    PICTURE_JPEG,
    PICTURE_TIFF,
    PICTURE_BMP,
    PICTURE_EXR,
    PICTURE_HDR,
    PICTURE_VALUES, // no file: the numbers are here
} PictureType;

enum { PICTURE_MAX_SIDE = 1 << 14 }; // of values

// ORDER picture_decode: how the stored values become light.
typedef enum {
    DECODE_NONE,  // they are it
    DECODE_FILE,  // as the file says; one that says nothing: as its format is wont to
    DECODE_OLD,   // as the file says; one that says nothing: not at all
    DECODE_POWER, // raised to picture.gamma
    DECODE_SRGB,
} PictureDecode;

// ORDER picture_layout
typedef enum { LAYOUT_PLANAR, LAYOUT_SPHERICAL, LAYOUT_CYLINDRICAL, LAYOUT_TORUS } PictureLayout;

// ORDER picture_between: what stands between the middles of pixels.
typedef enum { BETWEEN_NONE, BETWEEN_BILINEAR, BETWEEN_BICUBIC, BETWEEN_NORMALIZED } PictureBetween;

// ORDER picture_use: which number a pixel is, where one is asked for.
typedef enum { USE_PICTURE_COLOR, USE_PICTURE_INDEX, USE_PICTURE_ALPHA } PictureUse;

typedef struct {
    const char *path; // DF3; in a scene file as that of a picture
} DensityFile;

// One colour of the palette made transparent.
typedef struct {
    int place;
    bool transmit; // else filter
    float value;
} PaletteChange;

// A file and how it is laid on: over the unit square of x and y, around the unit sphere, ...
typedef struct {
    const char *path;            // in a scene file: absolute, or from where that stands
    int width, height, channels; // PICTURE_VALUES: 1 grey or 4 RGBA, 0 to 65535, rows from the top
    double *values;
    uint32_t value_count; // width * height * channels
    PictureType type;
    PictureDecode decode;
    float gamma;
    bool to_working; // light goes on to the working space (image_map)
    PictureLayout layout;
    PictureBetween between;
    PictureUse use;
    bool once;           // nothing is around it; else it repeats
    Vec2 repeat, offset; // default <1, 1> and <0, 0>
    bool has_filter, has_transmit;
    float filter, transmit; // of all pixels: added, or put into every place of the palette
    PaletteChange *changes;
    uint32_t change_count;
} Picture;

// How a point becomes a number. warps are stored in the order in which they are applied to the
// point (last written first); consecutive transforms are one (facts: textures 1.6).
typedef struct {
    PatternType type;
    WaveType wave;
    float frequency, phase, exponent; // frequency 0: no modulus, phase ignored
    int noise_generator;              // 1, 2, 3; 0: the scene's
    Warp *warps;
    uint32_t warp_count;
    bool has_turbulence;   // the `turbulence` of the block itself, applied after all warps
    Turbulence turbulence; // with has_turbulence; marble, wood, spirals and agate look inside
    Vec3 gradient;         // of unit length
    float agate_turb;      // default 1
    int arms;              // spiral1, spiral2
    Vec3 brick_size;       // default <8, 3, 4.5>
    float mortar;          // as written; default 0.5
    float quilted[2];      // control0, control1; default 1, 1
    CrackleShape crackle;  // default form <-1, 1, 0>, metric 2
    FacetsShape facets;    // default size 0.1, coords 0, metric 2
    uint32_t picture;      // of the patterns that look at one
    SlopeShape slope;      // default share 1
    FractalShape fractal;  // default exponent 2, exterior 1 and interior 0 with factors 1
    uint32_t function, pigment, object, density; // object: in Scene.projections
    int density_between;                         // 0, 1 linear, 2 cubic
} Pattern;

// One entry of a map: `value` is the position; the colour, or a pigment when pigment != NO_INDEX.
typedef struct {
    float value;
    Color color;
    uint32_t pigment;
} MapEntry;

typedef struct {
    Pattern pattern;
    Color color;       // PATTERN_PLAIN
    MapEntry *entries; // all other patterns; never empty there
    uint32_t entry_count;
    bool uv_mapping;      // evaluate at (u, v, 0) of the hit
    bool has_quick_color; // used instead at quality 0..5
    Color quick_color;
} Pigment;

// One step of a slope_map: the height there and the slope of the curve.
typedef struct {
    float value;
    double height, slope;
} SlopeEntry;

// One entry of a map of other records: its position, or weight, and an index into their pool.
typedef struct {
    float value;
    uint32_t index;
} IndexEntry;

// How a layer bends the surface's normal: as if its pattern were the height of the surface.
typedef struct {
    Pattern pattern;    // never PATTERN_PLAIN
    float amount;       // the depth, also called bump_size; default 0.5
    float accuracy;     // how far around the point the pattern is looked at; default 0.02
    SlopeEntry *slopes; // the pattern's value becomes a height; none: it is the height
    uint32_t slope_count;
    IndexEntry *entries; // normals; none: the pattern itself bends
    uint32_t entry_count;
    bool uv_mapping;    // evaluate at (u, v, 0) of the hit
    bool no_bump_scale; // transforms of the pattern change the depth
} Normal;

// Facts: rendering 4.4, 4.5. reflection: `max` is the value at grazing angles, `min` head-on.
typedef struct {
    Rgb ambient, emission;
    float diffuse, diffuse_back, brilliance, crand;
    float phong, phong_size;
    float specular, roughness; // roughness as written (the exponent is 1 / roughness)
    float metallic;
    Rgb reflection_min, reflection_max;
    float reflection_falloff, reflection_exponent, reflection_metallic;
    bool reflection_fresnel;
    bool conserve_energy;
    float irid, irid_thickness, irid_turbulence;
} Finish;

typedef struct {
    uint32_t pigment;
    Finish finish;
    uint32_t normal; // NO_INDEX: the surface's own
} Layer;

// Either layers, the top one (the last written) first; or, if there are none, textures chosen and
// mixed by a pattern. With uv_mapping and PATTERN_PLAIN there may be one entry instead of layers.
typedef struct {
    Layer *layers;
    uint32_t layer_count;
    bool uv_mapping;     // evaluate all of it at (u, v, 0); the pattern's warps turn only normals
    bool no_bump_scale;  // of the warps, for the normals inside
    Pattern pattern;     // PATTERN_PLAIN with layers
    IndexEntry *entries; // textures
    uint32_t entry_count;
} Texture;

// A refracted ray becomes so many.
enum { INTERIOR_MAX_DISPERSION = 100000 };

typedef struct {
    float ior;      // 1 when unset
    float caustics; // as written x 45
    float fade_distance, fade_power;
    Rgb fade_color;
    float refraction;       // what is seen through a surface is scaled by it; default 1
    float dispersion;       // ior of violet light to that of red light; 1: light keeps together
    int dispersion_samples; // 2 to INTERIOR_MAX_DISPERSION, default 7
} Interior;

// ---- objects --------------------------------------------------------------------------------

// ORDER object_type
typedef enum {
    OBJECT_UNION,        // children are separate objects
    OBJECT_MERGE,        // hits inside another child are dropped
    OBJECT_INTERSECTION, // hits outside another child are dropped; a difference is one with all
                         // children but the first inverted
    OBJECT_PATCH,
    OBJECT_PLANE,
    OBJECT_SPHERE,
    OBJECT_BOX,
    OBJECT_CYLINDER,
    OBJECT_CONE,
    OBJECT_TORUS,
    OBJECT_DISC,
    OBJECT_TRIANGLE,
    OBJECT_QUADRIC,
    OBJECT_POLY,
    OBJECT_SUPERELLIPSOID,
    OBJECT_LATHE,
    OBJECT_SOR,
    OBJECT_PRISM,
    OBJECT_SPHERE_SWEEP,
    OBJECT_BLOB,
    OBJECT_OVUS,
    OBJECT_SMOOTH_TRIANGLE,
    OBJECT_POLYGON,
    OBJECT_MESH,
    OBJECT_HEIGHT_FIELD,
    OBJECT_TEXT,
    OBJECT_ISOSURFACE,
    OBJECT_PARAMETRIC,
    OBJECT_INSTANCE, // a copy of a definition
    OBJECT_TYPE_COUNT,
} ObjectType;

// A Bézier patch in world space. Row i of points is weighted with u (POV-Ray's first index),
// column j with v. Texture coordinates: bilinear in the four corners (facts: rendering 7.6).
typedef struct {
    uint32_t degree_u, degree_v; // 1..16; 3, 3 for bicubic_patch
    Vec3 *points;                // (degree_u + 1) * (degree_v + 1)
    double *weights;             // of the points, > 0; NULL: all 1
    int type;                    // POV-Ray's 0 or 1; the picture is the same
    double flatness;             // this and the steps matter only to `facets`
    int u_steps, v_steps;        // recursion depths, not counts
    Vec2 uv[4];                  // at (i,j) = (0,0), (0,d), (d,d), (d,0)
} PatchShape;

// About its control points, so about the patch.
Box patch_shape_box(const PatchShape *patch);

typedef struct { // { p : normal . p = distance }, world space; inside is the side normal points
                 // from
    Vec3 normal; // unit
    double distance;
} PlaneShape;

// Below: local space; Object.transform takes it to the world.
typedef struct {
    Vec3 center;
    double radius;
} SphereShape;

typedef struct {
    Vec3 low, high;
} BoxShape;

// The cylinder or cone from base to apex (POV-Ray's two end points as written, with its order).
typedef struct {
    Vec3 base, apex;
    double base_radius, apex_radius; // equal for a cylinder
    bool open;
} ConeShape;

typedef struct { // axis y
    double major, minor;
} TorusShape;

typedef struct {
    Vec3 center, normal; // unit
    double radius, hole;
} DiscShape;

typedef struct { // world space
    Vec3 p[3];
} TriangleShape;

typedef struct {
    uint32_t *items;
    uint32_t count;
} ObjectList;

// The tree Scene.definitions[definition] once more, moved by Object.transform; textures are given
// as they are in the world. Only at top level, or in unions without clips and bounds that are not
// whole. Its flags are those of the tree's leaves. Leaves without a texture or an interior have
// those of the instance (which needs none: then they are one body of air).
typedef struct {
    uint32_t definition;
    uint32_t *textures; // pairs, ascending: leaves with the first have the second
    uint32_t texture_count;
    uint32_t *interiors; // the same
    uint32_t interior_count;
} InstanceShape;

// One hit shows no more textures than this at once, of parts of a blob or of what was cut.
enum { HIT_MAX_TEXTURES = 32 };

typedef struct {
    ObjectType type;
    // Leaves: NO_INDEX in texture means POV-Ray's built-in default (black). interior NO_INDEX: an
    // air interior of its own; two objects with the same index are one body to a ray.
    uint32_t texture, interior_texture, interior;
    bool no_shadow, no_image, no_reflection, hollow, double_illuminate;
    bool no_global_lights; // in a light_group: only its lights shine on it
    uint32_t light_group;  // see Light.group; 0: none
    bool inverse;          // of leaves and solid unions: of other trees it is lowered to the leaves
    bool uv_mapping;       // object level: all its textures are evaluated at (u, v, 0)
    bool solid;            // of a union of patches: they are closed, and have an inside
    bool whole;            // of a union without clips: as one object, like other trees
    // Of an intersection or merge, and of a leaf without a texture: POV-Ray's cutaway_textures. A
    // hit of the leaf shows the textures of what contains it in the outermost intersection, merge
    // or clipped union around, each alike; of a difference only the first child counts.
    bool difference, cutaway;
    bool has_transform;
    Transform transform; // local to world, of types with a local space (object_has_space)
    // Hits, and the inside, are only where all of these objects are (their flags and textures do
    // not count). Not on patches: POV-Ray ignores it there.
    ObjectList clips;
    // A ray sees the object only if it meets each of these objects too, or starts inside; the same
    // for all that is in them. Nothing but their shapes counts.
    ObjectList bounds;
    union {
        PatchShape patch;
        PlaneShape plane;
        SphereShape sphere;
        BoxShape box;
        ConeShape cone; // also OBJECT_CYLINDER
        TorusShape torus;
        DiscShape disc;
        TriangleShape triangle;
        QuadricShape quadric;
        PolyShape poly;
        SuperellipsoidShape superellipsoid;
        LatheShape lathe;
        SorShape sor;
        PrismShape prism;
        SphereSweepShape sphere_sweep;
        BlobShape blob;
        OvusShape ovus;
        SmoothTriangleShape smooth_triangle;
        PolygonShape polygon;
        MeshShape mesh;
        HeightFieldShape height_field;
        TextShape text;
        IsosurfaceShape isosurface;
        ParametricShape parametric;
        InstanceShape instance;
        ObjectList children; // UNION, MERGE, INTERSECTION
    } shape;
} Object;

// The sky: pigments from bottom to top; the unit direction goes through the inverse transform.
typedef struct {
    uint32_t *pigments;
    uint32_t pigment_count;
    Rgb emission;
    Transform transform;
} SkySphere;

// ORDER fog_type
typedef enum { FOG_CONSTANT, FOG_GROUND } FogType;

typedef struct {
    FogType type;
    double distance;    // never 0: at this depth 1/e of what lies behind is left
    double alt, offset; // ground: full below offset along up, thinner above by the scale of alt
    Vec3 up;
    Color color; // transmit: so much is left at any depth; filter: what is left takes its colour
    bool has_turbulence;
    Turbulence turbulence;
    float turb_depth; // default 0.5
} Fog;

enum { RAINBOW_ALL_AROUND = -1 };

typedef struct {
    uint32_t pigment;          // a gradient along x, looked up from 0 to 1 across the bow
    Vec3 direction, right, up; // unit, across each other; direction points away from the sun
    double distance;           // default 1e7
    double angle_deg;          // from direction to the middle of the bow
    double width_deg;          // never 0
    double arc_deg;            // 0..360: no bow beyond this angle in all, or RAINBOW_ALL_AROUND
    double falloff_deg;        // 0..arc_deg: where it begins to fade; the same
    double jitter;             // in widths
} Rainbow;

typedef struct {
    Settings settings;
    Camera camera;
    bool has_sky_sphere;
    SkySphere sky_sphere;
    Fog *fogs; // the last one written first
    uint32_t fog_count;
    Rainbow *rainbows; // the same
    uint32_t rainbow_count;
    Light *lights;
    uint32_t light_count;
    Picture *pictures;
    uint32_t picture_count;
    DensityFile *densities;
    uint32_t density_count;
    Pigment *pigments;
    uint32_t pigment_count;
    Normal *normals;
    uint32_t normal_count;
    Function *functions; // see src/function/function.h for how they are run
    uint32_t function_count;
    Texture *textures;
    uint32_t texture_count;
    Interior *interiors;
    uint32_t interior_count;
    Mesh *meshes;
    uint32_t mesh_count;
    HeightMap *height_maps;
    uint32_t height_map_count;
    Object *objects; // every node of the trees
    uint32_t object_count;
    uint32_t *roots; // what stands at top level, in the order of the source
    uint32_t root_count;
    uint32_t
        *projections; // objects that are not in the picture: see Light.projection, Pattern.object
    uint32_t projection_count;
    uint32_t *definitions; // trees that instances show, without instances in them
    uint32_t definition_count;
    const char **requires; // features the scene needs, sorted, each once ("bicubic_patch", ...)
    uint32_t requires_count;
} Scene;

Settings settings_default(void);
FocalBlur focal_blur_default(void); // without an aperture and samples
Camera camera_default(void);
Finish finish_default(void);
Interior interior_default(void);
Light light_default(LightType type);
AreaLight area_light_default(void);
// Are both the same, member by member and bit by bit? They may be of different scenes with the same
// pools: pigments in maps are compared by index.
bool pigment_equal(const Pigment *a, const Pigment *b);
bool picture_equal(const Picture *a, const Picture *b);
bool normal_equal(const Normal *a, const Normal *b);
bool texture_equal(const Texture *a, const Texture *b);

Fog fog_default(void);         // without a distance
Rainbow rainbow_default(void); // without a pigment and a direction

Turbulence turbulence_default(void); // without an amount
Pattern pattern_default(void);
Picture picture_default(void);
Normal normal_default(void); // without a pattern
Warp warp_default(WarpType type);
Object object_default(ObjectType type);
// Has it children?
bool object_is_tree(const Object *object);
// Has it a local space, so that it may have a transform?
bool object_has_space(ObjectType type);

// What a leaf of the instance's definition has there whose own texture or interior that is.
uint32_t instance_texture(const Object *instance, uint32_t own);
uint32_t instance_interior(const Object *instance, uint32_t own);

// Checks what the renderer relies on: indices in range, trees without cycles, degrees, finite
// numbers, map positions. Dies naming the field ("objects[3].interior: ..."). file is for messages.
void scene_validate(const Scene *scene, const char *file);

// Fills scene->requires (in arena) from what the scene holds: object types, patterns, camera type,
// ...
void scene_collect_requires(Scene *scene, Arena *arena);

// ---- the scene file: JSON, see README "The scene file" ----------------------------------------

typedef struct {
    bool binary; // control points to a side file, "x.qi.bin" beside "x.qi.json" (always above
                 // 10,000 patches)
} SceneWriteOptions;

// Writes path whole or not at all ("-": standard output, never binary); dies with a message if not.
// The scene is validated first. An object stands where it is in its tree; its index is not kept.
void scene_write(const Scene *scene, const char *path, const SceneWriteOptions *options);

// A number that two scenes share when their files would be the same (and hardly any others do).
uint64_t scene_hash(const Scene *scene);

// Reads and validates; dies with file:line:col for a syntax error, with the field's name for the
// rest. Objects are numbered as a walk of the trees meets them: a parent, then its children. All
// memory in arena.
Scene *scene_read(const char *path, Arena *arena);

#endif
