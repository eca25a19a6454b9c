// What WebGL 2 draws: particles as discs, particles as a density, a plane of a mesh. SPDX-License-Identifier: GPL-3.0-or-later

const paint = {gl: null, density: false};

const placing = `#version 300 es
precision highp float;
uniform vec3 lo, width, w;
uniform mat3 turn;
uniform vec4 view; // centre and pixels per unit, in clip coordinates: x, y, per unit x, per unit y
uniform float radius;
vec4 place(vec3 x) {
	vec3 p = turn * (((x - lo) / width - 0.5) * w);
	return vec4(view.xy + view.zw * p.xy, -0.4 * p.z, 1.0);
}
`;
const shading = `#version 300 es
precision highp float;
uniform vec4 scale; // lowest and highest value, 1 if logarithmic, where on the map the lowest is
uniform sampler2D map;
vec3 shade(float v) {
	float t = scale.z > 0.5 ? (v > 0.0 ? log(v / scale.x) / log(scale.y / scale.x) : 0.0) : (v - scale.x) / (scale.y - scale.x);
	t = scale.w + (1.0 - scale.w) * clamp(t, 0.0, 1.0);
	return texture(map, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb;
}
`;
const sources = {
	points: [placing + `
in float x, y, z, value;
out float v;
void main() {
	gl_Position = place(vec3(x, y, z));
	gl_PointSize = 2.0 * radius + 1.0;
	v = value;
}`, shading + `
uniform float radius, coloured;
uniform vec3 plain;
in float v;
out vec4 colour;
void main() {
	float r = length(gl_PointCoord - 0.5) * (2.0 * radius + 1.0), cover = clamp(radius + 0.5 - r, 0.0, 1.0);
	if (cover < 0.02)
		discard;
	colour = vec4(coloured > 0.5 ? shade(v) : plain, cover);
}`],
	splat: [placing + `
in float x, y, z;
void main() {
	gl_Position = vec4(place(vec3(x, y, z)).xy, 0.0, 1.0);
	gl_PointSize = 2.0 * radius + 1.0;
}`, `#version 300 es
precision highp float;
uniform float radius;
out vec4 colour;
void main() {
	float r = length(gl_PointCoord - 0.5) * (2.0 * radius + 1.0) / (radius + 0.5);
	colour = vec4(max(0.0, 1.0 - r * r) * 2.0 / (3.14159265 * (radius + 0.5) * (radius + 0.5)), 0.0, 0.0, 1.0); // in all 1
}`],
	tone: [`#version 300 es
in vec2 corner;
out vec2 at;
void main() {
	at = corner;
	gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}`, shading + `
uniform sampler2D heap;
in vec2 at;
out vec4 colour;
void main() {
	float v = texture(heap, at).r;
	if (v <= 0.0)
		discard;
	colour = vec4(shade(v), scale.z > 0.5 ? smoothstep(0.0, scale.x, v) : 1.0);
}`],
	plane: [placing + `
in vec3 corner;
in vec2 part;
out vec2 at;
void main() {
	at = part;
	gl_Position = place(corner);
}`, shading + `
uniform sampler2D numbers; // linear between the nodes
in vec2 at;
out vec4 colour;
float node(ivec2 i, ivec2 n) { return texelFetch(numbers, clamp(i, ivec2(0), n - 1), 0).r; }
void main() {
	ivec2 n = textureSize(numbers, 0);
	vec2 p = at * vec2(n - 1), f = fract(p);
	ivec2 i = ivec2(floor(p));
	colour = vec4(shade(mix(mix(node(i, n), node(i + ivec2(1, 0), n), f.x), mix(node(i + ivec2(0, 1), n), node(i + 1, n), f.x), f.y)), 1.0);
}`],
};

// False: this browser has no WebGL 2.
function paintBegin(canvas) {
	const gl = paint.gl = canvas.getContext("webgl2", {alpha: true, antialias: false, premultipliedAlpha: false, preserveDrawingBuffer: true});
	if (!gl)
		return false;
	paint.density = Boolean(gl.getExtension("EXT_color_buffer_float") && gl.getExtension("EXT_float_blend"));
	paint.programs = {};
	for (const [name, [vertex, fragment]] of Object.entries(sources)) {
		const program = gl.createProgram();
		for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
			const shader = gl.createShader(type);
			gl.shaderSource(shader, text);
			gl.compileShader(shader);
			gl.attachShader(program, shader);
		}
		gl.linkProgram(program);
		if (!gl.getProgramParameter(program, gl.LINK_STATUS))
			throw new Error(`${name}: ${gl.getProgramInfoLog(program)}`);
		paint.programs[name] = program;
	}
	paint.buffers = {};
	paint.held = {}; // what each buffer holds, so that nothing is sent twice
	paint.maps = {};
	paint.numbers = texture(gl.NEAREST);
	paint.heap = texture(gl.NEAREST);
	paint.frame = gl.createFramebuffer();
	return true;
}

function texture(filter) {
	const gl = paint.gl, made = gl.createTexture();
	gl.bindTexture(gl.TEXTURE_2D, made);
	for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
		gl.texParameteri(gl.TEXTURE_2D, side, filter);
	for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
		gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
	return made;
}

function mapTexture(name) {
	const gl = paint.gl;
	if (!paint.maps[name]) {
		paint.maps[name] = texture(gl.LINEAR);
		gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, 256, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, mapBytes(name));
	}
	return paint.maps[name];
}

function mapBytes(name) {
	return Uint8Array.from({length: 768}, (_, i) => parseInt(run.maps[name].slice(2 * i, 2 * i + 2), 16));
}

function attribute(program, name, numbers, size) {
	const gl = paint.gl, at = gl.getAttribLocation(program, name);
	if (at < 0)
		return;
	paint.buffers[name] = paint.buffers[name] || gl.createBuffer();
	gl.bindBuffer(gl.ARRAY_BUFFER, paint.buffers[name]);
	if (paint.held[name] !== numbers)
		gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.DYNAMIC_DRAW);
	paint.held[name] = numbers;
	gl.enableVertexAttribArray(at);
	gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
}

// Where things stand, and their colours.
function use(name, scale, radius) {
	const gl = paint.gl, program = paint.programs[name], canvas = gl.canvas, pixel = canvas.width / canvas.clientWidth;
	const at = uniform => gl.getUniformLocation(program, uniform), s = unitPixels() * camera.zoom;
	const [cx, cy] = projectUnit([0, 0, 0]);
	gl.useProgram(program);
	gl.uniform3f(at("lo"), ...space.axes.map(a => a.lo));
	gl.uniform3f(at("width"), ...space.axes.map(a => a.hi - a.lo));
	gl.uniform3f(at("w"), ...space.w);
	gl.uniformMatrix3fv(at("turn"), true, camera.turn);
	gl.uniform4f(at("view"), 2 * cx / canvas.clientWidth - 1, 1 - 2 * cy / canvas.clientHeight, 2 * s / canvas.clientWidth, 2 * s / canvas.clientHeight);
	gl.uniform1f(at("radius"), radius * pixel);
	if (scale) {
		gl.uniform4f(at("scale"), scale.lo, scale.hi, scale.log ? 1 : 0, scale.start);
		gl.activeTexture(gl.TEXTURE0);
		gl.bindTexture(gl.TEXTURE_2D, mapTexture(scale.map));
		gl.uniform1i(at("map"), 0);
	}
	return program;
}

// The ground, and from here on only the area of the data is drawn on.
function paintGround(ground) {
	const gl = paint.gl, canvas = gl.canvas, pixel = canvas.width / canvas.clientWidth;
	gl.bindFramebuffer(gl.FRAMEBUFFER, null);
	gl.viewport(0, 0, canvas.width, canvas.height);
	gl.disable(gl.SCISSOR_TEST);
	gl.clearColor(0, 0, 0, 0);
	gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
	gl.enable(gl.SCISSOR_TEST);
	gl.scissor(plot.x0 * pixel, canvas.height - plot.y1 * pixel, (plot.x1 - plot.x0) * pixel, (plot.y1 - plot.y0) * pixel);
	gl.clearColor(...ground, 1);
	gl.clear(gl.COLOR_BUFFER_BIT);
}

// x, y, z, value: Float32Arrays (value null: one colour, plain).
function paintPoints(x, y, z, value, scale, radius, plain) {
	const gl = paint.gl, program = use("points", scale, radius);
	gl.uniform1f(gl.getUniformLocation(program, "coloured"), value ? 1 : 0);
	gl.uniform3f(gl.getUniformLocation(program, "plain"), ...plain);
	gl.enable(gl.DEPTH_TEST);
	gl.enable(gl.BLEND);
	gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE);
	for (const [name, numbers] of Object.entries({x, y, z, value: value || x}))
		attribute(program, name, numbers, 1);
	gl.drawArrays(gl.POINTS, 0, x.length);
	gl.disable(gl.DEPTH_TEST);
	gl.disable(gl.BLEND);
}

// Particles per pixel, on a scale that follows what is seen. Returns the scale, or null where nothing is.
function paintDensity(x, y, z, scale, radius) {
	const gl = paint.gl, canvas = gl.canvas;
	gl.bindTexture(gl.TEXTURE_2D, paint.heap);
	gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, canvas.width, canvas.height, 0, gl.RED, gl.FLOAT, null);
	gl.bindFramebuffer(gl.FRAMEBUFFER, paint.frame);
	gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, paint.heap, 0);
	gl.clearColor(0, 0, 0, 0);
	gl.clear(gl.COLOR_BUFFER_BIT);
	const program = use("splat", null, radius);
	gl.enable(gl.BLEND);
	gl.blendFunc(gl.ONE, gl.ONE);
	for (const [name, numbers] of Object.entries({x, y, z}))
		attribute(program, name, numbers, 1);
	gl.drawArrays(gl.POINTS, 0, x.length);
	const heap = new Float32Array(canvas.width * canvas.height);
	gl.readPixels(0, 0, canvas.width, canvas.height, gl.RED, gl.FLOAT, heap);
	gl.bindFramebuffer(gl.FRAMEBUFFER, null);
	const most = heap.reduce((a, b) => b > a ? b : a, 0);
	const one = 2 / (Math.PI * (radius * canvas.width / canvas.clientWidth + 0.5) ** 2); // the peak of a single particle
	const seen = {...scale, lo: scale.log ? Math.max(0.3 * one, most * 1e-4) : 0, hi: Math.max(most, one)};
	const tone = use("tone", seen, radius);
	gl.activeTexture(gl.TEXTURE1);
	gl.bindTexture(gl.TEXTURE_2D, paint.heap);
	gl.uniform1i(gl.getUniformLocation(tone, "heap"), 1);
	gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE);
	attribute(tone, "corner", new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]), 2);
	gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
	gl.disable(gl.BLEND);
	return most > 0 ? seen : null;
}

// n: nodes across and up; corners: the four places of the first and last nodes, in the order of a strip.
function paintPlane(numbers, n, corners, scale) {
	const gl = paint.gl, program = use("plane", scale, 1);
	gl.activeTexture(gl.TEXTURE1);
	gl.bindTexture(gl.TEXTURE_2D, paint.numbers);
	gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
	gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, n[0], n[1], 0, gl.RED, gl.FLOAT, numbers);
	gl.uniform1i(gl.getUniformLocation(program, "numbers"), 1);
	gl.enable(gl.DEPTH_TEST);
	attribute(program, "corner", new Float32Array(corners.flat()), 3);
	attribute(program, "part", new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]), 2);
	gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
	gl.disable(gl.DEPTH_TEST);
}
