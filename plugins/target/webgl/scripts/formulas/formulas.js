import { numbered } from "../../../../../sdk/web/editor/problems.js";

const KINDS = ["reflection", "shading", "light"];

/** The scene's models of the kind of an id such as "reflection/phong". */
const split = (id) => [id.slice(0, id.indexOf("/")), id.slice(id.indexOf("/") + 1)];
export const modelOfId = (scene, id) => scene[`${split(id)[0]}_models`][split(id)[1]];

/** Ids of all models whose kernels the scene has. */
export const idsOf = (scene) => KINDS.flatMap((kind) => Object.keys(scene[`${kind}_models`]).map((name) => `${kind}/${name}`));

/** Whether a model contributes to an appearance (appearance.js); lights that are switched off do not. */
export function isUsed(appearance, id) {
    const [kind, name] = split(id);
    return kind === "light" ? appearance.lights.some(({ model }) => model === name) : appearance.objects.some((object) => object[kind] === name);
}

/** The reflection and shading models among these ids that do not contribute to it, as kind and name. (All lights are in every program.) */
export const unusedOf = (appearance, ids) =>
    [...ids].filter((id) => !isUsed(appearance, id)).map(split).filter(([kind]) => kind !== "light").map(([kind, name]) => ({ kind, name }));

/** The scene with other kernel texts, a map by id. Its shaders declare all functions that a kernel may use. */
export function withFormulas(scene, texts) {
    if (texts.size === 0) return scene;
    const result = { ...scene, shaders: { ...scene.shaders, prelude: scene.shaders.library } };
    for (const [id, text] of texts) {
        const [kind, name] = split(id), models = `${kind}_models`, model = scene[models][name];
        if (kind === "light") result.shaders.lights = result.shaders.lights.split(model.kernel).join(numbered(text));
        else result[models] = { ...result[models], [name]: { ...model, glsl: numbered(text) + model.glsl.slice(model.kernel.length) } };
    }
    return result;
}
