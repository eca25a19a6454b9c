// From the numbers of three axes to the screen: each axis runs over [-w/2, w/2], is turned by the matrix `turn`, seen along the third (no perspective, so that
// lengths can be compared), enlarged and moved. SPDX-License-Identifier: GPL-3.0-or-later

const camera = {turn: [1, 0, 0, 0, 1, 0, 0, 0, 1], zoom: 1, pan: [0, 0], deep: false};
const space = {axes: [], w: [1, 1, 1]}; // axes: {label, unit, lo, hi}; w: their lengths in the picture
const plot = {x0: 0, y0: 0, x1: 1, y1: 1}; // the area of the data on the screen [CSS pixels]

// Right and up on the screen are these axes.
function faceOn(right, up) {
	const rows = [[0, 0, 0], [0, 0, 0]];
	rows[0][right] = rows[1][up] = 1;
	const [a, b] = rows;
	camera.turn = [...a, ...b, a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function turned(yaw, pitch) { // [radian]; z points upwards
	const [c, s, k, l] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
	camera.turn = [c, s, 0, -s * l, c * l, k, s * k, -c * k, l];
}

// Turns by a mouse that moved (dx, dy) pixels: about the axes of the screen.
function rotate(dx, dy) {
	const a = dx * 0.008, b = dy * 0.008, m = camera.turn;
	const [c, s, k, l] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
	const about = (p, q, u, v) => { // rows p and q of the matrix
		for (let i = 0; i < 3; i++)
			[m[3 * p + i], m[3 * q + i]] = [u * m[3 * p + i] + v * m[3 * q + i], u * m[3 * q + i] - v * m[3 * p + i]];
	};
	about(0, 2, c, s);
	about(1, 2, k, -l);
}

// The axes that point right and up if one looks along the third; null where the box is seen askew.
function flatAxes() {
	const m = camera.turn, right = [0, 1, 2].find(i => m[i] > 0.99999), up = [0, 1, 2].find(i => m[3 + i] > 0.99999);
	return right === undefined || up === undefined ? null : [right, up];
}

// Pixels per unit of w at zoom 1: what is seen just fits.
function unitPixels() {
	const width = plot.x1 - plot.x0, height = plot.y1 - plot.y0, flat = flatAxes();
	if (flat)
		return Math.min(width / space.w[flat[0]], height / space.w[flat[1]]);
	return 0.95 * Math.min(width, height) / Math.hypot(...space.w);
}

// Numbers on the three axes -> [x, y, nearness] on the screen.
function project(x) {
	const u = x.map((value, d) => ((value - space.axes[d].lo) / (space.axes[d].hi - space.axes[d].lo) - 0.5) * space.w[d]);
	return projectUnit(u);
}

function projectUnit(u) {
	const m = camera.turn, s = unitPixels() * camera.zoom;
	const row = k => m[3 * k] * u[0] + m[3 * k + 1] * u[1] + m[3 * k + 2] * u[2];
	return [(plot.x0 + plot.x1) / 2 + camera.pan[0] + s * row(0), (plot.y0 + plot.y1) / 2 + camera.pan[1] - s * row(1), row(2)];
}

// The number on axis d at screen coordinate `at` (x if along = 0, y if 1), looking along the third axis.
function unproject(d, at, along) {
	const s = unitPixels() * camera.zoom, a = space.axes[d];
	const u = along ? ((plot.y0 + plot.y1) / 2 + camera.pan[1] - at) / s : (at - (plot.x0 + plot.x1) / 2 - camera.pan[0]) / s;
	return a.lo + (u / space.w[d] + 0.5) * (a.hi - a.lo);
}

// Enlarges about a point of the screen.
function zoomAbout(factor, x, y) {
	const before = camera.zoom;
	camera.zoom = Math.min(Math.max(camera.zoom * factor, 0.05), 1e4);
	const f = camera.zoom / before, cx = (plot.x0 + plot.x1) / 2, cy = (plot.y0 + plot.y1) / 2;
	camera.pan = [x - cx - f * (x - cx - camera.pan[0]), y - cy - f * (y - cy - camera.pan[1])];
}
