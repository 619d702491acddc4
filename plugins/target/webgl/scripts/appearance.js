import { decodeColor } from "./colors.js";
import { COLOR } from "./parameters.js";
import { normalize } from "./vectors.js";

/** What a shader gets for a parameter's value: { kind: "int" | "float" | "vec3", value }, angles in radians. */
function toUniform(parameter, value, isSrgb) {
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
            return { kind: "vec3", value: decodeColor(value, isSrgb) };
        case "direction":
            return { kind: "vec3", value: normalize(value) };
        default:
            return { kind: "vec3", value };
    }
}

/** Pairs of a uniform's name and value: the setting `${prefix}${name}` becomes the member `${struct}.${name}`. */
function modelUniforms(settings, model, prefix, struct, isSrgb) {
    return model.parameters
        .filter(({ name }) => settings.find(prefix + name) !== null)
        .map((parameter) => [`${struct}.${parameter.name}`, toUniform(parameter, settings.get(prefix + parameter.name), isSrgb)]);
}

/** The members of a light's struct, in their order. */
function structMembers(settings, model, prefix, isSrgb) {
    return model.block.members.map((name) => {
        const parameter = model.parameters.find((p) => p.name === name);
        return toUniform(parameter, settings.get(prefix + name), isSrgb);
    });
}

/** A snapshot of the settings as the renderer takes them, so that they may change while it refines a picture. */
export function appearanceOf(settings) {
    const { scene } = settings;
    const isSrgb = scene.image.color_management === "srgb";
    const lights = scene.lights
        .map(({ model }, i) => ({ model, isOn: settings.get(`light.${i}.on`), prefix: `light.${i}.value.` }))
        .filter(({ isOn }) => isOn)
        .map(({ model, prefix }) => ({ model, members: structMembers(settings, scene.light_models[model], prefix, isSrgb) }));
    const objects = scene.objects.map((object, i) => {
        const shading = settings.modelOf(object, "shading"), reflection = settings.modelOf(object, "reflection");
        const shadingModel = scene.shading_models[shading], reflectionModel = scene.reflection_models[reflection];
        return {
            shading, reflection, rate: shadingModel.rate, closed: object.closed,
            uniforms: [
                ["object_color", toUniform(COLOR, settings.get(`object.${i}.color`), isSrgb)],
                ...modelUniforms(settings, reflectionModel, `object.${i}.material.${reflection}.`, "material", isSrgb),
                ...modelUniforms(settings, shadingModel, `object.${i}.shading.${shading}.`, "shading", isSrgb),
            ],
        };
    });
    return { observer: settings.observer(), background: decodeColor(scene.image.background, isSrgb), lights, objects };
}
