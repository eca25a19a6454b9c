/* Memory handed over along a pipe, both ends of which are ours (stream/hand-over.h): what goes through the pipe, whose memory it is, who may write it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "check.h"
#include "stream/hand-over.h"
#include "stream/parts.h"
#include "stream/run.h"
#include "stream/wire.h"

enum { n = 100003, room = 900000 }; /* a pipe holds 1 MB; the frame has 3.6 MB */

static struct pm_frame *sample(double shift)
{
	struct pm_frame *f = pm_frame_new(2);
	f->hi[0] = 1, f->dt = 1;
	pm_frame_set_new(f, "matter", n);
	pm_frame_set_new(f, "few", 3);
	struct pm_field *x = pm_makes(f, "matter", "x", 2, PM_STATE), *low = pm_makes(f, "matter", "low", 1, PM_STATE);
	struct pm_field *id = pm_makes(f, "matter", "id", 1, PM_STATE);
	struct pm_field *m = pm_makes(f, "matter", "mass", 1, PM_STATE), *y = pm_makes(f, "few", "x", 1, PM_STATE);
	low->type = PM_F32, id->type = PM_I64, m->uniform = true, m->value[0] = 0.1;
	pm_frame_ready(f);
	for (int i = 0; i < 2 * n; i++)
		pm_out(x, 0)[i] = sin(i) + shift;
	for (int i = 0; i < n; i++)
		pm_out(low, 0)[i] = i / 3., pm_out_i64(id, 0)[i] = 7 * i;
	for (int i = 0; i < 3; i++)
		pm_out(y, 0)[i] = i;
	pm_frame_settle(f);
	return f;
}

static struct pm_field *x_of(const struct pm_frame *f) { return pm_frame_field(f, "matter", "x"); }

static bool holds(const struct pm_frame *f, double shift)
{
	int wrong = 0;
	for (int i = 0; i < 2 * n; i++)
		wrong += pm_in(x_of(f), 0)[i] != sin(i) + shift;
	for (int i = 0; i < n; i++)
		wrong += pm_in(pm_frame_field(f, "matter", "low"), 0)[i] != (float)(i / 3.) || pm_in_i64(pm_frame_field(f, "matter", "id"), 0)[i] != 7 * i;
	return !wrong && pm_in(pm_frame_field(f, "few", "x"), 0)[2] == 2;
}

static int waiting(const int pipes[2])
{
	int bytes = -1;
	ioctl(pipes[0], FIONREAD, &bytes);
	return bytes;
}

static struct pm_frame *sent(struct pm_writer *w, struct pm_reader *r, struct pm_frame *f, bool last)
{
	struct pm_frame *g = NULL;
	int status = last ? pm_write_header(w, f) : pm_write_frame(w, f);
	status = last && !status ? pm_write_last(w, f) : status;
	return !status && pm_read_frame(r, &g) == PM_GOT_FRAME ? g : NULL;
}

static void one_pipe(void)
{
	int pipes[2];
	if (pipe(pipes))
		exit(1);
	struct pm_reader *r = pm_reader_of_fd(pipes[0]);
	struct pm_writer *w = pm_writer_of_fd(pipes[1]);
	struct pm_frame *f = sample(0), *g = NULL;
	const int status = pm_write_frame(w, f), bytes = waiting(pipes);
	check(!status && bytes > 0 && bytes < 8192, "a frame of 3.6 MB goes through a pipe as %d bytes", bytes);
	check(pm_read_frame(r, &g) == PM_GOT_FRAME && holds(g, 0), "and has its values at the other end: f64, f32, i64, a small field (%s)", pm_message());
	check(g && x_of(g)->finite && x_of(g)->buffer->shared && !x_of(f)->buffer->shared, "they were copied once, and need not be checked again");
	struct pm_frame *h = g ? sent(w, r, g, false) : NULL;
	check(h && holds(h, 0) && x_of(h)->buffer->shared == x_of(g)->buffer->shared, "handed on they are the same memory");
	if (h) {
		pm_changes(h, "matter", "x");
		pm_frame_ready(h);
		for (int i = 0; i < 2 * n; i++)
			pm_out(x_of(h), 0)[i] += 0.25;
		pm_frame_settle(h);
		check(holds(g, 0) && holds(h, 0.25), "who changes values that another has as well changes a copy");
	}
	const void *first = g ? pm_in(x_of(g), 0) : NULL;
	pm_buffers_share(true);
	struct pm_frame *own = sample(0.5), *k = sent(w, r, own, true);
	pm_buffers_share(false);
	const void *had = k ? pm_in(x_of(k), 0) : NULL;
	if (k) {
		pm_changes(k, "matter", "x");
		pm_frame_ready(k);
		check(holds(k, 0.5) && pm_in(x_of(k), 0) == had && !x_of(own)->buffer, "values given away for good are changed in place");
		pm_frame_settle(k);
	}
	check(k && first != had, "a block in use is not taken again");
	pm_frame_free(f), pm_frame_free(g), pm_frame_free(h), pm_frame_free(own), pm_frame_free(k);
	pm_buffers_share(true);
	f = sample(1);
	pm_buffers_share(false);
	check(pm_in(x_of(f), 0) == first || pm_in(x_of(f), 0) == had, "one that nobody uses is");
	x_of(f)->summed = true, x_of(f)->crc = 12345;
	g = sent(w, r, f, false);
	check(g && x_of(g)->summed && x_of(g)->crc == 12345, "a checksum that is known goes along");
	pm_frame_free(f), pm_frame_free(g);
	pm_writer_close(w), pm_reader_close(r);
}

/* The stream as it would be recorded on its way; what: its bytes are read where nobody handed anything over. */
static void recorded(void)
{
	int pipes[2], file;
	char path[] = "/tmp/pm-hand-over-XXXXXX";
	static char text[room];
	if (pipe(pipes) || (file = mkstemp(path)) < 0)
		exit(1);
	struct pm_reader *r = pm_reader_of_fd(pipes[0]);
	struct pm_writer *w = pm_writer_of_fd(pipes[1]);
	struct pm_frame *f = sample(0), *g = NULL;
	pm_write_frame(w, f);
	const ssize_t bytes = read(pipes[0], text, room);
	if (write(file, text, (size_t)bytes) != bytes)
		exit(1);
	struct pm_reader *again = pm_reader_open(path);
	check(pm_read_frame(again, &g) < 0 && strstr(pm_message(), "PM_HANDOVER=0"), "elsewhere such a stream is refused: %s", pm_message());
	pm_reader_close(again), close(file), unlink(path);
	pm_writer_close(w), pm_reader_close(r), pm_frame_free(f), pm_frame_free(g);
}

/* The checksum that came with a field is written, not one computed anew: with a wrong one the stream is refused. */
static void plain_end(void)
{
	char path[] = "/tmp/pm-hand-over-XXXXXX";
	close(mkstemp(path));
	for (int wrong = 0; wrong < 2; wrong++) {
		struct pm_writer *w = pm_writer_open(path);
		struct pm_frame *f = sample(0), *g = NULL, *h = NULL;
		pm_write_frame(w, f), pm_write_end(w), pm_writer_close(w);
		struct pm_reader *r = pm_reader_open(path);
		pm_read_frame(r, &g);
		pm_reader_close(r);
		x_of(g)->crc ^= (uint32_t)wrong;
		w = pm_writer_open(path);
		pm_write_frame(w, g), pm_write_end(w), pm_writer_close(w);
		r = pm_reader_open(path);
		const bool got = pm_read_frame(r, &h) == PM_GOT_FRAME;
		check(got == !wrong, wrong ? "a field that passes untouched keeps the checksum it came with" : "and that is the right one");
		pm_reader_close(r), pm_frame_free(f), pm_frame_free(g), pm_frame_free(h);
	}
	unlink(path);
}

static void failures(void)
{
	int pipes[2];
	if (pipe(pipes))
		exit(1);
	struct pm_reader *r = pm_reader_of_fd(pipes[0]);
	struct pm_writer *w = pm_writer_of_fd(pipes[1]);
	struct pm_frame *f = sample(0), *g = NULL;
	pm_write_header(w, f);
	pm_write_abort(w, PM_NUMERICS, "not finite");
	check(waiting(pipes) < 8192 && pm_read_frame(r, &g) == -PM_NUMERICS && !strcmp(pm_message(), "not finite"), "an abort stands before a field");
	pm_writer_close(w), pm_reader_close(r), pm_frame_free(f), pm_frame_free(g);
	setenv("PM_HANDOVER", "0", 1);
	if (pipe(pipes))
		exit(1);
	r = pm_reader_of_fd(pipes[0]), w = pm_writer_of_fd(pipes[1]);
	check(!pm_writer_hands(w), "PM_HANDOVER=0 sends copies");
	pm_writer_close(w), pm_reader_close(r);
	unsetenv("PM_HANDOVER");
}

/* A reader that is slow: no more than one frame is on its way, though hundreds of such lines fit into the pipe. */
static void *slow_reader(void *p)
{
	struct pm_reader *r = p;
	struct pm_frame *g = NULL;
	usleep(100000);
	for (int got = PM_GOT_FRAME; got == PM_GOT_FRAME; g = pm_frame_free(g))
		got = pm_read_frame(r, &g);
	return NULL;
}

static void back_pressure(void)
{
	int pipes[2], most = 0;
	pthread_t thread;
	if (pipe(pipes))
		exit(1);
	struct pm_reader *r = pm_reader_of_fd(pipes[0]);
	struct pm_writer *w = pm_writer_of_fd(pipes[1]);
	struct pm_frame *f = sample(0);
	if (pthread_create(&thread, NULL, slow_reader, r))
		exit(1);
	for (int i = 0; i < 10; i++) {
		pm_write_frame(w, f);
		most = waiting(pipes) > most ? waiting(pipes) : most;
	}
	pm_write_end(w);
	pm_writer_close(w);
	pthread_join(thread, NULL);
	check(most < 4096, "a writer waits until the frame before has been read: at most %d bytes are on their way, a frame has 1472", most);
	pm_reader_close(r), pm_frame_free(f);
}

/* `{ one; another; } | reader` */
static void two_writers(void)
{
	int pipes[2];
	if (pipe(pipes))
		exit(1);
	struct pm_reader *r = pm_reader_of_fd(pipes[0]);
	bool good = true;
	for (int i = 0; i < 3; i++) {
		struct pm_writer *w = pm_writer_of_fd(dup(pipes[1]));
		struct pm_frame *f = sample(i), *g = NULL;
		good = good && pm_write_frame(w, f) == 0 && pm_write_end(w) == 0;
		if (i == 1) /* it has ended before its frame is read */
			pm_writer_close(w);
		good = good && pm_read_frame(r, &g) == PM_GOT_FRAME && holds(g, i) && x_of(g)->buffer->shared && pm_read_frame(r, &g) == PM_GOT_END;
		if (i != 1)
			pm_writer_close(w);
		pm_frame_free(f), pm_frame_free(g);
	}
	check(good, "writers that follow each other on one pipe hand over, each on its own (%s)", pm_message());
	close(pipes[1]), pm_reader_close(r);
}

/* `writer | { reader; cat; }`, whose reader ends early. */
static void reader_ends(void)
{
	int pipes[2];
	char words[16] = "";
	if (pipe(pipes))
		exit(1);
	const int rest = dup(pipes[0]);
	struct pm_reader *r = pm_reader_of_fd(pipes[0]);
	struct pm_writer *w = pm_writer_of_fd(pipes[1]);
	struct pm_frame *f = sample(0), *g = sent(w, r, f, false);
	pm_reader_close(r);
	pm_write_header(w, f);
	check(g && read(rest, words, sizeof words) == sizeof words && !memcmp(words, "PMPIPE/1 frame ", 15),
		"whoever reads on behind a reader that has ended gets a plain frame");
	close(rest), pm_writer_close(w), pm_frame_free(f), pm_frame_free(g);
}

int main(void)
{
	plain_end();
#ifdef __linux__
	one_pipe();
	recorded();
	failures();
	two_writers();
	back_pressure();
	reader_ends();
#endif
	return check_done();
}
