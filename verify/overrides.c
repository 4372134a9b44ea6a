#include "verify/overrides.h"

#include <stdio.h>
#include <string.h>

const char *verify_said(const struct verify_options *options, const char *key)
{
    size_t length = strlen(key);
    for (size_t i = options->override_count; i-- > 0;) {
        if (strncmp(options->override[i], key, length) == 0 && options->override[i][length] == '=') {
            return options->override[i] + length + 1;
        }
    }
    return NULL;
}

void verify_say_unless(struct verify_options *options, const char *key, char text[SOLVER_NAME], const char *value)
{
    if (value != NULL && verify_said(options, key) == NULL && options->override_count < VERIFY_OVERRIDES) {
        (void)snprintf(text, SOLVER_NAME, "%s=%s", key, value);
        options->override[options->override_count++] = text;
    }
}

void verify_say(struct verify_options *options, const char *words)
{
    if (options->override_count < VERIFY_OVERRIDES) {
        options->override[options->override_count++] = words;
    }
}
