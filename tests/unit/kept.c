/* Sums and quotients that are kept with fields follow every change of the values (lib/stream/kept.h). SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"
#include "limit/rates.h"
#include "stream/declare.h"
#include "stream/kept.h"
#include "stream/run.h"
#include "stream/strengths.h"
#include "transfer/transfer-frame.h"

enum { N = 1237 };

static void need(bool good)
{
	if (!good) {
		check(false, "%s", pm_message());
		exit(1);
	}
}

static void make(struct pm_frame *f, const char *set, const char *name, double value)
{
	struct pm_field *field = pm_makes(f, set, name, 1, PM_STATE);
	need(field);
	field->extensive = true;
	need(!pm_frame_ready(f));
	for (size_t i = 0; i < field->count; i++)
		pm_out(field, 0)[i] = value * (1 + (double)i / N);
	need(!pm_frame_settle(f));
}

/* As a word changes a field. */
static void multiply(struct pm_frame *f, const char *set, const char *name, double by)
{
	struct pm_field *field = pm_changes(f, set, name);
	need(field && !pm_frame_ready(f));
	struct pm_strengths before; /* a word may ask for them in frame() */
	pm_strengths_of(f, set, &before);
	for (size_t i = 0; i < field->count; i++)
		pm_out(field, 0)[i] *= by;
	need(!pm_frame_settle(f));
}

static double sum_of(const struct pm_frame *f, const char *set, const char *name)
{
	struct pm_strengths s;
	pm_strengths_of(f, set, &s);
	return pm_strength_find(&s, set, name)->sum;
}

static double ratio_of(const struct pm_frame *f, const char *set, size_t i)
{
	const double *ratio;
	double *made;
	need(!pm_ratio(f, set, "charge", "mass", &ratio, &made));
	const double r = ratio[i];
	pm_free(made);
	return r;
}

int main(void)
{
	struct pm_frame *f = pm_frame_new(1);
	const char *const sets[] = {"electrons", "ions"};
	snprintf(f->law, sizeof f->law, "electrostatic");
	pm_frame_constant_set(f, "eps0", 1);
	for (int i = 0; i < 2; i++) {
		need(pm_frame_set_new(f, sets[i], N));
		make(f, sets[i], "x", 0.3);
		make(f, sets[i], "charge", i ? 2.385 : -1.7);
		make(f, sets[i], "mass", i ? 40 : 1.3);
	}
	const struct pm_law *law = pm_law_of(f);
	const double tolerance = 1e-14; /* of sums of N values, added with their carry */
	for (int i = 0; i < 2; i++) {
		const double sum = sum_of(f, sets[i], "charge"), all = pm_strength_total(f, "charge"), omega = pm_plasma_frequency(f, law);
		const double ratio = ratio_of(f, sets[i], 17), own = fabs(sum);
		check(sum == sum_of(f, sets[i], "charge") && all == pm_strength_total(f, "charge") && omega == pm_plasma_frequency(f, law) &&
			ratio == ratio_of(f, sets[i], 17), "%s: sums and quotients that are kept are those that were computed", sets[i]);
		multiply(f, sets[i], "charge", 3);
		check_near(sum_of(f, sets[i], "charge") / sum, 3, tolerance, "the sum of a strength follows its change");
		check_near((pm_strength_total(f, "charge") - all) / own, 2, 1e3 * tolerance, "the sum over the sets follows the change of one");
		check(pm_plasma_frequency(f, law) > omega * (1 + 1e-3), "the plasma frequency follows the charge");
		check_near(ratio_of(f, sets[i], 17) / ratio, 3, tolerance, "charge over mass follows the charge");
		const double charged = pm_plasma_frequency(f, law);
		multiply(f, sets[i], "mass", 0.25);
		check(pm_plasma_frequency(f, law) > charged * (1 + 1e-3), "the plasma frequency follows the mass");
		check_near(ratio_of(f, sets[i], 17) / ratio, 12, 4 * tolerance, "charge over mass follows the mass");
	}
	struct pm_field *q = pm_frame_field(f, "electrons", "charge"), *m = pm_frame_field(f, "electrons", "mass");
	static const char name[] = "of both";
	need(pm_keep(q, m, name, pm_alloc(1, 8)));
	check(pm_kept(q, m, name) && !pm_kept(q, NULL, name) && !pm_kept(m, q, name), "what is kept of two fields belongs to both, in this order");
	multiply(f, "electrons", "mass", 2);
	check(!pm_kept(q, m, name), "what is kept of two fields is gone when the other one changes");
	need(pm_keep(m, NULL, "a note of the mass alone", pm_alloc(1, 8)));
	check(!pm_kept(q, m, name), "and does not come back with another note of that field");
	struct pm_field *made = pm_makes(f, "ions", "charge", 1, PM_STATE);
	need(made && !pm_frame_ready(f));
	double *block = pm_alloc(1, 8);
	const bool early = pm_keep(made, NULL, name, block);
	made->use |= PM_USE_DONE;
	check(!early && pm_keep(made, NULL, name, block), "of a new field something is kept when the word has written all values, not before");
	check(pm_kept(made, NULL, name) == block && !pm_frame_settle(f) && pm_kept(made, NULL, name) == block, "and the next word has it");
	pm_frame_free(f);
	return check_done();
}
