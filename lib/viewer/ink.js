// Axes, the box, the bar of colours and curves of 1-D meshes, on a canvas over the picture. SPDX-License-Identifier: GPL-3.0-or-later

// A canvas of the size that it has on the page, cleared; draws in CSS pixels.
function fresh(canvas) {
	const pixel = window.devicePixelRatio || 1, whole = length => Math.max(1, Math.round(length * pixel));
	const width = whole(canvas.clientWidth), height = whole(canvas.clientHeight);
	if (canvas.width !== width || canvas.height !== height)
		[canvas.width, canvas.height] = [width, height];
	const to = canvas.getContext("2d");
	to.setTransform(width / canvas.clientWidth, 0, 0, height / canvas.clientHeight, 0, 0);
	to.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
	to.font = "12px " + getComputedStyle(document.body).fontFamily;
	to.lineWidth = 1;
	return to;
}

const themed = name => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();

function line(to, x0, y0, x1, y1) {
	to.beginPath();
	to.moveTo(x0, y0);
	to.lineTo(x1, y1);
	to.stroke();
}

function label(to, text, x, y, across, up, turned) {
	to.save();
	to.translate(x, y);
	if (turned)
		to.rotate(-Math.PI / 2);
	to.textAlign = across;
	to.textBaseline = up;
	to.fillText(text, 0, 0);
	to.restore();
}

// Ticks and names left of and below the area `r`; x and y: {lo, hi, name, log}. Returns a function number -> screen for each axis.
function inkFrame(to, r, x, y) {
	const place = (a, p0, p1) => v => a.log ? p0 + Math.log(v / a.lo) / Math.log(a.hi / a.lo) * (p1 - p0) : p0 + (v - a.lo) / (a.hi - a.lo) * (p1 - p0);
	const across = place(x, r.x0, r.x1), upwards = place(y, r.y1, r.y0);
	const ticks = (a, most) => a.log ? logTicksOf(a.lo, a.hi, most) : ticksOf(a.lo, a.hi, most);
	to.strokeStyle = themed("faint");
	to.fillStyle = themed("ink");
	to.strokeRect(r.x0 - 0.5, r.y0 - 0.5, r.x1 - r.x0 + 1, r.y1 - r.y0 + 1);
	let free = -Infinity, wide = 0;
	for (const tick of ticks(x, (r.x1 - r.x0) / 75)) {
		const at = across(tick.at), half = to.measureText(tick.text).width / 2;
		line(to, at, r.y1, at, r.y1 + 5);
		if (at - half > free)
			label(to, tick.text, at, r.y1 + 7, "center", "top");
		free = Math.max(free, at + half + 6);
	}
	for (const tick of ticks(y, (r.y1 - r.y0) / 45)) {
		const at = upwards(tick.at);
		line(to, r.x0, at, r.x0 - 5, at);
		label(to, tick.text, r.x0 - 8, at, "right", "middle");
		wide = Math.max(wide, to.measureText(tick.text).width);
	}
	if (x.name)
		label(to, x.name, (r.x0 + r.x1) / 2, r.y1 + 24, "center", "top");
	if (y.name)
		label(to, y.name, Math.max(2, r.x0 - 24 - wide), (r.y0 + r.y1) / 2, "center", "top", true);
	return [across, upwards];
}

function inside(to, r, draw) {
	to.save();
	to.beginPath();
	to.rect(r.x0, r.y0, r.x1 - r.x0, r.y1 - r.y0);
	to.clip();
	draw();
	to.restore();
}

// The outline of the box as it is seen face on, dashed where it is periodic.
function inkFlatBox(to, [a, b]) {
	const corner = (p, q) => project([0, 1, 2].map(d => d === a ? space.axes[a][p] : d === b ? space.axes[b][q] : space.axes[d].lo));
	inside(to, plot, () => {
		const sides = [[b, "lo lo", "hi lo"], [b, "lo hi", "hi hi"], [a, "lo lo", "lo hi"], [a, "hi lo", "hi hi"]];
		for (const [d, p, q] of sides) {
			const [x0, y0] = corner(...p.split(" ")), [x1, y1] = corner(...q.split(" "));
			to.strokeStyle = "rgba(200, 208, 224, 0.55)";
			to.setLineDash(space.axes[d].periodic ? [5, 4] : []);
			line(to, x0, y0, x1, y1);
		}
		to.setLineDash([]);
	});
}

// The box askew: twelve edges, those behind fainter, ticks along the outermost edge of each direction.
function inkDeepBox(to) {
	const end = (d, e) => space.axes[d][e ? "hi" : "lo"];
	inside(to, plot, () => {
		for (let d = 0; d < 3; d++) {
			const [p, q] = [(d + 1) % 3, (d + 2) % 3];
			let best = null;
			for (const [e, g] of [[0, 0], [0, 1], [1, 0], [1, 1]]) {
				const at = t => project([0, 1, 2].map(k => k === d ? t : k === p ? end(p, e) : end(q, g)));
				const a = at(end(d, 0)), b = at(end(d, 1)), near = a[2] + b[2] > 0;
				to.strokeStyle = near ? "rgba(200, 208, 224, 0.6)" : "rgba(200, 208, 224, 0.25)";
				to.setLineDash(space.axes[p].periodic || space.axes[q].periodic ? [5, 4] : []);
				line(to, a[0], a[1], b[0], b[1]);
				const out = outward(a, b), far = out && out[2] + (near ? 0.01 : 0);
				if (out && (!best || far > best.far))
					best = {a, b, out, far, at};
			}
			to.setLineDash([]);
			if (best)
				inkEdge(to, space.axes[d], best);
		}
	});
}

// The direction on the screen away from the middle of the box, and how far out the edge is; null where the edge points at us. Lower edges are preferred.
function outward(a, b) {
	const dx = b[0] - a[0], dy = b[1] - a[1], length = Math.hypot(dx, dy), [cx, cy] = projectUnit([0, 0, 0]);
	if (length < 30)
		return null;
	let nx = -dy / length, ny = dx / length, away = nx * ((a[0] + b[0]) / 2 - cx) + ny * ((a[1] + b[1]) / 2 - cy);
	if (away < 0)
		[nx, ny, away] = [-nx, -ny, -away];
	return [nx, ny, away + (ny > 0.1 || (Math.abs(ny) <= 0.1 && nx < 0) ? 20 : 0)];
}

function inkEdge(to, axis, {a, b, out, at}) {
	const [nx, ny] = out, across = nx > 0.4 ? "left" : nx < -0.4 ? "right" : "center", up = ny > 0.4 ? "top" : ny < -0.4 ? "bottom" : "middle";
	to.strokeStyle = to.fillStyle = "#c8d0e0";
	let wide = 0;
	for (const tick of ticksOf(axis.lo, axis.hi, Math.hypot(b[0] - a[0], b[1] - a[1]) / 60)) {
		const [x, y] = at(tick.at);
		line(to, x, y, x + 5 * nx, y + 5 * ny);
		label(to, tick.text, x + 8 * nx, y + 8 * ny, across, up);
		wide = Math.max(wide, to.measureText(tick.text).width);
	}
	const off = 14 + (Math.abs(nx) > 0.4 ? wide : 0) + (Math.abs(ny) > 0.4 ? 14 : 6);
	to.fillStyle = "#ffffff";
	const name = withUnit(axis.label, axis.unit), half = to.measureText(name).width * (across === "center" ? 0.5 : 1), x = (a[0] + b[0]) / 2 + off * nx;
	const low = plot.x0 + 4 + (across === "left" ? 0 : half), high = plot.x1 - 4 - (across === "right" ? 0 : half);
	if (!inPlot((a[0] + b[0]) / 2, (a[1] + b[1]) / 2))
		return;
	if (x >= low - 4 && x <= high + 4)
		label(to, name, Math.min(Math.max(x, low), high), (a[1] + b[1]) / 2 + off * ny, across, up);
	else // no room beside the ticks: above the upper end
		label(to, name, Math.min(Math.max(a[1] < b[1] ? a[0] : b[0], plot.x0 + 4 + half / 2), plot.x1 - 4 - half / 2), Math.min(a[1], b[1]) - 8,
			"center", "bottom");
}

// The colours and their numbers, right of the area of the data.
function inkBar(to, scale, name) {
	const r = {x0: plot.x1 + 14, y0: plot.y0 + 10, x1: plot.x1 + 30, y1: plot.y1 - 10}, bytes = mapBytes(scale.map);
	for (let y = 0; y < r.y1 - r.y0; y++) {
		const t = scale.start + (1 - scale.start) * (1 - y / (r.y1 - r.y0)), i = Math.min(255, Math.round(255 * t));
		to.fillStyle = `rgb(${bytes[3 * i]}, ${bytes[3 * i + 1]}, ${bytes[3 * i + 2]})`;
		to.fillRect(r.x0, r.y0 + y, r.x1 - r.x0, 1.5);
	}
	to.strokeStyle = themed("faint");
	to.strokeRect(r.x0 - 0.5, r.y0 - 0.5, r.x1 - r.x0 + 1, r.y1 - r.y0 + 1);
	to.fillStyle = themed("ink");
	const span = r.y1 - r.y0;
	let wide = 0;
	for (const tick of scale.log ? logTicksOf(scale.lo, scale.hi, span / 40) : ticksOf(scale.lo, scale.hi, span / 40)) {
		const t = scale.log ? Math.log(tick.at / scale.lo) / Math.log(scale.hi / scale.lo) : (tick.at - scale.lo) / (scale.hi - scale.lo);
		line(to, r.x1, r.y1 - t * span, r.x1 + 4, r.y1 - t * span);
		label(to, tick.text, r.x1 + 6, r.y1 - t * span, "left", "middle");
		wide = Math.max(wide, to.measureText(tick.text).width);
	}
	label(to, name, Math.min(r.x1 + wide + 26, to.canvas.clientWidth - 4), (r.y0 + r.y1) / 2, "center", "bottom", true);
}
