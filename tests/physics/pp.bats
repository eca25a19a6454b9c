# Direct sums against closed forms: mollifiers, dimensions, momentum. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# value FIELD ROW [SET]: of the text of the frame on standard input.
value() { stab --plain --set "${3:-matter}" | awk -v f="$1" -v r="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == f) c = i; if (!c) exit 1;
	next } NR == r + 1 { print $c }'; }

two() { # two DIM R: masses 2 and 3 at distance R along x
	case $1 in
	1) printf 'x mass\n0 2\n%s 3\n' "$2" ;;
	2) printf 'x y mass\n0 0.5 2\n%s 0.5 3\n' "$2" ;;
	3) printf 'x y z mass\n0 0.5 1 2\n%s 0.5 1 3\n' "$2" ;;
	esac > t
	stab t --law gravity --constant G=1.7
}

@test "two masses: 2 pi G m in 1-D, 2 G m/r in 2-D, G m/r^2 in 3-D, towards each other" {
	within "$(two 1 2.385 | pp --mollifier none | value acc 1)" 32.04424506661589 1e-13 # 2 pi 1.7 3
	within "$(two 2 2.385 | pp --mollifier none | value acc_0 1)" "$(awk 'BEGIN { printf "%.17g", 2 * 1.7 * 3 / 2.385 }')" 1e-14
	within "$(two 3 2.385 | pp --mollifier none | value acc_0 2)" "$(awk 'BEGIN { printf "%.17g", -1.7 * 2 / 2.385^2 }')" 1e-15
}

@test "S4-4 to S4-6: Plummer, Rankine, Krasny, Gaussian cores inside and outside" {
	force() { two "$1" "$2" | pp --mollifier "$3" --softening 0.5 | value acc_0 1; }
	want() { awk "BEGIN { printf \"%.17g\", $1 }"; }
	within "$(force 3 0.3 plummer)" "$(want '1.7 * 3 * 0.3 / (0.09 + 0.25)^1.5')" 1e-14
	within "$(force 2 0.3 plummer)" "$(force 2 0.3 krasny)" 0
	within "$(force 2 0.3 krasny)" "$(want '2 * 1.7 * 3 * 0.3 / (0.09 + 0.25)')" 1e-14
	within "$(force 2 0.3 rankine)" "$(want '2 * 1.7 * 3 * 0.3 / 0.25')" 1e-14
	within "$(force 2 0.7 rankine)" "$(want '2 * 1.7 * 3 / 0.7')" 1e-14
	within "$(force 3 0.3 rankine)" "$(want '1.7 * 3 * 0.3 / 0.125')" 1e-14
	within "$(force 2 0.3 gaussian)" "$(want '2 * 1.7 * 3 / 0.3 * (1 - exp(-0.36))')" 1e-14
	within "$(force 3 4 gaussian)" "$(want '1.7 * 3 / 16')" 1e-15
}

@test "the potential excludes the particle's own, and sums to the energy of the pair" {
	within "$(two 3 2.385 | pp --softening 0.5 --potential | value phi 1)" "$(awk 'BEGIN { printf "%.17g", -1.7 * 3 / sqrt(2.385^2 + 0.25) }')" 1e-15
	within "$(two 2 2.385 | pp --mollifier none --potential | value phi 2)" "$(awk 'BEGIN { printf "%.17g", 2 * 1.7 * 2 * log(2.385) }')" 1e-14
}

@test "a test particle is accelerated and exerts no force; a fixed set exerts a force and is not moved" {
	pinit kepler | pp --potential > a
	within "$(value acc_0 1 < a)" "$(awk 'BEGIN { printf "%.17g", 1 / 1.9^2 }')" 1e-15
	run ! value acc_0 1 sun < a
	within "$(value phi 1 sun < a)" "$(awk 'BEGIN { printf "%.17g", -1 / 1.9 }')" 1e-15
}

@test "half loop and full loop agree to round-off, and both conserve momentum to round-off" {
	pinit plummer -n 1500 > a
	for loop in half full; do
		pp --loop $loop < a > $loop
		stab --plain < $loop | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { a = $c["acc_0"]; s += a; t += a < 0 ? -a : a } END {
			printf "%.9g\n", s / t }' > momentum
		below "$(cat momentum)" 1e-14 "momentum, $loop"
	done
	below "$(scmp --field acc half full | column relative_l2)" 1e-13 "half and full"
}
