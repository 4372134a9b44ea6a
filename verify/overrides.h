/* What the command line says of a scene's keys, and what a command adds to it. */
#ifndef VERIFY_OVERRIDES_H
#define VERIFY_OVERRIDES_H

#include "verify/options.h"

/* What the command line says of a key, or NULL. */
const char *verify_said(const struct verify_options *options, const char *key);
/* Adds KEY=VALUE, spelt into `text`, unless the command line says something of the key, or there is no value. */
void verify_say_unless(struct verify_options *options, const char *key, char text[SOLVER_NAME], const char *value);
/* Adds "KEY=VALUE", whatever the command line says. The words must outlive the options. */
void verify_say(struct verify_options *options, const char *words);

#endif
