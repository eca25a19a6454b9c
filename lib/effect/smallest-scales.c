/* Smallest scales of a turbulent flow in space: Kolmogorov's length eta = (nu^3/eps)^(1/4) beside the spacing. The part of the dissipation in waves beyond
 * k = pi/h is exp(-2.25 (k eta)^(4/3)) by Pao's spectrum (Kolmogorov's constant 1.5): 0.11 at k eta = 1, 0.02 at 1.5, 0.0034 at 2. eps is that of the frame,
 * 2 nu Z/V, or the larger one that the flow comes to: vorticity grows as exp(|grad u| t) at most, and eps to u'^3/(2 L), u' the rms of one component, L the
 * length of the field (Sreenivasan 1998). Taylor-Green at Re = 100 on 32^3 cells: 0.015, and its dissipation at t = 4 was 0.0075 too small
 * (docs/methods/vortex-space.md). Source: Pao 1965, Phys. Fluids 8, 1063; Pope 2000, sections 6.5.3 and 9.1.2. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"

static double eta(const struct pm_scales *s)
{
	const double omega = s->self / s->length; /* the field over its sources is a length: rms of the vorticity */
	const double now = s->nu * omega * omega, u = s->self / sqrt(3), most = fmax(now, 0.5 * u * u * u / s->length);
	return pow(pow(s->nu, 3) / fmin(now * exp(fmin(700, 2 * s->strain * s->time)), most), 0.25);
}

static double beyond(const struct pm_scales *s) { return exp(-2.25 * pow(M_PI / s->h * eta(s), 4. / 3)); }

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const bool turbulent = s->kind == PM_VORTICES && s->dim == 3 && !s->pairs && s->self > 0 && s->length > 0;
	if (!turbulent || !(s->nu > 0)) {
		pm_effect_off(d, !turbulent ? "no turbulence in space" : "nu = 0: there is none");
		return;
	}
	const double kmax = M_PI / s->h * eta(s);
	pm_effect_by(d, s, kmax, beyond(s));
	d->answer = d->share > s->accuracy ? PM_PUT_IN : PM_LEFT_OUT; /* as for remeshing-loss, the spacing is the user's */
	snprintf(d->text, sizeof d->text, "k_max eta = %.2g: %.1g of the dissipation is below the cells", kmax, d->share);
	if (d->answer == PM_PUT_IN)
		snprintf(d->text + strlen(d->text), sizeof d->text - strlen(d->text), " (pinit --cells %.0f)",
			ceil(s->box / s->h * pow(-log(s->accuracy) / 2.25, 0.75) / kmax));
}

const struct pm_effect effect_smallest_scales = {
	.name = "smallest-scales",
	.sentence = "eddies of Kolmogorov's length beside the cells",
	.source = "Pao 1965; Pope 2000, section 9.1.2",
	.numerical = true,
	.decide = decide,
};
