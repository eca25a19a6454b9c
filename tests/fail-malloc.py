#!/usr/bin/env python3
"""Memory runs out at every place: for each command below allocation number n fails alone, and then every one from n on, for n over all its calls (or every
K-th). Two outcomes are allowed: the bytes of the undisturbed run and exit 0; or a message and exit 1, no other bytes than the beginning of these, zeros
and an abort, and no file left behind. Prints a line a command, and the failures.
  python3 tests/fail-malloc.py [K [NAME...]]    K: every K-th call; NAME: only these commands
SPDX-License-Identifier: GPL-3.0-or-later"""
import os
import re
import subprocess
import sys
import tempfile

top = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
step = "push kick/2 drift | p2m -n 8 | poisson-fft | mgrad | m2p | push kick/2"
prepare = """
pinit plummer -n 40 --seed 3 --dt 0.01 >bodies.pm
p2m -n 8 -i bodies.pm >rho.pm
poisson-fft -i rho.pm >phi.pm
mgrad -i phi.pm >g.pm
m2p -i g.pm >acc.pm
pinit lamb-oseen --cells 12 --nu 1e-3 >vortex.pm
p2m -i vortex.pm >omega.pm
stab -i bodies.pm >bodies.txt
pinit uniform -n 40 --cells 10 | p2m >box.pm
pinit plummer -n 20000 --seed 3 >many.pm
sh5 -o bodies.h5 <bodies.pm
"""
# They run in an empty directory, and may write `out` there. plan is not among them: it prints times.
commands = {
    "pinit": ["pinit", "plummer", "-n", "40", "--seed", "3"],
    "p2m": "p2m -n 8 -i ../bodies.pm",
    "p2m-many": "p2m -n 32 --threads 2 -i ../many.pm",
    "poisson-fft": "poisson-fft -i ../rho.pm",
    "poisson-fft-lattice": "poisson-fft --green lattice -i ../rho.pm",
    "poisson-fft-box": "poisson-fft -i ../box.pm",
    "poisson-mg": "poisson-mg -i ../rho.pm",
    "poisson-mg-box": "poisson-mg --order 4 -i ../box.pm",
    "poisson-relax": "poisson-relax --method cg -i ../box.pm",
    "mgrad": "mgrad -i ../phi.pm",
    "m2p": "m2p -i ../g.pm",
    "push": "push kick drift -i ../acc.pm",
    "push-file": "push kick drift -i ../acc.pm -o out",
    "remesh": "remesh --outside grow -i ../vortex.pm",
    "diag": "diag --pair -i ../bodies.pm",
    "diag-file": "diag -i ../g.pm -o out",
    "pp": "pp -i ../bodies.pm",
    "stab": "stab -i ../bodies.pm",
    "stab-read": "stab ../bodies.txt",
    "cycle": ["cycle", "-n", "2", step, "-i", "../bodies.pm"],
    "cycle-checkpoint": ["cycle", "-n", "2", "--checkpoint", "out", "--until", "energy > 1e9", step, "-i", "../bodies.pm"],
    "cycle-plan": "cycle -n 1 --plan -i ../bodies.pm",
    "cycle-pipes": ["cycle", "-n", "1", "--engine", "pipes", "push kick/2 drift | pp | push kick/2", "-i", "../bodies.pm"],
    "pse": "pse -i ../vortex.pm",
    "diffuse": "diffuse -i ../omega.pm",
    "walk": "walk --nu 1e-3 -i ../vortex.pm",
    "jump": ["jump", "9: x = y, x", "x > 0 ? 1 : 0: x = -x, y", "-i", "../vortex.pm"],
    "scalc-per": ["scalc", "--total", "--per", "mass", "k = 1", "-i", "../bodies.pm"],
    "dt": "dt --courant 0.5 -i ../g.pm",
    "scalc": ["scalc", "a = 2 * x.x + mass", "-i", "../bodies.pm"],
    "sel": ["sel", "--where", "x.x > 0", "-i", "../bodies.pm"],
    "smod": "smod --constant softening=0.1 --law electrostatic -i ../bodies.pm",
    "smove": "smove --shift 0.1,0,0 -i ../bodies.pm",
    "ssort": "ssort -i ../bodies.pm",
    "stack": "stack ../bodies.pm ../bodies.pm",
    "sls": "sls --report -i ../acc.pm",
    "scmp": "scmp ../bodies.pm ../bodies.pm",
    "sdraw": "sdraw --format png -i ../bodies.pm -o out",
    "sh5": "sh5 ../bodies.h5",
    "sh5-write": "sh5 -o out -i ../bodies.pm",
}


def run(words, **more):
    """Its exit status, standard output, the file `out`, standard error, and the other files it left."""
    for name in os.listdir("run"):
        os.unlink(os.path.join("run", name))
    env = {**os.environ, "LD_PRELOAD": os.path.abspath("fail.so"), **more}
    p = subprocess.Popen(words, cwd="run", env=env, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        out, said = p.communicate(timeout=30)
    except subprocess.TimeoutExpired:
        p.kill()
        p.communicate()
        return 124, b"", b"", b"it did not end", []
    left = os.listdir("run")
    file = open("run/out", "rb").read() if "out" in left else b""
    return p.returncode, out, file, said, sorted(set(left) - {"out"})


def cut_short(got, want):
    """The beginning of want, then at most zeros and an abort."""
    n = next((i for i, (a, b) in enumerate(zip(got, want)) if a != b), min(len(got), len(want)))
    start = got.rfind(b"PMPIPE/1 abort", max(0, n - 64))
    rest = got[n:] if start < 0 else got[n:max(start, n)]
    aborted = start < 0 or re.match(rb"PMPIPE/1 abort [123] \d+( [0-9a-f]{8})? *\n[^\n]*\n\Z", got[start:])
    return aborted and not rest.strip(b"\0")


def outcome(status, got, file, said, left, want):
    """A checkpoint that was written stays, whatever becomes of the output behind it."""
    if status == 0 and got == want[1] and file == want[2] and left == want[4]:
        return "same"
    return "message" if status == 1 and said and not left and cut_short(got, want[1]) and cut_short(file, want[2]) else "wrong"


def all_failures(name, words, every):
    if os.path.exists("count"):
        os.unlink("count")
    want = run(words, FAIL_AT="0", FAIL_COUNT=os.path.abspath("count"))
    if want[0]:
        print("%s fails by itself: %s" % (name, want[3]))
        return {"wrong": 1}
    calls = max(int(n) for n in open("count").read().split())
    count = {"same": 0, "message": 0, "wrong": 0}
    for mode in {}, {"FAIL_ON": "1"}:
        for n in range(1, calls + 1, every):
            result = run(words, FAIL_AT=str(n), **mode)
            what = outcome(*result, want)
            count[what] += 1
            if what == "wrong":
                print("  %s: call %d%s: status %d, %d bytes, files %s: %s" % (name, n, " and all behind it" if mode else "", result[0], len(result[1]),
                    result[4], result[3][:160]))
    print("%s: %d calls, %d failures: %d the same bytes, %d a message and exit 1, %d neither" % (name, calls, sum(count.values()), count["same"],
        count["message"], count["wrong"]), flush=True)
    return count


def main():
    every, names = int(sys.argv[1]) if len(sys.argv) > 1 else 1, sys.argv[2:] or list(commands)
    os.environ.update(LC_ALL="C", OMP_NUM_THREADS="1", PATH=os.environ.get("PM_BIN", top + "/bin") + ":" + os.environ["PATH"])
    with tempfile.TemporaryDirectory() as scratch:
        os.chdir(scratch)
        os.mkdir("run")
        os.environ["XDG_CACHE_HOME"] = scratch + "/cache"
        subprocess.run([os.environ.get("CC", "cc").split()[-1], "-O1", "-fPIC", "-shared", "-fno-builtin", "-o", "fail.so", top + "/tests/fail-malloc.c"],
            check=True)
        subprocess.run(["bash", "-e", "-o", "pipefail", "-c", prepare], check=True)
        total = {}
        for name in names:
            words = commands[name]
            for what, n in all_failures(name, words.split() if isinstance(words, str) else words, every).items():
                total[what] = total.get(what, 0) + n
        os.chdir("/")
    print("%d failed allocations, %d with another outcome" % (sum(total.values()), total["wrong"]))
    return total["wrong"] > 0


sys.exit(main())
