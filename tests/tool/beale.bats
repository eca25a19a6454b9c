# beale: what an iteration gains, when it ends, what it reports, refusals.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

report() { sls --report | sed -n 's/.*beale.*"'"$1"'":\([^,}]*\).*/\1/p'; }

@test "every iteration multiplies the error of a wave by 1 - exp(-(k eps)^2/2), in the plane and in space" {
	for scene in 'taylor-green-2d --cells 32;2;0.19634954084936207' 'taylor-green-3d --cells 8;3;0.7853981633974483'; do
		IFS=';' read -r words k2 h <<<"$scene"
		for n in 0 1 3; do
			# shellcheck disable=SC2086
			pinit $words | beale --eps "$(calc "1.2 * $h")" --iterations $n --tolerance 0 >a
			within "$(report after <a)" "$(calc "(1 - exp(-$k2 * (1.2 * $h)^2 / 2))^($n + 1)")" 1e-8
			[ "$(report iterations <a)" = $n.0 ]
		done
	done
}

@test "the sampled field is the smoothed function of the strengths that are left, whose change is accounted for" {
	pinit lamb-oseen --cells 32 >a
	beale --overlap 1.2 <a >b
	sample --at vortices --overlap 1.2 --target again <b | scalc 'off = abs(again - sampled)' | sls --data | awk '$1 == "off" { getline; print $5 }' >off
	below "$(<off)" 1e-12
	within "$(calc "$(diag --columns circulation <b | tail -1) - $(diag --columns circulation <a | tail -1)")" "$(report given_circulation <b)" 1e-12
	beale --overlap 1.2 --threads 3 <a | cmp - b
}

@test "it ends at the tolerance, and an iteration that makes it worse is taken back" {
	pinit lamb-oseen --cells 64 | beale --overlap 1 --iterations 1000 --tolerance 1e-3 >a
	below "$(report after <a)" 1e-3
	below "$(report iterations <a)" 20
	# volumes three times too large: the factor of smooth waves is 1 - 3, it diverges
	pinit taylor-green-2d --cells 16 | scalc 'volume = 3*volume' >b
	beale --eps 0.3 <b >c 2>said
	[[ $(<said) == 'beale: the smoothed function differs from the given one by '*' too narrow for the spacing or wide for the function'* ]]
	pinit lamb-oseen --cells 16 | beale --eps 1e-6 2>&1 >d | grep -q 'beale: the smoothed function differs'
	pinit lamb-oseen --cells 32 | beale 2>said >d
	[ ! -s said ]
	[ "$(report iterations <c)" = 0.0 ]
	cmp <(stab --plain <b | column circulation) <(stab --plain <c | column circulation)
}

@test "beale: refusals in one sentence" {
	while IFS=';' read -r code command text; do
		run "-$code" --separate-stderr bash -c "$command"
		[[ $stderr == *"$text"* ]] || { echo "$command: $stderr"; return 1; }
	done <<-'END'
		1;pinit plummer -n 9 | beale;no field 'volume' on 'matter'
		1;pinit plummer -n 9 | scalc --extensive 'volume = 0' | beale --eps 1;has the volume 0 (above 0)
		1;pinit plummer -n 9 | beale --field v;no strength 'v' on 'matter'
		2;pinit lamb-oseen --cells 16 | beale --eps 1 --overlap 1;--eps or --overlap, not both
	END
}
