/* A picture: pixels and what is drawn on them. Lines, discs and letters are antialiased by their distance to the centre of each pixel. Rows of the PNG are
 * filtered and packed the same way every time and carry no date: equal pictures are equal bytes. SPDX-License-Identifier: GPL-3.0-or-later */
#include <png.h>
#include <string.h>

#include "picture/lettering.h"
#include "picture/picture.h"

int pm_picture_new(struct pm_picture *p, int width, int height, const unsigned char ground[3])
{
	*p = (struct pm_picture){width, height, pm_alloc((size_t)width * (size_t)height, 3)};
	if (!p->rgb)
		return -PM_DATA;
	pm_picture_fill(p, 0, 0, width, height, ground);
	return 0;
}

void pm_picture_free(struct pm_picture *p)
{
	pm_free(p->rgb);
	p->rgb = NULL;
}

void pm_picture_blend(struct pm_picture *p, int x, int y, const unsigned char rgb[3], double cover)
{
	if (x < 0 || y < 0 || x >= p->width || y >= p->height || !(cover > 0))
		return;
	unsigned char *o = p->rgb + 3 * ((size_t)y * (size_t)p->width + (size_t)x);
	cover = floor(16 * fmin(cover, 1) + 0.5) / 16; /* few different colours, so that most files have a palette */
	for (int k = 0; k < 3; k++)
		o[k] = (unsigned char)floor(o[k] + cover * (rgb[k] - o[k]) + 0.5);
}

void pm_picture_fill(struct pm_picture *p, int x0, int y0, int x1, int y1, const unsigned char rgb[3])
{
	for (int y = y0 > 0 ? y0 : 0; y < y1 && y < p->height; y++)
		for (int x = x0 > 0 ? x0 : 0; x < x1 && x < p->width; x++)
			memcpy(p->rgb + 3 * ((size_t)y * (size_t)p->width + (size_t)x), rgb, 3);
}

/* Distance of (x, y) to the segment. */
static double distance(double x, double y, const double s[4])
{
	double dx = s[2] - s[0], dy = s[3] - s[1], l2 = dx * dx + dy * dy;
	double t = l2 > 0 ? fmin(fmax(((x - s[0]) * dx + (y - s[1]) * dy) / l2, 0), 1) : 0;
	return hypot(x - s[0] - t * dx, y - s[1] - t * dy);
}

/* A set of segments as one stroke of a round pen, so that joints are not darker. */
static void stroke(struct pm_picture *p, int n, double (*s)[4], double width, const unsigned char rgb[3])
{
	double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL}, r = width / 2;
	for (int i = 0; i < n; i++)
		for (int k = 0; k < 4; k++)
			lo[k & 1] = fmin(lo[k & 1], s[i][k]), hi[k & 1] = fmax(hi[k & 1], s[i][k]);
	int x0 = (int)floor(fmax(lo[0] - r - 1, 0)), x1 = (int)ceil(fmin(hi[0] + r + 1, p->width));
	int y0 = (int)floor(fmax(lo[1] - r - 1, 0)), y1 = (int)ceil(fmin(hi[1] + r + 1, p->height));
	for (int y = y0; y < y1; y++)
		for (int x = x0; x < x1; x++) {
			double d = HUGE_VAL;
			for (int i = 0; i < n; i++)
				d = fmin(d, distance(x + 0.5, y + 0.5, s[i]));
			pm_picture_blend(p, x, y, rgb, r + 0.5 - d);
		}
}

void pm_picture_line(struct pm_picture *p, double x0, double y0, double x1, double y1, double width, const unsigned char rgb[3])
{
	double s[1][4] = {{x0, y0, x1, y1}};
	stroke(p, 1, s, width, rgb);
}

void pm_picture_disc(struct pm_picture *p, double x, double y, double radius, const unsigned char rgb[3], double cover)
{
	if (!(x > -radius - 1 && y > -radius - 1 && x < p->width + radius + 1 && y < p->height + radius + 1))
		return;
	for (int j = (int)floor(y - radius - 1); j <= (int)floor(y + radius + 1); j++)
		for (int i = (int)floor(x - radius - 1); i <= (int)floor(x + radius + 1); i++)
			pm_picture_blend(p, i, j, rgb, cover * fmin(1, radius + 0.5 - hypot(i + 0.5 - x, j + 0.5 - y)));
}

static double glyph(struct pm_picture *p, double x, double y, double unit, bool turned, char c, const unsigned char rgb[3])
{
	double s[PM_STROKES][4], width;
	int n = pm_lettering(c, s, &width);
	for (int i = 0; i < n; i++)
		for (int k = 0; k < 4; k += 2) {
			double a = s[i][k] * unit, b = s[i][k + 1] * unit;
			s[i][k] = turned ? x - b : x + a;
			s[i][k + 1] = turned ? y - a : y - b;
		}
	if (p && n)
		stroke(p, n, s, fmax(1, unit * 1.7), rgb);
	return width * unit;
}

double pm_picture_text(struct pm_picture *p, double x, double y, double height, bool turned, const char *text, const unsigned char rgb[3])
{
	double along = 0, scale = 1, lift = 0;
	for (; *text; text++) {
		if (!strncmp(text, "^{", 2)) {
			scale = 0.72, lift = 0.55 * height, text++;
			continue;
		}
		if (*text == '}' && lift > 0) {
			scale = 1, lift = 0;
			continue;
		}
		if ((*text & 0xc0) == 0x80)
			continue; /* the second byte of a letter that is not in the table */
		along += glyph(p, turned ? x - lift : x + along, turned ? y - along : y - lift, height / PM_CAPITAL * scale, turned, *text, rgb);
	}
	return along;
}

int pm_picture_ppm(const struct pm_picture *p, FILE *out)
{
	fprintf(out, "P6\n%d %d\n255\n", p->width, p->height);
	return fwrite(p->rgb, 3, (size_t)p->width * (size_t)p->height, out) == (size_t)p->width * (size_t)p->height ? 0
		: pm_fail_errno("cannot write the picture");
}

enum { most_colours = 256, places = 4096 };

/* The colours of a picture that has few: their number, 0 if there are more than 256. index: a byte a pixel. */
static int palette(const struct pm_picture *p, png_color colours[most_colours], unsigned char *index)
{
	short at[places]; /* a table of places, open addressing; -1: free */
	int n = 0;
	memset(at, -1, sizeof at);
	for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; i++) {
		const unsigned char *c = p->rgb + 3 * i;
		size_t k = (c[0] * 7919u + c[1] * 104729u + c[2] * 1299709u) % places;
		while (at[k] >= 0 && memcmp(&colours[at[k]], c, 3))
			k = (k + 1) % places;
		if (at[k] < 0) {
			if (n == most_colours)
				return 0;
			colours[n] = (png_color){c[0], c[1], c[2]};
			at[k] = (short)n++;
		}
		index[i] = (unsigned char)at[k];
	}
	return n;
}

static int write_png(const struct pm_picture *p, FILE *out, unsigned char *index)
{
	png_color colours[most_colours];
	int n = palette(p, colours, index);
	png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
	png_infop info = png ? png_create_info_struct(png) : NULL;
	if (!info || setjmp(png_jmpbuf(png))) { /* libpng comes back here when it fails */
		png_destroy_write_struct(&png, &info);
		return pm_fail_errno("cannot write the picture");
	}
	png_init_io(png, out);
	png_set_compression_level(png, 9);
	png_set_IHDR(png, info, (png_uint_32)p->width, (png_uint_32)p->height, 8, n ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
		PNG_COMPRESSION_TYPE_DEFAULT,
		PNG_FILTER_TYPE_DEFAULT);
	if (n)
		png_set_PLTE(png, info, colours, n);
	png_write_info(png, info);
	for (size_t y = 0; y < (size_t)p->height; y++)
		png_write_row(png, n ? index + y * (size_t)p->width : p->rgb + 3 * y * (size_t)p->width);
	png_write_end(png, NULL);
	png_destroy_write_struct(&png, &info);
	return 0;
}

int pm_picture_png(const struct pm_picture *p, FILE *out)
{
	unsigned char *index = pm_alloc((size_t)p->width * (size_t)p->height, 1);
	int status = index ? write_png(p, out, index) : -PM_DATA;
	pm_free(index);
	return status;
}
