// What is shown of a frame: which numbers, on which axes, in which colours. SPDX-License-Identifier: GPL-3.0-or-later

const state = {frame: 0, playing: false, drawn: null}; // drawn: what hover looks at
const chosen = id => document.getElementById(id).value;
const many = 4000; // particles from which on a density says more than points, as in sdraw

const choice = (name, key) => choicesCache(name).find(one => one.key === key);
const choicesHeld = new Map();

function choicesCache(name) {
	if (!choicesHeld.has(name))
		choicesHeld.set(name, choicesOf(name));
	return choicesHeld.get(name);
}

const isPosition = (one, dim) => one && one.field === "x" && one.c < dim;

// An axis for the numbers of a choice: the box for a position, else the range over all frames and a little more.
function axisOf(name, one) {
	const d = frames[0].dim;
	if (isPosition(one, d)) {
		const lo = Math.min(...frames.map(f => f.box[one.c].lo)), hi = Math.max(...frames.map(f => f.box[one.c].hi));
		return {label: "xyz"[one.c], unit: one.unit, lo, hi, periodic: frames[0].box[one.c].periodic, length: hi - lo};
	}
	let [lo, hi] = one ? rangeOf(name, one, null) : [-0.5, 0.5];
	const pad = hi > lo ? 0.04 * (hi - lo) : Math.abs(lo) / 2 || 0.5;
	return {label: one ? one.label : "", unit: one ? one.unit : "", lo: lo - pad, hi: hi + pad, periodic: false, length: 0};
}

// The lengths of the axes in the picture: those of the box if all are positions, else what fills the window.
function setSpace(axes, deep) {
	space.axes = axes;
	const used = axes.slice(0, deep ? 3 : 2), longest = Math.max(...used.map(a => a.length)), shortest = Math.min(...used.map(a => a.length));
	const like = shortest > 0 && longest / shortest <= 8, fill = (plot.x1 - plot.x0) / (plot.y1 - plot.y0);
	space.w = like ? axes.map(a => a.length / longest || 1) : deep ? [1, 1, 1] : [fill, 1, 1];
}

// Range, logarithm and map of the colours, as sdraw chooses them.
function scaleOf(name, one, points) {
	const asked = run.asked, own = chosen("span") === "frame" ? frames[state.frame] : null;
	const [min, max, first] = rangeOf(name, one, own);
	let [lo, hi, least] = asked.range && !own ? [...asked.range, asked.range[0]] : [min, max, first];
	const log = chosen("scale") === "log" && hi > 0, signs = Math.min(-min, max) > 0.01 * Math.max(-min, max) && !log;
	const map = chosen("map") !== "auto" ? chosen("map") : signs ? "coolwarm" : "viridis";
	if (map === "coolwarm" && lo < 0 && hi > 0 && !log)
		[lo, hi] = [-Math.max(-lo, hi), Math.max(-lo, hi)];
	if (log)
		lo = Math.max(least, hi * 1e-4);
	if (!(hi > lo)) {
		const half = Math.abs(lo) / 2 || 0.5;
		[lo, hi] = log ? [hi / 10, hi * 2] : [lo - half, hi + half];
	}
	return {lo, hi, log, map, start: points && map !== "coolwarm" ? 0.25 : 0}; // points must not be as dark as the ground
}

// The particles as they were chosen; as those beside them (withBar false) in one colour, on a mesh at their positions.
function drawParticles(name, ink, withBar) {
	const frame = frames[state.frame], place = placeOf(frame, name), radius = pointRadius(place ? place.kept : 0);
	const onMesh = chosen("show").startsWith("mesh ");
	const keys = (onMesh ? ["x 0", "x 1", "x 2"] : ["across", "up", "depth"].map(chosen)).map(key => choice(name, key));
	const numbers = keys.map(one => {
		const field = one && fieldOf(place, one.field);
		return field ? numbersOf(frame, place, field, one.c) : new Float32Array(place ? place.kept : 0);
	});
	state.drawn = {name, place, numbers, keys};
	if (chosen("trails") && withBar)
		drawTrails(name, keys, ink);
	if (!place || !place.kept || !paint.gl)
		return;
	if (chosen("colour") === "density" && withBar) {
		const wide = 0.6 * Math.min(plot.x1 - plot.x0, plot.y1 - plot.y0) / Math.sqrt(place.kept), spot = Math.min(Math.max(wide, 1.5), 12);
		const scale = {map: chosen("map") === "auto" ? "inferno" : chosen("map"), start: 0.1, log: chosen("scale") !== "linear"};
		const seen = paintDensity(...numbers, scale, spot * 2 ** Number(chosen("size")));
		if (seen)
			inkBar(ink, seen, "particles per pixel");
		return;
	}
	const one = withBar ? choice(name, chosen("colour")) : null, field = one && fieldOf(place, one.field), scale = one && scaleOf(name, one, true);
	paintPoints(...numbers, field ? numbersOf(frame, place, field, one.c) : null, field ? scale : null, radius, withBar ? [1, 0.84, 0.59] : [0.62, 0.8, 1]);
	if (field)
		inkBar(ink, scale, withUnit(one.label, one.unit));
}

// The ways of the particles from frame to frame; of the first thousand, and where their number stays the same. What leaves a periodic side comes in anew.
function drawTrails(name, keys, ink) {
	const last = chosen("trails") === "past" ? state.frame : frames.length - 1, number = i => placeOf(frames[i], name)?.kept ?? 0;
	const places = [];
	for (let i = 0; i <= last; i++) {
		const place = placeOf(frames[i], name);
		places.push(keys.map(one => one && place ? numbersOf(frames[i], place, fieldOf(place, one.field), one.c) : null));
	}
	ink.strokeStyle = "rgba(160, 185, 225, 0.55)";
	inside(ink, plot, () => {
		for (let p = 0; p < Math.min(1000, number(state.frame)); p++) {
			ink.beginPath();
			let before = null;
			places.forEach((xyz, i) => {
				const at = xyz.map(numbers => numbers ? numbers[p] : 0), [x, y] = project(at);
				const jumped = before && at.some((v, d) => space.axes[d].periodic &&
					Math.abs(v - before[d]) > (space.axes[d].hi - space.axes[d].lo) / 2);
				ink[!before || jumped || number(i) !== number(state.frame) ? "moveTo" : "lineTo"](x, y);
				before = at;
			});
			ink.stroke();
		}
	});
}

// As in sdraw: a seventh of the mean distance, within limits; by hand larger or smaller.
function pointRadius(n) {
	const size = Math.min(plot.x1 - plot.x0, plot.y1 - plot.y0);
	return Math.min(Math.max(0.14 * size / Math.sqrt(n + 1), 0.9), 4) * 2 ** Number(chosen("size")) * Math.min(2, Math.max(1, camera.zoom ** 0.3));
}

// A plane of a 3-D mesh between its nodes, or the mesh itself in 2-D: {numbers, n: nodes, corners, axes}. On a periodic axis the first node stands again at
// the end of the box.
function planeOf(place, numbers, offset, frame) {
	const p = place.points, axis = frame.dim < 3 ? 2 : Number(chosen("axis")), axes = [0, 1, 2].filter(d => d !== axis), [a, b] = axes;
	const lo = d => place.lo[d] + offset[d] * place.h[d], at = frame.dim < 3 ? 0 : sliceAt(), stride = [1, p[0], p[0] * p[1]];
	const closes = d => d < frame.dim && frame.box[d].periodic && Math.abs(p[d] * place.h[d] / (frame.box[d].hi - frame.box[d].lo) - 1) < 1e-6;
	const last = closes(axis) ? p[axis] : p[axis] - 1, node = frame.dim < 3 ? 0 : Math.min(Math.max((at - lo(axis)) / place.h[axis], 0), last);
	const k = Math.min(Math.floor(node), Math.max(last - 1, 0)), f = node - k;
	const below = k * stride[axis], above = Math.min(k + 1, last) % p[axis] * stride[axis];
	const n = axes.map(d => p[d] + (closes(d) ? 1 : 0)), out = new Float32Array(n[0] * n[1]);
	for (let j = 0; j < n[1]; j++)
		for (let i = 0; i < n[0]; i++) {
			const one = i % p[a] * stride[a] + j % p[b] * stride[b];
			out[j * n[0] + i] = (1 - f) * numbers[one + below] + f * numbers[one + above];
		}
	const corners = [[0, 0], [1, 0], [0, 1], [1, 1]].map(([i, j]) => {
		const x = [at, at, at];
		x[a] = lo(a) + i * (n[0] - 1) * place.h[a];
		x[b] = lo(b) + j * (n[1] - 1) * place.h[b];
		return x;
	});
	return {numbers: out, n, corners, axes};
}

const sliceAt = () => {
	const a = space.axes[Number(chosen("axis"))];
	return a.lo + Number(chosen("slice")) * (a.hi - a.lo);
};

function drawMesh(name, ink) {
	const frame = frames[state.frame], place = placeOf(frame, name), one = choice(name, chosen("colour")), field = one && fieldOf(place, one.field);
	state.drawn = {name, place, field, one};
	if (!field)
		return;
	const numbers = numbersOf(frame, place, field, one.c), c = Math.max(one.c, 0), offset = field.offset.slice(3 * c, 3 * c + 3);
	if (frame.dim === 1) {
		drawCurve(ink, name, one, place, numbers, offset[0]);
		return;
	}
	const plane = planeOf(place, numbers, one.c < 0 ? [0, 0, 0] : offset, frame), scale = scaleOf(name, one, false);
	state.drawn.plane = plane;
	if (!paint.gl)
		return;
	paintPlane(plane.numbers, plane.n, plane.corners, scale);
	inkBar(ink, scale, withUnit(one.label, one.unit));
}

// A field of a 1-D mesh against x.
function drawCurve(ink, name, one, place, numbers, offset) {
	const scale = scaleOf(name, one, false), log = scale.log, wide = 0.05 * (scale.hi - scale.lo), a = space.axes[0];
	const own = chosen("span") === "frame" ? frames[state.frame] : null, [lo, hi] = run.asked.range && !own ? run.asked.range : rangeOf(name, one, own);
	const pad = hi > lo ? 0.05 * (hi - lo) : wide, y = log ? {lo: scale.lo / 1.2, hi: scale.hi * 1.2, log} : {lo: lo - pad, hi: hi + pad};
	y.name = withUnit(one.label, one.unit);
	const view = {lo: unproject(0, plot.x0, 0), hi: unproject(0, plot.x1, 0), name: withUnit("x", a.unit)};
	const [across, upwards] = inkFrame(ink, plot, view, y), n = numbers.length + (a.periodic ? 1 : 0);
	state.drawn.curve = {numbers, at: i => place.lo[0] + (i + offset) * place.h[0], across};
	ink.strokeStyle = themed("accent");
	ink.lineWidth = 1.8;
	inside(ink, plot, () => {
		ink.beginPath();
		for (let i = 0; i < n; i++) {
			const v = numbers[i % numbers.length];
			ink[i ? "lineTo" : "moveTo"](across(place.lo[0] + (i + offset) * place.h[0]), upwards(log ? Math.max(v, y.lo) : v));
		}
		ink.stroke();
	});
	ink.lineWidth = 1;
}

// Everything on the page that depends on the frame or on a choice.
function draw() {
	const name = chosen("show"), onMesh = name.startsWith("mesh "), ink = fresh(document.getElementById("ink")), frame = frames[state.frame];
	layOut(ink.canvas, onMesh && frame.dim === 1);
	const curve = onMesh && frame.dim === 1, axes = axesShown(name, onMesh);
	setSpace(axes, camera.deep);
	if (paint.gl) {
		const canvas = paint.gl.canvas, pixel = window.devicePixelRatio || 1;
		[canvas.width, canvas.height] = [Math.max(1, Math.round(canvas.clientWidth * pixel)), Math.max(1, Math.round(canvas.clientHeight * pixel))];
		paintGround(curve ? rgbOf(themed("paper")) : rgbOf(themed("ground")));
	}
	if (onMesh) {
		drawMesh(name, ink);
		if (chosen("overlay") && frame.dim > 1) {
			const mesh = state.drawn;
			drawParticles(chosen("overlay"), ink, false);
			state.drawn = {...mesh, over: state.drawn};
		}
	} else {
		drawParticles(name, ink, true);
		const own = state.drawn;
		if (chosen("overlay") && chosen("overlay") !== name)
			drawParticles(chosen("overlay"), ink, false);
		state.drawn = {...own, over: state.drawn === own ? null : state.drawn};
	}
	const flat = flatAxes();
	if (!curve && flat) {
		inkFlatBox(ink, flat);
		const [a, b] = flat, along = (d, k) => ({lo: unproject(d, k ? plot.y1 : plot.x0, k), hi: unproject(d, k ? plot.y0 : plot.x1, k),
			name: withUnit(axes[d].label, axes[d].unit)});
		inkFrame(ink, plot, along(a, 0), along(b, 1));
	} else if (!curve)
		inkDeepBox(ink);
	document.getElementById("when").textContent = `t = ${written(frame.time)}   step ${frame.step}   frame ${state.frame + 1} of ${frames.length}`;
	drawCurves();
}

function axesShown(name, onMesh) {
	if (!onMesh)
		return ["across", "up", "depth"].map(id => axisOf(name, choice(name, chosen(id))));
	const unit = frames[0].sets.map(set => fieldOf(set, "x")?.unit).find(u => u) ?? "";
	const none = {label: "", unit: "", lo: -0.5, hi: 0.5, length: 0};
	return [0, 1, 2].map(c => c < frames[0].dim ? axisOf(name, {field: "x", c, unit, label: "xyz"[c]}) : none);
}

function rgbOf(colour) {
	return [1, 3, 5].map(i => parseInt(colour.slice(i, i + 2), 16) / 255);
}

// The area of the data, with room for axes and for the bar.
function layOut(canvas, curve) {
	const width = canvas.clientWidth, height = canvas.clientHeight, deep = !flatAxes() && !curve;
	const bar = !curve && (chosen("show").startsWith("mesh ") || chosen("colour") !== "");
	Object.assign(plot, {x0: deep ? 8 : 72, y0: 8, x1: Math.max(width - (bar ? 104 : 14), 120), y1: Math.max(height - (deep ? 8 : 46), 100)});
}
