/* What the machine can do at best, measured on itself: one side of the roofline; timing.h has the other. */
#ifndef VERIFY_ROOFLINE_H
#define VERIFY_ROOFLINE_H

/* Operations per second of multiply-adds in the widest vectors of the path in use (solver/path.h), two each; the best
 * of several samples, all threads together. */
double verify_roof_flops(int threads);
/* The share of the roofline min(peak, flops / bytes * bandwidth) that so many operations on so many bytes reach in
 * `seconds`. */
double verify_roof_share(double flops, double bytes, double seconds, double peak, double bandwidth);

#endif
