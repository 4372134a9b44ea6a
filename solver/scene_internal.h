/* Inside of the scene reader: the table of keys, the sandboxed interpreter and the overrides. Private to scene*.c.
 *
 * Everything that touches the interpreter runs inside one protected call (scene_lua_protect), so that every failure,
 * Lua's own shortage of memory included, comes back as a solver_error. Within it a refusal never returns; no code
 * there may hold memory of its own. */
#ifndef SOLVER_SCENE_INTERNAL_H
#define SOLVER_SCENE_INTERNAL_H

#include "solver/scene.h"

#include <lua.h>

/* --- the table of keys: scene_keys.c --- */

enum scene_kind {
    SCENE_TEXT,       /* char[SOLVER_TEXT] */
    SCENE_WORD,       /* char[SOLVER_NAME], out of `words` */
    SCENE_INDEX,      /* int: place within `words` */
    SCENE_FLAG,       /* bool */
    SCENE_NUMBER,     /* double */
    SCENE_INTEGER,    /* int */
    SCENE_SEED,       /* uint64_t */
    SCENE_NUMBERS,    /* double[count]; count 0: dim */
    SCENE_INTEGERS,   /* int[count] */
    SCENE_FORMULA,    /* offset is an enum solver_formula */
    SCENE_FACE,       /* offset is the face, 0..5 */
    SCENE_RESOLUTION, /* n: int, and levels */
    SCENE_STRUCTURED  /* a table with a reader of its own: scene_lists.c */
};

struct scene_key {
    enum scene_kind kind;
    size_t offset;      /* where in solver_scene the value goes */
    double low, high;   /* ends included */
    int count;          /* of SCENE_NUMBERS and SCENE_INTEGERS */
    const char *words;  /* admissible words, then after a '|' those promised but not there yet */
    const char *preset; /* the default as `--set` spells it; "" if the key may be absent; NULL if it is needed */
};

/* Index of a key in solver_scene_keys(), -1 if there is none of that name. */
int scene_key_find(const char *path);
const struct scene_key *scene_key_rule(int index);
/* Whether `name` is a key or the first part of one ("material"). */
bool scene_key_is_root(const char *name);
/* What must hold between plain keys, once they are read; fills in defaults that depend on others. */
void scene_check_plain(lua_State *L, struct solver_scene *scene);
/* The same of what depends on the bodies too: precision, the picture, and what is said twice. */
void scene_check_bodies(lua_State *L, const struct solver_scene *scene);
/* Refuses moduli, densities and lengths whose products leave the range of double precision. */
void scene_check_range(lua_State *L, const struct solver_scene *scene);
/* Whether `--set PATH=...` can mean anything; a name without dots may still be a parameter. */
bool scene_key_admits(const char *path);
/* ", did you mean material.nu?" for the nearest key; if none is near "; there are ..." with the keys of the same group,
 * "" if it has no group. `out` is [SOLVER_TEXT]. */
void scene_key_suggest(const char *path, char *out, size_t size);
/* Place of `word` in a list of words, -1 if absent; *later tells that it is promised for later. */
int scene_word_find(const char *words, const char *word, bool *later);
/* The word at a place of such a list. */
void scene_word_at(const char *words, int place, char *out, size_t size);
/* Shortest decimal that reads back as the same number. */
void scene_number_text(double value, char *out, size_t size);

/* --- the interpreter: scene_lua.c --- */

struct scene_override {
    char key[SOLVER_NAME];
    const char *value; /* what follows '=', within `text` */
    const char *text;  /* as given; the caller's, valid while loading */
    bool used;
};

enum scene_phase { SCENE_RUNNING_FILE, SCENE_FREEZING, SCENE_CLOSED };

struct solver_scene_lua {
    lua_State *L;
    struct solver_scene *scene;
    size_t bytes;       /* held by the interpreter */
    const char *out_of; /* why the allocator said no, NULL if it never did */
    enum scene_phase phase;
    int nesting;                        /* of functions while freezing */
    long budget, budget_full;           /* instructions left of how many */
    const struct scene_question *asked; /* of a formula that is being evaluated; NULL: none is */
    char doing[SOLVER_TEXT]; /* "initial.velocity at X = (0, 0, 0), t = 0": what a formula that failed was asked */
    struct solver_error error;
    int values, shown, upvalues;  /* registry references: key -> value; as scripts see it; what formulas captured */
    int formula[SOLVER_FORMULAS]; /* registry references, LUA_NOREF if absent */
    size_t parameter_count;
    struct solver_named parameter[SOLVER_PARAMETERS];
    size_t override_count;
    struct scene_override *override; /* [override_count]; freed after loading */
};

bool scene_lua_create(struct solver_scene *scene, struct solver_error *error);
void scene_lua_free(struct solver_scene_lua *lua);
/* Runs body(L) under protection; false with *error filled if it was refused or failed. */
bool scene_lua_protect(struct solver_scene_lua *lua, lua_CFunction body, void *argument, struct solver_error *error);
struct solver_scene_lua *scene_lua_of(lua_State *L);
/* Runs the scene's text; its values are then in place, overrides of assigned keys applied. */
void scene_lua_run_file(lua_State *L);
/* Keeps the function on top of the stack as a formula and pops it. */
void scene_lua_keep_formula(lua_State *L, enum solver_formula formula);

/* Leaves the protected call with "FILE[:LINE]: ..." as the error. */
_Noreturn void scene_refuse(lua_State *L, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* "FILE: KEY: expected EXPECTED, got VALUE", the value being at `index`. */
_Noreturn void scene_refuse_value(lua_State *L, const char *key, const char *expected, int index);

/* --- what a scene sees and sets: scene_globals.c --- */

void scene_globals_open(lua_State *L);
/* Pushes the environment of the scene file. */
void scene_globals_push(lua_State *L);
/* Makes everything that formulas captured unchangeable, so that a formula cannot keep state between calls. */
void scene_globals_freeze(lua_State *L);
/* Refuses a formula that has just changed a variable it captured. */
void scene_globals_check(lua_State *L);
/* Pushes the value at a path, nil if absent. */
void scene_lua_push(lua_State *L, const char *path);
/* Sets the value at a path from the top of the stack and pops it. */
void scene_lua_set(lua_State *L, const char *path);

/* --- overrides: scene_overrides.c --- */

bool scene_overrides_parse(struct solver_scene_lua *lua, const char *const *overrides, size_t count,
                           struct solver_error *error);
/* Applies those that begin with the key `root`, which has just been assigned. */
void scene_overrides_apply(lua_State *L, const char *root);
/* Applies those of keys that the file left alone; refuses the rest. */
void scene_overrides_finish(lua_State *L);
/* Pushes a value spelt as on the command line: number, true, false, list or word. */
void scene_push_spelling(lua_State *L, const char *key, const char *text);

/* --- readers: scene_values.c (plain keys); scene_bodies.c, scene_resolution.c, scene_lists.c and scene_measures.c
 *     (structured ones) --- */

double scene_read_number(lua_State *L, const char *key, int index, double low, double high, const char *expected);
/* Copies a string of fewer than `size` bytes. */
void scene_read_text(lua_State *L, const char *key, int index, char *out, size_t size);
void scene_read_numbers(lua_State *L, const char *key, int index, double *out, size_t count);
/* Pushes the table at `path`, nil if absent; true if it is there. */
bool scene_push_table(lua_State *L, const char *path, const char *expected);
/* Length of the list on top of the stack; entries under names are refused unless `named_too`. */
size_t scene_list_length(lua_State *L, const char *key, size_t limit, bool named_too);
void scene_read_plain(lua_State *L, struct solver_scene *scene);
/* Planes of symmetry: they cut the domain, which is there; then, once faces are there, they hold its lower ones. */
void scene_read_symmetry(lua_State *L, struct solver_scene *scene);
void scene_hold_symmetry(lua_State *L, struct solver_scene *scene);
/* Domain or bodies; the plain keys are there. */
void scene_read_bodies(lua_State *L, struct solver_scene *scene);
/* Walls by paths: scene_die.c. */
void scene_read_die(lua_State *L, struct solver_scene *scene);
extern const char scene_face_kinds[]; /* words */
void scene_read_faces(lua_State *L, struct solver_scene *scene);
/* Refuses conditions that the scene's lattice does not allow. */
void scene_check_faces(lua_State *L, const struct solver_scene *scene);
/* n and levels; bodies and faces are there. */
void scene_read_resolution(lua_State *L, struct solver_scene *scene);
void scene_read_probes(lua_State *L, struct solver_scene *scene);
void scene_read_oracle(lua_State *L, struct solver_scene *scene);
void scene_read_published(lua_State *L, struct solver_scene *scene);
void scene_read_gates(lua_State *L, struct solver_scene *scene);
void scene_read_beside(lua_State *L, struct solver_scene *scene);
void scene_read_trade(lua_State *L, struct solver_scene *scene);
/* After t_end is known. */
void scene_read_snapshots(lua_State *L, struct solver_scene *scene);
void scene_read_figures(lua_State *L, struct solver_scene *scene);

#endif
