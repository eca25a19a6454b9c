# The command pmpipe: all words behind one name, installed with the words off PATH; its help, doctor and completion.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

# install [VARIABLE=VALUE]: into ./root. One at a time: tests run side by side.
install() { flock "$top/build" make -s -C "$top" DESTDIR="$PWD/root" PREFIX=/usr "$@" install; }

# bare COMMAND...: with no word on PATH but pmpipe, as after make install.
bare() { env -i PATH="$PWD/root/usr/bin:/usr/bin:/bin" HOME="$HOME" LC_ALL=C OMP_NUM_THREADS=1 "$@"; }

@test "pmpipe lists every word once, under its kind, with the summary of its help" {
	pmpipe >list
	for t in $(tools); do
		summary=$("$t" --help | sed -n "1s/^$t: //p") kind=$("$t" --help | sed -n "4s/^$t \(.*\)\.$/\1/p")
		[ "$(grep -c "^  $t  *" list)" = 1 ]
		awk -v t="$t" -v kind="$kind:" -v s="$summary" '/^[a-z].*:$/ { now = $0 } $1 == t && now == kind && index($0, s) { found = 1 }
			END { exit !found }' list || { echo "$t"; return 1; }
	done
	same_as list <(pmpipe words)
}

@test "pmpipe WORD gives what WORD gives: bytes, message, exit status, input from a pipe" {
	pinit plummer -n 50 --cells 8 | p2m --kernel tsc >want
	pmpipe pinit plummer -n 50 --cells 8 | pmpipe p2m --kernel tsc >got
	same_as want got
	run -3 --separate-stderr pmpipe poisson-mg --max-cycles 1 --tolerance 1e-13 got -o out
	[[ $stderr == 'poisson-mg: '* ]]
	run -2 --separate-stderr pmpipe p2m --kernle tsc
	[[ $stderr == 'p2m: no option '* ]]
}

@test "pmpipe: a word or topic that is none is refused with the nearest name; a path is no word" {
	run -2 --separate-stderr pmpipe poison-fft
	[ "$stderr" = "pmpipe: no word 'poison-fft' (did you mean poisson-fft? pmpipe alone lists them)" ]
	run -2 --separate-stderr pmpipe help kernls
	[ "$stderr" = "pmpipe: no topic 'kernls' (did you mean kernels? pmpipe help lists them)" ]
	for w in ../bin/p2m ./p2m . .. "$top/bin/p2m" 'p2m; echo no' --; do
		run -2 --separate-stderr pmpipe "$w"
		[[ $stderr == "pmpipe: no word '$w'"* ]] || { echo "$w: $stderr"; return 1; }
	done
}

@test "installed: one program on PATH; words start each other from libexec: pipes, HDF5, plan, pareto, margin" {
	install
	[ "$(bare pmpipe path)" = "$PWD/root/usr/libexec/pmpipe" ]
	bare pmpipe pinit plummer -n 60 --cells 8 -o a.h5
	step='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'
	bare pmpipe cycle -n 2 "$step" -i a.h5 -o fused.h5
	bare pmpipe cycle -n 2 --engine pipes "$step" -i a.h5 -o pipes.h5
	bare pmpipe scmp --tolerance 0 fused.h5 pipes.h5
	bare pmpipe diag --columns step fused.h5 | grep -qx 2
	bare sh -c 'pmpipe pinit plummer -n 60 --cells 8 | pmpipe plan --check' | grep -q '^self field'
	bare pmpipe margin 'printf "x vx\n1 0\n" | stab - --law free | cycle -n 100 "push --dt {dt} kick/2 drift | field acc=-x | push kick/2"' \
		--vary dt:0.5:4 --expect 2 --unstable-when 'distance_max > 100' --tolerance 0.1 | grep -q yes
	# Other programs of these names come first on PATH.
	mkdir others
	for t in p2m cycle field pp stab push sh5; do printf '#!/bin/sh\necho other >&2\nexit 1\n' >"others/$t" && chmod +x "others/$t"; done
	PATH=$PWD/others:$PATH root/usr/bin/pmpipe pareto 'pinit plummer -n 60 | p2m --kernel {cic,tsc} -n 8 | poisson-fft | mgrad | m2p' --against pp \
		--field acc --repeat 1 --tsv | grep -c '^[12]' | grep -qx 2
	PATH=$PWD/others:$PATH root/usr/bin/pmpipe cycle -n 1 --engine pipes 'push drift' -i a.h5 -o b.pm
	PATH=$PWD/others:/usr/bin:/bin run -0 root/usr/bin/pmpipe doctor
	[[ $output == *"come first on PATH: $PWD/others/cycle"* ]]
	ln -s root/usr/bin/pmpipe link
	bare ./link sls b.pm | grep -q '^frame 1'
	install WITH_WORDS=1
	bare sh -c 'pinit plummer -n 60 -o c.h5 && p2m c.h5 | sls' | grep -q rho
	bare pareto 'pinit plummer -n 60 | p2m -n {8,16} | poisson-fft | mgrad | m2p' --against pp --field acc --repeat 1 --tsv | grep -c '^[12]' | grep -qx 2
}

@test "pmpipe help: a word, a page, what an option chooses from, the exit status" {
	same_as <(pmpipe help p2m) <(p2m --help)
	same_as <(pmpipe help hdf5) "$top/docs/methods/hdf5.md"
	same_as <(pmpipe help push.md) "$top/docs/methods/push.md"
	pmpipe help kernels | grep -q 'p2m --kernel'
	pmpipe help kernels | grep -q '^  cic, lambda-2, lambda-2-1'
	pmpipe help scenes | grep -q 'plummer, '
	pmpipe help exit | grep -qx '3 numerics (not finite, not converged, unstable).'
	pmpipe help >topics
	for page in "$top"/docs/methods/*.md; do grep -q "^  $(basename "$page" .md) " topics; done
	for file in /etc/passwd ../README ../../COPYING .; do run -2 pmpipe help "$file"; done
}

@test "pmpipe doctor: all rows, exit 0; a word that is missing a version, or does not run, is exit 1" {
	run -0 --separate-stderr pmpipe doctor
	for row in pmpipe words processor build libraries threads caches memory disk sentence gnuplot; do
		grep -qE "^$row +[^ ]" <<<"$output" || { echo "$row"; return 1; }
	done
	mkdir copy && cp "$(pmpipe path)"/* copy
	printf '#!/bin/sh\nkill -ILL $$\n' >copy/p2m
	run -1 --separate-stderr copy/pmpipe doctor
	grep -q 'not running: p2m (' <<<"$output"
	grep -q '^sentence *fails: ' <<<"$output"
	[[ $stderr == *'pmpipe: not all is well: see above' ]]
	sed "s/built='[^']*'/built='avx2 sse9'/" "$(pmpipe path)/pmpipe" >copy/pmpipe
	grep -q '^flags' /proc/cpuinfo || skip "no flags in /proc/cpuinfo here"
	run -1 copy/pmpipe doctor
	grep -q 'has no .*make PORTABLE=1' <<<"$output"
}

@test "completion knows words, options, choices, scenes and fields, and leaves files to the shell" {
	pinit two-stream -n 4 >a.pm
	[ "$(pmpipe complete pmpipe p | grep -c .)" = "$(($(tools | wc -l) + 4))" ]
	pmpipe complete pinit pl | grep -qx plummer
	pmpipe complete pmpipe push ki | grep -qx kick
	pmpipe complete p2m --ker | grep -q $'^--kernel\tthe interpolation kernel'
	pmpipe complete p2m --kernel '' | grep -qx m6prime
	pmpipe complete pmpipe p2m --kernel tsc | grep -qx tsc
	[ "$(pmpipe complete sdraw a.pm --field '' | tr '\n' ' ')" = 'x v charge mass id ' ] || pmpipe complete sdraw a.pm --field '' | grep -qx charge
	if pmpipe complete sdraw a.pm --field '' | grep -E 'matter|mesh|electrons|two-stream'; then return 1; fi
	pmpipe complete sdraw -f '' | grep -qx rho
	pmpipe complete pmpipe help '' | grep -q $'^kernels\t'
	[ -z "$(pmpipe complete sls '')$(pmpipe complete p2m -o '')$(pmpipe complete pmpipe diag --input '')$(pmpipe complete nothing '')" ]
}

@test "completion in bash" {
	run -0 bash -c 'eval "$(pmpipe completion bash)"
		complete -p cycle pmpipe >/dev/null
		try() { COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _pmpipe; echo "${COMPREPLY[@]}"; }
		try cycle --every-
		try cycle --engine p
		try pmpipe pini
		try pmpipe pinit cold-c
		try pmpipe sls ""
		mkdir -p other && printf "#!/bin/sh\n" >other/cycle && chmod +x other/cycle && PATH=$PWD/other:$PATH
		try cycle --ever'
	[ "$output" = $'--every-time\npipes\npinit\ncold-collapse' ]
}

@test "completion in fish" {
	command -v fish >/dev/null || skip 'no fish here'
	export HOME=$PWD
	run -0 fish -c 'pmpipe completion fish | source
		complete -C "cycle --ever"; complete -C "pmpipe cycle --engine p"; complete -C "pmpipe pinit cold-c"; touch afile; complete -C "pmpipe sls af"'
	[ "$output" = "$(printf '%s\n' "$(pmpipe complete cycle --ever | grep '^--every')" pipes cold-collapse afile)" ]
}

# zsh_shows LINE PATTERN: an interactive zsh, in which LINE and a TAB were typed, shows PATTERN.
zsh_shows() {
	cat >show.zsh <<-'END'
		zmodload zsh/zpty
		zpty z zsh -f -i
		zpty -w z "PS1=; stty -echo; autoload -Uz compinit; compinit -u -d ./dump; eval \"\$(pmpipe completion zsh)\"; print re''ady"
		zpty -r z out "*ready*"
		zpty -w -n z "$1"$'\t'
		zpty -r z out "*$2*"
	END
	timeout 30 zsh -f show.zsh "$1" "$2" || { echo "$1: no $2"; return 1; }
}

@test "completion in zsh" {
	command -v zsh >/dev/null || skip 'no zsh here'
	touch afile
	zsh_shows 'pmpipe pinit cold-c' cold-collapse
	zsh_shows 'cycle --e' 'in one process'
	zsh_shows 'pmpipe cycle --engine pip' pipes
	zsh_shows 'pmpipe help kern' kernels
	zsh_shows 'pmpipe sls af' afile
}
