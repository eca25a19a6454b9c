/* Choices of space: the mesh, the kernel, the gradient, the solver, or pairs instead of a mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "trial/choices.h"

static const struct pm_edit_option cells = {"cells", 'n'}, kernel = {"kernel", 'k'}, order = {"order", 0}, rim = {"rim", 0}, symbol = {"symbol", 0};

static void show(const size_t n[3], int dim, char text[48])
{
	int at = snprintf(text, 48, "%zu", n[0]);
	for (int d = 1; d < dim; d++)
		at += snprintf(text + at, 48 - (size_t)at, "x%zu", n[d]);
}

/* The mesh of p2m with other cells; where the particles are its nodes, they are put onto the new ones first. */
static int remeshed(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48], bool finer)
{
	size_t n[3];
	char words[160];
	if (!pm_edit_cells(e, *f, n))
		return 0;
	show(n, (*f)->dim, from);
	for (int d = 0; d < (*f)->dim; d++) {
		if (!finer && (n[d] % 2 || n[d] < 32)) /* 16 are the fewest that resolve a wave or two */
			return 0;
		n[d] = finer ? 2 * n[d] : n[d] / 2;
	}
	show(n, (*f)->dim, to);
	if (!pm_plan_nodes(p))
		return pm_edit_set(e, pm_edit_find(e, "p2m", 0), cells, to);
	snprintf(words, sizeof words, "remesh --kernel m6prime --cells %s", to);
	struct pm_frame *g = pm_plan_pass(*f, words);
	pm_frame_free(*f);
	*f = g;
	return g ? 1 : pm_failed();
}

/* Nodes cannot be made finer: what lies between them is not known. */
int pm_choice_finer(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48])
{
	return pm_plan_nodes(p) ? 0 : remeshed(p, e, f, from, to, true);
}

int pm_choice_coarser(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48])
{
	return remeshed(p, e, f, from, to, false);
}

static const char *next_of(const char *const pairs[][2], size_t n, const char *name)
{
	for (size_t i = 0; i < n; i++)
		if (!strcmp(pairs[i][0], name))
			return pairs[i][1];
	return NULL;
}

int pm_choice_kernel(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48])
{
	static const char *const next[][2] = {{"ngp", "cic"}, {"cic", "tsc"}, {"tsc", "pcs"}, {"pcs", "tsc"}, {"lambda-2", "m4prime"}, {"m4prime", "m6prime"},
		{"m6prime", "lambda-6-4"},
		{"lambda-2-1", "lambda-4-2"}, {"lambda-2-2", "lambda-4-2"}, {"lambda-4-2", "lambda-6-4"}, {"lambda-4-4", "lambda-6-4"}, {"lambda-6-4",
		"lambda-6-6"}, {"lambda-6-6", "lambda-6-4"}, {"lambda-8-4", "lambda-6-4"}, {"star", "tsc"}};
	char value[64];
	const int w = pm_edit_find(e, "p2m", 0);
	(void)f;
	if (w < 0)
		return 0;
	if (!pm_edit_value(e, w, kernel, value))
		snprintf(value, sizeof value, "%s", p->law->kernel ? p->law->kernel : "");
	const char *other = next_of(next, sizeof next / sizeof next[0], value);
	if (!other || !pm_edit_set(e, w, kernel, other))
		return 0;
	snprintf(from, 48, "%.47s", value);
	snprintf(to, 48, "%s", other);
	for (int r = -1; (r = pm_edit_find(e, "remesh", r + 1)) >= 0;)
		if (!pm_edit_set(e, r, kernel, other))
			return 0;
	return 1;
}

int pm_choice_gradient(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48])
{
	static const char *const next[][2] = {{"2", "4"}, {"4", "6"}, {"6", "4"}, {"spectral", "6"}};
	char value[64];
	const int w = pm_edit_find(e, "mgrad", 0), deposit = pm_edit_find(e, "p2m", 0);
	(void)f;
	if (w < 0)
		return 0;
	if (!pm_edit_value(e, w, order, value))
		snprintf(value, sizeof value, "%s", p->law->order);
	const char *other = next_of(next, sizeof next / sizeof next[0], value);
	if (!other || !pm_edit_set(e, w, order, other))
		return 0;
	if (p->scales.open && deposit >= 0 && !pm_edit_set(e, deposit, rim, !strcmp(other, "4") ? "1" : "2")) /* one-sided differences at open faces */
		return 0;
	snprintf(from, 48, "order %.32s", value);
	snprintf(to, 48, "order %s", other);
	return 1;
}

int pm_choice_solver(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48])
{
	const int fft = pm_edit_find(e, "poisson-fft", 0), mg = pm_edit_find(e, "poisson-mg", 0);
	char value[64];
	(void)p, (void)f;
	if (fft >= 0 && pm_edit_value(e, fft, (struct pm_edit_option){"green", 0}, value))
		return 0; /* softened: only by poisson-fft */
	if (fft >= 0) {
		pm_edit_set(e, fft, symbol, NULL);
		snprintf(e->word[fft], PM_EDIT_WORD, "poisson-mg --order 4");
	} else if (mg >= 0) {
		snprintf(e->word[mg], PM_EDIT_WORD, "poisson-fft");
	} else {
		return 0;
	}
	snprintf(from, 48, "%s", fft >= 0 ? "poisson-fft" : "poisson-mg");
	snprintf(to, 48, "%s", fft >= 0 ? "poisson-mg" : "poisson-fft");
	return 1;
}

/* Every pair summed, where the words from p2m to m2p do nothing else. */
int pm_choice_pairs(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48])
{
	const int first = pm_edit_find(e, "p2m", 0), last = pm_edit_find(e, "m2p", 0);
	const struct pm_scales *s = &p->scales;
	(void)f;
	if (first < 0 || last != first + 3 || pm_edit_find(e, "mgrad", 0) != first + 2 || strncmp(e->word[first + 1], "poisson-", 8) || pm_plan_nodes(p) ||
		s->periodic || s->walls)
		return 0;
	for (int i = 0; i < 3; i++)
		pm_edit_remove(e, first);
	snprintf(e->word[first], PM_EDIT_WORD, "pp");
	snprintf(from, 48, "a mesh");
	snprintf(to, 48, "pairs");
	return 1;
}
