"""Rows of pmesh's painter on one process, particles in the order of cells: what, kernel, threads, million particles per second. One line and status 1 where
it is not installed. python3 pmesh-painter.py [cells per axis]. SPDX-License-Identifier: GPL-3.0-or-later"""
import statistics
import sys
import time

try:
    import numpy
    from pmesh.pm import ParticleMesh
except ImportError as e:
    sys.exit(f"bench: skipped pmesh ({e})")

cells = int(sys.argv[1]) if len(sys.argv) > 1 else 160
mesh = ParticleMesh(BoxSize=cells, Nmesh=[cells] * 3, dtype="f8")
nodes = numpy.stack(numpy.meshgrid(*[numpy.arange(cells)] * 3, indexing="ij"), -1).reshape(-1, 3)
x = nodes + numpy.random.default_rng(1).random(nodes.shape)
for kernel in ("cic", "tsc", "pcs"):
    seconds = {"spread": [], "gather": []}
    for turn in range(8):
        began = time.process_time()
        rho = mesh.paint(x, resampler=kernel, hold=False)
        between = time.process_time()
        rho.readout(x, resampler=kernel)
        if turn:
            seconds["spread"].append(between - began)
            seconds["gather"].append(time.process_time() - between)
    for way, t in seconds.items():
        print(f"pmesh {way}\t{kernel}\t1\t{len(x) / statistics.median(t) / 1e6:.2f}")
