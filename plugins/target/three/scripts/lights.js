import { Color, DirectionalLight, PointLight, SpotLight } from "three";

/** The properties of all lights; those that shine in a direction also have a target, which is in the scene for its position. */
function placed(light, { position, target }) {
    light.position.set(...position);
    if (target === undefined) return [light];
    light.target.position.set(...target);
    return [light, light.target];
}

const MAKERS = {
    directional: (color, { intensity }) => new DirectionalLight(color, intensity),
    point: (color, { intensity, decay }) => new PointLight(color, intensity, 0, decay),
    spot: (color, { intensity, angle, penumbra, decay }) => new SpotLight(color, intensity, 0, angle, penumbra, decay),
};

/** three.js's own lights, for its own materials. Kernels read theirs from a table. */
export const lightsOf = ({ lights }) => lights.flatMap((light) => placed(MAKERS[light.type](new Color(...light.color), light), light));
