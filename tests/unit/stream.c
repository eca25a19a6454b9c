/* The stream: frames and headers round trip, order of fields, copy on write, declarations. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "stream/column.h"
#include "stream/header.h"
#include "stream/run.h"
#include "stream/table.h"
#include "stream/wire.h"

static struct pm_frame *sample(void)
{
	struct pm_frame *f = pm_frame_new(2);
	size_t cells[3] = {5, 3, 1};
	f->face[0][0] = f->face[0][1] = PM_PERIODIC;
	f->time = 0.1, f->dt = 1e-300;
	f->hi[0] = 2.385;
	pm_frame_constant_set(f, "G", 6.674e-11);
	pm_frame_set_new(f, "matter", 7);
	pm_frame_set_new(f, "nobody", 0);
	pm_frame_mesh_new(f, "mesh", cells);
	struct pm_field *x = pm_makes(f, "matter", "x", 2, PM_STATE), *m = pm_makes(f, "matter", "mass", 1, PM_STATE);
	struct pm_field *id = pm_makes(f, "matter", "id", 1, PM_STATE), *rho = pm_makes(f, "mesh", "rho", 1, PM_DERIVED);
	struct pm_field *low = pm_makes(f, "matter", "low", 1, PM_STATE), *e = pm_makes(f, "nobody", "x", 2, PM_STATE);
	struct pm_field *u = pm_makes(f, "matter", "flag", 1, PM_STATE);
	m->uniform = true, m->value[0] = 0.1, m->extensive = true;
	id->type = PM_I64, low->type = PM_F32, u->type = PM_U8;
	rho->staggered[0][1] = 1;
	(void)e;
	pm_frame_ready(f);
	for (int i = 0; i < 14; i++)
		pm_out(x, 0)[i] = sin(i * 1.7);
	for (int i = 0; i < 7; i++)
		pm_out_i64(id, 0)[i] = ((int64_t)1 << 62) - i, pm_out(low, 0)[i] = 1 / 3., pm_out_u8(u, 0)[i] = (unsigned char)(250 + i % 3);
	for (int i = 0; i < 20; i++)
		pm_out(rho, 0)[i] = 1e300 / (i + 1);
	pm_frame_settle(f);
	return f;
}

/* Writes a frame n times into a file and returns it opened. */
static struct pm_reader *written(struct pm_frame *f, int n, const char *path)
{
	struct pm_writer *w = pm_writer_open(path);
	for (int i = 0; i < n; i++)
		check(pm_write_frame(w, f) == 0, "a frame is written");
	pm_write_end(w);
	pm_writer_close(w);
	return pm_reader_open(path);
}

/* More than one piece of 256 KiB, of each type. */
static void long_fields(void)
{
	struct pm_frame *f = pm_frame_new(1), *g = NULL;
	enum { n = 200001 };
	char path[] = "/tmp/pm-stream-XXXXXX";
	close(mkstemp(path));
	f->hi[0] = 1, f->dt = 1;
	pm_frame_set_new(f, "matter", n);
	struct pm_field *x = pm_makes(f, "matter", "x", 1, PM_STATE), *low = pm_makes(f, "matter", "low", 1, PM_STATE),
		*id = pm_makes(f, "matter", "id", 1, PM_STATE);
	low->type = PM_F32, id->type = PM_I64;
	pm_frame_ready(f);
	for (int i = 0; i < n; i++)
		pm_out(x, 0)[i] = sin(i), pm_out(low, 0)[i] = i + 0.5, pm_out_i64(id, 0)[i] = 7 * i; /* i + 1/2 fits in f32 */
	pm_frame_settle(f);
	struct pm_reader *r = written(f, 1, path);
	int wrong = 0;
	check(pm_read_frame(r, &g) == PM_GOT_FRAME, "a frame with fields of several pieces is read (%s)", pm_message());
	for (int i = 0; i < n && g; i++)
		wrong += pm_in(pm_frame_field(g, "matter", "x"), 0)[i] != sin(i) || pm_in(pm_frame_field(g, "matter", "low"), 0)[i] != i + 0.5 ||
			pm_in_i64(pm_frame_field(g, "matter", "id"), 0)[i] != 7 * i;
	check(!wrong, "f64, f32 and i64 have the values written, in order (%d do not)", wrong);
	pm_frame_free(f), pm_frame_free(g);
	pm_reader_close(r);
	unlink(path);
}

static void round_trip(void)
{
	struct pm_frame *f = sample(), *g = NULL;
	char path[] = "/tmp/pm-stream-XXXXXX";
	close(mkstemp(path));
	struct pm_reader *r = written(f, 2, path);
	check(pm_read_frame(r, &g) == PM_GOT_FRAME, "a frame is read (%s)", pm_message());
	if (!g)
		return;
	json_t *a = pm_header_json(f), *b = pm_header_json(g);
	char *ta = pm_json_line(a), *tb = pm_json_line(b);
	check(!strcmp(ta, tb), "its header is the same text");
	check(!strchr(ta, ' ') && strstr(ta, "\"dt\":1e-300") && strstr(ta, "2.3849999999999998"), "canonical: compact, 17 digits");
	for (size_t i = 0; i < f->nfields; i++) {
		struct pm_field *p = f->fields[i], *q = g->fields[i];
		size_t bytes = p->count * (size_t)p->components * pm_field_memory(p);
		check(p->uniform ? q->uniform && q->value[0] == p->value[0] : !bytes || !memcmp(pm_field_bytes(p), pm_field_bytes(q), bytes),
			"field %s holds the same bytes", p->name);
	}
	check(pm_in(pm_frame_field(f, "matter", "low"), 0)[0] == (double)(float)(1 / 3.), "f32 is rounded after a stage");
	g = pm_frame_free(g);
	check(pm_read_frame(r, &g) == PM_GOT_FRAME, "so is the second");
	pm_frame_free(g);
	check(pm_read_header(r, &g) == PM_GOT_END && pm_read_header(r, &g) == PM_GOT_EOF, "then comes the end, then the end of the file");
	pm_reader_close(r);
	unlink(path);
	free(ta), free(tb), json_decref(a), json_decref(b), pm_frame_free(f);
}

static void names(const struct pm_frame *f, char *out)
{
	*out = 0;
	for (size_t i = 0; i < f->nfields; i++)
		strcat(strcat(out, *out ? " " : ""), f->fields[i]->name);
}

static void declarations(void)
{
	struct pm_frame *f = sample(), *h;
	char list[200];
	names(f, list);
	check(!strcmp(list, "x mass id rho low x flag"), "fields stand in the order in which they were made (%s)", list);
	check(pm_reads(f, "matter", "x") && pm_changes(f, "matter", "mass") && pm_changes(f, "matter", "x") && pm_changes(f, "matter", "mass"),
		"fields are declared");
	names(f, list);
	check(!strcmp(list, "id rho low x flag mass x"), "changed ones come last, in the order of the declarations (%s)", list);
	check(!pm_frame_ready(f) && pm_in(pm_frame_field(f, "matter", "mass"), 0)[6] == 0.1, "a uniform field that is changed is expanded");
	check(!pm_reads(f, "matter", "charge") && strstr(pm_message(), "no field 'charge' on 'matter'"), "a missing one is reported by name");
	struct pm_field *acc = pm_contributes(f, "matter", "acc", "v", 2, "self", false);
	check(acc && acc->nterms == 1 && acc->role == PM_CHANGE, "a change field is made by the first stage that adds to it");
	check(pm_contributes(f, "matter", "acc", "v", 2, "near", false) == acc, "the second adds to it");
	check(!pm_contributes(f, "matter", "acc", "v", 2, "near", false) && strstr(pm_message(), "already holds"), "the same term twice is refused");
	check(!pm_contributes(f, "matter", "acc", "v", 2, "near", true) && strstr(pm_message(), "would lose"), "replace does not lose other terms");
	pm_drops_roles(f, NULL, 1u << PM_DERIVED);
	check(!pm_frame_field(f, "mesh", "rho") && f->ndropped == 1, "derived mesh fields are dropped");
	check(!pm_frame_settle(f) && f->ndropped == 0, "and freed after the stage");
	h = pm_frame_copy(f);
	struct pm_field *x = pm_changes(h, "matter", "x");
	pm_frame_ready(h);
	pm_out(x, 0)[0] = 77;
	check(pm_in(pm_frame_field(f, "matter", "x"), 0)[0] != 77, "a copy shares data until it is written");
	pm_out(x, 1)[3] = NAN;
	check(pm_frame_settle(h) == -PM_NUMERICS && strstr(pm_message(), "component 1, index 3"), "a NaN computed by a stage is reported: %s", pm_message());
	pm_frame_free(h), pm_frame_free(f);
}

static int header(const char *text)
{
	struct pm_frame *f = NULL;
	json_t *j = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
	int status = j ? pm_header_frame(j, &f) : -99;
	json_decref(j);
	pm_frame_free(f);
	return status;
}

#define HEAD "\"law\":{\"name\":\"free\"},\"scene\":{\"name\":\"\"},\"time\":0,\"dt\":1,\"step\":0,\"substep\":0,\"meshes\":[],"
#define FACES(low, high, first, last) "\"box\":{\"lo\":[0],\"hi\":[1],\"fields\":[[\"" low "\",\"" high "\"]],\"particles\":[[\"" first "\",\"" last "\"]]},"
#define BOX "\"box\":{\"lo\":[0],\"hi\":[1],\"fields\":[[\"open\",\"open\"]],\"particles\":[[\"open\",\"open\"]]},"
#define SETS "\"sets\":[{\"name\":\"a\",\"n\":3}],"
static void hostile(void)
{
	check(header("{\"dim\":1," HEAD BOX SETS "\"fields\":[]}") == 0, "the smallest header is read (%s)", pm_message());
	check(header("{\"dim\":1," HEAD FACES("periodic", "periodic", "periodic", "periodic") SETS "\"fields\":[]}") == 0, "so is a periodic one (%s)",
		pm_message());
	const char *bad[] = {"[]", "{}", "{\"dim\":4," HEAD BOX SETS "\"fields\":[]}", "{\"dim\":1," HEAD SETS "\"fields\":[]}",
		"{\"dim\":2," HEAD BOX SETS "\"fields\":[]}", "{\"byte_order\":\"big\",\"dim\":1," HEAD BOX SETS "\"fields\":[]}",
		"{\"dim\":1," HEAD FACES("periodic", "open", "periodic", "periodic") SETS "\"fields\":[]}",
		"{\"dim\":1," HEAD FACES("periodic", "periodic", "periodic", "open") SETS "\"fields\":[]}",
		"{\"dim\":1," HEAD BOX "\"sets\":[{\"name\":\"a\",\"n\":-1}],\"fields\":[]}",
		"{\"dim\":1," HEAD BOX "\"sets\":[{\"name\":\"a\",\"n\":9007199254740993000}],\"fields\":[]}",
		"{\"dim\":1," HEAD BOX "\"sets\":[{\"name\":\"a\",\"n\":1},{\"name\":\"a\",\"n\":1}],\"fields\":[]}",
		"{\"dim\":1," HEAD BOX SETS "\"fields\":[{\"name\":\"x\"}]}",
		"{\"dim\":1," HEAD BOX SETS
			"\"fields\":[{\"name\":\"x\",\"on\":\"b\",\"components\":1,\"type\":\"f64\",\"role\":\"state\",\"kind\":\"value\"}]}",
		"{\"dim\":1," HEAD BOX SETS
			"\"fields\":[{\"name\":\"x\",\"on\":\"a\",\"components\":17,\"type\":\"f64\",\"role\":\"state\",\"kind\":\"value\"}]}",
		"{\"dim\":1," HEAD BOX SETS
			"\"fields\":[{\"name\":\"x\",\"on\":\"a\",\"components\":1,\"type\":\"f16\",\"role\":\"state\",\"kind\":\"value\"}]}",
		"{\"dim\":1," HEAD BOX SETS
			"\"fields\":[{\"name\":\"x\",\"on\":\"a\",\"components\":2,\"type\":\"f64\",\"role\":\"state\",\"kind\":\"value\",\"uniform\":[1]}]}"};
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
		check(header(bad[i]) == -PM_DATA, "hostile header %zu is refused: %s", i, pm_message());
}

/* 0.1 is no float. */
static void one_number_in_f32(void)
{
	struct pm_frame *f = pm_frame_new(1);
	pm_frame_set_new(f, "matter", 5);
	struct pm_field *q = pm_makes(f, "matter", "charge", 1, PM_STATE);
	q->type = PM_F32, q->uniform = true, q->value[0] = 0.1;
	check(!pm_frame_ready(f) && !pm_frame_settle(f), "a field of one number is made");
	pm_reads(f, "matter", "charge");
	check(!pm_frame_ready(f) && pm_in(q, 0)[4] == 0.1, "a word that reads it finds the number of the header");
	check(!pm_frame_settle(f) && !q->buffer, "and leaves no values, rounded, for the next word");
	pm_reads(f, "matter", "charge")->use |= PM_USE_COLUMNS;
	check(!pm_frame_ready(f), "a word may take it as a column");
	const struct pm_column c = pm_column_of(q, 0);
	check(!c.doubles && !c.floats && c.value == 0.1, "that is the number");
	check(pm_in(q, 0)[4] == 0.1, "and ask for its values too");
	pm_frame_settle(f), pm_frame_free(f);
}

static void write_text(const char *path, const char *text)
{
	FILE *file = fopen(path, "w");
	check(file && fputs(text, file) >= 0 && !fclose(file), "a text is written");
}

/* A table of three rows that is `then` when its numbers are read. */
static void changed_table(const char *then, const char *message)
{
	char path[] = "/tmp/pmpipe-stream-XXXXXX";
	const int fd = mkstemp(path);
	struct pm_table_column column[PM_COLUMNS];
	struct pm_text t;
	size_t rows = 0;
	write_text(path, "x\n1\n2\n3\n");
	check(fd >= 0 && pm_text_open_by_ranks(&t, path) == 1 && pm_text_names(&t, t.size, column) == 1 && !pm_table_count(0, &t, t.size, &rows) && rows == 3,
		"three rows are counted");
	struct pm_frame *f = pm_frame_new(1);
	pm_frame_set_new(f, "matter", rows);
	column[0].field = pm_makes(f, "matter", "x", 1, PM_STATE);
	column[0].component = 0, column[0].text = false;
	check(!pm_table_field(&t, column[0].field) && !pm_field_ready(column[0].field), "there is room for them");
	write_text(path, then);
	check(pm_table_read(0, &t, t.size, f, 1, column) == -PM_DATA && strstr(pm_message(), message), "'%s' is said of %s: %s", message, then, pm_message());
	pm_text_close(&t), pm_frame_free(f);
	close(fd), unlink(path);
}

int main(void)
{
	changed_table("x\n12345\n", "has changed while it was read");
	changed_table("x\n1\n\n\n23\n", "has changed while it was read");
	changed_table("x\n1\n", "has become shorter while it was read");
	round_trip();
	long_fields();
	declarations();
	hostile();
	one_number_in_f32();
	return check_done();
}
