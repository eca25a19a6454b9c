/* Transforms of four and of eight complex numbers of the lanes of a block; private to lib/fft. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_BUTTERFLY_H
#define PM_FFT_BUTTERFLY_H

#include "fft/fft-vector.h"

/* -i*a forward, +i*a back */
PM_SIMD_INLINE struct lanes turn(struct lanes a, bool back) { return back ? (struct lanes){-a.im, a.re} : (struct lanes){a.im, -a.re}; }

PM_SIMD_INLINE void dft4(struct lanes *a0, struct lanes *a1, struct lanes *a2, struct lanes *a3, bool back)
{
	struct lanes s = plus(*a0, *a2), d = minus(*a0, *a2), t = plus(*a1, *a3), e = turn(minus(*a1, *a3), back);
	*a0 = plus(s, t), *a1 = plus(d, e), *a2 = minus(s, t), *a3 = minus(d, e);
}

struct eight {
	struct lanes a0, a1, a2, a3, a4, a5, a6, a7; /* named variables, because the compiler would put an array into memory */
};

PM_SIMD_INLINE void dft8(struct eight *x, bool back)
{
	const double h = 0.70710678118654752440;
	dft4(&x->a0, &x->a2, &x->a4, &x->a6, back);
	dft4(&x->a1, &x->a3, &x->a5, &x->a7, back);
	struct lanes t = turn(x->a3, back), v = turn(x->a7, back), o2 = turn(x->a5, back); /* exp(-+i pi/4) = h (1 -+ i) */
	struct lanes o1 = {h * (x->a3.re + t.re), h * (x->a3.im + t.im)}, o3 = {h * (v.re - x->a7.re), h * (v.im - x->a7.im)}, o0 = x->a1;
	struct lanes e0 = x->a0, e1 = x->a2, e2 = x->a4, e3 = x->a6;
	x->a0 = plus(e0, o0), x->a1 = plus(e1, o1), x->a2 = plus(e2, o2), x->a3 = plus(e3, o3);
	x->a4 = minus(e0, o0), x->a5 = minus(e1, o1), x->a6 = minus(e2, o2), x->a7 = minus(e3, o3);
}

#endif
