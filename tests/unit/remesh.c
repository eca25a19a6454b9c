/* Remeshing on plain arrays: totals at every face, moments, a thousand remeshes (HC-41), the damping of waves (RM-01), overshoots (HC-43), the
 * cut-off, any number of threads; and the distortion of lattices. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "remesh/distortion.h"
#include "remesh/remesh.h"

static const enum pm_face faces[][2] = {{PM_PERIODIC, PM_PERIODIC}, {PM_WALL, PM_WALL}, {PM_NEUMANN, PM_WALL}, {PM_OPEN, PM_OPEN}};
enum { RULES = sizeof faces / sizeof *faces };

/* Awkward origin and spacing. */
static struct pm_grid grid_of(int dim, const size_t cells[3], int rule)
{
	struct pm_grid g = {.dim = dim};
	for (int d = 0; d < 3; d++) {
		bool used = d < dim;
		g.cells[d] = used ? cells[d] : 1;
		g.lo[d] = used ? -0.3 - d / 10. : 0;
		g.h[d] = used ? (const double[]){0.7, 0.55, 0.9}[d] : 1;
		for (int side = 0; side < 2; side++)
			g.face[d][side] = used ? faces[(rule + d) % RULES][side] : PM_PERIODIC;
		g.points[d] = used && g.face[d][0] != PM_PERIODIC ? g.cells[d] + 1 : g.cells[d];
	}
	return g;
}

struct particles {
	size_t n;
	double *x[3], *q;
};

static struct particles particles_new(size_t n)
{
	struct particles p = {.n = n, .q = pm_zalloc(n, sizeof(double))};
	for (int d = 0; d < 3; d++)
		p.x[d] = pm_zalloc(n, sizeof(double));
	return p;
}

static void particles_free(struct particles *p)
{
	for (int d = 0; d < 3; d++)
		pm_free(p->x[d]);
	pm_free(p->q);
}

static double uniform(uint64_t id, int what)
{
	double u[2];
	pm_random(11, id, (uint64_t)what, u);
	return u[0];
}

/* Random positions inside the mesh, also at closed faces; strengths of both signs. */
static struct particles scattered(const struct pm_grid *g, const struct pm_kernel *k, size_t n)
{
	struct particles p = particles_new(n);
	for (size_t i = 0; i < n; i++) {
		p.q[i] = 2 * uniform(i, 9) - 0.7;
		for (int d = 0; d < g->dim; d++) {
			bool open = g->face[d][0] == PM_OPEN;
			double low = open ? 0.5 * k->width + 1e-9 : 0, high = (double)g->cells[d] - low, u = i % 16 ? uniform(i, d) : (double)(i % 32 > 0);
			p.x[d][i] = g->lo[d] + g->h[d] * (low + u * (high - low));
		}
	}
	return p;
}

static const double *const *in(double *const *rows) { return (const double *const *)rows; }

static struct pm_remesh remeshed(const struct pm_grid *g, const struct pm_kernel *k, const struct particles *p, double cut_off)
{
	struct pm_remesh r = pm_remesh_on(g, k);
	struct pm_strays strays;
	const double *q = p->q;
	if (pm_remesh_add(&r, p->n, in(p->x), 1, &q, true, &strays) || strays.count || pm_remesh_keep(&r, cut_off, 0))
		check(false, "%s: %s", k->name, pm_message());
	return r;
}

/* One particle on every node. */
static struct particles taken(const struct pm_remesh *r)
{
	struct particles p = particles_new(r->kept);
	pm_remesh_value(r, 0, p.q);
	for (int d = 0; d < r->grid.dim; d++)
		pm_remesh_position(r, d, p.x[d]);
	return p;
}

static double size_of(const struct particles *p)
{
	double sum = 0;
	for (size_t i = 0; i < p->n; i++)
		sum += fabs(p->q[i]);
	return sum;
}

static void check_totals(int dim, const size_t cells[3])
{
	for (int k = 0; pm_kernels[k]; k++) {
		double worst = 0;
		for (int rule = 0; rule < RULES; rule++) {
			struct pm_grid g = grid_of(dim, cells, rule);
			struct particles p = scattered(&g, pm_kernels[k], 400);
			struct pm_remesh r = remeshed(&g, pm_kernels[k], &p, 0);
			struct particles q = taken(&r);
			check_worst(&worst, fabs(pm_sum_array(q.n, q.q) - pm_sum_array(p.n, p.q)) / size_of(&p));
			particles_free(&p), particles_free(&q), pm_remesh_free(&r);
		}
		check(worst <= 1e-15, "%s, %d-D: the total strength is kept at periodic, wall, neumann and open faces (off by %.2g of the sum of absolute "
			"strengths, tolerance 1e-15)", pm_kernels[k]->name, dim, worst);
	}
}

/* sum q prod_d x_d^power_d, in cells about the middle. */
static double moment(const struct pm_grid *g, const struct particles *p, const int power[2], double *size)
{
	struct pm_sum sum = {0, 0};
	*size = 0;
	for (size_t i = 0; i < p->n; i++) {
		double term = p->q[i];
		for (int d = 0; d < 2; d++)
			term *= pow((p->x[d][i] - g->lo[d]) / g->h[d] - 0.5 * (double)g->cells[d], power[d]);
		pm_sum_add(&sum, term);
		*size += fabs(term);
	}
	return pm_sum_total(sum);
}

/* Tensor products: every power up to the kernel's along each axis at once; a star: along one axis. The next one is not conserved. */
static void check_moments(void)
{
	for (int k = 0; pm_kernels[k]; k++) {
		struct pm_grid g = grid_of(2, (const size_t[]){15, 14, 1}, 3);
		g.face[1][0] = g.face[1][1] = PM_OPEN, g.points[1] = 15;
		struct particles p = scattered(&g, pm_kernels[k], 300);
		struct pm_remesh r = remeshed(&g, pm_kernels[k], &p, 0);
		struct particles q = taken(&r);
		double worst = 0, size, m = pm_kernels[k]->moments;
		for (int a = 0; a <= m; a++)
			for (int b = 0; b <= (pm_kernels[k]->star && a ? 0 : m); b++) {
				double before = moment(&g, &p, (const int[]){a, b}, &size), after = moment(&g, &q, (const int[]){a, b}, &size);
				check_worst(&worst, fabs(after - before) / size);
			}
		double before = moment(&g, &p, (const int[]){(int)m + 1, 0}, &size), after = moment(&g, &q, (const int[]){(int)m + 1, 0}, &size);
		check(worst <= 1e-13 && fabs(after - before) > 1e-9 * size,
			"%s keeps the moments up to %g along each axis (off by %.2g, tolerance 1e-13), not the "
			"next (off by %.2g)", pm_kernels[k]->name, m, worst, fabs(after - before) / size);
		particles_free(&p), particles_free(&q), pm_remesh_free(&r);
	}
}

/* Particles are the nodes, moved by shift[] cells, folded. */
static void shift_all(const struct pm_grid *g, struct particles *p, const double shift[3])
{
	for (int d = 0; d < g->dim; d++)
		for (size_t i = 0; i < p->n; i++) {
			double length = g->h[d] * (double)g->cells[d];
			p->x[d][i] += shift[d] * g->h[d];
			if (p->x[d][i] >= g->lo[d] + length)
				p->x[d][i] -= length;
		}
}

static struct particles lattice(const struct pm_grid *g, double q)
{
	struct particles p = particles_new(pm_grid_size(g));
	for (size_t i = 0; i < p.n; i++) {
		const size_t at[3] = {i % g->points[0], i / g->points[0] % g->points[1], i / g->points[0] / g->points[1]};
		p.q[i] = q;
		for (int d = 0; d < g->dim; d++)
			p.x[d][i] = g->lo[d] + (double)at[d] * g->h[d];
	}
	return p;
}

static void check_thousand(int dim, const size_t cells[3])
{
	for (int k = 0; pm_kernels[k]; k++) {
		struct pm_grid g = grid_of(dim, cells, 0);
		for (int d = 0; d < dim; d++)
			g.face[d][0] = g.face[d][1] = PM_PERIODIC, g.points[d] = g.cells[d];
		const double value = 2.385;
		struct particles p = lattice(&g, value);
		double total = pm_sum_array(p.n, p.q), worst = 0;
		size_t n = p.n;
		for (int pass = 0; pass < 1000 && p.n == n; pass++) {
			const double shift[3] = {uniform((uint64_t)pass, 0), uniform((uint64_t)pass, 1), uniform((uint64_t)pass, 2)};
			shift_all(&g, &p, shift);
			struct pm_remesh r = remeshed(&g, pm_kernels[k], &p, 0);
			particles_free(&p);
			p = taken(&r);
			pm_remesh_free(&r);
		}
		for (size_t i = 0; i < p.n; i++)
			check_worst(&worst, fabs(p.q[i] / value - 1));
		double drift = fabs(pm_sum_array(p.n, p.q) / total - 1);
		/* The bounds of the case: rounding errors add up as a random walk. */
		check(p.n == n, "HC-41: %s, %d-D: as many particles after 1000 remeshes", pm_kernels[k]->name, dim);
		check_below(worst, 1e-12 * sqrt(1000), "HC-41: a constant remeshed 1000 times at random shifts by %s, %d-D, stays constant",
			pm_kernels[k]->name, dim);
		check_below(drift, 1e-13, "HC-41: and so does its sum, %s, %d-D", pm_kernels[k]->name, dim);
		particles_free(&p);
	}
}

static struct pm_grid line_of(size_t n)
{
	return (struct pm_grid){.dim = 1, .cells = {n, 1, 1}, .points = {n, 1, 1}, .lo = {-1, 0, 0}, .h = {2. / (double)n, 1, 1}};
}

/* One remesh of a line of n nodes with strengths q, moved by s cells; q is replaced. */
static void remesh_line(const struct pm_kernel *k, size_t n, double s, double *q)
{
	struct pm_grid g = line_of(n);
	struct particles p = lattice(&g, 0);
	memcpy(p.q, q, n * sizeof *q);
	shift_all(&g, &p, (const double[]){s, 0, 0});
	struct pm_remesh r = remeshed(&g, k, &p, 0);
	memcpy(q, r.node[0], n * sizeof *q);
	particles_free(&p), pm_remesh_free(&r);
}

struct rm01 { /* tests/reference/values.csv, RM-01 */
	const char *name;
	double error[2];  /* of one remesh of a Gaussian, N = 64, 128 */
	double shifts[3]; /* amplitude after 100 shifts of 0.3 h at kh = pi/16, pi/8, pi/4 */
};
static const struct rm01 rm01[] = {
	{"cic", {4.489063e-03, 1.135035e-03}, {0.6668793588, 0.1969824138, 0.001411251773}},
	{"tsc", {5.347768e-03, 1.351461e-03}, {0.6174153865, 0.1447912004, 0.0004143175183}},
	{"pcs", {7.124469e-03, 1.801562e-03}, {0.5258042882, 0.07618229684, 3.186958023e-05}},
	{"m4prime", {1.971525e-04, 2.257449e-05}, {0.9975540722, 0.9619883394, 0.5519685161}},
	{"lambda-2-2", {2.937250e-04, 3.587612e-05}, {0.9978152615, 0.9660087992, 0.5894920224}},
	{"m6prime", {1.054591e-05, 3.257318e-07}, {0.9999824009, 0.9988947768, 0.9363965074}},
	{"lambda-6-4", {7.838840e-07, 6.390892e-09}, {0.9999998686, 0.9999672286, 0.9924783294}},
};

static double bump(double x)
{
	x -= 2 * floor((x + 1) / 2);
	return exp(-x * x / (2 * 0.15 * 0.15));
}

static void check_rm01(const struct rm01 *c)
{
	const struct pm_kernel *k = pm_kernel_find(c->name);
	enum { N = 32 };
	double off = 0, q[128];
	for (int m = 0; m < 3; m++) {
		int mode = 1 << m; /* kh = 2 pi mode/32 */
		double re = 0, im = 0;
		for (int i = 0; i < N; i++)
			q[i] = cos(2 * pm_pi * mode * i / N);
		for (int pass = 0; pass < 100; pass++)
			remesh_line(k, N, 0.3, q);
		for (int i = 0; i < N; i++)
			re += q[i] * cos(2 * pm_pi * mode * i / N) * 2 / N, im += q[i] * sin(2 * pm_pi * mode * i / N) * 2 / N;
		check_worst(&off, fabs(hypot(re, im) - c->shifts[m]));
	}
	check(off <= 1e-9, "RM-01: waves remeshed 100 times at shifts of 0.3 h by %s keep the amplitudes of the reference (off by %.2g, tolerance 1e-9)",
		c->name, off);
	off = 0;
	for (int j = 0; j < 2; j++) {
		int n = 64 << j;
		double worst = 0;
		for (int i = 0; i < n; i++)
			q[i] = bump(-1 + 2. * i / n);
		remesh_line(k, (size_t)n, 0.3, q);
		for (int i = 0; i < n; i++)
			check_worst(&worst, fabs(q[i] - bump(-1 + 2. * (i - 0.3) / n)));
		check_worst(&off, fabs(worst / c->error[j] - 1));
	}
	check(off <= 1e-3, "RM-01: one remesh of a Gaussian by %s has the error of the reference (relative %.2g, tolerance 1e-3)", c->name, off);
}

/* HC-43: the worst shift of a unit step; 270 shifts hit the worst of M'4, 1/3 and 2/3. */
static void check_step(const char *name, double want, double tolerance)
{
	enum { N = 32, SHIFTS = 270 };
	double over = 0, under = 0;
	for (int s = 0; s < SHIFTS; s++) {
		double q[N];
		for (int i = 0; i < N; i++)
			q[i] = i >= N / 2;
		remesh_line(pm_kernel_find(name), N, s / (double)SHIFTS, q);
		for (int i = 0; i < N; i++)
			check_worst(&over, q[i] - 1), check_worst(&under, -q[i]);
	}
	check_below(over - want, tolerance, "HC-43: a unit step remeshed once by %s at its worst shift goes %.6g above (want %.6g)", name, over, want);
	check_below(under - want, tolerance, "HC-43: a unit step remeshed once by %s at its worst shift goes %.6g below (want %.6g)", name, under, want);
}

static void check_cut(void)
{
	struct pm_grid g = grid_of(2, (const size_t[]){70, 81, 1}, 0);
	struct particles p = scattered(&g, pm_kernel_find("m6prime"), 2000);
	struct pm_remesh all = remeshed(&g, pm_kernel_find("m6prime"), &p, 0), r = remeshed(&g, pm_kernel_find("m6prime"), &p, 0.01);
	struct particles q = taken(&r);
	double most = 0, least = HUGE_VAL;
	for (size_t i = 0; i < all.points; i++)
		check_worst(&most, fabs(all.node[0][i]));
	for (size_t i = 0; i < q.n; i++)
		check_least(&least, fabs(q.q[i]));
	check(least > 0.01 * most && r.cut > 0 && r.kept + r.cut == all.kept,
		"a cut-off of 0.01 keeps nodes above a hundredth of the largest strength (%zu of %zu)", r.kept, all.kept);
	double off = fabs(pm_sum_array(q.n, q.q) + r.lost[0] - pm_sum_array(p.n, p.q));
	check(off <= 1e-15 * size_of(&p), "the strength removed is counted: kept and removed strength add up to the total (off by %.2g, lost %.3g)", off,
		r.lost[0]);
	particles_free(&p), particles_free(&q), pm_remesh_free(&r), pm_remesh_free(&all);
}

/* Components of one strength share the largest: what is small beside the other component is cut. */
static void check_components(void)
{
	struct pm_grid g = grid_of(1, (const size_t[]){12, 1, 1}, 0);
	struct pm_remesh r = pm_remesh_on(&g, pm_kernel_find("cic"));
	struct pm_strays strays;
	const double at[2] = {g.lo[0] + 3 * g.h[0], g.lo[0] + 7 * g.h[0]}, one[2] = {1, 0}, two[2] = {0, 1e-3};
	int bad = pm_remesh_add(&r, 2, (const double *const[]){at, NULL, NULL}, 2, (const double *const[]){one, two}, true, &strays) || strays.count ||
		pm_remesh_keep(&r, 0.01, 0);
	check(!bad && r.kept == 1, "a cut-off is of the largest component (%zu nodes kept, %zu cut)", r.kept, r.cut);
	pm_remesh_free(&r);
}

static void check_threads(void)
{
	bool same = true;
	struct pm_grid g = grid_of(3, (const size_t[]){37, 31, 33}, 1);
	struct particles p = scattered(&g, pm_kernel_find("m4prime"), 30000), first = {.n = 0};
	double lost = 0;
	for (int threads = 1; threads <= 3; threads++) {
		pm_threads_use(threads);
		struct pm_remesh r = remeshed(&g, pm_kernel_find("m4prime"), &p, 0.2);
		struct particles q = taken(&r);
		if (threads == 1)
			lost = r.lost[0];
		else
			same = same && q.n == first.n && !memcmp(q.q, first.q, q.n * sizeof *q.q) && !memcmp(q.x[2], first.x[2], q.n * sizeof *q.q) &&
				lost == r.lost[0];
		particles_free(&first), pm_remesh_free(&r);
		first = q;
	}
	pm_threads_use(1);
	check(same, "1, 2 and 3 threads give the same bytes, also of the loss");
	particles_free(&p), particles_free(&first);
}

static void check_volume(void)
{
	for (int rule = 0; rule < RULES; rule++) {
		struct pm_grid g = grid_of(3, (const size_t[]){9, 10, 11}, rule);
		struct particles p = lattice(&g, 1);
		for (int d = 0; d < 3; d++)
			if (g.face[d][0] == PM_OPEN)
				g.face[d][0] = g.face[d][1] = PM_NEUMANN; /* so that the end nodes are inside */
		struct pm_remesh r = remeshed(&g, pm_kernel_find("ngp"), &p, 0);
		double *volume = pm_zalloc(r.kept, sizeof *volume), box = 1;
		pm_remesh_volume(&r, volume);
		for (int d = 0; d < 3; d++)
			box *= g.h[d] * (double)g.cells[d];
		check(r.kept == r.points && fabs(pm_sum_array(r.kept, volume) / box - 1) <= 1e-14, "volumes of the nodes add up to the box (faces %d)", rule);
		pm_free(volume);
		particles_free(&p), pm_remesh_free(&r);
	}
}

/* Where a strength stands on every node but some, the nodes that are kept are where these were, rows with all nodes and rows with a few; a cut-off looks at
 * the size of negative ones too. */
static void check_rows(void)
{
	const struct pm_grid g = grid_of(3, (const size_t[]){8, 6, 5}, 0);
	struct particles p = lattice(&g, -1);
	size_t next = 0;
	bool same = true;
	for (size_t i = 0; i < p.n; i++)
		p.q[i] = i > p.n / 2 && i % 7 == 0 ? 0.3 : i % 5 ? -1 : -2;
	struct pm_remesh r = remeshed(&g, pm_kernel_find("ngp"), &p, 0.2);
	struct particles q = taken(&r);
	for (size_t i = 0; i < p.n; i++) {
		if (p.q[i] == 0.3)
			continue;
		for (int d = 0; d < 3 && next < q.n; d++)
			same = same && q.x[d][next] == p.x[d][i];
		same = same && next < q.n && fabs(q.q[next] - p.q[i]) <= 1e-15; /* density and back */
		next++;
	}
	check(same && next == q.n, "nodes that are kept: %zu of %zu, their places to the last bit", q.n, p.n);
	particles_free(&p), particles_free(&q), pm_remesh_free(&r);
}

/* Mean |H - 1| of the lattice after x -> A x about the middle, over the particles of the inner half. */
static double distorted(double a, double b, double c, double d)
{
	enum { N = 48 };
	struct pm_grid g = {.dim = 2, .cells = {N, N, 1}, .points = {N, N, 1}, .lo = {0, 0, 0}, .h = {1, 1, 1}};
	enum { M = 3 * N };
	struct particles p = particles_new((size_t)M * M);
	size_t n = 0, inner = 0;
	for (int j = -M / 2; j < M / 2; j++)
		for (int i = -M / 2; i < M / 2; i++) {
			double x = a * i + b * j + N / 2 + 0.31, y = c * i + d * j + N / 2 + 0.17;
			if (x >= 0 && x < N && y >= 0 && y < N)
				p.x[0][n] = x, p.x[1][n++] = y;
		}
	double sum = 0;
	if (pm_overlap(&g, NULL, n, in(p.x), NULL, p.q))
		return NAN;
	for (size_t i = 0; i < n; i++)
		if (fabs(p.x[0][i] - N / 2.) < N / 4. && fabs(p.x[1][i] - N / 2.) < N / 4.)
			sum += fabs(p.q[i] - 1), inner++;
	particles_free(&p);
	return sum / (double)inner;
}

static void check_distortion(void)
{
	double shifted = distorted(1, 0, 0, 1), turned = 0;
	check(shifted <= 1e-14, "a shifted lattice is not distorted (%.2g, tolerance 1e-14)", shifted);
	for (int angle = 5; angle <= 45; angle += 5) {
		double t = angle * pm_pi / 180;
		check_worst(&turned, distorted(cos(t), -sin(t), sin(t), cos(t)));
	}
	/* For a rotated lattice the measure is the spline's transform at its first reciprocal vectors, four times .358^8 = 2.7e-4 at 45 degrees. */
	check(turned <= 2e-3, "a rotated lattice is hardly distorted (at most %.2g over 5 to 45 degrees, tolerance 2e-3)", turned);
	double strain[3];
	for (int i = 0; i < 3; i++) {
		double e = 1.25 + 0.25 * i;
		strain[i] = distorted(e, 0, 0, 1 / e);
	}
	check(strain[0] > 1e-3 && strain[1] > 2 * strain[0] && strain[2] > 2 * strain[1],
		"pure strain distorts: stretched 1.25, 1.5, 1.75 times %.3g, %.3g, %.3g", strain[0], strain[1], strain[2]);
}

int main(void)
{
	pm_threads_use(1); /* small meshes: a team costs more than the work */
	check_totals(1, (const size_t[]){13, 1, 1});
	check_totals(2, (const size_t[]){12, 14, 1});
	check_totals(3, (const size_t[]){11, 12, 13});
	check_moments();
	check_thousand(1, (const size_t[]){33, 1, 1});
	check_thousand(2, (const size_t[]){12, 9, 1});
	for (size_t i = 0; i < sizeof rm01 / sizeof *rm01; i++)
		check_rm01(&rm01[i]);
	const char *const monotone[] = {"ngp", "cic", "tsc", "pcs"};
	for (int i = 0; i < 4; i++)
		check_step(monotone[i], 0, 1e-14); /* neighbours are rounded to slightly different shifts */
	check_step("m4prime", 2. / 27, 1e-14);
	check_step("m6prime", 0.10156766, 1e-5); /* the worst of 270 shifts */
	check_cut();
	check_components();
	check_threads();
	check_volume();
	check_rows();
	check_distortion();
	return check_done();
}
