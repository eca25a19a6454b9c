/* A spectrum as a table, or as an object of JSON per frame. SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/spectrum-table.h"

enum { COLUMNS = 4 };

static const char *const names[COLUMNS] = {"k", "waves", "energy", "power"};

static double value(const struct pm_spectrum *s, const struct pm_wave_shell *a, double scale, int column)
{
	const double square = a->square / (scale * scale);
	const double of[COLUMNS] = {a->k, a->waves, 0.5 * square / s->width, s->volume * square / a->waves};
	return of[column];
}

static void rows(const struct pm_spectrum *s, const struct pm_spectrum_print *p)
{
	if (p->head)
		fprintf(p->out, "%s\t%s\t%s\t%s\ttime\n", names[0], names[1], names[2], names[3]);
	for (size_t j = 0; j < s->n; j++) {
		for (int c = 0; c < COLUMNS && s->shell[j].waves > 0; c++)
			fprintf(p->out, "%.17g\t", value(s, s->shell + j, p->scale, c));
		if (s->shell[j].waves > 0)
			fprintf(p->out, "%.12g\n", p->time);
	}
}

static void object(const struct pm_spectrum *s, const char *field, int components, const struct pm_spectrum_print *p, const struct pm_slope *e)
{
	fprintf(p->out, "{\"time\":%.17g,\"field\":\"%s\",\"width\":%.17g,\"mean_square\":%.17g,\"waves_square\":%.17g,\"mean\":[", p->time, field, s->width,
		s->mean_square, s->waves_square);
	for (int c = 0; c < components; c++)
		fprintf(p->out, "%s%.17g", c ? "," : "", s->mean[c]);
	for (int c = 0; c < COLUMNS; c++) {
		const char *before = "";
		fprintf(p->out, "],\"%s\":[", names[c]);
		for (size_t j = 0; j < s->n; j++)
			if (s->shell[j].waves > 0) {
				fprintf(p->out, "%s%.17g", before, value(s, s->shell + j, p->scale, c));
				before = ",";
			}
	}
	fputs("]", p->out);
	if (isfinite(e->power))
		fprintf(p->out, ",\"slope_energy\":%.9g,\"slope_power\":%.9g,\"slope_error\":%.3g,\"slope_shells\":%zu", e->power + p->dim - 1, e->power,
			e->error, e->shells);
	fputs("}\n", p->out);
}

int pm_spectrum_write(const struct pm_spectrum *s, const char *field, int components, const struct pm_spectrum_print *p)
{
	const struct pm_slope e = isnan(p->from) ? (struct pm_slope){.power = NAN} : pm_spectrum_slope(s, p->from, p->to);
	if (p->json) {
		object(s, field, components, p, &e);
		return fflush(p->out) ? pm_fail_errno("cannot write the table") : 0;
	}
	rows(s, p);
	fprintf(p->out, "# %s at time %.9g: mean", field, p->time);
	for (int c = 0; c < components; c++)
		fprintf(p->out, " %.9g", s->mean[c]);
	fprintf(p->out, ", mean square %.9g, by its waves that times 1 %+.2g, shells %.9g wide\n", s->mean_square,
		s->mean_square > 0 ? s->waves_square / s->mean_square - 1 : 0, s->width);
	if (isfinite(e.power))
		fprintf(p->out, "# slope %.5g +- %.2g of energy, %.5g of power, %zu shells from k = %.9g to %.9g\n", e.power + p->dim - 1, e.error, e.power,
			e.shells, p->from, p->to);
	else if (!isnan(p->from))
		fprintf(p->out, "# no slope: %zu shells from k = %.9g to %.9g, and 3 are needed\n", e.shells, p->from, p->to);
	return fflush(p->out) ? pm_fail_errno("cannot write the table") : 0;
}
