/* Free space by James' method from transforms between walls: the box is solved grounded, the charge on its walls gives the potential there
 * (lib/james/james.c), and it is solved again with that. The answer is that of the differences on the infinite lattice, as of the Green's function `lattice` on
 * the doubled box. Source: James, J. Comput. Phys. 25 (1977) 71. Cost: two sine solutions, 100 N^3 operations for the walls;
 * memory: nine copies of the mesh in 3-D. SPDX-License-Identifier: GPL-3.0-or-later */
#include "james/james.h"
#include "poisson-fft/fft-passes.h"

struct pm_fft_james {
	struct pm_poisson_fft *walled;
	struct pm_james *outer;
	double *u; /* the grounded solution, of the points of the grid here */
};

int pm_fft_james_check(const struct pm_grid *g, const struct pm_poisson_fft_choice *o)
{
	if (!pm_james_wanted(g))
		return pm_fail(PM_DATA, "--free-space james is for open faces, and this box has none (leave it out, or smod --faces open)");
	if (o->symbol != PM_FD2 || o->screening > 0 || o->wave > 0 || o->green || pm_influence_any(&o->influence))
		return pm_fail(PM_USAGE, "--free-space james solves the differences of order 2 (leave out --symbol, --green, --screening, --wave-number, "
			"--influence and --cloud, or --free-space)");
	return pm_james_check(g);
}

struct pm_fft_james *pm_fft_james_free(struct pm_fft_james *j)
{
	if (j)
		pm_poisson_fft_free(j->walled), pm_james_free(j->outer), pm_free(j->u);
	return pm_free(j);
}

struct pm_fft_james *pm_fft_james_new(const struct pm_grid *g, const struct pm_planes *planes)
{
	const size_t n = planes && planes->divided ? planes->here * planes->size + 1 : pm_grid_size(g);
	const struct pm_grid walled = pm_james_walled(g);
	struct pm_fft_james *j = pm_zalloc(1, sizeof *j);
	int status = pm_planes_agree(j && (j->u = pm_alloc(n, sizeof *j->u)) ? 0 : pm_failed(), planes);
	if (!status && !(j->walled = pm_poisson_fft_new(&walled, &(struct pm_poisson_fft_choice){.symbol = PM_FD2, .planes = planes})))
		status = pm_failed(); /* on all ranks or on none */
	if (!status && !(j->outer = pm_james_new(g, planes)))
		status = pm_failed();
	return status ? pm_fft_james_free(j) : j;
}

int pm_fft_james_solve(struct pm_fft_james *j, double c, const double *s, double *phi)
{
	const double *f = NULL;
	int status = pm_poisson_fft_solve(j->walled, c, s, j->u, NULL);
	status = pm_james_source(status, j->outer, c, s, j->u, phi, &f);
	if (!status)
		status = pm_poisson_fft_solve(j->walled, 1, f, phi, NULL);
	if (!status)
		pm_james_set(j->outer, phi);
	return status;
}

const struct pm_poisson_fft *pm_fft_james_walled(const struct pm_fft_james *j) { return j->walled; }
