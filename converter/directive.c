// SPDX-License-Identifier: MIT
// Directives other than conditionals and loops (facts: sdl 3). Each is run when the next token is
// asked for and its '#' comes up; it leaves the stream at the token after it.
#include "converter/language.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

// ---- names ------------------------------------------------------------------------------------

// The name after #declare and its like; directives are held.
static const Token *expect_name(Converter *cv) {
    const Token *token = peek_token(cv);
    if (token->code != TOK_IDENTIFIER) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "Expected 'identifier', %s found instead%s", token_describe(cv, token),
               token->code >= KW_FIRST ? " (reserved words cannot be declared)" : "");
    }
    return next_token(cv);
}

// ( NAME [subscripts] ): is there a value? Any word may stand there; reserved ones have none.
bool place_is_set(Converter *cv) {
    bool held = hold_directives(cv);
    expect(cv, '(', "defined");
    const Token *token = next_token(cv);
    bool set = false;
    if (token->code == TOK_IDENTIFIER) {
        Place place = resolve_place(cv, token, true);
        set = place.symbol && (!place.array || place.value->type != VALUE_NONE);
    }
    expect(cv, ')', "defined");
    restore_directives(cv, held);
    return set;
}

// ---- #declare, #local, #undef -----------------------------------------------------------------

typedef struct {
    bool given, once;
    const char *message;
} Deprecation;

// deprecated [once] [S]
static Deprecation parse_deprecation(Converter *cv) {
    Deprecation d = {.given = accept(cv, KW_deprecated)};
    if (!d.given)
        return d;
    d.once = accept(cv, KW_once);
    if (next_is(cv, TOK_STRING))
        d.message = parse_string(cv);
    return d;
}

// Where the value goes: the place the name stands for, or a new binding. #local wants one of the
// innermost scope, #declare takes any visible one and else makes a global one.
static Place target_place(Converter *cv, const Token *name, bool local) {
    Place place = resolve_place(cv, name, true);
    if (place.symbol && (!local || place.symbol->scope == scope_level(cv)))
        return place;
    place = (Place){.symbol = symbol_add(cv, name->name, local ? scope_level(cv) : 0)};
    place.value = &place.symbol->value;
    return place;
}

static void run_declare(Converter *cv, bool local) {
    if (quick_declare(cv, local))
        return;
    bool held = hold_directives(cv);
    Deprecation deprecation = parse_deprecation(cv);
    const Token *name = expect_name(cv);
    Loc loc = token_loc(cv, name);
    Place place = target_place(cv, name, local);
    if (place.value->type == VALUE_MACRO)
        die_at(&loc, "'%s' is a macro and cannot be declared; #undef it first", name->text);
    const ValueType before = place.value->type;
    expect(cv, '=', "#declare");
    Value value;
    if (!parse_rvalue(cv, RVALUE_DECLARE, &value, NULL)) {
        restore_directives(cv, false);
        die_expected(cv, "a value for #declare");
    }
    const Value *now = place.value; // what the value declared may be here already
    if (now->type == VALUE_FUNCTION && before != VALUE_FUNCTION)
        warn_at(&loc, "'%s' stays the function that was declared amid its value", name->text);
    else
        place_assign(cv, &place, &value, &loc);
    if (deprecation.given) {
        place.symbol->deprecated = true;
        place.symbol->deprecated_once = deprecation.once;
        place.symbol->deprecation = deprecation.message;
    }
    accept(cv, ';'); // after numbers it is the second, which POV-Ray tolerates
    restore_directives(cv, held);
}

static void run_undef(Converter *cv) {
    bool held = hold_directives(cv);
    const Token *name = expect_name(cv);
    Place place = resolve_place(cv, name, true);
    if (!place.symbol) {
        Loc loc = token_loc(cv, name);
        warn_at(&loc, "Attempt to undef unknown identifier '%s'", name->text);
    } else if (place.array && place.value != place.symbol->target) {
        *place.value = (Value){0};
    } else {
        symbol_remove(cv, place.symbol);
    }
    restore_directives(cv, held);
}

// ---- #include, #version, #default -------------------------------------------------------------

static void run_include(Converter *cv, const Token *word) {
    const Token *at = peek_token(cv);
    Loc loc = token_loc(cv, at);
    if (at->code == TOK_IDENTIFIER && peek_value_type(cv) == VALUE_NONE)
        die_at(&loc, "The name of an include file stands in quotes: \"%s...\"", at->text);
    const char *name = parse_file_name(cv);
    (void)word;
    push_file(cv, source_open(cv, name, FILE_INCLUDE, &loc), at);
}

int effective_version(const Converter *cv) { return cv->version_set ? cv->version : 362; }

// version [unofficial] F [;]
static void run_version(Converter *cv) {
    bool held = hold_directives(cv);
    const Token *token = peek_token(cv);
    if (token->code == TOK_IDENTIFIER && strcmp(token->text, "unofficial") == 0)
        next_token(cv);
    token = peek_token(cv);
    Loc loc = token_loc(cv, token);
    double version = parse_float(cv) * 100 + 0.5;
    if (!(version < 371))
        die_at(&loc, "This file requires POV-Ray version %.2f; 3.7 is what is understood here",
               (version - 0.5) / 100);
    cv->version = version > INT_MIN ? (int)version : INT_MIN;
    cv->version_set = true;
    if (!cv->noise_generator_set)
        cv->noise_generator = cv->version >= 350 ? 2 : 1;
    if (!accept(cv, ';') && cv->version >= 310) {
        Loc end = token_loc(cv, cv->language->last);
        warn_at(&end, "#version should end with a semi-colon ';'");
    }
    restore_directives(cv, held);
}

// ---- #debug, #warning, #error -----------------------------------------------------------------

// Line ends inside become blanks, at the end they go.
static const char *one_line(Converter *cv, const char *text) {
    char *line = arena_strdup(cv->arena, text);
    size_t length = strlen(line);
    while (length && (line[length - 1] == '\n' || line[length - 1] == ' '))
        line[--length] = '\0';
    for (char *p = line; *p; p++)
        *p = *p == '\n' || *p == '\r' ? ' ' : *p;
    return line;
}

static void run_message(Converter *cv, const Token *word) {
    Loc loc = token_loc(cv, word);
    const char *text = string_for_output(cv, parse_string(cv));
    switch (word->code) {
    case KW_error:
        die_at(&loc, "#error: %s", one_line(cv, text));
    case KW_warning:
        warn_each_at(&loc, "#warning: %s", one_line(cv, text));
        return;
    case KW_debug:
        break;
    default:
        warn_at(&loc, "#%s streams are not available: read as #debug", word->text);
    }
    debug_text(cv, text);
}

// ---- all --------------------------------------------------------------------------------------

_Noreturn static void die_unknown(Converter *cv, const Token *hash, const Token *word) {
    Loc loc = token_loc(cv, word ? word : hash);
    die_at(&loc, "Expected 'object or directive', %s found after '#'%s",
           word ? token_describe(cv, word) : "end of file", word ? spelling_hint(cv, word) : "");
}

static void run_plain(Converter *cv, const Token *word) {
    switch (word->code) {
    case KW_declare:
    case KW_local:
        run_declare(cv, word->code == KW_local);
        break;
    case KW_undef:
        run_undef(cv);
        break;
    case KW_include:
        run_include(cv, word);
        break;
    case KW_version:
        run_version(cv);
        break;
    case KW_default:
        parse_default_block(cv);
        break;
    case KW_macro:
        define_macro(cv, word);
        break;
    case KW_debug:
    case KW_warning:
    case KW_error:
    case KW_render:
    case KW_statistics:
        run_message(cv, word);
        break;
    case KW_fopen:
        run_fopen(cv, word);
        break;
    case KW_fclose:
        run_fclose(cv);
        break;
    case KW_read:
        run_read(cv);
        break;
    default: // KW_write
        run_write(cv);
    }
}

static bool is_directive(int code) {
    switch (code) {
    case KW_declare:
    case KW_local:
    case KW_undef:
    case KW_include:
    case KW_version:
    case KW_default:
    case KW_macro:
    case KW_debug:
    case KW_warning:
    case KW_error:
    case KW_render:
    case KW_statistics:
    case KW_fopen:
    case KW_fclose:
    case KW_read:
    case KW_write:
        return true;
    default:
        return false;
    }
}

void run_directive(Converter *cv, const Token *hash) {
    const Token *word = raw_peek(cv);
    const Symbol *symbol =
        word && word->code == TOK_IDENTIFIER ? name_symbol(cv, word->name) : NULL;
    if (!word || word->code == TOK_NUMBER || (word->code == TOK_IDENTIFIER && !symbol))
        die_unknown(cv, hash, word);
    enter_level(cv);
    if (is_directive(word->code)) {
        cv->language->last = raw_token(cv);
        run_plain(cv, word);
    } else if (!run_conditional(cv)) {
        // POV-Ray drops a '#' before anything else: '#object' is 'object', '#Macro()' a call.
        if (!symbol || symbol->value.type != VALUE_MACRO) {
            Loc loc = token_loc(cv, hash);
            warn_at(&loc, "'#' has no meaning before %s", token_describe(cv, word));
        }
    }
    leave_level(cv);
}

bool accept_old_directive(Converter *cv) {
    const Token *word = peek_token(cv);
    if (word->code != KW_declare && word->code != KW_include && word->code != KW_version &&
        word->code != KW_default)
        return false;
    next_token(cv);
    if (cv->version >= 350) {
        Loc loc = token_loc(cv, word);
        warn_at(&loc, "'%s' should be changed to '#%s'", word->text, word->text);
    }
    run_plain(cv, word);
    return true;
}
