# The tables of docs/methods/kernels.md: g(k), its zeros, distortion of waves (000:S49, N22), by docs/kernels.sh (stab, scalc, m2p),
# against closed forms.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

page="$BATS_TEST_DIRNAME/../../docs/methods/kernels.md"

@test "the tables of waves in kernels.md are what docs/kernels.sh prints, for every kernel of the table but three that are others" {
	"$top/docs/kernels.sh" >now
	awk -F'\t' 'NR > 1 { printf "| `%s` |", $1; for (i = 2; i <= 8; i++) printf " %s |", $i; print "" }' now >rows
	awk -F'\t' 'NR > 1 { printf "| `%s` |", $1; for (i = 9; i <= 14; i++) printf " %s |", $i; print "" }' now >>rows
	[ "$(wc -l <rows)" = 24 ]
	grep -Fxf rows "$page" | same_as - rows
	(cd "$top/lib/kernel" && ls -- *.c) | sed 's/\.c$//' | grep -vxE 'lambda-2-1|lambda-4-2|star' | sort >all
	awk 'NR > 1 { print $1 }' now | sort | same_as - all
}

@test "g(k) of B-splines is sinc^m, of M'4 3 s^4 - 2 s^3 cos(k/2), of lambda-2 the integral of its pieces (000:S13, N22)" {
	"$top/docs/kernels.sh" ngp cic tsc pcs m4prime lambda-2 | awk -F'\t' '
		function want(name, k, s, i, x, sum) {
			s = sin(k / 2) / (k / 2)
			if (name == "ngp") return s
			if (name == "cic") return s^2
			if (name == "tsc") return s^3
			if (name == "pcs") return s^4
			if (name == "m4prime") return 3 * s^4 - 2 * s^3 * cos(k / 2)
			for (i = 0; i < 3000; i++) { x = (i + 0.5) / 2000; sum += (x < 0.5 ? 1 - x * x : (x * x - 3 * x + 2) / 2) * cos(k * x) / 1000 }
			return sum }
		BEGIN { pi = atan2(0, -1); split("32 16 8 4 2", cells, " ") }
		NR > 1 { for (i = 1; i <= 5; i++) { d = $(i + 1) - want($1, 2 * pi / cells[i]); n++
			if (d * d > 36e-12) { print $1, cells[i], $(i + 1), want($1, 2 * pi / cells[i]); bad = 1 } } } # five digits are printed
		END { exit bad || n != 30 }'
}

@test "order m: g - 1 vanishes with order m at 0 and g at 2 pi, m one above the last exact moment (000:N22)" {
	"$top/docs/kernels.sh" | awk -F'\t' 'NR > 1 { m = $7 < $8 ? $7 : $8; print $1, m }' >orders
	printf '%s\n' 'ngp 1' 'cic 2' 'tsc 2' 'lambda-2 3' 'pcs 2' 'm4prime 3' 'lambda-2-2 3' 'm6prime 5' 'lambda-4-4 5' 'lambda-6-4 7' 'lambda-6-6 7' \
		'lambda-8-4 9' | same_as - orders
}
