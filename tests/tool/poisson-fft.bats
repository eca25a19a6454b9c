# poisson-fft: options and refusals. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
export PM_PLAN=estimate

# refused STATUS TEXT COMMAND LINE: exit status and a piece of the message.
refused() {
	run -"$1" --separate-stderr bash -c "$3 > out"
	[[ $stderr == *"$2"* ]] || { echo "message: $stderr" >&2; false; }
}

@test "poisson-fft: makes phi from rho, derived, with the kernel's name" {
	sh_ok "pinit uniform -n 100 | p2m -n 8 --kernel tsc | poisson-fft | sls"
	[[ $output == *"phi "*derived*"kernel tsc"* ]]
}

@test "poisson-fft: --source, --target and --coefficient work without a law's names" {
	sh_ok "pinit uniform -n 100 | p2m -n 8 --field weight | poisson-fft --source weight --target u --coefficient -2 | stab --plain --mesh mesh > a
		pinit uniform -n 100 | p2m -n 8 | poisson-fft --coefficient 1 | stab --plain --mesh mesh > b"
	worst=$(paste a b | awk 'NR > 1 { d = $5 + 2*$10; if (d < 0) d = -d; if (d > m) m = d } END { print m + 0 }')
	below "$worst" 1e-15
}

@test "poisson-fft: what it cannot do is refused with what can" {
	pinit uniform -n 100 > bare
	p2m -n 8 < bare > rho
	refused 1 "no field 'rho' on 'mesh' (p2m makes it" "poisson-fft < bare"
	refused 1 "no mesh named fine" "poisson-fft --mesh fine < rho"
	refused 2 "choose another --target" "poisson-fft --target rho < rho"
	refused 1 "absorbing" "pinit uniform -n 0 --faces absorbing | p2m -n 8 | poisson-fft"
	pinit uniform -n 0 --faces open | p2m -n 8 > open
	refused 1 "choose gauss10, gauss2" "poisson-fft --green cell --screening 2 < open"
	refused 1 "choose gauss2" "poisson-fft --green vico --softening 1 < open"
	refused 1 "leave out one of" "poisson-fft --green vico --symbol fd2 < open"
	refused 1 "choose --symbol fd2" "poisson-fft --green lattice --symbol spectral < open"
	refused 1 "there are none (leave it out)" "poisson-fft --green vico < rho"
	refused 2 "" "poisson-fft --green ewald < open"
	refused 2 "" "poisson-fft --screening -1 < rho"
	refused 2 "" "poisson-fft --symbol fd3 < rho"
	refused 2 "PM_PLAN is 'quick'" "PM_PLAN=quick poisson-fft < rho"
}

@test "poisson-fft: a cut stream, garbage and an empty input exit 1" {
	pinit uniform -n 100 | p2m -n 8 > rho
	refused 1 "" "head -c 3000 rho | poisson-fft"
	refused 1 "" "echo garbage | poisson-fft"
	refused 1 "" "poisson-fft < /dev/null"
}
