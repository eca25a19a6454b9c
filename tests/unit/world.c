/* The eight operations of lib/world, in rehearsed worlds of 1 to 7 ranks with delays, and under mpirun where it is there: results, failures on one rank and
 * on several, a rank that is killed. Every world has a watchdog. SPDX-License-Identifier: GPL-3.0-or-later */
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "world/launch.h"
#include "world/world.h"
#include "check.h"

enum { watchdog = 60 /* s */, places = 5000, many_places = 200000 /* more than the lanes of a rehearsal hold */, most_ranks = 7 };

static int wrong; /* on this rank */

static void must(bool good, const char *what)
{
	if (!good)
		fprintf(stderr, "rank %d of %d: %s\n", pm_world_rank(), pm_world_size(), what);
	wrong += !good;
}

/* Uneven stretches, some of them empty. */
static void stretches(uint64_t from[most_ranks + 1], uint64_t n, int kind)
{
	const int size = pm_world_size();
	for (int r = 0; r <= size; r++)
		from[r] = kind == 0 ? (r ? n : 0) : kind == 1 ? n * (uint64_t)(r * r) / (uint64_t)(size * size) : kind == 2 ? (r < size ? 0 : n) :
			n * (uint64_t)r / (uint64_t)size;
}

static uint64_t value(uint64_t i) { return i * 0x9e3779b97f4a7c15u; }

static void share_and_gather(void)
{
	const int me = pm_world_rank(), size = pm_world_size();
	char text[40] = "";
	for (int root = 0; root < size; root++) {
		snprintf(text, sizeof text, "said by %d", me == root ? root : -1);
		must(!pm_world_share(0, root, text, sizeof text), "share");
		must(atoi(text + 8) == root, "share brings the root's bytes");
	}
	unsigned char mine[most_ranks];
	void *all;
	size_t total, at = 0;
	memset(mine, me, sizeof mine);
	must(!pm_world_gather(0, mine, (size_t)me, &all, &total), "gather");
	for (int r = 0; r < size && me == 0; r++)
		for (int k = 0; k < r; k++, at++)
			must(((unsigned char *)all)[at] == r, "gather joins the pieces in the order of ranks");
	must(total == at && (me == 0) == (all != NULL), "gather gives all to rank 0");
	pm_free(all);
}

static void exchange(void)
{
	const size_t me = (size_t)pm_world_rank(), size = (size_t)pm_world_size();
	size_t out[most_ranks], in[most_ranks], n = 0;
	unsigned char *data = malloc(most_ranks * most_ranks * 1000);
	void *got;
	for (size_t r = 0; r < size; r++)
		out[r] = (me + 1) * r * 37 % 1000, memset(data + n, (int)(16 * me + r), out[r]), n += out[r];
	must(!pm_world_exchange(0, data, out, &got, in), "exchange");
	const unsigned char *p = got;
	for (size_t r = 0; r < size && p; r++) {
		must(in[r] == (r + 1) * me * 37 % 1000, "exchange says how much came from whom");
		for (size_t k = 0; k < in[r]; k++)
			must(*p++ == 16 * r + me, "exchange brings each rank its own piece");
	}
	pm_free(got);
	free(data);
}

/* Planes of 3 numbers; kind 2 gives all planes to the last rank. */
static void halo(uint64_t planes, int wide, bool periodic, int kind)
{
	uint64_t from[most_ranks + 1];
	stretches(from, planes, kind);
	const int me = pm_world_rank();
	const int64_t n = (int64_t)planes, lo = (int64_t)from[me], here = (int64_t)from[me + 1] - lo;
	double *room = calloc((size_t)(here + 2 * wide) * 3, sizeof *room), *data = room + 3 * wide;
	for (int64_t k = -wide; k < here + wide; k++)
		for (int c = 0; c < 3; c++)
			data[3 * k + c] = k >= 0 && k < here ? (double)(10 * (lo + k) + c) : -1;
	must(!pm_world_halo(0, &(struct pm_halo){from, 3 * sizeof *data, wide, periodic, false}, data), "halo");
	for (int64_t k = -wide; k < here + wide && here; k++) {
		const int64_t g = lo + k, image = ((g % n) + n) % n;
		const bool inside = g >= 0 && g < n;
		for (int c = 0; c < 3; c++)
			must(data[3 * k + c] == (inside || periodic ? (double)(10 * image + c) : -1), "halo brings the planes of the neighbours");
	}
	free(room);
}

static void integers(void)
{
	const int64_t me = pm_world_rank(), size = pm_world_size();
	int64_t sum[20], least[20], most[20], before[20];
	for (int i = 0; i < 20; i++)
		sum[i] = least[i] = most[i] = before[i] = (int64_t)1 << 55 | (me * me * 100 - i * me);
	must(!pm_world_count(0, PM_SUM_OF, 20, sum) && !pm_world_count(0, PM_LEAST_OF, 20, least) && !pm_world_count(0, PM_MOST_OF, 20, most) &&
		!pm_world_count(0, PM_SUM_BEFORE, 20, before), "count");
	for (int64_t i = 0; i < 20; i++) {
		int64_t s = 0, b = 0, lo = INT64_MAX, hi = 0;
		for (int64_t r = 0; r < size; r++) {
			const int64_t y = (int64_t)1 << 55 | (r * r * 100 - i * r);
			s += y, b += r < me ? y : 0, lo = y < lo ? y : lo, hi = y > hi ? y : hi;
		}
		must(sum[i] == s && before[i] == b && least[i] == lo && most[i] == hi, "count is exact");
	}
	double y[5] = {(double)me - 3, me == size - 1 ? NAN : 1, -0.0, -1e300 * (double)me, me ? -INFINITY : -5e-324};
	must(!pm_world_largest(0, 5, y), "largest");
	must(y[0] == (double)size - 4 && isnan(y[1]) && y[2] == 0 && y[3] == 0 && y[4] == -5e-324, "largest");
}

/* More numbers than travel with a status. */
static void many(void)
{
	const int64_t me = pm_world_rank(), size = pm_world_size();
	int64_t sum[100];
	double largest[70];
	for (int i = 0; i < 100; i++)
		sum[i] = me + i;
	for (int i = 0; i < 70; i++)
		largest[i] = (double)(me * i);
	must(!pm_world_count(0, PM_SUM_OF, 100, sum) && !pm_world_largest(0, 70, largest), "many numbers");
	for (int i = 0; i < 100; i++)
		must(sum[i] == size * (size - 1) / 2 + size * i, "a hundred sums");
	for (int i = 0; i < 70; i++)
		must(largest[i] == (double)((size - 1) * i), "the largest of seventy numbers");
}

static void tell(void)
{
	char text[40] = "";
	snprintf(text, sizeof text, "rank %d", pm_world_rank());
	must(!pm_world_tell(text, sizeof text) && !strcmp(text, "rank 0"), "tell brings the bytes of rank 0");
}

static void recut(uint64_t n, int a, int b)
{
	uint64_t from[most_ranks + 1], to[most_ranks + 1];
	stretches(from, n, a), stretches(to, n, b);
	const int me = pm_world_rank();
	uint64_t *in = calloc(n, 8), *out = calloc(n, 8);
	for (uint64_t i = from[me]; i < from[me + 1]; i++)
		in[i - from[me]] = value(i);
	must(!pm_world_recut(0, from, to, 8, in, out), "recut");
	for (uint64_t i = to[me]; i < to[me + 1]; i++)
		must(out[i - to[me]] == value(i), "recut keeps the order");
	free(in), free(out);
}

static void results(void)
{
	share_and_gather();
	exchange();
	integers();
	many();
	tell();
	for (int a = 0; a < 4; a++)
		for (int b = 0; b < 4; b++)
			recut(places, a, b);
	recut(many_places, 1, 3), recut(many_places, 0, 2), recut(many_places, 3, 0);
	static const uint64_t planes[] = {1, 2, 5, 17, 64};
	for (int i = 0; i < 5; i++)
		for (int kind = 0; kind < 4; kind++)
			for (int wide = 1; wide <= 3; wide++)
				halo(planes[i], wide, false, kind), halo(planes[i], wide, true, kind);
}

/* Operation `which` with this status. */
static int operation(int which, int status)
{
	uint64_t from[most_ranks + 1], to[most_ranks + 1];
	size_t out[most_ranks] = {0}, in[most_ranks], total;
	double x[9] = {0};
	int64_t k = 1;
	void *got;
	stretches(from, 3, 0), stretches(to, 3, 2);
	switch (which) {
	case 0: return pm_world_share(status, 0, x, sizeof x);
	case 1: status = pm_world_gather(status, x, 8, &got, &total); pm_free(got); return status;
	case 2: status = pm_world_exchange(status, x, out, &got, in); pm_free(got); return status;
	case 3: return pm_world_halo(status, &(struct pm_halo){from, 8, 1, true, false}, x + 3);
	case 4: return pm_world_largest(status, 1, x);
	case 5: return pm_world_agree(status);
	case 6: return pm_world_count(status, PM_SUM_OF, 1, &k);
	case 7: return pm_world_count(status, PM_LEAST_OF, 1, &k);
	case 8: return pm_world_count(status, PM_MOST_OF, 1, &k);
	case 9: return pm_world_count(status, PM_SUM_BEFORE, 1, &k);
	default: return pm_world_recut(status, from, to, 8, x, x + 4);
	}
}

/* Ranks a and b fail, b in the earlier place; then a alone, without a place; and all goes on. */
static void failures(void)
{
	const int me = pm_world_rank(), size = pm_world_size();
	for (int which = 0; which <= 10; which++)
		for (int a = 0; a < size; a++) {
			const int b = (a + 1) % size;
			int status = 0;
			if (me == a || me == b) {
				status = pm_fail(me == b ? PM_NUMERICS : PM_DATA, "failure of rank %d", me);
				pm_world_place(1, 2, me == b ? 0 : 1, me == b ? 1000000 : 3);
			}
			status = operation(which, status);
			char want[40];
			snprintf(want, sizeof want, "failure of rank %d", b);
			must(status == -PM_NUMERICS && !strcmp(pm_message(), want), "the least place wins, with its code and message");
			status = operation(which, me == a ? pm_fail(PM_USAGE, "alone %d", a) : 0);
			snprintf(want, sizeof want, "alone %d", a);
			must(status == -PM_USAGE && !strcmp(pm_message(), want), "a failure of one rank is a failure of all");
			must(!operation(which, 0), "after a failure the next operation is as good as any");
		}
}

static void traffic(void)
{
	const uint64_t size = (uint64_t)pm_world_size();
	uint64_t from[most_ranks + 1], to[most_ranks + 1];
	char data[3000];
	stretches(from, 3000, 2), stretches(to, 3000, 3);
	memset(data, 1, sizeof data);
	const struct pm_world_traffic before = pm_world_traffic();
	must(!pm_world_recut(0, from, to, 1, data, data), "recut in place of one rank's items");
	const struct pm_world_traffic after = pm_world_traffic();
	const uint64_t agreed = size == 1 ? 0 : 8, own = to[size] - to[size - 1]; /* one agreement */
	const uint64_t pieces = pm_world_rank() == (int)size - 1 && size > 1 ? 3000 - own : 0;
	must(after.bytes - before.bytes == pieces + agreed, "bytes are counted");
	uint64_t messages = size == 1 ? 0 : 1;
	for (uint64_t r = 0; r + 1 < size && pieces; r++)
		messages += (to[r + 1] - to[r] + 6) / 7;
	pm_world_cut(7);
	must(!pm_world_recut(0, from, to, 1, data, data), "recut with cut messages");
	must(pm_world_traffic().messages - after.messages == messages, "messages are cut");
	pm_world_cut((size_t)1 << 30);
}

static void cut(void)
{
	pm_world_cut(7);
	share_and_gather();
	exchange();
	recut(places, 1, 3);
	halo(17, 3, true, 3);
	pm_world_cut((size_t)1 << 30);
}

static void everything(void)
{
	results();
	failures();
	traffic();
	cut();
}

/* 1: some rank found something wrong; or the status of a world that ended badly. */
static int verdict(void)
{
	int64_t n = wrong;
	if (pm_world_count(0, PM_SUM_OF, 1, &n))
		n = 1;
	const int rank = pm_world_rank(), end = pm_world_end();
	return rank ? 0 : n || end;
}

/* A process with n ranks; its exit status, or 128 and the signal. */
static int world_of(int n, void (*work)(void), const char *faults)
{
	struct pm_transport t;
	int how;
	fflush(NULL);
	const pid_t pid = fork();
	if (!pid) {
		setenv("PM_REHEARSE", faults, 1);
		if (pm_transport_rehearse(&t, n))
			_exit(99);
		alarm(watchdog);
		pm_world_set(&t);
		work();
		_exit(verdict());
	}
	return waitpid(pid, &how, 0) < 0 ? 98 : WIFEXITED(how) ? WEXITSTATUS(how) : 128 + WTERMSIG(how);
}

/* Rank 1 dies somewhere: nobody waits for it, and the others know. */
static void until_broken(void)
{
	for (int which = 0; !pm_world_broken(); which = (which + 1) % 8)
		operation(which, 0);
	const bool rank = pm_world_rank(), bad = pm_world_end();
	_exit(rank ? 0 : bad && strstr(pm_message(), "rank 1 of 3 was killed by signal 9") ? 55 : 96);
}

static void mpi(const char *self)
{
	char command[1000], directory[500];
	const char *bin = getenv("PM_BIN");
	snprintf(directory, sizeof directory, "%s", bin ? bin : "bin");
	snprintf(command, sizeof command, "%s/pmpipe-mpi.so", getenv("B") ? getenv("B") : "build");
	if (system("command -v mpirun >/dev/null 2>&1") || access(command, R_OK)) {
		printf("ok - the same under mpirun # skip no mpirun, or no pmpipe-mpi.so (mpicc was not there)\n");
		return;
	}
	setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1), setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
	setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1), setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);
	setenv("LSAN_OPTIONS", "detect_leaks=0", 1), setenv("ASAN_OPTIONS", "detect_leaks=0", 1); /* MPI's own, in objects that are closed by the end */
	for (int n = 2; n <= 3; n++) {
		snprintf(command, sizeof command, "timeout -k 1 %d mpirun -n %d '%s' --mpi '%s' </dev/null", watchdog, n, self, directory);
		check(!system(command), "MPI: results, failures, counts and cut messages with %d ranks", n);
	}
}

int main(int argc, char **argv)
{
	if (argc == 3 && !strcmp(argv[1], "--mpi")) {
		alarm(watchdog);
		if (!pm_launched() || pm_launch(argv[2]))
			return fprintf(stderr, "%s\n", pm_message()), 1;
		everything();
		return verdict();
	}
	static const int sizes[] = {1, 2, 3, 4, 7};
	for (int i = 0; i < 5; i++)
		check(!world_of(sizes[i], everything, ""), "the eight operations with %d ranks: results, failures, counts, cut messages", sizes[i]);
	for (int seed = 1; seed <= 3; seed++) {
		char faults[60];
		snprintf(faults, sizeof faults, "seed=%d delay=200", seed);
		check(!world_of(3, failures, faults), "failures with delays, seed %d", seed);
	}
	int bad = 0;
	for (int call = 1; call <= 30; call++) {
		char faults[60];
		snprintf(faults, sizeof faults, "kill=1:%d", call);
		const int got = world_of(3, until_broken, faults);
		bad += got != 55;
		if (got != 55)
			printf("# %s: %d\n", faults, got);
	}
	check(!bad, "a rank that is killed in any operation ends all, and is named");
	mpi(argv[0]);
	return check_done();
}
