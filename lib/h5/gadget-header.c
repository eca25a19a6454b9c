/* What a GADGET snapshot says about itself: group Header of all codes; groups Parameters and Config (GADGET-4, Arepo), Units, Cosmology and Code (SWIFT).
 * Source: Springel, GADGET-2 user guide (2005), section 6, and GADGET-4 (arXiv:2010.03567), appendix; SWIFT's documentation, Snapshots. A run is comoving if
 * a flag says so, or the redshift is not 0; then Time is the scale factor a = 1/(1 + z). Where the redshift is 0, a is 1 and nothing depends on it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "h5/apart.h"
#include "h5/gadget.h"

static const double newton = 6.6743e-8; /* [cm^3/(g s^2)], CODATA 2018 */

bool pm_gadget_is(hid_t file)
{
	hid_t o = H5Lexists(file, "Header", H5P_DEFAULT) > 0 ? H5Oopen(file, "Header", H5P_DEFAULT) : -1;
	bool is = o >= 0 && pm_h5_has(o, "NumPart_ThisFile");
	H5Oclose(o);
	return is;
}

/* A number of a group that may be missing. */
static double of_group(hid_t file, const char *group, const char *name, double otherwise)
{
	char folder[64];
	snprintf(folder, sizeof folder, "%s", group);
	*(strchr(folder, '/') ? strchr(folder, '/') : folder + strlen(folder)) = 0;
	bool there = H5Lexists(file, folder, H5P_DEFAULT) > 0 && H5Lexists(file, group, H5P_DEFAULT) > 0;
	hid_t o = there ? H5Oopen(file, group, H5P_DEFAULT) : -1;
	double x = o >= 0 ? pm_h5_number(o, name, otherwise) : otherwise;
	H5Oclose(o);
	return x;
}

/* The first of several groups that has it. */
static double either(hid_t file, const char *name, double otherwise)
{
	return of_group(file, "Header", name, of_group(file, "Parameters", name, otherwise));
}

static int counts(hid_t header, const char *name, int *n, double *x)
{
	*n = PM_GADGET_TYPES;
	int status = pm_h5_get_reals(header, name, n, x);
	for (int t = 0; t < *n && !status; t++)
		if (!(x[t] >= 0 && x[t] < 0x1p48 && x[t] == floor(x[t])))
			status = pm_fail(PM_DATA, "Header: '%s' is not a list of numbers of particles", name);
	return status;
}

int pm_gadget_here(hid_t file, struct pm_gadget *g)
{
	int n;
	hid_t header = H5Oopen(file, "Header", H5P_DEFAULT);
	int status = header < 0 ? pm_fail(PM_DATA, "there is no group 'Header'") : counts(header, "NumPart_ThisFile", &n, g->here);
	H5Oclose(header);
	if (!status && g->types && n != g->types)
		status = pm_fail(PM_DATA, "the files of the snapshot differ in the number of particle types");
	g->types = status ? 0 : n;
	return status;
}

static int totals(hid_t header, struct pm_gadget *g)
{
	double high[PM_GADGET_TYPES];
	int n, status = 0;
	memcpy(g->total, g->here, sizeof g->total);
	if (g->files > 1)
		status = counts(header, "NumPart_Total", &n, g->total);
	if (!status && g->files > 1 && pm_h5_has(header, "NumPart_Total_HighWord") && !(status = counts(header, "NumPart_Total_HighWord", &n, high)))
		for (int t = 0; t < n && t < g->types; t++)
			g->total[t] += high[t] * 0x1p32;
	n = PM_GADGET_TYPES;
	if (!status && pm_h5_has(header, "MassTable"))
		status = pm_h5_get_reals(header, "MassTable", &n, g->mass);
	for (int t = 0; t < n && t < g->types && !status; t++)
		if (!(g->mass[t] >= 0 && isfinite(g->mass[t])))
			status = pm_fail(PM_DATA, "Header: a mass of 'MassTable' is negative or not finite");
	return status;
}

/* STEM.K.ENDING, if there are several files and this is not one that stands for all of them. */
static int name_parts(const char *path, hid_t header, struct pm_gadget *g)
{
	double all[PM_GADGET_TYPES];
	int n = PM_GADGET_TYPES;
	bool whole = !pm_h5_get_reals(header, "NumPart_Total", &n, all) && n == g->types && !memcmp(all, g->here, (size_t)n * sizeof *all);
	const char *dot = strrchr(path, '.'), *end = dot;
	if (g->files == 1 || whole)
		return g->files = 1, 0;
	while (end && end > path && isdigit((unsigned char)end[-1]))
		end--;
	if (!dot || end == dot || end <= path + 1 || end[-1] != '.' || strlen(dot) >= sizeof g->ending || (size_t)(end - path) >= sizeof g->stem)
		return pm_fail(PM_DATA, "the snapshot has %d files, and this name does not end in .0.hdf5 (give the first of them)", g->files);
	snprintf(g->stem, sizeof g->stem, "%.*s", (int)(end - path), path);
	snprintf(g->ending, sizeof g->ending, "%s", dot);
	return 0;
}

hid_t pm_gadget_open(struct pm_gadget *g, int k)
{
	char path[sizeof g->stem + 32];
	snprintf(path, sizeof path, "%s%d%s", g->stem, k, g->ending);
	if (k > g->allowed) /* each file is opened for every field */
		pm_h5_more_room(path), g->allowed = k;
	hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
	if (file < 0)
		pm_h5_fail("cannot open '%s', one of the %d files of the snapshot", path, g->files);
	return file;
}

static void units(hid_t file, struct pm_gadget *g)
{
	g->length = either(file, "UnitLength_in_cm", of_group(file, "Units", "Unit length in cgs (U_L)", 0));
	g->weight = either(file, "UnitMass_in_g", of_group(file, "Units", "Unit mass in cgs (U_M)", 0));
	g->speed = either(file, "UnitVelocity_in_cm_per_s", g->length / of_group(file, "Units", "Unit time in cgs (U_t)", INFINITY));
	if (!(g->length > 0 && g->weight > 0 && g->speed > 0 && isfinite(g->length * g->weight * g->speed)))
		g->length = g->weight = g->speed = 0;
	const double stated = either(file, "GravityConstantInternal", of_group(file, "PhysicalConstants/InternalUnits", "newton_G", 0));
	g->G = stated > 0 ? stated : g->length ? newton * g->weight / (g->length * g->speed * g->speed) : 0;
	g->G = isfinite(g->G) ? g->G : 0;
}

static int epoch(hid_t file, struct pm_gadget *g)
{
	const double z = of_group(file, "Header", "Redshift", 0);
	const double flag = either(file, "ComovingIntegrationOn", of_group(file, "Cosmology", "Cosmological run", -1));
	g->time = of_group(file, "Header", "Time", 0);
	g->comoving = flag >= 0 ? flag != 0 : z != 0;
	g->a = !g->comoving ? 1 : of_group(file, "Header", "Scale-factor", g->swift ? 1 / (1 + z) : g->time);
	if (!isfinite(g->time) || !isfinite(g->a) || !(g->a > 0))
		return pm_fail(PM_DATA, "Header: 'Time' is %g, which is no %s", g->time, g->comoving ? "scale factor" : "time");
	if (g->comoving && fabs(g->a * (1 + z) - 1) > 1e-4) /* codes in single precision round z */
		return pm_fail(PM_DATA, "Header: the scale factor %g does not agree with the redshift %g", g->a, z);
	return 0;
}

int pm_gadget_header(hid_t file, const char *path, struct pm_gadget *g)
{
	*g = (struct pm_gadget){.periodic = -1};
	int sides = 3, status = pm_gadget_here(file, g);
	if (status)
		return status;
	hid_t header = H5Oopen(file, "Header", H5P_DEFAULT);
	const double files = pm_h5_number(header, "NumFilesPerSnapshot", 1);
	g->files = files >= 1 && files <= 65536 ? (int)files : 1;
	char *code = pm_h5_has(header, "Code") ? pm_h5_get_text(header, "Code") : NULL;
	g->swift = (code && !strcmp(code, "SWIFT")) || of_group(file, "Units", "Unit length in cgs (U_L)", 0) > 0;
	free(code);
	if (!(status = name_parts(path, header, g)) && !(status = totals(header, g)) && !(status = epoch(file, g)) && pm_h5_has(header, "BoxSize"))
		status = pm_h5_get_reals(header, "BoxSize", &sides, g->box);
	for (int d = sides == 3 ? 3 : 1; d < 3; d++)
		g->box[d] = g->box[0];
	H5Oclose(header);
	if (H5Lexists(file, "Config", H5P_DEFAULT) > 0 && !g->swift) {
		hid_t config = H5Oopen(file, "Config", H5P_DEFAULT);
		g->periodic = pm_h5_has(config, "PERIODIC") ? 1 : -1;
		H5Oclose(config);
	}
	units(file, g);
	return status;
}
