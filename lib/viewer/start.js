// The page begins. What stands behind # in its address chooses: page.html#frame=3&colour=v%20-1&dark=1 (ids of the menus, yaw, pitch and zoom).
// SPDX-License-Identifier: GPL-3.0-or-later

function readAddress() {
	const asked = new URLSearchParams(location.hash.slice(1));
	const menus = ["show", "overlay", "trails", "colour", "scale", "span", "map", "across", "up", "depth", "axis",
		"slice", "size", "curve", "curve-scale", "fps"];
	for (const id of menus)
		if (asked.has(id)) {
			byId(id).value = asked.get(id);
			byId(id).dispatchEvent(new Event("change"));
			slide(0);
		}
	if (asked.has("yaw") || asked.has("pitch"))
		turned(Number(asked.get("yaw") ?? 0.5), Number(asked.get("pitch") ?? 0.45));
	if (asked.has("zoom"))
		zoomBy(Number(asked.get("zoom")));
	if (asked.has("dark"))
		theme(asked.get("dark") === "1");
	goTo(Number(asked.get("frame") ?? 1) - 1);
	play(asked.get("play") === "1");
}

function tellNotes() {
	const notes = [], places = frames.flatMap(f => [...f.sets, ...f.meshes]);
	const of = type => [...new Set(places.filter(p => p.fields.some(f => f.data.some(d => d && d.as === type))).map(p => p.name))].join(", ");
	if (run.leftOut)
		notes.push(`Left out: this page has ${run.leftOut}.`);
	if (of("u16"))
		notes.push(`Positions (${of("u16")}) are rounded to 1/65535 of their range.`);
	if (of("f16"))
		notes.push(`Values (${of("f16")}) are rounded to 3 digits.`);
	byId("notes").textContent = notes.join(" ");
	byId("history").textContent = (Array.isArray(run.history) ? run.history : []).map(commandOf).join("\n");
}

// An entry of the history as it was typed.
function commandOf(entry) {
	const quoted = text => /^[\w.,:=+\/-]+$/.test(text) ? text : `'${text}'`;
	const options = Object.entries(entry.options ?? {}).map(([name, value]) => value === true ? `--${name}` : `--${name} ${quoted(String(value))}`);
	return [entry.program ?? JSON.stringify(entry), ...(entry.arguments ?? []).map(quoted), ...options].join(" ");
}

function start() {
	readPage();
	byId("title").textContent = run.title ?? (run.scene || run.law);
	if (!paintBegin(byId("scene"))) {
		byId("trouble").textContent = "This browser has no WebGL 2, so particles and planes of meshes cannot be drawn. The curves and the numbers " +
			"are here; another browser, or graphics acceleration switched on, shows the rest. sdraw -o run.png needs no browser.";
		byId("trouble").hidden = false;
	}
	const names = [...setNames().map(set => ["set " + set, set]), ...meshNames().map(mesh => ["mesh " + mesh, mesh === "mesh" ? mesh : `mesh ${mesh}`])];
	const asked = run.asked, onMesh = frames[0].meshes.find(mesh => asked.mesh === mesh.name || fieldOf(mesh, asked.field ?? ""));
	const mesh = (onMesh && !asked.set && !asked.colour) || !setNames().length;
	fill("show", names, mesh ? `mesh ${onMesh?.name ?? meshNames()[0]}` : "set " + (asked.set ?? setNames()[0]));
	fill("map", [["auto", "automatic"], ...Object.keys(run.maps).map(map => [map, map])], asked.map ?? "auto");
	byId("scale").value = asked.log ? "log" : "auto";
	byId("axis").value = asked.axis;
	byId("fps").value = asked.fps;
	byId("time").max = frames.length - 1;
	groupCurves();
	tellNotes();
	listen();
	theme(matchMedia("(prefers-color-scheme: dark)").matches);
	const box = frames[0].box[asked.axis];
	byId("slice").value = box && asked.slice !== null ? (asked.slice - box.lo) / (box.hi - box.lo) : 0.5;
	if (names.length) {
		offer();
		draw();
		slide(0);
		readAddress();
		draw();
	}
	document.body.dataset.ready = frames.length;
}

document.addEventListener("DOMContentLoaded", start);
