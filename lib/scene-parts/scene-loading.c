/* Starts of particles: at random, or quiet. A quiet start has positions and velocities that fill phase space evenly: numbers reversed in different bases, so
 * that positions and velocities do not go together; Sobol's sequence; a lattice with weights. Noise of a mode of n particles: n^(-1/2) at random; for the
 * sequences about log(n)/n at the start, but as each particle has a velocity of its own, few are near a phase velocity, and noise grows there; the
 * lattice has none until its beams are in phase again (recurrence), after 2 pi/(k dv), dv = 12 vth over their number B, or unstable by themselves: that grows
 * from 1e-9 to the noise of the sequences in about 0.5 to 0.7 B/omega_p.
 * Source: Hammersley 1960; Sobol 1967; Birdsall and Langdon 1985, section 16-3; Dawson 1960 and Byers and Grewal 1970 (beams). Cost n.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_qrng.h>

#include "scene-parts/scene-loading.h"

const char *const pm_loading_names[] = {"lattice", "bit-reversed", "sobol", "random", NULL};

double pm_scene_digits_reversed(uint64_t i, uint64_t base)
{
	double x = 0, digit = 1 / (double)base;
	for (; i; i /= base, digit /= (double)base)
		x += (double)(i % base) * digit;
	return x;
}

static int sobol(uint64_t n, int axes, double *const u[PM_LOAD_AXES])
{
	gsl_qrng *q = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)axes);
	double x[PM_LOAD_AXES];
	if (!q)
		return pm_no_memory();
	for (uint64_t i = 0; i < n; i++) {
		gsl_qrng_get(q, x);
		for (int d = 0; d < axes; d++)
			u[d][i] = x[d];
	}
	gsl_qrng_free(q);
	return 0;
}

int pm_scene_points(enum pm_loading how, uint64_t seed, uint64_t n, int axes, double *const u[PM_LOAD_AXES])
{
	static const uint64_t base[PM_LOAD_AXES - 1] = {2, 3, 5, 7, 11, 13, 17};
	if (how == PM_SOBOL)
		return sobol(n, axes, u);
#pragma omp parallel for schedule(static) if (n > 16384)
	for (uint64_t i = 0; i < n; i++) {
		double z[PM_LOAD_AXES / 2][2];
		for (int pair = 0; 2 * pair < axes && how == PM_RANDOM; pair++)
			pm_random(seed, i, (uint64_t)pair, z[pair]);
		for (int d = 0; d < axes; d++)
			u[d][i] = how == PM_RANDOM ? z[d / 2][d % 2] : d == axes - 1 ? ((double)i + 0.5) / (double)n
				: pm_scene_digits_reversed(i, base[d]) + 0.25 / (double)n;
	}
	return 0;
}

double pm_scene_normal_of(double u)
{
	const double p = u < 0.5 ? u : 1 - u, t = sqrt(-2 * log(p));
	double z = t - (2.515517 + t * (0.802853 + t * 0.010328)) / (1 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
	for (int i = 0; i < 3; i++) /* each step squares the error of 4.5e-4 */
		z += (0.5 * erfc(z / sqrt(2)) - p) / (exp(-0.5 * z * z) / sqrt(2 * pm_pi));
	return u < 0.5 ? -z : z;
}

static double speed(const struct pm_scene_beams *b, uint64_t beam) { return 12 * ((double)beam + 0.5) / (double)b->beams - 6; }

int pm_scene_beams_init(uint64_t n, double beams, struct pm_scene_beams *b)
{
	*b = (struct pm_scene_beams){.n = n, .beams = beams > 0 ? (uint64_t)beams : (uint64_t)fmax(1, round(sqrt(0.8 * (double)n)))};
	if (beams != floor(beams) || (n && b->beams > n))
		return pm_fail(PM_USAGE, "%llu particles do not make %g beams (--beams a whole number, at most -n)", (unsigned long long)n, beams);
	for (uint64_t i = 0; i < b->beams; i++)
		b->total += exp(-0.5 * speed(b, i) * speed(b, i));
	return 0;
}

struct pm_scene_beam_point pm_scene_beam_at(const struct pm_scene_beams *b, uint64_t i)
{
	/* beam m has the particles from m n/beams on, rounded up */
	const uint64_t beam = (uint64_t)((unsigned __int128)i * b->beams / b->n), from = (uint64_t)(((unsigned __int128)beam * b->n + b->beams - 1) / b->beams),
		to = (uint64_t)(((unsigned __int128)(beam + 1) * b->n + b->beams - 1) / b->beams);
	const double z = speed(b, beam), each = (double)(to - from);
	/* each lattice is offset (golden section), or their images on the mesh would come into phase repeatedly */
	const double first = fmod(0.6180339887498949 * ((double)beam + 1), 1);
	return (struct pm_scene_beam_point){.place = ((double)(i - from) + first) / each, .velocity = z, .weight = exp(-0.5 * z * z) / b->total / each};
}
