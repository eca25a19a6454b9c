/* Alone ids are matched by a list of indices; over ranks the fields of b are brought to where a has the same id, one field at a time (match-ranks.h).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/field-pairs.h"
#include "measure/joint-norms.h"
#include "measure/match-ranks.h"
#include "stream/joint-frame.h"
#include "world/world.h"

void pm_joint_declare(struct pm_frame *joint)
{
	for (size_t i = 0; i < joint->nfields; i++)
		joint->fields[i]->use |= PM_USE_READ;
}

/* Alone. *match: pm_free. */
static int match_alone(const struct pm_field *a, const struct pm_field *b, size_t **match)
{
	size_t *work = pm_alloc(a->count + 1, sizeof *work);
	*match = pm_alloc(a->count + 1, sizeof **match);
	const int status = *match && work ? pm_norms_match(a->count, pm_in_i64(a, 0), pm_in_i64(b, 0), *match, work) : -PM_DATA;
	pm_free(work);
	return status;
}

int pm_joint_norms(struct pm_frame *joint, struct pm_norms *norms)
{
	const int n = (int)pm_frame_parameter(joint, PM_JOINT_PAIRS, 0);
	const bool ids = pm_frame_parameter(joint, PM_JOINT_IDS, 0) > 0;
	if (!n)
		return 0;
	struct pm_field **of = joint->fields, *const id = ids ? of[2 * n] : NULL;
	const bool here = of[0]->here, matched = id && (here || id->count);
	struct pm_match_ranks ranks = {.same = true};
	size_t *match = NULL;
	double *weight = NULL;
	int status = pm_frame_set(joint, of[0]->on) || (weight = pm_field_pairs_weights(joint, of[0])) ? 0 : -PM_DATA;
	if (matched && here)
		status = pm_match_ranks_init(status, id, of[2 * n + 1], &ranks);
	else if (matched && !status)
		status = match_alone(id, of[2 * n + 1], &match);
	for (int i = 0; i < n; i++) {
		struct pm_field *brought = NULL, *a = of[2 * i], *b = of[2 * i + 1];
		status = here ? pm_match_ranks_bring(status, &ranks, b, &brought) : status;
		status = here ? pm_world_agree(status) : status;
		if (!status)
			norms[i] = pm_norms_with_ids(joint, a, brought ? brought : b, match, weight, matched ? pm_in_i64(id, 0) : NULL);
		pm_field_copy_free(brought);
	}
	pm_match_ranks_free(&ranks);
	pm_free(match), pm_free(weight);
	return status;
}
