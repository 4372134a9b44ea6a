#include "verify/signals.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

static const struct {
    int number;
    const char *name;
} watched[] = {{SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"}};
enum { WATCHED = sizeof watched / sizeof *watched };

/* timeout(1) sends its signal to the program and then to the program's group: that is one wish. Nobody who means two is
 * as fast [ns]. */
static const long together = 200 * 1000 * 1000;

static volatile sig_atomic_t asked;
static struct timespec first; /* when */
static struct sigaction before[WATCHED];

void verify_signals_prepare(void)
{
    (void)signal(SIGXFSZ, SIG_IGN);
}

/* Whether the first signal came just now. */
static bool just_now(void)
{
    struct timespec now = first;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (now.tv_sec - first.tv_sec) * 1000000000L + now.tv_nsec - first.tv_nsec < together;
}

static void note(int number)
{
    static const char said[] = "\nassay: stopping after this step, or when the run is set up or its record written; "
                               "once more ends it at once\n";
    if (asked == number && just_now()) {
        return;
    }
    if (asked != 0) {
        (void)signal(number, SIG_DFL);
        (void)raise(number); /* takes effect when this returns */
        return;
    }
    int kept = errno;
    (void)clock_gettime(CLOCK_MONOTONIC, &first);
    asked = number;
    ssize_t written = write(STDERR_FILENO, said, sizeof said - 1);
    (void)written;
    errno = kept;
}

void verify_signals_watch(void)
{
    struct sigaction action = {.sa_handler = note, .sa_flags = SA_RESTART};
    (void)sigemptyset(&action.sa_mask);
    for (int i = 0; i < WATCHED; i++) {
        (void)sigaction(watched[i].number, NULL, &before[i]);
        if (before[i].sa_handler != SIG_IGN) {
            (void)sigaction(watched[i].number, &action, NULL);
        }
    }
}

int verify_signals_asked(void)
{
    return asked;
}

const char *verify_signals_name(int number)
{
    for (int i = 0; i < WATCHED; i++) {
        if (watched[i].number == number) {
            return watched[i].name;
        }
    }
    return "a signal";
}

void verify_signals_leave(void)
{
    for (int i = 0; i < WATCHED; i++) {
        (void)sigaction(watched[i].number, &before[i], NULL);
    }
}

int verify_signals_follow(void)
{
    int number = asked;
    (void)fflush(stdout);
    (void)signal(number, SIG_DFL);
    (void)raise(number);
    return 128 + number; /* where the signal is blocked */
}
