// SPDX-License-Identifier: MIT
// Of the scene model (scene.h): how surfaces and what they enclose look. Patterns turn points into
// numbers; pigments and normals turn those into colours and bends; textures stack them.
#ifndef MODEL_TEXTURE_H
#define MODEL_TEXTURE_H

#include "base/color.h"
#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

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

Turbulence turbulence_default(void); // without an amount
Warp warp_default(WarpType type);
Pattern pattern_default(void);
Picture picture_default(void);
Normal normal_default(void); // without a pattern
Finish finish_default(void);
Interior interior_default(void);

// Are both the same, member by member and bit by bit? They may be of different scenes with the same
// pools: pigments in maps are compared by index.
bool pigment_equal(const Pigment *a, const Pigment *b);
bool picture_equal(const Picture *a, const Picture *b);
bool normal_equal(const Normal *a, const Normal *b);
bool texture_equal(const Texture *a, const Texture *b);

#endif
