/* The clock of a step, kept in the header of the frame. Cost: a few words per set and push.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "push/step-clock.h"
#include "stream/frame-time.h"

static const double tolerance = 1e-10; /* parts add to one only up to round-off: a million millionths to 8e-12, and no part is below 1e-9 */

static bool is_open(const struct pm_set *s) { return json_is_true(json_object_get(s->more, "open")); }

bool pm_clock_complete(const struct pm_set *s)
{
	return s->pass == 0 && s->drift == 1 && (s->kick == 0 || s->kick == 1) && !is_open(s);
}

static const char *scheme_name(const struct pm_set *s)
{
	const char *name = json_string_value(json_object_get(json_object_get(s->more, "scheme"), "name"));
	return name ? name : "a scheme";
}

static void set_scheme(struct pm_set *s, const char *name, double dt, int rates)
{
	if (!s->more)
		s->more = json_object();
	json_object_set_new(s->more, "scheme", json_pack("{s:s,s:f,s:i}", "name", name, "dt", dt, "rates", rates));
}

void pm_register_name(char to[PM_NAME], int i, const char *state)
{
	if (i)
		snprintf(to, PM_NAME, "q%d_%.48s", i + 1, state);
	else
		snprintf(to, PM_NAME, "q_%.48s", state);
}

/* Number of old steps in the registers of a set for this scheme and dt; 0 if anything does not match, so that the scheme is restarted. */
static int remembered(const struct pm_frame *f, const struct pm_set *s, const struct pm_step *asked, int n, const struct pm_rate *rates)
{
	const json_t *scheme = json_object_get(s->more, "scheme"), *count = json_object_get(scheme, "rates");
	json_int_t most = json_is_integer(count) ? json_integer_value(count) : 0;
	if (strcmp(scheme_name(s), asked->name) || json_number_value(json_object_get(scheme, "dt")) != f->dt || most < 0 || most > asked->rates)
		return 0;
	for (int r = 0; r < n; r++)
		for (int i = 0; i < asked->rates; i++) {
			char name[PM_NAME];
			pm_register_name(name, i, rates[r].state->name);
			const struct pm_field *q = pm_frame_field(f, s->name, name);
			if (!q || q->role != PM_REGISTER)
				return 0;
		}
	return (int)most;
}

int pm_clock_allows(const struct pm_set *s, const struct pm_step *scheme, double kick, double drift)
{
	const char *what = scheme ? scheme->name : kick > 0 && drift > 0 ? "kick and drift" : kick > 0 ? "kick" : "drift";
	if (s->pass && (!scheme || strcmp(scheme_name(s), scheme->name)))
		return pm_fail(PM_DATA, "%s on '%s' while %s is under way (%d passes done; finish its step first)", what, s->name, scheme_name(s),
			s->pass);
	if (pm_clock_complete(s))
		return pm_fail(PM_DATA, "%s on '%s', which has completed its step and waits for the other sets (--set to move those; drift --open where a "
			"kick is still to come)", what, s->name);
	if (scheme && !s->pass && (s->kick > 0 || s->drift > 0))
		return pm_fail(PM_DATA, "%s on '%s' in the middle of a step (kick %.6g, drift %.6g are done; complete them first)", what, s->name, s->kick,
			s->drift);
	return 0;
}

int pm_clock_add(struct pm_set *s, double kick, double drift, bool open)
{
	double *done[] = {&s->kick, &s->drift}, more[] = {kick, drift};
	for (int i = 0; i < 2; i++) {
		double sum = *done[i] + more[i];
		if (sum > 1 + tolerance)
			return pm_fail(PM_DATA, "%s on '%s' adds up to %.6g of a step (kick %.6g, drift %.6g were done before this push; %s)",
				i ? "drift" : "kick", s->name, sum, s->kick, s->drift, i && s->kick > 0 && s->kick < 1 && s->drift == 1 ?
				"the other part of the kick is missing: push kick/2 behind the force" : !i && s->kick == 1 && s->drift < 1 ?
				"a push drift is missing before it" : "each may reach 1");
		more[i] = fabs(sum - 1) <= tolerance ? 1 : sum;
	}
	s->kick = more[0], s->drift = more[1];
	if (open && s->drift == 1 && s->kick == 0)
		json_object_set_new(s->more, "open", json_true());
	else if (kick > 0)
		json_object_del(s->more, "open");
	json_object_del(s->more, "scheme"); /* old rates are invalid after another kind of push */
	return 0;
}

int pm_clock_pass(const struct pm_frame *f, struct pm_set *s, const struct pm_step *asked, int n, const struct pm_rate *rates,
	struct pm_pass *p)
{
	int memory = remembered(f, s, asked, n, rates);
	const struct pm_step *step = memory < asked->rates ? pm_step_find(asked->start) : asked;
	if (!step)
		return -PM_DATA;
	if (s->pass >= step->passes)
		return pm_fail(PM_DATA, "'%s' claims %d passes of %s, which has %d", s->name, s->pass, step->name, step->passes);
	bool last = s->pass + 1 == step->passes;
	*p = (struct pm_pass){.step = step, .pass = s->pass, .registers = asked->rates + step->registers,
		.known = s->pass ? PM_REGISTERS : memory ? asked->rates : 0,
		.shift = asked->changes ? step != asked && last : s->pass == 0};
	p->kept = last ? asked->rates : p->registers;
	if (last)
		memory = memory < asked->rates ? memory + 1 : memory;
	set_scheme(s, asked->name, f->dt, memory);
	if (last && !asked->rates)
		json_object_del(s->more, "scheme");
	s->pass = last ? 0 : s->pass + 1;
	s->drift = pm_step_at(step, p->pass);
	s->kick = last;
	return 0;
}

void pm_clock_close(struct pm_frame *f)
{
	double slowest = HUGE_VAL;
	bool complete = true;
	if (f->substep == 0) {
		f->start = f->time;
		if (!pm_frame_since_holds(f))
			pm_frame_since_renew(f);
	}
	for (size_t i = 0; i < f->nsets; i++)
		if (pm_set_moves(f, f->sets[i])) {
			slowest = fmin(slowest, f->sets[i]->drift);
			complete = complete && pm_clock_complete(f->sets[i]);
		}
	f->time = slowest != 1 ? f->start + f->dt * slowest : pm_frame_time_at(f, f->step + 1); /* compositions pass 0 and 1 on their way */
	f->substep++;
	if (!complete)
		return;
	f->start = f->time;
	f->step++;
	f->substep = 0;
	for (size_t i = 0; i < f->nsets; i++)
		f->sets[i]->kick = f->sets[i]->drift = 0;
}
