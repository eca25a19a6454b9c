/* A chart as SVG: text stays text, and the same chart gives the same bytes. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "chart/canvas.h"

static const double capital = 0.72; /* height of a capital over the size of the font */

static void points(FILE *out, size_t n, double (*xy)[2])
{
	for (size_t i = 0; i < n; i++)
		fprintf(out, "%s%.1f,%.1f", i ? " " : "", xy[i][0], xy[i][1]);
}

static void line(struct pm_canvas *c, size_t n, double (*xy)[2], double width, const double dash[2], const unsigned char rgb[3])
{
	fprintf(c->out, "<polyline fill=\"none\" stroke=\"#%02x%02x%02x\" stroke-width=\"%.2g\" stroke-linejoin=\"round\"", rgb[0], rgb[1], rgb[2], width);
	if (dash)
		fprintf(c->out, " stroke-dasharray=\"%.1f %.1f\"", dash[0], dash[1]);
	fputs(" points=\"", c->out);
	points(c->out, n, xy);
	fputs("\"/>\n", c->out);
}

static void shape(struct pm_canvas *c, size_t n, double (*xy)[2], const unsigned char rgb[3])
{
	fprintf(c->out, "<polygon fill=\"#%02x%02x%02x\" points=\"", rgb[0], rgb[1], rgb[2]);
	points(c->out, n, xy);
	fputs("\"/>\n", c->out);
}

static void disc(struct pm_canvas *c, double x, double y, double radius, const unsigned char rgb[3])
{
	fprintf(c->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"#%02x%02x%02x\"/>\n", x, y, radius, rgb[0], rgb[1], rgb[2]);
}

/* XML allows no control characters but tab, and what is not UTF-8 would make the whole file unreadable. */
static void letter(FILE *out, const char **s)
{
	const unsigned char *u = (const unsigned char *)*s;
	int more = *u < 0x80 ? 0 : *u >= 0xc2 && *u < 0xe0 ? 1 : *u >= 0xe0 && *u < 0xf0 ? 2 : *u >= 0xf0 && *u < 0xf5 ? 3 : -1;
	for (int k = 1; k <= more; k++)
		if ((u[k] & 0xc0) != 0x80)
			more = -1;
	if (more > 0 && ((*u == 0xe0 && u[1] < 0xa0) || (*u == 0xed && u[1] > 0x9f) || (*u == 0xf0 && u[1] < 0x90) || (*u == 0xf4 && u[1] > 0x8f)))
		more = -1;
	*s += more > 0 ? more : 0;
	if (*u == '&' || *u == '<' || *u == '>' || *u == '"')
		fputs(*u == '&' ? "&amp;" : *u == '<' ? "&lt;" : *u == '>' ? "&gt;" : "&quot;", out);
	else if (more < 0 || *u < 0x20 || *u == 0x7f)
		fputc('?', out);
	else
		fwrite(u, 1, (size_t)more + 1, out);
}

static void text(struct pm_canvas *c, const double at[2], double height, enum pm_canvas_anchor anchor, bool turned, const char *s, const unsigned char rgb[3])
{
	static const char *const anchors[] = {"start", "middle", "end"};
	double size = height / capital;
	bool high = false;
	fprintf(c->out, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%.1f\" fill=\"#%02x%02x%02x\"", at[0], at[1], size, rgb[0], rgb[1], rgb[2]);
	if (anchor != PM_CANVAS_START)
		fprintf(c->out, " text-anchor=\"%s\"", anchors[anchor]);
	if (turned)
		fprintf(c->out, " transform=\"rotate(-90 %.1f %.1f)\"", at[0], at[1]);
	fputc('>', c->out);
	for (; *s; s++)
		if (!strncmp(s, "^{", 2)) {
			fprintf(c->out, "<tspan dy=\"%.1f\" font-size=\"%.1f\">", -0.45 * size, 0.72 * size);
			high = true, s++;
		} else if (*s == '}' && high) {
			fprintf(c->out, "</tspan>%s", s[1] ? "" : "</text>\n");
			high = false;
			if (!s[1])
				return;
			fprintf(c->out, "<tspan dy=\"%.1f\">&#8203;</tspan>", 0.45 * size);
		} else
			letter(c->out, &s);
	fputs(high ? "</tspan></text>\n" : "</text>\n", c->out);
}

struct pm_canvas pm_canvas_svg(FILE *out, int width, int height)
{
	fprintf(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" font-family=\"Helvetica,Arial,sans-serif\">\n"
		"<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n", width, height, width, height, width, height);
	return (struct pm_canvas){line, shape, disc, text, NULL, out};
}

void pm_canvas_svg_end(struct pm_canvas *c) { fputs("</svg>\n", c->out); }
