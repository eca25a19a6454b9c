/* A set or mesh of a frame as one plain table: names, then a row a particle or mesh point. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_PLAIN_TABLE_H
#define PM_STREAM_PLAIN_TABLE_H

#include <stdio.h>

#include "stream/frame.h"

/* Header: every field of `on` is read; a mesh gets the coordinates of its points as a field x. 0 or failure. */
int pm_plain_table_declare(struct pm_frame *f, const char *on, bool mesh);
/* Data: uniform fields too, coordinates first; tabs between columns, or commas. 0 or failure. */
int pm_plain_table_write(FILE *out, bool csv, struct pm_frame *f, const char *on, bool mesh);

#endif
