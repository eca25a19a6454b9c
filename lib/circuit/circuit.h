/* An external circuit between the electrodes of a plasma in 1-D: a voltage, R, L and C in series. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CIRCUIT_H
#define PM_CIRCUIT_H

#include "stream/frame.h"

struct pm_circuit {
	int side;                     /* the electrode it drives, 0 x-low, 1 x-high; the other one is at ground */
	double resistance, inductance, capacitance; /* of an electrode of area 1; capacitance HUGE_VAL: none, a wire */
	const char *voltage, *current; /* expressions in time and the frame's constants; current NULL: what the circuit lets pass */
};

struct pm_circuit_state { /* at the end of the step */
	double potential, current, charge; /* of the electrode; current into it; charge that has passed the circuit */
};

/* Header: the particles that it reads. 1: it acts in this frame, 0: it has acted in this step, or the frame is between steps; or failure. */
int pm_circuit_declare(const struct pm_circuit *c, struct pm_frame *f);
/* Data: changes the constants charge_x_low (or high), circuit_charge, circuit_current, and those before. 0 or failure. */
int pm_circuit_step(const struct pm_circuit *c, struct pm_frame *f, struct pm_circuit_state *s);

#endif
