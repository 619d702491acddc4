import { isNumber, isVector, roundToFloat } from "../../../../sdk/web/values.js";

/** The smallest of 1, 2 or 5 times a power of ten that is not below x. */
function niceCeiling(x) {
    const power = 10 ** Math.floor(Math.log10(x));
    return roundToFloat([1, 2, 5, 10].map((digit) => digit * power).find((nice) => nice >= x * (1 - 1e-9)));
}

function stepOf(parameter, low, high) {
    const step = niceCeiling((high - low) / 250);
    return parameter.type === "integer" ? Math.max(1, Math.round(step)) : step;
}

/**
 * { low, high, step } of a slider for a parameter whose initial value is given; of a point's coordinate, within `extent`,
 * { low, high } by axis.
 */
export function sliderRange(parameter, initial, axis, extent) {
    const numbers = [initial, parameter.default].flat().filter(isNumber).map(Math.abs);
    const size = Math.max(...numbers, 0) || 1;
    let low = parameter.minimum, high = parameter.maximum;
    if (parameter.type === "point") {
        low = Math.min(extent.low[axis], initial[axis]);
        high = Math.max(extent.high[axis], initial[axis]);
    } else if (parameter.type === "direction") {
        high = Math.max(1, niceCeiling(size));
        low = -high;
    } else {
        // A limit far beyond the value is useless for a slider: nobody could aim in so wide a range.
        const isOpen = (limit) => limit === null || Math.abs(limit) > 25 * size;
        if (isOpen(low)) low = null;
        if (isOpen(high)) high = niceCeiling(Math.max(4 * size, low === null ? 0 : 2 * Math.abs(low)));
        if (low === null) low = -high;
    }
    const step = stepOf(parameter, low, high);
    if (parameter.type === "point") {
        low = Math.floor(low / step) * step;
        high = Math.ceil(high / step) * step;
        return { low: roundToFloat(low), high: roundToFloat(high), step };
    }
    if (parameter.minimum_excluded && low === parameter.minimum) low += step;
    if (parameter.maximum_excluded && high === parameter.maximum) high -= step;
    return { low: roundToFloat(low), high: roundToFloat(high), step };
}

/** The box that sliders move lights and the observer in: that of the whole scene, and a margin. */
export function sliderExtent(scene, bounds) {
    const points = bounds.flatMap(({ low, high }) => [low, high]);
    for (const light of scene.lights) {
        for (const { name, type } of scene.light_models[light.model].parameters) {
            if (type === "point" && isVector(light.values[name])) points.push(light.values[name]);
        }
    }
    points.push(scene.observer.position);
    const ends = [0, 1, 2].map((axis) => {
        const coordinates = points.map((point) => point[axis]);
        return [Math.min(...coordinates), Math.max(...coordinates)];
    });
    const margin = 0.25 * Math.max(...ends.map(([low, high]) => high - low), 1e-3);
    return { low: ends.map(([low]) => low - margin), high: ends.map(([, high]) => high + margin) };
}
