/* What a frame holds, in words or as a line of JSON: what sls prints. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_FRAME_LISTING_H
#define PM_MEASURE_FRAME_LISTING_H

#include <stdio.h>

#include "stream/frame.h"

struct pm_listing {
	bool data;    /* smallest, largest and mean value of every component; the data must be there */
	bool history; /* the programs that made the frame */
	bool report;  /* of the stages */
};

void pm_list_text(FILE *out, const struct pm_listing *c, const struct pm_frame *f, uint64_t number);
/* The header as in the stream, with the report and the ranges: one line. 0 or failure. */
int pm_list_json(FILE *out, const struct pm_listing *c, const struct pm_frame *f);

#endif
