// SPDX-License-Identifier: MIT
// Scene files that are wrong are refused by name, and no text at all makes the reader crash.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/diag.h"
#include "random_scene.h"
#include "scene_file.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define HEAD "{\"format\": \"qipov-scene\", \"version\": 1, "
#define PIGMENTS "\"pigments\": [{\"color\": [1, 0, 0]}], "
#define WARP(more)                                                                                 \
    HEAD "\"pigments\": [{\"type\": \"bozo\", \"map\": [{\"value\": 0}], \"warps\": [{" more "}]}" \
         "]}"
#define BEZIER                                                                                     \
    "\"objects\": [{\"type\": \"bezier_patch\", \"points\": [[[0,0,0],[1,0,0]], "                  \
    "[[0,1,0],[1,1,0]]], "
#define NET                                                                                        \
    "[[[0,0,0],[1,0,0],[2,0,0],[3,0,0]], [[0,1,0],[1,1,0],[2,1,0],[3,1,0]],"                       \
    " [[0,2,0],[1,2,0],[2,2,0],[3,2,0]], [[0,3,0],[1,3,0],[2,3,0],[3,3,0]]]"
#define BUFFER "\"buffers\": [{\"uri\": \"x.qi.bin\", \"byteLength\": 384}], "
#define RUN(more) HEAD BUFFER "\"objects\": [{\"type\": \"bicubic_patch\", " more "}]}"

static const struct {
    const char *text, *message;
} REFUSED[] = {
    {"", "x.qi.json:1:0: error: '[' or '{' expected near end of file"},
    {"[]", "expected an object {...}, found an array [...]"},
    {"{}", "format: this is no scene file"},
    {"{\"format\": 1}", "format: this is no scene file"},
    {"{\n\"a\": 1,\n]", "x.qi.json:3:1: error: string or '}' expected near ']'"},
    {"{\"a\": 1, \"a\": 2}", "duplicate object key near '\"a\"'"},
    {"{\"a\": 1e999}", "real number overflow"},
    {"{\"a\": 123456789012345678901234567890}", "too big integer"},
    {"{\"a\": \"\\ud800\"}", "invalid Unicode"},
    {"{\"a\": \"\xff\"}", "unable to decode byte 0xff"},
    {HEAD "\"objects\": []} x", "end of file expected near 'x'"},
    {"{\"format\": \"qipov-scene\"}", "'version' is missing"},
    {"{\"format\": \"qipov-scene\", \"version\": 2}",
     "version: 2, but this program reads only version 1"},
    {"{\"format\": \"qipov-scene\", \"version\": \"1\"}",
     "version: expected a whole number, found a string"},
    {HEAD "\"requires\": [\"sphere\", \"julia_fractal\"]}",
     "requires[1]: the scene needs 'julia_fractal'"},
    {HEAD "\"requires\": \"sphere\"}", "requires: expected an array [...], found a string"},
    {HEAD "\"colour\": 1}", "unknown field 'colour'"},
    {HEAD "\"settings\": {\"max_trace_level\": 300}}",
     "settings.max_trace_level: 300 is not in the range 0 to 256"},
    {HEAD "\"settings\": {\"max_trace_level\": 2.5}}",
     "settings.max_trace_level: expected a whole number, found 2.5"},
    {HEAD "\"settings\": {\"max_trace_level\": 1e300}}",
     "settings.max_trace_level: expected a whole number, found 1e+300"},
    {HEAD "\"settings\": {\"max_trace_level\": 99999999999}}",
     "settings.max_trace_level: 99999999999 is not in the range"},
    {HEAD "\"settings\": {\"adc_bailout\": 1e39}}",
     "settings.adc_bailout: 1e+39 is too large for single precision"},
    {HEAD "\"settings\": {\"gamma_mode\": \"rgb\"}}", "settings.gamma_mode: unknown word 'rgb'"},
    {HEAD "\"settings\": {\"assumed_gamma\": 0}}", "settings.assumed_gamma: 0 is not positive"},
    {HEAD "\"settings\": {\"noise_generator\": 4}}",
     "settings.noise_generator: 4 is not in the range 1 to 3"},
    {HEAD "\"camera\": {\"location\": [0, \"1\", 0]}}",
     "camera.location[1]: expected a number, found a string"},
    {HEAD "\"camera\": {\"location\": [0, 1]}}", "camera.location: expected 3 values, found 2"},
    {HEAD "\"camera\": {\"location\": {\"x\": 1}}}",
     "camera.location: expected an array [...], found an object"},
    {HEAD "\"camera\": {\"direction\": [0, 0, 0]}}", "camera.direction: it has no length"},
    {HEAD "\"camera\": {\"up\": [0, 1e61, 0]}}", "camera.up: 1e+61 is out of range"},
    {HEAD "\"camera\": {\"type\": \"mesh\"}}", "camera.type: unknown word 'mesh'"},
    {HEAD "\"lights\": [{\"location\": [0, 0, 0]}]}", "lights[0]: 'color' is missing"},
    {HEAD "\"lights\": [{\"location\": [0, 0, 1], \"color\": [1, 1, 1], \"type\": \"parallel\"}]}",
     "lights[0].point_at: it is the light's location"},
    {HEAD "\"lights\": [{\"location\": [0, 0, 1], \"color\": [1, 1, 1], \"shadowless\": 1}]}",
     "lights[0].shadowless: expected true or false, found a whole number"},
    {HEAD "\"pigments\": [{\"color\": [1, 0, 0, 1]}]}",
     "pigments[0].color: expected 3 values, found 4"},
    {HEAD "\"pigments\": [{\"type\": \"checker\"}]}", "pigments[0].map: it is empty"},
    {HEAD "\"pigments\": [{\"map\": [{\"value\": 0}]}]}",
     "pigments[0].map: a plain pigment has none"},
    {HEAD "\"pigments\": [{\"type\": \"gradient\", \"map\": [{\"value\": 0}]}]}",
     "pigments[0].gradient: its length is 0 instead of 1"},
    {HEAD "\"pigments\": [{\"type\": \"checker\", \"map\": [{\"value\": 0, \"pigment\": 0}]}]}",
     "pigments[0].map[0].pigment: pigment 0 is part of itself"},
    // A body that is where a pigment says, which asks whether a point is in that body.
    {HEAD "\"functions\": [{\"type\": \"pattern\", \"pigment\": 0}], \"pigments\": [{\"type\": "
          "\"object\", \"object\": 0, \"map\": [{\"value\": 0}, {\"value\": 1}]}], "
          "\"projections\": [{\"type\": \"isosurface\", \"function\": 0}]}",
     "part of itself"},
    {HEAD "\"objects\": [{\"type\": \"instance\"}]}", "objects[0]: 'definition' is missing"},
    {HEAD "\"objects\": [{\"type\": \"instance\", \"definition\": 1}], \"definitions\": "
          "[{\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1}]}",
     "objects[0].definition: 1, but there is 1 definition"},
    {HEAD "\"definitions\": [{\"type\": \"instance\", \"definition\": 0}]}",
     "definitions[0]: an instance stands only among objects"},
    {HEAD "\"objects\": [{\"type\": \"merge\", \"children\": [{\"type\": \"instance\", "
          "\"definition\": 0}]}], \"definitions\": [{\"type\": \"union\", \"children\": []}]}",
     "objects[0].children[0]: an instance stands only among objects"},
    {HEAD "\"interiors\": [{}, {}], \"objects\": [{\"type\": \"instance\", \"definition\": 0, "
          "\"interiors\": [[1, 0], [0, 1]]}], \"definitions\": [{\"type\": \"union\", "
          "\"children\": []}]}",
     "objects[0].interiors[1]: interior 0 is not above that of the pair before"},
    {HEAD "\"objects\": [{\"type\": \"parametric\", \"function_x\": 0, \"function_y\": 0}]}",
     "objects[0]: 'function_z' is missing"},
    {HEAD "\"objects\": [{\"type\": \"union\", \"difference\": true, \"children\": []}]}",
     "objects[0]: 'difference' is for intersections and merges"},
    {HEAD "\"objects\": [{\"type\": \"intersection\", \"cutaway\": true, \"children\": []}]}",
     "objects[0]: 'cutaway' is for primitives without a texture"},
    {HEAD "\"pigments\": [{\"type\": \"checker\", \"map\": [{\"value\": 0, \"pigment\": 1}]}]}",
     "pigments[0].map[0].pigment: 1, but there is 1 pigment"},
    {HEAD "\"pigments\": [{\"type\": \"hexagon\", \"map\": [{\"value\": 0}, {\"value\": 1}]}]}",
     "pigments[0].map: 2 entries, but the pattern has 3 values"},
    {HEAD "\"pigments\": [{\"type\": \"julia\"}]}", "pigments[0].type: unknown word 'julia'"},
    {HEAD "\"pigments\": [{\"noise_generator\": 4}]}",
     "pigments[0].noise_generator: 4 is not in the range 0 to 3"},
    {HEAD "\"pigments\": [{\"turbulence\": {\"octaves\": 3}}]}",
     "pigments[0].turbulence: 'amount' is missing"},
    {HEAD "\"pigments\": [{\"turbulence\": {\"amount\": [1, 1, 1], \"octaves\": 11}}]}",
     "pigments[0].turbulence.octaves: 11 is not in the range 1 to 10"},
    {HEAD "\"pigments\": [{\"type\": \"brick\", \"brick_size\": [8, 0, 4], "
          "\"map\": [{\"value\": 0}, {\"value\": 1}]}]}",
     "pigments[0].brick_size: 0 has no reciprocal"},
    {HEAD "\"pigments\": [{\"crackle\": {\"metric\": 1e61}}]}",
     "pigments[0].crackle.metric: 1e+61 is out of range"},
    {WARP("\"type\": \"shear\""), "pigments[0].warps[0].type: unknown word 'shear'"},
    {WARP("\"type\": \"cubic\", \"radius\": 1"),
     "pigments[0].warps[0]: 'radius' does not go with this type"},
    {WARP("\"radius\": 1"), "pigments[0].warps[0]: 'radius' does not go with this type"},
    {WARP("\"type\": \"black_hole\", \"center\": [0, 0, 0]"),
     "pigments[0].warps[0]: 'radius' is missing"},
    {WARP("\"type\": \"black_hole\", \"center\": [0, 0, 0], \"radius\": -1"),
     "pigments[0].warps[0].radius: -1 is negative"},
    {WARP("\"type\": \"turbulence\", \"amount\": [1, 1, 1], \"octaves\": 0"),
     "pigments[0].warps[0].octaves: 0 is not in the range 1 to 10"},
    {WARP("\"type\": \"repeat\", \"axis\": 3, \"width\": 1"),
     "pigments[0].warps[0].axis: 3 is not in the range 0 to 2"},
    {WARP("\"type\": \"repeat\", \"axis\": 0, \"width\": 0"),
     "pigments[0].warps[0].width: 0 has no reciprocal"},
    {HEAD "\"pigments\": [{\"type\": \"average\", \"map\": [{\"value\": 1}, {\"value\": -1}]}]}",
     "pigments[0].map: the weights add up to 0"},
    {WARP("\"type\": \"repeat\", \"axis\": 0, \"width\": 1, \"flip\": [1, 0, 1]"),
     "pigments[0].warps[0].flip: 0 is neither 1 nor -1"},
    {WARP("\"type\": \"planar\", \"orientation\": [0, 2, 0]"),
     "pigments[0].warps[0].orientation: its length is 2 instead of 1"},
    {HEAD PIGMENTS "\"textures\": [{}]}", "textures[0]: it has no layers"},
    {HEAD "\"pictures\": [{\"path\": \"\"}]}", "pictures[0].path: it is empty"},
    {HEAD "\"pictures\": [{}]}", "pictures[0].path: it is missing"},
    {HEAD "\"pictures\": [{\"type\": \"values\", \"width\": 2, \"height\": 1, \"channels\": 1, "
          "\"values\": [1]}]}",
     "pictures[0].values: 1 entries, expected 2 x 1 x 1"},
    {HEAD "\"pictures\": [{\"type\": \"values\", \"width\": 1, \"height\": 1, \"channels\": 1, "
          "\"values\": [65536]}]}",
     "pictures[0].values: entry 0 is not from 0 to 65535"},
    {HEAD "\"pictures\": [{\"type\": \"values\", \"width\": 1, \"height\": 1, \"channels\": 2}]}",
     "pictures[0].channels: 2 is neither 1 nor 4"},
    {HEAD "\"pigments\": [{\"type\": \"image_map\"}]}", "pigments[0].picture"},
    {HEAD "\"pigments\": [{\"type\": \"bumps\"}]}", "this pattern is for normals only"},
    {HEAD "\"normals\": [{\"type\": \"bumps\", \"map\": [{\"value\": 0, \"normal\": 0}]}]}",
     "normal 0 is part of itself"},
    {HEAD "\"normals\": [{\"type\": \"plain\"}]}", "normals[0].type: a normal needs a pattern"},
    {HEAD "\"normals\": [{\"type\": \"average\"}]}", "normals[0].map"},
    {HEAD "\"normals\": [{\"type\": \"bozo\", \"accuracy\": 0}]}", "0 has no reciprocal"},
    {HEAD "\"textures\": [{\"type\": \"bozo\", \"map\": [{\"value\": 0, \"texture\": 0}]}]}",
     "texture 0 is part of itself"},
    {HEAD "\"textures\": [{\"type\": \"checker\", \"map\": []}]}", "textures[0].map: it is empty"},
    {HEAD "\"textures\": [{\"layers\": [{\"pigment\": -1}]}]}",
     "textures[0].layers[0].pigment: -1 is not in the range"},
    {HEAD "\"sky_sphere\": {}}", "sky_sphere: it has no pigments"},
    {HEAD PIGMENTS "\"sky_sphere\": {\"pigments\": [0, 1]}}",
     "sky_sphere.pigments[1]: 1, but there is 1 pigment"},
    {HEAD "\"objects\": {}}", "objects: expected an array [...], found an object {...}"},
    {HEAD "\"objects\": [7]}", "objects[0]: expected an object {...}, found a whole number"},
    {HEAD "\"objects\": [{}]}", "objects[0]: 'type' is missing"},
    {HEAD "\"objects\": [{\"type\": \"blobby\"}]}",
     "objects[0].type: unknown object type 'blobby'"},
    {HEAD "\"objects\": [{\"type\": \"lathe\"}]}", "objects[0].points: 0 entries"},
    {HEAD "\"objects\": [{\"type\": \"lathe\", \"points\": [[1, 2], [1]]}]}",
     "objects[0].points[1]: expected 2 values"},
    {HEAD "\"objects\": [{\"type\": \"poly\", \"order\": 2, \"coefficients\": [1, 2]}]}",
     "objects[0].coefficients: 2 entries, expected 10"},
    {HEAD "\"objects\": [{\"type\": \"superellipsoid\", \"e\": 0, \"n\": 1}]}",
     "objects[0].e: 0 is not above 0"},
    {HEAD "\"objects\": [{\"type\": \"sor\", \"points\": [[0, 0], [1, 1], [1, 1], [0, 3]]}]}",
     "objects[0].points: point 2 is not above"},
    {HEAD "\"objects\": [{\"type\": \"mesh\", \"mesh\": 0}]}",
     "objects[0].mesh: 0, but there are 0"},
    {HEAD "\"objects\": [{\"type\": \"height_field\", \"map\": 3}]}",
     "objects[0].map: 3, but there are 0"},
    {HEAD "\"objects\": [{\"type\": \"text\", \"thickness\": 1, \"letters\": [7]}]}",
     "objects[0].letters: 7 does not follow"},
    {HEAD "\"objects\": [{\"type\": \"ovus\", \"bottom\": 1, \"top\": 3}]}",
     "objects[0]: 'top' is not below"},
    {HEAD "\"meshes\": [{\"points\": [[0, 0, 0]], \"faces\": [[0, 0, 1, -1, -1, -1, -1, -1, -1, "
          "-1, -1, -1]]}]}",
     "meshes[0].faces[0]: 1, but there is 1 point"},
    {HEAD "\"height_maps\": [{\"width\": 2, \"depth\": 2, \"heights\": [1, 2, 3]}]}",
     "height_maps[0].heights: 3 entries, expected 2 x 2"},
    {HEAD "\"objects\": [{\"type\": \"union\"}]}", "objects[0]: 'children' is missing"},
    {HEAD "\"objects\": [{\"type\": \"union\", \"children\": [{\"type\": \"sphere\", \"center\": "
          "[0, 0, 0]}]}]}",
     "objects[0].children[0]: 'radius' is missing"},
    {HEAD "\"objects\": [{\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": -1}]}",
     "objects[0].radius: -1 is negative"},
    {HEAD
     "\"objects\": [{\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1, \"interior\": 7}],"
     "\"interiors\": [{}, {}]}",
     "objects[0].interior: 7, but there are 2 interiors"},
    {HEAD "\"objects\": [{\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1, "
          "\"children\": []}]}",
     "objects[0]: unknown field 'children'"},
    {HEAD
     "\"objects\": [{\"type\": \"sphere\", \"count\": 2, \"center\": [0, 0, 0], \"radius\": 1}]}",
     "objects[0]: unknown field 'count'"},
    {HEAD "\"objects\": [{\"type\": \"torus\", \"major\": 1, \"minor\": 1, \"transform\": "
          "{\"matrix\": [[1, 0, 0], [2, 0, 0], [0, 0, 1], [0, 0, 0]]}}]}",
     "objects[0].transform.matrix: it cannot be inverted"},
    {HEAD "\"objects\": [{\"type\": \"torus\", \"major\": 1, \"minor\": 1, \"transform\": "
          "{\"matrix\": [[1, 0, 0], [0, 1, 0], [0, 0, 1], [5, 0, 0]],"
          " \"inverse\": [[1, 0, 0], [0, 1, 0], [0, 0, 1], [5, 0, 0]]}}]}",
     "objects[0].transform.inverse: it is not the inverse of the matrix"},
    {HEAD "\"objects\": [{\"type\": \"plane\", \"normal\": [0, 2, 0], \"distance\": 1}]}",
     "objects[0].normal: its length is 2 instead of 1"},
    {HEAD "\"objects\": [{\"type\": \"plane\", \"normal\": [0, 1, 0], \"distance\": 1, "
          "\"transform\": {}}]}",
     "objects[0]: unknown field 'transform'"},
    {HEAD "\"objects\": [{\"type\": \"box\", \"low\": [0, 2, 0], \"high\": [1, 1, 1]}]}",
     "objects[0]: 'low' is above 'high'"},
    {HEAD "\"objects\": [{\"type\": \"cone\", \"base\": [0, 2, 0], \"base_radius\": 1,"
          " \"apex\": [0, 2, 0], \"apex_radius\": 1}]}",
     "objects[0]: base and apex are the same point"},
    {HEAD "\"objects\": [{\"type\": \"bicubic_patch\"}]}", "objects[0]: 'points' is missing"},
    {HEAD "\"objects\": [{\"type\": \"bicubic_patch\", \"points\": []}]}",
     "objects[0].points: 0 rows of points, expected 2 to 17"},
    {HEAD "\"objects\": [{\"type\": \"bicubic_patch\", \"points\": [1, 2]}]}",
     "objects[0].points[0]: expected an array [...], found a whole number"},
    {HEAD
     "\"objects\": [{\"type\": \"bicubic_patch\", \"points\": [[[0,0,0],[1,1,1]],[[0,0,0]]]}]}",
     "objects[0].points[1]: 1 points, but the first row has 2"},
    {HEAD "\"objects\": [{\"type\": \"bicubic_patch\", \"points\": "
          "[[[0,0,0],[1,1,1]],[[0,0,0],[1,1,1]]]}]}",
     "objects[0].points: a bicubic_patch has 4 rows of 4 points"},
    {HEAD "\"objects\": [{\"type\": \"bicubic_patch\", \"points\": "
          "[[[0,0],[1,1,1]],[[0,0,0],[1,1,1]]]}]}",
     "objects[0].points[0][0]: expected 3 values, found 2"},
    {HEAD "\"objects\": [{\"type\": \"bezier_patch\", \"points\": "
          "[[[0,0,0],[1e70,1,1]],[[0,0,0],[1,1,1]]]}]}",
     "objects[0].points[0][1]: <1e+70, 1, 1> is out of range"},
    {HEAD "\"objects\": [{\"type\": \"bicubic_patch\", \"basis\": \"bspline\", \"points\": " NET
          "}]}",
     "objects[0]: 'basis' goes only with the points of a bezier_patch"},
    {HEAD BEZIER "\"weights\": [[1, 1]]}]}",
     "objects[0].weights: 1 rows, but there are 2 of points"},
    {HEAD BEZIER "\"weights\": [[1, 1], [1]]}]}",
     "objects[0].weights[1]: expected 2 values, found 1"},
    {HEAD BEZIER "\"weights\": [[1, 1], [1, 0]]}]}",
     "objects[0].weights[1][1]: the weight 0 is not above 0"},
    {HEAD BEZIER "\"weights\": [[1, 1], [1, -2]]}]}", "the weight -2 is not above 0"},
    {HEAD BEZIER "\"weights\": [[1e40, 1], [1, 1]]}]}", "differ by more than 1e+12"},
    {HEAD BEZIER "\"basis\": \"hermite\"}]}", "objects[0].basis: 'hermite' is none of"},
    {HEAD BEZIER "\"basis\": \"doo_sabin\"}]}",
     "objects[0].basis: a regular 'doo_sabin' patch has 3 rows of 3 points"},
    {HEAD BEZIER "\"knots_u\": [0, 1]}]}", "knots go only with the basis"},
    {HEAD BEZIER "\"basis\": \"bspline\", \"knots_u\": [0, 1, 2]}]}",
     "objects[0].knots_u: expected 2 values, found 3"},
    {HEAD BEZIER "\"basis\": \"bspline\", \"knots_v\": [1, 1]}]}",
     "objects[0].knots_v: the middle two knots"},
    {HEAD "\"objects\": [{\"type\": \"bicubic_patch\", \"degree\": [3, 3], \"points\": " NET "}]}",
     "objects[0]: 'degree' goes only with points in a buffer"},
    {HEAD "\"objects\": [{\"type\": \"bicubic_patch\", \"count\": 2, \"points\": " NET "}]}",
     "objects[0].count: 2 patches are more than the buffers hold"},
    {HEAD "\"objects\": [{\"type\": \"bicubic_patch\", \"patch_type\": 2, \"points\": " NET "}]}",
     "objects[0].patch_type: 2 is not in the range 0 to 1"},
    {HEAD "\"buffers\": [{\"uri\": \"../x.qi.bin\", \"byteLength\": 384}]}",
     "buffers[0].uri: '../x.qi.bin' is not in the folder of the scene file"},
    {HEAD "\"buffers\": [{\"uri\": \"a/../../x.bin\", \"byteLength\": 384}]}",
     "is not in the folder"},
    {HEAD "\"buffers\": [{\"uri\": \"a/..\", \"byteLength\": 384}]}", "is not in the folder"},
    {HEAD "\"buffers\": [{\"uri\": \"/etc/passwd\", \"byteLength\": 384}]}",
     "is not in the folder"},
    {HEAD "\"buffers\": [{\"uri\": \"\", \"byteLength\": 384}]}", "is not in the folder"},
    {HEAD "\"buffers\": [{\"uri\": \"y.bin\", \"byteLength\": 384}]}",
     "/y.bin': No such file or directory"},
    {HEAD "\"buffers\": [{\"uri\": \".\", \"byteLength\": 384}]}", "/.': not a regular file"},
    {HEAD "\"buffers\": [{\"uri\": \"x.qi.bin\"}]}", "buffers[0]: 'byteLength' is missing"},
    {HEAD "\"buffers\": [{\"uri\": \"x.qi.bin\", \"byteLength\": 383}]}",
     "/x.qi.bin' has 384 bytes"},
    {HEAD "\"buffers\": [{\"uri\": \"x.qi.bin\", \"byteLength\": -1}]}",
     "buffers[0].byteLength: -1 is not in the range"},
    {RUN("\"points\": {\"buffer\": 0, \"byteOffset\": 8}"),
     "objects[0].points.byteOffset: 384 bytes from 8 on, but the buffer ends at byte 384"},
    {RUN("\"points\": {\"buffer\": 0, \"byteOffset\": 9223372036854775807}"),
     "but the buffer ends at byte 384"},
    {RUN("\"points\": {\"buffer\": 1, \"byteOffset\": 0}"),
     "objects[0].points.buffer: 1, but there is 1 buffer"},
    {RUN("\"points\": {\"buffer\": 0}"), "objects[0].points: 'byteOffset' is missing"},
    {RUN("\"points\": 3"), "objects[0].points: expected an object {...}, found a whole number"},
    {RUN("\"count\": 2, \"points\": {\"buffer\": 0, \"byteOffset\": 0}"),
     "768 bytes from 0 on, but the buffer ends"},
    {RUN("\"count\": 4000000000, \"points\": {\"buffer\": 0, \"byteOffset\": 0}"),
     "4000000000 patches are more than"},
    {RUN("\"count\": 0, \"points\": {\"buffer\": 0, \"byteOffset\": 0}"),
     "objects[0].count: 0 is not in the range"},
    {RUN("\"degree\": [3, 17], \"points\": {\"buffer\": 0, \"byteOffset\": 0}"),
     "objects[0].degree: expected two whole numbers"},
    {RUN("\"degree\": [3, 2], \"points\": {\"buffer\": 0, \"byteOffset\": 0}"),
     "a bicubic_patch has 4 rows of 4 points"},
    {RUN("\"points\": {\"buffer\": 0, \"byteOffset\": 0}, \"uv\": {\"buffer\": 0, \"byteOffset\": "
         "328}"),
     "objects[0].uv.byteOffset: 64 bytes from 328 on"},
};

static void test_refused(void **state) {
    (void)state;
    static const char zeros[384];
    scene_file_put(scene_bin_path, zeros, sizeof zeros);
    for (size_t i = 0; i < sizeof REFUSED / sizeof REFUSED[0]; i++) {
        SceneJob job = {.arena = arena_create()};
        char *message = NULL;
        scene_file_put(scene_json_path, REFUSED[i].text, strlen(REFUSED[i].text));
        if (diag_catch(scene_job_read, &job, &message))
            fail_msg("accepted: %s", REFUSED[i].text);
        if (!strstr(message, REFUSED[i].message) || !strstr(message, scene_json_path))
            fail_msg("%s\nexpected: %s\nfound: %s", REFUSED[i].text, REFUSED[i].message, message);
        free(message);
        arena_destroy(job.arena);
    }
    // The cases of runs are refused for what they name: without it they are good.
    SceneJob job = {.arena = arena_create()};
    const char good[] = RUN("\"points\": {\"buffer\": 0, \"byteOffset\": 0}");
    scene_file_put(scene_json_path, good, strlen(good));
    assert_true(diag_catch(scene_job_read, &job, NULL));
    arena_destroy(job.arena);
    unlink(scene_bin_path);
}

// What only a program can make wrong: circles and shares in the trees.
static void expect_invalid(Scene *scene, const char *expected) {
    SceneJob job = {.scene = scene};
    char *message = NULL;
    assert_false(diag_catch(scene_job_validate, &job, &message));
    if (!strstr(message, expected))
        fail_msg("expected: %s\nfound: %s", expected, message);
    free(message);
}

static void test_trees(void **state) {
    (void)state;
    Arena *arena = arena_create();
    Scene *scene = scene_of_patches(arena, 3);
    Object *tree = &scene->objects[0];
    *tree = object_default(OBJECT_UNION);
    tree->shape.children.items = ARENA_ARRAY(arena, uint32_t, 2);
    tree->shape.children.items[0] = 1;
    tree->shape.children.items[1] = 2;
    tree->shape.children.count = 2;
    expect_invalid(scene, "memory: objects[1]: object 1 is used twice");
    scene->root_count = 1;
    scene_validate(scene, "memory");
    tree->shape.children.items[1] = 0;
    expect_invalid(scene, "memory: objects[0].children[1]: object 0 is used twice");
    tree->shape.children.items[1] = 9;
    expect_invalid(scene, "memory: objects[0].children[1]: 9, but there are 3 objects");
    tree->shape.children.count = 1;
    expect_invalid(scene, "memory: object 2 is part of no tree");
    tree->shape.children.count = 2;
    tree->shape.children.items[1] = 2;
    scene->objects[2].shape.patch.points[6].y = (double)NAN;
    expect_invalid(scene,
                   "memory: objects[0].children[1].points[1][2]: <1, nan, 2> is out of range");
    scene->objects[2].shape.patch.points[6].y = 0;
    scene->objects[2].shape.patch.degree_u = 17;
    expect_invalid(scene, "memory: objects[0].children[1]: the degrees 17 and 3");
    arena_destroy(arena);
}

// After a run, messages still count the entries of the file.
static void test_paths_after_run(void **state) {
    (void)state;
    Arena *arena = arena_create();
    Scene *scene = scene_of_patches(arena, 5);
    scene->objects[4] = object_default(OBJECT_SPHERE);
    scene->objects[4].shape.sphere.radius = 77;
    scene_write(scene, scene_json_path, &(SceneWriteOptions){true});
    char *text = scene_file_get(arena, scene_json_path), *radius = strstr(text, "77");
    assert_non_null(radius);
    radius[0] = '-';
    scene_file_put(scene_json_path, text, strlen(text));
    SceneJob job = {.arena = arena};
    char *message = NULL;
    assert_false(diag_catch(scene_job_read, &job, &message));
    assert_non_null(strstr(message, ": objects[1].radius: -7 is negative"));
    free(message);
    unlink(scene_bin_path);
    arena_destroy(arena);
}

// ---- no text makes the reader crash ---------------------------------------------------------

static void read_hostile(const char *text, size_t size) {
    SceneJob job = {.arena = arena_create()};
    char *message = NULL;
    scene_file_put(scene_json_path, text, size);
    if (!diag_catch(scene_job_read, &job, &message))
        assert_true(strlen(message) > 0);
    free(message);
    arena_destroy(job.arena);
}

static void test_hostile(void **state) {
    (void)state;
    enum { DEEP = 100000 };
    char *deep = malloc(DEEP + 64);
    memset(deep, '[', DEEP);
    read_hostile(deep, DEEP);
    int length = snprintf(deep, DEEP, HEAD "\"objects\": ");
    while (length < DEEP - 64)
        length += snprintf(deep + length, 64, "[{\"type\": \"union\", \"children\": ");
    read_hostile(deep, (size_t)length);
    free(deep);

    // A good file with bytes changed, dropped, doubled; and words swapped for others of the file.
    static const char *const WORDS[] = {"-1",   "1e308",      "null", "true", "{}",         "[]",
                                        "\"\"", "4294967295", "1.5",  "[[]]", "\"sphere\"", "0"};
    for (uint64_t number = 0; number < 600; number++) {
        Rng rng = {number};
        Arena *arena = arena_create();
        scene_write(random_scene(&rng, arena), scene_json_path,
                    &(SceneWriteOptions){number % 2 == 0});
        char *text = scene_file_get(arena, scene_json_path);
        size_t size = strlen(text);
        char *changed = arena_alloc(arena, size + 64);
        for (int i = 0; i < 3; i++) {
            size_t at = rng_next(&rng) % size, used = at;
            memcpy(changed, text, at);
            const char *rest = text + at;
            if (rng_next(&rng) % 2) {
                changed[used++] = (char)rng_next(&rng);
                rest++;
            } else {
                // Replaces the rest of this number or word.
                const char *word = WORDS[rng_next(&rng) % (sizeof WORDS / sizeof WORDS[0])];
                memcpy(changed + used, word, strlen(word));
                used += strlen(word);
                rest += strcspn(rest, ",]}: \n");
            }
            memcpy(changed + used, rest, strlen(rest));
            read_hostile(changed, used + strlen(rest));
        }
        arena_destroy(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_trees),
        cmocka_unit_test(test_paths_after_run),
        cmocka_unit_test(test_hostile),
    };
    return cmocka_run_group_tests_name("scene_refused", tests, scene_file_set_up,
                                       scene_file_tear_down);
}
