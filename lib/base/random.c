/* Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel random numbers: as easy as 1, 2, 3"): four 32-bit words from a key and a counter.
 * The key is the seed, the counter is (id, counter): a number depends on the particle and its use, not on threads or the order of particles.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/base.h"

static void philox(uint64_t seed, uint64_t id, uint64_t counter, uint32_t x[4])
{
	uint32_t k0 = (uint32_t)seed, k1 = (uint32_t)(seed >> 32);
	x[0] = (uint32_t)id, x[1] = (uint32_t)(id >> 32), x[2] = (uint32_t)counter, x[3] = (uint32_t)(counter >> 32);
	for (int round = 0; round < 10; round++) {
		uint64_t a = 0xD2511F53ull * x[0], b = 0xCD9E8D57ull * x[2];
		uint32_t y0 = (uint32_t)(b >> 32) ^ x[1] ^ k0, y2 = (uint32_t)(a >> 32) ^ x[3] ^ k1;
		x[0] = y0, x[1] = (uint32_t)b, x[2] = y2, x[3] = (uint32_t)a;
		k0 += 0x9E3779B9u, k1 += 0xBB67AE85u; /* the Weyl constants of the paper */
	}
}

void pm_random(uint64_t seed, uint64_t id, uint64_t counter, double u[2])
{
	uint32_t x[4];
	philox(seed, id, counter, x);
	for (int i = 0; i < 2; i++) /* 53 bits, shifted by half a step so that neither 0 nor 1 occurs */
		u[i] = ((double)(((uint64_t)x[2 * i] << 32 | x[2 * i + 1]) >> 12) + 0.5) * 0x1p-52;
}

void pm_random_normal(uint64_t seed, uint64_t id, uint64_t counter, double z[2])
{
	double u[2];
	pm_random(seed, id, counter, u);
	double r = sqrt(-2 * log(u[0])), a = 2 * pm_pi * u[1]; /* Box and Muller 1958; u[0] > 0 */
	z[0] = r * cos(a), z[1] = r * sin(a);
}
