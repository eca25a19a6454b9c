# The checksums of lines, headers and tails, and streams of versions that had none. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

# Written by version 0.1.0, before lines had checksums and frames had `since`:
#   unsealed-stream.pm: pinit landau -n 64 --cells 16 --seed 3 | smod --dt 0.1 | cycle -n 8 --every 4 '<leapfrog with mesh words>' | p2m | poisson-mg,
#     and behind it a frame half-way through a step: pinit two-body | pp | push rk4 | pp | push rk4
#   unsealed-checkpoint.pm: pinit plummer -n 30 --cells 4 --seed 3 | cycle -n 8 --checkpoint FILE "$forces"
old=$top/tests/reference
forces='push --dt 0.1 kick/2 drift | pp | push kick/2'

@test "a stream without checksums of its lines is read, and its values are those that were written" {
	sh_ok "sls -i '$old/unsealed-stream.pm' | grep '^frame'"
	[ "$output" = "frame 1: time 0 step 0 substep 0 dt 0.1 dim 1 seed 3
frame 2: time 0.4 step 4 substep 0 dt 0.1 dim 1 seed 3
frame 3: time 0.8 step 8 substep 0 dt 0.1 dim 1 seed 3
frame 4: time 0.01570796327 step 0 substep 2 dt 0.03141592654 dim 3 seed 1" ]
	python3 "$top/docs/read.py" <"$old/unsealed-stream.pm" >values
	[ "$(cksum <values)" = "1115991245 23786" ]
	sel -i "$old/unsealed-stream.pm" -o passed.pm
	python3 "$top/docs/read.py" <passed.pm | cmp - values
	sls --report -i "$old/unsealed-stream.pm" >reports
	sls --report -i passed.pm | cmp - reports
}

# Times before `since` are sums, so they agree to round-off only.
@test "a checkpoint without them is taken up where it was left" {
	cycle -n 12 --resume "$old/unsealed-checkpoint.pm" "$forces" >late.pm
	pinit plummer -n 30 --cells 4 --seed 3 | cycle -n 12 "$forces" | scmp --tolerance 1e-12 late.pm - >/dev/null
	[[ $(sls <late.pm) == "frame 1: time 1.2 step 12 substep 0 dt 0.1 "* ]]
}

@test "a step begun before is completed" {
	sel --frames 4 -i "$old/unsealed-stream.pm" | pp | push rk4 | pp | push rk4 >late.pm
	pinit two-body | cycle -n 1 'pp | push rk4' >new.pm
	scmp --tolerance 1e-12 late.pm new.pm >/dev/null
	[[ $(sls <late.pm) == "frame 1: time 0.03141592654 step 1 substep 0 "* ]]
}

@test "every line, header and tail of every word has its checksum, and the tests' own reader agrees with it" {
	cloud | cycle -n 2 --every 1 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' >a.pm
	sealed() { grep -aoE 'PMPIPE/1 (frame [0-9]+ [0-9]+|tail [0-9]+|end [0-9]+) [0-9a-f]{8} ' "$1" | wc -l; }
	[ "$(sealed a.pm)" = 7 ]
	wire seal a.pm | cmp - a.pm
	wire unseal a.pm >old.pm
	[ "$(sealed old.pm)" = 0 ]
	sel <old.pm | cmp - <(sel <a.pm)
	push --nonsense <a.pm >abort.pm 2>/dev/null || true
	wire seal abort.pm | cmp - abort.pm
	wire unseal abort.pm >old.pm
	run -2 sls -i old.pm
}

# Edits that leave the header sound JSON with sound numbers: without a checksum nothing could tell.
@test "a digit that changed in a header, a tail or a line is refused by every word, in one line" {
	edit() { LC_ALL=C sed "s/$1/$2/" same.pm; }
	for t in $(readers); do
		input "$t" >same.pm
		edit '"seed":[0-9]' '"seed":8' >header.pm
		edit '"report":{' '"REPORT":{' >tail.pm
		edit '^\(PMPIPE.1 end .*\)[0-9a-f] ' '\10e ' >end.pm
		for f in header tail end; do
			run -1 cmp -s same.pm $f.pm
			got=0
			bash -c "$(words "$t")" <$f.pm >out 2>err || got=$?
			[ $got = 1 ] && [ "$(grep -c . err)" = 1 ] && grep -Eq "^$t: .*(checksum of (a $f|the $f marker)|line of the stream)" err ||
				{ echo "$t, $f: exit status $got"; cat err; return 1; }
		done
		PM_UNSEALED=1 bash -c "$(words "$t")" <header.pm >out || { echo "$t with PM_UNSEALED=1"; return 1; }
	done
}

@test "padding that is neither zeros behind a field nor spaces behind a text is refused, with checksums and without" {
	cloud >a.pm
	python3 - <<-'PY'
		data = open("a.pm", "rb").read()
		words = data.split(None, 4)
		header, payload = int(words[2]), int(words[3])
		def put(name, at, new, old):
		    assert data[at:at + 1] == old
		    open(name, "wb").write(data[:at] + new + data[at + 1:])
		put("field.pm", 64 + header + payload - 1, b"\1", b"\0")
		put("header.pm", 64 + header - 1, b" ", b"\n")
		put("line.pm", 62, b"0", b" ")
		at = data.index(b" \n", 64)
		put("text.pm", at, b"\t", b" ")
	PY
	for f in field header line text; do
		run -1 --separate-stderr p2m -i $f.pm -o out.pm
		[ "$(wc -l <<<"$stderr")" = 1 ]
		PM_UNSEALED=1 run -1 --separate-stderr p2m -i $f.pm -o out.pm
	done
	[[ $stderr == *"spaces and a newline"* ]]
}

@test "the sealer of docs/stream.md gives an edited header its checksum" {
	sed -n '/^    import sys; .*crc32c/,/^$/s/^    //p' "$top/docs/stream.md" >sealer.py
	[ "$(grep -c . sealer.py)" = 4 ]
	cp "$top/docs/read.py" read.py
	pinit plummer -n 5 | cycle -n 2 --every 1 'push kick/2 drift | pp | push kick/2' >a.pm
	sed 's/"seed":1/"seed":7/' a.pm >b.pm
	run -1 sls -i b.pm
	python3 sealer.py <b.pm >c.pm
	[ "$(sls -i c.pm | grep -c 'seed 7')" = 3 ]
	wire seal b.pm | cmp - c.pm
	push --nonsense <a.pm >d.pm 2>/dev/null || true
	cat d.pm d.pm | python3 sealer.py | cmp - <(cat d.pm d.pm)
}

# One bit of every byte of a small stream, in one process each: Python needs 1 ms a flip.
@test "the reader in Python refuses what is damaged in one line, without a traceback" {
	pinit two-body --no-history >a.pm
	python3 - "$top/docs" <<-'PY'
		import contextlib, io, sys
		sys.path.insert(0, sys.argv[1])
		import read
		data = open("a.pm", "rb").read()
		print(len(list(read.frames(io.BufferedReader(io.BytesIO(data))))), "frame")
		for at in range(len(data)):
		    bad = data[:at] + bytes([data[at] ^ 1 << at % 8]) + data[at + 1:]
		    said = io.StringIO()
		    try:
		        with contextlib.redirect_stderr(said):
		            list(read.frames(io.BufferedReader(io.BytesIO(bad))))
		    except SystemExit as e:
		        assert e.code == 1 and said.getvalue().count("\n") == 1, (at, e.code, said.getvalue())
		    else:
		        raise SystemExit("byte %d: read" % at)
	PY
	wire unseal a.pm >old.pm
	for edit in 's/"dim":3/"dim"3/' 's/"type":"f64"/"type":"f99"/' 's/"sets":\[/"sets":[3/' 's/"n":2/"n":7/' 's/frame [0-9]*/frame x/' \
		's/"on":/"no":/' 's/tail [0-9]*/tail -9/' 's/"crc32c"/"crc32d"/' 's/"name":"matter"/"name":"\xff\xfe"/' \
		's/frame [0-9]*/frame 99999999999/'; do
		for f in a.pm old.pm; do
			LC_ALL=C sed "$edit" $f >bad.pm
			run -1 cmp -s $f bad.pm
			run -1 --separate-stderr bash -c "python3 '$top/docs/read.py' <bad.pm >out.pm"
			[ "$(wc -l <<<"$stderr")" = 1 ] && [[ $stderr != *Trace* ]] || { echo "$edit, $f: $stderr"; return 1; }
		done
	done
	run -0 bash -c "python3 '$top/docs/read.py' <a.pm >out.pm"
}
