// Three numbers.

const add = (a, b) => a.map((x, i) => x + b[i]);
const subtract = (a, b) => a.map((x, i) => x - b[i]);
const scaled = (a, s) => a.map((x) => x * s);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const lengthOf = (a) => Math.hypot(...a);

/// The zero vector stays zero.
function normalized(a) {
    const length = lengthOf(a);
    return length > 0 ? scaled(a, 1 / length) : [0, 0, 0];
}

/// About a unit axis, counter-clockwise as seen from its tip (Rodrigues).
function rotated(v, axis, angle) {
    const c = Math.cos(angle), s = Math.sin(angle);
    return add(add(scaled(v, c), scaled(cross(axis, v), s)), scaled(axis, dot(axis, v) * (1 - c)));
}
