# neutrals: rates, energies and temperatures of collisions with a gas; keys; refusals. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# gas N OPTIONS: N electrons with 3 velocities, steps of 0.1; moments: mean vx and the mean square of v about it, a third of it
gas() { pinit plasma --no-history | species electrons -n 40000 --velocities 3 --loading random --no-history "$@"; }
moments() {
	stab --plain --set electrons | awk '/vx/ { for (k = 1; k <= NF; k++) c[$k] = k; next }
		{ n++; s += $c["vx"]; q += $c["vx"]^2 + $c["vy"]^2 + $c["vz"]^2 } END { printf "%.12g %.12g\n", s / n, (q / n - (s / n)^2) / 3 }'
}

@test "a beam loses its direction at the rate n sigma g M/(m + M), in heavy and in equal atoms; heavy ones leave its energy" {
	gas --drift 2 --vth 0 >a
	cycle -q -n 100 "push drift | neutrals --density 0.1 --gas-mass 1e14 'elastic: 1/g'" <a >b
	# exp(-nu t) = exp(-1) for any step; standard error 2 sqrt(1/3 (1 - e^-1) + ...)/200
	read -r v T < <(moments <b)
	within "$v" "$(calc '2*exp(-1)')" 0.03
	within "$(calc "$v^2 + 3*$T")" 4 1e-10 # moments have 12 digits
	read -r v _ < <(cycle -q -n 100 "push drift | neutrals --density 0.1 --gas-mass 1 'elastic: 2/g'" <a | moments)
	# a half of (1 - exp(-nu dt)) is lost in a collision, nu = 0.2
	within "$v" "$(calc '2*(1 - 0.5*(1 - exp(-0.02)))^100')" 0.03
	# each process by its share: half of the collisions stop the particle
	three="'elastic: 0.25/g' 'exchange: 0.5/g' 'elastic: 0.25/g'"
	read -r v T < <(cycle -q -n 100 "push drift | neutrals --density 0.1 --gas-mass 1e14 $three" <a | moments)
	within "$(calc "$v^2 + 3*$T")" "$(calc '4*exp(-0.5)')" 0.05
	# the sum of processes is their rate
	read -r v _ < <(cycle -q -n 100 "push drift | neutrals --density 0.1 --gas-mass 1e14 'elastic: 0.25/g' 'excite 0.001: 0.75/g'" <a | moments)
	within "$v" "$(calc '2*exp(-1)')" 0.04
	within "$(sls --report b | grep -o '"collisions":[0-9]*' | cut -d: -f2)" "$(calc '40000*100*(1 - exp(-0.01))')" 800 # four standard errors
}

@test "exchange of charge brings ions to the temperature and the drift of the gas, exponentially" {
	gas --vth 1 --drift 0,0,0 >a
	for dt in 0.1 0.5; do # exact for every step, because the rate is constant
		read -r v T < <(smod --dt $dt a | cycle -q -t 5 "push drift |
			neutrals --density 0.2 --gas-mass 1 --vth 0.3 --drift 0.7 'exchange: 1/g'" | moments)
		within "$v" "$(calc '0.7*(1 - exp(-1))')" 0.02
		# what is left of the old, the new, and the spread of the two means along x
		within "$T" "$(calc 'exp(-1) + 0.09*(1 - exp(-1)) + 0.49*exp(-1)*(1 - exp(-1))/3')" 0.02
	done
	read -r v T < <(cycle -q -n 400 "push drift | neutrals --density 1 --gas-mass 1 --vth 0.5 'elastic: 1'" <a | moments)
	within "$T" 0.25 0.01
	within "$v" 0 0.015
}

@test "an excitation takes its energy from those that have it, and from no others" {
	gas --drift 2 --vth 0 >a
	cycle -q -n 20 "push drift | neutrals --density 0.1 --gas-mass 1e14 'excite 0.75: 1/g'" <a >b
	n=$(sls --report b | grep -o '"collisions":[0-9]*' | cut -d: -f2)
	read -r v T < <(moments <b)
	within "$(calc "20000*($v^2 + 3*$T)")" "$(calc "80000 - 0.75*$n")" 1e-4 # 40000 v^2/2; printed with 12 digits
	above "$n" 7000 # 40000 (1 - exp(-0.2)), and some of the second
	read -r v T < <(cycle -q -n 400 "push drift | neutrals --density 1 --gas-mass 1e14 'excite 0.75: 1/g'" <a | moments)
	within "$(calc "$v^2 + 3*$T")" 1 1e-9 # 2 - 0.75 - 0.75 = 0.5, below the threshold
}

@test "collisions belong to seed, set, id and step: not to threads, order, or where a run is interrupted; wrong sections are refused" {
	gas --vth 1 >a
	s="push drift | neutrals --density 0.3 'elastic: exp(-energy)' 'exchange: 0.1*g'"
	cycle -q --no-history -n 8 "$s" <a >b
	same_as b <(cycle -q --no-history -n 8 --threads 1 "$s" <a)
	same_as b <(cycle -q --no-history -n 3 "$s" <a | cycle -q --no-history -n 5 "$s")
	same_as <(ssort --by id b | sel --field v,id | stab --plain --set electrons) \
		<(ssort --by id --reverse a | cycle -q -n 8 "$s" | ssort --by id | sel --field v,id | stab --plain --set electrons)
	cycle -q --no-history -n 8 "${s/--density/--seed 3 --density}" <a | cmp -s - b && return 1
	refused() {
		run --separate-stderr bash -o pipefail -c "$2 | sls"
		[[ $status = "$3" && $stderr == *"$1"* ]] || { echo "$2: $status $stderr"; return 1; }
	}
	refused 'a cross-section is negative or not finite at the speeds of' "neutrals --density 1 'elastic: -1' <a" 3
	refused "'bounce: 1' is no process" "neutrals --density 1 'bounce: 1' <a" 2
	refused "'excite: 1' is no process" "neutrals --density 1 'excite: 1' <a" 2
	refused 'v of '\''electrons'\'' has 1 components (species --velocities 3)' "pinit landau | neutrals --density 1 'elastic: 1'" 1
	refused 'how dense is the gas?' "neutrals 'elastic: 1' <a" 2
}

@test "a table of cross-sections is linear between its rows and constant beyond them: the same velocities as by expressions; wrong tables are refused" {
	gas --drift 2 --vth 1 >a
	printf '# energy sigma\n0.5 0.375\n1 0.5\n3 1\n' >t
	with() { cycle -q --no-history -n 10 "push drift | neutrals --density 0.1 '$1' 'exchange: 0.2'" <a | sel --field v,id | stab --plain --set electrons; }
	same_as <(with 'elastic: @t') <(with 'elastic: 0.25 + 0.25*max(0.5, min(energy, 3))')
	same_as <(with 'excite 0.7: @t') <(with 'excite 0.7: 0.25 + 0.25*max(0.5, min(energy, 3))')
	refused() {
		run --separate-stderr neutrals --density 1 "elastic: @${3:-u}" <a
		[[ $status = 1 && $stderr == *"$1"* ]] || { echo "$1: $status $stderr"; return 1; }
	}
	printf '1 2\n1 3\n' >u
	refused "'u': row 2, 1 3: energies must ascend, and no cross-section be negative"
	printf '1 2\n2 -3\n' >u
	refused "row 2, 2 -3"
	printf '1 2 3\n2 3 4\n' >u
	refused "'u' has 3 columns and 2 rows, not two columns, energy and cross-section"
	refused 'nowhere' '' nowhere
}

@test "ionisation makes an electron and an ion where it happens: charge, mass and energy are accounted for, the atom's velocity goes on with the ion" {
	gas --drift 2 --vth 0 | species ions -n 0 --charge 1 --mass 99 --velocities 3 --no-history >a
	ion="neutrals --density 0.1 --gas-mass 100 --ions ions"
	s="push drift | $ion 'ionise 0.75: 1/g'"
	cycle -q --no-history -n 10 "$s" <a >b
	n=$(sls --report b | grep -o '"ionisations":[0-9]*' | cut -d: -f2)
	within "$n" "$(calc '40000*(1 - exp(-0.1))')" 240 # four standard errors; the halves, 0.62, are below the threshold
	[ "$(sls b | awk '$2 == "ions:" { print $3 }')" = "$n" ]
	diag --columns mass,charge --format tsv b | tail -1 >sums
	read -r mass charge <sums
	within "$charge" "$(calc '-4*pi')" 1e-9 # what is made is neutral
	within "$mass" "$(calc "4*pi*(1 + 100*$n/40000)")" 1e-8
	stab --plain --set electrons b | awk '/vx/ { for (k = 1; k <= NF; k++) c[$k] = k; next }
		{ w = $c["vx"]^2 + $c["vy"]^2 + $c["vz"]^2; if (w < 3.99) { n++; t += $c["vx"]; if ((w - u) ^ 2 > 1e-20 && n > 1) bad++; u = w } }
		END { printf "%d %.12g %.6g %d\n", n, u, t / n, bad }' >born # those that were born, and those that made them
	read -r many square mean bad <born
	[ "$many" = $((2 * n)) ]
	[ "$bad" = 0 ]
	within "$square" "$(calc '2*100/101 - 0.75')" 1e-9 # v^2/2 is a half of m M/(m + M) g^2/2 - 0.75
	within "$mean" 0 0.04 # any direction; four standard errors
	[ "$(stab --plain --set ions b | column vx | sort -u)" = 0 ]
	cycle -q --no-history -n 10 --threads 1 "$s" <a | same_as b -
	cycle -q --no-history -n 4 "$s" <a | cycle -q --no-history -n 6 --engine pipes "$s" | same_as b -
	stab --plain b --set electrons | column id | sort | uniq -d >twice
	[ ! -s twice ]
	# inside the step of a plasma, behind the drift; nothing below the threshold
	force='p2m | poisson-fft | mgrad | m2p'
	cycle -q -n 4 "push kick/2 drift | $ion --vth 0.1 'ionise 0.75: 1' | $force | push kick/2" <a | sls | grep -q 'set ions: [1-9]'
	cycle -q -n 4 "push drift | $ion 'ionise 2: 1'" <a | sls | grep -q 'set ions: 0'
	run -1 --separate-stderr neutrals --density 1 --ions none 'ionise 1: 1' <a
	[[ $stderr == *"no set 'none' of ions with 3 components of v (species none -n 0 --velocities 3)"* ]]
	run -2 --separate-stderr neutrals --density 1 'ionise 1: 1' <a
	[[ $stderr == *"of which set? (--ions NAME)"* ]]
}
