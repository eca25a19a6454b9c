# k A of a plane wave x = q + A sin(k q) from the text of stab --plain, one number a frame: 2 k/n sum (x - q) sin(k q), q from the id.
# awk -v n=PARTICLES (per axis; in 1-D) -f amplitude.awk. SPDX-License-Identifier: GPL-3.0-or-later
function out() { if (count) printf "%.17g\n", 2 * k * sum / count }
BEGIN { k = 2 * atan2(0, -1) }
NF == 0 { next }
/x/ {
	out()
	for (i = 1; i <= NF; i++) {
		if ($i == "x") cx = i
		if ($i == "id") ci = i
	}
	count = sum = 0
	next
}
{
	q = ($ci + 0.5) / n
	d = $cx - q
	d -= d > 0.5 ? 1 : d < -0.5 ? -1 : 0
	sum += d * sin(k * q)
	count++
}
END { out() }
