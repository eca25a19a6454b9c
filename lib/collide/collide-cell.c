/* Pairs of a cell. The particles of each set are shuffled by random numbers of their own; within a set the 1st meets the 2nd, the 3rd the 4th ...; of an odd
 * number the first three meet each other, for half a step each. Of two sets each particle of the larger one meets one of the smaller, which are taken in
 * turn; the density is that of the smaller, so that both have the right rate (Takizuka and Abe 1977). A pair keeps its momentum and the length of its
 * relative velocity, so momentum and energy are kept to round-off whatever the masses. What happens in a cell depends on nothing outside it.
 * Cost: one random direction a particle and partner set. SPDX-License-Identifier: GPL-3.0-or-later */
#include "collide/collide-cell.h"

struct shuffled {
	double place; /* random */
	size_t i;     /* in its set */
};

static size_t bucket(double place, size_t n)
{
	const size_t at = (size_t)(place * (double)n);
	return at < n ? at : n - 1;
}

/* The members of a set in a cell, in random order: into buckets by the random number, then by insertion. */
static void shuffle(const struct pm_colliders *k, int a, const size_t *members, size_t n, struct shuffled *out, size_t *count)
{
	const struct pm_colliding *s = &k->set[a];
	struct shuffled *in = out + n;
	for (size_t j = 0; j <= n; j++)
		count[j] = 0;
	for (size_t j = 0; j < n; j++) {
		double u[2];
		const size_t i = members[j] - k->from[a];
		pm_random(s->shuffle, s->id ? (uint64_t)s->id[i] : i, (uint64_t)k->step, u);
		in[j] = (struct shuffled){u[0], i};
		count[bucket(u[0], n) + 1]++;
	}
	for (size_t j = 1; j <= n; j++)
		count[j] += count[j - 1];
	for (size_t j = 0; j < n; j++)
		out[count[bucket(in[j].place, n)]++] = in[j];
	for (size_t j = 1; j < n; j++) {
		const struct shuffled moved = out[j];
		size_t at = j;
		for (; at && out[at - 1].place > moved.place; at--)
			out[at] = out[at - 1];
		out[at] = moved;
	}
}

/* Particle i of set a meets j of set b, at this density and for this time; returns s. */
static double meet(const struct pm_colliders *k, int a, size_t i, int b, size_t j, double density, double dt)
{
	const struct pm_colliding *p = &k->set[a], *q = &k->set[b];
	const double m = p->mass[i], w = q->mass[j], reduced = m * w / (m + w);
	const uint64_t key = k->key[a][b], id = p->id ? (uint64_t)p->id[i] : i, counter = 2 * (uint64_t)k->step;
	double u[3], square = 0, draw[2];
	for (int c = 0; c < 3; c++) {
		u[c] = p->v[c][i] - q->v[c][j];
		square += u[c] * u[c];
	}
	const double speed = sqrt(square), across = hypot(u[0], u[1]), b0 = p->charge[i] * q->charge[j] / (4 * pm_pi * k->eps0 * reduced * k->weight);
	if (!(speed > 0) || !(reduced > 0))
		return 0;
	const double s = 4 * pm_pi * density * k->logarithm[a < b ? a : b][a < b ? b : a] * b0 * b0 * dt / (square * speed);
	const double less = k->method->turned(fmin(s, 1e300), key, id, counter), sine = sqrt(less * (2 - less));
	pm_random(key, id, counter + 1, draw);
	const double x = sine * cos(2 * pm_pi * draw[0]), y = sine * sin(2 * pm_pi * draw[0]);
	double change[3] = {speed * x, speed * y, -u[2] * less};
	if (across > 0) {
		change[0] = (u[0] * u[2] * x - u[1] * speed * y) / across - u[0] * less;
		change[1] = (u[1] * u[2] * x + u[0] * speed * y) / across - u[1] * less;
		change[2] = -across * x - u[2] * less;
	}
	for (int c = 0; c < 3; c++) {
		p->v[c][i] += reduced / m * change[c];
		q->v[c][j] -= reduced / w * change[c];
	}
	return s;
}

struct tally {
	uint64_t pairs;
	double sum; /* of 1 - exp(-s) */
};
static void count_pair(struct tally *t, double s)
{
	t->pairs++;
	t->sum -= expm1(-s);
}

static void within(const struct pm_colliders *k, int a, const struct shuffled *p, size_t n, struct tally *t)
{
	const double density = (double)n * k->weight / k->cell;
	size_t j = 0;
	if (n % 2 && n > 1)
		for (; j < 3; j++)
			count_pair(t, meet(k, a, p[j].i, a, p[(j + 1) % 3].i, density, 0.5 * k->dt));
	for (; j + 1 < n; j += 2)
		count_pair(t, meet(k, a, p[j].i, a, p[j + 1].i, density, k->dt));
}

static void across_sets(const struct pm_colliders *k, int a, const struct shuffled *p, size_t n, int b, const struct shuffled *q, size_t m, struct tally *t)
{
	const double density = (double)m * k->weight / k->cell;
	for (size_t j = 0; j < n && m; j++)
		count_pair(t, meet(k, a, p[j].i, b, q[j % m].i, density, k->dt));
}

/* The members of a cell are order[0..n-1]; room for 2 n shuffled and n + 1 counts. */
static void collide(const struct pm_colliders *k, const size_t *order, size_t n, struct shuffled *room, size_t *count, struct tally *t)
{
	struct shuffled *at[PM_COLLIDE_SETS];
	size_t size[PM_COLLIDE_SETS], begin = 0;
	for (int a = 0; a < k->nsets; begin += size[a++]) {
		for (size[a] = 0; begin + size[a] < n && order[begin + size[a]] < k->from[a + 1];)
			size[a]++;
		at[a] = room + begin;
		shuffle(k, a, order + begin, size[a], at[a], count);
	}
	for (int a = 0; a < k->nsets; a++)
		for (int b = a; b < k->nsets; b++) {
			if (!k->pairs[a][b])
				continue;
			if (a == b)
				within(k, a, at[a], size[a], t);
			else if (size[a] >= size[b])
				across_sets(k, a, at[a], size[a], b, at[b], size[b], t);
			else
				across_sets(k, b, at[b], size[b], a, at[a], size[a], t);
		}
}

/* Cells are shared by threads in stretches of this many particles, so that sums have one order. */
enum { STRETCH = 4096 };

int pm_collide_cells(const struct pm_colliders *k, size_t n, uint64_t *pairs, double *turn)
{
	const size_t stretches = (n + STRETCH - 1) / STRETCH;
	struct tally *tally = pm_zalloc(stretches, sizeof *tally), all = {0};
	int failed = !tally;
#pragma omp parallel for schedule(dynamic, 1) reduction(| : failed) if (n > STRETCH)
	for (size_t stretch = 0; stretch < stretches; stretch++) {
		size_t from = stretch * STRETCH, to = from + STRETCH < n ? from + STRETCH : n;
		while (from && from < n && k->cell_of[k->order[from]] == k->cell_of[k->order[from - 1]])
			from++; /* a cell belongs to the stretch in which it begins */
		while (to < n && k->cell_of[k->order[to]] == k->cell_of[k->order[to - 1]])
			to++;
		struct shuffled *room = to > from ? pm_alloc(2 * (to - from), sizeof *room) : NULL;
		size_t *count = to > from ? pm_alloc(to - from + 1, sizeof *count) : NULL;
		failed |= failed || (to > from && (!room || !count));
		for (size_t end = from; from < to && !failed; from = end) {
			while (end < to && k->cell_of[k->order[end]] == k->cell_of[k->order[from]])
				end++;
			collide(k, k->order + from, end - from, room, count, &tally[stretch]);
		}
		pm_free(room), pm_free(count);
	}
	for (size_t stretch = 0; stretch < stretches && !failed; stretch++) {
		all.pairs += tally[stretch].pairs;
		all.sum += tally[stretch].sum;
	}
	pm_free(tally);
	*pairs = all.pairs;
	*turn = all.pairs ? all.sum / (double)all.pairs : 0;
	return failed ? -PM_DATA : 0;
}
