/* --timing: a line of numbers for each word in a file, or something to read on standard error. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

#include "stage/internal.h"
#include "world/world.h"

/* Three digits with s, ms or us. */
static const char *readable(char to[16], double seconds)
{
	const double scale = seconds >= 1 ? 1 : seconds >= 1e-3 ? 1e3 : 1e6;
	const double x = seconds * scale;
	snprintf(to, 16, "%.*f %s", x < 9.995 ? 2 : x < 99.95 ? 1 : 0, x, scale == 1 ? "s" : scale == 1e3 ? "ms" : "us");
	return to;
}

static double seconds_of(struct timeval t) { return (double)t.tv_sec + 1e-6 * (double)t.tv_usec; }

void pm_timing_whole(struct pm_stage *s)
{
	struct rusage ended;
	s->seconds = s->processor = 0;
	pm_work_since(s, s->run->began);
	if (!getrusage(RUSAGE_CHILDREN, &ended))
		s->processor += seconds_of(ended.ru_utime) + seconds_of(ended.ru_stime);
}

int pm_timing_write(const struct pm_stage *s, const char *file)
{
	char work[16], setup[16];
	if (!file)
		return 0;
	if (!strcmp(file, "-")) {
		fprintf(stderr, "%.60s: %s of work, %s of set-up\n", s->word, readable(work, s->seconds), readable(setup, s->setup));
		return 0;
	}
	FILE *out = fopen(file, "a");
	if (!out)
		return pm_fail_errno("cannot write the timing to '%s'", file);
	bool bad = fprintf(out, "%s\t%.9f\t%.9f\t%.9f\n", s->word, s->setup, s->seconds, s->processor) < 0 || fflush(out);
	bad |= fclose(out);
	return bad ? pm_fail_errno("cannot write the timing to '%s'", file) : 0;
}

void pm_timing_table(size_t n, const struct pm_stage *const *words)
{
	double sum = 0, setup = 0;
	int width = 4;
	char a[16], b[16];
	for (size_t i = 0; i < n; i++) {
		sum += words[i]->seconds, setup += words[i]->setup;
		width = (int)strlen(words[i]->word) > width ? (int)strlen(words[i]->word) : width;
	}
	if (sum == 0) {
		fprintf(stderr, "the words ran as processes, whose times are not measured (--engine fused)\n");
		return;
	}
	fprintf(stderr, "%-*s  %9s  %9s  share\n", width, "word", "set-up", "work");
	for (size_t i = 0; i < n; i++)
		fprintf(stderr, "%-*s  %9s  %9s  %3.0f %%%s\n", width, words[i]->word, readable(a, words[i]->setup), readable(b, words[i]->seconds),
			100 * words[i]->seconds / sum, pm_world_size() == 1 ? "" : words[i]->frames[1] ? "  all ranks" : "  rank 0 alone");
	fprintf(stderr, "%-*s  %9s  %9s\n", width, "all", readable(a, setup), readable(b, sum));
}
