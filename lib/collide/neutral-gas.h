/* Collisions of particles with a gas that stays as it is. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_COLLIDE_NEUTRAL_GAS_H
#define PM_COLLIDE_NEUTRAL_GAS_H

#include "collide/cross-section.h"
#include "expression/expression.h"
#include "load/density-profile.h"
#include "stream/frame.h"

enum { PM_GAS_PROCESSES = 8 };
enum pm_gas_kind { PM_GAS_ELASTIC, PM_GAS_EXCHANGE, PM_GAS_EXCITE, PM_GAS_IONISE };

struct pm_gas_process {
	enum pm_gas_kind kind;
	double threshold;      /* energy that is lost between the two, of PM_GAS_EXCITE and PM_GAS_IONISE */
	const char *section;   /* the cross-section [area], an expression in g, energy and the frame's constants, or @FILE */
	struct pm_cross_section table; /* of @FILE, made by the caller with pm_cross_section_read(pm_gas_file_of(section)) */
	struct pm_expression e;
	struct pm_density_names names;
};

struct pm_gas {
	const char *set, *ions; /* ions: the set that PM_GAS_IONISE adds to; NULL none */
	double mass, gas_mass, density, vth; /* of a real particle, of an atom; atoms per volume; standard deviation of a component of their velocity */
	double drift[3];
	uint64_t seed;
	int n;
	struct pm_gas_process process[PM_GAS_PROCESSES];
};

struct pm_gas_record {
	uint64_t collisions, pairs; /* of an electron and an ion that were made */
	double given_mass;          /* of these */
	double most; /* the largest probability of a collision in the step */
};

/* "elastic: EXPRESSION", "exchange: EXPRESSION", "excite ENERGY: EXPRESSION", "ionise ENERGY: EXPRESSION". 0 or failure. */
int pm_gas_process_of(const char *text, struct pm_gas_process *p);
/* The name behind @; NULL: the section is an expression. */
const char *pm_gas_file_of(const char *section);
/* Header: one of pm_gas_act, or failure. It acts between steps; with PM_GAS_IONISE also within one, where its set has drifted. Data: 0 or failure. */
enum pm_gas_act { PM_GAS_WAITS, PM_GAS_ACTS };
int pm_gas_declare(const struct pm_gas *g, struct pm_frame *f);
int pm_gas_step(struct pm_gas *g, struct pm_frame *f, struct pm_gas_record *r);

#endif
