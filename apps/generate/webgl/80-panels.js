// What stands beside the picture: models and their formulas, objects, lights, the observer.

const OPEN_AT_FIRST = 2;

/// A part that folds. Its contents are made when it is first opened, since scenes may have many.
function folded(summary, isOpen, contents) {
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

class Panels {
    constructor(settings, controls) {
        this.settings = settings;
        this.scene = settings.scene;
        this.controls = controls;
        this.folds = [];
        settings.listeners.push((path, byHand) => this.changed(path, byHand));
    }

    build() {
        this.fillModels(document.getElementById("models"));
        this.fillFormulas();
        this.fill("objects", this.scene.objects, (object, i) => this.objectFold(object, i));
        this.fill("lights", this.scene.lights, (light, i) => this.lightFold(light, i));
        const observer = this.settings.observerParameters();
        document.getElementById("observer").append(
            folded([element("span", { class: "title" }, "Observer")], false, () =>
                observer.map(({ name }) => this.controls.of(`observer.${name}`, name))));
    }

    fill(id, things, make) {
        const section = document.getElementById(id);
        section.hidden = things.length === 0;
        section.querySelector(".count").textContent = things.length > 1 ? String(things.length) : "";
        section.append(...things.map(make));
    }

    modelTitle(kind, name) {
        const own = new Set(this.scene.objects.map((object) => object[kind]));
        const models = this.scene[`${kind}_models`];
        if (name !== "") return models[name].title;
        return own.size === 1 ? `As the scene says (${models[[...own][0]].title})` : "As the scene says";
    }

    fillModels(section) {
        const select = (kind, title) => this.controls.choice(kind, title, (name) => this.modelTitle(kind, name));
        section.append(select("shading", "Shading model"), select("reflection", "Reflection model"));
    }

    /// Every model in force, once; those of the most objects first.
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
            const lines = model.formula.split("\n").map((text) => {
                const line = element("span", { class: "formula-line" }, text + "\n");
                line.style.setProperty("--indent", text.search(/\S|$/) + 4);
                return line;
            });
            return folded(
                [element("span", { class: "title" }, model.title), element("span", { class: "tag" }, kind)],
                isOpen,
                () => [
                    element("p", { class: "about" }, model.summary),
                    model.formula === "" ? null : element("pre", { class: "formula" }, ...lines),
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

    objectFold(object, i) {
        const { settings, controls } = this;
        const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
        const models = element("span", { class: "tag" });
        const fold = folded(
            [swatch, element("span", { class: "title" }, label(shownLabel(object.label, "object", i))), models],
            i < OPEN_AT_FIRST && this.scene.objects.length <= 3 * OPEN_AT_FIRST,
            () => {
                const shading = settings.modelOf(object, "shading"), reflection = settings.modelOf(object, "reflection");
                const of = (kind, model, values) => this.scene[`${kind}_models`][model].parameters.map(({ name }) =>
                    controls.of(`object.${i}.${values}.${model}.${name}`, name));
                return [
                    controls.of(`object.${i}.color`, "color"),
                    ...of("reflection", reflection, "material"),
                    ...of("shading", shading, "shading"),
                ].filter((control) => control !== null);
            },
        );
        fold.show = () => {
            swatch.style.backgroundColor = hexOf(settings.get(`object.${i}.color`));
            models.textContent = ["reflection", "shading"]
                .map((kind) => this.scene[`${kind}_models`][settings.modelOf(object, kind)].title).join(" · ");
        };
        return this.named(fold, shownLabel(object.label, "object", i), `object.${i}.`);
    }

    lightFold(light, i) {
        const { settings, controls } = this;
        const model = this.scene.light_models[light.model];
        const name = shownLabel(light.label, "light", i);
        const color = model.parameters.find(({ type }) => type === "color");
        const swatch = element("span", { class: "swatch round", "aria-hidden": "true" });
        const fold = folded(
            [swatch, element("span", { class: "title" }, label(name)), element("span", { class: "tag" }, model.title)],
            i < OPEN_AT_FIRST && this.scene.lights.length <= 3 * OPEN_AT_FIRST,
            () => model.parameters.map((p) => controls.of(`light.${i}.value.${p.name}`, p.name)).filter((control) => control !== null),
        );
        // Beside the summary, not in it: a control inside of a control cannot be reached by everybody.
        const isLit = controls.boolean(`light.${i}.on`, `${name} is on`);
        isLit.classList.add("switch");
        fold.show = () => {
            const path = `light.${i}.value.${color?.name}`;
            if (color && settings.find(path)) swatch.style.backgroundColor = hexOf(settings.get(path));
            fold.classList.toggle("dark", !settings.get(`light.${i}.on`));
        };
        return element("div", { class: "light" }, isLit, this.named(fold, name, `light.${i}.`));
    }

    /// `prefix`: of the paths of its settings.
    named(fold, name, prefix) {
        fold.querySelector(".body").setAttribute("role", "group");
        fold.querySelector(".body").setAttribute("aria-label", name);
        this.folds.push({ fold, prefix });
        fold.show();
        return fold;
    }

    changed(path, byHand) {
        const isOfModels = path === null || path === "shading" || path === "reflection";
        for (const { fold, prefix } of this.folds) {
            // Other models have other parameters; the select that chose them is elsewhere and keeps the focus.
            if (isOfModels && prefix.startsWith("object.")) fold.refill();
            if (isOfModels || path.startsWith(prefix)) fold.show();
        }
        if (isOfModels) this.fillFormulas();
        if (byHand) return;
        const isTouched = (control) => path === null || control.dataset.path.startsWith(path);
        for (const control of document.querySelectorAll(".setting")) {
            if (isTouched(control)) control.refresh();
        }
    }
}
