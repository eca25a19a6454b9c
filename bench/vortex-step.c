/* A remeshed step of vortices in the plane, fused as in cycle (two evaluations of the velocity, a remesh), beside the sum of what it takes with FINUFFT and
 * FFTW, in turn: FINUFFT's spreading and interpolation alone at the same points by as wide a kernel, and measured transforms of the same mesh; and the same
 * where the particles that begin on the nodes are copied to the mesh and back, as ours are. After that one
 * velocity of the particles, with its error, beside whole transforms of FINUFFT, of types 1 and 2, at the least power of ten as tolerance that makes their
 * error as large as ours. Reads one frame, of the flow u = sin x cos y, v = -cos x sin y:
 * pinit taylor-green-2d --cells C --dt DT | vortex-step. Without FINUFFT (finufft.h) only the step. SPDX-License-Identifier: GPL-3.0-or-later */
#include "finufft.h" /* before FFTW's header, which then has complex numbers of C */

#include <fftw3.h>

#include "mesh/gradient.h"
#include "poisson-fft/poisson-fft.h"
#include "sentence/sentence.h"
#include "stream/wire.h"
#include "transfer/transfer.h"

enum { PLACES = 3 }; /* of the particles: on the nodes, half a step on, a step on */

struct run {
	struct pm_sentence *words;
	struct pm_frame *frame;
	size_t n, cells;
	double dt;
	struct pm_transfer spread, gather;
	struct pm_poisson_fft *solver;
	struct pm_operator curl;
	double *x[PLACES][2], *q, *omega, *psi, *u[2], *vel[2];
	struct finufft finufft;
	int (*adjoint)(void *plan, double complex *c, double complex *mesh);
	double complex *symbol, *modes; /* -i k u of a mode of omega: as FFTW orders them, as FINUFFT does */
	double complex *strength, *value;
	fftw_plan there, back;
};

static int bad(const char *why) { return fprintf(stderr, "vortex-step: %s\n", why), 1; }

static void check(int status)
{
	if (status)
		exit(bad("failed"));
}

static void our_step(void *with)
{
	struct run *r = with;
	if (pm_sentence_step(r->words, &r->frame))
		exit(bad(pm_message()));
}

static void points(struct run *r, int place)
{
	check(r->finufft.points(r->finufft.plan, (int64_t)r->n, r->x[place][0], r->x[place][1], NULL, 0, NULL, NULL, NULL) > 1);
}

/* copies: of the particles on the nodes, as ours are. */
static void step_of_theirs(struct run *r, bool copies)
{
	double complex *mesh = r->finufft.mesh;
	for (int place = 0; place < PLACES; place++) {
		const bool copied = copies && !place;
		if (copied) {
			memcpy(mesh, r->strength, r->n * sizeof *mesh);
		} else {
			points(r, place);
			check(r->finufft.execute(r->finufft.plan, r->strength, mesh) > 1);
		}
		if (place == PLACES - 1) /* the remesh */
			return;
		fftw_execute(r->there);
		for (size_t i = 0; i < r->n; i++)
			mesh[i] *= r->symbol[i];
		fftw_execute(r->back);
		if (!copied)
			check(r->adjoint(r->finufft.plan, r->value, mesh) > 1);
		const double complex *value = copied ? mesh : r->value;
		for (size_t p = 0; p < r->n; p++)
			r->vel[0][p] = r->x[0][0][p] + r->dt * creal(value[p]), r->vel[1][p] = r->x[0][1][p] + r->dt * cimag(value[p]);
	}
}

static void their_step(void *with) { step_of_theirs(with, false); }
static void their_copied_step(void *with) { step_of_theirs(with, true); }

static void our_velocity(void *with)
{
	struct run *r = with;
	struct pm_strays strays;
	memset(r->omega, 0, r->n * sizeof *r->omega);
	check(pm_spread(&r->spread, r->n, (const double *const *)r->x[2], (const double *const *)&r->q, &r->omega, &strays));
	check(pm_poisson_fft_solve(r->solver, -1, r->omega, r->psi, NULL));
	check(pm_operator_apply(&r->curl, 1, (const double *const *)&r->psi, r->u, NULL));
	check(pm_gather(&r->gather, r->n, (const double *const *)r->x[2], (const double *const *)r->u, NULL, r->vel, &strays));
}

static void their_velocity(void *with)
{
	struct run *r = with;
	points(r, 2);
	check(r->finufft.execute(r->finufft.plan, r->strength, r->finufft.mesh) > 1);
	for (size_t i = 0; i < r->n; i++)
		r->finufft.mesh[i] *= r->modes[i];
	check(r->adjoint(r->finufft.plan, r->value, r->finufft.mesh) > 1);
}

static void flow(const double x[2], double u[2]) { u[0] = sin(x[0]) * cos(x[1]), u[1] = -cos(x[0]) * sin(x[1]); }

/* One step of RK4 along the flow. */
static void carry(const double from[2], double dt, double to[2])
{
	static const double at[] = {0, 0.5, 0.5, 1}, weight[] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
	double k[2] = {0, 0}, sum[2] = {0, 0};
	for (int s = 0; s < 4; s++) {
		const double x[2] = {from[0] + at[s] * dt * k[0], from[1] + at[s] * dt * k[1]};
		flow(x, k);
		for (int d = 0; d < 2; d++)
			sum[d] += weight[s] * k[d];
	}
	for (int d = 0; d < 2; d++) {
		to[d] = fmod(from[d] + dt * sum[d] + 2 * pm_pi, 2 * pm_pi);
		to[d] = to[d] < 2 * pm_pi ? to[d] : 0;
	}
}

static double wave(size_t i, size_t n) { return i <= n / 2 ? (double)i : (double)i - (double)n; }

/* Of u + i v for the mode (i, j) of omega: (kx + i ky)/k^2; the mode of half the mesh has no derivative. */
static double complex turn(size_t i, size_t j, size_t n)
{
	const double kx = 2 * i == n ? 0 : wave(i, n), ky = 2 * j == n ? 0 : wave(j, n), k2 = wave(i, n) * wave(i, n) + wave(j, n) * wave(j, n);
	return k2 > 0 ? (kx + I * ky) / k2 : 0;
}

static void *values(size_t n, size_t size)
{
	void *p = pm_zalloc(n, size);
	check(!p);
	return p;
}

static void prepare(struct run *r)
{
	const struct pm_grid g = pm_grid_of(r->frame, pm_frame_mesh(r->frame, NULL));
	const double h = 2 * pm_pi / (double)r->cells, cell = h * h;
	r->spread = r->gather = (struct pm_transfer){.grid = g, .kernel = pm_kernel_find("m6prime"), .components = 1, .set = {true, true}};
	r->gather.components = 2;
	r->solver = pm_poisson_fft_new(&g, &(struct pm_poisson_fft_choice){.symbol = PM_SPECTRAL});
	check(!r->solver || pm_operator_init(&r->curl, &g, PM_OP_CURL, 6, 1, true));
	r->n = r->cells * r->cells;
	r->dt = r->frame->dt;
	for (int d = 0; d < 2; d++) {
		r->u[d] = values(r->n, sizeof(double)), r->vel[d] = values(r->n, sizeof(double));
		for (int place = 0; place < PLACES; place++)
			r->x[place][d] = values(r->n, sizeof(double));
	}
	r->q = values(r->n, sizeof(double)), r->omega = values(r->n, sizeof(double)), r->psi = values(r->n, sizeof(double));
	r->symbol = values(r->n, sizeof *r->symbol), r->modes = values(r->n, sizeof *r->modes);
	r->strength = values(r->n, sizeof *r->strength), r->value = values(r->n, sizeof *r->value);
	for (size_t j = 0, p = 0; j < r->cells; j++)
		for (size_t i = 0; i < r->cells; i++, p++) {
			const double at[2] = {(double)i * h, (double)j * h};
			for (int place = 0; place < PLACES; place++) {
				double to[2];
				carry(at, place * r->dt / 2, to);
				r->x[place][0][p] = to[0], r->x[place][1][p] = to[1];
			}
			r->strength[p] = r->q[p] = 2 * sin(at[0]) * sin(at[1]) * cell;
			r->symbol[p] = turn(i, j, r->cells) / (double)r->n;
			r->modes[p] = turn((i + r->cells / 2) % r->cells, (j + r->cells / 2) % r->cells, r->cells) / (4 * pm_pi * pm_pi);
		}
}

/* Only: kernels alone, else transforms. */
static void plan(struct run *r, bool only, double tolerance)
{
	struct finufft *f = &r->finufft;
	int options[FINUFFT_OPTIONS];
	f->defaults(options);
	options[FINUFFT_ONLY] = only, options[FINUFFT_THREADS] = 1, options[FINUFFT_WARN] = 0;
	check(f->make(1, 2, (int64_t[]){(int64_t)r->cells, (int64_t)r->cells, 1}, -1, 1, tolerance, &f->plan, options) > 1);
}

/* rms of u + i v against the flow, over that of the flow. */
static double off(const struct run *r, bool ours)
{
	double sum = 0, all = 0;
	for (size_t p = 0; p < r->n; p++) {
		double u[2];
		flow((const double[]){r->x[2][0][p], r->x[2][1][p]}, u);
		const double complex exact = u[0] + I * u[1], got = ours ? r->vel[0][p] + I * r->vel[1][p] : r->value[p];
		sum += pow(cabs(got - exact), 2), all += pow(cabs(exact), 2);
	}
	return sqrt(sum / all);
}

static void velocities(struct run *r)
{
	our_velocity(r);
	const double error = off(r, true);
	double tolerance = pow(10, floor(log10(error)));
	struct bench_job jobs[] = {{our_velocity, r, {0}}, {their_velocity, r, {0}}};
	char name[96];
	for (;; tolerance *= 10) {
		plan(r, false, tolerance);
		their_velocity(r);
		if (off(r, false) >= error)
			break;
		r->finufft.destroy(r->finufft.plan);
	}
	bench_turns(2, jobs);
	snprintf(name, sizeof name, "velocity of the particles, 2-D %zu, m6prime", r->cells);
	bench_against((struct bench_row){.kernel = "vortex-step", .name = name, .unit = "M particles/s", .per = 1e6, .least = 3}, (double)r->n, jobs,
		"FINUFFT types 1 and 2", jobs + 1, 0);
	r->finufft.destroy(r->finufft.plan);
	strcat(name, ", error");
	bench_print(&(struct bench_row){.kernel = "vortex-step", .name = name, .unit = "relative", .measured = error, .against = "FINUFFT types 1 and 2",
		.other = off(r, false), .most = 1});
}

int main(void)
{
	static struct run r;
	struct pm_reader *in = pm_reader_open(NULL);
	pm_threads_use(1);
	if (!in || pm_read_frame(in, &r.frame) != PM_GOT_FRAME)
		return bad(pm_message());
	if (r.frame->dim != 2 || !r.frame->nmeshes || strcmp(r.frame->scene, "taylor-green-2d"))
		return bad("a frame of the scene taylor-green-2d, please");
	r.cells = r.frame->meshes[0]->cells[0];
	prepare(&r);
	r.words = pm_sentence_new("p2m | poisson-fft | mgrad | m2p | push rk2 | remesh", true, &(struct pm_list){0});
	if (!r.words || pm_sentence_ready(r.words, &r.frame))
		return bad(pm_message());
	bool peer = finufft_open(&r.finufft);
	if (peer && !(*(void **)&r.adjoint = dlsym(r.finufft.library, "finufft_execute_adjoint")))
		peer = false, fprintf(stderr, "bench: skipped FINUFFT (it has no finufft_execute_adjoint: before version 2.5)\n");
	if (peer) {
		const int n = (int)r.cells;
		r.finufft.mesh = values(r.n, sizeof *r.finufft.mesh);
		r.there = fftw_plan_dft_2d(n, n, r.finufft.mesh, r.finufft.mesh, FFTW_FORWARD, FFTW_MEASURE);
		r.back = fftw_plan_dft_2d(n, n, r.finufft.mesh, r.finufft.mesh, FFTW_BACKWARD, FFTW_MEASURE);
		plan(&r, true, pow(10, 1 - r.spread.kernel->width));
	}
	struct bench_job jobs[] = {{our_step, &r, {0}}, {their_step, &r, {0}}, {their_copied_step, &r, {0}}};
	bench_turns(peer ? 3 : 1, jobs);
	char name[96];
	snprintf(name, sizeof name, "remeshed step of cycle, 2-D %zu, m6prime, rk2", r.cells);
	bench_against((struct bench_row){.kernel = "vortex-step", .name = name, .unit = "M particles/s", .per = 1e6, .least = 3}, (double)r.n, jobs,
		"FINUFFT (kernels alone) + FFTW", peer ? jobs + 1 : NULL, 0);
	if (peer) {
		bench_against((struct bench_row){.kernel = "vortex-step", .name = name, .unit = "M particles/s", .per = 1e6}, (double)r.n, jobs,
			"the same, copied at the nodes", jobs + 2, 0);
		r.finufft.destroy(r.finufft.plan);
		velocities(&r);
	}
	return 0;
}
