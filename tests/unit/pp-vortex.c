/* Biot-Savart sums of vortices in space: the fast loop against the plain one for every core and form, the stretching against differences of the velocity,
 * the slopes of the cores, the total, any number of threads. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "far/pp-vortex.h"

enum { MOST = 1100 };

struct vortices {
	size_t n;
	double x[3][MOST], alpha[3][MOST];
};
struct sums {
	double u[3][MOST], rate[3][MOST], psi[3][MOST];
	uint64_t coincident;
};

static double next(uint64_t *state) { return (double)(*state = 16807 * *state % 2147483647) / 2147483647.0; }

static struct vortices fixture(size_t n)
{
	struct vortices v = {.n = n};
	uint64_t state = 7;
	for (size_t i = 0; i < n; i++)
		for (int d = 0; d < 3; d++)
			v.x[d][i] = next(&state), v.alpha[d][i] = next(&state) - 0.4;
	return v;
}

static struct sums sum(const struct pm_pp_vortex *p, const struct vortices *v, size_t targets, bool plain, bool psi)
{
	static struct sums s;
	memset(&s, 0, sizeof s);
	const double *x[3] = {v->x[0], v->x[1], v->x[2]}, *a[3] = {v->alpha[0], v->alpha[1], v->alpha[2]};
	struct pm_pp_vortex_sums to = {.coincident = 0};
	for (int d = 0; d < 3; d++)
		to.velocity[d] = s.u[d], to.stretching[d] = s.rate[d], to.psi[d] = psi ? s.psi[d] : NULL;
	(plain ? pm_pp_vortex_plain : pm_pp_vortex_sum)(p, targets, v->n, x, a, &to);
	s.coincident = to.coincident;
	return s;
}

static double difference(size_t n, double a[3][MOST], double b[3][MOST])
{
	double most = 0, scale = 0;
	for (size_t i = 0; i < n; i++)
		for (int d = 0; d < 3; d++)
			check_worst(&most, fabs(a[d][i] - b[d][i])), check_worst(&scale, fabs(b[d][i]));
	return scale > 0 ? most / scale : most;
}

static void loops(const struct pm_mollifier *m, enum pm_pp_form form)
{
	const size_t sizes[] = {1, 7, 33, 257, check_sanitized() ? 530 : MOST - 3}; /* blocks of 512 sources */
	double worst = 0;
	for (int k = 0; k < 5; k++)
		for (int many = 0; many < 4; many++) {
			struct vortices v = fixture(sizes[k]);
			const size_t targets = many & 1 ? (v.n + 1) / 2 : v.n;
			struct pm_pp_vortex p = {.delta = m->bare ? 0 : 0.0785, .mollifier = m, .form = form};
			struct sums fast = sum(&p, &v, targets, false, many & 2), plain = sum(&p, &v, targets, true, many & 2);
			check_worst(&worst, difference(targets, fast.u, plain.u));
			check_worst(&worst, difference(targets, fast.rate, plain.rate));
			check_worst(&worst, difference(targets, fast.psi, plain.psi));
		}
	char text[128];
	snprintf(text, sizeof text, "%s, %s: the fast loop equals the plain one", m->name, pm_pp_form_names[form]);
	check_near(worst, 0, 1e-13, text); /* sums of 1100 terms of either sign, each good to 2e-15 */
}

/* The Gaussian's polynomials, below and above s^2 = 1/2, and beyond its reach: one pair each. */
static void accuracy(const struct pm_mollifier *m)
{
	double worst = 0;
	for (double s = 1e-9; s < 9; s = s < 0.01 ? 10 * s : s + 0.00713) {
		struct vortices v = {.n = 2, .x = {{0, 0.6 * s}, {0, 0.8 * s}, {0, 0}}, .alpha = {{0.3, 0.4}, {-0.2, 0.5}, {0.7, -0.3}}};
		struct pm_pp_vortex p = {.delta = 1, .mollifier = m, .form = PM_PP_CLASSICAL};
		struct sums fast = sum(&p, &v, 2, false, true), plain = sum(&p, &v, 2, true, true);
		check_worst(&worst, difference(2, fast.u, plain.u));
		check_worst(&worst, difference(2, fast.rate, plain.rate));
		check_worst(&worst, difference(2, fast.psi, plain.psi));
	}
	char text[128];
	snprintf(text, sizeof text, "%s: a pair at any distance", m->name);
	check_near(worst, 0, 2e-14, text); /* the plain slope divides a difference by s^2 = 1 where it is a fifth of its terms */
}

/* d f/d(r^2) of the table by differences of fourth order. */
static void slopes(const struct pm_mollifier *m)
{
	static const double at[] = {0.0123, 0.3, 0.77, 0.99, 1.01, 1.5, 3.3, 6.4, 8};
	double worst = 0, delta = 0.85;
	for (int i = 0; i < 9; i++) {
		const double r2 = at[i] * at[i] * delta * delta, h = 1e-3 * r2;
		const double slope = 2 * ((m->force(r2 - 2 * h, delta, 3) - m->force(r2 + 2 * h, delta, 3)) + 8 * (m->force(r2 + h, delta, 3) -
			m->force(r2 - h, delta, 3))) / (12 * h);
		const double size = fmax(fabs(m->slope(r2, delta)), m->force(r2, delta, 3) / r2); /* differences of a force of this size */
		check_worst(&worst, fabs(slope - m->slope(r2, delta)) / size);
	}
	char text[128];
	snprintf(text, sizeof text, "%s: the slope is the derivative of the force", m->name);
	check_near(worst, 0, 1e-9, text); /* h^4 f'''''/30 of r^-3: 1e-11; round-off 1e-13/h */
}

/* (alpha . grad) u and sum_d alpha_d grad u_d of a test vortex by differences of the velocity of the others. */
static void gradients(void)
{
	struct vortices v = fixture(40);
	const double h = 1e-3;
	for (int form = 0; form < 2; form++) {
		struct pm_pp_vortex p = {.delta = 0.4, .mollifier = pm_mollifier_find("gaussian"), .form = form ? PM_PP_CLASSICAL : PM_PP_TRANSPOSE};
		struct sums here = sum(&p, &v, 1, false, false);
		double gradient[3][3], worst = 0; /* [d][c] = du_c/dx_d */
		for (int d = 0; d < 3; d++) {
			double u[4][3];
			const double steps[] = {-2, -1, 1, 2};
			for (int k = 0; k < 4; k++) {
				struct vortices w = v;
				w.x[d][0] += steps[k] * h;
				struct sums there = sum(&p, &w, 1, false, false);
				for (int c = 0; c < 3; c++)
					u[k][c] = there.u[c][0];
			}
			for (int c = 0; c < 3; c++)
				gradient[d][c] = (u[0][c] - u[3][c] + 8 * (u[2][c] - u[1][c])) / (12 * h);
		}
		for (int c = 0; c < 3; c++) {
			double want = 0;
			for (int d = 0; d < 3; d++)
				want += v.alpha[d][0] * (form ? gradient[d][c] : gradient[c][d]);
			check_worst(&worst, fabs(want - here.rate[c][0]) / 10);
		}
		check_near(worst, 0, 1e-10, form ? "classical is (alpha . grad) u" : "transpose is sum_d alpha_d grad u_d"); /* (h/delta)^4 = 4e-11 */
	}
}

static void totals_and_threads(void)
{
	struct vortices v = fixture(1037);
	struct pm_pp_vortex p = {.delta = 0.07, .mollifier = pm_mollifier_find("algebraic"), .form = PM_PP_TRANSPOSE};
	bool same = true;
	pm_threads_use(1);
	struct sums one = sum(&p, &v, v.n, false, true);
	for (int t = 2; t < 4; t++) {
		pm_threads_use(t);
		struct sums many = sum(&p, &v, v.n, false, true);
		same = same && !memcmp(&one, &many, sizeof one);
	}
	check(same, "equal bytes for 1, 2 and 3 threads");
	for (int form = 0; form < 2; form++) {
		p.form = form ? PM_PP_CLASSICAL : PM_PP_TRANSPOSE;
		struct sums s = sum(&p, &v, v.n, false, false);
		struct pm_sum total = {0}, scale = {0};
		for (size_t i = 0; i < v.n; i++)
			pm_sum_add(&total, s.rate[0][i]), pm_sum_add(&scale, fabs(s.rate[0][i]));
		const double drift = fabs(pm_sum_total(total) / pm_sum_total(scale));
		if (form)
			check(drift > 1e-6, "the classical form does not keep the total of vortices at random");
		else
			check_near(drift, 0, 1e-14, "the transpose keeps the total of alpha"); /* sums of 1000 pairs, each antisymmetric to round-off */
	}
}

static void coincident(void)
{
	struct vortices v = {.n = 3, .x = {{0.25, 0.25, 1}}, .alpha = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
	struct pm_pp_vortex p = {.mollifier = pm_mollifier_find("none")};
	struct sums s = sum(&p, &v, 3, false, true);
	check(s.coincident == 2 && isfinite(s.u[0][0]) && isfinite(s.rate[2][1]) && isfinite(s.psi[1][2]), "coincident points exert nothing and are counted");
	p = (struct pm_pp_vortex){.delta = 0.1, .mollifier = pm_mollifier_find("gaussian")};
	s = sum(&p, &v, 3, false, true);
	/* alpha_1 x alpha_2 f(0) of the core, along z: f(0) = 1/(3 pi^(3/2) delta^3); the third vortex is 7.5 delta away */
	check_near(s.rate[2][0] * 3 * pow(pm_pi, 1.5) * 1e-3, 1, 2e-3, "within a core two vortices still turn each other");
}

int main(void)
{
	for (int i = 0; pm_mollifiers[i]; i++)
		if (pm_mollifiers[i]->slope) {
			slopes(pm_mollifiers[i]);
			if (!pm_mollifiers[i]->bare)
				accuracy(pm_mollifiers[i]);
			for (int form = 0; pm_pp_form_names[form]; form++)
				loops(pm_mollifiers[i], (enum pm_pp_form)form);
		}
	gradients();
	totals_and_threads();
	coincident();
	return check_done();
}
