/* Eight doubles as one value, and eight complex numbers as two; private to lib/mesh/lanes*.c and lines-fold.c. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LANES_VECTOR_H
#define PM_LANES_VECTOR_H

#include "mesh/lanes.h"

#pragma GCC diagnostic ignored "-Wpsabi" /* vectors never cross a call: everything that passes them is inlined */
#define ALWAYS static inline __attribute__((always_inline))

typedef double v8 __attribute__((vector_size(64)));
typedef double v8_anywhere __attribute__((vector_size(64), aligned(8)));
struct c8 {
	v8 re, im;
};

#endif
