/* The most memory that the process held since a given moment, as Linux counts it (VmHWM, which "5" in clear_refs sets back to what is held now: proc(5)).
 * Other systems: unknown. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/base.h"

bool pm_memory_peak_begin(void)
{
	pm_memory_release();
	FILE *f = fopen("/proc/self/clear_refs", "w");
	bool done = f && fputs("5", f) >= 0;
	return f && !fclose(f) && done;
}

double pm_memory_peak(void)
{
	char line[256];
	double kib = NAN;
	FILE *f = fopen("/proc/self/status", "r");
	while (f && isnan(kib) && fgets(line, sizeof line, f))
		sscanf(line, "VmHWM: %lf kB", &kib);
	if (f)
		fclose(f);
	return 1024 * kib;
}
