/* The transform solver in every mixture of periodic, wall and neumann faces, a wall opposite a neumann face too, in 1-D to 3-D: 5, 25 and 125
 * mixtures each for manufactured solutions, for the stencils it inverts, against multigrid; and the screened equation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fft/axis-transform.h"
#include "mesh/gradient.h"
#include "poisson-fft/poisson-fft.h"
#include "poisson-mg/mg.h"

static const enum pm_face ends[][2] = {{PM_PERIODIC, PM_PERIODIC}, {PM_WALL, PM_WALL}, {PM_NEUMANN, PM_NEUMANN}, {PM_WALL, PM_NEUMANN},
	{PM_NEUMANN, PM_WALL}};
enum { KINDS = sizeof ends / sizeof *ends };

/* Mixture number m of dim axes; n cells along x and z, 4n/3 along y, twice as many on periodic axes if wide. */
static struct pm_grid mixture(int dim, int m, size_t n, bool wide)
{
	static const double length[3] = {2, 1.3, 0.9};
	struct pm_grid g = {.dim = dim, .cells = {1, 1, 1}, .points = {1, 1, 1}, .h = {1, 1, 1}};
	for (int d = 0; d < dim; d++, m /= KINDS) {
		bool periodic = m % KINDS == 0;
		g.cells[d] = (d == 1 ? 4 * n / 3 : n) * (periodic && wide ? 2 : 1);
		g.points[d] = g.cells[d] + !periodic;
		g.h[d] = length[d] / (double)g.cells[d];
		memcpy(g.face[d], ends[m % KINDS], sizeof g.face[d]);
	}
	return g;
}

static int mixtures(int dim)
{
	return dim == 1 ? KINDS : dim == 2 ? KINDS * KINDS : KINDS * KINDS * KINDS;
}

/* Under a sanitizer every 8th of the 125: 8 is prime to 5, so each pair of faces is there on each axis. */
static int apart(int dim) { return dim == 3 && check_sanitized() ? 8 : 1; }

static int looked_at(int dim) { return (mixtures(dim) + apart(dim) - 1) / apart(dim); }

static const char *name_of(const struct pm_grid *g)
{
	static char text[120];
	int used = 0;
	for (int d = 0; d < g->dim; d++)
		used += snprintf(text + used, sizeof text - (size_t)used, "%s%s-%s", d ? " x " : "", pm_face_names[g->face[d][0]],
			pm_face_names[g->face[d][1]]);
	return text;
}

/* f and f'' along axis d: functions of sines and cosines that the faces reflect into themselves, smooth through the images. */
static void profile(const struct pm_grid *g, int d, size_t i, double *f, double *f2)
{
	bool wall[2] = {g->face[d][0] == PM_WALL, g->face[d][1] == PM_WALL}, periodic = g->face[d][0] == PM_PERIODIC;
	double k = pm_pi / ((double)g->cells[d] * g->h[d]) * (periodic ? 2 : wall[0] == wall[1] ? 1 : 0.5), x = k * (double)i * g->h[d];
	double s = wall[0] ? sin(x) : cos(periodic ? x + 0.4 : x), c2 = 1 - s * s; /* s'' = -k^2 s, s'^2 = k^2 (1 - s^2) */
	if (wall[0] || wall[1]) {
		*f = sinh(s);
		*f2 = k * k * (sinh(s) * c2 - cosh(s) * s);
	} else {
		*f = exp(0.3 * s);
		*f2 = k * k * exp(0.3 * s) * (0.09 * c2 - 0.3 * s);
	}
}

/* phi = product of profiles, and s = lap phi - K^2 phi. */
static void manufacture(const struct pm_grid *g, double screening, double *phi, double *s)
{
	double f[3][128], f2[3][128];
	for (int d = 0; d < 3; d++)
		for (size_t i = 0; i < g->points[d]; i++) {
			f[d][i] = 1, f2[d][i] = 0;
			if (d < g->dim)
				profile(g, d, i, &f[d][i], &f2[d][i]);
		}
	for (size_t k = 0, q = 0; k < g->points[2]; k++)
		for (size_t j = 0; j < g->points[1]; j++)
			for (size_t i = 0; i < g->points[0]; i++, q++) {
				phi[q] = f[0][i] * f[1][j] * f[2][k];
				s[q] = f2[0][i] * f[1][j] * f[2][k] + f[0][i] * f2[1][j] * f[2][k] + f[0][i] * f[1][j] * f2[2][k] -
					screening * screening * phi[q];
			}
}

static void take_mean(const struct pm_grid *g, double *a)
{
	struct pm_sum sum = {0}, weight = {0};
	size_t n = pm_grid_size(g);
	for (size_t k = 0, q = 0; k < g->points[2]; k++)
		for (size_t j = 0; j < g->points[1]; j++)
			for (size_t i = 0; i < g->points[0]; i++, q++) {
				pm_sum_add(&sum, pm_grid_weight(g, i, j, k) * a[q]);
				pm_sum_add(&weight, pm_grid_weight(g, i, j, k));
			}
	for (size_t q = 0; q < n; q++)
		a[q] -= pm_sum_total(sum) / pm_sum_total(weight);
}

/* The largest difference over the largest want; where the problem is singular, of want without its mean. */
static double error_of(const struct pm_grid *g, const struct pm_poisson_fft_choice *o, const double *s, double *want)
{
	size_t n = pm_grid_size(g);
	double *phi = malloc(n * sizeof *phi), most = 0, scale = 1e-300;
	struct pm_poisson_fft *p = pm_poisson_fft_new(g, o);
	if (!p || pm_poisson_fft_solve(p, 1, s, phi, NULL))
		most = NAN;
	if (pm_poisson_fft_singular(g, o))
		take_mean(g, want);
	for (size_t q = 0; q < n; q++) {
		check_worst(&most, fabs(phi[q] - want[q]));
		check_worst(&scale, fabs(want[q]));
	}
	pm_poisson_fft_free(p);
	free(phi);
	return most / scale;
}

static double manufactured(const struct pm_grid *g, const struct pm_poisson_fft_choice *o)
{
	size_t n = pm_grid_size(g);
	double *s = malloc(n * sizeof *s), *want = malloc(n * sizeof *want);
	manufacture(g, o->screening, want, s);
	double error = error_of(g, o, s, want);
	free(s), free(want);
	return error;
}

static double slope(const double h[3], const double error[3])
{
	double sx = 0, sy = 0, sxx = 0, sxy = 0;
	for (int i = 0; i < 3; i++) {
		double x = log(h[i]), y = log(error[i]);
		sx += x, sy += y, sxx += x * x, sxy += x * y;
	}
	return (3 * sxy - sx * sy) / (3 * sxx - sx * sx);
}

/* The least order over all mixtures, each fitted from three resolutions; the spectral solver is exact to round-off once the images are resolved. */
static void orders(int dim, double screening)
{
	for (int symbol = PM_SPECTRAL; symbol <= PM_FD6; symbol++) {
		struct pm_poisson_fft_choice o = {.symbol = symbol, .screening = screening};
		double least = INFINITY, worst = 0;
		char where[120] = "";
		for (int m = 0; m < mixtures(dim); m += apart(dim)) {
			double h[3], error[3];
			struct pm_grid g;
			for (size_t l = 0; l < 3; l++) {
				g = mixture(dim, m, (symbol == PM_SPECTRAL ? 24 : 18) + 6 * l, true);
				h[l] = 1.0 / (double)(18 + 6 * l);
				error[l] = manufactured(&g, &o);
			}
			double order = slope(h, error);
			check_worst(&worst, error[0]);
			if (check_least(&least, order))
				snprintf(where, sizeof where, "%s", name_of(&g));
		}
		const char *which = screening > 0 ? ", screened" : "";
		if (symbol == PM_SPECTRAL) /* 24, 32, 24 cells; sinh(sin x) has 1e-17 left of its waves after 15; round-off of sums over 1e4 nodes */
			check(worst < 2e-13, "%d-D, %d mixtures of faces%s: spectral is exact for smooth solutions (error %.1e)", dim, looked_at(dim), which,
				worst);
		else /* order - 0.1 as everywhere */
			check(least >= 2 * symbol - 0.1, "%d-D, %d mixtures of faces%s: %s has order %.2f at least (%s)", dim, looked_at(dim), which,
				pm_symbol_names[symbol], least, where);
	}
}

static double *noise(size_t n, uint64_t seed)
{
	double *s = malloc(n * sizeof *s), u[2];
	for (size_t i = 0; i < n; i++) {
		pm_random(seed, i, 7, u);
		s[i] = u[0] - 0.3;
	}
	return s;
}

/* Noise through lap of mgrad and back. */
static double round_trip(const struct pm_grid *g, const struct pm_poisson_fft_choice *o)
{
	size_t n = pm_grid_size(g);
	double *want = noise(n, 2385), *s = malloc(n * sizeof *s), error = NAN;
	for (size_t q = 0; q < n; q++) {
		size_t at[3] = {q % g->points[0], q / g->points[0] % g->points[1], q / g->points[0] / g->points[1]};
		for (int d = 0; d < g->dim; d++)
			if ((g->face[d][0] == PM_WALL && at[d] == 0) || (g->face[d][1] == PM_WALL && at[d] == g->cells[d]))
				want[q] = 0;
	}
	struct pm_operator lap;
	struct pm_fft_plans planner = {0};
	if (!pm_operator_init(&lap, g, PM_OP_LAP, 2 * (int)o->symbol, 1, false) && !pm_operator_plan(&lap, &planner) &&
	    !pm_operator_apply(&lap, 1, (const double *[]){want}, (double *[]){s}, NULL)) {
		for (size_t q = 0; q < n; q++)
			s[q] -= o->screening * o->screening * want[q];
		error = error_of(g, o, s, want);
	}
	pm_fft_plans_clear(&planner);
	free(want), free(s);
	return error;
}

static void inverses(int dim)
{
	for (int symbol = PM_SPECTRAL; symbol <= PM_FD6; symbol++)
		for (int k = 0; k < 2; k++) {
			struct pm_poisson_fft_choice o = {.symbol = symbol, .screening = 2.385 * k};
			static const size_t size[] = {3, 9, 12, 17};
			double worst = 0;
			for (int m = 0; m < mixtures(dim); m += apart(dim))
				for (int i = 0; i < 4; i++) {
					struct pm_grid g = mixture(dim, m, size[i], false);
					double error = round_trip(&g, &o);
					check_worst(&worst, error);
				}
			/* on these meshes lap is up to 1e3 times its argument, with a round-off of 1e-16 of that */
			check(worst < 1e-12, "%d-D, %d mixtures of faces, %s%s: inverts lap of mgrad to round-off (error %.1e)", dim, looked_at(dim),
				pm_symbol_names[symbol], k ? ", screened" : "", worst);
		}
}

/* Cells a hundred times longer than wide: a direct solver cannot stall. */
static void flat(void)
{
	double worst = 0;
	for (int m = 0; m < mixtures(2); m++)
		for (int symbol = PM_SPECTRAL; symbol <= PM_FD6; symbol++) {
			struct pm_grid g = mixture(2, m, 33, false);
			g.h[0] = 1, g.h[1] = 0.01;
			double error = round_trip(&g, &(struct pm_poisson_fft_choice){.symbol = symbol});
			check_worst(&worst, error);
		}
	/* round-off of 1/hy^2 against the smallest eigenvalue, 1e4 (33/pi)^2 of it */
	check(worst < 1e-9, "HC-25: dx/dy = 100, all mixtures in 2-D: every stencil is inverted (error %.1e)", worst);
}

static void against_multigrid(int dim)
{
	double worst = 0;
	int cases = 0;
	for (int m = 0; m < mixtures(dim); m += apart(dim), cases++) {
		struct pm_grid g = mixture(dim, m, 9, false);
		size_t n = pm_grid_size(&g);
		double *s = noise(n, 5), *a = malloc(n * sizeof *a);
		struct pm_mg *mg = pm_mg_new(&g, 2);
		struct pm_mg_choice choice = {.pre = 2, .post = 2, .cycle = PM_MG_V, .relaxation = 1.15, .tolerance = 1e-12, .most = 100};
		static struct pm_mg_record record;
		double error = mg && pm_mg_solve(mg, &choice, 1, s, a, &record) == 0 ? error_of(&g, &(struct pm_poisson_fft_choice){.symbol = PM_FD2}, s, a)
			: NAN;
		check_worst(&worst, error);
		pm_mg_free(mg);
		free(s), free(a);
	}
	check(worst < 1e-10, "%d-D: fd2 is what multigrid converges to, %d mixtures of faces (difference %.1e)", dim, cases, worst);
}

/* phi'' - K^2 phi = delta/h with second differences: phi_j = -h r^|j|/(1/r - r), r + 1/r = 2 + K^2 h^2, and its images in a period of n. */
static void decay(void)
{
	enum { N = 40 };
	struct pm_grid g = {.dim = 1, .cells = {N, 1, 1}, .points = {N, 1, 1}, .h = {0.3, 1, 1}};
	double s[N] = {1 / 0.3}, want[N], b = 2 + pow(0.7 * 0.3, 2), r = 0.5 * (b - sqrt(b * b - 4));
	for (int j = 0; j < N; j++)
		want[j] = -0.3 / (1 / r - r) * (pow(r, j) + pow(r, N - j)) / (1 - pow(r, N));
	check_near(error_of(&g, &(struct pm_poisson_fft_choice){.symbol = PM_FD2, .screening = 0.7}, s, want), 0, 1e-14,
		"screened, 1-D: the second difference decays by its own exponential");
}

/* lap phi - K^2 phi = -4 pi rho of a Gaussian of width 1 in a box of 16: in free space, by completing the square,
 * phi = exp(K^2/2)/(2 r) (exp(-K r) erfc((K - r)/sqrt 2) - exp(K r) erfc((K + r)/sqrt 2)); images are 1e-13 where r < 4. */
static void yukawa(void)
{
	enum { N = 48 };
	const double K = 2.5, h = 16.0 / N;
	struct pm_grid g = {.dim = 3, .cells = {N, N, N}, .points = {N, N, N}, .h = {h, h, h}};
	size_t n = pm_grid_size(&g);
	double *s = malloc(n * sizeof *s), *r = malloc(n * sizeof *r), worst = 0;
	for (size_t q = 0; q < n; q++) {
		double x = h * (double)(q % N) - 8, y = h * (double)(q / N % N) - 8, z = h * (double)(q / N / N) - 8;
		r[q] = sqrt(x * x + y * y + z * z);
		s[q] = exp(-0.5 * r[q] * r[q]) / pow(2 * pm_pi, 1.5);
	}
	struct pm_poisson_fft *p = pm_poisson_fft_new(&g, &(struct pm_poisson_fft_choice){.screening = K});
	pm_poisson_fft_solve(p, -4 * pm_pi, s, s, NULL);
	for (size_t q = 0; q < n; q++)
		if (r[q] > 0.1 && r[q] < 4) {
			double e = exp(0.5 * K * K) / (2 * r[q]);
			double want = e * (exp(-K * r[q]) * erfc((K - r[q]) / sqrt(2)) - exp(K * r[q]) * erfc((K + r[q]) / sqrt(2)));
			check_worst(&worst, fabs(s[q] - want));
		}
	check(worst < 1e-12, "screened, 3-D: the Yukawa potential of a Gaussian (error %.1e of 0.2)", worst);
	pm_poisson_fft_free(p);
	free(s), free(r);
}

/* -lap G = delta on a periodic lattice of n^dim sites, less its mean: G at the site and its differences from it. */
static double lattice(int dim, size_t n, double differences[2])
{
	struct pm_grid g = {.dim = dim, .cells = {n, n, dim > 2 ? n : 1}, .points = {n, n, dim > 2 ? n : 1}, .h = {1, 1, 1}};
	double *s = calloc(pm_grid_size(&g), sizeof *s);
	s[0] = 1;
	struct pm_poisson_fft *p = pm_poisson_fft_new(&g, &(struct pm_poisson_fft_choice){.symbol = PM_FD2});
	pm_poisson_fft_solve(p, -1, s, s, NULL);
	double centre = s[0];
	differences[0] = centre - s[1], differences[1] = centre - s[n + 1];
	pm_poisson_fft_free(p);
	free(s);
	return centre;
}

/* The infinite lattice from three periodic ones: the remainders fall as n^-a and n^-b. */
static double limit(const double value[3], double a, double b)
{
	double p = pow(2, a), q = pow(2, b), low = (p * value[1] - value[0]) / (p - 1), high = (p * value[2] - value[1]) / (p - 1);
	return (q * high - low) / (q - 1);
}

static void lattices(void)
{
	double centre[3], d3[3][2], d2[3][2], across[3];
	for (size_t l = 0; l < 3; l++) {
		size_t n = 24u << l;
		double sites = pow((double)n, 3);
		centre[l] = lattice(3, n, d3[l]) + 2.8372974794806195 / (4 * pm_pi * (double)n); /* the images and the background: PS-01's constant */
		check_near(d3[l][0], (1 - 1 / sites) / 6, 1e-14, "PS-07: 3-D, G(0) - G(1,0,0) = 1/6, less the background of a periodic lattice");
		n *= 4;
		lattice(2, n, d2[l]);
		check_near(d2[l][0], (1 - 1 / pow((double)n, 2)) / 4, 1e-13, "PS-07: 2-D, G(0) - G(1,0) = 1/4, less the background");
		across[l] = d2[l][1];
	}
	check_near(limit(centre, 3, 5), 0.252731009858663, 1e-10, "PS-07: 3-D, G(0) of the infinite lattice from 24^3, 48^3 and 96^3 sites");
	check_near(limit(across, 2, 4), 1 / pm_pi, 1e-10, "PS-07: 2-D, G(0) - G(1,1) = 1/pi from 96^2, 192^2 and 384^2 sites");
}

int main(void)
{
	pm_threads_use(1); /* the meshes are small */
	for (int dim = 1; dim <= 3; dim++) {
		orders(dim, 0);
		orders(dim, 2.385);
		inverses(dim);
		against_multigrid(dim);
	}
	flat();
	decay();
	yukawa();
	lattices();
	return check_done();
}
