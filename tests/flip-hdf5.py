#!/usr/bin/env python3
"""Damages HDF5 files of sh5's and reads them: a bit flipped (or, with --bytes N, N random bytes written) anywhere, one reading each. Counts what came
of it: the same stream; refused, with a message and exit 1; another stream and exit 0, or anything else, which are failures and printed.
  python3 tests/flip-hdf5.py [TRIALS [SEED]] [--bytes N] [--keep DIR]
SPDX-License-Identifier: GPL-3.0-or-later"""
import argparse
import collections
import os
import random
import subprocess
import sys
import tempfile

scenes = ["pinit plummer -n 60 --seed 1 --cells 6 | p2m | poisson-fft | mgrad | m2p",
    "pinit two-stream -n 200 --seed 2 --cells 16 | cycle -n 2 --every 1 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'",
    "pinit lamb-oseen --cells 8 | smod --store f32 | cat - <(pinit two-body)"]


def outcome(sh5, path, want):
    run = subprocess.run([sh5, path], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60, check=False)
    lines = run.stderr.decode(errors="replace").splitlines()
    if run.returncode == 0:
        return "the same stream" if run.stdout == want else "CHANGED", ""
    if run.returncode == 1 and len(lines) == 1 and lines[0].startswith("sh5: ") and b"PMPIPE/1 abort" in run.stdout:
        apart = "ended by signal" in lines[0] or "does not get on" in lines[0]
        return ("HDF5 crashed or hung, said" if apart else "refused"), lines[0]
    return "OTHER", "status %d, %s" % (run.returncode, run.stderr[:200])


def main():
    p = argparse.ArgumentParser()
    p.add_argument("trials", type=int, nargs="?", default=600)
    p.add_argument("seed", type=int, nargs="?", default=1)
    p.add_argument("--bytes", type=int, default=0)
    p.add_argument("--keep")
    o = p.parse_args()
    here = os.path.dirname(os.path.abspath(__file__))
    bin_dir = os.environ.get("PM_BIN", os.path.join(here, "..", "bin"))
    env = dict(os.environ, PATH=bin_dir + ":" + os.environ["PATH"], OMP_NUM_THREADS="1")
    os.environ.update(env, PM_H5_SECONDS=os.environ.get("PM_H5_SECONDS", "2"))
    chance, count, bad = random.Random(o.seed), collections.Counter(), 0
    print("seed %d, %d trials" % (o.seed, o.trials))
    with tempfile.TemporaryDirectory() as scratch:
        files = []
        for k, scene in enumerate(scenes):
            path = os.path.join(scratch, "%d.h5" % k)
            subprocess.run(["bash", "-o", "pipefail", "-c", scene + " | sh5 -o " + path], env=env, check=True)
            files.append((open(path, "rb").read(), subprocess.run(["sh5", path], env=env, check=True, stdout=subprocess.PIPE).stdout))
        for trial in range(o.trials):
            data, want = files[trial % len(files)]
            damaged = bytearray(data)
            # half of the trials in the first 16 KB, where the structure is; the rest anywhere
            reach = min(len(data), 16384) if trial % 2 else len(data)
            for _ in range(max(o.bytes, 1)):
                at = chance.randrange(reach)
                damaged[at] = chance.randrange(256) if o.bytes else damaged[at] ^ 1 << chance.randrange(8)
            path = os.path.join(scratch, "damaged.h5")
            open(path, "wb").write(damaged)
            what, why = outcome("sh5", path, want)
            count[what] += 1
            if what in ("CHANGED", "OTHER"):
                bad += 1
                print("  trial %d: %s %s" % (trial, what, why))
            if o.keep and what not in ("the same stream", "refused"):
                open(os.path.join(o.keep, "%d-%d-%s.h5" % (o.seed, trial, what.split()[0])), "wb").write(damaged)
    for what in sorted(count):
        print("%d %s" % (count[what], what))
    return bad > 0


sys.exit(main())
