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

/* widest: the reach of the cell list over that of the method. */
static int add_fields(const struct pm_dc *o, double widest, int fields, const double *const values[], double *const rates[], struct pm_dc_found *found)
{
	struct pm_cell_list l;
	const double *at[3] = {x[0], x[1], x[2]};
	int status = pm_cell_list_init(&l, &domain, n, at, o->reach * widest, o->eps);
	if (!status)
		status = pm_dc_add(o, &l, 1, fields, values, rates, found);
	pm_cell_list_free(&l);
	return status;
}

static int add_within(const struct pm_dc *o, double widest, struct pm_dc_found *found)
{
	const double *values[] = {value};
	double *rates[] = {rate};
	memset(rate, 0, sizeof rate);
	return add_fields(o, widest, 1, values, rates, found);
}

static int add(const struct pm_dc *o, struct pm_dc_found *found) { return add_within(o, pm_dc_widest, found); }

static struct pm_dc method(int dim, int order, double eps)
{
	return (struct pm_dc){.dim = dim, .order = order, .eps = eps, .reach = eps * pm_dc_cutoff(order)};
}

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

/* (a x + b y + c z + 1/2)^k: its Laplacian is k (k-1) (a^2 + b^2 + c^2) of the power two below. All powers with the weights of one solution. */
static void polynomials(void)
{
	static double power[8][MOST], changes[8][MOST];
	static const double *const values[8] = {power[0], power[1], power[2], power[3], power[4], power[5], power[6], power[7]};
	static double *const rates[8] = {changes[0], changes[1], changes[2], changes[3], changes[4], changes[5], changes[6], changes[7]};
	static const double a[3] = {0.7, -0.4, 0.5};
	static const size_t sides[] = {40, 16, 8};
	for (int dim = 1; dim <= 3; dim++)
		for (int order = 2; order <= 6; order += 2) {
			struct pm_dc_found found;
			double worst = 0, a2 = 0;
			const size_t side = order == 6 && dim == 3 ? 6 : sides[dim - 1]; /* 216 points: 119 moments of each take long */
			points(dim, side, 0.3);
			struct pm_dc o = method(dim, order, 1 / (double)side);
			for (int d = 0; d < dim; d++)
				a2 += a[d] * a[d];
			for (size_t i = 0; i < n; i++) {
				value[i] = 0.5;
				for (int d = 0; d < dim; d++)
					value[i] += a[d] * x[d][i];
				for (int k = 0; k <= order + 1; k++)
					power[k][i] = pow(value[i], k);
			}
			memset(changes, 0, sizeof changes);
			int status = add_fields(&o, pm_dc_widest, order + 2, values, rates, &found);
			for (size_t i = 0; i < n && !status; i++)
				for (int k = 0; k <= order + 1; k++)
					check_worst(&worst, fabs(changes[k][i] - (k < 2 ? 0 : k * (k - 1) * a2 * pow(value[i], k - 2))));
			worst = status ? NAN : worst;
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
		/* the window of second neighbours is exp(-14) of that of the first */
		struct pm_dc o = {.dim = dim, .order = 2, .eps = h / 2.2, .reach = 2.5 * h};
		for (size_t i = 0; i < n; i++)
			value[i] = sin(7 * x[0][i]) * (dim > 1 ? cos(5 * x[1][i]) : 1) * (dim > 2 ? 1 + x[2][i] : 1);
		for (int d = 0; d < dim; d++, stride *= m)
			middle += m / 2 * stride;
		stride = 1;
		for (int d = 0; d < dim; d++, stride *= m)
			want += (value[middle + stride] - 2 * value[middle] + value[middle - stride]) / (h * h);
		int status = add_within(&o, 1, &found); /* else it widens until far partners count */
		check(!status, "the lattice determines the moments");
		check_near(rate[middle], want, 1e-2 * fabs(want), "F10: a narrow window on a lattice gives the second differences");
	}
}

/* As many partners as moments leave no choice: the differences of the textbook, whatever the window. */
static void stencils(void)
{
	static const double centred[3][7] = {{0, 0, -1 / 2., 0, 1 / 2., 0, 0}, {0, 1 / 12., -8 / 12., 0, 8 / 12., -1 / 12., 0},
		{-1 / 60., 9 / 60., -45 / 60., 0, 45 / 60., -9 / 60., 1 / 60.}};
	static const double below[3][7] = {{0, 1 / 2., -4 / 2., 3 / 2., 0, 0, 0}}; /* order 2, one side */
	points(1, 40, 0);
	for (size_t i = 0; i < n; i++)
		value[i] = sin(7 * x[0][i]) + x[0][i];
	for (int side = -1; side <= 1; side++)
		for (int order = 2; order <= (side ? 2 : 6); order += 2) {
			const struct pm_dc o = {.dim = 1, .order = order, .power = {1}, .eps = 0.05, .side = side,
				.reach = (side ? 2.5 : order / 2 + 0.5) / 40};
			struct pm_dc_found found;
			double want = 0, middle[7];
			domain.face[0][0] = domain.face[0][1] = PM_PERIODIC; /* so that no particle is without partners */
			int status = add_within(&o, 1, &found);
			memcpy(middle, value + 17, sizeof middle);
			for (int k = 0; k < 7; k++)
				want += 40 * (side ? -side * below[0][side < 0 ? k : 6 - k] : centred[order / 2 - 1][k]) * middle[k];
			check(!status, "order %d, side %d: the lattice determines the moments", order, side);
			check(fabs(rate[20] - want) < 1e-11, "F10: the stencil of order %d on side %d (%.17g, not %.17g)", order, side, rate[20], want);
		}
}

/* Every derivative of degree 1 to 4 of a polynomial of degree order + degree - 1, on moved points, from all partners or one side's. */
static void derivatives(void)
{
	static const int powers[][3] = {{1, 0}, {0, 1}, {1, 1}, {0, 2}, {2, 1}, {3, 0}, {2, 2}};
	static const double a[2] = {0.7, -0.4};
	struct pm_dc_found found;
	points(2, 20, 0.3);
	for (size_t t = 0; t < sizeof powers / sizeof *powers; t++)
		for (int side = -1; side <= 1; side++) {
			const int degree = powers[t][0] + powers[t][1], order = side ? 2 : 4, k = order + degree - 1;
			struct pm_dc o = method(2, order, side ? 0.075 : 0.05);
			double factor = 1, worst = 0;
			memcpy(o.power, powers[t], sizeof o.power);
			o.side = side, o.axis = 1;
			for (int d = 0; d < 2; d++) /* one side alone needs points there: periodic, and the middle is looked at */
				domain.face[d][0] = domain.face[d][1] = side ? PM_PERIODIC : PM_OPEN;
			for (int i = 0; i < degree; i++)
				factor *= (k - i) * a[i >= powers[t][0]];
			for (size_t i = 0; i < n; i++)
				value[i] = pow(0.5 + a[0] * x[0][i] + a[1] * x[1][i], k);
			int status = add(&o, &found);
			for (size_t i = 0; i < n && !status; i++)
				if (!side || (fabs(x[0][i] - 0.5) < 0.04 && fabs(x[1][i] - 0.5) < 0.04))
					check_worst(&worst, fabs(rate[i] - factor * pow(0.5 + a[0] * x[0][i] + a[1] * x[1][i], k - degree)));
			check(!status && worst < 1e-6 && worst > 0, "side %d: the derivative %d%d of a polynomial of degree %d (%.2g)", side, powers[t][0],
				powers[t][1], k, status ? NAN : worst); /* rounding over eps^4: 1e-16 1.6e5 times weights of 1e3 */
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
	stencils();
	derivatives();
	images();
	stuck();
	threads();
	return check_done();
}
