/* A world of n ranks on this machine: processes joined by lanes in shared memory. For tests: what MPI does over a network, these do in milliseconds, under
 * sanitizers, with delays and a death at a chosen call, which all others see.
 * PM_REHEARSE="seed=3 delay=500 kill=2:17": each call waits up to 500 us, at random from the seed; rank 2 is killed at its 17th call. memory=1:17: from its
 * 17th call on rank 1 gets no more memory. limit=1:4096: rank 1 cannot write beyond 4096 bytes of a file. one-thread: a call where threads work side by side
 * ends the rank, because with MPI only its first thread may call.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "world/lanes.h"
#include "world/world.h"

struct rehearsal {
	int n;
	struct pm_lanes *lanes;
	pid_t *pid;     /* rank 0: of each rank; 0: not one, or waited for */
	struct queue {
		size_t at, done; /* message of the list, bytes of it */
	} *in, *out;    /* by rank */
	bool *gone;     /* by rank: seen to have ended */
	uint64_t seed, calls;
	double delay;   /* [us] */
	bool one_thread;
	int kill_rank, starve_rank, limit_rank;  /* -1 none */
	uint64_t kill_call, starve_call, limit;
};

static char why[160]; /* outlives the rehearsal */
static bool killed;    /* it names a rank that was killed, which is the reason for all that followed */

static void limit(int what, uint64_t bytes)
{
	struct rlimit now;
	getrlimit((__rlimit_resource_t)what, &now);
	now.rlim_cur = (rlim_t)bytes;
	setrlimit((__rlimit_resource_t)what, &now);
}

static void faults(struct pm_transport *t)
{
	struct rehearsal *r = t->self;
	double u[2];
	r->calls++;
	if (r->one_thread && omp_in_parallel()) {
		fputs("rehearsal: a rank called others where its threads work side by side\n", stderr);
		_exit(1);
	}
	if (r->kill_rank == t->rank && r->calls == r->kill_call)
		raise(SIGKILL);
	if (r->starve_rank == t->rank && r->calls == r->starve_call)
		limit(RLIMIT_AS, 0);
	if (r->delay <= 0)
		return;
	pm_random(r->seed, (uint64_t)t->rank, r->calls, u);
	usleep((useconds_t)(u[0] * r->delay));
}

static int lost(struct rehearsal *r, int rank)
{
	if (!killed)
		snprintf(why, sizeof why, "rank %d of %d has ended before its work was done", rank, r->n);
	return -1;
}

/* To or from one rank, as far as it goes now; whether something is left. */
static bool advance(struct rehearsal *r, int rank, struct queue *q, size_t n, const struct pm_message_part *list, bool out)
{
	for (; q->at < n; q->at++, q->done = 0) {
		const struct pm_message_part *part = list + q->at;
		if (part->rank != rank || q->done == part->bytes)
			continue;
		char *data = (char *)part->data + q->done;
		const size_t rest = part->bytes - q->done;
		q->done += out ? pm_lanes_send(r->lanes, rank, data, rest) : pm_lanes_take(r->lanes, rank, data, rest);
		if (q->done < part->bytes)
			return true;
	}
	return false;
}

static int messages(struct pm_transport *t, size_t nout, const struct pm_message_part *out, size_t nin, const struct pm_message_part *in)
{
	struct rehearsal *r = t->self;
	memset(r->in, 0, (size_t)r->n * sizeof *r->in);
	memset(r->out, 0, (size_t)r->n * sizeof *r->out);
	for (;;) {
		const uint32_t rings = pm_lanes_rings(r->lanes);
		int from = -1, ended = -1;
		bool room = false;
		for (int k = 0; k < r->n; k++) {
			const bool gives = k != t->rank && advance(r, k, r->out + k, nout, out, true);
			const bool takes = k != t->rank && advance(r, k, r->in + k, nin, in, false);
			room |= gives;
			from = takes ? k : from;
			ended = (gives || takes) && r->gone[k] ? k : ended;
		}
		if (ended >= 0)
			return lost(r, ended);
		if (from < 0 && !room)
			break;
		if (pm_lanes_sleep(r->lanes, rings, from, room))
			for (int k = 0; k < r->n; k++) /* what they had sent before their end is taken first */
				r->gone[k] |= k != t->rank && pm_lanes_gone(r->lanes, k);
	}
	pm_lanes_awake(r->lanes);
	return 0;
}

static int move(struct pm_transport *t, size_t nout, const struct pm_message_part *out, size_t nin, const struct pm_message_part *in)
{
	faults(t);
	return messages(t, nout, out, nin, in);
}

/* One message from `root` to each, or from each to `root` into the places of `data`. */
static int star(struct pm_transport *t, int root, void *data, size_t bytes, bool from_root)
{
	struct rehearsal *r = t->self;
	struct pm_message_part *list = calloc((size_t)r->n, sizeof *list);
	size_t n = 0;
	if (!list)
		return lost(r, t->rank);
	if (t->rank != root)
		list[n++] = (struct pm_message_part){root, data, bytes};
	for (int k = 0; k < r->n && t->rank == root; k++)
		if (k != root)
			list[n++] = (struct pm_message_part){k, (char *)data + (from_root ? 0 : (size_t)k * bytes), bytes};
	const bool out = (t->rank == root) == from_root;
	const int status = messages(t, out ? n : 0, list, out ? 0 : n, list);
	free(list);
	return status;
}

static int share(struct pm_transport *t, int root, void *data, size_t bytes)
{
	faults(t);
	return star(t, root, data, bytes, true);
}

static void combine(enum pm_reduction how, size_t n, int64_t *sum, const int64_t *x)
{
	for (size_t i = 0; i < n; i++)
		if (how == PM_LEAST_OF)
			sum[i] = x[i] < sum[i] ? x[i] : sum[i];
		else if (how == PM_MOST_OF)
			sum[i] = x[i] > sum[i] ? x[i] : sum[i];
		else
			sum[i] += x[i];
}

/* Rank 0 collects all, and gives the results back. */
static int reduce(struct pm_transport *t, enum pm_reduction how, size_t n, int64_t *values)
{
	struct rehearsal *r = t->self;
	const size_t bytes = n * sizeof *values;
	faults(t);
	if (t->rank) {
		struct pm_message_part part = {0, values, bytes};
		return messages(t, 1, &part, 0, NULL) || messages(t, 0, NULL, 1, &part) ? -1 : 0;
	}
	int64_t *all = calloc((size_t)r->n + 1, bytes), *sum = all ? all + (size_t)r->n * n : NULL;
	if (!all)
		return lost(r, 0);
	memcpy(all, values, bytes);
	int status = star(t, 0, all, bytes, false);
	if (how != PM_SUM_BEFORE)
		memcpy(sum, all, bytes);
	for (int k = how == PM_SUM_BEFORE ? 0 : 1; k < r->n && !status; k++) {
		int64_t own[16]; /* of rank k, which gets the sum before it */
		for (size_t i = 0; i < n; i += 16) {
			const size_t m = n - i < 16 ? n - i : 16;
			memcpy(own, all + (size_t)k * n + i, m * sizeof *own);
			if (how == PM_SUM_BEFORE)
				memcpy(all + (size_t)k * n + i, sum + i, m * sizeof *own);
			combine(how, m, sum + i, own);
		}
	}
	for (int k = 1; k < r->n && !status; k++) {
		struct pm_message_part part = {k, how == PM_SUM_BEFORE ? all + (size_t)k * n : sum, bytes};
		status = messages(t, 1, &part, 0, NULL);
	}
	memcpy(values, how == PM_SUM_BEFORE ? all : sum, bytes);
	free(all);
	return status;
}

static int turn(struct pm_transport *t, const uint64_t *out, uint64_t *in)
{
	struct rehearsal *r = t->self;
	struct pm_message_part *list = calloc(2 * (size_t)r->n, sizeof *list);
	size_t n = 0;
	faults(t);
	if (!list)
		return lost(r, t->rank);
	for (int k = 0; k < r->n; k++) {
		in[k] = out[k];
		if (k != t->rank) {
			list[n] = (struct pm_message_part){k, (void *)(uintptr_t)(out + k), sizeof *out};
			list[r->n + (int)n++] = (struct pm_message_part){k, in + k, sizeof *in};
		}
	}
	const int status = messages(t, n, list, n, list + r->n);
	free(list);
	return status;
}

static void leave(struct rehearsal *r)
{
	pm_lanes_free(r->lanes);
	free(r->pid), free(r->in), free(r->out), free(r->gone), free(r);
}

/* How rank k has ended: whether badly. */
static bool ended(struct rehearsal *r, int k, int how)
{
	r->pid[k] = 0;
	if (WIFEXITED(how) && !WEXITSTATUS(how))
		return false;
	if (!killed)
		snprintf(why, sizeof why, WIFSIGNALED(how) ? "rank %d of %d was killed by signal %d" : "rank %d of %d ended with status %d", k, r->n,
			WIFSIGNALED(how) ? WTERMSIG(how) : WEXITSTATUS(how));
	killed |= WIFSIGNALED(how);
	return true;
}

/* Rank 0 waits for the others. */
static int finish(struct pm_transport *t)
{
	struct rehearsal *r = t->self;
	bool bad = killed;
	pm_lanes_free(r->lanes);
	r->lanes = NULL;
	for (int k = 1, how; k < r->n && !t->rank; k++)
		if (r->pid[k] > 0 && waitpid(r->pid[k], &how, 0) == r->pid[k])
			bad |= ended(r, k, how);
	leave(r);
	t->self = NULL;
	return bad ? -1 : 0;
}

/* Where a message failed because a rank was killed, that rank: its process may need a moment to be gone. */
static const char *reason(struct pm_transport *t)
{
	struct rehearsal *r = t->self;
	for (int tries = 0; r && !t->rank && !killed && tries < 20; tries++) {
		for (int k = 1, how; k < r->n; k++)
			if (r->pid[k] > 0 && waitpid(r->pid[k], &how, WNOHANG) == r->pid[k])
				ended(r, k, how);
		if (!killed)
			usleep(1000);
	}
	return why;
}

static void give_up(struct pm_transport *t, int code)
{
	struct rehearsal *r = t->self;
	(void)code;
	for (int k = 1; !t->rank && k < r->n; k++)
		if (r->pid[k] > 0)
			kill(r->pid[k], SIGKILL);
}

/* KEY=RANK:NUMBER */
static void fault(const char *text, const char *key, int *rank, uint64_t *number)
{
	const char *at = strstr(text, key);
	unsigned long long n;
	int which;
	if (at && sscanf(at + strlen(key), "%d:%llu", &which, &n) == 2)
		*rank = which, *number = n;
}

static void read_faults(struct rehearsal *r)
{
	const char *text = getenv("PM_REHEARSE"), *at;
	r->kill_rank = r->starve_rank = r->limit_rank = -1;
	if (!text)
		return;
	r->seed = (at = strstr(text, "seed=")) ? strtoull(at + 5, NULL, 10) : 0;
	r->delay = (at = strstr(text, "delay=")) ? strtod(at + 6, NULL) : 0;
	r->one_thread = strstr(text, "one-thread");
	fault(text, "kill=", &r->kill_rank, &r->kill_call);
	fault(text, "memory=", &r->starve_rank, &r->starve_call);
	fault(text, "limit=", &r->limit_rank, &r->limit);
}

static struct rehearsal *rehearsal_new(int n)
{
	struct rehearsal *r = calloc(1, sizeof *r);
	const size_t k = (size_t)n;
	if (!r)
		return NULL;
	r->n = n;
	r->pid = calloc(k, sizeof *r->pid);
	r->in = calloc(k, sizeof *r->in);
	r->out = calloc(k, sizeof *r->out);
	r->gone = calloc(k, sizeof *r->gone);
	if (r->pid && r->in && r->out && r->gone)
		return r;
	leave(r);
	return NULL;
}

int pm_transport_rehearse(struct pm_transport *t, int n)
{
	struct rehearsal *r = rehearsal_new(n);
	int status = 0, rank = 0;
	struct rlimit files;
	if (!r)
		return pm_no_memory();
	read_faults(r);
	if (!getrlimit(RLIMIT_NOFILE, &files) && files.rlim_cur < files.rlim_max) {
		files.rlim_cur = files.rlim_max;
		setrlimit(RLIMIT_NOFILE, &files);
	}
	if (!(r->lanes = pm_lanes_new(n))) {
		leave(r);
		return -PM_DATA;
	}
	const pid_t first = getpid();
	for (int k = 1; k < n && !rank && !status; k++) {
		if ((r->pid[k] = fork()) < 0)
			status = pm_fail_errno("cannot start %d ranks", n);
		else if (!r->pid[k])
			rank = k;
	}
	if (r->limit_rank == rank)
		limit(RLIMIT_FSIZE, r->limit);
	if (rank && prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && getppid() != first)
		_exit(PM_DATA);
	pm_lanes_keep(r->lanes, rank);
	*t = (struct pm_transport){.rank = rank, .size = n, .self = r, .share = share, .reduce = reduce, .turn = turn, .move = move, .abort = give_up,
		.close = finish, .reason = reason};
	if (status) { /* those that have started see that rank 0 leaves */
		finish(t);
		return status;
	}
	return 0;
}
