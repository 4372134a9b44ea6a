/* Signals that ask the program to end while a run is under way: SIGINT (Ctrl-C), SIGTERM and SIGHUP. The first is
 * noted, so that the run can stop after its step and be kept; another ends the program at once, as every one does while
 * nothing is watched: files are whole or absent whenever that is. The same one within a fifth of a second is no other:
 * timeout(1) sends its own twice. A signal that was ignored when the program started, as under nohup, stays so. */
#ifndef VERIFY_SIGNALS_H
#define VERIFY_SIGNALS_H

/* A file that grows beyond the limit of the process (ulimit -f) is then an error with a message, not the end. */
void verify_signals_prepare(void);

/* From here on the first signal is noted. */
void verify_signals_watch(void);
/* The number of the one that came; 0: none. */
int verify_signals_asked(void);
/* "SIGINT", for messages. */
const char *verify_signals_name(int number);
/* Back to what was before; what has come stays noted. */
void verify_signals_leave(void);

/* Ends the program by the signal that came, so that whoever started it sees by which: a shell gets 128 + its number. */
int verify_signals_follow(void);

#endif
