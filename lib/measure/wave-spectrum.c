/* E(x, t) of a saved run as waves exp(i k x - i omega t). In x the modes of the mesh, averaged over the other axes; in time a discrete transform under Hann's
 * window, whose lobe is 4 pi/T wide. The theory is that of the species and the magnetic field of the first frame (wave-theory.c), so it is printed beside
 * numbers it owes nothing to but the choice among its roots.
 * Source: Birdsall and Langdon 1985, section 5-7; Harris 1978, Proc. IEEE 66, 51 (windows). Cost: points times modes a frame, and a transform a mode.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_fft_complex.h>

#include "measure/growth.h"
#include "measure/law-field.h"
#include "measure/wave-spectrum.h"
#include "stream/declare.h"

int pm_wave_reads(const struct pm_measure *how, struct pm_frame *f)
{
	if (f->face[0][0] != PM_PERIODIC)
		return pm_fail(PM_DATA, "waves along x need a box that is periodic in x");
	if (!pm_law_field_mesh(how, f))
		return pm_fail(PM_DATA, "no field '%s' on a mesh (p2m | poisson-fft | mgrad makes one)", how->field ? how->field : "");
	pm_law_field_reads(how, f);
	pm_wave_theory_reads(f);
	return 0;
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
	if (!status && how->wave >= law.field->components)
		status = pm_fail(PM_USAGE, "the field '%s' has %d component%s (--component x)", how->field, law.field->components,
			law.field->components == 1 ? "" : "s");
	if (!status && 2 * (size_t)s->modes > g.points[0])
		status = pm_fail(PM_USAGE, "%d waves are asked for, and a mesh of %zu points has %zu (dispersion -n %zu)", s->modes, g.points[0],
			g.points[0] / 2, g.points[0] / 2);
	if (!status && !s->n) {
		s->k1 = 2 * pm_pi / (f->hi[0] - f->lo[0]);
		pm_wave_theory_of(&s->theory, f, s->k1, how->wave);
	}
	for (int m = 1; m <= s->modes && !status; m++) {
		double a[2];
		status = pm_mode(&g, law.field, pm_in(law.field, how->wave), m, a);
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

double pm_wave_peak(const struct pm_wave_spectrum *s, int mode, const double range[2], double *power)
{
	const double *p = s->power + (size_t)(mode - 1) * (s->half + 1);
	const size_t last = rows_below(s, range[1]);
	size_t at = (size_t)fmin(fmax(1, ceil(range[0] / s->step)), (double)s->half);
	if (at >= s->half || (at > 1 && at >= last))
		return *power = NAN;
	for (size_t j = at + 1; j < last; j++)
		at = p[j] > p[at] ? j : at;
	*power = p[at];
	if (!(p[at] > 0 && p[at - 1] > 0 && p[at + 1] > 0))
		return NAN;
	const double a = log(p[at - 1]), b = log(p[at]), c = log(p[at + 1]), bend = a - 2 * b + c;
	return s->step * ((double)at + (bend < 0 ? 0.5 * (a - c) / bend : 0));
}

void pm_wave_print(const struct pm_wave_spectrum *s, const double range[2], FILE *out)
{
	fprintf(out, "mode\tk\tomega\tresolution\tpower\ttheory_omega\ttheory_gamma\n");
	for (int m = 1; m <= s->modes; m++) {
		double power;
		const double k = s->k1 * m, omega = pm_wave_peak(s, m, range, &power);
		const double complex root = pm_wave_theory_nearest(&s->theory, k, omega);
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
