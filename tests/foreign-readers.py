"""What other programs see in a run: foreign-readers.py PROGRAM FILE prints the time, then a line `x y z vx vy vz mass` per particle in the order of their
identities, then a line `x y z rho gx gy gz` per point of the mesh, x fastest; all of the last frame. PROGRAM: paraview (under pvbatch), openpmd-api,
openpmd-viewer, yt (docs/yt-frames.py). SPDX-License-Identifier: GPL-3.0-or-later"""

import importlib.util
import os
import shutil
import sys
import tempfile

import numpy as np

program, path = sys.argv[1:3]


def lines(*columns):
    for row in zip(*columns):
        print(*["%.17g" % float(v) for v in row])


def points(lo, h, shape):
    """Coordinates of all points, x fastest; lo, h, shape by x, y, z."""
    axes = [lo[a] + h[a] * np.arange(shape[a]) for a in range(3)]
    return [g.ravel(order="F") for g in np.meshgrid(*axes, indexing="ij")]


def by_id(ids, *columns):
    order = np.argsort(ids)
    return [np.asarray(c)[order] for c in columns]


def paraview():
    from paraview import servermanager
    from paraview.simple import PVDReader
    from vtk.util.numpy_support import vtk_to_numpy
    reader = PVDReader(FileName=path)
    time = list(reader.TimestepValues)[-1]
    reader.UpdatePipeline(time)
    cloud, image = (servermanager.Fetch(reader).GetBlock(k) for k in (0, 1))
    cloud, image = (b.GetBlock(0) if b.IsA("vtkMultiBlockDataSet") else b for b in (cloud, image))
    print("%.17g" % time)
    x, field = vtk_to_numpy(cloud.GetPoints().GetData()), lambda on, name: vtk_to_numpy(on.GetPointData().GetArray(name))
    lines(*by_id(field(cloud, "id"), *x.T, *field(cloud, "v").T, field(cloud, "mass")))
    lines(*points(image.GetOrigin(), image.GetSpacing(), image.GetDimensions()), field(image, "rho"), *field(image, "g").T)


def openpmd_api():
    import openpmd_api as io
    series = io.Series(path, io.Access.read_only)
    it = series.iterations[max(series.iterations)]
    p, scalar = it.particles["matter"], io.Record_Component.SCALAR
    load = [p[r][c] for r in ("position", "positionOffset", "velocity") for c in "xyz"] + [p["mass"][scalar], p["id"][scalar]]
    rho, g = it.meshes["rho"], it.meshes["g"]
    assert rho.data_order == "C" and rho.axis_labels == ["z", "y", "x"], (rho.data_order, rho.axis_labels)
    assert p["velocity"].unit_dimension[:3] == [1, 0, -1] and p["mass"].unit_dimension[:3] == [0, 1, 0]
    assert rho.unit_dimension[:3] == [-3, 1, 0] and g.unit_dimension[:3] == [1, 0, -2]
    grids = [rho[scalar], g["x"], g["y"], g["z"]]
    factors = [c.unit_SI for c in load + grids]
    arrays = [c.load_chunk() for c in load + grids]
    series.flush()
    a = [u * v for u, v in zip(factors, arrays)]
    print("%.17g" % (it.time * it.time_unit_SI))
    lines(*by_id(a[10], a[0] + a[3], a[1] + a[4], a[2] + a[5], *a[6:10]))
    unit = rho.grid_unit_SI
    low, h = ([unit * v for v in values[::-1]] for values in (rho.grid_global_offset, rho.grid_spacing))
    lines(*points(low, h, a[11].shape[::-1]), *[v.ravel() for v in a[11:]])


def openpmd_viewer():
    from openpmd_viewer import OpenPMDTimeSeries
    with tempfile.TemporaryDirectory() as folder:  # it reads directories
        shutil.copy(path, folder)
        series = OpenPMDTimeSeries(folder, backend="h5py")
        step = series.iterations[-1]
        p = series.get_particle(["x", "y", "z", "velocity/x", "velocity/y", "velocity/z", "mass", "id"], species="matter", iteration=step)
        rho, info = series.get_field("rho", iteration=step)
        g = [series.get_field("g", coord=c, iteration=step)[0] for c in "xyz"]
    print("%.17g" % series.t[-1])
    lines(*by_id(p[7], *p[:7]))
    assert info.axes == {0: "z", 1: "y", 2: "x"}, info.axes
    lines(*points([info.xmin, info.ymin, info.zmin], [info.dx, info.dy, info.dz], rho.shape[::-1]), *[v.ravel() for v in [rho] + g])


def with_yt():
    import yt
    spec = importlib.util.spec_from_file_location("frames", os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "docs", "yt-frames.py"))
    frames = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(frames)
    yt.set_log_level("error")
    cloud = frames.particles(path)
    ad = cloud.all_data()
    names = ["position_x", "position_y", "position_z", "velocity_x", "velocity_y", "velocity_z", "mass", "id"]
    p = [np.asarray(ad["matter", "particle_" + name]) for name in names]
    grid = frames.mesh(path)
    low, high, shape = (np.asarray(v) for v in (grid.domain_left_edge, grid.domain_right_edge, grid.domain_dimensions))
    h = (high - low) / shape
    print("%.17g" % float(cloud.current_time))
    lines(*by_id(p[7], *p[:7]))
    box = grid.index.grids[0]
    lines(*points(low + h / 2, h, shape), *[np.asarray(box["stream", name]).ravel(order="F") for name in ("rho", "g_x", "g_y", "g_z")])


{"paraview": paraview, "openpmd-api": openpmd_api, "openpmd-viewer": openpmd_viewer, "yt": with_yt}[program]()
