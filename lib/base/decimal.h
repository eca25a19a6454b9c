/* Decimal text to double and back, exactly and fast: what is read is the nearest double, what is written reads back to the same bits.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BASE_DECIMAL_H
#define PM_BASE_DECIMAL_H

#include "base/base.h"

enum { PM_DECIMAL_LENGTH = 32 }; /* bytes that pm_decimal_write needs at most, the final 0 included */

/* The number that starts at text, which must end in a byte that is no part of a number (a blank or 0). Returns the bytes used, 0 where none starts;
 * nan, inf and what is too large for a double give an *x that is not finite. */
size_t pm_decimal_read(const char *text, double *x);
size_t pm_integer_read(const char *text, int64_t *x); /* the same for a whole number; 0 also where it does not fit */
/* The shortest of 15, 16 or 17 digits that reads back to the same double; returns the length. float_digits: of 6 to 9, to the same float. */
size_t pm_decimal_write(char *out, double x, bool float_digits);

#endif
