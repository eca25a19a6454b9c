/* Recorded commands as processes joined by pipes. Each is a program beside this one, started with its arguments as they are.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "again/recorded-run.h"
#include "stage/h5-pipe.h"

static pid_t processes[PM_RECORDED_MOST];

static void become(char **argv, int in, int out)
{
	char path[PATH_MAX + 64];
	pm_memory_end(NULL);
	signal(SIGPIPE, SIG_DFL);
	dup2(in, STDIN_FILENO);
	dup2(out, STDOUT_FILENO);
	snprintf(path, sizeof path, "%s/%s", pm_home() ? pm_home() : ".", argv[0]);
	execv(path, argv);
	pm_fail_errno("again: cannot run '%s'", path);
	fprintf(stderr, "%s\n", pm_message());
	_exit(127);
}

static int wait_for(pid_t pid)
{
	int how = 0;
	while (waitpid(pid, &how, 0) < 0 && errno == EINTR)
		;
	return how;
}

/* Ends those that run already: nobody reads what they write. */
static int given_up(int status, int started, int in, const int out[2])
{
	const int open[3] = {in, out[0], out[1]};
	for (int i = 0; i < 3; i++)
		if (open[i] >= 0)
			close(open[i]);
	while (started-- > 0)
		wait_for(processes[started]);
	return status;
}

int pm_recorded_start(const struct pm_recorded_run *run, int *end)
{
	int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
	for (int k = 0; k < run->n; k++) {
		int out[2] = {-1, -1};
		pid_t pid = in < 0 || pipe2(out, O_CLOEXEC) ? -1 : fork();
		if (pid < 0)
			return given_up(pm_fail_errno("cannot start '%s'", run->argv[k][0]), k, in, out);
		if (pid == 0)
			become(run->argv[k], in, out[1]);
		processes[k] = pid;
		close(in);
		close(out[1]);
		in = out[0];
	}
	*end = in;
	return 0;
}

int pm_recorded_wait(const struct pm_recorded_run *run)
{
	int status = 0;
	for (int k = 0; k < run->n; k++) {
		int how = wait_for(processes[k]);
		int code = WIFEXITED(how) ? WEXITSTATUS(how) : PM_DATA;
		if (code && !status)
			status = pm_fail(code <= PM_NUMERICS ? code : PM_DATA, "%s has failed, its reason is above", run->argv[k][0]);
	}
	return status;
}
