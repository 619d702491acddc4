// Typesets the models' formulas, like the pages of scenes.
import { formulaLines } from "../../plugins/target/webgl/scripts/formulas/typeset.js";

for (const element of document.querySelectorAll("pre.formula")) {
    const parameters = element.dataset.parameters.split(" ").map((name) => ({ name }));
    const set = document.createElement("div");
    set.className = "formula";
    set.append(...formulaLines({ formula: element.textContent, parameters }));
    element.replaceWith(set);
}
