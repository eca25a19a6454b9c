/* Numbers for a page: little-endian, then base64 (RFC 4648). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "viewer/viewer-pack.h"

uint16_t pm_half_of(float x)
{
	uint32_t bits;
	memcpy(&bits, &x, sizeof bits);
	const uint16_t sign = (uint16_t)(bits >> 16 & 0x8000);
	const float size = fabsf(x);
	if (size < 6.103515625e-05f) /* below 2^-14 in steps of 2^-24; lrint rounds ties to even */
		return (uint16_t)(sign | (uint16_t)lrintf(size * 16777216.0f));
	bits = (bits & 0x7fffffff) - (112u << 23); /* the exponent's bias is 15, not 127 */
	bits += 0xfff + (bits >> 13 & 1);
	return (uint16_t)(sign | bits >> 13);
}

static char *base64(const unsigned char *data, size_t bytes)
{
	static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	char *text = pm_alloc((bytes + 2) / 3 * 4 + 1, 1), *to = text;
	if (!text)
		return NULL;
	for (size_t i = 0; i < bytes; i += 3) {
		const size_t left = bytes - i;
		const uint32_t three = (uint32_t)data[i] << 16 | (left > 1 ? (uint32_t)data[i + 1] << 8 : 0) | (left > 2 ? data[i + 2] : 0);
		*to++ = digits[three >> 18];
		*to++ = digits[three >> 12 & 63];
		*to++ = left > 1 ? digits[three >> 6 & 63] : '=';
		*to++ = left > 2 ? digits[three & 63] : '=';
	}
	*to = 0;
	return text;
}

static int append(struct pm_viewer_blocks *b, char *text)
{
	if (b->n == b->room) {
		const size_t room = b->room ? 2 * b->room : 16;
		char **more = realloc(b->text, room * sizeof *more);
		if (!more)
			return pm_no_memory();
		b->text = more, b->room = room;
	}
	b->bytes += strlen(text);
	b->text[b->n++] = text;
	return 0;
}

static void put(unsigned char *to, uint32_t bits, size_t size)
{
	for (size_t k = 0; k < size; k++)
		to[k] = (unsigned char)(bits >> 8 * k);
}

json_t *pm_viewer_pack(struct pm_viewer_blocks *b, size_t n, const double *value, enum pm_viewer_as as, double lo, double hi)
{
	const size_t size = as == PM_AS_F32 ? 4 : 2;
	double most = 0, step = 1;
	for (size_t i = 0; i < n; i++)
		most = fmax(most, fabs(value[i]));
	if (as == PM_AS_U16)
		step = hi > lo ? (hi - lo) / 65535 : 1;
	else
		lo = 0, step = as == PM_AS_F32 && ((most > 1e-30 && most < 1e30) || most == 0) ? 1 : most > 0 ? most : 1;
	unsigned char *data = pm_alloc(n * size + 1, 1);
	for (size_t i = 0; data && i < n; i++) {
		const double x = (value[i] - lo) / step;
		const float single = (float)x;
		uint32_t bits;
		memcpy(&bits, &single, sizeof bits);
		put(data + i * size, as == PM_AS_F32 ? bits : as == PM_AS_F16 ? pm_half_of(single) : (uint32_t)lrint(fmin(fmax(x, 0), 65535)), size);
	}
	char *text = data ? base64(data, n * size) : NULL;
	pm_free(data);
	if (!text || append(b, text)) {
		pm_free(text);
		return NULL;
	}
	static const char *const names[] = {"f32", "f16", "u16"};
	return json_pack("{s:I, s:s, s:f, s:f}", "at", (json_int_t)b->n - 1, "as", names[as], "lo", lo, "step", step);
}

void pm_viewer_blocks_free(struct pm_viewer_blocks *b)
{
	for (size_t i = 0; i < b->n; i++)
		pm_free(b->text[i]);
	free(b->text);
	*b = (struct pm_viewer_blocks){0};
}
