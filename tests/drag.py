#!/usr/bin/env python3
"""A stage of a user, in Python without numpy: drag, acc += -k v, as the term 'drag'. Reads frame k, writes it whole, then reads k+1.
usage: drag.py K    SPDX-License-Identifier: GPL-3.0-or-later"""
import array, json, sys

i, o = sys.stdin.buffer, sys.stdout.buffer
k = float(sys.argv[1])
table = []
for n in range(256):
    for _ in range(8):
        n = n >> 1 ^ (0x82F63B78 if n & 1 else 0)
    table.append(n)


class Damaged(Exception):
    pass


def crc32c(data):
    c = 0xFFFFFFFF
    for byte in data:
        c = c >> 8 ^ table[(c ^ byte) & 255]
    return c ^ 0xFFFFFFFF


def pad(data, fill):
    return data + fill * (-len(data) % 64)


def line(words, block=b""):
    """The line of these words, with the checksum of words and block, and the block."""
    return (words + b" %08x" % crc32c(words + block)).ljust(63) + b"\n" + block


def text(j):
    t = json.dumps(j, sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()
    return t.ljust((len(t) + 64) // 64 * 64 - 1) + b"\n"


def take(n):
    data = i.read(n)
    if len(data) != n:
        raise Damaged("the input was cut")
    return data


def take_line():
    """Words and block of the next line, checked."""
    words = take(64).split()
    n = 4 if words[1] in (b"frame", b"abort") else 3
    size = 0 if words[1] == b"end" else int(words[3 if words[1] == b"abort" else 2])
    plain, block = b" ".join(words[:n]), take(size)
    if words[n:] not in ([], [b"%08x" % crc32c(plain + block)]):  # without a checksum: written by an older version
        raise Damaged("a checksum is wrong")
    return words, plain, block


def frames():
    while i.peek(1):
        words, plain, block = take_line()
        if words[1] != b"frame":  # end, abort: pass it on
            o.write(line(plain, block))
            o.flush()
            if words[1] == b"abort":
                sys.exit(int(words[2]))
            continue
        frame(json.loads(block))


def frame(j):
    n = {s["name"]: s["n"] for s in j["sets"]}
    data = {}
    for f in j["fields"]:
        size = 0 if "uniform" in f else n.get(f["on"], 0) * f["components"] * {"f64": 8, "i64": 8, "f32": 4, "u8": 1}[f["type"]]
        if f["on"] not in n and "uniform" not in f:
            raise Damaged("this little stage does not know meshes")
        data[f["on"], f["name"]] = take((size + 63) // 64 * 64)[:size]
    tail = json.loads(take_line()[2])
    if tail["crc32c"] != [crc32c(data[f["on"], f["name"]]) for f in j["fields"]]:
        raise Damaged("a checksum is wrong")
    v = array.array("d", data["matter", "v"])
    acc = next((f for f in j["fields"] if f["name"] == "acc"), None)
    a = array.array("d", data["matter", "acc"]) if acc else array.array("d", bytes(8 * len(v)))
    for p in range(len(a)):
        a[p] += -k * v[p]
    if acc:
        j["fields"].remove(acc)  # fields that a stage changes come last
    else:
        acc = {"name": "acc", "on": "matter", "components": 3, "type": "f64", "role": "change", "kind": "value", "unit": "", "of": "v"}
    acc["terms"] = acc.get("terms", []) + ["drag"]
    j["fields"].append(acc)
    data["matter", "acc"] = a.tobytes()
    blobs = [data[f["on"], f["name"]] for f in j["fields"]]
    header, tail["crc32c"] = text(j), [crc32c(b) for b in blobs]
    o.write(line(b"PMPIPE/1 frame %d %d" % (len(header), sum(len(pad(b, b"\0")) for b in blobs)), header))
    for b in blobs:
        o.write(pad(b, b"\0"))
    t = text(tail)
    o.write(line(b"PMPIPE/1 tail %d" % len(t), t))
    o.flush()


try:
    frames()
except (Damaged, ValueError, LookupError, TypeError, AttributeError, OverflowError, MemoryError, RecursionError) as e:
    message = "drag.py: %s" % (e if isinstance(e, Damaged) else "the input is damaged")
    print(message, file=sys.stderr)
    t = message.encode().ljust((len(message) + 64) // 64 * 64 - 1) + b"\n"
    o.write(line(b"PMPIPE/1 abort 1 %d" % len(t), t))
    sys.exit(1)
