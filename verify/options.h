/* The command line: which options there are, which command takes which, and what they say. */
#ifndef VERIFY_OPTIONS_H
#define VERIFY_OPTIONS_H

#include "solver/error.h"
#include "solver/scene.h"
#include "verify/pace.h"

#include <stddef.h>
#include <stdio.h>

/* Exit codes of the program. */
enum verify_exit {
    VERIFY_PASSED = 0,     /* done; all gates pass */
    VERIFY_FAILED = 1,     /* a gate or a comparison fails */
    VERIFY_BAD_INPUT = 2,  /* command line, scene or file is wrong */
    VERIFY_RUN_FAILED = 3, /* the run itself failed */
    VERIFY_STOPPED = 128,  /* a signal ended it, whose number is added (signals.h) */
};

enum { VERIFY_OVERRIDES = 64, VERIFY_OPERANDS = 16, VERIFY_COMMAND_LINE = 2048 };

/* Options a command may take, as a bit set. */
enum verify_takes {
    VERIFY_TAKES_SET = 1,
    VERIFY_TAKES_LEVELS = 2,
    VERIFY_TAKES_JSON = 4,
    VERIFY_TAKES_OUT = 8,
    VERIFY_TAKES_PICTURE = 16,
    VERIFY_TAKES_DIR = 32,
    VERIFY_TAKES_ORACLE = 64, /* --oracle NAME */
    VERIFY_TAKES_PARAM = 128, /* --param KEY=VALUE, --typical */
    VERIFY_TAKES_NORM = 256,
    VERIFY_TAKES_GATE = 512,
    VERIFY_TAKES_ORDER = 1024,
    VERIFY_TAKES_TIME = 2048,
    VERIFY_TAKES_SPACING = 4096,
    VERIFY_TAKES_PLACES = 8192, /* --points FILE, --grid RANGES, --inside */
    VERIFY_TAKES_TABLE = 16384, /* --output FILE.h5 or FILE.csv */
    VERIFY_TAKES_TOLERANCE = 32768,
    VERIFY_TAKES_MUTATIONS = 65536, /* --mutations, in place of any word */
    VERIFY_TAKES_VARY = 1 << 17,
    VERIFY_TAKES_BUDGET = 1 << 18,
    VERIFY_TAKES_ERROR_NAME = 1 << 19, /* --error NAME */
    VERIFY_TAKES_ERROR = 1 << 20,      /* --error [NAME=]BOUND */
    VERIFY_TAKES_STUDY = 1 << 21,      /* --study FILE */
    VERIFY_TAKES_CHECKPOINT = 1 << 22, /* --checkpoint PACE, --restart FILE in place of any word, --as-stored */
};

/* What an option that may be repeated was given, in order. */
struct verify_list {
    size_t count;
    const char *text[VERIFY_OVERRIDES];
};

struct verify_options {
    size_t operand_count;
    const char *operand[VERIFY_OPERANDS];
    size_t override_count;
    const char *override[VERIFY_OVERRIDES]; /* "KEY=value" */
    size_t level_count;                     /* 0: those of the scene */
    int level[SOLVER_LEVELS];
    const char *json, *out, *picture, *dir; /* NULL where not given */
    bool has_tolerance;
    double tolerance[2];                                           /* shares of pixels: in all, within the worst tile */
    const char *oracle, *times, *spacings, *points, *grid, *table; /* NULL where not given */
    struct verify_list param, norm, gate, order, vary;
    const char *error, *study; /* NULL where not given */
    double budget;             /* [s]; 0 where not given */
    bool typical;              /* the oracle's typical values in place of what is not given */
    bool inside;               /* places outside the body are left out */
    bool help;
    bool mutations;
    struct verify_pace checkpoint; /* zeros where not given */
    const char *restart;           /* NULL where not given */
    bool as_stored;                /* the scene's file may have changed since */
    char
        line[VERIFY_COMMAND_LINE]; /* the command line as typed, for the record; without --checkpoint, --out and --json,
                                      which no result depends on, so that equal runs leave equal bytes anywhere */
};

/* One command of the program. */
struct verify_command {
    const char *name;
    const char *operands; /* "SCENE", as the usage line prints them */
    const char *summary;  /* one line */
    const char *help;     /* paragraphs and examples */
    unsigned takes;
    size_t least, most; /* operands */
    int (*run)(const struct verify_options *options);
};

/* Reads the words after the command's name. Errors (SOLVER_BAD_INPUT) name the word and suggest what was meant. */
bool verify_options_parse(const struct verify_command *command, int count, char *const *words,
                          struct verify_options *options, struct solver_error *error);

/* Refuses --set n and --set levels, for commands that choose n otherwise; `how` says which way. */
bool verify_refuse_n(const struct verify_options *options, const char *how, struct solver_error *error);
extern const char verify_by_levels[];

/* The options of a command, as help and manual show them; returns how many there are. */
struct verify_option_line {
    char words[48];   /* "-s, --set KEY=VALUE", or "    --oracle NAME" */
    const char *help; /* one line */
};
enum { VERIFY_OPTIONS = 32 }; /* no command has more */
size_t verify_options_lines(const struct verify_command *command, struct verify_option_line line[VERIFY_OPTIONS]);

/* Usage line, help and options of one command. */
void verify_options_help(FILE *file, const struct verify_command *command);

/* The exit code that belongs to an error. */
enum verify_exit verify_exit_code(const struct solver_error *error);

#endif
