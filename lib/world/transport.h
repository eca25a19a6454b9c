/* What a world must be able to do for the operations of world.h: four calls that move bytes between ranks. alone.c, rehearse.c and mpi.c are the three
 * worlds. mpi.c is an object of its own, which includes this header and nothing else of ours.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSPORT_H
#define PM_TRANSPORT_H

#include <stddef.h>
#include <stdint.h>

struct pm_message_part {
	int rank;     /* to whom, or from whom */
	void *data;
	size_t bytes; /* at most the length at which messages are cut; both ends know it */
};

enum pm_reduction { PM_SUM_OF, PM_LEAST_OF, PM_MOST_OF, PM_SUM_BEFORE /* of the ranks before this one */ };

/* Each call is made by all ranks in the same order. 0, or not: the world is broken (a rank has died), and no further call is made but close. */
struct pm_transport {
	int rank, size;
	void *self;
	int (*share)(struct pm_transport *t, int root, void *data, size_t bytes);
	int (*reduce)(struct pm_transport *t, enum pm_reduction how, size_t n, int64_t *values); /* the result is on all ranks */
	int (*turn)(struct pm_transport *t, const uint64_t *out, uint64_t *in);                  /* one number from each rank to each */
	/* All of these messages; between two ranks they arrive in the order in which they were sent. */
	int (*move)(struct pm_transport *t, size_t nout, const struct pm_message_part *out, size_t nin, const struct pm_message_part *in);
	void (*abort)(struct pm_transport *t, int code); /* ends all ranks */
	int (*close)(struct pm_transport *t);            /* 0, or not: another rank ended badly */
	const char *(*reason)(struct pm_transport *t);   /* why it is broken, in words */
};

/* What the object of mpi.c exports under the name pm_world_mpi: 0 and the transport, or the reason why not. */
enum { PM_TRANSPORT_VERSION = 1 };
struct pm_transport_maker {
	int version; /* PM_TRANSPORT_VERSION */
	const char *(*open)(struct pm_transport *t);
};

#endif
