# Other programs read what sh5 and svtk write: the same numbers as stab prints, to the last bit but for the coordinates of mesh points, which each computes in
# its own way (tolerance: 1e-14 of the box). openpmd-api and openpmd-viewer are looked for in the Python of PM_OPENPMD_VENV (a directory), else in python3.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# python_with MODULE: the first Python that has it, or nothing.
python_with() {
	for p in ${PM_OPENPMD_VENV:+"$PM_OPENPMD_VENV/bin/python"} python3 /usr/bin/python3; do
		if "$p" -c "import $1, h5py" 2>/dev/null; then echo "$p" && return; fi
	done
}

# A run on a mesh with three different sides, each body with a mass of its own, and what stab says of its last frame.
make_run() {
	pinit plummer -n 50 --seed 1 --cells 8x7x10 | scalc 'mass = mass * (1 + id / 100)' |
		cycle -n 4 --every 2 --store all 'push kick/2 drift | p2m | poisson-fft | mgrad --order 2 | m2p | push kick/2' >run.pm
	sh5 -o run.h5 <run.pm
	svtk -o run.pvd <run.pm
	sel --last <run.pm >last.pm
	{
		sls <last.pm | sed -n 's/^frame 1: time \([^ ]*\) .*/\1/p'
		stab --plain <last.pm | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } NF {
			print $at["id"], $at["x"], $at["y"], $at["z"], $at["vx"], $at["vy"], $at["vz"], $at["mass"] }' | sort -n | cut -d' ' -f2-
		stab --plain --mesh mesh <last.pm | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } NF {
			print $at["x"], $at["y"], $at["z"], $at["rho"], $at["g_0"], $at["g_1"], $at["g_2"] }'
	} >want
	[ "$(wc -l <want)" = 843 ] # the time, 50 bodies, 9 x 8 x 11 points
}

# agrees: FILE got against want.
agrees() {
	python3 - <<'END'
want, got = ([[float(v) for v in line.split()] for line in open(name)] for name in ("want", "got"))
assert len(want) == len(got), (len(want), len(got))
for k, (w, g) in enumerate(zip(want, got)):
    assert len(w) == len(g), (k, w, g)
    for c, (a, b) in enumerate(zip(w, g)):
        assert abs(a - b) <= (28e-14 if k > 50 and c < 3 else 0), f"line {k + 1}, column {c + 1}: got {b!r}, want {a!r}"
END
}

@test "ParaView opens what svtk writes: times, positions, velocities, masses and mesh are those of the frame" {
	command -v pvbatch >/dev/null || skip "ParaView is not there (apt-get install paraview)"
	make_run
	pvbatch --force-offscreen-rendering "$top/tests/foreign-readers.py" paraview "$PWD/run.pvd" 2>log | grep -E '^[-0-9.]' >got || { cat log; return 1; }
	agrees
}

@test "openpmd-api reads what sh5 writes: time, units, order of axes, positions, velocities, masses and mesh are those of the frame" {
	python=$(python_with openpmd_api)
	[ "$python" ] || skip "openpmd-api is not there (pip install openpmd-api into a venv, its directory in PM_OPENPMD_VENV)"
	make_run
	"$python" "$top/tests/foreign-readers.py" openpmd-api run.h5 >got
	agrees
}

@test "openpmd-viewer reads what sh5 writes, and draws it" {
	python=$(python_with openpmd_viewer)
	[ "$python" ] || skip "openpmd-viewer is not there (pip install openpmd-viewer into a venv, its directory in PM_OPENPMD_VENV)"
	make_run
	"$python" "$top/tests/foreign-readers.py" openpmd-viewer run.h5 >got
	agrees
	mkdir one && cp run.h5 one
	MPLBACKEND=Agg "$python" -c '
from openpmd_viewer import OpenPMDTimeSeries
import matplotlib.pyplot as plt
s = OpenPMDTimeSeries("one")
s.get_particle(["x", "y"], species="matter", iteration=s.iterations[-1], plot=True)
plt.savefig("cloud.png")' 2>/dev/null
	[ -s cloud.png ]
}

@test "yt shows our particles and meshes through docs/yt-frames.py, in the order x, y, z" {
	python=$(python_with yt)
	[ "$python" ] || skip "yt is not there (apt-get install python3-yt)"
	make_run
	"$python" "$top/tests/foreign-readers.py" yt run.h5 2>log >got || { cat log; return 1; }
	agrees
	"$python" "$top/docs/yt-frames.py" run.h5 yt.png >/dev/null 2>&1
	[ -s yt.png ]
}

@test "svtk: two dimensions lie in the plane z = 0, f32 and whole numbers keep their type, a component half a cell up has its own image" {
	printf 'x y vx vy mass id\n0.25 0.5 1 2 3 7\n-0.5 0.125 4 5 6 8\n' | stab - --law gravity --box=-1,1 -n 4x5 | smod --store mass=f32 | p2m >a.pm
	svtk -o a.pvd <a.pm
	[ "$(ls a | paste -sd' ')" = "matter-000000-0.vtp mesh-000000-1.vti" ]
	python3 - <<'END'
import re, struct
def arrays(path):
    """name: (type, components, values) of the arrays of a file of VTK with raw data."""
    b = open(path, "rb").read()
    head, data = b[:b.index(b"<AppendedData")].decode(), b[b.index(b"\n_") + 2:]
    out = {}
    for kind, name, n, at in re.findall(r'type="(\w+)" Name="(\w+)" NumberOfComponents="(\d+)" format="appended" offset="(\d+)"', head):
        at, code = int(at), {"Float64": "d", "Float32": "f", "Int64": "q", "UInt8": "B"}[kind]
        size = struct.unpack_from("<Q", data, at)[0]
        out[name] = kind, int(n), struct.unpack_from("<%d%s" % (size // struct.calcsize(code), code), data, at + 8)
    return head, out
head, a = arrays("a/matter-000000-0.vtp")
assert a["x"] == ("Float64", 3, (0.25, 0.5, 0, -0.5, 0.125, 0)), a["x"]
assert a["v"] == ("Float64", 3, (1, 2, 0, 4, 5, 0)), a["v"]
assert a["mass"] == ("Float32", 1, (3, 6)) and a["id"] == ("Int64", 1, (7, 8)), a
assert a["connectivity"][2] == (0, 1) and a["offsets"][2] == (1, 2), a
head, a = arrays("a/mesh-000000-1.vti")
assert 'WholeExtent="0 4 0 5 0 0" Origin="-1 -1 0" Spacing="0.5 0.40000000000000002 1"' in head, head
assert len(a["rho"][2]) == 30 and abs(sum(a["rho"][2]) * 0.2 - 9) < 1e-12, a["rho"]
END
	pinit plummer -n 3 --cells 2 | p2m | poisson-fft | mgrad --order 2 2>/dev/null >b.pm
	half='next(k for k in h["fields"] if k["name"] == "g")["half"] = [[1, 0, 0], [0, 0, 0], [0, 0, 0]]'
	python3 -I -S "$top/tests/wire.py" edit b.pm "$half" | svtk -o b.pvd
	[ "$(grep -a -c 'Name="g"' b/mesh-000000-1.vti)" = 0 ]
	grep -a -q 'Origin="-7 -14 -14"' b/mesh-g_0-000000-2.vti
	grep -q 'name="mesh-g_0" file="b/mesh-g_0-000000-2.vti"' b.pvd
}

@test "svtk without a list to write is a usage error; after a failure there is no list" {
	run -2 --separate-stderr svtk -o a.vtk
	[ "$stderr" = "svtk: where to? (-o FILE.pvd, the kind of file that ParaView opens)" ]
	pinit plummer -n 10 | head -c 700 >cut
	run -1 --separate-stderr bash -c 'svtk -o a.pvd <cut'
	[ ! -e a.pvd ]
}
