/* Monte Carlo collisions with a gas of density n_g at rest or drifting, which they do not change. A particle meets an atom of a velocity V drawn from the gas;
 * g = |v - V|. It collides within dt with the probability 1 - exp(-n_g sum sigma_k(g) g dt), by process k with its share of the sum:
 *     elastic:  the relative velocity turns to any direction of space,  v' = (m v + M V + M g')/(m + M);
 *     exchange: the charge goes over to the atom, v' = V;
 *     excite E: as elastic, and m M/(m + M) g^2/2 has lost E; only where there is as much.
 *     ionise E: what energy is left above E goes in halves to the particle and to a second one like it, each in a direction of its own, which the relative
 *               velocity to the atom has; an ion of the mass M - m and the opposite charge goes on with V. Both begin where the particle is.
 * An atom is drawn for every particle, so no bound on sigma g is needed (the null-collision method needs it to draw fewer). One collision a step at most, so
 * rates have an error of first order in the probability. Random numbers belong to seed, set, id and step.
 * Source: Birdsall 1991 (IEEE Trans. Plasma Sci. 19, 65), section IV; Vahedi and Surendra 1995 (Comput. Phys. Commun. 87, 179); Turner et al. 2013
 * (Phys. Plasmas 20, 013507), the processes. Cost: two random numbers a particle, eight where the gas is warm, and the cross-sections.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "collide/neutral-gas.h"
#include "load/newcomers.h"
#include "push/random-walk.h"
#include "stream/declare.h"
#include "stream/edit.h"
#include "stream/field-value.h"

int pm_gas_process_of(const char *text, struct pm_gas_process *p)
{
	static const char *const kinds[] = {"elastic", "exchange", "excite", "ionise"};
	const char *colon = strchr(text, ':');
	*p = (struct pm_gas_process){.section = colon ? colon + 1 : NULL};
	for (int k = 0; k < 4 && colon; k++) {
		const size_t n = strlen(kinds[k]);
		char *end = NULL;
		if (strncmp(text, kinds[k], n))
			continue;
		p->kind = (enum pm_gas_kind)k;
		if (p->kind >= PM_GAS_EXCITE)
			p->threshold = strtod(text + n, &end);
		if (p->kind >= PM_GAS_EXCITE ? end == colon && end > text + n && p->threshold >= 0 : text + n == colon)
			return 0;
	}
	return pm_fail(PM_USAGE, "'%s' is no process ('elastic: SIGMA', 'exchange: SIGMA', 'excite ENERGY: SIGMA', 'ionise ENERGY: SIGMA')", text);
}

const char *pm_gas_file_of(const char *section)
{
	section += strspn(section, " \t");
	return *section == '@' ? section + 1 : NULL;
}

static bool ionises(const struct pm_gas *g)
{
	bool does = false;
	for (int k = 0; k < g->n; k++)
		does = does || g->process[k].kind == PM_GAS_IONISE;
	return does;
}

/* What is made: second electrons, and ions. */
static struct pm_newcomers newcomers(const char *set) { return (struct pm_newcomers){.set = set, .velocities = 3}; }

static int declare_pairs(const struct pm_gas *g, struct pm_frame *f)
{
	const struct pm_field *v = g->ions ? pm_frame_field(f, g->ions, "v") : NULL;
	const struct pm_newcomers electrons = newcomers(g->set), ions = newcomers(g->ions);
	if (!g->ions)
		return pm_fail(PM_USAGE, "'ionise' makes ions: of which set? (--ions NAME)");
	if (!v || v->components != 3 || !strcmp(g->ions, g->set))
		return pm_fail(PM_DATA, "no set '%s' of ions with 3 components of v (species %s -n 0 --velocities 3)", g->ions, g->ions);
	if (!(g->gas_mass > g->mass))
		return pm_fail(PM_USAGE, "an atom of the mass %g has no electron of the mass %g (--gas-mass)", g->gas_mass, g->mass);
	for (int k = 0; k < 4; k++)
		if (!pm_reads(f, g->set, (const char *const[]){"x", "mass", "charge", "id"}[k]))
			return pm_fail(PM_DATA, "'%s' has no %s (species makes sets with x, v, mass, charge and id)", g->set,
				(const char *const[]){"x", "mass", "charge", "id"}[k]);
	if (!f->substep && pm_frame_outdate(f))
		return -PM_DATA;
	if (f->substep) /* behind the drift: the next force includes what is made */
		pm_drops_roles(f, NULL, 1u << PM_CHANGE | 1u << PM_DERIVED);
	int status = pm_newcomers_declare(f, &electrons);
	return status ? status : pm_newcomers_declare(f, &ions);
}

int pm_gas_declare(const struct pm_gas *g, struct pm_frame *f)
{
	const struct pm_field *v = pm_frame_field(f, g->set, "v"), *id = pm_frame_field(f, g->set, "id");
	if (!pm_frame_set(f, g->set))
		return pm_fail(PM_DATA, "no set '%s' (sls lists the sets)", g->set);
	if (!v || v->components != 3)
		return pm_fail(PM_DATA, "collisions turn velocities in space, and v of '%s' has %d components (species --velocities 3)", g->set,
			v ? v->components : 0);
	if (!(f->dt > 0))
		return pm_fail(PM_DATA, "the time step is %g, and collisions happen per time (smod --dt)", f->dt);
	if (id && id->type != PM_I64)
		return pm_fail(PM_DATA, "'id' on '%s' is not i64, but the random numbers depend on it (smod --rename id=NAME)", g->set);
	if (f->substep && (!ionises(g) || !(pm_frame_set(f, g->set)->drift > 1 - 1e-9)))
		return PM_GAS_WAITS;
	const int status = ionises(g) ? declare_pairs(g, f) : 0;
	return status ? status : !pm_changes(f, g->set, "v") || (id && !pm_reads(f, g->set, "id")) ? -PM_DATA : PM_GAS_ACTS;
}

/* Any direction of space, of the length g. */
static void turn(double g, const double u[2], double to[3])
{
	const double along = 2 * u[0] - 1, across = sqrt(fmax(0, 1 - along * along)), phi = 2 * pm_pi * u[1];
	to[0] = g * across * cos(phi);
	to[1] = g * across * sin(phi);
	to[2] = g * along;
}

/* Frequency of each process [1/time] at the relative speed; the sum, NAN where a cross-section is none. */
static double frequencies(const struct pm_gas *g, double speed, double nu[PM_GAS_PROCESSES])
{
	const double reduced = g->mass * g->gas_mass / (g->mass + g->gas_mass), energy = 0.5 * reduced * speed * speed;
	double sum = 0;
	for (int k = 0; k < g->n; k++) {
		double number[64], sigma;
		if (g->process[k].table.n) {
			sigma = pm_cross_section_at(&g->process[k].table, energy);
		} else {
			memcpy(number, g->process[k].names.number, sizeof number);
			number[0] = speed;
			number[1] = energy;
			sigma = pm_expression_number(&g->process[k].e, number);
		}
		nu[k] = !(speed > 0) || energy < g->process[k].threshold ? 0 : g->density * sigma * speed; /* also of sections such as 1/g */
		sum += nu[k] >= 0 && isfinite(nu[k]) ? nu[k] : NAN;
	}
	return sum;
}

static void scatter(const struct pm_gas *g, const struct pm_gas_process *p, const double atom[3], double speed, const double u[2], double v[3])
{
	const double m = g->mass, M = g->gas_mass, reduced = m * M / (m + M);
	double to[3];
	const double left = fmax(0, speed * speed - 2 * p->threshold / reduced);
	if (p->kind == PM_GAS_IONISE) {
		turn(sqrt(0.5 * left * reduced / m), u, to);
		for (int c = 0; c < 3; c++)
			v[c] = atom[c] + to[c];
		return;
	}
	turn(sqrt(left), u, to);
	for (int c = 0; c < 3; c++)
		v[c] = p->kind == PM_GAS_EXCHANGE ? atom[c] : (m * v[c] + M * atom[c] + M * to[c]) / (m + M);
}

/* What a particle met. */
struct meeting {
	bool collided, ionised;
	double second[3], ion[3]; /* then: the velocities of the new ones */
};

/* One particle; its probability. */
static double meet(const struct pm_gas *g, double dt, uint64_t key, uint64_t id, uint64_t step, double v[3], struct meeting *o)
{
	double z[4] = {0}, u[4], atom[3], nu[PM_GAS_PROCESSES], square = 0;
	for (int k = 0; k < 2 && g->vth > 0; k++)
		pm_random_normal(key, id, step * 4 + (uint64_t)k, z + 2 * k);
	pm_random(key, id, step * 4 + 2, u);
	for (int c = 0; c < 3; c++) {
		atom[c] = g->drift[c] + g->vth * z[c];
		square += (v[c] - atom[c]) * (v[c] - atom[c]);
	}
	const double speed = sqrt(square), sum = frequencies(g, speed, nu), probability = -expm1(-sum * dt);
	*o = (struct meeting){.collided = u[0] < probability};
	if (o->collided)
		pm_random(key, id, step * 4 + 3, u + 2);
	double share = u[1] * sum;
	int k = 0;
	while (o->collided && k < g->n - 1 && share >= nu[k])
		share -= nu[k++];
	if (o->collided && g->process[k].kind == PM_GAS_IONISE) {
		double other[2];
		o->ionised = true;
		pm_random(key ^ 0x696f6e, id, step, other);
		memcpy(o->second, v, sizeof o->second);
		memcpy(o->ion, atom, sizeof o->ion);
		scatter(g, &g->process[k], atom, speed, other, o->second);
	}
	if (o->collided)
		scatter(g, &g->process[k], atom, speed, u + 2, v);
	return probability;
}

/* The pairs made: made[6][n] has the velocities of the second electron and of the ion where born. */
static int append(const struct pm_gas *g, struct pm_frame *f, const unsigned char *born, const double *made, struct pm_gas_record *r)
{
	const struct pm_field *x = pm_frame_field(f, g->set, "x"), *m = pm_frame_field(f, g->set, "mass"), *q = pm_frame_field(f, g->set, "charge");
	struct pm_newcomers a[2] = {newcomers(g->set), newcomers(g->ions)};
	const size_t n = x->count;
	int status = 0;
	for (int k = 0; k < 2 && !status; k++)
		status = pm_newcomers_room(f, &a[k], r->pairs);
	for (size_t i = 0, at = 0; i < n && !status; i++) {
		const double mass = pm_value_at(m, 0, i), ion = mass / g->mass * (g->gas_mass - g->mass);
		for (int k = 0; k < 2 && born[i]; k++) {
			for (int d = 0; d < f->dim; d++)
				a[k].x[d][at] = pm_value_at(x, d, i);
			for (int c = 0; c < 3; c++)
				a[k].v[c][at] = made[(size_t)(3 * k + c) * n + i];
			a[k].m[at] = k ? ion : mass;
			a[k].q[at] = (k ? -1 : 1) * pm_value_at(q, 0, i);
		}
		r->given_mass += born[i] ? mass + ion : 0;
		at += born[i];
	}
	for (int k = 0; k < 2; k++) {
		a[k].n = r->pairs;
		status = status ? status : pm_newcomers_append(&a[k], f);
		pm_newcomers_free(&a[k]);
	}
	return status;
}

int pm_gas_step(struct pm_gas *g, struct pm_frame *f, struct pm_gas_record *r)
{
	static const char *const variable[] = {"g", "energy", NULL};
	struct pm_field *v = pm_frame_field(f, g->set, "v");
	const struct pm_field *id = pm_frame_field(f, g->set, "id");
	const int64_t *number = id && id->count ? pm_in_i64(id, 0) : NULL;
	const uint64_t key = pm_walk_key(g->seed ^ 0x67617300, g->set); /* not the numbers of walk */
	double *const to[3] = {pm_out(v, 0), pm_out(v, 1), pm_out(v, 2)};
	double most = 0;
	uint64_t collisions = 0, wrong = 0, pairs = 0;
	const size_t n = v->count;
	const bool pair = ionises(g);
	unsigned char *born = pm_alloc(pair ? n + 1 : 1, 1);
	double *made = pm_alloc(pair ? 6 * n + 1 : 1, sizeof *made);
	for (int k = 0; k < g->n; k++) {
		g->process[k].names = (struct pm_density_names){.f = f, .variable = variable, .n = 2};
		if (!g->process[k].table.n && pm_expression_compile_numbers(&g->process[k].e, pm_density_name, &g->process[k].names, "number (g, energy)",
			g->process[k].section))
			return pm_free(born), pm_free(made), -PM_USAGE;
	}
	if (!born || !made)
		return pm_free(born), pm_free(made), -PM_DATA;
#pragma omp parallel for schedule(static) reduction(+:collisions, wrong, pairs) reduction(max:most) if (v->count > 4096)
	for (size_t i = 0; i < v->count; i++) {
		double w[3] = {to[0][i], to[1][i], to[2][i]};
		struct meeting o;
		const double p = meet(g, f->dt, key, number ? (uint64_t)number[i] : i, (uint64_t)f->step, w, &o);
		wrong += isnan(p);
		most = p > most ? p : most;
		collisions += o.collided;
		pairs += o.ionised;
		if (pair)
			born[i] = o.ionised;
		for (int c = 0; c < 3 && o.ionised; c++)
			made[(size_t)c * n + i] = o.second[c], made[(size_t)(3 + c) * n + i] = o.ion[c];
		for (int c = 0; c < 3; c++)
			to[c][i] = w[c];
	}
	*r = (struct pm_gas_record){.collisions = collisions, .pairs = pairs, .most = most};
	const int status = pair && !wrong ? append(g, f, born, made, r) : 0;
	pm_free(born);
	pm_free(made);
	if (status)
		return status;
	return wrong ? pm_fail(PM_NUMERICS, "a cross-section is negative or not finite at the speeds of %llu particles (max(0, ...) limits it)",
		(unsigned long long)wrong) : 0;
}
