import { appearanceOf } from "../appearance.js";
import { Editor } from "../../../../../sdk/web/editor/editor.js";
import { problemsOf } from "../../../../../sdk/web/editor/problems.js";
import { element } from "../../../../../sdk/web/elements.js";
import { idsOf, isUsed, modelOfId } from "./formulas.js";
import { announce } from "../messages.js";
import { quoted } from "../options.js";
import { layOver, onMoved } from "../overlay.js";
import { compare } from "../reference.js";

const DELAY_MS = 150;  // of the difference, which is drawn twice

/**
 * A model's kernel in an editor. A text that compiles is drawn at once; errors are shown at their lines, and the last text that
 * compiled stays. It can be compared with the shipped formula, and be kept as the start of a plugin.
 */
export class FormulaEditor {
    /**
     * `page`: has settings, canvas, formulas (a map of texts by id), useFormulas(texts), which throws if they do not compile,
     * and pixelsWith(texts, width, height). `isLive`: the page is served by `candela view`.
     */
    constructor(page, isLive) {
        Object.assign(this, { page, isLive });
        this.id = null;
        this.drafts = new Map();  // typed texts, by id, valid or not
        this.overlay = element("canvas", { id: "formula-canvas", "aria-hidden": "true", hidden: true });
        page.canvas.parentElement.append(this.overlay);
        onMoved(this.overlay, page.canvas, () => layOver(this.overlay, page.canvas));
        page.settings.listeners.push(() => this.compareLater());
        this.section = document.getElementById("formula-editor");
        this.section.hidden = false;
        this.model = element("select", { id: "formula-model" });
        const start = element("button", { type: "button", id: "formula-open" }, "Edit");
        start.addEventListener("click", () => this.open(this.model.value));
        this.body = element("div", { id: "formula-body", hidden: true });
        this.section.append(element("div", { class: "line-of-controls" }, element("label", { for: "formula-model" }, "Model"), this.model, start), this.body);
        this.model.addEventListener("change", () => { if (this.id !== null) this.open(this.model.value); });
        this.sceneChanged();
    }

    /** Offers the new scene's models; edits of models that it does not have are dropped. */
    sceneChanged() {
        const { scene } = this.page.settings, ids = idsOf(scene);
        const chosen = ids.includes(this.model.value) ? this.model.value : ids.find((id) => id === `reflection/${scene.objects[0]?.reflection}`) ?? ids[0];
        this.model.replaceChildren(...ids.map((id) => element("option", { value: id }, `${modelOfId(scene, id).title} (${id.slice(0, id.indexOf("/"))})`)));
        if (chosen) this.model.value = chosen;
        if (this.id === null) return;
        if (!ids.includes(this.id)) {
            this.close();
            return;
        }
        // The focus stays where it is. A shipped formula may have changed.
        const isOwn = this.page.formulas.has(this.id) || this.drafts.has(this.id);
        if (!isOwn && this.editor.text !== this.shipped()) this.editor.text = this.shipped();
        this.show();
    }

    close() {
        this.id = null;
        this.body.hidden = true;
        this.body.replaceChildren();
        this.overlay.hidden = true;
    }

    shipped() {
        return modelOfId(this.page.settings.scene, this.id).kernel;
    }

    /** The model's name in commands. */
    name() {
        return modelOfId(this.page.settings.scene, this.id).id;
    }

    open(id) {
        const { scene } = this.page.settings;
        this.id = id;
        this.editor = new Editor({ label: `The kernel of ${modelOfId(scene, id).title}`, text: this.drafts.get(id) ?? this.page.formulas.get(id) ?? this.shipped(), onInput: (text) => this.tryOut(text) });
        this.showing = element("select", { id: "formula-showing" },
            element("option", { value: "edited" }, "the edited formula"), element("option", { value: "shipped" }, "the shipped formula"), element("option", { value: "difference" }, "where the two differ"));
        this.showing.addEventListener("change", () => this.show());
        this.status = element("p", { id: "formula-status", role: "status" });
        const reset = element("button", { type: "button", id: "formula-reset" }, "Restore the shipped formula");
        reset.addEventListener("click", () => {
            this.editor.text = this.shipped();
            this.editor.focus();
        });
        this.body.replaceChildren(this.editor.element,
            element("div", { class: "line-of-controls" }, element("label", { for: "formula-showing" }, "The picture shows"), this.showing, reset),
            this.status, ...(id.startsWith("reflection/") ? this.keeping() : []));
        this.body.hidden = false;
        this.editor.refresh();
        this.editor.focus();
        this.show();
    }

    tryOut(text) {
        this.drafts.set(this.id, text);
        const formulas = new Map(this.page.formulas);
        text === this.shipped() ? formulas.delete(this.id) : formulas.set(this.id, text);
        try {
            this.page.useFormulas(formulas);
        } catch (error) {
            this.editor.showProblems(problemsOf(error.detail ?? error.message, text));
            this.status.textContent = "It does not compile; the picture shows the last formula that did.";
            return;
        }
        this.drafts.delete(this.id);
        this.editor.showProblems([]);
        this.show();
    }

    /** Draws the picture that is chosen. */
    show() {
        const { page } = this, isEdited = page.formulas.size > 0, mode = this.showing.value;
        page.drawWith(mode === "shipped" ? new Map() : page.formulas);
        this.status.textContent = isEdited ? "" : `This is the shipped formula.${this.isSeen() ? "" : " Nothing in the picture uses this model."}`;
        this.compareLater();
    }

    compareLater() {
        clearTimeout(this.timer);
        if (this.id === null) return;
        this.overlay.hidden = true;
        if (this.page.formulas.size > 0 && this.showing.value !== "shipped") this.timer = setTimeout(() => this.compare(), DELAY_MS);
    }

    /** Whether the picture depends on the formula. */
    isSeen() {
        return isUsed(appearanceOf(this.page.settings), this.id);
    }

    compare() {
        const { page, overlay } = this, { width, height } = page.settings.scene.image;
        const { heat, largest, beyond, pixels } = compare(page.pixelsWith(page.formulas, width, height), page.pixelsWith(new Map(), width, height));
        this.status.textContent = !this.isSeen() ? "It compiles. Nothing in the picture uses this model."
            : largest === 0 ? "The picture is identical to that of the shipped formula."
            : `${beyond} of ${pixels} pixels differ from the shipped formula's picture by more than 2 levels of 255; at most ${largest}.`;
        if (this.showing.value !== "difference") return;
        Object.assign(overlay, { width, height });
        overlay.getContext("2d").putImageData(new ImageData(heat, width, height), 0, 0);
        overlay.hidden = false;
        layOver(overlay, page.canvas);
    }

    /** A name, and a button that makes a plugin project of the formula, or tells how. */
    keeping() {
        const name = element("input", { id: "formula-name", type: "text", value: "my-model", pattern: "[a-z][a-z0-9]*(-[a-z0-9]+)*", required: true, autocomplete: "off", spellcheck: false });
        const result = element("p", { id: "formula-kept", role: "status" });
        const button = element("button", { type: "button", id: "formula-keep" }, "Keep it");
        button.addEventListener("click", async () => {
            if (!name.checkValidity()) {
                name.setAttribute("aria-invalid", "true");
                result.textContent = "A plugin's name consists of lower-case letters, digits and single hyphens, and begins with a letter.";
                return;
            }
            name.removeAttribute("aria-invalid");
            button.disabled = true;
            result.textContent = await (this.isLive ? this.keepHere(name.value) : this.download(name.value));
            button.disabled = false;
            announce(result.textContent);
        });
        return [element("div", { class: "line-of-controls" }, element("label", { for: "formula-name" }, "As a plugin called"), name, button), result];
    }

    /** `candela view` creates the project in the folder in which it was started. */
    async keepHere(name) {
        try {
            const response = await fetch(`keep?model=${encodeURIComponent(this.name())}&name=${encodeURIComponent(name)}`, { method: "POST", body: this.editor.text });
            return (await response.text()).trim();
        } catch (error) {
            return `The formula was not kept. ${error.message}`;
        }
    }

    download(name) {
        const href = URL.createObjectURL(new Blob([this.editor.text], { type: "text/plain" }));
        element("a", { href, download: `${name}.kernel` }).click();
        setTimeout(() => URL.revokeObjectURL(href));
        return `${name}.kernel was downloaded. In its folder, run: candela plugin new reflection ${name} --from ${quoted(this.name())} --kernel ${name}.kernel`;
    }
}
