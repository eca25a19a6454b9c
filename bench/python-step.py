"""A particle-mesh step as it is written in Python (cic, periodic, 1/k^2, gradient by centred differences, kick-drift-kick), with numpy and scipy and with
pmesh, whose painter, transforms and gathers are compiled C, beside the same step of cycle on the same particles in the order of cells: a row for each, by
turns, in processor time of one thread, and how far the accelerations are apart. python-step.py CELLS: one particle a cell.
What is not installed is skipped with a message. SPDX-License-Identifier: GPL-3.0-or-later"""
import os
import struct
import subprocess
import sys
import tempfile
import time

os.environ["OMP_NUM_THREADS"] = "1"
try:
    import numpy as np
except ImportError as problem:
    sys.exit(print(f"bench: skipped the steps in Python ({problem})", file=sys.stderr))


def corners(x, n):
    """The eight points around each particle of a unit box and their weights."""
    u = x * n
    low = np.floor(u).astype(np.int64)
    t = u - low
    for c in range(8):
        up = [(c >> d) & 1 for d in range(3)]
        i, j, k = ((low[d] + up[d]) % n for d in range(3))
        yield (k * n + j) * n + i, np.prod([t[d] if up[d] else 1 - t[d] for d in range(3)], axis=0)


def numpy_force(x, mass, n):
    from scipy import fft
    rho = np.zeros(n**3)
    for at, weight in corners(x, n):
        rho += np.bincount(at, mass * weight, n**3)
    waves = fft.rfftn(rho.reshape(n, n, n) * n**3)
    k = 2 * np.pi * np.fft.fftfreq(n, 1 / n)
    square = k[:, None, None] ** 2 + k[None, :, None] ** 2 + 2 * np.pi * 2 * np.pi * np.arange(n // 2 + 1)[None, None, :] ** 2
    square[0, 0, 0] = 1
    waves *= -4 * np.pi / square
    waves[0, 0, 0] = 0
    phi = fft.irfftn(waves, (n, n, n))
    acc = np.zeros_like(x)
    for d in range(3):
        g = ((np.roll(phi, 1, 2 - d) - np.roll(phi, -1, 2 - d)) * (n / 2)).ravel()
        for at, weight in corners(x, n):
            acc[d] += weight * g[at]
    return acc


def pmesh_force(x, mass, n, kept={}):
    """Positions and accelerations are arrays of n^3 rows, as pmesh takes them."""
    from pmesh.pm import ParticleMesh
    mesh = kept.setdefault(n, ParticleMesh(BoxSize=1.0, Nmesh=[n] * 3, dtype="f8"))
    waves = mesh.paint(x, mass=mass * n**3, resampler="cic", hold=False).r2c(out=Ellipsis)
    waves.apply(lambda k, v: -4 * np.pi * v / k.normp(zeromode=np.inf), out=Ellipsis)
    acc = np.empty_like(x)
    for d in range(3):
        g = waves.apply(lambda k, v: -1j * np.sin(k[d] / n) * n * v).c2r(out=Ellipsis)
        g.readout(x, resampler="cic", out=acc[:, d])
    return acc


def step(force, x, v, acc, mass, n, dt):
    v += dt / 2 * acc
    x = (x + dt * v) % 1
    acc = force(x, mass, n)
    v += dt / 2 * acc
    return x, v, acc


def cycle(steps, sentence, source, target):
    """Processor seconds of the words in a run."""
    with tempfile.NamedTemporaryFile("r") as times:
        subprocess.run(["cycle", "-q", "-n", str(steps), "--timing", times.name, "-i", source, "-o", target, "--store", "all", sentence], check=True)
        return sum(float(row.split("\t")[3]) for row in times.read().splitlines() if not row.startswith("cycle"))


def beside(name, force, turned, target, n, start, end, rounds=3):
    """The row of one peer; turned: it holds a particle in a row."""
    import pmpipe
    sentence = f"push kick/2 drift | p2m --kernel cic -n {n} | poisson-fft | mgrad --order 2 | m2p | push kick/2"
    frame = pmpipe.open(start)[-1]["matter"]
    x, v = (np.array(frame[f].T if turned else frame[f], order="C") for f in ("x", "v"))
    if x.shape[0] == 3 and turned or x.shape[0] != 3 and not turned:
        x, v = x.T.copy(), v.T.copy()
    mass, dt = np.array(frame["mass"]), 0.01
    acc = force(x, mass, n)
    x, v, acc = step(force, x, v, acc, mass, n, dt)
    ours = np.asarray(pmpipe.open(end)[-1]["matter"]["acc"])
    off = np.sqrt(((acc - (ours if ours.shape == acc.shape else ours.T)) ** 2).sum() / (ours**2).sum())
    ratios, rates = [], []
    for _ in range(rounds):
        began = time.process_time()
        x, v, acc = step(force, x, v, acc, mass, n, dt)
        theirs = time.process_time() - began
        mine = (cycle(4, sentence, start, "/dev/null") - cycle(1, sentence, start, "/dev/null")) / 3
        ratios.append(theirs / mine)
        rates.append((n**3 / mine / 1e6, n**3 / theirs / 1e6))
    middle = sorted(range(rounds), key=ratios.__getitem__)[rounds // 2]
    spread = f"{100 * (max(ratios) - min(ratios)) / ratios[middle]:.0f}%"
    good = "yes" if ratios[middle] >= target else "no"
    print("step", f"step of cycle, {n}^3, a particle a cell", 1, f"{rates[middle][0]:.4g}", "M particles/s", spread, "-", "-", "-", "-", name,
          f"{rates[middle][1]:.4g}", f"{ratios[middle]:.2f}", f">= {target}", good, sep="\t", flush=True)
    print(f"accelerations of cycle and {name} are {off:.1e} apart (rms, relative)", file=sys.stderr)


def main():
    n = int(sys.argv[1])
    sentence = f"push kick/2 drift | p2m --kernel cic -n {n} | poisson-fft | mgrad --order 2 | m2p | push kick/2"
    with tempfile.TemporaryDirectory(dir="/dev/shm") as room:
        start, end = room + "/start.pm", room + "/end.pm"
        subprocess.run(f"pinit uniform -n {n**3} --cells {n} | ssort -o {start}", shell=True, check=True)
        cycle(1, sentence, start, end)
        for name, force, turned, target in (("numpy and scipy", numpy_force, False, 8), ("pmesh", pmesh_force, True, 3)):
            try:
                beside(name, force, turned, target, n, start, end)
            except ImportError as problem:
                print(f"bench: skipped the step in {name} ({problem})", file=sys.stderr)


if __name__ == "__main__":
    main()
