/* E(x, t) of a saved run as waves exp(i k x - i omega t). In x the modes of the mesh, averaged over the other axes; in time a discrete transform under Hann's
 * window, whose lobe is 4 pi/T wide. The theory has every set as a Maxwellian species along x, with the plasma frequency, drift and width that it has
 * in the first frame (lib/plasma/dispersion.c), so it is printed beside numbers it owes nothing to but the choice among its roots.
 * Source: Birdsall and Langdon 1985, section 5-7; Harris 1978, Proc. IEEE 66, 51 (windows). Cost: points times modes a frame, and a transform a mode.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_fft_complex.h>

#include "measure/growth.h"
#include "measure/law-field.h"
#include "measure/species-moments.h"
#include "measure/wave-spectrum.h"
#include "stream/declare.h"

int pm_wave_reads(const struct pm_measure *how, struct pm_frame *f)
{
	const char *const names[] = {"v", "mass", "charge"};
	if (f->face[0][0] != PM_PERIODIC)
		return pm_fail(PM_DATA, "waves along x need a box that is periodic in x");
	if (!pm_law_field_mesh(how, f))
		return pm_fail(PM_DATA, "no field '%s' on a mesh (p2m | poisson-fft | mgrad makes one)", how->field ? how->field : "");
	pm_law_field_reads(how, f);
	for (size_t i = 0; i < f->nsets; i++)
		for (int k = 0; k < 3; k++)
			if (pm_frame_field(f, f->sets[i]->name, names[k]))
				pm_reads(f, f->sets[i]->name, names[k]);
	return 0;
}

/* Fourth moment of v_x about the mean over the square of the second; 3 of a Maxwellian. */
static double kurtosis(const struct pm_measured *b, double mean)
{
	double s = 0, s2 = 0, s4 = 0;
	for (size_t i = 0; i < b->n; i++) {
		const double m = b->mass ? b->mass[i] : 1, v = b->v[0][i] - mean;
		s += m, s2 += m * v * v, s4 += m * v * v * v * v;
	}
	return s2 > 0 ? s4 * s / (s2 * s2) : 3;
}

static void one_species(struct pm_wave_spectrum *s, const struct pm_frame *f, const struct pm_set *set, double volume)
{
	const struct pm_field *q = pm_frame_field(f, set->name, "charge"), *m = pm_frame_field(f, set->name, "mass"), *v = pm_frame_field(f, set->name, "v");
	double moment[PM_MOMENTS], w2 = 0;
	if (!set->n || set->fixed || !q || !m || !v || s->nspecies == PM_SPECIES_MOST)
		return;
	const struct pm_measured b = {.n = set->n, .vdim = 1, .v = {pm_in(v, 0)}, .mass = pm_in(m, 0)};
	pm_moments_of(&b, moment);
	for (size_t i = 0; i < set->n; i++)
		w2 += pm_in(q, 0)[i] * (pm_in(q, 0)[i] / b.mass[i]);
	const double vth = sqrt(moment[PM_MOMENT_COVARIANCE]), frequency = sqrt(w2 / volume / pm_frame_constant(f, "eps0", 1)), drift = moment[PM_MOMENT_DRIFT];
	/* the velocity of a wave that starts in cold particles is no temperature */
	const bool cold = vth * s->k1 < 0.02 * frequency;
	const double fourth = kurtosis(&b, drift);
	if (!cold && fabs(fourth - 3) > 0.3 && !s->why[0])
		snprintf(s->why, sizeof s->why, "the velocities of '%s' are not Maxwellian (fourth moment %.2g, not 3): make every beam a set",
			set->name, fourth);
	if (frequency > 0)
		s->species[s->nspecies++] = (struct pm_wave_species){frequency, drift, cold ? 0 : vth};
}

static void find_species(struct pm_wave_spectrum *s, const struct pm_frame *f)
{
	double volume = 1;
	for (int d = 0; d < f->dim; d++)
		volume *= f->hi[d] - f->lo[d];
	if (strcmp(f->law, "electrostatic"))
		snprintf(s->why, sizeof s->why, "the dispersion relation is that of the law electrostatic");
	for (size_t i = 0; i < f->nfields && !s->why[0]; i++)
		if (!strcmp(f->fields[i]->name, "B"))
			snprintf(s->why, sizeof s->why, "the dispersion relation is that without a magnetic field");
	for (size_t i = 0; i < f->nsets; i++)
		one_species(s, f, f->sets[i], volume);
	if (!s->nspecies && !s->why[0])
		snprintf(s->why, sizeof s->why, "no set has charge, mass and velocity");
	s->nspecies = s->why[0] ? 0 : s->nspecies;
}

static int more_room(struct pm_wave_spectrum *s)
{
	if (s->n < s->room)
		return 0;
	const size_t room = 2 * s->room + 256;
	double *t = realloc(s->t, room * sizeof *t);
	s->t = t ? t : s->t;
	double complex *a = t ? realloc(s->a, room * (size_t)s->modes * sizeof *a) : NULL;
	if (!a)
		return pm_no_memory();
	s->a = a, s->room = room;
	return 0;
}

int pm_wave_add(struct pm_wave_spectrum *s, const struct pm_measure *how, const struct pm_frame *f)
{
	struct pm_law_field law = {0};
	int status = more_room(s);
	status = status ? status : pm_law_field_of(how, f, &law);
	if (!status && !law.field)
		status = pm_fail(PM_DATA, "no field '%s' in this frame", how->field);
	const struct pm_grid g = status ? (struct pm_grid){0} : pm_grid_of(f, pm_frame_mesh(f, law.field->on));
	if (!status && 2 * (size_t)s->modes > g.points[0])
		status = pm_fail(PM_USAGE, "%d waves are asked for, and a mesh of %zu points has %zu (dispersion -n %zu)", s->modes, g.points[0],
			g.points[0] / 2, g.points[0] / 2);
	if (!status && !s->n) {
		s->k1 = 2 * pm_pi / (f->hi[0] - f->lo[0]);
		find_species(s, f);
	}
	for (int m = 1; m <= s->modes && !status; m++) {
		double a[2];
		status = pm_mode(&g, pm_in(law.field, how->wave < law.field->components ? how->wave : 0), m, a);
		s->a[s->n * (size_t)s->modes + (size_t)(m - 1)] = a[0] + I * a[1];
	}
	s->t[s->n] = f->time;
	s->n += !status;
	pm_law_field_free(&law);
	return status;
}

static int equally_spaced(const struct pm_wave_spectrum *s, double *dt)
{
	if (s->n < 16)
		return pm_fail(PM_DATA, "%zu frame%s too few for frequencies: 16 at least (cycle --every 1 writes every step)", s->n,
			s->n == 1 ? " is" : "s are");
	*dt = (s->t[s->n - 1] - s->t[0]) / (double)(s->n - 1);
	for (size_t i = 0; i < s->n; i++)
		if (!(fabs(s->t[i] - s->t[0] - *dt * (double)i) < 1e-6 * *dt * (double)s->n))
			return pm_fail(PM_DATA, "the frames are not equally spaced in time (frame %zu is at %g)", i + 1, s->t[i]);
	return *dt > 0 ? 0 : pm_fail(PM_DATA, "the time does not advance");
}

int pm_wave_done(struct pm_wave_spectrum *s)
{
	double dt = 0;
	if (equally_spaced(s, &dt))
		return -PM_DATA;
	s->half = (s->n - 1) / 2;
	s->step = 2 * pm_pi / ((double)s->n * dt);
	s->power = pm_alloc((size_t)s->modes * (s->half + 1), sizeof *s->power);
	double complex *work = pm_alloc(s->n, sizeof *work);
	gsl_fft_complex_wavetable *table = gsl_fft_complex_wavetable_alloc(s->n);
	gsl_fft_complex_workspace *space = gsl_fft_complex_workspace_alloc(s->n);
	int status = s->power && work && table && space ? 0 : pm_no_memory();
	for (size_t m = 0; m < (size_t)s->modes && !status; m++) {
		double sum = 0;
		for (size_t i = 0; i < s->n; i++) {
			const double hann = 0.5 - 0.5 * cos(2 * pm_pi * ((double)i + 0.5) / (double)s->n);
			work[i] = hann * s->a[i * (size_t)s->modes + m], sum += hann;
		}
		gsl_fft_complex_backward((double *)work, 1, s->n, table, space); /* sum a exp(+i omega t) */
		for (size_t j = 0; j <= s->half; j++) {
			const double forward = cabs(work[j]) / sum, back = j ? cabs(work[s->n - j]) / sum : 0;
			s->power[m * (s->half + 1) + j] = forward * forward + back * back;
		}
	}
	if (table)
		gsl_fft_complex_wavetable_free(table);
	if (space)
		gsl_fft_complex_workspace_free(space);
	pm_free(work);
	return status;
}

/* The highest row that is looked at. */
static size_t rows_below(const struct pm_wave_spectrum *s, double highest)
{
	const double rows = ceil(highest / s->step);
	return rows < (double)s->half && rows >= 1 ? (size_t)rows : s->half;
}

double pm_wave_peak(const struct pm_wave_spectrum *s, int mode, double highest, double *power)
{
	const double *p = s->power + (size_t)(mode - 1) * (s->half + 1);
	size_t at = 1;
	for (size_t j = 2; j < rows_below(s, highest); j++)
		at = p[j] > p[at] ? j : at;
	*power = p[at];
	if (!(p[at] > 0 && p[at - 1] > 0 && p[at + 1] > 0))
		return NAN;
	const double a = log(p[at - 1]), b = log(p[at]), c = log(p[at + 1]), bend = a - 2 * b + c;
	return s->step * ((double)at + (bend < 0 ? 0.5 * (a - c) / bend : 0));
}

void pm_wave_print(const struct pm_wave_spectrum *s, double highest, FILE *out)
{
	fprintf(out, "mode\tk\tomega\tresolution\tpower\ttheory_omega\ttheory_gamma\n");
	for (int m = 1; m <= s->modes; m++) {
		double power;
		const double k = s->k1 * m, omega = pm_wave_peak(s, m, highest, &power);
		const double complex root = s->nspecies && !isnan(omega) ? pm_wave_nearest(s->species, s->nspecies, k, omega) : NAN;
		const double values[] = {k, omega, s->step, power, creal(root), isnan(creal(root)) ? NAN : cimag(root)};
		fprintf(out, "%d", m);
		for (size_t i = 0; i < sizeof values / sizeof *values; i++)
			fprintf(out, isfinite(values[i]) ? "\t%.12g" : "\tnan", values[i]);
		fputc('\n', out);
	}
}

struct pm_frame *pm_wave_frame(const struct pm_wave_spectrum *s, double highest)
{
	const size_t rows = rows_below(s, highest), cells[3] = {(size_t)s->modes - 1, rows, 1};
	struct pm_frame *f = pm_frame_new(2);
	if (!f)
		return NULL;
	f->time = f->start = s->t[s->n - 1];
	f->lo[0] = s->k1, f->hi[0] = s->k1 * s->modes, f->lo[1] = 0, f->hi[1] = s->step * (double)rows;
	struct pm_field *p = pm_frame_mesh_new(f, "waves", cells) ? pm_makes(f, "waves", "power", 1, PM_STATE) : NULL;
	struct pm_field *l = p ? pm_makes(f, "waves", "log_power", 1, PM_STATE) : NULL;
	if (!l || pm_field_ready(p) || pm_field_ready(l))
		return pm_frame_free(f);
	for (size_t j = 0; j <= rows; j++)
		for (size_t m = 0; m < (size_t)s->modes; m++) {
			const double power = s->power[m * (s->half + 1) + j];
			pm_out(p, 0)[j * (size_t)s->modes + m] = power;
			pm_out(l, 0)[j * (size_t)s->modes + m] = log10(fmax(power, 1e-300));
		}
	return f;
}

void pm_wave_free(struct pm_wave_spectrum *s)
{
	free(s->t);
	free(s->a);
	pm_free(s->power);
	*s = (struct pm_wave_spectrum){0};
}
