/* remesh: particles put back onto the nodes of a mesh; the distribution of strengths is lib/remesh/remesh.c, the distortion lib/remesh/distortion.c.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <inttypes.h>
#include <string.h>

#include "expression/mesh-mask.h"
#include "law/law.h"
#include "remesh/distortion.h"
#include "remesh/remesh-frame.h"
#include "stage/mesh-options.h"
#include "stage/strength-report.h"

struct config {
	const char *kernel, *mesh, *set, *when, *by, *outside, *mask;
	struct pm_cells cells;
	struct pm_list drop;
	double cut_off, threshold;
	int64_t every, rim;
};

struct job {
	struct pm_remesh_choice choice;
	struct pm_sets sets;
	struct pm_mesh *mesh;
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	for (int i = 0; i < o->drop.n; i++)
		if (!strcmp(o->drop.item[i], "x"))
			return pm_fail(PM_USAGE, "--drop x would leave no particles");
	if (o->rim > 0 && o->by)
		return pm_fail(PM_USAGE, "--rim makes particles of strength 0, for which a value --by strength is undefined (leave one of them out)");
	if (pm_given(s, "threshold") && strcmp(o->when, "distortion"))
		return pm_fail(PM_USAGE, "--threshold belongs to --when distortion");
	return 0;
}

static int job_of(const struct config *o, const struct pm_frame *f, struct job *j)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	*j = (struct job){.choice = {.kernel = pm_remesh_kernel(o->kernel, o->by, law), .cut_off = o->cut_off,
		.rim = o->rim >= 0 ? (int)o->rim : -1, .by = o->by, .drop = o->drop.item, .ndrop = o->drop.n,
		.out = !strcmp(o->outside, "drop"), .overlap = !strcmp(o->when, "distortion")}};
	pm_remesh_defaults(f, &j->choice);
	j->mesh = pm_frame_mesh(f, o->mesh);
	if (!j->mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", o->mesh ? " " : "", o->mesh ? o->mesh : "");
	return j->choice.kernel ? pm_remesh_choose(f, o->set, &j->choice, &j->sets) : -PM_DATA;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct job j;
	if (f->substep || f->step % o->every)
		return PM_PASS;
	int status = job_of(o, f, &j);
	for (size_t i = 0; i < j.sets.n && !status; i++) {
		status = pm_remesh_reads(f, j.sets.name[i], &j.choice);
		if (!status && !j.choice.overlap)
			pm_remesh_drops(f, j.sets.name[i]);
	}
	status = !status && o->mask ? pm_mesh_mask_declare(f, j.mesh, o->mask) : status;
	return status ? status : PM_HOLD;
}

/* The mesh of the options: other cells, or enlarged until it contains every particle. */
static int fit(const struct config *o, struct pm_frame *f, struct job *j)
{
	const int status = pm_mesh_take_cells(f, j->mesh, &o->cells);
	return status ? (status < 0 ? status : 0) : strcmp(o->outside, "grow") ? 0 : pm_remesh_grow(f, j->mesh, j->choice.kernel, &j->sets);
}

/* What is removed is added over frames. */
static void report(struct pm_stage *s, struct pm_frame *f, const struct pm_kernel *kernel, const struct pm_remesh_loss *loss)
{
	if (loss->cut)
		pm_report_strengths(s, f, "lost", NULL, &loss->under);
	pm_report_count(s, f, "cut", loss->cut);
	if (loss->strays) {
		pm_report_count(s, f, "outside", loss->strays);
		pm_report_strengths(s, f, "outside", NULL, &loss->outside);
	}
	if (loss->square)
		pm_report_sum(s, f, "square_lost", loss->square);
	const double lost = json_number_value(json_object_get(json_object_get(f->report, s->word), "square_lost"));
	if (fabs(lost) > 0.01) /* the error that plan, too, allows where none is asked for */
		pm_tell_once(s, "by step %" PRIu64 " remeshing by %s has changed sum q^2/volume, twice the enstrophy of vortices, by %+.2g of itself; "
			"%ssmaller cells or fewer remeshings change it less", f->step, kernel->name, -lost, kernel->width < 6 ? "--kernel m6prime, " : "");
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct job j;
	double distortion = 0;
	int status = job_of(o, f, &j);
	if (!status && j.choice.overlap && !(status = pm_distortion_most(f, &j.sets, j.mesh, &distortion)))
		pm_report(s, f, "distortion", distortion);
	if (status || (j.choice.overlap && distortion <= o->threshold))
		return status;
	unsigned char *mask = NULL;
	status = fit(o, f, &j);
	status = !status && o->mask ? pm_mesh_mask(f, j.mesh, o->mask, pm_frame_field(f, j.sets.name[0], "x")->here, &mask) : status;
	j.choice.mask = mask;
	for (size_t i = 0; i < j.sets.n && !status; i++) {
		struct pm_remesh_loss loss;
		pm_remesh_drops(f, j.sets.name[i]);
		status = pm_remesh_set(f, j.sets.name[i], j.mesh, &j.choice, &loss);
		if (!status)
			report(s, f, j.choice.kernel, &loss);
	}
	if (!status)
		pm_report_count(s, f, "remeshings", 1);
	pm_free(mask);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f)
{
	struct job j;
	return !job_of(s->config, f, &j);
}

static const char *const when[] = {"always", "distortion", NULL}, *const outside[] = {"error", "drop", "grow", NULL};
static const struct pm_option options[] = {
	{.name = "kernel", .letter = 'k', .kind = PM_WORD, .choices = pm_kernel_names, PM_AT(kernel),
		.text = "the interpolation kernel (default: with --by volume m6prime, else the law's, else m4prime)"},
	PM_MESH_ROWS,
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "only this set (default: every set with a strength that is not fixed)"},
	{.name = "cut-off", .kind = PM_REAL, .high = 1, PM_AT(cut_off),
		.text = "drop and count nodes with at most this fraction of the largest strength (default: 1e-6 where a face is open, else 0)"},
	{.name = "rim", .kind = PM_INTEGER, .unit = "cells", .high = 1000, PM_AT(rim),
		.text = "also keep all nodes this close to a particle, so that diffusion has room (default: 2 if a face is open and nu is not 0, else 0)"},
	{.name = "every", .kind = PM_INTEGER, .unit = "steps", .fallback = "1", .low = 1, .high = 1e15, PM_AT(every), .text = "act only in multiples of this"},
	{.name = "when", .kind = PM_WORD, .fallback = "always", .choices = when, PM_AT(when),
		.text = "act always, or if the distortion of the particles exceeds --threshold"},
	{.name = "threshold", .kind = PM_REAL, .fallback = "0.02", .high = 1e9, PM_AT(threshold), .text = "largest distortion allowed (see above)"},
	{.name = "by", .kind = PM_TEXT, .unit = "STRENGTH", PM_AT(by),
		.text = "conserve the product of this strength and the values (v): momentum with mass; volume: values alone, such as a level"},
	{.name = "mask", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(mask),
		.text = "bodies: no particles where this is not 0 ('x^2 + y^2 < 1'), and one-sided kernels beside them and beside faces"},
	{.name = "drop", .kind = PM_LIST, .unit = "FIELD", PM_AT(drop), .text = "fields that the new particles do not have"},
	{.name = "outside", .kind = PM_WORD, .fallback = "grow", .choices = outside, PM_AT(outside),
		.text = "particles outside an open mesh: fail, leave out and count with the sum of their strengths, or enlarge the mesh"},
	{0},
};
static const struct pm_example examples[] = {
	{"a cloud of masses becomes a lattice of masses with the same momentum", "pinit uniform -n 1000 | remesh -n 16 --kernel tsc --by mass | sls"},
	{"three vortices advect each other; the smallest strengths are dropped",
		"printf 'x y circulation\\n0 0 1\\n1 0 1\\n0 1 1\\n' | stab - --law vortex --box -8,8 --dt 0.5 | cycle -n 5 "
		"'p2m | poisson-fft | mgrad | m2p | push midpoint | remesh --cut-off 1e-4' | sls"},
	{0},
};
const struct pm_tool tool_remesh = {
	.name = "remesh",
	.summary = "put the strengths of particles back onto the nodes of a mesh, which become the particles",
	.about = "strength(i) = sum over particles of strength * W((x - x_i)/h): nodes that are not 0, or above --cut-off, are the new particles, in the "
		"order of the mesh. The total is conserved to round-off, moments as far as the kernel does (docs/methods/kernels.md). Acts between steps only; "
		"inside a step the frame is passed on unchanged. Change and derived fields, registers and id are dropped; values need --by or --drop. "
		"Distortion is the mean of |H - H0|/H0 over the particles, H = sum of volume * zeta(distance), H0 that after the last remesh. What a remesh "
		"takes from sum q^2/volume of the first strength q is reported as square_lost, and said when it adds up to 1 %. See docs/methods/remesh.md.",
	.kind = PM_FILTER,
	.reads = "x and every strength (mass, charge, circulation); with --by values; volume",
	.changes = "the particles: their number, x, strengths, volume; the geometry of the mesh (-n, --outside grow)",
	.adds = "overlap, with --when distortion",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
};
