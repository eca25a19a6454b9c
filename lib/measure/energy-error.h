/* The energy error of a run of bodies on a mesh, told once by diag. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_ENERGY_ERROR_H
#define PM_MEASURE_ENERGY_ERROR_H

#include "measure/measure.h"

struct pm_energy_error { /* zero at first */
	bool known;
	double first; /* [energy] of the first frame that has one */
	int64_t step;
};

/* True, with a sentence, if |dE/E| has passed the bound and the energy should have been kept. */
bool pm_energy_error_note(struct pm_energy_error *e, const struct pm_measure *how, const struct pm_frame *f, const struct pm_measures *m, char text[320]);

#endif
