// SPDX-License-Identifier: MIT
// Names and what they stand for (facts: sdl 3.1). Every spelling is interned once and has a number.
// Scopes are dynamic: a name has a stack of bindings, the innermost active include or macro call on
// top, so looking up is one step and leaving a scope pops its own bindings.
#include "converter/language.h"

#include "base/hash.h"

#include <string.h>

typedef struct {
    const char *text;
    size_t length;
    Symbol *innermost;
} Name;

typedef struct {
    LIST(Name) names; // number 0 is no name
    uint32_t *slots;  // hash table of numbers, 0 = empty
    size_t slot_count;
    LIST(Symbol *) scopes; // the newest binding of each
    Symbol *spare;
} Symbols;

void *list_grow(Converter *cv, void *items, size_t count, size_t *capacity, size_t item_size) {
    size_t wanted = *capacity ? *capacity * 2 : 16;
    void *grown = arena_array(cv->arena, wanted, item_size);
    if (count)
        memcpy(grown, items, count * item_size);
    *capacity = wanted;
    return grown;
}

static Symbols *table(const Converter *cv) { return cv->symbols; }

static Symbols *table_made(Converter *cv) {
    if (!cv->symbols) {
        Symbols *s = ARENA_NEW(cv->arena, Symbols);
        s->slot_count = 1024;
        s->slots = ARENA_ARRAY(cv->arena, uint32_t, s->slot_count);
        list_push(cv, &s->names, (Name){0});
        list_push(cv, &s->scopes, NULL);
        cv->symbols = s;
    }
    return cv->symbols;
}

static size_t hash_text(const char *text, size_t length) {
    uint64_t h = hash_bytes(HASH_START, text, length);
    return (size_t)(h ^ (h >> 29));
}

static uint32_t *find_slot(Symbols *s, const char *text, size_t length) {
    size_t mask = s->slot_count - 1;
    for (size_t i = hash_text(text, length) & mask;; i = (i + 1) & mask) {
        const Name *name = &s->names.items[s->slots[i]];
        if (!s->slots[i] || (name->length == length && memcmp(name->text, text, length) == 0))
            return &s->slots[i];
    }
}

static void grow_slots(Converter *cv, Symbols *s) {
    s->slot_count *= 2;
    s->slots = ARENA_ARRAY(cv->arena, uint32_t, s->slot_count);
    for (uint32_t i = 1; i < s->names.count; i++)
        *find_slot(s, s->names.items[i].text, s->names.items[i].length) = i;
}

uint32_t name_intern(Converter *cv, const char *text, size_t length) {
    Symbols *s = table_made(cv);
    uint32_t *slot = find_slot(s, text, length);
    if (*slot)
        return *slot;
    char *copy = arena_alloc(cv->arena, length + 1);
    memcpy(copy, text, length);
    uint32_t number = (uint32_t)s->names.count;
    *slot = number;
    list_push(cv, &s->names, ((Name){.text = copy, .length = length}));
    if (s->names.count * 2 > s->slot_count)
        grow_slots(cv, s);
    return number;
}

const char *name_text(const Converter *cv, uint32_t name) {
    return table(cv)->names.items[name].text;
}

Symbol *name_symbol(const Converter *cv, uint32_t name) {
    return table(cv)->names.items[name].innermost;
}

uint32_t name_count(const Converter *cv) { return (uint32_t)table(cv)->names.count; }

int scope_level(const Converter *cv) { return (int)table(cv)->scopes.count - 1; }

void scope_enter(Converter *cv) { list_push(cv, &table_made(cv)->scopes, NULL); }

void scope_leave(Converter *cv) {
    Symbols *s = table(cv);
    Symbol *symbol = s->scopes.items[--s->scopes.count];
    for (Symbol *next; symbol; symbol = next) {
        next = symbol->sibling;
        if (symbol->removed)
            continue; // somebody's parameter may still point to it: not used again
        s->names.items[symbol->name].innermost = symbol->shadowed;
        symbol->sibling = s->spare;
        s->spare = symbol;
    }
}

Symbol *symbol_add(Converter *cv, uint32_t name, int scope) {
    Symbols *s = table_made(cv);
    Symbol *symbol = s->spare;
    if (symbol)
        s->spare = symbol->sibling;
    else
        symbol = ARENA_NEW(cv->arena, Symbol);
    *symbol = (Symbol){.name = name, .scope = scope};
    symbol->sibling = s->scopes.items[scope];
    s->scopes.items[scope] = symbol;
    // A binding of an outer scope goes below those of the inner ones.
    Symbol **link = &s->names.items[name].innermost;
    while (*link && (*link)->scope > scope)
        link = &(*link)->shadowed;
    symbol->shadowed = *link;
    *link = symbol;
    return symbol;
}

void symbol_remove(Converter *cv, Symbol *symbol) {
    Symbol **link = &table(cv)->names.items[symbol->name].innermost;
    while (*link != symbol)
        link = &(*link)->shadowed;
    *link = symbol->shadowed;
    symbol->removed = true;
}

// One subscript in brackets, checked against the size of its dimension.
static size_t read_subscript(Converter *cv, size_t size) {
    expect(cv, '[', "array subscript");
    Loc loc = here(cv);
    double v = parse_float(cv);
    if (!(v >= -EPSILON))
        die_at(&loc, "Negative subscript %g", v);
    if (v + EPSILON >= (double)size)
        die_at(&loc, "Array subscript out of range: %g, but the elements are 0 to %zu", v,
               size - 1);
    expect(cv, ']', "array subscript");
    return (size_t)(v + EPSILON);
}

static void warn_deprecated(Converter *cv, const Token *token, Symbol *symbol) {
    Loc loc = token_loc(cv, token);
    if (symbol->deprecation)
        warn_at(&loc, "%s", symbol->deprecation);
    else
        warn_at(&loc, "Identifier '%s' was declared deprecated", token->text);
    symbol->deprecated = !symbol->deprecated_once;
}

Place resolve_place(Converter *cv, const Token *token, bool want_unset) {
    Place place = {.symbol = name_symbol(cv, token->name)};
    if (!place.symbol)
        return place;
    place.value = place.symbol->target ? place.symbol->target : &place.symbol->value;
    place.array = place.symbol->target_array;
    if (place.symbol->deprecated && !want_unset)
        warn_deprecated(cv, token, place.symbol);
    for (const Token *next;
         place.value->type == VALUE_ARRAY && (next = raw_peek(cv)) && next->code == '[';) {
        Array *array = place.value->node;
        enter_level(cv);
        bool held = release_directives(cv);
        size_t index = 0;
        for (int d = 0; d < array->dimensions; d++)
            index = index * array->sizes[d] + read_subscript(cv, array->sizes[d]);
        restore_directives(cv, held);
        leave_level(cv);
        place.array = array;
        place.value = &array->items[index];
        if (place.value->type == VALUE_NONE && !want_unset) {
            Loc loc = token_loc(cv, token);
            die_at(&loc, "Attempt to access uninitialized array element %s[...]", token->text);
        }
    }
    return place;
}

void place_assign(Converter *cv, const Place *place, const Value *value, const Loc *loc) {
    (void)cv;
    ValueType old = place->value->type;
    if (old == VALUE_FUNCTION)
        die_at(loc, "Redeclaring functions is not allowed - #undef the function first");
    if (old == VALUE_MACRO || old == VALUE_FILE)
        die_at(loc, "This name is a %s; #undef it first", value_type_name(old));
    if (place->array) {
        if (place->array->type != VALUE_NONE && place->array->type != value->type)
            die_at(loc,
                   "Attempted to redefine %s identifier as %s identifier: all elements of an "
                   "array are of one type",
                   value_type_name(place->array->type), value_type_name(value->type));
        place->array->type = value->type;
    }
    *place->value = *value;
}
