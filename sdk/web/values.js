export const isNumber = (x) => typeof x === "number" && Number.isFinite(x);
export const isVector = (x) => Array.isArray(x) && x.length === 3 && x.every(isNumber);

/** Rounds to seven significant digits, the precision of the scene's floats, so that 0.1 reads as 0.1. */
export function roundToFloat(value) {
    if (typeof value === "number") return Number(value.toPrecision(7));
    return Array.isArray(value) ? value.map(roundToFloat) : value;
}

/** The canonical form of a value, which settings compare: rounded, and an RGB value as three numbers even if one stands for all. */
export function canonicalValue(parameter, value) {
    return roundToFloat(parameter.type === "rgb" && isNumber(value) ? [value, value, value] : value);
}

export function areEqual(a, b) {
    return Array.isArray(a) ? Array.isArray(b) && a.every((x, i) => x === b[i]) : a === b;
}
