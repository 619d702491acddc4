import { element, newId } from "../../../../sdk/web/elements.js";
import { announce } from "./messages.js";
import { areEqual, canonicalValue } from "../../../../sdk/web/values.js";

/**
 * A choice among the presets of an object's reflection model, such as materials; null if there are none. `prefix`: of the
 * object's paths. It sets the same values as the sliders, and shows the preset that matches all of them.
 */
export function presetChoice(settings, prefix, reflection) {
    const { presets, parameters } = settings.scene.reflection_models[reflection];
    if (presets.length === 0) return null;
    const settingsOf = ({ values, color }) => [
        ...Object.entries(values).map(([name, value]) =>
            [`${prefix}material.${reflection}.${name}`, canonicalValue(parameters.find((p) => p.name === name), value)]),
        ...(color === null ? [] : [[`${prefix}color`, color]]),
    ].filter(([path]) => settings.find(path) !== null);  // pictures give the others
    const isInForce = (preset) => settingsOf(preset).every(([path, value]) => areEqual(settings.get(path), value));
    const id = newId("preset"), source = element("p", { class: "meaning", id: newId("meaning") });
    const select = element("select", { id, "aria-describedby": source.id }, element("option", { value: "" }, "custom"),
        ...presets.map(({ name }, i) => element("option", { value: i }, name)));
    select.addEventListener("change", () => {
        if (select.value === "") return;
        const preset = presets[Number(select.value)];
        for (const [path, value] of settingsOf(preset)) settings.set(path, value);
        settings.notify(prefix);
        announce(`The values are those of ${preset.name}.`);
    });
    const row = element("div", { class: "preset" }, element("label", { class: "name", for: id }, "preset"), select, source);
    row.refresh = () => {
        const found = presets.findIndex(isInForce);
        select.value = found < 0 ? "" : found;
        source.textContent = found < 0 ? "" : presets[found].source;
    };
    row.refresh();
    return row;
}

/** Makes the choices follow the values. */
export function followPresets(settings) {
    settings.listeners.push(() => {
        for (const row of document.querySelectorAll(".preset")) row.refresh();
    });
}
