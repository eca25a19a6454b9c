/* The velocity of vortex filaments,
 *     u(x) = Gamma/(4 pi) integral of dl cross (x - y)/(|x - y|^2 + sigma^2)^(3/2),
 * in closed form over straight elements between the nodes. At a node its own two elements would give nothing; they are a piece of the circle through the
 * node and its neighbours:
 *     Gamma kappa b/(8 pi) [F(l-/sigma) + F(l+/sigma)],   F(z) = asinh z - z/sqrt(1 + z^2),   of lengths l-, l+, curvature kappa, binormal b.
 * With l- = l+ = local and no other elements this is local induction, Gamma kappa b/(4 pi) (ln(2 l/sigma) - 1) for thin cores.
 * Source: Rosenhead 1930, Proc. R. Soc. A 127, 590; Moore 1972, Aeronaut. Q. 23, 307; Leonard 1985, Annu. Rev. Fluid Mech. 17, 523; Saffman 1992, chapter 11.
 * Order 2 in the length of the elements. Cost: nodes times elements. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "filament/filament.h"

/* ln sigma/a = C - 1 where a thin ring of core a moves by Gamma/(4 pi R) (ln(8 R/a) - C): uniform vorticity C = 1/4 (Kelvin), a Gaussian
 * exp(-r^2/a^2) C = (1 - gamma + ln 2)/2, a hollow core C = 1/2, the smoothed integral itself 1. */
const struct pm_filament_core pm_filament_cores[] = {{"uniform", 0.47236655274101470714}, {"gaussian", 0.6427276266895524}, {"hollow", 0.60653065971263342360},
	{"smoothed", 1}, {0}};
const char *const pm_filament_core_names[] = {"uniform", "gaussian", "hollow", "smoothed", NULL};

struct element {
	double from[3], along[3]; /* [length] its beginning; unit vector */
	double length, sigma2, gamma;
};

struct tail { /* what a curve through the periodic box is beyond the images: two straight halves */
	double at[3], sigma2, gamma; /* a point on the axis */
	int axis, sign;
	double beyond[2];            /* [length] coordinates along the axis at which the halves begin */
};

struct work {
	const struct pm_filament *f;
	size_t n, tails;
	struct element *element;
	struct tail *tail;
	size_t *in, *out; /* the elements that end and begin at a node */
	int axis;         /* periodic; -1: none */
	double period;
};

struct key {
	int64_t curve, node;
	size_t i;
};

static int by_curve(const void *a, const void *b)
{
	const struct key *p = a, *q = b;
	return p->curve != q->curve ? (p->curve > q->curve) - (p->curve < q->curve) : (p->node > q->node) - (p->node < q->node);
}

static void cross(const double a[3], const double b[3], double c[3])
{
	for (int d = 0; d < 3; d++)
		c[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
}

/* Gamma/(4 pi) e cross r times the integral over t = 0..length of 1/((s - t)^2 + d^2)^(3/2), s = r.e; length may be infinite. */
static void add_straight(const double r[3], const double e[3], double length, double sigma2, double gamma, double u[3])
{
	double s = 0, r2 = 0, c[3];
	for (int d = 0; d < 3; d++)
		s += r[d] * e[d], r2 += r[d] * r[d];
	cross(e, r, c);
	const double d2 = c[0] * c[0] + c[1] * c[1] + c[2] * c[2] + sigma2; /* not r^2 - s^2, which cancels */
	const double to = isinf(length) ? 1 : (length - s) / sqrt((length - s) * (length - s) + d2);
	const double sum = to + s / sqrt(s * s + d2), w = gamma / (4 * pm_pi) * sum / d2;
	for (int d = 0; d < 3; d++)
		u[d] += w * c[d];
}

/* An element adds nothing on its own line, so nothing at its nodes. */
static void add_elements(const struct work *w, const double x[3], double u[3])
{
	const int images = w->axis >= 0 ? w->f->images : 0;
	for (size_t k = 0; k < w->n; k++) {
		const struct element *e = &w->element[k];
		double r[3];
		for (int image = -images; image <= images; image++) {
			for (int d = 0; d < 3; d++)
				r[d] = x[d] - e->from[d] - (d == w->axis ? image * w->period : 0);
			add_straight(r, e->along, e->length, e->sigma2, e->gamma, u);
		}
	}
	for (size_t k = 0; k < w->tails; k++) {
		const struct tail *t = &w->tail[k];
		for (int side = 0; side < 2; side++) { /* both halves point away from the box; their directions of integration do not */
			double r[3], e[3] = {0};
			e[t->axis] = side ? 1 : -1;
			for (int d = 0; d < 3; d++)
				r[d] = x[d] - (d == t->axis ? t->beyond[side] : t->at[d]);
			add_straight(r, e, INFINITY, t->sigma2, t->gamma * t->sign * (side ? 1 : -1), u);
		}
	}
}

static double arc(double z) { return asinh(z) - z / sqrt(1 + z * z); }

/* What the elements beyond a node's own, of the same length z sigma, have too little or too much because they are straight and not arcs. However small the
 * elements are it is of the order of Gamma kappa/(4 pi), 0.077 of it for thin cores: straight elements alone do not converge. Of 32 elements; the others
 * make less than 1e-4. */
static double bent(double z)
{
	double sum = 0, last = arc(z), slope = z / sqrt(1 + z * z);
	for (int j = 1; j <= 32; j++) {
		const double x = (j + 1) * z, next = arc(x), to = x / sqrt(1 + x * x);
		sum += next - last - j * (j + 1) * z * z * (to - slope);
		last = next, slope = to;
	}
	return sum;
}

/* The circle through a node and its neighbours at x - a and x + b: kappa times the binormal is 2 a cross b/(|a||b||a + b|). */
static void add_own(const struct work *w, size_t i, double u[3], double *oscillation)
{
	const struct element *in = &w->element[w->in[i]], *out = &w->element[w->out[i]];
	const double sigma = w->f->smoothing * w->f->core[i], la = in->length, lb = out->length;
	double turn[3], chord2 = 0;
	cross(in->along, out->along, turn);
	for (int d = 0; d < 3; d++)
		chord2 += pow(in->along[d] * la + out->along[d] * lb, 2);
	double sum = 0;
	for (int side = 0; side < 2; side++) {
		const double z = (w->f->local > 0 ? w->f->local : side ? lb : la) / sigma;
		sum += arc(z) + (w->f->local > 0 ? 0 : bent(z));
	}
	const double own = w->f->circulation[i] * sum / (8 * pm_pi);
	for (int d = 0; d < 3; d++)
		u[d] += own * 2 * turn[d] / sqrt(fmax(chord2, 1e-300));
	*oscillation = fabs(own) * 4 / (la * lb);
}

static void work_free(struct work *w) { pm_free(w->element), pm_free(w->tail), pm_free(w->in), pm_free(w->out); }

/* The elements of one curve, nodes key[0..n-1]; how often it winds through the period. */
static int curve_of(struct work *w, const struct key *key, size_t n)
{
	const struct pm_filament *f = w->f;
	double wound = 0, middle[3] = {0}, total = 0, core = 0, at[3] = {f->x[0][key[0].i], f->x[1][key[0].i], f->x[2][key[0].i]};
	if (n < 3)
		return pm_fail(PM_DATA, "curve %lld has %zu nodes, and a closed curve needs 3 and more (more nodes, or the same number in 'curve' for all "
			"of them)", (long long)key[0].curve, n);
	for (size_t k = 0; k < n; k++) {
		const size_t i = key[k].i, j = key[(k + 1) % n].i;
		struct element *e = &w->element[w->n];
		double l2 = 0;
		if (k + 1 < n && key[k].node == key[k + 1].node)
			return pm_fail(PM_DATA, "curve %lld has two nodes %lld", (long long)key[k].curve, (long long)key[k].node);
		if (!(fabs(f->circulation[i] - f->circulation[j]) <= 1e-9 * fabs(f->circulation[i])))
			return pm_fail(PM_DATA, "the circulation of curve %lld is %g at node %lld and %g at the next, but a filament has one (Helmholtz)",
				(long long)key[k].curve, f->circulation[i], (long long)key[k].node, f->circulation[j]);
		if (!(f->core[i] > 0))
			return pm_fail(PM_DATA, "node %lld of curve %lld has the core %g (a radius above 0)", (long long)key[k].node,
				(long long)key[k].curve, f->core[i]);
		for (int d = 0; d < 3; d++) {
			e->from[d] = at[d]; /* not folded back into the box */
			e->along[d] = f->x[d][j] - f->x[d][i];
			if (d == w->axis)
				e->along[d] -= w->period * rint(e->along[d] / w->period), wound += e->along[d];
			l2 += e->along[d] * e->along[d];
			at[d] += e->along[d];
		}
		if (!(l2 > 0))
			return pm_fail(PM_DATA, "nodes %lld and %lld of curve %lld coincide", (long long)key[k].node, (long long)key[(k + 1) % n].node,
				(long long)key[k].curve);
		e->length = sqrt(l2);
		for (int d = 0; d < 3; d++) {
			e->along[d] /= e->length;
			middle[d] += e->length * (e->from[d] + 0.5 * e->length * e->along[d]);
		}
		total += e->length;
		core += e->length * f->core[i];
		e->gamma = 0.5 * (f->circulation[i] + f->circulation[j]);
		e->sigma2 = pow(f->smoothing * 0.5 * (f->core[i] + f->core[j]), 2);
		w->out[i] = w->in[j] = w->n++;
	}
	const int turns = w->axis >= 0 ? (int)rint(wound / w->period) : 0;
	if (abs(turns) > 1)
		return pm_fail(PM_DATA, "curve %lld goes %d times through the periodic box (once, or not at all)", (long long)key[0].curve, turns);
	if (turns) {
		const double begin = f->x[w->axis][key[0].i], low = turns > 0 ? begin : begin - w->period;
		struct tail *t = &w->tail[w->tails++];
		*t = (struct tail){.sigma2 = pow(f->smoothing * core / total, 2), .gamma = f->circulation[key[0].i], .axis = w->axis, .sign = turns,
			.beyond = {low - f->images * w->period, low + (f->images + 1) * w->period}};
		for (int d = 0; d < 3; d++)
			t->at[d] = middle[d] / total;
	}
	return 0;
}

static int work_init(struct work *w, const struct pm_filament *f, size_t *curves)
{
	struct key *key = pm_alloc(f->n + 1, sizeof *key);
	*w = (struct work){.f = f, .axis = -1, .element = pm_alloc(f->n + 1, sizeof *w->element), .tail = pm_alloc(f->n + 1, sizeof *w->tail),
		.in = pm_alloc(f->n + 1, sizeof *w->in), .out = pm_alloc(f->n + 1, sizeof *w->out)};
	int status = key && w->element && w->tail && w->in && w->out ? 0 : -PM_DATA;
	for (int d = 0; d < 3; d++)
		if (f->domain.face[d][0] == PM_PERIODIC)
			w->axis = d, w->period = f->domain.hi[d] - f->domain.lo[d];
	for (size_t i = 0; i < f->n && !status; i++)
		key[i] = (struct key){f->curve[i], f->node[i], i};
	if (!status)
		qsort(key, f->n, sizeof *key, by_curve);
	*curves = 0;
	for (size_t i = 0, past; i < f->n && !status; i = past) {
		for (past = i; past < f->n && key[past].curve == key[i].curve; past++)
			;
		status = curve_of(w, key + i, past - i);
		++*curves;
	}
	pm_free(key);
	if (status)
		work_free(w);
	return status;
}

int pm_filament_velocity(const struct pm_filament *f, double *const u[3], struct pm_filament_made *made)
{
	struct work w;
	*made = (struct pm_filament_made){0};
	int status = work_init(&w, f, &made->curves);
	double *fast = status ? NULL : pm_alloc(f->n + 1, sizeof *fast);
	if (status || !fast) {
		if (!status)
			work_free(&w);
		return -PM_DATA;
	}
#pragma omp parallel for schedule(static)
	for (size_t i = 0; i < f->n; i++) {
		const double x[3] = {f->x[0][i], f->x[1][i], f->x[2][i]};
		double sum[3] = {0};
		add_own(&w, i, sum, &fast[i]);
		if (!(f->local > 0))
			add_elements(&w, x, sum);
		for (int d = 0; d < 3; d++)
			u[d][i] += sum[d];
	}
	struct pm_sum length = {0}, impulse[3] = {{0}};
	for (size_t k = 0; k < w.n; k++) {
		const struct element *e = &w.element[k];
		double c[3];
		cross(e->from, e->along, c);
		pm_sum_add(&length, e->length);
		made->oscillation = fmax(made->oscillation, fast[k]);
		for (int d = 0; d < 3; d++)
			pm_sum_add(&impulse[d], 0.5 * e->gamma * e->length * c[d]);
	}
	made->length = pm_sum_total(length);
	for (int d = 0; d < 3; d++)
		made->impulse[d] = w.axis >= 0 ? NAN : pm_sum_total(impulse[d]);
	pm_free(fast);
	work_free(&w);
	return 0;
}

int pm_filament_at(const struct pm_filament *f, size_t n, const double *const x[3], double *const u[3])
{
	struct work w;
	size_t curves;
	if (work_init(&w, f, &curves))
		return -PM_DATA;
#pragma omp parallel for schedule(static)
	for (size_t i = 0; i < n; i++) {
		const double at[3] = {x[0][i], x[1][i], x[2][i]};
		double sum[3] = {0};
		add_elements(&w, at, sum);
		for (int d = 0; d < 3; d++)
			u[d][i] += sum[d];
	}
	work_free(&w);
	return 0;
}
