import { project } from "./arrows.js";
import { viewAxes, viewHeight } from "../../../../sdk/web/camera.js";
import { svgElement } from "../../../../sdk/web/elements.js";
import { add, dot, scale, subtract } from "../../../../sdk/web/vectors.js";

/** The edges of a box around the origin, of that width, height and depth. */
export function boxLines(extent) {
    const corner = (i) => extent.map((size, axis) => ((i >> axis) & 1 ? 0.5 : -0.5) * size);
    const lines = [];
    for (let i = 0; i < 8; ++i) {
        for (let axis = 0; axis < 3; ++axis) {
            if (!((i >> axis) & 1)) lines.push([corner(i), corner(i | (1 << axis))]);
        }
    }
    return lines;
}

/** An observer's view as a pyramid or a box, up to the point that it looks at. */
export function viewLines(observer, aspect) {
    const { forward, right, up } = viewAxes(observer), depth = dot(forward, subtract(observer.look_at, observer.position));
    const isOrthographic = observer.projection === "orthographic";
    const half = (isOrthographic ? 0.5 : 0.5 * depth) * viewHeight(observer);
    const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) => add(scale(right, x * half * aspect), scale(up, y * half)));
    const ends = corners.map((corner) => add(add(observer.position, scale(forward, depth)), corner));
    const begins = corners.map((corner) => (isOrthographic ? add(observer.position, corner) : observer.position));
    return corners.flatMap((_, i) => [[begins[i], ends[i]], [ends[i], ends[(i + 1) % 4]], ...(isOrthographic ? [[begins[i], begins[(i + 1) % 4]]] : [])]);
}

/** A line's ends in the picture, as returned by project(); null if all of it is behind the observer. */
function projectLine(observer, [a, b]) {
    if (observer.projection !== "orthographic") {
        const { forward } = viewAxes(observer), depths = [a, b].map((point) => dot(forward, subtract(point, observer.position)));
        const nearest = 1e-3 * Math.max(...depths.map(Math.abs));
        if (Math.max(...depths) <= nearest) return null;
        const cut = (from, to, d, e) => (d >= nearest ? from : add(from, scale(subtract(to, from), (nearest - d) / (e - d))));
        [a, b] = [cut(a, b, ...depths), cut(b, a, ...depths.toReversed())];
    }
    const ends = [project(observer, a), project(observer, b)];
    return ends.includes(null) ? null : ends;
}

/** Lines of the scene as elements of a drawing that covers a picture of that size. */
export function drawLines(observer, [width, height], lines, className) {
    return lines.flatMap((line) => {
        const ends = projectLine(observer, line);
        if (ends === null) return [];
        const [[x1, y1], [x2, y2]] = ends.map(({ x, y }) => [width / 2 + x * height, height / 2 + y * height].map((c) => c.toFixed(2)));
        return [svgElement("line", { class: className, x1, y1, x2, y2 })];
    });
}

/** A word at a point of the scene; none behind the observer. */
export function drawWord(observer, [width, height], point, text, className) {
    const place = project(observer, point);
    if (place === null) return [];
    const size = height / 28;
    return [svgElement("text", { class: className, x: width / 2 + place.x * height + size / 3, y: height / 2 + place.y * height - size / 3, "font-size": size }, text)];
}
