import { materialUniforms } from "../appearance.js";
import { element, newId } from "../../../../../sdk/web/elements.js";
import { hemisphere, luminance, mirrorAngle, planeOfIncidence, reflectedInto } from "./lobe.js";
import { lobeDiagram } from "./lobe_diagram.js";
import { drawLobe } from "./lobe_surface.js";
import { layOver, onMoved } from "../overlay.js";

const number = (x) => String(Number(x.toPrecision(4)));

/** The light of one source reflected at a point in all directions: as a surface at the point, and as a diagram in the panel. */
export class Lobes {
    /** `renderer`: returns the page's current renderer. */
    constructor(settings, picture, renderer) {
        Object.assign(this, { settings, picture, renderer });
        this.canvas = element("canvas", { id: "lobe-canvas", "aria-hidden": "true" });
        picture.parentElement.append(this.canvas);
        this.other = "";  // a model to compare with
        this.isLogarithmic = false;
        onMoved(this.canvas, picture, () => layOver(this.canvas, this.picture));
    }

    /** From now on, draws them in that picture of these settings. */
    use(settings, picture) {
        Object.assign(this, { settings, picture });
    }

    clear() {
        this.canvas.width = this.canvas.height = 1;
    }

    /** Whether a model reads only the values of the point that the explanation contains. */
    isKnown(reflection, { tangent }) {
        const { needs_tangent: needsTangent, needs_uv: needsUv } = this.settings.scene.reflection_models[reflection];
        return !needsUv && (!needsTangent || tangent.some((x) => x !== 0));
    }

    /** Elements for the panel; none if the light has no direction. */
    parts(index, point, light) {
        this.clear();
        const { scene } = this.settings, reflection = this.settings.modelOf(scene.objects[index], "reflection");
        if (this.renderer() === null || !light.L || !this.isKnown(reflection, point)) return [];
        const valuesOf = (model, directions) =>
            reflectedInto(this.renderer(), model, materialUniforms(this.settings, index, model), point, light, directions).map(luminance);
        const { width, height } = scene.image, grid = hemisphere(point, light);
        drawLobe(this.canvas, this.settings.observer(), [width, height], point.position, grid, valuesOf(reflection, grid.directions));
        layOver(this.canvas, this.picture);

        const { angles, directions } = planeOfIncidence(point, light), shown = element("figure", { class: "lobe" });
        const others = Object.keys(scene.reflection_models).filter((name) => name !== reflection && this.isKnown(name, point));
        const redraw = () => {
            const names = [reflection, ...others.filter((name) => name === this.other)];
            const curves = names.map((name) => ({ name: scene.reflection_models[name].title, values: valuesOf(name, directions) }));
            const told = curves.map(({ name, values }) => `${name} at most ${number(Math.max(...values))}`).join(", ");
            const towards = number(valuesOf(reflection, [point.V])[0]);
            shown.replaceChildren(
                lobeDiagram(curves, angles, mirrorAngle(point, light), this.isLogarithmic, `The lobe in the plane of incidence: ${told}`),
                element("figcaption", {}, "In the plane of incidence: ",
                    ...curves.map(({ name, values }, i) => element("span", { class: `key key-${i}` }, `${name}, at most ${number(Math.max(...values))}`)),
                    ` Towards the observer: ${towards}`));
        };
        redraw();
        const id = newId("lobe");
        const choice = element("select", { id }, element("option", { value: "" }, "no other model"),
            ...others.map((name) => element("option", { value: name }, scene.reflection_models[name].title)));
        choice.value = others.includes(this.other) ? this.other : "";
        choice.addEventListener("change", () => { this.other = choice.value; redraw(); });
        const logarithmic = element("input", { type: "checkbox", checked: this.isLogarithmic });
        logarithmic.addEventListener("change", () => { this.isLogarithmic = logarithmic.checked; redraw(); });
        return [element("h3", {}, "Reflected light by direction"), shown, element("div", { class: "lobe-choices" },
            element("label", { for: id }, "Compare with"), choice, element("label", {}, logarithmic, " logarithmic, four decades"))];
    }
}
