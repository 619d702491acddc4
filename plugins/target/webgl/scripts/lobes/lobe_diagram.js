import { svgElement } from "../../../../../sdk/web/elements.js";

const RADIUS = 100, MARGIN = 16, DECADES = 4;

/** The distance from the centre at which an intensity is drawn; the largest is drawn at 1. */
function radiusOf(value, peak, isLogarithmic) {
    const share = peak > 0 ? Math.max(0, value) / peak : 0;
    return isLogarithmic ? Math.max(0, 1 + Math.log10(Math.max(share, 1e-30)) / DECADES) : share;
}

/**
 * A polar diagram of intensities over a surface: `curves` have a name and a value for each angle with N, in degrees, from left to right.
 * The light comes from the left at `incidence`.
 */
export function lobeDiagram(curves, angles, incidence, isLogarithmic, description) {
    const peak = Math.max(...curves.flatMap(({ values }) => values));
    const place = (angle, radius) => [Math.sin((angle * Math.PI) / 180), -Math.cos((angle * Math.PI) / 180)].map((x) => (RADIUS * radius * x).toFixed(2));
    const line = (name, angle) => {
        const [x, y] = place(angle, 1.08);
        return svgElement("line", { class: name, x1: 0, y1: 0, x2: x, y2: y });
    };
    const rings = [0.25, 0.5, 0.75, 1].map((r) => svgElement("path", { class: "ring", d: `M ${-RADIUS * r} 0 A ${RADIUS * r} ${RADIUS * r} 0 0 1 ${RADIUS * r} 0` }));
    const paths = curves.map(({ values }, i) => {
        const points = values.map((value, k) => place(angles[k], radiusOf(value, peak, isLogarithmic)).join(","));
        return svgElement("polygon", { class: `curve curve-${i}`, points: ["0,0", ...points].join(" ") });
    });
    const width = 2 * (RADIUS + MARGIN);
    return svgElement("svg", { class: "lobe-diagram", role: "img", "aria-label": description, viewBox: `${-width / 2} ${-RADIUS - MARGIN} ${width} ${RADIUS + 1.5 * MARGIN}` },
        svgElement("line", { class: "surface", x1: -RADIUS - MARGIN, y1: 0, x2: RADIUS + MARGIN, y2: 0 }), ...rings,
        line("to-light", -incidence), line("to-mirror", incidence), ...paths);
}
