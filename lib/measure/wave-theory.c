/* Which dispersion relation is that of a frame. Every set with charge, mass and velocity is a Maxwellian species, with the plasma frequency, drift and width
 * along x that it has. The magnetic field is the mean of what the particles carry (bfield), else of B on its mesh: along x or across it, or there is none.
 *     E_x:  electrostatic (lib/plasma/dispersion.c) where the field is 0 or along x; Bernstein's (bernstein.c) across it, with light the extraordinary wave
 *     E_y, E_z:  right and left waves where the field is 0 or along x; else ordinary along the field, extraordinary across it (magnetised.c)
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/species-moments.h"
#include "measure/wave-theory.h"
#include "plasma/bernstein.h"
#include "stream/declare.h"

static bool is_field(const struct pm_field *x) { return x->components == 3 && (!strcmp(x->name, "B") || !strcmp(x->name, "bfield")); }

void pm_wave_theory_reads(struct pm_frame *f)
{
	static const char *const names[] = {"v", "mass", "charge"};
	for (size_t i = 0; i < f->nsets; i++)
		for (int k = 0; k < 3; k++)
			if (pm_frame_field(f, f->sets[i]->name, names[k]))
				pm_reads(f, f->sets[i]->name, names[k]);
	for (size_t i = 0; i < f->nfields; i++)
		if (is_field(f->fields[i]))
			pm_reads(f, f->fields[i]->on, f->fields[i]->name);
}

/* Fourth moment about the mean over the square of the second; 3 of a Maxwellian. */
static double kurtosis(const struct pm_measured *b, double mean)
{
	double s = 0, s2 = 0, s4 = 0;
	for (size_t i = 0; i < b->n; i++) {
		const double m = b->mass ? b->mass[i] : 1, v = b->v[0][i] - mean;
		s += m, s2 += m * v * v, s4 += m * v * v * v * v;
	}
	return s2 > 0 ? s4 * s / (s2 * s2) : 3;
}

/* Temperature across x over that along it; 1 of velocities with fewer components. */
static double ratio_of(const double moment[PM_MOMENTS], int vdim)
{
	const double *t = moment + PM_MOMENT_COVARIANCE; /* xx yy zz ... */
	return vdim == 3 && t[0] > 0 ? 0.5 * (t[1] + t[2]) / t[0] : 1;
}

static void one_species(struct pm_wave_theory *t, const struct pm_frame *f, const struct pm_set *set, double volume, double k1)
{
	const struct pm_field *q = pm_frame_field(f, set->name, "charge"), *m = pm_frame_field(f, set->name, "mass"), *v = pm_frame_field(f, set->name, "v");
	double moment[PM_MOMENTS], w2 = 0, charge = 0, mass = 0;
	if (!set->n || set->fixed || !q || !m || !v || t->n == PM_SPECIES_MOST)
		return;
	struct pm_measured b = {.n = set->n, .vdim = v->components, .mass = pm_in(m, 0)};
	for (int k = 0; k < v->components; k++)
		b.v[k] = pm_in(v, k);
	pm_moments_of(&b, moment);
	for (size_t i = 0; i < set->n; i++) {
		w2 += pm_in(q, 0)[i] * (pm_in(q, 0)[i] / b.mass[i]);
		charge += pm_in(q, 0)[i], mass += b.mass[i];
	}
	const double vth = sqrt(moment[PM_MOMENT_COVARIANCE]), frequency = sqrt(w2 / volume / pm_frame_constant(f, "eps0", 1)), drift = moment[PM_MOMENT_DRIFT];
	/* the velocity of a wave that starts in cold particles is no temperature */
	const bool cold = vth * k1 < 0.02 * frequency;
	const double fourth = kurtosis(&b, drift);
	if (!cold && fabs(fourth - 3) > 0.3 && !t->why[0])
		snprintf(t->why, sizeof t->why, "the velocities of '%s' are not Maxwellian (fourth moment %.2g, not 3): make every beam a set",
			set->name, fourth);
	if (frequency > 0) {
		const double *s = moment + PM_MOMENT_COVARIANCE;
		t->spread[0] = vth, t->spread[1] = v->components == 3 ? sqrt(0.5 * (s[1] + s[2])) : NAN;
		t->species[t->n++] = (struct pm_gyrating){frequency, drift, cold ? 0 : vth, charge / mass, ratio_of(moment, v->components)};
	}
}

/* Mean of the fields of that name, and the root of the mean square of what varies. */
static bool mean_field(const struct pm_frame *f, const char *name, double mean[3], double *rest)
{
	double n = 0, sum[3] = {0}, square = 0;
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *b = f->fields[i];
		if (!is_field(b) || strcmp(b->name, name))
			continue;
		for (int k = 0; k < 3; k++)
			for (size_t p = 0; p < b->count; p++)
				sum[k] += pm_in(b, k)[p], square += pm_in(b, k)[p] * pm_in(b, k)[p];
		n += (double)b->count;
	}
	if (n == 0)
		return false;
	for (int k = 0; k < 3; k++)
		mean[k] = sum[k] / n, square -= sum[k] * mean[k];
	*rest = sqrt(fmax(square, 0) / n);
	return true;
}

static void find_field(struct pm_wave_theory *t, const struct pm_frame *f)
{
	double rest = 0, rate = 0, most = 0;
	if (!mean_field(f, "bfield", t->field, &rest))
		mean_field(f, "B", t->field, &rest);
	const double b = sqrt(t->field[0] * t->field[0] + t->field[1] * t->field[1] + t->field[2] * t->field[2]);
	for (int i = 0; i < t->n; i++)
		rate = fmax(rate, t->species[i].frequency), most = fmax(most, fabs(t->species[i].gyration));
	if (most * rest > 0.1 * fmax(rate, most * b) && !t->why[0])
		snprintf(t->why, sizeof t->why, "the magnetic field is not uniform (%.2g on average, varies by %.2g)", b, rest);
	for (int k = 0; k < 3; k++) /* of round-off, or of a wave */
		t->field[k] = fabs(t->field[k]) * most < 1e-6 * rate || fabs(t->field[k]) < 1e-6 * b ? 0 : t->field[k];
	for (int i = 0; i < t->n; i++)
		t->species[i].gyration *= sqrt(t->field[0] * t->field[0] + t->field[1] * t->field[1] + t->field[2] * t->field[2]) * (t->field[0] < 0 ? -1 : 1);
}

static int still(const struct pm_wave_theory *t, double k1)
{
	for (int i = 0; i < t->n; i++)
		if (fabs(t->species[i].drift) * k1 > 0.01 * fmax(t->species[i].frequency, fabs(t->species[i].gyration)))
			return 0;
	return 1;
}

static int kind_of(struct pm_wave_theory *t, bool light, int component, double k1)
{
	const bool along = t->field[0] != 0, over = t->field[1] != 0 || t->field[2] != 0;
	if (along && over) {
		snprintf(t->why, sizeof t->why, "the magnetic field is neither along x nor across it");
		return PM_NO_THEORY;
	}
	if (over && !still(t, k1)) {
		snprintf(t->why, sizeof t->why, "a species drifts across the magnetic field");
		return PM_NO_THEORY;
	}
	if (component == 0 && !(over && light))
		return over ? PM_BERNSTEIN : PM_ELECTROSTATIC;
	if (isnan(t->c)) {
		snprintf(t->why, sizeof t->why, "waves of light need the constant c");
		return PM_NO_THEORY;
	}
	if (!over)
		return PM_ALONG_FIELD;
	if (component && t->field[3 - component] != 0 && t->field[component] != 0) {
		snprintf(t->why, sizeof t->why, "the magnetic field is neither along y nor along z, so the component has both waves");
		return PM_NO_THEORY;
	}
	return component && t->field[component] != 0 ? PM_ORDINARY_WAVE : PM_EXTRAORDINARY_WAVE;
}

void pm_wave_theory_of(struct pm_wave_theory *t, const struct pm_frame *f, double k1, int component)
{
	double volume = 1;
	*t = (struct pm_wave_theory){.c = pm_frame_constant(f, "c", NAN)};
	for (int d = 0; d < f->dim; d++)
		volume *= f->hi[d] - f->lo[d];
	if (strcmp(f->law, "electrostatic") && strcmp(f->law, "electromagnetic"))
		snprintf(t->why, sizeof t->why, "the dispersion relation is that of the laws electrostatic and electromagnetic");
	for (size_t i = 0; i < f->nsets; i++)
		one_species(t, f, f->sets[i], volume, k1);
	if (!t->n && !t->why[0] && component == 0)
		snprintf(t->why, sizeof t->why, "no set has charge, mass and velocity");
	find_field(t, f);
	t->kind = t->why[0] ? PM_NO_THEORY : kind_of(t, !strcmp(f->law, "electromagnetic"), component, k1);
}

static bool differs(double found, double stated, double relative, double least)
{
	return !isnan(stated) && !isnan(found) && fabs(found - stated) > relative * fabs(stated) + least;
}

static double stated(const struct pm_frame *f, const struct pm_scene *scene, const char *quantity, double otherwise)
{
	const double x = scene->exact(f, quantity, f->time);
	return isnan(x) ? otherwise : x;
}

bool pm_wave_theory_as_made(const struct pm_wave_theory *t, const struct pm_frame *f, const struct pm_scene *scene, double k)
{
	const double charge = stated(f, scene, "charge", 0), mass = stated(f, scene, "mass", 0);
	double volume = pm_frame_constant(f, "eps0", 1);
	for (int d = 0; d < f->dim; d++)
		volume *= f->hi[d] - f->lo[d];
	const double w = mass > 0 ? fabs(charge) / sqrt(mass * volume) : 0;
	if (t->n != (w > 0))
		return false;
	return t->n == 0 || !(differs(t->species[0].frequency, w, 0.05, 0) || fabs(t->species[0].drift) * k > 0.05 * w ||
		differs(t->spread[0], stated(f, scene, "spread_along", NAN), 0.1, 0.02 * w / k) ||
		differs(t->spread[1], stated(f, scene, "spread_across", NAN), 0.1, 0.02 * w / k) ||
		differs(t->field[0], stated(f, scene, "field_along", 0), 0.01, 0.001 * w) ||
		differs(hypot(t->field[1], t->field[2]), stated(f, scene, "field_across", 0), 0.01, 0.001 * w));
}

const char *pm_wave_theory_name(const struct pm_wave_theory *t)
{
	static const char *const names[] = {"none", "electrostatic waves", "electrostatic waves across the magnetic field (Bernstein)",
		"right and left waves along the magnetic field", "ordinary waves across the magnetic field, of cold species",
		"extraordinary waves across the magnetic field, of cold species"};
	return t->kind == PM_ALONG_FIELD && t->field[0] == 0 ? "waves of light" : names[t->kind];
}

static double complex light(const struct pm_wave_theory *t, enum pm_light kind, double k, double omega)
{
	const struct pm_light_case l = {kind, t->species, t->n, k, t->c};
	return pm_light_nearest(&l, omega);
}

static double complex electrostatic(const struct pm_wave_theory *t, double k, double omega)
{
	struct pm_wave_species s[PM_SPECIES_MOST];
	for (int i = 0; i < t->n; i++)
		s[i] = (struct pm_wave_species){t->species[i].frequency, t->species[i].drift, t->species[i].vth};
	return pm_wave_nearest(s, t->n, k, omega);
}

static double bernstein(const struct pm_wave_theory *t, double k, double omega)
{
	struct pm_bernstein b;
	if (pm_bernstein_init(&b, t->species, t->n, k))
		return NAN;
	const double root = pm_bernstein_nearest(&b, omega);
	pm_bernstein_free(&b);
	return root;
}

double complex pm_wave_theory_nearest(const struct pm_wave_theory *t, double k, double omega)
{
	if (t->kind == PM_NO_THEORY || isnan(omega))
		return NAN;
	if (t->kind == PM_ELECTROSTATIC)
		return electrostatic(t, k, omega);
	if (t->kind == PM_BERNSTEIN)
		return bernstein(t, k, omega);
	if (t->kind != PM_ALONG_FIELD)
		return light(t, t->kind == PM_ORDINARY_WAVE ? PM_ORDINARY : PM_EXTRAORDINARY, k, omega);
	const double complex right = light(t, PM_RIGHT, k, omega), left = light(t, PM_LEFT, k, omega);
	return isnan(creal(right)) || fabs(creal(left) - omega) < fabs(creal(right) - omega) ? left : right;
}

/* Of two roots, as waves along k or against it, the one nearer to what was measured. */
static double complex nearer(double complex a, double complex b, double complex measured)
{
	const double complex root = fabs(creal(b)) + I * cimag(b);
	return isnan(creal(b)) || (!isnan(creal(a)) && cabs(a - measured) <= cabs(root - measured)) ? a : root;
}

static double complex root_from(const struct pm_wave_theory *t, int kind, double k, double complex start)
{
	const struct pm_light_case l = {(enum pm_light)kind, t->species, t->n, k, t->c};
	struct pm_wave_species s[PM_SPECIES_MOST];
	for (int i = 0; i < t->n; i++)
		s[i] = (struct pm_wave_species){t->species[i].frequency, t->species[i].drift, t->species[i].vth};
	return t->kind == PM_ELECTROSTATIC ? pm_wave_root(s, t->n, k, start) : pm_light_root(&l, start);
}

double complex pm_wave_theory_close(const struct pm_wave_theory *t, double k, double complex measured)
{
	const double complex m = fabs(creal(measured)) + I * cimag(measured);
	const int first = t->kind == PM_EXTRAORDINARY_WAVE ? PM_EXTRAORDINARY : t->kind == PM_ORDINARY_WAVE ? PM_ORDINARY : PM_RIGHT;
	const int last = t->kind == PM_ALONG_FIELD ? PM_LEFT : first;
	double complex best = NAN;
	if (t->kind == PM_NO_THEORY || isnan(creal(m)) || isnan(cimag(m)))
		return NAN;
	if (t->kind == PM_BERNSTEIN)
		return bernstein(t, k, creal(m));
	for (int kind = first; kind <= last; kind++) /* from both sides of the real axis too, as a wave may run against k */
		best = nearer(nearer(best, root_from(t, kind, k, m), m), root_from(t, kind, k, -conj(m)), m);
	return best;
}
