/* Colour maps. viridis, magma and inferno (Smith and van der Walt 2015, CC0) as the polynomials of degree six fitted by Zucker (2019, CC0), which differ
 * from the tables by at most 5 of 255 levels; grey is even in L*; coolwarm is Moreland (2009), Diverging color maps for scientific visualization, eqs. 1-4:
 * straight in
 * the polar form Msh of CIELAB from blue through an unsaturated middle to red, for numbers with a sign. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "picture/colour.h"

const char *const pm_colour_names[] = {"viridis", "magma", "inferno", "grey", "coolwarm", NULL};

static const double fits[3][7][3] = {
	{{0.2777273272234177, 0.005407344544966578, 0.3340998053353061}, {0.1050930431085774, 1.404613529898575, 1.384590162594685},
		{-0.3308618287255563, 0.214847559468213, 0.09509516302823659}, {-4.634230498983486, -5.799100973351585, -19.33244095627987},
		{6.228269936347081, 14.17993336680509, 56.69055260068105}, {4.776384997670288, -13.74514537774601, -65.35303263337234},
		{-5.435455855934631, 4.645852612178535, 26.3124352495832}},
	{{-0.002136485053939582, -0.000749655052795221, -0.005386127855323933}, {0.2516605407371642, 0.6775232436837668, 2.494026599312351},
		{8.353717279216625, -3.577719514958484, 0.3144679030132573}, {-27.66873308576866, 14.26473078096533, -13.64921318813922},
		{52.17613981234068, -27.94360607168351, 12.94416944238394}, {-50.76852536473588, 29.04658282127291, 4.23415299384598},
		{18.65570506591883, -11.48977351997711, -5.601961508734096}},
	{{0.0002189403691192265, 0.001651004631001012, -0.01948089843709184}, {0.1065134194856116, 0.5639564367884091, 3.932712388889277},
		{11.60249308247187, -3.972853965665698, -15.9423941062914}, {-41.70399613139459, 17.43639888205313, 44.35414519872813},
		{77.162935699427, -33.40235894210092, -81.80730925738993}, {-71.31942824499214, 32.62606426397723, 73.20951985803202},
		{25.13112622477341, -12.24266895238567, -23.07032500287172}}};

/* ---- sRGB and CIELAB (D65) ---- */

static double linear_of(double s) { return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4); }
static double coded(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055; }
static double cube_root(double t) { return t > 216.0 / 24389 ? cbrt(t) : (24389.0 / 27 * t + 16) / 116; }
static double cube(double t) { return t * t * t > 216.0 / 24389 ? t * t * t : (116 * t - 16) * 27 / 24389; }

static const double white[3] = {0.950489, 1, 1.088840};

static void lab_to_rgb(const double lab[3], double rgb[3])
{
	double fy = (lab[0] + 16) / 116, x = white[0] * cube(fy + lab[1] / 500), y = cube(fy), z = white[2] * cube(fy - lab[2] / 200);
	rgb[0] = coded(3.2404542 * x - 1.5371385 * y - 0.4985314 * z);
	rgb[1] = coded(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z);
	rgb[2] = coded(0.0556434 * x - 0.2040259 * y + 1.0572252 * z);
}

double pm_colour_lightness(const unsigned char rgb[3])
{
	return 116 * cube_root(0.2126729 * linear_of(rgb[0] / 255.0) + 0.7151522 * linear_of(rgb[1] / 255.0) + 0.0721750 * linear_of(rgb[2] / 255.0)) - 16;
}

static void coolwarm(double t, double rgb[3])
{
	/* Moreland's table 1: blue (59,76,192), red (180,4,38), and the middle M = 88; the hue turns by his eq. 4 towards it */
	double end = t < 0.5 ? 0 : 1, w = fabs(2 * t - 1), saturation = 1.08, hue = end == 0 ? -1.1 : 0.5, turned = end == 0 ? -1.661 : 1.061;
	double m = (1 - w) * 88 + w * 80, s = w * saturation, h = (1 - w) * turned + w * hue;
	double lab[3] = {m * cos(s), m * sin(s) * cos(h), m * sin(s) * sin(h)};
	lab_to_rgb(lab, rgb);
}

void pm_colour_of(int map, double t, unsigned char rgb[3])
{
	double c[3], grey[3] = {0, 0, 0};
	t = t >= 0 ? fmin(t, 1) : 0; /* NAN too */
	if (map < 3)
		for (int k = 0; k < 3; k++) {
			c[k] = 0;
			for (int i = 6; i >= 0; i--)
				c[k] = c[k] * t + fits[map][i][k];
		}
	else if (map == 3)
		grey[0] = 100 * t, lab_to_rgb(grey, c);
	else
		coolwarm(t, c);
	for (int k = 0; k < 3; k++)
		rgb[k] = (unsigned char)floor(255 * fmin(fmax(c[k], 0), 1) + 0.5);
}

int pm_colour_find(const char *name)
{
	for (int i = 0; pm_colour_names[i]; i++)
		if (!strcmp(pm_colour_names[i], name))
			return i;
	return -1;
}
