/* Values that are made when someone asks for them (pm_in, the writer), for a word that runs in one process with the next one: a field that this one needs in
 * pieces, or that no word needs before it is replaced, is never in memory as a whole. The values are those that would have been made at once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_LATER_H
#define PM_STREAM_LATER_H

#include "stream/frame.h"

struct pm_later;
struct pm_reorder;

/* Of velocities that kicks have left to be made from those before: for a pass over the particles that makes the rates of a few of them itself. */
struct pm_kicks {
	struct pm_field *acc, *bfield; /* may be left to be made too */
	/* [m] each; NULL: no such component. */
	void (*few)(const struct pm_later *later, size_t m, double *const v[3], const double *const acc[3], const double *const b[3]);
};

/* The first member of what is known of them, a block of malloc. Not where there are ranks. */
struct pm_later {
	int (*make)(const struct pm_later *later, double *to); /* all values, component by component, all finite; 0 or failure. Also says what kind it is */
	void (*free)(struct pm_later *later); /* what it holds beside `from`; NULL: nothing */
	double (*oscillation)(const struct pm_later *later, const double *values); /* [1/time] a limit (limits.h) that only the values tell; NULL: none */
	/* [1/time] The limit is not above it; need not be near it where it is not above enough. 0: not known; NULL: no limit is. */
	double (*most)(const struct pm_later *later, double enough);
	const struct pm_kicks *kicks; /* NULL: no velocities */
	/* The same of particles in another order (reorder.h), but for `from`, which it leaves NULL; NULL: failure. If it is NULL, the values are made. */
	struct pm_later *(*reorder)(const struct pm_later *later, struct pm_reorder *r);
	struct pm_field *from; /* f64: its values stay as they are now; set by pm_field_later */
};

/* In frame(), for an f64 field that the stage makes, or changes: takes `later` over, also when it fails. from may be the field itself. 0 or failure. */
int pm_field_later(struct pm_field *field, struct pm_later *later, const struct pm_field *from);
/* NULL: the values are there. A stage asks that can do without them, and has said so (PM_USE_LATER). */
const struct pm_later *pm_field_later_of(const struct pm_field *field);
/* In frame(): the same, to be added to; NULL also where other frames have it. */
struct pm_later *pm_field_later_alone(struct pm_field *field);
/* In frame(), of what pm_field_later_alone found: the field has the values of `from` again, to be changed in their place to those that were to be made. The
 * caller frees what it gets; NULL: failure. */
struct pm_later *pm_field_later_take(struct pm_field *field);
struct pm_later *pm_later_free(struct pm_later *later); /* returns NULL */
/* In frame(), of a field with PM_USE_LATER or PM_USE_WAITS: as if that had not been said. 0 or failure. */
int pm_field_now(struct pm_field *field);
/* Of a field with PM_USE_WAITS: nobody but `holders` (pm_field_held) has its values, so that they may be changed where they are, by a pass that still reads
 * what the holders know of them; and then that they are changed. */
bool pm_field_in_place(const struct pm_field *field, int holders);
void pm_field_changed(struct pm_field *field);
/* For make(): a copy that holds the values, left to be made as they may be; and then to have them. 0 or failure. */
struct pm_field *pm_field_held(const struct pm_field *field); /* give back by pm_held_free */
void pm_held_free(struct pm_field *held); /* or NULL */
int pm_held_bring(const struct pm_field *field);

#endif
