/* The loop of kicks and a drift against the loops of state-advance.c that do one action after the other: the same bytes, of any number of particles, inside the
 * box, on its faces, beyond them, and not finite. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "push/kick-drift.h"

enum { MOST = 70 };

struct particles {
	double x[MOST], v[MOST], k[MOST];
};

static const struct pm_bounds box = {.lo = -0.3, .hi = 2.385, .fold = true};

/* Those of every third number beside the faces, or beyond them by several boxes. */
static void fill(struct particles *p, uint64_t seed)
{
	const double near[] = {-0.3, 2.385, nextafter(-0.3, -1), nextafter(2.385, 0), -30, 55, -0.3 - 2.685};
	for (size_t i = 0; i < MOST; i++) {
		double u[2], w[2];
		pm_random(seed, i, 0, u), pm_random(seed, i, 1, w);
		const bool beside = i % 3 == 0;
		p->x[i] = beside ? near[i / 3 % 7] : -0.3 + 2.685 * u[0];
		p->v[i] = beside && i % 2 ? 0 : w[0] - 0.5;
		p->k[i] = beside && i % 2 ? 0 : w[1] - 0.5;
	}
}

/* Of the first n, one action after the other. True if they are finite. */
static bool by_actions(size_t n, const struct pm_advance *close, const struct pm_advance *open, struct particles *p, int64_t *most)
{
	const struct pm_advanced lines[] = {{.y = p->x, .k = p->v, .position = true}, {.y = p->v, .k = p->k}};
	bool finite = !close || pm_advance_few(n, close, 1, &lines[1], NULL, NULL, NULL);
	finite &= pm_advance_few(n, open, 2, lines, p->x, &box, most);
	return finite;
}

/* Whether both agree; `at` not MOST: x, v or k of this particle is `value`. */
static bool agree(size_t n, bool twice, uint64_t seed, size_t at, int which, double value)
{
	const struct pm_step *kick = pm_step_find("kick"), *drift = pm_step_find("drift");
	const struct pm_advance close = {.actions = 1, .action = {{kick, 0, 0.7}}}, open = {.actions = 2, .action = {{kick, 0, -0.3}, {drift, 0, 1.1}}};
	struct particles want, got;
	struct pm_kick_drift step;
	int64_t most[2] = {0, 0};
	bool finite = true, good = pm_kick_drift_is(twice ? &close : NULL, &open, &step);
	fill(&got, seed);
	if (at < MOST)
		(which == 0 ? got.x : which == 1 ? got.v : got.k)[at] = value;
	want = got;
	const size_t done = pm_kick_drift(n, &step, &box, got.k, got.v, got.x, &most[0], &finite);
	good = good && n - done < 8 && finite == by_actions(done, twice ? &close : NULL, &open, &want, &most[1]);
	return good && most[0] == most[1] && !memcmp(&want, &got, sizeof want);
}

int main(void)
{
	bool same = true, folds = true, caught = true;
	for (size_t n = 0; n <= MOST; n++)
		for (int twice = 0; twice < 2; twice++)
			for (uint64_t seed = 1; seed < 20; seed++)
				same &= agree(n, twice, seed, MOST, 0, 0);
	check(same, "kicks and a drift in one loop leave the bytes of one action after the other, of 0 to %d particles", MOST);
	for (size_t i = 0; i < 16; i++)
		for (int which = 0; which < 3; which++)
			caught &= agree(64, i % 2, 3, i, which, NAN) && agree(64, i % 2, 3, i, which, -INFINITY) && agree(64, i % 2, 3, i, which, INFINITY);
	check(caught, "what is not finite is found, in x, v and the rate");
	for (size_t i = 0; i < 16; i++)
		folds &= agree(64, i % 2, 3, i, 0, 1e15) && agree(64, i % 2, 3, i, 0, -1e300) && agree(64, i % 2, 3, i, 1, 1e308);
	check(folds, "what goes very far is folded as one action after the other folds it");
	const struct pm_step *kick = pm_step_find("kick"), *drift = pm_step_find("drift");
	struct pm_kick_drift step;
	check(!pm_kick_drift_is(NULL, &(struct pm_advance){.actions = 2, .action = {{drift, 0, 1}, {kick, 0, 1}}}, &step) &&
			!pm_kick_drift_is(NULL, &(struct pm_advance){.actions = 3, .action = {{kick, 0, 1}, {drift, 0, 1}, {kick, 0, 1}}}, &step) &&
			!pm_kick_drift_is(&(struct pm_advance){.actions = 2, .action = {{kick, 0, 1}, {kick, 0, 1}}},
				&(struct pm_advance){.actions = 2, .action = {{kick, 0, 1}, {drift, 0, 1}}}, &step),
		"other actions are not taken for these");
	return check_done();
}
