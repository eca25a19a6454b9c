/* svtk: frames as files of VTK, which ParaView, VisIt and PyVista open (docs/methods/vtk.md). Cost: that of the disk.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "stage/stage.h"
#include "vtk/vtk.h"

struct config {
	const char *output;
};

static const struct pm_option options[] = {
	{.name = "output", .letter = 'o', .kind = PM_TEXT, .unit = "FILE.pvd", .cosmetic = true, PM_AT(output),
		.text = "the list of all frames, which appears when it is complete; the frames are in a directory of the same name without .pvd"},
	{0},
};

static const struct pm_example examples[] = {
	{"A collapse for ParaView", "pinit plummer -n 200 | cycle -n 4 --every 2 'push kick/2 drift | pp | push kick/2' | svtk -o run.pvd; ls run run.pvd"},
	{"A file of HDF5 for ParaView", "pinit plummer -n 100 | p2m -n 8 -o a.h5; svtk -i a.h5 -o a.pvd"},
	{0}};

static int begin(struct pm_stage *s) { return pm_vtk_begin(s->state, ((const struct config *)s->config)->output); }

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	(void)s;
	for (size_t i = 0; i < f->nfields; i++)
		f->fields[i]->use |= PM_USE_READ | PM_USE_ANY;
	return 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f) { return pm_vtk_frame(s->state, f); }

static int end(struct pm_stage *s) { return pm_vtk_end(s->state); }

static void done(struct pm_stage *s) { pm_vtk_free(s->state); }

const struct pm_tool tool_svtk = {
	.name = "svtk",
	.summary = "frames as files of VTK for ParaView",
	.about = "A sink. Every set becomes a file of particles (.vtp) and every mesh an image (.vti), for each frame, with all fields. "
		"Vectors have three components, those beyond the dimension 0. FILE.pvd lists them with their times: open it in ParaView, VisIt or PyVista. "
		"A component half a cell up has an image of its own.",
	.kind = PM_SINK,
	.config = sizeof(struct config),
	.state = sizeof(struct pm_vtk_run),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.end = end,
	.free = done,
};
