"""HDF5 files through sh5: hdf5.py SECONDS SEED [DIRECTORY] changes bytes of small files that sh5 wrote, and reads them with sh5. The outcome must be exit
status 0, or 1 and one line; never a signal, never a wait. An input that does something else is kept in the directory. libhdf5 itself crashes on such files:
sh5 must survive that. SPDX-License-Identifier: GPL-3.0-or-later"""

import os
import random
import subprocess
import sys
import tempfile
import time

here = os.path.dirname(os.path.abspath(__file__))
programs = os.environ.get("PM_BIN", os.path.join(here, "..", "..", "bin"))
scenes = ["pinit plummer -n 3 --cells 2 -o a.h5", "pinit lamb-oseen --cells 3 | p2m --outside drop | cycle -n 0 'push drift' -o b.h5",
          "printf 'x name\\n0 a\\n' | stab - -o c.h5"]
odd = [0, 1, 2, 3, 7, 8, 0x7F, 0x80, 0xFE, 0xFF]


def seeds():
    for scene in scenes:
        subprocess.run(["bash", "-c", scene], stderr=subprocess.DEVNULL)
    return [open(name, "rb").read() for name in sorted(os.listdir(".")) if name.endswith(".h5")]


def changed(dice, data, others):
    """A few bytes changed, most of them among those that are not zero: most of a small file is empty space."""
    data = bytearray(data)
    used = [i for i, byte in enumerate(data) if byte]
    for _ in range(1 << dice.randrange(5)):
        at, kind = dice.choice(used) + dice.randrange(-1, 2), dice.randrange(6)
        at = min(max(at, 0), len(data) - 1)
        if kind < 2:
            data[at] ^= 1 << dice.randrange(8)
        elif kind == 2:
            data[at] = dice.choice(odd)
        elif kind == 3:
            data[at] = dice.randrange(256)
        elif kind == 4:
            wide = dice.choice([2, 4, 8])
            data[at:at + wide] = bytes([dice.choice([0, 0xFF])]) * len(data[at:at + wide])
        else:
            other, size = dice.choice(others), dice.randrange(1, 64)
            start = dice.randrange(len(other))
            data[at:at + size] = other[start:start + size]
    return bytes(data[:dice.randrange(len(data))] if dice.randrange(20) == 0 else data)


def verdict(path):
    """None, or what is wrong with the way sh5 ended."""
    try:
        done = subprocess.run([os.path.join(programs, "sh5"), path], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=120)
    except subprocess.TimeoutExpired:
        return "it takes more than two minutes"
    lines = done.stderr.count(b"\n")
    if done.returncode not in (0, 1) or lines != done.returncode or (lines and not done.stderr.startswith(b"sh5: ")):
        return f"exit status {done.returncode}, {lines} lines: {done.stderr[:300]!r}"
    return None


def main():
    seconds, seed = float(sys.argv[1]), int(sys.argv[2])
    keep = os.path.abspath(sys.argv[3]) if len(sys.argv) > 3 else None
    os.environ["PM_H5_SECONDS"] = "1"  # of the processor, for one file
    os.environ["PATH"] = programs + os.pathsep + os.environ["PATH"]
    dice, count, end = random.Random(seed), 0, time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        files = seeds()
        if not files:
            sys.exit("hdf5: no file to begin with: is sh5 built?")
        while time.monotonic() < end:
            data, count = changed(dice, dice.choice(files), files), count + 1
            with open("changed.h5", "wb") as out:
                out.write(data)
            why = verdict("changed.h5")
            if why:
                name = os.path.join(keep or here, f"hdf5-{seed}-{count}.h5")
                with open(name, "wb") as out:
                    out.write(data)
                sys.exit(f"hdf5: {why}: {name}")
        os.chdir("/")
    print(f"stat::number_of_executed_units: {count}")


main()
