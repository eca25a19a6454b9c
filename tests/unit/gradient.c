/* Mesh operators: waves against the modified wave number of each stencil, polynomials at open faces, identities, orders.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fft/axis-transform.h"
#include "mesh/gradient.h"

static struct pm_grid grid(int dim, const size_t cells[3], const enum pm_face face[3][2])
{
	struct pm_grid g = {.dim = dim, .cells = {1, 1, 1}, .points = {1, 1, 1}, .h = {1, 1, 1}};
	static const double h[3] = {0.7, 0.55, 1.3};
	for (int d = 0; d < 3; d++)
		for (int side = 0; side < 2 && d < dim; side++) {
			g.cells[d] = cells[d], g.h[d] = h[d];
			g.face[d][side] = face[d][side];
			g.points[d] = cells[d] + (face[d][0] != PM_PERIODIC);
		}
	return g;
}

static struct pm_grid box(int dim, size_t nx, size_t ny, size_t nz, enum pm_face fx, enum pm_face fy, enum pm_face fz)
{
	return grid(dim, (size_t[]){nx, ny, nz}, (const enum pm_face[3][2]){{fx, fx}, {fy, fy}, {fz, fz}});
}

static int apply(const struct pm_grid *g, enum pm_operator_kind kind, int order, int in, bool flow, double factor, const double *const from[],
	double *const to[])
{
	struct pm_operator o;
	struct pm_fft_plans p = {0};
	int status = pm_operator_init(&o, g, kind, order, in, flow);
	if (!status)
		status = pm_operator_plan(&o, &p);
	if (!status)
		status = pm_operator_apply(&o, factor, from, to, NULL);
	pm_fft_plans_clear(&p);
	return status;
}

static double *field(size_t n) { return calloc(n, sizeof(double)); }

static double *noise(size_t n, uint64_t seed)
{
	double *s = field(n), u[2];
	for (size_t i = 0; i < n; i++) {
		pm_random(seed, i, 7, u);
		s[i] = u[0] - 0.5;
	}
	return s;
}

/* The modified wave number [1/h] of a stencil of the first derivative, and the eigenvalue of the second. */
static double seen(int order, double t)
{
	double s = sin(t), c = 1 - cos(t);
	return order == 2 ? s : order == 4 ? s * (1 + c / 3) : order == 6 ? s * (1 + c / 3 + 2 * c * c / 15) : t;
}

static double seen_second(int order, double t)
{
	double c = 2 * (1 - cos(t));
	return order == 2 ? -c : order == 4 ? -c * (1 + c / 12) : order == 6 ? -c * (1 + c / 12 + c * c / 90) : -t * t;
}

/* A wave along axis d that the faces allow: value and derivative with the modified wave number `seen`. */
static void waves(size_t n, const enum pm_face ends[2], int order, double *worst)
{
	double period = ends[0] == PM_PERIODIC ? (double)n : 2.0 * (double)n, half = ends[0] == ends[1] ? 0 : 0.5;
	for (int d = 0; d < 3; d++) {
		size_t cells[3] = {3, 4, 5};
		cells[d] = n;
		enum pm_face f[3][2] = {{PM_PERIODIC, PM_PERIODIC}, {PM_PERIODIC, PM_PERIODIC}, {PM_PERIODIC, PM_PERIODIC}};
		f[d][0] = ends[0], f[d][1] = ends[1];
		struct pm_grid g = grid(3, cells, f);
		size_t total = pm_grid_size(&g), stride = d == 0 ? 1 : d == 1 ? g.points[0] : g.points[0] * g.points[1];
		double *s = field(total), *out[3] = {field(total), field(total), field(total)};
		for (double m = half; 2 * m < period; m += n > 10 ? 5 : 1) {
			double theta = 2 * pm_pi * m / period, shift = ends[0] == PM_WALL ? -pm_pi / 2 : ends[0] == PM_NEUMANN ? 0 : 0.4;
			for (size_t i = 0; i < total; i++)
				s[i] = cos(theta * (double)(i / stride % g.points[d]) + shift);
			*worst = apply(&g, PM_OP_GRAD, order, 1, false, 2.0, (const double *[]){s}, out) ? NAN : *worst;
			for (size_t i = 0; i < total; i++) {
				double want = -2 * seen(order, theta) / g.h[d] * sin(theta * (double)(i / stride % g.points[d]) + shift);
				check_worst(worst, fabs(out[d][i] - want));
				check_worst(worst, fabs(out[(d + 1) % 3][i]));
			}
			apply(&g, PM_OP_LAP, order, 1, false, 1, (const double *[]){s}, out);
			for (size_t i = 0; i < total; i++)
				check_worst(worst, fabs(out[0][i] - seen_second(order, theta) / (g.h[d] * g.h[d]) * s[i]));
		}
		free(s), free(out[0]), free(out[1]), free(out[2]);
	}
}

static void all_waves(void)
{
	static const size_t n[] = {1, 2, 3, 5, 6, 7, 33};
	static const enum pm_face ends[][2] = {{PM_PERIODIC, PM_PERIODIC}, {PM_WALL, PM_WALL}, {PM_NEUMANN, PM_NEUMANN}, {PM_WALL, PM_NEUMANN},
		{PM_NEUMANN, PM_WALL}};
	for (int order = 0; order <= 6; order += 2)
		for (int kind = 0; kind < 5; kind++) {
			double worst = 0;
			for (size_t i = 0; i < sizeof n / sizeof *n; i++)
				waves(n[i], ends[kind], order, &worst);
			char name[120];
			snprintf(name, sizeof name, "order %d, %s-%s: grad and lap of every wave have the eigenvalues of the stencil, n = 1 to 33, every "
				"axis", order, pm_face_names[ends[kind][0]], pm_face_names[ends[kind][1]]);
			/* round-off of k up to pi/0.55 over 33 nodes, some ten operations; images reach a wave's phase through 33*pi */
			check_near(worst, 0, order ? 2e-13 : 1e-12, name);
		}
}

static void polynomials(void)
{
	for (int order = 2; order <= 6; order += 2) {
		double worst = 0, worst2 = 0;
		for (int power = 0; power <= order + 1; power++) {
			struct pm_grid g = box(2, 11, 10, 1, PM_OPEN, PM_OPEN, 0);
			double *s = field(132), *out[2] = {field(132), field(132)};
			for (int i = 0; i < 132; i++)
				s[i] = pow((i % 12) * g.h[0] - 3, power) - 2 * pow((i / 12) * g.h[1] - 2, power);
			apply(&g, PM_OP_GRAD, order, 1, false, 1, (const double *[]){s}, out);
			for (int i = 0; i < 132 && power <= order; i++) {
				double x = (i % 12) * g.h[0] - 3, y = (i / 12) * g.h[1] - 2;
				double dx = power ? power * pow(x, power - 1) : 0, dy = power ? -2 * power * pow(y, power - 1) : 0;
				check_worst(&worst, fabs(out[0][i] - dx) / pow(5, power)), check_worst(&worst, fabs(out[1][i] - dy) / pow(5, power));
			}
			apply(&g, PM_OP_LAP, order, 1, false, 1, (const double *[]){s}, out);
			for (int i = 0; i < 132; i++) {
				double x = (i % 12) * g.h[0] - 3, y = (i / 12) * g.h[1] - 2;
				double want = power > 1 ? power * (power - 1) * (pow(x, power - 2) - 2 * pow(y, power - 2)) : 0;
				check_worst(&worst2, fabs(out[0][i] - want) / pow(5, power));
			}
			free(s), free(out[0]), free(out[1]);
		}
		char name[100];
		snprintf(name, sizeof name, "order %d, open: exact for polynomials of degree %d up to the ends", order, order);
		check_near(worst, 0, 1e-12, name); /* one-sided weights of order 6 add up to some hundred times 1/h */
		snprintf(name, sizeof name, "order %d, open: lap exact on degree %d", order, order + 1);
		check_near(worst2, 0, 1e-11, name);
	}
}

static void identities(void)
{
	struct pm_grid g = box(3, 9, 8, 7, PM_PERIODIC, PM_WALL, PM_NEUMANN);
	size_t n = pm_grid_size(&g);
	double *phi = noise(n, 1), *a[3] = {field(n), field(n), field(n)}, *b[3] = {field(n), field(n), field(n)};
	for (size_t i = 0; i < n; i++)
		if (i / 9 % 9 == 0 || i / 9 % 9 == 8)
			phi[i] = 0;
	for (int order = 0; order <= 6; order += 2) {
		double worst = 0;
		apply(&g, PM_OP_GRAD, order, 1, false, 1, (const double *[]){phi}, a);
		apply(&g, PM_OP_CURL, order, 3, false, 1, (const double *const *)a, b);
		for (size_t i = 0; i < n; i++)
			check_worst(&worst, fabs(b[0][i])), check_worst(&worst, fabs(b[1][i])), check_worst(&worst, fabs(b[2][i]));
		char name[100];
		snprintf(name, sizeof name, "order %d: curl grad = 0 at periodic, wall and neumann faces", order);
		check_near(worst, 0, 1e-13 * 20, name); /* values of size 10 */
		worst = 0;
		for (int c = 0; c < 3; c++)
			memcpy(a[c], phi, n * sizeof **a);
		struct pm_grid p = box(3, 9, 9, 8, PM_PERIODIC, PM_PERIODIC, PM_PERIODIC);
		apply(&p, PM_OP_CURL, order, 3, false, 1, (const double *const *)a, b);
		apply(&p, PM_OP_DIV, order, 3, false, 1, (const double *const *)b, a);
		for (size_t i = 0; i < n; i++)
			check_worst(&worst, fabs(a[0][i]));
		snprintf(name, sizeof name, "order %d: div curl = 0", order);
		check_near(worst, 0, 1e-13 * 20, name);
		double *q = noise(n, 2), sum = 0, scale = 0;
		apply(&p, PM_OP_GRAD, order, 1, false, 1, (const double *[]){phi}, a);
		apply(&p, PM_OP_GRAD, order, 1, false, 1, (const double *[]){q}, b);
		for (size_t i = 0; i < n; i++)
			sum += q[i] * a[2][i] + phi[i] * b[2][i], scale += fabs(q[i] * a[2][i]);
		snprintf(name, sizeof name, "order %d: the first derivative is antisymmetric", order);
		check_near(sum / scale, 0, 1e-14, name);
		free(q);
	}
	struct pm_grid w = box(2, 12, 9, 1, PM_WALL, PM_WALL, 0);
	double u[2][130], psi[130], lap[130], omega[130], *to[2] = {u[0], u[1]}, worst = 0, through = 0;
	for (int i = 0; i < 130; i++)
		psi[i] = sin(3 * pm_pi * (i % 13) / 12) * sin(2 * pm_pi * (i / 13) / 9.0);
	apply(&w, PM_OP_CURL, 0, 1, true, 1, (const double *[]){psi}, to);
	apply(&w, PM_OP_CURL, 0, 2, true, 1, (const double *[]){u[0], u[1]}, (double *[]){omega});
	apply(&w, PM_OP_LAP, 0, 1, false, 1, (const double *[]){psi}, (double *[]){lap});
	for (int i = 0; i < 130; i++) {
		check_worst(&worst, fabs(omega[i] + lap[i]));
		if (i % 13 == 0 || i % 13 == 12)
			check_worst(&through, fabs(u[0][i]));
	}
	check_near(worst, 0, 1e-12, "2-D: curl of (d psi/dy, -d psi/dx) is -lap psi between walls");
	check_near(through, 0, 1e-13, "2-D: no flow through a wall (S4-T6)");
	double still[130], *flat[1] = {still}, c[130], *cs[1] = {c};
	for (int i = 0; i < 130; i++)
		c[i] = 2.385;
	struct pm_grid line = box(1, 130, 1, 1, PM_PERIODIC, 0, 0);
	for (int order = 2; order <= 6; order += 2) {
		apply(&line, PM_OP_GRAD, order, 1, false, 1, (const double *const *)cs, flat);
		worst = 0;
		for (int i = 0; i < 130; i++)
			check_worst(&worst, fabs(still[i]));
		check(worst == 0, "order %d: the gradient of a constant is exactly zero", order);
	}
	free(phi);
	for (int k = 0; k < 3; k++)
		free(a[k]), free(b[k]);
}

/* Orders on three grids, for a smooth field that respects the faces only where they are open or periodic. */
static void orders(void)
{
	for (int kind = PM_OP_GRAD; kind <= PM_OP_LAP; kind += PM_OP_LAP)
		for (int order = 2; order <= 6; order += 2)
			for (enum pm_face face = PM_PERIODIC; face <= PM_NEUMANN; face++) {
				double h[3], error[3] = {0};
				for (int l = 0; l < 3; l++) {
					size_t n = (face == PM_OPEN && kind == PM_OP_LAP ? 24u : 48u) << l; /* one-sided weights reach round-off sooner */
					struct pm_grid g = box(1, n, 1, 1, face, 0, 0);
					g.h[0] = h[l] = 2 / (double)n;
					double s[200], out[200], scale = face == PM_OPEN ? pm_pi / 2 : pm_pi;
					for (size_t i = 0; i < g.points[0]; i++) {
						double x = scale * (double)i * h[l];
						s[i] = face == PM_NEUMANN ? exp(cos(x)) : face == PM_OPEN ? exp(sin(x + 1)) : sinh(sin(x));
					}
					apply(&g, kind, order, 1, false, 1, (const double *[]){s}, (double *[]){out});
					for (size_t i = 0; i < g.points[0]; i++) {
						double x = scale * (double)i * h[l] + (face == PM_OPEN), want;
						if (face == PM_NEUMANN)
							want = kind == PM_OP_GRAD ? -sin(x) * s[i] : (sin(x) * sin(x) - cos(x)) * s[i];
						else if (face == PM_OPEN)
							want = kind == PM_OP_GRAD ? cos(x) * s[i] : (cos(x) * cos(x) - sin(x)) * s[i];
						else
							want = kind == PM_OP_GRAD ? cos(x) * cosh(sin(x)) : cos(x) * cos(x) * s[i] - sin(x) * cosh(sin(x));
						check_worst(&error[l], fabs(out[i] - want * pow(scale, kind == PM_OP_GRAD ? 1 : 2)));
					}
				}
				char name[80];
				snprintf(name, sizeof name, "%s of order %d with %s faces", pm_operator_names[kind], order, pm_face_names[face]);
				check_order(3, h, error, order, name);
			}
}

/* Meshes above 2^20 points, whose rows are written past the caches: a product of waves that the faces allow, compared with the eigenvalues of the stencils. */
static void large(int dim, size_t nx, size_t ny, size_t nz)
{
	struct pm_grid g = box(dim, nx, ny, nz, PM_PERIODIC, PM_WALL, dim > 2 ? PM_NEUMANN : PM_PERIODIC);
	size_t n = pm_grid_size(&g);
	double *s = field(n), *out[3] = {field(n), field(n), field(n)}, *wave[3], *slope[3], theta[3];
	check(n > (size_t)1 << 20, "%d-D: %zu points", dim, n);
	for (int d = 0; d < 3; d++) {
		wave[d] = field(g.points[d]), slope[d] = field(g.points[d]);
		theta[d] = d >= dim ? 0 : (g.face[d][0] == PM_PERIODIC ? 2 : 1) * pm_pi * 7 / (double)g.cells[d];
		double shift = d >= dim ? 0 : g.face[d][0] == PM_PERIODIC ? 0.4 : g.face[d][0] == PM_WALL ? -pm_pi / 2 : 0;
		for (size_t i = 0; i < g.points[d]; i++)
			wave[d][i] = cos(theta[d] * (double)i + shift), slope[d][i] = -sin(theta[d] * (double)i + shift);
	}
	for (size_t i = 0; i < n; i++)
		s[i] = wave[0][i % g.points[0]] * wave[1][i / g.points[0] % g.points[1]] * wave[2][i / g.points[0] / g.points[1]];
	for (int order = 2; order <= 6; order += 2) {
		double worst[2] = {0}, second = 0;
		bool bad = apply(&g, PM_OP_GRAD, order, 1, false, 2, (const double *[]){s}, out);
		for (size_t i = 0; i < n; i++) {
			const size_t at[3] = {i % g.points[0], i / g.points[0] % g.points[1], i / g.points[0] / g.points[1]};
			for (int d = 0; d < dim; d++) {
				double want = 2 * seen(order, theta[d]) / g.h[d];
				for (int e = 0; e < 3; e++)
					want *= e == d ? slope[e][at[e]] : wave[e][at[e]];
				check_worst(&worst[0], fabs(out[d][i] - want));
			}
		}
		for (int d = 0; d < dim; d++)
			second += seen_second(order, theta[d]) / (g.h[d] * g.h[d]);
		bad = apply(&g, PM_OP_LAP, order, 1, false, 1, (const double *[]){s}, out) || bad;
		for (size_t i = 0; i < n; i++)
			check_worst(&worst[1], fabs(out[0][i] - second * s[i]));
		/* phases up to 45, known to 7e-15, and ten operations of size 1/h^2 = 3 */
		check(!bad && worst[0] <= 2e-13 && worst[1] <= 2e-13,
			"order %d, %zux%zux%zu: grad and lap are those of the stencil (off by %.2g, %.2g, tolerance 2e-13)", order, nx, ny, nz,
			worst[0], worst[1]);
	}
	free(s);
	for (int d = 0; d < 3; d++)
		free(out[d]), free(wave[d]), free(slope[d]);
}

/* Sums in registers beside those of the taps one after the other, to which `add` leads: written past the caches and, of the first planes alone, not. */
static void by_registers(enum pm_face x, size_t nx, size_t nz)
{
	struct pm_grid g = box(3, nx, 101, nz, x, PM_PERIODIC, PM_OPEN);
	const size_t n = pm_grid_size(&g);
	double *in[3] = {noise(n, 11), noise(n, 12), noise(n, 13)}, *fast[3] = {field(n), field(n), field(n)}, *slow[3];
	const double *const from[3] = {in[0], in[1], in[2]};
	for (int order = 2; order <= 6; order += 2)
		for (enum pm_operator_kind kind = PM_OP_GRAD; kind <= PM_OP_LAP; kind++) {
			struct pm_operator o;
			bool seen = false, same = true, spoiled = true;
			const int components = kind == PM_OP_CURL || kind == PM_OP_DIV ? 3 : 1;
			for (int c = 0; c < 3; c++)
				slow[c] = field(n);
			bool bad = pm_operator_init(&o, &g, kind, order, components, false) || pm_operator_apply(&o, 0.7, from, fast, &seen);
			o.add = true;
			bad = bad || pm_operator_apply(&o, 0.7, from, slow, NULL);
			for (int c = 0; c < o.out; c++)
				for (size_t i = 0; i < n; i++)
					same = same && fast[c][i] == slow[c][i];
			o.add = false;
			in[0][n / 2 + 1] = INFINITY;
			bad = bad || pm_operator_apply(&o, 0.7, from, slow, &spoiled);
			in[0][n / 2 + 1] = 0.25;
			check(!bad && same && seen && !spoiled, "%s, order %d, %zux101x%zu, %s: sums in registers are those of the taps one by one, and "
				"infinity is found", pm_operator_names[kind], order, nx, nz, pm_face_names[x]);
			for (int c = 0; c < 3; c++)
				free(slow[c]);
		}
	for (int c = 0; c < 3; c++)
		free(in[c]), free(fast[c]);
}

static void threads(void)
{
	struct pm_grid g = box(3, 33, 18, 20, PM_PERIODIC, PM_WALL, PM_NEUMANN);
	size_t n = pm_grid_size(&g);
	double *s = noise(n, 5), *a[3] = {field(n), field(n), field(n)}, *b[3] = {field(n), field(n), field(n)};
	bool same = true;
	for (int order = 0; order <= 6; order += 2)
		for (int t = 1; t <= 3; t++) {
			pm_threads_use(t);
			apply(&g, PM_OP_GRAD, order, 1, false, 1.7, (const double *[]){s}, t == 1 ? a : b);
			for (int c = 0; c < 3 && t > 1; c++)
				same = same && !memcmp(a[c], b[c], n * sizeof **a);
		}
	check(same, "the same bytes with 1, 2 and 3 threads");
	free(s);
	for (int c = 0; c < 3; c++)
		free(a[c]), free(b[c]);
}

static void refusals(void)
{
	struct pm_operator o;
	struct pm_grid g = box(2, 4, 9, 1, PM_OPEN, PM_OPEN, 0), m = box(1, 9, 1, 1, PM_WALL, 0, 0);
	check(pm_operator_init(&o, &g, PM_OP_GRAD, 6, 1, false) == -PM_DATA && strstr(pm_message(), "lower --order"), "too few nodes at an open face: %s",
		pm_message());
	check(pm_operator_init(&o, &g, PM_OP_GRAD, 0, 1, false) == -PM_DATA && strstr(pm_message(), "--order 2, 4 or 6"), "spectral at an open face: %s",
		pm_message());
	check(pm_operator_init(&o, &m, PM_OP_CURL, 2, 1, false) == -PM_DATA, "curl in 1-D: %s", pm_message());
}

int main(void)
{
	all_waves();
	polynomials();
	identities();
	orders();
	large(2, 1031, 1020, 1);
	large(3, 103, 101, 102);
	by_registers(PM_WALL, 101, 102);
	by_registers(PM_PERIODIC, 104, 103);
	by_registers(PM_OPEN, 25, 7);
	by_registers(PM_PERIODIC, 24, 7);
	threads();
	refusals();
	return check_done();
}
