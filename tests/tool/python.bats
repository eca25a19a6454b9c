# The package of python/: streams read and written, hostile ones refused, sentences run, words written, the page that shows it.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

export PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$top/python

# The tests run with the first python3 that has numpy, and as the python3 of PATH (for #! lines).
setup() {
	cd "$BATS_TEST_TMPDIR" || return
	local p
	for p in $(type -ap python3) /usr/bin/python3; do
		if "$p" -c 'import numpy' 2>/dev/null; then
			mkdir path && ln -s "$p" path/python3 && PATH=$PWD/path:$PATH && return
		fi
	done
	skip "no numpy for any python3 here (apt install python3-numpy)"
}

# streams: one of every kind in small files of their own.
streams() {
	pinit plummer -n 7 --cells 4 >fresh.pm
	cloud | p2m | poisson-fft | mgrad | m2p --field phi >mesh.pm
	pinit two-stream -n 10 --cells 4 >plasma.pm
	pinit shear-layer --cells 8x8 | cycle -n 1 'p2m | poisson-fft | mgrad | m2p | push ab2' >vortex.pm # with registers
	pinit two-body | cycle -n 2 --every 1 'push kick/2 drift | pp | push kick/2' >cycle.pm
	pp <fresh.pm | push kick/2 drift >inside.pm # within a step
	smod --store f32 <mesh.pm >f32.pm
	pinit plummer -n 3 --cells 4 | smod --rename matter=other >b.pm
	stack fresh.pm b.pm >sets.pm
	cat mesh.pm cycle.pm >both.pm
	sel --where 'x > 1e6' <fresh.pm >empty.pm
	wire end >none.pm
	wire edit mesh.pm 'next(k for k in h["fields"] if k["name"] == "g")["half"] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]' >half.pm
	wire edit fresh.pm 'h["remark"] = {"by": "häñd \u001f", "x": [1e300, -1e-7, 0.1, True, None]}; tail["report"]["who"] = {"n": 3}
h["fields"].insert(1, {"name": "flag", "on": "matter", "components": 1, "type": "u8", "role": "state", "kind": "value", "unit": "", "by": "hand"})
data.insert(1, bytearray(range(7)))' | sel >strange.pm # canonical again
}

@test "python: streams of every kind are read and written with equal bytes, from a file and from a pipe" {
	streams
	cat >round.py <<-'END'
		import io, sys
		import pmpipe
		for path in sys.argv[1:]:
		    for source in path, open(path, "rb", 0):
		        if source is not path:  # as a pipe has it: no size, no way back
		            source = type("Pipe", (), {"read": lambda self, n, file=open(path, "rb"): file.read(n)})()
		        out, n = io.BytesIO(), []
		        writer, stream = pmpipe.Writer(out), pmpipe.open(source)
		        stream._at_end = writer.end
		        for frame in stream:
		            writer.write(frame)
		        assert out.getvalue() == open(path, "rb").read(), path
		    print(path, len(pmpipe.open(path)))
	END
	run -0 python3 round.py ./*.pm
	echo "$output"
	[ "${#lines[@]}" = 14 ]
	[[ $output == *"both.pm 4"* && $output == *"none.pm 0"* ]]
	grep -aq '"half"' half.pm && grep -aq f32 f32.pm && grep -aq '"type":"u8"' strange.pm
}

@test "python: arrays have the values and the order that stab and docs/stream.md give them, without a copy" {
	pinit uniform -n 12 --seed 3 --cells 5x4x3 | p2m | poisson-fft | mgrad >a.pm
	stab --plain <a.pm >plain
	python3 - <<-'END'
		import struct
		import numpy as np, pmpipe
		frame = pmpipe.open("a.pm")[0]
		matter, mesh = frame["matter"], frame["mesh"]
		names, *rows = [line.split() for line in open("plain").read().splitlines() if not line.startswith("#")]
		columns = {n: [float(r[i]) for r in rows] for i, n in enumerate(names)}
		assert matter["x"].shape == (12, 3) and matter["mass"].shape == (12,) and matter["id"].dtype == np.int64
		for field, column in (("x", "xyz"), ("v", ("vx", "vy", "vz"))):
		    for c, name in enumerate(column):
		        assert matter[field][:, c].tolist() == columns[name], name
		nx, ny, nz = mesh.points
		g, rho = mesh["g"], mesh["rho"]
		assert g.shape == (nx, ny, nz, 3) and rho.shape == (nx, ny, nz) and len({nx, ny, nz}) == 3
		raw = open("a.pm", "rb").read()
		data = mesh.field("g").planar.tobytes()
		assert raw.count(data) == 1
		flat = struct.unpack("<%dd" % (3 * nx * ny * nz), data)  # [components][nz][ny][nx], x fastest
		for i, j, k, c in ((0, 0, 0, 0), (1, 0, 0, 2), (0, 1, 2, 1), (nx - 1, ny - 1, nz - 1, 2), (3, 2, 1, 0)):
		    assert g[i, j, k, c] == flat[((c * nz + k) * ny + j) * nx + i]
		assert np.shares_memory(g, mesh.field("g").planar) and g.base is not None and not g.flags.writeable
		assert matter["mass"].strides == (0,)  # uniform: no data, and none are made
		assert frame.law == "gravity" and frame.constants["G"] == 1 and frame.time == 0 and frame.step == 0
		assert abs(rho.sum() * np.prod(mesh.meta["h"]) - matter["mass"].sum()) < 1e-12  # a sum of 12 bodies
	END
}

@test "python: every byte of a small frame is guarded: whatever flips is refused with one line" {
	pinit two-body --no-history >a.pm
	pinit plummer -n 2 --cells 2 --no-history | push drift | p2m | poisson-fft --no-history >b.pm
	python3 - <<-'END'
		import pmpipe
		for path in "a.pm", "b.pm":
		    data = open(path, "rb").read()
		    for at in range(len(data)):
		        bad = data[:at] + bytes([data[at] ^ 1 << at % 8]) + data[at + 1:]
		        try:
		            for frame in pmpipe.of_bytes(bad):
		                frame.load()
		        except pmpipe.Error as e:
		            assert e.code == 1 and "\n" not in str(e) and str(e), (at, e)
		        else:
		            raise SystemExit("%s: byte %d: read" % (path, at))
		    for size in range(len(data)):
		        try:
		            [frame.load() for frame in pmpipe.of_bytes(data[:size])]
		        except pmpipe.Error as e:
		            assert e.code == 1, e
		        else:
		            raise SystemExit("%s: cut at %d: read" % (path, size))
		print("all refused")
	END
}

@test "python: what a reader must check is checked before memory is taken, as our reader does" {
	pinit plummer -n 4 --cells 2 --no-history >a.pm
	cat >judge.py <<-'END'
		import resource, sys
		import pmpipe
		resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
		for path in sys.argv[2:]:
		    try:
		        [frame.load() for frame in pmpipe.open(path)]
		    except pmpipe.Error as e:
		        assert "\n" not in str(e) and str(e), path
		    else:
		        assert sys.argv[1] == "any", path + " is read"
	END
	local n=0
	for code in 'h["sets"][0]["n"] = 2 ** 48 + 1' 'h["sets"][0]["n"] = 2 ** 47' 'h["sets"][0]["n"] = -1' 'h["sets"][0]["n"] = 4.0' \
		'h["sets"][0]["n"] = True' \
		'h["sets"] *= 2' 'h["fields"] *= 2' 'h["meshes"][0]["cells"] = [2 ** 31 + 1, 1, 1]' 'h["meshes"][0]["cells"] = [2 ** 20] * 3' \
		'h["meshes"][0]["cells"][1] = 1.5' 'h["meshes"][0]["h"][1] = 0' 'h["meshes"][0]["name"] = "matter"' 'h["fields"][0]["on"] = "nobody"' \
		'h["fields"][0]["components"] = 17' 'h["fields"][0]["type"] = "f16"' 'h["fields"][0]["name"] = "n" * 64' 'h["byte_order"] = "big"' \
		'h["box"]["fields"][0] = ["periodic", "open"]' 'h["box"]["hi"] = h["box"]["lo"]' 'del h["law"]' 'h["time"] = "now"' 'h["dim"] = 4' \
		'h["history"] = [1]' 'h["fields"][0]["name"] = "\0"' 'h["step"] = 2 ** 63' \
		'h["since"] = {"time": 0.0}' 'h["sets"][0]["done"] = {"kick": 2, "drift": 0}' \
		'h["fields"][0]["half"] = [[1]]' 'h["fields"][0]["terms"] = [3]' 'h["fields"][0]["uniform"] = [1]' 'tail["report"] = 3' \
		'tail["limits"] = {"matter/x": {"decay": -1}}'; do
		n=$((n + 1))
		wire edit a.pm "$code" >bad-$n.pm || rm bad-$n.pm # wire.py itself cannot write some
	done
	for edit in '"dim":3/"dim":3,"dim":3' '"dt":/"dt":NaN,"t":' '"dt":/"dt":1e999,"t":'; do
		n=$((n + 1))
		wire text a.pm "${edit%%/*}" "${edit#*/}" >bad-$n.pm
	done
	wire line a.pm 'PMPIPE/1 frame' 'PMPIPE/2 frame' >bad-0.pm
	[ "$(ls bad-*.pm | wc -l)" -ge 25 ]
	for f in bad-*.pm; do run -1 sls -i $f; done
	python3 judge.py none bad-*.pm
	PM_UNSEALED=1 python3 judge.py any "$top"/tests/fuzz/crashes/reader/*
}

# The data are a hole in the file: 4 GB that the disk does not hold, of which neither memory nor time is to be seen.
@test "python: the header of a large file is read without its data, which are compared with their checksum when they are touched" {
	python3 - <<-'END'
		import os, resource, time
		import numpy as np, pmpipe
		from pmpipe.wire import block_make, canonical, line_make
		resource.setrlimit(resource.RLIMIT_DATA, (1 << 30, 1 << 30))
		small = pmpipe.Frame(dim=3, time=0.5)
		small.add_set("matter", n=4, x=np.zeros((4, 3)), mass=np.arange(4.0))
		small.header["fields"] = [f.meta for f in small.fields]
		n = 1 << 27
		small.header["sets"][0]["n"] = n
		head, tail = block_make(canonical(small.header)), block_make(canonical({"crc32c": [1, 2]}))
		with open("big.pm", "wb") as f:
		    f.write(line_make("PMPIPE/1 frame %d %d" % (len(head), n * 32), head))
		    f.seek(n * 32, 1)
		    f.write(line_make("PMPIPE/1 tail %d" % len(tail), tail) + line_make("PMPIPE/1 end 1"))
		before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
		stream = pmpipe.open("big.pm")
		assert len(stream) == 1 and stream[0].time == 0.5 and stream[-1]["matter"].n == n and stream[0]["matter"].field("x").shape == (n, 3)
		grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
		assert grown < 20000, "%d kB" % grown  # of 4 GB
	END
	pinit plummer -n 100 --cells 4 | p2m >a.pm
	wire flip a.pm in-field-rho >bad.pm
	python3 - <<-'END'
		import pmpipe
		frame = pmpipe.open("bad.pm")[0]
		frame["matter"]["x"].sum()  # sound
		try:
		    frame["mesh"]["rho"]
		except pmpipe.Error as e:
		    assert "'rho' on 'mesh'" in str(e)
		else:
		    raise SystemExit("read")
		try:
		    pmpipe.write("copy.pm", frame)
		except pmpipe.Error:
		    pass
		else:
		    raise SystemExit("written")
	END
	[ ! -e copy.pm ] && [ -z "$(find . -name '*.part')" ]
}

@test "python: frames made in Python are streams for every word, and HDF5 goes in and out through sh5" {
	python3 - <<-'END'
		import numpy as np, pmpipe
		rng = np.random.default_rng(2)
		frame = pmpipe.Frame(dim=3, law="gravity", constants={"G": 1.0, "softening": 0.05}, lo=[-4] * 3, hi=[4] * 3, dt=0.01)
		matter = frame.add_set("matter", x=rng.normal(size=(50, 3)), v=np.zeros((50, 3)), mass=0.02, id=np.arange(50))
		frame.add_mesh("mesh", cells=[8, 4, 6])
		pmpipe.write("a.pm", frame)
		pmpipe.write("a.h5", frame)
		again = list(pmpipe.open("a.h5"))[0].load()
		assert (again["matter"]["x"] == matter["x"]).all() and again["mesh"].points == (9, 5, 7)
		got = pmpipe.run("pp | push kick", frame)[0]
		assert np.allclose(got["matter"]["v"], 0.01 * got["matter"]["acc"], rtol=1e-12)  # a kick from rest
		half = pmpipe.run("pp | push kick drift", frame)[0].copy()
		half["matter"].keep(half["matter"]["x"][:, 0] > 0)
		half["matter"]["mass"] = np.full(half["matter"].n, 2.0)
		half.time = 3
		pmpipe.write("half.pm", [frame, half])
		frames = pmpipe.open("half.pm")
		assert frames[0]["matter"].n == 50 and 0 < frames[1]["matter"].n < 50 and frames[1].time == 3
		assert (frames[1]["matter"]["x"][:, 0] > 0).all() and pmpipe.diag(frames)["time"][1] == 3
		for wrong in (lambda: matter.__setitem__("x", np.zeros((3, 50))), lambda: pmpipe.Frame(dim=4),
		              lambda: frame.add_mesh("matter", cells=[1, 1, 1])):
		    try:
		        wrong()
		    except pmpipe.Error:
		        pass
		    else:
		        raise SystemExit("accepted")
		matter["x"] = np.full((50, 3), np.nan)
		try:
		    pmpipe.write("nan.pm", frame)
		except pmpipe.Error as e:
		    assert e.code == 3 and "'x' on 'matter' is nan at 0" in str(e)
		else:
		    raise SystemExit("written")
	END
	scmp --tolerance 0 a.pm <(sh5 a.h5) 2>err || { cat err; return 1; }
	cycle -n 2 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' <a.pm | diag >rows
	[ "$(column step <rows)" = 2 ]
}

@test "python: run, text and table give frames, text and columns; a failure is the word's own line with its exit status" {
	pinit plummer -n 20 >a.pm
	sh5 -o a.h5 <a.pm
	python3 - <<-'END' 2>err
		import pathlib, sys
		import pmpipe
		frames = pmpipe.run("cycle -n 4 --every 2 'push kick/2 drift | pp | push kick/2'", "a.pm")
		assert [f.step for f in frames] == [0, 2, 4] and len(frames) == 3 and frames[-1].step == 4 and [f.step for f in frames[1:]] == [2, 4]
		assert len(pmpipe.run("pp", pathlib.Path("a.h5"))) == 1 and len(pmpipe.run("sel", open("a.pm", "rb").read())) == 1
		table = pmpipe.diag(frames, "--columns", "step,time,energy_kinetic")
		assert list(table) == ["step", "time", "energy_kinetic"] and list(table["step"]) == [0, 2, 4]
		assert type(table).__name__ == ("DataFrame" if "pandas" in sys.modules else "dict")
		sys.modules["pandas"] = None  # without it
		assert pmpipe.table("sel | diag --columns step", frames)["step"].tolist() == [0, 2, 4]
		def fails(call, code, words):
		    try:
		        call()
		    except pmpipe.Error as e:
		        assert e.code == code and words in str(e) and "\n" not in str(e), (e.code, str(e))
		    else:
		        raise SystemExit("no failure: " + words)
		fails(lambda: pmpipe.run("pinit plummer | push kick | diag"), 1, "push: frame 1: no field 'acc'")
		fails(lambda: pmpipe.run("pinit plumer"), 2, "pinit: ")
		fails(lambda: pmpipe.run("pinit plummer | p3m"), 2, "no word 'p3m' (did you mean p2m?)")
		fails(lambda: pmpipe.run("pinit plummer > a.pm"), 2, "'>' in the sentence")
		fails(lambda: pmpipe.run("pinit 'plummer"), 2, "cannot be read")
		fails(lambda: pmpipe.run("pinit plummer | | pp"), 2, "without a word")
		fails(lambda: pmpipe.run("pinit plummer -n 5 | diag"), 2, "ends in text")
		fails(lambda: pmpipe.run("pinit plummer | field 'acc = 1/(x-x),0,0'"), 3, "field: ")
		def broken():
		    yield frames[0]
		    raise ZeroDivisionError("mine")
		try:
		    pmpipe.run("pp", broken())
		except ZeroDivisionError:
		    pass
	END
	cat err
	[ ! -s err ]
	python3 -m pmpipe >list
	diff <(sed -n 's/^  \([a-z][a-z0-9-]*\)  .*/\1/p' list | LC_ALL=C sort) <(tools)
	python3 -c 'import pmpipe; print(*pmpipe.words(), sep="\n")' | diff - <(tools)
	python3 -m pmpipe pinit two-body | cmp - <(pinit two-body)
	run -2 --separate-stderr python3 -m pmpipe p3m
	[[ $stderr == "pmpipe: no word 'p3m' (did you mean p2m? "* ]]
}

@test "python: a word in ten lines follows the contract: ways agree, refusals are one line, aborts travel, mistakes end in an abort" {
	drag=$top/python/examples/drag.py
	[ "$(grep -cvE '^ *(#.*|""".*)?$' "$drag")" -le 10 ]
	pinit plummer -n 12 --cells 4 | p2m --kernel ngp >a.pm # with meshes
	s="push kick/2 drift | pp | $drag 0.5 | push kick/2"
	timeout 60 cycle -n 2 "$s" <a.pm >fused # a word that keeps the end to itself is waited for
	timeout 60 cycle -n 2 --engine pipes "$s" <a.pm >pipes
	same_as fused pipes
	[ "$(sls --history <fused | grep -c '"program":"drag"')" = 1 ]
	sh_ok "cat a.pm a.pm | $drag --no-history 0.5 | sls | grep -c frames" # streams stay two
	$drag 0.5 <a.pm | field 'acc = -0.5*vx,-0.5*vy,-0.5*vz' --term other | stab --plain | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
		{ d = $c["acc_0"] + $c["vx"]; if (d > 1e-15 || d < -1e-15) bad = 1; n++ } END { exit bad || !n }' # twice the same friction, rate 1
	e0=$(diag <a.pm | column energy_kinetic)
	cycle -n 40 "$drag 1 | push kick drift" <a.pm | diag >rows
	# v' = -v by Euler steps: the kinetic energy falls as (1 - dt)^(2n)
	within "$(awk -v a="$(column energy_kinetic <rows)" -v b="$e0" 'BEGIN { print a / b }')" \
		"$(awk -v t="$(column time <rows)" 'BEGIN { print (1 - t / 40) ^ 80 }')" 1e-6
	for fault in "$drag 1 | $drag 1:1:already holds the term 'drag'" "$drag 1e400:3:inf at" "$drag:2:arguments are required" "$drag x:2:invalid float" \
		"$drag 1 --set nobody:1:no set or mesh 'nobody'"; do
		words=${fault##*:} code=${fault%:*} code=${code##*:}
		run --separate-stderr bash -o pipefail -c "<a.pm ${fault%%:*} | sls"
		[[ $status != 0 && ${stderr_lines[0]} == "drag: "*"$words"* && ${stderr_lines[1]} == "sls: stopped by drag: "*"$words"* ]] ||
			{ echo "$fault: $stderr"; return 1; }
		bash -c "<a.pm ${fault%%:*}" >out 2>/dev/null || true
		grep -aq "^PMPIPE/1 abort $code " out || { echo "$fault"; return 1; }
	done
	push kick <a.pm >aborted.pm 2>/dev/null || true
	run -1 --separate-stderr bash -c "$drag 1 <aborted.pm"
	[[ $stderr == "drag: stopped by push: frame 1: no field 'acc'"* ]]
	head -c 2000 a.pm >cut.pm
	run -1 --separate-stderr bash -c "$drag 1 <cut.pm"
	[[ ${#stderr_lines[@]} = 1 && $stderr == "drag: frame 1: the input ends in "* ]]
	wire unseal a.pm >old.pm
	for edit in 's/"dim":3/"dim"3/' 's/tail [0-9]*/tail -9/' 's/"name":"matter"/"name":"\xff\xfe"/'; do
		LC_ALL=C sed "$edit" old.pm >bad.pm # without checksums of lines, which would see it first
		run -1 --separate-stderr bash -c "$drag 1 <bad.pm"
		[[ ${#stderr_lines[@]} = 1 && $stderr == "drag: frame 1: "* ]] || { echo "$edit: $stderr"; return 1; }
	done
	printf '%s\n' 'import pmpipe' '@pmpipe.stage' 'def broken(frame):' '    return 1 / 0' 'broken.main()' >broken.py
	run -1 --separate-stderr bash -c "python3 broken.py <a.pm"
	[[ $stderr == "broken: ZeroDivisionError: division by zero (broken.py, line 4)" ]]
}

@test "python: doctests pass, every public name has a docstring, and no syntax is newer than Python 3.9" {
	python3 - <<-'END'
		import ast, doctest, glob, importlib, inspect, os
		import pmpipe
		ran = 0
		for path in glob.glob(os.path.join(os.path.dirname(pmpipe.__file__), "*.py")):
		    name = os.path.basename(path)[:-3]
		    ast.parse(open(path).read(), feature_version=(3, 9))
		    if name.startswith("__"):
		        continue
		    result = doctest.testmod(importlib.import_module("pmpipe." + name))
		    assert result.failed == 0, name
		    ran += result.attempted
		assert ran > 20, ran
		for name in pmpipe.__all__:
		    thing = getattr(pmpipe, name)
		    if inspect.isclass(thing):
		        for key, value in vars(thing).items():
		            if not key.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
		                assert inspect.getdoc(value), (name, key)
		    assert name.startswith("__") or inspect.getdoc(thing), name
	END
	[ -e "$top/python/pmpipe/py.typed" ]
}

# Blocks of Python, each with what it prints in the block of text behind it, run as one session in an empty directory.
@test "python: every block of docs/python.md runs and prints what the page says, and its picture is the one that is shown" {
	cat >page.py <<-'END'
		import contextlib, io, re, sys
		page, names, n = open(sys.argv[1]).read(), {}, 0
		for code, rest in re.findall(r"^```python\n(.*?)^```\n(?:```text\n(.*?)^```\n)?", page, re.S | re.M):
		    said, n = io.StringIO(), n + 1
		    with contextlib.redirect_stdout(said):
		        exec(compile(code, "block %d" % n, "exec"), names)
		    assert said.getvalue() == rest, "block %d printed:\n%s" % (n, said.getvalue())
		print(n)
	END
	run --separate-stderr python3 page.py "$top/docs/python.md"
	echo "$stderr"
	[ "$status $output" = "0 8" ]
	[ "$(grep -c '^```python' "$top/docs/python.md")" = 8 ]
	cmp python.png "$top/docs/python.png"
	[ "$(wc -c <python.png)" -le 60000 ]
}

@test "python: docs/stage-in-python.md prints the word that is there, and its commands run" {
	sed -n '/^```python$/,/^```$/p' "$top/docs/stage-in-python.md" | sed '1d;$d' | cmp - "$top/python/examples/drag.py"
	ln -s "$top/python" .
	sed -n '/^```sh$/,/^```$/p' "$top/docs/stage-in-python.md" | sed '1d;$d' >page.sh
	[ "$(wc -l <page.sh)" = 2 ]
	run -0 bash -euo pipefail page.sh
	[[ $output == *"acc "*"terms drag"* ]]
}

# The programs of the tree as they are: building them again is for the long run (below).
@test "python: a wheel is built and installed without a network, and its programs run from outside the tree" {
	mkdir few && cp "${PM_BIN:-$top/bin}"/{pinit,push,pp,cycle,pmpipe} few
	wheel_here PMPIPE_PROGRAMS="$PWD/few"
}

@test "python: a wheel builds its programs from the tree with make, and an sdist from what it holds" {
	[ "${PM_LONG:-}" ] || skip "long: make check-long"
	wheel_here PMPIPE_PROGRAMS=
	echo 'pinit plummer -n 5000 | p2m -n 32 --kernel pcs | poisson-fft | mgrad | m2p' >step
	for level in x86-64 x86-64-v3 x86-64-v4; do # the code of each level, as far as the processor has it
		export PM_INSTRUCTIONS=$level
		env PATH="$PWD/venv/lib/$(ls venv/lib)/site-packages/pmpipe/libexec:$PATH" bash step | cksum
	done | sort -u >sums
	unset PM_INSTRUCTIONS
	bash step | cksum | cmp - sums
	(cd tree/python && python3 setup.py -q sdist -d "$BATS_TEST_TMPDIR/dist" 2>err) || { cat tree/python/err; return 1; }
	mkdir alone && tar -C alone --strip-components 1 -xzf dist/*.tar.gz
	[ -e alone/tree/lib/base/base.h ]
	rm -r tree dist
	PMPIPE_MAKE=PORTABLE=1 python3 -m pip wheel -q --no-build-isolation --no-index --no-deps -w dist ./alone
	unzip -l dist/*.whl | grep -q pmpipe/libexec/poisson-fft
}

# wheel_here NAME=VALUE: builds with that in the environment, installs into a venv, and runs its programs.
wheel_here() {
	local p=$PWD
	python3 -c 'import setuptools, pip, wheel, venv' 2>/dev/null ||
		skip "no pip, setuptools, wheel or venv for python3 (apt install python3-pip python3-setuptools python3-wheel python3-venv)"
	export PIP_DISABLE_PIP_VERSION_CHECK=1
	unset PYTHONPATH PM_BIN MAKEFLAGS
	mkdir tree && ln -s "$top"/{Makefile,COPYING,lib,tools,data,packaging} tree && cp -r "$top/python" tree
	env "$1" python3 -m pip wheel -q --no-build-isolation --no-index --no-deps -w dist ./tree/python
	python3 -m venv --system-site-packages --without-pip venv
	python3 -m pip -q --python venv/bin/python install --no-index --no-deps dist/*.whl
	cd /
	env -i "$p/venv/bin/pmpipe" pinit two-body | cmp - <(pinit two-body)
	env -i "$p/venv/bin/python" -c '
import pmpipe, sys
assert pmpipe.directory() == pmpipe.__file__.replace("__init__.py", "libexec"), pmpipe.directory()
frames = pmpipe.run("pinit two-body | cycle -n 2 '"'push kick/2 drift | pp | push kick/2'"'")
assert frames[-1].step == 2
assert pmpipe.text("pinit --version").split()[-1] == pmpipe.__version__, pmpipe.text("pinit --version")'
	cd "$p"
}
