// Settings as uniforms of shaders.

function parameterUniforms(settings, parameters, pathOf, nameOf, isSrgb) {
    return parameters
        .filter(({ name }) => settings.find(pathOf(name)) !== null)
        .map((parameter) => [nameOf(parameter.name), uniformOf(parameter, settings.get(pathOf(parameter.name)), isSrgb)]);
}

/// All that the renderer needs to know; `settings` may change afterwards.
function appearanceOf(settings) {
    const { scene } = settings;
    const isSrgb = scene.image.color_management === "srgb";
    const lights = scene.lights.map((light, i) => ({
        switch: light.switch,
        isOn: { kind: "int", value: settings.get(`light.${i}.on`) ? 1 : 0 },
        uniforms: parameterUniforms(
            settings, scene.light_models[light.model].parameters,
            (name) => `light.${i}.value.${name}`, (name) => `${light.uniform}.${name}`, isSrgb,
        ),
    }));
    const objects = scene.objects.map((object, i) => {
        const shading = settings.modelOf(object, "shading"), reflection = settings.modelOf(object, "reflection");
        const s = scene.shading_models[shading], r = scene.reflection_models[reflection];
        return {
            shading, reflection, rate: s.rate, closed: object.closed,
            uniforms: [
                ["object_color", uniformOf(COLOR, settings.get(`object.${i}.color`), isSrgb)],
                ...parameterUniforms(
                    settings, r.parameters, (name) => `object.${i}.material.${reflection}.${name}`, (name) => `material.${name}`, isSrgb,
                ),
                ...parameterUniforms(
                    settings, s.parameters, (name) => `object.${i}.shading.${shading}.${name}`, (name) => `shading.${name}`, isSrgb,
                ),
            ],
        };
    });
    return { observer: settings.observer(), background: decodedColor(scene.image.background, isSrgb), lights, objects };
}
