#!/usr/bin/env python3
"""Frames of an openPMD file that sh5 wrote, in yt: particles(path) and mesh(path) return datasets of yt with all fields, the axes in the order x, y, z, and
the time. As a program: yt-frames.py FILE.h5 PICTURE.png projects the particles of the last frame.

yt's own reader (yt.load, seen in 4.1.4 and 4.4.3) takes the axes in the order of the file, z first, and returns no particle: yt/frontends/open_pmd/
data_structures.py, _count_grids, looks for species["/position"], a path from the root of the file, and skips the KeyError.
SPDX-License-Identifier: GPL-3.0-or-later"""

import json
import sys

import h5py
import numpy as np
import yt


def values(record, name=None):
    """A component as an array: a dataset, or value and shape where it is constant."""
    part = record[name] if name else record
    return part[()] if isinstance(part, h5py.Dataset) else np.full(part.attrs["shape"], part.attrs["value"])


def components(record):
    """(suffix, array) of each component of a record."""
    if isinstance(record, h5py.Dataset) or "shape" in record.attrs:
        return [("", values(record))]
    return [("_" + name, values(record, name)) for name in record]


def iteration(file, step):
    """The group of a step (default: the last), and the header of its frame."""
    at = file["data"][str(max(map(int, file["data"])) if step is None else step)]
    return at, json.loads(at.attrs["pmpipeHeader"])


def particles(path, step=None):
    """All sets, each as a particle type of its name."""
    data, low, high = {}, np.full(3, np.inf), np.full(3, -np.inf)
    with h5py.File(path, "r") as file:
        at, header = iteration(file, step)
        for name, species in at["particles"].items():
            count = 0
            for record, group in species.items():
                for suffix, array in components(group):
                    count = len(array)
                    if record != "positionOffset":
                        data[name, "particle_" + record + suffix] = array.astype(float)
            for axis, letter in enumerate("xyz"):
                x = data.setdefault((name, "particle_position_" + letter), np.zeros(count))
                low[axis], high[axis] = min(low[axis], x.min(initial=np.inf)), max(high[axis], x.max(initial=-np.inf))
    for axis, (lo, hi) in enumerate(zip(header["box"]["lo"], header["box"]["hi"])):
        low[axis], high[axis] = min(low[axis], lo), max(high[axis], hi)
    high = np.where(high > low, np.nextafter(high, np.inf), low + 1)
    return yt.load_particles(data, bbox=np.stack([low, high], 1), length_unit=1, mass_unit=1, time_unit=1, sim_time=header["time"])


def mesh(path, step=None):
    """The fields of the first mesh; its points are the centres of yt's cells."""
    with h5py.File(path, "r") as file:
        at, header = iteration(file, step)
        own = [f["name"] for f in header["fields"] if f["on"] == header["meshes"][0]["name"]]
        arrays = {n + suffix: a.T for n, group in at["meshes"].items() if n in own for suffix, a in components(group)}
        group = at["meshes"][own[0]].attrs
        h, lo = group["gridSpacing"][::-1], group["gridGlobalOffset"][::-1]
    shape = next(iter(arrays.values())).shape
    more = 3 - len(shape)
    bbox = [[a - d / 2, a + (n - 0.5) * d] for a, d, n in zip(lo, h, shape)] + [[-0.5, 0.5]] * more
    data = {name: array.reshape(shape + (1,) * more).astype(float) for name, array in arrays.items()}
    return yt.load_uniform_grid(data, shape + (1,) * more, bbox=np.array(bbox), length_unit=1, sim_time=header["time"])


if __name__ == "__main__":
    yt.set_log_level("error")
    plot = yt.ParticlePlot(particles(sys.argv[1]), "particle_position_x", "particle_position_y", "particle_mass")
    plot.set_buff_size(160)
    plot.save(sys.argv[2])
