/* Choices of the particles: half of them, and their last bits. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "trial/choices.h"

/* Particles that sample a smooth density: the plan has found that their neighbours do not matter one by one. */
static bool samples(const struct pm_plan *p)
{
	bool near = false;
	for (int i = 0; i < p->neffects; i++)
		near = near || (!strcmp(p->effect[i].effect->name, "near-field") && p->effect[i].decision.answer == PM_PUT_IN);
	return !near && !p->scales.pairs && p->scales.n >= 256 && (p->scales.kind == PM_CHARGES || p->scales.kind == PM_MASSES);
}

/* |mean v| of the particles whose number has `bit` clear, against all, over rms v. */
static double unbalanced(const struct pm_frame *f, int64_t bit)
{
	double worst = 0;
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_field *v = pm_frame_field(f, f->sets[k]->name, "v"), *id = pm_frame_field(f, f->sets[k]->name, "id");
		if (!v || !id || !v->buffer || !id->buffer)
			continue;
		for (int c = 0; c < v->components; c++) {
			double all = 0, kept = 0, square = 0, n = 0;
			for (size_t i = 0; i < v->count; i++) {
				const double u = pm_in(v, c)[i], in = pm_in_i64(id, 0)[i] & bit ? 0 : 1;
				all += u, kept += in * u, n += in, square += u * u;
			}
			if (square > 0 && n > 0)
				worst = fmax(worst, fabs(kept / n - all / (double)v->count) / sqrt(square / (double)v->count) * sqrt(n));
		}
	}
	return worst;
}

/* Every second one by number, or every second pair where these would be one beam of two. 4: of the noise of a mean. */
int pm_choice_particles(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48])
{
	int64_t bit = 1;
	char words[256];
	(void)e;
	bool numbered = samples(p);
	for (size_t k = 0; k < (*f)->nsets; k++)
		numbered = numbered && !(*f)->sets[k]->fixed && pm_frame_field(*f, (*f)->sets[k]->name, "id");
	if (!numbered)
		return 0;
	while (bit < 8 && unbalanced(*f, bit) > 4)
		bit *= 2;
	int at = snprintf(words, sizeof words, "sel --where 'floor(id/%lld) - 2*floor(id/%lld) < 0.5' | scalc 'mass = 2*mass'", (long long)bit,
		(long long)(2 * bit));
	if (p->scales.kind == PM_CHARGES)
		snprintf(words + at, sizeof words - (size_t)at, " 'charge = 2*charge'");
	struct pm_frame *g = pm_plan_pass(*f, words);
	pm_frame_free(*f);
	*f = g;
	snprintf(from, 48, "n = %g", p->scales.n);
	snprintf(to, 48, "half of them");
	return g ? 1 : pm_failed();
}

int pm_choice_last_bit(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48])
{
	struct pm_frame *g = pm_digits_moved(*f, 1);
	(void)p, (void)e;
	pm_frame_free(*f);
	*f = g;
	snprintf(from, 48, "input");
	snprintf(to, 48, "last bits moved");
	return g ? 1 : pm_failed();
}
