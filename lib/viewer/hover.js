// What stands under the mouse, in words. SPDX-License-Identifier: GPL-3.0-or-later

const inPlot = (x, y) => x >= plot.x0 && x <= plot.x1 && y >= plot.y0 && y <= plot.y1;

// The particle next to (x, y) on the screen, within 10 pixels; of those within 3 pixels the nearest to us. -1: none.
function particleAt({numbers}, x, y) {
	const n = numbers[0].length, m = camera.turn, s = unitPixels() * camera.zoom, [cx, cy] = projectUnit([0, 0, 0]);
	const slope = space.axes.map((a, d) => space.w[d] / (a.hi - a.lo)), base = space.axes.map((a, d) => -a.lo * slope[d] - space.w[d] / 2);
	let best = -1, least = Infinity;
	for (let i = 0; i < n; i++) {
		const u = numbers[0][i] * slope[0] + base[0], v = numbers[1][i] * slope[1] + base[1], w = numbers[2][i] * slope[2] + base[2];
		const dx = cx + s * (m[0] * u + m[1] * v + m[2] * w) - x, dy = cy - s * (m[3] * u + m[4] * v + m[5] * w) - y, far = dx * dx + dy * dy;
		if (far > 100)
			continue;
		const rank = far < 9 ? -1e3 - (m[6] * u + m[7] * v + m[8] * w) : far;
		if (rank < least)
			[least, best] = [rank, i];
	}
	return best;
}

function tellParticle(drawn, i) {
	const frame = frames[state.frame], {place, name} = drawn, lines = [`${place.name}, particle ${i}`];
	for (const one of choicesCache(name)) {
		const field = fieldOf(place, one.field);
		if (field && lines.length < 22)
			lines.push(`${one.label} = ${written(numbersOf(frame, place, field, one.c)[i])}${one.unit ? " " + one.unit : ""}`);
	}
	return lines.join("\n");
}

// The value of the plane, linear between its nodes as it is drawn.
function tellPlane({plane, one}, x, y) {
	const flat = flatAxes(), frame = frames[state.frame];
	if (!flat || !plane.axes.includes(flat[0]) || !plane.axes.includes(flat[1]))
		return "";
	const at = [0, 1, 2].map(d => d === flat[0] ? unproject(d, x, 0) : d === flat[1] ? unproject(d, y, 1) : plane.corners[0][d]);
	const p = plane.axes.map((d, k) => (at[d] - plane.corners[0][d]) / (plane.corners[k + 1][d] - plane.corners[0][d]) * (plane.n[k] - 1));
	if (p.some((v, k) => !(v >= 0 && v <= plane.n[k] - 1)))
		return "";
	const i = Math.min(Math.floor(p[0]), plane.n[0] - 2), j = Math.min(Math.floor(p[1]), plane.n[1] - 2), [f, g] = [p[0] - i, p[1] - j];
	const node = (k, l) => plane.numbers[(j + l) * plane.n[0] + i + k];
	const value = (1 - g) * ((1 - f) * node(0, 0) + f * node(1, 0)) + g * ((1 - f) * node(0, 1) + f * node(1, 1));
	return [...at.slice(0, frame.dim).map((v, d) => `${"xyz"[d]} = ${written(v)}`),
		`${one.label} = ${written(value)}${one.unit ? " " + one.unit : ""}`].join("\n");
}

function tellCurve({curve, one}, x) {
	let best = 0;
	curve.numbers.forEach((_, i) => {
		if (Math.abs(curve.across(curve.at(i)) - x) < Math.abs(curve.across(curve.at(best)) - x))
			best = i;
	});
	return `x = ${written(curve.at(best))}\n${one.label} = ${written(curve.numbers[best])}${one.unit ? " " + one.unit : ""}`;
}

function textAt(x, y) {
	const drawn = state.drawn;
	if (!drawn || !inPlot(x, y))
		return "";
	for (const particles of [drawn.numbers && drawn, drawn.over]) {
		const i = particles && particles.place ? particleAt(particles, x, y) : -1;
		if (i >= 0)
			return tellParticle(particles, i);
	}
	return drawn.plane ? tellPlane(drawn, x, y) : drawn.curve ? tellCurve(drawn, x) : "";
}

let resting = 0;

// At once, or where there are many particles to search (a million take 0.1 s) when the mouse rests.
function hover(x, y) {
	const n = state.drawn?.numbers?.[0].length ?? 0;
	clearTimeout(resting);
	byId("tip").hidden = byId("tip").hidden || n > 1e5;
	if (n > 1e5)
		resting = setTimeout(tell, 150, x, y);
	else
		tell(x, y);
}

function tell(x, y) {
	const tip = document.getElementById("tip"), view = document.getElementById("view"), text = textAt(x, y);
	tip.hidden = !text;
	tip.textContent = text;
	tip.style.left = `${Math.max(0, x + 16 + tip.offsetWidth > view.clientWidth ? x - tip.offsetWidth - 10 : x + 16)}px`;
	tip.style.top = `${Math.max(0, Math.min(y + 12, view.clientHeight - tip.offsetHeight - 4))}px`;
}
