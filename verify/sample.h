/* A sample: what a file says of a body at one time. Any solver may have written it; nothing in it is trusted before it
 * has been checked. */
#ifndef VERIFY_SAMPLE_H
#define VERIFY_SAMPLE_H

#include "solver/error.h"

#include <stdbool.h>
#include <stddef.h>

enum {
    VERIFY_SAMPLES = 16, /* levels of one judgement: as many as a study has */
    VERIFY_SAMPLE_FIELDS = 64,
    VERIFY_SAMPLE_NAME = 64,
    VERIFY_SAMPLE_UNIT = 32,
    VERIFY_SAMPLE_PLACE = 512,
    VERIFY_MOST_PACKED = 1032 /* deflate shrinks nothing by more: what a file can hold is its size times this */
};

struct verify_sample_field {
    char name[VERIFY_SAMPLE_NAME];
    char unit[VERIFY_SAMPLE_UNIT]; /* as given; meaningless where none is */
    bool has_unit;
    int width;      /* numbers a point: 1 scalar; 2, 3 vector; 4, 6, 9 tensor */
    unsigned given; /* bit i: component i is known; tables may leave some out */
    double *value;  /* [count][width] */
};

/* A single number beside the points: the time, or the spacing. */
struct verify_sample_number {
    double value; /* NaN: not given */
    char unit[VERIFY_SAMPLE_UNIT];
    bool has_unit;
};

struct verify_sample {
    char place[VERIFY_SAMPLE_PLACE]; /* for messages: "run.h5: /coarse" */
    size_t count;
    int dim;                       /* coordinates given of each point, 1 to 3 */
    bool single;                   /* they were stored in single precision */
    bool needs_units;              /* the format has a place for units, so that a missing one is a mistake */
    char unit[VERIFY_SAMPLE_UNIT]; /* of the points */
    bool has_unit;
    struct verify_sample_number time, h;
    int n;          /* spacings along the reference length; 0: not given */
    double *X;      /* [count][3]; 0 beyond dim */
    double *weight; /* [count], NULL: none given */
    size_t field_count;
    struct verify_sample_field field[VERIFY_SAMPLE_FIELDS];
};

struct verify_samples {
    size_t count;
    struct verify_sample *sample[VERIFY_SAMPLES]; /* owned */
};

/* Adds an empty sample of this place; NULL, with the error, if there is no room or memory. */
struct verify_sample *verify_samples_add(struct verify_samples *samples, const char *place, struct solver_error *error);
void verify_samples_free(struct verify_samples *samples);

/* "PLACE: WHAT ...", SOLVER_BAD_INPUT; always false. */
bool verify_sample_refuse(const struct verify_sample *sample, struct solver_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Makes room for the points, not filled in yet; `count` must have been checked against what the file can hold. */
bool verify_sample_points(struct verify_sample *sample, size_t count, int dim, struct solver_error *error);
/* The same for weights and for a field of `width` numbers a point. A field's name may carry its unit: "u [mm]". NULL if
 * there is no room or memory, or a field of that name is there already. */
bool verify_sample_weights(struct verify_sample *sample, struct solver_error *error);
struct verify_sample_field *verify_sample_add(struct verify_sample *sample, const char *name, int width,
                                              struct solver_error *error);

/* Takes a single number by its name: "time", "TimeValue", "t", "h", "spacing", "n", whatever the case; others are
 * passed over. `unit` may be NULL. False if the number cannot be what its name says. */
bool verify_sample_number(struct verify_sample *sample, const char *name, double value, const char *unit,
                          struct solver_error *error);
bool verify_sample_is_number(const char *name);
/* Whether a field of this name holds the weights of the points: "weight", "weights", "volume". */
bool verify_sample_is_weight(const char *name);

/* Reads a file of any format the judge knows, by what stands in it, and adds its samples. Numbers that are not finite
 * are refused. */
bool verify_sample_read(const char *path, struct verify_samples *samples, struct solver_error *error);

/* The formats, each of a whole file in memory (bytes[size] is 0) or by its name. */
bool verify_sample_csv(const char *path, char *bytes, size_t size, struct verify_samples *samples,
                       struct solver_error *error);
bool verify_sample_vtu(const char *path, char *bytes, size_t size, struct verify_samples *samples,
                       struct solver_error *error);
/* In a process of its own: the HDF5 library crashes on some damaged files, which then is an error like any other. */
bool verify_sample_hdf5(const char *path, size_t size, struct verify_samples *samples, struct solver_error *error);

#endif
