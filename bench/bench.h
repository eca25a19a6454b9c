/* Shared by the benchmark programs: jobs run in turn, medians of seven with their spread, the limits of the machine, and a row of the table.
 * A row, tab-separated: kernel, case, threads, measured, unit, spread, bytes and operations needed per item, limit of the machine, fraction of it,
 * what it is compared with and its value, the ratio, the target, whether it is reached. "-": unknown or not applicable; "~": compared with a number recorded
 * on another machine. PM_MACHINE and PM_PEERS name files of rows `what, case, threads, value` of the same run.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BENCH_H
#define PM_BENCH_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/base.h"

enum { BENCH_ROUNDS = 7 };

struct bench_job {
	void (*run)(void *with);
	void *with;
	double seconds[BENCH_ROUNDS]; /* after bench_turns */
};

/* One thread is timed by processor time, so that other programs matter less; several threads by wall time. */
static inline double bench_clock(void)
{
	struct timespec t;
	if (pm_threads() > 1)
		return pm_seconds();
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Each job once untimed, then seven rounds in which they run in turn, so that a change of the machine's speed affects all of them. */
static inline void bench_turns(int n, struct bench_job *jobs)
{
	for (int r = -1; r < BENCH_ROUNDS; r++)
		for (int i = 0; i < n; i++) {
			double began = bench_clock();
			jobs[i].run(jobs[i].with);
			if (r >= 0)
				jobs[i].seconds[r] = bench_clock() - began;
		}
}

static inline int bench_rising(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

struct bench_middle {
	double median, spread; /* (second largest - second smallest) / median */
};

static inline struct bench_middle bench_middle(const double v[BENCH_ROUNDS])
{
	double s[BENCH_ROUNDS];
	memcpy(s, v, sizeof s);
	qsort(s, BENCH_ROUNDS, sizeof *s, bench_rising);
	return (struct bench_middle){s[BENCH_ROUNDS / 2], (s[BENCH_ROUNDS - 2] - s[1]) / s[BENCH_ROUNDS / 2]};
}

static inline double bench_median(const struct bench_job *j) { return bench_middle(j->seconds).median; }

/* Median over the rounds of a's seconds over b's: how much faster b is. */
static inline double bench_faster(const struct bench_job *a, const struct bench_job *b)
{
	double q[BENCH_ROUNDS];
	for (int r = 0; r < BENCH_ROUNDS; r++)
		q[r] = a->seconds[r] / b->seconds[r];
	return bench_middle(q).median;
}

/* The value of a row `what, name, threads` in the file that the variable names; NAN. */
static inline double bench_look(const char *variable, const char *what, const char *name, int threads)
{
	const char *file = getenv(variable);
	FILE *in = file ? fopen(file, "r") : NULL;
	char line[512], a[64], b[64];
	double value, found = NAN;
	int t;
	while (in && fgets(line, sizeof line, in))
		if (sscanf(line, "%63[^\t]\t%63[^\t]\t%d\t%lf", a, b, &t, &value) == 4 && !strcmp(a, what) && !strcmp(b, name) && t == threads)
			found = value;
	if (in)
		fclose(in);
	return found;
}

/* GB/s (read, copy, copy-nt, triad, triad-nt, update) or GFLOP/s (fma) of the same run, on as many threads as are in use. */
static inline double bench_machine(const char *name) { return bench_look("PM_MACHINE", "machine", name, pm_threads()); }

struct bench_row {
	const char *kernel, *name, *unit;
	double measured, spread;  /* [unit], relative */
	double bytes, flops;      /* an item moves, computes; 0: not counted */
	const char *stream;       /* the kind of memory traffic: a row of the machine, which with bytes and flops gives the limit */
	double per;               /* items/s of one unit (1e6: million items per second) */
	double limit;             /* [unit] if known from elsewhere; else 0 */
	const char *against;      /* NULL: nothing */
	double other;             /* its value in the same unit */
	bool recorded;            /* on another machine */
	double ratio;             /* NAN: measured / other */
	double least, most;       /* target of the ratio, of the fraction if there is none, or of the value itself; 0: none */
};

/* The limit of an item: its bytes at the machine's bandwidth or its operations, whichever takes longer. */
static inline double bench_limit(const struct bench_row *r)
{
	double memory = r->bytes > 0 && r->stream ? r->bytes / (1e9 * bench_machine(r->stream)) : 0;
	double work = r->flops > 0 ? r->flops / (1e9 * bench_machine("fma")) : 0;
	if (r->limit > 0)
		return r->limit;
	return memory > 0 || work > 0 ? 1 / ((memory > work ? memory : work) * r->per) : NAN;
}

static inline void bench_cell(double v, const char *format)
{
	char text[32] = "-";
	if (isfinite(v) && v != 0)
		snprintf(text, sizeof text, format, v);
	printf("\t%s", text);
}

static inline void bench_print(const struct bench_row *r)
{
	double limit = bench_limit(r), fraction = r->measured / limit;
	double ratio = !r->against ? NAN : isfinite(r->ratio) && r->ratio != 0 ? r->ratio : r->measured / r->other;
	double judged = r->against ? ratio : isfinite(fraction) ? fraction : r->measured;
	const char *sign = r->recorded ? "~" : "";
	printf("%s\t%s\t%d\t%.4g\t%s", r->kernel, r->name, pm_threads(), r->measured, r->unit);
	bench_cell(1e2 * r->spread, "%.0f%%");
	bench_cell(r->bytes, "%.4g");
	bench_cell(r->flops, "%.4g");
	bench_cell(limit, "%.4g");
	bench_cell(fraction, "%.2f");
	printf("\t%s%s", r->against ? r->against : "-", r->recorded ? " (recorded)" : "");
	bench_cell(r->other, "%.4g");
	printf("\t%s", isfinite(ratio) ? sign : "");
	if (isfinite(ratio))
		printf("%.2f", ratio);
	else
		printf("-");
	if (!(r->least > 0 || r->most > 0) || !isfinite(judged))
		printf("\t-\t-\n");
	else if (r->least > 0)
		printf("\t>= %g\t%s%s\n", r->least, sign, judged >= r->least ? "yes" : "no");
	else
		printf("\t<= %g\t%s%s\n", r->most, sign, judged <= r->most ? "yes" : "no");
	fflush(stdout);
}

/* A rate: items done in the median of the seconds. */
static inline void bench_rate(struct bench_row row, double items, const struct bench_job *j)
{
	row.measured = items / bench_median(j) / row.per;
	row.spread = bench_middle(j->seconds).spread;
	bench_print(&row);
}

/* Another code measured in turn with ours (seconds of both), else its recorded rate, else nothing. */
static inline void bench_against(struct bench_row row, double items, const struct bench_job *ours, const char *peer, const struct bench_job *theirs,
	double recorded)
{
	row.against = theirs || recorded > 0 ? peer : NULL;
	row.recorded = !theirs;
	row.other = theirs ? items / bench_median(theirs) / row.per : recorded;
	row.ratio = theirs ? bench_faster(theirs, ours) : NAN;
	if (!row.against)
		row.recorded = false, row.other = NAN, row.least = row.most = 0;
	bench_rate(row, items, ours);
}

#endif
