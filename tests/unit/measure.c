/* What diag measures, against sums done by hand, exact fields, and itself with other numbers of threads. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "measure/measure.h"
#include "check.h"
#include "stream/declare.h"

static double plummer(double r2, double softening, int dim)
{
	(void)dim;
	return -1 / (4 * pm_pi * sqrt(r2 + softening * softening));
}

static void sums(void)
{
	const size_t n = 10000000;
	double *m = pm_alloc(n, sizeof *m), hard[] = {1, 1e100, 1, -1e100}, one[] = {1, 1, 1, 1};
	for (size_t i = 0; i < n; i++)
		m[i] = 0.1;
	struct pm_measured b = {.n = n, .dim = 1, .vdim = 1, .x = {m}, .v = {m}, .mass = m};
	struct pm_particle_sums bulk = {0};
	pm_particle_sums_add(&b, &bulk);
	check_near(bulk.mass, 1000000, 0, "HC-58: the mass of ten million particles of 0.1 is 1000000 to the last bit");
	bulk = (struct pm_particle_sums){0};
	b = (struct pm_measured){.n = 4, .dim = 1, .vdim = 1, .x = {one}, .v = {hard}, .mass = one, .strength = hard, .phi = one};
	pm_particle_sums_add(&b, &bulk);
	check_near(bulk.momentum[0], 2, 0, "HC-58: the momentum of 1, 1e100, 1, -1e100 is 2");
	check_near(pm_energy_at_particles(&b), 1, 0, "HC-58: the energy at the particles is compensated too");
	pm_free(m);
}

/* Eight values of a lane are added without a carry: three roundings more of each than its product has. For n values at random these come to
 * 1e-16 sqrt(4 n) of a value, over the sum of n sizes 1e-18. A long sum without its carry is rounded at every value: 1e-16 sqrt(n) of the sum itself. */
static void round_off(void)
{
	enum { n = 100003 };
	static double x[n], v[n], m[n];
	long double mass = 0, momentum = 0, kinetic = 0;
	for (size_t i = 0; i < n; i++) {
		double u[2], w[2];
		pm_random(6, i, 0, u), pm_random(6, i, 1, w);
		x[i] = u[0], v[i] = u[1] - 0.5, m[i] = 1 + w[0];
		const long double p = (long double)m[i] * (long double)v[i];
		mass += (long double)m[i], momentum += p, kinetic += 0.5L * p * (long double)v[i];
	}
	const struct pm_measured b = {.n = n, .dim = 1, .vdim = 1, .x = {x}, .v = {v}, .mass = m};
	struct pm_particle_sums bulk = {0};
	pm_particle_sums_add(&b, &bulk);
	check_near((double)((bulk.momentum[0] - momentum) / bulk.scale), 0, 5e-18, "the momentum of a hundred thousand particles at random, over sum m|v|");
	check_near((double)(bulk.kinetic / kinetic - 1), 0, 1.2e-16, "their kinetic energy to its last bit");
	check_near((double)(bulk.mass / mass - 1), 0, 1.2e-16, "their mass to its last bit");
}

static void by_hand(void)
{
	const double x[3][2] = {{1, 2}, {-1, 3}, {0.5, 0}}, v[3][2] = {{0, 2}, {1, 0}, {4, -1}}, m[2] = {2, 3}, q[2] = {2, -3};
	const struct pm_measured b = {.n = 2, .dim = 3, .vdim = 3, .x = {x[0], x[1], x[2]}, .v = {v[0], v[1], v[2]}, .mass = m, .strength = q};
	struct pm_particle_sums bulk = {0};
	pm_particle_sums_add(&b, &bulk);
	check(bulk.n == 2 && bulk.mass == 5 && bulk.kinetic == 24.5, "mass and kinetic energy of two bodies");
	check(bulk.momentum[0] == 6 && bulk.momentum[1] == 2 && bulk.momentum[2] == 5, "their momentum");
	/* 2 (-4.5, -4, 1) + 3 (-3, 2, -6) */
	check(bulk.angular[0] == -18 && bulk.angular[1] == -2 && bulk.angular[2] == -16, "their angular momentum");
	check(bulk.moment[0] == 8 && bulk.farthest == sqrt(13), "their first moment and the largest distance");
	check_near(bulk.scale, 2 * sqrt(17) + 3 * sqrt(5), 1e-14, "the scale of their momentum");
	check_near(pm_energy_of_pairs(&b, &b, 4 * pm_pi, 0.5, plummer), 6 / sqrt(17.25 + 0.25), 1e-15, "their pair energy with softening");
	const struct pm_measured still = {.n = 2, .dim = 3, .x = {x[0], x[1], x[2]}};
	bulk = (struct pm_particle_sums){0};
	pm_particle_sums_add(&still, &bulk);
	check(isnan(bulk.mass) && bulk.movers == 0, "without masses the mass is not a number");
}

/* Two sets in one sum, one set in halves: the pair energy is the same. */
/* Whole numbers, whose sums are exact: numbers of particles that are not multiples of eight, every number of dimensions. */
static void any_number(void)
{
	static const size_t sizes[] = {1, 2, 7, 8, 9, 15, 16, 17, 4096, 4099};
	static double x[3][4099], v[3][4099], m[4099];
	int bad = 0;
	for (size_t p = 0; p < 4099; p++)
		for (int d = 0; d < 3; d++)
			x[d][p] = (double)(p * 7 % 13) - d, v[d][p] = (double)(p * 5 % 11) - 5 + d, m[p] = (double)(p % 3) + 1;
	for (int k = 0; k < 10 * 4; k++) {
		struct pm_measured b = {.n = sizes[k / 4], .dim = k % 4 < 3 ? k % 4 + 1 : 2, .vdim = k % 4 < 3 ? k % 4 + 1 : 3,
			.x = {x[0], x[1], x[2]}, .v = {v[0], v[1], v[2]}, .mass = m};
		struct pm_particle_sums got = {0}, want = {0};
		pm_particle_sums_add(&b, &got);
		for (size_t p = 0; p < b.n; p++) {
			double v2 = 0, x2 = 0, y[3] = {0}, w[3] = {0};
			for (int d = 0; d < b.dim; d++)
				y[d] = x[d][p], x2 += y[d] * y[d], want.moment[d] += m[p] * y[d];
			for (int d = 0; d < b.vdim; d++)
				w[d] = v[d][p], v2 += w[d] * w[d], want.momentum[d] += m[p] * w[d];
			want.mass += m[p], want.kinetic += 0.5 * m[p] * v2, want.square += v2;
			want.angular[2] += m[p] * (y[0] * w[1] - y[1] * w[0]);
			check_worst(&want.farthest, sqrt(x2));
		}
		bad += got.mass != want.mass || got.kinetic != want.kinetic || got.square != want.square || got.angular[2] != want.angular[2] ||
			got.farthest != want.farthest || memcmp(got.momentum, want.momentum, sizeof want.momentum) ||
			memcmp(got.moment, want.moment, sizeof want.moment);
	}
	check(bad == 0, "bulk sums of 1 to 4099 particles of whole numbers in 1 to 3 dimensions are exact (%d of 40 are not)", bad);
}

/* The same along a row of the mesh: 1/2 sum of weight rho phi, end nodes with half weight unless the axis is periodic. */
static void any_row(void)
{
	double rho[40], phi[40];
	int bad = 0;
	for (int i = 0; i < 40; i++)
		rho[i] = i % 5 - 1, phi[i] = i % 7 + 1;
	for (size_t n = 1; n < 39; n++)
		for (int wall = 0; wall < 2; wall++) {
			enum pm_face face = wall ? PM_WALL : PM_PERIODIC;
			struct pm_grid g = {.dim = 1, .cells = {n, 1, 1}, .points = {n + (size_t)wall, 1, 1}, .h = {2, 1, 1}, .face = {{face, face}}};
			double want = 0;
			for (size_t i = 0; i < g.points[0]; i++)
				want += rho[i] * phi[i] * (wall && (i == 0 || i + 1 == g.points[0]) ? 0.5 : 1);
			bad += pm_energy_on_mesh(&g, rho, phi) != want;
		}
	check(bad == 0, "the energy of the field along rows of 1 to 39 points is exact for whole numbers (%d of 76 are not)", bad);
}

static void pairs(void)
{
	enum { n = 1201 };
	static double x[3][n], q[n];
	for (int i = 0; i < n; i++) {
		double u[2];
		for (int d = 0; d < 3; d++) {
			pm_random(5, (uint64_t)i, (uint64_t)d, u);
			x[d][i] = u[0];
		}
		q[i] = u[1] - 0.3;
	}
	const int cut = 517;
	struct pm_measured all = {.n = n, .dim = 3, .x = {x[0], x[1], x[2]}, .strength = q}, a = all, b = all;
	a.n = cut, b.n = n - cut, b.strength += cut;
	for (int d = 0; d < 3; d++)
		b.x[d] += cut;
	const double whole = pm_energy_of_pairs(&all, &all, 1, 0.1, plummer);
	const double parts = pm_energy_of_pairs(&a, &a, 1, 0.1, plummer) + pm_energy_of_pairs(&b, &b, 1, 0.1, plummer) + pm_energy_of_pairs(&a, &b, 1, 0.1,
		plummer);
	check_near(parts, whole, 1e-13 * fabs(whole), "the pair energy of two sets is that of their union");
	double again[2];
	for (int t = 0; t < 2; t++) {
		pm_threads_use(t ? 3 : 1);
		again[t] = pm_energy_of_pairs(&all, &all, 1, 0.1, plummer);
	}
	check(again[0] == whole && again[1] == whole, "HC-58: with 1, 2 and 3 threads the same bytes");
}

static void bulk_threads(void)
{
	const size_t n = 300007;
	double *a[7];
	for (int k = 0; k < 7; k++) {
		a[k] = pm_alloc(n, sizeof **a);
		for (size_t i = 0; i < n; i++)
			a[k][i] = sin((double)i * (k + 1)) * exp(20 * cos(0.3 * (double)i));
	}
	const struct pm_measured b = {.n = n, .dim = 3, .vdim = 3, .x = {a[0], a[1], a[2]}, .v = {a[3], a[4], a[5]}, .mass = a[6]};
	struct pm_particle_sums bulk[3] = {0};
	for (int t = 0; t < 3; t++) {
		pm_threads_use(t + 1);
		pm_particle_sums_add(&b, &bulk[t]);
	}
	check(!memcmp(bulk, bulk + 1, sizeof *bulk) && !memcmp(bulk, bulk + 2, sizeof *bulk),
		"HC-58: all bulk quantities have the same bytes with 1, 2 and 3 threads");
	for (int k = 0; k < 7; k++)
		pm_free(a[k]);
}

/* rho = cos kx, phi = -cos kx: the integral is -L/4 (periodic: exact sum; walls: the ends have half weight, exact too). */
static void on_mesh(void)
{
	for (int periodic = 0; periodic < 2; periodic++) {
		struct pm_frame *f = pm_frame_new(2);
		const size_t cells[3] = {12, 7, 1};
		for (int d = 0; d < 2; d++) {
			f->hi[d] = d ? 3 : 2.385;
			for (int s = 0; s < 2; s++)
				f->face[d][s] = periodic ? PM_PERIODIC : PM_NEUMANN;
		}
		const struct pm_grid g = pm_grid_of(f, pm_frame_mesh_new(f, "mesh", cells));
		double rho[13 * 8], phi[13 * 8];
		for (size_t p = 0; p < pm_grid_size(&g); p++) {
			rho[p] = cos(2 * pm_pi * (double)(p % g.points[0]) / 12);
			phi[p] = -rho[p];
		}
		check_near(pm_energy_on_mesh(&g, rho, phi), -0.25 * 2.385 * 3, 1e-14,
			periodic ? "the energy of a wave on a periodic mesh" : "the same between faces, whose points count half");
		pm_frame_free(f);
	}
}

static void radii(void)
{
	enum { n = 1000 };
	struct pm_shell shell[n];
	const double fraction[] = {0.1, 0.5, 1, 1e-9};
	double r[4];
	for (size_t i = 0; i < n; i++)
		shell[i] = (struct pm_shell){(double)((i * 617) % n + 1), 0.001, i};
	pm_radii(n, shell, 4, fraction, r);
	check(r[0] == 100 && r[1] == 500 && r[2] == 1000 && r[3] == 1, "Lagrangian radii of a thousand equal shells");
	pm_radii(0, shell, 1, fraction, r);
	check(isnan(r[0]), "no shells have no radius");
}

int main(void)
{
	sums();
	round_off();
	by_hand();
	any_number();
	any_row();
	pairs();
	bulk_threads();
	on_mesh();
	radii();
	return check_done();
}
