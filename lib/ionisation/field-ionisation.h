/* Ionisation of atoms and ions by the electric field of the mesh: what the word ionise does (docs/methods/ionise.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_IONISATION_FIELD_IONISATION_H
#define PM_IONISATION_FIELD_IONISATION_H

#include "ionisation/tunnel-rate.h"
#include "stream/frame.h"

struct pm_field_ionisation {
	const char *set, *electrons;     /* of atoms and ions; that grows */
	const char *kernel, *mesh;       /* NULL: as the field was made, the first mesh that has the field */
	const struct pm_element *element;
	double mass;                     /* of one neutral atom */
	double charge, electron_mass;    /* of one electron */
	double time_unit, length_unit;   /* [s], [m] of those of the frame; length NAN: from the constant c */
	bool suppressed;                 /* beyond the critical field the rate of a suppressed barrier */
	uint64_t seed;
};

struct pm_field_ionised {
	uint64_t electrons;  /* particles that were made */
	double energy;       /* of ionisation, which something must have given */
	double strongest;    /* [V/m] field that an ion was in */
	double critical;     /* the largest field over the critical one of the electron that came next */
	uint64_t outside;    /* atoms beyond the mesh, where there is no field */
};

/* Header: one of pm_field_ionise_act, or failure. It acts between steps, or within one behind the drift, where the mesh has its field. */
enum pm_field_ionise_act { PM_FIELD_IONISE_WAITS, PM_FIELD_IONISE_ACTS };
int pm_field_ionise_declare(const struct pm_field_ionisation *g, struct pm_frame *f);
/* Data: 0 or failure. */
int pm_field_ionise_step(const struct pm_field_ionisation *g, struct pm_frame *f, struct pm_field_ionised *r);

#endif
