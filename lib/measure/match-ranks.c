/* Both sets are sorted by id over the ranks, and what belongs to an id is at the same place then; the values of b go there and on to where a has the id. Cost:
 * two sorts of N/P ids; of a particle of b that changes its rank 8 bytes for each component travel, twice. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "measure/match-ranks.h"
#include "stream/joint-frame.h"
#include "world/world.h"

/* The last of the ids on the ranks before this one. */
struct before {
	bool any;
	int64_t id;
};

static int last_before(int status, size_t n, const int64_t *id, struct before *b)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	int64_t *of = calloc(2 * ranks, sizeof *of); /* how many; the last */
	*b = (struct before){false, 0};
	if (!of)
		status = pm_no_memory();
	else if (n && !status)
		of[me] = 1, of[ranks + me] = id[n - 1];
	status = pm_world_count(status, PM_SUM_OF, 2 * ranks, of);
	for (size_t r = 0; r < me && !status; r++)
		if (of[r])
			*b = (struct before){true, of[ranks + r]};
	free(of);
	return status;
}

static bool same_here(size_t n, const int64_t *a, const int64_t *b, const struct before *before)
{
	for (size_t i = 0; i < n; i++)
		if (a[i] != b[i] || (i ? a[i] <= a[i - 1] : before->any && a[i] <= before->id))
			return false;
	return true;
}

static int check(size_t first, size_t n, const int64_t *a, const int64_t *b, const struct before before[2])
{
	for (size_t k = 0; k < n; k++) {
		const bool any = k || before[0].any;
		const int64_t p = a[k], q = b[k], p0 = k ? a[k - 1] : before[0].id, q0 = k ? b[k - 1] : before[1].id;
		if (p == q && !(any && (p == p0 || q == q0)))
			continue;
		pm_world_place(1, 0, 0, first + k);
		if (any && (p == p0 || q == q0))
			return pm_fail(PM_DATA, "the id %lld occurs twice", (long long)(p == p0 ? p : q));
		return pm_fail(PM_DATA, "the id %lld occurs only in the %s", (long long)(p < q ? p : q), p < q ? "first" : "second");
	}
	return 0;
}

/* A rank without memory for the copy has the shape of the original, and takes part with its status. */
static struct pm_field *or_failed(struct pm_field *copy, const struct pm_field *field) { return copy ? copy : (struct pm_field *)(uintptr_t)field; }

/* The ids here in the order of all, and the way there. */
static int sorted(int status, const struct pm_field *id, struct pm_sort_ranks *s, struct pm_field **to)
{
	const size_t n = id->count;
	uint64_t *key = status ? NULL : pm_alloc(n + 1, sizeof *key);
	*to = status ? NULL : pm_field_copy_here(id);
	status = status ? status : key && *to ? 0 : pm_failed();
	for (size_t i = 0; i < n && !status; i++)
		key[i] = (uint64_t)pm_in_i64(id, 0)[i] ^ (uint64_t)1 << 63; /* unsigned keys in the order of signed ones */
	status = pm_sort_ranks_init(status, id->from, n, key, s);
	pm_free(key);
	return pm_sort_ranks_permute(status, s, or_failed(*to, id));
}

int pm_match_ranks_init(int status, const struct pm_field *a, const struct pm_field *b, struct pm_match_ranks *m)
{
	struct before before[2];
	struct pm_field *p = NULL, *q = NULL;
	const size_t n = a->count;
	*m = (struct pm_match_ranks){.same = false};
	status = last_before(status, n, status ? NULL : pm_in_i64(a, 0), before);
	double differs = !status && !same_here(n, pm_in_i64(a, 0), pm_in_i64(b, 0), before);
	status = pm_world_largest(status, 1, &differs);
	m->same = differs == 0;
	if (status || m->same)
		return status;
	status = sorted(status, a, &m->a, &p);
	status = sorted(status, b, &m->b, &q);
	status = last_before(status, n, status ? NULL : pm_in_i64(p, 0), &before[0]);
	status = last_before(status, n, status ? NULL : pm_in_i64(q, 0), &before[1]);
	status = pm_world_agree(status ? status : check((size_t)a->first, n, pm_in_i64(p, 0), pm_in_i64(q, 0), before));
	pm_field_copy_free(p), pm_field_copy_free(q);
	return status;
}

int pm_match_ranks_bring(int status, const struct pm_match_ranks *m, const struct pm_field *b, struct pm_field **brought)
{
	*brought = NULL;
	if (m->same || b->uniform)
		return status;
	*brought = status ? NULL : pm_field_copy_here(b);
	status = status ? status : *brought ? 0 : pm_failed();
	status = pm_sort_ranks_permute(status, &m->b, or_failed(*brought, b));
	return pm_sort_ranks_return(status, &m->a, or_failed(*brought, b));
}

void pm_match_ranks_free(struct pm_match_ranks *m)
{
	pm_sort_ranks_free(&m->a), pm_sort_ranks_free(&m->b);
}
