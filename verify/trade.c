#include "verify/trade.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name, *meaning;
} costs[VERIFY_COSTS] = {
    [VERIFY_PAIRS] = {"pair_evaluations", "right-hand sides times pairs"},
    [VERIFY_BYTES] = {"bytes", "bytes moved by the time loop"},
    [VERIFY_SECONDS] = {"seconds", "wall time of set-up and time loop [s]"},
};

const char *verify_cost_name(enum verify_cost cost)
{
    return costs[cost].name;
}

const char *verify_cost_meaning(enum verify_cost cost)
{
    return costs[cost].meaning;
}

/* FNV-1a, 64 bits. */
const uint64_t verify_trade_hash_start = 0xcbf29ce484222325u;

uint64_t verify_trade_hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    for (const unsigned char *c = bytes; c < (const unsigned char *)bytes + size; c++) {
        hash = (hash ^ *c) * 0x100000001b3u;
    }
    return hash;
}

uint64_t verify_trade_hash(const struct solver_scene *scene)
{
    uint64_t hash = verify_trade_hash_bytes(verify_trade_hash_start, scene->text, strlen(scene->text) + 1);
    return verify_trade_hash_bytes(hash, scene->overrides, strlen(scene->overrides));
}

bool verify_trade_begin(const struct solver_scene *scene, struct verify_trade *trade, struct solver_error *error)
{
    *trade = (struct verify_trade){.hash = verify_trade_hash(scene)};
    (void)snprintf(trade->scene, sizeof trade->scene, "%s", scene->name);
    (void)snprintf(trade->title, sizeof trade->title, "%s", scene->title);
    (void)snprintf(trade->oracle, sizeof trade->oracle, "%s", scene->oracle);
    trade->overrides = strdup(scene->overrides);
    return trade->overrides != NULL || solver_fail(error, SOLVER_NO_MEMORY, "no memory for a study");
}

bool verify_trade_reserve(struct verify_trade *trade, size_t more, struct solver_error *error)
{
    size_t wanted = trade->run_count + more;
    if (wanted > VERIFY_TRADE_RUNS) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "more than %d runs: fix some keys by --set, or name the values to try by --vary",
                           (int)VERIFY_TRADE_RUNS);
    }
    if (wanted <= trade->run_room) {
        return true;
    }
    size_t room = wanted > 2 * trade->run_room ? wanted : 2 * trade->run_room;
    struct verify_trade_run *run = realloc(trade->run, room * sizeof *run);
    if (run == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for a study of %zu runs", room);
    }
    trade->run = run;
    trade->run_room = room;
    return true;
}

void verify_trade_free(struct verify_trade *trade)
{
    free(trade->overrides);
    free(trade->run);
    trade->overrides = NULL;
    trade->run = NULL;
    trade->run_count = trade->run_room = 0;
}

bool verify_trade_key(const char *key, size_t length)
{
    static const char *const others[] = {"n", "seed"}; /* levels have an option, and no draw is a better method */
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        if (strlen(others[i]) == length && strncmp(others[i], key, length) == 0) {
            return false;
        }
    }
    return solver_scene_key_says(key, length) == SOLVER_KEY_METHOD;
}

bool verify_trade_word(const char *words, const char *key, char value[SOLVER_NAME])
{
    size_t length = strlen(key);
    for (const char *word = words; *word != '\0'; word += strspn(word, " ")) {
        size_t whole = strcspn(word, " ");
        if (whole > length && strncmp(word, key, length) == 0 && word[length] == '=') {
            return (size_t)snprintf(value, SOLVER_NAME, "%.*s", (int)(whole - length - 1), word + length + 1) <
                   SOLVER_NAME;
        }
        word += whole;
    }
    return false;
}

/* Whether all runs that have the key have one value of it. */
static bool shared(const struct verify_trade *trade, const char *key)
{
    char first[SOLVER_NAME] = "", value[SOLVER_NAME];
    for (size_t i = 0; i < trade->run_count; i++) {
        if (verify_trade_word(trade->run[i].words, key, value)) {
            if (first[0] != '\0' && strcmp(first, value) != 0) {
                return false;
            }
            (void)snprintf(first, sizeof first, "%s", value);
        }
    }
    return true;
}

void verify_trade_short(const struct verify_trade *trade, const struct verify_trade_run *run,
                        char text[VERIFY_TRADE_WORDS])
{
    size_t used = 0;
    text[0] = '\0';
    for (const char *word = run->words; *word != '\0'; word += strspn(word, " ")) {
        char key[SOLVER_NAME];
        size_t whole = strcspn(word, " "), equals = strcspn(word, "=");
        (void)snprintf(key, sizeof key, "%.*s", (int)equals, word);
        if (!shared(trade, key)) {
            size_t cut = equals + 1 < whole && isalpha((unsigned char)word[equals + 1]) ? equals + 1 : 0;
            used += (size_t)snprintf(text + used, VERIFY_TRADE_WORDS - used, "%s%.*s", used > 0 ? " " : "",
                                     (int)(whole - cut), word + cut);
        }
        word += whole;
    }
    if (used == 0) { /* nothing varies */
        used = (size_t)snprintf(text, VERIFY_TRADE_WORDS, "%s", run->words);
    }
    if (run->variant[0] != '\0' && used < VERIFY_TRADE_WORDS) {
        (void)snprintf(text + used, VERIFY_TRADE_WORDS - used, "%s(%s)", used > 0 ? " " : "", run->variant);
    }
}

static bool beats(const double *error, const double *cost, size_t one, size_t other)
{
    bool less = error[one] < error[other] || cost[one] < cost[other];
    return error[one] <= error[other] && cost[one] <= cost[other] && (less || one < other);
}

void verify_pareto(size_t count, const double *error, const double *cost, bool *front)
{
    for (size_t i = 0; i < count; i++) {
        front[i] = isfinite(error[i]) && isfinite(cost[i]);
        for (size_t j = 0; j < count && front[i]; j++) {
            front[i] = j == i || !isfinite(error[j]) || !isfinite(cost[j]) || !beats(error, cost, j, i);
        }
    }
}

bool verify_trade_fronts(struct verify_trade *trade, struct solver_error *error)
{
    size_t count = trade->run_count;
    double *point = calloc(2 * count + 1, sizeof *point);
    bool *front = calloc(count + 1, sizeof *front);
    bool there = point != NULL && front != NULL;
    for (int cost = 0; there && cost < VERIFY_COSTS; cost++) {
        for (size_t i = 0; i < count; i++) {
            bool measured =
                trade->run[i].end == VERIFY_MEASURED && !(trade->relative && trade->run[i].error[trade->chosen] >= 1);
            point[i] = measured ? trade->run[i].error[trade->chosen] : NAN;
            point[count + i] = measured ? trade->run[i].cost[cost] : NAN;
        }
        verify_pareto(count, point, point + count, front);
        for (size_t i = 0; i < count; i++) {
            trade->run[i].front[cost] = front[i];
        }
    }
    free(point);
    free(front);
    return there || solver_fail(error, SOLVER_NO_MEMORY, "no memory for the fronts of %zu runs", count);
}

size_t verify_trade_cheapest(const struct verify_trade *trade, size_t error, double bound, enum verify_cost cost,
                             bool own)
{
    size_t found = trade->run_count;
    for (size_t i = 0; i < trade->run_count; i++) {
        const struct verify_trade_run *run = &trade->run[i];
        bool reaches = run->end == VERIFY_MEASURED && islessequal(run->error[error], bound) && (run->own || !own);
        if (reaches && (found == trade->run_count || run->cost[cost] < trade->run[found].cost[cost])) {
            found = i;
        }
    }
    return found;
}

size_t verify_trade_best(const struct verify_trade *trade, size_t error)
{
    size_t found = trade->run_count;
    for (size_t i = 0; i < trade->run_count; i++) {
        const struct verify_trade_run *run = &trade->run[i];
        if (run->end == VERIFY_MEASURED && isfinite(run->error[error]) &&
            (found == trade->run_count || run->error[error] < trade->run[found].error[error])) {
            found = i;
        }
    }
    return found;
}

void verify_trade_stopped(const struct verify_trade *trade, char *text, size_t size)
{
    size_t measured = 0, begun = 0;
    for (size_t i = 0; i < trade->run_count; i++) {
        measured += trade->run[i].end == VERIFY_MEASURED;
        while (begun < trade->level_count && trade->level[begun] != trade->run[i].n) {
            begun++;
        }
    }
    size_t used = (size_t)snprintf(text, size, "stopped by %s: %zu of %zu runs were measured", trade->stopped, measured,
                                   trade->run_count);
    for (size_t i = begun + 1; i < trade->level_count && used < size; i++) {
        used += (size_t)snprintf(text + used, size - used, "%s%d", i == begun + 1 ? "; not begun: n = " : ", ",
                                 trade->level[i]);
    }
}

size_t verify_trade_error(const struct verify_trade *trade, const char *name)
{
    size_t i = 0;
    while (i < trade->error_count && strcmp(trade->error_name[i], name) != 0) {
        i++;
    }
    return i;
}
