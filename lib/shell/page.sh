# shellcheck shell=bash
# Pages and pictures of the tools in shell: one self-contained HTML file with a table that sorts, the machine, the versions and every command that was run;
# pictures by splot. The tool defines `commands`, which prints the commands, and sets with_parallel where it ran GNU parallel, which takes 0.1 s to start.
# SPDX-License-Identifier: GPL-3.0-or-later

escape() { sed -e 's/&/\&amp;/g' -e 's/</\&lt;/g' -e 's/>/\&gt;/g' -e 's/"/\&quot;/g'; }

# How many there are, whatever OMP_NUM_THREADS says, which nproc would believe.
processors() { env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc; }

machine() {
	echo "$(uname -srm), $(processors) processors,$(sed -n 's/^model name[^:]*:/ /p' /proc/cpuinfo 2>/dev/null | head -n 1), $(awk '/^MemTotal/ {
		printf "%.1f GB", $2 / 1048576 }' /proc/meminfo 2>/dev/null)"
	echo "threads: ${OMP_NUM_THREADS:-as many as processors}; load when written: $(cut -d' ' -f1-3 /proc/loadavg 2>/dev/null)"
}

versions() {
	echo "pmpipe $version"
	echo "bash $BASH_VERSION"
	[ -z "${with_parallel:-}" ] || parallel --version </dev/null 2>/dev/null | head -n 1
}

# page_head TITLE
page_head() {
	printf '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>%s</title>\n' "$1"
	cat <<-'HTML'
		<style>
		body{font:15px/1.45 sans-serif;max-width:72em;margin:2em auto;padding:0 1em;color:#262a33}
		pre{background:#f4f5f7;padding:.7em;overflow-x:auto}
		table{border-collapse:collapse;font-size:13px;display:block;overflow-x:auto}
		td,th{padding:.15em .6em;text-align:left;border-bottom:1px solid #ddd;white-space:nowrap}
		th{cursor:pointer;user-select:none}
		th[aria-sort=ascending]::after{content:" \25b2"}
		th[aria-sort=descending]::after{content:" \25bc"}
		.front{background:#eef3f9;font-weight:bold}
		svg{max-width:100%;height:auto}
		button{float:right;margin:.4em}
		</style></head><body>
	HTML
}

# pasted TITLE TEXT: a block of text with a button that copies it.
pasted() { printf '<h2>%s</h2>\n<button type="button" class="copy">Copy</button><pre>%s</pre>\n' "$1" "$(escape <<<"$2")"; }

# rows_html TSV [FROM TO]: the table, without the columns FROM to TO; rows whose third column is yes stand out.
rows_html() {
	escape <"$1" | awk -F'\t' -v from="${2:-0}" -v to="${3:--1}" '{ tag = NR == 1 ? "th" : "td"; s = ""
		for (i = 1; i <= NF; i++) if (i < from || i > to) s = s "<" tag ">" $i "</" tag ">"
		print (NR == 1 ? "<table>\n<thead><tr>" : $3 == "yes" ? "<tr class=\"front\">" : "<tr>") s "</tr>" (NR == 1 ? "</thead><tbody>" : "") }
		END { print "</tbody></table>" }'
}

# A click sorts the rows by a column, as numbers where both are numbers; - and text stand behind numbers. A button copies the block behind it.
page_script() {
	cat <<-'HTML'
		<script>
		'use strict';
		for (const th of document.querySelectorAll('th')) th.addEventListener('click', () => {
			const body = th.closest('table').tBodies[0], k = th.cellIndex, up = th.getAttribute('aria-sort') !== 'ascending';
			const value = row => { const s = row.cells[k].textContent, x = Number(s); return s.trim() !== '' && !Number.isNaN(x) ? x : s; };
			const rank = v => typeof v === 'number' ? 0 : 1;
			const order = (a, b) => { const u = value(a), v = value(b);
				if (rank(u) !== rank(v)) return rank(u) - rank(v);
				const d = rank(u) ? u.localeCompare(v) : u - v;
				return up ? d : -d; };
			for (const other of th.parentNode.cells) other.removeAttribute('aria-sort');
			th.setAttribute('aria-sort', up ? 'ascending' : 'descending');
			body.append(...[...body.rows].sort(order));
		});
		for (const button of document.querySelectorAll('button.copy')) button.addEventListener('click', () => {
			const pre = button.nextElementSibling, named = s => { button.textContent = s; };
			const done = () => { named('Copied'); setTimeout(named, 1500, 'Copy'); };
			const select = () => { getSelection().selectAllChildren(pre); if (document.execCommand('copy')) done(); };
			if (navigator.clipboard) navigator.clipboard.writeText(pre.textContent).then(done, select); else select();
		});
		</script>
	HTML
}

page_foot() {
	pasted 'Every command as run' "$(commands)"
	printf '<h2>Machine</h2>\n<pre>%s</pre>\n<h2>Versions</h2>\n<pre>%s</pre>\n' "$(machine | escape)" "$(versions | escape)"
	page_script
	printf '</body></html>\n'
}

inline_svg() { sed '/^<?xml/d; /^<!DOCTYPE/,/>$/d' "$1"; }

# picture DIRECTORY NAME ARGUMENTS...: NAME.svg and NAME.png of points.tsv there, by splot with these arguments; sets picture_command.
picture() {
	local dir=$1 name=$2 ending
	shift 2
	plain_words splot "$@" points.tsv -o "$name.svg"
	picture_command=$text
	for ending in svg png; do
		splot "$@" -i "$dir/points.tsv" -o "$dir/$name.$ending" </dev/null 2>"$work/splot" ||
			{ tell "no picture: $(tail -n 1 "$work/splot" | sed 's/^splot: //')"; return; }
	done
	[ ! -s "$work/splot" ] || tell "$(sed 's/^splot: //' "$work/splot")"
}
