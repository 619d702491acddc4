import { decodeFloats, decodeIndices } from "../../../../sdk/web/base64.js";
import { Editor } from "../../../../sdk/web/editor/editor.js";
import { foreignTo, problemsOf } from "../../../../sdk/web/editor/problems.js";
import { element } from "../../../../sdk/web/elements.js";
import { answerText, bodyOf } from "./answers.js";
import { compareAll, compareTerm } from "./comparison.js";
import { Evaluation, TERMS } from "./evaluation.js";
import { drawBall, drawDifference, drawNothing } from "./pictures.js";

const byId = (id) => document.getElementById(id);
function percent(share) {
    if (Number.isNaN(share)) return "not a number";
    if (share > 0 && share < 0.001) return "< 0.1 %";
    if (share >= 10) return share < 1000 ? `${share.toFixed(0)} times` : "> 1000 times";
    return `${(100 * share).toFixed(share > 0 && share < 0.1 ? 1 : 0)} %`;
}

function readExercise() {
    const exercise = JSON.parse(byId("exercise").textContent);
    exercise.pixels = [...decodeIndices(exercise.pixels)];
    exercise.expected = exercise.cases.map((one) => Object.fromEntries(TERMS.map((term) => [term, decodeFloats(one[term])])));
    return exercise;
}

class ExercisePage {
    constructor() {
        const exercise = this.exercise = readExercise();
        this.values = null;  // results of the last formula that compiled
        byId("task").textContent = `Write the body of ${exercise.function}(). Its results are compared with the model's at ${exercise.pixels.length} points of a ball, in ${exercise.cases.length} cases.`;
        byId("paper").textContent = exercise.reference;
        byId("paper").hidden = exercise.reference === "";
        byId("before").textContent = exercise.before.trim();
        byId("after").textContent = exercise.after.trim();
        byId("case").append(...exercise.cases.map(({ label }, i) => element("option", { value: i }, label)));
        for (const id of ["case", "term"]) byId(id).addEventListener("change", () => this.draw());
        this.editor = new Editor({ label: `The body of ${exercise.function}()`, text: "\n", onInput: (text) => this.tryOut(text) });
        byId("editor").append(this.editor.element);
        this.editor.refresh();
        this.connectButtons();
        try {
            this.evaluation = new Evaluation(exercise);
        } catch (error) {
            byId("problem").textContent = error.message;
            byId("problem").hidden = false;
        }
        this.tryOut(this.editor.text);
    }

    connectButtons() {
        const { exercise, editor } = this, file = byId("answer-file");
        const say = (text) => {
            byId("notice").textContent = text;
            byId("notice").hidden = text === "";
        };
        byId("save-answer").addEventListener("click", () => {
            const url = URL.createObjectURL(new Blob([answerText(exercise, editor.text)], { type: "application/json" }));
            element("a", { href: url, download: `${exercise.function.replaceAll("_", "-")}.answer` }).click();
            setTimeout(() => URL.revokeObjectURL(url));
            say("");
        });
        byId("load-answer").addEventListener("click", () => file.click());
        file.addEventListener("change", async () => {
            try {
                editor.text = bodyOf(exercise, await file.files[0].text());
                say("");
            } catch (error) {
                say(error.message);
            }
            file.value = "";
        });
        byId("clear-answer").addEventListener("click", () => {
            editor.text = "\n";
            editor.focus();
        });
    }

    /** The pictures keep showing the last formula that compiled. */
    tryOut(text) {
        const verdict = byId("verdict");
        verdict.classList.remove("matches");
        let problems = text.trim() === "" ? [] : foreignTo(text);
        if (text.trim() !== "" && problems.length === 0 && this.evaluation) {
            try {
                this.values = this.evaluation.valuesOf(text);
            } catch (error) {
                problems = problemsOf(error.detail ?? error.message, text);
            }
        }
        this.editor.showProblems(problems);
        if (text.trim() === "") verdict.textContent = "Nothing written yet.";
        else if (problems.length > 0) verdict.textContent = this.values ? "It does not compile; the results below are from the last version that did." : "It does not compile.";
        else if (this.values) this.judge();
        this.draw();
    }

    judge() {
        const { exercise, values } = this, verdict = byId("verdict");
        const found = TERMS.map((term) => ({ term, ...compareAll(exercise.expected, values, term) }));
        byId("differences").tBodies[0].replaceChildren(...found.map(({ term, share, largest, worst, matches }) =>
            element("tr", { class: matches ? "" : "differs" }, element("th", { scope: "row" }, term), element("td", {}, percent(share)),
                element("td", {}, percent(largest)), element("td", {}, share === 0 ? "" : exercise.cases[worst].label))));
        const wrong = found.filter(({ matches }) => !matches);
        verdict.textContent = wrong.length === 0 ? "It matches the model." : `It differs from the model: ${wrong.map(({ term }) => term).join(", ")}.`;
        verdict.classList.toggle("matches", wrong.length === 0);
    }

    draw() {
        const { exercise, values } = this, index = Number(byId("case").value), shown = byId("term").value, expected = exercise.expected[index];
        drawBall(byId("model"), exercise, expected, shown);
        if (values === null) {
            for (const id of ["own", "where"]) drawNothing(byId(id), exercise);
            return;
        }
        drawBall(byId("own"), exercise, values[index], shown);
        const terms = shown === "all" ? TERMS : [shown];
        const differing = terms.map((term) => compareTerm(expected[term], values[index][term]).differing);
        drawDifference(byId("where"), exercise, differing[0].map((_, i) => differing.reduce((most, one) => (Number.isNaN(one[i]) ? NaN : Math.max(most, one[i])), 0)));
    }
}

/** For scripts. */
window.candelaExercise = new ExercisePage();
