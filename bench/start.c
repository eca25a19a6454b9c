/* What it costs to start a filter: wall time of a process that reads a stream of no frames and writes one, above the time of /bin/true.
 * The commands take turns, so that a change of the machine's mood meets all of them; medians of 200 rounds.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/base.h"

extern char **environ;
enum { rounds = 200, most = 8 };

/* Seconds from before the spawn to after the wait; input is rewound. */
static double run(int input, char *const argv[])
{
	posix_spawn_file_actions_t fa;
	posix_spawn_file_actions_init(&fa);
	lseek(input, 0, SEEK_SET);
	posix_spawn_file_actions_adddup2(&fa, input, 0);
	posix_spawn_file_actions_addopen(&fa, 1, "/dev/null", O_WRONLY, 0);
	pid_t pid;
	int status;
	double t = pm_seconds();
	if (posix_spawnp(&pid, argv[0], &fa, NULL, argv, environ) || waitpid(pid, &status, 0) != pid || status) {
		fprintf(stderr, "start: %s failed\n", argv[0]);
		exit(1);
	}
	t = pm_seconds() - t;
	posix_spawn_file_actions_destroy(&fa);
	return t;
}

static int ascending(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

int main(void)
{
	char *commands[][4] = {{"/bin/true"}, {"push", "drift"}, {"p2m"}, {"m2p"}, {"mgrad"}, {"poisson-fft"}, {"diag"}};
	enum { n = sizeof commands / sizeof *commands };
	static double seconds[n][rounds];
	char line[65];
	snprintf(line, sizeof line, "%-63s\n", "PMPIPE/1 end 0");
	char name[] = "/tmp/pm-start-XXXXXX";
	int input = mkstemp(name);
	if (input < 0 || unlink(name) || write(input, line, 64) != 64)
		return 1;
	for (int r = 0; r < rounds; r++)
		for (int i = 0; i < n; i++)
			seconds[i][r] = run(input, commands[i]);
	for (int i = 0; i < n; i++)
		qsort(seconds[i], rounds, sizeof(double), ascending);
	double base = seconds[0][rounds / 2];
	printf("start\t/bin/true\t%.3f ms\n", 1e3 * base);
	for (int i = 1; i < n; i++)
		printf("start\t%s\t%.3f ms above /bin/true\n", commands[i][0], 1e3 * (seconds[i][rounds / 2] - base));
	return 0;
}
