/* The cost of starting a filter: wall time of a process that reads and writes a stream without frames, compared with /bin/true.
 * The commands run in turn, so that a change of the machine's speed affects all of them; medians of 200 rounds.
 * start [FILE]: FILE is a stream with many particles and a small mesh, which poisson-fft then reads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"

extern char **environ;
enum { rounds = 200, most = 8 };

/* Seconds from before the spawn to after the wait; input is rewound. megabytes: most memory it had. */
static double run(int input, char *const argv[], double *megabytes)
{
	posix_spawn_file_actions_t fa;
	posix_spawn_file_actions_init(&fa);
	lseek(input, 0, SEEK_SET);
	posix_spawn_file_actions_adddup2(&fa, input, 0);
	posix_spawn_file_actions_addopen(&fa, 1, "/dev/null", O_WRONLY, 0);
	pid_t pid;
	int status;
	struct rusage used;
	double t = pm_seconds();
	if (posix_spawnp(&pid, argv[0], &fa, NULL, argv, environ) || wait4(pid, &status, 0, &used) != pid || status) {
		fprintf(stderr, "start: %s failed\n", argv[0]);
		exit(1);
	}
	t = pm_seconds() - t;
	*megabytes = (double)used.ru_maxrss / 1024;
	posix_spawn_file_actions_destroy(&fa);
	return t;
}

int main(int argc, char **argv)
{
	char *commands[][4] = {{"/bin/true"}, {"push", "drift"}, {"p2m"}, {"m2p"}, {"mgrad"}, {"poisson-fft"}, {"diag"}};
	enum { n = sizeof commands / sizeof *commands };
	static double seconds[n][rounds];
	char line[65];
	double megabytes;
	snprintf(line, sizeof line, "%-63s\n", "PMPIPE/1 end 0");
	char name[] = "/tmp/pm-start-XXXXXX";
	int input = mkstemp(name);
	if (input < 0 || unlink(name) || write(input, line, 64) != 64)
		return 1;
	for (int r = 0; r < rounds; r++)
		for (int i = 0; i < n; i++)
			seconds[i][r] = run(input, commands[i], &megabytes);
	for (int i = 0; i < n; i++)
		qsort(seconds[i], rounds, sizeof(double), bench_rising);
	double base = seconds[0][rounds / 2];
	bench_print(&(struct bench_row){.kernel = "start", .name = "/bin/true", .unit = "ms", .measured = 1e3 * base});
	for (int i = 1; i < n; i++)
		bench_print(&(struct bench_row){.kernel = "start", .name = commands[i][0], .unit = "ms", .measured = 1e3 * seconds[i][rounds / 2],
			.spread = (seconds[i][rounds * 7 / 8] - seconds[i][rounds / 8]) / seconds[i][rounds / 2], .most = 1});
	if (argc > 1 && (input = open(argv[1], O_RDONLY)) >= 0) {
		run(input, commands[5], &megabytes);
		bench_print(&(struct bench_row){.kernel = "start", .name = "memory of poisson-fft while particles are copied", .unit = "MB",
			.measured = megabytes, .most = 8});
	}
	return 0;
}
