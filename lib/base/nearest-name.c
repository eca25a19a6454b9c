/* The name nearest to a misspelt one. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/nearest-name.h"

enum { edit = 4, swap = 3 };

/* Edit distance of two words of at most 63 letters, in quarters: insert, delete, replace cost 4, swapping neighbours 3. */
static int distance(const char *a, const char *b)
{
	int n = (int)strlen(a), m = (int)strlen(b), d[65][65];
	if (n > 63 || m > 63)
		return 999;
	for (int i = 0; i <= n; i++)
		for (int j = 0; j <= m; j++) {
			if (!i || !j) {
				d[i][j] = edit * (i + j);
				continue;
			}
			int best = d[i - 1][j - 1] + edit * (a[i - 1] != b[j - 1]);
			best = d[i - 1][j] + edit < best ? d[i - 1][j] + edit : best;
			best = d[i][j - 1] + edit < best ? d[i][j - 1] + edit : best;
			if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && d[i - 2][j - 2] + swap < best)
				best = d[i - 2][j - 2] + swap;
			d[i][j] = best;
		}
	return d[n][m];
}

const char *pm_nearer(const char *word, const char *name, const char *best, int *least)
{
	int far = distance(word, name);
	if (!strncmp(word, name, strlen(word)) && strlen(word) >= 2)
		far = far > edit ? edit : far; /* an unfinished word is near */
	if (far >= *least || far > edit * (1 + (int)strlen(word) / 3))
		return best;
	*least = far;
	return name;
}

const char *pm_nearest(const char *word, const char *const *names)
{
	const char *best = NULL;
	int least = 999;
	for (int i = 0; names && names[i]; i++)
		best = pm_nearer(word, names[i], best, &least);
	return best;
}
