/* CRC-32C (Castagnoli, reflected polynomial 0x82F63B78; RFC 3720 appendix B.4). With SSE4.2 three interleaved streams, joined by the factor
 * of their length; a table otherwise. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/base.h"

static const uint32_t polynomial = 0x82F63B78u;

/* Polynomials over two elements, x^31 in the lowest bit: the product modulo that polynomial. */
static uint32_t times(uint32_t a, uint32_t b)
{
	uint32_t product = 0;
	for (; a; a <<= 1) {
		product ^= a >> 31 ? b : 0;
		b = b >> 1 ^ (b & 1 ? polynomial : 0);
	}
	return product;
}

/* x^(8 bytes): the factor of a checksum for as many zero bytes behind (Adler's crc32_combine). */
static uint32_t behind(size_t bytes)
{
	uint32_t product = 1u << 31; /* x^0 */
	for (uint32_t power = 1u << 23; bytes; bytes >>= 1, power = times(power, power)) /* from x^8 on */
		product = bytes & 1 ? times(power, product) : product;
	return product;
}

uint32_t pm_crc32c_join(uint32_t first, uint32_t second, size_t bytes) { return times(behind(bytes), first) ^ second; }

#ifdef __SSE4_2__
#include <nmmintrin.h>

enum { lane = 4096 }; /* bytes of each of the three streams */

static uint32_t lane_shift[4][256]; /* for `lane` bytes, byte by byte of the crc */

__attribute__((constructor)) static void lane_shift_fill(void) /* every start of a program pays for it */
{
	const uint32_t by = behind(lane);
	for (int k = 0; k < 4; k++)
		for (uint32_t v = 1; v < 256; v++) {
			const uint32_t others = v & (v - 1); /* it is linear: without the lowest bit, and that bit */
			lane_shift[k][v] = others ? lane_shift[k][others] ^ lane_shift[k][v ^ others] : times(by, v << 8 * k);
		}
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
