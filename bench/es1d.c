/* A step of an electrostatic plasma on a line, fused as in cycle, beside es1d of ZPIC (github.com/ricardo-fonseca/zpic), which sorts its particles every 16
 * steps and computes in single precision, on the same electrons, in turn: 16 steps a round. ZPIC is a shared library of its files but the one with main(),
 * found at run time (PM_ZPIC=FILE); nothing of it is needed to build. After that, for a cold wave, the positions of both against the exact ones. Reads one
 * frame: pinit langmuir -n N --cells C --dt DT | es1d [STEPS|NAME], N a multiple of C; STEPS of the comparison, or a name of the row.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <dlfcn.h>

#include "sentence/sentence.h"
#include "stream/wire.h"

#include "bench.h"

enum { STEPS = 16 };

/* What begins ZPIC's records; the rest is left to it. */
struct zpic_particle {
	int cell;
	float x, v; /* x from the middle of the cell, in cells; v half a step ahead of x before the first step, which has no field yet */
};

struct zpic {
	struct {
		char name[33];
		struct zpic_particle *part;
		int n;
		char rest[4096];
	} electrons;
	union {
		double aligned;
		char rest[8192];
	} simulation;
	void (*species)(void *species, char name[], float charge, int per_cell, const float *flow, const float *thermal, int cells, float box, float dt,
		void *density);
	void (*start)(void *simulation, int cells, float box, float dt, float end, int dump, void *species, int nspecies);
	void (*step)(void *simulation);
};

struct run {
	struct pm_sentence *words;
	struct pm_frame *frame;
	char set[PM_NAME];
	struct zpic zpic;
	size_t n, cells;
	double length;
};

static int bad(const char *why) { return fprintf(stderr, "es1d: %s\n", why), 1; }

static void ours(struct run *r, int steps)
{
	for (int k = 0; k < steps; k++)
		if (pm_sentence_pass(r->words, &r->frame))
			exit(bad(pm_message()));
}

static void theirs(struct run *r, int steps)
{
	for (int k = 0; k < steps; k++)
		r->zpic.step(&r->zpic.simulation);
}

static void our_round(void *with) { ours(with, STEPS); }
static void their_round(void *with) { theirs(with, STEPS); }

/* False, with a message, if it is not there. */
static bool zpic_open(struct zpic *z)
{
	const char *file = getenv("PM_ZPIC");
	void *library = file ? dlopen(file, RTLD_NOW | RTLD_LOCAL) : NULL;
	if (library)
		*(void **)&z->species = dlsym(library, "spec_new"), *(void **)&z->start = dlsym(library, "sim_new"),
		*(void **)&z->step = dlsym(library, "sim_iter");
	if (z->species && z->start && z->step)
		return true;
	fprintf(stderr, "bench: skipped ZPIC (PM_ZPIC names a library of its es1d%s%s)\n", file && !library ? ": " : "", file && !library ? dlerror() : "");
	return false;
}

static double *field(const struct run *r, const char *name) { return pm_out(pm_frame_field(r->frame, r->set, name), 0); }

/* The same electrons there. q: where they would be at rest, whose distance is the acceleration of a cold wave; NULL: none is known. */
static void zpic_fill(struct run *r, const double *q)
{
	const double *x = field(r, "x"), *v = field(r, "v"), dt = r->frame->dt, h = r->length / (double)r->cells;
	r->zpic.species(&r->zpic.electrons, (char[]){"electrons"}, -1, (int)(r->n / r->cells), NULL, NULL, (int)r->cells, (float)r->length, (float)dt, NULL);
	for (size_t p = 0; p < r->n; p++) {
		const double u = (x[p] - r->frame->lo[0]) / h, cell = fmin(floor(u), (double)r->cells - 1);
		r->zpic.electrons.part[p] = (struct zpic_particle){(int)cell, (float)(u - cell - 0.5), (float)(v[p] - (q ? dt / 2 * (x[p] - q[p]) : 0))};
	}
	r->zpic.start(&r->zpic.simulation, (int)r->cells, (float)r->length, (float)dt, 1e9f, 0, &r->zpic.electrons, 1);
}

/* The rms distance of sorted positions from those that the wave has at a time, over its rms amplitude: neighbours never change places. */
static double off(const struct run *r, const double *q, const double *start, double *x, double t)
{
	double sum = 0, all = 0;
	qsort(x, r->n, sizeof *x, bench_rising);
	for (size_t p = 0; p < r->n; p++) {
		const double s = start[p] - q[p], d = x[p] - q[p] - s * cos(t);
		sum += d * d, all += s * s;
	}
	return sqrt(sum / all);
}

static void compare(struct run *r, int steps)
{
	double *q = pm_alloc(r->n, sizeof *q), *start = pm_alloc(r->n, sizeof *q), *x = pm_alloc(r->n, sizeof *q);
	const double h = r->length / (double)r->cells, t = steps * r->frame->dt;
	for (size_t p = 0; p < r->n; p++)
		q[p] = r->frame->lo[0] + ((double)p + 0.5) / (double)r->n * r->length, start[p] = field(r, "x")[p];
	zpic_fill(r, q);
	ours(r, steps), theirs(r, steps);
	memcpy(x, field(r, "x"), r->n * sizeof *x);
	struct bench_row row = {.kernel = "es1d", .name = "cold wave: error of positions", .unit = "relative", .measured = off(r, q, start, x, t),
		.against = "ZPIC es1d (f32)", .most = 1};
	for (size_t p = 0; p < r->n; p++)
		x[p] = r->frame->lo[0] + (r->zpic.electrons.part[p].cell + 0.5 + (double)r->zpic.electrons.part[p].x) * h;
	row.other = off(r, q, start, x, t);
	bench_print(&row);
	pm_free(q), pm_free(start), pm_free(x);
}

int main(int argc, char **argv)
{
	static struct run r;
	struct pm_reader *in = pm_reader_open(NULL);
	if (!in || pm_read_frame(in, &r.frame) != PM_GOT_FRAME)
		return bad(pm_message());
	const struct pm_set *moves = NULL;
	for (size_t k = 0; k < r.frame->nsets && !moves; k++)
		moves = pm_set_moves(r.frame, r.frame->sets[k]) ? r.frame->sets[k] : NULL;
	if (!moves || r.frame->dim != 1 || !r.frame->nmeshes)
		return bad("a frame on a line with a mesh and one moving set, please");
	snprintf(r.set, sizeof r.set, "%s", moves->name);
	r.n = moves->n, r.cells = r.frame->meshes[0]->cells[0], r.length = r.frame->hi[0] - r.frame->lo[0];
	r.words = pm_sentence_new("push kick/2 drift | p2m --kernel cic | poisson-fft | mgrad | m2p | push kick/2", true, &(struct pm_list){0});
	const bool peer = zpic_open(&r.zpic);
	if (!r.words || pm_sentence_prime(r.words, &r.frame))
		return bad(pm_message());
	const int steps = argc > 1 ? atoi(argv[1]) : 0;
	if (steps) {
		if (peer)
			compare(&r, steps);
		return 0;
	}
	if (peer)
		zpic_fill(&r, NULL);
	struct bench_job jobs[] = {{our_round, &r, {0}}, {their_round, &r, {0}}};
	bench_turns(1 + peer, jobs);
	char name[64];
	snprintf(name, sizeof name, "step of cycle%s%s, 1-D %zu, %zu a cell", argc > 1 ? ", " : "", argc > 1 ? argv[1] : "", r.cells, r.n / r.cells);
	bench_against((struct bench_row){.kernel = "es1d", .name = name, .unit = "M particles/s", .per = 1e6, .least = 3}, (double)r.n * STEPS, jobs,
		"ZPIC es1d (f32, sorted)", peer ? jobs + 1 : NULL, 0);
	return 0;
}
