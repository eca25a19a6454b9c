/* Written under a temporary name and renamed when complete. SPDX-License-Identifier: GPL-3.0-or-later */
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/replace.h"
#include "cycle/checkpoint.h"
#include "stage/h5-pipe.h"
#include "stream/wire.h"

/* A stream of one frame. */
static int write_alone(struct pm_writer *w, struct pm_frame *f)
{
	int status = w ? pm_write_frame(w, f) : pm_failed();
	status = status || !w ? status : pm_write_end(w);
	int closed = w ? pm_writer_close(w) : 0;
	return status ? status : closed;
}

/* As HDF5: sh5 does the renaming. If its pipe closes during writing, sh5 has failed; a later close is normal. */
static int write_h5(const char *name, struct pm_frame *f)
{
	struct pm_h5_pipe *rest = NULL;
	void (*before)(int) = signal(SIGPIPE, SIG_IGN);
	int status = write_alone(pm_h5_pipe_write(name, &rest), f), closed = pm_h5_pipe_close(rest);
	signal(SIGPIPE, before);
	return closed ? closed : status;
}

/* Takes the lock of the file that has the name now, unless it is ours already. One cycle writes a checkpoint: the file in place is always locked by it. */
static int lock(struct pm_checkpoint *c)
{
	const char *name = c->name;
	for (int tries = 0; tries < 100; tries++) {
		struct stat mine, now;
		int fd = open(name, O_RDWR | O_CLOEXEC);
		if (fd < 0) /* none there; or one that cannot be written, which is said when it is */
			return 0;
		bool ours = c->lock >= 0 && !fstat(c->lock, &mine) && !fstat(fd, &now) && mine.st_dev == now.st_dev && mine.st_ino == now.st_ino;
		int got = ours ? -1 : pm_lock_file(fd);
		if (!got) {
			close(fd);
			return pm_fail(PM_DATA, "'%s' is the checkpoint of another cycle that runs (--checkpoint with a name of its own)", name);
		}
		if (got < 0) { /* ours, or a file system without locks */
			close(fd);
			return 0;
		}
		bool same = !fstat(fd, &mine) && !stat(name, &now) && mine.st_dev == now.st_dev && mine.st_ino == now.st_ino;
		if (same && c->lock >= 0)
			close(c->lock);
		if (same) {
			c->lock = fd;
			return 0;
		}
		close(fd); /* another took its place meanwhile */
	}
	return 0;
}

static int write_stream(struct pm_checkpoint *c, struct pm_frame *f)
{
	struct pm_writer *w = pm_writer_lasting(c->name);
	int fd = w ? fcntl(pm_writer_file(w), F_DUPFD_CLOEXEC, 0) : -1;
	if (fd >= 0)
		pm_lock_file(fd);
	int status = write_alone(w, f);
	if (status && fd >= 0)
		close(fd);
	if (!status && c->lock >= 0)
		close(c->lock);
	c->lock = status ? c->lock : fd;
	return status;
}

int pm_checkpoint_write(struct pm_checkpoint *c, struct pm_frame *f)
{
	const bool hdf = pm_h5_pipe_is(c->name);
	int status = lock(c);
	status = status ? status : hdf ? write_h5(c->name, f) : write_stream(c, f);
	status = status || !hdf ? status : lock(c);
	c->told = pm_seconds();
	return status && !strstr(pm_message(), c->name) ? pm_fail(-status, "checkpoint '%s': %s", c->name, pm_message()) : status;
}

/* The target is writable, and is not a device that the rename would replace. */
static int check(struct pm_checkpoint *c)
{
	struct stat st;
	struct pm_replace try;
	if (!strcmp(c->name, "-") || (!stat(c->name, &st) && !S_ISREG(st.st_mode)))
		return pm_fail(PM_USAGE, "--checkpoint '%s' is not a file", c->name);
	int status = lock(c);
	if (status || (status = pm_replace_open(&try, c->name, true)))
		return status;
	close(try.fd);
	pm_replace_drop(&try);
	return 0;
}

/* "500", or "30s", "10m", "1.5h". */
static int take_every(struct pm_checkpoint *c, const char *every)
{
	static const struct {
		const char *unit;
		double seconds;
	} units[] = {{"s", 1}, {"m", 60}, {"h", 3600}};
	char *end;
	const double x = strtod(every, &end);
	double seconds = *end ? 0 : 1;
	for (int i = 0; i < 3; i++)
		seconds = strcmp(end, units[i].unit) ? seconds : units[i].seconds;
	if (!(x > 0 && x <= 1e15) || !(*every >= '0' && *every <= '9') || seconds <= 0 || (!*end && x != (double)(int64_t)x))
		return pm_fail(PM_USAGE, "--checkpoint-every '%s' (a number of steps, or a time: 30s, 10m, 2h)", every);
	c->steps = *end ? 0 : (int64_t)x;
	c->seconds = *end ? x * seconds : 0;
	return c->name ? 0 : pm_fail(PM_USAGE, "--checkpoint-every needs --checkpoint FILE");
}

int pm_checkpoint_init(struct pm_checkpoint *c, const char *name, const char *every)
{
	*c = (struct pm_checkpoint){.name = name, .lock = -1, .told = pm_seconds()};
	const int status = every ? take_every(c, every) : 0;
	return status || !name ? status : check(c);
}

bool pm_checkpoint_with_frames(const struct pm_checkpoint *c) { return c->name && !c->steps && c->seconds <= 0; }

bool pm_checkpoint_due(const struct pm_checkpoint *c, const struct pm_frame *f)
{
	return c->name && ((c->steps && f->step % c->steps == 0) || (c->seconds > 0 && pm_seconds() - c->told >= c->seconds));
}

void pm_checkpoint_free(struct pm_checkpoint *c)
{
	if (c->lock >= 0)
		close(c->lock);
	c->lock = -1;
}
