// SPDX-License-Identifier: MIT
// The bounding box of an object as POV-Ray keeps it: a low corner and lengths in single precision,
// a box around the eight corners once a matrix is involved (facts: sdl 2.5, 9; measured with
// min_extent and max_extent).
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

// The rotation that takes the z axis to the unit vector axis, about an axis in the plane z = 0.
static Transform axis_rotation(Vec3 axis) {
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

// A box around the z axis, set up at `origin` along `axis`.
static Box axial_box(Vec3 origin, Vec3 axis, double radius, double low, double high) {
    Transform place = transform_translate(origin), turn = axis_rotation(axis);
    Transform t = transform_compose(&turn, &place);
    return transformed_box((Box){vec3(-radius, -radius, low), vec3(radius, radius, high)}, &t);
}

static Box cone_box(const ConeShape *cone) {
    Vec3 axis = vec_sub(cone->apex, cone->base);
    double length = vec_length(axis);
    double radius = fmax(fabs(cone->base_radius), fabs(cone->apex_radius));
    return axial_box(cone->base, vec_scale(axis, 1.0 / length), radius, 0, length);
}

// POV-Ray gives a disc a thickness.
static const double DISC_HALF = 1e-3;

static Box leaf_box(const Object *object) {
    switch (object->type) {
    case OBJECT_SPHERE: {
        const SphereShape *s = &object->shape.sphere;
        Vec3 r = vec3(s->radius, s->radius, s->radius);
        return (Box){vec_sub(s->center, r), vec_add(s->center, r)};
    }
    case OBJECT_BOX:
        return (Box){object->shape.box.low, object->shape.box.high};
    case OBJECT_CYLINDER:
    case OBJECT_CONE:
        return cone_box(&object->shape.cone);
    case OBJECT_TORUS: {
        const TorusShape *t = &object->shape.torus;
        double r = t->major + t->minor;
        return (Box){vec3(-r, -t->minor, -r), vec3(r, t->minor, r)};
    }
    case OBJECT_DISC: {
        const DiscShape *d = &object->shape.disc;
        return axial_box(d->center, d->normal, d->radius, -DISC_HALF, DISC_HALF);
    }
    case OBJECT_PATCH:
    case OBJECT_TRIANGLE: {
        bool patch = object->type == OBJECT_PATCH;
        const Vec3 *p = patch ? object->shape.patch.points : object->shape.triangle.p;
        Box box = box_empty();
        for (int i = 0; i < (patch ? 16 : 3); i++)
            box = box_extend(box, p[i]);
        return box;
    }
    case OBJECT_PLANE:
    case OBJECT_UNION:
    case OBJECT_MERGE:
        break;
    }
    return (Box){vec3(-HUGE_EXTENT, -HUGE_EXTENT, -HUGE_EXTENT),
                 vec3(HUGE_EXTENT, HUGE_EXTENT, HUGE_EXTENT)};
}

static Box box_intersect(Box a, Box b) {
    return (Box){vec_max(a.low, b.low), vec_min(a.high, b.high)};
}

static double box_volume(Box b) {
    Vec3 d = vec_sub(b.high, b.low);
    return d.x * d.y * d.z;
}

static bool list_box(const ObjectNode *list, bool together, Box *out) {
    Box all = together ? box_empty()
                       : (Box){vec3(-HUGE_EXTENT, -HUGE_EXTENT, -HUGE_EXTENT),
                               vec3(HUGE_EXTENT, HUGE_EXTENT, HUGE_EXTENT)};
    bool any = false;
    for (; list; list = list->next) {
        Box box;
        if (list->light)
            continue;
        if (!node_extent(list, &box))
            return false;
        all = together ? box_union(all, box) : box_intersect(all, box);
        any = true;
    }
    *out = any ? all : leaf_box(&(Object){.type = OBJECT_UNION});
    return true;
}

static bool whole_box(const ObjectNode *node, Box *out) {
    int keyword = node->keyword;
    if (keyword == KW_intersection)
        return list_box(node->first, false, out);
    if (keyword == KW_difference && node->first)
        return node_extent(node->first, out);
    if (!node->modelled)
        return false;
    if (node->light) {
        *out = leaf_box(&(Object){.type = OBJECT_UNION});
        return true;
    }
    if (node->object.type == OBJECT_UNION || node->object.type == OBJECT_MERGE)
        return list_box(node->first, true, out);
    *out = leaf_box(&node->object);
    if (node->object.has_transform)
        *out = transformed_box(*out, &node->object.transform);
    return true;
}

// The box of bounding or clipping bodies replaces a larger one.
static bool shrink(const ObjectNode *bodies, Box *box) {
    Box limit;
    if (!bodies)
        return true;
    if (!list_box(bodies, false, &limit))
        return false;
    if (box_volume(limit) < box_volume(*box))
        *box = limit;
    return true;
}

bool node_extent(const ObjectNode *node, Box *out) {
    Box box;
    if (!whole_box(node, &box) || !shrink(node->bounds, &box) || !shrink(node->clips, &box))
        return false;
    *out = round_box(box);
    return true;
}

bool object_extent(Converter *cv, const Value *value, Box *out) {
    (void)cv;
    return value->type == VALUE_OBJECT && node_extent(value->node, out);
}
