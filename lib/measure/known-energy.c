/* The sum over pairs has the softening and mollifier of pp, if it was given any, else the frame's and the law's. A term of the acceleration that is not the
 * law's own field (a given field, a friction, a word of the user) has an energy that nobody states, so the total is unknown.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "measure/known-energy.h"
#include "mollifier/mollifier.h"
#include "stream/acting-forces.h"

static bool counts(const struct pm_measure *how, const struct pm_frame *f, const struct pm_set *set)
{
	return (!how->set || !strcmp(how->set, set->name)) && pm_set_moves(f, set);
}

static bool same(const struct pm_acting *a, const struct pm_acting *b)
{
	return (a->softening == b->softening || (isnan(a->softening) && isnan(b->softening))) && !strcmp(a->mollifier ? a->mollifier : "",
		b->mollifier ? b->mollifier : "");
}

void pm_known_energy(const struct pm_frame *f, const struct pm_law *law, bool pairs, struct pm_measure *how)
{
	struct pm_acting first = {.softening = NAN};
	bool any = false, differ = false;
	how->unknown[0] = 0;
	for (size_t i = 0; i < f->nsets; i++) {
		const char *set = f->sets[i]->name;
		if (!counts(how, f, f->sets[i]))
			continue;
		const bool second = pm_frame_field(f, set, "v") != NULL;
		const struct pm_acting a = pm_acting_on(f, set, second ? "acc" : "vel");
		if (second && a.other && !how->unknown[0])
			snprintf(how->unknown, sizeof how->unknown, "the term '%.64s' acts on '%.64s', and its potential is not known", a.other, set);
		if (how->strength && pm_frame_field(f, set, how->strength)) {
			differ = differ || (any && !same(&a, &first));
			first = any ? first : a;
			any = true;
		}
	}
	const char *name = first.mollifier ? first.mollifier : law->mollifier ? law->mollifier : "plummer";
	const struct pm_mollifier *m = pairs ? pm_mollifier_find(name) : NULL;
	how->softening = isnan(first.softening) ? pm_frame_constant(f, "softening", 0) : first.softening;
	how->pair = m ? m->potential : NULL;
	if (!pairs || !differ)
		return;
	how->softening = NAN;
	if (!how->unknown[0])
		snprintf(how->unknown, sizeof how->unknown, "the sums over pairs of the sets are softened differently");
}

enum pm_pairs pm_pairs_unasked(const struct pm_frame *f, const struct pm_law *law, const struct pm_measure *how, char why[200])
{
	uint64_t n = 0;
	bool open = !(law->background && pm_frame_constant(f, law->background, 0) != 0);
	why[0] = 0;
	for (int d = 0; d < 2 * f->dim; d++)
		open = open && f->face[d / 2][d % 2] == PM_OPEN;
	for (size_t i = 0; i < f->nsets && how->strength; i++)
		n += (!how->set || !strcmp(how->set, f->sets[i]->name)) && pm_frame_field(f, f->sets[i]->name, how->strength) ? f->sets[i]->n : 0;
	const bool pairs = !how->vector && law->coefficient && law->dims >> f->dim & 1; /* is there a sum over pairs? */
	if (!n || !how->potential || how->unknown[0] || !(pairs || how->vector))
		return PM_PAIRS_NO;
	if (!open || !pairs)
		snprintf(why, 200, "no mesh holds %s and %s (p2m | poisson-fft, or poisson-mg, makes them)", how->density, how->potential);
	else if (n > PM_PAIRS_UNASKED)
		snprintf(why, 200, "no mesh and no particle holds %s, and the pairs of more than %d particles are not summed unasked (p2m | poisson-fft, pp "
			"--potential, or diag --pair)", how->potential, PM_PAIRS_UNASKED);
	return !open || !pairs ? PM_PAIRS_NO : n > PM_PAIRS_UNASKED ? PM_PAIRS_MANY : PM_PAIRS_SUM;
}
