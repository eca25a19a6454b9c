/* sh5 on a pipe. A stream read from sh5 is complete if it has an end marker. A failure of an sh5 that writes is recognised by its standard error, one line
 * with the reason. SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "stage/h5-pipe.h"
#include "stream/declare.h"
#include "world/world.h"

struct pm_h5_pipe {
	pid_t pid;
	int said; /* its standard error */
};

const char *pm_home(void)
{
	static char path[PATH_MAX];
	ssize_t n = readlink("/proc/self/exe", path, sizeof path - 1);
	if (n <= 0)
		return NULL;
	path[n] = 0;
	return dirname(path);
}

bool pm_h5_pipe_is(const char *path)
{
	size_t n = path ? strlen(path) : 0;
	return (n > 3 && !strcmp(path + n - 3, ".h5")) || (n > 5 && !strcmp(path + n - 5, ".hdf5"));
}

enum pm_file_kind pm_file_kind(const char *path)
{
	static const char hdf5[] = "\211HDF\r\n\032\n", ours[] = "PMPIPE/";
	char head[8] = "";
	struct stat is;
	enum pm_file_kind by_name = pm_h5_pipe_is(path) ? PM_FILE_HDF5 : PM_FILE_OTHER;
	if (!strcmp(path, "-") || stat(path, &is) || !S_ISREG(is.st_mode))
		return by_name;
	int fd = open(path, O_RDONLY | O_CLOEXEC);
	ssize_t n = fd < 0 ? -1 : read(fd, head, sizeof head);
	if (fd >= 0)
		close(fd);
	if (n == sizeof head && !memcmp(head, hdf5, sizeof head))
		return PM_FILE_HDF5;
	return n == sizeof head && !memcmp(head, ours, sizeof ours - 1) ? PM_FILE_STREAM : by_name;
}

static void become(const char *const argv[])
{
	char beside[PATH_MAX + 8];
	const char *dir = pm_home();
	signal(SIGPIPE, SIG_DFL);
	pm_memory_end(NULL); /* a failure here must not end the parent's output */
	if (dir) {
		snprintf(beside, sizeof beside, "%s/sh5", dir);
		execv(beside, (char *const *)(uintptr_t)argv);
	}
	execvp("sh5", (char *const *)(uintptr_t)argv);
}

int pm_h5_pipe_fd(const char *path)
{
	const char *const argv[] = {"sh5", "--", path, NULL};
	int out[2];
	pid_t pid = pipe2(out, O_CLOEXEC) ? -1 : fork();
	if (pid < 0)
		return pm_fail_errno("cannot start sh5");
	if (pid == 0) {
		setenv("PM_QUIET", "1", 1); /* its message arrives in the stream as an abort */
		dup2(out[1], STDOUT_FILENO);
		become(argv);
		struct pm_writer *w = pm_writer_of_fd(STDOUT_FILENO);
		if (w)
			pm_write_abort(w, PM_DATA, "no program sh5, which .h5 files need (install it beside this program, or on PATH)");
		_exit(127);
	}
	close(out[1]);
	return out[0];
}

struct pm_reader *pm_h5_pipe_open(const char *path)
{
	int fd = path && pm_file_kind(path) == PM_FILE_HDF5 ? pm_h5_pipe_fd(path) : STDIN_FILENO;
	if (fd < 0)
		return NULL;
	return fd != STDIN_FILENO ? pm_reader_of_fd(fd) : pm_reader_open(path && strcmp(path, "-") ? path : NULL);
}

struct pm_writer *pm_h5_pipe_write(const char *path, struct pm_h5_pipe **rest)
{
	const char *const argv[] = {"sh5", "-o", path, NULL};
	int in[2], said[2];
	struct pm_h5_pipe *r = calloc(1, sizeof *r);
	if (!r) {
		pm_no_memory();
		return NULL;
	}
	if (pipe2(in, O_CLOEXEC) || pipe2(said, O_CLOEXEC) || (r->pid = fork()) < 0) {
		pm_fail_errno("cannot start sh5");
		free(r);
		return NULL;
	}
	if (r->pid == 0) {
		unsetenv("PM_QUIET");
		signal(SIGINT, SIG_IGN); /* it ends with its input; the stream contains its result */
		dup2(in[0], STDIN_FILENO);
		dup2(said[1], STDERR_FILENO);
		become(argv);
		fprintf(stderr, "sh5: no program sh5, which .h5 files need (install it beside this program, or on PATH)\n");
		_exit(PM_DATA);
	}
	close(in[0]);
	close(said[1]);
	signal(SIGPIPE, SIG_IGN); /* if it fails, its message is used */
	r->said = said[0];
	*rest = r;
	return pm_writer_of_fd(in[1]);
}

/* Makes the line on its standard error our message; 0 if there is none. */
static int complaint(struct pm_h5_pipe *r, int code)
{
	char text[2048];
	ssize_t n = read(r->said, text, sizeof text - 1);
	if (n <= 0)
		return 0;
	text[n] = 0;
	text[strcspn(text, "\n")] = 0;
	return pm_fail(code, "%s", text + (strncmp(text, "sh5: ", 5) ? 0 : 5));
}

static int wait_code(struct pm_h5_pipe *r)
{
	int how = 0;
	while (waitpid(r->pid, &how, 0) < 0 && errno == EINTR)
		;
	r->pid = 0;
	return WIFEXITED(how) ? WEXITSTATUS(how) : PM_DATA;
}

int pm_h5_pipe_reason(struct pm_h5_pipe *r, int status)
{
	fcntl(r->said, F_SETFL, O_NONBLOCK); /* it prints before it exits, so the line is complete if it exited first */
	int said = complaint(r, PM_DATA);
	fcntl(r->said, F_SETFL, 0);
	return said ? -wait_code(r) : status;
}

int pm_h5_pipe_close(struct pm_h5_pipe *r)
{
	if (!r)
		return 0;
	int status = r->pid ? complaint(r, PM_DATA) : 0, code = r->pid ? wait_code(r) : 0;
	if (code && !status)
		status = pm_fail(PM_DATA, "sh5 ended with status %d", code);
	close(r->said);
	free(r);
	return status ? -(code ? code : PM_DATA) : 0;
}

int pm_h5_pipe_first(const char *path, struct pm_frame **f)
{
	const bool apart = pm_world_apart(true); /* every rank that makes the stage reads the whole frame */
	struct pm_reader *r = pm_h5_pipe_open(path);
	const int got = r ? pm_read_frame(r, f) : -PM_DATA;
	int status = got < 0 ? got : got == PM_GOT_FRAME ? 0 : pm_fail(PM_DATA, "%s holds no frame", path);
	for (size_t i = 0; !status && i < (*f)->nfields; i++)
		status = pm_field_ready((*f)->fields[i]);
	if (r)
		pm_reader_close(r);
	pm_world_apart(apart);
	return status;
}
