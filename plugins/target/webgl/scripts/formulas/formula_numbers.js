import { element } from "../../../../../sdk/web/elements.js";
import { partsOfLine } from "./formula_tree.js";
import { knownNames, mathLine, mathNumber, mathPower, mathRow, mathSign, treeElement } from "./typeset.js";
import { dot } from "../../../../../sdk/web/vectors.js";

const shown = (x) => (x === 0 ? "0" : String(Number(x.toPrecision(4))).replace("-", "−"));
const VECTORS = ["N", "V", "L", "R", "H"];

/** A number, or three; one if all three are equal. */
function valueElement(value) {
    if (typeof value === "number") return mathNumber(shown(value));
    const same = value.every((x) => x === value[0]);
    if (same) return mathNumber(shown(value[0]));
    return mathRow(mathSign("("), ...value.flatMap((x, i) => (i === 0 ? [mathNumber(shown(x))] : [mathSign(","), mathNumber(shown(x))])), mathSign(")"));
}

/** The code may write a formula's k_s or C_1 as ks or C1. */
const valueNamed = (values, name) => values.get(name) ?? values.get(name.replace("_", ""));

/** The replacement of a node whose names have values. */
function substitution(values) {
    return (node) => {
        const valueOf = (one) => (one.kind === "name" ? valueNamed(values, one.text) : undefined);
        if (node.kind === "dot") {
            const [a, b] = node.of.map(valueOf);
            return Array.isArray(a) && Array.isArray(b) ? valueElement(dot(a, b)) : null;
        }
        const value = valueOf(node);
        return value === undefined ? null : valueElement(value);
    };
}

/** Formulas may be wider than the panel, and can be scrolled with keys. */
const scrollable = (name, ...lines) => element("div", { class: "formula", tabIndex: 0, role: "group", "aria-label": name }, ...lines);

/** The name that a line assigns, and its expression; null if the line is not an assignment. */
function definition({ tree }) {
    if (tree?.kind !== "row") return null;
    const [left, equals, ...right] = tree.of;
    const isOne = left?.kind === "name" && equals?.kind === "sign" && equals.text === "=" && right.length > 0;
    return isOne ? { name: left.text, right: { kind: "row", of: right } } : null;
}

/** The values of names in a model's formula, from the explanation of a light at a point; `own`: the model's parameters. */
function valuesAt(point, light, own, steps) {
    const values = new Map(Object.entries(own).filter(([, value]) => typeof value === "number" || Array.isArray(value)));
    // The kernel's own names, at the top level; a letter may be capital in the formula.
    for (const { kind, name, value, depth } of steps) {
        if (kind === "value" && depth <= 1 && (typeof value === "number" || value?.length === 3)) values.set(name, value);
    }
    for (const name of VECTORS) {
        const vector = point[name] ?? light[name];
        if (vector) values.set(name, vector);
    }
    for (const name of ["I_a", "I_d", "I_s"]) values.set(name, light[name]);
    values.set("C_o", point.C_o);
    if (light.ambient) values.set("I_ambient", light.ambient);
    return values;
}

/**
 * A model's formula with numbers in place of names: for each assignment, the line, the line with known values filled in, and
 * its value. Lines for choices other than the scene's ('falloff = "linear"') are left out, as are those that do not matter for
 * this light.
 */
export function formulaAt(model, point, light, own, steps) {
    const known = knownNames(model), values = valuesAt(point, light, own, steps), isAmbient = Boolean(light.ambient);
    const ofAmbient = new Set(["I_a"]), ofLight = new Set(["I_d", "I_s", "R", "H"]);
    const lines = model.formula.split("\n").flatMap((line) => {
        const parts = partsOfLine(line, known);
        const isOther = parts.some(({ text }) => {
            const choice = /^(\w+) = "([^"]*)"$/.exec(text);
            return choice !== null && own[choice[1]] !== undefined && own[choice[1]] !== choice[2];
        });
        return isOther ? [] : parts.flatMap((part) => {
            const found = definition(part);
            if (found === null || (isAmbient ? ofLight : ofAmbient).has(found.name)) return [];
            const arriving = found.name === "I_s" ? light.specular : light.diffuse;
            const here = new Map(values);
            if (arriving) here.set("I_L", arriving);
            const result = valueNamed(values, found.name);
            const name = treeElement({ kind: "name", text: found.name });
            const numbers = treeElement(found.right, substitution(here)), formula = treeElement(found.right);
            return [element("div", { class: "formula-steps", title: part.text },
                mathLine(name, mathSign("="), formula),
                numbers.outerHTML === formula.outerHTML ? null : mathLine(mathSign("="), numbers),
                result === undefined ? null : mathLine(mathSign("="), valueElement(result)))];
        });
    });
    return lines.length === 0 ? null : scrollable(`${model.title} with numbers`, ...lines);
}

/** From a point's sums to its intensity. */
export function sumAt(point) {
    const symbol = (text) => treeElement({ kind: "name", text }), sum = (make) => [make("I_a"), mathSign("+"), make("I_d"), mathSign("+"), make("I_s")];
    return scrollable("The sum", element("div", { class: "formula-steps" },
        mathLine(symbol("I"), mathSign("="), ...sum(symbol)),
        mathLine(mathSign("="), ...sum((name) => valueElement(point[name]))),
        mathLine(mathSign("="), valueElement(point.I))));
}

/** From an intensity to the byte, channel by channel: the sRGB curve of IEC 61966-2-1. */
export function encodingAt({ I, toned = I, encoded, bytes, color_management: management }) {
    const lines = ["red", "green", "blue"].map((channel, c) => {
        const clamped = Math.min(1, Math.max(0, toned[c])), x = mathNumber(shown(clamped));
        const curve = management !== "srgb" ? [x] : clamped <= 0.0031308 ? [mathNumber("12.92"), mathSign("·"), x]
            : [mathNumber("1.055"), mathSign("·"), mathPower(x, mathRow(mathNumber("1"), mathSign("/"), mathNumber("2.4"))), mathSign("−"), mathNumber("0.055")];
        const byte = [mathNumber("255"), mathSign("·"), mathNumber(shown(encoded[c])), mathSign("="), mathNumber((255 * encoded[c]).toFixed(2)), mathSign("→"), mathNumber(String(bytes[c]))];
        return element("div", { class: "formula-line" }, element("span", { class: "said" }, channel), mathLine(...curve, mathSign("="), mathNumber(shown(encoded[c]))), mathLine(...byte));
    });
    return scrollable("From intensities to bytes", ...lines);
}
