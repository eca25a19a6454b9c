# Every example of every tool runs as printed, in an empty directory, in less than a second.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

# The limit leaves room for a loaded machine, and for sanitizers: the median example takes a few hundredths of a second.
limit=${PM_EXAMPLE_SECONDS:-$((PM_SANITIZED ? 60 : 10))}

@test "every tool has at least one example" {
	for t in $(tools); do
		[ "$("$t" --examples | wc -l)" -ge 1 ] || { echo "$t has none"; return 1; }
	done
}

@test "every example of every tool runs as printed" {
	n=0
	for t in $(tools); do
		while IFS= read -r example; do
			n=$((n + 1))
			mkdir "$n"
			(cd "$n" && timeout "$limit" bash -o pipefail -c "$example" >out 2>err </dev/null) || { echo "$t: exit status $? of: $example"
			cat "$n/err"; return 1; }
			sed -i '/^pareto: the machine was loaded:/d' "$n/err" # by the tests beside this one
		[ ! -s "$n/err" ] || { echo "$t: says on stderr: $example"; cat "$n/err"; return 1; }
			rm -r "$n"
		done < <("$t" --examples)
	done
	[ $n -ge "$(tools | wc -l)" ]
}
