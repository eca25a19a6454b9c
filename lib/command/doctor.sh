# shellcheck shell=sh
# pmpipe doctor: what is installed, what is missing, and what the machine is. Exit 1 if a word does not run here.
# SPDX-License-Identifier: GPL-3.0-or-later

row() { printf '%-10s %s\n' "$1" "$2"; }
bad() {
	row "$1" "$2"
	ill=1
}

words_run() {
	count=0 wrong=
	for word in $(word_list); do
		count=$((count + 1))
		said=$("$words/$word" --version 2>&1) || said="exit status $?"
		[ "$said" = "$word (pmpipe) $version" ] || wrong="$wrong $word ($said)"
	done
	row words "$count in $words"
	[ -z "$wrong" ] || bad '' "not of version $version, or not running:$wrong (make install again)"
}

on_path() {
	others=
	for word in $(word_list); do
		found=$(command -v "$word") || found=
		case $found in
		'') others="$others none" ;;
		*) [ "$(readlink -f -- "$found")" = "$words/$word" ] || others="$others $found" ;;
		esac
	done
	hides=$(printf '%s\n' "$others" | tr ' ' '\n' | grep / | tr '\n' ' ')
	# shellcheck disable=SC2016 # as it is to be typed
	case $others in
	*none*) row '' 'not all on PATH: type pmpipe WORD, or PATH=$(pmpipe path):$PATH' ;;
	'') row '' 'all on PATH' ;;
	esac
	[ -z "$hides" ] || row '' "other programs of these names come first on PATH: $hides"
}

# The instructions the words were built for must be those of the processor.
processor() {
	built='@SIMD@' levels='@LEVELS@' taken=x86-64
	has=$(sed -n 's/^\(flags\|Features\)[[:blank:]]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1)
	row processor "$(sed -n 's/^model name[[:blank:]]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1)"
	if [ -n "$levels" ]; then
		case " $has " in *' avx2 '*) taken=x86-64-v3 ;; esac
		case " $has " in *' avx512bw '*) taken=x86-64-v4 ;; esac
		row build "@BUILD@; for $levels, of which $taken is taken (PM_INSTRUCTIONS=LEVEL allows less)"
		return
	fi
	row build "@BUILD@; for ${built:-any processor of its kind}"
	for flag in $built; do
		case " $has " in '  ' | *" $flag "*) ;; *) bad '' "this processor has no $flag (build with make PORTABLE=1)" && break ;; esac
	done
	best=
	for flag in avx512f avx2 avx; do
		case " $has " in *" $flag "*) best=${best:-$flag} ;; esac
	done
	case " $built " in *" ${best:-none} "*) return ;; esac
	[ -z "$best" ] || row '' "this processor has $best too (a build of its own, without PORTABLE=1, is faster)"
}

caches() {
	for level in 1 2 3; do
		bytes=$(getconf LEVEL$level"$([ $level != 1 ] || echo _D)"CACHE_SIZE 2>/dev/null || getconf LEVEL${level}_CACHE_SIZE 2>/dev/null) || bytes=
		case $bytes in '' | 0 | *[!0-9]*) continue ;; esac
		printf 'L%s %s KiB  ' $level $((bytes / 1024))
	done
}

optional() { # PROGRAM, PACKAGE, WHAT IT IS FOR
	if found=$(command -v "$1"); then
		row "$1" "$found: $3"
	else
		row "$1" "missing: $3 (apt-get install $2)"
	fi
}

# A sentence that uses mesh, solver and pairs, in a directory of its own.
sentence_runs() {
	for line in 'pinit plummer -n 64 --cells 8 | p2m | poisson-fft | mgrad | m2p' \
		'pinit plummer -n 64 --cells 8 | cycle -n 1 "push kick/2 drift | pp | push kick/2"' \
		'pinit plummer -n 64 --cells 8 | sh5 -o run.h5 && sh5 run.h5'; do
		said=$(cd "$room" && PATH=$words:$PATH sh -c "$line | diag --columns particles" 2>&1) || said="exit status $?: $said"
		[ "$said" != "$(printf 'particles\n64')" ] || continue
		bad sentence "fails: $line"
		row '' "$(printf '%s' "$said" | head -n 1)"
		return
	done
	row sentence 'mesh, pairs, cycle and HDF5: fine'
}

doctor() {
	[ $# = 0 ] || fail 2 "doctor takes no arguments, not '$1'"
	ill=
	row pmpipe "$version ($here/pmpipe)"
	words_run
	on_path
	processor
	row libraries '@LIBRARIES@'
	row threads "$(nproc) of $(getconf _NPROCESSORS_ONLN 2>/dev/null || echo '?') processors, OMP_NUM_THREADS ${OMP_NUM_THREADS:-not set}"
	row caches "$(caches)"
	row memory "$(awk '/^MemTotal|^MemAvailable/ { printf "%s%.1f GiB%s", sep, $2 / 1048576, /Total/ ? "" : " free"; sep = ", " }' /proc/meminfo \
		2>/dev/null)"
	room=$(mktemp -d "${TMPDIR:-/tmp}/pmpipe.XXXXXX") || fail 1 "cannot make a directory in '${TMPDIR:-/tmp}' (TMPDIR names another place)"
	trap 'rm -rf "$room"' EXIT
	row disk "$(df -Pk "$room" | awk 'NR == 2 { printf "%.1f GiB free", $4 / 1048576 }') in ${TMPDIR:-/tmp}"
	sentence_runs
	optional bash bash 'pareto, margin and digits'
	optional gnuplot gnuplot-nox 'pictures of the gallery'
	optional parallel parallel 'pareto --jobs'
	optional ffmpeg ffmpeg 'sdraw -o run.mp4'
	optional chromium chromium 'the tests of the pages (any browser shows them)'
	optional h5ls hdf5-tools 'a look into .h5 files'
	optional python3 python3 'the Python package and the readers in docs/'
	[ -z "$ill" ] || fail 1 'not all is well: see above'
}
