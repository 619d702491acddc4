/** A parameter as models' manifests describe theirs, for what belongs to no model. */
export const makeParameter = (name, type, rest = {}) => ({
    name, type, unit: "", meaning: "", default: null, choices: [],
    minimum: null, maximum: null, minimum_excluded: false, maximum_excluded: false, ...rest,
});

export const OBSERVER_PARAMETERS = [
    makeParameter("position", "point", { unit: "m", meaning: "where the observer is" }),
    makeParameter("look_at", "point", { unit: "m", meaning: "the middle of the picture" }),
    makeParameter("fov", "real", {
        unit: "deg", meaning: "the full vertical angle of view",
        minimum: 0, maximum: 180, minimum_excluded: true, maximum_excluded: true,
    }),
    makeParameter("height", "real", { unit: "m", meaning: "what fits the picture's height", minimum: 0, minimum_excluded: true }),
];

export const COLOR = makeParameter("color", "color", { meaning: "the object's own colour" });
/** What can be shown over the picture, and the pictures beside one another: no part of the scene. */
export const SHOWN = ["lights", "room", "axes", "observer"].map((name) => makeParameter(name, "boolean"));
export const LAYOUT = makeParameter("panes", "choice", { choices: ["one", "two", "three", "four", "wipe"] });

export const SWITCH = makeParameter("on", "boolean", { meaning: "whether the light is lit" });
