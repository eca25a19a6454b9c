/* Snapshots of NEMO (Teuben's stellar dynamics toolbox) as frames. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NEMO_H
#define PM_NEMO_H

#include "stream/frame.h"

struct pm_nemo_item { /* of a structured binary file */
	char type;            /* ( begins a set, ) ends it; d f i l s c b h: data */
	const char *tag;      /* "" none */
	int ndim;
	uint64_t dim[9], count; /* count: values in all */
	bool swapped;         /* the other byte order */
	const unsigned char *data; /* in the file's bytes */
};

struct pm_nemo {
	const char *data; /* the file, with a 0 behind it */
	size_t size, at;
	struct pm_nemo_item mass; /* the last there was: NEMO writes masses that stay the same once */
	char left_out[512];       /* names of items that no frame has */
};

bool pm_nemo_is(const char *data, size_t size); /* by its first bytes */
/* The next snapshot that has particles: 1 and a frame of law free with set `set`; 0 no more; or failure. The box is not set. */
int pm_nemo_next(struct pm_nemo *r, const char *set, struct pm_frame **f);

#endif
