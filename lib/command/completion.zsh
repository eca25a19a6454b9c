#compdef pmpipe
# zsh completion of pmpipe and of its words where they are on PATH. SPDX-License-Identifier: GPL-3.0-or-later

_pmpipe() {
	local command=${words[1]:t} line
	local -a found
	if [[ $command != pmpipe ]]; then # a program of that name that is not ours
		[[ ${${:-$(whence -p -- $words[1])}:A} == $(pmpipe path)/* ]] || { _default; return }
	fi
	for line in ${(f)"$(pmpipe complete "${(@Q)words[1,CURRENT]}" 2>/dev/null)"}; do
		[[ $line != *$'\t'* ]] && found+=("${line//:/\\:}") || found+=("${${line%%$'\t'*}//:/\\:}:${line#*$'\t'}")
	done
	if (( $#found )); then
		_describe -t values value found
	else
		_files
	fi
}

if [[ $funcstack[1] == _pmpipe ]]; then # loaded by its name from fpath
	_pmpipe "$@"
else
	compdef _pmpipe pmpipe $(ls "$(pmpipe path 2>/dev/null)" 2>/dev/null)
fi
