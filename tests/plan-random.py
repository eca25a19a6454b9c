#!/usr/bin/env python3
"""Frames drawn at random over scenes, options, accuracies and times, each run by its plan and by the plan for a tenth of the accuracy: does plan
keep its word? A line for each frame, and the sum.

    python3 tests/plan-random.py [COUNT [SEED [FIRST]]]     PM_BIN: the directory of the programs; PM_ONLY: draw from this scene alone

The error of a run is the difference of the two at the end, l2 over the particles, relative to the largest l2 norm of the finer run at five times:
of velocities where particles have inertia, else of displacements, or of the vorticity on the scene's mesh where particles represent it.
  within   at most the accuracy asked for
  warned   more, but plan refused the frame, or said at its top that something is missing
  near     up to three times the accuracy, without a word
  WRONG    more than that, without a word
  dear     a run takes more than PM_LONGEST seconds (60): not counted
Exit 1 if a frame is WRONG, or fewer than 95 % of those counted are within or warned.
SPDX-License-Identifier: GPL-3.0-or-later
"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ENV = dict(os.environ, PATH=os.environ.get("PM_BIN", TOP + "/bin") + ":" + os.environ["PATH"], LC_ALL="C")
LONGEST = float(os.environ.get("PM_LONGEST", "60"))
LATTICES = ("cone-vortex", "ellipse", "lamb-oseen", "shear-layer", "taylor-green-2d")  # their particles represent a vorticity
POINTS = ("point-vortices", "polygon", "vortex-pair")


def draw(r):
    """A scene with options, and the end of a run that means something for it."""

    def log(low, high):
        return float("%.3g" % math.exp(r.uniform(math.log(low), math.log(high))))

    def some(option, *values):
        return [option, r.choice(values)]

    def real(option, low, high):
        return [option, "%g" % log(low, high)]

    def whole(option, low, high):
        return [option, "%d" % log(low, high)]

    def seed():
        return ["--seed", str(r.randrange(1, 1000))]

    def soft():
        return real("--softening", 0.003, 0.1)

    scenes = {
        "cold-collapse": lambda: (whole("-n", 256, 4096) + some("--cells", "16", "32", "64") + real("--amplitude", 0.01, 0.3), log(0.3, 2.5)),
        "cold-sphere": lambda: (whole("-n", 50, 1000) + some("--cells", "16", "32") + soft() + seed(), log(0.2, 1)),
        "cone-vortex": lambda: (some("--cells", "32", "48", "64"), log(0.02, 0.3)),
        "ellipse": lambda: (some("--cells", "32", "64") + some("--nu", "0", "1e-4", "5e-4", "1e-2"), log(0.1, 2)),
        "exb": lambda: (real("--electric-field", 0.01, 1), log(1, 50)),
        "gyration": lambda: (real("--magnetic-field", 0.1, 10), log(1, 50)),
        "kepler": lambda: (some("--eccentricity", "0", "0.3", "0.9", "0.97", "0.99", "0.999"), log(1, 40)),
        "lamb-oseen": lambda: (some("--cells", "24", "32", "64") + some("--nu", "1e-4", "1e-3", "0.01", "0.05"), log(1.2, 4)),
        "landau": lambda: (whole("-n", 1000, 20000) + some("--cells", "16", "32", "64") + real("--wavenumber", 0.1, 1) + real("--amplitude", 0.005, 0.3)
                           + some("--loading", "lattice", "random", "sobol"), log(2, 30)),
        "langmuir": lambda: (whole("-n", 200, 4096) + some("--cells", "8", "16", "32", "64") + real("--amplitude", 0.001, 0.5), log(2, 100)),
        "lattice": lambda: (some("-n", "64", "512", "4096") + some("--cells", "16", "32"), log(0.5, 5)),
        "pair": lambda: (whole("--length", 10, 30) + real("--m2", 0.1, 100), log(0.3, 20)),
        "plummer": lambda: (whole("-n", 100, 2000) + some("--cells", "16", "32") + soft() + seed(), log(0.3, 4)),
        "point-vortices": lambda: (whole("-n", 10, 2000) + some("--cells", "16", "32") + soft() + seed(), log(0.05, 2)),
        "polygon": lambda: (whole("-n", 2, 12), log(2, 60)),
        "shear-layer": lambda: (some("--cells", "32", "64", "128") + some("--rho", "30", "80") + some("--nu", "0", "1e-4", "1e-3"), log(0.1, 0.8)),
        "taylor-green-2d": lambda: (some("--cells", "16", "32", "64") + some("--nu", "0", "1e-3", "0.01", "0.1"), log(0.5, 5)),
        "two-body": lambda: (["--eccentricity", "%.2g" % r.uniform(0, 0.98)] + real("--ratio", 1e-6, 1), log(1, 60)),
        "two-stream": lambda: (["-n", str(2 * int(log(250, 4000)))] + some("--cells", "32", "64") + real("--v0", 0.3, 1.6) + some("--vth", "0", "0.05", "0.3"),
                               log(2, 30)),
        "uniform": lambda: (whole("-n", 20, 2000) + some("--dim", "2", "3") + some("--cells", "8", "16", "32") + soft() + seed()
                            + some("--mass-spread", "0", "2"), log(0.05, 1)),
        "vortex-pair": lambda: (["--circulation2", "%.3g" % r.uniform(-2, 2)] + real("--distance", 0.3, 3), log(1, 60)),
    }
    name = os.environ.get("PM_ONLY") or r.choice(sorted(scenes))
    options, end = scenes[name]()
    return name, options, end


class Dear(Exception):
    """A run that takes too long."""


def run(words, source=os.devnull, to=None, allow=(0,)):
    """Runs a program; to: a file for its output. Its exit status, output and messages."""
    with open(source, "rb") as take, open(to or os.devnull, "wb") as give:
        try:
            p = subprocess.run(words, stdin=take, stdout=give if to else subprocess.PIPE, stderr=subprocess.PIPE, env=ENV, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            raise Dear from None
    said = p.stderr.decode().strip()
    if p.returncode not in allow:
        raise RuntimeError("%s: exit %d: %s" % (words[0], p.returncode, said[-300:]))
    return p.returncode, "" if to else p.stdout.decode(), said


def plan(start, end, accuracy):
    """The sentence (None: refused), and what plan says at its top."""
    status, text, said = run(["plan", "--format", "json", "--no-cost", "-t", repr(end), "--accuracy", repr(accuracy)], start, allow=(0, 1, 3))
    if status:
        return None, [said]
    answer = json.loads(text)
    lacks = answer["warnings"] + [answer[k] for k in ("not_promised",) if k in answer]
    return answer["sentence"], lacks + [w["words"].split()[0] for w in answer["stages"] if "more than asked for" in w["reason"]]


def norms(field, where, a, b):
    """Root mean square of the difference of a field of two streams, and of the field in b."""
    _, text, _ = run(["scmp", "--field", field, "--set", where, a, b])
    names, values = (line.split("\t") for line in text.splitlines()[:2])
    row = dict(zip(names, values))
    l2, relative = float(row["l2"]), float(row["relative_l2"])
    return l2, l2 / relative if relative > 0 else 0.0


def on_scene_mesh(file, h, to):
    """Vorticity on cells as wide as those of the scene."""
    head = json.loads(run(["sls", "--format", "json"], file)[1].splitlines()[0])
    cells = [round((high - low) / w) for low, high, w in zip(head["box"]["lo"], head["box"]["hi"], h)]
    run(["p2m", "--kernel", "m6prime", "-n", "x".join(map(str, cells))], file, to)
    head = json.loads(run(["sls", "--format", "json"], to)[1].splitlines()[0])
    table = {}
    for line in run(["stab", "--plain", "--mesh", head["meshes"][0]["name"]], to)[1].splitlines()[1:]:
        *place, omega = map(float, line.split("\t"))
        table[tuple(round(x / w * 2) for x, w in zip(place, h))] = omega
    return table


def last_step(sentence):
    """Steps that plan chose end at the time; others are made to."""
    return [] if "--dt" in sentence or "dt --" in sentence else ["--exact"]


def error_of(name, end, begun, sentence, finer, at):
    """The error of a sentence, by a finer one."""
    head = json.loads(run(["sls", "--format", "json"], at("start"))[1].splitlines()[0])
    where = next(s["name"] for s in head["sets"] if not s.get("fixed"))
    inertia = name not in LATTICES + POINTS
    largest = 0.0
    before = at("start")
    for quarter in (1, 2, 3, 4):
        now = at("finer%d" % quarter)
        run(["cycle", "-t", repr(begun + (end - begun) * quarter / 4), *last_step(finer), finer], before, now)
        if name not in LATTICES:
            largest = max(largest, norms("v" if inertia else "x", where, at("start"), now)[int(inertia)])
        before = now
    run(["cycle", "-t", repr(end), *last_step(sentence), sentence], at("start"), at("end"))
    if name in LATTICES:
        a, b = (on_scene_mesh(file, head["meshes"][0]["h"], at("mesh")) for file in (at("end"), before))
        both = set(a) | set(b)
        return math.sqrt(sum((a.get(k, 0) - b.get(k, 0)) ** 2 for k in both) / sum(b.get(k, 0) ** 2 for k in both))
    if inertia:
        largest = max(largest, norms("v", where, before, at("start"))[1])
    difference = norms("v" if inertia else "x", where, at("end"), before)[0]
    return difference / largest if largest > 0 else 0.0 if difference == 0 else math.inf


def frame(number, seed, at):
    """Verdict, error and description of one frame."""
    r = random.Random("%d:%d" % (seed, number))
    name, options, end = draw(r)
    accuracy = r.choice([0.1, 0.03, 0.01, 0.003, 0.001])
    told = "pinit %s; -t %g --accuracy %g" % (" ".join([name, *options]), end, accuracy)
    lacks, sentence = [], None
    try:
        run(["pinit", name, *options], to=at("start"))
        begun = json.loads(run(["sls", "--format", "json"], at("start"))[1].splitlines()[0])["time"]
        sentence, lacks = plan(at("start"), end, accuracy)
        if sentence is None:
            return "warned", math.nan, told + "  # " + lacks[0]
        finer, why = plan(at("start"), end, accuracy / 10)
        if finer is None:
            return "dear", math.nan, told + "  # the tenth is refused: " + why[0]
        error = error_of(name, end, begun, sentence, finer, at)
    except Dear:
        return "dear", math.nan, told
    except RuntimeError as e:
        return "warned" if lacks else "WRONG", math.nan, told + "  # " + str(e)
    verdict = "within" if error <= accuracy else "warned" if lacks else "near" if error <= 3 * accuracy else "WRONG"
    told += "  # needs " + ", ".join(lacks) if lacks else ""
    return verdict, error, told + ("  # " + sentence + "  # against: " + finer if verdict in ("near", "WRONG") else "")


def main():
    count, seed, first = (int(a) for a in (sys.argv[1:] + ["20", "1", "1"][len(sys.argv) - 1:]))
    total = dict.fromkeys(("within", "warned", "near", "WRONG", "dear"), 0)
    with tempfile.TemporaryDirectory() as work:
        for number in range(first, first + count):
            verdict, error, told = frame(number, seed, lambda file: os.path.join(work, file))
            total[verdict] += 1
            print("%d:%-4d %-6s %9.2g  %s" % (seed, number, verdict, error, told), flush=True)
    counted = count - total["dear"]
    kept = total["within"] + total["warned"]
    print("%d frames of seed %d: %s; %.1f %% of %d within the accuracy, refused or warned of" % (
        count, seed, ", ".join("%d %s" % (v, k) for k, v in total.items()), 100 * kept / max(counted, 1), counted))
    return 1 if total["WRONG"] or kept < 0.95 * counted else 0


if __name__ == "__main__":
    sys.exit(main())
