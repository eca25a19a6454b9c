"""A particle-mesh step as it is written in numpy and scipy (cic, periodic, 1/k^2, gradient by centred differences, kick-drift-kick), beside the same step of
cycle on the same particles: seconds of a step, by turns, and how far the accelerations are apart. numpy-step.py CELLS: one particle a cell, one thread.
Without numpy or scipy the row is skipped with a message. SPDX-License-Identifier: GPL-3.0-or-later"""
import os
import struct
import subprocess
import sys
import tempfile
import time

os.environ["OMP_NUM_THREADS"] = "1"
try:
    import numpy as np
    from scipy import fft
except ImportError as problem:
    sys.exit(print(f"bench: skipped the step in numpy ({problem})", file=sys.stderr))


def corners(x, n):
    """The eight points around each particle of a unit box and their weights."""
    u = x * n
    low = np.floor(u).astype(np.int64)
    t = u - low
    for c in range(8):
        up = [(c >> d) & 1 for d in range(3)]
        i, j, k = ((low[d] + up[d]) % n for d in range(3))
        yield (k * n + j) * n + i, np.prod([t[d] if up[d] else 1 - t[d] for d in range(3)], axis=0)


def force(x, mass, n):
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


def step(x, v, acc, mass, n, dt):
    v += dt / 2 * acc
    x = (x + dt * v) % 1
    acc = force(x, mass, n)
    v += dt / 2 * acc
    return x, v, acc


def cycle(steps, sentence, source, target):
    """Seconds of the words in a run."""
    with tempfile.NamedTemporaryFile("r") as times:
        subprocess.run(["cycle", "-q", "-n", str(steps), "--timing", times.name, "-i", source, "-o", target, "--store", "all", sentence], check=True)
        return sum(float(row.split("\t")[2]) for row in times.read().splitlines() if not row.startswith("cycle"))


def main():
    import pmpipe
    n, rounds = int(sys.argv[1]), 3
    sentence = f"push kick/2 drift | p2m --kernel cic -n {n} | poisson-fft | mgrad --order 2 | m2p | push kick/2"
    with tempfile.TemporaryDirectory(dir="/dev/shm") as room:
        start, end = room + "/start.pm", room + "/end.pm"
        subprocess.run(f"pinit uniform -n {n**3} --cells {n} | ssort -o {start}", shell=True, check=True)
        cycle(1, sentence, start, end)
        frame = pmpipe.open(start)[-1]["matter"]
        x, v = (np.array(frame[name].T, order="C") for name in ("x", "v"))
        mass, dt = frame["mass"], 0.01
        acc = force(x, mass, n)
        x, v, acc = step(x, v, acc, mass, n, dt)
        ours = pmpipe.open(end)[-1]["matter"]["acc"].T
        off = np.sqrt(((acc - ours) ** 2).sum() / (ours**2).sum())
        ratios, rates = [], []
        for _ in range(rounds):
            began = time.perf_counter()
            x, v, acc = step(x, v, acc, mass, n, dt)
            theirs = time.perf_counter() - began
            mine = (cycle(4, sentence, start, "/dev/null") - cycle(1, sentence, start, "/dev/null")) / 3
            ratios.append(theirs / mine)
            rates.append((n**3 / mine / 1e6, n**3 / theirs / 1e6))
    middle = sorted(range(rounds), key=ratios.__getitem__)[rounds // 2]
    spread = f"{100 * (max(ratios) - min(ratios)) / ratios[middle]:.0f}%"
    good = "yes" if ratios[middle] >= 8 else "no"
    print("step", f"step of cycle, {n}^3, a particle a cell", 1, f"{rates[middle][0]:.4g}", "M particles/s", spread, "-", "-", "-", "-", "numpy and scipy",
          f"{rates[middle][1]:.4g}", f"{ratios[middle]:.2f}", ">= 8", good, sep="\t")
    print(f"accelerations of the two are {off:.1e} apart (rms, relative)", file=sys.stderr)


if __name__ == "__main__":
    main()
