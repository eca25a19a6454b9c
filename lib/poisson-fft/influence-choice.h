/* The influence function that words and a source ask for: what poisson-fft does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_FFT_INFLUENCE_CHOICE_H
#define PM_POISSON_FFT_INFLUENCE_CHOICE_H

#include "law/law.h"
#include "poisson-fft/influence.h"

struct pm_influence_choice {
	const char *name, *symbol; /* one of pm_influence_names; as typed, or NULL */
	const char *order;         /* of the gradient that will compute the law's field; NULL: the law's */
	double cloud;              /* [length] diameter, 0: points */
};

/* With the kernel of the source. 0 or failure. */
int pm_influence_choose(const struct pm_influence_choice *o, const struct pm_law *law, const struct pm_field *source, struct pm_influence *i);

#endif
