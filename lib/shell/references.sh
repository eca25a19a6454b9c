# shellcheck shell=bash
# The references of a sweep and the common beginning of all its members, each run once. SPDX-License-Identifier: GPL-3.0-or-later

# refer MEMBER: assigns a reference to each member from MEMBER on; there are several if the reference contains names of --vary, or if there are
# several beginnings (--size).
refer() {
	local m key size from=$1
	local -A finest=()
	[ "$from" != 0 ] || { reference_text=() reference_begins=() reference_of=() reference_members=() reference_number=(); }
	[ "$against" != exact ] || return 0
	if [ "$against" = finest ]; then
		for m in "${walk[@]}"; do finest[${beginning_of[m]}.$(size_of "$m")]=$m; done
		[ -n "$size_choice" ] || finest[0.]=$last_member
		for m in "${!finest[@]}"; do reference_members+=("${finest[$m]}"); done
	fi
	for m in "${walk[@]}"; do
		[ "$m" -ge "$from" ] || continue
		[[ ${reference[m]} != *'{'*','*'}'* ]] || usage "--against has alternatives of its own (only {name} of --vary may stand there)"
		text=${reference[m]}
		if [ "$against" = finest ]; then
			words "${sentence[finest[${beginning_of[m]}.$(size_of "$m")]]}"
			join "${word[@]:skip}"
		fi
		key="x${beginning_of[m]}|$text"
		[ -n "${reference_number[$key]:-}" ] || {
			reference_number[$key]=${#reference_text[@]}; reference_text+=("$text"); reference_begins+=("${beginning_of[m]}"); }
		reference_of[m]=${reference_number[$key]}
	done
}

# size_of MEMBER: its value of --size.
size_of() { [ -z "$size_choice" ] || echo "${chosen[$1 * ${#choice_name[@]} + size_choice - 1]}"; }

# Runs the beginnings and the references that are missing.
prepare() {
	local i status input m
	local -A wanted=()
	doing="nothing measured yet"
	for m in "${walk[@]}"; do wanted[${beginning_of[m]}]=1; done
	for i in "${!beginning_text[@]}"; do
		[[ $skip != 0 && -n ${wanted[$i]:-} && ! -e $work/beginning.$i ]] || continue
		status=0
		run "${beginning_text[i]}" /dev/null "$work/beginning.$i" || status=$?
		[ $status = 0 ] || fail 1 "the beginning '${beginning_text[i]}' fails: $(why $status)"
	done
	for i in "${!reference_text[@]}"; do
		[ ! -e "$work/reference.$i" ] || continue
		status=0
		if [[ -f ${reference_text[i]} ]]; then
			ln -sf "$(realpath -- "${reference_text[i]}")" "$work/reference.$i"
			continue
		fi
		words "${reference_text[i]}"
		local w all=()
		for w in "${word[@]}"; do with_timing "$w"; all+=("$text"); done
		join "${all[@]}"
		input=/dev/null
		[ $skip = 0 ] || input=$work/beginning.${reference_begins[i]}
		run "$text" "$input" "$work/reference.$i" || status=$?
		[ $status = 0 ] || fail 1 "the reference '${reference_text[i]}' fails: $(why $status)"
		cut -f3 "$work/timing" >"$state/reference.$i.seconds"
	done
}
