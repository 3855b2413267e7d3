// SPDX-License-Identifier: MIT
// union, merge, intersection, difference, light_group (facts: sdl 4.2). What children inherit from
// them is worked out by emit.c.
#include "converter/nodes.h"

bool keyword_is_csg(int keyword) {
    return keyword == KW_union || keyword == KW_composite || keyword == KW_merge ||
           keyword == KW_intersection || keyword == KW_difference;
}

static void check_child(Converter *cv, const ObjectNode *parent, const ObjectNode *child,
                        const Token *token) {
    bool takes_lights = parent->keyword == KW_union || parent->keyword == KW_composite ||
                        parent->keyword == KW_light_group;
    if (child->light && !takes_lights) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "a light source cannot be part of '%s'", keyword_name(parent->keyword));
    }
}

// OBJECT*. From the second on, the children of a difference are inverted: it is the intersection
// of the first with their outsides.
void parse_csg_data(Converter *cv, ObjectNode *object) {
    uint32_t count = 0;
    for (;;) {
        const Token *token = peek_token(cv);
        ObjectNode *child = parse_object(cv);
        if (!child)
            break;
        check_child(cv, object, child, token);
        if (object->keyword == KW_difference && count > 0 && !child->surface)
            object_invert(cv, child);
        object_add_child(cv, object, child);
        count++;
    }
    csg_box_begin(object);
    if (count < 2 && object->keyword != KW_light_group) {
        Loc loc = here(cv);
        warn_at(&loc, "'%s' should have at least two objects", keyword_name(object->keyword));
    }
}
