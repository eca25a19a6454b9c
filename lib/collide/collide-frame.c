/* Which sets collide, Coulomb's logarithm, and the cells (collide-cell.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/in-order.h"
#include "cell/radix-sort.h"
#include "collide/collide-cell.h"
#include "collide/collide-frame.h"
#include "law/law.h"
#include "stream/declare.h"

/* Is the set one of the two, or one of all? */
static bool takes(const struct pm_collide *c, const struct pm_frame *f, const struct pm_set *set)
{
	if (c->between[0])
		return !strcmp(set->name, c->between[0]) || !strcmp(set->name, c->between[1]);
	return pm_set_moves(f, set) && pm_frame_field(f, set->name, "charge") && pm_frame_field(f, set->name, "mass") && pm_frame_field(f, set->name, "v");
}

static int declare_set(struct pm_frame *f, const char *on)
{
	const struct pm_field *id = pm_frame_field(f, on, "id");
	if (id && id->type != PM_I64)
		return pm_fail(PM_DATA, "'id' on '%s' is not i64, but the random numbers depend on it (smod --rename id=NAME)", on);
	const struct pm_field *v = pm_reads(f, on, "x") && pm_reads(f, on, "charge") && pm_reads(f, on, "mass") ? pm_changes(f, on, "v") : NULL;
	if (!v || (id && !pm_reads(f, on, "id")))
		return -PM_DATA;
	return v->components == 3 ? 0
		: pm_fail(PM_DATA, "the velocities of '%s' have %d component%s, but collisions turn them in space (pinit --velocities 3)", on, v->components,
			v->components == 1 ? "" : "s");
}

int pm_collide_declare(const struct pm_collide *c, struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	int sets = 0, status = 0;
	if (!law || !law->strength || strcmp(law->strength, "charge"))
		return pm_fail(PM_DATA, "collisions are those of charges, and the law is %s (smod --law electrostatic)", f->law);
	if (!(f->dt > 0))
		return pm_fail(PM_DATA, "the time step is %g, but collisions need dt > 0 (smod --dt)", f->dt);
	if (!pm_frame_mesh(f, c->mesh))
		return pm_fail(PM_DATA, "no mesh%s%s, whose cells hold the particles that collide (p2m -n CELLS makes one)", c->mesh ? " " : "",
			c->mesh ? c->mesh : "");
	for (int i = 0; i < 2 && c->between[i]; i++)
		if (!pm_frame_set(f, c->between[i]))
			return pm_fail(PM_DATA, "no set '%s' (sls lists them)", c->between[i]);
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (takes(c, f, f->sets[i]))
			status = sets++ == PM_COLLIDE_SETS ? pm_fail(PM_DATA, "more than %d sets", PM_COLLIDE_SETS) : declare_set(f, f->sets[i]->name);
	return status ? status : sets ? 0 : pm_fail(PM_DATA, f->nsets ? "no set that moves has charge, mass and velocity (species adds one; of a table stab "
		"--strength charge,mass)" : "no particles (species, stab and pinit make them)");
}

/* Sums over a set: charge^2, mass, mass v, mass v^2. */
enum { CHARGE2, MASS, MOMENTUM, ENERGY = MOMENTUM + 3, SUMS };
static void add(const void *data, size_t from, size_t to, void *part)
{
	const struct pm_colliding *s = data;
	struct pm_sum *sum = part;
	for (size_t i = from; i < to; i++) {
		pm_sum_add(&sum[CHARGE2], s->charge[i] * s->charge[i]);
		pm_sum_add(&sum[MASS], s->mass[i]);
		for (int c = 0; c < 3; c++) {
			pm_sum_add(&sum[MOMENTUM + c], s->mass[i] * s->v[c][i]);
			pm_sum_add(&sum[ENERGY], s->mass[i] * s->v[c][i] * s->v[c][i]);
		}
	}
}

/* Of each set: the mean charge [charge] and mass, <|v - <v>|^2>, and its n q^2/T, whose sum is eps0 over the square of the Debye length. */
struct mean {
	double charge, mass, spread, shield;
};
static struct mean mean_of(const struct pm_colliding *s, double volume)
{
	const struct pm_parts parts = {.size = SUMS * sizeof(struct pm_sum), .make = add, .join = pm_join_sums};
	struct pm_sum sum[SUMS] = {{0}};
	const double n = (double)s->n;
	pm_over_set(&parts, s, s->n, sum);
	const double mass = pm_sum_total(sum[MASS]);
	double flow = 0;
	for (int c = 0; c < 3; c++)
		flow += pow(pm_sum_total(sum[MOMENTUM + c]) / mass, 2);
	struct mean m = {.charge = sqrt(pm_sum_total(sum[CHARGE2]) / n), .mass = mass / n, .spread = fmax(0, pm_sum_total(sum[ENERGY]) / mass - flow)};
	m.shield = 3 * n * m.charge * m.charge / (volume * m.mass * m.spread);
	return m;
}

/* Coulomb's logarithm of every pair of sets. */
static double logarithms(const struct pm_collide *c, const struct pm_frame *f, struct pm_colliders *k)
{
	struct mean m[PM_COLLIDE_SETS];
	double volume = 1, shield = 0, least = HUGE_VAL;
	for (int d = 0; d < f->dim; d++)
		volume *= f->hi[d] - f->lo[d];
	for (int a = 0; a < k->nsets && isnan(c->logarithm); a++)
		if (k->set[a].n) {
			m[a] = mean_of(&k->set[a], volume);
			shield += isfinite(m[a].shield) ? m[a].shield : 0;
		}
	for (int a = 0; a < k->nsets; a++)
		for (int b = a; b < k->nsets; b++) {
			double value = c->logarithm;
			if (isnan(value) && k->set[a].n && k->set[b].n) {
				const double reduced = m[a].mass * m[b].mass / (m[a].mass + m[b].mass), u2 = m[a].spread + m[b].spread;
				value = log(sqrt(k->eps0 / shield) * 4 * pm_pi * k->eps0 * reduced * u2 * k->weight / (m[a].charge * m[b].charge));
			}
			k->logarithm[a][b] = isnan(c->logarithm) ? fmax(2, isnan(value) ? 2 : value) : value;
			least = fmin(least, k->logarithm[a][b]);
		}
	return least;
}

static uint64_t key_of(uint64_t seed, const char *a, const char *b)
{
	uint64_t hash = 0xcbf29ce484222325u;
	for (int i = 0; i < 2; i++) {
		for (const char *c = i ? b : a; *c; c++)
			hash = (hash ^ (unsigned char)*c) * 0x100000001b3u;
		hash = (hash ^ '/') * 0x100000001b3u;
	}
	return seed ^ hash;
}

static void sets_of(const struct pm_collide *c, struct pm_frame *f, struct pm_colliders *k)
{
	for (size_t i = 0; i < f->nsets; i++) {
		const char *on = f->sets[i]->name;
		const struct pm_field *id = pm_frame_field(f, on, "id");
		if (!takes(c, f, f->sets[i]))
			continue;
		struct pm_colliding *s = &k->set[k->nsets++];
		*s = (struct pm_colliding){.name = on, .n = f->sets[i]->n, .id = id ? pm_in_i64(id, 0) : NULL,
			.charge = pm_in(pm_frame_field(f, on, "charge"), 0), .mass = pm_in(pm_frame_field(f, on, "mass"), 0),
			.shuffle = key_of(c->seed, on, "order")};
		for (int d = 0; d < 3; d++)
			s->v[d] = pm_out(pm_frame_field(f, on, "v"), d);
	}
	for (int a = 0; a < k->nsets; a++)
		for (int b = 0; b < k->nsets; b++) {
			k->key[a][b] = key_of(c->seed, k->set[a].name, k->set[b].name);
			k->pairs[a][b] = !c->between[0] || (strcmp(c->between[0], c->between[1]) ? a != b : a == b);
		}
}

/* The cell of every particle of all sets, and their order by cell. */
static int order_of(struct pm_frame *f, const struct pm_grid *g, const struct pm_colliders *k, size_t n, uint64_t *key, size_t *order)
{
	uint64_t *sorted = pm_alloc(n, sizeof *sorted), *work = pm_alloc(n, sizeof *work);
	size_t *order_work = pm_alloc(n, sizeof *order_work), at = 0;
	const bool room = sorted && work && order_work;
	for (int a = 0; a < k->nsets && room; at += k->set[a++].n) {
		const struct pm_field *x = pm_frame_field(f, k->set[a].name, "x");
		const double *const position[3] = {pm_in(x, 0), x->components > 1 ? pm_in(x, 1) : NULL, x->components > 2 ? pm_in(x, 2) : NULL};
		pm_keys_of_cells(g, k->set[a].n, position, key + at);
	}
	if (room) {
		memcpy(sorted, key, n * sizeof *key);
		pm_keys_order(n, sorted, work, order, order_work);
	}
	pm_free(sorted), pm_free(work), pm_free(order_work);
	return room ? 0 : -PM_DATA;
}

static double fastest(const struct pm_colliders *k)
{
	double most = 0;
	for (int a = 0; a < k->nsets; a++) {
		const struct pm_colliding *s = &k->set[a];
		for (size_t i = 0; i < s->n; i++)
			most = fmax(most, s->v[0][i] * s->v[0][i] + s->v[1][i] * s->v[1][i] + s->v[2][i] * s->v[2][i]);
	}
	return sqrt(most);
}

/* Particles that stand for different numbers of the same body. */
static bool weighted(const struct pm_colliding *s)
{
	bool same = true, one = true;
	for (size_t i = 1; i < s->n; i++) {
		one = one && s->mass[i] == s->mass[0];
		same = same && fabs(s->charge[i] * s->mass[0] - s->charge[0] * s->mass[i]) <= 1e-12 * fabs(s->charge[0] * s->mass[i]);
	}
	return same && !one;
}

int pm_collide_step(const struct pm_collide *c, struct pm_frame *f, struct pm_collided *r)
{
	const struct pm_grid g = pm_grid_of(f, pm_frame_mesh(f, c->mesh));
	struct pm_colliders k = {.method = c->method, .dt = f->dt, .step = f->step, .cell = pm_grid_cell(&g), .eps0 = pm_law_constant(f, "eps0", 1)};
	size_t n = 0;
	sets_of(c, f, &k);
	for (int a = 0; a < k.nsets; a++)
		k.from[a] = n, n += k.set[a].n;
	k.from[k.nsets] = n;
	const double bodies = pm_frame_constant(f, "bodies", NAN);
	k.weight = !isnan(c->weight) ? c->weight : isfinite(bodies) && n ? bodies / (double)n : 1;
	*r = (struct pm_collided){.logarithm = logarithms(c, f, &k), .fastest = fastest(&k), .single = isnan(c->weight) && !isfinite(bodies)};
	for (int a = 0; a < k.nsets && !r->weighted; a++)
		r->weighted = weighted(&k.set[a]) ? k.set[a].name : NULL;
	k.cell_of = pm_alloc(n, sizeof *k.cell_of);
	k.order = pm_alloc(n, sizeof *k.order);
	int status = !k.cell_of || !k.order ? -PM_DATA : order_of(f, &g, &k, n, k.cell_of, k.order);
	if (!status)
		status = pm_collide_cells(&k, n, &r->pairs, &r->turn);
	pm_free(k.cell_of), pm_free(k.order);
	return status;
}
