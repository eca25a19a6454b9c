/* Pictures written to files, one a frame or all into one: what sdraw does with what it has drawn. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PICTURE_FILE_H
#define PM_PICTURE_FILE_H

#include "picture/picture.h"

struct pm_picture_files {
	const char *name; /* with %d or %04d once for the number of the frame, or without */
	bool ppm;         /* else png */
	bool standard;    /* ppm to standard output */
	FILE *movie;      /* ppm pictures one behind the other in one file; NULL: none is open */
};

/* Is the name one that can be written? 0, or failure in words. */
int pm_picture_files_check(const char *name);
/* The picture of frame number `frame`, from 1; the name of a new file is printed. 0 or failure. */
int pm_picture_files_write(struct pm_picture_files *files, const struct pm_picture *p, uint64_t frame);
int pm_picture_files_close(struct pm_picture_files *files);

#endif
