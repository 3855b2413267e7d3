// SPDX-License-Identifier: MIT
// What the files of the language core share and no statement needs: names and their bindings, the
// frames of the program being read, open conditionals, macros, arrays, splines, files.
#ifndef CONVERTER_LANGUAGE_H
#define CONVERTER_LANGUAGE_H

#include "converter/converter.h"

// More than this comes from mistakes. What can be moved is a Limit (limits.c).
enum {
    MAX_DIMENSIONS = 5,
    MAX_PARAMETERS = 256,
    MAX_IDENTIFIER = 4096,
};

// Truth, equality and subscripts are taken with this tolerance, as POV-Ray does (facts: sdl 2).
#define EPSILON 1e-10
static inline bool is_true(double v) { return fabs(v) > EPSILON; }

// ---- memory -----------------------------------------------------------------------------------

// Growing lists in the arena: count and capacity as in base/array.h, old pieces are left behind.
#define LIST(Type) ARRAY(Type)
#define list_push(cv, list, value)                                                                 \
    (((list)->count == (list)->capacity                                                            \
          ? (void)((list)->items = list_grow((cv), (list)->items, (list)->count,                   \
                                             &(list)->capacity, sizeof *(list)->items))            \
          : (void)0),                                                                              \
     (list)->items[(list)->count++] = (value))
void *list_grow(Converter *cv, void *items, size_t count, size_t *capacity, size_t item_size);

// ---- symbol.c ---------------------------------------------------------------------------------

typedef struct Array {
    ValueType type; // of all elements; VALUE_NONE until the first is set
    int dimensions;
    size_t sizes[MAX_DIMENSIONS], count;
    Value *items;
} Array;

// One binding of a name. The bindings of a name are stacked, the innermost scope's on top.
struct Symbol {
    Value value;
    Value *target;       // a parameter given by reference: the caller's value
    Array *target_array; // the array that holds it, if any
    uint32_t name;
    int scope;
    Symbol *shadowed; // the next outer binding of the same name
    Symbol *sibling;  // the one made before it in the same scope
    bool removed;     // by #undef; still in its scope's list
    bool deprecated, deprecated_once;
    const char *deprecation;
};

uint32_t name_intern(Converter *cv, const char *text, size_t length);
const char *name_text(const Converter *cv, uint32_t name);
Symbol *name_symbol(const Converter *cv, uint32_t name); // the innermost, or NULL
uint32_t name_count(const Converter *cv);                // the numbers are 1 to this - 1
// hint.c: what an undeclared identifier may have meant, in parentheses and with a blank before it;
// else "".
const char *spelling_hint(Converter *cv, const Token *token);

int scope_level(const Converter *cv); // 0: global
void scope_enter(Converter *cv);
void scope_leave(Converter *cv);
Symbol *symbol_add(Converter *cv, uint32_t name, int scope); // shadows; scope 0 or the innermost
void symbol_remove(Converter *cv, Symbol *symbol);           // must be the innermost of its name

// What an identifier token with its subscripts stands for.
typedef struct {
    Symbol *symbol;
    Value *value;
    Array *array; // that holds value, or NULL
} Place;

// Reads the subscripts of an identifier whose token was just taken from the frame.
// Unset elements are allowed only if want_unset.
Place resolve_place(Converter *cv, const Token *token, bool want_unset);
// Stores value: the type of an array's elements cannot change, functions cannot be declared anew.
void place_assign(Converter *cv, const Place *place, const Value *value, const Loc *loc);

// ---- value.c ----------------------------------------------------------------------------------

int value_width(ValueType type); // 1..5, 0 if it is not numeric
Value value_number(const double c[5], int width);

// A macro's argument that is a bare name is passed by reference, unless the name belongs to a scope
// that ends with the argument (the local of a macro that is the argument).
typedef struct {
    int outermost; // scopes up to this one live on
    Place place;   // value NULL: the argument is no bare name
} Reference;

// What stands right of '=', as an array's element, or as a macro's argument (then reference is not
// NULL). False: nothing of the kind is next.
typedef enum { RVALUE_DECLARE, RVALUE_ARGUMENT, RVALUE_ELEMENT } RvalueUse;
bool parse_rvalue(Converter *cv, RvalueUse use, Value *out, Reference *reference);

// ---- expr.c -----------------------------------------------------------------------------------

// e has room for five components. `want` is the number of components that a literal is repeated
// into; returns how many the expression has. Components of e beyond that are left alone.
int parse_add(Converter *cv, double e[5], int want);
int parse_full(Converter *cv, double e[5], int want);

bool is_comparison(int code);
bool compare_floats(int code, double a, double b);

// quick.c: each takes what it reads, or nothing and is false: then the usual way is to be gone.
bool quick_float(Converter *cv, double *out);     // ADD of floats alone
bool quick_vector(Converter *cv, double out[3]);  // < ADD , ADD , ADD >
bool quick_condition(Converter *cv, double *out); // ( FULL ) of floats alone
bool quick_declare(Converter *cv, bool local);    // after #declare: a float that gets a float

// expr_call.c: the built-in functions. True if the next token is one; then e and *width are set.
bool parse_call(Converter *cv, double e[5], int *width, int want);
bool is_number_keyword(int code); // begins a float of its own or a float function
bool is_vector_keyword(int code);
double full_in_parentheses(Converter *cv, const char *where); // ( FULL )

// expr_object.c: after the function's name.
Vec3 trace_call(Converter *cv, const Token *name);
Vec3 extent_call(Converter *cv, const Token *name);
double inside_call(Converter *cv, const Token *name);

// expr_color.c
bool is_color_keyword(int code);

// string.c
bool is_string_keyword(int code);
const char *string_from_literal(Converter *cv, const Token *token, bool file_name);
int string_compare(const char *a, const char *b);
size_t string_units(const char *s); // UTF-16 code units
const char *string_for_output(Converter *cv, const char *s);

// ---- spline.c ---------------------------------------------------------------------------------

Spline *parse_spline(Converter *cv); // after the keyword `spline`: { ... }
// The keyword of a kind, if it is next.
bool accept_spline_kind(Converter *cv, SplineKind *kind);

// ---- cursor.c ---------------------------------------------------------------------------------

typedef struct Macro {
    uint32_t name;
    uint32_t parameters[MAX_PARAMETERS];
    size_t parameter_count;
    TokenList body;      // without its #end
    const Token *header; // the macro's name where it is defined
} Macro;

struct Frame {
    Frame *outer;
    const Token *tokens;
    size_t count, at;
    const Source *source; // of an include
    const Macro *macro;   // of a call; NULL: a file
    const Token *call;    // what led here: the call or the include; NULL: the main file
    size_t conditions;    // open when the frame was entered
    uint64_t serial;
    const Loc *call_loc; // of call, and how it led here: made when first needed
    const char *what;
};

typedef enum {
    CONDITION_IF,    // the taken branch of #if ... #else: #else and #elseif end it
    CONDITION_ELSE,  // in #else: only #end may follow
    CONDITION_CASE,  // in a taken #case
    CONDITION_WHILE, // body of a loop
    CONDITION_FOR,
} ConditionKind;

typedef struct {
    ConditionKind kind;
    const Token *directive; // #if, #while, ...
    uint64_t frame;         // its serial
    size_t at;              // loops: where the condition or the body starts
    double subject;         // #switch
    double end, step;       // #for
    uint32_t variable;
} Condition;

typedef struct UserFile {
    const char *name;
    const Loc *loc;   // of the #fopen that made it
    TokenList tokens; // being read
    size_t at;
    bool writing;
    char *text; // written so far
    size_t size, capacity;
    struct UserFile *next; // all that were written
} UserFile;

typedef struct {
    const Source *source;
    TokenList tokens;
} TokenizedFile;

// A pigment or pattern that a function asks.
typedef struct {
    const struct PatternNode *node;
    Loc loc; // of the function's body
} FunctionPigment;

// What the text has asked about before the scene is complete: probing.c.
typedef struct ProbeEntry ProbeEntry;
typedef struct {
    ProbeEntry *entries;
    size_t count, capacity;
} ProbeTable;

typedef struct Language {
    // cursor.c
    const Token *ahead; // read but not consumed, or NULL
    Place place;        // what `ahead` stands for, if it is a declared identifier
    bool ahead_raw;     // it was read while directives were held
    bool held;
    const Token *last; // the last consumed
    uint64_t consumed; // tokens given out by next_token
    uint64_t read;     // tokens taken from frames
    uint64_t limits[LIMIT_COUNT];
    uint64_t work, started; // limits.c: work left before the clock is looked at
    size_t max_bytes, probe_bytes, stack_room;
    const char *stack_base;
    uint64_t serials;
    size_t includes, calls; // frames of each kind
    size_t condition_floor; // conditions that belong to outer frames of a macro call
    Frame *spare;
    LIST(Condition) conditions;
    LIST(const Source *) sources;
    LIST(TokenizedFile) files;
    LIST(const char *) library;
    LIST(uint32_t) seeds;     // states of the random streams
    LIST(Function) functions; // all that were ever declared: function.c
    LIST(FunctionPigment) function_pigments;
    ProbeTable probes;
    UserFile *written;
    size_t elements;     // of all arrays
    char debug_line[96]; // debug_text.c: of #debug, until its end comes
    size_t debug_used;
} Language;

const Token *raw_token(Converter *cv); // the next token of the frames as it stands
const Token *raw_peek(Converter *cv);  // in the innermost frame only; NULL at its end
void push_file(Converter *cv, const Source *source, const Token *call);
void push_macro(Converter *cv, const Macro *macro, const Token *call);
void leave_macro(Converter *cv);         // #break
const Place *ahead_place(Converter *cv); // of the next token; NULL: it names nothing
void expect_raw(Converter *cv, int code, const char *where);

// ---- limits.c ---------------------------------------------------------------------------------

void limits_start(Converter *cv);
void count_token(Converter *cv);

// ---- directive.c, loop.c, macro.c, user_file.c -----------------------------------------------

void run_directive(Converter *cv, const Token *hash); // after its '#'
void check_all_closed(Converter *cv);                 // at the end of the main file
bool place_is_set(Converter *cv);                     // ( IDENTIFIER [subscripts] )
// loop.c: if the word after the '#' is one of if ... end, takes it and runs it.
bool run_conditional(Converter *cv);
const char *innermost_loop(Converter *cv, Loc *loc); // its name for a message, or NULL
void define_macro(Converter *cv, const Token *word);
void call_macro(Converter *cv, const Token *name, const Macro *macro);
void run_fopen(Converter *cv, const Token *word);
void run_fclose(Converter *cv);
void save_open_files(Converter *cv); // at the end of the scene
void run_read(Converter *cv);
void run_write(Converter *cv);
const Source *written_source(Converter *cv, const char *name);
void debug_text(Converter *cv, const char *text); // debug_text.c

#endif
