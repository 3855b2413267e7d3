// SPDX-License-Identifier: MIT
// What the two QI searches share: the ray's frame, and the list of hits found.
//
// In the ray's frame the ray is the z axis from the origin upwards, and a patch meets it where
// x = y = 0. There are two such frames:
//   FRAME_ACROSS  x and y in the plane orthogonal to the ray, z the depth: a rotation;
//   FRAME_SKEW    x and y in the plane of two coordinate axes, projected along the ray, and z along
//                 the third axis k, that of the largest |dir_k| / max |P_k - org_k|. (x, y) is then
//                 the offset from the ray's point of the same z. No axis gets more from another
//                 than it has itself, so a patch that is 1e10 times thinner in one axis, met by
//                 rays of any direction, keeps its digits.
//   FRAME_SKEW_RATIONAL  the same with room for the rounding of a rational patch's points.
// Frame units are scene units times a power of two, chosen so that no coordinate exceeds 1 by much:
// no square over- or underflows, and the change of units is exact.
#ifndef PATCH_QI_FRAME_H
#define PATCH_QI_FRAME_H

#include "patch/qi.h"

typedef enum { FRAME_ACROSS, FRAME_SKEW, FRAME_SKEW_RATIONAL } QiFrameKind;

typedef struct {
    int exponent;                     // frame units = scene units * 2^exponent
    int t_exponent;                   // t = z / length * 2^t_exponent
    double length;                    // of dir along z, scaled; > 0
    Vec3 axes[3];                     // a coordinate is axis . point, scaled
    double stretch;                   // length in space of a step of 1 in z along the ray
    double side_x, side_y;            // largest |x| and |y| of a control point
    double slack_x, slack_y, slack_z; // rounding of any point or net point derived
    double rounding;                  // of a distance in space, from all three
    double tolerance;                 // the query's, or what rounding allows
    double least_tolerance;           // what rounding allows
    double z_low, z_high;             // depths that t_min and t_max allow, rounded outwards
} QiFrame;

// Puts the patch into the ray's frame: out gets its points. False for a ray that can have no hit
// (zero or infinite direction, NaN).
bool qi_frame_init(QiFrame *frame, QiFrameKind kind, const Bezier *patch, const Ray *ray,
                   Bezier *out);
// The tolerance and depths of a query of that patch by that ray. False for one that can have no hit
// (empty ranges, NaN).
bool qi_frame_ask(QiFrame *frame, const QiQuery *query);
double qi_frame_t(const QiFrame *frame, double z);
double qi_frame_scene(const QiFrame *frame, double length); // frame units to scene units

typedef enum { QI_ALL, QI_NEAREST, QI_ANY } QiMode;

typedef struct {
    double t, z, u, v, bound; // bound in frame units
    BezierRect rect;          // the piece it was found in
    int sign;                 // of the projected Jacobian there; 0: not known
} QiFound;

// Hits found so far. QI_NEAREST and QI_ANY keep one.
typedef struct {
    QiMode mode;
    double t_min, t_max;
    int count, capacity;
    QiFound *found;
} QiList;

// Adds a hit if its t lies in the range. In QI_ALL mode it merges with earlier ones whose pieces
// touch its own, unless the signs say that the ray enters at one and leaves at the other. In the
// other modes the nearer stays.
void qi_list_add(QiList *list, QiFound found);
// Depth beyond which nothing is of interest any more.
double qi_list_z_high(const QiList *list, const QiFrame *frame);
// Is a root at that depth, or behind, as far as rounding can tell no nearer than the hit found? Of
// a ribbon across the ray, thinner than its rounding, all roots have one depth: to look for the
// least would follow the curve they are on to the last bit.
bool qi_list_no_nearer(const QiList *list, const QiFrame *frame, double z);
// QI_ANY has its hit; the hit of QI_NEAREST is as near to the range's begin as rounding can tell.
bool qi_list_done(const QiList *list, const QiFrame *frame);
// Of points on the ray at depths from `low` to `high`: are all that count within `radius` of one
// hit found, so that they are the same place? Their piece then belongs to that hit's, if they
// touch.
bool qi_list_has(QiList *list, const QiFrame *frame, double low, double high, double radius,
                 BezierRect rect);
// By increasing t, normals and scene units filled in.
int qi_list_report(QiList *list, const Bezier *patch, const double *weights, const QiFrame *frame,
                   Vec3 dir, QiStats *stats, QiSink sink, void *context);

#endif
