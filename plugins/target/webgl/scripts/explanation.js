import { arrowLayer, drawArrows } from "./arrows.js";
import { element, isolated, newId } from "../../../../sdk/web/elements.js";
import { encodingAt, formulaAt, sumAt } from "./formulas/formula_numbers.js";
import { Lobes } from "./lobes/lobes.js";
import { announce } from "./messages.js";
import { queryOf } from "./options.js";
import { layOver, onMoved } from "./overlay.js";
import { PANE_NAMES } from "./panes.js";
import { nameOf } from "../../../../sdk/web/scene.js";
import { add, scale } from "../../../../sdk/web/vectors.js";

const CLICK_DISTANCE = 4;  // in CSS pixels: a pointer that moves farther turns the scene
const VECTORS = ["N", "V", "L", "R", "H"];

const number = (x) => (x === 0 ? "0" : String(Number(x.toPrecision(6))));
const numbers = (values) => (Array.isArray(values) ? values.map(number).join(", ") : number(values));
const row = (name, ...cells) => element("tr", {}, element("th", { scope: "row" }, name), ...cells.map((cell) => element("td", {}, cell)));
const head = (...names) => element("thead", {}, element("tr", {}, ...names.map((name) => element(name === "" ? "td" : "th", name === "" ? {} : { scope: "col" }, name))));
const table = (caption, columns, rows) => element("table", {}, element("caption", {}, caption), head("", ...columns), element("tbody", {}, ...rows));

const vectorsOf = (point, light) => VECTORS.map((name) => [name, point[name] ?? light[name]]).filter(([, vector]) => vector);

function steps(title, list) {
    if (list.length === 0) return null;
    const lines = list.map(({ kind, name, text, value, depth, file, line }) => {
        const said = kind === "function" ? [element("span", { class: "step-place" }, `${file}:${line} `), `${name}()`]
            : [element("b", {}, `${kind === "result" ? "result" : name} = ${numbers(value)}`),
               kind === "argument" ? null : element("span", { class: "step-text" }, text)];
        const result = element("li", {}, ...said.filter((part) => part !== null));
        result.style.setProperty("--depth", depth);
        return result;
    });
    return element("details", {}, element("summary", {}, title), element("ol", { class: "steps" }, ...lines));
}

/**
 * Explains a pixel that is clicked or given by its coordinates: the output of `candela explain`, with its vectors as arrows in
 * the picture. Available only if `candela view` serves the page, since the explanation comes from there.
 */
export class Explanation {
    /** `renderer`: returns the page's current renderer. */
    constructor(settings, canvas, renderer) {
        Object.assign(this, { allSettings: settings, first: canvas, request: 0 });
        const byId = (id) => document.getElementById(id);
        Object.assign(this, { section: byId("explanation"), x: byId("explanation-x"), y: byId("explanation-y"), result: byId("explanation-result"), closing: byId("explanation-close"), arrows: arrowLayer(), pane: byId("explanation-pane") });
        this.lobes = new Lobes(settings, canvas, renderer);
        canvas.parentElement.append(this.arrows);
        this.section.hidden = false;
        byId("explanation-form").addEventListener("submit", (event) => {
            event.preventDefault();
            this.explain(Number(this.x.value), Number(this.y.value));
        });
        this.closing.addEventListener("click", () => this.clear());
        this.section.addEventListener("keydown", (event) => {
            if (event.key === "Escape") this.clear();
        });
        let from = null;
        const area = canvas.parentElement;
        area.addEventListener("pointerdown", (event) => { from = event.isPrimary && event.button === 0 ? [event.clientX, event.clientY] : null; });
        area.addEventListener("click", (event) => {
            const pane = this.pictures().indexOf(event.target);
            if (pane >= 0 && from !== null && Math.hypot(event.clientX - from[0], event.clientY - from[1]) <= CLICK_DISTANCE) this.explainAt(pane, event);
        });
        onMoved(this.arrows, canvas, () => this.placeArrows());
        settings.listeners.push(() => this.clear());
        this.fit();
    }

    /** The picture of the first pane, and those of the others. */
    pictures() {
        return [this.first, ...this.first.parentElement.querySelectorAll("canvas.pane")];
    }

    /** Called when there may be other pictures, or pictures of another size. */
    fit() {
        const { width, height } = this.allSettings.scene.image, count = this.pictures().length;
        this.x.max = width - 1;
        this.y.max = height - 1;
        if (count !== this.pane.options.length) this.pane.replaceChildren(...PANE_NAMES.slice(0, count).map((name, i) => element("option", { value: i }, name)));
        this.pane.parentElement.hidden = count === 1;
        this.use(Number(this.pane.value));
    }

    /** From now on explains that pane's picture, with the values that it shows. */
    use(pane) {
        this.pane.value = pane;
        Object.assign(this, { settings: this.allSettings.inPane(pane), canvas: this.pictures()[pane] });
        this.lobes.use(this.settings, this.canvas);
    }

    /** Called when the picture no longer shows the explained state. */
    clear() {
        this.request += 1;
        this.fit();
        this.arrows.replaceChildren();
        this.lobes.clear();
        this.result.replaceChildren();
        this.closing.hidden = true;
    }

    explainAt(pane, { clientX, clientY }) {
        const box = this.pictures()[pane].getBoundingClientRect();  // before a change triggers a new layout of the page
        this.pane.value = pane;
        this.fit();
        const { width, height } = this.settings.scene.image;
        const pixel = (at, begin, size, count) => Math.max(0, Math.min(count - 1, Math.floor(((at - begin) / size) * count)));
        this.explain(pixel(clientX, box.left, box.width, width), pixel(clientY, box.top, box.height, height));
    }

    async explain(x, y) {
        this.clear();
        const { request } = this;
        [this.x.value, this.y.value] = [x, y];
        this.result.append(element("p", {}, "Candela explains …"));
        let explanation = null, problem = "";
        try {
            const changes = queryOf(this.allSettings, Number(this.pane.value));
            const response = await fetch(`explanation.json?pixel=${x}%2C${y}${changes === "" ? "" : `&${changes}`}`);
            if (response.ok) explanation = await response.json();
            else problem = await response.text();
        } catch (error) {
            problem = error.message;
        }
        if (request !== this.request) return;
        this.closing.hidden = false;
        if (explanation === null) this.result.replaceChildren(element("pre", { class: "plain-problem", tabIndex: 0 }, problem));
        else this.show(explanation);
    }

    show(explanation) {
        const { bytes, fragments } = explanation, [x, y] = explanation.pixel;
        const pixel = `${this.pictures().length === 1 ? "Pixel" : `Pane ${PANE_NAMES[this.pane.value]}, pixel`} ${x}, ${y}`;
        this.result.replaceChildren(element("p", {}, `${pixel}: `, element("b", { class: "bytes" }, bytes.join(", "))), this.pixelTable(explanation), encodingAt(explanation));
        if (explanation.note) this.result.append(element("p", { class: "reference" }, explanation.note));
        const shown = element("div");
        if (fragments.length === 0) this.result.append(element("p", {}, "No object here: this is the background."));
        else this.result.append(...this.choice("Triangle", fragments.map((f) => `${nameOf(f.object)}, triangle ${f.triangle} (${number(100 * f.weight)} %)`), (i) => shown.replaceChildren(...this.fragmentParts(fragments[i]))), shown);
        announce(`${pixel} is explained: ${bytes.join(", ")}.`);
    }

    pixelTable({ I, toned, tone, encoded, bytes, color_management: management }) {
        const channels = ["red", "green", "blue"], tonedHeads = toned ? [tone === "none" ? "exposed" : `exposed, ${tone}`] : [];
        return table("From the intensity to the byte", ["I", ...tonedHeads, management === "srgb" ? "sRGB" : "clamped", "× 255", "byte"],
            channels.map((name, c) => row(name, number(I[c]), ...(toned ? [number(toned[c])] : []), number(encoded[c]), (255 * encoded[c]).toFixed(2), String(bytes[c]))));
    }

    /** A choice among several, or nothing for one; `pick` is called for the first. */
    choice(label, names, pick) {
        pick(0);
        if (names.length === 1) return [];
        const id = newId("choice"), select = element("select", { id }, ...names.map((name, i) => element("option", { value: i }, name)));
        select.addEventListener("change", () => pick(Number(select.value)));
        return [element("label", { for: id }, label), select];
    }

    fragmentParts(fragment) {
        const shown = element("div"), { points } = fragment;
        const about = element("p", {}, isolated(nameOf(fragment.object)), `, triangle ${fragment.triangle}, barycentric ${numbers(fragment.barycentric)}; lit per ${fragment.shaded_per} (`,
            isolated(fragment.shading), ")");
        const choice = this.choice("Point", points.map((_, i) => (points.length === 3 ? `vertex ${i + 1}` : "the point")), (i) => shown.replaceChildren(...this.pointParts(fragment, points[i])));
        return [about, ...choice, shown];
    }

    pointParts(fragment, point) {
        const shown = element("div"), name = ({ light, sample }) => nameOf(light) + (sample > 0 ? `, sample ${sample + 1}` : "");
        const choice = this.choice("Light", point.lights.map(name), (i) => shown.replaceChildren(...this.lightParts(fragment, point, point.lights[i])));
        const sums = table("All lights", ["red", "green", "blue"], ["I_a", "I_d", "I_s", "I"].map((sum) => row(sum, ...point[sum].map(number))));
        if (point.lights.length === 0) this.drawVectors(point, vectorsOf(point, {}));
        return [steps("How N is found", point.normal_steps), ...choice, shown, sumAt(point), sums].filter((part) => part !== null);
    }

    lightParts(fragment, point, light) {
        const vectors = vectorsOf(point, light);
        const { blocked_by: blocker, visibility } = light;
        this.drawVectors(point, vectors, blocker ? add(point.position, scale(light.L, blocker.distance)) : null);
        const arriving = light.ambient ? [["arriving", light.ambient]] : [["arriving, diffuse", light.diffuse], ["arriving, specular", light.specular]];
        return [
            table("Unit vectors", ["x", "y", "z"], vectors.map(([name, vector]) => row(name, ...vector.map(number)))),
            ...this.lobes.parts(fragment.index, point, light),
            element("p", {}, `C_o = ${numbers(point.C_o)}`),
            ...this.formulas(fragment.index, point, light),
            "N.L" in light ? element("p", {}, `N·L = ${number(light["N.L"])}`) : null,
            visibility ? element("p", { class: "visibility" }, blocker ? `Blocked by ${nameOf(blocker.object)}, triangle ${blocker.triangle}, at ${number(blocker.distance)} m` : `Visibility ${numbers(visibility)}`) : null,
            table(`Light: ${nameOf(light.light)}`, ["red", "green", "blue"],
                [...arriving, ...["I_a", "I_d", "I_s"].map((sum) => [sum, light[sum]])].map(([name, values]) => row(name, ...values.map(number)))),
            steps(`How ${light.type} emits, step by step`, light.light_steps),
            steps(`How ${light.reflection} reflects, step by step`, light.reflection_steps),
        ].filter((part) => part !== null);
    }

    /** The formulas of the light and of the reflection, with this point's numbers. */
    formulas(index, point, light) {
        const { settings } = this, { scene } = settings;
        const valuesOf = (model, prefix) => Object.fromEntries(model.parameters.map(({ name }) => prefix + name)
            .filter((path) => settings.find(path) !== null).map((path) => [path.slice(prefix.length), settings.get(path)]));
        const reflection = settings.modelOf(scene.objects[index], "reflection"), named = scene.lights.filter(({ label }) => label === light.light);
        const models = [[scene.reflection_models[reflection], `object.${index}.material.${reflection}.`, light.reflection_steps]];
        // With two lights of the same name, it is ambiguous.
        if (named.length === 1) models.unshift([scene.light_models[named[0].model], `light.${scene.lights.indexOf(named[0])}.value.`, light.light_steps]);
        return models.flatMap(([model, prefix, done]) => {
            const formula = formulaAt(model, point, light, valuesOf(model, prefix), done);
            return formula === null ? [] : [element("h3", {}, `${model.title} here`), formula];
        });
    }

    drawVectors(point, vectors, blockedAt = null) {
        const { width, height } = this.settings.scene.image;
        drawArrows(this.arrows, this.settings.observer(), width, height, point.position, vectors, blockedAt);
        if (this.pictureWithArrows !== this.canvas) this.placeArrows();
    }

    placeArrows() {
        layOver(this.arrows, this.canvas);
        this.pictureWithArrows = this.canvas;
    }
}
