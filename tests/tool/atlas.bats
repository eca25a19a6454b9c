# The atlas of accuracy: the page agrees with its files, each figure is made by its commands, and data/atlas/ has the measured values.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

page=$top/docs/accuracy/README.md
figures() { sed -n 's|^!\[.*](\([^)]*\)\.png)$|\1|p' "$page"; }
# below_picture NAME: the text of the page from the picture to the end of its section.
below_picture() { awk -v picture="]($1.png)" 'index($0, picture) { there = 1; next } there { print } there && /^```$/ && on { exit } /^```sh$/ {
	on = there }' "$page"; }

@test "every figure of the page has its picture, its numbers, commands that write both, and three sentences" {
	[ "$(figures | wc -l)" -ge 8 ]
	for name in $(figures); do
		below_picture "$name" >text
		[ "$(head -c 4 "$top/docs/accuracy/$name.png" | tail -c 3)" = PNG ] || { echo "$name.png is not there (make atlas)"; return 1; }
		[ "$(wc -c <"$top/docs/accuracy/$name.png")" -le 80000 ]
		awk -F'\t' 'NR == 1 { n = NF; for (i = 1; i <= NF; i++) error += $i == "error" } NF != n { exit 1 } END { exit !(error == 1 &&
			NR > 8) }' "$top/docs/accuracy/$name.tsv" || { echo "$name.tsv"; return 1; }
		grep -q "> $name\.png$" text && grep -qE "> $name\.tsv$" text || { echo "$name: no command writes its picture and its numbers"; return 1; }
		# Shows, choose, surprised: one sentence each, with one full stop, at its end.
		[ "$(grep -c '^- ' text)" = 3 ] || { echo "$name: not three sentences"; return 1; }
		for word in Shows Choose Surprised; do
			grep -qE "^- \*$word:\* ([^.!?]|[.!?][^ ])+\.$" text || { echo "$name: '$word:' is not one sentence"; return 1; }
		done
	done
}

@test "docs/accuracy/ holds the files of the page's figures and no others" {
	diff <(figures | sed 's/.*/&.png\n&.tsv/' | sort) <(cd "$top/docs/accuracy" && ls -- *.png *.tsv | sort)
}

@test "a figure is made by its commands, and its errors are those that are stored" {
	command -v pnmcat >/dev/null || skip "no netpbm here"
	OUT=$PWD bash "$top/docs/accuracy/atlas.sh" diffusion
	[ "$(head -c 4 diffusion.png | tail -c 3)" = PNG ]
	# Other instruction sets round differently: 1e-6 of an error, and the round-off of u = 0.4.
	paste "$top/docs/accuracy/diffusion.tsv" diffusion.tsv | awk -F'\t' 'NR == 1 { next } $1 $2 $3 != $5 $6 $7 { exit 1 } $4 == "-" || $8 == "-" { next }
		{ n++; d = $4 - $8; if (d < 0) d = -d; if (d > 1e-6 * $4 + 1e-14) { print; exit 1 } } END { exit n < 40 }'
	# N64: exchange at N = 25 to 1600, the kernel cut off at 5 eps, as in the notes.
	k=0
	for want in 7.09e-5 1.95e-5 5.6e-6 2.1e-6 1.25e-6 1.05e-6 1.00e-6; do
		within "$(awk -F'\t' -v n=$((25 * 2 ** k)) '$1 == "pse --cutoff 5" && $2 == "lattice" && $3 == n { print $4 }' diffusion.tsv)" $want "$(awk -v \
			w=$want 'BEGIN { print 0.006 * w }')" "N = $((25 * 2 ** k))"
		k=$((k + 1))
	done
}

@test "data/atlas/ has the documented columns, all numeric, and the errors of the figures" {
	grep -v '^#' "$top/data/atlas/force.tsv" >force
	[ "$(head -n 1 force)" = $'scene\tsolver\tkernel\tgradient\th_over_scale\terror\tns_per_particle' ]
	awk -F'\t' 'NR > 1 && !($1 ~ /^(smooth|clustered|vortex|vortex-quarter)$/ &&
		$2 ~ /^(poisson-(fft|mg)|pp)/ && $4 ~ /^([246-]|spectral)$/ && $5 >= 0 && $5 < 2 && $6 >= 0 &&
		$6 < 2 && $7 > 0) { print; exit 1 }' force
	diff <(sed 1d force | cut -f6) <(for f in smooth clustered vortex; do
		awk -F'\t' 'NR > 1 && $5 != "-" { print $5 }' "$top/docs/accuracy/force-$f.tsv"; done)
	for kernel in $(cut -f3 force | sed 1d | grep -v '^-$' | sort -u); do p2m --complete | grep -- '^--kernel' | grep -qw -- "$kernel"; done
	grep -v '^#' "$top/data/atlas/step.tsv" | diff - "$top/docs/accuracy/steps.tsv"
	[ "$(head -n 1 "$top/docs/accuracy/steps.tsv")" = $'problem\tscheme\tdt\terror\tevaluations' ]
	awk -F'\t' 'NR > 1 && !($3 > 0 && $4 ~ /^([0-9]|nan)/ && $5 > 0) { print; exit 1 }' "$top/docs/accuracy/steps.tsv"
	for what in force.tsv step.tsv; do grep -q "atlas/$what" "$top/data/README.md"; done
}

@test "a row of each table agrees with a new measurement" {
	want=$(awk -F'\t' '$1 == "clustered" && $2 == "poisson-fft" && $3 == "cic" && $4 == 4 && $5 == 0.875 { print $6 }' "$top/data/atlas/force.tsv")
	pinit plummer -n 20000 >stars
	p2m --kernel cic -n 32 <stars | poisson-fft | mgrad --order 4 | m2p >mesh
	pp <stars | scmp --field acc mesh - >norms
	within "$(column relative_l2 <norms)" "$want" 1e-6
	row=$(awk -F'\t' '$1 == "kepler" && $2 == "kdk" && $5 == 2049' "$top/data/atlas/step.tsv")
	within "$(cut -f3 <<<"$row")" "$(awk 'BEGIN { print 8 * atan2(1, 1) / 2048 }')" 1e-8
	pinit kepler --dt "$(awk 'BEGIN { printf "%.17g", 8 * atan2(1, 1) / 2048 }')" >start
	cycle -n 2048 'push kick/2 drift | pp | push kick/2' <start | scmp --field x --set matter - start >norms
	within "$(column relative_l2 <norms)" "$(cut -f4 <<<"$row")" 1e-8
}

@test "evaluations counted are those that run: passes of a scheme, and those of its start" {
	# A word that stores its input before passing it on (tee is stopped before its last line is in the file).
	cat >keep <<-'PY'
		#!/usr/bin/env python3
		import os
		kept = open("passed", "ab", 0)
		while data := os.read(0, 1 << 20):
		    kept.write(data)
		    os.write(1, data)
	PY
	chmod +x keep
	for scheme in kdk euler rk2 lsrk3 rk4 ab2 ab3; do
		rm -f passed
		sentence="pp | ./keep | push --unsafe $scheme"
		[ $scheme != kdk ] || sentence='push --unsafe kick/2 drift | pp | ./keep | push --unsafe kick/2'
		pinit kepler --dt "$(awk 'BEGIN { printf "%.17g", 8 * atan2(1, 1) / 32 }')" | cycle -n 32 "$sentence" >/dev/null
		want=$(awk -F'\t' -v s=$scheme '$1 == "kepler" && $2 == s && $3 == "0.19635" { print $5 }' "$top/data/atlas/step.tsv")
		[ "$(grep -ac '^PMPIPE/1 frame' passed)" = "$want" ] || { echo "$scheme: $(grep -ac '^PMPIPE/1 frame' passed), not $want"; return 1; }
	done
}

@test "a name that the atlas does not have is refused in one line" {
	command -v pnmcat >/dev/null || skip "no netpbm here"
	OUT=$PWD run -1 --separate-stderr bash "$top/docs/accuracy/atlas.sh" nothing
	[[ ${#stderr_lines[@]} = 1 && $stderr == "atlas: docs/accuracy/README.md has no picture 'nothing'"* ]]
}
