/* Every ion of charge Z e in the field E loses electrons one after the other within dt: the first after the time -log(u)/W_Z(|E|), the second after
 * -log(u')/W_{Z+1}(|E|) more, and so on until the step ends. For a field that is constant through the step this has the probabilities of the chain of rate
 * equations exactly, whatever W dt is, equal rates included (Nuter et al. 2011 draw from the same law with one number). A particle that stands for w atoms
 * gives w electrons for each stage, one particle; it is where the ion is and has its velocity, and the ion loses its mass and charge: so charge, momentum and
 * mass of both are what they were, and so are the density of charge and its field. The charge of an ion is its state:
 *     w = (mass + (charge/|e|) m_e)/M,   Z = charge/(w |e|).
 * Field and time in atomic units: E (|e|/m_e) (L/a_0)/(T/t_a)^2, dt T/t_a, with units L and T of the frame.
 * Random numbers belong to seed, set, id (or index), step and stage. Cost: a gather of E, and a rate and two random numbers an ion and stage.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "ionisation/field-ionisation.h"
#include "load/newcomers.h"
#include "push/random-walk.h"
#include "stream/declare.h"
#include "stream/field-value.h"
#include "transfer/gather-frame.h"

enum { stage_bits = 6 }; /* of the counter of random numbers */
static const double speed_of_light = 299792458; /* [m/s] */

struct chain {
	struct pm_tunnel stage[PM_ELEMENT_MOST];
	int z;
	double field, time; /* of the frame's units in atomic ones */
	bool suppressed;
	uint64_t key, step;
};

static int units(const struct pm_field_ionisation *g, const struct pm_frame *f, double *length)
{
	const double c = pm_frame_constant(f, "c", NAN);
	*length = isfinite(g->length_unit) ? g->length_unit : g->time_unit * speed_of_light / c;
	if (!(*length > 0))
		return pm_fail(PM_DATA, "how long is the frame's unit of length? (--length-unit METRES, or the constant c: smod --constant c=C)");
	if (isfinite(g->length_unit) && isfinite(c) && fabs(g->time_unit * speed_of_light / (g->length_unit * c) - 1) > 1e-3)
		return pm_fail(PM_USAGE, "with these units of time and length light has the speed %.6g, and the frame's c is %.6g (leave out --length-unit)",
			g->time_unit * speed_of_light / g->length_unit, c);
	return 0;
}

static int choose_field(const struct pm_field_ionisation *g, const struct pm_frame *f, struct pm_gather_job *j)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	if (!law->strength || strcmp(law->strength, "charge") || !law->field)
		return pm_fail(PM_DATA, "the law '%s' has no electric field (smod --law electrostatic)", f->law);
	const struct pm_gather_choice choice = {.kernel = g->kernel, .mesh = g->mesh, .set = g->set, .field = law->field, .outside = "drop"};
	const int status = pm_gather_choose(&choice, f, j);
	return status || !j->interlaced ? status
		: pm_fail(PM_DATA, "the field at an atom is that of one mesh, and '%s' is interlaced (p2m without --interlace)", law->field);
}

static int check_sets(const struct pm_field_ionisation *g, const struct pm_frame *f)
{
	static const char *const needs[] = {"x", "v", "mass", "charge", NULL};
	const struct pm_field *v = pm_frame_field(f, g->set, "v"), *u = pm_frame_field(f, g->electrons, "v"), *id = pm_frame_field(f, g->set, "id");
	if (!pm_frame_set(f, g->set))
		return pm_fail(PM_DATA, "no set '%s' (species %s --charge 0 makes atoms)", g->set, g->set);
	for (int k = 0; needs[k]; k++)
		if (!pm_frame_field(f, g->set, needs[k]))
			return pm_fail(PM_DATA, "'%s' has no '%s' (species makes sets with x, v, mass, charge and id)", g->set, needs[k]);
	if (!u || u->components != v->components || !strcmp(g->electrons, g->set))
		return pm_fail(PM_DATA, "no set '%s' of electrons with %d components of v (species %s -n 0 --velocities %d)", g->electrons,
			v->components, g->electrons, v->components);
	if (id && id->type != PM_I64)
		return pm_fail(PM_DATA, "'id' on '%s' is not i64, but the random numbers depend on it (smod --rename id=NAME)", g->set);
	if (!(f->dt > 0))
		return pm_fail(PM_DATA, "the time step is %g, and ionisation happens per time (smod --dt)", f->dt);
	return 0;
}

/* What is made: electrons. */
static struct pm_newcomers newcomers(const struct pm_field_ionisation *g, const struct pm_frame *f)
{
	return (struct pm_newcomers){.set = g->electrons, .velocities = pm_frame_field(f, g->set, "v")->components};
}

/* Rates of change belong to the particles and charges of before. */
static int drop_changes(const struct pm_field_ionisation *g, struct pm_frame *f)
{
	const char *const set[] = {g->set, g->electrons};
	for (size_t i = 0; i < f->nfields && f->substep; i++) {
		const struct pm_field *p = f->fields[i];
		if ((p->role == PM_CHANGE || p->role == PM_REGISTER) && (!strcmp(p->on, set[0]) || !strcmp(p->on, set[1])))
			return pm_fail(PM_DATA, "'%s' has '%s' already, which is not that of new electrons and charges (put ionise in front of m2p)",
				p->on, p->name);
	}
	for (int k = 0; k < 2; k++)
		pm_drops_roles(f, set[k], 1u << PM_CHANGE | 1u << PM_DERIVED);
	return 0;
}

int pm_field_ionise_declare(const struct pm_field_ionisation *g, struct pm_frame *f)
{
	struct pm_gather_job j;
	double length;
	int status = check_sets(g, f);
	status = status ? status : units(g, f, &length);
	if (status)
		return status;
	const struct pm_set *electrons = pm_frame_set(f, g->electrons);
	if (f->substep && !(electrons->drift > 0))
		return pm_fail(PM_DATA, "within a step ionise stands behind the drift (push boris/2 | p2m --current | maxwell | push drift | ionise ... | "
			"m2p | push boris/2)");
	if (f->substep && !(electrons->drift > 1 - 1e-9))
		return PM_FIELD_IONISE_WAITS;
	if ((status = choose_field(g, f, &j)) || (status = drop_changes(g, f)))
		return status;
	const struct pm_newcomers a = newcomers(g, f);
	if (!pm_reads(f, j.mesh->name, j.name) || !pm_reads(f, g->set, "x") || !pm_reads(f, g->set, "v") || !pm_changes(f, g->set, "mass")
		|| !pm_changes(f, g->set, "charge") || (pm_frame_field(f, g->set, "id") && !pm_reads(f, g->set, "id")))
		return -PM_DATA;
	status = pm_newcomers_declare(f, &a);
	return status ? status : PM_FIELD_IONISE_ACTS;
}

static double *strengths_of_field(const struct pm_gather_job *j, const struct pm_frame *f, const char *set, size_t n, uint64_t *outside)
{
	struct pm_strays strays = {.count = 0};
	const double *x[3] = {0}, *mesh[3] = {0};
	double *out[3] = {0}, *all = pm_zalloc(3 * n + 1, sizeof *all);
	const int components = j->transfer.components < 3 ? j->transfer.components : 3;
	for (int d = 0; d < f->dim; d++)
		x[d] = pm_in(pm_frame_field(f, set, "x"), d);
	for (int c = 0; c < components; c++)
		mesh[c] = pm_in(j->field, c), out[c] = all ? all + (size_t)c * n : NULL;
	if (!all || pm_gather(&j->transfer, n, x, mesh, NULL, out, &strays)) {
		pm_free(all);
		return NULL;
	}
	for (size_t i = 0; i < n; i++)
		all[i] = sqrt(all[i] * all[i] + all[n + i] * all[n + i] + all[2 * n + i] * all[2 * n + i]);
	*outside = strays.count;
	return all;
}

static void chain_init(struct chain *k, const struct pm_field_ionisation *g, const struct pm_frame *f)
{
	double length = NAN;
	units(g, f, &length);
	*k = (struct chain){.z = g->element->z, .suppressed = g->suppressed, .step = (uint64_t)f->step, .key = pm_walk_key(g->seed ^ 0x61646b00, g->set)};
	for (int s = 0; s < k->z; s++)
		k->stage[s] = pm_tunnel_of(g->element, s);
	k->time = g->time_unit / PM_ATOMIC_TIME;
	k->field = fabs(g->charge) / g->electron_mass * (length / PM_ATOMIC_LENGTH) / (k->time * k->time);
}

/* The electrons that an ion of charge `from` loses within dt [atomic], in the field E [atomic]. */
static int lose(const struct chain *k, uint64_t id, int from, double field, double dt)
{
	int to = from;
	for (double u[2]; to < k->z; to++) {
		const double rate = pm_tunnel_rate(&k->stage[to], field, k->suppressed);
		if (!(rate * dt > 1e-16)) /* below the resolution of u */
			break;
		pm_random(k->key, id, k->step << stage_bits | (uint64_t)to, u);
		dt += log(u[0]) / rate;
		if (!(dt >= 0))
			break;
	}
	return to - from;
}

/* What an ion is: its number of real ones, and its charge in |e|; -1: none. */
static int state_of(const struct pm_field_ionisation *g, double mass, double charge, double *weight)
{
	const double e = fabs(g->charge);
	*weight = (mass + charge / e * g->electron_mass) / g->mass;
	const double z = *weight > 0 ? charge / (*weight * e) : 0, whole = rint(z);
	const bool near = fabs(z - whole) <= 1e-5 * fmax(1, whole); /* mass and charge may be f32 */
	return *weight >= 0 && whole >= 0 && whole <= g->element->z && near ? (int)whole : -1;
}

struct losses {
	unsigned char *lost;  /* [n] electrons of each ion */
	uint64_t electrons;
	size_t wrong;         /* the first ion that is none, or n */
	double strongest, critical;
};

static void draw(const struct pm_field_ionisation *g, const struct pm_frame *f, const struct chain *k, const double *field, size_t n, struct losses *o)
{
	const struct pm_field *id = pm_frame_field(f, g->set, "id");
	const int64_t *number = id && id->count ? pm_in_i64(id, 0) : NULL;
	const double *mass = pm_in(pm_frame_field(f, g->set, "mass"), 0), *charge = pm_in(pm_frame_field(f, g->set, "charge"), 0);
	uint64_t electrons = 0;
	size_t wrong = n;
	double strongest = 0, critical = 0;
#pragma omp parallel for schedule(static) reduction(+:electrons) reduction(min:wrong) reduction(max:strongest, critical) if (n > 1024)
	for (size_t i = 0; i < n; i++) {
		double weight;
		const int z = state_of(g, mass[i], charge[i], &weight);
		o->lost[i] = 0;
		if (z < 0) {
			wrong = i < wrong ? i : wrong;
			continue;
		}
		const double E = field[i] * k->field;
		strongest = E > strongest ? E : strongest;
		if (z < k->z && weight > 0) {
			const double over = E / k->stage[z].critical;
			critical = over > critical ? over : critical;
			o->lost[i] = (unsigned char)lose(k, number ? (uint64_t)number[i] : i, z, E, f->dt * k->time);
			electrons += o->lost[i];
		}
	}
	o->electrons = electrons;
	o->wrong = wrong;
	o->strongest = strongest;
	o->critical = critical;
}

/* The electrons, in the order of the ions; what is left of these. */
static int take(const struct pm_field_ionisation *g, struct pm_frame *f, const struct chain *k, const struct losses *o, size_t n, struct pm_sum *energy)
{
	const struct pm_field *x = pm_frame_field(f, g->set, "x"), *v = pm_frame_field(f, g->set, "v");
	double *mass = pm_out(pm_frame_field(f, g->set, "mass"), 0), *charge = pm_out(pm_frame_field(f, g->set, "charge"), 0);
	struct pm_newcomers a = newcomers(g, f);
	int status = pm_newcomers_room(f, &a, o->electrons);
	for (size_t i = 0; i < n && !status; i++) {
		double weight;
		int z = state_of(g, mass[i], charge[i], &weight);
		for (int lost = 0; lost < o->lost[i]; lost++, z++, a.n++) {
			for (int d = 0; d < f->dim; d++)
				a.x[d][a.n] = pm_value_at(x, d, i);
			for (int c = 0; c < v->components; c++)
				a.v[c][a.n] = pm_value_at(v, c, i);
			a.m[a.n] = weight * g->electron_mass;
			a.q[a.n] = weight * g->charge;
			pm_sum_add(energy, weight * k->stage[z].energy);
		}
		mass[i] -= o->lost[i] * weight * g->electron_mass;
		charge[i] -= o->lost[i] * weight * g->charge;
	}
	status = status ? status : pm_newcomers_append(&a, f);
	pm_newcomers_free(&a);
	return status;
}

int pm_field_ionise_step(const struct pm_field_ionisation *g, struct pm_frame *f, struct pm_field_ionised *r)
{
	struct pm_gather_job j;
	struct chain k;
	struct losses o = {.lost = NULL};
	struct pm_sum energy = {0};
	const size_t n = pm_frame_field(f, g->set, "x")->count;
	double *field = NULL, length = 1;
	*r = (struct pm_field_ionised){.electrons = 0};
	int status = choose_field(g, f, &j);
	status = status ? status : units(g, f, &length);
	if (!status) {
		field = strengths_of_field(&j, f, g->set, n, &r->outside);
		o.lost = pm_alloc(n + 1, 1);
		status = field && o.lost ? 0 : -PM_DATA;
	}
	if (!status) {
		chain_init(&k, g, f);
		draw(g, f, &k, field, n, &o);
		if (o.wrong < n)
			status = pm_fail(PM_DATA, "particle %zu of '%s' is no ion of %s: an atom of the mass %g that has lost Z electrons has the mass "
				"%g - Z %g and the charge Z %g (--mass, --electron-charge; species --mass, --charge)", o.wrong, g->set, g->element->symbol,
				g->mass, g->mass, g->electron_mass, fabs(g->charge));
	}
	if (!status)
		status = take(g, f, &k, &o, n, &energy);
	if (!status) {
		const double speed = (length / PM_ATOMIC_LENGTH) / k.time; /* of the frame's unit, in atomic ones */
		r->electrons = o.electrons;
		r->energy = pm_sum_total(energy) * g->electron_mass / (speed * speed);
		r->strongest = o.strongest * PM_ATOMIC_FIELD;
		r->critical = o.critical;
	}
	pm_free(field);
	pm_free(o.lost);
	return status;
}
