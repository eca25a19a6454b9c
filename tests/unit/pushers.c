/* Relativistic kicks: one step to the digits of PIC-14, second order over a longer time, a steady drift at E x B/B^2; the drift of an orbit in a field that
 * varies across it (PIC-13). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "step/step.h"

enum { BORIS, VAY, CARY, SCHEMES };
static const char *const names[SCHEMES] = {"relativistic", "vay", "higuera-cary"};

struct particle {
	double v[3], acc[3], b[3], charge, mass;
};

static void advance(const struct pm_step *s, struct particle *p, bool closing, double dt)
{
	const struct pm_magnetic m = {.v = {&p->v[0], &p->v[1], &p->v[2]}, .acc = {&p->acc[0], &p->acc[1], &p->acc[2]},
		.b = {&p->b[0], &p->b[1], &p->b[2]}, .charge = &p->charge, .mass = &p->mass, .c = 1};
	s->magnetic(closing, dt, 0, 1, &m);
}

static struct particle start(void)
{
	const double gamma = sqrt(15);
	return (struct particle){.v = {1 / gamma, 2 / gamma, 3 / gamma}, .acc = {0.1, -0.2, 0.3}, .b = {0.4, 0.5, -0.6}, .charge = 1, .mass = 1};
}

static void proper(const struct particle *p, double u[3])
{
	const double gamma = 1 / sqrt(1 - p->v[0] * p->v[0] - p->v[1] * p->v[1] - p->v[2] * p->v[2]);
	for (int c = 0; c < 3; c++)
		u[c] = gamma * p->v[c];
}

static double distance(const double a[3], const double b[3])
{
	return fmax(fabs(a[0] - b[0]), fmax(fabs(a[1] - b[1]), fabs(a[2] - b[2])));
}

static void test_step(void)
{
	static const double want[SCHEMES][3] = {{0.940084773532164, 2.02603150532298, 3.02174943679059},
		{0.940083675646562, 2.02603335377143, 3.02175024524057},
		{0.940080649804482, 2.02603417440079, 3.02174891187031}};
	static const double exact[3] = {-3.93257649365, 0.281461698259, 2.27950041945};
	for (int k = 0; k < SCHEMES; k++) {
		const struct pm_step *s = pm_step_find(names[k]);
		struct particle p = start();
		double u[3], error[3];
		advance(s, &p, true, 0.1);
		advance(s, &p, false, 0.1);
		proper(&p, u);
		/* the reference has 15 digits; v keeps u to gamma^2 = 15 roundings */
		check(distance(u, want[k]) < 2.5e-14, "PIC-14: one step of %s (off by %.2g)", names[k], distance(u, want[k]));
		for (int r = 0; r < 3; r++) {
			const int n = 100 << r;
			p = start();
			for (int i = 0; i < n; i++) {
				advance(s, &p, true, 10. / n);
				advance(s, &p, false, 10. / n);
			}
			proper(&p, u);
			error[r] = distance(u, exact);
		}
		const double order = log2(error[0] / error[2]) / 2;
		check(error[0] < 0.05 && order > 1.95 && order < 2.05, "%s to t = 10 is of second order (%.3f; error %.2g with dt 0.1)", names[k],
			order, error[0]);
	}
}

/* E x B at 0.995 c: a force-free particle stays one with vay and higuera-cary, not with boris. */
static void test_drift(void)
{
	for (int k = 0; k < SCHEMES; k++) {
		struct particle p = {.v = {0.995, 0, 0}, .acc = {0, 0.995, 0}, .b = {0, 0, 1}, .charge = 1, .mass = 1};
		for (int i = 0; i < 200; i++) {
			advance(pm_step_find(names[k]), &p, true, 0.5);
			advance(pm_step_find(names[k]), &p, false, 0.5);
		}
		const double off = fmax(fabs(p.v[1]), fabs(p.v[0] - 0.995));
		if (k == BORIS)
			check(off > 1e-4, "boris leaves the drift at E x B/B^2 of gamma 10 (by %.2g)", off);
		else
			check(off < 1e-12, "%s keeps the drift at E x B/B^2 of gamma 10 (off by %.2g)", names[k], off);
	}
}

/* PIC-13: B = 1 + eps x along z, q = m = 1, from (0, 0) with v = (1, 0): the time at which vx is 1 again with vy rising through 0, and the drift along y. */
static void test_gradient(void)
{
	static const double want[2][3] = {{0.05, 0.0250706959084228, 6.29503115316}, {0.1, 0.0505750212146482, 6.33136927263}};
	for (int run = 0; run < 4; run++) {
		const int k = run / 2, tangent = run % 2;
		const struct pm_step *s = pm_step_find(tangent ? "boris-tan" : "boris");
		struct particle p = {.v = {1, 0, 0}, .charge = 1, .mass = 1};
		double x[2] = {0, 0}, first = 0, last = 0, y_first = 0, y_last = 0, dt = 0.05;
		int turns = -1;
		p.b[2] = 1;
		for (int i = 0; turns < 40; i++) {
			const double before = p.v[1], y = x[1];
			advance(s, &p, false, dt);
			x[0] += dt * p.v[0];
			x[1] += dt * p.v[1];
			p.b[2] = 1 + want[k][0] * x[0];
			advance(s, &p, true, dt);
			if (!(before > 0 && p.v[1] <= 0)) /* clockwise: vy falls through 0 once a turn where vx is 1 */
				continue;
			const double part = before / (before - p.v[1]);
			last = dt * (i + part), y_last = y + part * (x[1] - y);
			if (turns++ < 0)
				first = last, y_first = y_last;
		}
		const double period = (last - first) / turns, drift = fabs(y_last - y_first) / (last - first);
		/* boris turns too little by (Omega dt)^2/12 = 2e-4; the drift of boris-tan is that of its radius, too large by (Omega dt)^2/12 */
		check(fabs(drift / want[k][1] - 1) < (tangent ? 3e-4 : 1e-4) && fabs(period / want[k][2] - 1) < (tangent ? 1e-4 : 3e-4),
			"PIC-13, %s: eps %g: drift %.8f (%.8f), period %.8f (%.8f)", s->name, want[k][0], drift, want[k][1], period, want[k][2]);
	}
}

/* From rest by forces up to 1e15 along one axis: the rounded speed is at most c. Roots and quotients are rounded so that it is (sqrt(u u) is u, and u (1/u) is
 * not above 1); an inverse root of 1.5 round-offs is not enough. */
static void test_light(void)
{
	for (int closing = 0; closing < 2; closing++) {
		int above = 0;
		for (int i = 0; i < 3000; i++) {
			struct particle p = {.acc = {[0] = 0}, .b = {0}, .charge = 1, .mass = 1};
			p.acc[i % 3] = pow(10, 6 + 9. * i / 3000);
			advance(pm_step_find("relativistic"), &p, closing, 2);
			above += p.v[i % 3] > 1;
		}
		check(above == 0, "relativistic/2, %s half: no force brings a speed above c (%d of 3000 did)", closing ? "closing" : "opening", above);
		for (int k = 0; k < SCHEMES; k++) {
			struct particle p = {.acc = {1e200}, .b = {0}, .charge = 1, .mass = 1};
			advance(pm_step_find(names[k]), &p, closing, 2);
			check(isnan(p.v[0]), "%s/2, %s half: where u^2 overflows v is NaN, which push refuses", names[k], closing ? "closing" : "opening");
		}
	}
}

/* Particles side by side, of one charge and mass or of many, are kicked as each alone. */
static void test_lanes(void)
{
	enum { many = 150 };
	for (int k = 0; k < SCHEMES; k++)
		for (int run = 0; run < 4; run++) {
			const struct pm_step *s = pm_step_find(names[k]);
			const bool alike = run % 2, closing = run / 2;
			double of[11][many];
			int differ = 0;
			for (int i = 0; i < many; i++)
				for (int c = 0; c < 11; c++)
					of[c][i] = c < 9 ? 0.5 * sin(2.385 * i + c) : alike ? 5.5 - c / 2. : 1 + (i + c) % 7;
			struct particle alone[many];
			for (int i = 0; i < many; i++) {
				alone[i] = (struct particle){.v = {of[0][i], of[1][i], of[2][i]}, .acc = {of[3][i], of[4][i], of[5][i]},
					.b = {of[6][i], of[7][i], of[8][i]}, .charge = of[9][i], .mass = of[10][i]};
				advance(s, &alone[i], closing, 0.731);
			}
			const struct pm_magnetic m = {.v = {of[0], of[1], of[2]}, .acc = {of[3], of[4], of[5]}, .b = {of[6], of[7], of[8]}, .charge = of[9],
				.mass = of[10], .alike = alike, .c = 1};
			s->magnetic(closing, 0.731, 0, many, &m);
			for (int i = 0; i < many; i++)
				for (int c = 0; c < 3; c++)
					differ += of[c][i] != alone[i].v[c];
			check(!differ, "%s: %d velocities of %d differ from those of a particle alone", names[k], differ, 3 * many);
		}
}

int main(void)
{
	test_light();
	test_lanes();
	test_step();
	test_drift();
	test_gradient();
	return check_done();
}
