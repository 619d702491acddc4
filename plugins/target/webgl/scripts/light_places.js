import { displayName } from "../../../../sdk/web/scene.js";
import { toHex } from "../../../../sdk/web/colors.js";
import { add, cross, length, normalize, rotate, scale, subtract } from "../../../../sdk/web/vectors.js";

const CIRCLE_STEPS = 36, RULINGS = 6;
const MOST_AT_ONCE = 12;  // more would cover the picture, unless they are asked for

/** The middle of boxes { low, high }, and the radius of a ball around all of them. */
export function ballAround(bounds) {
    const low = [0, 1, 2].map((axis) => Math.min(...bounds.map((box) => box.low[axis])));
    const high = [0, 1, 2].map((axis) => Math.max(...bounds.map((box) => box.high[axis])));
    if (!low.every(Number.isFinite)) return { centre: [0, 0, 0], radius: 1 };
    return { centre: scale(add(low, high), 0.5), radius: Math.max(0.5 * length(subtract(high, low)), 1e-3) };
}

/** A light's value, if its model has a parameter of that name and type. */
function valueOf(settings, model, index, name, type) {
    const hasIt = model.parameters.some((parameter) => parameter.name === name && parameter.type === type);
    return hasIt ? settings.get(`light.${index}.value.${name}`) : null;
}

const hasPlace = (model) => model.parameters.some(({ name, type }) =>
    (name === "position" && type === "point") || (name === "direction" && type === "direction"));

/** Whether a scene's lights are shown by default. */
export const areLightsShown = (scene) =>
    scene.lights.filter(({ model }) => hasPlace(scene.light_models[model])).length <= MOST_AT_ONCE;

/** Rounds to steps of a size, except coordinates that have hardly changed since `before`. */
const inSteps = (value, before, step) =>
    value.map((x, i) => (Math.abs(x - before[i]) < 0.5 * step ? before[i] : Math.round(x / step) * step));

/** A light's direction as a movable place: `sign` times the direction from `origin`. */
function directionHandle(path, direction, origin, reach, sign) {
    return {
        part: "direction", path, at: add(origin, scale(normalize(direction), sign * reach)),
        valueAt: (at) => {
            const size = length(direction), value = scale(normalize(subtract(at, origin)), sign * size);
            return inSteps(value, direction, 10 ** Math.floor(Math.log10(size * 0.003)));
        },
    };
}

/** A cone's circle and some of its lines. `angle`: between its axis and its lines, in degrees. */
function coneLines(tip, direction, angle, reach) {
    const axis = normalize(direction), side = normalize(cross(axis, Math.abs(axis[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0]));
    const radians = (angle * Math.PI) / 180;
    const edge = add(scale(axis, reach * Math.cos(radians)), scale(side, reach * Math.sin(radians)));
    const around = (i, count) => add(tip, rotate(edge, axis, (2 * Math.PI * i) / count));
    const lines = [];
    for (let i = 0; i < CIRCLE_STEPS; ++i) lines.push([around(i, CIRCLE_STEPS), around(i + 1, CIRCLE_STEPS)]);
    for (let i = 0; i < RULINGS; ++i) lines.push([tip, around(i, RULINGS)]);
    return lines;
}

/** A shaft and two barbs, which lie in a plane with `across`. */
function arrowLines(from, to, across) {
    const back = scale(subtract(from, to), 0.14), side = scale(normalize(cross(back, across)), 0.5 * length(back));
    return [[from, to], [to, add(to, add(back, side))], [to, add(to, subtract(back, side))]];
}

/**
 * The places of lights, found by the names and types of their parameters, so that lights of other plugins are shown as well. A
 * directional light is placed next to the scene, where it comes from. `handles`: movable points, each with the setting that it
 * changes and its value at another place; `lines`: pairs of points.
 */
export function lightPlaces(settings, bounds) {
    const { scene } = settings, { centre, radius } = ballAround(bounds);
    return scene.lights.flatMap((light, index) => {
        const model = scene.light_models[light.model], prefix = `light.${index}.value.`;
        const value = (name, type) => valueOf(settings, model, index, name, type);
        const position = value("position", "point"), direction = value("direction", "direction");
        if (position === null && direction === null) return [];
        const handles = [], lines = [];
        if (position !== null) {
            handles.push({ part: "position", path: `${prefix}position`, at: position, valueAt: (at, step) => inSteps(at, position, step) });
            const [u, v] = ["edge_u", "edge_v"].map((name) => value(name, "vector"));
            if (u !== null && v !== null) {
                const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => add(position, add(scale(u, a / 2), scale(v, b / 2))));
                corners.forEach((corner, i) => lines.push([corner, corners[(i + 1) % 4]]));
            }
        }
        if (direction !== null && position !== null) {
            const reach = Math.max(0.45 * length(subtract(centre, position)), 0.2 * radius);
            handles.push(directionHandle(`${prefix}direction`, direction, position, reach, 1));
            lines.push([position, handles[1].at]);
            const angle = value("outer_angle", "real");
            if (angle !== null) lines.push(...coneLines(position, direction, angle, reach));
        } else if (direction !== null) {
            const handle = directionHandle(`${prefix}direction`, direction, centre, 0.9 * radius, -1);
            const across = subtract(settings.observer().position, centre);
            handles.push(handle);
            lines.push(...arrowLines(handle.at, add(handle.at, scale(normalize(direction), 0.5 * radius)), across));
        }
        const color = model.parameters.find(({ type }) => type === "color");
        return [{
            index, handles, lines,
            name: displayName(light.label, "light", index), title: model.title,
            color: toHex(color ? settings.get(prefix + color.name) : [255, 255, 255]),
            isOn: settings.get(`light.${index}.on`),
        }];
    });
}
