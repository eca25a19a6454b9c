/* L dI/dt + R I + q/C + phi = V(t), dq/dt = I, phi the potential of the electrode against the other one at distance D:
 *     phi = (D sigma + sum q_k d_k + background D^2/2)/eps0,
 * d_k the distance of charge k from the other electrode, sigma the charge on this one: what it has collected (push), emitted (inject), and I dt.
 * Particles and circuit are solved together, by backward differences of order 2 (order 1 in the first step), so that no step is too long for the circuit.
 * Source: Verboncoeur, Alves, Vahedi and Birdsall 1993 (J. Comput. Phys. 104, 321), sections 3 and 4. Cost: a sum over the particles.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "circuit/circuit.h"
#include "base/in-order.h"
#include "expression/expression.h"
#include "law/law.h"
#include "load/density-profile.h"
#include "push/electrode-charge.h"
#include "stream/declare.h"

static const char charge[] = "circuit_charge", charge_before[] = "circuit_charge_before", current[] = "circuit_current",
	current_before[] = "circuit_current_before", last_step[] = "circuit_step", last_dt[] = "circuit_dt";

static bool charged(const struct pm_frame *f, const struct pm_set *set)
{
	return pm_frame_field(f, set->name, "charge") && pm_frame_field(f, set->name, "x");
}

int pm_circuit_declare(const struct pm_circuit *c, struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	char name[PM_ELECTRODE_NAME];
	pm_electrode_name(0, c->side, name);
	if (!law)
		return -PM_DATA;
	if (f->dim != 1 || strcmp(law->name, "electrostatic") != 0)
		return pm_fail(PM_DATA, "a circuit belongs to a plasma in 1-D with the law electrostatic, and this frame has %d dimensions and the law '%s'",
			f->dim, f->law);
	if (!pm_electrode(f, 0, c->side))
		return pm_fail(PM_DATA, "the face x-%s is no electrode (smod --constant %s=0)", c->side ? "high" : "low", name);
	if (f->face[0][c->side] != PM_NEUMANN || f->face[0][!c->side] != PM_WALL)
		return pm_fail(PM_DATA, "an electrode whose charge is known is a face neumann, opposite a wall (smod --faces %s, and --x-%s '%s/eps0' "
			"in the solver)", c->side ? "wall,neumann" : "neumann,wall", c->side ? "high" : "low", name);
	if (!f->substep || pm_frame_constant(f, last_step, -1) == (double)f->step)
		return 0;
	for (size_t i = 0; i < f->nsets; i++)
		if (charged(f, f->sets[i]) && (!pm_reads(f, f->sets[i]->name, "x") || !pm_reads(f, f->sets[i]->name, "charge")))
			return -PM_DATA;
	return 1;
}

struct moment {
	const double *x, *q; /* q NULL: 1 */
	double from;
};

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct moment *m = data;
	for (size_t p = from; p < to; p++)
		pm_sum_add(part, (m->q ? m->q[p] : 1) * fabs(m->x[p] - m->from));
}

/* sum q_k d_k, with the background. */
static double moment_of(const struct pm_frame *f, int side)
{
	const struct pm_parts parts = {.size = sizeof(struct pm_sum), .make = make, .join = pm_join_sums};
	const double D = f->hi[0] - f->lo[0];
	double total = 0.5 * pm_frame_constant(f, "background", 0) * D * D;
	for (size_t i = 0; i < f->nsets; i++)
		if (charged(f, f->sets[i])) {
			const struct pm_field *x = pm_frame_field(f, f->sets[i]->name, "x"), *q = pm_frame_field(f, f->sets[i]->name, "charge");
			const struct moment m = {.x = pm_in(x, 0), .q = q->uniform ? NULL : pm_in(q, 0), .from = side ? f->lo[0] : f->hi[0]};
			struct pm_sum sum = {0, 0};
			pm_over_set(&parts, &m, x->count, &sum);
			total += (q->uniform ? q->value[0] : 1) * pm_sum_total(sum);
		}
	return total;
}

static int value_of(const struct pm_frame *f, const char *text, double time, double *value)
{
	static const char *const variable[] = {"time", NULL};
	struct pm_density_names names = {.f = f, .variable = variable, .n = 1};
	struct pm_expression e;
	if (pm_expression_compile_numbers(&e, pm_density_name, &names, "number", text))
		return -PM_USAGE;
	names.number[0] = time;
	*value = pm_expression_number(&e, names.number);
	return isfinite(*value) ? 0 : pm_fail(PM_NUMERICS, "'%s' is %g at time %g", text, *value, time);
}

int pm_circuit_step(const struct pm_circuit *c, struct pm_frame *f, struct pm_circuit_state *s)
{
	const double dt = f->dt, D = f->hi[0] - f->lo[0], eps0 = pm_frame_constant(f, "eps0", 1), M = moment_of(f, c->side);
	const double q = pm_frame_constant(f, charge, 0), I = pm_frame_constant(f, current, 0);
	const bool second = pm_frame_constant(f, last_dt, 0) == dt;
	const double before = second ? q - pm_frame_constant(f, charge_before, 0) : 0, I_before = pm_frame_constant(f, current_before, 0);
	char name[PM_ELECTRODE_NAME];
	double V, moved;
	pm_electrode_name(0, c->side, name);
	const double sigma = pm_frame_constant(f, name, 0), a = second ? 1.5 / dt : 1 / dt, end = f->start + dt;
	if (value_of(f, c->current ? c->current : c->voltage, c->current ? end - 0.5 * dt : end, &V))
		return -PM_USAGE;
	if (c->current)
		moved = V * dt;
	else { /* I' = a moved - old, L dI'/dt = L (a I' - rest) */
		const double old = second ? 0.5 * before / dt : 0, rest = second ? (4 * I - I_before) / (2 * dt) : I / dt;
		const double Z = c->inductance * a + c->resistance, k = 1 / c->capacitance;
		moved = (V - (M + D * sigma) / eps0 - q * k + c->inductance * rest + Z * old) / (Z * a + k + D / eps0);
	}
	*s = (struct pm_circuit_state){.charge = q + moved, .current = c->current ? V : second ? 1.5 * moved / dt - 0.5 * before / dt : moved / dt};
	pm_electrode_add(f, 0, c->side, moved);
	s->potential = (M + D * (sigma + moved)) / eps0;
	pm_frame_constant_set(f, charge_before, q);
	pm_frame_constant_set(f, current_before, I);
	pm_frame_constant_set(f, charge, s->charge);
	pm_frame_constant_set(f, current, s->current);
	pm_frame_constant_set(f, last_step, (double)f->step);
	pm_frame_constant_set(f, last_dt, dt);
	return 0;
}
