// Menus, sliders, mouse, fingers and keys. SPDX-License-Identifier: GPL-3.0-or-later

const byId = id => document.getElementById(id);
let waiting = false;

// Draws once before the next picture of the screen, however often it is asked for.
function redraw() {
	if (!waiting)
		requestAnimationFrame(() => {
			waiting = false;
			draw();
		});
	waiting = true;
}

function goTo(frame) {
	state.frame = Math.min(Math.max(frame, 0), frames.length - 1);
	byId("time").value = state.frame;
	byId("tip").hidden = true;
	redraw();
}

function fill(id, options, value) {
	const list = byId(id);
	list.replaceChildren(...options.map(([key, text]) => new Option(text, key)));
	if (options.some(([key]) => key === value))
		list.value = value;
}

// The menus that depend on what is shown.
function offer() {
	const name = chosen("show"), onMesh = name.startsWith("mesh "), all = choicesCache(name), dim = frames[0].dim, asked = run.asked;
	const labels = all.map(one => [one.key, one.label]), position = all.filter(one => one.field === "x" && one.c < dim);
	const first = all.find(one => one.field === asked.field && one.c === componentAsked(one, asked.component)) ??
		all.find(one => one.field === asked.colour);
	for (const [kind, there] of [["particles", !onMesh], ["slice", onMesh && dim === 3],
		["beside", onMesh ? dim > 1 && setNames().length : setNames().length > 1]])
		for (const element of document.querySelectorAll("." + kind))
			element.hidden = !there;
	fill("overlay", [["", "none"], ...setNames().map(set => ["set " + set, set]).filter(([key]) => key !== name)], onMesh ? "" : otherSet(name));
	if (onMesh) {
		fill("colour", labels, first?.key ?? all.at(-1)?.key);
	} else {
		const most = Math.max(...frames.map(f => placeOf(f, name)?.kept ?? 0)), dense = paint.density ? [["density", "density"]] : [];
		fill("colour", [["", "one colour"], ...dense, ...labels], first?.key ?? (most >= many && dense.length ? "density" : ""));
		const velocity = all.find(one => one.field === "v" && one.c <= 0), find = text => all.find(one => one.field === text)?.key;
		const deep = position[2] && rangeOf(name, position[2], null), flat = asked.x || asked.y || dim < 3 || !(deep[1] > deep[0]);
		fill("across", labels, find(asked.x) ?? position[0]?.key);
		const upwards = dim > 1 ? position[1] : all.find(one => one.field === "v" && one.c === 0) ?? velocity ?? position[0];
		fill("up", labels, find(asked.y) ?? upwards?.key);
		byId("trails").value = most <= 20 && frames.length > 1 ? "past" : "";
		fill("depth", [["", "none"], ...labels], flat ? "" : position[2]?.key);
	}
	firstView();
}

// Few bodies beside those that are shown are shown too.
function otherSet(name) {
	const few = place => place.kept <= 20 && "set " + place.name !== name;
	return frames[0].sets.filter(few).map(place => "set " + place.name)[0] ?? "";
}

function componentAsked(one, text) {
	if (text === null)
		return choicesCache(chosen("show")).filter(other => other.field === one.field).some(other => other.c < 0) ? -1 : 0;
	return "xyz".includes(text) ? "xyz".indexOf(text) : Number(text);
}

const setNames = () => [...new Set(frames.flatMap(f => f.sets.map(set => set.name)))];
const meshNames = () => [...new Set(frames.flatMap(f => f.meshes.filter(mesh => mesh.fields.length).map(mesh => mesh.name)))];

// Askew where there are three axes of particles, else face on.
function firstView() {
	const onMesh = chosen("show").startsWith("mesh ");
	camera.deep = onMesh ? frames[0].dim === 3 : chosen("depth") !== "";
	camera.zoom = 1;
	camera.pan = [0, 0];
	if (camera.deep && !onMesh)
		turned(0.5, 0.45);
	else if (onMesh && frames[0].dim === 3)
		lookAlong(Number(chosen("axis")));
	else
		faceOn(0, 1);
	redraw();
}

function lookAlong(axis) {
	camera.pan = [0, 0];
	faceOn(...[[1, 2], [0, 2], [0, 1]][axis]);
	redraw();
}

function choose(id, value) {
	byId(id).value = value;
	byId(id).dispatchEvent(new Event("change"));
}

function next(id, by = 1) {
	const list = byId(id);
	choose(id, list.options[(list.selectedIndex + by + list.length) % list.length].value);
}

function play(on) {
	state.playing = on && frames.length > 1;
	byId("play").textContent = state.playing ? "pause" : "play";
	let last = performance.now();
	const tick = now => {
		if (!state.playing)
			return;
		if (now - last >= 1000 / Math.max(Number(chosen("fps")) || 1, 0.1)) {
			last = now;
			goTo((state.frame + 1) % frames.length);
		}
		requestAnimationFrame(tick);
	};
	if (state.playing)
		requestAnimationFrame(tick);
}

function theme(dark) {
	document.documentElement.classList.toggle("dark", dark);
	redraw();
}

function slide(by) {
	if (chosen("show").startsWith("mesh "))
		byId("slice").value = Number(chosen("slice")) + by * 0.01;
	else
		byId("size").value = Number(chosen("size")) + by * 0.25;
	tellSlice();
	redraw();
}

function tellSlice() {
	const a = space.axes[Number(chosen("axis"))];
	byId("slice-at").textContent = a ? `${a.label} = ${written(sliceAt())}` : "";
}

const keys = {
	" ": () => play(!state.playing), ArrowLeft: () => goTo(state.frame - 1), ArrowRight: () => goTo(state.frame + 1), Home: () => goTo(0),
	End: () => goTo(frames.length - 1), c: () => next("colour"), C: () => next("colour", -1), m: () => next("map"),
	l: () => choose("scale", chosen("scale") === "log" ? "linear" : "log"),
	r: firstView, t: () => theme(!document.documentElement.classList.contains("dark")), "[": () => slide(-1), "]": () => slide(1),
	"+": () => zoomBy(1.25), "=": () => zoomBy(1.25), "-": () => zoomBy(0.8), "?": () => byId("help").showModal(),
	x: () => camera.deep && lookAlong(0), y: () => camera.deep && lookAlong(1), z: () => camera.deep && lookAlong(2),
};

function zoomBy(factor, x = (plot.x0 + plot.x1) / 2, y = (plot.y0 + plot.y1) / 2) {
	zoomAbout(factor, x, y);
	redraw();
}

function listenKeys() {
	document.addEventListener("keydown", event => {
		const act = keys[event.key], typing = /^(INPUT|SELECT|BUTTON|SUMMARY)$/.test(event.target.tagName);
		if (!act || event.ctrlKey || event.metaKey || event.altKey || byId("help").open || (typing && !/^[a-z?]$/i.test(event.key)) ||
			(event.target.tagName === "SELECT"))
			return;
		event.preventDefault();
		act();
	});
}

// One finger or button turns or moves; two fingers, shift or another button move; two fingers zoom too.
function listenPointers() {
	const view = byId("view"), fingers = new Map();
	const at = event => [event.clientX - view.getBoundingClientRect().left, event.clientY - view.getBoundingClientRect().top];
	view.addEventListener("pointerdown", event => {
		view.setPointerCapture(event.pointerId);
		fingers.set(event.pointerId, at(event));
		byId("tip").hidden = true;
	});
	view.addEventListener("pointermove", event => {
		const now = at(event), before = fingers.get(event.pointerId);
		if (!before) {
			hover(...now);
			return;
		}
		const [dx, dy] = [now[0] - before[0], now[1] - before[1]], other = [...fingers].find(([id]) => id !== event.pointerId);
		fingers.set(event.pointerId, now);
		if (other) {
			const far = p => Math.hypot(p[0] - other[1][0], p[1] - other[1][1]);
			camera.pan = [camera.pan[0] + dx / 2, camera.pan[1] + dy / 2];
			zoomAbout(far(now) / Math.max(far(before), 1), (now[0] + other[1][0]) / 2, (now[1] + other[1][1]) / 2);
		} else if (camera.deep && !event.shiftKey && event.buttons === 1)
			rotate(dx, dy);
		else
			camera.pan = [camera.pan[0] + dx, camera.pan[1] + dy];
		redraw();
	});
	for (const end of ["pointerup", "pointercancel"])
		view.addEventListener(end, event => fingers.delete(event.pointerId));
	view.addEventListener("pointerleave", () => byId("tip").hidden = true);
	view.addEventListener("contextmenu", event => event.preventDefault());
	view.addEventListener("wheel", event => {
		event.preventDefault();
		zoomBy(Math.exp(-Math.min(Math.max(event.deltaY, -200), 200) * 0.002), ...at(event));
	}, {passive: false});
}

function listenCurves() {
	const canvas = byId("curves-ink"), choose = event => panel.r && goTo(frameAt(event.clientX - canvas.getBoundingClientRect().left));
	canvas.addEventListener("pointerdown", event => {
		canvas.setPointerCapture(event.pointerId);
		choose(event);
	});
	canvas.addEventListener("pointermove", event => event.buttons && choose(event));
}

function listen() {
	byId("show").addEventListener("change", offer);
	byId("depth").addEventListener("change", firstView);
	for (const id of ["across", "up"])
		byId(id).addEventListener("change", firstView);
	for (const id of ["overlay", "trails", "colour", "scale", "span", "map", "curve", "curve-scale"])
		byId(id).addEventListener("change", redraw);
	for (const id of ["size", "slice"])
		byId(id).addEventListener("input", () => slide(0));
	byId("axis").addEventListener("change", () => {
		tellSlice();
		lookAlong(Number(chosen("axis")));
	});
	byId("time").addEventListener("input", () => goTo(Number(chosen("time"))));
	byId("play").addEventListener("click", () => play(!state.playing));
	byId("reset").addEventListener("click", firstView);
	byId("theme").addEventListener("click", keys.t);
	byId("help-open").addEventListener("click", keys["?"]);
	matchMedia("(prefers-color-scheme: dark)").addEventListener("change", event => theme(event.matches));
	new ResizeObserver(redraw).observe(byId("view"));
	new ResizeObserver(redraw).observe(byId("curves-ink"));
	listenKeys();
	listenPointers();
	listenCurves();
}
