import { viewAxes, viewHeight } from "../../../../sdk/web/camera.js";
import { svgElement } from "../../../../sdk/web/elements.js";
import { add, dot, scale, subtract } from "../../../../sdk/web/vectors.js";

export const ARROW_LENGTH = 0.16;  // relative to the picture's height, at the depth of the point

/** The position of a scene's point in the picture, in picture heights to the right of and below its centre; null behind the observer. */
export function project(observer, position) {
    const { forward, right, up } = viewAxes(observer), from = subtract(position, observer.position);
    const depth = dot(forward, from);
    const across = (observer.projection === "orthographic" ? 1 : depth) * viewHeight(observer);
    return across > 0 ? { x: dot(right, from) / across, y: -dot(up, from) / across, across } : null;
}

/** The drawing that arrows are added to; it lies over the picture. */
export const arrowLayer = () => svgElement("svg", { id: "arrows", "aria-hidden": "true" });

/**
 * Draws unit vectors at a point as named arrows into an SVG element that covers the picture, and the way of a light's ray to where
 * it is blocked, if it is.
 */
export function drawArrows(svg, observer, width, height, position, vectors, blockedAt = null) {
    svg.replaceChildren();
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const from = project(observer, position);
    if (from === null) return;
    const place = ({ x, y }) => [width / 2 + x * height, height / 2 + y * height];
    const [x0, y0] = place(from), unit = height / 100;
    for (const [name, vector] of vectors) {
        const to = project(observer, add(position, scale(vector, ARROW_LENGTH * from.across)));
        if (to === null) continue;
        const [x, y] = place(to), angle = Math.atan2(y - y0, x - x0), tip = (turn) => `${x - 2.4 * unit * Math.cos(angle + turn)},${y - 2.4 * unit * Math.sin(angle + turn)}`;
        const group = svgElement("g", { class: `arrow arrow-${name}` });
        group.append(
            svgElement("line", { x1: x0, y1: y0, x2: x, y2: y, "stroke-width": 0.7 * unit }),
            svgElement("polygon", { points: `${x},${y} ${tip(0.45)} ${tip(-0.45)}` }),
            svgElement("text", { x: x + 2.6 * unit * Math.cos(angle), y: y + 2.6 * unit * Math.sin(angle) + 1.4 * unit, "font-size": 4.4 * unit, "text-anchor": "middle" }, name));
        svg.append(group);
    }
    const end = blockedAt === null ? null : project(observer, blockedAt);
    if (end !== null) {
        const [x, y] = place(end), bar = 1.4 * unit, stroke = { "stroke-width": 0.5 * unit };
        svg.append(svgElement("g", { class: "ray" },
            svgElement("line", { x1: x0, y1: y0, x2: x, y2: y, "stroke-dasharray": `${1.5 * unit}`, ...stroke }),
            svgElement("line", { x1: x - bar, y1: y - bar, x2: x + bar, y2: y + bar, ...stroke }),
            svgElement("line", { x1: x - bar, y1: y + bar, x2: x + bar, y2: y - bar, ...stroke })));
    }
    svg.append(svgElement("circle", { cx: x0, cy: y0, r: 0.9 * unit, class: "arrow-origin" }));
}
