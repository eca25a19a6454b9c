# fish completion of pmpipe and of its words where they are on PATH. SPDX-License-Identifier: GPL-3.0-or-later

function __pmpipe_candidates
    set -l line (commandline -opc) (commandline -ct)
    if test (basename -- $line[1]) != pmpipe # a program of that name that is not ours
        string match -q -- (pmpipe path)"/*" (realpath -- (command -s -- $line[1])); or return 0
    end
    set -l found (pmpipe complete $line 2>/dev/null)
    if test (count $found) -gt 0
        printf '%s\n' $found
    else
        __fish_complete_path (commandline -ct)
    end
end

for name in pmpipe (command ls (pmpipe path 2>/dev/null) 2>/dev/null)
    complete -c $name -f -a '(__pmpipe_candidates)'
end
