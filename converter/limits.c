// SPDX-License-Identifier: MIT
// What reading a scene may cost. A scene is a program that somebody else wrote: each way in which
// it could eat the stack, the memory or the day ends at a limit with a message that names it, and
// --limit NAME=N moves it. The defaults are far above what scenes need. In the hostile test build
// those that cost time or stack are lower.
#include "converter/language.h"

#include "base/usage.h"

#include <sys/resource.h>

#ifdef HOSTILE
#define PICK(usual, hostile) (hostile)
#else
#define PICK(usual, hostile) (usual)
#endif

static const uint64_t defaults[LIMIT_COUNT] = {
    [LIMIT_CALLS] = PICK(500, 250),
    [LIMIT_ELEMENTS] = PICK(10000000, 1000000),
    [LIMIT_INCLUDES] = 64,
    [LIMIT_MEGABYTES] = PICK(4096, 160),
    [LIMIT_NESTING] = PICK(1200, 450),
    [LIMIT_OBJECTS] = PICK(20000000, 20000),
    [LIMIT_SECONDS] = 3600,
    [LIMIT_STRING] = 1 << 20,
    [LIMIT_TOKENS] = PICK(200000000, 5000000),
};

// Deep nesting ends before the stack does, whatever the limit. Of an unlimited stack 64 MB are
// used.
static size_t stack_room(void) {
    struct rlimit r;
    size_t stack = (size_t)64 << 20;
    if (getrlimit(RLIMIT_STACK, &r) == 0 && r.rlim_cur != RLIM_INFINITY && r.rlim_cur < stack)
        stack = (size_t)r.rlim_cur;
    return stack / 4 * 3;
}

static uint64_t now_seconds(void) { return (uint64_t)usage_clock(); }

void limits_start(Converter *cv) {
    Language *l = cv->language;
    for (int i = 0; i < LIMIT_COUNT; i++)
        l->limits[i] = cv->options->limits[i] ? cv->options->limits[i] : defaults[i];
    uint64_t bytes = l->limits[LIMIT_MEGABYTES] << 20;
    l->max_bytes = arena_bytes(cv->arena) + (size_t)bytes;
    l->started = now_seconds();
    l->stack_base = __builtin_frame_address(0);
    l->stack_room = stack_room();
}

uint64_t limit_of(const Converter *cv, Limit limit) { return cv->language->limits[limit]; }

const char *limit_hint(Converter *cv, Limit limit) {
    return arena_printf(cv->arena, "(--limit %s=%llu sets another limit)",
                        options_limit_name(limit),
                        (unsigned long long)cv->language->limits[limit] * 2);
}

static Loc last_loc(Converter *cv) {
    Language *l = cv->language;
    return token_loc(cv, l->last ? l->last : cv->frame->tokens);
}

void check_room(Converter *cv, uint64_t bytes) {
    Language *l = cv->language;
    if (arena_bytes(cv->arena) + l->probe_bytes + bytes <= l->max_bytes)
        return;
    Loc loc = last_loc(cv);
    die_at(&loc, "The scene needs too much memory: more than %llu MB while it is read %s",
           (unsigned long long)limit_of(cv, LIMIT_MEGABYTES), limit_hint(cv, LIMIT_MEGABYTES));
}

void check_limits(Converter *cv, uint64_t work) {
    Language *l = cv->language;
    if (l->work > work) {
        l->work -= work;
        return;
    }
    l->work = 1024; // until the next look at the clock
    check_room(cv, 0);
    if (now_seconds() - l->started >= limit_of(cv, LIMIT_SECONDS)) {
        Loc loc = last_loc(cv);
        die_at(&loc, "The scene takes too long: it has been read for %llu s %s",
               (unsigned long long)limit_of(cv, LIMIT_SECONDS), limit_hint(cv, LIMIT_SECONDS));
    }
}

void count_token(Converter *cv) {
    Language *l = cv->language;
    check_limits(cv, 1);
    if (++l->read <= l->limits[LIMIT_TOKENS])
        return;
    Loc loc;
    const char *loop = innermost_loop(cv, &loc);
    if (!loop) {
        loc = last_loc(cv);
        loop = "this program";
    }
    die_at(&loc, "%s has run too long: more than %llu tokens were read %s", loop,
           (unsigned long long)l->limits[LIMIT_TOKENS], limit_hint(cv, LIMIT_TOKENS));
}

void check_depth(Converter *cv, int depth, const char *what) {
    if (depth < MAX_DEPTH)
        return;
    Loc loc = last_loc(cv);
    die_at(&loc, "Nested too deeply: %d %s inside one another", MAX_DEPTH, what);
}

void enter_level(Converter *cv) {
    Language *l = cv->language;
    const char *here_now = __builtin_frame_address(0);
    size_t used =
        (size_t)(here_now > l->stack_base ? here_now - l->stack_base : l->stack_base - here_now);
    bool full = used > l->stack_room;
    if ((uint64_t)++cv->level <= l->limits[LIMIT_NESTING] && !full)
        return;
    Loc loc = last_loc(cv);
    die_at(&loc, "Nested too deeply (%d levels of braces, parentheses and macro calls) %s",
           cv->level - 1, full ? "for the stack of this program" : limit_hint(cv, LIMIT_NESTING));
}

void leave_level(Converter *cv) { cv->level--; }
