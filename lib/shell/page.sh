# shellcheck shell=bash
# Pages and pictures of the tools in shell: one self-contained HTML file with the machine, the versions and every command that was run;
# gnuplot's terminals. The tool defines `commands`, which prints the commands. SPDX-License-Identifier: GPL-3.0-or-later

escape() { sed -e 's/&/\&amp;/g' -e 's/</\&lt;/g' -e 's/>/\&gt;/g'; }

machine() {
	echo "$(uname -srm), $(nproc) processors,$(sed -n 's/^model name[^:]*:/ /p' /proc/cpuinfo 2>/dev/null | head -n 1), $(awk '/^MemTotal/ {
		printf "%.1f GB", $2 / 1048576 }' /proc/meminfo 2>/dev/null)"
	echo "threads: ${OMP_NUM_THREADS:-as many as processors}; load when written: $(cut -d' ' -f1-3 /proc/loadavg 2>/dev/null)"
}

versions() {
	local p
	echo "pmpipe $version"
	echo "bash $BASH_VERSION"
	for p in gnuplot parallel; do
		! command -v $p >/dev/null || $p --version </dev/null 2>/dev/null | head -n 1
	done
}

# page_head TITLE CSS
page_head() {
	printf '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>%s</title>\n<style>' "$1"
	printf %s 'body{font:15px/1.45 sans-serif;max-width:72em;margin:2em auto;padding:0 1em}pre{background:#f4f4f4;padding:.7em;overflow-x:auto}'
	printf %s 'table{border-collapse:collapse;font-size:13px;display:block;overflow-x:auto}'
	printf %s 'td,th{padding:.15em .6em;text-align:left;border-bottom:1px solid #ddd;white-space:nowrap}svg{max-width:100%;height:auto}'
	printf '%s</style></head><body>\n' "$2"
}

page_foot() {
	printf '<h2>Machine</h2>\n<pre>%s</pre>\n<h2>Versions</h2>\n<pre>%s</pre>\n' "$(machine | escape)" "$(versions | escape)"
	printf '<h2>Every command as run</h2>\n<pre>%s</pre>\n</body></html>\n' "$(commands | escape)"
}

inline_svg() { sed '/^<?xml/d; /^<!DOCTYPE/,/>$/d' "$1"; }

# Sets png to the terminal that this gnuplot has.
terminal() {
	png=png
	! echo 'set terminal pngcairo' | gnuplot >/dev/null 2>&1 || png=pngcairo
}

# draw DIRECTORY FILE: runs gnuplot there.
draw() {
	(cd "$1" && LC_ALL=C.UTF-8 gnuplot "$2") 2>"$work/gnuplot" || { tell "gnuplot: $(grep -v '^[ ^]*$' "$work/gnuplot" | tail -n 1)"; return 1; }
}
