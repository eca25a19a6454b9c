/* "PMPIPE/1 word number ... checksum": words with one space between, padded with spaces to 63 bytes, and a newline. The checksum, 8 hex digits, is the
 * CRC-32C of the words before it and of the block behind the line. SPDX-License-Identifier: GPL-3.0-or-later */
#include "stream/line.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { seal_digits = 8, prefix = 9 }; /* bytes of the checksum, and of "PMPIPE/1 " */

static int damaged(void) { return pm_fail(PM_DATA, "a line of the stream is damaged"); }

static int numbers_of(const char *word)
{
	static const char *const two[] = {"frame", "abort", "shared", "given"}, *const one[] = {"tail", "end", "copied"};
	for (size_t i = 0; i < sizeof two / sizeof *two; i++)
		if (!strcmp(word, two[i]))
			return 2;
	for (size_t i = 0; i < sizeof one / sizeof *one; i++)
		if (!strcmp(word, one[i]))
			return 1;
	return -1;
}

static bool decimal(const char *text, size_t n, uint64_t *out)
{
	char *end;
	errno = 0;
	*out = strtoull(text, &end, 10);
	return n && strspn(text, "0123456789") == n && end == text + n && !errno;
}

static bool checksum(const char *text, size_t n, uint32_t *out)
{
	if (n != seal_digits || strspn(text, "0123456789abcdef") != n)
		return false;
	*out = (uint32_t)strtoul(text, NULL, 16);
	return true;
}

/* Of a word it does not know it reads no more than the word, for the caller's message. */
int pm_line_parse(const char text[PM_LINE], struct pm_line *line)
{
	char copy[PM_LINE + 1];
	memcpy(copy, text, PM_LINE);
	copy[PM_LINE] = 0;
	*line = (struct pm_line){0};
	if (!memcmp(copy, "\211HDF", 4))
		return pm_fail(PM_DATA, "this is an HDF5 file (give its name, which ends in .h5, or put sh5 FILE before this word)");
	if (memcmp(copy, "PMPIPE/", 7))
		return pm_fail(PM_DATA, "this is not a pmpipe stream (stab - reads text, sh5 reads HDF5)");
	if (memcmp(copy, "PMPIPE/1 ", prefix))
		return pm_fail(PM_DATA, "the stream has version %ld, this program reads version 1 (use a newer pmpipe)", strtol(copy + 7, NULL, 10));
	size_t n = PM_LINE - 1, k = strspn(copy + prefix, "abcdefghijklmnopqrstuvwxyz");
	if (copy[n] != '\n' || !k || k >= sizeof line->word)
		return damaged();
	while (copy[n - 1] == ' ')
		n--;
	copy[n] = 0;
	memcpy(line->word, copy + prefix, k);
	int numbers = numbers_of(line->word);
	char *at = copy + prefix + k;
	for (int i = 0; i < numbers; i++, at += k) {
		k = *at == ' ' ? strcspn(at + 1, " ") + 1 : 0;
		if (!k || !decimal(at + 1, k - 1, line->number + i))
			return damaged();
	}
	line->crc = pm_crc32c(0, copy, (size_t)(at - copy));
	line->sealed = at != copy + n;
	if (numbers >= 0 && line->sealed && (*at != ' ' || !checksum(at + 1, (size_t)(copy + n - at - 1), &line->seal)))
		return damaged();
	return 0;
}

int pm_line_check(const struct pm_line *line, const void *block, size_t bytes, const char *what)
{
	if (!line->sealed || pm_crc32c(line->crc, block, bytes) == line->seal)
		return 0;
	const char *unsealed = getenv("PM_UNSEALED");
	if (unsealed && !strcmp(unsealed, "1"))
		return 0;
	return pm_fail(PM_DATA, "the checksum of %s is wrong: it is damaged, or was edited without a new checksum (docs/stream.md)", what);
}

void pm_line_seal(char out[PM_LINE], const char *words, const void *block, size_t bytes)
{
	size_t n = strlen(words);
	uint32_t crc = pm_crc32c(pm_crc32c(0, words, n), block, bytes);
	memset(out, ' ', PM_LINE);
	memcpy(out, words, n);
	for (size_t i = 0; i < seal_digits; i++)
		out[n + 1 + i] = "0123456789abcdef"[crc >> 4 * (seal_digits - 1 - i) & 15];
	out[PM_LINE - 1] = '\n';
}
