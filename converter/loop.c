// SPDX-License-Identifier: MIT
// #if, #ifdef, #ifndef, #switch, #while, #for and what closes them (facts: sdl 3.3). One stack of
// open conditionals for the whole program: an #if of an include may be closed by the file that
// includes it. Only a macro call fences off those below it. Untaken branches are skipped here token
// by token; nothing in them is looked up.
#include "converter/language.h"

static Condition *innermost(Converter *cv) {
    Language *l = cv->language;
    return l->conditions.count > l->condition_floor ? &l->conditions.items[l->conditions.count - 1]
                                                    : NULL;
}

static Condition *open_condition(Converter *cv, ConditionKind kind, const Token *word) {
    Language *l = cv->language;
    if (l->conditions.count > 100000) {
        Loc loc = token_loc(cv, word);
        die_at(&loc, "Too many nested conditionals");
    }
    Condition c = {.kind = kind, .directive = word, .frame = cv->frame->serial};
    list_push(cv, &l->conditions, c);
    return innermost(cv);
}

static void close_condition(Converter *cv) { cv->language->conditions.count--; }

_Noreturn static void die_mismatched(Converter *cv, const Token *word, const char *why) {
    Loc loc = token_loc(cv, word);
    die_at(&loc, "Mis-matched '#%s': %s", word->text, why);
}

void check_all_closed(Converter *cv) {
    Language *l = cv->language;
    if (!l->conditions.count)
        return;
    const Token *word = l->conditions.items[l->conditions.count - 1].directive;
    Loc loc = token_loc(cv, word);
    die_at(&loc, "This #%s has no #end (the end of the file was reached)", word->text);
}

const char *innermost_loop(Converter *cv, Loc *loc) {
    Language *l = cv->language;
    for (size_t i = l->conditions.count; i-- > 0;) {
        const Condition *c = &l->conditions.items[i];
        if (c->kind == CONDITION_WHILE || c->kind == CONDITION_FOR) {
            *loc = token_loc(cv, c->directive);
            return c->kind == CONDITION_WHILE ? "this #while loop" : "this #for loop";
        }
    }
    return NULL;
}

// ---- skipping ---------------------------------------------------------------------------------

enum { STOP_AT_ELSE = 1, STOP_AT_CASE = 2 };

static bool opens_block(int code) {
    return code == KW_if || code == KW_ifdef || code == KW_ifndef || code == KW_while ||
           code == KW_for || code == KW_switch || code == KW_macro;
}

// Reads on to the #end that closes `opener` (with `depth` more open inside it), or to the next
// branch of it if those are asked for. Returns the word.
static const Token *skip_block(Converter *cv, const Token *opener, int stop_at, size_t depth) {
    for (;;) {
        bool ended = cv->frame->macro && cv->frame->at == cv->frame->count;
        const Token *token = ended ? NULL : raw_token(cv);
        if (!token || token->code == TOK_EOF) {
            Loc loc = token_loc(cv, opener);
            die_at(&loc, "This #%s has no #end (the end of the %s was reached)", opener->text,
                   token ? "file" : "macro");
        }
        if (token->code != '#' || !raw_peek(cv))
            continue;
        const Token *word = raw_token(cv);
        if (opens_block(word->code))
            depth++;
        else if (word->code == KW_end && depth-- == 0)
            return word;
        else if (depth == 0 && (stop_at & STOP_AT_ELSE) &&
                 (word->code == KW_else || word->code == KW_elseif))
            return word;
        else if (depth == 0 && (stop_at & STOP_AT_CASE) &&
                 (word->code == KW_else || word->code == KW_case || word->code == KW_range))
            return word;
    }
}

static void skip_to_end(Converter *cv, const Token *opener) { skip_block(cv, opener, 0, 0); }

// ---- #if --------------------------------------------------------------------------------------

static double condition_value(Converter *cv, const Token *word) {
    double quick;
    if (quick_condition(cv, &quick))
        return quick;
    bool held = hold_directives(cv);
    double v = full_in_parentheses(cv, word->text);
    restore_directives(cv, held);
    return v;
}

static void run_if(Converter *cv, const Token *word) {
    bool taken = word->code == KW_if ? is_true(condition_value(cv, word))
                                     : place_is_set(cv) == (word->code == KW_ifdef);
    if (taken) {
        open_condition(cv, CONDITION_IF, word);
        return;
    }
    for (;;) {
        const Token *branch = skip_block(cv, word, STOP_AT_ELSE, 0);
        if (branch->code == KW_end)
            return;
        if (branch->code == KW_else) {
            open_condition(cv, CONDITION_ELSE, word);
            return;
        }
        if (is_true(condition_value(cv, branch))) {
            open_condition(cv, CONDITION_IF, word);
            return;
        }
    }
}

// #else or #elseif met while running: the taken branch ends here; in a #switch it falls through.
static void run_else(Converter *cv, const Token *word) {
    const Condition *c = innermost(cv);
    if (c && c->kind == CONDITION_CASE && word->code == KW_else)
        return;
    if (!c || c->kind != CONDITION_IF)
        die_mismatched(cv, word, "no #if is open here");
    skip_to_end(cv, c->directive);
    close_condition(cv);
}

// ---- #switch ----------------------------------------------------------------------------------

// After #case or #range.
static bool case_matches(Converter *cv, const Token *word, double subject) {
    if (word->code == KW_case) {
        return fabs(condition_value(cv, word) - subject) < EPSILON;
    }
    bool held = hold_directives(cv);
    expect(cv, '(', "#range");
    double low = parse_float(cv);
    optional_comma(cv);
    double high = parse_float(cv);
    expect(cv, ')', "#range");
    restore_directives(cv, held);
    return subject >= low && subject <= high;
}

// The first #case must follow; only directives that leave no tokens may stand before it.
static const Token *first_case(Converter *cv, const Token *opener) {
    for (;;) {
        const Token *hash = raw_peek(cv);
        if (!hash || hash->code != '#') {
            Loc loc = token_loc(cv, hash ? hash : opener);
            die_at(&loc, "#switch not followed by #case or #range");
        }
        raw_token(cv);
        const Token *word = raw_peek(cv);
        if (word && (word->code == KW_case || word->code == KW_range))
            return raw_token(cv);
        if (!word || word->code == KW_end || word->code == KW_else)
            die_mismatched(cv, word && word->text ? word : opener,
                           "#switch not followed by #case or #range");
        run_directive(cv, hash);
    }
}

static void run_switch(Converter *cv, const Token *opener) {
    double subject = condition_value(cv, opener);
    const Token *word = first_case(cv, opener);
    for (;;) {
        if (word->code == KW_end)
            return;
        if (word->code == KW_else || case_matches(cv, word, subject))
            break;
        word = skip_block(cv, opener, STOP_AT_CASE, 0);
    }
    open_condition(cv, CONDITION_CASE, opener)->subject = subject;
}

// A further #case of a taken one: read, and fallen through.
static void run_case(Converter *cv, const Token *word) {
    const Condition *c = innermost(cv);
    if (!c || c->kind != CONDITION_CASE)
        die_mismatched(cv, word, "no #switch is open here");
    case_matches(cv, word, c->subject);
}

// ---- loops ------------------------------------------------------------------------------------

static void run_while(Converter *cv, const Token *word) {
    size_t at = cv->frame->at;
    if (is_true(condition_value(cv, word)))
        open_condition(cv, CONDITION_WHILE, word)->at = at;
    else
        skip_to_end(cv, word);
}

// The loop's variable: in the innermost scope, made anew if that has none of the name.
static Place loop_variable(Converter *cv) {
    bool held = hold_directives(cv);
    const Token *token = peek_token(cv);
    if (token->code != TOK_IDENTIFIER)
        die_expected(cv, "the loop variable's name");
    next_token(cv);
    Loc loc = token_loc(cv, token);
    Place place = resolve_place(cv, token, true);
    if (place.array && place.value != place.symbol->target)
        die_at(&loc, "#for loop variable must not be an array element");
    if (!place.symbol || place.symbol->scope != scope_level(cv)) {
        place = (Place){.symbol = symbol_add(cv, token->name, scope_level(cv))};
        place.value = &place.symbol->value;
    }
    optional_comma(cv);
    restore_directives(cv, held);
    return place;
}

static bool past_end(double v, double end, double step) {
    return (step > 0 && v > end + EPSILON) || (step < 0 && v < end - EPSILON);
}

// #for ( NAME [,] F [,] F [,] [F] )
static void run_for(Converter *cv, const Token *word) {
    expect_raw(cv, '(', "#for");
    Loc loc = token_loc(cv, word);
    Place place = loop_variable(cv);
    Value start = {.type = VALUE_FLOAT, .c = {parse_float(cv)}};
    optional_comma(cv);
    double end = parse_float(cv);
    optional_comma(cv);
    double step = starts_expression(cv) ? parse_float(cv) : 1;
    expect(cv, ')', "#for");
    if (fabs(step) < EPSILON)
        die_at(&loc, "#for loop increment must be non-zero");
    place_assign(cv, &place, &start, &loc);
    if (past_end(start.c[0], end, step)) {
        skip_to_end(cv, word);
        return;
    }
    size_t at = cv->frame->at;
    Condition *c = open_condition(cv, CONDITION_FOR, word);
    c->at = at;
    c->end = end;
    c->step = step;
    c->variable = place.symbol->name;
}

// At the #end of a #for: true if it runs once more.
static bool step_for(Converter *cv, const Condition *c) {
    Symbol *symbol = name_symbol(cv, c->variable);
    Value *value = symbol ? symbol->target ? symbol->target : &symbol->value : NULL;
    if (!value || value->type != VALUE_FLOAT) {
        Loc loc = token_loc(cv, c->directive);
        die_at(&loc, "#for loop variable must remain defined and numerical during the loop");
    }
    value->c[0] += c->step;
    return !past_end(value->c[0], c->end, c->step);
}

static void run_end(Converter *cv, const Token *word) {
    const Condition *c = innermost(cv);
    if (!c)
        die_mismatched(cv, word, "nothing is open here");
    if (c->kind == CONDITION_WHILE || c->kind == CONDITION_FOR) {
        if (c->frame != cv->frame->serial)
            die_mismatched(cv, word, "a loop must end in the file where it started");
        size_t after = cv->frame->at, index = (size_t)(c - cv->language->conditions.items);
        cv->frame->at = c->at;
        bool again =
            c->kind == CONDITION_FOR ? step_for(cv, c) : is_true(condition_value(cv, c->directive));
        if (again)
            return;
        cv->frame->at = after;
        cv->language->conditions.count = index + 1;
    }
    close_condition(cv);
}

// Leaves the innermost loop or #case, or else the macro being called.
static void run_break(Converter *cv, const Token *word) {
    Language *l = cv->language;
    size_t inside = 0;
    for (; l->conditions.count > l->condition_floor; inside++, close_condition(cv)) {
        const Condition *c = innermost(cv);
        if (c->kind != CONDITION_IF && c->kind != CONDITION_ELSE) {
            skip_block(cv, c->directive, 0, inside);
            close_condition(cv);
            return;
        }
    }
    if (!l->calls)
        die_mismatched(cv, word, "Invalid context for #break: no loop, #case or macro around it");
    leave_macro(cv);
}

bool run_conditional(Converter *cv) {
    static const struct {
        int code;
        void (*run)(Converter *, const Token *);
    } words[] = {
        {KW_if, run_if},       {KW_ifdef, run_if},      {KW_ifndef, run_if},   {KW_else, run_else},
        {KW_elseif, run_else}, {KW_switch, run_switch}, {KW_case, run_case},   {KW_range, run_case},
        {KW_while, run_while}, {KW_for, run_for},       {KW_break, run_break}, {KW_end, run_end},
    };
    const Token *word = raw_peek(cv);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (words[i].code == word->code) {
            cv->language->last = raw_token(cv);
            words[i].run(cv, word);
            return true;
        }
    }
    return false;
}
