# The reader of docs/read.py on real streams: the same values as stab's text, the same checksums, the same complaints.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

read_py() { python3 "$top/docs/read.py"; }

@test "the Python reader is short" {
	[ "$(grep -cvE '^ *(#.*)?$' "$top/docs/read.py")" -le 70 ]
	! grep -q numpy "$top/docs/read.py"
}

@test "the Python reader gets the values that stab prints, to the last bit" {
	pinit uniform -n 50 --seed 2 --dispersion 1.5 --mass-spread 0.3 >a.pm
	stab <a.pm >text
	read_py <a.pm >read
	python3 - <<-'END'
	import re
	text = [l.split("\t") for l in open("text").read().splitlines() if l and not l.startswith("#")]
	head, rows = text[0], text[1:]
	read, name = {}, None
	for line in open("read").read().splitlines():
	    if re.match("[a-z]", line) and not line.startswith(("nan", "inf")):
	        name = line.split()[1]
	        read[name] = []
	    else:
	        read[name].append([float(v) for v in line.split("\t")])
	axes = {"x": ("x", 0), "y": ("x", 1), "z": ("x", 2), "vx": ("v", 0), "vy": ("v", 1), "vz": ("v", 2), "mass": ("mass", 0), "id": ("id", 0)}
	assert len(rows) == 50 and set(axes) <= set(head), head
	for column, (field, c) in axes.items():
	    assert [float(r[head.index(column)]) for r in rows] == [v[c] for v in read[field]], column
	END
}

@test "the Python reader reads particles, meshes, uniform fields and several frames, and agrees on every checksum" {
	cloud | p2m >mesh.pm
	cat mesh.pm mesh.pm >two.pm
	read_py <two.pm >out
	[ "$(grep -c '^mesh rho f64' out)" = 2 ]
	[ "$(sed -n '/^mesh rho/,$p' out | sed -n '2,65p' | wc -l)" = 64 ]
	[ "$(sed -n '/^matter mass/,/^matter id/p' out | grep -v '^matter' | sort -u | wc -l)" = 1 ] # uniform
}

@test "the Python reader and ours say no to the same: cut, damaged, refused, aborted" {
	cloud >a.pm
	wire cut a.pm in-field-v >cut.pm
	run -1 read_py <cut.pm
	[ "$output" = "the stream is cut" ]
	wire flip a.pm in-field-v >flip.pm
	run -1 read_py <flip.pm
	[ "$output" = "a checksum is wrong" ]
	wire line a.pm PMPIPE/1 PMPIPE/2 >new.pm
	run -1 read_py <new.pm
	run -1 read_py </dev/null
	push --nonsense <a.pm >abort.pm 2>err || true
	run -2 read_py <abort.pm
	[ "$output" = "$(cat err)" ]
}

# The reader of lib/pmpipe-read.h in a program that prints what it reads; with --flips it reads the file with every byte damaged, and cut at every length.
one_header() {
	cat >print.c <<-'END'
		#include "pmpipe-read.h"
		static int all(FILE *file, int print)
		{
			struct pmr *r = pmr_of(file);
			int code, got;
			while ((got = pmr_next(r)) > 0)
				for (size_t i = 0; i < r->nfields; i++) {
					const struct pmr_field *f = r->fields + i;
					size_t n;
					const void *data = pmr_data(r, f->on, f->name, f->type, &n);
					if (!print)
						continue;
					printf("%s %s %s\n", f->on, f->name, f->type);
					for (size_t k = 0; k < n; k++)
						for (int c = 0; c < f->components; c++) {
							size_t at = (size_t)c * n + k;
							double v = f->type[0] == 'i' ? (double)((const int64_t *)data)[at]
								: f->type[0] == 'u' ? ((const unsigned char *)data)[at]
								: f->type[1] == '3' ? ((const float *)data)[at] : ((const double *)data)[at];
							printf("%.17g%c", v, c < f->components - 1 ? '\t' : '\n');
						}
				}
			if (got && print)
				fprintf(stderr, "%s\n", pmr_message(r));
			code = pmr_code(r);
			pmr_close(r);
			return code;
		}
		int main(int argc, char **argv)
		{
			static unsigned char data[1 << 20];
			FILE *file = fopen(argv[1], "rb");
			size_t n = fread(data, 1, sizeof data, file), bad = 0;
			fclose(file);
			if (argc == 2)
				return all(fmemopen(data, n, "rb"), 1);
			for (size_t at = 0; at < n; at++) {
				data[at] ^= 1 << at % 8;
				bad += !all(fmemopen(data, n, "rb"), 0);
				data[at] ^= 1 << at % 8;
				bad += at && !all(fmemopen(data, at, "rb"), 0);
			}
			return bad != 0;
		}
	END
	gcc -std=gnu99 -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all -Wall -Wextra -Werror -I"$top/lib" -o show print.c 2>err ||
		gcc -std=gnu99 -O1 -Wall -Wextra -Werror -I"$top/lib" -o show print.c
}

@test "the reader in one header gets the values that docs/read.py gets, of every kind of field" {
	one_header
	cloud | p2m | poisson-fft | mgrad >a.pm
	smod --store f32 <a.pm >b.pm
	pinit two-stream -n 10 --cells 4 | cycle -n 2 --every 1 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' >c.pm
	cat a.pm c.pm >d.pm
	sel --where 'x > 1e6' <a.pm >e.pm
	wire edit a.pm 'h["remark"] = {"\u00e4\\\"b": [1e300, -1e-7, None, True, {}], "": []}
h["fields"].insert(1, {"name": "fl\u00e4g\"", "on": "matter", "components": 1, "type": "u8", "role": "state", "kind": "value", "unit": ""})
data.insert(1, bytearray(range(12)))' >f.pm
	wire unseal a.pm >g.pm
	for f in ?.pm; do
		./show $f | awk '{ if ($0 !~ /^[a-z]/) for (i = 1; i <= NF; i++) $i = sprintf("%.17g", $i); $1 = $1; print }' >got
		read_py <$f | awk '{ if ($0 !~ /^[a-z]/) for (i = 1; i <= NF; i++) $i = sprintf("%.17g", $i); $1 = $1; print }' | cmp - got
		[ "$(wc -l <got)" -gt 5 ]
	done
}

@test "the reader in one header refuses every flipped byte, every cut, and headers that lie; no read past the end" {
	one_header
	pinit two-body --no-history >a.pm
	pinit plummer -n 2 --cells 2 --no-history | p2m --no-history >b.pm
	for f in a b; do ./show $f.pm >/dev/null && ./show $f.pm --flips; done
	for code in 'h["sets"][0]["n"] = 2 ** 48 + 1' 'h["sets"][0]["n"] = 2 ** 47' 'h["sets"] *= 2' 'h["fields"] *= 2' \
		'h["meshes"][0]["cells"] = [2 ** 20] * 3' 'h["meshes"][0]["h"][1] = 0' 'h["fields"][0]["on"] = "nobody"' 'h["fields"][0]["components"] = 17' \
		'h["fields"][0]["type"] = "f16"' 'h["fields"][0]["name"] = "n" * 64' 'h["byte_order"] = "big"' 'h["box"]["fields"][0] = ["periodic", "open"]' \
		'del h["law"]' 'h["dim"] = 4' 'h["fields"][0]["name"] = "\0"' 'h["fields"][0]["uniform"] = [1]'; do
		wire edit b.pm "$code" >bad.pm || continue
		run -1 ./show bad.pm
		[ "${#lines[@]}" = 1 ]
	done
	wire text b.pm '"dim":3' '"dim":3,"dim":3' >bad.pm
	run -1 ./show bad.pm
	for f in "$top"/tests/fuzz/crashes/reader/*; do
		code=0
		PM_UNSEALED=1 timeout 20 ./show "$f" >out 2>err || code=$?
		[[ $code -le 3 && $(wc -l <err) -le 1 ]] || { cat err; return 1; }
	done
	push --nonsense <a.pm >abort.pm 2>said || true
	run -2 ./show abort.pm
	[ "$output" = "$(cat said)" ]
}
