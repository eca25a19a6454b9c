/* A picture: pixels, lines, discs, letters; written as PNG or PPM. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PICTURE_H
#define PM_PICTURE_H

#include <stdio.h>

#include "base/base.h"

struct pm_picture {
	int width, height;
	unsigned char *rgb; /* rows from the top, 3 bytes a pixel */
};

int pm_picture_new(struct pm_picture *p, int width, int height, const unsigned char ground[3]);
void pm_picture_free(struct pm_picture *p);
/* All coordinates in pixels from the upper left corner, y downwards; pixel i covers i to i+1. What lies outside is not drawn. cover: 0 to 1. */
void pm_picture_blend(struct pm_picture *p, int x, int y, const unsigned char rgb[3], double cover);
void pm_picture_fill(struct pm_picture *p, int x0, int y0, int x1, int y1, const unsigned char rgb[3]);
void pm_picture_line(struct pm_picture *p, double x0, double y0, double x1, double y1, double width, const unsigned char rgb[3]);
void pm_picture_disc(struct pm_picture *p, double x, double y, double radius, const unsigned char rgb[3], double cover);
/* Text of the given cap height: the base line starts at x, y; turned: it runs upwards. ^{...} is a superscript. Returns the width; with p = NULL nothing is
 * drawn. */
double pm_picture_text(struct pm_picture *p, double x, double y, double height, bool turned, const char *text, const unsigned char rgb[3]);
int pm_picture_png(const struct pm_picture *p, FILE *out);
int pm_picture_ppm(const struct pm_picture *p, FILE *out);

#endif
