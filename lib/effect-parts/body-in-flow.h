/* The solid body of a frame and the stream past it, as effects of walls take them. A body: the mesh state `body`, a level below 0 inside, or that of the scene.
 * A stream: the constants stream_x, stream_y, stream_z, or that of the scene. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BODY_IN_FLOW_H
#define PM_BODY_IN_FLOW_H

#include "law/law.h"
#include "scene/scene.h"

/* Is there a body? Its level "" if not; the stream is there without one too. */
bool pm_effect_body(const struct pm_frame *f, struct pm_scene_solid *b);
/* |U|, and "1, 0": one number an axis. */
double pm_effect_stream(const struct pm_frame *f, const struct pm_scene_solid *b, char text[96]);
/* penalize with its options; a sentence that makes its layer, from particles without vorticity. */
void pm_effect_penalize(const struct pm_frame *f, char words[320]);
void pm_effect_layer(const struct pm_frame *f, char sentence[512]);
/* [length] of a disc or ball as large as the body on the frame's mesh, or as the fluid if that is smaller; NAN: not known. */
double pm_effect_body_size(const struct pm_frame *f, const struct pm_scene_solid *b);

/* [length] of its boundary layer, sqrt(nu D/U), U the speed past it or `self` if that is more; NAN: no body, or no viscosity. */
double pm_effect_layer_thickness(const struct pm_frame *f, double nu, double self);

#endif
