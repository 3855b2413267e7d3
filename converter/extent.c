// SPDX-License-Identifier: MIT
// The bounding box of an object as POV-Ray keeps it: a low corner and lengths in single precision,
// a box around the eight corners once a matrix is involved (facts: sdl 2.5, 9; measured with
// min_extent and max_extent). Primitives are measured when asked; the box of a CSG is made of its
// children's once, and then moves by itself, growing with every rotation.
#include "converter/nodes.h"

#include <math.h>

static const double HUGE_EXTENT = 1e10; // half the side of an infinite box

static float to_float(double v) { return (float)v; }

// Low corner and lengths are what is rounded, so the high corner is their sum.
static Box round_box(Box b) {
    Vec3 low = vec3(to_float(b.low.x), to_float(b.low.y), to_float(b.low.z));
    Vec3 size = vec3(to_float(b.high.x - b.low.x), to_float(b.high.y - b.low.y),
                     to_float(b.high.z - b.low.z));
    return (Box){low, vec_add(low, size)};
}

static Box transformed_box(Box b, const Transform *t) {
    Box out = box_empty();
    for (int i = 0; i < 8; i++) {
        Vec3 corner = vec3(i & 1 ? b.high.x : b.low.x, i & 2 ? b.high.y : b.low.y,
                           i & 4 ? b.high.z : b.low.z);
        out = box_extend(out, transform_point(t, corner));
    }
    return out;
}

Transform axis_rotation(Vec3 axis) {
    Vec3 about = vec3(-axis.y, axis.x, 0);
    double angle = acos(fmax(-1.0, fmin(1.0, axis.z)));
    if (fabs(axis.z) > 1.0 - 1e-10) {
        about = vec3(1, 0, 0);
        angle = axis.z < 0 ? M_PI : 0.0;
    }
    about = vec_normalize(about);
    double c = cos(angle), s = sin(angle), k = 1.0 - c;
    const double rows[4][3] = {{about.x * about.x * k + c, about.x * about.y * k + about.z * s,
                                about.x * about.z * k - about.y * s},
                               {about.x * about.y * k - about.z * s, about.y * about.y * k + c,
                                about.y * about.z * k + about.x * s},
                               {about.x * about.z * k + about.y * s,
                                about.y * about.z * k - about.x * s, about.z * about.z * k + c},
                               {0, 0, 0}};
    Transform t = transform_identity();
    transform_matrix(rows, &t);
    return t;
}

// A box around the z axis, set up at `origin` along `axis`, then moved with the object.
static Box axial_box(const Object *object, Vec3 origin, Vec3 axis, double radius, double low,
                     double high) {
    Transform place = transform_translate(origin), t = axis_rotation(axis);
    t = transform_compose(&t, &place);
    if (object->has_transform)
        t = transform_compose(&t, &object->transform);
    Box box = {vec3(-radius, -radius, low), vec3(radius, radius, high)};
    return transformed_box(object->type == OBJECT_DISC ? round_box(box) : box, &t);
}

// POV-Ray's axis ends where the radius is larger, at the base when the radii are equal; the four
// corners around it turn with its direction.
static Box cone_box(const Object *object) {
    const ConeShape *cone = &object->shape.cone;
    bool to_apex = fabs(cone->apex_radius) > fabs(cone->base_radius);
    Vec3 start = to_apex ? cone->base : cone->apex, end = to_apex ? cone->apex : cone->base;
    Vec3 axis = vec_sub(end, start);
    double length = vec_length(axis);
    double radius = fmax(fabs(cone->base_radius), fabs(cone->apex_radius));
    return axial_box(object, start, vec_scale(axis, 1.0 / length), radius, 0, length);
}

static Box points_box(const Vec3 *points, int count) {
    Box box = box_empty();
    for (int i = 0; i < count; i++)
        box = box_extend(box, points[i]);
    return box;
}

// Without the object's transform, for the types that have one only now and then.
static Box local_box(const Object *object) {
    if (object->type == OBJECT_SPHERE) {
        const SphereShape *s = &object->shape.sphere;
        Vec3 r = vec3(s->radius, s->radius, s->radius);
        return (Box){vec_sub(s->center, r), vec_add(s->center, r)};
    }
    if (object->type == OBJECT_TORUS) {
        const TorusShape *t = &object->shape.torus;
        double r = t->major + t->minor;
        return (Box){vec3(-r, -t->minor, -r), vec3(r, t->minor, r)};
    }
    return (Box){object->shape.box.low, object->shape.box.high};
}

static Box infinite_box(void) {
    return (Box){vec3(-HUGE_EXTENT, -HUGE_EXTENT, -HUGE_EXTENT),
                 vec3(HUGE_EXTENT, HUGE_EXTENT, HUGE_EXTENT)};
}

// POV-Ray gives a disc a thickness.
static const double DISC_HALF = 1e-3;

static Box leaf_box(const ObjectNode *node) {
    const Object *object = &node->object;
    switch (object->type) {
    case OBJECT_SPHERE:
    case OBJECT_BOX:
    case OBJECT_TORUS: {
        Box box = local_box(object);
        if (!object->has_transform)
            return box;
        box = round_box(box);
        return transformed_box(box, &object->transform);
    }
    case OBJECT_CYLINDER:
    case OBJECT_CONE:
        return cone_box(object);
    case OBJECT_DISC: {
        const DiscShape *d = &object->shape.disc;
        return axial_box(object, d->center, d->normal, d->radius, -DISC_HALF, DISC_HALF);
    }
    case OBJECT_PATCH:
        return points_box(object->shape.patch.points, 16);
    case OBJECT_TRIANGLE: {
        Box box = points_box(object->shape.triangle.p, 3);
        Vec3 little = vec3(1e-10, 1e-10, 1e-10);
        return (Box){vec_sub(box.low, little), vec_add(box.high, little)};
    }
    case OBJECT_PLANE:
    case OBJECT_UNION:
    case OBJECT_MERGE:
    case OBJECT_INTERSECTION:
        break;
    case OBJECT_SMOOTH_TRIANGLE:
        return points_box(object->shape.smooth_triangle.p, 3);
    default: {
        Box box;
        if (moved_extent(object, &box))
            return box;
        box = solid_extent(node);
        return object->has_transform && box.high.x < HUGE_EXTENT
                   ? transformed_box(round_box(box), &object->transform)
                   : box;
    }
    }
    return infinite_box();
}

static Box box_intersect(Box a, Box b) {
    return (Box){vec_max(a.low, b.low), vec_min(a.high, b.high)};
}

static double box_volume(Box b) {
    Vec3 d = vec_sub(b.high, b.low);
    return d.x * d.y * d.z;
}

// POV-Ray's flag: planes and surfaces never have it.
static bool is_flipped(const ObjectNode *node) {
    if (object_is_tree(&node->object))
        return node->flipped;
    return node->object.inverse && !node->surface;
}

// The box around all.
static bool joint_box(const ObjectNode *list, Box *out) {
    *out = box_empty();
    bool any = false;
    for (; list; list = list->next) {
        Box box;
        if (!node_extent(list, &box))
            return false;
        *out = box_union(*out, box);
        any = true;
    }
    if (!any)
        *out = infinite_box();
    return true;
}

// A plane across an axis ends there, as a member of an intersection.
static Box plane_box(const PlaneShape *plane) {
    Box box = infinite_box();
    double n[3] = {plane->normal.x, plane->normal.y, plane->normal.z};
    double *low = &box.low.x, *high = &box.high.x;
    for (int i = 0; i < 3; i++) {
        if (!(fabs(n[(i + 1) % 3]) < 1e-10 && fabs(n[(i + 2) % 3]) < 1e-10))
            continue;
        if (n[i] > 0)
            high[i] = plane->distance;
        else
            low[i] = -plane->distance;
    }
    return box;
}

// What all have in common; those that are inverted do not count.
static bool common_box(const ObjectNode *list, bool members, Box *out) {
    *out = infinite_box();
    for (; list; list = list->next) {
        Box box;
        const Object *object = &list->object;
        if (list->light || is_flipped(list) || (members && object->type == OBJECT_HEIGHT_FIELD))
            continue;
        if (!node_extent(list, &box))
            return false;
        if (members && object->type == OBJECT_PLANE)
            box = plane_box(&object->shape.plane);
        *out = box_intersect(*out, box);
    }
    return true;
}

// The box of bounding or clipping bodies replaces a larger one.
static bool shrink(const ObjectNode *bodies, Box *box) {
    Box limit;
    if (!bodies)
        return true;
    if (!common_box(bodies, false, &limit))
        return false;
    if (box_volume(limit) < box_volume(*box))
        *box = limit;
    return true;
}

// POV-Ray gives up boxes that are empty or too large.
static const double CRITICAL_LENGTH = 1e6;

static Box sound_box(Box box) {
    Vec3 size = vec_sub(box.high, box.low);
    bool empty = size.x < 0 || size.y < 0 || size.z < 0;
    if (empty || fmax(size.x, fmax(size.y, size.z)) > CRITICAL_LENGTH)
        return infinite_box();
    return box;
}

// Meshes and quadrics move the box that they had at first.
void extent_begin(ObjectNode *node) {
    node->has_box = true;
    node->box = round_box(solid_extent(node));
}

void csg_box_begin(ObjectNode *node) {
    Box box;
    bool all = node->keyword == KW_intersection || node->keyword == KW_difference;
    node->has_box = all ? common_box(node->first, true, &box) : joint_box(node->first, &box);
    if (node->has_box)
        node->box = round_box(sound_box(box));
}

// Most leaves are measured anew, as if there were no bounds.
void extent_move(ObjectNode *node, const Move *move) {
    node->boxed = false;
    node->clip_box =
        node->clips && (node->object.type == OBJECT_PLANE || node->object.type == OBJECT_POLY);
    if (node->has_box)
        node->box = round_box(box_intersect(transformed_box(node->box, &move->t), infinite_box()));
}

void extent_bound(ObjectNode *node) {
    // These are measured once more when all of their own statement has been read.
    bool anew = !node->ended &&
                (node->object.type == OBJECT_BLOB || node->object.type == OBJECT_HEIGHT_FIELD);
    node->ended = true;
    node->boxed = !anew && (node->bounds || node->clips);
    if (node->has_box)
        node->has_box = shrink(node->bounds, &node->box) && shrink(node->clips, &node->box);
}

bool node_extent(const ObjectNode *node, Box *out) {
    *out = node->box;
    if (node->has_box)
        return true;
    if (!node->modelled || (object_is_tree(&node->object) && !node->light))
        return false;
    Box box;
    if (node->clip_box && !node_extent(node->clips, &box))
        return false;
    if (!node->clip_box)
        box = node->light ? infinite_box() : leaf_box(node);
    if (node->boxed && (!shrink(node->bounds, &box) || !shrink(node->clips, &box)))
        return false;
    *out = round_box(box);
    return true;
}

// A body that clips has the box of what it holds, unless something in it is inverted.
static bool bodies_cut(const ObjectNode *list) {
    for (; list; list = list->next)
        if (!is_flipped(list) && node_extent_cuts(list))
            return true;
    return false;
}

// A disc's inside is the half space behind it, a height field's goes on below: out of their boxes,
// to which POV-Ray keeps an intersection with them.
static bool inside_leaves_box(const ObjectNode *node) {
    if (!object_is_tree(&node->object))
        return node->object.type == OBJECT_DISC || node->object.type == OBJECT_HEIGHT_FIELD;
    for (const ObjectNode *child = node->first; child; child = child->next)
        if (!is_flipped(child) && inside_leaves_box(child))
            return true;
    return false;
}

bool node_extent_cuts(const ObjectNode *node) {
    if (node->light)
        return false;
    if (node->bounds || (node->clips && node->object.type == OBJECT_PATCH))
        return true;
    if (bodies_cut(node->clips) || (node->clip_box && node->clips && is_flipped(node->clips)))
        return true;
    if (!object_is_tree(&node->object))
        return false;
    if (node->flipped)
        return true;
    bool all = node->keyword == KW_intersection || node->keyword == KW_difference;
    for (const ObjectNode *child = node->first; child; child = child->next)
        if (all ? !is_flipped(child) && (inside_leaves_box(child) || node_extent_cuts(child))
                : is_flipped(child) || node_extent_cuts(child))
            return true;
    return false;
}

bool object_extent(Converter *cv, const Value *value, Box *out) {
    (void)cv;
    if (value->type != VALUE_OBJECT || !node_extent(value->node, out))
        return false;
    // POV-Ray adds low corner and lengths in single precision.
    out->high = vec3(to_float(out->high.x), to_float(out->high.y), to_float(out->high.z));
    return true;
}
