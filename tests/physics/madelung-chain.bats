# The ionic chain, charges (-1)^n at x = n: its potential at (1/4, 1/4) by the plain sum, by Ewald's split, and by words (002:FT1, N25).
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

exact=1.3985527798610

@test "800001 terms of the plain sum leave 2.5e-6; one distant term and seven near ones 2.9e-8" {
	python3 -I -S - >sums <<'END'
from math import cos, erfc, exp, hypot, pi
x = y = 0.25
print("plain", sum((1 - 2 * (n % 2)) / hypot(x - n, y) for n in range(-400000, 400001)))

def distant(k, n=4000):  # (1/pi) int_0^1 exp(-k^2/(4 u^2) - y^2 u^2)/u du, Simpson's rule; the integrand is 0 at 0
    f = lambda u: exp(-k * k / (4 * u * u) - y * y * u * u) / u if u > 0 else 0
    return sum((1 if i in (0, n) else 4 if i % 2 else 2) * f(i / n) for i in range(n + 1)) / (3 * n * pi)

far = 4 * pi * cos(pi * x) * distant(pi)
print("second", 4 * pi * cos(3 * pi * x) * distant(3 * pi))
near = sorted(range(-9, 10), key=lambda n: abs(n - x))
for terms in (5, 6, 7):
    print(terms, far + sum((1 - 2 * (n % 2)) * erfc(r) / r for n in near[:terms] for r in [hypot(x - n, y)]))
END
	off() { awk -v n="$1" -v e=$exact '$1 == n { print $2 - e }' sums; }
	within "$(off plain)" 2.5e-6 1e-7 "800001 terms" # half of the first term left out at either end
	below "$(awk '$1 == "second" { print $2 }' sums)" 2e-11 "the second distant term" # 1.3e-11; its integral alone 1.5e-12
	below "$(off 5)" 3.6e-5 "five near terms" # 3.5e-5
	below "$(off 6)" 1.3e-6 "six"             # 1.2e-6
	below "$(off 7)" 3.0e-8 "seven"           # 2.9e-8
}

# Two ions a period, periodic along x and open around; nodes at the ions and at (1/4, 1/4).
chain() { pinit ionic-chain --cells "$1"; }
at() { # N: 4 pi phi at (1/4, 1/4, 0)
	stab | sed '1,/^#mesh/d' | awk -F'\t' -v n="$1" '/^#/ { next } !c { for (i = 1; i <= NF; i++) if ($i == "phi") c = i; next }
		k++ == n / 8 + n * (5 * n / 8 + (n + 1) * n / 2) { printf "%.15g\n", $c * 4 * atan2(0, -1) }'
}

@test "the same number from p2m | poisson-fft, periodic along the chain and open around it, to order 6" {
	e=()
	for n in 24 32 48; do
		chain $n >c
		phi=$(p2m --kernel ngp <c | poisson-fft --symbol fd6 | at $n)
		e+=("$(calc "2/$n")" "$(awk -v a="$phi" -v e=$exact 'BEGIN { d = a - e; print d < 0 ? -d : d }')")
	done
	order 5.5 "${e[@]}" # a point charge at four to six cells: 5.9 between 32 and 64 cells, where 4.5e-6 is left
	below "${e[5]}" 3e-5
}

@test "each ion has Madelung's energy -ln 2/(4 pi): the energy on the mesh less that of a lone ion, to order 2" {
	e=()
	for n in 16 24 32; do
		both=$(pinit ionic-chain --cells $n | p2m --kernel ngp | poisson-fft --symbol fd2 | diag -q | column energy_field_mesh)
		one=$(printf 'x y z charge mass\n0 0 0 1 1\n' | stab - --law electrostatic --box -1,-1,-1,1,1,1 --faces open -n $n | p2m --kernel ngp |
			poisson-fft --symbol fd2 | diag -q | column energy_field_mesh)
		e+=("$(calc "2/$n")" "$(calc "-(4*pi*($both-2*$one)/2+log(2))")")
	done
	order 1.9 "${e[@]}" # 2.05
	below "${e[5]}" 1e-3
}
