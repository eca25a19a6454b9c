/* Particle strength exchange and the cell list under it: moments of the kernels, the fast loops against the plain one in every dimension and with every
 * kind of face, boxes smaller than the reach, conservation, the bound on the fastest decay (DF-01), any number of threads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "base/simd.h"
#include "check.h"
#include "near/pse.h"

enum { MOST = 4096 };

struct bodies {
	struct pm_domain domain;
	size_t n;
	double x[3][MOST], volume[MOST], strength[MOST], share[MOST];
};
static struct bodies b;
static double rate[MOST], plain[MOST];

static double uniform(uint64_t id, uint64_t use)
{
	double u[2];
	pm_random(7, id, use, u);
	return u[0];
}

static int add(const struct pm_pse *p, double edge, double *to, struct pm_pse_found *found)
{
	struct pm_cell_list l;
	const double *x[3] = {b.x[0], b.x[1], b.x[2]};
	int status = pm_cell_list_init(&l, &b.domain, b.n, x, p->reach, edge);
	if (!status)
		status = pm_pse_add(p, &l, 1, b.volume, b.strength, to, found);
	pm_cell_list_free(&l);
	return status;
}

/* n particles at random in the unit box, unequal volumes and strengths of either sign. */
static void scatter(int dim, size_t n)
{
	b.domain = (struct pm_domain){.dim = dim, .hi = {1, 1, 1}};
	b.n = n;
	for (int d = 0; d < 3; d++)
		b.domain.face[d][0] = b.domain.face[d][1] = PM_OPEN;
	for (size_t i = 0; i < n; i++) {
		for (int d = 0; d < dim; d++)
			b.x[d][i] = uniform(i, (uint64_t)d);
		b.volume[i] = (0.5 + uniform(i, 8)) / (double)n;
		b.strength[i] = uniform(i, 9) - 0.4;
		b.share[i] = uniform(i, 10);
	}
}

/* A lattice of m^dim points in the unit box, cell-centred. */
static void lattice(int dim, size_t m)
{
	b.domain = (struct pm_domain){.dim = dim, .hi = {1, 1, 1},
		.face = {{PM_PERIODIC, PM_PERIODIC}, {PM_PERIODIC, PM_PERIODIC}, {PM_PERIODIC, PM_PERIODIC}}};
	b.n = 1;
	for (int d = 0; d < dim; d++)
		b.n *= m;
	for (size_t i = 0; i < b.n; i++) {
		size_t at = i;
		for (int d = 0; d < dim; d++, at /= m)
			b.x[d][i] = ((double)(at % m) + 0.5) / (double)m;
		b.volume[i] = 1 / (double)b.n;
		b.strength[i] = 0;
	}
}

static void exponential(void)
{
	double worst = 0;
	for (int i = -700000; i < 700000; i += 8) {
		pm_simd x;
		for (int l = 0; l < 8; l++)
			x[l] = (i + l) * 1e-3 + 1e-4 * sin(i + l);
		pm_simd e = pm_simd_exp(x);
		for (int l = 0; l < 8; l++)
			check_worst(&worst, fabs(e[l] / exp(x[l]) - 1));
	}
	check(worst < 5e-16, "exp, eight at a time, is right to 5e-16 from -700 to 700 (got %.2g)", worst);
	check(pm_simd_exp(pm_simd_all(0))[3] == 1, "and 1 at 0");
}

/* Sum of x^a y^c eta over a lattice of spacing 1/2, which is the integral but for exp(-4 pi^2). */
static double moment(const struct pm_pse *p, int a, int c)
{
	const double h = 0.5;
	double sum = 0;
	int reach[3] = {0};
	for (int d = 0; d < p->dim; d++)
		reach[d] = 28;
	for (int k = -reach[2]; k <= reach[2]; k++)
		for (int j = -reach[1]; j <= reach[1]; j++)
			for (int i = -reach[0]; i <= reach[0]; i++)
				sum += pow(i * h, a) * pow(j * h, c) * pm_pse_value(p, h * h * (i * i + j * j + k * k)) * pow(h, p->dim);
	return sum;
}

/* The integral of |eta| beyond z = c over the whole, c^2 > 8 + 2 dim: with a = c/2, J0 = Gamma(dim/2, a^2)/Gamma(dim/2) and the recursion of Gamma(s + 1, x).
 * */
static double beyond(int dim, int order, double c)
{
	const double a = c / 2, e = exp(-a * a), J0 = dim == 2 ? e : erfc(a) + (dim == 3 ? 2 * a * e / sqrt(pm_pi) : 0);
	const double J2 = 0.5 * dim * J0 + pow(a, dim) * e / tgamma(0.5 * dim);
	return order == 2 ? J0 : (J2 - (2 + 0.5 * dim) * J0) / 2;
}

static void moments(void)
{
	for (int dim = 1; dim <= 3; dim++)
		for (int order = 2; order <= 4; order += 2) {
			struct pm_pse p = pm_pse_of(dim, order, 1, 8);
			double fourth = order == 2 ? 12 : 0, mixed = order == 2 ? 4 : 0; /* of exp(-z^2/4): variance 2 */
			printf("# order %d in %d-D\n", order, dim);
			check_near(moment(&p, 2, 0), 2, 1e-12, "the second moment is 2");
			check_near(moment(&p, 0, 0), p.total, 1e-12, "the zeroth moment is that of the entry");
			check_near(moment(&p, 4, 0), fourth, 1e-11, "the fourth vanishes for order 4");
			if (dim > 1)
				check_near(moment(&p, 2, 2), mixed, 1e-11, "and so does the mixed one");
			check_near(p.beyond / beyond(dim, order, 8), 1, 1e-3,
				"the part beyond the cut-off is given by incomplete gamma functions (midpoints: 4^2/(24 64^2) "
				"= 1.6e-4)");
		}
}

/* The symbol of a lattice, total - sum eta cos(k x): k^2 with an error of order + 2 in k, in every order and dimension. */
static void symbols(void)
{
	for (int dim = 1; dim <= 3; dim++)
		for (int order = 2; order <= 8; order += 2) {
			const struct pm_pse p = pm_pse_of(dim, order, 1, pm_pse_cutoff(order));
			const int cut = (int)p.cutoff;
			double off[3], sum = 0;
			for (int t = 0; t < 3; t++) {
				const double wave = 0.5 * pow(1.3, t);
				sum = 0;
				for (int k = dim > 2 ? -cut : 0; k <= (dim > 2 ? cut : 0); k++)
					for (int j = dim > 1 ? -cut : 0; j <= (dim > 1 ? cut : 0); j++)
						for (int i = -cut; i <= cut; i++)
							if (i * i + j * j + k * k <= p.reach * p.reach)
								sum += (1 - cos(wave * i)) * pm_pse_value(&p, i * i + j * j + k * k);
				off[t] = fabs(sum - wave * wave);
			}
			const double slope = log(off[2] / off[0]) / log(1.69);
			check(fabs(slope - order - 2) < 0.8, "order %d in %d-D: the symbol's error goes as k^%.2f", order, dim, slope);
			/* exp(-s) (1/(m+1)! + ...) s^(m+2), m + 1 = order/2 */
			const double s = 0.25, lead = pow(s, order / 2 + 1) / tgamma(order / 2 + 1) * (order / 2) / (order / 2 + 1);
			check(off[0] < lead, "order %d in %d-D: %.2g of %.2g", order, dim, off[0], lead);
		}
}

/* The loss of the second moment of a lattice with eps = h at the cut-offs 5 to 9, and the number of partners: the tables of docs/methods/pse.md, to the
 * digits printed there. */
static void cutoffs(void)
{
	static const double lost[2][3][5] = {{{-1.3e-3, -6.8e-5, -2.1e-6, -3.7e-8, -3.9e-10}, {-1.3e-2, -1.3e-3, -8.8e-5, -2.7e-6, -3.9e-8},
		{-3.0e-2, -2.6e-3, -1.9e-4, -6.7e-6, -1.1e-7}},
		{{8.8e-3, 6.7e-4, 2.8e-5, 6.6e-7, 8.9e-9}, {5.7e-2, 9.1e-3, 8.9e-4, 3.7e-5, 7.1e-7}, {1.2e-1, 1.8e-2, 1.8e-3, 9.1e-5, 1.9e-6}}};
	static const int partners[2][5] = {{81, 113, 149, 197, 253}, {515, 925, 1419, 2109, 3071}};
	for (int dim = 1; dim <= 3; dim++)
		for (int order = 2; order <= 4; order += 2)
			for (int cut = 5; cut <= 9; cut++) {
				const struct pm_pse p = pm_pse_of(dim, order, 1, cut);
				double sum = 0, want = lost[order / 2 - 1][dim - 1][cut - 5];
				int count = 0;
				for (int k = dim > 2 ? -cut : 0; k <= (dim > 2 ? cut : 0); k++)
					for (int j = dim > 1 ? -cut : 0; j <= (dim > 1 ? cut : 0); j++)
						for (int i = -cut; i <= cut; i++)
							if (i * i + j * j + k * k <= p.reach * p.reach)
								sum += i * i * pm_pse_value(&p, i * i + j * j + k * k), count++;
				check(fabs((sum / 2 - 1) / want - 1) < 0.05, "order %d in %d-D, cut at %d: %.3g of the second moment (page: %.2g)", order,
					dim, cut, sum / 2 - 1, want);
				check(dim == 1 || count == partners[dim - 2][cut - 5], "and %d partners", count);
			}
}

/* The images along an axis by reflecting the box at one face after the other, which is how the method of images is defined: each image within reach must
 * occur once, with the product of the signs of its reflections, and no others. */
struct mirrored {
	double side, shift, sign;
};

static int reflected(double lo, double hi, const enum pm_face face[2], struct mirrored *m)
{
	int n = 0;
	m[n++] = (struct mirrored){1, 0, 1};
	for (int k = 1; k <= 20 && face[0] == PM_PERIODIC; k++)
		m[n++] = (struct mirrored){1, k * (hi - lo), 1}, m[n++] = (struct mirrored){1, -k * (hi - lo), 1};
	for (int first = 0; first < 2; first++) {
		struct mirrored now = m[0];
		for (int k = 0; k < 20; k++) {
			int side = (first + k) % 2;
			if (face[side] != PM_WALL && face[side] != PM_NEUMANN)
				break;
			now = (struct mirrored){-now.side, 2 * (side ? hi : lo) - now.shift, face[side] == PM_WALL ? -now.sign : now.sign};
			m[n++] = now;
		}
	}
	return n;
}

static void images(void)
{
	static const enum pm_face face[][2] = {{PM_OPEN, PM_OPEN}, {PM_PERIODIC, PM_PERIODIC}, {PM_WALL, PM_WALL}, {PM_WALL, PM_OPEN}, {PM_OPEN, PM_WALL},
		{PM_OPEN, PM_NEUMANN}, {PM_NEUMANN, PM_OPEN}, {PM_NEUMANN, PM_WALL}, {PM_WALL, PM_NEUMANN}, {PM_NEUMANN, PM_NEUMANN}};
	const double lo = -0.37, hi = 1.21;
	for (size_t f = 0; f < sizeof face / sizeof *face; f++) {
		int wrong = 0;
		for (int r = 0; r < 4; r++) {
			double reach = (const double[]){0.01, 0.9, 1.7, 4.1}[r];
			struct mirrored want[90];
			struct pm_images m;
			int n = reflected(lo, hi, face[f], want), known = 0;
			wrong += pm_images_of(lo, hi, face[f], reach, &m) != 0;
			for (int i = 0; i < n; i++) {
				double one = want[i].side * lo + want[i].shift, other = want[i].side * hi + want[i].shift;
				bool near = fmin(one, other) - hi <= reach && lo - fmax(one, other) <= reach;
				int found = 0;
				for (int k = 0; k < m.n; k++)
					found += m.image[k].side == want[i].side && fabs(m.image[k].shift - want[i].shift) < 1e-12 &&
						m.image[k].sign == want[i].sign;
				wrong += near ? found != 1 : found > 1;
				known += found;
			}
			wrong += known != m.n || m.image[0].side != 1 || m.image[0].shift != 0;
		}
		check(!wrong, "%s-%s: the images are those of repeated reflection, signs included (%d are not)", pm_face_names[face[f][0]],
			pm_face_names[face[f][1]], wrong);
	}
}

/* The largest difference of the fast and the plain sum, over the largest rate. */
static double differs(const struct pm_pse *p, double edge)
{
	const double *x[3] = {b.x[0], b.x[1], b.x[2]};
	struct pm_pse_found found;
	double worst = 0, most = 0;
	memset(rate, 0, sizeof rate);
	memset(plain, 0, sizeof plain);
	if (add(p, edge, rate, &found) || pm_pse_plain(p, &b.domain, 1, b.n, x, b.volume, b.strength, plain))
		return NAN;
	for (size_t i = 0; i < b.n; i++) {
		check_worst(&worst, fabs(rate[i] - plain[i]));
		check_worst(&most, fabs(plain[i]));
	}
	return most > 0 ? worst / most : worst;
}

static void faces(void)
{
	static const enum pm_face pairs[][2] = {{PM_OPEN, PM_OPEN}, {PM_PERIODIC, PM_PERIODIC}, {PM_WALL, PM_WALL}, {PM_WALL, PM_OPEN}, {PM_OPEN, PM_NEUMANN},
		{PM_NEUMANN, PM_WALL}, {PM_NEUMANN, PM_NEUMANN}};
	static const double reaches[] = {0.013, 0.11, 0.5, 1.3, 3.1};
	for (int dim = 1; dim <= 3; dim++)
		for (int order = 2; order <= 4; order += 2) {
			double worst = 0;
			for (int k = 0; k < 7 * 5; k++) {
				double reach = reaches[k % 5];
				if (dim == 3 && k % 5 == 4)
					continue; /* thousands of images in the plain loop */
				scatter(dim, 61);
				for (int d = 0; d < dim; d++)
					memcpy(b.domain.face[d], pairs[(k / 5 + 2 * d) % 7], sizeof pairs[0]);
				b.x[0][5] = 0, b.x[dim - 1][6] = b.domain.face[dim - 1][0] == PM_PERIODIC ? 0 : 1; /* on faces */
				struct pm_pse p = pm_pse_of(dim, order, reach / 5, 5);
				p.share = k % 2 ? b.share : NULL;
				double d = differs(&p, k % 3 ? 0.07 : reach);
				check_worst(&worst, d);
			}
			check(worst < 1e-12, "order %d in %d-D: fast and plain agree for every kind of face and reaches of 0.013 to 3.1 boxes (%.2g)", order,
				dim, worst);
		}
}

/* Far apart, so that the table of all cells is not made; with clusters. */
static void sparse(void)
{
	for (int dim = 1; dim <= 3; dim++) {
		scatter(dim, 300);
		for (size_t i = 0; i < b.n; i++)
			for (int d = 0; d < dim; d++)
				b.x[d][i] = (i % 3 ? 1e6 * (double)(i % 7) : -3e6) + 0.5 * b.x[d][i];
		struct pm_pse p = pm_pse_of(dim, 2, 0.02, 8);
		double d = differs(&p, 0.04);
		check(d < 1e-12, "%d-D: clusters a hundred million cells apart (%.2g)", dim, d);
		for (size_t i = 0; i < b.n; i++)
			for (int a = 0; a < dim; a++)
				b.x[a][i] = 0.25;
		d = differs(&p, 0.04);
		check(d < 1e-12, "%d-D: all particles in one point (%.2g)", dim, d);
	}
}

static void conserves(void)
{
	static const enum pm_face kinds[] = {PM_OPEN, PM_PERIODIC, PM_NEUMANN};
	for (int dim = 1; dim <= 3; dim++)
		for (int k = 0; k < 3; k++) {
			scatter(dim, 2000);
			double all = 0;
			for (int d = 0; d < dim; d++)
				b.domain.face[d][0] = b.domain.face[d][1] = kinds[k];
			struct pm_pse p = pm_pse_of(dim, 4, 0.03, 8.3);
			struct pm_pse_found found;
			p.share = b.share;
			memset(rate, 0, sizeof rate);
			add(&p, 0.05, rate, &found);
			for (size_t i = 0; i < b.n; i++)
				all += fabs(rate[i]);
			double drift = fabs(pm_sum_array(b.n, rate)) / all;
			/* each rate is a sum of up to 2000 terms, rounded: 1e-16 sqrt(2000) of the terms; systematic loss would show as 1e-13 and more */
			check_below(drift, 1e-15, "S33: %s faces in %d-D: the rates of 2000 random particles add up to zero", pm_face_names[kinds[k]],
				dim);
			for (size_t i = 0; i < b.n; i++)
				b.strength[i] = 3, b.volume[i] = 0.7;
			memset(rate, 0, sizeof rate);
			add(&p, 0.05, rate, &found);
			for (size_t i = 0, zero = 0; i < b.n; i++) {
				zero += rate[i] == 0;
				if (i + 1 == b.n)
					check(zero == b.n, "a constant stays constant, to the last bit");
			}
		}
}

/* DF-01: the symbol of a wave on a lattice, cut off at 5 eps; and the limit of Euler. */
static void symbol(void)
{
	static const double overlap[] = {0.5, 1, 2}, want[] = {0.976610322395664, 0.925903818630344, 0.745912165774872},
		limit[] = {0.60225363683734, 2.00021771891933, 8.00048743916354};
	for (int k = 0; k < 3; k++) {
		size_t m = 64;
		struct pm_pse_found found;
		lattice(1, m);
		double h = 1 / (double)m, kh = pm_pi / 8, wave = kh / h;
		struct pm_pse p = pm_pse_of(1, 2, overlap[k] * h, 5);
		for (size_t i = 0; i < b.n; i++)
			b.strength[i] = cos(wave * b.x[0][i]);
		memset(rate, 0, sizeof rate);
		add(&p, 2 * h, rate, &found);
		check_near(rate[3] / b.strength[3] / -(wave * wave), want[k], 1e-10, "DF-01: nu_eff/nu of k h = pi/8");
		double longest = 2 / found.fastest / (h * h);
		check(longest <= limit[k] && longest > limit[k] * (overlap[k] < 1 ? 0.8 : 0.998),
			"DF-01: eps/h = %g: the bound on nu dt/h^2, %.6f, is within the limit %.6f and near it", overlap[k], longest, limit[k]);
	}
}

static void few(void)
{
	struct pm_pse p = pm_pse_of(2, 2, 0.1, 8);
	struct pm_pse_found found = {0};
	scatter(2, 0);
	check(add(&p, 0.1, rate, &found) == 0, "no particles");
	scatter(2, 1);
	rate[0] = 5;
	check(add(&p, 0.1, rate, &found) == 0 && rate[0] == 5 && found.alone == 1, "one particle is alone");
	b.domain.face[0][0] = b.domain.face[0][1] = PM_PERIODIC;
	p = pm_pse_of(2, 2, 1, 8);
	check(add(&p, 0.1, rate, &found) == 0 && rate[0] == 5 && found.alone == 0, "or with its own images, which are as strong as itself");
	b.domain.hi[0] = 1e-3;
	check(add(&p, 0.1, rate, &found) == -PM_DATA, "a reach of thousands of boxes is refused");
}

static void threads(void)
{
	static double one[MOST];
	struct pm_pse_found found, first = {0};
	scatter(3, MOST);
	for (int t = 1; t <= 4; t++) {
		struct pm_pse p = pm_pse_of(3, 2, 0.06, 8); /* four pieces, of which some particles get from three or more */
		bool same = true;
		pm_threads_use(t);
		for (int k = 0; k < 9; k++) { /* so that threads overlap in more than one order */
			memset(rate, 0, sizeof rate);
			add(&p, 0.12, rate, &found);
			if (t == 1 && k == 0)
				memcpy(one, rate, sizeof one), first = found;
			same &= !memcmp(one, rate, sizeof one) && found.fastest == first.fastest;
		}
		check(same, "the same bytes with %d threads, 9 times", t);
	}
}

int main(void)
{
	exponential();
	moments();
	symbols();
	cutoffs();
	images();
	faces();
	sparse();
	conserves();
	symbol();
	few();
	threads();
	return check_done();
}
