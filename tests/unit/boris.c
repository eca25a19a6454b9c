/* The magnetic kick: angle, length, the published step, 1e6 of them. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "step/step.h"

extern const struct pm_step step_boris;

static const double charge = -1, mass = 1;

/* Half a step of one particle. */
static void half(bool closing, double dt, double v[3], const double acc[3], const double b[3], int components)
{
	struct pm_magnetic m = {.charge = &charge, .mass = &mass};
	for (int c = 0; c < 3; c++) {
		m.v[c] = c < components ? &v[c] : NULL;
		m.acc[c] = acc ? &acc[c] : NULL;
		m.b[c] = &b[c];
	}
	step_boris.magnetic(closing, dt, 0, 1, &m);
}

static double length(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static void angles(void)
{
	const double omega_dt[] = {0.1, 0.5, 2}, want[] = {0.0999167914438855, 0.489957326253728, pm_pi / 2};
	for (int i = 0; i < 3; i++) {
		double v[3] = {2.385, 0, 0};
		const double b[3] = {0, 0, 1};
		half(true, omega_dt[i], v, NULL, b, 2), half(false, omega_dt[i], v, NULL, b, 2);
		check_near(atan2(v[1], v[0]), want[i], 1e-15, "PIC-12: two halves turn by 2 atan(Omega dt/2), counter-clockwise for q < 0");
		check_near(length(v), 2.385, 1e-15 * 2.385, "and keep |v|");
	}
}

/* E/2, rotation by t and s = 2 t/(1 + t^2), E/2 as printed. */
static void published(double dt, double v[3], const double acc[3], const double b[3])
{
	double t[3], w[3], u[3], t2 = 0;
	for (int c = 0; c < 3; c++) {
		t[c] = charge / mass * b[c] * dt / 2;
		t2 += t[c] * t[c];
		v[c] += acc[c] * dt / 2;
	}
	for (int c = 0; c < 3; c++)
		w[c] = v[c] + v[(c + 1) % 3] * t[(c + 2) % 3] - v[(c + 2) % 3] * t[(c + 1) % 3];
	for (int c = 0; c < 3; c++)
		u[c] = v[c] + 2 / (1 + t2) * (w[(c + 1) % 3] * t[(c + 2) % 3] - w[(c + 2) % 3] * t[(c + 1) % 3]);
	for (int c = 0; c < 3; c++)
		v[c] = u[c] + acc[c] * dt / 2;
}

static void is_the_published_step(void)
{
	double v[3] = {1, -2, 3}, u[3] = {1, -2, 3};
	const double acc[3] = {0.1, -0.2, 0.3}, b[3] = {0.4, 0.5, -0.6}, dt = 0.731;
	for (int i = 0; i < 5; i++) {
		half(true, dt, v, acc, b, 3), half(false, dt, v, acc, b, 3);
		published(dt, u, acc, b);
	}
	for (int c = 0; c < 3; c++)
		check_near(v[c], u[c], 1e-14, "closing and opening half about one time are the published step of Boris");
	const double none[3] = {0};
	double w[3] = {1, -2, 3};
	half(false, dt, w, acc, none, 3);
	check_near(w[1], -2 - 0.2 * dt / 2, 1e-15, "without a field it is a kick of half a step");
}

/* Three particles at once, whose fields make the three angles. */
static void keeps_the_speed(void)
{
	enum { many = 3 };
	static const double omega_dt[many] = {0.1, 2, 100}, charges[many] = {-1, -1, -1}, masses[many] = {1, 1, 1};
	const int steps = check_sanitized() ? 10000 : 1000000; /* of the same instructions: 1e6 of them took a sanitizer's run 100 s */
	for (int plane = 0; plane < 2; plane++) {
		const double direction[3] = {plane ? 0 : 0.36, plane ? 0 : -0.48, plane ? 1 : 0.8}, start[3] = {0.6, 0.3, plane ? 0 : 0.7};
		double v[3][many], b[3][many], worst[many] = {0};
		struct pm_magnetic m = {.charge = charges, .mass = masses};
		for (int c = 0; c < 3; c++) {
			for (int i = 0; i < many; i++)
				v[c][i] = start[c], b[c][i] = omega_dt[i] * direction[c];
			m.v[c] = c < 3 - plane ? v[c] : NULL;
			m.b[c] = b[c];
		}
		for (int n = 0; n < steps; n++) {
			step_boris.magnetic(true, 1, 0, many, &m);
			step_boris.magnetic(false, 1, 0, many, &m);
			for (int i = 0; i < many; i++)
				check_worst(&worst[i], fabs(length((const double[]){v[0][i], v[1][i], v[2][i]}) / length(start) - 1));
		}
		for (int i = 0; i < many; i++) {
			check_below(worst[i], 1e-11, "HC-08: %g steps of Omega dt = %g keep |v|, %d components", (double)steps, omega_dt[i], 3 - plane);
			check_below(worst[i], 1e-12, "PIC-12: and to 1e-12");
		}
	}
}

int main(void)
{
	angles();
	is_the_published_step();
	keeps_the_speed();
	return check_done();
}
