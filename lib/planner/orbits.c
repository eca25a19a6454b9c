/* The fastest orbit among few bodies: for every bound pair the Kepler ellipse of this pair alone, a = 1/(2/r - v^2/mu), e^2 = 1 - L^2/(mu a), mean motion n^2 =
 * mu/a^3; the result is the one that is fastest at its pericentre, n sqrt((1 + e)/(1 - e)^3). mu = G (m1 + m2), or G times the fixed mass if one body
 * is fixed. Source: Goldstein 1980, chapter 3. Assumes gravity in 3-D; ignores other bodies. Cost N^2.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "limit/rates.h"
#include "planner/scales.h"
#include "stream/field-value.h"

static double at(const struct pm_field *f, int c, size_t i) { return f && c < f->components ? pm_value_at(f, c, i) : 0; }

size_t pm_orbit_bodies(const struct pm_frame *f, const struct pm_law *law, struct pm_orbit_body b[PM_SCALES_FEW])
{
	size_t n = 0;
	for (size_t k = 0; k < f->nsets; k++) {
		const char *set = f->sets[k]->name;
		const struct pm_field *x = pm_frame_field(f, set, "x"), *v = pm_frame_field(f, set, "v"), *m = pm_frame_field(f, set, law->strength);
		for (size_t i = 0; x && m && i < x->count && n < PM_SCALES_FEW; i++, n++) {
			b[n] = (struct pm_orbit_body){.mass = at(m, 0, i), .fixed = !pm_set_moves(f, f->sets[k])};
			for (int c = 0; c < 3; c++)
				b[n].x[c] = at(x, c, i), b[n].v[c] = b[n].fixed ? 0 : at(v, c, i);
		}
	}
	return n;
}

static void pair(const struct pm_orbit_body *p, const struct pm_orbit_body *q, double G, double *fastest, struct pm_scales *s)
{
	const double mu = G * ((q->fixed ? 0 : p->mass) + (p->fixed ? 0 : q->mass));
	double r2 = 0, v2 = 0, rv = 0;
	for (int c = 0; c < 3; c++) {
		const double x = p->x[c] - q->x[c], v = p->v[c] - q->v[c];
		r2 += x * x, v2 += v * v, rv += x * v;
	}
	const double r = sqrt(r2), over = 2 / r - v2 / mu, L2 = r2 * v2 - rv * rv;
	if (!(mu > 0) || !(r > 0) || !(over > 0) || (p->fixed && q->fixed))
		return;
	const double a = 1 / over, e = fmin(sqrt(fmax(0, 1 - L2 / (mu * a))), 1 - 1e-6), n = sqrt(mu / (a * a * a)), near = n * sqrt((1 + e) / pow(1 - e, 3));
	if (!(near > *fastest))
		return;
	const double E = atan2(rv / sqrt(mu * a), 1 - r / a), pull = fmax(p->fixed ? 0 : q->mass, q->fixed ? 0 : p->mass);
	*fastest = near, s->orbit = n, s->eccentricity = e, s->pericentre = a * (1 - e);
	s->anomaly = E - e * sin(E);
	s->stated = pow(G * pull, 0.75) / sqrt(mu); /* times (G M)^(-1/4), M of all bodies (limit/rates.c) */
}

void pm_scales_orbits(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s)
{
	struct pm_orbit_body b[PM_SCALES_FEW];
	double fastest = 0;
	s->orbit = s->eccentricity = s->pericentre = s->anomaly = s->stated = s->few = NAN;
	if (s->kind != PM_MASSES || f->dim != 3 || s->sources > PM_SCALES_FEW)
		return;
	const size_t n = pm_orbit_bodies(f, law, b);
	const double G = law->coefficient(f) / (4 * pm_pi);
	s->few = n < PM_SCALES_FEW ? (double)n : NAN; /* there may be more without a mass */
	for (size_t i = 0; i < n; i++)
		for (size_t j = 0; j < i; j++)
			pair(&b[i], &b[j], G, &fastest, s);
	s->stated *= pow(G * pm_strength_total(f, law->strength), -0.25);
}
