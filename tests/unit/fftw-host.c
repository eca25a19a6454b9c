/* FFTW's plans in a program that has wisdom of its own: it keeps its wisdom, and our plans and results are those of a program without.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fft/fft-block.h"

static const size_t lengths[] = {257, 514, 263};
enum { COUNT = sizeof lengths / sizeof *lengths, L = PM_FFT_LINES };

/* The host measures our very problem. */
static void measure(size_t n)
{
	fftw_iodim length = {(int)n, L, L}, lines = {L / 2, 1, 1};
	double *b = pm_zalloc(n * L, sizeof *b);
	fftw_destroy_plan(fftw_plan_guru_split_dft(1, &length, 1, &lines, b, b + L / 2, b, b + L / 2, FFTW_MEASURE));
	pm_free(b);
}

/* The checksum of our plans, and of what they compute. */
static void ours(uint32_t *plans, uint32_t *result)
{
	struct pm_fft_plans p = {0};
	*result = 0;
	for (int i = 0; i < COUNT; i++) {
		const size_t n = lengths[i];
		struct pm_fft *f = pm_fft(&p, n);
		double *b = pm_alloc(n * L, sizeof *b), u[2];
		for (size_t k = 0; k < n * L; k++) {
			pm_random(17, k, (uint64_t)i, u);
			b[k] = u[0] - 0.5;
		}
		if (f)
			pm_fft_forward(f, b);
		if (!f)
			check(false, "a transform of length %zu (%s)", n, pm_message());
		*result = pm_crc32c(*result, b, n * L * sizeof *b);
		pm_free(b);
	}
	*plans = p.sum;
	pm_fft_plans_clear(&p);
}

/* Lines of FFTW's wisdom come in no order of their own. */
static int compare(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }
static char *sorted(char *wisdom)
{
	char *line[4096], *out = calloc(1, strlen(wisdom) + 4096);
	size_t n = 0;
	for (char *l = strtok(wisdom, "\n"); l && n < 4096; l = strtok(NULL, "\n"))
		line[n++] = l;
	qsort(line, n, sizeof *line, compare);
	for (size_t i = 0; i < n; i++)
		strcat(out, line[i]), strcat(out, "\n");
	free(wisdom);
	return out;
}

int main(void)
{
	uint32_t plans, result, again, with_plans, with_result;
	char *empty = fftw_export_wisdom_to_string();
	ours(&plans, &result);
	char *none = fftw_export_wisdom_to_string();
	check(!strcmp(none, empty), "a host without wisdom has none afterwards");
	free(none), free(empty);
	ours(&again, &with_result);
	check(plans && plans == again && result == with_result, "the same plans and bytes the second time");
	for (int i = 0; i < COUNT; i++)
		measure(lengths[i]);
	char *before = sorted(fftw_export_wisdom_to_string());
	ours(&with_plans, &with_result);
	char *after = sorted(fftw_export_wisdom_to_string());
	check(strlen(before) > 300 && !strcmp(before, after), "a host keeps its wisdom");
	check(with_plans == plans && with_result == result, "our plans and bytes do not follow the host's wisdom");
	free(before), free(after);
	return check_done();
}
