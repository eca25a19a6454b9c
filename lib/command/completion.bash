# bash completion of pmpipe and of its words where they are on PATH. SPDX-License-Identifier: GPL-3.0-or-later

_pmpipe() {
	local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[0]##*/} found list
	COMPREPLY=()
	if [[ $command != pmpipe ]]; then # a program of that name that is not ours
		found=$(readlink -f -- "$(type -P -- "${COMP_WORDS[0]}")")
		[[ $found == "$(pmpipe path)"/* ]] || return 0
	fi
	list=$(pmpipe complete "${COMP_WORDS[@]:0:COMP_CWORD+1}" 2>/dev/null | cut -f1)
	mapfile -t COMPREPLY < <(compgen -W "$list" -- "$word")
}

complete -o default -F _pmpipe pmpipe
mapfile -t _pmpipe_words < <(ls "$(pmpipe path 2>/dev/null)" 2>/dev/null)
((${#_pmpipe_words[@]} == 0)) || complete -o default -F _pmpipe "${_pmpipe_words[@]}"
unset _pmpipe_words
