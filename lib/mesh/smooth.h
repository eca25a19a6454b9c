/* The binomial filter of values on a mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_SMOOTH_H
#define PM_MESH_SMOOTH_H

#include "mesh/planes.h"

/* n passes of (1, 2, 1)/4 along every axis and, if compensated, one of (-n/4, 1 + n/2, -n/4): a wave of wave number k along an axis keeps
 * cos^2n(k h/2) (1 + n sin^2(k h/2)) of itself, 1 + O(k^4). Values are continued evenly beyond faces, so sums with the weights of quadrature stay.
 * values, work: those of the planes here. Takes the caller's status and returns the agreed one. Source: Birdsall and Langdon 1985, appendix C. */
int pm_smooth(int status, const struct pm_grid *g, const struct pm_planes *p, int n, bool compensated, double *values, double *work);

#endif
