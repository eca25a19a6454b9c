# HC-60: the input of a filter may be anything. Hostile headers give an error message and use no memory.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load ../tool/words

setup_file() {
	cd "$BATS_FILE_TMPDIR" || return
	cloud >one.pm
}

# [kB] of address space; the sanitizers need terabytes of it, and refuse huge requests by themselves.
memory=${PM_SANITIZED:+unlimited}
memory=${memory:-500000}
[ -z "$PM_SANITIZED" ] || export ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}allocator_may_return_null=1:max_allocation_size_mb=500

# refused FILE PATTERN: by a filter, a sink and cycle: exit 1 within a second and 500 MB, one printable line that matches. All three read by the same code: the
# first file of a test is given to each, the others to one in turn, in check-long all to each.
refused() {
	local s got subjects=(p2m sls "cycle -n 1 'push drift'")
	[ $((turn++)) = 0 ] || [ -n "${PM_LONG:-}" ] || subjects=("${subjects[$((turn % 3))]}")
	for s in "${subjects[@]}"; do
		got=0
		(ulimit -v "$memory" && timeout 5 bash -c "OMP_NUM_THREADS=1 $s" <"$1" >out 2>err) || got=$?
		[ -z "$PM_SANITIZED" ] || sed -i '/^==.*WARNING: AddressSanitizer failed to allocate/d' err
		[ $got = 1 ] || { echo "$s on $1: exit status $got"; head -c 300 err; return 1; }
		[ "$(wc -l <err)" = 1 ] || { echo "$s on $1: not one line"; head -c 600 err; return 1; }
		[ "$(wc -c <err)" -lt 600 ] || { echo "$s on $1: a very long message"; head -c 900 err; return 1; }
		! LC_ALL=C grep -q '[^ -~]' err || { echo "$s on $1: not printable"; cat -A err; return 1; }
		grep -Eq "^${s%% *}: .*($2)" err || { echo "$s on $1: wanted '$2', got"; cat err; return 1; }
	done
	counted 1
}
setup() {
	turn=0
	cd "$BATS_TEST_TMPDIR" || return
	cp "$BATS_FILE_TMPDIR"/one.pm .
}
header() { wire edit one.pm "$1" >hostile.pm; }
text() { wire text one.pm "$1" "$2" >hostile.pm; }

@test "HC-60: sizes that are huge, negative, no integers or do not fit the payload are refused" {
	for n in 13 1000000000000 281474976710656 9223372036854775807 -1 -12 12.5 1e3 18446744073709551615 99999999999999999999999 '"12"' null true '[12]'; do
		text '"n":12' "\"n\":$n"
		refused hostile.pm "header|JSON|checksum" # 13 need as many padded bytes as 12: only the checksums show the difference
	done
}

@test "HC-60: no memory is allocated for a huge payload before it arrives" {
	# 2^40 particles, and a line that announces their size.
	wire text one.pm '"n":12' '"n":1099511627776' >big.pm
	promised=$(wire header one.pm |
		python3 -c 'import json,sys; h=json.load(sys.stdin); print(sum(-(-f["components"]*2**40*8//64)*64 for f in h["fields"] if "uniform" not in f))')
	old=$(head -c 64 big.pm | tr -s ' ' | cut -d' ' -f4)
	wire line big.pm " $old" " $promised" >hostile.pm
	refused hostile.pm 'memory|cut'
}

@test "HC-60: cells, components and dimensions out of range are refused" {
	for c in '[4,4,0]' '[4,4,-4]' '[4,4]' '[4,4,4,4]' '[2147483648,2147483648,2147483648]' '[9223372036854775807,2,2]' '[1.5,4,4]' '[1e308,1e308,1e308]' \
		'"4"' '{}'; do
		text '"cells":[4,4,4]' "\"cells\":$c"
		refused hostile.pm "header|JSON"
	done
	for c in 0 -1 17 1000000000 4294967297; do
		text '"components":3' "\"components\":$c"
		refused hostile.pm "header"
	done
	for d in 0 4 -3 2147483651; do
		text '"dim":3' "\"dim\":$d"
		refused hostile.pm "header"
	done
}

@test "HC-60: fields whose sizes overflow 64 bits in sum are refused" {
	header '
for s in h["sets"]: s["n"] = 1 << 48
h["fields"] = [{"name": "f%d" % i, "on": "matter", "components": 16, "type": "f64", "role": "state", "kind": "value", "unit": ""} for i in range(600)]
data[:] = [bytearray() for f in h["fields"]]'
	refused hostile.pm "are too large|describes"
}

@test "HC-60: JSON that is deep, cut, has duplicate keys, is not UTF-8, or has invalid syntax" {
	text '"dim":3' "\"deep\":$(printf '[%.0s' {1..5000})$(printf ']%.0s' {1..5000}),\"dim\":3"
	refused hostile.pm "JSON"
	for t in '"dim":NaN' '"dim":Infinity' '"dim":-Infinity' '"dim":1e999' '"dim":03' '"dim":3,' '"dim":3,"dim":3' '"dim":0x3' "'dim':3" \
		'"dim":3,"a":"\xff\xfe"' '"dim":3,"a":"\xc0\x80"' '"dim":3,"a":"\xed\xa0\x80"' '"dim":3,"a":"\x00"' '"dim":3,"a":"\x1b[2J"' '"dim":3}{'; do
		text '"dim":3' "$t"
		refused hostile.pm "JSON"
	done
	wire text one.pm '{' '[' >hostile.pm
	refused hostile.pm "JSON"
}

@test "HC-60: a header that is not an object is refused" {
	for code in 'h.clear()' 'h["fields"] = {}' 'h["fields"] = [[]]' 'h["sets"] = 3' 'h["sets"].append(None)' 'h["meshes"] = None' 'h["box"] = []' \
		'h["law"] = "gravity"' \
		'h["history"] = {}' 'h["time"] = "now"' 'h["step"] = -1' 'h["step"] = 1.5' 'h["substep"] = -1' 'h["box"]["lo"] = [0, 0]' \
			'h["box"]["hi"] = h["box"]["lo"]' \
		'h["box"]["fields"][0] = ["periodic", "open"]' 'h["box"]["fields"] = "periodic"' 'h["box"]["particles"][1][1] = "elastic"' \
			'h["sets"][0]["done"] = {"kick": -1, "drift": 0}' \
		'h["sets"][0]["done"] = {"kick": "half", "drift": 0}' 'h["meshes"][0]["h"][0] = 0' 'h["meshes"][0]["h"][0] = -1.0' 'del h["law"]' \
			'del h["box"]'; do
		wire edit one.pm "
keep = [len(d) for d in data]
$code" >hostile.pm 2>err || true
		[ -s hostile.pm ] || { echo "could not make: $code"; cat err; return 1; }
		refused hostile.pm "header"
	done
}

@test "HC-60: names that are empty, too long, duplicate, without owner, or no text are refused" {
	long=$(printf 'n%.0s' {1..64})
	for code in 'h["fields"][0]["name"] = ""' "h['fields'][0]['name'] = '$long'" 'h["fields"][0]["name"] = 7' 'h["fields"][0]["name"] = "v"' \
		'h["fields"][0]["on"] = "nobody"' \
		'h["fields"][0]["type"] = "f16"' 'h["fields"][0]["role"] = "king"' 'h["fields"][0]["kind"] = "odd"' 'h["fields"][0]["half"] = [[1]]' \
			'h["fields"][0]["half"] = [["a", 0, 0], [0, 0, 2], [0, 0, 0]]' 'h["fields"][0]["terms"] = 3' \
		'h["fields"][0]["terms"] = ["t%d" % i for i in range(99)]' 'h["sets"].append(dict(h["sets"][0]))' 'h["meshes"].append(dict(h["meshes"][0]))' \
		'h["meshes"][0]["name"] = "matter"' 'h["fields"][0]["unit"] = [1]' 'h["fields"][0]["uniform"] = [1, 2, "three"]' \
			'h["fields"][0]["uniform"] = [1]' 'h["law"]["name"] = 7'; do
		header "$code"
		refused hostile.pm "header"
	done
}

@test "HC-60: lines that announce too much, or wrong numbers, are refused" {
	for size in 18446744073709551615 99999999999999999999 17000000 -64 63 0 x '' '64 64 64 64'; do
		old=$(head -c 64 one.pm | tr -s ' ' | cut -d' ' -f3)
		wire line one.pm "frame $old " "frame $size " >hostile.pm
		refused hostile.pm "header|line"
	done
	printf '%-63s\n' 'PMPIPE/1 abort 1 18446744073709551615' >hostile.pm
	refused hostile.pm "abort|line"
	printf '%-63s\n' 'PMPIPE/1 abort' >hostile.pm
	refused hostile.pm "abort|line"
	printf '%-63s\n' 'PMPIPE/1 tail 64' >hostile.pm
	refused hostile.pm "tail"
	printf '%-62s\n\n' 'PMPIPE/1' >hostile.pm
	refused hostile.pm "line|instead of a frame"
}

@test "HC-60: the text of an abort is printed as one line, its code is kept only if valid" {
	{ printf '%-63s\n' 'PMPIPE/1 abort 3 64'; printf '%-63s\n' $'p2m: \e[31mred\e[0m\ttab'; } >abort.pm
	got=0
	sls <abort.pm 2>err || got=$?
	[ $got = 3 ]
	[ "$(wc -l <err)" = 1 ]
	run ! grep -q $'\e' err
	{ printf '%-63s\n' 'PMPIPE/1 abort 77 64'; printf '%-63s\n' 'odd'; } >abort.pm
	run -1 sls -i abort.pm
}

@test "HC-60: a wrong tail is refused: checksums missing, too many, of the wrong kind" {
	for t in '"crc32d":[' '"crc32c":[1,' '"crc32c":[null,1,' '"crc32c":{"a":1},"b":['; do
		wire tail-text one.pm '"crc32c":[' "$t" >hostile.pm
		refused hostile.pm "tail"
	done
	wire tail-text one.pm '"report":{}' '"report":[]' >hostile.pm
	refused hostile.pm "tail"
}
