// SPDX-License-Identifier: MIT
// What METHOD_QI prepares: patches are cut into pieces that are nearly parallelograms, and the
// pieces lie eight to a leaf of one tree. Private to accel.c, piece.c, root.c and the kernels.
//
// Each piece gets an affine frame (x,y,z) of its own, made from its tangents at the middle, in
// which the piece fills the box [-1,1]^3: x goes along u, y along v, z is the thickness. The box
// comes from the QI net and its bound, taken in the frame. So a ray, taken to the frame, meets the
// piece only if it meets that box, and x and y are the piece's own parameters a, b in [-1,1] but
// for a small and smooth rest.
#ifndef PATCH_PIECE_H
#define PATCH_PIECE_H

#include "base/arena.h"
#include "patch/bezier.h"
#include "patch/patch.h"
#include "patch/tree.h"

#include <stddef.h>

enum { BLOCK_LANES = 8 };

// Everything local counts from the patch's center, so that its rounding is relative to the patch
// and not to its place. What a ray needs of a bicubic patch lies together: where there are many
// patches each line of it comes from memory, and those whose address is known come at once.
typedef struct {
    _Alignas(64) Vec3 center;
    double rounding;     // of a coordinate of S; of its derivatives: times twice the degree
    double tolerance;    // scene units
    double radius;       // of a ball that holds all points
    double border;       // how far outside of it the patch may be hit, see border.h
    uint32_t id;         // the definition's
    bool cubic;          // bi-degree (3,3); then local is own
    double own[49];      // one more, since a point is read as four numbers
    const double *local; // points less center; cubic: [column][row][3], else [3][row][column]
    const PatchDef *def;
} AccelPatch;
_Static_assert(sizeof(AccelPatch) == 512, "eight lines of cache");

// How far outside its rectangle, in shares of its size, a piece's bounds still hold.
#define PIECE_MARGIN 0x1p-20

// In the frame, with a = (u - middle) / half width and b alike, (x, y, z) is the sum of
// poly[j][i] a^i b^j but for rounding (of cubic patches; of others up to second order), good for a
// guess; and what holds strictly is
//     |a - scale_a x - shift_a| <= rest_a    |b - scale_b y - shift_b| <= rest_b.
// The terms leave every fourth number free for the rest that is to be known: the rectangle (exact,
// its sides are halvings) and bounds of the lengths of the second derivatives in the patch's
// parameters.
typedef union {
    float poly[4][4][4]; // [power of b][power of a][x y z, something else]
    struct {
        float xyz0[3];
        float u0;
        float xyz1[3];
        float u1;
        float xyz2[3];
        float v0;
        float xyz3[3];
        float v1;
        float xyz4[3];
        float muu;
        float xyz5[3];
        float muv;
        float xyz6[3];
        float mvv;
        float xyz7[3];
        float scale_a;
        float xyz8[3];
        float scale_b;
        float xyz9[3];
        float shift_a;
        float xyz10[3];
        float shift_b;
        float xyz11[3];
        float rest_a;
        float xyz12[3];
        float rest_b;
        float xyz13[3];
        float unused;
        float xyz14[3];
        uint32_t patch;
        float xyz15[3];
        uint32_t fourth; // of a piece of high degree: its number in Accel's
    };
} Piece;
_Static_assert(sizeof(Piece) == 256, "four lines of cache");

static inline BezierRect piece_rect(const Piece *piece) {
    return (BezierRect){(double)piece->u0, (double)piece->u1, (double)piece->v0, (double)piece->v1};
}

// The frames of eight pieces side by side: frame = axis (X - center) + shift for X in tree units.
// steep: with q the ray's direction in the frame, no two points of the piece lie on one such ray if
//     |qz| > steep[0] |qx| + steep[1] |qy| + steep[2].
typedef struct {
    float axis[3][3][BLOCK_LANES]; // [row][coordinate]
    float shift[3][BLOCK_LANES], steep[3][BLOCK_LANES];
    float center[4];       // tree space; the fourth is 0
    uint32_t first, count; // accel_piece(first + LINES_OF_PIECE i) is lane i
    uint32_t coarse;       // bit i: rounding makes the box of lane i twice as large as the piece
    uint32_t unused;
    // Of each lane: its patch, which the piece knows too, but so both can be fetched at once; and
    // the rays that may meet it.
    uint32_t patch[BLOCK_LANES], mask[BLOCK_LANES];
} Block;
_Static_assert(sizeof(Block) == 576, "nine lines of cache");

// Blocks and pieces are numbered by the lines of cache before them: of each leaf the block and then
// its pieces, since a ray that asks for a piece has come from its block, and what lies in the same
// page of memory is found sooner.
enum { LINE = 64, LINES_OF_BLOCK = sizeof(Block) / LINE, LINES_OF_PIECE = sizeof(Piece) / LINE };

// Of a piece of a patch of high degree: see qi_local.h.
typedef struct {
    float most[3][5];
} PieceFourth;

// One class of size of the patches (classes.h): nearly always all of them.
typedef struct Accel {
    struct Accel *next; // NULL: this is the last
    bool is_class;      // one of several
    const PatchDef *defs;
    AccelPatch *patches;
    char *lines;
    PieceFourth *fourth; // of pieces of high degree; NULL: there are none
    Tree tree;           // its leaves' numbers are those of their blocks
    size_t patch_count, line_count;
} Accel;

static inline const Block *accel_block(const Accel *accel, uint32_t number) {
    return (const Block *)(accel->lines + (size_t)number * LINE);
}
static inline const Piece *accel_piece(const Accel *accel, uint32_t number) {
    return (const Piece *)(accel->lines + (size_t)number * LINE);
}
static inline uint32_t block_piece(const Block *block, uint32_t lane) {
    return block->first + LINES_OF_PIECE * lane;
}

// Cuts the patches (in parallel) and builds the tree. defs and their points must stay. total: the
// patches of all classes, which share what there may be of pieces.
void pieces_build(Arena *arena, const PatchDef *defs, size_t count, size_t total,
                  PatchPrepare prepare, Accel *accel);

// S, dS/du and dS/dv at (u,v) in [0,1]^2, about the patch's center.
void piece_eval(const AccelPatch *patch, double u, double v, Vec3 out[3]);

// ---- Frames (frame.c)

// No half size of a box is taken to be less, scene units.
#define FRAME_LEAST 1e-150

// A frame about the patch's center, scene units: row . X + shift in [-1,1] for each row.
typedef struct {
    double row[3][3], shift[3];
    double half[3];                // the box's half sizes before it was made 1
    double steep[2];               // as in Block
    double rest[2], rest_shift[2]; // as in Piece, for a = half x + rest_shift
    bool regular; // else the tangents do not span a plane, and only the box is of use
} PieceFrame;

// Of a part of a patch whose control points, about the patch's center, err by `error` in each
// coordinate.
void frame_measure(const Bezier *part, double error, PieceFrame *frame);
// What decides whether the part is cut, without the rest of its frame: half[2], and what is asked
// afterwards, the larger rest (of a part no wider than its rounding that is nothing that a cut
// makes less: then it does not count). part must stay.
typedef struct {
    const Bezier *part;
    Vec3 from, axes[3];
    double wide, half;
    bool regular;
} FrameWeight;
void frame_weigh(const Bezier *part, double error, FrameWeight *weight);
double frame_unevenness(const FrameWeight *weight, double goal); // of a regular one
// A box around the part.
Box frame_box(const Bezier *part, double error);
// Puts a frame into a lane, and what belongs to it into the piece. reach: no point of the block's
// box, nor a ray's origin in its test, is farther from the block's center than that, tree units.
void frame_to_lane(const PieceFrame *frame, const Bezier *part, const Tree *tree, Vec3 patch_center,
                   double reach, Block *block, int lane, Piece *piece);

#endif
