// The frames of the page: descriptions in JSON, numbers in base64 blocks that are unpacked when they are first looked at.
// SPDX-License-Identifier: GPL-3.0-or-later

const run = {};      // what the program said about the run
const frames = [];   // descriptions: time, step, box, sets, meshes
const curves = {columns: [], rows: []};
const cacheLimit = 5e8; // bytes of unpacked numbers kept
const cache = new Map(); // in the order of use
let cached = 0;
let halves = null;   // value of every f16

function readPage() {
	const json = element => JSON.parse(element.textContent);
	Object.assign(run, json(document.getElementById("run")));
	for (const element of document.querySelectorAll("script.frame"))
		frames.push(json(element));
	Object.assign(curves, json(document.getElementById("curves")));
}

function bytesOf(text) {
	const binary = atob(text), bytes = new Uint8Array(binary.length);
	for (let i = 0; i < bytes.length; i++)
		bytes[i] = binary.charCodeAt(i);
	return bytes;
}

function halfTable() {
	const table = new Float32Array(65536);
	for (let i = 0; i < 65536; i++) {
		const exponent = i >> 10 & 31, fraction = i & 1023;
		const size = exponent ? (1 + fraction / 1024) * 2 ** (exponent - 15) : fraction * 2 ** -24;
		table[i] = i & 0x8000 ? -size : size;
	}
	return table;
}

function unpack(block, data) {
	const view = new DataView(bytesOf(document.getElementById("block-" + block).textContent).buffer);
	const size = data.as === "f32" ? 4 : 2, out = new Float32Array(view.byteLength / size);
	halves = halves || halfTable();
	for (let i = 0; i < out.length; i++) {
		const stored = size === 4 ? view.getFloat32(4 * i, true) : view.getUint16(2 * i, true);
		out[i] = data.lo + data.step * (data.as === "f16" ? halves[stored] : stored);
	}
	return out;
}

function remember(key, make) {
	let value = cache.get(key);
	if (value)
		cache.delete(key); // and again as the latest
	else {
		value = make();
		cached += value.byteLength;
	}
	cache.set(key, value);
	for (const [old, numbers] of cache) {
		if (cached <= cacheLimit || old === key)
			break;
		cache.delete(old);
		cached -= numbers.byteLength;
	}
	return value;
}

function countOf(place) {
	return place.points ? place.points[0] * place.points[1] * place.points[2] : place.kept;
}

// Component c of a field of a set or mesh; c = -1: the length of the vector. A Float32Array.
function numbersOf(frame, place, field, c) {
	if (field.data.length === 1)
		c = 0;
	return remember(`${frame.at}/${place.name}/${field.name}/${c}/${place.points ? 1 : 0}`, () => {
		if (c >= 0)
			return typeof field.data[c] === "object" && field.data[c] ? unpack(frame.at + field.data[c].at, field.data[c]) :
				new Float32Array(countOf(place)).fill(field.data[c] ?? NaN);
		const square = new Float64Array(countOf(place));
		for (let k = 0; k < field.data.length; k++) {
			const part = numbersOf(frame, place, field, k);
			for (let i = 0; i < square.length; i++)
				square[i] += part[i] * part[i];
		}
		return Float32Array.from(square, Math.sqrt);
	});
}

// "set matter" or "mesh mesh" -> the set or mesh of that name in the frame; undefined if it has none.
function placeOf(frame, name) {
	const list = name.startsWith("set ") ? frame.sets : frame.meshes;
	return list.find(place => place.name === name.slice(name.indexOf(" ") + 1));
}

const fieldOf = (place, name) => place && place.fields.find(field => field.name === name);

// The names of the components as sdraw and scalc spell them.
function componentName(field, c) {
	if (c < 0)
		return `|${field.name}|`;
	if (field.data.length === 1 && field.name !== "x")
		return field.name === "v" ? "vx" : field.name;
	if (field.name === "x")
		return "xyz"[c] ?? field.name + "_" + c;
	return c < 3 && field.data.length <= 3 ? field.name + (field.name.length === 1 ? "xyz"[c] : "." + "xyz"[c]) : field.name + "_" + c;
}

// Every number that a set or mesh offers, over all frames: {key, field, c, label, unit}.
function choicesOf(name) {
	const found = new Map();
	for (const frame of frames)
		for (const field of placeOf(frame, name)?.fields ?? []) {
			const first = field.data.length > 1 && field.name !== "x" ? -1 : 0;
			for (let c = first; c < field.data.length; c++) {
				const key = `${field.name} ${c}`;
				if (!found.has(key))
					found.set(key, {key, field: field.name, c, label: componentName(field, c), unit: field.unit});
			}
		}
	return [...found.values()];
}

// [smallest, largest, smallest above 0] of a choice in one frame, or over all (frame = null).
function rangeOf(name, choice, frame) {
	const range = [Infinity, -Infinity, Infinity];
	for (const one of frame ? [frame] : frames) {
		const field = fieldOf(placeOf(one, name), choice.field);
		const r = field && field.range[choice.c < 0 ? field.data.length : choice.c];
		if (!r || r[0] === null)
			continue;
		range[0] = Math.min(range[0], r[0]);
		range[1] = Math.max(range[1], r[1]);
		range[2] = Math.min(range[2], r[2] ?? Infinity);
	}
	return range[0] <= range[1] ? range : [0, 1, 1];
}
