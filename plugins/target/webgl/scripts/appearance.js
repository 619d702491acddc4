import { decodeColor } from "../../../../sdk/web/colors.js";
import { COLOR, EXPOSURE_PATH, SHADOWS_PATH, TONE, TONE_PATH } from "./parameters.js";
import { canonicalValue } from "../../../../sdk/web/values.js";
import { normalize, scale } from "../../../../sdk/web/vectors.js";

/** A parameter's value for a shader: { kind: "int" | "float" | "vec3", value }, angles in radians. */
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

/** A member that no setting changes, as pairs of a uniform's name and value: a matrix, or the place and size of a table. */
function fixedUniforms(name, { kind, value }) {
    if (kind !== "table") return [[name, { kind, value }]];
    return ["first", "count"].map((part, i) => [`${name}.${part}`, { kind: "int", value: value[i] }]);
}

/**
 * Pairs of a uniform's name and value: the setting `${prefix}${name}` becomes the member `${struct}.${name}`, as do the `fixed`
 * members. `values`: the scene's own.
 */
function modelUniforms(settings, model, prefix, { fixed, values }, struct, isSrgb) {
    // A parameter that pictures give has the value without them.
    const valueOf = (parameter) => {
        const own = values?.[parameter.name] ?? null;
        if (settings.find(prefix + parameter.name) !== null) return settings.get(prefix + parameter.name);
        return own === null ? null : canonicalValue(parameter, own);
    };
    const adjustable = model.parameters
        .map((parameter) => [parameter, valueOf(parameter)])
        .filter(([, value]) => value !== null)
        .map(([parameter, value]) => [`${struct}.${parameter.name}`, toUniform(parameter, value, isSrgb)]);
    return [...adjustable, ...Object.entries(fixed).flatMap(([name, value]) => fixedUniforms(`${struct}.${name}`, value))];
}

/** The members of a light's struct, in their order: a value for each texel. In a scene with mirror images or shadows, they end with the light's. */
function structMembers(settings, model, prefix, { fixed, radiance, shadows }, isSrgb) {
    const members = model.block.members.flatMap((name) => {
        const parameter = model.parameters.find((p) => p.name === name);
        if (parameter) return [toUniform(parameter, settings.get(prefix + name), isSrgb)];
        const { kind, value } = fixed[name];
        return kind === "mat3" ? [0, 3, 6].map((i) => ({ kind: "vec3", value: value.slice(i, i + 3) })) : [{ kind: kind === "table" ? "int" : kind, value }];
    });
    return [...members, ...[radiance, shadows].filter((texel) => texel).map((value) => ({ kind: "vec3", value }))];
}

/** The values of an object's material that a reflection model reads, whether or not it is the object's own model. */
export function materialUniforms(settings, index, reflection) {
    const { scene } = settings, isSrgb = scene.image.color_management === "srgb";
    return modelUniforms(settings, scene.reflection_models[reflection], `object.${index}.material.${reflection}.`,
        { fixed: scene.objects[index].fixed.material[reflection], values: scene.objects[index].materials[reflection] }, "material", isSrgb);
}

/** A setting's value as a factor of the scene's own; 1 if there is none. */
function factorOf(settings, path) {
    const found = settings.find(path);
    return found === null ? 1 : settings.get(path) / found.initial;
}

/** The opacity of an object that no picture gives. */
const opacityOf = (settings, i, { opacity }) => (settings.find(`object.${i}.common.opacity`) === null ? opacity : settings.get(`object.${i}.common.opacity`));

/** The uniforms of emission, occlusion, opacity and tilted normals, in a scene where objects have it. */
function commonUniforms(settings, i, object) {
    const { emission, occlusion, opacity_cutoff, normal_scale } = object, opacity = opacityOf(settings, i, object);
    const strength = factorOf(settings, `object.${i}.common.emission_strength`);
    return [
        ...(emission ? [["object_emission", { kind: "vec3", value: scale(emission, strength) }]] : []),
        ...(occlusion !== undefined ? [["object_occlusion", { kind: "float", value: occlusion }]] : []),
        ...(opacity !== undefined ? [["object_opacity", { kind: "float", value: opacity }], ["object_opacity_cutoff", { kind: "float", value: opacity_cutoff }]] : []),
        ...(normal_scale ? [["normal_scale", { kind: "float", value: factorOf(settings, `object.${i}.${normal_scale.path}`) }]] : []),
    ];
}

/** The factor of intensities: 1 / (1.2 · 2^EV), or the scene's own. */
function exposureFactor(settings) {
    const value = settings.get(EXPOSURE_PATH);
    return value === settings.find(EXPOSURE_PATH).initial ? settings.scene.image.exposure_factor : 1 / (1.2 * 2 ** value);
}

/** A snapshot of the settings for the renderer, so that they may change while it refines a picture. */
export function appearanceOf(settings) {
    const { scene } = settings;
    const isSrgb = scene.image.color_management === "srgb";
    const lights = scene.lights
        .map((light, i) => ({ light, isOn: settings.get(`light.${i}.on`), prefix: `light.${i}.value.` }))
        .filter(({ isOn }) => isOn)
        .map(({ light, prefix }) =>
            ({ model: light.model, members: structMembers(settings, scene.light_models[light.model], prefix, light, isSrgb) }));
    const hasShadows = settings.find(SHADOWS_PATH) !== null && settings.get(SHADOWS_PATH);
    const objects = scene.objects.map((object, i) => {
        const shading = settings.modelOf(object, "shading"), reflection = settings.modelOf(object, "reflection");
        const shadingModel = scene.shading_models[shading];
        const material = reflection === object.reflection ? object.material : object.common_material;
        return {
            shading, reflection, rate: shadingModel.rate, seesTriangle: shadingModel.sees_triangle, closed: object.closed,
            material, normalMap: object.normal_map, opacityMap: object.opacity_map, opacityChannel: object.opacity_channel,
            opacity: opacityOf(settings, i, object),
            isTextured: [material, object.normal_map, object.opacity_map].some((text) => text !== null),
            uniforms: [
                ["object_index", { kind: "int", value: i }],
                ["is_shadowed", { kind: "int", value: hasShadows && object.receives_shadows ? 1 : 0 }],
                ["blocks_both_sides", { kind: "int", value: object.is_solid ? 0 : 1 }],
                ["object_middle", { kind: "vec3", value: object.middle ?? [0, 0, 0] }],
                ["object_color", toUniform(COLOR, object.is_color_textured ? object.color : settings.get(`object.${i}.color`), isSrgb)],
                ...commonUniforms(settings, i, object),
                ...materialUniforms(settings, i, reflection),
                ...modelUniforms(
                    settings, shadingModel, `object.${i}.shading.${shading}.`, { fixed: object.fixed.shading[shading] }, "shading", isSrgb),
            ],
        };
    });
    const exposure = exposureFactor(settings);
    return {
        observer: settings.observer(), exposure, tone: TONE.choices.indexOf(settings.get(TONE_PATH)), lights, objects,
        // Shown as it is written, whatever the exposure.
        background: scale(decodeColor(scene.image.background, isSrgb), 1 / exposure),
    };
}
