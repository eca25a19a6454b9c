/* Norms of the difference of two fields. Sums are compensated and in the order of the stream (base/in-order.h);
 * matching sorts the ids of both and merges them. Cost: O(N), matching O(N log N).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "measure/norms.h"
#include "mesh/mesh-sum.h"

/* scale: differences and references are multiplied by these before they are squared. */
struct pair {
	const struct pm_frame *f;
	const struct pm_field *a, *b;
	const size_t *match;
	const double *weight;
	const int64_t *id;
	double scale[2];
};

struct part {
	struct pm_sum one, two, reference, weight; /* joined as four */
	double max, reference_max;
	size_t worst;
	int64_t worst_id;
};

static double value(const struct pm_field *f, int c, size_t i)
{
	return f->type == PM_I64 ? (double)pm_in_i64(f, c)[i] : f->type == PM_U8 ? (double)pm_in_u8(f, c)[i] : pm_in(f, c)[i];
}

/* Integers are subtracted as integers: beyond 2^53 different ones can have the same double. */
static double difference(const struct pm_field *a, const struct pm_field *b, int c, size_t i, size_t j)
{
	if (a->type == PM_I64 && b->type == PM_I64) {
		int64_t p = pm_in_i64(a, c)[i], q = pm_in_i64(b, c)[j];
		return p > q ? (double)((uint64_t)p - (uint64_t)q) : -(double)((uint64_t)q - (uint64_t)p);
	}
	return value(a, c, i) - value(b, c, j);
}

static void make(const void *data, size_t first, size_t last, void *part)
{
	const struct pair *q = data;
	const struct pm_field *a = q->a, *b = q->b;
	struct part p = *(struct part *)part;
	for (size_t i = first; i < last; i++) {
		double d = 0, r = 0, w = q->weight ? q->weight[i] : 1;
		size_t j = q->match ? q->match[i] : i;
		for (int c = 0; c < a->components; c++) {
			double dc = difference(a, b, c, i, j), rc = value(b, c, j);
			d = a->components == 1 ? fabs(dc) : hypot(d, dc);
			r = a->components == 1 ? fabs(rc) : hypot(r, rc);
		}
		pm_sum_add(&p.one, w * d);
		pm_sum_add(&p.two, w * (d * q->scale[0]) * (d * q->scale[0]));
		pm_sum_add(&p.reference, w * (r * q->scale[1]) * (r * q->scale[1]));
		pm_sum_add(&p.weight, w);
		if (d > p.max)
			p.max = d, p.worst = (size_t)a->first + i, p.worst_id = q->id ? q->id[i] : 0;
		p.reference_max = fmax(p.reference_max, r);
	}
	*(struct part *)part = p;
}

static void join(size_t size, const void *part, void *all)
{
	(void)size;
	const struct part *from = part;
	struct part *to = all;
	pm_join_sums(offsetof(struct part, max), from, to);
	if (from->max > to->max)
		to->max = from->max, to->worst = from->worst, to->worst_id = from->worst_id;
	to->reference_max = fmax(to->reference_max, from->reference_max);
}

static double ratio(double error, double reference) { return error == 0 ? 0 : error / reference; }

static struct part all_of(const struct pair *q)
{
	const struct pm_parts parts = {.size = sizeof(struct part), .make = make, .join = join};
	struct part all = {.max = 0};
	pm_over_field(&parts, q, q->f, q->a, &all);
	return all;
}

/* A power of two that scales x to about 1, so that its square neither overflows nor underflows; 1 if there is no such risk. */
static double scale_of(double x) { return x > 1e-140 && x < 1e140 ? 1 : x > 0 ? ldexp(1, -ilogb(x) < 1000 ? -ilogb(x) : 1000) : 1; }

struct pm_norms pm_norms_with_ids(const struct pm_frame *f, const struct pm_field *a, const struct pm_field *b, const size_t *match,
	const double *weight, const int64_t *id)
{
	struct pair q = {.f = f, .a = a, .b = b, .match = match, .weight = weight, .id = id, .scale = {1, 1}};
	struct part all = all_of(&q);
	q.scale[0] = scale_of(all.max), q.scale[1] = scale_of(all.reference_max);
	if (q.scale[0] != 1 || q.scale[1] != 1)
		all = all_of(&q);
	double w = pm_sum_total(all.weight), two = sqrt(pm_sum_total(all.two)) / q.scale[0], reference = sqrt(pm_sum_total(all.reference)) / q.scale[1];
	w = w > 0 ? w : 1;
	return (struct pm_norms){.l1 = pm_sum_total(all.one) / w, .l2 = two / sqrt(w), .max = all.max,
		.relative_l2 = ratio(two, reference), .relative_max = ratio(all.max, all.reference_max), .worst = all.worst, .worst_id = all.worst_id};
}

struct pm_norms pm_norms_of(const struct pm_frame *f, const struct pm_field *a, const struct pm_field *b, const size_t *match, const double *weight)
{
	return pm_norms_with_ids(f, a, b, match, weight, NULL);
}

static int by_id(const void *p, const void *q, void *ids)
{
	size_t i = *(const size_t *)p, j = *(const size_t *)q;
	int64_t a = ((const int64_t *)ids)[i], b = ((const int64_t *)ids)[j];
	return a < b ? -1 : a > b ? 1 : i < j ? -1 : i > j;
}

static bool ascending(size_t n, const int64_t *a)
{
	for (size_t i = 1; i < n; i++)
		if (a[i] <= a[i - 1])
			return false;
	return true;
}

static void ordered(size_t n, const int64_t *id, size_t *order)
{
	for (size_t i = 0; i < n; i++)
		order[i] = i;
	if (!ascending(n, id))
		qsort_r(order, n, sizeof *order, by_id, (void *)(uintptr_t)id);
}

int pm_norms_match(size_t n, const int64_t *a, const int64_t *b, size_t *match, size_t *order)
{
	size_t *first = pm_alloc(n, sizeof *first);
	int status = first || !n ? 0 : -PM_DATA;
	if (status)
		return status;
	ordered(n, a, first);
	ordered(n, b, order);
	for (size_t k = 0; k < n && !status; k++) {
		int64_t p = a[first[k]], q = b[order[k]];
		if (k && (p == a[first[k - 1]] || q == b[order[k - 1]]))
			status = pm_fail(PM_DATA, "the id %lld occurs twice", (long long)(p == a[first[k - 1]] ? p : q));
		else if (p != q)
			status = pm_fail(PM_DATA, "the id %lld occurs only in the %s", (long long)(p < q ? p : q), p < q ? "first" : "second");
		match[first[k]] = order[k];
	}
	pm_free(first);
	return status;
}
