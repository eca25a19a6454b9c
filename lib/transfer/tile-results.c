/* Results of particles in the order of tiles: to their places in the stream, or to who takes them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "transfer/tile-results.h"

/* ahead: of a later record the end is prefetched, for it begins where the one before ends; line: doubles per cache line */
enum { batch = PM_TILE_ORDER_PACK, ahead = 16, line = 8 };

bool pm_tile_results_round(int n, const struct pm_tile_results *r)
{
	bool all = true;
	for (int c = 0; c < n; c++)
		all = all && r->to[c].floats && (r->set[c] || r->to[c].zero) && !r->factor[c].doubles && !r->factor[c].floats;
	return all;
}

static bool is_one(const struct pm_column *c) { return !c->doubles && !c->floats && c->value == 1; }

/* m values of a component, times their factors, to floats. */
static void unpack_floats(size_t m, int stride, const double *records, const double *f, bool set, float *restrict y)
{
	for (size_t i = 0; i < m; i++) {
		double value = records[i * (size_t)stride];
		value = f ? f[i] * value : value;
		y[i] = (float)(set ? value : y[i] + value);
	}
}

/* Value i of component c: values[i * stride + c * next]. */
PM_SIMD_INLINE bool unpack(size_t p, size_t m, size_t stride, size_t next, const double *values, int nvalues, const struct pm_tile_results *r)
{
	bool finite = true;
	double few[batch];
	for (int c = 0; c < nvalues; c++) {
		const bool set = r->set[c];
		const double *f = is_one(&r->factor[c]) ? NULL : pm_column_take(&r->factor[c], p, m, few), *from = values + (size_t)c * next;
		if (r->to[c].floats) {
			unpack_floats(m, (int)stride, from, f, set, r->to[c].floats + p);
			continue; /* checked where the stage ends */
		}
		double *restrict y = r->to[c].doubles + p;
		if (stride == 1 && set && !f) {
			memcpy(y, from, m * sizeof *y);
			finite &= pm_finite_few(m, from);
			continue;
		}
		for (size_t i = 0; i < m; i++) {
			double value = from[i * stride];
			value = f ? f[i] * value : value;
			y[i] = set ? value : y[i] + value;
		}
		finite &= pm_finite_few(m, y);
	}
	return finite;
}

bool pm_tile_results_unpack(size_t p, size_t m, int stride, const double *records, int nvalues, const struct pm_tile_results *r)
{
	return unpack(p, m, (size_t)stride, 1, records, nvalues, r);
}

PM_SIMD_INLINE bool unpack_to(const uint32_t *place, size_t m, size_t stride, size_t next, const double *values, int nvalues, const struct pm_tile_results *r)
{
	const uint64_t one = (uint64_t)1 << 52, exponent = 0x7ff * one;
	uint64_t over = 0; /* the highest bit if the exponent of a value is the largest there is: it is not finite */
	for (int c = 0; c < nvalues; c++) {
		const bool plain = is_one(&r->factor[c]), set = r->set[c];
		double *restrict y = r->to[c].doubles;
		float *restrict z = r->to[c].floats;
		for (size_t i = 0; i < m; i++) {
			const size_t p = place[i];
			uint64_t bits;
			double value = values[i * stride + (size_t)c * next];
			value = plain ? value : pm_column_at(&r->factor[c], p) * value;
			if (z) {
				z[p] = (float)(set ? value : z[p] + value);
				continue;
			}
			y[p] = value = set ? value : y[p] + value;
			memcpy(&bits, &value, sizeof bits);
			over |= (bits & exponent) + one;
		}
	}
	return !(over >> 63);
}

/* Of particles that stay, and not together. */
PM_SIMD_INLINE bool deliver(const struct pm_tile_order *o, size_t p, size_t m, size_t stride, size_t next, const double *values, int nvalues,
	const struct pm_tile_results *r)
{
	uint32_t place[batch];
	pm_tile_runs_places(&o->runs, p, m, place);
	return unpack_to(place, m, stride, next, values, nvalues, r);
}

/* Arrays of finite values that are set as they are go run by run. */
static bool put_arrays(const struct pm_tile_order *o, size_t p, size_t m, const double *values, int nvalues, const struct pm_tile_results *r)
{
	enum { most = PM_TILE_RUNS_MOST };
	bool finite = true;
	for (int c = 0, n; c < nvalues; c += n) {
		const double *from[most];
		double *to[most];
		for (n = 0; n < most && c + n < nvalues; n++) {
			from[n] = values + (size_t)(c + n) * batch, to[n] = r->to[c + n].doubles;
			finite &= pm_finite_few(m, from[n]);
		}
		pm_tile_runs_put(&o->runs, p, m, n, from, to);
	}
	return finite;
}

bool pm_tile_results_deliver_arrays(const struct pm_tile_order *o, size_t p, size_t m, const double *values, int nvalues, const struct pm_tile_results *r)
{
	bool plain = true;
	if (!o->runs.run || pm_tile_runs_together(&o->runs, p, m))
		return unpack(o->runs.run ? pm_tile_runs_at(&o->runs, p) : p, m, 1, batch, values, nvalues, r);
	for (int c = 0; c < nvalues; c++)
		plain = plain && is_one(&r->factor[c]) && r->set[c] && r->to[c].doubles;
	return plain ? put_arrays(o, p, m, values, nvalues, r) : deliver(o, p, m, 1, batch, values, nvalues, r);
}

bool pm_tile_results_deliver(const struct pm_tile_order *o, size_t p, size_t m, int stride, const double *records, int nvalues,
	const struct pm_tile_results *r)
{
	if (!o->runs.run || pm_tile_runs_together(&o->runs, p, m))
		return pm_tile_results_unpack(o->runs.run ? pm_tile_runs_at(&o->runs, p) : p, m, stride, records, nvalues, r);
	return deliver(o, p, m, (size_t)stride, 1, records, nvalues, r);
}

void pm_tile_results_leave_strays(const struct pm_tile_order *o, int nvalues, const struct pm_tile_results *r)
{
	const double zero[PM_COMPONENTS] = {0};
	for (size_t p = o->runs.run ? o->begin[o->tiles] : o->n; p < o->n; p++)
		pm_tile_results_deliver(o, p, 1, nvalues, zero, nvalues, r);
}

/* Particles p..p+m-1 of a chunk that ends at `end`. */
struct batch {
	size_t p, m, end;
};

/* The records of a batch component by component, in the order of the stream; a stray's is zero. Where they go to is fetched meanwhile. */
static void collect(const struct pm_tile_order *o, const double *results, size_t stride, const struct batch *b, size_t *cursor, int nvalues,
	const struct pm_tile_results *r, double to[PM_COMPONENTS][batch])
{
	for (int c = 0; c < nvalues; c++)
		for (size_t i = 0; i < b->m && r->to[c].doubles; i += line)
			__builtin_prefetch(r->to[c].doubles + b->p + i, 1);
	for (size_t i = 0; i < b->m; i++) {
		uint32_t tile = o->tile[b->p + i], soon = o->tile[b->p + i + ahead < b->end ? b->p + i + ahead : b->p + i];
		const double *record = results + stride * cursor[tile]++;
		__builtin_prefetch(results + stride * cursor[soon] + nvalues - 1);
		for (int c = 0; c < nvalues; c++)
			to[c][i] = tile == o->tiles ? 0 : record[c];
	}
}

int pm_tile_results_return_floats(const struct pm_tile_order *o, const float *results, int stride, int nvalues, const struct pm_tile_results *r)
{
	const size_t columns = o->tiles + 1, each = (size_t)stride;
	size_t *cursors = pm_alloc((size_t)o->chunks * columns, sizeof *cursors);
	if (!cursors)
		return -PM_DATA;
	memcpy(cursors, o->cursor, (size_t)o->chunks * columns * sizeof *cursors);
#pragma omp parallel for num_threads(o->chunks) schedule(static, 1)
	for (int chunk = 0; chunk < o->chunks; chunk++) {
		size_t *cursor = cursors + (size_t)chunk * columns;
		for (size_t p = pm_tile_chunk(o->n, o->chunks, chunk), end = pm_tile_chunk(o->n, o->chunks, chunk + 1); p < end; p++) {
			const uint32_t tile = o->tile[p];
			const float *record = results + each * cursor[tile]++;
			__builtin_prefetch(results + each * cursor[o->tile[p + ahead < end ? p + ahead : p]] + nvalues - 1);
			for (int c = 0; c < nvalues; c++)
				r->to[c].floats[p] = tile == o->tiles ? 0 : record[c];
		}
	}
	pm_free(cursors);
	return 0;
}

/* Values of m particles to who takes them, times factor[c], one number each. */
static void hand_over(const struct pm_tile_order *o, size_t p, size_t m, int nvalues, double values[PM_COMPONENTS][batch], const struct pm_tile_results *r)
{
	double *value[PM_COMPONENTS];
	for (int c = 0; c < nvalues; c++) {
		const double factor = r->factor[c].value;
		for (size_t i = 0; i < m; i++)
			values[c][i] *= factor;
		value[c] = values[c];
	}
	r->taker->take(r->taker->data, o, p, m, NULL, value);
}

void pm_tile_results_hand_over(const struct pm_tile_order *o, size_t p, size_t m, int stride, const double *records, int nvalues,
	const struct pm_tile_results *r)
{
	double values[PM_COMPONENTS][batch];
	for (int c = 0; c < nvalues; c++)
		for (size_t i = 0; i < m; i++)
			values[c][i] = records[i * (size_t)stride + (size_t)c];
	hand_over(o, p, m, nvalues, values, r);
}

int pm_tile_results_return(const struct pm_tile_order *o, const double *results, int stride, int nvalues, const struct pm_tile_results *r, bool *finite)
{
	size_t columns = o->tiles + 1, *cursors = pm_alloc((size_t)o->chunks * columns, sizeof *cursors);
	int bad = 0;
	if (!cursors)
		return -PM_DATA;
	memcpy(cursors, o->cursor, (size_t)o->chunks * columns * sizeof *cursors);
#pragma omp parallel for num_threads(o->chunks) schedule(static, 1) reduction(| : bad)
	for (int chunk = 0; chunk < o->chunks; chunk++) {
		double values[PM_COMPONENTS][batch];
		size_t *cursor = cursors + (size_t)chunk * columns;
		for (size_t p = pm_tile_chunk(o->n, o->chunks, chunk), end = pm_tile_chunk(o->n, o->chunks, chunk + 1); p < end; p += batch) {
			size_t m = end - p < batch ? end - p : batch;
			collect(o, results, (size_t)stride, &(struct batch){p, m, end}, cursor, nvalues, r, values);
			if (r->taker)
				hand_over(o, p, m, nvalues, values, r);
			else
				bad |= !unpack(p, m, 1, batch, values[0], nvalues, r);
		}
	}
	pm_free(cursors);
	*finite = !bad;
	return 0;
}
