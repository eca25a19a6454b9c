/* Rates of tunnel ionisation: numbers computed apart, hydrogen, the field where the barrier goes. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "check.h"
#include "ionisation/tunnel-rate.h"

/* Nuter et al. 2011, eq. 1 with m = 0, in Python with math.gamma, from energies and shells written down there. */
static const struct { const char *symbol; int charge; double field, rate; } row[] = {
	{"H", 0, 0.06, 0.00100566994157},
	{"He", 0, 0.2, 0.005545041901111},
	{"N", 4, 0.7, 0.003483565209356},
	{"Ar", 0, 0.08, 0.004213915494715},
	{"Ar", 7, 1, 0.00598223173651},
	{"Kr", 8, 1, 2.067964298931e-12},
	{"Xe", 0, 0.05, 0.003536969025316},
};

static void numbers(void)
{
	for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
		const struct pm_tunnel t = pm_tunnel_of(pm_element_find(row[i].symbol), row[i].charge);
		check_near(pm_tunnel_rate(&t, row[i].field, false), row[i].rate, 1e-11 * row[i].rate, "rate of the formula, with gamma functions");
	}
	/* the nucleus moves: I is smaller than 1/2 by 5.3e-4, so 2/(3 E) (2 I)^1.5 by 0.9 % of one */
	const struct pm_tunnel h = pm_tunnel_of(pm_element_find("H"), 0);
	check_near(pm_tunnel_rate(&h, 0.06, false) / (4 / 0.06 * exp(-2 / (3 * 0.06))), 1, 0.012, "hydrogen: 4/E exp(-2/(3 E))");
	check_near(h.critical, 0.084, 0.0005, "Bauer and Mulser's critical field of hydrogen");
}

/* Every ion of the table: energies ascend, one critical field above that of the classical barrier, where both rates meet and beyond which they ascend. */
static void all(void)
{
	int wrong = 0, ions = 0, order = 0;
	for (size_t k = 0; pm_element_at(k); k++) {
		const struct pm_element *e = pm_element_at(k);
		for (int z = 0; z < e->z; z++, ions++) {
			const struct pm_tunnel t = pm_tunnel_of(e, z);
			const double classical = t.energy * t.energy / (4 * (z + 1)), at = t.critical;
			const double below = pm_tunnel_rate(&t, at * (1 - 1e-9), true), above = pm_tunnel_rate(&t, at * (1 + 1e-9), true);
			wrong += !(at > classical && at < 1.6 * classical) || fabs(above / below - 1) > 1e-6;
			wrong += !(pm_tunnel_rate(&t, 30 * at, true) > pm_tunnel_rate(&t, 10 * at, true)); /* tunnelling alone falls there */
			order += z > 0 && !(e->energy[z] > e->energy[z - 1]);
		}
	}
	check(ions == 261 && !wrong && !order, "261 ions: energies ascend (%d do not), both rates meet at the critical field, 1 to 1.6 of the classical one "
		"(%d do not)", order, wrong);
}

static void ends(void)
{
	const struct pm_tunnel t = pm_tunnel_of(pm_element_find("Ar"), 17);
	check(pm_tunnel_rate(&t, 0, true) == 0 && pm_tunnel_rate(&t, 1e-300, true) == 0 && isfinite(pm_tunnel_rate(&t, 1e150, true)),
		"no field, hardly a field, a huge one: 0, 0, a number");
	check(!pm_element_find("Unobtainium") && pm_element_l(1) == 0 && pm_element_l(18) == 1 && pm_element_l(28) == 2 && pm_element_l(54) == 1,
		"shells of 1, 18, 28 and 54 electrons: 1s, 3p, 3d, 5p");
}

int main(void)
{
	numbers();
	all();
	ends();
	return check_done();
}
