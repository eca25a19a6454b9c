/* Files replaced as a whole. A symbolic link is followed: what it names is replaced, never the link. Temporary names are made by mkostemp, so
 * no file of the user's is touched, nor that of another process. lasting: fsync of the file before the rename and of the directory behind it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/base.h"
#include "base/replace.h"

/* The directory of a path; free() it. */
static char *directory_of(const char *path)
{
	char *copy = strdup(path), *name = copy ? strdup(dirname(copy)) : NULL;
	free(copy);
	if (!name)
		pm_no_memory();
	return name;
}

/* DIRECTORY/.NAME.XXXXXX */
static char *name_beside(const char *path)
{
	char *directory = directory_of(path), *copy = strdup(path), *name = NULL;
	if (!directory || !copy || asprintf(&name, "%s/.%.200s.XXXXXX", directory, basename(copy)) < 0)
		name = NULL;
	free(directory), free(copy);
	return name;
}

/* Links followed; where the file is not there yet, path itself, unless a link leads to it. */
static char *target_of(const char *path)
{
	char *target = realpath(path, NULL);
	if (target || errno != ENOENT)
		return target;
	struct stat st;
	if (lstat(path, &st) || !S_ISLNK(st.st_mode))
		return strdup(path);
	errno = ELOOP;
	return NULL;
}

static bool device(const char *path) { return !strncmp(path, "/dev/", 5) || !strncmp(path, "/proc/", 6); }

static mode_t usual_mode(void)
{
	mode_t mask = umask(0);
	umask(mask);
	return 0666 & ~mask;
}

int pm_replace_open(struct pm_replace *r, const char *path, bool always)
{
	struct stat st;
	*r = (struct pm_replace){.fd = -1};
	bool there = !stat(path, &st);
	if (device(path) || (there ? !S_ISREG(st.st_mode) : !always)) {
		r->fd = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
		return r->fd < 0 ? pm_fail_errno("cannot write '%s'", path) : 0;
	}
	if ((there && access(path, W_OK)) || !(r->path = target_of(path)))
		return pm_fail_errno("cannot write '%s'", path);
	char *directory = directory_of(r->path), *name = name_beside(r->path);
	if (!directory || !name) {
		free(directory), free(name);
		pm_replace_drop(r);
		return pm_no_memory();
	}
	r->fd = open(directory, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
	if (r->fd < 0 && (r->fd = mkostemp(name, O_CLOEXEC)) >= 0)
		r->temporary = name;
	else
		free(name);
	free(directory);
	if (r->fd < 0 || fchmod(r->fd, there ? st.st_mode & 07777 : usual_mode())) {
		int status = pm_fail_errno("cannot write '%s'", path);
		pm_replace_drop(r);
		return status;
	}
	return 0;
}

int pm_replace_named(struct pm_replace *r)
{
	char self[64], *name = name_beside(r->path);
	snprintf(self, sizeof self, "/proc/self/fd/%d", r->fd);
	for (int tries = 0; name && tries < 100; tries++) {
		snprintf(name + strlen(name) - 6, 7, "%06x", (unsigned)(getpid() * 101 + tries) & 0xffffff);
		if (!linkat(AT_FDCWD, self, AT_FDCWD, name, AT_SYMLINK_FOLLOW)) {
			r->temporary = name;
			return 0;
		}
		if (errno != EEXIST)
			break;
	}
	int status = name ? pm_fail_errno("cannot write '%s'", r->path) : pm_no_memory();
	free(name);
	return status;
}

int pm_replace_rename(const char *temporary, const char *path, bool lasting)
{
	if (rename(temporary, path))
		return pm_fail_errno("cannot replace '%s'", path);
	char *directory = lasting ? directory_of(path) : NULL;
	int fd = directory ? open(directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
	if (fd >= 0) {
		fsync(fd); /* file systems that cannot do this refuse it */
		close(fd);
	}
	free(directory);
	return 0;
}

int pm_replace_commit(struct pm_replace *r, bool lasting)
{
	if (!r->path)
		return 0;
	if (lasting && fsync(r->fd) && errno != EINVAL)
		return pm_fail_errno("cannot write '%s'", r->path);
	int status = r->temporary ? 0 : pm_replace_named(r);
	status = status ? status : pm_replace_rename(r->temporary, r->path, lasting);
	if (!status) {
		free(r->temporary);
		r->temporary = NULL;
	}
	return status;
}

void pm_replace_drop(struct pm_replace *r)
{
	if (r->temporary)
		unlink(r->temporary);
	free(r->temporary), free(r->path);
	*r = (struct pm_replace){.fd = -1};
}

static char unfinished[PATH_MAX];

void pm_replace_abandon(void)
{
	if (*unfinished)
		unlink(unfinished);
}

char *pm_replace_name(const char *path, char **target)
{
	struct stat st;
	bool there = !stat(path, &st);
	*target = target_of(path);
	char *name = *target ? name_beside(*target) : NULL;
	if (*target && !name) {
		pm_no_memory();
		return NULL;
	}
	int fd = name && !(there && access(path, W_OK)) ? mkostemp(name, O_CLOEXEC) : -1;
	if (fd < 0) {
		pm_fail_errno("cannot write '%s'", path);
		free(name);
		return NULL;
	}
	fchmod(fd, there ? st.st_mode & 07777 : usual_mode());
	close(fd);
	snprintf(unfinished, sizeof unfinished, "%s", name);
	return name;
}

/* Of the open file, so that it is not lost when the process opens and closes the file elsewhere; flock would keep HDF5 from reading. */
int pm_lock_file(int fd)
{
	struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
	if (!fcntl(fd, F_OFD_SETLK, &whole))
		return 1;
	return errno == EAGAIN || errno == EACCES ? 0 : -1;
}
