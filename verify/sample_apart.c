#include "verify/sample_apart.h"

#include <errno.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* What goes before each sample; its own pointers mean nothing to the other side. */
struct message {
    bool ok, weights;
    size_t samples; /* how many follow, this one among them */
    struct solver_error error;
    struct verify_sample sample;
};

static bool write_all(int fd, const void *bytes, size_t size)
{
    for (const char *at = bytes; size > 0;) {
        ssize_t written = write(fd, at, size);
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            return false;
        }
        at += written;
        size -= (size_t)written;
    }
    return true;
}

static bool read_all(int fd, void *bytes, size_t size)
{
    for (char *at = bytes; size > 0;) {
        ssize_t got = read(fd, at, size);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            return false;
        }
        at += got;
        size -= (size_t)got;
    }
    return true;
}

static bool send_sample(int fd, const struct verify_sample *sample)
{
    bool ok = write_all(fd, sample->X, 3 * sample->count * sizeof(double)) &&
              (sample->weight == NULL || write_all(fd, sample->weight, sample->count * sizeof(double)));
    for (size_t i = 0; ok && i < sample->field_count; i++) {
        const struct verify_sample_field *field = &sample->field[i];
        ok = write_all(fd, field->value, (size_t)field->width * sample->count * sizeof(double));
    }
    return ok;
}

/* Limits what a reader that was led astray can do. Address sanitizers reserve more than any limit. */
static void limit(unsigned seconds, size_t bytes)
{
    struct rlimit time = {seconds, seconds}, none = {0, 0};
    (void)setrlimit(RLIMIT_CPU, &time);
    (void)setrlimit(RLIMIT_CORE, &none);
#ifndef __SANITIZE_ADDRESS__
    rlim_t most = (rlim_t)1 << 31;
    most += 64 * (rlim_t)bytes;
    struct rlimit memory = {most, most};
    (void)setrlimit(RLIMIT_DATA, &memory);
#else
    (void)bytes;
#endif
}

static _Noreturn void read_apart(verify_sample_reader *read, int fd, const char *path, size_t bytes)
{
    static struct message message;
    static struct verify_samples samples;
    (void)signal(SIGPIPE, SIG_DFL);
    message.ok = read(path, bytes, &samples, &message.error);
    message.samples = samples.count;
    bool sent = message.ok || write_all(fd, &message, sizeof message);
    for (size_t i = 0; sent && message.ok && i < samples.count; i++) {
        message.sample = *samples.sample[i];
        message.weights = samples.sample[i]->weight != NULL;
        message.samples = samples.count - i;
        sent = write_all(fd, &message, sizeof message) && send_sample(fd, samples.sample[i]);
    }
    _exit(sent ? 0 : 1);
}

static bool ends(const char *text, size_t size)
{
    return memchr(text, '\0', size) != NULL;
}

/* What a reader in its right mind would send of a file of so many bytes. */
static bool is_sound(const struct message *message, size_t bytes)
{
    const struct verify_sample *sample = &message->sample;
    size_t most = bytes * VERIFY_MOST_PACKED;
    bool sound = message->samples >= 1 && message->samples <= VERIFY_SAMPLES && sample->count >= 1 &&
                 sample->count <= most && sample->dim >= 1 && sample->dim <= 3 && sample->n >= 0 &&
                 sample->field_count <= VERIFY_SAMPLE_FIELDS && ends(sample->place, sizeof sample->place) &&
                 ends(sample->unit, sizeof sample->unit) && ends(sample->time.unit, sizeof sample->time.unit) &&
                 ends(sample->h.unit, sizeof sample->h.unit);
    for (size_t i = 0; sound && i < sample->field_count; i++) {
        const struct verify_sample_field *field = &sample->field[i];
        sound = ends(field->name, sizeof field->name) && ends(field->unit, sizeof field->unit) && field->width >= 1 &&
                field->width <= 9;
    }
    return sound;
}

/* Takes over all of a sample but its numbers. */
static bool prepare(const struct message *message, struct verify_sample *sample, struct solver_error *error)
{
    const struct verify_sample *from = &message->sample;
    struct verify_sample empty = *from;
    empty.X = empty.weight = NULL;
    empty.field_count = 0;
    *sample = empty;
    if (!verify_sample_points(sample, from->count, from->dim, error) ||
        (message->weights && !verify_sample_weights(sample, error))) {
        return false;
    }
    for (size_t i = 0; i < from->field_count; i++) {
        struct verify_sample_field *field = verify_sample_add(sample, from->field[i].name, from->field[i].width, error);
        if (field == NULL) {
            return false;
        }
        field->has_unit = from->field[i].has_unit;
        memcpy(field->unit, from->field[i].unit, sizeof field->unit);
    }
    return true;
}

static bool lost(const char *path, struct solver_error *error)
{
    return solver_fail(error, SOLVER_BAD_INPUT,
                       "%.360s: the library that reads such files did not survive it: the file is damaged", path);
}

static bool receive_sample(int fd, struct verify_sample *sample, const char *path, struct solver_error *error)
{
    bool got = read_all(fd, sample->X, 3 * sample->count * sizeof(double)) &&
               (sample->weight == NULL || read_all(fd, sample->weight, sample->count * sizeof(double)));
    for (size_t i = 0; got && i < sample->field_count; i++) {
        struct verify_sample_field *field = &sample->field[i];
        got = read_all(fd, field->value, (size_t)field->width * sample->count * sizeof(double));
    }
    return got || lost(path, error);
}

static bool receive(int fd, const char *path, size_t bytes, struct verify_samples *samples, struct solver_error *error)
{
    static struct message message;
    do {
        if (!read_all(fd, &message, sizeof message)) {
            return lost(path, error);
        }
        if (!message.ok) {
            *error = message.error;
            error->text[sizeof error->text - 1] = '\0';
            error->code = error->code == SOLVER_NO_MEMORY || error->code == SOLVER_IO ? error->code : SOLVER_BAD_INPUT;
            return false;
        }
        if (!is_sound(&message, bytes)) {
            return lost(path, error);
        }
        struct verify_sample *sample = verify_samples_add(samples, message.sample.place, error);
        if (sample == NULL || !prepare(&message, sample, error) || !receive_sample(fd, sample, path, error)) {
            return false;
        }
    } while (message.samples > 1);
    return true;
}

/* Whether the process ended as one does that has said all. */
static bool ended_well(pid_t child)
{
    int status = 0;
    pid_t ended;
    do {
        ended = waitpid(child, &status, 0);
    } while (ended < 0 && errno == EINTR);
    return ended == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool verify_sample_apart(verify_sample_reader *read, unsigned seconds, const char *path, size_t bytes,
                         struct verify_samples *samples, struct solver_error *error)
{
    int ends_of_pipe[2];
    if (pipe(ends_of_pipe) != 0) {
        return solver_fail(error, SOLVER_IO, "%.360s: no pipe to read it through: %s", path, strerror(errno));
    }
    pid_t child = fork();
    if (child == 0) {
        (void)close(ends_of_pipe[0]);
        limit(seconds, bytes);
        read_apart(read, ends_of_pipe[1], path, bytes);
    }
    int number = errno;
    (void)close(ends_of_pipe[1]);
    bool done = child > 0 ? receive(ends_of_pipe[0], path, bytes, samples, error)
                          : solver_fail(error, SOLVER_IO, "%.360s: no process to read it: %s", path, strerror(number));
    (void)close(ends_of_pipe[0]);
    bool well = child <= 0 || ended_well(child);
    return done && !well ? lost(path, error) : done;
}
