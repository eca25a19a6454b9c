/* A movie by ffmpeg: rows of RGB on its standard input, 4:2:0 of the matrix of BT.709 (H.264 where ffmpeg has it) in an MP4 whose index stands in front, so
 * that a browser can begin at once. ffmpeg writes into a file that has no name until it is complete. SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "picture/movie.h"

int pm_movie_possible(void)
{
	const char *path = getenv("PATH"), *end;
	char name[4096];
	for (const char *p = path ? path : ""; *p; p = *end ? end + 1 : end) {
		end = strchrnul(p, ':');
		snprintf(name, sizeof name, "%.*s/ffmpeg", (int)(end - p), p);
		if (!access(name, X_OK))
			return 0;
	}
	return pm_fail(PM_DATA, "no program ffmpeg, which writes .mp4 (apt-get install ffmpeg; or -o run.html, a page that plays the frames)");
}

static void become(const struct pm_movie *m, int in)
{
	char size[32], rate[32];
	snprintf(size, sizeof size, "%dx%d", m->width, m->height);
	snprintf(rate, sizeof rate, "%g", m->fps);
	const char *const argv[] = {"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size,
		"-framerate", rate, "-i", "pipe:0", "-an", "-vf", "scale=out_color_matrix=bt709:out_range=tv", "-pix_fmt", "yuv420p",
		"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv",
		"-fflags", "+bitexact", "-flags", "+bitexact", "-movflags", "+faststart", "-f", "mp4", "-y", "/proc/self/fd/3", NULL};
	signal(SIGPIPE, SIG_DFL);
	signal(SIGINT, SIG_IGN); /* it ends with its input */
	if (dup2(in, STDIN_FILENO) < 0 || dup2(m->said, STDOUT_FILENO) < 0 || dup2(m->said, STDERR_FILENO) < 0)
		_exit(127);
	if (m->file.fd == 3 ? fcntl(3, F_SETFD, 0) : dup2(m->file.fd, 3) < 0)
		_exit(127);
	execvp("ffmpeg", (char *const *)(uintptr_t)argv);
	fprintf(stderr, "%s\n", strerror(errno));
	_exit(127);
}

static int start(struct pm_movie *m, const struct pm_picture *p)
{
	int in[2];
	m->width = p->width, m->height = p->height;
	m->said = memfd_create("ffmpeg", MFD_CLOEXEC);
	if (m->said < 0 || pm_replace_open(&m->file, m->name, true))
		return m->said < 0 ? pm_fail_errno("cannot start ffmpeg") : pm_failed();
	if (pipe2(in, O_CLOEXEC))
		return pm_fail_errno("cannot start ffmpeg");
	m->pid = fork();
	if (m->pid == 0)
		become(m, in[0]);
	close(in[0]);
	m->pipe = m->pid > 0 ? fdopen(in[1], "wb") : NULL;
	if (m->pipe)
		signal(SIGPIPE, SIG_IGN); /* if ffmpeg fails, its message is used */
	else
		close(in[1]);
	return m->pipe ? 0 : pm_fail_errno("cannot start ffmpeg");
}

int pm_movie_add(struct pm_movie *m, const struct pm_picture *p)
{
	int status = m->pid ? 0 : start(m, p);
	if (status)
		return status;
	if (p->width != m->width || p->height != m->height)
		return pm_fail(PM_DATA, "this picture has %d x %d pixels, those before %d x %d, and a movie has one size (give --area)", p->width,
			p->height, m->width, m->height);
	const size_t bytes = 3 * (size_t)p->width * (size_t)p->height;
	return fwrite(p->rgb, 1, bytes, m->pipe) == bytes ? 0 : pm_movie_end(m) ? pm_failed() : pm_fail(PM_DATA, "ffmpeg ended early");
}

int pm_movie_end(struct pm_movie *m)
{
	int status = 0, state = 0;
	char text[1024];
	if (m->pid <= 0)
		return m->pid ? pm_fail(PM_DATA, "cannot start ffmpeg") : 0;
	const bool cut = !m->pipe || fclose(m->pipe) != 0;
	m->pipe = NULL;
	while (waitpid(m->pid, &state, 0) < 0 && errno == EINTR);
	m->pid = 0;
	if (cut || !WIFEXITED(state) || WEXITSTATUS(state)) {
		ssize_t n = pread(m->said, text, sizeof text - 1, 0);
		text[n > 0 ? n : 0] = 0;
		text[strcspn(text, "\r\n")] = 0;
		status = pm_fail(PM_DATA, "ffmpeg: %s", *text ? text : "it ended before the movie was complete");
	}
	return status ? status : pm_replace_commit(&m->file, false);
}

void pm_movie_drop(struct pm_movie *m)
{
	if (m->pipe)
		fclose(m->pipe);
	if (m->pid > 0) {
		kill(m->pid, SIGKILL);
		waitpid(m->pid, NULL, 0);
	}
	if (m->width) {
		close(m->said);
		if (m->file.fd > 2)
			close(m->file.fd);
		pm_replace_drop(&m->file);
	}
	*m = (struct pm_movie){0};
}
