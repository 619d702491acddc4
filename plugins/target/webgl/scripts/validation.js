import { isNumber, isVector, roundToFloat } from "../../../../sdk/web/values.js";
import { length } from "../../../../sdk/web/vectors.js";

function describeRange({ minimum, maximum, minimum_excluded, maximum_excluded }) {
    const lower = minimum === null ? "" : `${minimum_excluded ? "more than" : "at least"} ${roundToFloat(minimum)}`;
    const upper = maximum === null ? "" : `${maximum_excluded ? "less than" : "at most"} ${roundToFloat(maximum)}`;
    return [lower, upper].filter((text) => text !== "").join(" and ");
}

function isInRange({ minimum, maximum, minimum_excluded, maximum_excluded }, x) {
    // Limits are also floats: 0.95 must be allowed if the limit reads 0.949999988.
    if (minimum !== null && (x < roundToFloat(minimum) || (minimum_excluded && x === roundToFloat(minimum)))) return false;
    return maximum === null || !(x > roundToFloat(maximum) || (maximum_excluded && x === roundToFloat(maximum)));
}

/** The error of a parameter's value, as a predicate ("must be ..."); null if it is valid. */
export function validateValue(parameter, value) {
    const validateRange = (x) => (isInRange(parameter, x) ? null : `must be ${describeRange(parameter)}`);
    switch (parameter.type) {
        case "real":
            return isNumber(value) ? validateRange(value) : "must be a number";
        case "integer":
            return Number.isInteger(value) ? validateRange(value) : "must be an integer";
        case "boolean":
            return typeof value === "boolean" ? null : "must be on or off";
        case "choice":
            return parameter.choices.includes(value) ? null : "must be one of the choices";
        case "color":
            return isVector(value) && value.every((x) => x >= 0 && x <= 256) ? null : "must be three numbers from 0 to 255";
        case "rgb":
            if (isNumber(value)) return validateRange(value);
            break;
    }
    if (!isVector(value)) return "must be three numbers";
    if (parameter.type === "direction" && length(value) === 0) return "must not be all zero";
    return value.map(validateRange).find((error) => error !== null) ?? null;
}
