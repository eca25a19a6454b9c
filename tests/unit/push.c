/* push on frames in memory: errors and their messages, the clock, registers, several sets, faces of the box, what is dropped.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "stage/apply.h"
#include "push/step-clock.h"
#include "stream/frame-time.h"

extern const struct pm_tool tool_push;

/* push with the arguments of a line; 0, or the failure. */
static int push(struct pm_frame *f, const char *line)
{
	char words[256], *argv[16] = {"push"};
	int argc = 1;
	snprintf(words, sizeof words, "%s", line);
	for (char *w = strtok(words, " "); w; w = strtok(NULL, " "))
		argv[argc++] = w;
	struct pm_stage *s = pm_stage_new(&tool_push, argc, argv);
	if (!s)
		return -PM_USAGE;
	int status = pm_stage_apply(s, f);
	pm_stage_free(s);
	return status;
}

static struct pm_field *field(struct pm_frame *f, const char *on, const char *name, int components, enum pm_role role)
{
	struct pm_field *y = pm_makes(f, on, name, components, role);
	pm_field_ready(y);
	y->use = 0;
	return y;
}

/* n particles of unit spacing at x = 0.25, 1.25, ..., at rest, in a box of length 10; no rates. */
static struct pm_frame *frame(int dim, size_t n, bool with_v)
{
	struct pm_frame *f = pm_frame_new(dim);
	f->dt = 0.25;
	for (int d = 0; d < dim; d++)
		f->hi[d] = 10;
	pm_frame_set_new(f, "matter", n);
	struct pm_field *x = field(f, "matter", "x", dim, PM_STATE);
	for (int d = 0; d < dim; d++)
		for (size_t i = 0; i < n; i++)
			pm_out(x, d)[i] = 0.25 + (double)i;
	if (with_v)
		field(f, "matter", "v", dim, PM_STATE);
	return f;
}

static struct pm_field *change(struct pm_frame *f, const char *on, const char *name, const char *of, int components, double value)
{
	struct pm_field *y = field(f, on, name, components, PM_CHANGE);
	snprintf(y->of, sizeof y->of, "%s", of);
	for (int c = 0; c < components; c++)
		for (size_t i = 0; i < y->count; i++)
			pm_out(y, c)[i] = value;
	return y;
}

static double at(const struct pm_frame *f, const char *on, const char *name, int c, size_t i) { return pm_in(pm_frame_field(f, on, name), c)[i]; }

static void set(struct pm_frame *f, const char *on, const char *name, double value)
{
	struct pm_field *y = pm_frame_field(f, on, name);
	for (int c = 0; c < y->components; c++)
		for (size_t i = 0; i < y->count; i++)
			pm_out(y, c)[i] = value;
}

/* The push fails with this code, and its message contains this text. */
static void refused(struct pm_frame *f, const char *line, int code, const char *words)
{
	struct pm_frame *c = pm_frame_copy(f);
	int got = push(c, line);
	check(got == -code && strstr(pm_message(), words), "push %s: %s%s%s", line, words, got == -code ? "" : " -- GOT: ",
		got == -code && strstr(pm_message(), words) ? "" : pm_message());
	pm_frame_free(c);
}

static void usage(void)
{
	struct pm_frame *f = frame(2, 3, true);
	refused(f, "kcik", PM_USAGE, "did you mean 'kick'");
	refused(f, "kick/0.5", PM_USAGE, "N from 1 to 1e9");
	refused(f, "kick/", PM_USAGE, "N from 1 to 1e9");
	refused(f, "kick/two", PM_USAGE, "N from 1 to 1e9");
	refused(f, "rk4/2", PM_USAGE, "schemes have no parts");
	refused(f, "drift kick", PM_USAGE, "push drift | force | push kick");
	refused(f, "kick rk4", PM_USAGE, "a whole scheme stands alone");
	refused(f, "rk4 drift", PM_USAGE, "a whole scheme stands alone");
	refused(f, "clear kick", PM_USAGE, "put clear last");
	refused(f, "kick --open", PM_USAGE, "--open belongs to drift");
	refused(f, "drift --dt 0", PM_USAGE, "--dt must not be 0");
	pm_frame_free(f);
}

static void refusals(void)
{
	struct pm_frame *f = frame(2, 3, true), *g = frame(2, 3, false);
	const char *remedy = "no field 'acc' on 'matter' (compute it first: field 'acc = ...')";
	refused(f, "kick", PM_MISSING, remedy);
	refused(f, "kick/2 drift", PM_MISSING, remedy);
	refused(f, "rk4", PM_MISSING, remedy);
	refused(f, "ab3", PM_MISSING, remedy);
	refused(g, "drift", PM_MISSING, "no field 'vel' on 'matter' (compute it first");
	refused(g, "lsrk3", PM_MISSING, "no field 'vel' on 'matter' (compute it first");
	refused(f, "drift --set gas", PM_DATA, "no set 'gas'");
	f->sets[0]->fixed = true;
	refused(f, "drift", PM_DATA, "no set moves (has 'x', not fixed; species adds one)");
	refused(f, "drift --set matter", PM_DATA, "it is fixed");
	f->sets[0]->fixed = false;
	f->dt = 0;
	refused(f, "drift", PM_DATA, "no time step");
	f->dt = 0.25;
	change(f, "matter", "acc", "v", 2, 1);
	change(f, "matter", "growth", "size", 1, 1);
	refused(f, "kick", PM_DATA, "'growth' on 'matter' is the change of 'size', which is not there");
	pm_drops(f, pm_frame_field(f, "matter", "growth"));
	change(f, "matter", "vel", "x", 2, 1);
	refused(f, "kick", PM_DATA, "both a velocity 'v' and a change 'vel' of 'x'");
	pm_drops(f, pm_frame_field(f, "matter", "vel"));
	change(f, "matter", "bfield", "", 3, 1);
	refused(f, "kick", PM_DATA, "magnetic field, which a plain kick would leave out");
	refused(f, "rk4", PM_DATA, "magnetic field, which rk4 would leave out");
	pm_drops(f, pm_frame_field(f, "matter", "bfield"));
	pm_frame_mesh_new(f, "mesh", (const size_t[]){4, 4, 1});
	field(f, "matter", "strength", 1, PM_STATE);
	change(f, "mesh", "domega", "strength", 1, 1);
	refused(f, "kick", PM_DATA, "the change 'domega' of 'strength' is on mesh 'mesh' and not yet on 'matter' (carry it over with m2p)");
	refused(f, "rk2", PM_DATA, "carry it over with m2p");
	change(f, "matter", "dstrength", "strength", 1, 1);
	struct pm_field *there = pm_frame_field(f, "mesh", "domega"), *here = pm_frame_field(f, "matter", "dstrength");
	snprintf(there->terms[there->nterms++], PM_NAME, "diffusion");
	refused(f, "kick", PM_DATA, "carry it over with m2p"); /* one term of it is not yet there */
	snprintf(here->terms[here->nterms++], PM_NAME, "diffusion");
	check(push(f, "kick") == 0, "a change on a mesh that has been carried over is no obstacle");
	pm_frame_free(f), pm_frame_free(g);
}

/* Kick and drift advance by dt/N; kick keeps the rate, drift drops it. */
static void motion(void)
{
	struct pm_frame *f = frame(2, 5, true);
	pm_frame_mesh_new(f, "mesh", (const size_t[]){4, 4, 1});
	change(f, "matter", "acc", "v", 2, 2.385);
	field(f, "matter", "phi", 1, PM_DERIVED), field(f, "mesh", "rho", 1, PM_DERIVED), field(f, "mesh", "E", 2, PM_STATE);
	field(f, "matter", "strength", 1, PM_STATE);
	change(f, "matter", "dstrength", "strength", 1, -3);
	check(push(f, "kick/2") == 0 && pm_frame_field(f, "matter", "acc") && pm_frame_field(f, "matter", "phi") && pm_frame_field(f, "mesh", "rho"),
		"kick keeps change and derived fields");
	check_near(at(f, "matter", "v", 1, 4), 0.125 * 2.385, 0, "kick/2: v += acc dt/2");
	check_near(at(f, "matter", "strength", 0, 4), -0.375, 0, "kick/2: any other change field advances the state it names");
	check_near(at(f, "matter", "x", 1, 4), 4.25, 0, "kick leaves the positions");
	check(push(f, "drift") == 0, "drift after kick/2");
	check_near(at(f, "matter", "x", 1, 4), 4.25 + 0.25 * 0.125 * 2.385, 1e-15, "drift: x += v dt");
	check(!pm_frame_field(f, "matter", "acc") && !pm_frame_field(f, "matter", "phi") && !pm_frame_field(f, "mesh", "rho")
		&& !pm_frame_field(f, "matter", "dstrength"), "drift drops change and derived fields of the set and of the meshes");
	check(pm_frame_field(f, "mesh", "E") && pm_frame_field(f, "matter", "strength"), "drift keeps state, on meshes too");
	refused(f, "kick/2", PM_MISSING, "no field 'acc'");
	pm_frame_free(f);

	f = frame(1, 5, false);
	field(f, "matter", "v", 3, PM_STATE);
	change(f, "matter", "acc", "v", 1, 1);
	check(push(f, "kick drift") == 0, "one dimension with three velocities and one component of acc");
	check_near(at(f, "matter", "v", 0, 2), 0.25, 0, "the component that acc has is kicked");
	check_near(at(f, "matter", "v", 2, 2), 0, 0, "the missing ones count as zero");
	check_near(at(f, "matter", "x", 0, 2), 2.25 + 0.0625, 0, "kick and drift in one push: the drift uses the new velocity");
	pm_frame_free(f);

	f = frame(2, 5, false);
	change(f, "matter", "vel", "x", 2, 3);
	check(push(f, "drift") == 0 && f->step == 1, "a set without v moves by vel and completes its step with drift alone");
	check_near(at(f, "matter", "x", 1, 2), 2.25 + 0.75, 0, "x += vel dt");
	check(push(f, "clear") == 0 && f->substep == 0 && f->step == 1, "clear does not count as part of a step");
	pm_frame_free(f);
}

static void clock_is(const struct pm_frame *f, double time, int substep, int64_t step, const char *sentence)
{
	check(fabs(f->time - time) <= 1e-15 && f->substep == substep && f->step == step, "%s (time %.17g substep %d step %lld)", sentence, f->time,
		f->substep, (long long)f->step);
}

static void force(struct pm_frame *f, const char *on) /* acc = -x */
{
	int dim = pm_frame_field(f, on, "x")->components;
	struct pm_field *acc = change(f, on, "acc", "v", dim, 0);
	for (int d = 0; d < dim; d++)
		for (size_t i = 0; i < acc->count; i++)
			pm_out(acc, d)[i] = -at(f, on, "x", d, i);
}

static void clock(void)
{
	struct pm_frame *f = frame(2, 3, true);
	force(f, "matter");
	push(f, "kick/2"), clock_is(f, 0, 1, 0, "kick/2 alone does not change the time");
	push(f, "drift"), clock_is(f, 0.25, 2, 0, "time moves with drift");
	force(f, "matter");
	push(f, "kick/2"), clock_is(f, 0.25, 0, 1, "drift 1 and kick 1 complete the step");
	check(f->start == 0.25 && f->sets[0]->kick == 0 && f->sets[0]->drift == 0, "and both fractions are reset");
	push(f, "drift/2"), clock_is(f, 0.375, 1, 1, "half a drift is half of dt");
	force(f, "matter");
	push(f, "kick drift/2"), clock_is(f, 0.5, 0, 2, "drift/2, kick, drift/2 is a step");
	for (int i = 0; i < 3; i++)
		push(f, "drift/3");
	clock_is(f, 0.75, 0, 3, "three thirds are a step");
	for (int n = 3; n <= 1000000; n = 10 * n + 7 > 1000000 && n < 1000000 ? 1000000 : 10 * n + 7) {
		struct pm_set s = {.name = "matter", .kick = 1};
		int bad = 0;
		for (int i = 0; i < n && !bad; i++)
			bad = pm_clock_complete(&s) || pm_clock_add(&s, 0, 1.0 / n, false);
		check(!bad && s.drift == 1, "%d parts drift/%d are one, not earlier and not later", n, n);
		if (n == 1000000)
			break;
	}
	push(f, "drift --open"), clock_is(f, 1, 1, 3, "drift --open: a kick is still to come");
	force(f, "matter");
	push(f, "kick"), clock_is(f, 1, 0, 4, "and the kick completes the step");
	force(f, "matter");
	push(f, "kick"), clock_is(f, 1, 1, 4, "a kick alone does not");
	refused(f, "kick/2", PM_DATA, "kick on 'matter' adds up to 1.5 of a step");
	refused(f, "drift --dt 0.5", PM_DATA, "may change only at substep 0");
	refused(f, "rk4", PM_DATA, "in the middle of a step");
	check(push(f, "drift --dt 0.25") == 0, "push --dt with the same value is allowed");
	check(push(f, "drift --dt 0.5") == 0 && f->dt == 0.5, "push --dt at substep 0 is recorded");
	pm_frame_free(f);

	f = frame(2, 3, true);
	force(f, "matter"), push(f, "kick/2 drift");
	force(f, "matter");
	refused(f, "kick/2 drift", PM_DATA, "drift on 'matter' adds up to 2 of a step");
	check(push(f, "kick/2") == 0, "HC-17: misaligned: the closing kick must come first");
	pm_frame_free(f);
}

static void several_sets(void)
{
	struct pm_frame *f = frame(2, 3, true);
	pm_frame_set_new(f, "dust", 2), pm_frame_set_new(f, "wall", 2);
	field(f, "dust", "x", 2, PM_STATE), field(f, "dust", "v", 2, PM_STATE);
	field(f, "wall", "x", 2, PM_STATE), field(f, "wall", "v", 2, PM_STATE);
	pm_frame_set(f, "wall")->fixed = true;
	set(f, "wall", "v", 1);
	force(f, "matter"), force(f, "wall");
	refused(f, "kick", PM_MISSING, "no field 'acc' on 'dust'");
	force(f, "dust");
	set(f, "dust", "v", 1);
	check(push(f, "drift --set matter") == 0 && !pm_frame_field(f, "matter", "acc") && pm_frame_field(f, "dust", "acc"),
		"--set moves one set and drops its rates alone");
	clock_is(f, 0, 1, 0, "time follows the slowest set that moves");
	check(at(f, "dust", "x", 0, 0) == 0, "the other set has not moved");
	refused(f, "drift", PM_DATA, "completed its step and waits for the other sets");
	refused(f, "rk2 --set matter", PM_DATA, "completed its step and waits");
	push(f, "drift/2 --set dust"), clock_is(f, 0.125, 2, 0, "half of the slowest");
	push(f, "drift/2 --set dust"), clock_is(f, 0.25, 0, 1, "when all are complete the step is done");
	check(at(f, "wall", "x", 0, 0) == 0 && at(f, "wall", "v", 0, 0) == 1, "a fixed set is left alone");
	check(!pm_frame_field(f, "wall", "acc"), "except for its change fields, which depend on the positions of the others");
	check(push(f, "drift") == 0, "both at once");
	clock_is(f, 0.5, 0, 2, "is a step of both");
	force(f, "matter"), set(f, "dust", "v", 0);
	for (int pass = 0; pass < 4; pass++)
		force(f, "matter"), push(f, "rk4 --set matter");
	clock_is(f, 0.5, 4, 2, "a scheme on one set, too, waits for the other");
	push(f, "drift --open --set dust"), clock_is(f, 0.75, 5, 2, "drift --open on the other");
	force(f, "dust");
	push(f, "kick --set dust"), clock_is(f, 0.75, 0, 3, "and its kick closes the step of both");
	pm_frame_free(f);
}

/* Passes of a scheme on x'' = -x until the step is complete; the number of them. */
static int step(struct pm_frame *f, const char *line)
{
	int passes = 0;
	do {
		force(f, "matter");
		if (push(f, line))
			return -1;
		passes++;
	} while (f->substep && passes < 9);
	return passes;
}

static int registers(const struct pm_frame *f)
{
	int n = 0;
	for (size_t i = 0; i < f->nfields; i++)
		n += f->fields[i]->role == PM_REGISTER;
	return n;
}

static double error_at_one(const char *line, int n)
{
	struct pm_frame *f = frame(2, 1, true);
	f->dt = 1.0 / n;
	for (int i = 0; i < n; i++)
		step(f, line);
	double e = fabs(at(f, "matter", "x", 1, 0) - 0.25 * cos(1)) + fabs(f->time - 1) + fabs((double)f->step - n);
	pm_frame_free(f);
	return e;
}

static void schemes(void)
{
	static const struct {
		const char *name;
		int order, passes, later, kept;
		double at[4];
	} all[] = {{"euler", 1, 1, 1, 0, {0}}, {"rk2", 2, 2, 2, 0, {1}}, {"midpoint", 2, 2, 2, 0, {0.5}},
		{"lsrk3", 3, 3, 3, 0, {1.0 / 3, 0.75}}, {"rk4", 4, 4, 4, 0, {0.5, 0.5, 1}},
		{"ab2", 2, 2, 1, 2, {1}}, {"ab3", 3, 3, 1, 4, {1.0 / 3, 0.75}}};
	for (int k = 0; k < 7; k++) {
		const char *name = all[k].name;
		struct pm_frame *f = frame(2, 3, true);
		for (int p = 0; p + 1 < all[k].passes; p++) {
			force(f, "matter"), push(f, name);
			check(f->substep == p + 1 && f->sets[0]->pass == p + 1 && fabs(f->time - 0.25 * all[k].at[p]) < 1e-16 && !f->step && registers(f) > 0,
				"%s: after pass %d the time is that of the stage", name, p + 1);
			check(!pm_frame_field(f, "matter", "acc"), "%s: every pass drops the rates", name);
		}
		if (all[k].passes > 1) {
			force(f, "matter");
			refused(f, "kick", PM_DATA, "is under way");
			refused(f, "drift", PM_DATA, "is under way");
			refused(f, strcmp(name, "rk4") ? "rk4" : "rk2", PM_DATA, "is under way");
		}
		force(f, "matter"), push(f, name);
		check(f->step == 1 && !f->substep && registers(f) == all[k].kept, "%s: after the last pass the step is done and %d registers are left", name,
			all[k].kept);
		step(f, name);
		check(step(f, name) == all[k].later && step(f, name) == all[k].later, "%s: %d passes for every later step", name, all[k].later);
		pm_frame_free(f);
		double h[3], e[3];
		for (int i = 0; i < 3; i++)
			h[i] = 1.0 / (16 << i), e[i] = error_at_one(name, 16 << i);
		char text[96];
		snprintf(text, sizeof text, "%s: order of an oscillator moved by push", name);
		check_order(3, h, e, all[k].order, text);
	}
}

static void restarts(void)
{
	struct pm_frame *f = frame(2, 3, true);
	step(f, "ab3"), step(f, "ab3");
	check(step(f, "ab3") == 1, "ab3 is running");
	check(step(f, "ab3 --dt 0.125") == 3, "ab3 restarts when dt has changed");
	step(f, "ab3"), check(step(f, "ab3") == 1, "and runs again");
	pm_drops(f, pm_frame_field(f, "matter", "q2_v"));
	check(step(f, "ab3") == 3, "ab3 restarts when a register is missing");
	step(f, "ab3"), step(f, "ab3"), step(f, "drift");
	check(registers(f) == 0, "drift drops the old rates, which no longer belong to the step before");
	check(step(f, "ab3") == 3, "ab3 restarts after another scheme has moved the particles");
	check(step(f, "ab2") == 2 && registers(f) == 2, "ab2 does not take the old rates of ab3");
	check(step(f, "rk4") == 4 && registers(f) == 0, "and leaves none to rk4");
	force(f, "matter"), push(f, "rk4");
	pm_drops(f, pm_frame_field(f, "matter", "q_x"));
	force(f, "matter");
	refused(f, "rk4", PM_DATA, "no register 'q_x' on 'matter' after 1 passes of rk4");
	pm_frame_free(f);
}

static void faces(void)
{
	struct pm_frame *f = frame(2, 5, true);
	double *x = pm_out(pm_frame_field(f, "matter", "x"), 0), *v = pm_out(pm_frame_field(f, "matter", "v"), 0);
	const double from[] = {9.75, -1e-17, 10, 3, 0.125}, speed[] = {2, 0, 0, 1e6, -1};
	for (int s = 0; s < 2; s++)
		f->pface[0][s] = PM_PFOLD;
	memcpy(x, from, sizeof from), memcpy(v, speed, sizeof speed);
	push(f, "drift");
	check_near(at(f, "matter", "x", 0, 0), 0.25, 0, "periodic: folded at the top");
	check_near(at(f, "matter", "x", 0, 1), 0, 0, "FP-04: periodic: -1e-17 becomes lo, not L");
	check_near(at(f, "matter", "x", 0, 2), 0, 0, "periodic: lo + L becomes lo");
	check_near(at(f, "matter", "x", 0, 3), 3, 1e-10, "periodic: many boxes at once");
	check_near(at(f, "matter", "x", 0, 4), 9.875, 0, "periodic: folded at the bottom");
	check_near(at(f, "matter", "v", 0, 0), 2, 0, "periodic: the velocity is kept");

	for (int s = 0; s < 2; s++)
		f->pface[0][s] = PM_PREFLECT;
	const double inside[] = {9.75, 0.125, 10, 3, 0}, fast[] = {2, -1, 0, 1e6, -44};
	memcpy(pm_out(pm_frame_field(f, "matter", "x"), 0), inside, sizeof inside), memcpy(pm_out(pm_frame_field(f, "matter", "v"), 0), fast, sizeof fast);
	struct pm_frame *before = pm_frame_copy(f);
	push(f, "drift");
	check_near(at(before, "matter", "v", 0, 0), 2, 0, "reflect: a frame that shares the buffers keeps its velocities");
	pm_frame_free(before);
	check_near(at(f, "matter", "x", 0, 0), 9.75, 0, "reflect: mirrored at the top");
	check_near(at(f, "matter", "v", 0, 0), -2, 0, "reflect: and its velocity is reversed");
	check_near(at(f, "matter", "x", 0, 1), 0.125, 0, "reflect: mirrored at the bottom");
	check_near(at(f, "matter", "v", 0, 1), 1, 0, "reflect: and its velocity is reversed there");
	check_near(at(f, "matter", "x", 0, 2), 10, 0, "reflect: a particle on the face stays");
	check_near(at(f, "matter", "x", 0, 3), 3, 1e-10, "reflect: 250000 lengths are an even number of mirrors");
	check_near(at(f, "matter", "v", 0, 3), 1e6, 0, "reflect: and the velocity is as before");
	check_near(at(f, "matter", "x", 0, 4), 9, 0, "reflect: twice in a step");
	check_near(at(f, "matter", "v", 0, 4), -44, 0, "reflect: and reversed twice is the original velocity");
	check_near(at(f, "matter", "v", 1, 0), 0, 0, "reflect: other components are kept");
	for (int s = 0; s < 2; s++)
		f->pface[0][s] = PM_POPEN;
	set(f, "matter", "v", 100);
	push(f, "drift");
	check_near(at(f, "matter", "x", 0, 0), 34.75, 0, "open: positions are not changed");
	pm_frame_free(f);
}

/* A particle in a constant field between mirrors: with the mirror the exact parabola is folded, and so is that of any scheme. */
static void mirrors_in_schemes(void)
{
	static const char *const names[] = {"rk2", "midpoint", "lsrk3", "rk4", "ab2", "ab3"};
	for (int k = 0; k < 6; k++) {
		struct pm_frame *f = frame(1, 1, true), *g = frame(1, 1, true);
		for (int s = 0; s < 2; s++)
			f->pface[0][s] = PM_PREFLECT;
		set(f, "matter", "x", 9), set(g, "matter", "x", 9), set(f, "matter", "v", 2.385), set(g, "matter", "v", 2.385);
		for (int i = 0; i < 12; i++) {
			for (int other = 0; other < 2; other++) {
				struct pm_frame *h = other ? g : f;
				do { /* a force that the mirror reverses too: 0.3 away from the wall's image */
					double x = at(h, "matter", "x", 0, 0);
					bool image = other ? x > 10 : at(f, "matter", "v", 0, 0) < 0;
					change(h, "matter", "acc", "v", 1, !other && image ? -0.3 : 0.3);
					push(h, names[k]);
				} while (h->substep);
			}
		}
		char text[96];
		snprintf(text, sizeof text, "reflect: %s through a mirror is the mirrored path", names[k]);
		double x = at(g, "matter", "x", 0, 0);
		check_near(at(f, "matter", "x", 0, 0), x > 10 ? 20 - x : x, 1e-12, text);
		pm_frame_free(f), pm_frame_free(g);
	}
}

static void absorb(void)
{
	struct pm_frame *f = frame(2, 9, true);
	struct pm_field *id = field(f, "matter", "id", 1, PM_STATE), *tag = field(f, "matter", "tag", 2, PM_STATE), *mass = field(f, "matter", "mass", 1,
		PM_STATE);
	pm_drops(f, id), pm_drops(f, tag);
	id = pm_makes(f, "matter", "id", 1, PM_STATE), id->type = PM_I64;
	tag = pm_makes(f, "matter", "tag", 2, PM_STATE), tag->type = PM_U8;
	pm_field_ready(id), pm_field_ready(tag), id->use = tag->use = 0;
	mass->uniform = true, mass->value[0] = 0.5;
	double *v = pm_out(pm_frame_field(f, "matter", "v"), 0);
	for (int i = 0; i < 9; i++) {
		pm_out_i64(id, 0)[i] = 100 + i, pm_out_u8(tag, 0)[i] = (unsigned char)i, pm_out_u8(tag, 1)[i] = (unsigned char)(2 * i);
		v[i] = i % 4 == 0 ? -100 : 0; /* 0, 4 and 8 leave at the bottom of x */
	}
	f->pface[0][0] = PM_PABSORB;
	check(push(f, "drift") == 0 && f->sets[0]->n == 6, "absorb: particles that crossed the face are gone");
	const int64_t want[] = {101, 102, 103, 105, 106, 107};
	bool good = true;
	for (int i = 0; i < 6; i++)
		good = good && pm_in_i64(pm_frame_field(f, "matter", "id"), 0)[i] == want[i]
			&& pm_in_u8(pm_frame_field(f, "matter", "tag"), 1)[i] == 2 * (want[i] - 100)
			&& at(f, "matter", "x", 1, (size_t)i) == 0.25 + (double)(want[i] - 100);
	check(good, "absorb: the remaining particles keep all their fields, in order");
	check(pm_frame_field(f, "matter", "mass")->uniform && pm_frame_field(f, "matter", "mass")->count == 6, "absorb: a uniform field stays uniform");
	json_t *report = json_object_get(f->report, "push drift");
	check(json_integer_value(json_object_get(report, "absorbed")) == 3, "absorb: and they are counted");
	f->pface[0][1] = PM_PABSORB;
	set(f, "matter", "v", 1e3);
	check(push(f, "drift") == 0 && f->sets[0]->n == 0, "absorb: all of them");
	check(push(f, "drift") == 0 && f->step == 3, "N = 0: an empty set still completes its steps");
	pm_frame_free(f);
}

/* The header alone. A sum of a million 0.1 is 100000.00000133288. */
static void million(void)
{
	struct pm_frame *f = pm_frame_new(1);
	struct pm_set *s = pm_frame_set_new(f, "matter", 0);
	pm_makes(f, "matter", "x", 1, PM_STATE);
	pm_frame_dt_set(f, 0.1);
	for (int i = 0; i < 1000000; i++)
		pm_clock_add(s, 0, 1, false), pm_clock_close(f);
	check(f->step == 1000000 && f->time == 100000, "1e6 steps of 0.1 end at exactly 100000 (%.17g)", f->time);
	pm_frame_dt_set(f, 1 / 3.);
	check(f->since_time == 100000 && f->since_step == 1000000, "another dt counts from there");
	int inside = 0;
	for (int i = 0; i < 2000000; i++) {
		pm_clock_add(s, 0, 0.5, false), pm_clock_close(f);
		inside += f->substep && f->time != f->start + f->dt / 2;
	}
	check(f->step == 2000000 && f->time == 100000 + 1000000 * (1 / 3.), "and so do 1e6 steps of 1/3 in two halves (%.17g)", f->time);
	check(!inside, "half-way the time is half a step after the beginning of the step");
	f->dt = 0.1; /* by a word that knows nothing of since */
	pm_clock_add(s, 0, 1, false), pm_clock_close(f);
	check(f->time == f->since_time + 0.1 && f->since_step == 2000000, "a dt that was set by hand counts from the next step on (%.17g)", f->time);
	pm_frame_free(f);
}

int main(void)
{
	usage();
	refusals();
	motion();
	clock();
	million();
	several_sets();
	schemes();
	restarts();
	faces();
	mirrors_in_schemes();
	absorb();
	return check_done();
}
