/* Plans of the transforms, one file of FFTW wisdom per plan in $XDG_CACHE_HOME/pmpipe or ~/.cache/pmpipe.
 * The name of a file holds the transform, its length, the effort and the signature of this FFTW on this processor; its first line holds a
 * CRC-32C of the rest. A plan is always made from the wisdom in its file and from nothing else (what is in memory is forgotten first), by
 * the process that measured it too, so it does not depend on which process measured it, nor on earlier plans. Measuring and writing
 * happen under a lock and end in a rename: the first writer wins, and every process reads back the stored file. If nothing can be stored, the plan is
 * estimated, which involves no timing. Source: Frigo and Johnson 2005 (FFTW 3); when plans are made and kept: docs/methods/poisson-fft.md, Plans.
 * Assumes a file system with flock and rename; without flock the cache counts as one that cannot be written.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "fft/fftw-plan.h"

enum { PATH = 1024, FILE_MOST = 1 << 20 };

const char *const pm_fft_effort_names[] = {"estimate", "measure", "patient", NULL};
static const unsigned effort_flag[] = {FFTW_ESTIMATE, FFTW_MEASURE, FFTW_PATIENT};
static const char *const transform_names[] = {"block-forward", "block-backward"};

int pm_fft_effort_find(const char *name)
{
	const char *from = "--plan";
	if (!name) {
		name = getenv("PM_PLAN");
		from = "PM_PLAN";
		if (!name || !*name)
			return PM_MEASURE;
	}
	for (int i = 0; pm_fft_effort_names[i]; i++)
		if (!strcmp(pm_fft_effort_names[i], name))
			return i;
	pm_fail(PM_USAGE, "%s is '%s' (choose estimate, measure or patient)", from, name);
	return -1;
}

static fftw_plan make(enum pm_fft_direction transform, size_t n, unsigned flags, double *block)
{
	fftw_iodim length = {(int)n, PM_FFT_LINES, PM_FFT_LINES}, lines = {PM_FFT_LINES / 2, 1, 1};
	bool back = transform == PM_BLOCK_BACKWARD; /* the transform of the other sign exchanges real and imaginary parts */
	double *re = block + (back ? PM_FFT_LINES / 2 : 0), *im = block + (back ? 0 : PM_FFT_LINES / 2);
	return fftw_plan_guru_split_dft(1, &length, 1, &lines, re, im, re, im, flags);
}

/* The first line of FFTW's wisdom names its version and the codelets this processor can run: wisdom is good only where it is the same. */
static uint32_t signature(void)
{
	fftw_forget_wisdom();
	char *w = fftw_export_wisdom_to_string();
	uint32_t sum = w ? pm_crc32c(0, w, strcspn(w, "\n")) : 0;
	free(w);
	return sum;
}

/* The cache directory, made if need be; "" if the user has none. */
static void cache_directory(char path[PATH])
{
	const char *xdg = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
	int n = 0;
	*path = 0;
	if (xdg && *xdg == '/')
		n = snprintf(path, PATH, "%s", xdg);
	else if (home && *home == '/')
		n = snprintf(path, PATH, "%s/.cache", home);
	if (n <= 0 || n >= PATH - 256) { /* room for the name of a file */
		*path = 0;
		return;
	}
	mkdir(path, 0700); /* if it fails, the following calls fail too and report it */
	strcat(path, "/pmpipe");
	mkdir(path, 0700);
}

static void note(struct pm_fft_plans *p, const char *path, const char *what)
{
	snprintf(p->note, sizeof p->note, "%.200s: %s", path, what);
}

/* The wisdom in a file with a correct checksum in its first line; NULL if there is no file (no note) or it is not ours (noted). */
static char *wisdom_read(struct pm_fft_plans *p, const char *path)
{
	int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC); /* a pipe of that name must not be waited for */
	struct stat st;
	bool plain = fd >= 0 && !fstat(fd, &st) && S_ISREG(st.st_mode);
	FILE *f = plain ? fdopen(fd, "r") : NULL;
	if (!f) {
		if (fd >= 0 || errno != ENOENT)
			note(p, path, fd >= 0 ? "not a plain file" : strerror(errno));
		if (fd >= 0)
			close(fd);
		return NULL;
	}
	char *text = malloc(FILE_MOST + 1);
	if (!text)
		pm_no_memory(); /* a program ends here; for others it is estimated */
	size_t n = text ? fread(text, 1, FILE_MOST, f) : 0;
	fclose(f);
	unsigned sum = 0;
	int head = 0;
	if (text) {
		text[n] = 0;
		if (sscanf(text, "pmpipe plan 1 %8x%n", &sum, &head) == 1 && text[head] == '\n' &&
		    pm_crc32c(0, text + head + 1, n - (size_t)head - 1) == sum && strlen(text) == n) {
			memmove(text, text + head + 1, n - (size_t)head);
			return text;
		}
	}
	note(p, path, "not a plan file of pmpipe");
	free(text);
	return NULL;
}

/* The whole file or nothing: written aside and renamed. */
static int wisdom_write(const char *path, const char *wisdom)
{
	char aside[PATH + 32];
	snprintf(aside, sizeof aside, "%s.%ld", path, (long)getpid());
	int fd = open(aside, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
	if (fd < 0 && errno == EEXIST && !unlink(aside)) /* of a process that is gone and had our number */
		fd = open(aside, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
	FILE *f = fd < 0 ? NULL : fdopen(fd, "w");
	if (!f)
		return -1;
	int bad = fprintf(f, "pmpipe plan 1 %08x\n%s", pm_crc32c(0, wisdom, strlen(wisdom)), wisdom) < 0;
	bad |= fclose(f) != 0;
	bad = bad || rename(aside, path) != 0;
	if (bad)
		unlink(aside);
	return -bad;
}

/* The plan that a file's wisdom holds, NULL if it holds none. */
static fftw_plan stored(struct pm_fft_plans *p, const char *path, enum pm_fft_direction transform, size_t n, double *block)
{
	char *w = wisdom_read(p, path);
	if (!w)
		return NULL;
	fftw_forget_wisdom();
	fftw_plan plan = NULL;
	if (fftw_import_wisdom_from_string(w))
		plan = make(transform, n, effort_flag[p->effort] | FFTW_WISDOM_ONLY, block);
	if (plan)
		p->sum = pm_crc32c(p->sum, w, strlen(w));
	else
		note(p, path, "wisdom of another FFTW or processor");
	free(w);
	return plan;
}

/* Measures and stores under the lock; the plan returned was read from the file. NULL: nothing can be stored. */
static fftw_plan measured(struct pm_fft_plans *p, const char *directory, const char *path, enum pm_fft_direction transform, size_t n, double *block)
{
	char name[PATH];
	snprintf(name, sizeof name, "%.990s/lock", directory);
	int lock = open(name, O_RDWR | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0600);
	struct stat st;
	bool plain = lock >= 0 && !fstat(lock, &st) && S_ISREG(st.st_mode);
	if (!plain || flock(lock, LOCK_EX)) {
		note(p, name, lock >= 0 && !plain ? "not a plain file" : strerror(errno));
		if (lock >= 0)
			close(lock);
		return NULL;
	}
	fftw_plan plan = stored(p, path, transform, n, block); /* another process may have been first */
	if (plan) {
		p->stored++;
		close(lock);
		return plan;
	}
	fftw_forget_wisdom();
	fftw_plan first = make(transform, n, effort_flag[p->effort], block);
	char *w = first ? fftw_export_wisdom_to_string() : NULL;
	fftw_destroy_plan(first);
	if (w && wisdom_write(path, w) == 0) {
		plan = stored(p, path, transform, n, block);
		p->measured += plan != NULL;
	} else {
		note(p, path, strerror(errno));
	}
	free(w);
	close(lock);
	return plan;
}

static fftw_plan find(struct pm_fft_plans *p, enum pm_fft_direction transform, size_t n, double *block)
{
	fftw_plan plan = NULL;
	char directory[PATH] = "", path[PATH];
	if (p->effort != PM_ESTIMATE)
		cache_directory(directory);
	if (*directory) {
		snprintf(path, sizeof path, "%.800s/fftw-%08x-%s-%s-%zu", directory, signature(), pm_fft_effort_names[p->effort], transform_names[transform],
			n);
		plan = stored(p, path, transform, n, block);
		if (plan)
			p->stored++;
		else
			plan = measured(p, directory, path, transform, n, block);
	}
	if (!plan) {
		fftw_forget_wisdom();
		plan = make(transform, n, FFTW_ESTIMATE, block);
		p->estimated++;
	}
	return plan;
}

fftw_plan pm_plan(struct pm_fft_plans *p, enum pm_fft_direction transform, size_t n)
{
	for (int i = 0; i < p->n; i++)
		if (p->entry[i].transform == transform && p->entry[i].n == n)
			return p->entry[i].plan;
	if (p->n == PM_FFT_PLANS || n > INT_MAX / PM_FFT_LINES) {
		pm_fail(PM_DATA, "no plan for transforms of length %zu", n);
		return NULL;
	}
	double *block = pm_zalloc(n * PM_FFT_LINES, sizeof *block);
	fftw_plan plan = block ? find(p, transform, n, block) : NULL;
	if (block && !plan)
		pm_fail(PM_DATA, "FFTW makes no plan for transforms of length %zu", n);
	pm_free(block);
	if (plan) {
		p->entry[p->n].transform = transform;
		p->entry[p->n].n = n;
		p->entry[p->n++].plan = plan;
	}
	return plan;
}

void pm_fft_plans_clear(struct pm_fft_plans *p)
{
	for (int i = 0; i < p->nmade; i++)
		p->unmake(p->made[i]);
	for (int i = 0; i < p->n; i++)
		fftw_destroy_plan(p->entry[i].plan);
	*p = (struct pm_fft_plans){.effort = p->effort};
}

struct pm_fft_plans *pm_fft_plans_new(enum pm_fft_effort effort)
{
	struct pm_fft_plans *p = pm_zalloc(1, sizeof *p);
	if (p)
		p->effort = effort;
	return p;
}

struct pm_fft_plans *pm_fft_plans_free(struct pm_fft_plans *p)
{
	if (p)
		pm_fft_plans_clear(p);
	return pm_free(p);
}
