/* A frame: one instant of one simulation (docs/stream.md). Attributes, particle sets, meshes, and one flat list of fields in the order of the stream. Planar
 * everywhere: component c of a field is one contiguous array. This header is for methods and for the frame() functions of words; declare.h is for stages
 * that make and change fields, run.h for the layer that runs stages.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_FRAME_H
#define PM_STREAM_FRAME_H

#include <jansson.h>

#include "base/base.h"

PM_C_BEGIN

enum { PM_NAME = 64, PM_COMPONENTS = 16, PM_TERMS = 16 };

enum pm_type { PM_F64, PM_F32, PM_I64, PM_U8 };
enum pm_role { PM_STATE, PM_CHANGE, PM_DERIVED, PM_REGISTER };
enum pm_face { PM_PERIODIC, PM_OPEN, PM_WALL, PM_NEUMANN, PM_ABSORBING };          /* of the fields */
enum pm_particle_face { PM_PFOLD, PM_PREFLECT, PM_PABSORB, PM_POPEN };             /* of the particles: periodic, reflect, absorb, open */

enum { PM_RIM_MOST = 64 }; /* cells */
/* What m2p does with particles beyond the open faces of the mesh, of whose density the field was made (docs/methods/transfer.md). */
enum pm_outside { PM_OUTSIDE_MONOPOLE, PM_OUTSIDE_DROP, PM_OUTSIDE_ERROR };

extern const char *const pm_outside_names[]; /* NULL ends */
extern const char *const pm_type_names[], *const pm_role_names[], *const pm_face_names[], *const pm_particle_face_names[]; /* NULL ends */
size_t pm_type_size(enum pm_type type); /* bytes of a value in the stream */

/* What the running stage does with a field; set in declare(), cleared after frame(). */
enum { PM_USE_READ = 1, PM_USE_CHANGE = 2, PM_USE_NEW = 4, PM_USE_FILL = 8 /* new, and the stage writes every value: no zeros needed */,
	PM_USE_SEEN = 16 /* the stage has checked every value in its own loop, and all are finite */,
	PM_USE_ANY = 32 /* values are only copied, so they need not be finite */,
	PM_USE_FROM_VALUE = 64 /* changed, and was uniform */,
	PM_USE_COLUMNS = 128 /* the stage takes the values as columns (column.h): those held as floats stay so, uniform ones that are read are one number */,
	PM_USE_LATER = 256 /* read, and the stage can do with values that are to be made (later.h) */,
	PM_USE_WAITS = 512 /* changed, and the stage makes the field ready itself (pm_field_now), or changes it in its place (later.h) */,
	PM_USE_DONE = 1024 /* set in frame(), of f64: new, and the stage has written all values, so that what is computed of them may be kept (kept.h) */ };

struct pm_buffer; /* reference counted, 64-byte aligned, copied on write */

/* Real fields (f64, f32) are doubles for a stage; an f32 field is rounded to f32 when a stage has changed it, and where there are no ranks is held as floats
 * between two stages: pm_in and pm_out widen it, the end of the stage narrows it again. i64 is int64_t, u8 bytes. */
/* Something computed from a field's values and kept for the next stage in the same process; dropped when the values change. Never part of the stream:
 * results must not depend on it. */
struct pm_note {
	void (*free)(struct pm_note *note);
};

/* How fast a change field makes its state decay, oscillate and strain [1/time]; 0 unknown, or none (stream/limits.h). */
struct pm_limits {
	double decay;       /* the largest rate of exponential decay: the largest eigenvalue of the operator behind the change */
	double oscillation; /* the largest angular frequency */
	double strain;      /* of a flow: the largest |grad u|, so that particles cross within a step of 1/strain */
};

struct pm_field {
	char name[PM_NAME];
	char on[PM_NAME];     /* the set or mesh it belongs to */
	char unit[PM_NAME];   /* free text, "" unknown */
	char of[PM_NAME];     /* change fields: the state it is the rate of, "" none (bfield) */
	char kernel[PM_NAME]; /* mesh fields made by p2m, and fields derived from them: the kernel's name, "several" if these differ in it; else "" */
	bool interlaced;      /* made with that kernel on two meshes half a cell apart */
	enum pm_outside outside; /* mesh fields with a kernel; monopole unless p2m or a solver says otherwise */
	int rim;              /* [cells] of p2m --rim, for m2p: particles so near to the reach of open faces are outside */
	int components;       /* 1..PM_COMPONENTS */
	enum pm_type type;
	enum pm_role role;
	bool extensive;       /* a strength (true) or a value (false) */
	bool uniform;         /* all values of a component are equal: value[c], and no data in the stream */
	double value[PM_COMPONENTS];
	unsigned char staggered[PM_COMPONENTS][3]; /* meshes: 1 where the component sits half a cell up that axis */
	/* Change fields: the names of the contributions (self, near, external, ...). Densities and what is made of them: the sets that were deposited, if not
	 * all that have the strength. */
	char terms[PM_TERMS][PM_NAME];
	int nterms;
	struct pm_limits limits;              /* of change fields; travel in the tail */
	size_t count;         /* values per component: n of the set, points of the mesh; in a divided frame those of this rank */
	bool here;            /* in a divided frame: the values are this rank's stretch alone */
	uint64_t first;       /* then: the number of the first one in the whole stream; else 0 */
	const uint64_t *from; /* then: the first of every rank, one more than ranks; else NULL */
	int order;            /* then: among the fields in use, for the place of a failure */
	unsigned use;         /* PM_USE_... bits of the running stage */
	bool finite;          /* known to hold only finite values */
	bool summed;          /* crc is the checksum of the values as they are in the stream */
	uint32_t crc;
	double within;        /* no absolute value is larger; 0: not known */
	struct pm_note *note; /* NULL: none */
	struct pm_buffer *buffer; /* NULL: not loaded (passed on), uniform and not expanded, or a header only */
	json_t *more;         /* unknown keys; passed on */
};

struct pm_set {
	char name[PM_NAME];
	uint64_t n;          /* particles, 0 is legal */
	double kick, drift;  /* completed fractions of the current step, 0..1 */
	int pass;            /* completed passes of a multi-stage scheme, else 0 */
	bool fixed;          /* never pushed (a fixed background of bodies) */
	json_t *more;
};

struct pm_mesh {
	char name[PM_NAME];
	size_t cells[3];     /* >= 1 per axis below dim, 1 above */
	double lo[3], h[3];  /* [length]; point i of an axis sits at lo + i*h */
	json_t *more;
};

struct pm_frame {
	int dim;                        /* 1, 2, 3 */
	char law[PM_NAME];              /* a name of lib/law */
	json_t *constants;              /* object: constants of the law and the scene by name (G, eps0, nu, background, softening ...) */
	char scene[PM_NAME];
	json_t *parameters;             /* object: parameters of the scene */
	double time, dt;                /* [time] */
	double start;                   /* [time] at substep 0 of the current step; equal to time when substep is 0 */
	int64_t step;                   /* full steps done */
	double since_time;              /* [time] at which step since_step began; since then dt has been the same (frame-time.h) */
	int64_t since_step;
	int substep;                    /* pushes done in the current step, 0 between steps */
	double lo[3], hi[3];            /* the box [length] */
	enum pm_face face[3][2];        /* of the fields: [axis][low, high] */
	enum pm_particle_face pface[3][2];
	uint64_t seed;
	json_t *history;                /* array of objects, one per stage */
	json_t *report;                 /* object: the reports of the stages, keyed by the word as typed; written in the tail */
	json_t *more;                   /* unknown attributes; passed on */
	json_t *inside;                 /* the same inside "box", "law" and "scene", keyed by these */
	size_t nsets, nmeshes, nfields;
	struct pm_set **sets;
	struct pm_mesh **meshes;
	struct pm_field **fields;       /* in the order of the stream */
	size_t ndropped;
	struct pm_field **dropped;      /* dropped by the running stage; freed after frame() */
};

struct pm_frame *pm_frame_new(int dim);                     /* law free, unit box [0,1], all faces open, no sets, no meshes */
struct pm_frame *pm_frame_free(struct pm_frame *f);
struct pm_frame *pm_frame_copy(const struct pm_frame *f);  /* shares the buffers */

struct pm_set *pm_frame_set(const struct pm_frame *f, const char *name);   /* NULL if missing */
bool pm_set_moves(const struct pm_frame *f, const struct pm_set *set);      /* push moves it: it has positions and is not fixed */
struct pm_mesh *pm_frame_mesh(const struct pm_frame *f, const char *name); /* NULL if missing; name NULL: the first */
struct pm_field *pm_frame_field(const struct pm_frame *f, const char *on, const char *name); /* NULL if missing */
size_t pm_mesh_points(const struct pm_frame *f, const struct pm_mesh *m, size_t points[3]); /* cells (periodic) or cells+1; their product */
double pm_frame_constant(const struct pm_frame *f, const char *name, double otherwise);
void pm_frame_constant_set(struct pm_frame *f, const char *name, double value);
double pm_frame_parameter(const struct pm_frame *f, const char *name, double otherwise);
void pm_frame_parameter_set(struct pm_frame *f, const char *name, double value);

/* For the computing function of a stage: the data of component c (double, int64_t or bytes), count values long. */
/* Values that are divided over ranks are brought together by who first asks for them. Where threads will ask, this asks before: only the first thread of a rank
 * may use the world (MPI_THREAD_FUNNELED). Nothing in a divided frame, and for a field without values or NULL. */
void pm_field_bring(const struct pm_field *field);
const double *pm_in(const struct pm_field *field, int c);
double *pm_out(struct pm_field *field, int c);
const int64_t *pm_in_i64(const struct pm_field *field, int c);
int64_t *pm_out_i64(struct pm_field *field, int c);
const unsigned char *pm_in_u8(const struct pm_field *field, int c);
unsigned char *pm_out_u8(struct pm_field *field, int c);
void *pm_field_bytes(struct pm_field *field);         /* all components, whatever the type; NULL if the data are not held */
size_t pm_field_memory(const struct pm_field *field); /* bytes of one value there: 8, or 1 of u8 */

PM_C_END

#endif
