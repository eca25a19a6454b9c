/* Numerical Cherenkov radiation: on Yee's mesh a beam near the speed of light overtakes the mesh's slower waves, or its aliases, and they grow (Godfrey
 * 1974). Rates over the plasma frequency, measured for two cold beams at gamma = 10 in cells of c/omega_p of each beam (docs/methods/maxwell.md, yee):
 * a step of c dt up to 0.6 h, and above. They are the same to a factor of two at other gamma, so this is an order of magnitude. The waves start from the
 * noise of the particles. In 1-D there are no waves across, along which the fields of a beam could grow.
 * Source: Godfrey 1974, J. Comput. Phys. 15, 504. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"

struct row {
	const char *kernel;
	double slow, fast; /* c dt = 0.5 h, 0.7 h */
};
static const struct row rows[] = {{"cic", 0.025, 0.197}, {"tsc", 0.022, 0.118}, {"pcs", 0.016, 0.096}};

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const struct row *r = rows;
	if (!s->light || s->dim < 2 || !(s->drift > 0.9 * s->c) || !(s->effective > 0)) {
		pm_effect_off(d, !s->light ? "the law has no light" : s->dim < 2 ? "1-D" : "no beam near the speed of light");
		return;
	}
	for (size_t i = 1; i < sizeof rows / sizeof *rows; i++)
		r = !strcmp(rows[i].kernel, c->method->kernel) ? &rows[i] : r;
	const double rate = s->c * fabs(s->dt) > 0.6 * s->h ? r->fast : r->slow, grown = rate * s->omega / sqrt(2) * s->time;
	pm_effect_by(d, s, s->drift / s->c, fmin(1, exp(fmin(2 * grown, 100)) / s->effective));
	snprintf(d->text, sizeof d->text, "a beam at %.6g c: waves of the mesh grow by exp(%.2g)%s", s->drift / s->c, grown,
		d->answer == PM_PUT_IN ? "; smooth, maxwell --method psatd --current-drift" : "");
}

const struct pm_effect effect_numerical_cherenkov = {
	.name = "numerical-cherenkov",
	.sentence = "radiation of fast beams that the mesh makes",
	.source = "Godfrey 1974",
	.numerical = true,
	.decide = decide,
};
