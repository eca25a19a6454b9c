/* What the harnesses of `make fuzz` share (docs/reliability.md). libFuzzer calls LLVMFuzzerTestOneInput with one input after the other.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FUZZ_H
#define PM_FUZZ_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/base.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

/* What must be true whatever the input is: else the fuzzer keeps the input as a crash. */
static inline void fuzz_must(bool true_, const char *what)
{
	if (true_)
		return;
	fprintf(stderr, "not true: %s: %s\n", what, pm_message());
	abort();
}

/* Every refusal is one line without control characters. */
static inline void fuzz_refused(void)
{
	const char *m = pm_message();
	fuzz_must(*m && !strpbrk(m, "\n\r\033"), "a refusal has one line of message");
}

/* A file in memory that holds these bytes, at its beginning. *fd is made at the first call. */
static inline void fuzz_file(int *fd, const void *data, size_t n)
{
	if (*fd < 0)
		*fd = memfd_create("fuzz", MFD_CLOEXEC);
	fuzz_must(*fd >= 0 && !ftruncate(*fd, 0) && pwrite(*fd, data, n, 0) == (ssize_t)n && !lseek(*fd, 0, SEEK_SET), "there is a file in memory");
}

/* The bytes as a text of C, which ends in a 0; free() it. Its size is exact, so that the sanitizer reports a read past the end. */
static inline char *fuzz_text(const uint8_t *data, size_t n)
{
	char *text = malloc(n + 1);
	fuzz_must(text, "there is memory");
	memcpy(text, data, n);
	text[n] = 0;
	return text;
}

#endif
