const BEYOND = 100000;  // lines after the text

/** A text within a shader, with line numbers of its own. */
export const numbered = (text) => `\n#line 1\n${text}\n#line ${BEYOND}\n`;

/** A graphics driver's messages about lines of a text that was numbered(): [{ line, message }], at most one per line. */
export function problemsOf(log, text) {
    const found = new Map(), last = text.split("\n").length;
    for (const [, number, message] of log.matchAll(/ERROR:\s*\d+:(\d+):\s*([^\n]*)/g)) {
        const line = Math.min(Number(number), last);  // an error after the text, such as a missing brace, is reported at its end
        if (!found.has(line)) found.set(line, message.trim());
    }
    if (found.size === 0) return [{ line: 0, message: log.split("\n")[0] }];
    return [...found].map(([line, message]) => ({ line, message }));
}

const FOREIGN = [
    [/#/, "the kernel language has no preprocessor"],
    [/["'\\@$`]/, "the kernel language has no such sign"],
    [/[[\]]/, "the kernel language has no arrays; a vector's components are v.x, v.y, v.z"],
    [/::|->/, "the kernel language has no such operator"],
    [/\b(uniform|in|out|inout|varying|attribute|layout|precision|discard|sampler\w+|switch|struct|void|uint)\b/, "this word is not in the kernel language"],
];

const withoutComments = (text) => text.replace(/\/\/[^\n]*|\/\*[^]*?(\*\/|$)/g, (comment) => comment.replace(/[^\n]/g, " "));

/** Constructs in a function's body that GLSL allows but the kernel language, which is also C++, does not: [{ line, message }]. */
export function foreignTo(body) {
    return withoutComments(body).split("\n").flatMap((text, i) => FOREIGN.filter(([pattern]) => pattern.test(text)).slice(0, 1).map(([, message]) => ({ line: i + 1, message })));
}
