/* Markov jump processes of particles. A particle in the state s jumps by channel c at the rate a_c(s) >= 0. Within a step the process is exact (Gillespie 1977,
 * J. Phys. Chem. 81, 2340, the direct method): with a = sum of a_c the time to the next jump is -ln(u1)/a, its channel is c with probability a_c/a, and the
 * rates are computed anew from the state behind it, until dt is used up. So a particle stays as it is with probability exp(-a dt). Numbers that the channels do
 * not change (time, totals over the set) keep the values of the beginning: an error of first order in dt, none without them.
 * A jump depends on (seed, set, channels, particle, step, number of the jump) alone, not on order or threads.
 * Cost: the rates and one pair of random numbers per particle and jump, and once more per particle. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "expression/jump-process.h"
#include "push/random-walk.h"
#include "stream/declare.h"
#include "world/world.h"

enum { jump_bits = 24 }; /* of the counter of random numbers: jumps of a particle in a step; the other 40 are the step */
enum { jumps_looked_at = 1 << 12 }; /* by then a rate that runs away is known by its pace */

/* The length of the rate: up to the first colon that is not the second half of a ?: . */
static size_t rate_length(const char *text)
{
	size_t n = 0;
	for (int open = 0; text[n] && (text[n] != ':' || open); n++)
		open += text[n] == '?' ? 1 : text[n] == ':' ? -1 : 0;
	return n;
}

static char *copied(const char *text, size_t length)
{
	char *copy = malloc(length + 1);
	if (!copy) {
		pm_no_memory();
		return NULL;
	}
	memcpy(copy, text, length);
	copy[length] = 0;
	return copy;
}

/* The next "NAME = EXPRESSION" of the text, copied; *text goes behind it. */
static char *next_effect(const char **text)
{
	const size_t n = strcspn(*text, ";");
	char *copy = copied(*text, n);
	*text += n + ((*text)[n] == ';');
	return copy;
}

int pm_jump_check(const char *text)
{
	const size_t n = rate_length(text);
	const char *rest = text + n + 1, *expression;
	char name[PM_NAME];
	int status = 0, effects = 0;
	if (!text[n])
		return pm_fail(PM_USAGE, "'%s' is not RATE: NAME = EXPRESSION (jump '0.1*a: a = a - 1; b = b + 1')", text);
	do {
		char *one = next_effect(&rest);
		status = one ? pm_expression_named(one, name, &expression) : -PM_DATA;
		free(one);
	} while (!status && *rest && ++effects < PM_JUMP_EFFECTS);
	return status || !*rest ? status : pm_fail(PM_USAGE, "'%s' changes more than %d fields", text, PM_JUMP_EFFECTS);
}

static bool is_state(const struct pm_field *p) { return p && p->role == PM_STATE; }

/* Does the set have every state that the channel changes? Writes the first that it lacks. */
static bool has_states(const struct pm_frame *f, const char *set, const char *text, char name[PM_NAME])
{
	bool has = true;
	for (const char *rest = text + rate_length(text) + 1, *expression; *rest && has;) {
		char *one = next_effect(&rest);
		has = one && !pm_expression_named(one, name, &expression) && is_state(pm_frame_field(f, set, name));
		free(one);
	}
	return has;
}

static int declare_effect(struct pm_jump_process *p, struct pm_frame *f, const char *set, const char *text)
{
	char name[PM_NAME];
	const char *expression = NULL;
	struct pm_expression_job *job = pm_expression_jobs_next(&p->effects);
	int status = job ? pm_expression_named(text, name, &expression) : -PM_DATA;
	if (!status)
		status = pm_expression_compile(&job->e, f, set, expression);
	if (status)
		return status;
	const struct pm_field *old = pm_frame_field(f, set, name);
	if (old->components != job->e.nparts)
		return pm_fail(PM_DATA, "'%s' on '%s' has %d components, here are %d (one expression each, commas between)", name, set, old->components,
			job->e.nparts);
	if (old->type == PM_U8)
		return pm_fail(PM_DATA, "'%s' holds bytes, which jump does not change", name);
	if (!strcmp(name, "id"))
		return pm_fail(PM_DATA, "the random numbers depend on 'id', which cannot jump");
	if (!(job->field = pm_changes(f, set, name)))
		return -PM_DATA;
	p->effects.n++;
	return 0;
}

static int declare_channel(struct pm_jump_process *p, struct pm_frame *f, const char *set, const char *text, struct pm_jump_channel *c)
{
	const size_t n = rate_length(text);
	char *rate = copied(text, n);
	struct pm_expression_job *job = rate ? pm_expression_jobs_next(&p->rates) : NULL;
	int status = job ? pm_expression_compile(&job->e, f, set, rate) : -PM_DATA;
	if (!status && job->e.nparts > 1)
		status = pm_fail(PM_USAGE, "the rate '%s' has %d parts, but a channel has one rate", rate, job->e.nparts);
	free(rate);
	*c = (struct pm_jump_channel){.rate = p->rates.n, .effect = p->effects.n};
	p->rates.n += !status;
	for (const char *rest = text + n + 1; *rest && !status; c->effects++) {
		char *one = next_effect(&rest);
		status = one ? declare_effect(p, f, set, one) : -PM_DATA;
		free(one);
	}
	return status;
}

static int declare_set(struct pm_jump_process *p, struct pm_frame *f, struct pm_set *set, uint64_t seed, int channels, const char *const *text)
{
	const struct pm_field *id = pm_frame_field(f, set->name, "id");
	int status = 0;
	if (id && id->type != PM_I64)
		return pm_fail(PM_DATA, "'id' on '%s' is not i64, but the random numbers depend on it (smod --rename id=NAME)", set->name);
	if (id && !pm_reads(f, set->name, "id"))
		return -PM_DATA;
	struct pm_jump_channel *more = realloc(p->channel, (p->nsets + 1) * (size_t)channels * sizeof *more);
	p->channel = more ? more : p->channel;
	struct pm_jump_set *sets = realloc(p->sets, (p->nsets + 1) * sizeof *sets);
	p->sets = sets ? sets : p->sets;
	if (!more || !sets)
		return pm_no_memory(), -PM_DATA;
	p->sets[p->nsets] = (struct pm_jump_set){set, pm_walk_key(pm_walk_key(seed, "jump"), set->name)};
	for (int c = 0; c < channels && !status; c++) {
		p->sets[p->nsets].key = pm_walk_key(p->sets[p->nsets].key, text[c]); /* so that two words of a sentence draw their own numbers */
		status = declare_channel(p, f, set->name, text[c], p->channel + p->nsets * (size_t)channels + c);
	}
	p->nsets++;
	return status;
}

int pm_jump_declare(struct pm_jump_process *p, struct pm_frame *f, const char *set, uint64_t seed, int channels, const char *const *text)
{
	char lacks[PM_NAME] = "";
	int status = 0;
	p->rates.n = p->effects.n = p->nsets = 0;
	p->channels = channels;
	if (!(f->dt > 0))
		return pm_fail(PM_DATA, "the time step is %g, but jumps take time (smod --dt, or the word dt)", f->dt);
	for (size_t i = 0; i < f->nsets && !status; i++) {
		bool takes = !set || !strcmp(set, f->sets[i]->name);
		for (int c = 0; c < channels && takes; c++)
			takes = has_states(f, f->sets[i]->name, text[c], lacks);
		if (takes)
			status = declare_set(p, f, f->sets[i], seed, channels, text);
	}
	if (!status && !p->nsets)
		return set && !pm_frame_set(f, set) ? pm_fail(PM_DATA, "no set '%s' (sls lists the sets)", set)
			: pm_fail(PM_DATA, "no set %s%shas the state '%s' (scalc --role state '%s = 0' makes one)", set ? set : "", set ? " " : "", lacks,
				lacks);
	for (size_t i = 0; i < f->nsets && !status; i++)
		pm_drops_roles(f, f->sets[i]->name, 1u << PM_CHANGE | 1u << PM_DERIVED);
	pm_drops_roles(f, NULL, 1u << PM_CHANGE | 1u << PM_DERIVED);
	return status;
}

struct jumping { /* the particles of a set that may still jump in this step */
	size_t n, *index;
	int *channel;                /* of the jump of each; -1: none any more */
	double *left, *rate, *value; /* [time] of each; rates, channel by channel; what effects give, part by part */
	size_t *jumped;              /* those of one channel */
};

/* A whole number is the floor, as in scalc. */
static bool store(struct pm_field *field, int k, size_t n, const size_t *index, const double *value)
{
	for (size_t i = 0; i < n; i++) {
		const double v = field->type == PM_I64 ? floor(value[i]) : value[i];
		if (!isfinite(v) || (field->type == PM_I64 && !(v >= -0x1p63 && v < 0x1p63)))
			return pm_fail(PM_NUMERICS, "'%s' would jump to %g at index %zu", field->name, v, (size_t)field->first + index[i]), false;
		if (field->type == PM_I64)
			pm_out_i64(field, k)[index[i]] = (int64_t)v;
		else
			pm_out(field, k)[index[i]] = v;
	}
	return true;
}

/* All effects of the channel are computed from the state before the jump. */
static int apply(const struct pm_jump_process *p, const struct pm_jump_channel *c, struct pm_frame *f, size_t n, struct jumping *j)
{
	double *value = j->value;
	bool good = true;
	for (size_t e = c->effect; e < c->effect + (size_t)c->effects; e++)
		for (int k = 0; k < p->effects.job[e].e.nparts; k++, value += n)
			pm_expression_eval_at(&p->effects.job[e].e, f, k, n, j->jumped, value);
	value = j->value;
	for (size_t e = c->effect; e < c->effect + (size_t)c->effects; e++)
		for (int k = 0; k < p->effects.job[e].e.nparts && good; k++, value += n)
			good = store(p->effects.job[e].field, k, n, j->jumped, value);
	return good ? 0 : -PM_NUMERICS;
}

/* When does each jump next, and by which channel? Returns the first particle whose rate is none, or n. */
static size_t draw(const struct pm_jump_process *p, uint64_t key, uint64_t counter, const int64_t *id, uint64_t first, struct jumping *j)
{
	const size_t n = j->n;
	size_t wrong = n;
#pragma omp parallel for schedule(static) reduction(min : wrong) if (n > 4096)
	for (size_t i = 0; i < n; i++) {
		double u[2], sum = 0, below = 0;
		for (int c = 0; c < p->channels; c++) {
			const double a = j->rate[(size_t)c * n + i];
			if (!(a >= 0 && isfinite(a)) && i < wrong)
				wrong = i;
			sum += a;
		}
		j->channel[i] = -1;
		if (!(sum > 0))
			continue;
		pm_random(key, id ? (uint64_t)id[j->index[i]] : first + j->index[i], counter, u);
		j->left[i] += log(u[0]) / sum;
		if (!(j->left[i] > 0))
			continue;
		for (int c = 0; c < p->channels; c++) { /* the last with a rate above 0 where rounding leaves none */
			const double a = j->rate[(size_t)c * n + i];
			if (a > 0 && (j->channel[i] < 0 || u[1] * sum >= below))
				j->channel[i] = c;
			below += a;
		}
	}
	return wrong;
}

static int wrong_rate(const struct pm_jump_process *p, const struct jumping *j, size_t i, uint64_t first)
{
	for (int c = 0; c < p->channels; c++) {
		const double a = j->rate[(size_t)c * j->n + i];
		if (!(a >= 0 && isfinite(a)))
			return pm_fail(PM_NUMERICS, "the rate of channel %d is %g at index %zu, but rates are finite and not negative (max(0, ...))", c + 1,
				isnan(a) ? (double)NAN : a, (size_t)first + j->index[i]);
	}
	return -PM_NUMERICS;
}

/* One jump of every particle that has one before the step ends; those that have none leave the list. */
static int round_of(const struct pm_jump_process *p, size_t s, struct pm_frame *f, uint64_t counter, const int64_t *id, uint64_t first, struct jumping *j,
	uint64_t *jumps)
{
	const struct pm_jump_channel *channel = p->channel + s * (size_t)p->channels;
	int status = 0;
	for (int c = 0; c < p->channels; c++)
		pm_expression_eval_at(&p->rates.job[channel[c].rate].e, f, 0, j->n, j->index, j->rate + (size_t)c * j->n);
	const size_t wrong = draw(p, p->sets[s].key, counter, id, first, j);
	if (wrong < j->n)
		return wrong_rate(p, j, wrong, first);
	for (int c = 0; c < p->channels && !status; c++) {
		size_t n = 0;
		for (size_t i = 0; i < j->n; i++)
			if (j->channel[i] == c)
				j->jumped[n++] = j->index[i];
		*jumps += n;
		status = n ? apply(p, channel + c, f, n, j) : 0;
	}
	size_t stay = 0;
	for (size_t i = 0; i < j->n; i++)
		if (j->channel[i] >= 0) {
			j->index[stay] = j->index[i];
			j->left[stay++] = j->left[i];
		}
	j->n = stay;
	return status;
}

/* Does a particle, at its pace so far, need more jumps than the counter holds? */
static bool runs_away(const struct jumping *j, double dt, double jumps)
{
	bool away = false;
	for (size_t i = 0; i < j->n; i++)
		away = away || dt - j->left[i] < dt * jumps / (1 << jump_bits);
	return away;
}

static int jump_set(const struct pm_jump_process *p, size_t s, struct pm_frame *f, uint64_t *jumps)
{
	const struct pm_jump_channel *channel = p->channel + s * (size_t)p->channels;
	const struct pm_field *some = p->effects.job[channel->effect].field, *id = pm_frame_field(f, p->sets[s].set->name, "id"),
		*x = pm_frame_field(f, p->sets[s].set->name, "x");
	const size_t n = some->count, room = n ? n : 1;
	int parts = 1, status = 0;
	for (size_t e = channel->effect; e < p->effects.n; e++)
		parts += p->effects.job[e].e.nparts;
	struct jumping j = {.n = n, .index = pm_alloc(room, sizeof *j.index), .channel = pm_alloc(room, sizeof *j.channel),
		.left = pm_alloc(room, sizeof *j.left), .rate = pm_alloc(room * (size_t)p->channels, sizeof *j.rate),
		.value = pm_alloc(room * (size_t)parts, sizeof *j.value), .jumped = pm_alloc(room, sizeof *j.jumped)};
	if (!j.index || !j.channel || !j.left || !j.rate || !j.value || !j.jumped)
		status = -PM_DATA;
	for (size_t i = 0; i < n && !status; i++) {
		j.index[i] = i;
		j.left[i] = f->dt;
	}
	for (uint64_t k = 0; j.n && !status; k++)
		status = k >> jump_bits || (k == jumps_looked_at && runs_away(&j, f->dt, (double)k)) ? pm_fail(PM_NUMERICS,
			"a particle jumps more than %d times in a step (a shorter dt, or a rate that does not run away)", 1 << jump_bits)
			: round_of(p, s, f, (uint64_t)f->step << jump_bits | k, id ? pm_in_i64(id, 0) : NULL, some->first, &j, jumps);
	if (!status && x && x->use & PM_USE_CHANGE) {
		double *at[3] = {NULL};
		for (int d = 0; d < f->dim; d++)
			at[d] = pm_out(pm_frame_field(f, p->sets[s].set->name, "x"), d);
		pm_walk_faces(f, n, at);
	}
	pm_free(j.index), pm_free(j.channel), pm_free(j.left), pm_free(j.rate), pm_free(j.value), pm_free(j.jumped);
	return status;
}

int pm_jump_step(const struct pm_jump_process *p, struct pm_frame *f, uint64_t *jumps)
{
	int status = 0;
	*jumps = 0;
	for (size_t s = 0; s < p->nsets && !status; s++)
		status = jump_set(p, s, f, jumps);
	int64_t all = (int64_t)*jumps;
	status = pm_world_count(status, PM_SUM_OF, 1, &all);
	*jumps = (uint64_t)all;
	return status;
}

void pm_jump_free(struct pm_jump_process *p)
{
	pm_expression_jobs_free(&p->rates);
	pm_expression_jobs_free(&p->effects);
	free(p->channel);
	free(p->sets);
	*p = (struct pm_jump_process){0};
}
