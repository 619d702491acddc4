import { ARROW_LENGTH, project } from "../arrows.js";
import { viewAxes } from "../../../../../sdk/web/camera.js";
import { add, cross, dot, normalize, scale, subtract } from "../../../../../sdk/web/vectors.js";

const COLOR = [120, 225, 205], OPACITY = 0.9;

/**
 * Intensities over a surface as a surface themselves: each is as far from the point as it is large, and the largest as far as
 * an arrow is long. Drawn into a canvas that covers the picture, from back to front; `grid`: of lobe.js's hemisphere().
 */
export function drawLobe(canvas, observer, [width, height], position, grid, values) {
    [canvas.width, canvas.height] = [width, height];
    const context = canvas.getContext("2d"), from = project(observer, position), peak = Math.max(...values);
    if (from === null || !(peak > 0)) return;
    const { forward } = viewAxes(observer), unit = (ARROW_LENGTH * from.across) / peak;
    const places = grid.directions.map((direction, i) => add(position, scale(direction, unit * Math.max(0, values[i]))));
    const inPicture = places.map((place) => project(observer, place));
    const quads = [];
    for (let row = 0; row < grid.rows; ++row) {
        for (let column = 0; column < grid.columns; ++column) {
            const first = row * (grid.columns + 1) + column, corners = [first, first + 1, first + grid.columns + 2, first + grid.columns + 1];
            if (corners.some((i) => inPicture[i] === null)) continue;
            const [a, b, c, d] = corners.map((i) => places[i]);
            const towards = Math.abs(dot(forward, normalize(cross(subtract(c, a), subtract(d, b)))));
            quads.push({ corners, towards, depth: corners.reduce((sum, i) => sum + dot(forward, places[i]), 0) });
        }
    }
    quads.sort((one, other) => other.depth - one.depth);
    for (const { corners, towards } of quads) {
        context.beginPath();
        for (const i of corners) context.lineTo(width / 2 + inPicture[i].x * height, height / 2 + inPicture[i].y * height);
        context.closePath();
        context.fillStyle = context.strokeStyle = `rgb(${COLOR.map((c) => Math.round(c * (0.35 + 0.65 * towards))).join(" ")} / ${OPACITY})`;
        context.fill();
        context.stroke();  // otherwise the background shows between two of them
    }
}
