"""A GADGET snapshot in HDF5 for the tests: gadget.py STEM KIND writes STEM.hdf5, or STEM.0.hdf5 and STEM.1.hdf5, after the published layout (GADGET-2 user
guide, section 6). KIND: isolated (GADGET-2, no units), cosmological (GADGET-2, two files, single precision, z = 3), units (GADGET-4), swift. The numbers follow
from the index, so that the test can compute them anew. SPDX-License-Identifier: GPL-3.0-or-later"""

import sys

import h5py
import numpy as np

kind, stem = sys.argv[2], sys.argv[1]
real = np.float32 if kind == "cosmological" else np.float64


def table(n, first, shift):
    """x[i, c] = first + 0.25 i + 10 c + shift: exact in single precision."""
    i, c = np.arange(n)[:, None], np.arange(3)[None, :]
    return (first + 0.25 * i + 10 * c + shift).astype(real)


def write(name, counts, before, total, files, **header):
    with h5py.File(name, "w") as f:
        h = f.create_group("Header").attrs
        h["NumPart_ThisFile"] = np.array(counts, np.int32)
        h["NumPart_Total"] = np.array(total, np.uint32)
        h["NumPart_Total_HighWord"] = np.zeros(len(counts), np.uint32)
        h["NumFilesPerSnapshot"] = files
        for key, value in header.items():
            h[key] = value
        for t, n in enumerate(counts):
            if not n:
                continue
            g, at = f.create_group(f"PartType{t}"), before[t]
            g["Coordinates"] = table(n, 1, 0.25 * at + t)
            g["Velocities"] = table(n, -3, 0.25 * at + t)
            g["ParticleIDs"] = np.arange(at, at + n, dtype=np.uint32) + 1000 * t
            if header["MassTable"][t] == 0:
                g["DynamicalMasses" if kind == "swift" and t == 5 else "Masses"] = (np.arange(at, at + n) + 1).astype(real)
            if t == 0:
                g.create_dataset("InternalEnergy", data=np.arange(at, at + n, dtype=real) / 8, chunks=(2,), compression="gzip")
                g["Metals"] = np.ones((n, 17))  # more columns than a field can have
                g["Names"] = np.array([b"gas"] * n)
    return name


old = {"MassTable": np.array([0, 0.5, 0, 0, 0, 0.0]), "Redshift": 0.0, "Time": 2.5, "BoxSize": 0.0, "Omega0": 0.0, "OmegaLambda": 0.0, "HubbleParam": 1.0}
counts = [3, 5, 0, 0, 0, 2]
if kind == "isolated":
    write(stem + ".hdf5", counts, [0] * 6, counts, 1, **old)
elif kind == "cosmological":
    more = dict(old, Redshift=3.0, Time=0.25, BoxSize=64.0, Omega0=0.3, OmegaLambda=0.7, HubbleParam=0.7)
    write(stem + ".0.hdf5", [3, 2, 0, 0, 0, 0], [0] * 6, counts, 2, **more)
    write(stem + ".1.hdf5", [0, 3, 0, 0, 0, 2], [3, 2, 0, 0, 0, 0], counts, 2, **more)
elif kind == "units":
    with h5py.File(write(stem + ".hdf5", counts, [0] * 6, counts, 1, **old), "a") as f:
        p = f.create_group("Parameters").attrs
        p["UnitLength_in_cm"], p["UnitMass_in_g"], p["UnitVelocity_in_cm_per_s"], p["ComovingIntegrationOn"] = 3.085678e21, 1.989e43, 1e5, 0
        f["PartType1/ParticleIDs"][0]  # stays
        del f["PartType5/ParticleIDs"]
        f["PartType5/ParticleIDs"] = np.array([7, 2**64 - 1], np.uint64)
elif kind == "swift":
    more = dict(old, Redshift=np.array([1.0]), Time=np.array([0.003]), BoxSize=np.array([64.0, 64.0, 96.0]), Code=np.bytes_("SWIFT"))
    with h5py.File(write(stem + ".hdf5", counts, [0] * 6, counts, 1, **{**more, "Scale-factor": np.array([0.5])}), "a") as f:
        u = f.create_group("Units").attrs
        u["Unit length in cgs (U_L)"], u["Unit mass in cgs (U_M)"], u["Unit time in cgs (U_t)"] = [3.085678e24], [1.98841e43], [3.085678e19]
        f.create_group("Cosmology").attrs["Cosmological run"] = [1]
        f["GasParticles"] = h5py.SoftLink("/PartType0")
