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
#include "model/object.h"
#include "model/texture.h"

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

// ---- surroundings ---------------------------------------------------------------------------

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

// ---- the scene ------------------------------------------------------------------------------

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
    // Objects that are not in the picture: see Light.projection, Pattern.object.
    uint32_t *projections;
    uint32_t projection_count;
    uint32_t *definitions; // trees that instances show, without instances in them
    uint32_t definition_count;
    const char **requires; // features the scene needs, sorted, each once ("bicubic_patch", ...)
    uint32_t requires_count;
} Scene;

Settings settings_default(void);
FocalBlur focal_blur_default(void); // without an aperture and samples
Camera camera_default(void);
Light light_default(LightType type);
AreaLight area_light_default(void);
Fog fog_default(void);         // without a distance
Rainbow rainbow_default(void); // without a pigment and a direction

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