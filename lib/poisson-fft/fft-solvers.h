/* A few solvers by transforms kept ready, one for each kind of faces that the components of a source have. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_FFT_SOLVERS_H
#define PM_POISSON_FFT_SOLVERS_H

#include "poisson-fft/poisson-fft.h"

enum { PM_FFT_SOLVERS = 8 }; /* kinds of faces of a vector: one for each axis as the normal one, and one for other components; of given
	* values two for each axis, and one */

struct pm_fft_solvers {
	int n;
	struct pm_fft_made {
		struct pm_poisson_fft *solver;
		struct pm_grid grid;
		enum pm_symbol symbol;
		int fitted;
		double softening;
		struct pm_influence influence;
	} made[PM_FFT_SOLVERS];
};

/* The solver for a grid; NULL if there is none yet, of several ranks on any of them (one is made by all together). Of the choice only symbol,
 * fitted, softening, influence and planes may differ between calls. */
struct pm_poisson_fft *pm_fft_solvers_find(const struct pm_fft_solvers *s, const struct pm_grid *g, const struct pm_poisson_fft_choice *o);
/* Makes one; a scalar source (alone) needs no other beside it. NULL with a message. */
struct pm_poisson_fft *pm_fft_solvers_add(struct pm_fft_solvers *s, const struct pm_grid *g, const struct pm_poisson_fft_choice *o, bool alone);
void pm_fft_solvers_clear(struct pm_fft_solvers *s);

#endif
