/* A step needs again what is state, change or register; density and potential are kept for diag and pictures. What mgrad made of a potential is three
 * quarters of a mesh in three dimensions, follows from the potential, and is made anew by the next step: it is left out, unless a word of the sentence uses
 * it before that, or --field names it. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cycle/output.h"
#include "mesh/gradient-frame.h"
#include "cycle/dense-output.h"
#include "stream/edit.h"
#include "stream/run.h"

int pm_output_init(struct pm_output *o, const struct pm_output_choice *c)
{
	*o = (struct pm_output){.kept = pm_selection_of(&c->kept)};
	for (int i = 0; i < c->store.n; i++) {
		o->all |= !strcmp(c->store.item[i], "all");
		o->single |= !strcmp(c->store.item[i], "f32");
	}
	return 0;
}

static bool chooses(const struct pm_output *o) { return o->kept.sets.n || o->kept.meshes.n || o->kept.fields.n || o->kept.drop.n; }

int pm_output_begin(struct pm_output *o, const struct pm_frame *f)
{
	pm_output_free(o);
	if (chooses(o) && !(o->before = pm_frame_header(f)))
		return pm_failed();
	return 0;
}

int pm_output_check(struct pm_output *o, const struct pm_frame *f)
{
	const struct pm_frame *const both[] = {o->before, f};
	const int status = o->before ? pm_selection_check(&o->kept, both, 2) : 0;
	pm_output_free(o);
	return status;
}

static void leave_out(struct pm_frame *f, struct pm_sentence *words)
{
	for (size_t i = f->nfields; i-- > 0;)
		if (pm_gradient_repeats(f, f->fields[i]) && !pm_sentence_uses(words, f, f->fields[i]))
			pm_gradient_leave_out(f, f->fields[i]);
}

struct pm_frame *pm_output_of(const struct pm_output *o, struct pm_sentence *words, const struct pm_frame *f)
{
	struct pm_frame *copy = pm_frame_copy(f);
	if (!copy)
		return NULL;
	if (!o->all && !o->kept.fields.n)
		leave_out(copy, words);
	if (!o->all && pm_dense_has(copy))
		pm_dense_leave_out(copy);
	pm_selection_leave_out(&o->kept, copy);
	int status = o->single ? pm_frame_store(copy, "f32") : 0;
	status = status || !o->single ? status : pm_frame_ready(copy);
	const int settled = pm_frame_settle(copy);
	return status || settled ? pm_frame_free(copy) : copy;
}

void pm_output_free(struct pm_output *o) { o->before = pm_frame_free(o->before); }
