// SPDX-License-Identifier: MIT
// The program as one stream of tokens. What is being read is a stack of frames over token arrays:
// the main file, the includes, the bodies of the macros being called. A loop sets its frame back.
// Directives run and macros open between any two tokens, when the next token is asked for; only
// while directives are held does the stream show '#' and macro names as they stand (facts:
// sdl 9.1).
#include "converter/language.h"

#include <string.h>

// ---- frames -----------------------------------------------------------------------------------

static Frame *push_frame(Converter *cv, TokenList list, const Token *call) {
    Language *l = cv->language;
    Frame *f = l->spare;
    if (f)
        l->spare = f->outer;
    else
        f = ARENA_NEW(cv->arena, Frame);
    *f = (Frame){.outer = cv->frame, .tokens = list.items, .count = list.count, .call = call};
    f->conditions = l->conditions.count;
    f->serial = ++l->serials;
    cv->frame = f;
    if (f->outer)
        scope_enter(cv);
    return f;
}

static TokenList tokens_of(Converter *cv, const Source *source) {
    Language *l = cv->language;
    for (size_t i = 0; i < l->files.count; i++) {
        if (l->files.items[i].source == source)
            return l->files.items[i].tokens;
    }
    TokenList list = lexer_tokenize(cv, source);
    list_push(cv, &l->files, ((TokenizedFile){source, list}));
    return list;
}

void push_file(Converter *cv, const Source *source, const Token *call) {
    TokenList list = tokens_of(cv, source);
    if (call && ++cv->language->includes > limit_of(cv, LIMIT_INCLUDES)) {
        Loc loc = token_loc(cv, call);
        die_at(&loc, "Too many nested include files (%llu): does '%s' include itself? %s",
               (unsigned long long)limit_of(cv, LIMIT_INCLUDES), source->name,
               limit_hint(cv, LIMIT_INCLUDES));
    }
    list.count--; // the TOK_EOF behind the end stays readable for the main file
    push_frame(cv, list, call)->source = source;
}

void push_macro(Converter *cv, const Macro *macro, const Token *call) {
    Language *l = cv->language;
    if (++l->calls > limit_of(cv, LIMIT_CALLS)) {
        Loc loc = token_loc(cv, call);
        die_at(&loc, "Too many nested macro calls (%llu): does '%s' call itself without end? %s",
               (unsigned long long)limit_of(cv, LIMIT_CALLS), name_text(cv, macro->name),
               limit_hint(cv, LIMIT_CALLS));
    }
    push_frame(cv, macro->body, call)->macro = macro;
    l->condition_floor = l->conditions.count;
}

static void pop_frame(Converter *cv) {
    Language *l = cv->language;
    Frame *f = cv->frame;
    if (f->macro) {
        if (l->conditions.count != f->conditions) {
            Loc loc = token_loc(cv, l->conditions.items[l->conditions.count - 1].directive);
            die_at(&loc, "This #%s has no #end before the end of macro '%s'",
                   l->conditions.items[l->conditions.count - 1].directive->text,
                   name_text(cv, f->macro->name));
        }
        l->calls--;
        l->condition_floor = 0;
        for (const Frame *o = f->outer; o; o = o->outer) {
            if (o->macro) {
                l->condition_floor = o->conditions;
                break;
            }
        }
    } else {
        l->includes--;
    }
    scope_leave(cv);
    cv->frame = f->outer;
    f->outer = l->spare;
    l->spare = f;
}

void leave_macro(Converter *cv) {
    while (!cv->frame->macro)
        pop_frame(cv);
    cv->language->conditions.count = cv->frame->conditions;
    pop_frame(cv);
}

// ---- places -----------------------------------------------------------------------------------

static const Loc *call_loc(Converter *cv, Frame *f);

static void set_chain(Converter *cv, Loc *loc, Frame *f) {
    if (!f || !f->call)
        return;
    loc->from = call_loc(cv, f);
    if (!f->what)
        f->what =
            f->macro ? arena_printf(cv->arena, "in macro %s, called", name_text(cv, f->macro->name))
                     : "included";
    loc->what = f->what;
}

static Loc bare_loc(const Token *token) {
    return (Loc){.file = token->source->name,
                 .text = token->source->text,
                 .line = token->line,
                 .column = token->column};
}

static const Loc *call_loc(Converter *cv, Frame *f) {
    if (!f->call_loc) {
        Loc *loc = ARENA_NEW(cv->arena, Loc);
        *loc = bare_loc(f->call);
        set_chain(cv, loc, f->outer);
        f->call_loc = loc;
    }
    return f->call_loc;
}

Loc token_loc(Converter *cv, const Token *token) {
    Loc loc = bare_loc(token);
    set_chain(cv, &loc, cv->frame);
    return loc;
}

Loc here(Converter *cv) { return token_loc(cv, peek_token(cv)); }

void die_expected(Converter *cv, const char *what) {
    const Token *token = peek_token(cv);
    Loc loc = token_loc(cv, token);
    die_at(&loc, "Expected %s, %s found instead%s", what, token_describe(cv, token),
           spelling_hint(cv, token));
}

// ---- tokens -----------------------------------------------------------------------------------

const Token *raw_token(Converter *cv) {
    while (cv->frame->at == cv->frame->count) {
        if (!cv->frame->outer)
            return &cv->frame->tokens[cv->frame->count]; // TOK_EOF, again and again
        pop_frame(cv);
    }
    count_token(cv);
    const Token *token = &cv->frame->tokens[cv->frame->at++];
    if (token->code == TOK_ERROR) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "%s", token->text);
    }
    return token;
}

const Token *raw_peek(Converter *cv) {
    const Frame *f = cv->frame;
    return f->at < f->count ? &f->tokens[f->at] : NULL;
}

void expect_raw(Converter *cv, int code, const char *where) {
    bool held = hold_directives(cv);
    expect(cv, code, where);
    restore_directives(cv, held);
}

// Fills `ahead`: runs directives and opens macros until a token of the program is next.
static void fetch(Converter *cv) {
    Language *l = cv->language;
    const Token *token;
    for (;;) {
        token = raw_token(cv);
        if (token->code == TOK_EOF || l->held)
            break;
        if (token->code == '#') {
            run_directive(cv, token);
            if (l->ahead)
                return; // the directive's last part looked beyond its end
            continue;
        }
        if (token->code != TOK_IDENTIFIER)
            break;
        Place place = resolve_place(cv, token, false);
        if (place.symbol && place.value->type == VALUE_MACRO) {
            call_macro(cv, token, place.value->node);
            continue;
        }
        l->place = place;
        break;
    }
    if (token->code == TOK_EOF)
        check_all_closed(cv);
    l->ahead_raw = l->held;
    l->ahead = token;
}

const Token *peek_token(Converter *cv) {
    if (!cv->language->ahead)
        fetch(cv);
    return cv->language->ahead;
}

const Token *next_token(Converter *cv) {
    const Token *token = peek_token(cv);
    cv->language->ahead = NULL;
    cv->language->last = token;
    cv->language->consumed++;
    return token;
}

const Place *ahead_place(Converter *cv) {
    const Token *token = peek_token(cv);
    Language *l = cv->language;
    if (token->code != TOK_IDENTIFIER)
        return NULL;
    // Held back are directives and macro calls only; what a variable stands for is known.
    if (l->ahead_raw) {
        const Symbol *symbol = name_symbol(cv, token->name);
        if (!symbol || symbol->value.type == VALUE_MACRO)
            return NULL;
        l->ahead = NULL;
        Place place = resolve_place(cv, token, false);
        l->place = place;
        l->ahead = token;
        l->ahead_raw = false;
    }
    if (!l->place.symbol || l->place.value->type == VALUE_NONE)
        return NULL;
    return &l->place;
}

bool hold_directives(Converter *cv) {
    bool before = cv->language->held;
    cv->language->held = true;
    return before;
}

bool release_directives(Converter *cv) {
    bool before = cv->language->held;
    restore_directives(cv, false);
    return before;
}

void restore_directives(Converter *cv, bool held) {
    Language *l = cv->language;
    // A token that was read as it stands must be read again now that directives run.
    if (!held && l->ahead && l->ahead_raw) {
        Frame *f = cv->frame;
        if (f->at > 0 && &f->tokens[f->at - 1] == l->ahead)
            f->at--;
        l->ahead = NULL;
    }
    l->held = held;
}

bool next_is(Converter *cv, int code) { return peek_token(cv)->code == code; }

bool accept(Converter *cv, int code) {
    if (!next_is(cv, code))
        return false;
    next_token(cv);
    return true;
}

static const char *spelling(Converter *cv, int code) {
    Token token = {.code = code};
    return code == TOK_IDENTIFIER ? "an identifier" : token_describe(cv, &token);
}

void expect(Converter *cv, int code, const char *where) {
    if (accept(cv, code))
        return;
    const Token *found = peek_token(cv);
    Loc loc = token_loc(cv, found);
    const char *description = token_describe(cv, found), *hint = spelling_hint(cv, found);
    if (code == '}')
        die_at(&loc, "No matching } in '%s', %s found instead%s", where, description, hint);
    die_at(&loc, "Expected %s in '%s', %s found instead%s", spelling(cv, code), where, description,
           hint);
}

void optional_comma(Converter *cv) { accept(cv, ','); }
