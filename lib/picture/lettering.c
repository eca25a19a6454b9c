/* Letters as strokes of a round pen, designed for this program. A letter is its width, then strokes separated by blanks; a stroke is a list of points of two
 * characters: x from '0' upwards in units, y from 'a' = -4 (e: base line, o: height of a small letter, s: capital). A stroke that starts with ~ is smooth:
 * Catmull-Rom through its points, closed where it ends as it starts. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdbool.h>
#include <string.h>

#include "picture/lettering.h"

/* From ' ' to '~'. */
static const char *const letters[95] = {
	"5", /* space */
	"2 1s1i 1f1e", "4 1s1p 3s3p", "9 3s1e 7s5e 0n8n 0j8j", "8 ~8p6r4r1q1n4l7j8h5e2e0g 4t4c", "; ~2s4r4o2m0o0r2s :s1e ~9l;j;f9e7f7j9l",
	": ~:l9h5e2e0g0i3l6n6q4s2q2n:e", "2 1s1p",
	"4 ~4t2r1n1i2e4b", "4 ~0t2r3n3i2e0b", "8 4s4k 0q8m 8q0m", "9 4n4f 0j8j", "3 2f2d1b", "7 0j6j", "2 1f1e", "7 0c6t",
	"8 ~4s7q8l7g4e1g0l1q4s", "8 2p5s5e", "8 ~0p1r4s7r8p7m4j0e 0e8e", "8 0s8s4m ~3m5m8j8h5e2e0g", "8 6e6s0i8i", "8 8s1s0l ~0l4n7m8i7f4e2e0g",
	"8 ~7s3p0k0h2e4e7f8i7l4m1k0i", "8 0s8s3e",
	"8 ~4m7n7q4s1q1n4m ~4m8j8g4e0g0j4m", "8 ~1e5h8m8p6s4s1r0o1l4k7m8o", "2 1n1m 1f1e", "3 2n2m 2f2d1b", "8 8o0j8e", "8 0l8l 0h8h", "8 0o8j0e",
	"7 ~0p1r3s6r6o4l3i 3f3e",
	"< ~9m8k5j4l5o8o9m9j;i<l;p8s4s1q0l0i3e6d9e", "9 0e5s:e 2j8j", "9 0e0s ~0s5s8r8n5l ~5l8k9h8f5e 0l5l 0e5e", ": ~:p7s4s1q0l1g4e7e:g",
	": 0e0s ~0s4s7r9o9i7f4e 4e0e", "8 8s0s0e8e 0l6l", "8 8s0s0e 0l6l",
	"; ~:p7s4s1q0l1g4e7e:g :g:k6k", "9 0e0s 9e9s 0l9l", "2 1e1s", "7 6s6i ~6i5f3e1f0i", "9 0e0s 9s0j 3l9e", "8 0s0e8e", "< 0e0s6i<s<e", ": 0e0s9e9s",
	"; ~5s9q:l9g5e1g0l1q5s",
	"9 0e0s ~0s5s8r9o8l5k 5k0k", "; ~5s9q:l9g5e1g0l1q5s 6h:d", "9 0e0s ~0s5s8r9o8l5k 5k0k 5k9e", "9 ~8q7s3s1r1n4l7k8h5e2e0g", ": 0s:s 5s5e",
	": 0s0j ~0j1f5e8f9j 9j9s", "9 0s5e:s", "> 0s4e7s:e>s", "9 0s9e 9s0e",
	": 0s5l:s 5l5e", "9 0s9s0e9e", "4 4t1t1b4b", "7 0t6c", "4 0t3t3b0b", "8 0m4s8m", "8 0c8c", "4 1s3p",
	"8 ~1n3o5o7m7j 7m7e ~7j4k1j0h1f3e6f7h", "8 0e0s ~0m3o5o8m8g5e2e0h", "7 ~7m5o3o1m0j1g3e5e7g", "8 8e8s ~8m5o3o0m0g3e5e8h", "8 ~0j8j8l6o3o0l0h3e5e7f",
	"6 ~6s4s2q2o 2o2e 0n5n",
	"8 8o8d ~8d7b4a2a0b ~8m5o3o0m0h3f5f8h", "8 0e0s ~0l2n5o7m8j 8j8e", "2 1e1o 1r1s", "4 3o3d ~3d2b0a 3r3s", "8 0e0s 7o0i 3l7e", "2 1e1s",
	"< 0e0o ~0l2o4o6l 6l6e ~6l8o:o<l <l<e",
	"8 0e0o ~0l2n5o7m8j 8j8e", "8 ~4o7n8j7f4e1f0j1n4o", "8 0o0a ~0m3o5o8m8g5e2e0h", "8 8o8a ~8m5o3o0m0g3e5e8h", "5 0e0o ~0l2n5o", "7 ~6m4o2o0m3j6i6f4e2e0f",
	"6 2s2g ~2g3e5e 0o5o",
	"8 8o8e 0o0h ~0h1f3e6f8h", "7 0o4e8o", ": 0o3e5o8e:o", "7 0o7e 7o0e", "8 0o4e 8o4e2b0a", "7 0o7o0e7e", "5 ~5t3s3o1k3h3d5b", "2 1t1b",
	"5 ~0t2s2o4k2h2d0b", "8 ~0j2l5i8k"};

struct pen {
	double (*segment)[4];
	int n;
};

static void draw(struct pen *p, double x0, double y0, double x1, double y1)
{
	if (p->n < PM_STROKES) {
		double *s = p->segment[p->n++];
		s[0] = x0, s[1] = y0, s[2] = x1, s[3] = y1;
	}
}

static void point(const char *s, double at[2])
{
	at[0] = s[0] - '0';
	at[1] = s[1] - 'e';
}

/* Catmull-Rom at t in [0, 1] between b and c. */
static double between(double a, double b, double c, double d, double t)
{
	return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

static void stroke(struct pen *p, const char *s, int n)
{
	bool smooth = *s == '~';
	s += smooth, n = (n - smooth) / 2;
	bool closed = n > 2 && !strncmp(s, s + 2 * (n - 1), 2);
	for (int i = 0; i + 1 < n; i++) {
		double q[4][2], last[2];
		point(s + 2 * (i > 0 ? i - 1 : closed ? n - 2 : 0), q[0]);
		point(s + 2 * i, q[1]), point(s + 2 * (i + 1), q[2]);
		point(s + 2 * (i + 2 < n ? i + 2 : closed ? 1 : n - 1), q[3]);
		last[0] = q[1][0], last[1] = q[1][1];
		for (int k = 1; k <= (smooth ? 4 : 1); k++) {
			double t = smooth ? k / 4.0 : 1, x = between(q[0][0], q[1][0], q[2][0], q[3][0], t), y = between(q[0][1], q[1][1], q[2][1], q[3][1], t);
			draw(p, last[0], last[1], x, y);
			last[0] = x, last[1] = y;
		}
	}
}

int pm_lettering(char c, double segments[PM_STROKES][4], double *width)
{
	const char *s = letters[(c < ' ' || c > '~' ? '?' : c) - ' '];
	struct pen p = {segments, 0};
	*width = *s++ - '0' + 3;
	while (*s) {
		int n = (int)strcspn(++s, " ");
		stroke(&p, s, n);
		s += n;
	}
	return p.n;
}
