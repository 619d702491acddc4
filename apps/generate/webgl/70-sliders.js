// Which numbers a slider covers.

/// 1, 2 or 5 times a power of ten: the smallest that is not below x.
function niceAbove(x) {
    const power = 10 ** Math.floor(Math.log10(x));
    return tidy([1, 2, 5, 10].map((digit) => digit * power).find((nice) => nice >= x * (1 - 1e-9)));
}

function stepOf(parameter, low, high) {
    const step = niceAbove((high - low) / 250);
    return parameter.type === "integer" ? Math.max(1, Math.round(step)) : step;
}

/// { low, high, step } around what the scene says. `reach`: how far places go, { low, high } by axis.
function sliderRange(parameter, own, axis, reach) {
    const numbers = [own, parameter.default].flat().filter(isNumber).map(Math.abs);
    const size = Math.max(...numbers, 0) || 1;
    let low = parameter.minimum, high = parameter.maximum;
    if (parameter.type === "point") {
        low = Math.min(reach.low[axis], own[axis]);
        high = Math.max(reach.high[axis], own[axis]);
    } else if (parameter.type === "direction") {
        high = Math.max(1, niceAbove(size));
        low = -high;
    } else {
        // A range that is far wider than the value is as good as open: nobody could aim in it.
        const isOpen = (limit) => limit === null || Math.abs(limit) > 25 * size;
        if (isOpen(low)) low = null;
        if (isOpen(high)) high = niceAbove(Math.max(4 * size, low === null ? 0 : 2 * Math.abs(low)));
        if (low === null) low = -high;
    }
    const step = stepOf(parameter, low, high);
    if (parameter.type === "point") return { low: tidy(Math.floor(low / step) * step), high: tidy(Math.ceil(high / step) * step), step };
    if (parameter.minimum_excluded && low === parameter.minimum) low += step;
    if (parameter.maximum_excluded && high === parameter.maximum) high -= step;
    return { low: tidy(low), high: tidy(high), step };
}

/// How far lights and the observer are moved by sliders: somewhat beyond all that is there.
function reachOf(scene, boxes) {
    const places = boxes.flatMap(({ low, high }) => [low, high]);
    for (const light of scene.lights) {
        for (const { name, type } of scene.light_models[light.model].parameters) {
            if (type === "point" && isThreeNumbers(light.values[name])) places.push(light.values[name]);
        }
    }
    places.push(scene.observer.position);
    const ends = [0, 1, 2].map((axis) => {
        const along = places.map((place) => place[axis]);
        return [Math.min(...along), Math.max(...along)];
    });
    const margin = 0.25 * Math.max(...ends.map(([low, high]) => high - low), 1e-3);
    return { low: ends.map(([low]) => low - margin), high: ends.map(([, high]) => high + margin) };
}
