/* Proportional and integral control of the step (step-choice.h).
 * Source: Gustafsson 1991, ACM Trans. Math. Softw. 17, 533; Hairer and Wanner 1996, section IV.2. Cost: none.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "push/step-choice.h"
#include "stream/frame-time.h"

static const double safety = 0.9, shortest = 0.2, longest = 5; /* of a step over the last one */

struct pm_choice pm_choice_recall(const struct pm_moving *m, const struct pm_step *scheme)
{
	const char *name = json_string_value(json_object_get(json_object_get(m->set->more, "scheme"), "name"));
	if (!name || strcmp(name, scheme->name))
		return (struct pm_choice){0};
	return (struct pm_choice){.error = fmax(pm_decided_recall(m, "error"), 0), .rejected = pm_decided_recall(m, "rejected") != 0,
		.rest = pm_decided_recall(m, "rest")};
}

int pm_choice_of(struct pm_frame *f, const struct pm_push *p, int order, struct pm_choice *c, struct pm_controlled *done)
{
	const double power = 1.0 / (order + 1), e = done->error / p->tolerance, dt = f->dt;
	const double before = c->error > 0 ? fmax(c->error, 1e-4) : 1;
	done->dt = done->next = dt;
	done->completed = true;
	done->iterations = 1;
	if (!(p->tolerance > 0))
		return isfinite(done->error) ? 0 : pm_fail(PM_NUMERICS, "the step from time %.9g with dt %g is not finite (a shorter dt)", f->start, dt);
	double ratio = !isfinite(e) ? shortest : e > 0 ? safety * pow(e, -(e <= 1 ? 0.7 : 1) * power) * (e <= 1 ? pow(before, 0.4 * power) : 1) : longest;
	ratio = fmin(c->rejected ? 1 : longest, fmax(shortest, ratio));
	done->rejected = !(e <= 1) && fabs(dt) > p->floor;
	done->least = !(e <= 1) && !done->rejected;
	if (done->least && !isfinite(e))
		return pm_fail(PM_NUMERICS, "the step from time %.9g is not finite, and is the shortest that --min allows, %g", f->start, dt);
	done->completed = !done->rejected;
	done->next = copysign(fmax(p->floor, fmin(p->most, fabs(dt) * ratio)), dt);
	if (!(fabs(f->start + done->next - f->start) > 0))
		return pm_fail(PM_NUMERICS, "%s would need steps of %g at time %.9g: the rates are not smooth there (bodies that meet, a coarse mesh; a "
			"softening, a larger --tolerance, or --min)", p->scheme->name, done->next, f->start);
	c->rejected = done->rejected;
	if (done->completed)
		c->error = e;
	else
		pm_frame_dt_set(f, done->next);
	return 0;
}

void pm_choice_take(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_choice *c, int pass, double at, const struct pm_controlled *done)
{
	const double began = f->start, step = f->dt + c->rest, rest = done->completed ? step - ((began + step) - began) : c->rest;
	const bool chosen = done->completed && done->next != f->dt;
	json_t *memory = json_pack("{s:f,s:i,s:f,s:f}", "error", c->error, "rejected", (int)c->rejected, "rest", chosen ? rest : c->rest, "dt", f->dt);
	pm_decided_mark(f, n, moving, memory, pass, at);
	if (!chosen) /* the time of steps of one length is exact */
		return;
	f->time = f->start = began + step;
	f->dt = done->next;
	pm_frame_since_renew(f);
}
