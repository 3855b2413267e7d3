// SPDX-License-Identifier: MIT
// Macros (facts: sdl 3.4). A definition keeps the tokens of its body; a call evaluates its
// arguments in the caller's scope, then pushes the body as a frame with a scope of its own.
#include "converter/language.h"

static bool opens_block(int code) {
    return code == KW_if || code == KW_ifdef || code == KW_ifndef || code == KW_while ||
           code == KW_for || code == KW_switch || code == KW_macro;
}

// From here to the #end that closes the macro, in the same file.
static TokenList read_body(Converter *cv, const Token *word) {
    Frame *f = cv->frame;
    TokenList body = {.items = f->tokens + f->at};
    size_t depth = 0;
    for (;;) {
        if (f->at == f->count) {
            Loc loc = token_loc(cv, word);
            die_at(&loc, "This #macro has no #end (the end of the file was reached)");
        }
        const Token *hash = raw_token(cv);
        const Token *next = raw_peek(cv);
        if (hash->code != '#' || !next)
            continue;
        raw_token(cv);
        if (opens_block(next->code))
            depth++;
        if (next->code == KW_end && depth-- == 0) {
            body.count = (size_t)(hash - body.items);
            return body;
        }
    }
}

// ( NAME [,] NAME ... )
static void read_parameters(Converter *cv, Macro *macro) {
    expect(cv, '(', "#macro");
    while (!accept(cv, ')')) {
        if (!next_is(cv, TOK_IDENTIFIER)) {
            Loc loc = here(cv);
            die_at(&loc,
                   "Expected 'identifier', %s found instead: a reserved word cannot name a "
                   "macro's parameter",
                   token_describe(cv, peek_token(cv)));
        }
        if (macro->parameter_count == MAX_PARAMETERS) {
            Loc loc = here(cv);
            die_at(&loc, "Too many parameters (%d are the limit)", MAX_PARAMETERS);
        }
        macro->parameters[macro->parameter_count++] = next_token(cv)->name;
        optional_comma(cv);
    }
}

// Macros are global wherever they are defined.
static void bind_macro(Converter *cv, Macro *macro) {
    Symbol *symbol = name_symbol(cv, macro->name);
    while (symbol && symbol->scope != 0)
        symbol = symbol->shadowed;
    if (symbol && !symbol->removed && symbol->value.type != VALUE_MACRO &&
        symbol->value.type != VALUE_NONE) {
        Loc loc = token_loc(cv, macro->header);
        die_at(&loc, "'%s' is already a %s identifier; #undef it before making it a macro",
               macro->header->text, value_type_name(symbol->value.type));
    }
    if (!symbol)
        symbol = symbol_add(cv, macro->name, 0);
    symbol->value = (Value){.type = VALUE_MACRO, .node = macro};
}

void define_macro(Converter *cv, const Token *word) {
    if (cv->version < 310) {
        Loc loc = token_loc(cv, word);
        die_at(&loc, "Macros require #version 3.1 or later but #version %d.%02d is set",
               cv->version / 100, cv->version % 100);
    }
    bool held = hold_directives(cv);
    Macro *macro = ARENA_NEW(cv->arena, Macro);
    if (!next_is(cv, TOK_IDENTIFIER))
        die_expected(cv, "the macro's name (an identifier that is no reserved word)");
    macro->header = next_token(cv);
    macro->name = macro->header->name;
    read_parameters(cv, macro);
    restore_directives(cv, held);
    macro->body = read_body(cv, word);
    bind_macro(cv, macro);
}

typedef struct {
    Value value;
    Reference reference;
} Argument;

static void read_argument(Converter *cv, const Macro *macro, size_t index, Argument *out) {
    if (!next_is(cv, ')') && parse_rvalue(cv, RVALUE_ARGUMENT, &out->value, &out->reference)) {
        optional_comma(cv);
        return;
    }
    if (!next_is(cv, ')'))
        die_expected(cv, "a macro argument");
    Loc loc = here(cv);
    die_at(&loc, "Expected %zu parameters for macro '%s' but only %zu found",
           macro->parameter_count, name_text(cv, macro->name), index);
}

static void bind_argument(Converter *cv, uint32_t name, const Argument *argument) {
    Symbol *symbol = symbol_add(cv, name, scope_level(cv));
    if (!argument->reference.place.value) {
        symbol->value = argument->value;
        return;
    }
    symbol->target = argument->reference.place.value;
    symbol->target_array = argument->reference.place.array;
}

// NAME ( argument [,] argument ... )
void call_macro(Converter *cv, const Token *name, const Macro *macro) {
    enter_level(cv);
    Argument few[8], *arguments = few;
    if (macro->parameter_count > sizeof few / sizeof *few)
        arguments = ARENA_ARRAY(cv->arena, Argument, macro->parameter_count);
    int level = scope_level(cv);
    expect(cv, '(', name_text(cv, macro->name));
    for (size_t i = 0; i < macro->parameter_count; i++) {
        arguments[i] = (Argument){.reference.outermost = level};
        read_argument(cv, macro, i, &arguments[i]);
    }
    if (!accept(cv, ')'))
        die_expected(cv,
                     arena_printf(cv->arena, "')' behind the %zu argument%s of macro '%s'",
                                  macro->parameter_count, macro->parameter_count == 1 ? "" : "s",
                                  name_text(cv, macro->name)));
    push_macro(cv, macro, name);
    for (size_t i = 0; i < macro->parameter_count; i++)
        bind_argument(cv, macro->parameters[i], &arguments[i]);
    leave_level(cv);
}
