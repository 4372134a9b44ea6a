#include "oracles/skyline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool skyline_create(struct skyline *skyline, size_t rows, const size_t *first)
{
    *skyline = (struct skyline){
        .rows = rows, .first = malloc(rows * sizeof *first), .start = malloc((rows + 1) * sizeof *first)};
    if (skyline->first != NULL && skyline->start != NULL) {
        memcpy(skyline->first, first, rows * sizeof *first);
        skyline->start[0] = 0;
        for (size_t i = 0; i < rows; i++) {
            skyline->start[i + 1] = skyline->start[i] + (i + 1 - first[i]);
        }
        skyline->entry = calloc(skyline->start[rows], sizeof(double));
    }
    if (skyline->entry == NULL) {
        skyline_free(skyline);
        return false;
    }
    return true;
}

void skyline_free(struct skyline *skyline)
{
    free(skyline->first);
    free(skyline->start);
    free(skyline->entry);
    *skyline = (struct skyline){0};
}

void skyline_add(struct skyline *skyline, size_t row, size_t column, double value)
{
    size_t low = row > column ? row : column, high = row > column ? column : row;
    skyline->entry[skyline->start[low] + high - skyline->first[low]] += value;
}

/* In eight sums side by side, which a processor works on at once; their order never changes. */
static double dot(const double *a, const double *b, size_t count)
{
    double sum[8] = {0}, rest = 0;
    size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        for (size_t k = 0; k < 8; k++) {
            sum[k] += a[i + k] * b[i + k];
        }
    }
    for (; i < count; i++) {
        rest += a[i] * b[i];
    }
    return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7])) + rest;
}

bool skyline_factorise(struct skyline *skyline)
{
    for (size_t i = 0; i < skyline->rows; i++) {
        size_t begin = skyline->first[i];
        double *row = skyline->entry + skyline->start[i];
        for (size_t j = begin; j <= i; j++) {
            const double *other = skyline->entry + skyline->start[j];
            size_t from = skyline->first[j] > begin ? skyline->first[j] : begin;
            double *entry = &row[j - begin];
            *entry -= dot(row + (from - begin), other + (from - skyline->first[j]), j - from);
            if (j < i) {
                *entry /= other[j - skyline->first[j]];
            } else if (*entry > 0) {
                *entry = sqrt(*entry);
            } else {
                return false; /* NaN as well */
            }
        }
    }
    return true;
}

void skyline_solve(const struct skyline *factor, double *b)
{
    for (size_t i = 0; i < factor->rows; i++) {
        const double *row = factor->entry + factor->start[i];
        size_t count = i - factor->first[i];
        b[i] = (b[i] - dot(row, b + factor->first[i], count)) / row[count];
    }
    for (size_t i = factor->rows; i-- > 0;) {
        const double *row = factor->entry + factor->start[i];
        size_t count = i - factor->first[i];
        b[i] /= row[count];
        for (size_t j = 0; j < count; j++) {
            b[factor->first[i] + j] -= row[j] * b[i];
        }
    }
}
