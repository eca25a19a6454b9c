/* CRC-32C (Castagnoli, reflected polynomial 0x82F63B78; RFC 3720 appendix B.4). With SSE4.2 three interleaved streams, joined by the matrix
 * of the shift by their length; a table otherwise. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/base.h"

static const uint32_t polynomial = 0x82F63B78u;

/* The operator "append `bytes` zero bytes" applied to crc, by squaring the operator of one zero bit (Adler's crc32_combine). */
static uint32_t times(const uint32_t matrix[32], uint32_t v)
{
	uint32_t r = 0;
	for (int i = 0; v; i++, v >>= 1)
		if (v & 1)
			r ^= matrix[i];
	return r;
}

static void square(uint32_t out[32], const uint32_t in[32])
{
	for (int i = 0; i < 32; i++)
		out[i] = times(in, in[i]);
}

static uint32_t shift(uint32_t crc, size_t bytes)
{
	uint32_t a[32], b[32];
	a[0] = polynomial; /* one zero bit */
	for (int i = 1; i < 32; i++)
		a[i] = 1u << (i - 1);
	square(b, a), square(a, b), square(b, a); /* 2, 4, 8 bits: b is one byte */
	for (uint32_t *m = b, *s = a; bytes; bytes >>= 1) {
		if (bytes & 1)
			crc = times(m, crc);
		square(s, m);
		uint32_t *t = m;
		m = s, s = t;
	}
	return crc;
}

uint32_t pm_crc32c_join(uint32_t first, uint32_t second, size_t bytes) { return shift(first, bytes) ^ second; }

#ifdef __SSE4_2__
#include <nmmintrin.h>

enum { lane = 4096 }; /* bytes of each of the three streams */

static uint32_t lane_shift[4][256]; /* shift by `lane` bytes, byte by byte of the crc */

__attribute__((constructor)) static void lane_shift_fill(void)
{
	uint32_t a[32], b[32], *bit = a, *next = b;
	a[0] = polynomial;
	for (int i = 1; i < 32; i++)
		a[i] = 1u << (i - 1);
	for (int bits = 1; bits < 8 * lane; bits *= 2) { /* lane is a power of two: squaring is enough */
		square(next, bit);
		uint32_t *t = bit;
		bit = next, next = t;
	}
	for (int k = 0; k < 4; k++)
		for (uint32_t v = 0; v < 256; v++)
			lane_shift[k][v] = times(bit + 8 * k, v);
}

static uint32_t shift_lane(uint32_t c)
{
	return lane_shift[0][c & 255] ^ lane_shift[1][c >> 8 & 255] ^ lane_shift[2][c >> 16 & 255] ^ lane_shift[3][c >> 24];
}

static uint64_t word(const unsigned char *p)
{
	uint64_t w;
	memcpy(&w, p, 8);
	return w;
}

uint32_t pm_crc32c(uint32_t crc, const void *data, size_t bytes)
{
	const unsigned char *p = data;
	uint64_t c = ~crc;
	for (; bytes >= 3 * lane; bytes -= 3 * lane, p += 3 * lane) {
		uint64_t c1 = 0, c2 = 0;
		for (size_t i = 0; i < lane; i += 8) {
			c = _mm_crc32_u64(c, word(p + i));
			c1 = _mm_crc32_u64(c1, word(p + lane + i));
			c2 = _mm_crc32_u64(c2, word(p + 2 * lane + i));
		}
		c = shift_lane(shift_lane((uint32_t)c) ^ (uint32_t)c1) ^ (uint32_t)c2;
	}
	for (; bytes >= 8; bytes -= 8, p += 8)
		c = _mm_crc32_u64(c, word(p));
	for (; bytes; bytes--, p++)
		c = _mm_crc32_u8((uint32_t)c, *p);
	return ~(uint32_t)c;
}
#else
static uint32_t table[256];

__attribute__((constructor)) static void table_fill(void)
{
	for (uint32_t v = 0; v < 256; v++) {
		uint32_t c = v;
		for (int k = 0; k < 8; k++)
			c = c >> 1 ^ (c & 1 ? polynomial : 0);
		table[v] = c;
	}
}

uint32_t pm_crc32c(uint32_t crc, const void *data, size_t bytes)
{
	const unsigned char *p = data;
	crc = ~crc;
	for (; bytes; bytes--, p++)
		crc = crc >> 8 ^ table[(crc ^ *p) & 255];
	return ~crc;
}
#endif
