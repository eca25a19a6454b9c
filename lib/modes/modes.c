/* The linear modes of a sentence on a frame. With M the map of the state over `steps` steps, its derivative on a vector w is
 *   J w = (M(u + e w) - M(u - e w))/(2 e),   error e^2 M''' and 1e-16/e,
 * with e such that the largest displacement is `displacement` scales (state-vector.h). Arnoldi's iteration gives the eigenvalues lambda of J of largest
 * magnitude; a mode grows by ln|lambda|/steps per step. Two runs of the sentence for each vector.
 * Limits: the map is that of one place of the state, so u must be an equilibrium, or periodic with these steps. Conserved quantities give lambda = 1, often
 * defective (an offset of a velocity moves a position for ever), which errors of 1e-10 split by 1e-5: growth below `neutral` is none.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "modes/modes.h"
#include "sentence/sentence.h"
#include "stream/run.h"

static const double differences = 1e-7; /* the relative error of J w, measured on smooth forces with the default displacement: 1e-10 to 1e-8 */

struct map {
	const struct pm_modes *m;
	const struct pm_modes_choice *c;
	const struct pm_frame *base;
	struct pm_sentence *words;
};

static int steps(struct pm_sentence *s, struct pm_frame **f, int64_t n)
{
	int status = *f ? 0 : pm_failed();
	for (int64_t i = 0; i < n && !status; i++)
		status = pm_sentence_step(s, f);
	return status;
}

/* out = J in. */
static int derivative(void *with, const double *in, double *out)
{
	const struct map *a = with;
	const struct pm_state_vector *v = &a->m->state;
	double largest = 0;
	for (size_t i = 0; i < v->n; i++)
		largest = fmax(largest, fabs(in[i]));
	const double e = a->c->displacement / largest;
	struct pm_frame *up = pm_state_moved(v, a->base, in, e), *down = pm_state_moved(v, a->base, in, -e);
	int status = up && down ? steps(a->words, &up, a->c->steps) : pm_failed();
	status = status ? status : steps(a->words, &down, a->c->steps);
	status = status ? status : pm_state_difference(v, up, down, 2 * e, out);
	pm_frame_free(up);
	pm_frame_free(down);
	return status;
}

static bool has_registers(const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nfields; i++)
		if (f->fields[i]->role == PM_REGISTER)
			return true;
	return false;
}

/* The state about which is linearised. A scheme with registers (ab2, ab3) has them after its first steps. */
static int settle(struct pm_sentence *words, struct pm_frame **base, struct pm_frame **after)
{
	static const struct pm_state_vector nothing;
	int status = *base ? 0 : pm_failed();
	if (!status && has_registers(*after) && !has_registers(*base)) {
		pm_frame_free(*base);
		*base = *after;
		status = steps(words, base, 2);
		struct pm_frame *bare = status ? NULL : pm_state_moved(&nothing, *base, NULL, 0);
		status = status ? status : bare ? 0 : pm_failed();
		*after = NULL;
		if (bare) {
			pm_frame_free(*base);
			*base = bare;
			*after = pm_frame_copy(bare);
			status = steps(words, after, 1);
		}
	}
	return status;
}

/* How far the map moves the state, in scales. */
static int rest(struct pm_modes *m, const struct pm_modes_choice *c, const struct pm_frame *base, struct pm_frame *after)
{
	double *d = pm_alloc(m->state.n, sizeof *d);
	int status = d ? pm_state_difference(&m->state, after, base, 1, d) : pm_no_memory();
	for (size_t i = 0; i < m->state.n && !status; i++)
		m->moves = fmax(m->moves, fabs(d[i]));
	pm_free(d);
	if (!status && fabs((after->time - base->time) / (double)c->steps - after->dt) > 1e-6 * fabs(after->dt))
		status = pm_fail(PM_USAGE, "the sentence chooses its steps, and modes are of steps of one length (push ias15 --tolerance 0; without dt)");
	if (!status && m->moves > 0.01 && !c->moving)
		status = pm_fail(PM_USAGE, "the frame is no equilibrium: its state changes by %.2g of the distance of particles in "
			"%lld step%s (-n: the steps after which it returns; --moving: the modes of these steps alone)", m->moves,
			(long long)c->steps, c->steps == 1 ? "" : "s");
	return status;
}

int pm_modes_run(struct pm_modes *m, const struct pm_frame *f, const char *sentence, const struct pm_modes_choice *c)
{
	static const struct pm_state_vector nothing;
	const struct pm_stage quiet = {.quiet = true};
	*m = (struct pm_modes){.steps = c->steps};
	struct map a = {.m = m, .c = c, .words = pm_sentence_new(sentence, true, NULL)};
	struct pm_frame *base = NULL, *after = NULL;
	int status = a.words ? 0 : pm_failed();
	if (!status && f->substep)
		status = pm_fail(PM_DATA, "in the middle of a step (substep %d)", f->substep);
	if (!status) {
		pm_sentence_notes(a.words, &quiet); /* hundreds of runs would each say the same */
		base = pm_state_moved(&nothing, f, NULL, 0);
		after = base ? pm_frame_copy(base) : NULL;
		status = steps(a.words, &after, 1);
	}
	status = status ? status : settle(a.words, &base, &after);
	struct pm_frame *rates = status ? NULL : pm_frame_copy(base);
	status = status ? status : rates ? pm_sentence_prime(a.words, &rates) : pm_failed();
	status = status ? status : pm_state_vector_of(&m->state, base, rates, after->dt);
	pm_frame_free(rates);
	status = status ? status : steps(a.words, &after, c->steps - 1);
	status = status ? status : rest(m, c, base, after);
	a.base = base;
	m->dt = after ? after->dt : 0;
	status = status ? status : pm_arnoldi_run(&m->found, m->state.n, (int)c->vectors, c->tolerance, (uint64_t)c->seed, derivative, &a);
	char message[1024];
	snprintf(message, sizeof message, "%s", pm_message());
	pm_frame_free(base);
	pm_frame_free(after);
	pm_sentence_free(a.words);
	return status ? pm_fail(-status, "%s", message) : 0;
}

struct pm_mode pm_modes_mode(const struct pm_modes *m, const struct pm_modes_choice *c, int k)
{
	const struct pm_ritz *r = m->found.ritz + k;
	const double size = hypot(r->re, r->im), n = (double)m->steps;
	struct pm_mode mode = {size > 0 ? log(size) / n : -INFINITY, size > 0 ? (r->residual / size + differences) / n : 0, atan2(r->im, r->re) / n, false};
	mode.unstable = mode.growth > c->neutral && mode.growth > mode.error;
	return mode;
}

/* A field of the mode, of the numbers `from`, in its own units. */
static int one_field(struct pm_frame *f, const struct pm_state_part *p, const char *ending, const double *from)
{
	char name[PM_NAME];
	if (snprintf(name, sizeof name, "mode_%s%s", p->name, ending) >= PM_NAME)
		return pm_fail(PM_DATA, "the name of the field '%s' is too long for its mode", p->name);
	struct pm_field *field = pm_makes(f, p->on, name, p->components, PM_DERIVED);
	if (!field || pm_field_ready(field))
		return pm_failed();
	for (int c = 0; c < p->components; c++)
		for (size_t i = 0; i < p->count; i++)
			pm_out(field, c)[i] = p->scale * from[(size_t)c * p->count + i];
	return 0;
}

/* The largest number of the positions, or of all where no position takes part, in units of the field; *at: its place. */
static double largest_of(const struct pm_state_vector *v, const double *re, const double *im, bool positions, size_t *at)
{
	double largest = 0;
	size_t k = 0;
	for (int p = 0; p < v->parts; p++) {
		const size_t end = k + (size_t)v->part[p].components * v->part[p].count;
		for (; k < end; k++) {
			const double x = v->part[p].scale * hypot(re[k], im[k]);
			if ((v->part[p].position || !positions) && x > largest * (1 + 1e-6)) { /* of equal ones the first, whatever the last bits are */
				*at = k;
				largest = x;
			}
		}
	}
	return largest;
}

int pm_modes_fields(const struct pm_modes *m, int k, struct pm_frame *f)
{
	const size_t n = m->state.n;
	double *re = pm_alloc(2 * n, sizeof *re), *im = re ? re + n : NULL, left = 0;
	size_t at = 0, from = 0;
	int status = re ? 0 : pm_no_memory();
	if (status)
		return status;
	pm_arnoldi_vector(&m->found, k, re, im);
	if (fabs(m->found.ritz[k].im) < 1e-6 * fabs(m->found.ritz[k].re)) /* a double real eigenvalue, split by errors: the real part alone is a mode */
		memset(im, 0, n * sizeof *im);
	double largest = largest_of(&m->state, re, im, true, &at);
	largest = largest > 0 ? largest : largest_of(&m->state, re, im, false, &at);
	const double here = hypot(re[at], im[at]), c = re[at] / here, s = im[at] / here; /* the phase in which the largest number is real and positive */
	for (size_t i = 0; i < n; i++) {
		const double x = (re[i] * c + im[i] * s) / largest;
		im[i] = (im[i] * c - re[i] * s) / largest;
		re[i] = x;
		left = fmax(left, fabs(im[i]) * largest);
	}
	for (int p = 0; p < m->state.parts && !status; p++) {
		const struct pm_state_part *part = m->state.part + p;
		if (part->role != PM_REGISTER) {
			status = one_field(f, part, "", re + from);
			if (!status && left > 1e-6)
				status = one_field(f, part, "_imaginary", im + from);
		}
		from += (size_t)part->components * part->count;
	}
	pm_free(re);
	return status;
}

void pm_modes_free(struct pm_modes *m) { pm_arnoldi_free(&m->found); }
