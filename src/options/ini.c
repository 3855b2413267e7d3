// SPDX-License-Identifier: MIT
// INI files (facts: sdl 5.1): one Keyword=value a line, switches, and names of scenes, folders and
// further INI files. Lines before the first [section] always count, those below one only when it
// was asked for by file.ini[section]. What is wrong dies at its place in the file.
#include "options/table.h"

#include "base/file.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char BLANKS[] = " \t";
static const char LINE_ENDS[] = "\r\n";
static const char WORD_ENDS[] = " \t\r\n\v\f,;#\"'";
static const char KEY_ENDS[] = " \t\r\n\v\f,;#\"'[]=";

// One file being read.
typedef struct {
    Parse *parse;
    const char *name, *text, *at;
    const char *section; // asked for, or NULL
    bool active, found;  // do the lines here count; has the section been met
} Ini;

// ---- places ------------------------------------------------------------------------------------

static Loc place_of(const Ini *ini, const char *at) {
    Loc loc = {.file = ini->name, .text = ini->text, .line = 1, .column = 1};
    for (const char *p = ini->text; p < at; p++) {
        loc.column++;
        if (*p == '\n' || (*p == '\r' && p[1] != '\n')) {
            loc.line++;
            loc.column = 1;
        }
    }
    return loc;
}

// What is refused from here on stands at `at`.
static void set_place(Ini *ini, const char *at) {
    const Loc *from = ini->parse->loc.from;
    const char *what = ini->parse->loc.what;
    ini->parse->loc = place_of(ini, at);
    ini->parse->loc.from = from;
    ini->parse->loc.what = what;
}

static void move_over(Ini *ini, const char *set) { ini->at += strspn(ini->at, set); }

static void skip_line(Ini *ini) { ini->at += strcspn(ini->at, LINE_ENDS); }

static bool at_line_end(const char *at) { return !*at || strchr("\r\n;#", *at); }

static const char *text_of(const Ini *ini, const char *start, size_t length) {
    return arena_printf(ini->parse->arena, "%.*s", (int)length, start);
}

// ---- values ------------------------------------------------------------------------------------

// The text between the quote here and the next of its kind, on the same line.
static const char *read_quoted(Ini *ini) {
    char quote = *ini->at;
    const char stops[] = {quote, '\r', '\n', '\0'};
    const char *start = ini->at + 1;
    size_t length = strcspn(start, stops);
    set_place(ini, ini->at);
    if (start[length] != quote)
        die_at(&ini->parse->loc, "the quote is not closed on this line");
    ini->at = start + length + 1;
    return text_of(ini, start, length);
}

// After a blank: does the value go on? Not when a comment, another value of the list, a switch or a
// keyword follows; else it is a name with blanks in it.
static bool goes_on(const Ini *ini, const char *rest) {
    if (at_line_end(rest) || *rest == ',')
        return false;
    if ((*rest == '+' || *rest == '-') && isalpha((unsigned char)rest[1]))
        return false;
    return !option_keyword(ini->parse, rest, strcspn(rest, KEY_ENDS));
}

// A value without quotes ends with its word; one with blanks in it, with the line.
static const char *read_plain(Ini *ini) {
    const char *start = ini->at;
    size_t length = strcspn(start, WORD_ENDS);
    const char *rest = start + length + strspn(start + length, BLANKS);
    if (rest > start + length && goes_on(ini, rest)) {
        length = strcspn(start, ";#\r\n");
        while (length && strchr(BLANKS, start[length - 1]))
            length--;
        set_place(ini, start);
        option_remark(ini->parse, true,
                      "a value with blanks is taken up to the end of the line; it should be in "
                      "quotes");
    }
    ini->at = start + length;
    return text_of(ini, start, length);
}

// A command of the shell keeps its quotes and ends with the line, or a comment outside of quotes.
static const char *read_command(Ini *ini) {
    const char *start = ini->at;
    char quote = '\0';
    for (; *ini->at && !strchr(LINE_ENDS, *ini->at); ini->at++) {
        char c = *ini->at;
        if (!quote && (c == ';' || c == '#'))
            break;
        if (c == '\\' && ini->at[1] && strchr("\\\"'", ini->at[1]))
            ini->at++;
        else if (c == quote)
            quote = '\0';
        else if (!quote && (c == '"' || c == '\''))
            quote = c;
    }
    return text_of(ini, start, (size_t)(ini->at - start));
}

static bool is_command(const char *key, size_t length) {
    const char *end = "_command";
    size_t tail = strlen(end);
    return length > tail && strncasecmp(key + length - tail, end, tail) == 0;
}

// ---- lines -------------------------------------------------------------------------------------

static void read_section(Ini *ini) {
    const char *start = ini->at + 1;
    size_t length = strcspn(start, "]\r\n");
    set_place(ini, ini->at);
    if (start[length] != ']')
        die_at(&ini->parse->loc, "the ']' of this section's name is missing");
    ini->active = ini->section && strlen(ini->section) == length &&
                  strncasecmp(ini->section, start, length) == 0;
    ini->found = ini->found || ini->active;
    ini->at = start + length + 1;
}

// Keyword = value, value ... The key is known to be followed by '='.
static void read_assignment(Ini *ini, size_t key_length) {
    const char *key = ini->at;
    ini->at += key_length;
    move_over(ini, BLANKS);
    ini->at++; // '='
    do {
        move_over(ini, BLANKS);
        const char *start = ini->at, *value;
        if (is_command(key, key_length))
            value = read_command(ini);
        else
            value = *start == '"' || *start == '\'' ? read_quoted(ini) : read_plain(ini);
        bool known = option_keyword(ini->parse, key, key_length);
        set_place(ini, known ? start : key);
        const char *word = arena_printf(ini->parse->arena, "%.*s=%s", (int)key_length, key, value);
        option_assign(ini->parse, word, key_length, value);
        move_over(ini, BLANKS);
    } while (*ini->at == ',' && ini->at++);
    if (!at_line_end(ini->at)) {
        set_place(ini, ini->at);
        option_remark(ini->parse, true, "one keyword a line: the rest of this line is not read");
    }
    skip_line(ini);
}

// A switch, its value glued to it, perhaps in quotes: +L"my folder".
static void read_switch(Ini *ini) {
    const char *start = ini->at;
    size_t length = 1 + strcspn(start + 1, KEY_ENDS);
    const char *word = text_of(ini, start, length);
    ini->at += length;
    if (*ini->at == '"' || *ini->at == '\'')
        word = arena_printf(ini->parse->arena, "%s%s", word, read_quoted(ini));
    set_place(ini, start);
    if (word[1] == '-')
        die_at(&ini->parse->loc, "words with two dashes stand on the command line only");
    int used;
    option_switch(ini->parse, word, NULL, &used);
}

static void read_one(Ini *ini) {
    const char *start = ini->at;
    if (strchr("+-", *start)) {
        read_switch(ini);
        return;
    }
    size_t length = strcspn(start, KEY_ENDS);
    const char *behind = start + length + strspn(start + length, BLANKS);
    if (length && *behind == '=') {
        read_assignment(ini, length);
        return;
    }
    const char *name = *start == '"' || *start == '\'' ? read_quoted(ini) : read_plain(ini);
    set_place(ini, start);
    if (!*name)
        die_at(&ini->parse->loc, "a keyword, a switch or a name is expected here");
    option_name(ini->parse, name);
}

static void read_all(Ini *ini) {
    for (;;) {
        move_over(ini, " \t\r\n\v\f");
        if (!*ini->at)
            return;
        if (*ini->at == '[')
            read_section(ini);
        else if (!ini->active || at_line_end(ini->at))
            skip_line(ini);
        else
            read_one(ini);
    }
}

// ---- files -------------------------------------------------------------------------------------

// The file's path: its name if that has a short extension, else with .ini; here, or in the library
// paths given so far. NULL: there is none.
static const char *find_file(const Parse *parse, const char *name) {
    const RenderOptions *o = parse->options;
    const char *dot = strrchr(name, '.');
    static const char *const extensions[] = {"", ".ini", ".INI"};
    for (size_t k = 0; k <= o->library_path_count; k++) {
        const char *folder = k ? o->library_paths[k - 1] : "";
        for (size_t i = dot && strlen(dot) <= 4 ? 0 : 1; i < 3; i++) {
            const char *path =
                arena_printf(parse->arena, "%s%s%s%s", folder, k ? "/" : "", name, extensions[i]);
            if (file_exists(path))
                return path;
        }
    }
    return NULL;
}

static bool refuse_missing(Parse *parse, const char *word, const char *name) {
    const char *scene = arena_printf(parse->arena, "%s.pov", name);
    const char *why;
    if (file_exists(scene))
        why = arena_printf(
            parse->arena, "means the INI file %s.ini, which is not there; the scene is %s, or +I%s",
            name, scene, name);
    else if (strchr(word, '['))
        why = arena_printf(parse->arena, "no INI file %s here or in the library paths", name);
    else
        why = "neither a switch, a scene (.pov, .qi.json) nor an INI file here or in the library "
              "paths";
    return option_refuse(parse, word, why);
}

// Reads the file at path. The place in parse is that of the word which named it.
static void read_file(Parse *parse, const char *path, const char *section) {
    enum { DEEPEST = 16 };
    const Loc outer = parse->loc;
    size_t size;
    const char *why;
    const char *text = file_read(parse->arena, path, &size, &why);
    if (!text)
        die("cannot read '%s': %s", path, why);
    if (memchr(text, '\0', size))
        die("cannot read '%s': it is not an INI file (it holds bytes that are no text)", path);
    bool marked = size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0; // byte order mark
    Ini ini = {.parse = parse,
               .name = path,
               .text = text,
               .at = marked ? text + 3 : text,
               .section = section,
               .active = true};
    if (++parse->depth > DEEPEST)
        die_at(&outer, "INI files are nested more than %d deep: does '%s' name itself?", DEEPEST,
               path);
    Loc *from = ARENA_NEW(parse->arena, Loc);
    *from = outer;
    parse->loc.from = outer.file ? from : NULL;
    parse->loc.what = "included";
    read_all(&ini);
    parse->depth--;
    parse->loc = outer;
    if (section && !ini.found)
        option_remark(parse, true, "'%s' has no section [%s]", path, section);
}

bool option_ini(Parse *parse, const char *word) {
    const char *bracket = strchr(word, '['), *section = NULL;
    const char *name = word;
    if (bracket) {
        const char *end = strchr(bracket, ']');
        if (!end || end[1])
            return option_refuse(parse, word, "a section is written as in file.ini[Section]");
        name = arena_printf(parse->arena, "%.*s", (int)(bracket - word), word);
        section = arena_printf(parse->arena, "%.*s", (int)(end - bracket - 1), bracket + 1);
    }
    const char *path = find_file(parse, name);
    if (!path)
        return refuse_missing(parse, word, name);
    read_file(parse, path, section);
    return true;
}

void options_read_povray_ini(OptionsProgram program, Arena *arena, RenderOptions *options) {
    Parse parse = {.program = program, .options = options, .arena = arena, .povray_ini = true};
    const char *named = getenv("POVINI"), *home = getenv("HOME");
    if (named && !file_exists(named)) {
        option_remark(&parse, true, "POVINI: cannot read '%s'", named);
        named = NULL;
    }
    const char *const places[] = {
        named,
        "./povray.ini",
        home ? arena_printf(arena, "%s/.povray/3.7/povray.ini", home) : NULL,
        "/etc/povray/3.7/povray.ini",
        home ? arena_printf(arena, "%s/.povrayrc", home) : NULL,
        "/etc/povray.ini",
    };
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        if (places[i] && file_exists(places[i])) {
            options->povray_ini = places[i];
            options->width = 160;
            options->height = 120;
            read_file(&parse, places[i], NULL);
            // The machine's habit is not the user's word: +Ox.exr still means an EXR file.
            options->format_given = false;
            return;
        }
}

void options_report(const RenderOptions *options) {
    static const Loc nowhere;
    for (int i = 0; i < CONSOLE_COUNT; i++) {
        console_show((Console)i, options->console[i]);
        if (options->all_file)
            console_copy((Console)i, options->all_file, options->append_file);
        if (options->console_file[i])
            console_copy((Console)i, options->console_file[i], options->append_file);
    }
    for (size_t i = 0; i < options->remark_count; i++) {
        const OptionRemark *remark = &options->remarks[i];
        const Loc *loc = remark->loc.file ? &remark->loc : &nowhere;
        if (remark->warning)
            warn_at(loc, "%s", remark->text);
        else
            note_at(loc, "%s", remark->text);
    }
}
