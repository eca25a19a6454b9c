/* Colours, ticks, planes and letters. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "picture/colour.h"
#include "picture/lettering.h"
#include "picture/plot.h"
#include "stream/run.h"

static void maps(void)
{
	for (int m = 0; pm_colour_names[m]; m++) {
		double worst = 0, step[256], last = 0, mean = 0, middle = 0;
		bool diverging = !strcmp(pm_colour_names[m], "coolwarm");
		for (int i = 0; i < 256; i++) {
			unsigned char rgb[3];
			pm_colour_of(m, i / 255.0, rgb);
			double l = pm_colour_lightness(rgb);
			step[i] = i ? l - last : 0, last = l;
			middle = i == 128 ? l : middle;
		}
		for (int i = 1; i < 256; i++)
			mean += (diverging && i > 128 ? -step[i] : step[i]) / 255;
		for (int i = 8; i < 248; i++) { /* over eight steps, so that the rounding to 256 levels averages out */
			double s = 0;
			for (int k = 0; k < 8; k++)
				s += step[i + k - 4] / 8;
			check_worst(&worst, diverging ? (i < 116 && s < 0) || (i > 140 && s > 0) : fabs(s / mean - 1));
		}
		/* the published tables are even to about 0.3; a rainbow is off by 3 and changes sign */
		check(worst < 0.75 && mean > 0.1, "%s: lightness changes evenly (worst step off by %.2f of the mean)", pm_colour_names[m], worst);
		if (diverging)
			check_near(middle, 88, 1, "coolwarm is lightest in the middle");
	}
	static const struct { const char *map; double t; int rgb[3]; } published[] = {{"viridis", 0, {68, 1, 84}}, {"viridis", 0.5, {33, 145, 140}},
		{"viridis", 1, {253, 231, 37}},
		{"magma", 0.5, {183, 55, 121}}, {"inferno", 0.5, {188, 55, 84}}, {"coolwarm", 0, {59, 76, 192}}, {"coolwarm", 0.5, {221, 221, 221}},
		{"coolwarm", 1, {180, 4, 38}}};
	for (size_t i = 0; i < sizeof published / sizeof *published; i++) {
		unsigned char rgb[3];
		int worst = 0;
		pm_colour_of(pm_colour_find(published[i].map), published[i].t, rgb);
		for (int k = 0; k < 3; k++)
			worst = abs(rgb[k] - published[i].rgb[k]) > worst ? abs(rgb[k] - published[i].rgb[k]) : worst;
		check(worst <= 5, "%s at %g is the published colour within 5 of 255 (off by %d)", published[i].map, published[i].t, worst);
	}
}

static void ticks(void)
{
	double at[32], step;
	check(pm_plot_ticks(-10, 10, 7, at, &step) == 5 && step == 5 && at[2] == 0, "-10 to 10 is divided by fives");
	check(pm_plot_ticks(0.13, 0.87, 7, at, &step) == 4 && fabs(step - 0.2) < 1e-15 && fabs(at[0] - 0.2) < 1e-15, "0.13 to 0.87 is divided by fifths");
	int n = pm_plot_ticks(1e300, 1.1e300, 7, at, &step);
	check(n >= 3 && n <= 8, "numbers near the largest have ticks too");
}

static void planes(void)
{
	struct pm_frame *f = pm_frame_new(3);
	size_t cells[3] = {4, 3, 2}, bins[2] = {5, 4}, outside;
	f->hi[0] = 4, f->hi[1] = 3, f->hi[2] = 2;
	f->face[0][0] = f->face[0][1] = PM_PERIODIC;
	struct pm_mesh *m = pm_frame_mesh_new(f, "mesh", cells);
	struct pm_field *p = pm_makes(f, "mesh", "f", 1, PM_DERIVED);
	struct pm_raster r;
	pm_frame_ready(f);
	for (size_t i = 0; i < p->count; i++)
		pm_out(p, 0)[i] = (double)(i % 4) + 10 * (double)(i / 4 % 4) + 100 * (double)(i / 16);
	pm_raster_slice(&r, f, m, p, 0, 2, 0.25);
	check(r.n[0] == 4 && r.n[1] == 4 && r.wrap[0] && !r.wrap[1], "a slice across z has the points of x and y");
	check_near(pm_raster_at(&r, 1.5, 2.25), 1.5 + 22.5 + 25, 1e-12, "a linear field is exact between points and planes");
	check_near(pm_raster_at(&r, 3.5, 0), 1.5 + 25, 1e-12, "a periodic axis closes");
	pm_raster_free(&r);
	pm_raster_slice(&r, f, m, p, 0, 0, 3.5);
	check_near(pm_raster_at(&r, 1, 1), 1.5 + 110, 1e-12, "a slice between the last plane and the first of a periodic axis");
	pm_raster_free(&r);
	pm_raster_project(&r, f, m, p, 0, 2);
	check_near(pm_raster_at(&r, 1, 1), 2 * 11 + 200, 1e-12, "an integral counts end points half");
	pm_raster_free(&r);
	double x[4] = {0, 4, 1.3, 5}, y[4] = {0, 3, 2.9, 1}, w[4] = {1, 2, 4, 8}, lo[2] = {0, 0}, hi[2] = {4, 3}, sum = 0;
	pm_raster_density(&r, bins, lo, hi, &(struct pm_raster_points){.n = 4, .x = x, .y = y, .w = w}, &outside);
	pm_raster_smooth(&r);
	for (size_t i = 0; i < 20; i++)
		sum += r.value[i] * 4 * 3 / 20;
	check_near(sum, 7, 1e-13, "a density has the weight of the points inside, at the edge too");
	check(outside == 1, "points outside are counted");
	pm_raster_free(&r);
	double many[3][2][400]; /* x, y, w; forward and back */
	struct pm_raster both[2];
	for (int i = 0; i < 400; i++)
		for (int d = 0; d < 3; d++)
			many[d][0][i] = many[d][1][399 - i] = d < 2 ? fmod(0.385 * (i + 1) * (i + 1 + d), 3) : exp(fmod(2.385 * i * i, 20) - 10);
	for (int k = 0; k < 2; k++)
		pm_raster_density(&both[k], bins, lo, hi, &(struct pm_raster_points){.n = 400, .x = many[0][k], .y = many[1][k], .w = many[2][k]}, &outside);
	check(both[0].value[7] > 0 && !memcmp(both[0].value, both[1].value, bins[0] * bins[1] * sizeof(double)),
		"a density does not depend on the order of its points, to the last bit");
	pm_raster_free(&both[0]), pm_raster_free(&both[1]);
	pm_frame_free(f);
}

static void letters(void)
{
	double s[PM_STROKES][4], width;
	int empty = 0, wild = 0;
	for (int c = '!'; c <= '~'; c++) {
		int n = pm_lettering((char)c, s, &width);
		empty += n == 0 || n == PM_STROKES;
		for (int i = 0; i < n; i++)
			for (int k = 0; k < 4; k++)
				wild += !(s[i][k] > -6 && s[i][k] < 17) || (!(k & 1) && s[i][k] > width);
	}
	check(!empty && !wild, "every letter has strokes and stays within its width");
	check(pm_lettering(' ', s, &width) == 0 && width > 4, "a blank is only space");
	check(pm_picture_text(NULL, 0, 0, 14, false, "10^{-3}", NULL) < pm_picture_text(NULL, 0, 0, 14, false, "10-3", NULL), "superscripts are smaller");
}

int main(void)
{
	maps(), ticks(), planes(), letters();
	return check_done();
}
