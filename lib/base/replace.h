/* A file that is replaced when the new one is whole: written without a name, or under one of its own, in the same directory, then renamed.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_REPLACE_H
#define PM_REPLACE_H

#include <stdbool.h>

struct pm_replace {
	int fd;          /* to be written; closing it is the caller's */
	char *path;      /* what will be replaced: links followed; NULL: fd is the file itself, and there is nothing to do */
	char *temporary; /* NULL: it has no name yet */
};

/* Opens what will replace path. A file that is not there yet is opened itself unless `always`; so is what is no regular file (a pipe, a terminal).
 * 0 or failure with a message. */
int pm_replace_open(struct pm_replace *r, const char *path, bool always);
/* Gives it the name by which other processes open it, before it is complete; r->temporary. 0 or failure. */
int pm_replace_named(struct pm_replace *r);
/* The new file takes the place of the old one; lasting: it will be there after the machine has lost its power, too. */
int pm_replace_commit(struct pm_replace *r, bool lasting);
void pm_replace_drop(struct pm_replace *r); /* what was written is forgotten; also behind commit */
/* The name to be used for a file beside path, which a library opens itself; free() it. NULL: failure with a message. path: links are followed. */
char *pm_replace_name(const char *path, char **target);
int pm_replace_rename(const char *temporary, const char *path, bool lasting);
void pm_replace_abandon(void); /* the process ends: deletes the file of the last name */

/* A lock on a regular file that ends with the process: 1 taken, 0 another process has it, -1 this file system has no locks. */
int pm_lock_file(int fd);

#endif
