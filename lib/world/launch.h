/* Was this process started by a launcher of MPI? Then it is a rank of its world. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LAUNCH_H
#define PM_LAUNCH_H

#include <stdbool.h>

bool pm_launched(void);      /* a launcher of more than one rank (docs/distributed.md says how this is known) */
int pm_launched_rank(void);  /* as the launcher says, before MPI is opened; 0 where it does not */
/* Opens pmpipe-mpi.so, made with the programs in `directory`, and makes it the world; what this process starts from now on runs alone. 0 or failure. */
int pm_launch(const char *directory);

/* Is standard output a terminal? A launcher gives its ranks one also where its own output is a file, so it is not asked there. */
bool pm_output_is_terminal(void);

#endif
