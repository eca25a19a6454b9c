# What a plan says about the cost of the whole run, and what planning itself costs.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "planning holds little more than the run planned: no mesh for forces that cancel, no blocks of earlier trials" {
	# Resident sets: lattice 27 MB (833 MB with the mesh that the atlas proposed for a force of round-off), uniform 130 MB as its run (219 MB with the
	# meshes of both forces that smoothing compares). Both plans need 160 MB of addresses; without either mend more than 240 MB.
	for scene in lattice uniform; do
		pinit $scene >start
		(ulimit -v 200000; plan <start >text) || { echo $scene; return 1; }
		grep -q 'a step$' text
	done
	(ulimit -v 200000; pinit lattice | plan -t 50 >text) # forces of round-off that may grow: on the mesh of the frame too
	grep -q '^poisson-fft' text
	[[ "$(pinit lattice | plan --no-cost --on self-field)" = *"p2m  "*"cic: forces cancel on the mesh of the frame"* ]] || {
		pinit lattice | plan --no-cost --on self-field; return 1; }
}

@test "the cost of the whole run: the steps that cycle does, the seconds as their product, no less memory than a frame" {
	for run in "two-body|1" "landau -n 2000 --cells 32|0.7" "lamb-oseen --cells 32|1.4" "plummer -n 300|0.033" "exb|0.3" "lattice -n 64 --cells 8|1"; do
		pinit ${run%|*} >start
		plan -t "${run#*|}" --format json <start >plan.json
		cycle -t "${run#*|}" --plan <start >end
		python3 - "$(sls end | sed -n 's/.* step \([0-9]*\) .*/\1/p')" "$(stat -c %s end)" <<-'END' || { echo "$run"; jq -c .cost plan.json; return 1; }
			import json, sys
			plan = json.load(open("plan.json"))
			c = plan["cost"]
			assert c["steps"] == int(sys.argv[1]), "steps of cycle: " + sys.argv[1]
			total = c["set_up"] + c["steps"] * c["seconds_per_step"]
			assert abs(c["seconds"] - total) <= 1e-12 * total, "seconds"
			assert 0 < c["seconds_low"] <= c["seconds"] <= c["seconds_high"], "interval"
			assert c["steps_timed"] >= 1 and c["processor_per_step"] > 0 and c["load"] > 0
			assert c["memory"] > c["frame"] > 0, "memory"
			# the words are inside the steps; medians of sums are not sums of medians, and blocks differ on a loaded machine
			assert sum(s["seconds"] for s in plan["stages"]) < 3 * c["seconds_per_step"], "stages"
			# the header and the history take a few kB
			assert c["frame"] <= int(sys.argv[2]) <= c["frame"] + 16384, "bytes of a frame: " + sys.argv[2]
		END
	done
}

@test "the cost of the whole run as text: steps, seconds with their range, memory; nothing costs 0 us, and with --no-cost nothing is priced" {
	pinit kepler | plan -t 1 >text
	grep -qE '^# the run  *(about )?[0-9]+ steps, .*[mu]s \(.* to .*\), of it .* to begin; processor .*; from [0-9]+ steps timed, without output$' text
	grep -qE '^# memory  *[0-9.]+ MB at most; a frame written takes [0-9.]+ kB$' text
	for scene in kepler lattice exb; do
		pinit $scene | plan >text
		run ! grep -E '[^0-9.]0 us|saves 0' text
	done
	run ! grep -E '^# the run|^# memory|a step' <<<"$(pinit kepler | plan --no-cost)"
	[ "$(pinit kepler | plan --no-cost --format json | jq .cost)" = null ]
}

@test "--within: the most accurate plan that the time allows, and none where even accuracy 1 takes longer" {
	pinit kepler >start
	plan -t 1 --within 2h --format json <start >all.json
	plan -t 1 --within 0.5s --format json <start >some.json
	python3 - <<-'END'
		import json
		all, some = json.load(open("all.json")), json.load(open("some.json"))
		assert all["accuracy"] == 1e-6 and some["cost"]["seconds"] <= 0.5 and all["cost"]["seconds"] <= 7200
		assert some["accuracy"] >= all["accuracy"]
	END
	a=$(jq .accuracy all.json)
	[ "$(plan -t 1 --within 2h --sentence <start)" = "$(plan -t 1 --accuracy "$a" --sentence <start)" ] # and the same sentence as by that accuracy
	plan -t 1 --within 2h <start | grep -q '^# within 120 min  *accuracy 1e-06 by the estimates of the atlas, on this machine$'
	# The orbits of 200 stars part as exp(1.2 t): at t = 30 by about 0.08 (docs/plan.md), whatever the time allows.
	pinit plummer -n 200 | plan -t 30 --within 2h >text
	grep -qE '^# within .* accuracy (0\.[123]|1) by .* machine; 0\.[0-9]+ cannot be had$' text || { grep '^# within' text; return 1; }
	run -1 plan -t 1e3 --within 1us <start
	[[ $output == *"no plan takes as little as 1 us on this machine: at accuracy 1 it is "* ]]
	for wrong in 5x -1s s 1e 0x1s nan inf; do
		run -2 plan --within "$wrong" <start
		[[ $output == *"'$wrong' is not a time (2s, 50ms, 1.5min)"* ]] || { echo "$wrong: $output"; return 1; }
		run -2 pareto 'pinit kepler | pp --softening {0,1}' --within "$wrong" # the same times as there
	done
	run -2 plan --within 1s --accuracy 0.1 <start
}
