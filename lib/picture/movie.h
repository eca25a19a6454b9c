/* A movie: pictures of one size piped into ffmpeg, which writes an MP4 file. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PICTURE_MOVIE_H
#define PM_PICTURE_MOVIE_H

#include <sys/types.h>

#include "base/replace.h"
#include "picture/picture.h"

struct pm_movie { /* zero at first */
	const char *name;
	double fps;             /* [1/s] pictures per second */
	pid_t pid;              /* of ffmpeg; 0: it does not run */
	FILE *pipe;             /* its standard input */
	int said;               /* its standard error, a file without a name */
	int width, height;      /* of the first picture */
	struct pm_replace file; /* appears under its name when it is complete */
};

int pm_movie_possible(void);                                       /* is ffmpeg on PATH? 0, or failure in words */
int pm_movie_add(struct pm_movie *m, const struct pm_picture *p);  /* the first one starts ffmpeg */
int pm_movie_end(struct pm_movie *m);                              /* 0, or failure with the first line of ffmpeg's own message */
void pm_movie_drop(struct pm_movie *m);                            /* frees; a movie that was not ended leaves no file */

#endif
