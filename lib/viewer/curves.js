// The second panel: what diag measures, against time; a line marks the frame that is shown, and a click chooses one. SPDX-License-Identifier: GPL-3.0-or-later

const panel = {groups: [], r: null, lo: 0, hi: 1};
const shades = ["#2a78c4", "#d9622b", "#3c9a55", "#9457b5", "#b8902a", "#d04a7a"];

// Columns that belong together are drawn together: the components of a vector, the energies.
function groupCurves() {
	const column = name => curves.rows.map(row => row[curves.columns.indexOf(name)]), groups = new Map();
	for (const name of curves.columns) {
		if (name === "time" || name === "step")
			continue;
		const group = name.startsWith("energy") ? "energy" : name.startsWith("strength_") ? "strength" : name.replace(/_[xyz]$/, "");
		groups.set(group, [...groups.get(group) ?? [], {name, y: column(name)}]);
	}
	const energy = groups.get("energy")?.find(one => one.name === "energy");
	if (energy && energy.y[0])
		groups.set("energy error (E - E0)/|E0|", [{name: "(E - E0)/|E0|",
			y: energy.y.map(e => e === null ? null : (e - energy.y[0]) / Math.abs(energy.y[0]))}]);
	panel.time = column("time");
	panel.groups = [...groups].map(([name, lines]) => ({name, lines}));
	const list = document.getElementById("curve");
	for (const {name} of panel.groups)
		list.add(new Option(name, name));
	const varies = ({lines}) => lines.some(({y}) => y.some(v => v !== null && Math.abs(v - y[0]) > 1e-9 * Math.abs(y[0])));
	list.value = (panel.groups.find(({name}) => name === "energy") ?? panel.groups.find(varies) ?? panel.groups[0])?.name;
	document.getElementById("panel").hidden = panel.groups.length === 0;
	if (curves.rows.length === 1)
		listValues();
}

// Of a single frame the numbers, not curves.
function listValues() {
	const table = document.getElementById("values");
	for (const [i, name] of curves.columns.entries()) {
		const row = table.insertRow();
		row.insertCell().textContent = name;
		row.insertCell().textContent = written(curves.rows[0][i]);
	}
	table.hidden = false;
	for (const element of document.querySelectorAll("#panel > :not(table)"))
		element.hidden = true;
}

function positive(lines) {
	return lines.flatMap(({y}) => y).filter(v => v !== null && v !== 0).map(Math.abs);
}

// What is drawn, and the range of its numbers.
function curveRange(lines, log) {
	const values = log ? positive(lines) : lines.flatMap(({y}) => y).filter(v => v !== null);
	let lo = values.reduce((a, b) => Math.min(a, b), Infinity), hi = values.reduce((a, b) => Math.max(a, b), -Infinity);
	if (!(lo <= hi))
		return log ? [0.1, 1] : [0, 1];
	if (log)
		return lo < hi ? [Math.max(lo, hi * 1e-16) / 1.3, hi * 1.3] : [lo / 10, hi * 10];
	const size = Math.max(Math.abs(lo), Math.abs(hi)), pad = hi - lo > 1e-13 * size ? 0.06 * (hi - lo) : 0.1 * size || 0.5; // rounding is not a signal
	return [lo - pad, hi + pad];
}

function drawCurves() {
	const canvas = document.getElementById("curves-ink"), group = panel.groups.find(({name}) => name === document.getElementById("curve").value);
	if (!group || canvas.clientWidth < 60 || canvas.clientHeight < 60)
		return;
	const to = fresh(canvas), log = document.getElementById("curve-scale").value === "log", [lo, hi] = curveRange(group.lines, log);
	const shift = hi - lo < 1e-4 * Math.max(Math.abs(lo), Math.abs(hi)) && !log ? Number(((lo + hi) / 2).toPrecision(6)) : 0;
	const y = {lo: lo - shift, hi: hi - shift, log}, t = panel.time, pad = t[t.length - 1] > t[0] ? 0 : 0.5;
	const texts = (log ? logTicksOf(lo, hi, 5) : ticksOf(y.lo, y.hi, 5)).map(tick => to.measureText(tick.text).width);
	const r = {x0: 14 + Math.max(20, ...texts), y0: 8 + 15 * group.lines.length, x1: canvas.clientWidth - 16, y1: canvas.clientHeight - 42};
	const [across, upwards] = inkFrame(to, r, {lo: t[0] - pad, hi: t[t.length - 1] + pad, name: "time"}, y);
	inside(to, r, () => group.lines.forEach((one, k) => {
		to.strokeStyle = to.fillStyle = shades[k % shades.length];
		to.lineWidth = 1.6;
		to.beginPath();
		let drawn = false;
		one.y.forEach((v, i) => {
			if (v === null || (log && v === 0)) {
				drawn = false;
				return;
			}
			const at = [across(t[i]), upwards(log ? Math.abs(v) : v - shift)];
			drawn ? to.lineTo(...at) : to.moveTo(...at);
			drawn = true;
			if (t.length === 1)
				to.fillRect(at[0] - 3, at[1] - 3, 6, 6);
		});
		to.stroke();
	}));
	to.lineWidth = 1;
	to.strokeStyle = themed("mark");
	line(to, across(frames[state.frame].time), r.y0, across(frames[state.frame].time), r.y1);
	inkLegend(to, group.lines, r, log, shift);
	Object.assign(panel, {r, lo: t[0] - pad, hi: t[t.length - 1] + pad});
}

// Names, and the numbers of the frame that is shown.
function inkLegend(to, lines, r, log, shift) {
	const i = panel.time.findIndex(t => t >= frames[state.frame].time - 1e-12 * Math.abs(frames[state.frame].time));
	lines.forEach((one, k) => {
		const x = 4, y = 4 + 15 * k, value = one.y[i];
		to.fillStyle = shades[k % shades.length];
		to.fillRect(x, y + 4, 10, 3);
		to.fillStyle = themed("ink");
		to.save();
		to.font = "11px " + getComputedStyle(document.body).fontFamily;
		const name = log && lines.some(l => l.y.some(v => v < 0)) ? `|${one.name}|` : one.name;
		label(to, `${name} ${value === undefined ? "" : written(value)}`, x + 14, y, "left", "top");
		to.restore();
	});
	if (shift)
		label(to, `${shift > 0 ? "+" : ""}${written(shift)}`, r.x0 + 4, r.y0 + 3, "left", "top");
}

// The frame whose time is nearest to where the panel was clicked.
function frameAt(x) {
	const time = panel.lo + (x - panel.r.x0) / (panel.r.x1 - panel.r.x0) * (panel.hi - panel.lo);
	return frames.reduce((best, frame, i) => Math.abs(frame.time - time) < Math.abs(frames[best].time - time) ? i : best, 0);
}
