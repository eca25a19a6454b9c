"""A snapshot of NEMO for the tests: nemo.py KIND writes to standard output, after the manual page filestruct(5NEMO), two snapshots of three bodies.
KIND: f8 (PhaseSpace in double precision), f4 (Position and Velocity in single precision), swapped (f8 in the other byte order), spherical.
SPDX-License-Identifier: GPL-3.0-or-later"""

import struct
import sys

kind = sys.argv[1]
order = ">" if kind == "swapped" else "<"
real = "f" if kind == "f4" else "d"
n, out = 3, sys.stdout.buffer


def item(letter, tag, values=None, *dims):
    """A value, an array, a set ( or its end )."""
    out.write(struct.pack(order + "H", 0x0b92 if dims else 0x0992) + letter.encode() + b"\0")
    if letter != ")":
        out.write(tag.encode() + b"\0")
    if dims:
        out.write(struct.pack(order + "%di" % (len(dims) + 1), *dims, 0))
    if values is not None:
        out.write(values if letter == "c" else struct.pack(order + "%d%s" % (len(values), letter.replace("l", "q")), *values))


text = b"nemo.py f8\0"
item("c", "History", text, len(text))
for k in range(2):
    x = [[0.25 * i + 10 * c + k for c in range(3)] for i in range(n)]
    v = [[-0.5 * i + 3 * c for c in range(3)] for i in range(n)]
    item("(", "SnapShot")
    item("(", "Parameters")
    item("i", "Nobj", [n])
    item("d", "Time", [1.5 + k])
    item(")", "")
    item("(", "Particles")
    item("i", "CoordSystem", [(2 if kind == "spherical" else 1) << 16 | 3 << 8 | 2])
    if k == 0:  # masses that stay the same are written once
        item(real, "Mass", [1.0, 0.5, 0.25], n)
    if kind == "f4":
        item(real, "Position", sum(x, []), n, 3)
        item(real, "Velocity", sum(v, []), n, 3)
    else:
        item(real, "PhaseSpace", sum([a + b for a, b in zip(x, v)], []), n, 2, 3)
    item("i", "Key", [7, 8, -9], n)
    item(real, "Aux", [0.125, 0.25, 0.5], n)
    item("c", "Story", b"abc\0", 4)
    item(")", "")
    item("(", "Diagnostics")
    item("d", "Energy", [1.0, 2.0, 3.0], 3)
    item(")", "")
    item(")", "")
