#!/usr/bin/env bash
# Sentences with alternatives (lib/shell/braces.sh): braces.sh SECONDS SEED makes texts and values of --vary from a seed, of what braces, quotes and a
# shell give a meaning, and lets pareto's and margin's code read them. Nothing in a text may be run, no text may take long, and a refusal is one line and
# exit 2. A value of --vary that is taken reaches the program as one word, whatever is in it: that is tried by running the sentence.
# braces.sh --batch SEED N: N texts. SPDX-License-Identifier: GPL-3.0-or-later
set -u
export LC_ALL=C
# shellcheck disable=SC2016,SC1003 # these are texts
pieces=('{' '}' '{a,b}' '{k}' '{k2}' ',' '|' ' | ' ' ' '\{' '\}' '\,' '\' "'" '"' '$' '$(' ')' '(' '`' ';' '&' '>touched' '<(' '${x:-$(>touched)}'
	'$((a[$(>touched)]))' '$(>touched)' '`>touched`' ';>touched;' '|>touched|' 'a[$(>touched)]' '=' '--n' '-n' ' --n=' 'p2m' 'x' '1' '*' '?' '[a-z]' '~' '#'
	'!' 'é' '%s' '\n' "\$'\\n'" '{a{1,2},b}' '{,}' '{,-x}' '@' ':' '1e9' '0x' '{{k}}' '$k' '~root' '!!' '%d%n' '-e' '--')

# made MOST: sets made to a text of up to MOST pieces.
made() {
	local n=$((RANDOM % $1 + 1))
	made=
	while [ $((n--)) != 0 ]; do made+=${pieces[RANDOM % ${#pieces[@]}]}; done
}

# wrong WHY: says which text did what, and ends the batch.
wrong() {
	printf 'braces: %s: sentences %q %q k=%q k2=%q\n' "$1" "$template" "$reference_text" "$value" "$other"
	exit 1
}

# One text: is it taken, and is nothing run?
try() {
	local status
	(
		set -euo pipefail
		words "$template"
		sentences "$template" "$reference_text" "k=$value" "k2=$other"
		for s in "${sentence[@]}"; do
			(words "$s") 2>/dev/null || true
		done
	) >out 2>err
	status=$?
	[[ ! -e touched ]] || wrong "ran a command"
	[[ $status = 0 || $status = 2 ]] || wrong "exit status $status: $(head -n 3 err)"
	[[ ! -s out && $(wc -l <err) = $((status / 2)) ]] || wrong "$(wc -l <err) lines of message: $(head -n 3 err)"
}

# A value where the sentence has a word, text between quotes, or text between apostrophes: the program gets it as it was typed.
value_stays() {
	local plain=('{k}' "x{k}y" '"{k}"' "'{k}'" '"a {k}"')
	template="printf '<%s>' ${plain[RANDOM % 5]} {u,v}" reference_text=
	value=${value//[\{\}]/} # a value that names values is another matter
	(
		set -euo pipefail
		sentences "$template" '' "k=$value"
		for ((i = 0; i < ${#sentence[@]}; i++)); do
			got=$(PATH=/nowhere /bin/bash -c "${sentence[i]}") || exit 9
			n=${#choice_name[@]} stands=
			for ((c = 0; c < n; c++)); do [[ ${choice_name[c]} != k* ]] || stands=${chosen[i * n + c]}; done
			[[ -z $stands ]] && continue # no word at all
			[[ ${got//[[:space:]]/} == *"${stands//[[:space:]]/}"* && $got == '<'*'><'[uv]'>' ]] || { echo "$got is not $stands" >&2; exit 8; }
		done
	) >out 2>err
	status=$?
	[[ ! -e touched ]] || wrong "ran a command"
	[[ $status = 0 || $status = 2 ]] || wrong "the value does not stay one word ($status): $(head -n 3 err)"
}

batch() {
	local n
	me=braces RANDOM=$1
	# shellcheck source=lib/shell/help.sh
	. "$top/lib/shell/help.sh"
	# shellcheck source=lib/shell/braces.sh
	. "$top/lib/shell/braces.sh"
	for ((n = 0; n < $2; n++)); do
		made 8 && template=$made
		made 2 && reference_text=$made
		# shellcheck disable=SC2178 # sentences has a list of that name inside
		made 4 && value=$made
		made 2 && other=$made
		if ((n % 4)); then try; else value_stays; fi
	done
}

top=$(cd "$(dirname "$0")/../.." && pwd)
if [ "$1" = --batch ]; then
	batch "$2" "$3"
	exit 0
fi
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
inputs=0 seed=$2 end=$((SECONDS + $1)) size=100
while [ $SECONDS -lt $end ]; do
	timeout 60 bash "$top/tests/fuzz/braces.sh" --batch $((seed % 32768)) $size || {
		echo "braces: failed, or took more than 60 s: tests/fuzz/braces.sh --batch $((seed % 32768)) $size"
		exit 1
	}
	inputs=$((inputs + size)) seed=$((seed + 1))
done
echo "stat::number_of_executed_units: $inputs"
