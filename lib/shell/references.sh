# shellcheck shell=bash
# The references of a sweep and the common beginning of all its members, each run once. SPDX-License-Identifier: GPL-3.0-or-later

# Assigns a reference to each member; there are several only if the reference contains names of --vary.
refer() {
	local m
	local -A number=()
	reference_text=() reference_of=() reference_member=-1
	[ "$against" != exact ] || return 0
	for m in "${!sentence[@]}"; do
		[[ ${reference[m]} != *'{'*','*'}'* ]] || usage "--against has alternatives of its own (only {name} of --vary may stand there)"
		[ -n "${number[x${reference[m]}]:-}" ] || { number[x${reference[m]}]=${#reference_text[@]}; reference_text+=("${reference[m]}"); }
		reference_of[m]=${number[x${reference[m]}]}
	done
	if [ "$against" = finest ]; then
		reference_member=$last_member
		words "${sentence[last_member]}"
		join "${word[@]:${#beginning[@]}}"
		reference_text=("$text")
	fi
}

# Runs the common beginning and the references.
prepare() {
	local i status
	first_input=/dev/null
	if [ ${#beginning[@]} != 0 ]; then
		join "${beginning[@]}"
		doing="nothing measured yet"
		status=0
		run "$text" /dev/null "$work/beginning" || status=$?
		[ $status = 0 ] || fail 1 "the beginning '$text' fails: $(why $status)"
		first_input=$work/beginning
	fi
	for i in "${!reference_text[@]}"; do
		status=0
		if [[ -f ${reference_text[i]} ]]; then
			ln -sf "$(realpath -- "${reference_text[i]}")" "$work/reference.$i"
			continue
		fi
		words "${reference_text[i]}"
		local w all=()
		for w in "${word[@]}"; do with_timing "$w"; all+=("$text"); done
		join "${all[@]}"
		run "$text" "$first_input" "$work/reference.$i" || status=$?
		[ $status = 0 ] || fail 1 "the reference '${reference_text[i]}' fails: $(why $status)"
		cut -f3 "$work/timing" >"$state/reference.$i.seconds"
	done
}
