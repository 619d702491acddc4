// Values as a person writes them in a scene file: what is allowed, and what shaders get.

const isNumber = (x) => typeof x === "number" && Number.isFinite(x);
const isThreeNumbers = (x) => Array.isArray(x) && x.length === 3 && x.every(isNumber);

/// The scene's numbers are floats: seven digits say all, and 0.1 reads as 0.1.
function tidy(value) {
    if (typeof value === "number") return Number(value.toPrecision(7));
    return Array.isArray(value) ? value.map(tidy) : value;
}

/// A triple is three numbers, however it was written.
function canonical(parameter, value) {
    return tidy(parameter.type === "rgb" && isNumber(value) ? [value, value, value] : value);
}

function areEqual(a, b) {
    return Array.isArray(a) ? Array.isArray(b) && a.every((x, i) => x === b[i]) : a === b;
}

function rangeText({ minimum, maximum, minimum_excluded, maximum_excluded }) {
    const least = minimum === null ? "" : minimum_excluded ? `more than ${tidy(minimum)}` : `at least ${tidy(minimum)}`;
    const most = maximum === null ? "" : maximum_excluded ? `less than ${tidy(maximum)}` : `at most ${tidy(maximum)}`;
    return [least, most].filter((text) => text !== "").join(" and ");
}

function isInRange(parameter, x) {
    const { minimum, maximum, minimum_excluded, maximum_excluded } = parameter;
    // Limits are floats, too: 0.95 must be allowed where the limit reads 0.949999988.
    if (minimum !== null && (x < tidy(minimum) || (minimum_excluded && x === tidy(minimum)))) return false;
    return maximum === null || !(x > tidy(maximum) || (maximum_excluded && x === tidy(maximum)));
}

/// What is wrong with a value; null where nothing is.
function complaint(parameter, value) {
    const inRange = (x) => (isInRange(parameter, x) ? null : `must be ${rangeText(parameter)}`);
    switch (parameter.type) {
        case "real":
            return isNumber(value) ? inRange(value) : "must be a number";
        case "integer":
            return Number.isInteger(value) ? inRange(value) : "must be a whole number";
        case "boolean":
            return typeof value === "boolean" ? null : "must be on or off";
        case "choice":
            return parameter.choices.includes(value) ? null : "must be one of the choices";
        case "color":
            return isThreeNumbers(value) && value.every((x) => x >= 0 && x <= 256) ? null : "must be three numbers from 0 to 255";
        case "rgb":
            if (isNumber(value)) return inRange(value);
            break;
    }
    if (!isThreeNumbers(value)) return "must be three numbers";
    if (parameter.type === "direction" && lengthOf(value) === 0) return "must not be all zero";
    return value.map(inRange).find((text) => text !== null) ?? null;
}

/// 0-255 to a linear intensity; sRGB is IEC 61966-2-1.
function decodedColor(color, isSrgb) {
    return color.map((byte) => {
        const c = Math.min(byte, 255) / 255;
        if (!isSrgb) return c;
        return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
    });
}

/// An integer, a float or three floats for a shader: { kind: "int" | "float" | "vec3", value }.
function uniformOf(parameter, value, isSrgb) {
    switch (parameter.type) {
        case "real":
            return { kind: "float", value: parameter.unit === "deg" ? (value * Math.PI) / 180 : value };
        case "integer":
            return { kind: "int", value };
        case "boolean":
            return { kind: "int", value: value ? 1 : 0 };
        case "choice":
            return { kind: "int", value: parameter.choices.indexOf(value) };
        case "color":
            return { kind: "vec3", value: decodedColor(value, isSrgb) };
        case "direction":
            return { kind: "vec3", value: normalized(value) };
        default:
            return { kind: "vec3", value };
    }
}
