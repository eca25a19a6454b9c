// Numbers as people write them, and where the ticks of an axis stand. SPDX-License-Identifier: GPL-3.0-or-later

// With 5 digits, without trailing zeros.
function written(x) {
	if (x === null || x === undefined || Number.isNaN(x))
		return "nan";
	const size = Math.abs(x);
	if (size !== 0 && (size < 1e-3 || size >= 1e6))
		return x.toExponential(4).replace(/\.?0+e/, "e").replace("e+", "e").replace(/-/g, "\u2212");
	return String(Number(x.toPrecision(5))).replace("-", "\u2212");
}

// Round numbers, 1, 2 or 5 times a power of ten apart: {at, text}, at most `most`.
function ticksOf(lo, hi, most) {
	const ticks = [], raw = (hi - lo) / Math.max(most, 1), power = 10 ** Math.floor(Math.log10(raw)), left = raw / power;
	const step = power * (left <= 1 ? 1 : left <= 2 ? 2 : left <= 5 ? 5 : 10);
	if (!(step > 0) || !Number.isFinite(step))
		return ticks;
	const large = Math.max(Math.abs(lo), Math.abs(hi)), decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
	for (let k = Math.ceil(lo / step - 1e-9); k * step <= hi + 1e-9 * step && ticks.length < 40; k++) {
		const at = k === 0 ? 0 : k * step;
		const text = large < 1e5 && decimals <= 4 ? at.toFixed(decimals) :
			at.toExponential(Math.min(12, Math.max(0, Math.floor(Math.log10(Math.max(Math.abs(at), step))) - Math.floor(Math.log10(step) + 1e-9))));
		ticks.push({at, text: at === 0 ? "0" : text.replace("e+", "e").replace(/-/g, "\u2212")});
	}
	return ticks;
}

// Powers of ten, and between them 2 and 5 where there are few.
function logTicksOf(lo, hi, most) {
	const ticks = [], first = Math.floor(Math.log10(lo)), last = Math.ceil(Math.log10(hi)), decades = Math.log10(hi / lo);
	const skip = Math.max(1, Math.ceil(decades / Math.max(most, 1)));
	for (let p = first; p <= last; p++)
		for (const m of decades < 1.5 ? [1, 2, 3, 5, 7] : decades * 3 < most ? [1, 2, 5] : [1]) {
			const at = m * 10 ** p;
			if (at >= lo * (1 - 1e-9) && at <= hi * (1 + 1e-9) && (m > 1 || (p - first) % skip === 0))
				ticks.push({at, text: written(at)});
		}
	return ticks;
}

const withUnit = (name, unit) => unit ? `${name}  [${unit}]` : name;
