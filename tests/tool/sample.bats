# sample: particles as a function; mollifiers, orders, the valley of the error, images (000:S07, N02, N03, N05, Exercise 1; 001:F1, F2, N42 to N45).
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# lattice N DIM CELLS [stab options]: u = prod (1 + sin(2 pi x)/2) at the points (i + 0.3)/N of a unit box, as strengths called heat.
lattice() {
	awk -v n="$1" -v dim="$2" 'BEGIN { pi = atan2(0, -1); h = 1 / n; split("x y z", c, " ")
		for (d = 1; d <= dim; d++) s = s c[d] " "
		print s "heat volume"
		for (i = 0; i < n ^ dim; i++) {
			k = i; s = ""; f = 1
			for (d = 1; d <= dim; d++) { x = (k % n + 0.3) * h; k = int(k / n); s = s sprintf("%.17g ", x); f *= 1 + 0.5 * sin(2 * pi * x) }
			printf "%s%.17g %.17g\n", s, f * h ^ dim, h ^ dim } }' | stab - --strength heat --box 0,1 --faces periodic -n "$3" "${@:4}"
}
most() { scmp --norm max --field sampled "$1" "$2" | tail -1 | cut -f7; }
k='(2*pi)'
u=("" "1+0.5*sin($k*x)" "(1+0.5*sin($k*x))*(1+0.5*sin($k*y))" "(1+0.5*sin($k*x))*(1+0.5*sin($k*y))*(1+0.5*sin($k*z))")
lap2="-0.5*$k^2*(sin($k*x)+sin($k*y)+sin($k*x)*sin($k*y))"
grad2="0.5*$k*cos($k*x)*(1+0.5*sin($k*y)), 0.5*$k*cos($k*y)*(1+0.5*sin($k*x))"

@test "the value is of order 2, 4 and, algebraic, 3 to 4, in 1-D to 3-D (000:N02, 001:N42)" {
	for row in '1 2 gaussian 24 32 48' '2 2 gaussian 24 32 48' '3 2 gaussian 24 32 40' '1 4 gaussian 24 32 48' '2 4 gaussian 24 32 48' \
		'3 4 gaussian 24 32 40' '2 3.3 algebraic 64 96 128'; do
		read -r dim claim kind ns <<<"$row"
		e=()
		for n in $ns; do
			lattice "$n" "$dim" 8 >a
			sample --field heat --mollifier "$kind" $([ "$kind" = gaussian ] && echo --order "$claim") <a >b
			scalc --mesh mesh "sampled=${u[dim]}" <b >c
			e+=("$(calc "1/$n")" "$(most b c)")
		done
		order "$(calc "$claim-0.05")" "${e[@]}" # 1.9 to 2.0, 3.8 to 4.0 at these widths; algebraic 3.2 to 3.4: a logarithm
	done
}

@test "gradient and Laplacian have the order of the mollifier on a lattice with overlap, as the value (001:F2, N43 as corrected)" {
	for row in "2 grad $grad2" "4 grad $grad2" "2 lap $lap2" "4 lap $lap2"; do
		read -r claim operator exact <<<"$row"
		e=()
		for n in 24 32 48; do
			lattice $n 2 8 >a
			sample --field heat --order "$claim" --operator "$operator" <a >b
			scalc --mesh mesh "sampled=$exact" <b >c
			e+=("$(calc "1/$n")" "$(most b c)")
		done
		order "$(calc "$claim-0.1")" "${e[@]}"
	done
}

@test "overlap: a lattice sums to 1 within 5e-9 at eps = h, 1.4e-2 at h/2, 0.59 at h/4 (000:N03)" {
	lattice 20 1 64 | scalc --extensive 'one=volume' >a
	for row in '1 5.33e-9 1e-11' '0.5 1.434e-2 1e-5' '0.25 0.595 1e-3'; do # 2 exp(-2 pi^2 (eps/h)^2), and where that is not small the next wave
		read -r overlap want tolerance <<<"$row"
		sample --field one --overlap "$overlap" <a >b
		scalc --mesh mesh 'sampled=1' <b >c
		within "$(most b c)" "$want" "$tolerance" "eps = $overlap h"
	done
}

@test "the error over eps has a valley, and that of the Laplacian lies at larger eps (000:N03, N05)" {
	lattice 32 1 64 >a
	valley() { # OPERATOR EXACT: the overlap of least error
		for overlap in 0.4 0.5 0.6 0.7 0.8 0.9 1 1.2 1.5 2; do
			sample --field heat --order 4 --operator "$1" --overlap $overlap <a >b
			scalc --mesh mesh "sampled=$2" <b >c
			echo "$overlap $(most b c)"
		done >map
		awk 'NR == 1 || $2 < least { least = $2; at = $1 } { first = NR == 1 ? $2 : first; last = $2 }
			END { exit !(first > 20 * least && last > 20 * least) }' map || cat map >&2
		awk 'NR == 1 || $2 < least { least = $2; at = $1 } END { print at }' map
	}
	value=$(valley value "${u[1]}")
	laplacian=$(valley lap "-0.5*$k^2*sin($k*x)")
	between "$value" 0.7 1 # exp(-2 pi^2 (eps/h)^2) meets (2 pi eps)^4/8
	above "$laplacian" "$(calc "$value+0.05")"
}

@test "the map over h and eps of sample.md: at eps = h/2 the error of the Laplacian grows as h^-2, beyond h only eps counts (000:N03, N05)" {
	for n in 16 32 64; do
		lattice $n 1 320 >a
		for width in 128 64 32 16; do
			for job in 'value 1+0.5*sin(2*pi*x)' 'lap -0.5*(2*pi)^2*sin(2*pi*x)'; do
				sample --field heat --operator "${job%% *}" --eps "$(calc "1/$width")" <a >b
				scalc --mesh mesh "sampled=${job#* }" <b >c
				echo "$width ${job%% *} $(most b c)"
			done
		done
	done | awk '{ row[$1 " " $2] = row[$1 " " $2] sprintf(" %.3g", $3) } END { for (k in row) print k row[k] }' | sort -k2,2r -k1,1nr >map
	paste -d' ' <(awk '$2 == "value" { print $1, $3, $4, $5 }' map) <(awk '$2 == "lap" { print $3, $4, $5 }' map) >got
	grep -E '^[|] 1/(128|64|32|16) ' "$top/docs/methods/sample.md" | tr -d '|/' | awk '{ $1 = substr($1, 2); $1 = $1; print }' >want
	[ "$(wc -l <want)" = 4 ]
	paste -d' ' want got | awk '{ for (i = 1; i <= 7; i++) { d = $i / $(i + 7) - 1; if (d * d > 0.0025) { print; exit 1 } } }' # two digits
	between "$(awk '/^32 / { a = $5 } /^128 / { b = $7 } END { print b / a }' got)" 14 18 # h^-2 from 1/16 to 1/64 is 16
}

@test "every mollifier and operator is the plain sum over the particles, at nodes and at particles, in open space" {
	awk 'BEGIN { srand(7); print "x y z q volume"; for (i = 0; i < 23; i++) print rand(), rand(), rand(), rand() - 0.4, 0.02 }' >t
	stab t --strength q --box 0,1 -n 2 >a
	for row in 'gaussian 2 value' 'gaussian 2 grad' 'gaussian 2 lap' 'gaussian 4 value' 'gaussian 4 grad' 'gaussian 4 lap' 'algebraic 4 value' \
		'algebraic 4 grad' 'algebraic 4 lap'; do
		read -r kind order operator <<<"$row"
		sample --field q --eps 0.31 --mollifier $kind --order $order --operator $operator --cutoff 100 --at matter <a | stab --plain >got
		# u and its differences by steps of 1e-3, of which the fourth power is 1e-12: the reference knows no derivative of a mollifier.
		awk -v kind=$kind -v order=$order -v op=$operator 'function zeta(s) {
				if (kind == "algebraic") return 15 / (4 * 2 * pi) * 1 * (2.5 - s) / (1 + s) ^ 4.5 / 0.31 ^ 3
				return (order == 4 ? (5 - s) / 2 : 1) * exp(-s / 2) / (2 * pi) ^ 1.5 / 0.31 ^ 3 }
			function value(X, Y, Z, j, sum) {
				for (j = 1; j <= n; j++) sum += q[j] * zeta(((X - x[j]) ^ 2 + (Y - y[j]) ^ 2 + (Z - z[j]) ^ 2) / 0.31 ^ 2)
				return sum }
			function first(d, i) { return (8 * (at(d, i, 1) - at(d, i, -1)) - at(d, i, 2) + at(d, i, -2)) / 12 / h }
			function second(d, i) { return (16 * (at(d, i, 1) + at(d, i, -1)) - at(d, i, 2) - at(d, i, -2) - 30 * at(d, i, 0)) / 12 / h ^ 2 }
			function at(d, i, s) { return value(x[i] + (d == 0) * s * h, y[i] + (d == 1) * s * h, z[i] + (d == 2) * s * h) }
			BEGIN { pi = atan2(0, -1); h = 2e-3 }
			FNR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
			{ n++; x[n] = $1; y[n] = $2; z[n] = $3; q[n] = $4; s0[n] = $c[op == "grad" ? "sampled_0" : "sampled"]; s2[n] = $c["sampled_2"] }
			END { for (i = 1; i <= n; i++) {
					want = op == "value" ? at(0, i, 0) : op == "grad" ? first(0, i) : second(0, i) + second(1, i) + second(2, i)
					off = s0[i] - want; worst = off * off > worst ? off * off : worst; size = want * want > size ? want * want : size
					off = op == "grad" ? s2[i] - first(2, i) : 0; worst = off * off > worst ? off * off : worst }
				printf "%.3g\n", sqrt(worst / size) }' got >off
		below "$(cat off)" "$([ $operator = value ] && echo 1e-14 || echo 1e-7)" "$row" # differences: (h/eps)^4 = 2e-9 times derivatives
	done
	sample --field q --eps 0.31 <a >b # the nodes of the mesh are eight corners, edges and the middle
	stab t --strength q --box 0,1 -n 2 >p
	awk 'BEGIN { print "x y z"; for (k = 0; k < 3; k++) for (j = 0; j < 3; j++) for (i = 0; i < 3; i++) print i / 2, j / 2, k / 2 }' |
		stab - --set nodes --box 0,1 -n 2 | stack --merge p - | sample --field q --set matter --eps 0.31 --at nodes | sel --set nodes | stab --plain |
		awk 'NR > 1 { print $NF }' >at
	stab b | sed '1,/^#mesh/d' | awk '/^[-0-9]/' >nodes
	[ "$(wc -l <at)" = 27 ]
	[ "$(wc -l <nodes)" = 27 ]
	paste at nodes | awk '{ d = $1 - $2; if (d * d > 1e-26) exit 1 }'
}

@test "walls have odd images and neumann faces even ones" {
	printf 'x q\n0.07 1\n0.4 -0.3\n' | stab - --strength q --box 0,1 --faces wall,neumann -n 10 | sample --field q --eps 0.2 --target s | stab >a
	awk 'BEGIN { print "x q"; split("0.07 0.4", x, " "); split("1 -0.3", q, " ")
		for (i = 1; i <= 2; i++) { print x[i], q[i]; print 4 - x[i], -q[i]; print 2 - x[i], q[i]; print 2 + x[i], -q[i] } }' |
		stab - --strength q --box 0,4 --faces periodic -n 40 | sample --field q --eps 0.2 --target s | stab >b
	numbers() { sed '1,/^#mesh/d' "$1" | awk '/^[-0-9]/ { print $NF }' | head -11; }
	paste <(numbers a) <(numbers b) | awk '{ d = $1 - $2; n++; if (d * d > 1e-28) exit 1 } END { exit n != 11 }'
}

@test "what cannot be sampled is refused by name, and the width is reported" {
	lattice 8 1 8 >a
	sample --field heat <a >b
	tail -c 300 b | grep -aq '"eps":0.1875'
	while IFS='|' read -r code options text; do
		run -$code --separate-stderr sample $options <a
		[[ $stderr == *"$text"* ]] || { echo "$options: $stderr"; return 1; }
	done <<'ROWS'
1||the law free has no strength (--field NAME)
1|--field mass|no set with x and 'mass'
1|--field heat --set probes|no set named probes with x and 'heat'
1|--field heat --at probes|no set probes
1|--field heat --mesh fine|no mesh fine
2|--field heat --eps 1 --overlap 2|--eps or --overlap, not both
2|--field heat --mollifier algebraic --order 2|the algebraic mollifier has order 4
1|--field heat --at matter --target volume|'volume' on 'matter' is there and not derived
ROWS
	scalc --role state 'heat=0' <a | sel --field x,heat | cat >c
	run -1 --separate-stderr sample --field heat <c
	[[ $stderr == *"no field 'volume' on 'matter', from which --overlap takes the width"* ]]
}

# rim N FUNCTION: values f on N^2 points of the unit square moved by a third of their distance, open faces, sampled on a mesh of 8 x 8 cells.
rim() {
	awk -v n="$1" 'function r(k) { k = sin(12.9898 * k) * 43758.5453; return k - int(k) } BEGIN { h = 1 / n; print "x y f volume"
		for (i = 0; i < n; i++) for (j = 0; j < n; j++) { x = (i + 0.5 + r(i*n + j)/3)*h; y = (j + 0.5 + r(j*n + i + 0.5)/3)*h
			printf "%.17g %.17g %.17g %.17g\n", x, y, '"$2"', h*h } }' | stab - --law passive --box 0,1 --faces open -n 8
}

@test "--correct: a constant is 1 and a linear function exact up to an open rim and its corners, to round-off (000:S19)" {
	rim 20 1 >one
	rim 20 '1 + 2*x - 3*y' >line
	sample --field f one | scalc --mesh mesh 'sampled = 1' >1
	sample --field f line | scalc --mesh mesh 'sampled = 1 + 2*x - 3*y' >2
	sample --field f one >b
	above "$(most b 1)" 0.5 "without it"
	for o in '' '--order 4' '--mollifier algebraic'; do
		sample --field f --correct unity $o one >b
		below "$(most b 1)" 1e-13 "unity $o"
	done
	sample --field f --correct unity line >b
	above "$(most b 2)" 0.05 "unity, a slope"
	sample --field f --correct linear one >b
	below "$(most b 1)" 1e-12 constant
	sample --field f --correct linear line >b
	below "$(most b 2)" 1e-12 linear # condition of M in a corner 50: 50 * 4 * 1e-16 * sqrt(400)
	for t in 1 3; do OMP_NUM_THREADS=$t sample --no-history --field f --correct linear line >t$t; done
	same_as t1 t3
}

@test "--correct linear is of second order up to the rim, unity of first; mirrors and their signs are as without" {
	unity=() linear=()
	for n in 16 32 64; do
		awk -v n=$n 'BEGIN { print "x f volume"; for (i = 0; i < n; i++) printf "%.17g %.17g %.17g\n", (i + 0.5)/n, exp((i + 0.5)/n), 1/n }' |
			stab - --law passive --box 0,1 --faces open -n 64 >a
		sample --field f a | scalc --mesh mesh 'sampled = exp(x)' >c
		sample --field f --correct unity a >b
		unity+=("$(calc 1/$n)" "$(most b c)")
		sample --field f --correct linear a >b
		linear+=("$(calc 1/$n)" "$(most b c)")
	done
	order 1 "${unity[@]}"
	order 2 "${linear[@]}"
	echo "${unity[@]}" "${linear[@]}" >&2
	for faces in neumann wall periodic; do # complete by images: 1 already, so nothing changes but round-off
		awk 'BEGIN { print "x f volume"; for (i = 0; i < 16; i++) printf "%.17g %.17g %.17g\n", (i + 0.5)/16, i, 1/16 }' |
			stab - --law passive --box 0,1 --faces $faces -n 16 >a
		sample --field f a >b
		for c in unity linear; do
			sample --field f --correct $c a >c
			below "$(most b c)" 1e-6 "$faces $c" # that of the sum at overlap 1.5
		done
	done
	run -2 sample --correct linear --order 4
	[[ $output == *"--correct linear needs a mollifier without negative parts (the Gaussian of order 2; or --correct unity)"* ]]
	run -2 sample --correct unity --operator lap
	[[ $output == *"--correct is of the value (leave out --operator)"* ]]
	stab - --law passive --box 0,9 --faces open -n 9 <<<$'x f volume\n1 1 1' >a
	run -0 bash -c 'sample --verbose --field f --correct linear a 2>&1 >b'
	[[ $output == *"5 points have hardly a particle in reach"* ]]
}
