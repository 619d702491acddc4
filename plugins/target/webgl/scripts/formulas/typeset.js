import { element } from "../../../../../sdk/web/elements.js";
import { partsOfLine } from "./formula_tree.js";

const GREEK = {
    alpha: "α", beta: "β", gamma: "γ", delta: "δ", theta: "θ", lambda: "λ", mu: "μ", pi: "π", rho: "ρ", sigma: "σ", phi: "φ", omega: "ω", dphi: "Δφ",
};
const NAMED = ["position", "direction", "intensity", "color", "outer", "inner", "attenuation", "environment", "mirrored", "refracted", "distance", "depth", "falloff", "radius", "sum", "up",
    "cool", "warm", "sky_color", "ground_color", ...Object.keys(GREEK)];
const SIGNS = { "-": "−", "<=": "≤", ">=": "≥" };

function mathElement(tag, attributes, ...children) {
    const result = document.createElementNS("http://www.w3.org/1998/Math/MathML", tag);
    for (const [name, value] of Object.entries(attributes)) result.setAttribute(name, value);
    result.append(...children);
    return result;
}

const letter = (text) => mathElement("mi", {}, GREEK[text] ?? text);
const sign = (text, attributes = {}) => mathElement("mo", attributes, SIGNS[text] ?? text);
const row = (...children) => (children.length === 1 ? children[0] : mathElement("mrow", {}, ...children));

/** I_d, kd, C1, alpha. */
function nameElement(text) {
    const [base, ...rest] = text.split("_");
    if (rest.length > 0) return mathElement("msub", {}, nameElement(base), letter(rest.join(" ")));
    const short = /^(k)([ads])$/.exec(text) ?? /^([A-Za-z])(\d+)$/.exec(text);
    return short ? mathElement("msub", {}, letter(short[1]), /\d/.test(short[2]) ? mathElement("mn", {}, short[2]) : letter(short[2])) : letter(text);
}

const withoutGroup = (node) => (node.kind === "group" ? node.of[0] : node);
const fenced = (open, content, close) => mathElement("mrow", {}, sign(open, { stretchy: "false" }), content, sign(close, { stretchy: "false" }));

/**
 * A tree as MathML, which browsers typeset. `valueOf`: gets a node and returns its replacement, such as a number for a name, or
 * null.
 */
export function treeElement(node, valueOf = () => null) {
    const value = valueOf(node);
    if (value !== null) return value;
    const inner = (child) => treeElement(child, valueOf);
    switch (node.kind) {
        case "number":
            return mathElement("mn", {}, node.text);
        case "name":
            return node.text === "sum" ? sign("∑") : nameElement(node.text);
        case "word":
            return mathElement("mtext", {}, `\u00a0${node.text}\u00a0`);
        case "sign":
            return sign(node.text === "x" ? "×" : node.text);
        case "dot":
            return row(inner(node.of[0]), sign("·"), inner(node.of[1]));
        case "power":
            return mathElement("msup", {}, inner(node.of[0]), inner(withoutGroup(node.of[1])));
        case "fraction":
            return mathElement("mfrac", {}, ...node.of.map((part) => inner(withoutGroup(part))));
        case "group":
            return fenced("(", inner(node.of[0]), ")");
        case "norm":
            return fenced("|", inner(node.of[0]), "|");
        case "minus":
            return row(sign("-", { form: "prefix" }), inner(node.of[0]));
        case "call":
            if (node.name === "sqrt") return mathElement("msqrt", {}, inner(node.of[0]));
            return row(nameElement(node.name), mathElement("mo", {}, "\u2061"), fenced("(", inner(node.of[0]), ")"));
        case "product":
            return row(...node.of.flatMap((factor, i) => {
                const isNumeric = (one) => one.kind === "number" || valueOf(one) !== null;
                const isLong = (one) => one.kind === "call" || (one.kind === "name" && one.text.length > 2);
                const before = node.of[i - 1];
                // Between numbers, multiplication must be visible.
                const between = i > 0 && isNumeric(before) && isNumeric(factor) ? sign("·")
                    : mathElement("mspace", { width: i > 0 && (isLong(before) || isLong(factor)) ? "0.22em" : "0.08em" });
                return i === 0 ? [inner(factor)] : [between, inner(factor)];
            }));
        default:
            return row(...node.of.map(inner));
    }
}

export const mathLine = (...children) => mathElement("math", {}, ...children);
export const mathSign = sign;
export const mathNumber = (text) => mathElement("mn", {}, text);
export const mathRow = row;
export const mathPower = (base, exponent) => mathElement("msup", {}, base, exponent);

/** The names of several letters that stand for something in a model's formula. */
export const knownNames = (model) => new Set([...NAMED, ...model.parameters.map(({ name }) => name)]);

/** A model's formula, typeset line by line; lines that are not formulas stay as they were written. */
export function formulaLines(model) {
    const known = knownNames(model);
    return model.formula.split("\n").map((line) => {
        const parts = partsOfLine(line, known).map(({ text, label, tree }) => {
            if (tree === null) return element("span", { class: "said" }, text);
            return element("span", {}, label ? element("span", { class: "said" }, `${label}: `) : null, mathLine(treeElement(tree)));
        });
        return element("div", { class: "formula-line", title: line.trim() }, ...parts);
    });
}
