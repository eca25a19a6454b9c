/* Effects: what physics a frame may call for. Each decides from numbers of the frame, measured once (lib/planner/scales.c), whether leaving it out
 * would change the result by more than the accuracy asked for. One file per effect. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EFFECT_H
#define PM_EFFECT_H

#include <stdio.h>

#include "base/base.h"

/* One frame in numbers. NAN: not there, or not known. */
struct pm_scales {
	int dim;
	const char *law;             /* its name */
	enum { PM_NO_FIELD, PM_CARRIED, PM_MASSES, PM_CHARGES, PM_VORTICES } kind; /* free, passive, gravity, plasmas, vortices */
	bool second;                 /* moved by an acceleration: the particles have v */
	bool pairs;                  /* the far field is summed pair by pair, not on a mesh */
	bool periodic, open, walls;  /* a face of the fields is; walls: of any other kind */
	double n, sources;           /* particles that move; those with a strength, fixed ones too */
	double dt, time;             /* [time] the step, and how long the run is to last */
	double h, box;               /* [length] largest spacing of the mesh, shortest side of the box */
	double points, edge;         /* of the mesh; [length] of the particle nearest to an open face from it, HUGE_VAL: there is none */
	double softening, nu, c;     /* [length], [length^2/time], [length/time] constants of the frame; c NAN: infinite */
	double spread, nearest, spacing; /* [length] rms distance from the centre; of the nearest pair; of neighbours on the average */
	double v_max, v_rms, v_thermal; /* [length/time] speeds, and the rms about the mean */
	double omega;                /* [1/time] of the particles together: omega_p, sqrt(4 pi G rho), largest vorticity */
	double encounter;            /* [1/time] of the nearest pair, softened: the fastest thing there can be between two */
	double orbit, eccentricity;  /* [1/time] mean motion of the orbit with the fastest pericentre, where there are few bodies; NAN: none */
	double debye, per_debye;     /* [length] v_thermal/omega; particles in a sphere of that radius, in a stretch of that length in 1-D */
	double overlap, width;       /* mean |H - 1| of the particles: 0 a lattice, they carry a field; NAN: no volumes. [length] mean volume^(1/dim) */
	double ratio;                /* largest q/m */
	double given, cyclotron;     /* [length/time^2] largest (q/m) E given on a mesh; [1/time] largest (q/m) B */
	double self, self_max;       /* rms and largest of what the self field adds to acc [length/time^2] or vel [length/time] */
	double strain, rough;        /* [1/time] largest |grad u|; [1/length^2] |lap density|/|density| in l2 */
	double length;               /* [length] of the field: |field|/|its sources| in l2 */
	double mesh_error;           /* of the force on the mesh, by the atlas; NAN: not known */
	double distortion[4];        /* after 1, 2, 4, 8 steps without remeshing */
	double accuracy;             /* what is asked for: relative changes below are negligible */
};

enum pm_answer { PM_LEFT_OUT, PM_PUT_IN };

struct pm_decision {
	enum pm_answer answer;
	bool kept;       /* put in though it may be small: it costs nothing, or nothing would move without it */
	double number;   /* the one that decided; NAN: none was needed */
	double share;    /* what leaving it out changes, relative, within the time of the run; NAN: not known */
	int every;       /* of remeshing: steps */
	char text[160];  /* the reason, with the number */
};

struct pm_effect {
	const char *name, *sentence, *source;
	const char *word; /* the word that does it; NULL: the words of the far field do */
	void (*decide)(const struct pm_scales *s, struct pm_decision *d);
};

extern const struct pm_effect *const pm_effects[]; /* generated from lib/effect/, NULL ends */
extern const char *const pm_effect_names[];
const struct pm_effect *pm_effect_find(const char *name); /* NULL with a message */

/* Forces that cancel to rounding and stay so: a lattice that moves as one and meets no wall. */
static inline bool effect_cancels(const struct pm_scales *s)
{
	const double rest = s->self / (s->omega * s->omega * s->spacing);
	return s->second && !s->walls && s->v_thermal <= 1e-7 * s->v_rms && rest < 1e-9 && rest * cosh(fmin(s->omega * s->time, 700)) < s->accuracy;
}
/* Is there no force between particles? */
static inline bool effect_alone(const struct pm_scales *s)
{
	return s->kind == PM_NO_FIELD || s->kind == PM_CARRIED || s->sources < 1 || (s->sources < 2 && !s->walls) || effect_cancels(s);
}

/* For the entries: a decision that needs no number, and one that a share decides; shares are estimates, so it must be below half the accuracy. */
static inline void effect_off(struct pm_decision *d, const char *text)
{
	*d = (struct pm_decision){.answer = PM_LEFT_OUT, .number = NAN, .share = 0};
	snprintf(d->text, sizeof d->text, "%s", text);
}
static inline void effect_by(struct pm_decision *d, const struct pm_scales *s, double number, double share)
{
	*d = (struct pm_decision){.answer = share > 0.5 * s->accuracy ? PM_PUT_IN : PM_LEFT_OUT, .number = number, .share = share};
}

#endif
