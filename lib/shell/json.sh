# shellcheck shell=bash
# Tables and texts as JSON. SPDX-License-Identifier: GPL-3.0-or-later

# Any tab-separated table as JSON: numbers stay numbers, "-" becomes null.
json_rows() {
	awk -F'\t' 'function quote(s) { gsub(/\\/, "\\\\&", s); gsub(/"/, "\\\"", s); gsub(/[\001-\037]/, " ", s); return "\"" s "\"" }
	function value(s) { return s == "-" ? "null" : s ~ /^-?[0-9]+(\.[0-9]*)?([eE][-+]?[0-9]+)?$/ ? s : quote(s) }
	NR == 1 { for (i = 1; i <= NF; i++) name[i] = $i; next }
	{ s = ""; for (i = 1; i <= NF; i++) s = s (i > 1 ? ", " : "") quote(name[i]) ": " value($i); printf "%s  {%s}", (NR > 2 ? ",\n" : ""),
		s } END { print "" }' "$1"
}
quoted() { awk 'BEGIN { s = ARGV[1]; gsub(/\\/, "\\\\&", s); gsub(/"/, "\\\"", s); gsub(/[\001-\037]/, " ", s); printf "\"%s\"", s }' "$1"; }
