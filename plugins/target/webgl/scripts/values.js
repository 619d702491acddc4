export const isNumber = (x) => typeof x === "number" && Number.isFinite(x);
export const isVector = (x) => Array.isArray(x) && x.length === 3 && x.every(isNumber);

/** To seven significant digits, which is all that the scene's floats hold, so that 0.1 reads as 0.1. */
export function roundToFloat(value) {
    if (typeof value === "number") return Number(value.toPrecision(7));
    return Array.isArray(value) ? value.map(roundToFloat) : value;
}

/** The one form of a value that settings compare: rounded, and an RGB value as three numbers even where one stands for all. */
export function canonicalValue(parameter, value) {
    return roundToFloat(parameter.type === "rgb" && isNumber(value) ? [value, value, value] : value);
}

export function areEqual(a, b) {
    return Array.isArray(a) ? Array.isArray(b) && a.every((x, i) => x === b[i]) : a === b;
}
