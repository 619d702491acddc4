/** Parameters in the form of models' manifests, for settings that do not belong to a model. */
export const makeParameter = (name, type, rest = {}) => ({
    name, type, unit: "", meaning: "", default: null, choices: [],
    minimum: null, maximum: null, minimum_excluded: false, maximum_excluded: false, ...rest,
});

export const OBSERVER_PARAMETERS = [
    makeParameter("position", "point", { unit: "m", meaning: "where the observer is" }),
    makeParameter("look_at", "point", { unit: "m", meaning: "the point at the centre of the picture" }),
    makeParameter("fov", "real", {
        unit: "deg", meaning: "the full vertical angle of view",
        minimum: 0, maximum: 180, minimum_excluded: true, maximum_excluded: true,
    }),
    makeParameter("height", "real", { unit: "m", meaning: "the height that fits the picture", minimum: 0, minimum_excluded: true }),
];

export const COLOR = makeParameter("color", "color", { meaning: "the object's own colour" });
/** Keys of every material, by their names; a model may have parameters of the same names. */
export const COMMON = [
    makeParameter("emission_strength", "real", { meaning: "multiplies the light that the surface emits", default: 1, minimum: 0 }),
    makeParameter("opacity", "real", { meaning: "the fraction of what is behind that the surface covers", default: 1, minimum: 0, maximum: 1 }),
];
/** How steep a picture makes the surface, by paths within the object. */
export const NORMAL_SCALES = new Map([
    ["normal_map.scale", makeParameter("scale", "real", { meaning: "multiplies the normals' parts along u and v", default: 1 })],
    ["bump_map.height", makeParameter("height", "real", { unit: "m", meaning: "of white above black" })],
]);
/** The display over the picture, and the layout of pictures: not part of the scene. */
export const SHOWN = ["lights", "room", "axes", "observer"].map((name) => makeParameter(name, "boolean"));
export const LAYOUT = makeParameter("panes", "choice", { choices: ["one", "two", "three", "four", "wipe"] });

/** Whether objects block light; only in a scene with shadows. */
export const SHADOWS_PATH = "shadows.enabled";
export const SHADOWS = makeParameter("enabled", "boolean");

/** How intensities become bytes: settings of the picture as a whole. */
export const EXPOSURE_PATH = "image.exposure", TONE_PATH = "image.tone";
export const EXPOSURE = makeParameter("exposure", "real", {
    unit: "EV", meaning: "exposure value at ISO 100: intensities are divided by 1.2 · 2^EV", default: 1, minimum: -24, maximum: 24,
});
/** In the order in which the shader knows them. */
export const TONE = makeParameter("tone", "choice", { choices: ["none", "khronos-neutral", "aces", "agx", "reinhard"] });

export const SWITCH = makeParameter("on", "boolean", { meaning: "whether the light is on" });
