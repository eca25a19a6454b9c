/* Corrected particle strength exchange: exact for polynomials on any points, the differences it becomes on a lattice (F10), images, points that do not
 * determine it (S36), any number of threads. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "near/dcpse.h"

enum { MOST = 2048 };
static struct pm_domain domain;
static size_t n;
static double x[3][MOST], value[MOST], rate[MOST];

static int add(const struct pm_dc *o, struct pm_dc_found *found)
{
	struct pm_cell_list l;
	const double *at[3] = {x[0], x[1], x[2]}, *values[] = {value};
	double *rates[] = {rate};
	int status = pm_cell_list_init(&l, &domain, n, at, o->reach * pm_dc_widest, o->eps);
	memset(rate, 0, sizeof rate);
	if (!status)
		status = pm_dc_add(o, &l, 1, 1, values, rates, found);
	pm_cell_list_free(&l);
	return status;
}

static struct pm_dc method(int dim, int order, double eps) { return (struct pm_dc){dim, order, eps, eps * pm_dc_cutoff(order)}; }

/* m^dim points, moved at random by jitter of their spacing. */
static void points(int dim, size_t m, double jitter)
{
	domain = (struct pm_domain){.dim = dim, .hi = {1, 1, 1}};
	n = 1;
	for (int d = 0; d < 3; d++) {
		domain.face[d][0] = domain.face[d][1] = PM_OPEN;
		n *= d < dim ? m : 1;
	}
	for (size_t i = 0; i < n; i++) {
		size_t at = i;
		for (int d = 0; d < dim; d++, at /= m) {
			double u[2];
			pm_random(3, i, (uint64_t)d, u);
			x[d][i] = ((double)(at % m) + 0.5 + jitter * (2 * u[0] - 1)) / (double)m;
		}
	}
}

/* (a x + b y + c z + 1/2)^k: its Laplacian is k (k-1) (a^2 + b^2 + c^2) of the power two below. */
static void polynomials(void)
{
	static const double a[3] = {0.7, -0.4, 0.5};
	static const size_t sides[] = {40, 16, 8};
	for (int dim = 1; dim <= 3; dim++)
		for (int order = 2; order <= 4; order += 2) {
			struct pm_dc_found found;
			double worst = 0, a2 = 0;
			points(dim, sides[dim - 1], 0.3);
			struct pm_dc o = method(dim, order, 1 / (double)sides[dim - 1]);
			for (int d = 0; d < dim; d++)
				a2 += a[d] * a[d];
			for (int k = 0; k <= order + 1; k++) {
				for (size_t i = 0; i < n; i++) {
					double s = 0.5;
					for (int d = 0; d < dim; d++)
						s += a[d] * x[d][i];
					value[i] = pow(s, k);
				}
				int status = add(&o, &found);
				for (size_t i = 0; i < n && !status; i++) {
					double s = 0.5;
					for (int d = 0; d < dim; d++)
						s += a[d] * x[d][i];
					check_worst(&worst, fabs(rate[i] - (k < 2 ? 0 : k * (k - 1) * a2 * pow(s, k - 2))));
				}
				worst = status ? NAN : worst;
			}
			/* rounding of values of 1 over eps^2 (1600 in 1-D), times weights of up to 1e3 at the rim */
			check(worst < 1e-8, "order %d in %d-D is exact for polynomials of degree 0 to %d on points moved by 0.3 h, rims included (%.2g; "
				"%llu of %zu widened)", order, dim, order + 1, worst, (unsigned long long)found.widened, n);
		}
}

static void differences(void)
{
	for (int dim = 1; dim <= 3; dim++) {
		size_t m = dim == 3 ? 10 : 16, middle = 0, stride = 1;
		struct pm_dc_found found;
		points(dim, m, 0);
		for (int d = 0; d < dim; d++)
			domain.face[d][0] = domain.face[d][1] = PM_PERIODIC;
		double h = 1 / (double)m, want = 0;
		struct pm_dc o = {dim, 2, h / 2.2, 2.5 * h}; /* the window of second neighbours is exp(-14) of that of the first */
		for (size_t i = 0; i < n; i++)
			value[i] = sin(7 * x[0][i]) * (dim > 1 ? cos(5 * x[1][i]) : 1) * (dim > 2 ? 1 + x[2][i] : 1);
		for (int d = 0; d < dim; d++, stride *= m)
			middle += m / 2 * stride;
		stride = 1;
		for (int d = 0; d < dim; d++, stride *= m)
			want += (value[middle + stride] - 2 * value[middle] + value[middle - stride]) / (h * h);
		int status = add(&o, &found);
		check(!status, "the lattice determines the moments");
		check_near(rate[middle], want, 1e-2 * fabs(want), "F10: a narrow window on a lattice gives the second differences");
	}
}

/* An odd field between walls, an even one between neumann faces, continued beyond the faces. */
static void images(void)
{
	static const enum pm_face kinds[] = {PM_WALL, PM_NEUMANN, PM_PERIODIC};
	for (int k = 0; k < 3; k++) {
		struct pm_dc_found found;
		double worst = 0, wave = kinds[k] == PM_PERIODIC ? 2 * pm_pi : pm_pi;
		points(2, 40, 0.3);
		for (int d = 0; d < 2; d++)
			domain.face[d][0] = domain.face[d][1] = kinds[k];
		struct pm_dc o = method(2, 4, 0.025);
		for (size_t i = 0; i < n; i++)
			value[i] = kinds[k] == PM_WALL ? sin(wave * x[0][i]) * sin(wave * x[1][i]) : cos(wave * x[0][i]) * cos(wave * x[1][i]);
		int status = add(&o, &found);
		for (size_t i = 0; i < n; i++)
			check_worst(&worst, fabs(rate[i] + 2 * wave * wave * value[i]));
		check(!status && found.widened == 0 && worst < (kinds[k] == PM_PERIODIC ? 0.02 : 0.001),
			"%s faces: right up to them, no particle reaches farther (%.2g)", pm_face_names[kinds[k]], worst);
	}
}

static void stuck(void)
{
	struct pm_dc_found found;
	struct pm_dc o = method(2, 2, 0.1);
	points(2, 10, 0);
	for (size_t i = 0; i < n; i++)
		x[1][i] = 0.5 * x[0][i];
	int lost = add(&o, &found);
	check(lost == -PM_NUMERICS && found.stuck == 0 && found.rank == 3 && found.wanted == 9,
		"S36: points on a line in the plane have rank 3 of 9 (%d of %d)", found.rank, found.wanted);
	n = 7;
	check(add(&o, &found) == -PM_NUMERICS && found.rank <= 6, "too few points");
	n = 1;
	check(add(&o, &found) == -PM_NUMERICS && found.partners == 0 && found.rank == 0, "one point");
	n = 0;
	check(add(&o, &found) == 0, "no points");
	points(2, 12, 0.3);
	for (size_t i = 0; i < n; i++)
		value[i] = x[0][i] * x[0][i];
	memcpy(x[0] + n, x[0], n * sizeof(double)), memcpy(x[1] + n, x[1], n * sizeof(double)), memcpy(value + n, value, n * sizeof(double));
	n *= 2;
	o = method(2, 2, 1. / 12);
	int status = add(&o, &found);
	check(!status && fabs(rate[30] - 2) < 1e-9 && rate[30 + 144] == rate[30], "HC-45: points that occur twice do not change the result");
}

static void threads(void)
{
	static double one[MOST];
	struct pm_dc o = method(2, 2, 1. / 40);
	struct pm_dc_found found, first = {0};
	points(2, 40, 0.3);
	for (size_t i = 0; i < n; i++)
		value[i] = sin(9 * x[0][i] + 4 * x[1][i]);
	for (int t = 1; t <= 3; t++) {
		pm_threads_use(t);
		add(&o, &found);
		if (t == 1)
			memcpy(one, rate, sizeof one), first = found;
		check(!memcmp(one, rate, sizeof one) && found.fastest == first.fastest && found.widened == first.widened, "the same bytes with %d threads", t);
	}
}

int main(void)
{
	polynomials();
	differences();
	images();
	stuck();
	threads();
	return check_done();
}
