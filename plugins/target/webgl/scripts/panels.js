import { commonControls, givenByPictures } from "./common_controls.js";
import { toHex } from "../../../../sdk/web/colors.js";
import { element, isolated } from "../../../../sdk/web/elements.js";
import { EXPOSURE_PATH, TONE_PATH } from "./parameters.js";
import { followPresets, presetChoice } from "./presets.js";
import { displayName } from "../../../../sdk/web/scene.js";
import { formulaLines } from "./formulas/typeset.js";

const INITIALLY_OPEN = 2;

/** A <details> whose contents are made when it is first opened, since a scene may have many. */
export function disclosure(summary, isOpen, contents) {
    const body = element("div", { class: "body" });
    const details = element("details", { open: isOpen }, element("summary", {}, ...summary), body);
    const fill = () => {
        if (details.open && body.childElementCount === 0) body.append(...contents());
    };
    details.addEventListener("toggle", fill);
    details.refill = () => {
        body.replaceChildren();
        fill();
    };
    fill();
    return details;
}

/** The data that determine which panels and controls exist, but not their values. */
function structureOf(scene) {
    const shown = ({ title, summary, formula, reference, parameters, presets }) => [title, summary, formula, reference, parameters, presets];
    const models = ["light_models", "shading_models", "reflection_models"]
        .map((kind) => Object.entries(scene[kind]).map(([name, model]) => [name, shown(model)]));
    const objects = scene.objects.map(({ label, shading, reflection }) => [label, shading, reflection]);
    const lights = scene.lights.map(({ label, model }) => [label, model]);
    return JSON.stringify([models, objects, lights, scene.observer.projection]);
}

/** The controls next to the picture: models and their formulas, objects, lights, the observer. */
export class Panels {
    constructor(settings, controls) {
        this.settings = settings;
        this.controls = controls;
        this.sections = [];
        settings.listeners.push((path, isFromControl) => this.changed(path, isFromControl));
        followPresets(settings);
    }

    get scene() {
        return this.settings.scene;
    }

    /** Called after another scene has arrived: restores the open panels and the focus as far as they still exist. */
    rebuild() {
        const summaryOf = (details) => details.querySelector("summary").textContent;
        const panels = [...document.querySelectorAll("aside > section:not(#explanation, #panes, #formula-editor)")];
        const details = () => panels.flatMap((panel) => [...panel.querySelectorAll("details")]);
        const wereOpen = new Map(details().map((one) => [summaryOf(one), one.open]));
        const focused = document.activeElement, path = focused?.closest(".setting")?.dataset.path;
        const place = path && [...focused.closest(".setting").querySelectorAll("input, select, button")].indexOf(focused);
        if (structureOf(this.scene) === this.structure) {
            this.refill();
        } else {
            this.sections = [];
            for (const panel of panels) panel.replaceChildren(...[...panel.children].filter(({ tagName }) => tagName === "H2"));
            this.build();
            for (const one of details()) one.open = wereOpen.get(summaryOf(one)) ?? one.open;
        }
        const again = path && !focused.isConnected && [...document.querySelectorAll(".setting")].find((setting) => setting.dataset.path === path);
        if (again) [...again.querySelectorAll("input, select, button")][place]?.focus();
    }

    /** Rebuilds only the controls whose part of the scene has changed: layout takes a browser longer than anything else here. */
    refill() {
        for (const one of this.sections) {
            const content = JSON.stringify(one.contentOf());
            if (content !== one.content) one.section.refill();
            one.content = content;
            one.section.show?.();
        }
        this.refreshControls(null);
        for (const row of document.querySelectorAll(".preset")) row.refresh();
    }

    build() {
        this.structure = structureOf(this.scene);
        this.fillModels(document.getElementById("models"));
        this.fillFormulas();
        this.fill("objects", this.scene.objects, (object, i) => this.objectSection(object, i));
        this.fill("lights", this.scene.lights, (light, i) => this.lightSection(light, i));
        const observer = disclosure([element("span", { class: "title" }, "Observer")], false, () =>
            [
                ...this.settings.observerParameters().map(({ name }) => this.controls.of(`observer.${name}`, name)),
                this.controls.of(EXPOSURE_PATH, "exposure"),
                this.controls.of(TONE_PATH, "tone"),
            ]);
        document.getElementById("observer").append(observer);
        this.follow(observer, "observer.", () => [this.scene.observer, this.scene.image.exposure, this.scene.image.tone]);
    }

    fill(id, items, make) {
        const section = document.getElementById(id);
        section.hidden = items.length === 0;
        section.querySelector(".count").textContent = items.length > 1 ? String(items.length) : "";
        section.append(...items.map(make));
    }

    modelTitle(kind, name) {
        const own = new Set(this.scene.objects.map((object) => object[kind]));
        const models = this.scene[`${kind}_models`];
        if (name !== "") return models[name].title;
        return own.size === 1 ? `As in the scene (${models[[...own][0]].title})` : "As in the scene";
    }

    fillModels(section) {
        const select = (kind, title) => this.controls.choice(kind, title, (name) => this.modelTitle(kind, name));
        section.append(select("shading", "Shading model"), select("reflection", "Reflection model"));
    }

    /** The names of all models in use, by the number of objects that use them, most first. */
    modelsInForce(kind) {
        const uses = new Map();
        for (const object of this.scene.objects) {
            const name = this.settings.modelOf(object, kind);
            uses.set(name, (uses.get(name) ?? 0) + 1);
        }
        return [...uses.keys()].sort((a, b) => uses.get(b) - uses.get(a));
    }

    fillFormulas() {
        const formula = (kind, name, isOpen) => {
            const model = this.scene[`${kind}_models`][name];
            return disclosure(
                [element("span", { class: "title" }, model.title), element("span", { class: "tag" }, kind)],
                isOpen,
                () => [
                    element("p", { class: "about" }, model.summary),
                    model.formula === "" ? null : element("div", { class: "formula", tabIndex: 0, role: "group", "aria-label": `Formula of ${model.title}` }, ...formulaLines(model)),
                    model.reference === "" ? null : element("p", { class: "reference" }, model.reference),
                ].filter((part) => part !== null),
            );
        };
        const shadings = this.modelsInForce("shading"), reflections = this.modelsInForce("reflection");
        document.getElementById("formulas").replaceChildren(
            ...reflections.map((name, i) => formula("reflection", name, i === 0)),
            ...shadings.map((name) => formula("shading", name, false)),
        );
    }

    objectSection(object, i) {
        const { settings, controls } = this;
        const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
        const models = element("span", { class: "tag" });
        const section = disclosure(
            [swatch, element("span", { class: "title" }, isolated(displayName(object.label, "object", i))), models],
            i < INITIALLY_OPEN && this.scene.objects.length <= 3 * INITIALLY_OPEN,
            () => {
                const shading = settings.modelOf(object, "shading"), reflection = settings.modelOf(object, "reflection");
                const of = (kind, model, values) => this.scene[`${kind}_models`][model].parameters.map(({ name }) =>
                    controls.of(`object.${i}.${values}.${model}.${name}`, name));
                return [
                    presetChoice(settings, `object.${i}.`, reflection),
                    controls.of(`object.${i}.color`, "color"),
                    givenByPictures(this.scene.objects[i], reflection),
                    ...of("reflection", reflection, "material"),
                    ...commonControls(settings, controls, "", i, shading),
                    ...of("shading", shading, "shading"),
                ].filter((control) => control !== null);
            },
        );
        section.show = () => {
            swatch.style.backgroundColor = toHex(this.scene.objects[i].is_color_textured ? this.scene.objects[i].color : settings.get(`object.${i}.color`));
            models.textContent = ["reflection", "shading"]
                .map((kind) => this.scene[`${kind}_models`][settings.modelOf(object, kind)].title).join(" · ");
        };
        const contentOf = () => {
            const { color, materials, shadings, is_color_textured, textured, emission_strength, opacity, opacity_cutoff, opacity_map, normal_scale } = this.scene.objects[i];
            return [color, materials, shadings, is_color_textured, textured, emission_strength, opacity, opacity_cutoff, opacity_map, normal_scale];
        };
        return this.register(section, displayName(object.label, "object", i), `object.${i}.`, contentOf);
    }

    lightSection(light, i) {
        const { settings, controls } = this;
        const model = this.scene.light_models[light.model];
        const name = displayName(light.label, "light", i);
        const color = model.parameters.find(({ type }) => type === "color");
        const swatch = element("span", { class: "swatch round", "aria-hidden": "true" });
        const section = disclosure(
            [swatch, element("span", { class: "title" }, isolated(name)), element("span", { class: "tag" }, model.title)],
            i < INITIALLY_OPEN && this.scene.lights.length <= 3 * INITIALLY_OPEN,
            () => model.parameters.map((p) => controls.of(`light.${i}.value.${p.name}`, p.name)).filter((control) => control !== null),
        );
        // Next to the summary, not in it: assistive technology cannot reach a control within a control.
        const lightSwitch = controls.boolean(`light.${i}.on`, `${name} is on`);
        lightSwitch.classList.add("switch");
        section.show = () => {
            const path = `light.${i}.value.${color?.name}`;
            if (color && settings.find(path)) swatch.style.backgroundColor = toHex(settings.get(path));
            section.classList.toggle("dark", !settings.get(`light.${i}.on`));
        };
        return element("div", { class: "light" }, lightSwitch, this.register(section, name, `light.${i}.`, () => this.scene.lights[i].values));
    }

    /** `prefix`: of the paths of the section's settings. `contentOf`: returns the scene's data for them. */
    register(section, name, prefix, contentOf) {
        section.querySelector(".body").setAttribute("role", "group");
        section.querySelector(".body").setAttribute("aria-label", name);
        this.follow(section, prefix, contentOf);
        section.show();
        return section;
    }

    follow(section, prefix, content) {
        // The sliders cover the extent of the scene.
        const contentOf = () => [content(), this.controls.extent];
        this.sections.push({ section, prefix, contentOf, content: JSON.stringify(contentOf()) });
    }

    changed(path, isFromControl) {
        const isModelChange = path === null || path === "shading" || path === "reflection";
        for (const { section, prefix } of this.sections) {
            // Other models have other parameters. The select that chose the model is elsewhere, so it keeps the focus.
            if (isModelChange && prefix.startsWith("object.")) section.refill();
            if (isModelChange || path.startsWith(prefix)) section.show?.();
        }
        if (isModelChange) this.fillFormulas();
        if (!isFromControl) this.refreshControls(path);
    }

    /** Refreshes the controls of settings whose path begins so; null stands for any. */
    refreshControls(path) {
        const isAffected = (control) => path === null || control.dataset.path.startsWith(path);
        for (const control of document.querySelectorAll(".setting")) {
            if (isAffected(control)) control.refresh();
        }
    }
}
