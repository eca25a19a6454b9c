/* Pictures written to files, one a frame or all into one: what sdraw does with what it has drawn. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PICTURE_FILE_H
#define PM_PICTURE_FILE_H

#include "picture/movie.h"
#include "picture/picture.h"

enum pm_picture_kind { PM_PICTURE_PNG, PM_PICTURE_PPM, PM_PICTURE_MP4, PM_PICTURE_HTML /* written by lib/viewer */ };
extern const char *const pm_picture_kinds[]; /* their endings without the dot; NULL ends */

struct pm_picture_files {
	const char *name; /* with %d or %04d once for the number of the frame, or without; "-": standard output */
	double fps;       /* [1/s] of a movie */
	enum pm_picture_kind kind;
	FILE *series;     /* ppm pictures one behind the other in one file; NULL: none is open */
	struct pm_movie movie;
};

/* The kind of picture that the ending of the name says, or, where it has none, the format (one of pm_picture_kinds; NULL: not given, and "-" is a PNG). 0, or
 * failure in words: an unknown ending, one that contradicts the format, or a number of the frame that is not %d or %04d. */
int pm_picture_files_check(struct pm_picture_files *files, const char *format);
/* The picture of frame number `frame`, from 1; the name of a complete file is printed. 0 or failure. */
int pm_picture_files_write(struct pm_picture_files *files, const struct pm_picture *p, uint64_t frame);
int pm_picture_files_close(struct pm_picture_files *files);
void pm_picture_files_drop(struct pm_picture_files *files); /* frees; what is not complete leaves no movie */

#endif
