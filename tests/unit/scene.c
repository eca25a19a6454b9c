/* Every scene of the table against what it promises, and each against its exact numbers. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "law/law.h"
#include "mesh/grid.h"
#include "scene-parts/scene-parameters.h"
#include "scene-parts/kepler-orbit.h"
#include "scene-parts/scene-parameters.h"
#include "scene/scene.h"
#include "check.h"

static struct pm_frame *make(const struct pm_scene *s, int dim, uint64_t n, uint64_t seed)
{
	struct pm_scene_choice c = {.dim = dim, .n = n, .seed = seed};
	struct pm_frame *f = pm_frame_new(dim);
	snprintf(f->scene, sizeof f->scene, "%s", s->name);
	for (int i = 0; s->parameters[i].name; i++) {
		c.value[i] = s->parameters[i].otherwise;
		pm_frame_parameter_set(f, s->parameters[i].name, c.value[i]);
	}
	return s->make(&c, f) ? pm_frame_free(f) : f;
}

/* The set that moves. */
static const char *moving(const struct pm_frame *f) { return f->sets[0]->name; }

static double mass_of(const struct pm_field *m, size_t i) { return m->uniform ? m->value[0] : pm_in(m, 0)[i]; }

/* sum of mass times component c of a field, over the scale sum |m a|. */
static double mean_of(const struct pm_frame *f, const char *name, int c, double *scale)
{
	const struct pm_field *a = pm_frame_field(f, moving(f), name), *m = pm_frame_field(f, moving(f), "mass");
	struct pm_sum sum = {0}, size = {0};
	for (size_t i = 0; i < a->count; i++) {
		pm_sum_add(&sum, mass_of(m, i) * pm_in(a, c)[i]);
		pm_sum_add(&size, fabs(mass_of(m, i) * pm_in(a, c)[i]));
	}
	*scale = pm_sum_total(size);
	return pm_sum_total(sum);
}

static bool centred(const struct pm_frame *f, const char *name)
{
	double scale;
	for (int d = 0; d < f->dim; d++)
		if (!(fabs(mean_of(f, name, d, &scale)) <= 1e-15 * scale)) /* rounding of one subtraction, averaged over the particles */
			return false;
	return true;
}

/* Kernels of width 4 touch floor-1 .. floor+2; on an open mesh of n cells that lies in 1..n-1. Faces that reflect fold kernels. */
static bool inside(const struct pm_frame *f, size_t cells)
{
	for (size_t s = 0; s < f->nsets; s++) {
		const struct pm_field *x = pm_frame_field(f, f->sets[s]->name, "x");
		for (int d = 0; d < f->dim; d++)
			for (size_t i = 0; i < x->count; i++) {
				const double at = (pm_in(x, d)[i] - f->lo[d]) / (f->hi[d] - f->lo[d]) * (double)cells;
				const bool folds = f->face[d][0] == PM_PERIODIC || f->pface[d][0] == PM_PREFLECT;
				if (folds ? !(at >= 0 && at < (double)cells) : !(floor(at) >= 2 && floor(at) + 2 <= (double)cells - 1))
					return false;
			}
	}
	return true;
}

static void promises(const struct pm_scene *s, int dim)
{
	struct pm_frame *f = make(s, dim, s->n, 1);
	if (!check(f != NULL, "%s in %d-D can be made by default", s->name, dim))
		return;
	if (!f->nsets) {
		check(!s->n && pm_law_of(f) && f->dt > 0 && pm_frame_mesh(f, "mesh") && s->exact(f, "mass", 0) == 0,
			"%s in %d-D: a box without a set: law, dt, mesh", s->name, dim);
		pm_frame_free(f);
		return;
	}
	const struct pm_field *x = pm_frame_field(f, moving(f), "x"), *v = pm_frame_field(f, moving(f), "v"), *m = pm_frame_field(f, moving(f), "mass");
	const struct pm_field *id = pm_frame_field(f, moving(f), "id");
	const struct pm_mesh *mesh = pm_frame_mesh(f, "mesh");
	bool good = f->dim == dim && pm_law_of(f) && f->dt > 0 && mesh && x->count == s->n && x->components == dim && v->components >= dim;
	check(good && m->extensive && id->type == PM_I64, "%s in %d-D: dim, law, dt, mesh, x, v, mass (a strength), id (i64)", s->name, dim);
	if (!strcmp(f->law, "gravity"))
		check(pm_frame_constant(f, "G", NAN) == 1 && pm_frame_constant(f, "softening", NAN) >= 0, "%s in %d-D states G = 1 and its softening",
			s->name, dim);
	for (int d = 0; d < dim; d++)
		good = good && pm_finite(x->count, pm_in(x, d)) && pm_finite(v->count, pm_in(v, d)) && mesh->lo[d] == f->lo[d] &&
			fabs(mesh->lo[d] + mesh->h[d] * (double)mesh->cells[d] - f->hi[d]) < 1e-14 * (f->hi[d] - f->lo[d]);
	for (size_t i = 0; i < s->n; i++)
		good = good && mass_of(m, i) >= 0 && pm_in_i64(id, 0)[i] == (int64_t)i;
	check(good, "%s in %d-D: all finite, ids in order, the mesh spans the box", s->name, dim);
	check(inside(f, mesh->cells[0]) && inside(f, 16) && inside(f, 128), "%s in %d-D lies inside its mesh for kernels of width 4, and for 16 and 128 cells",
		s->name, dim);
	if (strcmp(s->name, "kepler") && strcmp(s->name, "pair") && strcmp(s->name, "gyration") && strcmp(s->name, "exb"))
		check(centred(f, "v"), "%s in %d-D has no momentum", s->name, dim);
	if (f->face[0][0] == PM_OPEN && strcmp(s->name, "kepler"))
		check(centred(f, "x"), "%s in %d-D has its centre of mass at the origin", s->name, dim);
	double total = 0;
	for (size_t k = 0; k < f->nsets; k++)
		for (size_t i = 0; i < f->sets[k]->n; i++)
			total += mass_of(pm_frame_field(f, f->sets[k]->name, "mass"), i);
	check_near(total, s->exact(f, "mass", 0), 1e-11 * fmax(1, total), "and the mass of its exact value");
	check(isnan(s->exact(f, "no such number", 0)), "%s: unknown quantities are NaN", s->name);
	pm_frame_free(f);
}

static void same_for_any_threads(const struct pm_scene *s)
{
	struct pm_frame *f[3];
	bool good = true;
	for (int t = 0; t < 3; t++) {
		pm_threads_use(t + 1);
		f[t] = make(s, s->dim, s->n, 7);
	}
	for (int d = 0; d < s->dim; d++)
		for (int t = 1; t < 3; t++)
			for (int k = 0; k < 2; k++) {
				const struct pm_field *a = pm_frame_field(f[0], moving(f[0]), k ? "v" : "x"),
					*b = pm_frame_field(f[t], moving(f[t]), k ? "v" : "x");
				good = good && !memcmp(pm_in(a, d), pm_in(b, d), a->count * sizeof(double));
			}
	check(good, "HC-56: %s has the same bytes with 1, 2 and 3 threads", s->name);
	for (int t = 0; t < 3; t++)
		pm_frame_free(f[t]);
}

/* Seeds give independent scenes; 4/sqrt(N) is the bound of HC-56. */
static void uncorrelated(const struct pm_scene *s)
{
	const uint64_t n = 10000;
	struct pm_frame *f = make(s, s->dim, n, 1), *g = make(s, s->dim, n, 2);
	double worst = 0;
	for (int d = 0; d < s->dim; d++) {
		const double *a = pm_in(pm_frame_field(f, moving(f), "x"), d), *b = pm_in(pm_frame_field(g, moving(g), "x"), d);
		const double ma = pm_sum_array(n, a) / (double)n, mb = pm_sum_array(n, b) / (double)n;
		double ab = 0, aa = 0, bb = 0;
		for (size_t i = 0; i < n; i++)
			ab += (a[i] - ma) * (b[i] - mb), aa += (a[i] - ma) * (a[i] - ma), bb += (b[i] - mb) * (b[i] - mb);
		check_worst(&worst, fabs(ab) / sqrt(aa * bb));
	}
	check_below(worst, 4 / sqrt((double)n), "HC-56, two seeds: %s of 1 and 2 are uncorrelated", s->name);
	pm_frame_free(f), pm_frame_free(g);
}

static void plummer(void)
{
	const struct pm_scene *s = pm_scene_find("plummer");
	struct pm_frame *f = pm_frame_new(3);
	pm_frame_parameter_set(f, "truncation", 1e6);
	check_near(s->exact(f, "energy", 0), -3 * pm_pi / 64, 1e-14, "PM-09: without an end the energy of plummer is -3 pi/64");
	check_near(s->exact(f, "energy_field_pair", 0), -0.29452431127404312, 1e-14, "PM-09: and that of its field -3 pi/32");
	check_near(s->exact(f, "radius_0.5", 0), 1.3047660265041067, 1e-11, "PM-09: half of the mass is within 1.30477");
	check_near(s->exact(f, "radius_0.1", 0), 0.52402806361287057, 1e-11, "PM-09: a tenth within 0.52403");
	check_near(s->exact(f, "radius_0.9", 0), 3.7071127919540843, 1e-10 /* the end at 1e6 a moves it by 3e-11 */, "PM-09: nine tenths within 3.70711");
	check_near(pow(s->exact(f, "dispersion_centre", 0), 2), 0.16666666666666667, 1e-15, "PM-09: sigma^2 in the centre is 1/6");
	pm_frame_free(f);
	f = make(s, 3, 100000, 1);
	const struct pm_field *v = pm_frame_field(f, moving(f), "v"), *x = pm_frame_field(f, moving(f), "x");
	double square = 0, near = 0, n = 0;
	for (size_t i = 0; i < v->count; i++)
		for (int d = 0; d < 3; d++) {
			square += pm_in(v, d)[i] * pm_in(v, d)[i];
			const double r = hypot(hypot(pm_in(x, 0)[i], pm_in(x, 1)[i]), pm_in(x, 2)[i]);
			if (r < 0.2)
				near += pm_in(v, d)[i] * pm_in(v, d)[i] * sqrt(1 + r * r), n++;
		}
	/* K sums 1e5 speeds of relative spread about 1: 0.4 % is over one standard deviation; four of them */
	check_near(0.5 * s->exact(f, "mass", 0) / 1e5 * square, s->exact(f, "energy_kinetic", 0), 0.0025,
		"the kinetic energy of 1e5 particles is the exact one");
	check_near(near / n, 1.0 / 6, 4 * sqrt(2 / n) / 6, "PM-09: the dispersion of 1e5 particles within 0.2 a is GM/(6a)");
	pm_frame_free(f);
}

static void orbits(void)
{
	double x[2], v[2], worst = 0;
	for (int k = 0; k <= 40; k++) {
		const struct pm_scene_orbit o = {2.385, 1.7, 0.9};
		pm_scene_orbit_at(o, 0.0573 * k * pm_scene_orbit_period(o), x, v);
		const double energy = 0.5 * (v[0] * v[0] + v[1] * v[1]) - o.gm / hypot(x[0], x[1]), turn = x[0] * v[1] - x[1] * v[0];
		check_worst(&worst, fabs(energy + o.gm / (2 * o.axis)) + fabs(turn - sqrt(o.gm * o.axis * (1 - o.e * o.e))));
	}
	double moved = 0;
	for (int k = 0; k <= 40; k++) { /* v is the rate of x: centred differences over 1e-5 are good to 1e-9, rounding to 1e-10 */
		const struct pm_scene_orbit o = {2.385, 1.7, 0.6};
		double x1[2], x2[2];
		const double t = 0.173 * k, h = 1e-5;
		pm_scene_orbit_at(o, t, x, v);
		pm_scene_orbit_at(o, t - h, x1, (double[2]){0});
		pm_scene_orbit_at(o, t + h, x2, (double[2]){0});
		check_worst(&moved, hypot((x2[0] - x1[0]) / (2 * h) - v[0], (x2[1] - x1[1]) / (2 * h) - v[1]));
	}
	check_near(moved, 0, 1e-7, "the velocity on the Kepler orbit is the rate of the position");
	check_near(worst, 0, 1e-12, "the Kepler orbit keeps energy and angular momentum all the way round");
	pm_scene_orbit_at((struct pm_scene_orbit){1, 1, 0.9}, 0, x, v);
	check(x[0] == -1.9 && fabs(x[1]) < 1e-15 && fabs(v[0]) < 1e-15, "PM-10: it starts at (-1.9, 0)");
	check_near(v[1], -sqrt(0.1 / 1.9), 1e-15, "PM-10: with v = (0, -sqrt(0.1/1.9))");
}

static void collapse(void)
{
	const struct pm_scene *s = pm_scene_find("cold-collapse");
	struct pm_frame *f = make(s, 1, 4096, 1);
	check_near(s->exact(f, "kA", 1), 0.0771540317407622, 1e-15, "PM-06: k A = 0.0771540 after one Jeans time");
	check_near(s->exact(f, "kA", 2), 0.188109784554182, 1e-15, "PM-06: 0.1881098 after two");
	check_near(s->exact(f, "crossing", 0), 3.6882538673613, 1e-13, "PM-06: the sheets cross at 3.68825");
	pm_frame_free(f);
	s = pm_scene_find("cold-sphere");
	f = make(s, 3, 10, 1);
	const double fall = s->exact(f, "free_fall", 0), r0 = s->exact(f, "radius_0.5", 0);
	check_near(fall, 1.1107207345395916, 1e-15, "PM-08: the cold sphere falls together in 1.11072");
	check_near(s->exact(f, "radius_0.5", 0.25 * fall) / r0, 0.960936867781004, 1e-14, "PM-08: it has 0.96094 of its radius at a quarter of that");
	check_near(s->exact(f, "radius_0.5", 0.75 * fall) / r0, 0.597150078385516, 1e-14, "PM-08: and 0.59715 at three quarters");
	pm_frame_free(f);
}

/* Every parameter that pinit offers fits its list. */
static void room_for_parameters(void)
{
	const struct pm_scene_parameter *rows[PM_SCENE_ROWS];
	const int n = pm_scene_rows(rows);
	for (int s = 0; pm_scenes[s]; s++)
		for (const struct pm_scene_parameter *p = pm_scenes[s]->parameters; p->name; p++)
			check(pm_scene_row_at(rows, n, p->name) < n, "%s: pinit has --%s", pm_scenes[s]->name, p->name);
}

/* Of vortices, or of tracers alone. */
static bool massless(const struct pm_scene *s)
{
	struct pm_frame *f = make(s, s->dim, s->n, 1);
	const bool is = f && (!strcmp(f->law, "vortex") || !strcmp(f->law, "passive"));
	pm_frame_free(f);
	return is;
}

static struct pm_frame *loaded(const char *name, uint64_t n, enum pm_loading how, double vth)
{
	const struct pm_scene *s = pm_scene_find(name);
	struct pm_frame *f = pm_frame_new(1);
	struct pm_scene_choice c = {.dim = 1, .n = n, .seed = 1, .loading = how};
	for (int i = 0; s->parameters[i].name; i++)
		c.value[i] = !strcmp(s->parameters[i].name, "vth") ? vth : s->parameters[i].otherwise;
	return f && !s->make(&c, f) ? f : pm_frame_free(f);
}

static double sum_of(const struct pm_frame *f, const char *weight, int power, double wavenumber)
{
	const struct pm_field *w = pm_frame_field(f, "electrons", weight), *x = pm_frame_field(f, "electrons", "x");
	const struct pm_field *v = pm_frame_field(f, "electrons", "v");
	double sum = 0;
	for (size_t i = 0; i < x->count; i++)
		sum += (w->uniform ? w->value[0] : pm_in(w, 0)[i]) * pow(pm_in(v, 0)[i], power) * cos(wavenumber * pm_in(x, 0)[i]);
	return sum;
}

/* All starts: the charge of the background, no momentum, the moments of the Maxwellian, the wave of the options. Noise of n numbers: the quantiles of 10000
 * velocities end at 3.9 vth, 4e-4 of the variance is beyond, 8e-3 of the fourth moment; discrepancy log(n)/n; at random 3 standard errors, n^(-1/2) times
 * sqrt 2 for the variance, sqrt 96 for the fourth moment, sqrt(1/2) for the wave. A lattice ends at 6 vth and has 7e-8 less variance. */
static void plasma(void)
{
	static const struct {
		double v2, v4, wave;
	} tolerance[] = {{1e-6, 1e-4, 1e-5}, {1e-3, 0.03, 2e-4}, {2e-3, 0.04, 5e-4}, {0.03, 0.21, 0.015}};
	const char *const names[] = {"langmuir", "two-stream", "landau"};
	for (int i = 0; i < 12; i++) {
		const enum pm_loading how = (enum pm_loading)(i % 4);
		const struct pm_scene *s = pm_scene_find(names[i / 4]);
		struct pm_frame *f = loaded(s->name, 20000, how, i / 4 == 2);
		const double charge = sum_of(f, "charge", 0, 0), length = f->hi[0] - f->lo[0];
		check_near(charge / length, -pm_frame_constant(f, "background", NAN), 1e-11,
			"a plasma, whatever its loading: the background neutralises the electrons");
		check_near(s->exact(f, "charge", 0), charge, 1e-10, "and it is the charge of the scene's parameters");
		check_near(sum_of(f, "mass", 1, 0) / length, 0, 1e-13, "and the momentum is 0");
		pm_frame_free(f);
	}
	for (int how = 0; how < 4; how++) {
		struct pm_frame *f = loaded("landau", 20000, (enum pm_loading)how, 1);
		struct pm_frame *g = loaded("two-stream", 20000, (enum pm_loading)how, 0.1);
		const double length = f->hi[0], v0 = 0.6123724356957945;
		check_near(sum_of(f, "mass", 2, 0) / length, 1, tolerance[how].v2, "landau, any loading: the variance of the velocities is vth^2");
		check_near(sum_of(f, "mass", 4, 0) / length, 3, tolerance[how].v4, "landau, any loading: their fourth moment is that of a Maxwellian");
		check_near(sum_of(f, "mass", 0, 0.5) / length, 0.01, tolerance[how].wave, "landau, any loading: the density has the wave of the options");
		check_near(sum_of(g, "mass", 2, 0) / g->hi[0], v0 * v0 + 0.01, 0.01 * tolerance[how].v2 + 0.4 * tolerance[how].wave,
			"two-stream, any loading: the variance is v0^2 + vth^2");
		pm_frame_free(f);
		pm_frame_free(g);
	}
	struct pm_frame *f;
	f = pm_frame_new(1);
	pm_frame_parameter_set(f, "v0", 0.3);
	check_near(pm_scene_find("two-stream")->exact(f, "gamma", 0), 0.256405640402469, 1e-14, "PIC-02: cold beams grow at 0.2564056 for k v0 = 0.3");
	pm_frame_parameter_set(f, "v0", sqrt(0.375));
	check_near(pm_scene_find("two-stream")->exact(f, "gamma", 0), 0.353553390593274, 1e-14, "PIC-02: and at 1/sqrt 8 at most");
	check_near(pm_scene_find("ionic-chain")->exact(f, "potential", 0), 1.3985527798610, 2e-13, "ionic chain: potential at (1/4, 1/4), by Bessel functions");
	const struct pm_scene *sheath = pm_scene_find("sheath"); /* scipy's brentq on the equations in the head of lib/scene/sheath.c */
	check_near(sheath->exact(f, "potential_wall", 0), -1.7147984280919264, 1e-14, "sheath: the collector");
	check_near(sheath->exact(f, "potential_plasma", 0), -0.7913382144016985, 1e-13, "sheath: the plasma");
	check_near(sheath->exact(f, "density", 0), 0.41377398793211234, 1e-13, "sheath: density of the plasma");
	check_near(sheath->exact(f, "ion_speed", 0), 0.17354790916446, 1e-13, "sheath: mean velocity of the ions");
	pm_frame_free(f);
}

int main(void)
{
	room_for_parameters();
	for (int i = 0; pm_scenes[i]; i++) {
		check(!strcmp(pm_scenes[i]->name, pm_scene_names[i]), "%s is named like its file", pm_scene_names[i]);
		if (massless(pm_scenes[i]))
			continue; /* no mass and no velocity: tests/unit/scene-vortex.c */
		for (int dim = 1; dim <= 3; dim++)
			if (pm_scenes[i]->dims >> dim & 1)
				promises(pm_scenes[i], dim);
		if (pm_scenes[i]->n)
			same_for_any_threads(pm_scenes[i]);
		if (pm_scenes[i]->random)
			uncorrelated(pm_scenes[i]);
	}
	plummer();
	orbits();
	collapse();
	plasma();
	return check_done();
}
