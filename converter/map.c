// SPDX-License-Identifier: MIT
// color_map and its like, the items of list patterns, and the maps that a pattern has when none is
// given (facts: sdl 4.6, textures 4.1, 4.3).
#include "converter/nodes.h"

bool map_keyword(int code, MapKind *kind) {
    switch (code) {
    case KW_color_map:
    case KW_colour_map:
        *kind = MAP_COLOR;
        return true;
    case KW_pigment_map:
        *kind = MAP_PIGMENT;
        return true;
    case KW_normal_map:
        *kind = MAP_NORMAL;
        return true;
    case KW_slope_map:
        *kind = MAP_SLOPE;
        return true;
    case KW_texture_map:
        *kind = MAP_TEXTURE;
        return true;
    case KW_density_map:
        *kind = MAP_DENSITY;
        return true;
    default:
        return false;
    }
}

static const char *const map_names[] = {"color_map",  "slope_map",   "pigment_map",
                                        "normal_map", "texture_map", "density_map"};
static const ValueType map_values[] = {VALUE_COLOR_MAP,  VALUE_SLOPE_MAP,   VALUE_PIGMENT_MAP,
                                       VALUE_NORMAL_MAP, VALUE_TEXTURE_MAP, VALUE_DENSITY_MAP};

// The items while they are read; the count is not known before the end.
typedef struct ItemLink {
    struct ItemLink *next;
    MapItem item;
} ItemLink;

typedef struct {
    ItemLink *first, *last;
    uint32_t count;
} ItemList;

static void add_item(Converter *cv, ItemList *list, MapItem item) {
    ItemLink *link = ARENA_NEW(cv->arena, ItemLink);
    link->item = item;
    if (list->last)
        list->last->next = link;
    else
        list->first = link;
    list->last = link;
    list->count++;
}

static int pattern_depth(const PatternNode *pattern) {
    return pattern && pattern->map ? pattern->map->depth : 0;
}

static int texture_depth(const TextureNode *texture) {
    int depth = 0;
    for (; texture; texture = texture->below) {
        const PatternNode *parts[] = {&texture->pattern, texture->pigment, texture->normal};
        for (int i = 0; i < 3; i++)
            depth = pattern_depth(parts[i]) > depth ? pattern_depth(parts[i]) : depth;
    }
    return depth;
}

const MapNode *map_create(Converter *cv, MapKind kind, const MapItem *items, uint32_t count) {
    int depth = 0;
    for (uint32_t i = 0; i < count && kind != MAP_COLOR && kind != MAP_SLOPE; i++) {
        int inner =
            kind == MAP_TEXTURE ? texture_depth(items[i].node) : pattern_depth(items[i].node);
        depth = inner > depth ? inner : depth;
    }
    check_depth(cv, depth + 1, "maps of patterns");
    MapNode map = {.kind = kind, .items = items, .count = count, .depth = depth + 1};
    return arena_copy(cv->arena, &map, sizeof map);
}

static const MapNode *finish_map(Converter *cv, MapKind kind, const ItemList *list) {
    MapItem *items = ARENA_ARRAY(cv->arena, MapItem, list->count);
    uint32_t i = 0;
    for (const ItemLink *link = list->first; link; link = link->next)
        items[i++] = link->item;
    return map_create(cv, kind, items, list->count);
}

static Color value_color(const Value *value) {
    return (Color){(float)value->c[0], (float)value->c[1], (float)value->c[2], (float)value->c[3],
                   (float)value->c[4]};
}

// [F C]; the old form [F F color C color C] is two entries. The colour may also be an expression
// of five components that begins with a number ([1 1-Red]).
static void parse_color_entry(Converter *cv, ItemList *list, float first) {
    if (starts_color(cv)) {
        add_item(cv, list, (MapItem){.value = first, .color = parse_color(cv)});
        return;
    }
    if (!starts_expression(cv) || next_is(cv, '<'))
        die_expected(cv, "a colour");
    Loc loc = here(cv);
    Value value = parse_value(cv);
    if (value.type == VALUE_COLOR) {
        add_item(cv, list, (MapItem){.value = first, .color = value_color(&value)});
        return;
    }
    if (value.type != VALUE_FLOAT)
        die_at(&loc, "expected a colour or a second position, found %s",
               value_type_name(value.type));
    optional_comma(cv);
    for (int i = 0; i < 2; i++) {
        if (!starts_color(cv))
            die_expected(cv, "a colour");
        float position = i == 0 ? first : (float)value.c[0];
        add_item(cv, list, (MapItem){.value = position, .color = parse_color(cv)});
        optional_comma(cv);
    }
}

static const void *parse_entry_body(Converter *cv, MapKind kind) {
    const TextureNode *standard = cv->nodes->default_texture;
    switch (kind) {
    case MAP_PIGMENT:
        return parse_pigment_body(cv, standard->pigment);
    case MAP_NORMAL:
        return parse_normal_body(cv, standard->normal);
    case MAP_TEXTURE:
        return parse_texture_body(cv);
    case MAP_DENSITY:
        return parse_density_body(cv, NULL);
    case MAP_COLOR:
    case MAP_SLOPE:
        break;
    }
    return NULL;
}

// POV-Ray divides by the sum of the weights.
static void check_weights(Converter *cv, ItemList *list) {
    float sum = 0;
    for (const ItemLink *link = list->first; link; link = link->next)
        sum += link->item.value;
    if (sum != 0)
        return;
    Loc loc = here(cv);
    warn_at(&loc, "the weights of this average add up to 0: all are taken for 1");
    for (ItemLink *link = list->first; link; link = link->next)
        link->item.value = 1;
}

const MapNode *parse_map(Converter *cv, MapKind kind, bool average) {
    const char *name = map_names[kind];
    ItemList list = {0};
    enter_level(cv);
    expect(cv, '{', name);
    const Value *value = accept_value(cv, map_values[kind]);
    const MapNode *map = value ? value->node : NULL;
    while (!map && accept(cv, '[')) {
        float position = 1;
        if (!average || starts_expression(cv))
            position = (float)parse_float(cv);
        optional_comma(cv);
        if (kind == MAP_COLOR)
            parse_color_entry(cv, &list, position);
        else if (kind == MAP_SLOPE)
            add_item(cv, &list, (MapItem){.value = position, .slope = parse_uv(cv)});
        else
            add_item(cv, &list, (MapItem){.value = position, .node = parse_entry_body(cv, kind)});
        expect(cv, ']', name);
    }
    if (!map && list.count == 0)
        die_expected(cv, "'['");
    if (average && !map)
        check_weights(cv, &list);
    expect(cv, '}', name);
    leave_level(cv);
    return map ? map : finish_map(cv, kind, &list);
}

// ---- lists -------------------------------------------------------------------------------------

static const MapItem checker_colors[] = {
    {.value = 0, .color = {0, 0, 1, 0, 0}},
    {.value = 1, .color = {0, 1, 0, 0, 0}},
    {.value = 2, .color = {1, 0, 0, 0, 0}}, // hexagon
};
static const MapItem brick_colors[] = {
    {.value = 0, .color = {0.5F, 0.5F, 0.5F, 0, 0}},
    {.value = 1, .color = {0.6F, 0.15F, 0.15F, 0, 0}},
};
static const MapItem cubic_colors[] = {
    {.value = 0, .color = {1, 0, 0, 0, 0}}, {.value = 1, .color = {0, 1, 0, 0, 0}},
    {.value = 2, .color = {0, 0, 1, 0, 0}}, {.value = 3, .color = {1, 1, 0, 0, 0}},
    {.value = 4, .color = {0, 1, 1, 0, 0}}, {.value = 5, .color = {1, 0, 1, 0, 0}},
};
static const MapItem bozo_colors[] = {
    {.value = 0.4F, .color = {1, 1, 1, 0, 0}}, {.value = 0.4F, .color = {0, 1, 0, 0, 0}},
    {.value = 0.6F, .color = {0, 1, 0, 0, 0}}, {.value = 0.6F, .color = {0, 0, 1, 0, 0}},
    {.value = 0.8F, .color = {0, 0, 1, 0, 0}}, {.value = 0.8F, .color = {1, 0, 0, 0, 0}},
};
static const MapItem wood_colors[] = {
    {.value = 0.6F, .color = {0.666F, 0.312F, 0.2F, 0, 0}},
    {.value = 0.6F, .color = {0.4F, 0.1333F, 0.066F, 0, 0}},
};
static const MapItem mandel_colors[] = {
    {.value = 0.001F, .color = {0, 0, 0, 0, 0}}, {.value = 0.001F, .color = {0, 1, 1, 0, 0}},
    {.value = 0.012F, .color = {1, 1, 0, 0, 0}}, {.value = 0.015F, .color = {1, 0, 1, 0, 0}},
    {.value = 0.1F, .color = {0, 1, 1, 0, 0}},
};
static const MapItem agate_colors[] = {
    {.value = 0, .color = {1, 1, 1, 0, 0}},
    {.value = 0.5F, .color = {0.95F, 0.75F, 0.5F, 0, 0}},
    {.value = 0.5F, .color = {0.9F, 0.7F, 0.5F, 0, 0}},
    {.value = 0.6F, .color = {0.9F, 0.7F, 0.4F, 0, 0}},
    {.value = 0.6F, .color = {1, 0.7F, 0.4F, 0, 0}},
    {.value = 1, .color = {0.6F, 0.3F, 0, 0, 0}},
};
static const MapItem radial_colors[] = {
    {.value = 0, .color = {0, 1, 1, 0, 0}},
    {.value = 0.333F, .color = {1, 1, 0, 0, 0}},
    {.value = 0.666F, .color = {1, 0, 1, 0, 0}},
    {.value = 1, .color = {0, 1, 1, 0, 0}},
};
static const MapItem marble_colors[] = {
    {.value = 0, .color = {0.9F, 0.8F, 0.8F, 0, 0}},
    {.value = 0.9F, .color = {0.9F, 0.08F, 0.08F, 0, 0}},
    {.value = 0.9F, .color = {0, 0, 0, 0, 0}},
};
static const MapItem grey_colors[] = {
    {.value = 0, .color = {0, 0, 0, 0, 0}},
    {.value = 1, .color = {1, 1, 1, 0, 0}},
};

#define COUNT(items) ((uint32_t)(sizeof(items) / sizeof *(items)))

static MapNode default_colors(const PatternInfo *info) {
    switch (info->keyword) {
    case KW_checker:
    case KW_object:
    case KW_hexagon:
        return (MapNode){.items = checker_colors, .count = (uint32_t)info->list};
    case KW_brick:
        return (MapNode){.items = brick_colors, .count = COUNT(brick_colors)};
    case KW_square:
    case KW_triangular:
    case KW_cubic:
        return (MapNode){.items = cubic_colors, .count = (uint32_t)info->list};
    case KW_bozo:
        return (MapNode){.items = bozo_colors, .count = COUNT(bozo_colors)};
    case KW_wood:
        return (MapNode){.items = wood_colors, .count = COUNT(wood_colors)};
    case KW_mandel:
        return (MapNode){.items = mandel_colors, .count = COUNT(mandel_colors)};
    case KW_agate:
        return (MapNode){.items = agate_colors, .count = COUNT(agate_colors)};
    case KW_radial:
        return (MapNode){.items = radial_colors, .count = COUNT(radial_colors)};
    case KW_marble:
        return (MapNode){.items = marble_colors, .count = COUNT(marble_colors)};
    default:
        return (MapNode){.items = grey_colors, .count = COUNT(grey_colors)};
    }
}

const MapNode *map_default(Converter *cv, const PatternInfo *info) {
    MapNode map = default_colors(info);
    return arena_copy(cv->arena, &map, sizeof map);
}

static const void *default_item(Converter *cv, MapKind kind) {
    const TextureNode *standard = cv->nodes->default_texture;
    switch (kind) {
    case MAP_PIGMENT:
    case MAP_DENSITY:
        return standard->pigment;
    case MAP_NORMAL:
        return standard->normal;
    case MAP_TEXTURE:
        return standard;
    case MAP_COLOR:
    case MAP_SLOPE:
        break;
    }
    return NULL;
}

static const void *parse_list_block(Converter *cv, PatternUse use) {
    const TextureNode *standard = cv->nodes->default_texture;
    switch (use) {
    case USE_PIGMENT:
        return parse_pigment_block(cv, standard->pigment);
    case USE_NORMAL:
        return parse_normal_block(cv, standard->normal);
    case USE_TEXTURE:
        return parse_texture_block(cv);
    case USE_DENSITY:
        return parse_density_block(cv);
    }
    return NULL;
}

static bool starts_list_color(Converter *cv, PatternUse use) {
    return (use == USE_PIGMENT || use == USE_DENSITY) &&
           (starts_color(cv) || starts_expression(cv));
}

// { C }* or { pigment{} }* (texture{}, normal{}, density{}); the rest comes from the defaults.
// NULL: not one item stands there.
const MapNode *parse_pattern_list(Converter *cv, PatternUse use, const PatternInfo *info) {
    static const int keywords[] = {KW_pigment, KW_normal, KW_texture, KW_density};
    static const MapKind kinds[] = {MAP_PIGMENT, MAP_NORMAL, MAP_TEXTURE, MAP_DENSITY};
    uint32_t limit = (uint32_t)info->list;
    ItemList list = {0};
    optional_comma(cv);
    MapKind kind = starts_list_color(cv, use) ? MAP_COLOR : kinds[use];
    while (list.count < limit) {
        MapItem item = {.value = (float)list.count};
        if (kind == MAP_COLOR && starts_list_color(cv, use))
            item.color = parse_color(cv);
        else if (kind != MAP_COLOR && accept(cv, keywords[use]))
            item.node = parse_list_block(cv, use);
        else
            break;
        add_item(cv, &list, item);
        optional_comma(cv);
    }
    if (list.count == 0 && use != USE_TEXTURE)
        return NULL;
    MapNode colors = default_colors(info);
    while (list.count < limit) {
        MapItem item = {.value = (float)list.count};
        if (kind == MAP_COLOR)
            item.color = colors.items[list.count].color;
        else
            item.node = default_item(cv, kind);
        add_item(cv, &list, item);
    }
    return finish_map(cv, kind, &list);
}
