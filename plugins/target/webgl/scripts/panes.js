import { commonControls } from "./common_controls.js";
import { element, isolated, newId } from "../../../../sdk/web/elements.js";
import { Gestures } from "../../../../sdk/web/gestures.js";
import { layOver, onMoved } from "./overlay.js";
import { disclosure } from "./panels.js";
import { presetChoice } from "./presets.js";
import { displayName } from "../../../../sdk/web/scene.js";
import { areEqual } from "../../../../sdk/web/values.js";

const COUNTS = { one: 1, two: 2, three: 3, four: 4, wipe: 2 };
const LAYOUT_TITLES = { one: "one picture", two: "two pictures", three: "three pictures", four: "four pictures", wipe: "two pictures with a wipe" };
export const PANE_NAMES = ["A", "B", "C", "D"];
const MODELS = ["reflection", "shading"];

/**
 * Pictures of the same view next to the first one, or over a part of it, with their own models and values. A pane takes every
 * other setting from the first, A.
 */
export class Panes {
    /** `change`: gets the views of the others, in Viewport's form. */
    constructor({ settings, picture, controls, onReset, change }) {
        Object.assign(this, { settings, picture, controls, onReset, change });
        this.panes = [];
        this.select = document.getElementById("panes-layout");
        this.share = document.getElementById("panes-share");
        this.section = document.getElementById("panes");
        this.labels = PANE_NAMES.map(() => element("p", { class: "pane-label", "aria-hidden": "true" }));
        this.select.append(...Object.entries(LAYOUT_TITLES).map(([value, text]) => element("option", { value }, text)));
        this.select.addEventListener("change", () => this.choose(this.select.value));
        this.share.addEventListener("input", () => this.place());
        settings.listeners.push((path) => this.changed(path));
        onMoved(picture, picture, () => this.place());
        this.arrange();
    }

    get layout() {
        return this.settings.get("panes");
    }

    /** A pane that opens has a model that no other has, so that there is something to compare. */
    choose(layout) {
        const { settings } = this;
        settings.set("panes", layout);
        for (let i = 1; i < COUNTS[layout]; ++i) {
            const prefix = `pane.${i}.`;
            if ([...settings.changes.keys()].some((path) => path.startsWith(prefix))) continue;
            for (const kind of MODELS) {
                const shown = Array.from({ length: i }, (_, k) => this.modelsIn(k, kind)).flat();
                const other = Object.keys(settings.scene[`${kind}_models`]).find((name) => !shown.includes(name));
                if (other === undefined) continue;
                settings.set(`${prefix}${kind}`, other);
                break;
            }
        }
        settings.notify(null);
    }

    /** The models in use in a pane. */
    modelsIn(index, kind) {
        const settings = this.settings.inPane(index);
        return [...new Set(settings.scene.objects.map((object) => settings.modelOf(object, kind)))];
    }

    /** A short description of a pane's picture. */
    describe(index) {
        const { settings } = this, { scene } = settings, prefix = `pane.${index}.`;
        const models = MODELS.map((kind) => this.modelsIn(index, kind).map((name) => scene[`${kind}_models`][name].title).join(", "));
        const own = [...settings.changes.keys()].filter((path) => path.startsWith(prefix) && !MODELS.includes(path.slice(prefix.length)));
        const values = own.filter((path) => {
            const [, , kind, object, group, model] = path.split(".");
            const isInForce = kind !== "object" || !["material", "shading"].includes(group) || this.modelsIn(index, group === "material" ? "reflection" : "shading").includes(model);
            return isInForce && !areEqual(settings.get(path), settings.get(path.slice(prefix.length))) && object !== undefined;
        });
        const told = values.slice(0, 3).map((path) => `${path.split(".").at(-1)} ${[settings.get(path)].flat().filter((x, i, all) => i === 0 || x !== all[0]).join(", ")}`);
        return [...models, ...told, ...(values.length > 3 ? ["…"] : [])].join(" · ");
    }

    changed(path) {
        const { scene } = this.settings, isArranged = this.arrangement === `${this.layout} ${scene.objects.length}`;
        if (path === null || path === "panes" || !isArranged) this.arrange();
        else if (/(^|\.)(reflection|shading)$/.test(path)) this.fillSection();
        else if (!path.startsWith("pane.")) this.refreshControls();
        this.tell();
    }

    /** Creates the layout's canvases, with their controls. */
    arrange() {
        this.arrangement = `${this.layout} ${this.settings.scene.objects.length}`;
        this.select.value = this.layout;
        const isWipe = this.layout === "wipe", count = COUNTS[this.layout], parent = this.picture.parentElement;
        this.share.parentElement.hidden = !isWipe;
        while (this.panes.length > count - 1) this.panes.pop().canvas.remove();
        while (this.panes.length < count - 1) {
            // The first one's size, not a canvas's default of 300 x 150 until it is drawn on, which would move the page's
            // content.
            const { width, height } = this.picture, canvas = element("canvas", { class: "pane", role: "img", width, height }), index = this.panes.length + 1;
            new Gestures(canvas, this.settings, this.onReset);
            const last = this.panes.at(-1)?.canvas ?? parent.querySelector(".markers") ?? this.picture;
            last.after(canvas);
            this.panes.push({ canvas, index });
        }
        for (const { canvas } of this.panes) {
            canvas.classList.toggle("over", isWipe);
            if (!isWipe) Object.assign(canvas.style, { left: "", top: "", clipPath: "" });
        }
        this.labels.forEach((label, i) => {
            if (i < count && count > 1) parent.append(label);
            else label.remove();
        });
        this.fillSection();
        this.tell();
        this.change(this.panes.map(({ canvas, index }) => ({ canvas, settings: this.settings.inPane(index), isOver: isWipe })));
        this.place();
    }

    /** Names over the pictures, and for assistive technology. */
    tell() {
        if (this.panes.length === 0) return;
        [{ index: 0, canvas: null }, ...this.panes].forEach(({ index, canvas }) => {
            const text = `${PANE_NAMES[index]}: ${this.describe(index)}`;
            this.labels[index].replaceChildren(isolated(text));
            canvas?.setAttribute("aria-label", `Pane ${text}`);
        });
    }

    place() {
        const isWipe = this.layout === "wipe", share = Number(this.share.value);
        for (const { canvas } of this.panes) {
            if (!isWipe) continue;
            layOver(canvas, this.picture);
            canvas.style.clipPath = `inset(0 0 0 ${100 - share}%)`;
        }
        const around = this.picture.parentElement.getBoundingClientRect();
        [this.picture, ...this.panes.map(({ canvas }) => canvas)].forEach((canvas, i) => {
            const box = canvas.getBoundingClientRect(), isRight = isWipe && i === 1;
            Object.assign(this.labels[i].style, {
                left: isRight ? "" : `${box.left - around.left}px`, right: isRight ? `${around.right - box.right}px` : "",
                bottom: `${around.bottom - box.bottom}px`, maxWidth: `${isWipe ? box.width / 2 : box.width}px`,
            });
        });
    }

    fillSection() {
        this.section.hidden = this.panes.length === 0;
        const wereOpen = new Set([...this.section.querySelectorAll("details[open]")].map(({ dataset }) => dataset.part));
        const focused = document.activeElement?.closest?.("#panes .setting")?.dataset.path;
        const part = (name, details) => {
            details.dataset.part = name;
            if (wereOpen.has(name)) details.open = true;
            return details;
        };
        this.section.replaceChildren(element("h2", {}, "Panes"), element("p", { class: "about" }, "Settings that differ from picture A; all other controls belong to A."),
            ...this.panes.map(({ index }) => this.paneSection(index, part)));
        if (focused) [...this.section.querySelectorAll(".setting")].find(({ dataset }) => dataset.path === focused)?.querySelector("select, input")?.focus();
    }

    paneSection(index, part) {
        const { settings, controls } = this, { scene } = settings, prefix = `pane.${index}.`;
        const title = (text) => element("span", { class: "title" }, text);
        const models = MODELS.map((kind) => controls.choice(prefix + kind, `${kind === "reflection" ? "Reflection" : "Shading"} model of ${PANE_NAMES[index]}`,
            (name) => (name === "" ? "As in the scene" : scene[`${kind}_models`][name].title)));
        const own = settings.inPane(index);
        const objects = scene.objects.map((object, i) => part(`${index} ${i}`, disclosure([title(isolated(displayName(object.label, "object", i)))], false, () => {
            const of = (kind, group) => {
                const model = own.modelOf(object, kind);
                return scene[`${kind}_models`][model].parameters.map(({ name }) => controls.of(`${prefix}object.${i}.${group}.${model}.${name}`, name));
            };
            const chosen = presetChoice(settings, `${prefix}object.${i}.`, own.modelOf(object, "reflection"));
            const common = commonControls(settings, controls, prefix, i, own.modelOf(object, "shading"));
            return [chosen, controls.of(`${prefix}object.${i}.color`, "color"), ...of("reflection", "material"), ...common, ...of("shading", "shading")]
                .filter((control) => control !== null);
        })));
        return element("div", { class: "pane-controls", role: "group", "aria-label": `Pane ${PANE_NAMES[index]}` }, ...models, ...objects);
    }

    /** Controls that follow A show its values. */
    refreshControls() {
        for (const control of this.section.querySelectorAll(".setting")) control.refresh();
    }
}
