/* Beale's iteration: Gamma_p += V_p [u_p - sum_q Gamma_q zeta(x_p - x_q)], which begins with Gamma_p = V_p u_p, for the strengths whose smoothed sum takes the
 * values u_p at the particles. A wave of wave number k loses 1 - zeta^(k) of its error in each iteration, so the error of smoothing, eps^2, becomes eps^(2n).
 * Source: Beale 1988, IMA Volumes in Mathematics and its Applications 12, 19; Cottet and Koumoutsakos 2000, section 7.1. The waves of the spacing are lost
 * whatever the number of iterations, and the total is not conserved. Cost: a sum over neighbours an iteration. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "near/beale.h"
#include "stream/declare.h"

int pm_beale_choose(const struct pm_sample_choice *typed, const struct pm_frame *f, struct pm_sample_choice *c)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	*c = *typed;
	c->mollifier = "gaussian";
	c->field = c->field ? c->field : law->strength;
	if (!c->field)
		return pm_fail(PM_DATA, "the law %s has no strength (--field NAME)", law->name);
	for (size_t i = 0; i < f->nsets && !c->set; i++)
		if (pm_frame_field(f, f->sets[i]->name, c->field))
			c->set = f->sets[i]->name;
	const struct pm_field *q = c->set ? pm_frame_field(f, c->set, c->field) : NULL;
	if (!q || !q->extensive)
		return pm_fail(PM_DATA, "no strength '%s' on %s%s%s (sls lists what there is)", c->field, c->set ? "'" : "any set", c->set ? c->set : "",
			c->set ? "'" : "");
	c->at = c->set;
	return pm_frame_field(f, c->set, "volume") ? 0 : pm_fail(PM_DATA, "no field 'volume' on '%s', by which a strength is a value (remesh gives volumes)",
		c->set);
}

/* Largest |wanted - smoothed| over the components, and its largest value. */
static double worst(const struct pm_field *smoothed, double *const wanted, size_t n)
{
	double most = 0, off = 0;
	for (int c = 0; c < smoothed->components; c++)
		for (size_t i = 0; i < n; i++) {
			most = fmax(most, fabs(wanted[(size_t)c * n + i]));
			off = fmax(off, fabs(wanted[(size_t)c * n + i] - pm_in(smoothed, c)[i]));
		}
	return most > 0 ? off / most : 0;
}

int pm_beale(const struct pm_sample_choice *choice, struct pm_frame *f, int most, double tolerance, struct pm_beale_gain *gain)
{
	struct pm_field *q = pm_frame_field(f, choice->set, choice->field), *smoothed = pm_frame_field(f, choice->set, choice->target);
	const double *volume = pm_in(pm_frame_field(f, choice->set, "volume"), 0);
	const size_t n = q->count, all = n * (size_t)q->components;
	double *wanted = pm_alloc(all + 1, sizeof *wanted), *kept = pm_alloc(all + 1, sizeof *kept);
	struct pm_sample_found found;
	int status = wanted && kept ? 0 : -PM_DATA;
	*gain = (struct pm_beale_gain){0};
	for (size_t i = 0; i < n && !status; i++)
		if (!(volume[i] > 0))
			status = pm_fail(PM_DATA, "particle %zu of '%s' has the volume %g (above 0)", i, choice->set, volume[i]);
	for (int c = 0; c < q->components && !status; c++)
		for (size_t i = 0; i < n; i++)
			wanted[(size_t)c * n + i] = pm_in(q, c)[i] / volume[i];
	status = status ? status : pm_sample_apply(choice, f, &found);
	if (!status)
		gain->before = gain->after = worst(smoothed, wanted, n);
	while (!status && gain->iterations < most && gain->after > tolerance) {
		for (int c = 0; c < q->components; c++) {
			memcpy(kept + (size_t)c * n, pm_in(q, c), n * sizeof *kept);
			for (size_t i = 0; i < n; i++)
				pm_out(q, c)[i] += volume[i] * (wanted[(size_t)c * n + i] - pm_in(smoothed, c)[i]);
		}
		status = pm_sample_apply(choice, f, &found);
		const double now = status ? 0 : worst(smoothed, wanted, n);
		if (!status && !(now < gain->after)) {
			for (int c = 0; c < q->components; c++)
				memcpy(pm_out(q, c), kept + (size_t)c * n, n * sizeof *kept);
			status = pm_sample_apply(choice, f, &found);
			break;
		}
		gain->after = now;
		gain->iterations++;
	}
	pm_free(wanted), pm_free(kept);
	return status;
}
