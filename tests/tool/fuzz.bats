# What fuzzing found stays found (docs/reliability.md): every input of tests/fuzz/crashes/ through the ordinary programs. Each is read, or refused by one
# line without control characters. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

export OMP_NUM_THREADS=1 PM_UNSEALED=1
shopt -s nullglob
crashes=$top/tests/fuzz/crashes

# survives COMMAND...: exit status 0, or 1 to 3 and one line; no signal, no wait.
survives() {
	local status=0
	timeout 60 "$@" >out 2>err || status=$?
	[[ $status = 0 && ! -s err || $status = [123] && $(wc -l <err) = 1 && -s err ]] && ! LC_ALL=C grep -q '[[:cntrl:]]' err &&
		! LC_ALL=C grep -qE '^[a-z0-9-]+: *$' err || { echo "$*: status $status: $(cat -v err)"; return 1; }
}

@test "streams that broke the reader are read or refused" {
	for f in "$crashes"/reader/*; do
		survives sls -i "$f"
		survives stab -i "$f"
	done
}

@test "texts that broke stab are read or refused" {
	for f in "$crashes"/table/*; do survives stab "$f"; done
}

@test "expressions that broke the compiler are computed or refused" {
	pinit plummer -n 3 --cells 2 >a.pm
	for f in "$crashes"/expression/*; do
		survives sel -i a.pm --where "$(cat "$f")"
		survives scalc -i a.pm "a = $(cat "$f")"
	done
}

@test "sentences that broke cycle are run or refused" {
	pinit plummer -n 3 --cells 2 >a.pm
	for f in "$crashes"/sentence/*; do survives cycle -n 0 -i a.pm "$(cat "$f")"; done
}

@test "HDF5 files that broke sh5 are read or refused" {
	export PM_H5_SECONDS=1 # of the processor: one of them makes libhdf5 go round for ever
	for f in "$crashes"/hdf5/*; do survives sh5 "$f"; done
}
