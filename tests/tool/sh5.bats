# sh5: the stream at rest, in HDF5 as openPMD 1.1 lays it out. Tolerances: none, bytes are equal.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

wire() { python3 "$top/tests/wire.py" "$@"; }

# there_and_back FILE.pm: equal bytes, and no message.
there_and_back() {
	sh5 -o back.h5 <"$1" && sh5 back.h5 | cmp - "$1"
}

# attribute FILE PATH: its values as h5dump prints them, one line.
attribute() { h5dump -a "$2" "$1" | sed -n '/DATA {/,/}/{/DATA {/d; /}/d; s/^ *([0-9,]*): //; p}' | tr -s ' \n' ' ' | sed 's/ $//'; }

mesh() { pinit plummer -n "${1:-50}" --seed 1 --cells 8x7x10 --no-history | p2m --no-history | poisson-fft --no-history | mgrad --no-history |
	m2p --no-history; }

# says CODE LINE COMMAND...: exit status and the one line on stderr.
says() {
	local code=$1 line=$2
	shift 2
	run -"$code" --separate-stderr "$@"
	[[ ${#stderr_lines[@]} = 1 && $stderr == $line ]] || { echo "$*: $stderr"; return 1; }
}

@test "stream to HDF5 to stream gives equal bytes: particles, meshes, uniform, history, report" {
	mesh >a.pm
	there_and_back a.pm
	pinit plummer -n 137 --seed 3 --cells 16 | p2m | poisson-fft >b.pm # with history; phi brings a report
	there_and_back b.pm
	sh5 --no-history back.h5 | cmp - b.pm
	for scene in $(pinit --complete | tr ' ' '\n' | grep -xE 'plummer|uniform|lattice|two-body|kepler|two-stream|lamb-oseen'); do
		pinit "$scene" >s.pm
		there_and_back s.pm || { echo "$scene"; return 1; }
	done
}

@test "stream to HDF5 to stream gives equal bytes: f32, i64, u8, NaN, sixteen components, names that openPMD does not allow" {
	pinit uniform -n 7 --seed 3 --cells 4 >one.pm
	wire edit one.pm '
h["colour"] = {"deep": [1, None, "two"]}
def add(name, type, code, n, components=1, values=None, **more):
    h["fields"].append({"name": name, "on": "matter", "components": components, "type": type, "role": "state", "kind": "value", "unit": "", **more})
    data.append(bytearray(struct.pack("<%d%s" % (n, code), *(values or [k % 256 for k in range(n)]))))
add("temperature", "f32", "f", 7, values=[0.1, -0.0, 1e-45, 3.4e38, 1, float("nan"), float("inf")])
add("tag", "i64", "q", 7, values=[-2**63, 2**63 - 1, 0, 1, 2, 3, 4])
add("letters", "u8", "B", 7 * 16, components=16)
add("a-b", "f64", "d", 7)
add("a b", "f64", "d", 7)
add("a/b", "f64", "d", 7)
add("position", "f64", "d", 7)
add("positionOffset", "f64", "d", 7)
add("plane", "f32", "f", 14, components=2)' >odd.pm
	there_and_back odd.pm
	h5ls -r back.h5 | grep -q '/matter/letters/c15 '
	h5dump -H -d /data/0/particles/matter/temperature back.h5 | grep -q H5T_IEEE_F32LE
	h5dump -H -d /data/0/particles/matter/tag back.h5 | grep -q H5T_STD_I64LE
	h5dump -H -d /data/0/particles/matter/letters/c0 back.h5 | grep -q H5T_STD_U8LE
}

@test "stream to HDF5 to stream gives equal bytes: no particles, several sets and meshes, several frames of equal step, two streams, none" {
	pinit uniform -n 7 --seed 3 --cells 4 | p2m >one.pm
	wire edit one.pm 'resize("matter", 0)' >nobody.pm
	there_and_back nobody.pm
	h5ls -r back.h5 | grep -q 'position/x *Dataset {0}'
	wire edit one.pm '
h["sets"] += [{"name": "more matter", "n": 3, "done": {"kick": 0.0, "drift": 0.0}}, {"name": "more_matter", "n": 2, "done": {"kick": 0.0, "drift": 0.0}}]
h["meshes"].append(dict(h["meshes"][0], name="fine"))
rho = next(k for k in h["fields"] if k["name"] == "rho")
h["fields"].append(dict(rho, on="fine")); data.append(bytearray(data[h["fields"].index(rho)]))
for n, on in ((3, "more matter"), (2, "more_matter")):
    h["fields"].append({"name": "x", "on": on, "components": 3, "type": "f64", "role": "state", "kind": "value", "unit": ""})
    data.append(bytearray(struct.pack("<%dd" % (3 * n), *range(3 * n))))' >sets.pm
	there_and_back sets.pm
	wire frames one.pm sets.pm nobody.pm one.pm >four.pm
	there_and_back four.pm
	[ "$(h5ls back.h5/data | cut -d' ' -f1 | paste -sd,)" = 0,1,2,3 ]
	cat four.pm one.pm >two.pm
	there_and_back two.pm
	wire end >none.pm
	there_and_back none.pm
	cat none.pm one.pm none.pm >mixed.pm
	there_and_back mixed.pm
}

@test "iterations are called by their step; where it does not rise, by the next free number" {
	pinit two-body | cycle -n 12 --every 5 'push kick/2 drift | pp | push kick/2' >a.pm
	there_and_back a.pm
	[ "$(h5ls back.h5/data | cut -d' ' -f1 | sort -n | paste -sd,)" = 0,5,10,12 ]
	cat a.pm a.pm >twice.pm
	there_and_back twice.pm
	[ "$(h5ls back.h5/data | cut -d' ' -f1 | sort -n | paste -sd,)" = 0,5,10,12,13,14,15,16 ]
}

@test "equal runs give equal files, and h5diff agrees; it finds a value that differs" {
	mesh >a.pm
	sh5 -o a.h5 <a.pm
	sh5 -o b.h5 <a.pm
	cmp a.h5 b.h5
	h5diff a.h5 b.h5
	wire edit a.pm 'put("v", 3, 7.25)' | sh5 -o c.h5
	run -1 h5diff a.h5 c.h5
	[[ $output == *"velocity"*"1 differences found"* ]]
}

@test "h5dump shows the numbers that stab shows" {
	mesh 5 >a.pm
	sh5 -o a.h5 <a.pm
	h5dump -y -w 1 -m %.17g -d /data/0/particles/matter/velocity/y a.h5 | awk 'NF == 1 && /}/ { exit } NF == 1 && /[0-9]/ { printf "%.12g\n", $1 }' >one
	stab --plain <a.pm | awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "vy") c = i; next } { printf "%.12g\n", $c }' >two
	[ "$(wc -l <one)" = 5 ]
	cmp one two
}

@test "what openPMD 1.1 requires is there" {
	mesh >a.pm
	sh5 -o a.h5 <a.pm
	is() { [ "$(attribute a.h5 "$1")" = "$2" ] || { echo "$1: got $(attribute a.h5 "$1"), want $2"; return 1; }; }
	is /openPMD '"1.1.0"'
	is /openPMDextension 0
	is /basePath '"/data/%T/"'
	is /meshesPath '"meshes/"'
	is /particlesPath '"particles/"'
	is /iterationEncoding '"groupBased"'
	is /iterationFormat '"/data/%T/"'
	is /data/0/time 0
	is /data/0/dt 0.03125
	is /data/0/timeUnitSI 1
	is /data/0/meshes/rho/geometry '"cartesian"'
	is /data/0/meshes/rho/dataOrder '"C"'
	is /data/0/meshes/rho/axisLabels '"z", "y", "x"'
	is /data/0/meshes/rho/gridGlobalOffset '-14, -14, -14'
	is /data/0/meshes/rho/gridSpacing '2.8, 4, 3.5'
	is /data/0/meshes/rho/gridUnitSI 1
	is /data/0/meshes/rho/unitSI 1
	is /data/0/meshes/rho/timeOffset 0
	is /data/0/meshes/rho/position '0, 0, 0'
	is /data/0/meshes/rho/unitDimension '-3, 1, 0, 0, 0, 0, 0'
	is /data/0/meshes/g/unitDimension '1, 0, -2, 0, 0, 0, 0'
	is /data/0/meshes/g/x/position '0, 0, 0'
	is /data/0/particles/matter/position/unitDimension '1, 0, 0, 0, 0, 0, 0'
	is /data/0/particles/matter/position/x/unitSI 1
	is /data/0/particles/matter/positionOffset/x/value 0
	is /data/0/particles/matter/positionOffset/x/shape 50
	is /data/0/particles/matter/velocity/unitDimension '1, 0, -1, 0, 0, 0, 0'
	is /data/0/particles/matter/mass/value 0.0197037
	is /data/0/particles/matter/mass/shape 50
	is /data/0/particles/matter/mass/macroWeighted 1
	is /data/0/particles/matter/mass/weightingPower 1
	is /data/0/particles/matter/velocity/macroWeighted 0
	h5ls -r a.h5 | grep -q '/data/0/meshes/rho *Dataset {11, 8, 9}' # z, y, x in points: x fastest
}

@test "a component half a cell up says so" {
	mesh >a.pm
	wire edit a.pm 'next(k for k in h["fields"] if k["name"] == "g")["half"] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]' >half.pm
	there_and_back half.pm
	[ "$(attribute back.h5 /data/0/meshes/g/x/position)" = "0, 0, 0.5" ]
	[ "$(attribute back.h5 /data/0/meshes/g/z/position)" = "0.5, 0, 0" ]
}

# stranger FILE: the same file as if written by another program: without our own attributes.
stranger() { sed 's/pmpipeHeader/pmpipeHeadex/; s/pmpipeReport/pmpipeReport/; s/pmpipeStreams/pmpipeStreamx/' "$1"; }
# columns FILE.pm [--mesh NAME] NAMES: those columns of stab --plain.
columns() { stab --plain "${@:2:$#-2}" <"$1" | awk -F'\t' -v names="${*: -1}" 'NR == 1 { n = split(names, w, ","); for (i = 1; i <= NF; i++) at[$i] = i;
	next } { for (k = 1; k <= n; k++) printf "%s ", $at[w[k]]; print "" }'; }

@test "a file of another program is read: particles, weighting, meshes, time" {
	mesh >a.pm
	wire edit a.pm 'h["time"] = 1.5; h["step"] = 7
h["fields"].append({"name": "weighting", "on": "matter", "components": 1, "type": "f64", "role": "state", "kind": "value", "unit": "",
    "uniform": [2.5]})
data.append(bytearray())' >b.pm
	sh5 -o b.h5 <b.pm
	stranger b.h5 >c.h5
	sh5 c.h5 >c.pm
	cmp <(columns b.pm x,y,z,vx,vy,vz,id) <(columns c.pm x,y,z,vx,vy,vz,id)
	cmp <(columns b.pm --mesh mesh x,y,z,rho,phi,g_0,g_1,g_2) <(columns c.pm --mesh mesh x,y,z,rho,phi,g_0,g_1,g_2)
	wire header c.pm | python3 -c '
import json, sys
h = json.load(sys.stdin)
field = {k["name"]: k for k in h["fields"]}
assert h["time"] == 1.5 and h["step"] == 7 and h["box"]["lo"] == [-14, -14, -14] and h["box"]["hi"] == [14, 14, 14], h
assert field["weighting"]["kind"] == field["mass"]["kind"] == "strength" and field["weighting"]["uniform"] == [2.5], field
assert [e["program"] for e in h["history"]] == ["sh5"], h["history"]'
}

@test "a file of another program: axes in another order, components at different places, what cannot be read" {
	mesh >a.pm
	wire edit a.pm 'next(k for k in h["fields"] if k["name"] == "g")["half"] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]' | sh5 -o a.h5
	stranger a.h5 >b.h5
	sh5 b.h5 >b.pm
	cmp <(columns a.pm --mesh mesh rho) <(columns b.pm --mesh "$(wire header b.pm |
		python3 -c 'import json, sys; print(next(k["on"] for k in json.load(sys.stdin)["fields"] if k["name"] == "rho"))')" rho)
	[ "$(wire header b.pm |
		python3 -c 'import json, sys
h = json.load(sys.stdin)
print(len(h["meshes"]), [k["name"] for k in h["fields"] if k["name"][0] == "g"], [m["lo"] for m in h["meshes"]][0])')" = \
		"4 ['g_x', 'g_y', 'g_z'] [-12.25, -14.0, -14.0]" ]
	sh5 -o c.h5 <a.pm
	stranger c.h5 | sed 's/zyx/xyz/g' >d.h5
	sh5 d.h5 >d.pm
	# The axes change places: sorted by the slowest first, the values are in the order of before.
	cmp <(columns a.pm --mesh mesh rho) <(columns d.pm --mesh mesh x,y,z,rho | LC_ALL=C sort -g -k1,1 -k2,2 -k3,3 | awk '{ print $4 " " }')
	stranger c.h5 | sed 's/cartesian/thetaMode/g' >e.h5
	says 1 "sh5: iteration 0: mesh 'g': only cartesian*" sh5 e.h5
}

# unweigh FILE POWER: the strengths of FILE as other programs have them, for one body of each particle: macroWeighted 0 and weightingPower POWER written over
# the 1 and 1 of ours, where HDF5 has the values of these two attributes (their types and shapes are as long as they are).
unweigh() {
	python3 -c '
import struct, sys
b = bytearray(open(sys.argv[1], "rb").read())
for name, place, old, new in ((b"macroWeighted\0", 40, struct.pack("<I", 1), bytes(4)),
        (b"weightingPower\0", 48, struct.pack("<d", 1), struct.pack("<d", float(sys.argv[2])))):
    i = -1
    while (i := b.find(name, i + 1)) >= 0:
        if b[i + place:i + place + len(old)] == old:
            b[i + place:i + place + len(old)] = new
sys.stdout.buffer.write(b)' "$1" "$2"
}

@test "a file of another program: mass and charge of one body are multiplied by weighting^weightingPower, those of the whole are not" {
	printf 'x y mass charge\n0 0 2 -1\n1 0 3 -0.5\n1 1 4 0.25\n' | stab - | scalc --type f64 'weighting = 1 + 2 * (x + y)' >a.pm # weighting 1, 3, 5
	sh5 -o whole.h5 <a.pm
	unweigh whole.h5 1 >one.h5
	unweigh whole.h5 2 >two.h5
	[ "$(attribute one.h5 /data/0/particles/matter/mass/macroWeighted)" = 0 ]
	[ "$(attribute two.h5 /data/0/particles/matter/charge/weightingPower)" = 2 ]
	for f in whole one two; do
		stranger $f.h5 >s.h5
		sh5 s.h5 | columns /dev/stdin mass,charge,weighting >$f
	done
	diff whole - <<<$'2 -1 1 \n3 -0.5 3 \n4 0.25 5 '
	diff one - <<<$'2 -1 1 \n9 -1.5 3 \n20 1.25 5 '
	diff two - <<<$'2 -1 1 \n27 -4.5 3 \n100 6.25 5 '
}

@test "openPMD-validator finds no error" {
	command -v openPMD_check_h5 >/dev/null || skip "openPMD-validator is not there (pip install openPMD-validator)"
	mesh | sh5 -o mesh.h5
	for scene in plummer two-stream lamb-oseen exb kepler; do pinit $scene | p2m -o $scene.h5 --no-history; done
	for f in *.h5; do openPMD_check_h5 -i "$f" | grep -q '^Result: 0 Errors' || { echo "$f"; return 1; }; done
}

# The Python that has yt, or nothing: that of Debian is not always the first on PATH.
yt_python() {
	for p in python3 /usr/bin/python3; do
		if "$p" -c 'import yt, h5py' 2>/dev/null; then echo "$p" && return; fi
	done
}

# What yt 4.1 of Debian 12 can by itself: meshes to the last bit, the names of the particles' fields and their number. (Their arrays are empty, see
# docs/methods/vtk.md; foreign-readers.bats has them.)
@test "yt reads the meshes, and finds the particles" {
	python=$(yt_python)
	[ "$python" ] || skip "yt is not there (apt-get install python3-yt)"
	pinit two-body | cycle -n 4 --every 2 --store all 'push kick/2 drift | p2m -n 8x7x10 | poisson-fft | mgrad | m2p | push kick/2' >a.pm
	sh5 -o a.h5 <a.pm
	cat >look.py <<'END'
import yt
yt.set_log_level("error")
series = yt.load("a.h5")
d = series[4]
print(*[int(k) for k in series._pre_outputs], float(d.current_time), *d.particle_type_counts.values())
print(*sorted(name for kind, name in d.field_list if kind == "openPMD"))
print(int(("io", "particle_velocity_x") in d.field_list))
for x in sorted(float(x) for x in d.all_data()["openPMD", "phi"]): print("%.17g" % x)
END
	run -0 --separate-stderr "$python" look.py
	[ "${lines[0]}" = "0 2 4 $(diag <a.pm | column time | tail -n 1) 2" ]
	[ "${lines[1]}" = "g_x g_y g_z phi rho" ]
	[ "${lines[2]}" = 1 ]
	sel --last <a.pm | stab --plain --mesh mesh | awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "phi") c = i; next } NF { printf "%.17g\n",
		$c }' | sort -g >want
	[ "$(wc -l <want)" = 792 ]
	printf '%s\n' "${lines[@]:3}" | sort -g | diff - want
}

@test "scmp and stack read HDF5 wherever they take a file, and cycle keeps and resumes its checkpoint in it" {
	mesh >a.pm
	sh5 -o a.h5 <a.pm
	sh_ok 'scmp --tolerance 0 a.h5 a.pm; scmp --tolerance 0 - a.h5 <a.pm'
	stack --merge a.pm a.pm >two.pm
	sh_ok 'stack --merge a.h5 a.pm | scmp --tolerance 0 - two.pm'
	says 1 "scmp: frame 1 of no.h5: sh5: cannot open 'no.h5'*" scmp a.pm no.h5
	says 1 "stack: no.h5: frame 1: sh5: cannot open 'no.h5'*" stack a.pm no.h5
	pinit two-body >b.pm
	leapfrog='push kick/2 drift | pp | push kick/2'
	cycle -n 6 --every 2 --checkpoint c.h5 "$leapfrog" <b.pm >whole.pm
	[ "$(h5ls c.h5/data | cut -d' ' -f1)" = 6 ]
	cycle -n 2 --checkpoint c.h5 "$leapfrog" <b.pm >/dev/null
	cycle -n 6 --resume c.h5 "$leapfrog" | cmp - <(sel --last --no-history <whole.pm)
	[ -z "$(ls | grep part)" ]
	says 1 "cycle: stopped by sh5: cannot open 'no.h5'*" cycle -n 6 --resume no.h5 "$leapfrog"
	says 1 "cycle: cannot write '/nosuch/c.h5'*" cycle -n 6 --checkpoint /nosuch/c.h5 -i b.pm -o /dev/null "$leapfrog"
}

@test "-i and -o of any tool read and write HDF5" {
	mesh >a.pm
	sh5 -o a.h5 <a.pm
	p2m -i a.h5 | cmp - <(p2m <a.pm)
	p2m -i a.h5 -o b.h5
	sh5 b.h5 | cmp - <(p2m <a.pm)
	pinit plummer -n 20 -o c.h5
	sh5 c.h5 | cmp - <(pinit plummer -n 20)
	cycle -n 2 -i c.h5 -o d.h5 'push kick/2 drift | pp | push kick/2'
	sh5 d.h5 | cmp - <(sh5 c.h5 | cycle -n 2 'push kick/2 drift | pp | push kick/2')
	diag -i d.h5 | cmp - <(sh5 d.h5 | diag)
	sh5 -i d.h5 -o e.h5
	cmp d.h5 e.h5
}

@test "unsupported files are refused in one line" {
	mesh | sh5 -o a.h5
	says 1 "sh5: cannot open 'no.h5': No such file or directory" sh5 no.h5
	head -c 5000 "$top/COPYING" >text.h5
	says 1 "sh5: 'text.h5' is not HDF5*" sh5 text.h5
	: >empty.h5
	says 1 "sh5: 'empty.h5' is not HDF5*" sh5 empty.h5
	head -c 20000 a.h5 >cut.h5
	says 1 "sh5: cannot open 'cut.h5' (HDF5: truncated file*" sh5 cut.h5
	sed 's/openPMD\x00/openPMX\x00/' a.h5 >plain.h5
	says 1 "sh5: this is HDF5, but neither openPMD*" sh5 plain.h5
	sed 's/"n":50/"n":51/' a.h5 >lie.h5
	says 1 "sh5: iteration 0: 'particles/matter/position/x' does not agree with the header of the frame*" env PM_UNSEALED=1 sh5 lie.h5
	sed 's/"mass","on"/"mess","on"/' a.h5 >lie.h5
	says 1 "sh5: iteration 0: 'particles/matter/mess' does not agree*" env PM_UNSEALED=1 sh5 lie.h5
	sed 's/"type":"i64"/"type":"f64"/' a.h5 >lie.h5
	says 1 "sh5: iteration 0: 'particles/matter/id' does not agree*" env PM_UNSEALED=1 sh5 lie.h5
	says 1 "p2m: stopped by sh5: cannot open 'no.h5': No such file or directory" p2m -i no.h5
	says 1 "diag: stopped by sh5: cannot open 'no.h5'*" diag -i no.h5
}

@test "what cannot be written leaves nothing behind, and the code of the failure arrives" {
	mesh >a.pm
	says 1 "sh5: cannot write '/nosuch/x.h5': No such file or directory" sh5 -i a.pm -o /nosuch/x.h5
	says 1 "sh5: cannot write '/dev/null': it is not a regular file" sh5 -i a.pm -o /dev/null
	says 1 "p2m:*cannot write '/nosuch/x.h5': No such file or directory" p2m -i a.pm -o /nosuch/x.h5
	wire cut a.pm in-field-v1 >cut.pm 2>/dev/null || head -c 3000 a.pm >cut.pm
	echo old >x.h5
	says 1 "sh5: frame 1: the input ends in*" sh5 -i cut.pm -o x.h5
	[ "$(cat x.h5)" = old ]
	says 1 "p2m: frame 1:*cut*" p2m -i cut.pm -o x.h5
	[ "$(cat x.h5)" = old ]
	says 2 "p2m: no option '--nonsense'*" p2m -i a.pm -o x.h5 --nonsense
	run bash -c 'pinit uniform --nonsense 2>/dev/null | sh5 -o x.h5 2>err'
	[ "$status" = 2 ]
	grep -q '^sh5: stopped by pinit: no option' err
	[ "$(cat x.h5)" = old ]
	[ -z "$(ls | grep part)" ]
	says 2 "diag: 'x.h5': .h5 files hold streams, but diag writes text" diag -i a.pm -o x.h5
}

@test "a full disk: exit 1, one line, nothing left" {
	pinit uniform -n 20000 >a.pm
	got=0
	(trap '' XFSZ; ulimit -f 100; sh5 -o x.h5 <a.pm 2>err) || got=$?
	[ $got = 1 ]
	[ "$(wc -l <err)" = 1 ]
	grep -q '^sh5: ' err
	[ -z "$(ls | grep h5)" ]
}

@test "wrong options are usage errors; inside a sentence sh5 is refused" {
	says 2 "sh5: which way?*" sh5
	says 2 "cycle: *sh5 reads or writes a file*" cycle -n 1 'push drift | sh5 -o x.h5'
}

@test "only sh5 links HDF5" {
	command -v ldd >/dev/null || skip "no ldd here"
	for t in "$top"/bin/*; do
		[ "${t##*/}" = sh5 ] || ! ldd "$t" | grep -q hdf5 || { echo "$t"; return 1; }
	done
	ldd "$top/bin/sh5" | grep -q hdf5
}

# flip FILE TEXT OFFSET: damaged.h5, with a bit flipped in the byte that lies so far behind the start of the first TEXT (or bytes, 0x...).
flip() {
	python3 - "$@" <<-'PY'
		import sys
		data = bytearray(open(sys.argv[1], "rb").read())
		what = bytes.fromhex(sys.argv[2][2:]) if sys.argv[2].startswith("0x") else sys.argv[2].encode()
		data[data.index(what) + int(sys.argv[3])] ^= 4
		open("damaged.h5", "wb").write(data)
	PY
}

@test "every dataset has a checksum: one bit in the data, the header or the report is refused with its name; files without are read" {
	pinit plummer -n 20 --seed 1 --cells 4 | p2m | poisson-fft >a.pm
	sh5 -o a.h5 <a.pm
	[ "$(h5dump -A a.h5 | grep -c 'ATTRIBUTE "pmpipeCrc32c"')" = "$(( $(h5ls -r a.h5 | grep -c Dataset) + 1 ))" ]
	h5dump -d /data/0/particles/matter/position/y -b LE -o y.bin a.h5 >/dev/null
	flip a.h5 "0x$(od -An -tx1 -j 16 -N 8 y.bin | tr -d ' ')" 3
	says 1 "sh5: iteration 0: the checksum of 'particles/matter/position/y' is wrong: the file is damaged*" sh5 damaged.h5
	says 1 "sls: stopped by sh5: iteration 0: the checksum of 'particles/matter/position/y' is wrong*" sls -i damaged.h5
	[ "$(PM_UNSEALED=1 sh5 damaged.h5 | cmp -l - a.pm | wc -l)" -gt 0 ]
	flip a.h5 '"seed":1' 7
	says 1 "sh5: iteration 0: the checksum of 'pmpipeHeader' is wrong*" sh5 damaged.h5
	flip a.h5 '"plan":"own"' 9
	says 1 "sh5: iteration 0: the checksum of 'pmpipeReport' is wrong*" sh5 damaged.h5
	sed 's/pmpipeCrc32c/pmpipeCrc32x/g; s/HeaderCrc32c/HeaderCrc32x/g; s/ReportCrc32c/ReportCrc32x/g' a.h5 >older.h5
	sh5 older.h5 | cmp - a.pm
}

@test "the order of the frames and the ends of streams have a checksum" {
	for k in 1 2 3; do pinit two-body | smod --time $k; done >a.pm
	sh5 -o a.h5 <a.pm
	sed 's/pmpipeStreams/pmpipeStreamz/' a.h5 >one.h5
	says 1 "sh5: the checksum of 'the sequence of the frames' is wrong*" sh5 one.h5
	sed 's/pmpipeHeader\x00/pmpipeHeadex\x00/' a.h5 >headless.h5
	says 1 "sh5: iteration *: no attribute 'pmpipeHeader', but the file is one of sh5's: it is damaged" sh5 headless.h5
}

# Fields of several pieces (256 KB): particles of f64, f32 and i64; rows, planes and parts of rows of meshes.
@test "fields of several pieces: through a file, handed over, from chunks of another program; cut or damaged within one they end no stream well" {
	wire edit <(pinit uniform -n 70001 --seed 3 --cells 37x41x43) '
h["fields"].append({"name": "T", "on": "matter", "components": 2, "type": "f32", "role": "state", "kind": "value", "unit": ""})
data.append(bytearray(struct.pack("<140002f", *(k % 997 / 7 for k in range(140002)))))' | p2m >a.pm
	(pinit uniform --dim 2 -n 100 --cells 40000x3 && pinit uniform -n 100 --cells 190x201x3) | p2m >b.pm
	cat a.pm b.pm >c.pm
	there_and_back c.pm
	mv back.h5 whole.h5
	PM_HANDOVER=0 sh5 -o back.h5 <c.pm
	cmp back.h5 whole.h5
	cat c.pm | sel | sh5 -o back.h5 # handed over
	sh5 back.h5 | sel --no-history | scmp --tolerance 0 - c.pm >/dev/null
	sh5 whole.h5 | sel --no-history | cmp - c.pm
	sh5 whole.h5 | PM_HANDOVER=0 sel --no-history | cmp - c.pm
	if command -v h5repack >/dev/null; then
		h5repack -l /data/0/particles/matter/T/x:CHUNK=5000 -f /data/0/particles/matter/T/x:GZIP=1 whole.h5 chunks.h5
		sh5 chunks.h5 | cmp - c.pm
	fi
	for bytes in 300000 1900000 4000000; do
		head -c $bytes c.pm >cut.pm
		says 1 "sh5: frame 1: the input ends in the data: it was cut*" sh5 -o cut.h5 <cut.pm
	done
	[ ! -e cut.h5 ]
	flip whole.h5 "0x$(python3 -c 'import struct; print(struct.pack("<4f", *(k % 997 / 7 for k in range(66000, 66004))).hex())')" 5
	sh5 damaged.h5 >damaged.pm 2>said && return 1
	grep -q "^sh5: iteration 0: the checksum of 'particles/matter/T/x' is wrong" said
	[ "$(wc -l <said)" = 1 ]
	says 1 "sls: stopped by sh5: iteration 0: the checksum of 'particles/matter/T/x' is wrong*" sls <damaged.pm
	says 1 "sls: stopped by sh5: iteration 0: the checksum of 'particles/matter/T/x' is wrong*" sls -i damaged.h5
}

@test "of 60 files with a bit flipped and 30 with 30 bytes overwritten none gives another stream, and none ends sh5 by a signal" {
	run -0 python3 "$top/tests/flip-hdf5.py" 60 5
	echo "$output"
	run -0 python3 "$top/tests/flip-hdf5.py" 30 6 --bytes 30
	echo "$output"
}

@test "the process that reads the file crashes or does not get on: one line, exit 1, and an abort behind the part that was sent" {
	pinit uniform -n 200000 -o big.h5
	mkfifo pipe
	PM_HANDOVER=0 sh5 big.h5 >pipe 2>said & # memory would be handed over whole, and its process done
	pid=$!
	exec 7<pipe
	for _ in $(seq 200); do
		child=$(ps -o pid= --ppid $pid) && break
		sleep 0.05
	done
	sleep 0.5 # both pipes are full
	kill -SEGV $child
	run -1 --separate-stderr sls <&7
	[[ $stderr == "sls: stopped by sh5: the process that reads the file was ended by signal 11 (HDF5 1."* ]] || { echo "$stderr"; return 1; }
	exec 7<&-
	wait $pid && return 1
	[ "$(wc -l <said)" = 1 ]
	grep -q '^sh5: the process that reads the file was ended by signal 11' said
	pinit two-body | cycle -n 300 --every 1 'push drift' -o long.h5
	PM_H5_SECONDS=0.000001 says 1 "sh5: the HDF5 library does not get on*" sh5 long.h5 # the first tick of the clock ends it
}

@test "the process that writes the file crashes: one line, exit 1, nothing is left, the old file stays" {
	pinit two-body | sh5 -o a.h5
	cp a.h5 old.h5
	(pinit two-body && sleep 2) | sh5 -o a.h5 2>said &
	pid=$!
	for _ in $(seq 200); do
		child=$(ps -o pid= --ppid $pid) && break
		sleep 0.05
	done
	kill -SEGV $child
	wait $pid && return 1
	cmp a.h5 old.h5
	grep -qx 'sh5: the process that writes the file was ended by signal 11.*' said
	[ "$(wc -l <said)" = 1 ]
	[ "$(ls -A | tr '\n' ' ')" = "a.h5 old.h5 said " ] || { ls -A; return 1; }
}
