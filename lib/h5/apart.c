/* HDF5 in a process of its own. What the reading process may use is limited: memory by RLIMIT_AS (4 GB, or PM_EXPAND_GB, and 16 times the size of the file),
 * and processor time by a timer that is set anew for each piece of the file (20 s, or PM_H5_SECONDS, and 1 s for every 50 MB).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "h5/apart.h"
#include "h5/node.h"
#include "stream/forward.h"
#include "stream/hand-over.h"
#include "stream/run.h"
#include "world/world.h"

static double number_of(const char *variable, double otherwise)
{
	const char *given = getenv(variable);
	double x = given ? strtod(given, NULL) : 0;
	return x > 0 && x < 1e9 ? x : otherwise;
}

static bool limited;

void pm_h5_goes_on(size_t bytes)
{
	double seconds = number_of("PM_H5_SECONDS", 20) + (double)bytes / 50e6;
	const struct itimerval t = {.it_value = {.tv_sec = (time_t)seconds, .tv_usec = (suseconds_t)((seconds - floor(seconds)) * 999999) + 1}};
	if (limited)
		setitimer(ITIMER_PROF, &t, NULL);
}

/* Bytes of address space in use; a program with a sanitizer has terabytes. */
static double in_use(void)
{
	double pages = 0;
	FILE *f = fopen("/proc/self/statm", "r");
	if (f && fscanf(f, "%lf", &pages) != 1)
		pages = 0;
	if (f)
		fclose(f);
	return pages * (double)sysconf(_SC_PAGESIZE);
}

static void limit(const char *path)
{
	struct stat st;
	double bytes = number_of("PM_EXPAND_GB", 4) * 1e9 + (stat(path, &st) ? 0 : 16 * (double)st.st_size), now = in_use();
	struct rlimit most;
	if (now < 1e11 && now + bytes < 1e18 && !getrlimit(RLIMIT_AS, &most) && now + bytes < (double)most.rlim_cur) {
		most.rlim_cur = (rlim_t)(now + bytes);
		setrlimit(RLIMIT_AS, &most);
	}
	limited = true;
	pm_h5_goes_on(0);
}

void pm_h5_more_room(const char *path)
{
	struct stat st;
	struct rlimit most;
	if (limited && !stat(path, &st) && !getrlimit(RLIMIT_AS, &most) && most.rlim_cur != RLIM_INFINITY) {
		rlim_t more = most.rlim_cur + 16 * (rlim_t)st.st_size;
		most.rlim_cur = more > most.rlim_cur && more < most.rlim_max ? more : most.rlim_max;
		setrlimit(RLIMIT_AS, &most);
	}
}

/* How it ended, as a failure; 0 if well. */
static int how_it_ended(int how, const char *doing)
{
	if (WIFEXITED(how) && !WEXITSTATUS(how))
		return 0;
	if (WIFEXITED(how))
		return pm_fail(PM_DATA, "the process that %s ended with status %d", doing, WEXITSTATUS(how));
	if (WTERMSIG(how) == SIGPROF)
		return pm_fail(PM_DATA, "the HDF5 library does not get on: the file is damaged (a slow machine: PM_H5_SECONDS=100 in the environment)");
	return pm_fail(PM_DATA, "the process that %s was ended by signal %d (HDF5 %u.%u.%u crashes on some damaged files)", doing, WTERMSIG(how),
		H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE);
}

static int wait_for(pid_t pid)
{
	int how = 0;
	while (waitpid(pid, &how, 0) < 0 && errno == EINTR)
		;
	return how;
}

/* The stream of the other process, as any word passes one on. */
static int relay(struct pm_reader *r, struct pm_writer *w, void (*seen)(void *who, const struct pm_frame *f), void *who)
{
	for (;;) {
		struct pm_frame *f = NULL;
		int got = pm_read_header(r, &f), status = got < 0 ? got : 0;
		if (got == PM_GOT_EOF)
			return 0;
		if (got == PM_GOT_END)
			status = pm_write_end(w);
		if (got == PM_GOT_FRAME) {
			status = pm_write_header(w, f);
			status = status ? status : pm_read_payload(r, f, false, w);
			status = status ? status : pm_write_payload(w, f);
			if (!status)
				seen(who, f);
		}
		pm_frame_free(f);
		if (status)
			return status;
	}
}

int pm_h5_read_apart(const char *path, struct pm_writer *w, void (*seen)(void *who, const struct pm_frame *f), void *who)
{
	int out[2];
	struct pm_ring *ring = pm_writer_hands(w) ? NULL : pm_ring_new(); /* NULL: blocks go through both processes as they are */
	pid_t pid = pipe2(out, O_CLOEXEC) ? -1 : fork();
	if (pid < 0)
		return pm_fail_errno("cannot start a process");
	if (ring)
		pm_ring_end(ring, pid == 0);
	if (pid == 0) {
		pm_writer_forked(w, ring);
		int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
		prctl(PR_SET_PDEATHSIG, SIGKILL);
		dup2(out[1], STDOUT_FILENO);
		dup2(nowhere, STDERR_FILENO); /* its message arrives as an abort; what libc prints before it aborts is none of ours */
		limit(path);
		return 1;
	}
	close(out[1]);
	struct pm_reader *r = pm_reader_of_fd(out[0]);
	if (r)
		pm_reader_ring(r, ring);
	int status = r ? relay(r, w, seen, who) : -PM_DATA;
	bool said = r && pm_reader_aborted(r);
	char text[1024];
	snprintf(text, sizeof text, "%s", pm_message());
	pm_reader_close(r);
	pm_ring_free(ring);
	int how = wait_for(pid), end = said || (status && WIFSIGNALED(how) && WTERMSIG(how) == SIGPIPE) ? 0 : how_it_ended(how, "reads the file");
	if (end || !status)
		return end;
	return pm_fail(-status, "%s", text + (said && !strncmp(text, "sh5: ", 5) ? 5 : 0));
}

int pm_h5_write_apart(void)
{
	if (pm_world_size() > 1) /* the others talk to this process */
		return 0;
	pid_t pid = fork();
	if (pid < 0)
		return pm_fail_errno("cannot start a process");
	if (pid == 0) {
		prctl(PR_SET_PDEATHSIG, SIGTERM);
		return 1;
	}
	int how = wait_for(pid);
	if (WIFEXITED(how))
		_exit(WEXITSTATUS(how)); /* it has said what there is to say */
	return how_it_ended(how, "writes the file");
}
