# stab on snapshots of NEMO. tests/nemo.py writes them after the published format, with numbers that follow from the index and are exact in both precisions.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

snapshot() { python3 -I -S "$top/tests/nemo.py" "$1" >snap; }

# The two snapshots as stab prints them: x y z vx vy vz mass id Aux.
want() { awk 'BEGIN { split("1 0.5 0.25", m); split("7 8 -9", id); split("0.125 0.25 0.5", aux); for (k = 0; k < 2; k++) for (i = 0; i < 3; i++)
	print 0.25 * i + k, 0.25 * i + 10 + k, 0.25 * i + 20 + k, -0.5 * i, -0.5 * i + 3, -0.5 * i + 6, m[i + 1], id[i + 1], aux[i + 1] }'; }
got() { stab --plain <"$1" | awk '$1 ~ /[a-z]/ { for (i = 1; i <= NF; i++) at[$i] = i; next }
	NF { print $at["x"], $at["y"], $at["z"], $at["vx"], $at["vy"], $at["vz"], $at["mass"], $at["id"], $at["Aux"] }'; }

@test "snapshots of NEMO are read in double and single precision and in either byte order: positions, velocities, masses written once, keys, times" {
	for kind in f8 f4 swapped; do
		snapshot $kind
		run -0 --separate-stderr bash -c 'stab snap >a.pm'
		[ "$stderr" = "stab: a snapshot of NEMO, law gravity with G = 1 (--law, --constant); left out: Diagnostics, Story" ]
		diff <(got a.pm) <(want) || { echo "$kind"; return 1; }
		[ "$(sls <a.pm | sed -n 's/^frame [12]: time \([^ ]*\) .*/\1/p' | paste -sd' ')" = "1.5 2.5" ]
		sls <a.pm | grep -qx '  law gravity (G 1)'
	done
	[ "$(stab snap 2>/dev/null | stab | grep -v '^#' | cksum)" = "$(stab - <snap 2>/dev/null | stab | grep -v '^#' | cksum)" ]
	stab snap --law free --time 4 --set stars --box=-50,50 2>/dev/null | sls >said
	grep -q '^frame 2: time 4 ' said && grep -q '  law free' said && grep -q 'set stars: 3' said && grep -qF 'box [-50, 50]' said
}

@test "what is no cartesian snapshot, or is cut, is refused in one line that says where" {
	snapshot spherical
	run -1 --separate-stderr bash -c 'stab snap >/dev/null'
	[ "$stderr" = "stab: snap: the coordinates are not cartesian" ]
	snapshot f8
	head -c 300 snap >cut
	run -1 --separate-stderr bash -c 'stab cut >/dev/null'
	[[ $stderr == "stab: cut: byte "*" of a NEMO file: it ends within the data of an item" ]] || { echo "$stderr"; return 1; }
	run -2 --separate-stderr bash -c 'stab snap --number >/dev/null'
	[ "$stderr" = "stab: snap: --number is for plain tables, and this is a snapshot of NEMO" ]
}

@test "of 150 snapshots with a few bytes changed each is read, or refused in one line" {
	snapshot f4
	python3 - <<'END'
import random, subprocess
data, dice = open("snap", "rb").read(), random.Random(9)
for k in range(150):
    d = bytearray(data)
    for _ in range(1 << dice.randrange(4)):
        d[dice.randrange(4, len(d))] = dice.choice([0, 1, 40, 41, 127, 255, dice.randrange(256)])
    done = subprocess.run(["stab", "-"], input=bytes(d), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=60)
    assert done.returncode in (0, 1) and done.stderr.count(b"\n") == 1, (k, done.returncode, done.stderr)
END
}
