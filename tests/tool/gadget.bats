# sh5 on snapshots in GADGET's HDF5 layout. tests/gadget.py writes them with h5py after the published layout, with numbers that follow from the index; the
# wanted numbers are computed here from the same formula. Tolerances: none, all numbers are exact in both precisions.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

snapshot() {
	for p in python3 /usr/bin/python3; do
		if "$p" -c 'import h5py' 2>/dev/null; then "$p" "$top/tests/gadget.py" snap "$1"; return; fi
	done
	skip "h5py is not there (apt-get install python3-h5py)"
}

# want N TYPE FACTOR MASS: x y z vx vy vz mass id of the particles of a type; MASS 0: the index from 1.
want() {
	awk -v n="$1" -v t="$2" -v s="$3" -v m="$4" 'BEGIN { for (i = 0; i < n; i++) { b = 0.25 * i + t; print 1 + b, 11 + b, 21 + b, s * (b - 3), s * (b + 7),
		s * (b + 17), m ? m : i + 1, 1000 * t + i } }'
}

got() {
	scalc "mass = 1 * mass" | stab --plain --set "PartType$1" | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
		NF { print $at["x"], $at["y"], $at["z"], $at["vx"], $at["vy"], $at["vz"], $at["mass"], $at["id"] }'
}

# agrees FILE.pm FACTOR: the three types of tests/gadget.py.
agrees() {
	for row in "0 3 0" "1 5 0.5" "5 2 0"; do
		read -r t n m <<<"$row"
		sel --set "PartType$t" <"$1" | got "$t" | diff - <(want "$n" "$t" "$2" "$m") || { echo "PartType$t"; return 1; }
	done
}

@test "a snapshot without units is read: positions, velocities, masses of the table and of the list, identities, time; the line says what is left out" {
	snapshot isolated
	run -0 --separate-stderr bash -c 'sh5 snap.hdf5 >a.pm'
	[ "$stderr" = "sh5: GADGET snapshot, 1 file, v = Velocities, an open box, no units stated, so the law is free (kpc, 1e10 Msun, km/s: \
smod --law gravity --constant G=43007.1); left out: PartType0/Metals (more than 16 columns), PartType0/Names (no numbers)" ]
	agrees a.pm 1
	[ "$(stab --plain --set PartType0 <a.pm | awk '{ print $NF }' | paste -sd' ')" = "InternalEnergy 0 0.125 0.25" ]
	sls <a.pm | grep -q '^frame 1: time 2.5 '
	smod --law gravity --constant G=43007.1 <a.pm | p2m -n 8 --outside drop 2>&1 >b.pm
	[ "$(sls <b.pm | grep -c ' rho ')" = 1 ]
	p2m -i snap.hdf5 -n 8 2>&1 | grep -q "the law 'free' deposits nothing on a mesh" # any word reads it
}

@test "a comoving snapshot in two files: v is sqrt(a) times what GADGET stores, the box is periodic, the files are joined in their order" {
	snapshot cosmological
	sh5 snap.0.hdf5 >a.pm 2>said
	grep -q '2 files, comoving lengths, v = sqrt(a) Velocities, the periodic box, law free' said
	agrees a.pm 0.5
	[ "$(sh5 snap.1.hdf5 2>/dev/null | stab | grep -v '^#' | cksum)" = "$(stab <a.pm | grep -v '^#' | cksum)" ] # whichever of the files is named
	sls <a.pm | grep -q 'box \[0, 64\] periodic x \[0, 64\] periodic'
	[ "$(sls <a.pm | grep -c ' v  *3 f32')" = 3 ]
	rm snap.1.hdf5
	run -1 --separate-stderr sh5 snap.0.hdf5
	[[ $stderr == "sh5: cannot open 'snap.1.hdf5', one of the 2 files of the snapshot"* ]] || { echo "$stderr"; return 1; }
	mv snap.0.hdf5 part.hdf5
	run -1 --separate-stderr sh5 part.hdf5
	[[ $stderr == "sh5: the snapshot has 2 files, and this name does not end in .0.hdf5"* ]] || { echo "$stderr"; return 1; }
}

@test "a snapshot with units: gravity with the constant in these units, units of the fields; identities beyond 2^63 are left out and named" {
	snapshot units
	sh5 snap.hdf5 >a.pm 2>said
	grep -q 'PartType5/ParticleIDs (whole numbers beyond 2^63)' said
	# CODATA 2018: 6.6743e-8 cm^3/(g s^2) times 1.989e43 g / (3.085678e21 cm (1e5 cm/s)^2)
	within "$(sls <a.pm | sed -n 's/.*law gravity (G \([0-9.]*\).*/\1/p')" 43021.93 0.01
	sls <a.pm | grep -q ' x  *3 f64 state value \[3.08568e+21 cm\]'
	sh5 -o again.h5 <a.pm
	[ -z "$(sh5 again.h5 2>&1 >b.pm)" ] # said once, by the word that read the snapshot
	cmp a.pm b.pm
}

@test "a snapshot of SWIFT: velocities are peculiar already, the masses of black holes have their name, the box has three sides" {
	snapshot swift
	sh5 snap.hdf5 >a.pm 2>said
	grep -q 'GADGET snapshot of SWIFT, 1 file, comoving lengths, v = Velocities, ' said
	agrees a.pm 1
	sls <a.pm | grep -qF 'box [0, 64] periodic x [0, 64] periodic x [0, 96] periodic'
	sls <a.pm | grep -q '^frame 1: time 0.003 '
}

@test "of 40 snapshots with a few bytes changed each is read, or refused in one line" {
	snapshot units
	python3 - <<'END'
import random, subprocess
data, dice = open("snap.hdf5", "rb").read(), random.Random(4)
used = [i for i, byte in enumerate(data) if byte]
for k in range(40):
    d = bytearray(data)
    for _ in range(1 << dice.randrange(5)):
        d[dice.choice(used)] = dice.choice([0, 1, 127, 255, dice.randrange(256)])
    open("bad.hdf5", "wb").write(d)
    done = subprocess.run(["sh5", "bad.hdf5"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=60)
    assert done.returncode in (0, 1) and done.stderr.count(b"\n") == 1, (k, done.returncode, done.stderr)
END
}
