/* Distances from interfaces that are known, at nodes and between them, near and far, where they are curved and where several parts are equally far.
 * Lengths are in cells; the box is periodic and `cells` wide. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "level/redistance.h"

enum { CIRCLE, DISTORTED, ELLIPSE, DISKS, SPHERE, ZALESAK, SHAPES };

struct shape {
	int kind, cells;
	double radius, centre[3];
};

/* From a circle or sphere about c. */
static double ball(int dim, const double x[3], const double c[3], double radius)
{
	double r2 = 0;
	for (int d = 0; d < dim; d++)
		r2 += (x[d] - c[d]) * (x[d] - c[d]);
	return sqrt(r2) - radius;
}

/* From the ellipse with the half axes a and a/2, by golden section around the best of 50 points of a quarter of it. */
static double ellipse(double x, double y, double a)
{
	const double b = 0.5 * a, step = 0.01 * pm_pi;
	double best = INFINITY, at = 0, r = 0;
	for (int i = 0; i <= 50; i++)
		if ((r = hypot(fabs(x) - a * cos(i * step), fabs(y) - b * sin(i * step))) < best)
			best = r, at = i * step;
	double low = fmax(at - step, 0), high = fmin(at + step, 0.5 * pm_pi);
	for (int i = 0; i < 40; i++) {
		const double one = low + 0.381966 * (high - low), two = low + 0.618034 * (high - low);
		if (hypot(fabs(x) - a * cos(one), fabs(y) - b * sin(one)) < hypot(fabs(x) - a * cos(two), fabs(y) - b * sin(two)))
			high = two;
		else
			low = one;
	}
	r = hypot(fabs(x) - a * cos(low), fabs(y) - b * sin(low));
	return x * x / (a * a) + y * y / (b * b) < 1 ? -r : r;
}

static double segment(double x, double y, double ax, double ay, double bx, double by)
{
	const double s = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) * (bx - ax) + (by - ay) * (by - ay)), t = fmin(fmax(s, 0), 1);
	return hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay));
}

/* From a disk with a slot of a third of the radius, which ends at two thirds above the middle. */
static double zalesak(double x, double y, double r)
{
	const double w = r / 6, top = 2 * r / 3, low = -sqrt(r * r - w * w), rho = hypot(x, y);
	double best = fmin(fmin(segment(x, y, -w, low, -w, top), segment(x, y, w, low, w, top)), segment(x, y, -w, top, w, top));
	if (y > 0 || fabs(x) > rho / 6)
		best = fmin(best, fabs(rho - r));
	return rho < r && !(fabs(x) < w && y < top) ? -best : best;
}

/* The signed distance from the nearest image. Those of shapes that are even about their middle are nearest about the nearest middle; of others all count. */
static double exact(const struct shape *s, const double x[3])
{
	const int dim = s->kind == SPHERE ? 3 : 2;
	const double side = s->cells, other[3] = {2.5 * s->radius, 0.37 * s->radius, 0};
	double y[3], best = INFINITY;
	for (int d = 0; d < 3; d++)
		y[d] = x[d] - s->centre[d] - side * rint((x[d] - s->centre[d]) / side);
	if (s->kind == ELLIPSE)
		return ellipse(y[0], y[1], s->radius);
	if (s->kind != DISKS && s->kind != ZALESAK)
		return ball(dim, y, (double[]){0, 0, 0}, s->radius);
	for (int k = 0; k < 9; k++) {
		const double a[3] = {y[0] + (k % 3 - 1) * side, y[1] + (k / 3 - 1) * side, 0};
		best = fmin(best, s->kind == ZALESAK ? zalesak(a[0], a[1], s->radius) : fmin(ball(2, a, (double[]){0, 0, 0}, s->radius),
			ball(2, a, other, 0.6 * s->radius)));
	}
	return best;
}

/* The level on the nodes: the distance, or a level with the same interface and slopes from 0.6 to 1.5. */
static double given(const struct shape *s, const double x[3])
{
	const double a = x[0] - s->centre[0], b = x[1] - s->centre[1], wave = 1 + 0.3 * sin(2 * pm_pi * x[0] / s->cells) * cos(2 * pm_pi * x[1] / s->cells);
	if (s->kind == ELLIPSE)
		return 0.5 * s->radius * (a * a + 4 * b * b - s->radius * s->radius) / (s->radius * s->radius) * wave;
	return exact(s, x) * (s->kind == DISTORTED ? wave : 1);
}

/* From the nearest corner of Zalesak's disk, measured where x is nearest to the interface. */
static double from_corner(const struct shape *s, const double x[3])
{
	const double w = s->radius / 6, low = -sqrt(s->radius * s->radius - w * w), top = 2 * s->radius / 3, e = exact(s, x);
	double best = INFINITY;
	for (int k = 0; k < 4; k++) {
		const double a = x[0] - s->centre[0] - (k & 1 ? w : -w), b = x[1] - s->centre[1] - (k & 2 ? top : low);
		const double dx = a - s->cells * rint(a / s->cells), dy = b - s->cells * rint(b / s->cells);
		best = fmin(best, sqrt(fmax(dx * dx + dy * dy - e * e, 0)));
	}
	return best;
}

/* Largest errors of the distances of `fine` particles a cell and axis, half of their spacing off the nodes; the second where x is nearest to a corner.
 * Fine 1: on the nodes. */
static void errors_of(const struct shape *s, int fine, double worst[2], struct pm_redistance *made)
{
	const int dim = s->kind == SPHERE ? 3 : 2;
	const size_t n = (size_t)s->cells, along = n * (size_t)fine, many = along * along * (dim == 3 ? along : 1);
	const struct pm_grid g = {.dim = dim, .cells = {n, n, dim == 3 ? n : 1}, .points = {n, n, dim == 3 ? n : 1}, .h = {1, 1, 1}};
	double *node = malloc(pm_grid_size(&g) * sizeof *node), *x = malloc(4 * many * sizeof *x), *level = x + 3 * many;
	for (size_t i = 0; i < pm_grid_size(&g); i++)
		node[i] = given(s, (double[]){(double)(i % n), (double)(i / n % n), (double)(i / n / n)});
	for (size_t p = 0; p < many; p++) {
		const size_t at[3] = {p % along, p / along % along, p / along / along};
		for (int d = 0; d < 3; d++)
			x[(size_t)d * many + p] = d < dim ? ((double)at[d] + (fine > 1 ? 0.5 : 0)) / fine : 0;
		level[p] = given(s, (double[]){x[p], x[many + p], x[2 * many + p]});
	}
	worst[0] = worst[1] = 0;
	if (pm_redistance(&g, node, many, (const double *const[]){x, x + many, x + 2 * many}, level, made))
		worst[0] = NAN;
	for (size_t p = 0; p < many; p++) {
		const double y[3] = {x[p], x[many + p], x[2 * many + p]};
		check_worst(&worst[s->kind == ZALESAK && from_corner(s, y) < 4], fabs(level[p] - exact(s, y)));
	}
	free(node), free(x);
}

/* Of order 3, and at most `most` cells at the largest of three radii; at nodes and more densely between them. */
static void smooth(const char *name, int kind, const double radius[3], double per_radius, double x, double y, double most)
{
	const int finest = kind != SPHERE ? 3 : check_sanitized() ? 1 : 2;
	for (int fine = 1; fine <= finest; fine += kind == SPHERE ? 1 : 2) {
		double h[3], error[3], worst[2];
		size_t failed = 0;
		for (int i = 0; i < 3; i++) {
			const int cells = (int)(per_radius * radius[i]);
			const struct shape s = {kind, cells, radius[i], {cells / 2 + x, cells / 2 + y, cells / 2 + 0.5 * x}};
			struct pm_redistance made;
			errors_of(&s, fine, worst, &made);
			h[i] = 1 / radius[i], error[i] = worst[0] / radius[i];
			failed += made.linear + made.unsettled;
		}
		char sentence[200];
		snprintf(sentence, sizeof sentence, "%s, %s: %.2g, %.2g, %.2g cells off: the error falls as the cube of the cell", name,
			fine > 1 ? "between the nodes" : "on the nodes", error[0] * radius[0], error[1] * radius[1], error[2] * radius[2]);
		check_order(3, h, error, 3, sentence);
		check_below(worst[0], most, "%s: and is at most %g cells where the radius is %g", name, most, radius[2]);
		check(failed == 0, "%s: every search settles (%zu do not)", name, failed);
	}
}

/* The corners are those of the interpolant, which rounds them. */
static void corners(void)
{
	for (int fine = 1; fine <= 3; fine += 2) {
		const struct shape s = {ZALESAK, 60, 15, {30.31, 30.17, 0}};
		struct pm_redistance made;
		double worst[2];
		errors_of(&s, fine, worst, &made);
		check_below(worst[0], 1e-3, "Zalesak's disk, four cells from its corners");             /* 6.9e-4 */
		check_below(worst[1], 0.4, "Zalesak's disk, nearest to a corner or within four cells"); /* 0.34 */
		check(made.unsettled == 0, "Zalesak's disk: every search settles (%zu do not)", made.unsettled);
	}
}

/* A level that changes sign from node to node has no zero set that a search could follow: what does not settle is counted, and gets the distance of a node. */
static void noise(void)
{
	enum { N = 24, MANY = 4 * N * N };
	const struct pm_grid g = {.dim = 2, .cells = {N, N, 1}, .points = {N, N, 1}, .h = {1, 1, 1}};
	static double node[N * N], x[2 * MANY], level[MANY];
	struct pm_redistance made;
	double worst = 0;
	for (size_t i = 0; i < N * N; i++)
		node[i] = sin(1.7 * (double)(i * i % 1009));
	for (size_t p = 0; p < MANY; p++)
		x[p] = 0.5 * (double)(p % (2 * N)), x[MANY + p] = 0.5 * (double)(p / (2 * N)), level[p] = p & 1 ? 1 : -1;
	check(!pm_redistance(&g, node, MANY, (const double *const[]){x, x + MANY}, level, &made), "a level of noise is taken");
	for (size_t p = 0; p < MANY; p++)
		check_worst(&worst, fabs(level[p]));
	check(made.unsettled > 0 && made.unsettled < MANY, "a level of noise: searches that do not settle are counted (%zu of %d)", made.unsettled, MANY);
	check_below(worst, 2, "a level of noise: distances are those of crossings nearby all the same");
}

int main(void)
{
	const double radius[3] = {4, 8, 16}, shorter[3] = {4, 6, 9}, longer[3] = {6, 12, 24};
	smooth("a circle about a node", CIRCLE, radius, 4, 0, 0, 2e-4);                 /* 1.4e-4; 5.1e-4 at radius 8 */
	smooth("a circle off the nodes", CIRCLE, radius, 4, 0.31, 0.17, 2e-4);          /* 1.4e-4; 6.2e-4 */
	smooth("a level that is no distance", DISTORTED, radius, 4, 0.31, 0.17, 4e-4);  /* 2.6e-4 */
	smooth("an ellipse", ELLIPSE, longer, 3, 0.31, 0.17, 5e-4);                  /* 3.1e-4 */
	smooth("two disks, and what is between them", DISKS, radius, 6, 0.31, 0.17, 6e-4); /* 3.9e-4; the smaller has 0.6 of the radius */
	smooth("a sphere", SPHERE, shorter, 3, 0.31, 0.17, 1e-3);                   /* 7.3e-4 */
	corners();
	noise();
	return check_done();
}
