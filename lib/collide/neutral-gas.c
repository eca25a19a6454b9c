/* Monte Carlo collisions with a gas of density n_g at rest or drifting, which they do not change. A particle meets an atom of a velocity V drawn from the gas;
 * g = |v - V|. It collides within dt with the probability 1 - exp(-n_g sum sigma_k(g) g dt), by process k with its share of the sum:
 *     elastic:  the relative velocity turns to any direction of space,  v' = (m v + M V + M g')/(m + M);
 *     exchange: the charge goes over to the atom, v' = V;
 *     excite E: as elastic, and m M/(m + M) g^2/2 has lost E; only where there is as much.
 * An atom is drawn for every particle, so no bound on sigma g is needed (the null-collision method needs it to draw fewer). One collision a step at most, so
 * rates have an error of first order in the probability. Random numbers belong to seed, set, id and step.
 * Source: Birdsall 1991 (IEEE Trans. Plasma Sci. 19, 65), section IV; Vahedi and Surendra 1995 (Comput. Phys. Commun. 87, 179); Turner et al. 2013
 * (Phys. Plasmas 20, 013507), the processes. Cost: eight random numbers a particle, and the expressions. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "collide/neutral-gas.h"
#include "push/random-walk.h"
#include "stream/declare.h"

int pm_gas_process_of(const char *text, struct pm_gas_process *p)
{
	static const char *const kinds[] = {"elastic", "exchange", "excite"};
	const char *colon = strchr(text, ':');
	*p = (struct pm_gas_process){.section = colon ? colon + 1 : NULL};
	for (int k = 0; k < 3 && colon; k++) {
		const size_t n = strlen(kinds[k]);
		char *end = NULL;
		if (strncmp(text, kinds[k], n))
			continue;
		p->kind = (enum pm_gas_kind)k;
		if (p->kind == PM_GAS_EXCITE)
			p->threshold = strtod(text + n, &end);
		if (p->kind == PM_GAS_EXCITE ? end == colon && end > text + n && p->threshold >= 0 : text + n == colon)
			return 0;
	}
	return pm_fail(PM_USAGE, "'%s' is no process ('elastic: SIGMA', 'exchange: SIGMA', or 'excite ENERGY: SIGMA')", text);
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
	return !pm_changes(f, g->set, "v") || (id && !pm_reads(f, g->set, "id")) ? -PM_DATA : 0;
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
		double number[64];
		memcpy(number, g->process[k].names.number, sizeof number);
		number[0] = speed;
		number[1] = energy;
		const double sigma = pm_expression_number(&g->process[k].e, number);
		nu[k] = !(speed > 0) || energy < g->process[k].threshold ? 0 : g->density * sigma * speed; /* also of sections such as 1/g */
		sum += nu[k] >= 0 && isfinite(nu[k]) ? nu[k] : NAN;
	}
	return sum;
}

static void scatter(const struct pm_gas *g, const struct pm_gas_process *p, const double atom[3], double speed, const double u[2], double v[3])
{
	const double m = g->mass, M = g->gas_mass, reduced = m * M / (m + M);
	double to[3];
	turn(sqrt(fmax(0, speed * speed - 2 * p->threshold / reduced)), u, to);
	for (int c = 0; c < 3; c++)
		v[c] = p->kind == PM_GAS_EXCHANGE ? atom[c] : (m * v[c] + M * atom[c] + M * to[c]) / (m + M);
}

/* One particle; its probability, and whether it collided. */
static double meet(const struct pm_gas *g, double dt, uint64_t key, uint64_t id, uint64_t step, double v[3], bool *collided)
{
	double z[4], u[4], atom[3], nu[PM_GAS_PROCESSES], square = 0;
	for (int k = 0; k < 2; k++) {
		pm_random_normal(key, id, step * 4 + (uint64_t)k, z + 2 * k);
		pm_random(key, id, step * 4 + 2 + (uint64_t)k, u + 2 * k);
	}
	for (int c = 0; c < 3; c++) {
		atom[c] = g->drift[c] + g->vth * z[c];
		square += (v[c] - atom[c]) * (v[c] - atom[c]);
	}
	const double speed = sqrt(square), sum = frequencies(g, speed, nu), probability = -expm1(-sum * dt);
	*collided = u[0] < probability;
	double share = u[1] * sum;
	int k = 0;
	while (*collided && k < g->n - 1 && share >= nu[k])
		share -= nu[k++];
	if (*collided)
		scatter(g, &g->process[k], atom, speed, u + 2, v);
	return probability;
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
	uint64_t collisions = 0, wrong = 0;
	for (int k = 0; k < g->n; k++) {
		g->process[k].names = (struct pm_density_names){.f = f, .variable = variable, .n = 2};
		if (pm_expression_compile_numbers(&g->process[k].e, pm_density_name, &g->process[k].names, "number (g, energy)", g->process[k].section))
			return -PM_USAGE;
	}
#pragma omp parallel for schedule(static) reduction(+:collisions, wrong) reduction(max:most) if (v->count > 4096)
	for (size_t i = 0; i < v->count; i++) {
		double w[3] = {to[0][i], to[1][i], to[2][i]};
		bool collided;
		const double p = meet(g, f->dt, key, number ? (uint64_t)number[i] : i, (uint64_t)f->step, w, &collided);
		wrong += isnan(p);
		most = p > most ? p : most;
		collisions += collided;
		for (int c = 0; c < 3; c++)
			to[c][i] = w[c];
	}
	*r = (struct pm_gas_record){.collisions = collisions, .most = most};
	return wrong ? pm_fail(PM_NUMERICS, "a cross-section is negative or not finite at the speeds of %llu particles (max(0, ...) limits it)",
		(unsigned long long)wrong) : 0;
}
