/* Every rank says which planes it wants of whom, a byte a plane; these come back rank after rank, plane after plane, component after component.
 * Cost: what travels is a byte a plane and rank, and the planes wanted of others. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "mesh/planes-some.h"
#include "world/world.h"

static int all_here(const struct pm_planes *p, int n, const double *const in[], struct pm_some_planes *s)
{
	for (size_t i = 0; i < (size_t)n * p->all; i++)
		s->at[i] = in[i / p->all] + i % p->all * p->size;
	return 0;
}

/* What each rank wants of this one: asked[rank][planes here]. */
static int ask(int status, const struct pm_planes *p, const unsigned char *wanted, void **asked)
{
	const size_t ranks = (size_t)pm_world_size();
	size_t *bytes = status ? NULL : malloc(2 * ranks * sizeof *bytes);
	status = status || bytes ? status : pm_no_memory();
	for (size_t r = 0; r < ranks && bytes; r++)
		bytes[r] = p->from[r + 1] - p->from[r];
	status = pm_world_exchange(status, wanted, bytes, asked, bytes ? bytes + ranks : NULL);
	free(bytes);
	return status;
}

static int reply(int status, const struct pm_planes *p, const unsigned char *asked, int n, const double *const in[], void **came)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank(), one = p->size * sizeof(double);
	size_t *bytes = status ? NULL : calloc(2 * ranks, sizeof *bytes), all = 0;
	status = status || bytes ? status : pm_no_memory();
	for (size_t r = 0; r < ranks && bytes; r++)
		for (size_t k = 0; k < p->here && r != me; k++)
			bytes[r] += asked[r * p->here + k] ? (size_t)n * one : 0;
	for (size_t r = 0; r < ranks && bytes; r++)
		all += bytes[r];
	char *out = status ? NULL : pm_alloc(all + 1, 1), *to = out;
	status = status || out ? status : pm_failed();
	for (size_t r = 0; r < ranks && !status; r++)
		for (size_t k = 0; k < p->here && r != me; k++)
			for (int c = 0; c < n && asked[r * p->here + k]; c++, to += one)
				memcpy(to, in[c] + k * p->size, one);
	status = pm_world_exchange(status, out, bytes, came, bytes ? bytes + ranks : NULL);
	pm_free(out), free(bytes);
	return status;
}

int pm_planes_some(int status, const struct pm_planes *p, const unsigned char *wanted, int n, const double *const in[], struct pm_some_planes *s)
{
	void *asked = NULL, *came = NULL;
	*s = (struct pm_some_planes){.at = status ? NULL : pm_zalloc((size_t)n * p->all + 1, sizeof *s->at)};
	status = status || s->at ? status : pm_failed();
	if (!p->divided)
		return status ? status : all_here(p, n, in, s);
	status = ask(status, p, wanted, &asked);
	status = reply(status, p, asked, n, in, &came);
	pm_free(asked);
	const double *next = s->room = came;
	for (size_t k = 0; k < p->all && !status; k++)
		for (int c = 0; c < n && wanted[k]; c++) {
			const bool mine = k >= p->first && k - p->first < p->here;
			s->at[(size_t)c * p->all + k] = mine ? in[c] + (k - p->first) * p->size : next;
			next += mine ? 0 : p->size;
		}
	return status;
}

void pm_planes_some_free(struct pm_some_planes *s)
{
	pm_free(s->at), pm_free(s->room);
	*s = (struct pm_some_planes){.at = NULL};
}

size_t pm_planes_at_once(const struct pm_planes *p, size_t width)
{
	return p->divided ? 2 * (p->all / (size_t)pm_world_size() + width) + 16 : p->all + width;
}
