/* Groups, datasets and attributes in the few forms that openPMD uses. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_H5_NODE_H
#define PM_H5_NODE_H

#if !__has_include(<hdf5.h>)
#error "HDF5 was not found: install libhdf5-dev, or give its place: make CFLAGS=-I..."
#endif
#include <hdf5.h>

#include "h5/h5.h"

enum { PM_H5_PATH = 256 };

struct pm_h5 {
	hid_t file;
	char *path, *part;       /* part: NULL when reading, or when finished */
	const char *word;        /* reading: as typed, the key of its report */
	uint64_t last;           /* name of the last iteration written */
	uint64_t frames;         /* writing: of the current stream; reading: all so far */
	size_t nstreams, stream; /* writing: end markers; reading: the next one */
	uint64_t *streams;       /* frames of each stream */
	size_t niterations, at;  /* reading: names of the iterations, ascending */
	uint64_t *iterations;
	bool own;                /* reading: a frame that was a stream has been read */
	bool gadget;             /* reading: a snapshot in GADGET's layout, one frame */
	uint32_t crc;            /* of the headers and reports so far: that of the file with the frames of the streams behind them */
};

/* pm_fail with the innermost error of the HDF5 library appended to the message. */
int pm_h5_fail(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Each returns 0 or failure. n = 0: a scalar, else an array of n. */
int pm_h5_put_reals(hid_t at, const char *name, int n, const double *x);
int pm_h5_put_counts(hid_t at, const char *name, int n, const uint64_t *x);
int pm_h5_put_flag(hid_t at, const char *name, unsigned x);          /* uint32 */
int pm_h5_put_text(hid_t at, const char *name, const char *text);    /* of fixed length */
int pm_h5_put_long_text(hid_t at, const char *name, const char *text); /* of any length */
int pm_h5_put_letters(hid_t at, const char *name, int n, const char *letters); /* n texts of one letter */
hid_t pm_h5_group(hid_t at, const char *name);                       /* made; negative with a message */

bool pm_h5_has(hid_t at, const char *name);       /* an attribute */
/* n on entry: room, on return: how many there are. Fails if not numbers or too many. */
int pm_h5_get_reals(hid_t at, const char *name, int *n, double *x);
char *pm_h5_get_text(hid_t at, const char *name); /* free() it; NULL with a message */
int pm_h5_get_letters(hid_t at, const char *name, int most, char *letters); /* first letters of an array of texts; how many, or failure */
double pm_h5_number(hid_t at, const char *name, double otherwise);
struct pm_h5_names {
	int n;
	char name[256][PM_NAME];
};
int pm_h5_children(hid_t at, const char *path, struct pm_h5_names *all); /* the members of a group, sorted by name */
hid_t pm_h5_type(enum pm_type type);                                        /* in the file; the same in memory but for f32 */

/* A checksum as an attribute, name NULL: pmpipeCrc32c. check: 0 if it agrees or is not there; what: for the message. */
int pm_h5_put_checksum(hid_t at, const char *name, uint32_t crc);
int pm_h5_check(hid_t at, const char *name, uint32_t crc, const char *what);
/* The values of a component: the next of the stream, or with r NULL those that the field holds. Made; negative with a message. */
hid_t pm_h5_put_data(hid_t at, const char *name, struct pm_field *p, int c, int rank, const hsize_t *dims, struct pm_reader *r);
int pm_h5_get_data(hid_t d, const char *path, struct pm_field *p, int c, uint32_t *crc); /* the field has its room; f32 is widened */
int pm_h5_send_data(hid_t d, const char *path, const struct pm_field *p, struct pm_writer *w, uint32_t *crc); /* the same onto a stream, piece by piece */

/* The paths of the fields of a frame: "particles/matter/position", "meshes/rho". room for f->nfields. */
void pm_h5_paths(const struct pm_frame *f, char (*path)[PM_H5_PATH]);
bool pm_h5_is_vector(const struct pm_field *p);
void pm_h5_component(const struct pm_field *p, int c, char name[8]); /* x, y, z, or c0, c1, ... */

/* An iteration without our header, written by another program. */
int pm_h5_get_foreign(hid_t iteration, const char *name, struct pm_frame **f);

#endif
