/* Green's functions of blobs where other axes are not open or the equation is screened: against their Fourier integrals, and in boxes of two sizes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <stdlib.h>

#include "check.h"
#include "poisson-fft/poisson-fft.h"

extern const struct pm_green green_gauss2, green_gauss6, green_gauss10;

struct wave {
	const struct pm_green_case *c;
	int order;
	double r;
};

/* zeta(k)/(k^2 + kappa^2) times the measure and the wave of d dimensions. */
static double integrand(double k, void *p)
{
	const struct wave *w = p;
	const struct pm_green_case *c = w->c;
	double s = 0.5 * c->width * c->width * (k * k + c->k2), sum = 0, term = 1, x = k * w->r;
	for (int j = 0; j < w->order / 2; j++) {
		sum += term;
		term *= s / (j + 1);
	}
	double wave = c->dim == 1 ? cos(x) / pm_pi : c->dim == 2 ? k * j0(x) / (2 * pm_pi) : k * k * (x > 0 ? sin(x) / x : 1) / (2 * pm_pi * pm_pi);
	return -exp(-s) * sum / (k * k + c->kappa * c->kappa) * wave;
}

static double integral(const struct pm_green_case *c, int order, double r, gsl_integration_workspace *space)
{
	struct wave w = {c, order, r};
	gsl_function f = {integrand, &w};
	double most = 14 / c->width, part, error, sum = 0; /* zeta of order 10: exp(-98) 98^4/24 */
	int pieces = 1 + (int)(most * r / 30);
	for (int i = 0; i < pieces; i++) {
		gsl_integration_qag(&f, most * i / pieces, most * (i + 1) / pieces, 1e-15, 1e-13, 2000, GSL_INTEG_GAUSS61, space, &part, &error);
		sum += part;
	}
	return sum;
}

static void values(void)
{
	static const struct pm_green *const green[] = {&green_gauss2, &green_gauss6, &green_gauss10};
	static const double waves[][2] = {{0.09, 0}, {0, 0.04}, {0.3, 0.2}, {0, 4}, {9, 0}, {12, 30}, {1e-5, 0}}; /* k2, K^2 */
	static const double r[] = {0, 0.35, 1.7, 6, 8.9, 13, 25};
	gsl_integration_workspace *space = gsl_integration_workspace_alloc(2000);
	gsl_set_error_handler_off(); /* round-off stops the reference a little above what was asked for */
	for (int dim = 1; dim <= 3; dim++)
		for (int g = 0; g < 3; g++) {
			double worst = 0;
			for (size_t i = 0; i < sizeof waves / sizeof *waves; i++)
				for (size_t j = 0; j < sizeof r / sizeof *r; j++) {
					struct pm_green_case c = {.dim = dim, .width = 1.1, .kappa = sqrt(waves[i][0] + waves[i][1]), .k2 = waves[i][0]};
					if (dim < 3 && c.kappa < 0.01)
						continue; /* the reference has a peak of that width at k = 0 */
					double scale = fabs(integral(&c, green[g]->order, 0, space));
					check_worst(&worst, fabs(green[g]->at(&c, r[j] * r[j]) - integral(&c, green[g]->order, r[j], space)) / scale);
				}
			char name[100];
			snprintf(name, sizeof name, "%s in %d-D with waves and screening, against its Fourier integral", green[g]->name, dim);
			check_near(worst, 0, 1e-12, name); /* the reference's own round-off; 1e-13 measured */
		}
	gsl_integration_workspace_free(space);
}

/* phi near a point in a box of `cells` cells along the open axes, 11^dim nodes. */
static void near(const char *faces, size_t cells, const struct pm_poisson_fft_choice *o, double *out)
{
	struct pm_grid g = {.dim = 3, .cells = {1, 1, 1}, .h = {1, 1, 1}};
	for (int d = 0; d < 3; d++) {
		for (int side = 0; side < 2; side++)
			g.face[d][side] = faces[2 * d + side] == 'o' ? PM_OPEN : faces[2 * d + side] == 'w' ? PM_WALL : PM_PERIODIC;
		g.cells[d] = faces[2 * d] == 'o' ? cells : 12;
		g.points[d] = g.cells[d] + (g.face[d][0] != PM_PERIODIC);
	}
	size_t n = pm_grid_size(&g), at[3];
	double *s = calloc(n, sizeof *s), *phi = malloc(n * sizeof *phi);
	for (int d = 0; d < 3; d++)
		at[d] = g.cells[d] / 2;
	s[at[0] + g.points[0] * (at[1] + g.points[1] * at[2])] = 1;
	struct pm_poisson_fft_record r;
	struct pm_poisson_fft *p = pm_poisson_fft_new(&g, o);
	if (!p || pm_poisson_fft_solve(p, 1, s, phi, &r))
		check(false, "the solver runs (%s)", pm_message());
	pm_poisson_fft_free(p);
	for (size_t k = 0; k < 1331; k++)
		out[k] = phi[at[0] + k % 11 - 5 + g.points[0] * (at[1] + k / 11 % 11 - 5 + g.points[1] * (at[2] + k / 121 - 5))];
	free(s), free(phi);
}

static void boxes(void)
{
	static const struct pm_green *const green[] = {&green_gauss2, &green_gauss10};
	static const char *const faces[] = {"oooopp", "wwoopp", "oooooo"};
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 8; k++) {
			const double softening[] = {0.5, 1.5, 0, 4.3};
			struct pm_poisson_fft_choice o = {.green = green[k % 2], .softening = softening[k / 2], .screening = i == 2 ? 0.2 : 0};
			double small[1331], large[1331], worst = 0, scale = 0;
			near(faces[i], 14, &o, small), near(faces[i], 23, &o, large);
			for (size_t j = 0; j < 1331; j++) {
				check_worst(&worst, fabs(small[j] - large[j]));
				check_worst(&scale, fabs(small[j]));
			}
			char name[100];
			snprintf(name, sizeof name, "%s, %s, softening %g: the same in a larger open box", o.green->name, faces[i], o.softening);
			check_near(worst / scale, 0, 2e-14, name); /* round-off; at 4.3 by the transform of the truncated function */
		}
}

int main(void)
{
	values();
	boxes();
	return check_done();
}
