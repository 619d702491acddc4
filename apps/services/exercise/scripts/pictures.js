import { TERMS } from "./evaluation.js";

const AMBIENT_LIGHT = 0.4;  // relative to a light of intensity 1
const encode = (x) => 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);  // IEC 61966-2-1

/** Draws `colorOf(point)`, three numbers 0 to 255, at the exercise's pixels. */
function draw(canvas, { size, pixels }, colorOf) {
    canvas.width = canvas.height = size;
    const image = new ImageData(size, size);
    for (let k = 3; k < image.data.length; k += 4) image.data[k] = 255;
    pixels.forEach((pixel, i) => image.data.set(colorOf(i), 4 * pixel));
    canvas.getContext("2d").putImageData(image, 0, 0);
}

/** Draws the ball with the intensities in `values`; `shown`: a term, or "all". */
export function drawBall(canvas, exercise, values, shown) {
    const weights = TERMS.map((term) => (shown !== "all" && shown !== term ? 0 : term === "ambient" && shown === "all" ? AMBIENT_LIGHT : 1));
    const at = (i) => TERMS.reduce((sum, term, k) => sum + (weights[k] === 0 ? 0 : weights[k] * values[term][i]), 0);
    draw(canvas, exercise, (point) => [0, 1, 2].map((c) => encode(Math.min(1, Math.max(0, at(3 * point + c) || 0)))));
}

/** Draws how much each point differs relative to the largest value, from black over red and yellow to white. NaN is white. */
export function drawDifference(canvas, exercise, differing) {
    draw(canvas, exercise, (point) => {
        const value = differing[point];
        if (value === 0) return [0, 0, 0];
        const heat = Number.isFinite(value) ? Math.min(1, 0.25 + 0.75 * Math.sqrt(value)) : 1;
        return [0, 1, 2].map((c) => 255 * Math.min(1, Math.max(0, 3 * heat - c)));
    });
}

/** Draws a black ball. */
export function drawNothing(canvas, exercise) {
    draw(canvas, exercise, () => [0, 0, 0]);
}
