/* Sockets of Linux's abstract names, of which nothing stays when their owner ends. Both ends have the same version and the same user.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "stream/hand-over.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifdef __linux__
#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

enum { remembered = 64 }; /* blocks whose descriptor the other end has */

struct pm_hands {
	int listens, fd; /* -1: none (yet) */
	bool owed; /* the writer's: the reader has not said yet that it has read the last frame */
	uint64_t sent[remembered];
	unsigned nsent;
};

static bool name_of(int pipe, struct sockaddr_un *a, socklen_t *bytes)
{
	const char *wanted = getenv("PM_HANDOVER");
	struct stat st;
	if ((wanted && !strcmp(wanted, "0")) || fstat(pipe, &st) || !S_ISFIFO(st.st_mode))
		return false;
	*a = (struct sockaddr_un){.sun_family = AF_UNIX};
	int n = snprintf(a->sun_path + 1, sizeof a->sun_path - 1, "pmpipe/%s/%llx/%llx", PM_VERSION, (unsigned long long)st.st_dev,
		(unsigned long long)st.st_ino);
	*bytes = (socklen_t)(offsetof(struct sockaddr_un, sun_path) + 1 + (size_t)n);
	return true;
}

static struct pm_hands *hands_new(int listens, int fd)
{
	struct pm_hands *h = listens < 0 && fd < 0 ? NULL : calloc(1, sizeof *h);
	if (h)
		h->listens = listens, h->fd = fd;
	return h;
}

struct pm_hands *pm_hands_listen(int pipe)
{
	struct sockaddr_un a;
	socklen_t bytes;
	if (!name_of(pipe, &a, &bytes))
		return NULL;
	int s = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
	if (s >= 0 && (bind(s, (struct sockaddr *)&a, bytes) || listen(s, 1))) {
		close(s);
		s = -1;
	}
	return hands_new(s, -1);
}

static bool same_user(int s)
{
	struct ucred who;
	socklen_t bytes = sizeof who;
	return !getsockopt(s, SOL_SOCKET, SO_PEERCRED, &who, &bytes) && who.uid == geteuid();
}

struct pm_hands *pm_hands_connect(int pipe)
{
	struct sockaddr_un a;
	socklen_t bytes;
	if (!name_of(pipe, &a, &bytes))
		return NULL;
	/* Without waiting: the reader takes up no connection of writers that follow each other on one pipe and give nothing, and only so many are kept. */
	int s = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
	if (s >= 0 && (connect(s, (struct sockaddr *)&a, bytes) || !same_user(s) || fcntl(s, F_SETFL, 0))) {
		close(s);
		s = -1;
	}
	return hands_new(-1, s);
}

struct pm_hands *pm_hands_close(struct pm_hands *h)
{
	if (h) {
		if (h->listens >= 0)
			close(h->listens);
		if (h->fd >= 0)
			close(h->fd);
		free(h);
	}
	return NULL;
}

static bool was_sent(const struct pm_hands *h, uint64_t id)
{
	for (unsigned i = 0; i < remembered; i++)
		if (h->sent[i] == id)
			return true;
	return false;
}

int pm_hands_give(struct pm_hands *h, struct pm_shared *b, bool *comes)
{
	union {
		struct cmsghdr head;
		char room[CMSG_SPACE(sizeof(int))];
	} control = {.room = {0}};
	struct iovec part = {&b->id, sizeof b->id};
	struct msghdr m = {.msg_iov = &part, .msg_iovlen = 1, .msg_control = &control, .msg_controllen = sizeof control};
	pm_shared_use(b); /* before it is asked whether its maker has left: shared-block.c */
	*comes = pm_shared_left(b) || !was_sent(h, b->id);
	h->owed = true;
	if (!*comes)
		return 0;
	control.head = (struct cmsghdr){.cmsg_len = CMSG_LEN(sizeof(int)), .cmsg_level = SOL_SOCKET, .cmsg_type = SCM_RIGHTS};
	memcpy(CMSG_DATA(&control.head), &b->fd, sizeof b->fd);
	ssize_t n;
	do
		n = sendmsg(h->fd, &m, MSG_NOSIGNAL);
	while (n < 0 && errno == EINTR);
	if (n < 0) {
		const bool gone = errno == EPIPE || errno == ECONNRESET;
		const int status = gone ? 0 : pm_fail_errno("cannot write the output"); /* gone: what is written to the pipe next ends this program as ever */
		pm_shared_drop(b);
		return status;
	}
	h->sent[h->nsent++ % remembered] = b->id;
	return 0;
}

bool pm_hands_wait(struct pm_hands *h)
{
	char said;
	ssize_t n = 1;
	while (h->owed && (n = recv(h->fd, &said, 1, 0)) < 0 && errno == EINTR)
		;
	h->owed = false;
	if (n > 0) /* it may have ended behind that frame */
		n = recv(h->fd, &said, 1, MSG_PEEK | MSG_DONTWAIT);
	return n > 0 || (n < 0 && (errno == EAGAIN || errno == EINTR));
}

void pm_hands_taken(struct pm_hands *h)
{
	if (h && h->fd >= 0)
		send(h->fd, "", 1, MSG_NOSIGNAL | MSG_DONTWAIT);
}

/* The descriptor of the next message; -1: none. A writer that follows another on the same pipe has a connection of its own. */
static int descriptor(struct pm_hands *h, uint64_t *id)
{
	union {
		struct cmsghdr head;
		char room[CMSG_SPACE(sizeof(int))];
	} control;
	struct iovec part = {id, sizeof *id};
	struct msghdr m = {.msg_iov = &part, .msg_iovlen = 1, .msg_control = &control};
	int fd;
	for (;;) {
		m.msg_controllen = sizeof control;
		/* It was sent before the line that names it. */
		ssize_t n = h->fd < 0 ? 0 : recvmsg(h->fd, &m, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
		if (n < 0 && errno == EINTR)
			continue;
		if (n == (ssize_t)sizeof *id)
			break;
		int s = accept4(h->listens, NULL, NULL, SOCK_CLOEXEC);
		if (s < 0)
			return -1;
		if (!same_user(s)) {
			close(s);
			continue;
		}
		if (h->fd >= 0)
			close(h->fd);
		h->fd = s;
	}
	if (m.msg_controllen < CMSG_LEN(sizeof fd) || control.head.cmsg_type != SCM_RIGHTS)
		return -1;
	memcpy(&fd, CMSG_DATA(&control.head), sizeof fd);
	return fd;
}

struct pm_shared *pm_hands_take(struct pm_hands *h, const struct pm_given *what)
{
	uint64_t id = what->id;
	int fd = h && what->comes ? descriptor(h, &id) : -1;
	struct pm_shared *b = fd >= 0 && id == what->id ? pm_shared_map(id, fd) : h && !what->comes ? pm_shared_known(id) : NULL;
	if (!b && (fd < 0 || id != what->id)) {
		pm_fail(PM_DATA, "the stream names memory that was not handed over: it was recorded on its way, or is damaged (PM_HANDOVER=0 sends copies)");
		if (fd >= 0)
			close(fd);
	}
	return b;
}
#else
struct pm_hands *pm_hands_listen(int pipe) { return (void)pipe, NULL; }
struct pm_hands *pm_hands_connect(int pipe) { return (void)pipe, NULL; }
struct pm_hands *pm_hands_close(struct pm_hands *h) { return (void)h, NULL; }
int pm_hands_give(struct pm_hands *h, struct pm_shared *b, bool *comes) { return (void)h, (void)b, (void)comes, -PM_DATA; }
bool pm_hands_wait(struct pm_hands *h) { return (void)h, false; }
void pm_hands_taken(struct pm_hands *h) { (void)h; }
struct pm_shared *pm_hands_take(struct pm_hands *h, const struct pm_given *what)
{
	(void)h, (void)what;
	pm_fail(PM_DATA, "the stream names memory, which no program hands over here");
	return NULL;
}
#endif

enum { summed_bit = 32, finite_bit, comes_bit, floats_bit }; /* behind the checksum */

uint64_t pm_given_bits(const struct pm_given *g)
{
	return g->crc | (uint64_t)g->summed << summed_bit | (uint64_t)g->finite << finite_bit | (uint64_t)g->comes << comes_bit |
		(uint64_t)g->floats << floats_bit;
}

struct pm_given pm_given_of(uint64_t id, uint64_t bits)
{
	return (struct pm_given){.id = id, .crc = (uint32_t)bits,
		.summed = bits >> summed_bit & 1, .finite = bits >> finite_bit & 1, .comes = bits >> comes_bit & 1, .floats = bits >> floats_bit & 1};
}
