/* The advice where a field is missing: the words that make it, from what the frame has already. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_FORCE_WORDS_H
#define PM_MESH_FORCE_WORDS_H

#include "law/law.h"

enum { PM_FORCE_WORDS = 96 };

/* The words that make `name`, a mesh field of the law or the change that its particles need, joined by bars: "p2m | poisson-fft | mgrad | m2p" or its
 * end, from what the mesh holds (mesh NULL: any). In open space a change has ", or pp" behind it. "": no words of the law make it. */
const char *pm_force_words(const struct pm_frame *f, const struct pm_law *law, const char *mesh, const char *name, char text[PM_FORCE_WORDS]);

#endif
