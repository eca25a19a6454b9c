/* A chart drawn as pixels. SPDX-License-Identifier: GPL-3.0-or-later */
#include "chart/canvas.h"

static void line(struct pm_canvas *c, size_t n, double (*xy)[2], double width, const double dash[2], const unsigned char rgb[3])
{
	double along = 0, period = dash ? dash[0] + dash[1] : 0;
	for (size_t i = 1; i < n; i++) {
		double dx = xy[i][0] - xy[i - 1][0], dy = xy[i][1] - xy[i - 1][1], length = hypot(dx, dy);
		if (!dash)
			pm_picture_line(c->picture, xy[i - 1][0], xy[i - 1][1], xy[i][0], xy[i][1], width, rgb);
		for (double s = 0; dash && s < length;) { /* the dashes that begin or go on in this piece */
			double in = fmod(along + s, period), left = in < dash[0] ? dash[0] - in : period - in, e = fmin(s + fmax(left, 1e-3), length);
			if (in < dash[0])
				pm_picture_line(c->picture, xy[i - 1][0] + s / length * dx, xy[i - 1][1] + s / length * dy, xy[i - 1][0] + e / length * dx,
					xy[i - 1][1] + e / length * dy, width, rgb);
			s = e;
		}
		along += length;
	}
}

static bool inside(size_t n, double (*xy)[2], double x, double y)
{
	bool in = false;
	for (size_t i = 0, j = n - 1; i < n; j = i++)
		if ((xy[i][1] > y) != (xy[j][1] > y) && x < (xy[j][0] - xy[i][0]) * (y - xy[i][1]) / (xy[j][1] - xy[i][1]) + xy[i][0])
			in = !in;
	return in;
}

/* How much of a pixel is covered is counted on 4 x 4 points. */
static void shape(struct pm_canvas *c, size_t n, double (*xy)[2], const unsigned char rgb[3])
{
	double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
	for (size_t i = 0; i < n; i++)
		for (int d = 0; d < 2; d++)
			lo[d] = fmin(lo[d], xy[i][d]), hi[d] = fmax(hi[d], xy[i][d]);
	for (int y = (int)fmax(floor(lo[1]), 0); y <= (int)fmin(ceil(hi[1]), c->picture->height); y++)
		for (int x = (int)fmax(floor(lo[0]), 0); x <= (int)fmin(ceil(hi[0]), c->picture->width); x++) {
			int count = 0;
			for (int k = 0; k < 16; k++)
				count += inside(n, xy, x + (k % 4 + 0.5) / 4, y + (k / 4 + 0.5) / 4);
			pm_picture_blend(c->picture, x, y, rgb, count / 16.0);
		}
}

static void disc(struct pm_canvas *c, double x, double y, double radius, const unsigned char rgb[3]) { pm_picture_disc(c->picture, x, y, radius, rgb, 1); }

static void text(struct pm_canvas *c, const double at[2], double height, enum pm_canvas_anchor anchor, bool turned, const char *s, const unsigned char rgb[3])
{
	double back = anchor == PM_CANVAS_START ? 0 : pm_canvas_width(height, s) * (anchor == PM_CANVAS_MIDDLE ? 0.5 : 1);
	pm_picture_text(c->picture, at[0] - (turned ? 0 : back), at[1] + (turned ? back : 0), height, turned, s, rgb);
}

double pm_canvas_width(double height, const char *s)
{
	static const unsigned char none[3];
	return fmax(0, pm_picture_text(NULL, 0, 0, height, false, s, none) - height * 3 / 14); /* without the space behind the last letter */
}

struct pm_canvas pm_canvas_pixels(struct pm_picture *p) { return (struct pm_canvas){line, shape, disc, text, p, NULL}; }
