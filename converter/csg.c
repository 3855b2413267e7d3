// SPDX-License-Identifier: MIT
// union, merge, intersection, difference, light_group (facts: sdl 4.2). What children inherit from
// them is worked out by emit.c.
#include "converter/nodes.h"

bool keyword_is_csg(int keyword) {
    return keyword == KW_union || keyword == KW_composite || keyword == KW_merge ||
           keyword == KW_intersection || keyword == KW_difference;
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
        object_add_child(cv, object, child);
        count++;
    }
    csg_box_begin(object);
    if (count < 2 && object->keyword != KW_light_group) {
        Loc loc = here(cv);
        warn_at(&loc, "'%s' should have at least two objects", keyword_name(object->keyword));
    }
}
