/* The followers wait in a share of rank 0 for the next request. SPDX-License-Identifier: GPL-3.0-or-later */
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "stage/divided.h"
#include "stage/internal.h"
#include "stage/ranks.h"
#include "stream/parts-file.h"
#include "world/launch.h"
#include "world/world.h"

/* What a rank is made of: ranks that differ in any of it could give other bytes than a run alone. */
struct identity {
	char tool[PM_NAME], version[32], processor[1024];
	uint32_t program;
};

/* Only rank 0 reads and writes; and a signal, which a launcher or a terminal sends to all, ends the run by rank 0. */
static void step_back(void)
{
	const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
	if (nothing >= 0) {
		dup2(nothing, STDIN_FILENO);
		dup2(nothing, STDOUT_FILENO);
		close(nothing);
	}
	signal(SIGINT, SIG_IGN), signal(SIGTERM, SIG_IGN), signal(SIGHUP, SIG_IGN);
	pm_memory_end(NULL); /* a failed allocation is a failure of this rank, which the ranks agree on */
}

int pm_ranks_launch(void)
{
	const char *home = pm_home();
	const int status = pm_launch(home ? home : ".");
	if (status && pm_launched_rank()) { /* rank 0 says it, if it has failed too; a launcher ends all where one rank ends so */
		sleep(1);
		_exit(pm_exit_code(status));
	}
	if (!status && pm_world_rank())
		step_back();
	return status;
}

int pm_ranks_rehearse(int n)
{
	struct pm_transport t;
	if (pm_world_size() > 1)
		return pm_fail(PM_USAGE, "--ranks rehearses on one machine, but a launcher has started %d ranks (leave out --ranks)", pm_world_size());
	if (n == 1)
		return 0;
	const int status = pm_transport_rehearse(&t, n);
	if (status)
		return status;
	pm_world_set(&t);
	if (t.rank)
		step_back();
	return 0;
}

static uint32_t checksum_of(const char *path)
{
	static char piece[1 << 16];
	const int fd = open(path, O_RDONLY | O_CLOEXEC);
	uint32_t crc = 0;
	ssize_t n;
	while (fd >= 0 && (n = read(fd, piece, sizeof piece)) > 0)
		crc = pm_crc32c(crc, piece, (size_t)n);
	if (fd >= 0)
		close(fd);
	return crc;
}

/* Its instructions: libraries choose their code by them. */
static void processor_of(char *text, size_t room)
{
	static char line[8192];
	FILE *info = fopen("/proc/cpuinfo", "r");
	uint32_t flags = 0;
	char name[200] = "unknown";
	while (info && fgets(line, sizeof line, info)) {
		const char *value = strchr(line, ':');
		if (value && !strncmp(line, "model name", 10))
			snprintf(name, sizeof name, "%.*s", (int)strcspn(value + 2, "\n"), value + 2);
		if (value && (!strncmp(line, "flags", 5) || !strncmp(line, "Features", 8))) {
			flags = pm_crc32c(0, value, strlen(value));
			break;
		}
	}
	if (info)
		fclose(info);
	snprintf(text, room, "%s, instructions %08x", name, flags);
}

static int compare(const struct identity *mine, const struct identity *first)
{
	if (strcmp(mine->tool, first->tool))
		return pm_fail(PM_USAGE, "rank %d runs '%s', rank 0 '%s' (a launcher starts one word; put a sentence between the quotes of cycle)",
			pm_world_rank(), mine->tool, first->tool);
	if (getenv("PM_ANY_BUILD"))
		return 0;
	if (strcmp(mine->version, first->version) || mine->program != first->program)
		return pm_fail(PM_DATA, "rank %d runs another build of pmpipe than rank 0, so that bytes may differ (install the same; PM_ANY_BUILD=1 goes on)",
			pm_world_rank());
	if (strcmp(mine->processor, first->processor))
		return pm_fail(PM_DATA, "the processor of rank %d is '%s', that of rank 0 '%s', so that bytes may differ (PM_ANY_BUILD=1 goes on)",
			pm_world_rank(), mine->processor, first->processor);
	return 0;
}

int pm_ranks_compare(const struct pm_tool *tool)
{
	struct identity mine = {.version = PM_VERSION}, first;
	snprintf(mine.tool, sizeof mine.tool, "%s", tool->name);
	mine.program = checksum_of("/proc/self/exe");
	processor_of(mine.processor, sizeof mine.processor);
	first = mine;
	int status = pm_world_share(0, 0, &first, sizeof first);
	return pm_world_agree(status ? status : compare(&mine, &first));
}

int pm_ranks_follow(const struct pm_tool *tool)
{
	enum pm_request what = PM_REQUEST_FORGET;
	while (what != PM_REQUEST_END && !pm_world_broken()) {
		void *more;
		size_t bytes;
		if (!pm_request_take(&what, &more, &bytes)) {
			if (what == PM_REQUEST_APPLY)
				pm_divided_follow(tool, more);
			else if (what == PM_REQUEST_TALLY)
				pm_divided_tally_follow(tool, more);
			else if (what == PM_REQUEST_SOURCE)
				pm_divided_source_follow(tool, more);
			else if (what == PM_REQUEST_READ || what == PM_REQUEST_WRITE)
				pm_parts_file_follow(what, more, bytes);
			else if (what != PM_REQUEST_END)
				pm_request_parts(what, more, bytes);
		}
	}
	pm_divided_free();
	pm_parts_free();
	pm_world_end();
	return 0;
}

int pm_ranks_end(void)
{
	if (pm_world_size() == 1)
		return 0;
	int status = pm_world_broken() ? pm_fail(PM_DATA, "%s", pm_message()) : pm_request_send(PM_REQUEST_END, NULL, 0);
	pm_parts_free();
	const int end = pm_world_end();
	return end ? end : status;
}
