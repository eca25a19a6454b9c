/* --timing: a line of numbers for each word in a file, or something to read on standard error. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

#include "stage/divided.h"
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

/* Bytes with B, kB, MB or GB. */
static const char *amount(char to[16], double bytes)
{
	static const char *const unit[] = {"B", "kB", "MB", "GB"};
	int k = 0;
	for (; k < 3 && bytes >= 1e3; k++)
		bytes /= 1e3;
	snprintf(to, 16, "%.3g %s", bytes, unit[k]);
	return to;
}

/* A word is one on the other ranks, how often it stands in the sentence: the first has the sum. */
static void traffic(size_t n, const struct pm_stage *const *words, size_t i, char text[100])
{
	uint64_t sent[2] = {0, 0};
	double seconds = 0;
	struct pm_tally t;
	char a[16];
	for (size_t k = 0; k < n; k++) {
		if (strcmp(words[k]->word, words[i]->word) || !words[k]->frames[1])
			continue;
		if (k < i) {
			snprintf(text, 100, "  all ranks, counted above");
			return;
		}
		seconds += words[k]->shared, sent[0] += words[k]->sent[0], sent[1] += words[k]->sent[1];
	}
	if (pm_divided_tally(words[i], seconds, sent, &t))
		snprintf(text, 100, "  all ranks");
	else
		snprintf(text, 100, "  all ranks: %s in %llu messages, slowest/mean %.2f", amount(a, (double)t.bytes), (unsigned long long)t.messages,
			t.slowest);
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
	for (size_t i = 0; i < n; i++) {
		char where[100] = "";
		if (pm_world_size() > 1 && words[i]->frames[1])
			traffic(n, words, i, where);
		else if (pm_world_size() > 1)
			snprintf(where, sizeof where, "  rank 0 alone");
		fprintf(stderr, "%-*s  %9s  %9s  %3.0f %%%s\n", width, words[i]->word, readable(a, words[i]->setup), readable(b, words[i]->seconds),
			100 * words[i]->seconds / sum, where);
	}
	const struct pm_world_traffic own = pm_world_traffic();
	struct pm_tally t;
	char bytes[16];
	fprintf(stderr, "%-*s  %9s  %9s", width, "all", readable(a, setup), readable(b, sum));
	if (pm_world_size() > 1 && !pm_divided_tally(NULL, 0, (const uint64_t[]){own.bytes, own.messages}, &t))
		fprintf(stderr, "        sent, with what is given out and brought together: %s in %llu messages", amount(bytes, (double)t.bytes),
			(unsigned long long)t.messages);
	fprintf(stderr, "\n");
}
