// SPDX-License-Identifier: MIT
// The converter's room: the one vocabulary of its stages, in the order of the data.
//
//   source.c     finds and reads files                      -> Source
//   lexer.c      text -> tokens with their places            -> Token[]
//   cursor.c     a stack of frames over token arrays: includes, macro bodies, loops; runs the
//                directives between any two tokens           -> next_token()
//   symbol.c     names -> values, dynamic scopes
//   expr.c       ADD and FULL expressions, colours, strings  -> Value
//   function.c   function { } bodies, splines
//   directive.c  #declare ... #while ... #macro ...
//   object.c patch.c texture.c pattern.c light.c camera.c settings.c
//                one statement family each                   -> nodes (nodes.h)
//   emit.c       nodes -> Scene
//
// Nothing is freed: everything lives in cv->arena. Wrong input dies at its place (die_at).
#ifndef CONVERTER_CONVERTER_H
#define CONVERTER_CONVERTER_H

#include "base/arena.h"
#include "base/array.h"
#include "base/color.h"
#include "base/diag.h"
#include "base/vec.h"
#include "model/scene.h"
#include "options/options.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Converter Converter;
typedef struct Symbol Symbol;
typedef struct UserFunction UserFunction; // function.c
typedef struct Frame Frame;               // cursor.c

// ---- source.c ---------------------------------------------------------------------------------

typedef struct {
    const char *name; // as shown in messages: the path as found
    const char *text; // NUL-terminated
    size_t size;
    bool utf8; // a byte order mark was there
} Source;

// What kind of file is looked for decides the extensions that are tried (facts: sdl 1.6).
typedef enum { FILE_SCENE, FILE_INCLUDE, FILE_IMAGE, FILE_FONT, FILE_DENSITY, FILE_TEXT } FileKind;

// The path of the file, or NULL: working directory, then the library paths; then, with a note, the
// folder of the including file, and the name in another case.
const char *source_find(Converter *cv, const char *name, FileKind kind);
// Finds and reads; dies at loc when there is none or it cannot be read.
const Source *source_open(Converter *cv, const char *name, FileKind kind, const Loc *loc);
// A source of text that is there already (NUL-terminated, in the arena).
const Source *source_create(Converter *cv, const char *name, const char *text, size_t size,
                            FileKind kind);
// The path of a file that a statement names and other code reads; dies at loc when there is none.
const char *source_require(Converter *cv, const char *name, FileKind kind, const Loc *loc);
// The name of such a file at the cursor, which must be there; its path.
const char *parse_required_file(Converter *cv, FileKind kind);

// ---- lexer.c ----------------------------------------------------------------------------------

// Token.code: a KW_ value for reserved words, the character for one-character tokens, or one of
// these. KW_ values start above them all.
enum {
    TOK_EOF = 0,
    TOK_NUMBER = 256,
    TOK_STRING,     // text as between the quotes, escapes not interpreted
    TOK_IDENTIFIER, // text
    TOK_LE,         // <=
    TOK_GE,         // >=
    TOK_NE,         // !=
    TOK_ERROR,      // text says what is wrong here; dies when the cursor reaches it
    KW_FIRST,
};
enum Keyword {
    KW_BEFORE_FIRST = KW_FIRST - 1,
#define X(word) KW_##word,
#include "converter/keywords.h"
#undef X
    KW_END,
};

typedef struct {
    int code;
    int line, column; // from 1
    uint32_t name;    // TOK_IDENTIFIER: its number in symbol.c
    double number;    // TOK_NUMBER
    const char *text; // TOK_STRING, TOK_IDENTIFIER, and the spelling of reserved words
    const Source *source;
} Token;

typedef struct {
    const Token *items; // the last one is TOK_EOF
    size_t count;
} TokenList;

// The whole source as tokens; comments are gone, directives are '#' followed by their word. Where
// the text cannot be read the list ends with TOK_ERROR, TOK_EOF.
TokenList lexer_tokenize(Converter *cv, const Source *source);
const char *keyword_name(int code);
// How a token is called in a message: "'}'", "number", "undeclared identifier 'Redd'", ...
const char *token_describe(Converter *cv, const Token *token);

// ---- cursor.c ---------------------------------------------------------------------------------

// The next token of the program, after all directives before it have run and macro calls are
// replaced by their bodies. The pointer stays valid. After the end: TOK_EOF again and again.
const Token *next_token(Converter *cv);
const Token *peek_token(Converter *cv); // the same without consuming it
// While held, directives and macro calls are not run: a '#' or a macro's name comes out as it is.
// Used exactly while looking for a continuation of a #declare value or a macro argument.
// Both return the state before, for restore_directives; inside parentheses and at the start of a
// factor directives run again.
bool hold_directives(Converter *cv);
bool release_directives(Converter *cv);
void restore_directives(Converter *cv, bool held);
// At top level POV-Ray still takes declare, include, default and version without their '#'. If one
// is next, runs it (with a warning) and returns true.
bool accept_old_directive(Converter *cv);

bool accept(Converter *cv, int code);                    // consumes the token if it is the one
bool next_is(Converter *cv, int code);                   // peeks
void expect(Converter *cv, int code, const char *where); // dies "expected X in WHERE, found Y"
void optional_comma(Converter *cv);
Loc token_loc(Converter *cv, const Token *token); // with the chain of includes and macro calls
Loc here(Converter *cv);                          // the place of the next token
// Dies at the next token: "expected WHAT, found Y".
_Noreturn void die_expected(Converter *cv, const char *what);

// Nesting of statements and parentheses is bounded so that no input overflows the stack: enter at
// each recursive parse function, leave at its end.
void enter_level(Converter *cv);
void leave_level(Converter *cv);

// ---- limits.c ---------------------------------------------------------------------------------

uint64_t limit_of(const Converter *cv, Limit limit);
const char *limit_hint(Converter *cv, Limit limit); // "(--limit NAME=... sets another limit)"
// To be called for each piece of work that a few tokens can ask for many times (a copy of an object
// of a tree): dies where the time or the memory of the reading is over. work: about how many
// tokens' worth it is.
void check_limits(Converter *cv, uint64_t work);
// Dies when the scene would have more memory than its limit with so many bytes more.
void check_room(Converter *cv, uint64_t bytes);
// What is built from named parts (objects, maps of pigments, ...) may be nested without a brace in
// the text being nested. Whoever walks it later calls itself for each level.
enum { MAX_DEPTH = SCENE_MAX_DEPTH };
void check_depth(Converter *cv, int depth, const char *what);

// ---- value.c, symbol.c ------------------------------------------------------------------------

// ORDER value_type (value_type_name)
typedef enum {
    VALUE_NONE, // declared by nobody, or an array element that was never set
    VALUE_FLOAT,
    VALUE_UV,
    VALUE_VECTOR,
    VALUE_VECTOR4,
    VALUE_COLOR,
    VALUE_STRING,
    VALUE_ARRAY,
    VALUE_FUNCTION,
    VALUE_SPLINE,
    VALUE_MACRO,
    VALUE_FILE,
    // From here on `node` points to what the statement's file made (nodes.h). Nodes are never
    // changed once they are in a Value: who edits one edits a copy.
    VALUE_PIGMENT,
    VALUE_NORMAL,
    VALUE_FINISH,
    VALUE_TEXTURE,
    VALUE_MATERIAL,
    VALUE_INTERIOR,
    VALUE_MEDIA,
    VALUE_DENSITY,
    VALUE_COLOR_MAP,
    VALUE_PIGMENT_MAP,
    VALUE_NORMAL_MAP,
    VALUE_SLOPE_MAP,
    VALUE_TEXTURE_MAP,
    VALUE_DENSITY_MAP,
    VALUE_FOG,
    VALUE_RAINBOW,
    VALUE_SKY_SPHERE,
    VALUE_CAMERA,
    VALUE_TRANSFORM,
    VALUE_OBJECT,
} ValueType;

typedef struct {
    ValueType type;
    double c[5];        // the numeric types: components in order; colours r, g, b, filter, transmit
    const char *string; // VALUE_STRING, escapes interpreted, UTF-8
    void *node;         // the other types
} Value;

const char *value_type_name(ValueType type);

// If the next tokens name (or index an array to) a value of that type, consumes them and returns
// it; else NULL and nothing is consumed. Subscripts belong to the identifier's token: they are
// evaluated when it is read, and the element stands for the token.
const Value *accept_value(Converter *cv, ValueType type);
// The type that the next identifier (or array element) names, VALUE_NONE if the next token is none.
ValueType peek_value_type(Converter *cv);

// ---- expr.c -----------------------------------------------------------------------------------
// facts: sdl 2. ADD: sums and products, no comparison. FULL: everything. All die on wrong input.

bool starts_expression(Converter *cv); // could the next token begin a number, vector or colour?
bool starts_color(Converter *cv);      // a colour keyword (rgb, color, red ...) or a colour's name
bool starts_string(Converter *cv);

double parse_float(Converter *cv);      // ADD, one component
double parse_full_float(Converter *cv); // FULL
Vec2 parse_uv(Converter *cv);           // ADD, 2 components
Vec3 parse_vector(Converter *cv);       // ADD, 3 components
void parse_vector4(Converter *cv, double out[4]);
Color parse_color(Converter *cv); // COLOUR place, five components
Rgb parse_color3(Converter *cv);  // COLOUR place without filter and transmit (warns if given)
// `keyword` alone is on; followed by a number it is on when the number is > 0.
bool parse_optional_bool(Converter *cv);
const char *parse_string(Converter *cv);    // escapes interpreted; UTF-8
const char *parse_file_name(Converter *cv); // backslashes as they are
// What may stand right of #declare: number, colour, string, array, function, spline, or a
// statement.
Value parse_value(Converter *cv);

// ---- function.c -------------------------------------------------------------------------------

// After the keyword `function`: [(parameters)] { body }.
UserFunction *parse_function(Converter *cv);
// Into the components of e, whose number is returned. Dies where the function was written if it
// needs what is not modelled, or runs too long.
int user_function_evaluate(Converter *cv, const UserFunction *f, const double *arguments,
                           double e[5]);
uint32_t user_function_number(const UserFunction *f); // in the order of declaration
int user_function_parameters(const Converter *cv, const UserFunction *f);
int user_function_width(const Converter *cv, const UserFunction *f); // components of its value

// ---- the statements: called by directive.c and convert.c --------------------------------------

// If the next token begins a statement that makes a value of VALUE_PIGMENT and after (a keyword
// such as `pigment`, `sphere`, `transform`, or the name of such a value), parses it. False: it does
// not. Also `pattern { ... }`, the body of a function, as a VALUE_PIGMENT. The node of a
// VALUE_TRANSFORM is a Transform.
bool parse_statement_value(Converter *cv, Value *out);
// Everything at top level until the end of the main file. For `declare` and so on without '#':
// accept_old_directive.
void parse_scene_statements(Converter *cv);
// emit.c: what the statements have gathered, as a scene in the caller's arena.
Scene *emit_scene(Converter *cv);
// object.c: the box of a declared object or, for an image_map pigment, <0,0,0>..<width,height,0>.
// False: there is none for that value.
bool object_extent(Converter *cv, const Value *value, Box *out);
// The block after #default, from its '{' to its '}'.
void parse_default_block(Converter *cv);

// ---- convert.c: the state ---------------------------------------------------------------------

typedef struct Nodes Nodes; // nodes.h: what the statements have gathered

struct Converter {
    Arena *arena;
    const RenderOptions *options;
    Frame *frame;             // innermost; cursor.c
    void *symbols;            // symbol.c
    Nodes *nodes;             // nodes.h
    int version;              // of the language, x 100, at this point of the text
    bool version_set;         // was any #version executed, or +MV given?
    bool noise_generator_set; // by global_settings: #version no longer changes it
    int noise_generator;
    bool utf8;          // global_settings { charset utf8 }, or the scene file begins with a BOM
    int level;          // enter_level
    bool gamma_set;     // by assumed_gamma: srgb colours are understood from then on
    bool gamma_is_srgb; // assumed_gamma srgb
    double gamma;       // assumed_gamma, 0 when it is srgb or not yet known
    void *missing;      // MissingList of convert.h: what is not modelled goes there; NULL: warn
    struct Language *language; // language.h: what only the language's own files need
};

// The language version that rules the picture: 3.62 for a scene that never names one.
int effective_version(const Converter *cv);

#endif
