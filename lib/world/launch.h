/* Was this process started by a launcher of MPI? Then it is a rank of its world. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LAUNCH_H
#define PM_LAUNCH_H

#include <stdbool.h>

bool pm_launched(void);      /* a launcher of more than one rank (docs/distributed.md says how this is known) */
int pm_launched_rank(void);  /* as the launcher says, before MPI is opened; 0 where it does not */
/* Opens pmpipe-mpi.so in `directory` and makes it the world; what this process starts from now on runs alone. 0 or failure. */
int pm_launch(const char *directory);

#endif
