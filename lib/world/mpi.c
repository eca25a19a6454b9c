/* A world of MPI. This file is an object of its own (pmpipe-mpi.so), opened only under a launcher, so that no program links MPI. It needs nothing of ours.
 * Lengths of messages are below 2 GiB because world.c cuts them at 1 GiB. SPDX-License-Identifier: GPL-3.0-or-later */
#define _POSIX_C_SOURCE 200809L
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>
#include <stdlib.h>
#include <time.h>

#include "transport.h"

extern const struct pm_transport_maker pm_world_mpi;

enum { tag = 7 };

static MPI_Comm comm;

/* MPI waits by asking again and again. Ranks that wait for a word which runs on rank 0 alone would take the cores from its threads: after a millisecond or so
 * they sleep in between. */
static int share(struct pm_transport *t, int root, void *data, size_t bytes)
{
	const struct timespec nap = {0, 20000};
	MPI_Request request;
	int done = 0, status = MPI_Ibcast(data, (int)bytes, MPI_BYTE, root, comm, &request);
	(void)t;
	for (int tries = 0; !status && !done; tries++) {
		status = MPI_Test(&request, &done, MPI_STATUS_IGNORE);
		if (!done && tries > 2000)
			nanosleep(&nap, NULL);
	}
	return status;
}

static int reduce(struct pm_transport *t, enum pm_reduction how, size_t n, int64_t *values)
{
	const MPI_Op op = how == PM_LEAST_OF ? MPI_MIN : how == PM_MOST_OF ? MPI_MAX : MPI_SUM;
	if (how != PM_SUM_BEFORE)
		return MPI_Allreduce(MPI_IN_PLACE, values, (int)n, MPI_INT64_T, op, comm);
	const int status = MPI_Exscan(MPI_IN_PLACE, values, (int)n, MPI_INT64_T, op, comm);
	for (size_t i = 0; i < n && !t->rank; i++)
		values[i] = 0; /* MPI leaves it undefined there */
	return status;
}

static int turn(struct pm_transport *t, const uint64_t *out, uint64_t *in)
{
	(void)t;
	return MPI_Alltoall(out, 1, MPI_UINT64_T, in, 1, MPI_UINT64_T, comm);
}

static int move(struct pm_transport *t, size_t nout, const struct pm_message_part *out, size_t nin, const struct pm_message_part *in)
{
	(void)t;
	MPI_Request *all = malloc((nout + nin + 1) * sizeof *all);
	int status = !all, n = 0;
	for (size_t i = 0; i < nin && !status; i++)
		status = MPI_Irecv(in[i].data, (int)in[i].bytes, MPI_BYTE, in[i].rank, tag, comm, all + n++);
	for (size_t i = 0; i < nout && !status; i++)
		status = MPI_Isend(out[i].data, (int)out[i].bytes, MPI_BYTE, out[i].rank, tag, comm, all + n++);
	for (int i = 0; i < n && !status; i++) /* as MPI_Waitall, which compilers warn of with MPICH's MPI_STATUSES_IGNORE */
		status = MPI_Wait(all + i, MPI_STATUS_IGNORE);
	free(all);
	return status;
}

static void give_up(struct pm_transport *t, int code)
{
	(void)t;
	MPI_Abort(comm, code);
}

static int finish(struct pm_transport *t)
{
	(void)t;
	return MPI_Comm_free(&comm) || MPI_Finalize();
}

static const char *reason(struct pm_transport *t)
{
	(void)t;
	return "MPI has failed (its own message is above)";
}

static const char *begin(struct pm_transport *t)
{
	int level, known;
	if (MPI_Initialized(&known) || known)
		return "MPI is in use already";
	if (MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &level))
		return "MPI does not start";
	if (level < MPI_THREAD_FUNNELED)
		return "this MPI knows no threads";
	if (MPI_Comm_dup(MPI_COMM_WORLD, &comm) || MPI_Comm_rank(comm, &t->rank) || MPI_Comm_size(comm, &t->size))
		return "MPI has no ranks";
	t->self = NULL;
	t->share = share, t->reduce = reduce, t->turn = turn, t->move = move, t->abort = give_up, t->close = finish, t->reason = reason;
	return NULL;
}

const struct pm_transport_maker pm_world_mpi = {.version = PM_TRANSPORT_VERSION, .open = begin};
