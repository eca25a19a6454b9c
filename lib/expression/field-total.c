/* Sums over the particles of a set by the law of sums (docs/distributed.md), or of groups of it: then a part is what a group has in a block of 4096 of the
 * stream, and parts are joined in its order, of several ranks by the one that owns the group. Cost: N, with groups N log N on one thread; 8 (2 components + 1)
 * bytes of a part travel to the owner, and 8 components back.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "expression/field-total.h"
#include "stream/declare.h"
#include "world/over-ranks.h"

int pm_total_declare(struct pm_frame *f, const struct pm_field *field, const char *per)
{
	const struct pm_field *group = per ? pm_frame_field(f, field->on, per) : NULL;
	if (!pm_frame_set(f, field->on))
		return pm_fail(PM_DATA, "'%s' is on a mesh, but --total adds over the particles of a set (diag has sums over meshes)", field->on);
	if (field->type == PM_I64 || field->type == PM_U8)
		return pm_fail(PM_DATA, "'%s' holds whole numbers, but --total needs a real field (another name)", field->name);
	if (per && (!group || group->components != 1))
		return pm_fail(PM_DATA, group ? "'%s' on '%s' is a vector, but --per needs one number a particle"
			: "no field '%s' on '%s' for --per (sls lists the fields)", per, field->on);
	return per && !pm_reads(f, field->on, per) ? -PM_DATA : 0;
}

struct member {
	double group;
	size_t index;
};

static int by_group(const void *a, const void *b)
{
	const struct member *p = a, *q = b;
	return p->group != q->group ? (p->group > q->group) - (p->group < q->group) : (p->index > q->index) - (p->index < q->index);
}

/* The particles here in the order of groups; a new part begins where the group or the block of the stream changes. */
struct members {
	size_t n, parts, components;
	struct member *of;
};

static bool begins(const struct members *m, size_t i)
{
	return !i || m->of[i].group != m->of[i - 1].group || m->of[i].index / pm_sum_block != m->of[i - 1].index / pm_sum_block;
}

static int sort(const struct pm_field *group, const struct pm_field *field, struct members *m)
{
	*m = (struct members){.n = field->count, .components = (size_t)field->components, .of = pm_alloc(field->count + 1, sizeof *m->of)};
	if (!m->of)
		return -PM_DATA;
	for (size_t i = 0; i < m->n; i++)
		m->of[i] = (struct member){(group->type == PM_I64 ? (double)pm_in_i64(group, 0)[i] : group->type == PM_U8 ? pm_in_u8(group, 0)[i]
			: pm_in(group, 0)[i]) + 0.0, i}; /* -0 is 0 */
	qsort(m->of, m->n, sizeof *m->of, by_group);
	for (size_t i = 0; i < m->n; i++)
		m->parts += begins(m, i);
	return 0;
}

/* A part is its group, then the sum and the carry of each component. */
static size_t length(size_t components) { return 1 + 2 * components; }

static void make_parts(const struct members *m, const struct pm_field *field, double *part)
{
	double *to = part;
	memset(part, 0, m->parts * length(m->components) * sizeof *part);
	for (size_t i = 0; i < m->n; i++) {
		to += i && begins(m, i) ? length(m->components) : 0;
		to[0] = m->of[i].group;
		for (size_t c = 0; c < m->components; c++) {
			struct pm_sum sum = {to[1 + 2 * c], to[2 + 2 * c]};
			pm_sum_add(&sum, pm_in(field, (int)c)[m->of[i].index]);
			to[1 + 2 * c] = sum.sum, to[2 + 2 * c] = sum.carry;
		}
	}
}

/* total[n][components]: of each part that of its group, whose parts are joined in their order. */
static int join(size_t n, size_t components, const double *part, double *total)
{
	struct member *m = pm_alloc(n + 1, sizeof *m);
	if (!m)
		return -PM_DATA;
	for (size_t i = 0; i < n; i++)
		m[i] = (struct member){part[i * length(components)], i};
	qsort(m, n, sizeof *m, by_group);
	for (size_t from = 0, to = 0; from < n; from = to)
		for (size_t c = 0; c < components; c++) {
			struct pm_sum all = {0, 0};
			for (to = from; to < n && m[to].group == m[from].group; to++) {
				const double *one = part + m[to].index * length(components) + 1 + 2 * c;
				pm_join_sums(sizeof all, &(struct pm_sum){one[0], one[1]}, &all);
			}
			for (size_t i = from; i < to; i++)
				total[m[i].index * components + c] = pm_sum_total(all);
		}
	pm_free(m);
	return 0;
}

/* The rank that joins the parts of a group. */
static size_t owner(double group)
{
	uint64_t bits;
	memcpy(&bits, &group, sizeof bits);
	bits *= 0x9e3779b97f4a7c15; /* 2^64 over the golden ratio: neighbours go to different ranks */
	return (size_t)((bits >> 32) % (uint64_t)pm_world_size());
}

/* Parts, or with back what came of them, [size] each, in the order of their ranks, and back in their own order. */
static void by_owner(const struct members *m, const double *part, size_t size, double *sorted, double *own, size_t *bytes)
{
	size_t at = 0;
	for (size_t r = 0; r < (size_t)pm_world_size(); r++) {
		const size_t before = at;
		for (size_t i = 0; i < m->parts; i++)
			if (owner(part[i * length(m->components)]) == r) {
				memcpy(own ? own + i * size : sorted + at * size, own ? sorted + at * size : part + i * size, size * sizeof *part);
				at++;
			}
		if (bytes)
			bytes[r] = (at - before) * size * sizeof *part;
	}
}

/* As join, over all ranks: what comes to the owner of a group is in the order of ranks, so of the stream. */
static int join_ranks(int status, const struct members *m, const double *part, double *total)
{
	const size_t ranks = (size_t)pm_world_size(), each = length(m->components), k = m->components;
	size_t *bytes = status ? NULL : calloc(3 * ranks, sizeof *bytes), n = 0;
	double *out = status ? NULL : pm_alloc(m->parts * each + 1, sizeof *out), *reply = NULL;
	void *came = NULL, *back = NULL;
	status = status ? status : bytes && out ? 0 : pm_no_memory();
	if (!status)
		by_owner(m, part, each, out, NULL, bytes);
	status = pm_world_exchange(status, out, bytes, &came, bytes ? bytes + ranks : NULL);
	for (size_t r = 0; r < ranks && !status; r++)
		n += bytes[ranks + r] / (each * sizeof *out);
	status = status ? status : (reply = pm_alloc(n * k + 1, sizeof *reply)) ? join(n, k, came, reply) : pm_failed();
	for (size_t r = 0; r < ranks && !status; r++)
		bytes[ranks + r] = bytes[ranks + r] / each * k;
	status = pm_world_exchange(status, reply, bytes ? bytes + ranks : NULL, &back, bytes ? bytes + 2 * ranks : NULL);
	if (!status)
		by_owner(m, part, k, back, total, NULL);
	pm_free(out), pm_free(reply), pm_free(came), pm_free(back), free(bytes);
	return status;
}

static int of_groups(int status, const struct pm_field *group, struct pm_field *field)
{
	struct members m = {.n = 0};
	status = status ? status : sort(group, field, &m);
	double *part = status ? NULL : pm_alloc((m.parts + 1) * length(m.components), sizeof *part);
	double *total = status ? NULL : pm_alloc(m.parts * m.components + 1, sizeof *total);
	status = status ? status : part && total ? 0 : pm_failed();
	if (!status)
		make_parts(&m, field, part);
	status = field->here ? join_ranks(status, &m, part, total) : status ? status : join(m.parts, m.components, part, total);
	for (size_t c = 0; c < m.components && !status; c++)
		for (size_t i = 0, at = 0; i < m.n; i++) {
			at += begins(&m, i);
			pm_out(field, (int)c)[m.of[i].index] = total[(at - 1) * m.components + c];
		}
	pm_free(m.of), pm_free(part), pm_free(total);
	return status;
}

int pm_total(int status, const struct pm_frame *f, struct pm_field *field, const char *per)
{
	if (per)
		return of_groups(status, pm_frame_field(f, field->on, per), field);
	for (int c = 0; c < field->components; c++) {
		struct pm_sum all = {0};
		double *x = status ? NULL : pm_out(field, c);
		status = pm_world_sum_of_set(status, field->count, x, NULL, &all);
		for (size_t i = 0; i < field->count && !status; i++)
			x[i] = pm_sum_total(all);
	}
	return status;
}
