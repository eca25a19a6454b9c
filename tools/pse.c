/* pse: viscosity by exchange of strength between particles (lib/near/pse.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "law/law.h"
#include "transfer/transfer-frame.h"
#include "near/pse-frame.h"
#include "stage/viscosity-options.h"

struct config {
	const char *method, *order, *set, *field, *wall, *nu;
	double eps, overlap, cutoff;
	bool replace;
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	if (pm_given(s, "eps") && pm_given(s, "overlap"))
		return pm_fail(PM_USAGE, "--eps or --overlap, not both: either is the width");
	if (!strcmp(o->method, "dc") && !strcmp(o->order, "8"))
		return pm_fail(PM_USAGE, "--method dc has orders 2, 4 and 6 (order 8 would need the moments of 219 monomials in 3-D)");
	return pm_viscosity_typed(o->nu);
}

/* The sets, and what is the same for all of them. */
static int choose(const struct config *o, const struct pm_frame *f, struct pm_pse_set *p, struct pm_sets *sets)
{
	const char *field = o->field ? o->field : pm_law_of(f)->strength;
	*p = (struct pm_pse_set){.field = field, .corrected = !strcmp(o->method, "dc"), .order = atoi(o->order),
		.eps = o->eps, .overlap = o->overlap, .cutoff = o->cutoff, .images = !strcmp(o->wall, "images")};
	const char *const needs[] = {"x", field, NULL};
	return pm_sets_choose(f, o->set, needs, "stab reads it from a table", sets);
}

static int viscosity(struct pm_stage *s, struct pm_frame *f, struct pm_pse_set *p, struct pm_viscosity *v)
{
	const struct config *o = s->config;
	int status = pm_viscosity_of(s, f, p->set, o->nu, v);
	p->nu = v->least;
	memcpy(p->axis, v->ratio, sizeof p->axis);
	if (!status && !(p->nu > 0))
		return pm_fail(PM_USAGE, "--nu %s is 0 along an axis, and particles exchange along all (diffuse does it on a mesh)", o->nu);
	return status || !v->varies || !p->corrected ? status :
		pm_fail(PM_USAGE, "--method dc takes one nu, or one for each axis; where it varies use --method exchange");
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct pm_pse_set p;
	struct pm_sets sets;
	struct pm_viscosity v;
	const struct pm_law *law = pm_law_of(f);
	int status = law ? o->nu ? 0 : pm_viscosity_check(s, pm_viscosity(f, NAN)) : -PM_DATA;
	if (!status && !o->field && !law->strength)
		return pm_fail(PM_DATA, "the law '%s' has no strength to diffuse (--field NAME)", law->name);
	if (!status)
		status = choose(o, f, &p, &sets);
	for (size_t i = 0; !status && i < sets.n; i++) {
		p.set = sets.name[i];
		status = viscosity(s, f, &p, &v);
		status = status ? status : pm_reads_positions(f, p.set);
		if (!status)
			status = pm_pse_plan(f, &p, o->replace);
	}
	return status;
}

/* Exchange in a set; what varies is put into a share of the largest nu. */
static int apply(struct pm_stage *s, struct pm_frame *f, struct pm_pse_set *p, struct pm_pse_found *found)
{
	struct pm_viscosity v;
	const size_t n = pm_frame_field(f, p->set, "x")->count;
	double least, *share = NULL;
	int status = viscosity(s, f, p, &v);
	*found = (struct pm_pse_found){0};
	if (!status && v.varies) {
		share = pm_alloc(n + 1, sizeof *share);
		status = pm_viscosity_values(share ? 0 : pm_failed(), &v, f, n, share, &least, &p->nu);
		for (size_t i = 0; i < n && !status; i++)
			share[i] = p->nu > 0 ? share[i] / p->nu : 1;
		p->share = share;
	}
	status = status ? status : pm_pse_apply(f, p, found);
	pm_free(share);
	return status;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_pse_set common;
	struct pm_sets sets;
	double fastest = 0;
	int status = choose(s->config, f, &common, &sets);
	for (size_t i = 0; !status && i < sets.n; i++) {
		struct pm_pse_set p = common;
		struct pm_pse_found found;
		p.set = sets.name[i];
		if ((status = apply(s, f, &p, &found)) || !pm_frame_set(f, p.set)->n)
			continue;
		fastest = fmax(fastest, found.fastest);
		if (pm_pse_distorted(&p, f->dim, &found) && f->step && !f->substep) /* points as they were given are not its affair */
			pm_tell_once(s, "the spacing of '%s' is distorted (largest overlap %.4g, 1 on a lattice), so the exchange is not that of diffusion "
				"(put remesh behind push)", p.set, found.overlap);
		pm_report(s, f, "eps", p.eps);
		pm_report(s, f, "cutoff", p.cutoff);
		if (found.alone)
			pm_report_count(s, f, "alone", found.alone);
		if (found.widened)
			pm_report_count(s, f, "widened", found.widened);
		if (found.alone)
			pm_say(s, "%llu particles of '%s' have no partner within %g (a larger --overlap or --eps)", (unsigned long long)found.alone, p.set,
				p.eps * p.cutoff);
	}
	if (!status)
		pm_report(s, f, "fastest_dt", fastest * f->dt);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static const char *const methods[] = {"exchange", "dc", NULL}, *const orders[] = {"2", "4", "6", "8", NULL}, *const walls[] = {"images", "none", NULL};
static const struct pm_option options[] = {
	{.name = "method", .kind = PM_WORD, .fallback = "exchange", .choices = methods, PM_AT(method),
		.text = "exchange: conserves the sum, for particles without distortion; dc: corrected for the positions of the partners (DC-PSE), does not "
			"conserve"},
	{.name = "order", .kind = PM_WORD, .fallback = "2", .choices = orders, PM_AT(order), .text = "error eps^2 with positive weights, or eps^4"},
	{.name = "eps", .kind = PM_REAL, .unit = "length", .low = 1e-60, .high = 1e60, PM_AT(eps),
		.text = "width of the kernel exp(-(r/eps)^2/4); by default --overlap times the spacing of the particles"},
	{.name = "overlap", .kind = PM_REAL, .fallback = "1", .low = 1e-3, .high = 1e3, PM_AT(overlap),
		.text = "eps over the spacing (mean volume)^(1/dim); must be at least 1 on a lattice, and more for distorted particles"},
	{.name = "cutoff", .kind = PM_REAL, .unit = "eps", .low = 1, .high = 40, PM_AT(cutoff),
		.text = "partners farther apart than this do not exchange; by default 8, 9, 10 and 11 for orders 2 to 8; of dc 3.1, 4.1 and 5.1"},
	PM_VISCOSITY_FIELD_ROW,
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", PM_AT(field), .text = "diffuse this field, a strength or a value; by default the law's strength"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "only this set; by default every set with the field, each separately"},
	{.name = "wall", .kind = PM_WORD, .fallback = "images", .choices = walls, PM_AT(wall),
		.text = "mirror particles at faces that are wall (odd) or neumann (even), or nothing beyond them"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(replace), .text = "replace the change instead of refusing to add it twice"},
	{0},
};
static const struct pm_example examples[] = {
	{"a vortex spreads, its circulation is conserved",
		"pinit lamb-oseen --cells 48 | cycle -n 3 'p2m | poisson-fft | mgrad | m2p | pse | push midpoint | remesh' | diag --columns circulation"},
	{"heat in a rod between cold ends, particles at rest",
		"awk 'BEGIN { print \"x heat volume\"; for (i = 0; i < 40; i++) print (i + 0.5)/40, (i < 20)/40, 1/40 }' | stab - --strength heat --box 0,1 "
		"--faces wall --dt 1e-3 | cycle -n 9 'field \"vel = 0\" | pse --field heat --nu 0.1 | push rk2' | sls --report"},
	{"distorted particles, corrected: the Laplacian of x^2 is 2 wherever they are",
		"pinit uniform --dim 2 -n 400 --faces open | scalc --role state 'f = x^2' 'volume = 1/400' | pse --field f --nu 1 --method dc | sls --data"},
	{0},
};
const struct pm_tool tool_pse = {
	.name = "pse",
	.summary = "add viscosity by exchange of strength between particles",
	.about = "d(strength)_p += (nu/eps^2) sum over q of (V_p G_q - V_q G_p) eta((x_p - x_q)/eps)/eps^dim, as the term diffusion: no mesh, the sum of the "
		"strengths conserved to round-off. Gaussians of order 2 to 8, cut off; periodic images and mirror images at walls. Explicit: push refuses "
		"a step beyond the "
		 "limit, nu dt/eps^2 <= 4/order "
		 "for euler on a lattice. Needs volumes, and particles that are not distorted: remesh. Reports eps, cutoff, "
		 "fastest_dt, and the number of particles without a partner (alone). --method dc solves for the weights of each particle: order 2, 4 or 6 also "
		"for "
		 "distorted particles and at boundaries. If nu is 0 the frame is passed on unchanged. See docs/methods/pse.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x, volume and the law's strength",
	.adds = "a change of the strength (dcirculation; term diffusion)",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
};
