#!/usr/bin/env python3
"""Sentences drawn at random, each run alone and rehearsed with several ranks and threads: output, messages and exit code are equal, byte for byte.

    python3 tests/ranks-random.py [COUNT [SEED [FIRST]]]     PM_BIN: the directory of the programs

One in four runs is cut in the middle and resumed with another number of ranks; inputs and outputs are files or pipes, by chance. Prints what differs, with
a command for each, and the sum: equal, of these refused (alone, too), DIFFERENT, HANGS. Exit 1 if any differs or hangs, or more than a third is refused.
SPDX-License-Identifier: GPL-3.0-or-later
"""
import os
import random
import shlex
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ENV = dict(os.environ, PATH=os.environ.get("PM_BIN", TOP + "/bin") + ":" + os.environ["PATH"], LC_ALL="C", OMP_WAIT_POLICY="passive", PM_REHEARSE="one-thread")
SAID = []  # by the run alone
LONGEST = 60  # [s] of a run; one that takes more hangs


def draw(r):
    """The command that makes the frame, and the words of a step."""

    def maybe(p, *words):
        return " " + " ".join(words) if r.random() < p else ""

    def pick(*values):
        return r.choice(values)

    def count(*small):
        return pick(*small, 1, 2, 4095, 4096, 4097, 8191, 9000) if r.random() < 0.4 else pick(*small)

    def cells(dim, *sides):
        return "x".join(str(pick(*sides)) for _ in range(dim)) if r.random() < 0.5 else str(pick(*sides))

    def solver(dim, periodic):
        fft = "poisson-fft" + maybe(0.2, "--symbol", pick("fd2", "fd4")) if periodic else "poisson-fft" + maybe(0.2, "--open-faces sum")
        fft += maybe(0.15, "--influence optimal") if periodic and "--symbol" not in fft else ""
        given = maybe(0.25, "--dirichlet", pick("'1 + 0.1*x'", "'x*x + time'", "2")) if not periodic else ""
        if not periodic and r.random() < 0.6:
            return fft + (given if "sum" not in fft else "")
        if given:
            return pick("poisson-fft", "poisson-mg", "poisson-mg --order 4", "poisson-relax --tolerance 1e-3") + given
        if r.random() < 0.15:
            return "poisson-mg --coarse galerkin --tolerance 1e-3" if periodic else "poisson-fft --free-space james"
        return pick(fft, fft, "poisson-mg" + maybe(0.3, "--cycle", pick("v", "w", "fmg")) + maybe(0.2, "--order 4"),
            "poisson-relax --tolerance 1e-3 --method " + pick("red-black", "red-black-sor", "cg", "weighted-jacobi"))

    def force(dim, periodic, *sides):
        kernel = maybe(0.3, "-k", pick("cic", "tsc", "pcs", "ngp"))
        filtered = maybe(0.15, "| smooth", pick("", "--passes 2"))
        if periodic and r.random() < 0.15:
            return f"p2m -n {cells(dim, *sides)}{maybe(0.3, '-k', pick('tsc', 'pcs'))}{filtered} | {solver(dim, periodic)} | m2p --energy-conserving"
        return (f"p2m -n {cells(dim, *sides)}{kernel}{maybe(0.15, '--interlace') if periodic else ''}{filtered} | {solver(dim, periodic)} | "
            f"mgrad{maybe(0.4, '--order', pick('2', '4', '6', *(['spectral'] if periodic else [])))} | m2p")

    def around(f, second=True):
        leap = f"push kick/2 drift | {f} | push kick/2"
        return pick(leap, leap, f + " | push " + pick("rk2", "rk4", "lsrk3", "ab2", "yoshida4", "midpoint")) if second else \
            f + " | push " + pick("rk2", "rk4", "lsrk3", "ab3", "euler", "midpoint")

    def more(words):
        """Words that may stand behind a whole step, or before it."""
        words += maybe(0.15, "| ssort" + maybe(0.5, "--every 2"))
        words += maybe(0.12, "| walk --nu 0.01")
        words += maybe(0.12, "| scalc 'k = floor(9*x) + n'")
        words += maybe(0.08, "| scalc 'side = floor(7*x)' | scalc --total --per side 'all = 1/3 + x' 'w = x, 0.1'")
        words += maybe(0.15, "| diag --tee table", pick("--columns mass,momentum_x,energy_kinetic", "", "--field-errors"))
        return words

    def gravity():
        dim, periodic = pick(1, 2, 3), r.random() < 0.5
        faces = f" | smod --faces {pick('wall', 'open')} --particle-faces {pick('reflect', 'absorb')}" if not periodic else ""
        scene = f"pinit uniform -n {count(50, 300)} --dim {dim} --dispersion 0.3 --dt 0.05 --seed {r.randrange(99)}{faces}"
        sides = {1: (16, 33, 100), 2: (8, 17, 20), 3: (4, 7, 12, 15)}[dim]
        return scene, more(maybe(0.15, "dt --courant 0.3 --max 0.1 |") + " " + around(force(dim, periodic, *sides)))

    def cluster():
        soft = maybe(0.3, "--softening 0.05")
        pairs = "pp" + soft + maybe(0.4, "--loop full") + maybe(0.3, "--potential")
        rates = pick("acc = 0.1*cos(time)*x, -0.1*y, -0.2*z", "acc = -x, -y, vx")
        return f"pinit plummer -n {count(20, 200, 500)} --seed {r.randrange(99)}", maybe(0.15, "dt --oscillation 0.1 --acceleration 0.02 --softening 0.1 |") + \
            more(around(pick(pairs, pairs + f" | field '{rates}'", f"field '{rates}'", force(3, False, 8, 15, 16))))

    def plasma():
        if r.random() < 0.3:
            return f"pinit {pick('gyration', 'exb')} -n {count(7, 60)}", more("push boris/2 drift | m2p | push boris/2")
        dim = pick(1, 1, 2)
        n = count(500, 900)
        scene = f"pinit two-stream -n {max(2, n)} --vth 0.1 --amplitude 0.1"
        if dim == 2:
            scene = f"pinit langmuir --dim 2 --axes 2 -n {pick(100, 961, 9025)} --amplitude 0.3"
        return scene, more(maybe(0.15, "dt --plasma 0.1 |") + " " + around(force(dim, True, *((33, 64, 35) if dim == 1 else (16, 17, 24)))))

    def two_sets():
        other = f"pinit uniform -n {count(30, 200)} --seed 7 | smod --rename matter=probes"
        scene = f"pinit uniform -n {count(30, 300)} --dispersion 0.2 --dt 0.05 >one.pm; {other} >two.pm; stack one.pm two.pm"
        return scene, more(around(force(3, True, 6, 9, 12)))

    def vortices():
        scene = pick(f"pinit lamb-oseen --cells {pick(16, 24, 33)}", f"pinit ellipse --cells {pick(16, 32)}", f"pinit shear-layer --cells {pick(16, 32)}",
            f"pinit taylor-green-2d --cells {pick(16, 70)}", f"pinit polygon -n {pick(3, 7)} --disturbance 1e-3")
        if "polygon" in scene:
            return scene, more("pp" + maybe(0.3, "| field 'dcirculation = -0.1*circulation'") + " | push " + pick("rk4", "rk2", "ab3"))
        kernel = maybe(0.5, "--kernel m6prime")
        body = maybe(0.2, "| penalize --body 'hypot(x - 0.5, y) - 0.4' --velocity '1, 0.1*y'")
        words = f"p2m{kernel} | poisson-fft | mgrad{maybe(0.3, '--order', pick('2', '4', '6'))}{body} | "
        within = f"'hypot(x - {pick(0.1, 0.4)}, y) < {pick(0.15, 0.3)}'"
        words += pick("diffuse | m2p", "dt --lcfl 0.2 | diffuse | m2p", "m2p | pse", "m2p | pse --order 4", "m2p", f"m2p --mask {within}")
        words += " | push " + pick("rk2", "lsrk3", "rk4")
        return scene, words + pick("", " | walk", " | remesh --cut-off 1e-6", " | remesh --kernel m6prime --cut-off 1e-6 | ssort",
            f" | remesh --cut-off 1e-6 --mask {within}")

    def space():
        scene = pick("pinit taylor-green-3d --cells 8", "pinit vortex-ring --cells 12", "pinit taylor-green-3d --cells 17")
        orders = ("2", "4", "6") + (("spectral",) if "green" in scene else ())
        form = maybe(0.4, "--form", pick("classical", "transpose", "mixed")) + maybe(0.4, "--order", pick(*orders))
        return scene, f"p2m | poisson-fft | mgrad | stretch{form} | diffuse{maybe(0.4, '--order', pick(*orders))} | m2p | push " + \
            pick("lsrk3", "rk2") + maybe(0.3, "| remesh")

    def medium():
        dim = pick(2, 3)
        faces = pick("", f" --faces {','.join(pick('wall', 'neumann') for _ in range(2 * dim))} --particle-faces reflect")
        eps = pick("1 + x*x", "x + y < 0.9 ? 1 : 100", "1 + time + rho*rho")
        solver = f"poisson-mg --permittivity eps --tolerance 1e-3{maybe(0.3, '--cycle', pick('v', 'w'))}{maybe(0.2, '--mean arithmetic')}"
        return f"pinit uniform -n {count(50, 300)} --dim {dim} --dispersion 0.3 --dt 0.05{faces}", \
            more(f"push drift --open | p2m -n {cells(dim, 4, 7, 9, 16)} | scalc --mesh mesh 'eps = {eps}' | {solver} | mgrad | m2p | push kick")

    def light():
        dim, method = pick(1, 2, 3), pick("yee", "fourth", "cole-karkkainen", "psatd")
        scene = f"pinit langmuir --dim {dim} --axes {dim} -n {pick(4, 7, 17) ** dim} --amplitude 0.3 --velocities 3 | smod --law electromagnetic --dt 0.02 | "
        scene += f"p2m -n {cells(dim, 5, 8, 11, 17)} | maxwell --gauss --method {method} | sel --drop rho"
        step = f"push boris/2 | p2m --current | maxwell --method {method} | push drift | m2p | push boris/2"
        waves = method == "psatd"
        return scene, more(step + maybe(0.4, "| p2m | maxwell --gauss --method", method) + (maybe(0.2, "| p2m | maxwell --marder 2") if not waves else ""))

    def free():
        scene = f"pinit uniform -n {count(0, 1001, 13000)} --dim {pick(1, 2, 3)} --dispersion {pick(0.3, 1)} --dt 0.1"
        scene += pick("", " | smod --faces open --particle-faces absorb", " | smod --faces wall --particle-faces reflect")
        return scene, more("push drift")

    return r.choice([gravity, gravity, cluster, cluster, plasma, two_sets, vortices, vortices, space, light, medium, free])()


def run(command, directory, threads):
    env = dict(ENV, OMP_NUM_THREADS=str(threads))
    try:
        done = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=directory, env=env, capture_output=True, timeout=LONGEST)
    except subprocess.TimeoutExpired:
        return None
    return done.returncode, done.stdout, done.stderr


def read(path):
    try:
        with open(path, "rb") as f:
            return f.read()
    except FileNotFoundError:
        return None


def apart(r, scene, directory):
    """"", or what differs where ranks make the scene, or do one word of its frame from file to file."""
    single = scene.startswith("pinit") and "|" not in scene and ";" not in scene
    word = r.choice(["push drift", "ssort", "scalc 'k = floor(9*x) + n'", "sel --where 'x < 0.4'", "diag"])
    ranks = r.choice([2, 3, 4, 5, 7])
    commands = [(f"{word} -i start.pm -o {{}}", f"{word} --ranks {ranks} -i start.pm -o {{}}")]
    if single:
        commands.append((f"{scene} -o {{}}", f"{scene} --ranks {ranks} -o {{}}"))
    for alone, shared in commands:
        want, got = run(alone.format("one.out"), directory, 1), run(shared.format("other.out"), directory, r.choice([1, 2]))
        if got is None or want is None:
            return f"HANGS: {{ {scene}; }} >start.pm; {shared}"
        if got != want or (want[0] == 0 and read(directory + "/one.out") != read(directory + "/other.out")):
            return f"DIFFERENT: {{ {scene}; }} >start.pm; {shared}"
    return ""


def one(r, directory):
    """"" if all ways are equal, "refused" if they are and the run alone failed, else what differs."""
    scene, words = draw(r)
    steps, store, every = r.choice([2, 3, 4]), r.choice(["", " --store all", " --store f32"]), r.choice(["", " --every 1"])
    run(f"{scene} --no-history >start.pm" if ";" not in scene and "|" not in scene else f"{{ {scene}; }} >start.pm", directory, 1)
    differs = apart(r, scene, directory) if r.random() < 0.3 else ""
    if differs:
        return differs
    sentence = f"{shlex.quote(words)}"
    common = f"-q -n {steps}{store}{every} --no-history"

    def results(said):
        return said, read(directory + "/out.pm"), read(directory + "/table")

    def clean():
        for name in ("out.pm", "table", "half.pm"):
            if os.path.exists(directory + "/" + name):
                os.remove(directory + "/" + name)

    def complete(ranks, files, again):
        into, out = (" -i start.pm", " -o out.pm") if files else (" <start.pm", " >out.pm")
        clean()
        if not again:
            return f"cycle{ranks} {common}{out} {sentence}{into}"
        first = common.replace(f"-n {steps}", "-n 1").replace(every, "") if every else common.replace(f"-n {steps}", "-n 1")
        rest = common.replace(every, "") if every else common
        return f"cycle{ranks} {first} --checkpoint half.pm {sentence}{into} >{os.devnull} && cycle{again} {rest} --resume half.pm{out} {sentence}"

    resumed = r.random() < 0.25 and "diag" not in words
    alone = complete("", r.random() < 0.5, " " if resumed else "")
    if resumed:
        alone = alone.replace("cycle  ", "cycle ")
    want = results(run(alone, directory, 1))
    if want[0] is None:
        return f"HANGS alone: {scene} | {alone}"
    SAID[:] = [want[0][2].decode().strip()]
    if want[0][0] == 0 and not (want[1] and len(want[1]) > 1000):
        return f"DIFFERENT: nothing was written: {scene} | {alone}"
    for _ in range(2):
        ranks, threads, files = r.choice([2, 3, 4, 5, 7]), r.choice([1, 2]), r.random() < 0.5
        command = complete(f" --ranks {ranks}", files, f" --ranks {r.choice([2, 3, 5])}" if resumed else "")
        got = results(run(command, directory, threads))
        told = f"OMP_NUM_THREADS={threads}: {{ {scene}; }} >start.pm; {command}"
        if got[0] is None:
            return "HANGS: " + told
        if got[0] != want[0]:
            return f"DIFFERENT exit or words ({got[0][0]}, alone {want[0][0]}: {got[0][2].decode()!r}, alone {want[0][2].decode()!r}): {told}"
        if want[0][0] == 0 and got[1:] != want[1:]:
            return f"DIFFERENT bytes: {told}"
    return "refused" if want[0][0] else ""


def main():
    count, seed, first = (int(a) for a in (sys.argv[1:] + ["200", "20261123", "0"][len(sys.argv) - 1:])[:3])
    refused = bad = 0
    print(f"{count} sentences, seed {seed}, from number {first}")
    for i in range(first, first + count):
        with tempfile.TemporaryDirectory() as directory:
            said = one(random.Random(f"{seed} {i}"), directory)
        refused += said == "refused"
        if said not in ("", "refused"):
            bad += 1
            print(f"{i}: {said}", flush=True)
        elif said and os.environ.get("PM_SHOW"):
            print(f"{i}: refused: {SAID[-1]}", flush=True)
    print(f"{count - bad} equal, {refused} of them refused, {bad} DIFFERENT or HANGS")
    return bad > 0 or 3 * refused > count


if __name__ == "__main__":
    sys.exit(main())
