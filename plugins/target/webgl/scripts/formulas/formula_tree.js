/**
 * Formulas as written in models' manifests, "I_d = kd C_o I_L max(N.L, 0)", as trees. Juxtaposition multiplies, and binds like
 * "/", from left to right; two or more spaces separate a formula from a remark.
 *
 * Nodes: { kind: "number" | "name" | "word", text }, { kind: "dot" | "power" | "fraction", of: [a, b] }, { kind: "call", name, of },
 * { kind: "group" | "norm" | "minus", of: [a] }, { kind: "product" | "row", of }, { kind: "sign", text } within rows.
 */

const TOKEN = /\s+|\d+(?:\.\d+)?|[A-Za-z]\w*|"[^"]*"|<=|>=|\.\.\.|[-+/^=(),.|<>?:]/y;
const RELATIONS = ["=", "<", ">", "<=", ">=", "?", ":"];
const FUNCTIONS = new Set(["max", "min", "sqrt", "exp", "sin", "cos", "tan", "clamp", "ceil", "floor", "log", "pow"]);
const WORDS = new Set(["where", "else", "and", "or", "if", "with", "for", "at", "least", "most", "instead", "of", "over"]);

class NoFormula extends Error {}

function tokensOf(text) {
    const tokens = [];
    TOKEN.lastIndex = 0;
    while (TOKEN.lastIndex < text.length) {
        const at = TOKEN.lastIndex, match = TOKEN.exec(text);
        if (match === null) throw new NoFormula(`unexpected '${text[at]}' in a formula`);
        const isSpace = match[0].trim() === "";
        if (isSpace && tokens.length > 0) tokens.at(-1).isSpaced = true;
        if (!isSpace) tokens.push({ text: match[0], isSpaced: false });
    }
    return tokens;
}

const isNumber = (text) => /^\d/.test(text ?? "");
const isName = (text) => /^[A-Za-z]/.test(text ?? "");

class Parser {
    constructor(text) {
        this.tokens = tokensOf(text);
        this.at = 0;
        this.norms = 0;  // open ones: a "|" ends the innermost
    }

    get next() {
        return this.tokens[this.at]?.text;
    }

    take(text) {
        if (this.next !== text) return false;
        this.at += 1;
        return true;
    }

    expect(text) {
        if (!this.take(text)) throw new NoFormula(`expected '${text}'`);
    }

    whole() {
        const row = this.row();
        if (this.next !== undefined) throw new NoFormula(`unexpected '${this.next}' after the formula`);
        return row;
    }

    /** Sums, relations and words, one after the other. */
    row() {
        const of = [];
        for (;;) {
            const { next } = this;
            if (next === undefined || next === ")" || (next === "|" && this.norms > 0 && of.length > 0)) break;
            if (RELATIONS.includes(next) || ["+", "-", ",", "x"].includes(next)) {
                this.at += 1;
                const isUnary = next === "-" && (of.length === 0 || of.at(-1).kind === "sign");
                of.push(isUnary ? { kind: "minus", of: [this.product()] } : { kind: "sign", text: next });
            } else if (next === "..." || next.startsWith('"') || WORDS.has(next)) {
                this.at += 1;
                of.push({ kind: "word", text: next });
            } else {
                of.push(this.product());
            }
        }
        return of.length === 1 ? of[0] : { kind: "row", of };
    }

    product() {
        let factors = [this.power()];
        for (;;) {
            const { next } = this;
            if (this.take("/")) {
                const above = factors.length === 1 ? factors[0] : { kind: "product", of: factors };
                factors = [{ kind: "fraction", of: [above, this.power()] }];
            } else if ((isNumber(next) || isName(next) || next === "(" || (next === "|" && this.norms === 0)) && !WORDS.has(next) && next !== "x") {
                factors.push(this.power());
            } else {
                return factors.length === 1 ? factors[0] : { kind: "product", of: factors };
            }
        }
    }

    power() {
        const base = this.dotted();
        return this.take("^") ? { kind: "power", of: [base, this.take("-") ? { kind: "minus", of: [this.primary()] } : this.primary()] } : base;
    }

    /** N.L, without spaces. */
    dotted() {
        const first = this.primary();
        return this.next === "." && !this.tokens[this.at - 1].isSpaced && this.take(".") ? { kind: "dot", of: [first, this.primary()] } : first;
    }

    primary() {
        const token = this.tokens[this.at++];
        if (token === undefined) throw new NoFormula("the formula ends too early");
        const { text, isSpaced } = token;
        if (isNumber(text)) return { kind: "number", text };
        if (isName(text)) {
            if (this.next !== "(" || isSpaced || !(FUNCTIONS.has(text) || text.length > 2)) return { kind: "name", text };
            return { kind: "call", name: text, of: this.inParentheses() };
        }
        if (text === "(") {
            this.at -= 1;
            return { kind: "group", of: this.inParentheses() };
        }
        if (text === "|") {
            this.norms += 1;
            const of = [this.row()];
            this.expect("|");
            this.norms -= 1;
            return { kind: "norm", of };
        }
        throw new NoFormula(`unexpected '${text}'`);
    }

    inParentheses() {
        this.expect("(");
        const { norms } = this;
        this.norms = 0;
        const of = [this.row()];
        this.norms = norms;
        this.expect(")");
        return of;
    }
}

/** Whether a text has names that are neither letters nor known, as sentences do. */
const sentenceWords = (text, known) =>
    (text.match(/[A-Za-z]\w*/g) ?? []).filter((word) => /^[a-z]{3,}$/.test(word) && !known.has(word) && !FUNCTIONS.has(word) && !WORDS.has(word));

/**
 * A line as its parts: { text, tree } each, with a null tree for words. `known`: the names of several letters that stand for
 * something.
 */
export function partsOfLine(line, known) {
    return line.trim().split(/\s{2,}/).filter((text) => text !== "").map((text) => {
        const label = /^([a-z][\w-]*): (.*)$/.exec(text), body = label ? label[2] : text;
        if (sentenceWords(body, known).length > 0) return { text, tree: null };
        try {
            return { text, label: label?.[1] ?? "", tree: new Parser(body).whole() };
        } catch (error) {
            if (error instanceof NoFormula) return { text, tree: null };
            throw error;
        }
    });
}
