#!/usr/bin/env bash
# Prints the bash completion of all programs, from what `TOOL --complete` prints: an option per line, its choices behind it.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cat <<'TEXT'
# bash completion of the pmpipe programs; generated

_pmpipe() {
	local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} option choices
	while read -r option choices; do
		if [[ $option == "$before" && -n $choices ]]; then
			mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
			return
		fi
	done < <(_pmpipe_rows "${COMP_WORDS[0]##*/}")
	[[ $word != -* ]] || mapfile -t COMPREPLY < <(compgen -W "$(_pmpipe_rows "${COMP_WORDS[0]##*/}" | cut -d' ' -f1)" -- "$word")
}

_pmpipe_rows() {
	case $1 in
TEXT
for tool; do
	printf '\t%s) cat <<"END" ;;\n' "${tool##*/}"
	"$tool" --complete
	echo END
done
printf '\tesac\n}\n\ncomplete -o default -F _pmpipe'
printf ' %s' "${@##*/}"
echo
