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


def crc32c(data):
    c = 0xFFFFFFFF
    for byte in data:
        c = c >> 8 ^ table[(c ^ byte) & 255]
    return c ^ 0xFFFFFFFF


def pad(data, fill):
    return data + fill * (-len(data) % 64)


def line(text):
    return text.ljust(63).encode() + b"\n"


def text(j):
    t = json.dumps(j, sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()
    return t.ljust((len(t) + 64) // 64 * 64 - 1) + b"\n"


while True:
    head = i.read(64).split()
    if not head:
        break
    if head[1] != b"frame":  # end, abort: pass it on
        o.write(line(" ".join(w.decode() for w in head)) + (i.read(int(head[3])) if head[1] == b"abort" else b""))
        o.flush()
        continue
    j = json.loads(i.read(int(head[2])))
    n = {s["name"]: s["n"] for s in j["sets"]}
    data = {}
    for f in j["fields"]:
        size = 0 if "uniform" in f else n.get(f["on"], 0) * f["components"] * {"f64": 8, "i64": 8, "f32": 4, "u8": 1}[f["type"]]
        assert f["on"] in n or size == 0, "this little stage does not know meshes"
        data[f["on"], f["name"]] = i.read((size + 63) // 64 * 64)[:size]
    tail = json.loads(i.read(int(i.read(64).split()[2])))
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
    header = text(j)
    o.write(line("PMPIPE/1 frame %d %d" % (len(header), sum(len(pad(b, b"\0")) for b in blobs))) + header)
    for b in blobs:
        o.write(pad(b, b"\0"))
    tail["crc32c"] = [crc32c(b) for b in blobs]
    t = text(tail)
    o.write(line("PMPIPE/1 tail %d" % len(t)) + t)
    o.flush()
