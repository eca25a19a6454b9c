/* The slip of the fluid at a wall becomes vorticity in the fluid: nu d omega/dn = -sheet/dt over a step. In the half-plane beside a panel of half-length b
 * the flux of a time dt leaves, at the height y and the place x along the panel, in proportion to
 *     K = integral_0^1 exp(-y^2/(s q)^2) 1/2 (erf((x + b)/(s q)) - erf((x - b)/(s q))) dq,    s^2 = 4 nu dt
 * (heat kernels of the panel and of its image, tau = dt q^2), by 8 nodes of Gauss and Legendre; a sheet that is there at once, the integrand at q = 1.
 * The mean of y^2 is nu dt, or 2 nu dt. A particle's share is K (a + b x + c y^2), such that the circulation is that of the panel, its centre is beside
 * the middle, and the mean of y^2 is exact: this one grows by 2 nu a time, so an error of it would be a wrong time for as long as the layer lives.
 * Source: Koumoutsakos, Leonard and Pepin 1994, J. Comput. Phys. 113, 52; Koumoutsakos and Leonard 1995, J. Fluid Mech. 296, 1; the polynomial is ours.
 * Cost: panels times particles for the slip. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "panels/wall-flux.h"

/* Crossings of the panels with each row of the mesh turn the parity of what lies behind them. */
static void within(const struct pm_grid *g, const struct pm_panels *p, unsigned char *mask)
{
	const size_t nx = g->points[0], ny = g->points[1];
	for (size_t i = 0; i < p->n; i++) {
		const double x0 = p->corner[0][i], y0 = p->corner[1][i], x1 = p->corner[2][i], y1 = p->corner[3][i];
		const double low = (fmin(y0, y1) - g->lo[1]) / g->h[1], high = (fmax(y0, y1) - g->lo[1]) / g->h[1];
		for (double row = fmax(0, ceil(low)); row < high && row < (double)ny; row++) {
			const double x = x0 + (x1 - x0) * (g->lo[1] + row * g->h[1] - y0) / (y1 - y0), column = fmax(0, ceil((x - g->lo[0]) / g->h[0]));
			if (column < (double)nx)
				mask[(size_t)row * nx + (size_t)column] ^= 1;
		}
	}
	for (size_t j = 0; j < ny; j++)
		for (size_t i = 1; i < nx; i++)
			mask[j * nx + i] ^= mask[j * nx + i - 1];
}

int pm_wall_fluid_find(struct pm_wall_fluid *w, const struct pm_panels *p)
{
	const struct pm_grid *g = &w->grid;
	unsigned char *mask = pm_zalloc(pm_grid_size(g) + 1, 1);
	int status = mask ? 0 : -PM_DATA;
	if (!status)
		within(g, p, mask);
	for (size_t i = 0; i < w->n && !status; i++) {
		size_t node[2];
		for (int d = 0; d < 2 && !status; d++) {
			const double at = (w->x[d][i] - g->lo[d]) / g->h[d], near = round(at);
			if (!(fabs(at - near) < 1e-6 && near >= 0 && near < (double)g->points[d]))
				status = pm_fail(PM_DATA, "particle %zu at %g %g is not on a node of the mesh (remesh --mask BODY before noslip)", i,
					w->x[0][i], w->x[1][i]);
			node[d] = status ? 0 : (size_t)near;
		}
		const size_t k = node[1] * g->points[0] + node[0];
		if (!status && w->at[k])
			status = pm_fail(PM_DATA, "two particles at %g %g (remesh before noslip)", w->x[0][i], w->x[1][i]);
		if (!status && mask[k] && w->circulation[i] != 0)
			status = pm_fail(PM_DATA, "a particle at %g %g has circulation within the wall (remesh --mask BODY before noslip)", w->x[0][i],
				w->x[1][i]);
		if (!status && !mask[k])
			w->at[k] = i + 1;
	}
	pm_free(mask);
	return status;
}

size_t pm_wall_diffuse(const struct pm_wall_fluid *w, double nu, double time, double *work)
{
	const struct pm_grid *g = &w->grid;
	const double h = fmin(g->h[0], g->h[1]), steps = fmax(1, ceil(nu * time / (0.2 * h * h))); /* without oscillations up to 1/4 */
	const double rate[2] = {nu * time / (steps * g->h[0] * g->h[0]), nu * time / (steps * g->h[1] * g->h[1])};
	const size_t nx = g->points[0], ny = g->points[1];
	for (double s = 0; s < steps; s++) {
		memcpy(work, w->circulation, w->n * sizeof *work);
#pragma omp parallel for schedule(static)
		for (size_t j = 0; j < ny; j++)
			for (size_t i = 0; i < nx; i++) {
				const size_t k = j * nx + i, me = w->at[k];
				const size_t beside[4] = {i ? w->at[k - 1] : 0, i + 1 < nx ? w->at[k + 1] : 0, j ? w->at[k - nx] : 0,
					j + 1 < ny ? w->at[k + nx] : 0};
				for (int b = 0; b < 4 && me; b++)
					if (beside[b])
						w->circulation[me - 1] += rate[b / 2] * (work[beside[b] - 1] - work[me - 1]);
			}
	}
	return (size_t)steps;
}

/* Angle under which a panel of length l and unit tangent t around x is seen from a point; its series where it is small. */
static inline double angle(double dx, double dy, double tx, double ty, double half)
{
	const double along = dx * tx + dy * ty, off = dy * tx - dx * ty, r2 = dx * dx + dy * dy; /* off: to the left, the side of the body */
	if (r2 > 100 * half * half) { /* Im 2 (z + z^3/3 + z^5/5), z = half/(along + i off) */
		const double re = half * along / r2, im = half * off / r2, re2 = re * re - im * im, im2 = 2 * re * im;
		const double qr = 1 + re2 / 3 + (re2 * re2 - im2 * im2) / 5, qi = im2 / 3 + 2 * re2 * im2 / 5;
		return 2 * (re * qi + im * qr);
	}
	return atan2(2 * half * off, r2 - half * half);
}

void pm_wall_slip(const struct pm_wall_fluid *w, const struct pm_panels *p, double *const u[2])
{
#pragma omp parallel for schedule(static)
	for (size_t i = 0; i < p->n; i++) {
		const double tx = -p->normal[1][i], ty = p->normal[0][i], half = 0.5 * p->length[i], x = p->x[0][i], y = p->x[1][i];
		double sum = 0;
		for (size_t j = 0; j < w->n; j++)
			if (w->circulation[j] != 0)
				sum += w->circulation[j] * angle(w->x[0][j] - x, w->x[1][j] - y, tx, ty, half);
		sum /= 2 * pm_pi * p->length[i];
		u[0][i] += sum * tx, u[1][i] += sum * ty;
	}
}

/* Places and weights of Gauss and Legendre on 0..1, 8 nodes: Abramowitz and Stegun 1964, table 25.4. */
static const double gauss[4][2] = {{0.1834346424956498, 0.3626837833783620}, {0.5255324099163290, 0.3137066458778873}, {0.7966664774136267, 0.2223810344533745},
	{0.9602898564975363, 0.1012285362903763}};

static double kernel(double x, double y, double half, double s, bool sudden)
{
	double sum = 0;
	if (sudden)
		return 0.5 * exp(-y * y / (s * s)) * (erf((x + half) / s) - erf((x - half) / s));
	for (int k = 0; k < 8; k++) {
		const double q = s * 0.5 * (1 + (k % 2 ? 1 : -1) * gauss[k / 2][0]);
		sum += 0.25 * gauss[k / 2][1] * exp(-y * y / (q * q)) * (erf((x + half) / q) - erf((x - half) / q));
	}
	return sum;
}

/* The particles beside a panel, in its own coordinates. */
struct beside {
	size_t n, room, *which;
	double *x, *y, *k; /* [length] along the panel and away from it; the kernel, then the share */
};

static int gather(const struct pm_wall_fluid *w, const struct pm_panels *p, size_t i, double s, bool sudden, struct beside *b)
{
	const struct pm_grid *g = &w->grid;
	const double half = 0.5 * p->length[i], h = fmax(g->h[0], g->h[1]), reach = half + 3.5 * s + h;
	size_t from[2], to[2];
	for (int d = 0; d < 2; d++) {
		from[d] = (size_t)fmin(fmax(0, floor((p->x[d][i] - reach - g->lo[d]) / g->h[d])), (double)g->points[d]);
		to[d] = (size_t)fmin(fmax(0, ceil((p->x[d][i] + reach - g->lo[d]) / g->h[d]) + 1), (double)g->points[d]);
	}
	b->n = 0;
	for (size_t row = from[1]; row < to[1]; row++)
		for (size_t column = from[0]; column < to[0]; column++) {
			const size_t me = w->at[row * g->points[0] + column];
			if (!me)
				continue;
			const double dx = w->x[0][me - 1] - p->x[0][i], dy = w->x[1][me - 1] - p->x[1][i], nx = p->normal[0][i], ny = p->normal[1][i];
			const double along = dy * nx - dx * ny, off = dx * nx + dy * ny;
			if (off < -h || hypot(fmax(0, fabs(along) - half), off) > 3.5 * s) /* beyond: 5e-6 of the kernel */
				continue;
			if (b->n == b->room) {
				const size_t room = 2 * b->room + 64;
				size_t *which = pm_alloc(room, sizeof *which);
				double *v = pm_alloc(3 * room, sizeof *v);
				if (!which || !v) {
					pm_free(which), pm_free(v);
					return -PM_DATA;
				}
				if (b->n) {
					memcpy(which, b->which, b->n * sizeof *which);
					memcpy(v, b->x, b->n * sizeof *v), memcpy(v + room, b->y, b->n * sizeof *v);
					memcpy(v + 2 * room, b->k, b->n * sizeof *v);
				}
				pm_free(b->which), pm_free(b->x);
				b->which = which, b->x = v, b->y = v + room, b->k = v + 2 * room, b->room = room;
			}
			b->which[b->n] = me - 1, b->x[b->n] = along, b->y[b->n] = off, b->k[b->n] = kernel(along, off, half, s, sudden), b->n++;
		}
	return 0;
}

/* a, b, c of K (a + b x + c y^2) with the moments 1, 0 and the mean square of y. false: too few nodes, or shares that would alternate. */
static bool moments(const struct beside *b, double unit, double square, double c[3])
{
	double m[3][4] = {{0, 0, 0, 1}, {0}, {0, 0, 0, square / (unit * unit)}}, size = 0;
	for (size_t j = 0; j < b->n; j++) {
		const double e[3] = {1, b->x[j] / unit, b->y[j] * b->y[j] / (unit * unit)};
		for (int r = 0; r < 3; r++)
			for (int k = 0; k < 3; k++)
				m[r][k] += b->k[j] * e[r] * e[k];
	}
	const double least = 1e-3 * m[0][0];
	for (int r = 0; r < 3; r++) { /* a Gram matrix: no pivoting */
		if (!(m[r][r] > least))
			return false;
		for (int q = 0; q < 3; q++) {
			const double by = m[q][r] / m[r][r];
			for (int k = 0; k < 4 && q != r; k++)
				m[q][k] -= by * m[r][k];
		}
	}
	for (int r = 0; r < 3; r++)
		c[r] = m[r][3] / m[r][r];
	for (size_t j = 0; j < b->n; j++)
		size += fabs(b->k[j] * (c[0] + c[1] * b->x[j] / unit + c[2] * b->y[j] * b->y[j] / (unit * unit)));
	return size < 5; /* of a sum of 1 */
}

/* The shares, in place of the kernel. 1: only their sum is exact. */
static int shares(struct beside *b, double unit, double square)
{
	double c[3], total = 0;
	const bool whole = moments(b, unit, square, c);
	for (size_t j = 0; j < b->n; j++) {
		b->k[j] *= whole ? c[0] + c[1] * b->x[j] / unit + c[2] * b->y[j] * b->y[j] / (unit * unit) : 1;
		total += b->k[j];
	}
	for (size_t j = 0; j < b->n; j++)
		b->k[j] /= total;
	return !whole;
}

int pm_wall_flux(const struct pm_wall_fluid *w, const struct pm_panels *p, const double *sheet, double nu, double time, bool sudden, size_t *plain)
{
	const double h = fmax(w->grid.h[0], w->grid.h[1]), square = (sudden ? 2 : 1) * nu * time;
	const double s = fmax(2 * sqrt(nu * time), 1.5 * h); /* only the moments are right where cells are thicker; with 1 more slip is left */
	struct beside b = {0};
	int status = 0;
	*plain = 0;
	for (size_t i = 0; i < p->n && !status; i++) {
		status = gather(w, p, i, s, sudden, &b);
		if (!status && !b.n)
			status = pm_fail(PM_DATA, "no particles beside the panel at %g %g (remesh --rim keeps those without circulation)",
				p->x[0][i], p->x[1][i]);
		if (!status)
			*plain += (size_t)shares(&b, h, square);
		for (size_t j = 0; j < b.n && !status; j++)
			w->circulation[b.which[j]] += sheet[i] * p->length[i] * b.k[j];
	}
	pm_free(b.which), pm_free(b.x);
	return status;
}
