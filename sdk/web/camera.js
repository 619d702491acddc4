import { roundToFloat } from "./values.js";
import { add, cross, dot, length, normalize, rotate, scale, subtract } from "./vectors.js";

/** The camera's orthonormal axes in world space. */
export function viewAxes(observer) {
    const forward = normalize(subtract(observer.look_at, observer.position));
    const right = normalize(cross(forward, observer.up));
    return { forward, right, up: cross(right, forward) };
}

/** The height of the picture: in metres, at a distance of 1 in perspective. */
export function viewHeight(observer) {
    const own = observer.projection === "orthographic" ? observer.height : 2 * Math.tan((observer.fov * Math.PI) / 360);
    return (observer.widening ?? 1) * own;
}

/** An invalid observer's error; null if it is valid. */
export function validateObserver(observer) {
    const view = subtract(observer.look_at, observer.position);
    if (!(length(view) > 0)) return "the observer must not look at its own position";
    if (length(cross(normalize(view), normalize(observer.up))) < 1e-6) return "the observer must not look along its 'up'";
    return null;
}

/**
 * Clipping planes: the near one is Candela's, a tenth of a millimetre or less in a small scene, and the far one lies behind all
 * bounding boxes. The fragment shader fills the depth buffer, with the same relative precision at all distances.
 */
export function clippingPlanes(observer, forward, bounds) {
    let nearest = Infinity, farthest = -Infinity;
    for (const { low, high } of bounds) {
        for (let corner = 0; corner < 8; ++corner) {
            const position = low.map((x, axis) => ((corner >> axis) & 1 ? high[axis] : x));
            const depth = dot(forward, subtract(position, observer.position));
            nearest = Math.min(nearest, depth);
            farthest = Math.max(farthest, depth);
        }
    }
    if (!(farthest > 0)) return { near: 0.1, far: 1 };
    // With room for rounding: the depths of the farthest points must differ from the largest.
    const far = farthest * 1.05;
    if (observer.projection === "orthographic") return { near: Math.max(0.9 * nearest, 0), far };
    return { near: Math.max(0.9 * nearest, Math.min(1e-4, 1e-5 * farthest)), far };
}

/** World space to clip space, column by column; `offset` moves the picture right and down by that many pixels. */
export function viewProjection(observer, bounds, width, height, offset) {
    const { forward, right, up } = viewAxes(observer);
    const { near, far } = clippingPlanes(observer, forward, bounds);
    const isOrthographic = observer.projection === "orthographic";
    const focal = 2 / viewHeight(observer);
    const viewRow = (axis, factor) => [...scale(axis, factor), -factor * dot(axis, observer.position)];
    const addScaled = (a, b, factor) => a.map((coordinate, i) => coordinate + factor * b[i]);
    const depth = viewRow(forward, 1);
    const w = isOrthographic ? [0, 0, 0, 1] : depth;
    const x = addScaled(viewRow(right, (focal * height) / width), w, (2 * offset[0]) / width);
    const y = addScaled(viewRow(up, focal), w, (-2 * offset[1]) / height);
    const [depthScale, depthOffset] = isOrthographic
        ? [2 / (far - near), -(far + near) / (far - near)]
        : [1, -2 * near];  // clips at the near plane; the fragment shader writes the depth
    const z = addScaled(scale(depth, depthScale), [0, 0, 0, 1], depthOffset);
    return new Float32Array([0, 1, 2, 3].flatMap((i) => [x[i], y[i], z[i], w[i]]));
}

/** The distance between the lines of sight of two adjacent pixels: in metres, at a distance of 1 in perspective. */
export const pixelSize = (observer, height) => viewHeight(observer) / height;

/**
 * The line of sight at (0, 0) of gl_FragCoord, to which its coordinates add pixels: for samples at `position` within pixels, from
 * their top left. Orthographic: the distance of that line from the eye.
 */
export function lineOfSight(observer, width, height, position) {
    const { forward, right, up } = viewAxes(observer), pixel = pixelSize(observer, height);
    const corner = add(scale(right, pixel * (position[0] - 0.5 - width / 2)), scale(up, pixel * (0.5 - position[1] - height / 2)));
    return observer.projection === "orthographic" ? corner : add(forward, corner);
}

/** The observer turned around the point it looks at, by angles in radians, stopping short of the poles. */
export function orbit(observer, azimuth, elevation) {
    const pole = normalize(observer.up);
    const offset = subtract(observer.position, observer.look_at);
    const distance = length(offset);
    const limit = (89 * Math.PI) / 180;
    const current = Math.asin(Math.max(-1, Math.min(1, dot(offset, pole) / distance)));
    const target = Math.max(-limit, Math.min(limit, current + elevation));
    const horizontal = normalize(rotate(subtract(offset, scale(pole, dot(offset, pole))), pole, azimuth));
    const moved = add(scale(horizontal, distance * Math.cos(target)), scale(pole, distance * Math.sin(target)));
    return { ...observer, position: roundToFloat(add(observer.look_at, moved)) };
}

/** The observer's distance (orthographic: the height of its view) multiplied by `factor`. */
export function zoom(observer, factor) {
    if (observer.projection === "orthographic") return { ...observer, height: roundToFloat(observer.height * factor) };
    const offset = subtract(observer.position, observer.look_at);
    return { ...observer, position: roundToFloat(add(observer.look_at, scale(offset, factor))) };
}
