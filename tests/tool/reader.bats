# The reader of docs/read.py on real streams: the same values as stab's text, the same checksums, the same complaints.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

read_py() { python3 "$top/docs/read.py"; }

@test "the Python reader is short" {
	[ "$(grep -cvE '^ *(#.*)?$' "$top/docs/read.py")" -le 70 ]
	! grep -q numpy "$top/docs/read.py"
}

@test "the Python reader gets the values that stab prints, to the last bit" {
	pinit uniform -n 50 --seed 2 --dispersion 1.5 --mass-spread 0.3 >a.pm
	stab <a.pm >text
	read_py <a.pm >read
	python3 - <<-'END'
	import re
	text = [l.split("\t") for l in open("text").read().splitlines() if l and not l.startswith("#")]
	head, rows = text[0], text[1:]
	read, name = {}, None
	for line in open("read").read().splitlines():
	    if re.match("[a-z]", line) and not line.startswith(("nan", "inf")):
	        name = line.split()[1]
	        read[name] = []
	    else:
	        read[name].append([float(v) for v in line.split("\t")])
	axes = {"x": ("x", 0), "y": ("x", 1), "z": ("x", 2), "vx": ("v", 0), "vy": ("v", 1), "vz": ("v", 2), "mass": ("mass", 0), "id": ("id", 0)}
	assert len(rows) == 50 and set(axes) <= set(head), head
	for column, (field, c) in axes.items():
	    assert [float(r[head.index(column)]) for r in rows] == [v[c] for v in read[field]], column
	END
}

@test "the Python reader reads particles, meshes, uniform fields and several frames, and agrees on every checksum" {
	cloud | p2m >mesh.pm
	cat mesh.pm mesh.pm >two.pm
	read_py <two.pm >out
	[ "$(grep -c '^mesh rho f64' out)" = 2 ]
	[ "$(sed -n '/^mesh rho/,$p' out | sed -n '2,65p' | wc -l)" = 64 ]
	[ "$(sed -n '/^matter mass/,/^matter id/p' out | grep -v '^matter' | sort -u | wc -l)" = 1 ] # uniform
}

@test "the Python reader and ours say no to the same: cut, damaged, refused, aborted" {
	cloud >a.pm
	wire cut a.pm in-field-v >cut.pm
	run -1 read_py <cut.pm
	[ "$output" = "the stream is cut" ]
	wire flip a.pm in-field-v >flip.pm
	run -1 read_py <flip.pm
	[ "$output" = "a checksum is wrong" ]
	wire line a.pm PMPIPE/1 PMPIPE/2 >new.pm
	run -1 read_py <new.pm
	run -1 read_py </dev/null
	push --nonsense <a.pm >abort.pm 2>err || true
	run -2 read_py <abort.pm
	[ "$output" = "$(cat err)" ]
}
