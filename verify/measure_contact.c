/* Measures of bodies that collide. */
#include "verify/measures.h"

bool verify_contact_time(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                         struct solver_error *error)
{
    (void)argument;
    (void)error;
    *value = in->history->contact_end - in->history->contact_begin;
    return true;
}

bool verify_body_velocity(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                          struct solver_error *error)
{
    (void)error;
    *value = in->history->body_velocity[argument[0].body][0];
    return true;
}
