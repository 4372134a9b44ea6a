/* Signals that ask a run to stop. Each attempt is a process of its own. */
#include "tests/unit/unit.h"
#include "verify/signals.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { NOTHING_NOTED = 1, NOTED = 2 };

/* After what `act` does: the signal it died of, or minus what it exits with. */
static int attempt(void (*act)(void))
{
    int status = 0;
    (void)fflush(NULL);
    pid_t child = fork();
    CU_ASSERT_FATAL(child >= 0);
    if (child == 0) {
        (void)dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
        (void)signal(SIGINT, SIG_DFL);
        (void)signal(SIGTERM, SIG_DFL);
        act();
        _exit(verify_signals_asked() != 0 ? NOTED : NOTHING_NOTED);
    }
    CU_ASSERT_FATAL(waitpid(child, &status, 0) == child);
    return WIFSIGNALED(status) ? WTERMSIG(status) : -WEXITSTATUS(status);
}

static void watch_and_raise(int number)
{
    verify_signals_watch();
    (void)raise(number);
}

static void wait_a_while(void)
{
    (void)nanosleep(&(struct timespec){.tv_nsec = 250 * 1000 * 1000}, NULL);
}

static void once(void)
{
    watch_and_raise(SIGTERM);
    if (verify_signals_asked() != SIGTERM) {
        _exit(NOTHING_NOTED);
    }
}

static void twice_at_once(void)
{
    watch_and_raise(SIGTERM);
    (void)raise(SIGTERM);
}

static void twice(void)
{
    watch_and_raise(SIGTERM);
    wait_a_while();
    (void)raise(SIGTERM);
}

static void another(void)
{
    watch_and_raise(SIGTERM);
    (void)raise(SIGINT);
}

static void ignored(void)
{
    (void)signal(SIGHUP, SIG_IGN);
    watch_and_raise(SIGHUP);
}

static void not_watched_any_more(void)
{
    verify_signals_watch();
    verify_signals_leave();
    (void)raise(SIGTERM);
}

static void followed(void)
{
    watch_and_raise(SIGTERM);
    verify_signals_leave();
    (void)verify_signals_follow();
}

static void what_comes_is_noted(void)
{
    CU_ASSERT_EQUAL(attempt(once), -NOTED);
    CU_ASSERT_EQUAL(attempt(twice_at_once), -NOTED);
    CU_ASSERT_EQUAL(attempt(ignored), -NOTHING_NOTED);
}

static void what_ends_the_program(void)
{
    CU_ASSERT_EQUAL(attempt(twice), SIGTERM);
    CU_ASSERT_EQUAL(attempt(another), SIGINT);
    CU_ASSERT_EQUAL(attempt(not_watched_any_more), SIGTERM);
    CU_ASSERT_EQUAL(attempt(followed), SIGTERM);
}

static void names(void)
{
    CU_ASSERT_STRING_EQUAL(verify_signals_name(SIGINT), "SIGINT");
    CU_ASSERT_STRING_EQUAL(verify_signals_name(SIGTERM), "SIGTERM");
    CU_ASSERT_STRING_EQUAL(verify_signals_name(SIGUSR1), "a signal");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"what comes is noted", what_comes_is_noted},
        {"what ends the program", what_ends_the_program},
        {"names", names},
    };
    return unit_main("signals", tests, sizeof tests / sizeof *tests);
}
