/* What pieces give goes from the rank of the piece to that of the place, in chunks; ranks have pieces one after another, so that what arrives is in
 * the order of pieces. Cost: 1 KiB for each 64 places that a piece reaches, about those of the pieces and their neighbours; 8 bytes a sum on the way back.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "near/pse-ranks.h"

enum { CHUNK = PM_PSE_CHUNK };

void pm_pse_places(size_t n, size_t piece, int rank, size_t *begin, size_t *end)
{
	const size_t pieces = (n + piece - 1) / piece, ranks = (size_t)pm_world_size(), r = (size_t)rank;
	*begin = pieces * r / ranks * piece < n ? pieces * r / ranks * piece : n;
	*end = pieces * (r + 1) / ranks * piece < n ? pieces * (r + 1) / ranks * piece : n;
}

static struct pm_pse_chunk *chunk_add(struct pm_pse_kept *kept)
{
	if (kept->n == kept->room) {
		const size_t room = 2 * kept->room + 256;
		struct pm_pse_chunk *of = pm_alloc(room, sizeof *of);
		if (!of) {
			kept->bad = true;
			return NULL;
		}
		if (kept->n)
			memcpy(of, kept->of, kept->n * sizeof *of);
		pm_free(kept->of);
		kept->of = of, kept->room = room;
	}
	return &kept->of[kept->n++];
}

void pm_pse_keep(struct pm_pse_kept *kept, size_t low, size_t high, double *exchange, double *weight)
{
	for (size_t at = low / CHUNK * CHUNK; at < high && !kept->bad; at += CHUNK) {
		const size_t from = at < low ? low : at, to = at + CHUNK < high ? at + CHUNK : high;
		bool any = false;
		for (size_t i = from; i < to && !any; i++)
			any = exchange[i] != 0 || weight[i] != 0;
		struct pm_pse_chunk *c = any ? chunk_add(kept) : NULL;
		if (!c)
			continue;
		*c = (struct pm_pse_chunk){.at = at};
		for (size_t i = from; i < to; i++) {
			c->exchange[i - at] = exchange[i], exchange[i] = 0;
			c->weight[i - at] = weight[i], weight[i] = 0;
		}
	}
}

static int rank_of(size_t n, size_t piece, size_t place)
{
	int r = 0;
	for (size_t begin, end = 0; r < pm_world_size() - 1; r++) {
		pm_pse_places(n, piece, r, &begin, &end);
		if (place < end)
			break;
	}
	return r;
}

/* The chunks for rank 0, then for rank 1, ...; pieces stay in order. bytes: for each. */
static int deal(const struct pm_pse_kept *kept, size_t n, size_t piece, struct pm_pse_chunk **out, size_t *bytes)
{
	struct pm_pse_chunk *all = pm_alloc(kept->n + 1, sizeof *all);
	size_t *at = calloc((size_t)pm_world_size() + 1, sizeof *at);
	*out = all;
	if (!all || !at) {
		free(at);
		return pm_no_memory();
	}
	for (size_t k = 0; k < kept->n; k++)
		at[rank_of(n, piece, kept->of[k].at) + 1]++;
	for (int r = 0; r < pm_world_size(); r++) {
		bytes[r] = at[r + 1] * sizeof *all;
		at[r + 1] += at[r];
	}
	for (size_t k = 0; k < kept->n; k++)
		all[at[rank_of(n, piece, kept->of[k].at)]++] = kept->of[k];
	free(at);
	return 0;
}

int pm_pse_bring(int status, struct pm_pse_kept *kept, size_t n, size_t piece, double *exchange, double *weight)
{
	const size_t ranks = (size_t)pm_world_size();
	size_t *bytes = calloc(2 * ranks, sizeof *bytes), total = 0;
	struct pm_pse_chunk *out = NULL;
	void *in = NULL;
	status = status ? status : bytes ? deal(kept, n, piece, &out, bytes) : pm_no_memory();
	status = pm_world_exchange(status, out, bytes, &in, bytes ? bytes + ranks : NULL);
	for (size_t r = 0; r < ranks && !status; r++)
		total += bytes[ranks + r] / sizeof *out;
	for (size_t k = 0; k < total && !status; k++) {
		const struct pm_pse_chunk *c = (const struct pm_pse_chunk *)in + k;
		for (size_t i = 0; i < CHUNK && c->at + i < n; i++) {
			exchange[c->at + i] += c->exchange[i];
			weight[c->at + i] += c->weight[i];
		}
	}
	pm_free(out), pm_free(in), free(bytes);
	return status;
}

int pm_pse_found_all(int status, struct pm_pse_found *found)
{
	int64_t alone = (int64_t)found->alone;
	status = pm_world_largest(status, 1, &found->fastest);
	status = pm_world_count(status, PM_SUM_OF, 1, &alone);
	found->alone = (uint64_t)alone;
	return status;
}

static bool of_rank(const struct pm_cell_list *l, const uint64_t *from, size_t place, size_t rank)
{
	return l->order[place] >= from[rank] && l->order[place] < from[rank + 1];
}

int pm_pse_return(int status, const struct pm_cell_list *l, size_t piece, const uint64_t *from, double *exchange)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	size_t *bytes = calloc(2 * ranks, sizeof *bytes), begin, end, k = 0;
	pm_pse_places(l->n, piece, (int)me, &begin, &end);
	double *out = status ? NULL : pm_alloc(end - begin + 1, sizeof *out);
	void *in = NULL;
	status = status ? status : bytes && out ? 0 : pm_no_memory();
	for (size_t r = 0; r < ranks && !status; r++) {
		const size_t before = k;
		for (size_t i = begin; i < end; i++)
			if (of_rank(l, from, i, r))
				out[k++] = exchange[i];
		bytes[r] = (k - before) * sizeof *out;
	}
	status = pm_world_exchange(status, out, bytes, &in, bytes ? bytes + ranks : NULL);
	k = 0;
	for (size_t i = 0; i < l->n && !status; i++) /* places are those of one rank after another */
		if (of_rank(l, from, i, me))
			exchange[i] = ((const double *)in)[k++];
	pm_free(out), pm_free(in), free(bytes);
	return status;
}
