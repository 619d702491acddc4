import { element, newId } from "../elements.js";

const DELAY_MS = 200;  // after the last key

/** The page contains CodeMirror as text, which becomes a script when it is first used. */
function codeMirror() {
    if (globalThis.CodeMirror === undefined) {
        const script = document.createElement("script");
        script.textContent = document.getElementById("codemirror").textContent;
        document.head.append(script);
    }
    return globalThis.CodeMirror;
}

/**
 * An editor for a text in the kernel language, with its errors below. Tab leaves it like any field.
 */
export class Editor {
    /** `label`: its name for assistive technology. `onInput` gets the text a moment after the last key. */
    constructor({ label, text, onInput }) {
        const area = element("div", { class: "editor" });
        this.problemList = element("ul", { class: "editor-problems", id: newId("problems"), "aria-live": "polite" });
        this.element = element("div", { class: "editor-box" }, area, this.problemList);
        this.mirror = codeMirror()(area, {
            value: text, mode: "x-shader/x-fragment", lineNumbers: true, indentUnit: 4, matchBrackets: true, viewportMargin: Infinity,
            screenReaderLabel: label, extraKeys: { Tab: false, "Shift-Tab": false },
            // A screen reader reads the lines themselves, and the scrolling element contains the focus.
            inputStyle: "contenteditable",
        });
        const field = this.mirror.getInputField();
        field.setAttribute("role", "textbox");
        field.setAttribute("aria-multiline", "true");
        field.setAttribute("aria-describedby", this.problemList.id);
        this.marked = [];
        this.mirror.on("change", () => {
            clearTimeout(this.timer);
            this.timer = setTimeout(() => onInput(this.text), DELAY_MS);
        });
    }

    get text() {
        return this.mirror.getValue();
    }

    /** `onInput` is called. */
    set text(text) {
        this.mirror.setValue(text);
    }

    /** Must be called once it is in the page and visible. */
    refresh() {
        this.mirror.refresh();
    }

    focus() {
        this.mirror.focus();
    }

    /** Problems: { line, message } with lines from 1; those without a line, or beyond the end, are about the whole text. */
    showProblems(problems) {
        for (const handle of this.marked) this.mirror.removeLineClass(handle, "wrap", "editor-problem");
        this.marked = problems
            .filter(({ line }) => line >= 1 && line <= this.mirror.lineCount())
            .map(({ line }) => this.mirror.addLineClass(line - 1, "wrap", "editor-problem"));
        this.problemList.replaceChildren(...problems.map(({ line, message }) => element("li", {}, line ? `Line ${line}: ${message}` : message)));
        const field = this.mirror.getInputField();
        problems.length === 0 ? field.removeAttribute("aria-invalid") : field.setAttribute("aria-invalid", "true");
    }
}
