/* Ewald's sum with its long-range half by the transform solver: ions as Gaussians of variance 1/(4 alpha^2) on the mesh, lap phi = -4 pi rho, energy
 * 1/2 int rho phi, and the short-range half erfc(alpha r)/r by hand. Crystals, ions anywhere, and, with open faces, a layer and a chain, whose
 * Madelung constants are known in closed form: 4 eta(1/2) beta(1/2) and 2 ln 2.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "check.h"
#include "poisson-fft/poisson-fft.h"

extern const struct pm_green green_vico, green_hockney;

enum { MOST = 8, CELLS = 32 };

struct ions {
	int n;
	double x[MOST][3], q[MOST];
};

/* On periodic axes of length 1, or open ones of length 34/32 with the ions in the middle: sigma = 2 h has 8 sigma of room there. */
static struct pm_grid cell(const char *faces)
{
	struct pm_grid g = {.dim = 3};
	for (int d = 0; d < 3; d++) {
		bool open = faces[d] == 'o';
		g.cells[d] = CELLS + 2 * open, g.points[d] = g.cells[d] + open, g.h[d] = 1.0 / CELLS;
		g.face[d][0] = g.face[d][1] = open ? PM_OPEN : PM_PERIODIC;
	}
	return g;
}

/* exp(-(x-x_i)^2/2 sigma^2) and, with slope, times (x-x_i)/sigma^2, with the images of a periodic axis. */
static double bell(const struct pm_grid *g, int d, size_t i, double x, double sigma, bool slope)
{
	double sum = 0;
	for (int image = -1; image <= 1; image++) {
		double r = (double)i * g->h[d] - x - image;
		if (image == 0 || g->face[d][0] == PM_PERIODIC)
			sum += exp(-r * r / (2 * sigma * sigma)) * (slope ? r / (sigma * sigma) : 1);
	}
	return sum;
}

/* Energy, and the force on ion 0 if force is given. */
static double energy(const struct ions *ions, const char *faces, const struct pm_green *green, double force[3])
{
	struct pm_grid g = cell(faces);
	const size_t n = pm_grid_size(&g), *p = g.points;
	const double sigma = 2.0 / CELLS, alpha = 0.5 / sigma, factor = pow(2 * pm_pi * sigma * sigma, -1.5), volume = pm_grid_cell(&g);
	double *rho = calloc(n, sizeof *rho), *phi = calloc(n, sizeof *phi), sum = 0;
	for (size_t q = 0; q < n; q++)
		for (int i = 0; i < ions->n; i++)
			rho[q] += factor * ions->q[i] * bell(&g, 0, q % p[0], ions->x[i][0], sigma, false) * bell(&g, 1, q / p[0] % p[1], ions->x[i][1],
				sigma, false) *
				bell(&g, 2, q / p[0] / p[1], ions->x[i][2], sigma, false);
	struct pm_poisson_fft *s = pm_poisson_fft_new(&g, &(struct pm_poisson_fft_choice){.green = green});
	check(s && !pm_poisson_fft_solve(s, -4 * pm_pi, rho, phi, NULL), "%s: solved", faces);
	pm_poisson_fft_free(s);
	for (size_t q = 0; q < n; q++) /* rho is 0 at open ends, where weights would be half */
		sum += 0.5 * volume * rho[q] * phi[q];
	for (int d = 0; d < 3 && force; d++) {
		force[d] = 0;
		for (size_t q = 0; q < n; q++) {
			size_t at[3] = {q % p[0], q / p[0] % p[1], q / p[0] / p[1]};
			double b = factor * ions->q[0];
			for (int e = 0; e < 3; e++)
				b *= bell(&g, e, at[e], ions->x[0][e], sigma, e == d);
			force[d] -= volume * b * phi[q];
		}
	}
	for (int i = 0; i < ions->n; i++) {
		sum -= alpha / sqrt(pm_pi) * ions->q[i] * ions->q[i];
		for (int j = 0; j < ions->n; j++)
			for (int image = 0; image < 27; image++) {
				int m[3] = {image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1};
				double r2 = 0, x[3];
				bool there = true;
				for (int d = 0; d < 3; d++) {
					there = there && (m[d] == 0 || faces[d] == 'p');
					x[d] = ions->x[i][d] - ions->x[j][d] - m[d];
					r2 += x[d] * x[d];
				}
				if (!there || r2 == 0)
					continue;
				double r = sqrt(r2), qq = ions->q[i] * ions->q[j];
				sum += 0.5 * qq * erfc(alpha * r) / r;
				for (int d = 0; d < 3 && force && i == 0; d++)
					force[d] += qq * (erfc(alpha * r) / r + 2 * alpha / sqrt(pm_pi) * exp(-alpha * alpha * r2)) * x[d] / r2;
			}
	}
	free(rho), free(phi);
	return sum;
}

/* Face-centred positions for one kind of ion, the other shifted by (s, s, s) or along x. */
static struct ions faces_centred(double sx, double sy, double sz)
{
	struct ions a = {.n = 8};
	for (int i = 0; i < 8; i++) {
		int k = i / 2, second = i % 2;
		double x[3] = {(k == 1 || k == 2) * 0.5, (k == 1 || k == 3) * 0.5, (k == 2 || k == 3) * 0.5}, s[3] = {sx, sy, sz};
		for (int d = 0; d < 3; d++)
			a.x[i][d] = x[d] + second * s[d] + 0.01; /* off the nodes */
		a.q[i] = second ? -1 : 1;
	}
	return a;
}

static void crystals(void)
{
	struct ions salt = faces_centred(0.5, 0, 0), zinc = faces_centred(0.25, 0.25, 0.25), caesium = {2, {{0.01, 0.02, 0.03}, {0.51, 0.52, 0.53}}, {1, -1}};
	check_near(-energy(&salt, "ppp", NULL, NULL) * 0.5 / 4, 1.747564594633182, 1e-10, "PS-04: the Madelung constant of NaCl");
	check_near(-energy(&caesium, "ppp", NULL, NULL) * sqrt(0.75), 1.762674773070988, 1e-10, "PS-04: the Madelung constant of CsCl");
	check_near(-energy(&zinc, "ppp", NULL, NULL) * sqrt(3) / 4 / 4, 1.638055053388789, 1e-10, "PS-04: the Madelung constant of zincblende");
}

static void anywhere(void)
{
	static const double want[3] = {-0.60171367422, -5.5879689186, 5.4854469821};
	struct ions a = {.n = 8};
	uint64_t state = 7;
	for (int i = 0; i < 8; i++) {
		for (int d = 0; d < 3; d++)
			a.x[i][d] = (double)(state = 16807 * state % 2147483647) / 2147483647.0;
		a.q[i] = i % 2 ? -1 : 1;
	}
	double force[3];
	check_near(energy(&a, "ppp", NULL, force), -17.8735592188424, 1e-10, "PS-01: the energy of eight ions");
	for (int d = 0; d < 3; d++)
		check_near(force[d], want[d], 1e-9, "PS-01: the force on the first of eight ions"); /* values.csv */
}

static void layers(void)
{
	const double middle = 17.0 / CELLS, layer = 4 * 0.6048986434216304 * 0.6676914571896092, chain = 2 * log(2);
	struct ions sheet = {4, {{0.01, 0.02, middle}, {0.51, 0.02, middle}, {0.01, 0.52, middle}, {0.51, 0.52, middle}}, {1, -1, -1, 1}};
	struct ions row = {2, {{middle, 0.01, middle}, {middle, 0.51, middle}}, {1, -1}};
	check_near(-energy(&sheet, "ppo", &green_vico, NULL) * 0.5 / 2, layer, 1e-10, "PS-04: the Madelung constant of a square layer, open across");
	check_near(-energy(&row, "opo", &green_vico, NULL) * 0.5, chain, 1e-10, "PS-04: the Madelung constant of a chain, open around");
	/* The blobs are two spacings wide: (h/sigma)^4 of the energy of the long-range half. */
	check_near(-energy(&row, "opo", &green_hockney, NULL) * 0.5, chain, 2e-2, "PS-04: a chain with the sampled function, to its order");
}

int main(void)
{
	crystals();
	anywhere();
	layers();
	return check_done();
}
