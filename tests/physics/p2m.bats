# Conservation in p2m: the moments of 1000 random particles before and after, summed over the mesh.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# moments: sum of m, m x, m y, m (x^2 + y^2) of a table of x y value on standard input, times a cell's volume.
moments() { awk -v v="$1" 'NR > 1 { m += $3; a += $3 * $1; b += $3 * $2; r += $3 * ($1 ^ 2 + $2 ^ 2) } END { printf "%.17g %.17g %.17g %.17g", m * v, a * v,
	b * v, r * v }'; }

@test "p2m conserves the moments stated by its kernel; cic, tsc and pcs widen the second as computed" {
	{
		echo "x y mass"
		pinit uniform -n 1000 --dim 2 --mass-spread 2 | stab --plain | awk 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "mass") c = i; next } {
			print 0.2 + 0.6 * $1, 0.3 + 0.5 * $2, $c }'
	} >particles
	stab - --law gravity --box 0,1 --faces open -n 20x25 <particles >a
	read -r m x y r <<<"$(moments 1 <particles)"
	for kernel in ngp cic tsc pcs m4prime; do
		read -r gm gx gy gr <<<"$(p2m --kernel $kernel <a | stab --plain --mesh mesh | moments 0.002)"
		# 1000 particles with six-digit positions read exactly: round-off of a thousand terms
		within "$gm" "$m" "$(awk -v m="$m" 'BEGIN { print 1e-13 * m }')" "$kernel: total"
		[ $kernel = ngp ] && continue
		within "$gx" "$x" "$(awk -v m="$m" 'BEGIN { print 1e-13 * m }')" "$kernel: sum m x"
		within "$gy" "$y" "$(awk -v m="$m" 'BEGIN { print 1e-13 * m }')" "$kernel: sum m y"
		# the second moment grows by m h^2/4 (tsc), m h^2/3 (pcs) per axis, not at all (m4prime), by m h^2 t(1-t) (cic: 0 to 1/4)
		h2=$(awk 'BEGIN { print 0.05 ^ 2 + 0.04 ^ 2 }')
		excess=$(awk -v a="$gr" -v b="$r" -v m="$m" -v h="$h2" 'BEGIN { printf "%.15g", (a - b) / (m * h) }')
		case $kernel in
		tsc) within "$excess" 0.25 1e-9 "tsc: second moment" ;;
		pcs) within "$excess" "$(awk 'BEGIN { printf "%.15g", 1 / 3 }')" 1e-9 "pcs: second moment" ;;
		m4prime) within "$excess" 0 1e-9 "m4prime: second moment" ;;
		cic) within "$excess" 0.166 0.03 "cic: second moment, 1/6 on average over t" ;;
		esac
	done
}
