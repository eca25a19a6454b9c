/* Launchers are known by the variables that they set for each rank; the names in `variables` are Open MPI's, PMI's (MPICH and others) and PMIx's. SLURM_* says
 * nothing: it is there in every job, also for programs that srun has not started. SPDX-License-Identifier: GPL-3.0-or-later */
#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "world/launch.h"
#include "world/world.h"

static const char *const sizes[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", NULL};
static const char *const ranks[] = {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK", NULL};

static const char *first_of(const char *const *names)
{
	for (; *names; names++)
		if (getenv(*names))
			return getenv(*names);
	return NULL;
}

bool pm_launched(void)
{
	const char *world = getenv("PM_WORLD"), *size = first_of(sizes);
	if (world && !strcmp(world, "alone"))
		return false;
	return size ? atoi(size) > 1 : getenv("PMIX_RANK") != NULL;
}

bool pm_output_is_terminal(void) { return !getenv("PM_WORLD") && !first_of(sizes) && !first_of(ranks) && isatty(STDOUT_FILENO); }

int pm_launched_rank(void)
{
	const char *rank = first_of(ranks);
	return rank ? atoi(rank) : 0;
}

/* What names the job and is the same for all programs of a rank; NULL: nothing. MPICH's launcher names none, but each rank has a socket to it. */
static const char *job_of(char text[32])
{
	const char *socket = getenv("PMI_FD");
	struct stat st;
	if (getenv("PMIX_NAMESPACE") || getenv("PMI_JOBID"))
		return getenv("PMIX_NAMESPACE") ? getenv("PMIX_NAMESPACE") : getenv("PMI_JOBID");
	if (!socket || fstat(atoi(socket), &st))
		return NULL;
	snprintf(text, 32, "%llu", (unsigned long long)st.st_ino);
	return text;
}

/* Two programs of one rank at the same time are a pipeline that the launcher has started as one program. A socket whose name has no file holds the place of the
 * rank; a rank other than 0 whose input is a pipe is in a pipeline, too, but with MPICH's launcher, which gives one to every rank. */
static int only_one_of_this_rank(void)
{
	char text[32];
	const char *job = job_of(text);
	struct sockaddr_un place = {.sun_family = AF_UNIX};
	struct stat in;
	bool other = pm_launched_rank() && !getenv("PMI_FD") && !fstat(STDIN_FILENO, &in) && S_ISFIFO(in.st_mode);
	if (job) {
		const int n = snprintf(place.sun_path + 1, sizeof place.sun_path - 1, "pmpipe-%.60s-%d", job, pm_launched_rank());
		const int held = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0); /* until the process ends */
		other |= held >= 0 && bind(held, (struct sockaddr *)&place, (socklen_t)(offsetof(struct sockaddr_un, sun_path) + 1 + (size_t)n));
	}
	return other ? pm_fail(PM_USAGE, "a pipeline runs inside the launcher (start each word by a launcher of its own, or put the words between the quotes "
		"of cycle)") : 0;
}

static void alone_from_here(void)
{
	static const char *const more[] = {"OMPI_COMM_WORLD_LOCAL_SIZE", "OMPI_COMM_WORLD_LOCAL_RANK", "PMI_FD", "PMI_PORT", "PMIX_NAMESPACE", NULL};
	for (int i = 0; sizes[i]; i++)
		unsetenv(sizes[i]);
	for (int i = 0; ranks[i]; i++)
		unsetenv(ranks[i]);
	for (int i = 0; more[i]; i++)
		unsetenv(more[i]);
	setenv("PM_WORLD", "alone", 1);
}

/* Where the object of mpi.c is, seen from the programs: installed; in the tree; in another build directory. */
static void *object_open(const char *directory)
{
	static const char *const beside[] = {"../../lib/pmpipe", "../build", "..", NULL};
	char path[PATH_MAX + 64];
	for (int i = 0; beside[i]; i++) {
		snprintf(path, sizeof path, "%s/%s/pmpipe-mpi.so", directory, beside[i]);
		if (!access(path, R_OK)) {
			void *object = dlopen(path, RTLD_NOW | RTLD_GLOBAL); /* global: Open MPI opens parts of itself that need it */
			if (!object)
				pm_fail(PM_DATA, "started by an MPI launcher, but MPI does not open: %s (PM_WORLD=alone runs without)", dlerror());
			return object;
		}
	}
	pm_fail(PM_DATA, "started by an MPI launcher, but pmpipe-mpi.so is not there (install openmpi-bin and libopenmpi-dev, then make; PM_WORLD=alone runs "
		"without)");
	return NULL;
}

int pm_launch(const char *directory)
{
	const char *size = first_of(sizes), *why;
	const int announced = size ? atoi(size) : 0;
	struct pm_transport t = {0};
	int status = only_one_of_this_rank();
	if (status)
		return status;
	void *object = object_open(directory);
	if (!object)
		return pm_failed();
	const struct pm_transport_maker *maker = dlsym(object, "pm_world_mpi");
	if (!maker || maker->version != PM_TRANSPORT_VERSION)
		return pm_fail(PM_DATA, "pmpipe-mpi.so belongs to another version of pmpipe (make again)");
	if ((why = maker->open(&t)))
		return pm_fail(PM_DATA, "%s", why);
	if (announced && t.size != announced)
		return pm_fail(PM_DATA, "the launcher has started %d ranks, but this MPI sees %d (the launcher belongs to another MPI than pmpipe-mpi.so)",
			announced, t.size);
	alone_from_here();
	pm_world_set(&t);
	return 0;
}
