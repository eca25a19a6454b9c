# Streams that are truncated, damaged, of another format, or whose reader stops: all cases for a filter, a sink and cycle, some for every other tool.
# Each case must give an exit status and a message.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

subjects="p2m diag cycle"
command_of() {
	case $1 in
	cycle) echo "cycle -n 1 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'" ;;
	diag) echo 'diag -q' ;;
	*) echo "$1" ;;
	esac
}

setup_file() {
	cd "$BATS_FILE_TMPDIR" || return
	cloud >one.pm
	pinit uniform -n 7 --seed 4 --cells 4 >other.pm
	wire frames one.pm other.pm >two.pm
}
setup() {
	cd "$BATS_TEST_TMPDIR" || return
	cp "$BATS_FILE_TMPDIR"/*.pm .
}

# fails FILE CODE PATTERN [SUBJECT...]: the exit status, one line on stderr that matches, and an abort with that line for later stages.
fails() {
	local file=$1 code=$2 pattern=$3 got=0 s
	shift 3
	for s in "${@:-$subjects}"; do for s in $s; do
		got=0
		bash -c "$(command_of "$s")" <"$file" >out 2>err || got=$?
		[ $got = "$code" ] || { echo "$s on $file: exit status $got, wanted $code"; cat err; return 1; }
		[ "$(wc -l <err)" = 1 ] || { echo "$s on $file: not one line on stderr:"; cat err; return 1; }
		grep -Eq "^$s: .*($pattern)" err || { echo "$s on $file: wanted '$pattern', got"; cat err; return 1; }
		[ "$s" = diag ] || [ "$(wire messages out)" = "$code $(cat err)" ] || { echo "$s on $file: the abort says"; wire messages out; return 1; }
		counted 1
	done; done
}

# works FILE [SUBJECT...]: exit status 0 and nothing on stderr; the output is in out.SUBJECT.
works() {
	local file=$1 got=0 s
	shift
	for s in "${@:-$subjects}"; do for s in $s; do
		got=0
		bash -c "$(command_of "$s")" <"$file" >"out.$s" 2>err || got=$?
		[ $got = 0 ] && [ ! -s err ] || { echo "$s on $file: exit status $got"; cat err; return 1; }
	done; done
}

# cut KIND PATTERN: at every position of that kind in a stream of two frames.
cut_at() {
	local place n=0 frame
	for place in $(wire places two.pm | grep -E "$1"); do
		wire cut two.pm "$place" >cut.pm
		frame=1
		case $place in *2 | *end-line) frame=2 ;; esac
		[ -s cut.pm ] && fails cut.pm 1 "frame $frame: .*$2"
		n=$((n + 1))
	done
	[ $n -gt 1 ]
}

@test "cut between the parts of a frame: exit 1, the frame is named" {
	cut_at '^before-(header|field|tail)' 'cut'
}

@test "cut in a line: exit 1, the frame is named" {
	cut_at '^in-(frame|tail)-line' 'cut'
}

@test "cut in a header: exit 1, the frame is named" {
	cut_at '^in-header' 'in a header: it was cut'
}

@test "cut in the data: exit 1, the frame is named" {
	cut_at '^in-field' 'in the data: it was cut'
}

@test "cut in a tail: exit 1, the frame is named" {
	cut_at '^in-tail[0-9]*$' 'in a tail: it was cut'
}

@test "cut before the end marker: exit 1, says that the marker is missing" {
	for place in before-frame-line2 before-end-line; do
		wire cut two.pm $place >cut.pm
		fails cut.pm 1 'without an end marker: it was cut'
	done
	wire cut two.pm in-end-line >cut.pm
	fails cut.pm 1 'cut'
}

@test "zero bytes are not a stream: exit 1" {
	: >empty.pm
	fails empty.pm 1 'zero bytes are not a stream'
}

@test "garbage: exit 1, says what it is not" {
	printf 'x y z\n1 2 3\n' >text
	fails text 1 'not a pmpipe stream'
	head -c 5000 "$top/COPYING" >long
	fails long 1 'not a pmpipe stream'
	head -c 4096 /dev/zero >zero
	fails zero 1 'not a pmpipe stream'
}

@test "garbage after a valid stream is not taken for another stream: exit 1" {
	cat one.pm text 2>/dev/null >behind || true
	echo 'a line behind the end' >>behind
	fails behind 1 'not a pmpipe stream'
}

@test "big-endian data: exit 1, says which is read" {
	wire edit one.pm 'h["byte_order"] = "big"' >big.pm
	fails big.pm 1 'little-endian'
}

@test "a newer version: exit 1, names the version" {
	wire line one.pm PMPIPE/1 PMPIPE/2 >new.pm
	fails new.pm 1 'version 2.*reads version 1'
}

@test "a bit that changed on the way: exit 1, the checksum says so, and nothing was computed from it" {
	wire flip two.pm in-field-x2 >flip.pm
	fails flip.pm 1 'frame 2: .*checksum'
}

@test "a damaged header, tail or end: exit 1" {
	wire text one.pm '"dim"' '"dim' >header.pm
	fails header.pm 1 'frame 1: .*not JSON'
	wire line one.pm 'PMPIPE/1 end 1' 'PMPIPE/1 end 2' >end.pm
	fails end.pm 1 'end marker does not count the'
	wire line one.pm 'PMPIPE/1 tail' 'PMPIPE/1 tale' >tail.pm
	fails tail.pm 1 'tale'
}

@test "two frames: each is treated as if it were alone" {
	works one.pm
	mv out.p2m one.out
	mv out.diag one.rows
	mv out.cycle one.cycle
	works other.pm
	mv out.p2m other.out
	mv out.diag other.rows
	mv out.cycle other.cycle
	works two.pm
	wire frames one.out other.out | cmp - out.p2m
	wire frames one.cycle other.cycle | cmp - out.cycle
	{ cat one.rows && tail -n +2 other.rows; } | cmp - out.diag
}

@test "two streams, one after the other: two streams come out" {
	works one.pm
	mv out.p2m one.out
	mv out.diag one.rows
	mv out.cycle one.cycle
	works other.pm
	mv out.p2m other.out
	mv out.diag other.rows
	mv out.cycle other.cycle
	cat one.pm other.pm >both.pm
	works both.pm
	cat one.out other.out | cmp - out.p2m
	cat one.cycle other.cycle | cmp - out.cycle
	{ cat one.rows && tail -n +2 other.rows; } | cmp - out.diag
}

@test "a stream of no frames is a stream: exit 0" {
	wire end >none.pm
	works none.pm
	cmp none.pm out.p2m
	cmp none.pm out.cycle
}

@test "unknown fields and attributes are passed on unchanged and have no effect" {
	wire edit one.pm '
h["colour"] = {"deep": [1, None, "two"]}
h["box"]["walls"] = "painted"
h["law"]["since"] = 1687
h["sets"][0]["nickname"] = "dust"
h["meshes"][0]["age"] = 1.5
h["fields"].insert(1, {"name": "temperature", "on": "matter", "components": 1, "type": "f32", "role": "state", "kind": "value", "unit": "K", "by": "hand"})
data.insert(1, bytearray(struct.pack("<12f", *range(12))))' >odd.pm
	works odd.pm
	for s in p2m cycle; do
		wire edit out.$s '
assert h["colour"] == {"deep": [1, None, "two"]} and h["box"]["walls"] == "painted" and h["law"]["since"] == 1687, h
assert h["sets"][0]["nickname"] == "dust" and h["meshes"][0]["age"] == 1.5, h
i = field("temperature")
assert h["fields"][i]["by"] == "hand" and h["fields"][i]["type"] == "f32" and struct.unpack("<12f", data[i]) == tuple(range(12))' >/dev/null
	done
	works one.pm diag
	mv out.diag plain
	works odd.pm diag
	cmp plain out.diag
}

@test "no particles: exit 0, a zero density, a row of zeros" {
	wire edit one.pm 'resize("matter", 0)' >nobody.pm
	works nobody.pm
	wire edit out.p2m 'assert not any(data[field("rho")]), "rho"' >/dev/null
	[ "$(column mass <out.diag)" = 0 ]
	wire edit out.cycle 'assert h["step"] == 1 and h["sets"][0]["n"] == 0' >/dev/null
}

@test "NaN in a field that is read: exit 1, the field is named" {
	wire edit one.pm 'put("x", 5, float("nan"))' >nan.pm
	fails nan.pm 1 "(frame 1|step 1: p2m): 'x' of 'matter' is not finite"
	wire edit one.pm 'put("x", 5, float("inf"))' >inf.pm
	fails inf.pm 1 "(frame 1|step 1: p2m): 'x' of 'matter' is not finite"
}

@test "NaN in a field that is not read is passed on: exit 0" {
	wire edit one.pm '
h["fields"].append({"name": "heat", "on": "matter", "components": 1, "type": "f64", "role": "state", "kind": "value", "unit": ""})
data.append(bytearray(struct.pack("<12d", *[float("nan")] * 12)))' >nan.pm
	works nan.pm
	for s in p2m cycle; do
		wire edit out.$s 'assert struct.unpack("<12d", data[field("heat")])[3] != 0
assert all(v != v for v in struct.unpack("<12d", data[field("heat")]))' >/dev/null
	done
}

@test "a full disk: exit 1, the system's reason" {
	for s in $subjects; do
		got=0
		bash -c "$(command_of "$s")" <one.pm >/dev/full 2>err || got=$?
		[ $got = 1 ]
		[ "$(wc -l <err)" = 1 ]
		grep -q "^$s: .*No space left on device" err
	done
}

@test "a reader that has exited: SIGPIPE, no message" {
	for s in $subjects; do
		[ "$(wire closed bash -c "exec $(command_of "$s")" <one.pm 2>err)" = 141 ] || { echo "$s"; return 1; }
		[ ! -s err ]
	done
}

@test "every other tool: cut in the data, exit 1 and the message" {
	for t in $(readers); do
		input "$t" >in.pm
		cp in.pm same.pm
		wire cut in.pm "$(wire places in.pm | grep in-field | head -n 1)" >cut.pm
		got=0
		bash -c "$(words "$t")" <cut.pm >out 2>err || got=$?
		[ $got = 1 ] && grep -q "^$t: .*cut" err && [ "$(wc -l <err)" = 1 ] || { echo "$t: exit status $got"; cat err; return 1; }
		counted 1
	done
}

@test "every other tool: zero bytes, exit 1 and the message" {
	for t in $(readers); do
		input "$t" >same.pm
		got=0
		bash -c "$(words "$t")" </dev/null >out 2>err || got=$?
		[ $got = 1 ] && grep -q "^$t: .*zero bytes are not a stream" err || { echo "$t: exit status $got"; cat err; return 1; }
	done
}

@test "every other tool: a newer version, exit 1 and the message" {
	for t in $(readers); do
		input "$t" >same.pm
		wire line same.pm PMPIPE/1 PMPIPE/2 >new.pm
		got=0
		bash -c "$(words "$t")" <new.pm >out 2>err || got=$?
		[ $got = 1 ] && grep -q "^$t: .*version 2" err || { echo "$t: exit status $got"; cat err; return 1; }
	done
}

@test "every other tool: works on the complete stream" {
	for t in $(readers); do
		input "$t" >same.pm
		got=0
		bash -c "$(words "$t")" <same.pm >out 2>err || got=$?
		[ $got = 0 ] || { echo "$t: exit status $got"; cat err; return 1; }
	done
}
