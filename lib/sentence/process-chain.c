/* Processes joined by pipes. A second thread writes while this one reads, so that a frame larger than the pipe buffers causes no deadlock.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sentence/process-chain.h"
#include "stage/h5-pipe.h"
#include "stage/apply.h"

struct pm_chain {
	int n;
	bool broken; /* a process failed: the others must end */
	pid_t *pid;  /* 0: already waited for */
	const char **name;
	struct pm_writer *to;
	struct pm_reader *from;
};

bool (*pm_chain_give_up)(void);

static void child(char **argv, int in, int out)
{
	char path[PATH_MAX + 64];
	const char *dir = pm_tool_find(argv[0]) ? pm_home() : NULL;
	pm_memory_end(NULL); /* a failure here must not end the parent's output */
	setpgid(0, 0); /* only cycle handles an interrupt from the terminal: it completes the step first */
	signal(SIGPIPE, SIG_DFL);
	setenv("OMP_WAIT_POLICY", "passive", 0); /* waiting threads must not occupy the cores of the other processes */
	setenv("PM_QUIET", "1", 1); /* its message arrives in the stream as an abort, and cycle prints it once */
	dup2(in, STDIN_FILENO);
	dup2(out, STDOUT_FILENO);
	if (dir) {
		snprintf(path, sizeof path, "%s/%s", dir, argv[0]);
		execv(path, argv);
	}
	execvp(argv[0], argv);
	snprintf(path, sizeof path, "cannot run '%s': %s", argv[0], strerror(errno));
	struct pm_writer *w = pm_writer_of_fd(STDOUT_FILENO);
	if (w)
		pm_write_abort(w, PM_DATA, path);
	_exit(127);
}

struct pm_chain *pm_chain_new(char ***words)
{
	struct pm_chain *c = calloc(1, sizeof *c);
	int in[2], out[2], n = 0, status = 0;
	while (words[n])
		n++;
	bool room = c && (c->pid = calloc((size_t)n, sizeof *c->pid)) && (c->name = calloc((size_t)n, sizeof *c->name));
	if (!room || pipe2(in, O_CLOEXEC)) {
		room ? pm_fail_errno("cannot make a pipe") : pm_no_memory();
		if (c)
			free(c->pid), free(c->name);
		free(c);
		return NULL;
	}
	for (int i = 0; i < n; i++)
		c->name[i] = words[i][0]; /* the sentence outlives its chains */
	c->to = pm_writer_of_fd(in[1]);
	int next = in[0];
	for (; c->n < n && !status; c->n++) {
		status = pipe2(out, O_CLOEXEC);
		c->pid[c->n] = status ? -1 : fork();
		if (!status && c->pid[c->n] == 0)
			child(words[c->n], next, out[1]);
		close(next);
		if (!status)
			close(out[1]);
		next = out[0];
		status = status || c->pid[c->n] < 0;
	}
	if (status) {
		pm_fail_errno("cannot start '%s'", words[c->n - 1][0]);
		free(c->pid), free(c->name), free(c);
		return NULL;
	}
	c->from = pm_reader_of_fd(next);
	if (c->from)
		pm_reader_give_up(c->from, pm_chain_give_up);
	return c;
}

struct sending {
	struct pm_writer *to;
	struct pm_frame *f; /* NULL: the end marker */
	int status;
	char message[512];
};

/* The writing thread; a process that has ended gives an error here (EPIPE), not a signal. */
static void *sending_run(void *p)
{
	struct sending *s = p;
	sigset_t set;
	sigemptyset(&set);
	sigaddset(&set, SIGPIPE);
	pthread_sigmask(SIG_BLOCK, &set, NULL);
	s->status = s->f ? pm_write_frame(s->to, s->f) : pm_write_end(s->to);
	if (s->status)
		snprintf(s->message, sizeof s->message, "%s", pm_message()); /* error messages are per thread */
	return NULL;
}

/* For a stream that was cut: finds which process ended and how. The system may need a moment to report it. */
static int who_died(struct pm_chain *c, int otherwise)
{
	for (int tries = 0; tries < 50; tries++) {
		for (int i = 0, how; i < c->n; i++) {
			if (c->pid[i] <= 0 || waitpid(c->pid[i], &how, WNOHANG) <= 0)
				continue;
			c->pid[i] = 0;
			if (WIFSIGNALED(how) && WTERMSIG(how) != SIGPIPE)
				return pm_fail(PM_DATA, "'%s' was killed by signal %d", c->name[i], WTERMSIG(how));
			if (WIFEXITED(how) && !pm_tool_find(c->name[i]))
				return pm_fail(PM_DATA, "'%s' ended with status %d before its input did", c->name[i], WEXITSTATUS(how));
		}
		usleep(2000);
	}
	return otherwise;
}

/* Sends a frame while reading the result. */
static int exchange(struct pm_chain *c, struct sending *s, struct pm_frame **back)
{
	pthread_t writer;
	if (pthread_create(&writer, NULL, sending_run, s))
		return pm_fail_errno("cannot start a thread");
	int got = pm_read_header(c->from, back);
	if (got == PM_GOT_FRAME) {
		int status = pm_read_payload(c->from, *back, true, NULL);
		got = status ? status : got;
	}
	if (got < 0) {
		bool gave_up = pm_chain_give_up && pm_chain_give_up();
		c->broken = true;
		char message[1024];
		snprintf(message, sizeof message, "%s", pm_message());
		bool cut = !gave_up && (!pm_reader_aborted(c->from) || strstr(message, "it was cut") || strstr(message, "zero bytes"));
		int died = cut ? who_died(c, 0) : 0; /* a later word of ours reports only that its input was cut */
		got = died ? died : pm_fail(-got, "%s", message);
		for (int i = 0; i < c->n; i++) /* a writer blocked on one of them then fails */
			if (c->pid[i] > 0)
				kill(c->pid[i], SIGTERM);
		for (int i = 0; i < c->n && gave_up; i++) /* with what it may have started */
			if (c->pid[i] > 0)
				kill(-c->pid[i], SIGKILL);
	}
	pthread_join(writer, NULL);
	return got;
}

int pm_chain_apply(struct pm_chain *c, struct pm_frame **f)
{
	struct sending s = {c->to, *f, 0, ""};
	struct pm_frame *back = NULL;
	int got = exchange(c, &s, &back);
	if (got != PM_GOT_FRAME) {
		pm_frame_free(back);
		return got < 0 ? got : pm_fail(PM_DATA, "a stage ended its output before its input ended");
	}
	pm_frame_free(*f);
	*f = back;
	return s.status ? pm_fail(PM_DATA, "%s", s.message) : 0;
}

static int last_words(struct pm_chain *c)
{
	struct sending s = {c->to, NULL, 0, ""};
	struct pm_frame *f = NULL;
	int got = exchange(c, &s, &f);
	pm_frame_free(f);
	return got == PM_GOT_END || got < 0 ? (got < 0 ? got : 0) : pm_fail(PM_DATA, "a stage sent a frame too many");
}

int pm_chain_close(struct pm_chain *c)
{
	if (!c)
		return 0;
	int status = c->broken ? 0 : last_words(c), how;
	pm_writer_close(c->to);
	pm_reader_close(c->from);
	for (int i = 0; i < c->n; i++) {
		bool bad = c->pid[i] > 0 && waitpid(c->pid[i], &how, 0) > 0 && (!WIFEXITED(how) || WEXITSTATUS(how));
		if (bad && !c->broken && !status)
			status = pm_fail(PM_DATA, "process %d of the sentence ended with status %d", i + 1,
				WIFEXITED(how) ? WEXITSTATUS(how) : 128 + WTERMSIG(how));
	}
	free(c->pid);
	free(c->name);
	free(c);
	return status;
}
