// SPDX-License-Identifier: MIT
// union, merge, intersection, difference, light_group (facts: sdl 4.2). What children inherit from
// them is worked out by emit.c.
#include "converter/nodes.h"

bool keyword_is_csg(int keyword) {
    return keyword == KW_union || keyword == KW_composite || keyword == KW_merge ||
           keyword == KW_intersection || keyword == KW_difference;
}

// Is it nothing but its parts, so that whatever holds it may as well hold those?
static bool is_plain_union(const ObjectNode *node) {
    const Object *object = &node->object;
    bool says_nothing = !node->texture && !node->interior_texture && !node->interior &&
                        !node->hollow_set && !node->double_set && !node->cutaway && !node->gaps &&
                        !object->no_shadow && !object->no_image && !object->no_reflection &&
                        !object->uv_mapping;
    return (node->keyword == KW_union || node->keyword == KW_composite) && says_nothing &&
           !node->bounds && !node->clips && !node->no_split;
}

// Adds the parts of a plain union, and those of the plain unions among them.
static void add_parts(Converter *cv, ObjectNode *to, ObjectNode *node) {
    object_unshare(cv, node);
    for (ObjectNode *next, *part = node->first; part; part = next) {
        next = part->next;
        if (is_plain_union(part))
            add_parts(cv, to, part);
        else
            object_add_child(cv, to, part);
    }
}

// A union that grows in a loop, `#declare U = union { object { U } ... }`, is a tree as deep as the
// loop is long. Where that becomes too deep the unions in it that are plain are made one.
static ObjectNode *made_flat(Converter *cv, ObjectNode *deep) {
    if (deep->depth + 1 < MAX_DEPTH || !is_plain_union(deep))
        return deep;
    ObjectNode *flat = object_copy(cv, deep);
    flat->first = flat->last = NULL;
    flat->late = NULL;
    flat->shared = false;
    flat->depth = 0;
    flat->below = 0;
    add_parts(cv, flat, object_copy(cv, deep));
    return flat;
}

// OBJECT*. From the second on, the children of a difference are inverted: it is the intersection
// of the first with their outsides.
void parse_csg_data(Converter *cv, ObjectNode *object) {
    uint32_t count = 0;
    for (;;) {
        ObjectNode *child = parse_object(cv);
        if (!child)
            break;
        if (object->keyword == KW_difference && count > 0 && !child->surface && !child->light)
            object_invert(cv, child);
        object->textured = object->textured || child->textured;
        object_add_child(cv, object, made_flat(cv, child));
        count++;
    }
    csg_box_begin(object);
    if (count < 2 && object->keyword != KW_light_group) {
        Loc loc = here(cv);
        warn_at(&loc, "'%s' should have at least two objects", keyword_name(object->keyword));
    }
}
