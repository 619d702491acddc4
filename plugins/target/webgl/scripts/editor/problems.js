const BEYOND = 100000;  // lines that stand behind the text

/** A text within a shader, with line numbers of its own. */
export const numbered = (text) => `\n#line 1\n${text}\n#line ${BEYOND}\n`;

/** What a graphics driver's log says about lines of a text that was numbered(): [{ line, message }], no line twice. */
export function problemsOf(log, text) {
    const found = new Map(), last = text.split("\n").length;
    for (const [, number, message] of log.matchAll(/ERROR:\s*\d+:(\d+):\s*([^\n]*)/g)) {
        const line = Math.min(Number(number), last);  // what is wrong behind the text, such as a missing brace, is wrong at its end
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

/** What GLSL allows in a function's body, and the kernel language, which is C++ too, does not: [{ line, message }]. */
export function foreignTo(body) {
    return withoutComments(body).split("\n").flatMap((text, i) => FOREIGN.filter(([pattern]) => pattern.test(text)).slice(0, 1).map(([, message]) => ({ line: i + 1, message })));
}
