import { element } from "../../../../sdk/web/elements.js";
import { COMMON } from "./parameters.js";

/** The control of a normal or bump map; null without one, and where light is not evaluated at pixels. */
function normalScale({ scene }, controls, prefix, i, shading) {
    const { normal_scale: scale } = scene.objects[i];
    if (!scale || scene.shading_models[shading].rate !== "fragment") return null;
    return controls.of(`${prefix}object.${i}.${scale.path}`, scale.path.replace(".", " "));
}

/** The controls that an object has whatever its reflection model, and null in place of those that it does not have. `prefix`: of a pane. */
export const commonControls = (settings, controls, prefix, i, shading) =>
    [...COMMON.map(({ name }) => controls.of(`${prefix}object.${i}.common.${name}`, name)), normalScale(settings, controls, prefix, i, shading)];

/** A sentence about the values that have no control, since they differ from point to point; null if there are none. */
export function givenByPictures({ is_color_textured, textured, opacity_map, reflection: own }, reflection) {
    const names = [...(is_color_textured ? ["color"] : []), ...(reflection === own ? textured : []), ...(opacity_map === null ? [] : ["opacity"])];
    return names.length === 0 ? null : element("p", { class: "about" }, `Given by pictures or vertices: ${names.join(", ")}.`);
}
