/* Copies frames between a stream and an HDF5 file, whose own frames go piece by piece. Cost: that of the disk.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "h5/stream-copy.h"

/* The failure with the number of the frame in front. */
static int in_frame(const struct pm_reader *r, int status)
{
	char why[1024];
	if (pm_reader_aborted(r))
		return status;
	snprintf(why, sizeof why, "%s", pm_message());
	return pm_fail(-status, "frame %llu: %s", (unsigned long long)pm_reader_frame(r), why);
}

int pm_h5_from_stream(struct pm_h5 *h, struct pm_reader *r)
{
	for (;;) {
		struct pm_frame *f = NULL;
		int got = pm_read_header(r, &f), status = got < 0 ? got : 0;
		if (got == PM_GOT_EOF)
			return pm_h5_finish(h);
		if (got == PM_GOT_FRAME)
			status = pm_h5_put(h, f, r);
		else if (got == PM_GOT_END)
			status = pm_h5_put_end(h);
		pm_frame_free(f);
		if (status)
			return in_frame(r, status);
	}
}

int pm_h5_to_stream(struct pm_h5 *h, struct pm_writer *w, json_t *entry)
{
	for (;;) {
		struct pm_frame *f = NULL;
		bool foreign = false;
		int got = pm_h5_get(h, &f, &foreign), status = got < 0 ? got : 0;
		if (got == PM_GOT_EOF)
			return 0;
		if (got == PM_GOT_FRAME && foreign && entry) /* sh5 changes nothing, so it adds no entry */
			json_array_append(f->history, entry);
		if (!status)
			status = got == PM_GOT_END ? pm_write_end(w) : foreign ? pm_write_frame(w, f) : pm_h5_send(h, f, w);
		pm_frame_free(f);
		if (status)
			return status;
	}
}
